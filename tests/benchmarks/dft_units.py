"""How long pictures take in units of a plain matrix DFT: ``python -m tests.benchmarks.dft_units [WORDS]``.

The unit is what anyone would write in numpy for the paper's pupil: 128² samples of the phase of six coefficients of a
new field each time, their exponentials, and two products with kernels that are kept, to 64² samples of the intensity.
All take turns in one process, on CPU time; medians. Sources are new each time too. WORDS choose among the names.
"""

import sys
import warnings
from collections.abc import Callable
from itertools import count
from statistics import median
from time import process_time

import numpy as np

import p2sf
from p2sf.paraxial.seidel import coefficients
from p2sf.threads import using_threads

LENS, FIELD_DEG, WAVELENGTH_UM = "double_gauss_28", 10.0, 0.5875618
SIZE, PIXELS, PIXEL_UM = 128, 64, 0.88
TURNS, SOONEST = 25, 0.004  # rounds, and CPU seconds of one call from which on one is enough in each
UNIT = "plain matrix DFT 128² → 64²"
Work = Callable[[], object]


def plain() -> Work:
    """Return the matrix DFT in float32, everything but the pupil prepared."""
    lens, turn = p2sf.load_lens(LENS), count()
    place = ((np.arange(SIZE) + 0.5) * 2 / SIZE - 1).astype(np.float32)
    eta, square = place[:, None], place**2 + place[:, None] ** 2
    terms = square**2, square * eta, eta**2 + 0 * place, square
    clear = (square <= 1).astype(np.float32)
    na = float(coefficients(lens, np.inf, 0.0, WAVELENGTH_UM).na)
    axis = (np.arange(PIXELS) - PIXELS // 2) * PIXEL_UM * na / WAVELENGTH_UM
    kernel = np.exp(2j * np.pi * np.outer(axis, place)).astype(np.complex64)

    def work() -> np.ndarray:
        six = coefficients(lens, np.inf, np.tan(np.deg2rad(FIELD_DEG)) + 1e-8 * next(turn), WAVELENGTH_UM)
        amounts = six.w40, six.w31, six.w22, six.w20 + six.wd
        phase = sum(np.float32(amount) * term for amount, term in zip(amounts, terms, strict=True))
        field = kernel @ (clear * np.exp(np.complex64(2j * np.pi) * phase)) @ kernel.T
        intensity = np.abs(field) ** 2
        return intensity / intensity.sum()

    return work


def picture(method: str, field_deg: float = FIELD_DEG, strehl: bool = False, **keywords: object) -> Work:
    """Return a public call for a new field each time."""
    lens, turn = p2sf.load_lens(LENS), count()

    def work() -> object:
        source = p2sf.Source(field_deg=field_deg + 1e-6 * next(turn), wavelength_nm=1000 * WAVELENGTH_UM)
        psf = p2sf.render(lens, source, method, **keywords)
        return psf.strehl if strehl else psf

    return work


def look_up(together: int) -> Work:
    """Return PSFs of a database: so many in one call, or one by one where that is 1."""
    database = p2sf.build_database(p2sf.load_lens(LENS), [2000.0, np.inf], [0, 5, 10, 14], [500, 550, 600])
    fields = np.linspace(0.5, 13.5, max(together, 1))
    if together > 1:
        return lambda: database.psfs(depth_mm=np.inf, field_deg=fields, wavelength_nm=550.0, pixels=32, pixel_um=0.69)
    return lambda: database.psf(p2sf.Source(field_deg=7.0, wavelength_nm=550), pixels=32, pixel_um=0.69)


POINTS = {"pixels": PIXELS, "pixel_um": PIXEL_UM, "integrated": False}
HUYGENS = {"pixels": 32, "pixel_um": 0.69, "integrated": False}
TOGETHER = 64
JOBS: dict[str, tuple[Work, int]] = {
    UNIT: (plain(), 1),
    "seidel, preview": (picture("seidel", quality="preview", **POINTS), 1),
    "fitted, preview": (picture("fitted", quality="preview", **POINTS), 1),
    "traced, preview": (picture("traced", quality="preview", **POINTS), 1),
    "huygens 32² at 14°, settled": (picture("huygens", 14.0, **HUYGENS), 1),
    "huygens 32² at 14°, settled, Strehl ratio": (picture("huygens", 14.0, strehl=True, **HUYGENS), 1),
    "render(lens, source), preview": (picture("auto", quality="preview"), 1),
    "render(lens, source), settled": (picture("auto"), 1),
    "one PSF looked up, 32²": (look_up(1), 1),
    f"one of {TOGETHER} looked up together, 32²": (look_up(TOGETHER), TOGETHER),
}


def seconds(work: Work, shares: int) -> float:
    """Return the CPU time of one picture: of one call, or of several where these are short."""
    begun = process_time()
    work()
    taken = process_time() - begun
    more = max(0, round(SOONEST / max(taken, 1e-6)) - 1)
    for _ in range(more):
        work()
    return (process_time() - begun) / (1 + more) / shares


def main(words: list[str]) -> None:
    """Print milliseconds and units of the jobs whose names hold one of the words, or of all."""
    warnings.simplefilter("ignore", p2sf.P2SFWarning)
    jobs = {name: job for name, job in JOBS.items() if name == UNIT or not words or any(w in name for w in words)}
    with using_threads(1):
        taken: dict[str, list[float]] = {name: [] for name in jobs}
        for turn in range(TURNS + 2):
            for name, job in jobs.items():
                found = seconds(*job)
                taken[name] += [found] if turn > 1 else []
    unit = median(taken[UNIT])
    for name, each in taken.items():
        print(f"{name:44} {1e3 * median(each):8.3f} ms {median(each) / unit:7.2f}")


if __name__ == "__main__":
    main(sys.argv[1:])
