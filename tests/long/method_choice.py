"""Try the chooser on random lenses and sources: ``python -m tests.long.method_choice --points 300``.

A point is a shipped lens (or a witness's, glass as listed), its f-number, depth, focus, field and wavelength drawn at
random. Every method that was cheaper than the chosen one, and the chosen one, is rendered and measured against the
reference. Never may the chosen one fall below the tolerance; how often a cheaper one would have done is printed.
"""

import argparse
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import inf

import numpy as np

from p2sf.errors import GeometryError, P2SFError
from p2sf.lens.lens import Lens, with_f_number, with_mask, with_sensor
from p2sf.lens.positions import PARAMETER
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.positions import lens_at
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.compare import r_squared
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import sum_rays
from p2sf.psf.methods import QUICK_LEVELS, Choice, PsfOptions, choose, reference_pupil, render
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.pupil.mask import PupilMask
from p2sf.raytrace.fit import levels

PIXELS = 64
STEEPEST = 80.0  # waves per pupil radius: beyond it a reference takes seconds, and no method is harder to choose
TOLERANCES = (0.9, 0.99, 0.999, 0.9999)


@dataclass(frozen=True)
class Trial:
    """One point: what was chosen, what was predicted and measured (1 − R²), and what cheaper methods measured."""

    lens: str
    source: Source
    tolerance: float
    method: str
    predicted: float
    measured: float
    cheaper: tuple[float, ...]

    @property
    def wrong(self) -> bool:
        """Return whether the chosen method is worse than was asked."""
        return 1 - self.measured < self.tolerance

    @property
    def needless(self) -> bool:
        """Return whether a cheaper method would have done."""
        return any(1 - error >= self.tolerance for error in self.cheaper)


def random_point(rng: np.random.Generator, names: Sequence[str] = ()) -> tuple[Lens, Source]:
    """Return a shipped lens, its rings anywhere, and a source it can be asked about; both may still have no image."""
    names = names or shipped_lenses()
    lens = find_lens(names[rng.integers(len(names))])
    if lens.positions:
        turned = {PARAMETER[axis.kind]: rng.uniform(axis.low, axis.high) for axis in lens.positions.axes}
        lens = lens_at(lens, **turned)
    low, high = min(lens.wavelengths_nm), max(lens.wavelengths_nm)
    wavelength = rng.uniform(low, high) / 1000
    focal = abs(float(cardinal_points(lens, wavelength).effective_focal_length))
    if np.isfinite(focal) and rng.random() < 0.5:
        lens = with_f_number(lens, float(np.exp(rng.uniform(np.log(2), np.log(16)))))
    depth = inf if rng.random() < 0.4 else min(1e3, focal) * float(np.exp(rng.uniform(np.log(4), np.log(100))))
    field = float(np.tan(np.deg2rad(rng.uniform(0, max(lens.fields_deg)))))
    if rng.random() < 0.7:
        lens = with_sensor(lens, float(image_distance(lens, depth, wavelength)) + 0.05 * float(rng.normal()))
    return lens, Source(depth, field, wavelength)


def random_mask(rng: np.random.Generator) -> PupilMask:
    """Return a mask such as cameras and telescopes have: one to three parts of it."""
    parts = [
        {"obscuration": float(rng.uniform(0.1, 0.9))},
        {"vanes": int(rng.integers(1, 6)), "vane_width": float(rng.uniform(0.005, 0.05))},
        {"blades": int(rng.integers(3, 12)), "roundness": float(rng.uniform(0, 1))},
        {"apodisation": float(rng.uniform(0.4, 1.5)), "apodisation_power": 2 * int(rng.integers(1, 5))},
        {"cubic_um": float(rng.normal())},
        {"zernike_um": tuple(rng.normal(0, 0.1, 11).tolist())},
    ]
    chosen = rng.choice(len(parts), rng.integers(1, 4), replace=False)
    values = {name: value for k in chosen for name, value in parts[k].items()}
    return PupilMask(**values, turn_deg=float(rng.choice([0.0, rng.uniform(0, 360)])))


def trial(lens: Lens, source: Source, tolerance: float) -> Trial | None:
    """Return the outcome of one point; None where it has no PSF or would take a reference seconds."""
    try:
        c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
        pixel = float(suitable_pixel_um(c, PIXELS))
        if pixel * PIXELS * float(c.na) / source.wavelength_um / 2 > STEEPEST:
            return None
        choice = choose(lens, source, tolerance)
        reference = sum_rays(reference_pupil(lens, source), (PIXELS, pixel))
    except P2SFError:
        return None

    def error(psf) -> float:
        return 1 - r_squared(psf.values, reference.values)

    chosen = render(lens, source, choice.method, PIXELS, pixel, PsfOptions(min_r2=tolerance))
    errors = tuple(error(psf) for psf in _cheaper(lens, source, choice, pixel))
    return Trial(lens.name, source, tolerance, choice.method, choice.predicted_error, error(chosen), errors)


def _cheaper(lens: Lens, source: Source, choice: Choice, pixel: float):
    """Yield the PSFs of all methods below the chosen one; a fit that lost rays forbid is none."""
    if choice.method != "seidel":
        yield render(lens, source, "seidel", PIXELS, pixel)
    for level in levels(lens.aim)[: len(QUICK_LEVELS)]:
        if choice.method in ("traced", "huygens", "spherical") or level.numbers < choice.numbers:
            with suppress(GeometryError):
                yield fitted_psf(lens, source, PIXELS, pixel, level.numbers)


def trials(points: int, seed: int = 1, masks: bool = False, names: Sequence[str] = ()):
    """Yield ``points`` outcomes of shipped lenses, the tolerances in turn; ``masks``: behind random masks."""
    rng, found = np.random.default_rng(seed), 0
    while found < points:
        lens, source = random_point(rng, names)
        lens = with_mask(lens, random_mask(rng)) if masks else lens
        outcome = trial(lens, source, TOLERANCES[found % len(TOLERANCES)])
        if outcome:
            found += 1
            yield outcome


def summary(outcomes: list[Trial]) -> str:
    """Return in words how often each method was chosen, wrong and needlessly expensive, per tolerance."""
    lines = []
    for tolerance in TOLERANCES:
        some = [o for o in outcomes if o.tolerance == tolerance]
        counts = {m: sum(o.method == m for o in some) for m in ("seidel", "fitted", "traced", "huygens", "spherical")}
        used = ", ".join(f"{method} {count}" for method, count in counts.items() if count)
        wrong, needless = sum(o.wrong for o in some), sum(o.needless for o in some)
        lines.append(f"R² ≥ {tolerance}: {len(some)} points, {used}; {wrong} wrong, {needless} needlessly expensive")
    ratio = max(o.measured / o.predicted for o in outcomes)
    return "\n".join([*lines, f"largest measured/predicted error of a chosen method: {ratio:.2f}"])


def main() -> None:
    """Run the trial from the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--masks", action="store_true", help="put random masks into the stops")
    parser.add_argument("--lenses", nargs="+", default=(), metavar="LENS", help="draw from these only")
    given = parser.parse_args()
    outcomes = []
    for outcome in trials(given.points, given.seed, given.masks, given.lenses):
        outcomes.append(outcome)
        if outcome.wrong:
            print("WRONG", outcome, flush=True)
        if len(outcomes) % 50 == 0:
            print(len(outcomes), "points", flush=True)
    print(summary(outcomes))


if __name__ == "__main__":
    main()
