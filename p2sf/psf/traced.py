"""The `traced` method: exact rays in one pass (handbook 5.4).

Phase, direction and light of the rays are smooth over the pupil although the field is not: some hundreds of rays give
by interpolation as many plane waves as blur and window require. Held-out rays on the rim check this; if it fails, and
behind a mask, all rays are traced.
"""

from math import prod

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.psf.picture import Window, psf_of_pupil
from p2sf.psf.result import Psf
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.pupil import Pupil
from p2sf.pupil.rays import MOST_INTERPOLATED, RayPupil
from p2sf.pupil.watch import MOST_RAYS, Watch
from p2sf.threads import one_blas_thread

EDGE_TOLERANCE = 3e-3  # relative L2 for a pupil bounded by rims or lost rays: R² to 1e-5


@one_blas_thread
def traced_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    quality: str = "settled",
    clip: bool = False,
    watch: Watch | None = None,
) -> Psf:
    """Return the PSF of exact rays, one pass: "settled" in float64, "preview" in float32.

    If rays are lost or clipped, the outline of the pupil is less accurate than its inside, and rays are added until two
    passes agree to EDGE_TOLERANCE, or their cost ends that: ``watch`` is asked between blocks of them (`Cancelled`).
    Raises GeometryError if the chief ray does not reach the sensor, SamplingError for a window that needs too many
    rays.
    """
    pupil, watch = traced_pupil(lens, source, clip), watch or Watch()
    window = pixels, pixel_um
    rtol = rtol_of_rays(pupil, window, watch) if quality == "settled" else None
    return psf_of_pupil(pupil, window, quality, rtol, watch)


def traced_pupil(lens: Lens, source: Source, clip: bool = False) -> RayPupil:
    """Return the rays of a source, interpolated where they are smooth."""
    return RayPupil(lens, source, clip, method="traced", interpolated=True, most=MOST_INTERPOLATED)


def rtol_of_rays(pupil: Pupil, window: Window, watch: Watch) -> float | None:
    """Return the agreement that two settled sums of a pupil need; None where one is enough.

    It is where its nodes are known to suffice: not along an outline, nor where too many rays would have to be traced.
    """
    if not pupil.interpolated:
        return None
    if pupil.edges:
        return EDGE_TOLERANCE
    if watch.most >= MOST_RAYS:  # more are refused
        return None
    reach = window_reach_um(*window)
    return None if prod(pupil.counts(reach)) // 2 <= watch.most or pupil.smooth(reach) else EDGE_TOLERANCE
