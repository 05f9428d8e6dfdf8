"""The `traced` method: exact rays in one pass (handbook 5.4).

Phase, direction and light of the rays are smooth over the pupil though the field is not: some hundreds of rays give by
interpolation as many plane waves as blur and window need. Rays on the rim, left out of it, tell whether that holds;
where it does not, and behind a mask, all are traced.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from time import perf_counter

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.huygens import (
    blur_um2,
    first_counts,
    huygens_psf,
    one_pass,
    sampling_of,
    waves_reaching,
)
from p2sf.psf.picture import Origin, psf_of_waves, resolved
from p2sf.psf.prediction import EDGE_ERROR, TRACED_ERROR
from p2sf.psf.result import Psf
from p2sf.psf.smooth_pupil import all_reach, interpolated_waves
from p2sf.psf.sums.plane_waves import window_reach_um
from p2sf.pupil.quadrature import SETTLED_TOLERANCE
from p2sf.threads import one_blas_thread

MOST_NODES = 2**23  # radii × directions / 2: some seconds of work
EDGE_TOLERANCE = 3e-3  # relative L2 where the pupil ends at rims or at lost rays: R² to 1e-5


@one_blas_thread
def traced_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    quality: str = "settled",
    clip: bool = False,
    cancelled: Callable[[], bool] | None = None,
) -> Psf:
    """Return the PSF of exact rays, one pass: "settled" in float64, "preview" in float32.

    Where rays are lost or clipped, the pupil's outline is known less well than its inside, and rays are added until two
    passes agree to EDGE_TOLERANCE: ``cancelled`` is called between blocks of them (`Cancelled`). Raises GeometryError
    where the chief ray does not reach the sensor, SamplingError for a window no rays can carry.
    """
    started, settled = perf_counter(), quality == "settled"
    if clip or not all_reach(lens, source):
        tolerance = EDGE_TOLERANCE if settled else None
        found = huygens_psf(lens, source, pixels, pixel_um, tolerance, None, cancelled, clip)
        return replace(found, method="traced", predicted_error=EDGE_ERROR)
    window, reach = (pixels, pixel_um), window_reach_um(pixels, pixel_um)
    counts = first_counts(lens, source, reach, clip, MOST_NODES)
    rays = interpolated_waves(lens, source, counts, reach) or one_pass(lens, source, window, clip, cancelled)
    precision = "float64" if settled else "float32"
    made = Origin(
        "traced",
        0,
        rays.traced,
        Message("{nodes}, {precision}", nodes=sampling_of(lens, rays, clip, None), precision=precision),
        started,
        SETTLED_TOLERANCE if settled else None,
        TRACED_ERROR,
    )
    blur = blur_um2(lens, source) if resolved(rays.waves.spread, pixel_um) else None
    reaching = partial(waves_reaching, lens, source)
    return psf_of_waves(rays.waves, window, source.wavelength_um, blur, made, reaching, quality)
