"""Try `auto` on random states of the shipped lenses: ``python -m tests.long.method_choice --points 300 --keep FILE``.

A state is a shipped lens, its rings anywhere, and its f-number, depth (2 cm to infinity), focus, field and wavelength
(all that its glass has) drawn at random, in a window of 24 to 128 samples that shows all or as little as a fiftieth of
the PSF's width. What `auto` makes is compared with converged spherical waves, or with plane ones (`huygens`) of an exit
pupil at infinity and, where spherical ones take more than a minute, of a Fresnel number above 1000 and a defocus below
three waves; every sixth state with Kirchhoff's sum over the reference sphere of `tests.support.double_sum`, which
shares with the program its rays alone. Reported are 1 − R²,
the relative L2 error (which tells more where a window holds less than half of the light), CPU seconds and the peak of
memory of every state, in a process of its own, with one thread. States that `auto` refuses count apart. ``--keep`` adds
every state to a file as it is found, and goes on where that file ends. ``--masks`` puts random masks into the stops.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import inf, prod
from pathlib import Path
from time import process_time

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.disc.mask import PupilMask
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import Cancelled, P2SFError
from p2sf.figures.compare import r_squared, relative_l2
from p2sf.lens.lens import Lens, lens_range_um, with_f_number, with_mask, with_sensor
from p2sf.lens.positions import PARAMETER
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.positions import lens_at
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.methods import PsfOptions, whole_pixel_um
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.psf.spherical import fresnel_number, spherical_pupil
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.rays import RayPupil
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.pupil.watch import Watch
from p2sf.raytrace.exit_sphere import exit_sphere
from tests.support.double_sum import double_sum

TOLERANCES = (0.9, 0.99, 0.99, 0.999)
SIDES = (24, 32, 64, 128)
SHORTEST, LONGEST = 0.3, 2.5  # µm, of glasses that have no limits
FEWEST = 1000.0  # Fresnel number, and
MOST_WAVES = 3.0  # of defocus, between which plane waves are the reference
EVERY = 6  # states, of which one is compared with a sum of its own
PAIRS_A_SECOND = 3e7  # wavelets at places of that sum
MOST_SECONDS = 60.0  # of a reference
SECONDS, MEGABYTES = 5.0, 1000.0


@dataclass(frozen=True)
class Trial:
    """One state: what `auto` made of it, what it predicted, and what it missed of the reference.

    ``reference``: what that is; ``missed``, ``l2``: 1 − R² and relative L2 against it; ``own_missed``: 1 − R² against
    a sum that shares the rays alone, None where there is none.
    """

    place: int
    lens: str
    asked: float
    method: str
    predicted: float
    stated_l2: float
    energy: float | None
    reference: str
    missed: float | None
    l2: float | None
    own_missed: float | None
    seconds: float
    megabytes: float

    @property
    def warned(self) -> bool:
        """Return whether the picture says that it keeps less than was asked."""
        return self.predicted > self.asked

    @property
    def wrong(self) -> bool:
        """Return whether it misses more than was asked, and more than it says."""
        worst = max(self.missed or 0.0, self.own_missed or 0.0)
        return worst > max(self.asked, self.predicted)


def random_point(rng: np.random.Generator, names: Sequence[str] = ()) -> tuple[Lens, Source]:
    """Return a shipped lens, its rings anywhere, and a source it can be asked about; both may still have no image."""
    names = names or shipped_lenses()
    lens = find_lens(names[rng.integers(len(names))])
    if lens.positions:
        turned = {PARAMETER[axis.kind]: rng.uniform(axis.low, axis.high) for axis in lens.positions.axes}
        lens = lens_at(lens, **turned)
    low, high = lens_range_um(lens) or (SHORTEST, LONGEST)
    wave = float(rng.uniform(max(low, SHORTEST), min(high, LONGEST)))
    focal = abs(float(cardinal_points(lens, wave).effective_focal_length))
    if np.isfinite(focal) and rng.random() < 0.5:
        lens = with_f_number(lens, float(np.exp(rng.uniform(np.log(2), np.log(16)))))
    depth = inf if rng.random() < 0.4 else float(np.exp(rng.uniform(np.log(20), np.log(2e4))))
    field = float(np.tan(np.deg2rad(rng.uniform(0, max(map(abs, lens.fields_deg))))))
    if rng.random() < 0.6:
        at = depth if rng.random() < 0.5 else float(np.exp(rng.uniform(np.log(100), np.log(1e5))))
        focused = float(image_distance(lens, at, wave))
        if np.isfinite(focused):
            lens = with_sensor(lens, focused + 0.05 * float(rng.normal()))
    return lens, Source(depth, field, wave)


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


def draw(place: int, seed: int, masks: bool = False, names: Sequence[str] = ()) -> tuple[Lens, Source, int, float]:
    """Return the lens, the source and the window, samples a side and µm, of one state. Raises P2SFError."""
    rng = np.random.default_rng([seed, place])
    lens, source = random_point(rng, names)
    lens = with_mask(lens, random_mask(rng)) if masks else lens
    side, part = int(rng.choice(SIDES)), float(np.exp(rng.uniform(np.log(0.02), np.log(2))))
    return lens, source, side, whole_pixel_um(lens, source, side) * (1.0 if rng.random() < 0.4 else part)


def trial(
    place: int, seed: int, masks: bool = False, names: Sequence[str] = (), most_seconds: float = MOST_SECONDS
) -> Trial | str:
    """Return the outcome of one state, or why `auto` refuses it. ``most_seconds``: of its reference."""
    tolerance = TOLERANCES[place % len(TOLERANCES)]
    try:
        lens, source, side, pixel = draw(place, seed, masks, names)
        before = process_time()
        psf = render_integrated(lens, source, "auto", side, pixel, PsfOptions(min_r2=tolerance), wanted=False)
        repr(psf)  # which reads the Strehl ratio
        seconds = process_time() - before
    except P2SFError as reason:
        return f"refused: {reason}"
    megabytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    throughout = psf.shortfall is not None and psf.predicted_error >= 1  # said to be wrong: no reference says more
    reference, values = ("none", None) if throughout else _reference(lens, source, (side, pixel), most_seconds)
    missed = None if values is None else 1 - r_squared(psf.values, values)
    own = _own_sum(lens, source, (side, pixel), most_seconds) if place % EVERY == 0 and not masks else None
    return Trial(
        place,
        lens.name,
        1 - tolerance,
        psf.method,
        inf if psf.predicted_error is None else psf.predicted_error,
        psf.l2_error or inf,
        None if psf.energy is None else float(psf.energy),
        reference,
        missed,
        None if values is None else relative_l2(psf.values, values),
        None if own is None else 1 - r_squared(psf.values, own),
        seconds,
        megabytes,
    )


def _reference(
    lens: Lens, source: Source, window: tuple[int, float], most_seconds: float
) -> tuple[str, np.ndarray | None]:
    """Return the converged sum that `auto` is compared with and its name; None where it takes too many rays."""
    try:
        number = fresnel_number(lens, source)
        waves = abs(float(coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um).wd))
        if number < inf:
            try:
                return "spherical", _within(most_seconds, spherical_pupil(lens, source), window)
            except Cancelled:
                if number < FEWEST or waves > MOST_WAVES:
                    raise
        return "huygens", _within(most_seconds, RayPupil(lens, source), window)
    except P2SFError as reason:
        return f"none: {reason}", None


def _within(seconds: float, pupil: RayPupil, window: tuple[int, float]) -> np.ndarray:
    end = process_time() + seconds
    return psf_of_pupil(
        pupil, window, rtol=SETTLED_TOLERANCE, watch=Watch(cancelled=lambda: process_time() > end)
    ).values


def _own_sum(lens: Lens, source: Source, window: tuple[int, float], most_seconds: float) -> np.ndarray | None:
    """Return Kirchhoff's sum at a third more nodes than should do; None behind a mask, of lost rays and of many nodes.

    The sum knows no masks.
    """
    try:
        sphere = exit_sphere(lens, source)
        if sphere is None or not all_reach(lens, source) or not lens.mask.clear:
            return None
        counts = RayPupil(lens, source, sphere=sphere, most=2**24).counts(window_reach_um(*window))
    except P2SFError:
        return None
    radii, angles = (round(4 / 3 * count) for count in counts)
    radii += radii // 3  # Gauss–Legendre in ρ takes more nodes than in ρ²
    if prod((radii, angles)) * window[0] ** 2 > PAIRS_A_SECOND * most_seconds:
        return None
    return double_sum(lens, source, centred_axis(*window), (radii, angles))


def summary(outcomes: list[Trial | str]) -> str:
    """Return in words how often each method was chosen, what is wrong, and what it cost."""
    found, lines = [one for one in outcomes if isinstance(one, Trial)], []
    for asked in sorted({one.asked for one in found}):
        some = [one for one in found if one.asked == asked]
        counts = {m: sum(o.method == m for o in some) for m in ("seidel", "fitted", "traced", "huygens", "spherical")}
        used = ", ".join(f"{method} {count}" for method, count in counts.items() if count)
        lines.append(
            f"1 − R² ≤ {asked:.1g}: {len(some)} states, {used}; {sum(o.wrong for o in some)} wrong, "
            f"{sum(o.warned for o in some)} that say they keep less"
        )
    seconds, megabytes = ([getattr(one, name) for one in found] for name in ("seconds", "megabytes"))
    theirs, own = (sum(getattr(one, name) is not None for one in found) for name in ("missed", "own_missed"))
    lines.append(
        f"{len(outcomes) - len(found)} refused; {theirs} compared with a reference, {own} with a sum of its own"
    )
    slow, large = sum(value > SECONDS for value in seconds), sum(value > MEGABYTES for value in megabytes)
    lines.append(f"CPU seconds: median {np.median(seconds):.3f}, largest {max(seconds):.2f}, {slow} above {SECONDS:g}")
    lines.append(f"memory: largest {max(megabytes):.0f} MB, {large} above {MEGABYTES:g}")
    return "\n".join(lines)


def trials(
    points: int, seed: int = 1, masks: bool = False, names: Sequence[str] = (), most_seconds: float = MOST_SECONDS
):
    """Yield the outcomes of states in this process until ``points`` are not refused."""
    place = found = 0
    while found < points:
        outcome = trial(place, seed, masks, names, most_seconds)
        found, place = found + isinstance(outcome, Trial), place + 1
        yield outcome


def _in_a_process(place: int, given: argparse.Namespace) -> Trial | str:
    """Return the outcome of one state by a process of its own, whose memory is its own; "lost" where that ends."""
    options = ["--one", str(place), "--seed", str(given.seed), *(["--masks"] if given.masks else [])]
    options += ["--lenses", *given.lenses] if given.lenses else []
    one = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "P2SF_THREADS")}
    done = subprocess.run(
        [sys.executable, "-m", "tests.long.method_choice", *options],
        capture_output=True,
        text=True,
        env=os.environ | one,
        check=False,
    )
    return _read(done.stdout.splitlines()[-1]) if done.stdout else f"lost: {done.stderr[-300:]}"


def _read(line: str) -> Trial | str:
    one = json.loads(line)
    return one if isinstance(one, str) else Trial(**one)


def _written(outcome: Trial | str) -> str:
    return json.dumps(outcome if isinstance(outcome, str) else asdict(outcome))


def main() -> None:
    """Run the trial from the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--masks", action="store_true", help="put random masks into the stops")
    parser.add_argument("--lenses", nargs="+", default=(), metavar="LENS", help="draw from these only")
    parser.add_argument("--keep", type=Path, help="a file of outcomes, to go on where it ends")
    parser.add_argument("--one", type=int, help="print the outcome of one state alone")
    given = parser.parse_args()
    if given.one is not None:
        print(_written(trial(given.one, given.seed, given.masks, given.lenses)))
        return
    kept = given.keep.read_text().splitlines() if given.keep and given.keep.exists() else []
    outcomes = [_read(line) for line in kept]
    while sum(isinstance(one, Trial) for one in outcomes) < given.points:
        outcomes.append(_in_a_process(len(outcomes), given))
        if given.keep:
            with given.keep.open("a") as file:
                file.write(_written(outcomes[-1]) + "\n")
        last = outcomes[-1]
        if isinstance(last, str) and last.startswith("lost"):
            print(last, flush=True)
        if isinstance(last, Trial) and (last.wrong or last.warned or last.seconds > SECONDS):
            print("WRONG" if last.wrong else "note", last, flush=True)
    print(summary(outcomes))


if __name__ == "__main__":
    main()
