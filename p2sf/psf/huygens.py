"""The `huygens` method, the reference: each traced ray is a plane wave at the sensor, and all are summed directly.

The count of rays rises until two successive PSFs agree. See handbook 5.5.
"""

from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.result import Psf
from p2sf.pupil.rays import RayPupil
from p2sf.pupil.watch import Watch


def huygens_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    rtol: float | None = SETTLED_TOLERANCE,
    clip: bool = False,
    watch: Watch | None = None,
) -> Psf:
    """Return the reference PSF, all rays of a source as plane waves; of one pass where ``rtol`` is None."""
    return psf_of_pupil(RayPupil(lens, source, clip), (pixels, pixel_um), rtol=rtol, watch=watch)
