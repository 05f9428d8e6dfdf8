"""The pupil mask in the pupil coordinates of a source."""

from dataclasses import replace

import numpy as np

from p2sf.disc.mask import EDGE_HARMONICS, PupilMask, mask_slopes
from p2sf.disc.mask_nodes import throughput
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import pupils
from p2sf.raytrace.ray_field import Steepness

DARKEST = 1e-12  # of the light of the clear disc: less vanishes in single precision


def mask_seen(lens: Lens, source: Source) -> PupilMask:
    """Return the mask in the pupil coordinates of a source: rotated by its azimuth, and by 180° for an inverted pupil.

    A source outside the plane ξ = 0 is described as one in that plane (`Source.azimuth_deg`), from which the fixed mask
    appears rotated the other way. Raises GeometryError for a filter that transmits almost no light.
    """
    if lens.mask.shaded and not throughput(lens.mask).light > DARKEST:
        raise GeometryError("the filter in the stop lets no light through; make its apodisation wider")
    if lens.mask.round:
        return lens.mask
    inverted = float(np.asarray(pupils(lens, source.wavelength_um).upright)) < 0
    return lens.mask.turned(180.0 * inverted - source.azimuth_deg)


def with_slopes(steep: Steepness, mask: PupilMask, wavelength_um: float) -> Steepness:
    """Return the steepness of the phase including that of the mask; changes of the amplitude count too."""
    if not (mask.phased or mask.shaded):
        return steep
    slopes = mask_slopes(mask)
    radial = slopes.path_radial_um / wavelength_um + EDGE_HARMONICS * slopes.amplitude
    angular = slopes.path_angular_um / wavelength_um + EDGE_HARMONICS * slopes.amplitude * (not mask.round)
    both = float(np.hypot(radial, angular))
    return replace(
        steep,
        radial=steep.radial + radial,
        angular=steep.angular + angular,
        across=steep.across + both,
        along=steep.along + both,
    )
