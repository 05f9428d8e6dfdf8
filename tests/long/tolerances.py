"""Builds by quadratic forms against exact rays: ``python -m tests.long.tolerances [BUILDS]``.

10 000 builds of the Double Gauss, all surfaces, three fields, back focus compensated; 500 of them are traced exactly,
each focused anew. A build agrees where its Strehl ratio is within 0.01, or its RMS within 2 % where the Strehl ratio is
below 0.1. Exit code 1 where fewer than 95 % agree.
"""

import sys
from dataclasses import dataclass
from time import thread_time

import numpy as np

from p2sf.lens.lens import Lens, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import image_distance
from p2sf.tolerance.builds import Builds, simulate
from p2sf.tolerance.criteria import share_within
from p2sf.tolerance.differentials import Differentials, differentials
from p2sf.tolerance.errors_of_build import Grade, Tolerance, build, usual_tolerances
from tests.support.tolerances import exact_quality

STREHL, RMS_SHARE, DARK = 0.01, 0.02, 0.1
REFOCUS_MM = 0.01


@dataclass(frozen=True)
class Agreement:
    """The share of checked builds and fields that agree, seconds of preparation and of 10 000 builds."""

    agree: float
    preparation: float
    builds: float
    found: Builds


def gauss(f_number: float | None = None) -> Lens:
    """Return the Double Gauss, stopped down and refocused on infinity if asked."""
    lens = find_lens("double_gauss_28")
    if f_number is None:
        return lens
    opened = with_f_number(lens, f_number)
    return with_sensor(opened, float(image_distance(opened, np.inf, opened.reference_wavelength_um)))


def agreement(lens: Lens, grade: Grade, fields: tuple[float, ...], checked: int, builds: int = 10_000) -> Agreement:
    tolerances = (*usual_tolerances(lens, grade), Tolerance("thickness", len(lens.surfaces), 0.2))
    last = len(tolerances) - 1
    begun = thread_time()
    known = differentials(lens, [Source(field_deg=field) for field in fields], tolerances)
    prepared = thread_time()
    found = simulate(known, builds, (last,))
    done = thread_time()
    shares = [_agrees(known, found, number, last) for number in range(checked)]
    return Agreement(float(np.mean(shares)), prepared - begun, done - prepared, found)


def _agrees(known: Differentials, found: Builds, number: int, focus: int) -> np.ndarray:
    errors = found.errors[number]

    def exact(shift: float) -> tuple[np.ndarray, np.ndarray]:
        moved = errors.copy()
        moved[focus] += shift
        return exact_quality(build(known.lens, known.tolerances, moved), known.sources)

    # The best focus of exact rays, by a parabola through three.
    low, middle, high = ((exact(shift)[0] ** 2).sum() for shift in (-REFOCUS_MM, 0.0, REFOCUS_MM))
    rms, strehl = exact(REFOCUS_MM * (low - high) / (2 * (low - 2 * middle + high)))
    near = np.abs(strehl - found.strehl[number]) <= STREHL
    dark = np.abs(rms / found.rms_waves[number] - 1) <= RMS_SHARE
    return np.where(strehl < DARK, dark, near)


def main() -> int:
    checked = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    worst = 1.0
    for f_number, grade in ((None, "precision"), (8.0, "commercial"), (8.0, "high")):
        one = agreement(gauss(f_number), grade, (0.0, 7.0, 10.0), checked)
        worst = min(worst, one.agree)
        share, error = share_within(one.found, {"strehl": 0.4})
        print(
            f"f/{f_number or 3:g}, {grade}: {one.agree:.1%} of {checked} builds agree; {one.preparation:.2f} s of "
            f"preparation, {one.builds:.2f} s for 10 000 builds; Strehl ≥ 0.4 in {share:.1%} ± {error:.1%}",
            flush=True,
        )
    return int(worst < 0.95)


if __name__ == "__main__":
    sys.exit(main())
