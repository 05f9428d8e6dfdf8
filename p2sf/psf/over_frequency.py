"""The pupil over spatial frequencies as each method describes it, for contrast, energy and spreads (handbook 6.3).

``turn_deg`` everywhere: by how much its axes are turned from those of the source's image, from +y towards +x.
"""

from dataclasses import replace
from math import sqrt

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import Coefficients, check_seidel, coefficients
from p2sf.psf.prediction import SAFETY, seidel_error
from p2sf.psf.seidel import check_image
from p2sf.pupil.fit import fit
from p2sf.pupil.frequency_pupil import (
    FrequencyPupil,
    PupilAtRims,
    PupilEnd,
    pupil_of_coefficients,
    pupil_of_fit,
    pupil_of_rays,
    with_spot,
)
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.exit_sphere import exit_sphere


def six_over_frequency(lens: Lens, source: Source, clip: bool, turn_deg: float) -> FrequencyPupil:
    """Return the pupil of the lens's own six coefficients; GeometryError where there are none, or no image."""
    check_seidel(lens)
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    check_image(six)
    return pupil_of_six(lens, source, six, turn_deg, clip)


def fit_over_frequency(lens: Lens, source: Source, clip: bool, turn_deg: float) -> FrequencyPupil:
    """Return the pupil of a fit; GeometryError where rays do not reach the sensor."""
    found = pupil_of_fit(fit(lens, source), turn_deg, _end_of(lens, source, clip))
    return with_spot(found, lens, source, clip, turn_deg)


def _end_of(lens: Lens, source: Source, clip: bool) -> PupilEnd:
    """Return where a pupil that is described whole ends."""
    return PupilAtRims(lens, source, clip) if clip else PupilEnd(lens.pupil_domain)


def spheres_over_frequency(lens: Lens, source: Source, clip: bool, turn_deg: float) -> FrequencyPupil:
    """Return the pupil of exact rays that send spherical waves; GeometryError where they do not reach the sensor."""
    return pupil_of_rays(lens, source, clip, turn_deg, exit_sphere(lens, source))


def pupil_of_six(
    lens: Lens, source: Source, six: Coefficients, turn_deg: float = 0.0, clip: bool = False
) -> FrequencyPupil:
    """Return the pupil of six coefficients of a lens, with what they are predicted to miss of its exact rays."""
    missed = sqrt(seidel_error(lens, source, six) / SAFETY["seidel"]) / (2 * np.pi)
    pupil = pupil_of_coefficients(six, mask_seen(lens, source), turn_deg, _end_of(lens, source, clip))
    pupil = replace(pupil, residual_waves=missed)
    if lens.misaligned:  # the six are those of the aligned lens
        return pupil
    try:
        return with_spot(pupil, lens, source, clip, turn_deg)
    except GeometryError:  # no ray arrives, which the six cannot know
        return pupil
