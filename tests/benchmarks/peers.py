"""The same work by this project and its peers, in one process: ``python -m tests.benchmarks.peers [--json]``.

Needs the extra ``.[bench]``; a peer that is not installed is left out and said so. Everything on one BLAS thread;
median CPU and wall times; ratios to our own row. Peers start from prepared operators wherever they offer them.
"""

import json
import sys
import warnings
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from p2sf.conventions import slope_from_degrees
from p2sf.disc.quadrature import cell_areas
from p2sf.figures.compare import r_squared
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import PsfOptions, render
from p2sf.psf.opd_array import opd_intensity
from p2sf.psf.seidel import seidel_psf
from p2sf.raytrace.pencil import opd_map
from tests.benchmarks.timing import timed

SIZE, PIXELS = 128, 64
CELL = (2 * np.arange(SIZE) + 1 - SIZE) / SIZE
CYCLES = -0.25  # NA·pixel/λ, with the sign of the peers' forward transform
SLOW_MS = 30.0  # a call this slow is repeated less often


@dataclass(frozen=True)
class Row:
    """One program's median times for one piece of work, and the ratio of its CPU time to ours."""

    work: str
    program: str
    cpu_ms: float
    wall_ms: float
    ratio: float
    note: str = ""


Work = Callable[[], object]


def dft_rows() -> Iterator[tuple[str, Work, str]]:
    """Yield every program's matrix DFT, 128² OPD array in, 64² PSF at λ/(4 NA) out; R² is against our float64 one."""
    xi, eta = np.meshgrid(CELL, CELL)
    area = cell_areas(CELL, CELL, 2 / SIZE)
    opd = 1.2 * (xi**2 + eta**2) ** 2 - 0.8 * eta * (xi**2 + eta**2) + 0.5 * eta**2
    wanted = opd_intensity(opd, area, CYCLES, PIXELS, np.float64)
    for dtype in (np.float32, np.float64):
        yield f"p2sf, {np.dtype(dtype).name}", lambda t=dtype: opd_intensity(opd, area, CYCLES, PIXELS, t), ""

    def pupil(sign=1):
        return area * np.exp(sign * 2j * np.pi * opd)

    for name, peer in (("prysm", _prysm), ("hcipy", _hcipy), ("poppy", _poppy)):
        try:
            work = peer(pupil)
        except ImportError:
            print(f"{name} is not installed and left out; pip install '.[bench]' brings it", file=sys.stderr)
            continue
        yield name, work, f"R² {r_squared(work(), wanted):.4f} to ours"


def _prysm(pupil) -> Work:
    from prysm.fttools import mdft

    return lambda: np.abs(mdft.dft2(pupil(), 2, PIXELS)) ** 2


def _hcipy(pupil) -> Work:
    from hcipy import CartesianGrid, Field, MatrixFourierTransform, SeparatedCoords

    place = np.arange(PIXELS) - PIXELS // 2
    inside = CartesianGrid(SeparatedCoords((CELL / 2, CELL / 2)))
    outside = CartesianGrid(SeparatedCoords((place * np.pi, place * np.pi)))
    inside.weights, outside.weights = np.ones(inside.size), np.ones(outside.size)
    transform = MatrixFourierTransform(inside, outside, precompute_matrices=True, allocate_intermediate=True)
    return lambda: np.abs(np.asarray(transform.forward(Field(pupil().ravel(), inside)))).reshape(PIXELS, PIXELS) ** 2


def _poppy(pupil) -> Work:
    from poppy.matrixDFT import matrix_dft

    # Its forward transform has the other sign: the conjugate pupil gives the same picture, not the one turned by 180°.
    return lambda: np.abs(matrix_dft(pupil(-1), PIXELS / 2, PIXELS, centering="FFTSTYLE")) ** 2


def lens_rows() -> dict[str, list[tuple[str, Work, str]]]:
    """Return the pieces of work that start from a lens: the Double Gauss at 14°, C line."""
    lens = find_lens("double_gauss_28")
    source = Source(field_slope=float(slope_from_degrees(14)), wavelength_um=0.6562725)
    window = 32, 0.69125
    place = source.depth_mm, source.field_slope, source.wavelength_um
    wanted = huygens_psf(lens, source, *window).values

    def ours(name: str, work: Callable[[], object]):
        return f"p2sf, {name}", work, f"R² {r_squared(work().values, wanted):.4f} to the Huygens sum"

    peer = _optiland()
    psfs = [
        ours("huygens, one pass", lambda: render(lens, source, "huygens", *window, PsfOptions("preview"))),
        ours("traced, preview", lambda: render(lens, source, "traced", *window, PsfOptions("preview"))),
        ours("fitted, preview", lambda: render(lens, source, "fitted", *window, PsfOptions("preview"))),
        ours("seidel, preview", lambda: seidel_psf(coefficients(lens, *place), *window, "preview")),
    ]
    opds = [("p2sf", lambda: opd_map(lens, source, SIZE), "exact rays")]
    sums = [("p2sf", lambda: coefficients(lens, *place), "six coefficients, one source")]
    if peer:
        opd, psf, seidel = peer
        psfs.append(("optiland, HuygensPSF 128² rays", psf, "its own Double Gauss, its own grid"))
        opds.append(("optiland", opd, "uniform 128² distribution"))
        sums.append(("optiland", seidel, "Seidel sums, one source"))
    return {
        "lens to PSF 32 × 32": psfs,
        "exact OPD on 128 × 128": opds,
        "Seidel coefficients": sums,
    }


def _optiland():
    """Return optiland's OPD, Huygens PSF and Seidel sums of its own Double Gauss at full field; None without it."""
    try:
        from optiland.aberrations import Aberrations
        from optiland.psf import HuygensPSF
        from optiland.samples.objectives import DoubleGauss
        from optiland.wavefront import OPD
    except ImportError:
        print("optiland is not installed and left out; pip install '.[bench]' brings it", file=sys.stderr)
        return None
    lens = DoubleGauss()
    return (
        lambda: OPD(lens, (0, 1), 0.6563, num_rays=SIZE, distribution="uniform"),
        lambda: HuygensPSF(lens, (0, 1), 0.6563, num_rays=SIZE, image_size=32),
        lambda: Aberrations(lens).seidels(),
    )


def measured(work: str, entries) -> list[Row]:
    """Return a row per program, the first one's CPU time the unit of the ratios."""
    rows = []
    for program, call, note in entries:
        with threadpool_limits(1):  # here, since a peer's import may bring thread pools of its own
            found = timed(call, 200 if timed(call, 3).cpu_ms < SLOW_MS else 5)
        unit = rows[0].cpu_ms if rows else found.cpu_ms
        rows.append(Row(work, program, found.cpu_ms, found.wall_ms, found.cpu_ms / unit, note))
    return rows


def main(arguments: list[str]) -> int:
    """Print the table in Markdown, or the rows as JSON."""
    warnings.simplefilter("ignore")  # the peers' own, on their way through numba and pandas
    rows = measured("matrix DFT 128² → 64²", dft_rows())
    for work, entries in lens_rows().items():
        rows += measured(work, entries)
    if "--json" in arguments:
        print(json.dumps([asdict(row) for row in rows], indent=1, ensure_ascii=False))
        return 0
    print("| work | program | CPU ms | wall ms | times ours | |\n|---|---|---|---|---|---|")
    for row in rows:
        figures = f"{row.cpu_ms:.3g} | {row.wall_ms:.3g} | {row.ratio:.3g}"
        print(f"| {row.work} | {row.program} | {figures} | {row.note} |")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
