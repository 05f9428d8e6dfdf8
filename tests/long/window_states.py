"""Hold random pictures of the window against Huygens: ``python -m tests.long.window_states --states 500``.

A state is a shipped lens with depth, field, f-number, focus distance and sensor shift drawn at random over the window's
own ranges, something in the stop of every third, and the method left to `auto`. The picture is the one that stays when
the sliders rest, deferred sums waited for. It has R² of at least 0.99 against the Huygens sum on every k-th of its own
samples, or it is ray density, says so and quotes no figure of waves. Printed are all that break this, the share of ray
density, and the least R².
"""

import argparse
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf
from time import perf_counter

import numpy as np

from p2sf.errors import P2SFError
from p2sf.figures.compare import r_squared
from p2sf.lensfile.library import shipped_lenses
from p2sf.psf.methods import reference_pupil
from p2sf.psf.picture import psf_of_pupil
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.rays import RayPupil
from p2sf_explorer.compute.deferred_sums import SumCache, answer_to
from p2sf_explorer.compute.live import Live, live
from p2sf_explorer.compute.setup import ParaxialSetup, default_state, prescription, ranges
from p2sf_explorer.state.state import State, change

LEAST = 0.99
SAMPLES, FEW_SAMPLES = 64, 16  # a side, on which a picture is compared; where the reference has many rays
MOST_RAYS, MOST_PRODUCTS = 2**27, 2**34  # of the reference, which has to reach farther than in the window
FARTHEST_MM = 1e5
MASKED = 1 / 3  # of the states have something in the stop
SHIFT_UM = 50.0  # standard deviation of the sensor's place about the focus


@dataclass(frozen=True)
class Outcome:
    """A state, the method of its picture, R² against Huygens (NaN for ray density), and what is wrong with it."""

    state: State
    method: str
    r_squared: float
    wrong: str
    seconds: float


def random_state(rng: np.random.Generator) -> State:
    """Return a state within the window's ranges: half of the lenses focused on the source, the others somewhere."""
    names = shipped_lenses()
    state = default_state(names[rng.integers(len(names))])
    lens = prescription(state)
    found = ranges(lens)
    near = max(found.closest_mm, 1.0)

    def distance() -> float:
        return (
            inf if rng.random() < 0.4 else float(np.exp(rng.uniform(np.log(near), np.log(max(FARTHEST_MM, 10 * near)))))
        )

    made_for = state.optics.depth_mm  # finite for a lens that is made for near objects
    depth = distance() if made_for == inf else made_for * float(np.exp(rng.uniform(-0.5, 0.5)))
    focus = depth if rng.random() < 0.5 else (None if rng.random() < 0.5 else distance())
    f_number = float(np.exp(rng.uniform(*np.log(found.f_number)))) if rng.random() < 0.7 else None
    return change(
        state,
        **(random_mask(rng) if rng.random() < MASKED else {}),
        method="auto",
        depth_mm=depth,
        field_deg=float(rng.uniform(0, max(max(lens.fields_deg), 1.0))),
        f_number=f_number,
        focus_mm=focus,
        sensor_shift_um=float(rng.normal(0, SHIFT_UM)) if rng.random() < 0.5 else 0.0,
    )


def random_mask(rng: np.random.Generator) -> dict[str, float]:
    """Return entries of a mask in the stop: one or two of an obscuration, a spider, blades, a filter, a cubic phase."""
    angle = float(rng.uniform(-180, 180))
    kinds = (
        {"obscuration": float(rng.uniform(0.05, 0.9))},
        {"obscuration": float(rng.uniform(0.1, 0.5)), "vanes": int(rng.integers(2, 7)), "vane_angle_deg": angle},
        {"blades": int(rng.integers(3, 12)), "roundness": float(rng.uniform(0, 1)), "blade_angle_deg": angle / 3},
        {"apodisation": float(rng.uniform(0.4, 2)), "apodisation_power": int(2 * rng.integers(1, 5))},
        {"cubic_um": float(rng.uniform(-1, 1))},
    )
    found: dict[str, float] = {}
    for number in rng.choice(len(kinds), size=int(rng.integers(1, 3)), replace=False):
        found |= kinds[number]
    return found


def settled(state: State) -> Live:
    """Return the answer that stays on screen, its deferred sum waited for."""
    cache = SumCache()
    answer = live(state, cache=cache)
    while answer.pending:
        try:
            cache.keep(answer.pending, answer_to(answer.pending))
        except P2SFError as error:
            cache.keep(answer.pending, error.message)
        answer = live(state, cache=cache)
    return answer


def outcome(state: State) -> Outcome | None:
    """Return what is shown in a state; None where there is no picture, which the window says."""
    begun = perf_counter()
    try:
        answer = settled(state)
    except P2SFError:
        return None
    psf = answer.psf
    if psf.method == "geometric":
        said = "ray density" in str(answer.why) or "ray density" in " ".join(map(str, answer.warnings))
        quoted = psf.strehl is not None or psf.predicted_error is not None
        wrong = "" if said and not quoted else "ray density that is not said, or quotes a figure of waves"
        return Outcome(state, "geometric", np.nan, wrong, perf_counter() - begun)
    found = against_huygens(answer)
    return Outcome(state, psf.method, found, "" if found >= LEAST else "a wrong picture", perf_counter() - begun)


def against_huygens(answer: Live) -> float:
    """Return R² of a picture on every k-th of its samples, more of them where few look wrong."""
    found = on_samples(answer, SAMPLES)
    return found if found >= LEAST else on_samples(answer, 2 * SAMPLES)


def on_samples(answer: Live, samples: int) -> float:
    """Return R² of a picture on so many of its samples a side about the chief ray's, on fewer where rays are many.

    Where even few of them would take minutes, they lie closer together, about the chief ray.
    """
    psf, setup, clip = answer.psf, answer.setup, answer.state.optics.clip
    count = psf.values.shape[-1]
    step = count // samples
    while step > 1 and too_many(setup, (samples, psf.pixel_um * step), clip):
        if samples > FEW_SAMPLES:
            samples, step = samples // 2, step * 2
        else:
            step //= 2
    some = slice((count - samples * step) // 2, (count + samples * step) // 2, step)
    pupil = replace(reference_pupil(setup.lens, setup.source, clip), most=MOST_RAYS)
    reference = psf_of_pupil(pupil, (samples, psf.pixel_um * step))
    return r_squared(psf.values[some, some], reference.values)


def too_many(setup: ParaxialSetup, window: tuple[int, float], clip: bool) -> bool:
    """Return whether the reference would take minutes for a window."""
    radii, directions = RayPupil(setup.lens, setup.source, clip, most=MOST_RAYS).counts(window_reach_um(*window))
    return radii * directions * window[0] ** 2 > MOST_PRODUCTS


def outcomes(states: int, seed: int = 1) -> Iterator[Outcome]:
    """Yield so many outcomes."""
    rng, count = np.random.default_rng(seed), 0
    while count < states:
        found = outcome(random_state(rng))
        if found:
            count += 1
            yield found


def summary(found: list[Outcome]) -> str:
    """Return in words how many pictures are wrong, which methods made them, and the least R²."""
    counts = Counter(one.method for one in found)
    used = ", ".join(f"{method} {count}" for method, count in counts.most_common())
    least = np.nanmin([one.r_squared for one in found])
    share = 100 * counts["geometric"] / len(found)
    wrong = sum(bool(one.wrong) for one in found)
    return f"{len(found)} states: {used}; {wrong} wrong; ray density in {share:.1f} %; least R² {least:.6f}"


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--states", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    found = []
    for one in outcomes(given.states, given.seed):
        found.append(one)
        if one.wrong:
            print("WRONG", one, flush=True)
        if len(found) % 50 == 0:
            print(summary(found), flush=True)


if __name__ == "__main__":
    main()
