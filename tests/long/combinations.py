"""Random combinations of everything: ``python -m tests.long.combinations [COUNT] [--seed N] [--start K]``.

A state is a shipped lens with its rings anywhere, at some f-number, depth, focus, field, azimuth and colour; perhaps
with surfaces tilted and decentred, a freeform or irregular one, one that passes less light, a tilted sensor, a mask and
rims that clip; and a method. Either it is refused by a sentence, or its PSF is

- the sum of its own description of the pupil: 1 − R² ≤ 1e-4 against `tests.support.brute_force`, of six coefficients,
  of the polynomials of a fit or of exact rays;
- as near to exact rays as it says: 1 − R² ≤ 1e-4 for traced and huygens, of other methods what they predict, of auto
  what is allowed.

Printed: for every method how many hold, the worst 1 − R² against its own description and against rays; every failure
with the command that repeats it; every sentence that refuses, and how often. States are drawn independently.
"""

import argparse
import sys
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from math import inf, isfinite, sqrt

import numpy as np

import p2sf
from p2sf.disc.mask import PupilMask
from p2sf.errors import P2SFError, P2SFWarning
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import Lens, with_aim, with_mask
from p2sf.lens.misalignment import with_tilted_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lens.transmission import Transmission
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.methods import NAMES, whole_pixel_um
from p2sf.psf.prediction import residual_for
from p2sf.psf.result import Psf
from p2sf.pupil.fit import fit
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.pencil import pencil
from tests.long.method_choice import TOLERANCES, random_mask, random_point
from tests.long.misaligned_methods import misaligned
from tests.support.brute_force import AGREED, Description, brute_force, of_fit, of_rays, of_six, within_rims
from tests.support.waves import r_squared

PIXELS = 24
ALLOWED = 1e-4  # 1 − R² of a sum, and of exact rays
STEEPEST = 40.0  # waves per pupil radius: beyond, brute force takes many seconds
SENSOR_TILT_DEG = 2.0
PART_UM = 0.5  # sag of an added part of a surface, µm
MOST_SAID = 110  # characters of a sentence that refuses
# The double sum of spherical waves is in `tests.psf.test_spherical`; here light goes in plane ones.
METHODS = (*(name for name in NAMES if name != "spherical"), "auto")


@dataclass(frozen=True)
class State:
    """What is asked for; ``pixel_um`` shows the whole PSF."""

    lens: Lens
    source: Source
    method: str
    clip: bool
    tolerance: float
    pixel_um: float
    parts: str

    def __str__(self) -> str:
        mask, clipped = self.lens.mask, "clipped, " if self.clip else ""
        own = [f.name for f in fields(mask) if getattr(mask, f.name) != f.default]
        shown = f", PupilMask({', '.join(f'{name}={getattr(mask, name)}' for name in own)})" if own else ""
        return f"{self.lens.name} {self.source} {self.method} {clipped}R² ≥ {self.tolerance:g}, {self.parts}{shown}"


@dataclass(frozen=True)
class Verdict:
    """1 − R² against the description of the pupil (NaN: it has none) and against exact rays, or why there is no PSF.

    ``limit``: what was allowed against exact rays. ``refused``: the template of a sentence; ``unjudged``: it is outside
    the limits, but brute force did not converge.
    """

    state: State
    own: float = np.nan
    exact: float = np.nan
    limit: float = np.nan
    refused: str = ""
    said: str = ""
    unjudged: bool = False

    @property
    def good(self) -> bool:
        held = not self.own > ALLOWED and self.exact <= self.limit
        return bool(self.refused) or self.unjudged or held


def state_of(seed: int, number: int) -> State:
    """Return one state: the first drawn that can be built and whose blur brute force can sum."""
    rng = np.random.default_rng((seed, number))
    while True:
        with suppress(P2SFError):
            lens, source = random_point(rng)
            lens, parts = with_parts(lens, rng)
            source = replace(source, azimuth_deg=float(rng.choice([0.0, rng.uniform(0, 360)])))
            method, clip = METHODS[number % len(METHODS)], bool(rng.random() < 0.4)
            tolerance = TOLERANCES[int(rng.integers(len(TOLERANCES)))]
            pixel, slope = _pitch(lens, source)
            if slope < STEEPEST:
                return State(lens, source, method, clip, tolerance, pixel, parts)


def _pitch(lens: Lens, source: Source) -> tuple[float, float]:
    """Return a pitch at which the window shows where coefficients and rays land, and waves per pupil radius."""
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    pixel = float(whole_pixel_um(lens, source, PIXELS))
    turn = np.linspace(0, 2 * np.pi, 16)
    rays = pencil(lens, source, np.sin(turn), np.cos(turn))
    pixel = max(pixel, 2.2 * float(np.nanmax(np.hypot(rays.x_um, rays.y_um), initial=0.0)) / PIXELS)
    return pixel, pixel * PIXELS * abs(float(c.na)) / source.wavelength_um / 2


def with_parts(lens: Lens, rng: np.random.Generator) -> tuple[Lens, str]:
    """Return the lens with some of what a lens may have, and in words which."""
    kinds: tuple[tuple[str, float, Callable[[Lens, np.random.Generator], Lens]], ...] = (
        ("freeform", 0.15, _freeform),
        ("transmission", 0.15, _shaded),
        ("misaligned", 0.35, misaligned),
        ("tilted sensor", 0.2, _tilted),
        ("mask", 0.6, _masked),
        ("paraxial pupil", 0.15, lambda lens, rng: with_aim(lens, "paraxial")),
    )
    chosen = [(name, change) for name, share, change in kinds if rng.random() < share]
    for _, change in chosen:
        lens = change(lens, rng)
    return lens, ", ".join(name for name, _ in chosen) or "as shipped"


def _freeform(lens: Lens, rng: np.random.Generator) -> Lens:
    """Return the lens with a polynomial, Zernike terms or an irregularity on one of its surfaces."""
    k = int(rng.integers(len(lens.surfaces)))
    radius, size = lens.surfaces[k].semi_diameter or 10.0, PART_UM / 1000
    values = tuple((size * rng.uniform(-1, 1, 9)).tolist())
    kind = rng.integers(3)
    if kind == 2 or lens.surfaces[k].shape is not None or lens.surfaces[k].ideal:
        part = {"irregularity": Irregularity(*rng.uniform(-2, 2, 2).tolist(), radius)}
    else:
        part = {"shape": (XYPolynomial, ZernikeFringeSag)[kind](values, radius)}
    return _with_surface(lens, k, **part)


def _shaded(lens: Lens, rng: np.random.Generator) -> Lens:
    """Return the lens with a surface that passes less light towards its rim."""
    k = int(rng.integers(len(lens.surfaces)))
    radius = lens.surfaces[k].semi_diameter or 10.0
    return _with_surface(lens, k, transmission=Transmission(0.9, -float(rng.uniform(0, 0.8)) / radius**2))


def _with_surface(lens: Lens, k: int, **change: object) -> Lens:
    surfaces = list(lens.surfaces)
    surfaces[k] = replace(surfaces[k], **change)  # type: ignore[arg-type]  # any field of a surface
    return replace(lens, surfaces=tuple(surfaces))


def _tilted(lens: Lens, rng: np.random.Generator) -> Lens:
    x, y = rng.uniform(-SENSOR_TILT_DEG, SENSOR_TILT_DEG, 2).tolist()
    return with_tilted_sensor(lens, Placement(tilt_x_deg=x, tilt_y_deg=y))


def _masked(lens: Lens, rng: np.random.Generator) -> Lens:
    """Return the lens with a random mask, its dark disc anywhere."""
    mask = random_mask(rng)
    if mask.obscuration and rng.random() < 0.5:
        room, angle = (1 - mask.obscuration) * rng.random(), rng.uniform(0, 2 * np.pi)
        mask = replace(mask, obscuration_x=float(room * np.sin(angle)), obscuration_y=float(room * np.cos(angle)))
    return with_mask(lens, mask)


def verdict(state: State) -> Verdict:
    """Return what becomes of a state."""
    lens, source = state.lens, state.source
    try:
        psf = rendered(state)
    except P2SFError as why:
        return Verdict(state, refused=template(why), said=str(why))
    if psf.method == "spherical":
        return Verdict(state, refused="spherical waves", said="judged by the double sum of its own tests")
    mask = mask_seen(lens, source)
    exact, sure = brute_force(of_rays(lens, source, mask, state.clip), mask, psf.values, state.pixel_um)
    own, sums = described(state, psf, mask), exact
    if own is not None:
        sums, known = brute_force(own, mask, psf.values, state.pixel_um)
        sure &= known
    error = np.nan if psf.method == "gaussian" else 1 - r_squared(psf.values, sums)
    found = Verdict(state, error, 1 - r_squared(psf.values, exact), _limit(state, psf))
    return found if found.good or sure else replace(found, unjudged=True)


def rendered(state: State) -> Psf:
    """Return the PSF as anyone asks for it."""
    return p2sf.render(
        state.lens,
        state.source,
        state.method,
        pixels=PIXELS,
        pixel_um=state.pixel_um,
        min_r2=state.tolerance,
        clip=state.clip,
        integrated=False,
    )


def described(state: State, psf: Psf, mask: PupilMask) -> Description | None:
    """Return the description of the pupil by the method that made the PSF; None where that is exact rays."""
    lens, source, whole = state.lens, state.source, None
    if psf.method == "seidel":
        whole = of_six(coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um), mask)
    if psf.method == "fitted":
        found = fit(lens, source, psf.numbers, residual_waves=residual_for(state.tolerance))
        whole = of_fit(found, mask, source.wavelength_um)
    return within_rims(whole, lens, source) if whole and state.clip else whole


def _limit(state: State, psf: Psf) -> float:
    """Return the 1 − R² against exact rays that is allowed."""
    if psf.method in ("traced", "huygens"):
        return ALLOWED
    predicted = inf if psf.predicted_error is None else float(psf.predicted_error)
    if psf.method == "gaussian":  # measured against the reference, not predicted
        return (sqrt(predicted) + sqrt(AGREED)) ** 2
    predicted = max(predicted, ALLOWED)  # by which the sum may err
    return min(predicted, max(1 - state.tolerance, ALLOWED)) if state.method == "auto" else predicted


def template(why: P2SFError) -> str:
    """Return the sentence of an error without its values."""
    return str(why.message.template)


def verdicts(count: int, seed: int = 1, start: int = 0) -> Iterator[tuple[int, Verdict]]:
    """Yield the numbers of so many states and what becomes of them."""
    return ((number, verdict(state_of(seed, number))) for number in range(start, start + count))


def table(found: list[Verdict]) -> str:
    """Return for every method how many states hold, and the worst errors."""
    lines = [f"{'asked':10}{'states':>7}{'held':>6}{'refused':>9}{'unjudged':>9}{'failed':>7}  worst own   exact/limit"]
    for method in METHODS:
        some = [one for one in found if one.state.method == method]
        judged = [one for one in some if not one.refused and not one.unjudged]
        refused, unjudged = sum(bool(one.refused) for one in some), sum(one.unjudged for one in some)
        failed = sum(not one.good for one in some)
        own = max((one.own for one in judged if isfinite(one.own)), default=np.nan)
        share = max((one.exact / one.limit for one in judged), default=np.nan)
        held = len(judged) - failed
        lines.append(f"{method:10}{len(some):7}{held:6}{refused:9}{unjudged:9}{failed:7}  {own:9.1e}   {share:11.1e}")
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--start", type=int, default=0)
    parser.add_argument("--verbose", action="store_true", help="a line for every state")
    given = parser.parse_args()
    warnings.simplefilter("ignore", P2SFWarning)  # of light beyond the window
    found, begun = [], time.perf_counter()
    for number, one in verdicts(given.count, given.seed, given.start):
        found.append(one)
        seconds, begun = time.perf_counter() - begun, time.perf_counter()
        figures = f"own {one.own:.1e}, exact {one.exact:.1e} of {one.limit:.1e}"
        if not one.good:
            again = f"python -m tests.long.combinations 1 --seed {given.seed} --start {number}"
            print(f"FAILED {figures}: {again}\n    {one.state}", flush=True)
        elif given.verbose:
            became = one.said or ("not converged" if one.unjudged else figures)
            print(f"{number} {seconds:.1f} s {one.state}: {became}", flush=True)
    print(table(found))
    for (method, sentence), count in sorted(Counter((v.state.method, v.refused) for v in found if v.refused).items()):
        print(f"{count:5} {method:8} {sentence[:MOST_SAID]}")
    return int(not all(one.good for one in found))


if __name__ == "__main__":
    sys.exit(main())
