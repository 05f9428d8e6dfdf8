"""MTF, energy and pictures at the extremes, both ways to fill the pupil: ``python -m tests.long.measures_extremes``.

Every case of the extremes' sweep over aperture, depth, field and curvature of the sensor, and those with a flat sensor
also on a curved one: measures that keep every law, or a sentence; pictures by a fit and by spherical waves without NaN
and of unit sum, or a sentence. Prints how many of each there are per regime, and what broke a law.
"""

import argparse
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from math import isfinite

import numpy as np

from p2sf.errors import P2SFError, SamplingError
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import cardinal_points
from p2sf.psf.methods import PsfOptions, render, whole_pixel_um
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.rays import RayPupil
from tests.extremes.regimes import Case, curved_sensor_cases
from tests.extremes.test_measures_extremes import AIMS, NAMED, SWEPT, outcome_of

PIXELS = 16
MOST_RAYS = 2**19  # of a sum here: some seconds
LONG = "too long for this job"
BENT = -0.7  # radius of the sensor over the focal length, as a field that is curved inwards


def picture(case: Case, aim: str, method: str) -> str:
    """Return whether a case has a picture; AssertionError where that has a NaN, or light that is negative or lost."""
    lens, source = with_aim(case.lens, aim), Source(case.depth, case.slope, case.wavelength)
    try:
        pixel_um = whole_pixel_um(lens, source, PIXELS)
        if method == "spherical":
            try:
                RayPupil(lens, source, most=MOST_RAYS).counts(window_reach_um(PIXELS, pixel_um))
            except SamplingError:
                return LONG
        psf = render(lens, source, method, PIXELS, pixel_um, PsfOptions("preview"))
    except P2SFError as reason:
        assert len(str(reason)) > 20
        return NAMED
    assert np.isfinite(psf.values).all() and (psf.values >= 0).all() and abs(psf.values.sum() - 1) < 1e-5
    number, error = psf.fresnel_number, psf.plane_wave_error
    assert number is None or number > 0
    assert error is None or -1e-9 <= error <= 4  # 1 − R², 2 at most of pictures of one sign but for their means
    return "picture"


def cases() -> Iterator[Case]:
    """Yield the sweep, then on curved sensors, then curved sensors of every radius."""
    yield from SWEPT
    for case in SWEPT:
        focal = float(cardinal_points(case.lens, case.wavelength).effective_focal_length)
        if isfinite(focal):
            bent = replace(case.lens, sensor_radius=BENT * abs(focal))
            yield replace(case, lens=bent, regime=f"{case.regime}, curved sensor")
    yield from curved_sensor_cases()


def main() -> None:
    """Try every case and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=1, help="take every so manieth case")
    every = parser.parse_args().every
    trials: dict[str, Callable[[Case, str], str]] = {"measures": outcome_of}
    trials |= {method: partial(picture, method=method) for method in ("fitted", "spherical")}
    seen: Counter = Counter()
    for case in list(cases())[::every]:
        for aim in AIMS:
            for what, trial in trials.items():
                try:
                    found = trial(case, aim)
                except (AssertionError, ValueError, ArithmeticError) as fault:
                    found = "BROKEN"
                    print(f"{case} {aim} {what}: {type(fault).__name__} {fault}"[:300], flush=True)
                seen[case.regime, aim, what, found] += 1
    for key, count in sorted(seen.items()):
        print(*key, count, sep=" | ")
    raise SystemExit(any(found == "BROKEN" for *_, found in seen))


if __name__ == "__main__":
    main()
