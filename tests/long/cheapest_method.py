"""What `auto` takes and what a stopwatch would: ``python -m tests.long.cheapest_method --points 60 --keep FILE``.

States are those of `tests.long.method_choice`: shipped lenses, f-numbers, depths, focus, fields, wavelengths and
windows at random. Every method makes its preview and its settled picture, interleaved, of sources that differ in the
tenth digit so that nothing is remembered; a time is the median of ROUNDS readings of the process's own clock, and that
of a picture with its predicted error. True errors are against the settled sum of spherical waves, or of plane ones of
an exit pupil at infinity; states whose reference takes longer than --most seconds are left out and counted. Reported
are, at every R² of ASKED: misses of `auto`, said or not; its time over that of the cheapest method that suffices; how
often six coefficients are passed over that would do; what choosing adds to a picture; and the predicted over the true
error of every method.
"""

import argparse
import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from math import isinf
from pathlib import Path
from time import process_time

import numpy as np

from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import Cancelled, P2SFError
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.psf.methods import PsfOptions, method_of, render
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.spherical import spherical_pupil
from p2sf.pupil.watch import Watch
from p2sf.threads import using_threads
from tests.long.method_choice import draw

ASKED = 0.9, 0.99, 0.999
COMPARED = "seidel", "fitted", "traced", "huygens", "spherical"
ROUNDS, SLOW_SECONDS = 4, 0.4  # of readings, and from which on one does
SMALLEST = 3e-8  # 1 − R² by which settled sums of 1e-4 differ: no ratio of errors below tells anything
STEP = 1e-10  # by which sources differ


@dataclass(frozen=True)
class State:
    """What each method made of one state: by method and quality its CPU seconds, true and predicted 1 − R².

    ``auto``: by the R² asked for, what was taken, what it predicts, misses, and its seconds.
    """

    place: int
    lens: str
    seconds: dict[str, float]
    true: dict[str, float]
    predicted: dict[str, float | None]
    auto: dict[str, dict[str, float | str | None]]

    def cheapest(self, quality: str, allowed: float) -> float:
        """Return the seconds of the fastest method that misses no more than ``allowed``."""
        return min(self.seconds[key] for key, error in self.true.items() if key.endswith(quality) and error <= allowed)


def fresh(source: Source, number: int) -> Source:
    """Return a source that nothing has been remembered of, the same to ten digits."""
    factor = 1 + STEP * number
    if isinf(source.depth_mm):
        return replace(source, wavelength_um=source.wavelength_um * factor)
    return replace(source, depth_mm=source.depth_mm * factor)


def measured(place: int, seed: int, most_seconds: float) -> State | str:
    """Return what the methods made of one state, or why it is left out."""
    try:
        lens, source, side, pixel = draw(place, seed)
        end = process_time() + most_seconds
        pupil = spherical_pupil(lens, source)
        watch = Watch(cancelled=lambda: process_time() > end)
        reference = psf_of_pupil(pupil, (side, pixel), rtol=SETTLED_TOLERANCE, watch=watch).values
    except (P2SFError, Cancelled) as reason:
        return f"{type(reason).__name__}: {reason}"[:100]
    return _timed(place, lens, source, (side, pixel), reference)


def _timed(place: int, lens: Lens, source: Source, window: tuple[int, float], reference: np.ndarray) -> State:
    ways = [(name, quality) for name in COMPARED for quality in ("preview", "settled")]
    ways = [way for way in ways if way[1] == "settled" or method_of(way[0]).previewed]
    tries = [(*way, 0.99) for way in ways] + [("auto", q, r2) for r2 in ASKED for q in ("preview", "settled")]
    readings: dict[tuple[str, str, float], list[float]] = {}
    made = {}
    for number in range(ROUNDS):
        for count, one in enumerate(tries):
            if number and (one not in made or max(readings[one]) > SLOW_SECONDS):
                continue
            method, quality, least = one
            asked = fresh(source, 1 + number * len(tries) + count)
            before = process_time()
            try:
                made[one] = render(lens, asked, method, *window, PsfOptions(quality, least))
                repr(made[one].predicted_error)
            except P2SFError:
                continue
            readings.setdefault(one, []).append(process_time() - before)
    seconds = {one: float(np.median(some[1:] or some)) for one, some in readings.items()}
    true = {one: 1 - r_squared(psf.values, reference) for one, psf in made.items()}
    said = {one: psf.predicted_error for one, psf in made.items()}
    own = {one: f"{one[0]} {one[1]}" for one in made if one[0] != "auto"}
    auto = {
        f"{one[1]} {one[2]}": {
            "method": psf.method,
            "predicted": said[one],
            "true": true[one],
            "seconds": seconds[one],
        }
        for one, psf in made.items()
        if one[0] == "auto"
    }
    parts = ({name: some[one] for one, name in own.items()} for some in (seconds, true, said))
    return State(place, lens.name, *parts, auto)


def summary(states: list[State]) -> str:
    """Return the figures over all states in words."""
    lines = [f"{len(states)} states"]
    for least in ASKED:
        for quality in ("preview", "settled"):
            lines.append(_of_auto(states, quality, least))
    lines += [_of_prediction(states, method) for method in COMPARED[:4]]
    return "\n".join(lines)


def _of_auto(states: list[State], quality: str, least: float) -> str:
    allowed, key = 1 - least, f"{quality} {least}"
    regrets, shares, counts, silent, said, passed, enough, worst = [], [], {}, [], 0, 0, 0, (0.0, "")
    for state in states:
        if key not in state.auto:
            continue
        got = state.auto[key]
        method, missed = str(got["method"]), float(got["true"])
        counts[method] = counts.get(method, 0) + 1
        told = got["predicted"] is not None and got["predicted"] > allowed
        said += missed > allowed and told
        silent += [(state.place, state.lens, method, missed)] if missed > allowed and not told else []
        own = state.seconds.get(f"{method} {quality}")
        if own:
            shares.append(max(0.0, 1 - own / got["seconds"]))
        if state.true.get("seidel settled", 1.0) <= allowed:
            enough, passed = enough + 1, passed + (method != "seidel")
        if min(error for name, error in state.true.items() if name.endswith(quality)) <= allowed:
            regrets.append(got["seconds"] / state.cheapest(quality, allowed))
            worst = max(worst, (regrets[-1], f"{state.place} {state.lens} {method}"))
    used = ", ".join(f"{name} {count}" for name, count in sorted(counts.items()))
    parts = (
        f"R² ≥ {least} {quality}: {used}",
        f"{said} misses said, {len(silent)} not {silent or ''}",
        f"time over the cheapest {_spread(regrets)}, worst {worst[1]}",
        f"choosing {100 * np.median(shares):.0f} %",
        f"six coefficients passed over in {passed} of {enough}",
    )
    return "; ".join(parts)


def _of_prediction(states: list[State], method: str) -> str:
    key = f"{method} settled"
    pairs = [(s.predicted[key], s.true[key]) for s in states if s.predicted.get(key) is not None]
    ratios = [said / true for said, true in pairs if SMALLEST < true < 0.5]
    low = np.mean([ratio < 1 for ratio in ratios]) if ratios else 0.0
    return f"predicted/true of {method}: {_spread(ratios)} over {len(ratios)} states, below 1 in {100 * low:.0f} %"


def _spread(values: Iterable[float]) -> str:
    some = list(values)
    if not some:
        return "none"
    low, middle, high = np.quantile(some, (0.05, 0.5, 0.95))
    return f"{middle:.3g} (5 % {low:.3g}, 95 % {high:.3g}, least {min(some):.3g}, most {max(some):.3g})"


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most", type=float, default=3.0, help="seconds of a reference")
    parser.add_argument("--keep", type=Path, help="a file of states, to go on where it ends")
    given = parser.parse_args()
    kept = given.keep.read_text().splitlines() if given.keep and given.keep.exists() else []
    found: list[State | str] = [one if isinstance(one := json.loads(line), str) else State(**one) for line in kept]
    with using_threads(1):
        while sum(isinstance(one, State) for one in found) < given.points:
            found.append(measured(len(found), given.seed, given.most))
            if given.keep:
                last = found[-1]
                with given.keep.open("a") as file:
                    file.write(json.dumps(last if isinstance(last, str) else asdict(last)) + "\n")
    print(summary([one for one in found if isinstance(one, State)]))
    print(
        f"{sum(isinstance(one, str) for one in found)} left out: no image, or a reference of more than {given.most} s"
    )


if __name__ == "__main__":
    main()
