"""The `traced` method: exact rays in one pass (handbook 5.4).

Phase, direction and light of the rays are smooth over the pupil although the field is not: some hundreds of rays give
by interpolation as many plane waves as blur and window require. Held-out rays on the rim check this; if it fails, and
behind a mask, all rays are traced.
"""

from dataclasses import replace
from functools import partial
from math import prod
from time import perf_counter

from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.huygens import (
    RayPupil,
    Watch,
    blur_um2,
    first_counts,
    one_pass,
    sampling_of,
    sum_rays,
    waves_reaching,
)
from p2sf.psf.picture import psf_of_waves, resolved
from p2sf.psf.prediction import EDGE_ERROR, TRACED_ERROR
from p2sf.psf.result import Psf
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.smooth_pupil import all_reach, interpolated_waves
from p2sf.threads import one_blas_thread

MOST_NODES = 2**23  # radii × directions / 2: some seconds of work
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
    started, settled, watch = perf_counter(), quality == "settled", watch or Watch()
    pupil, window = RayPupil(lens, source, clip), (pixels, pixel_um)
    if clip or not all_reach(lens, source):
        return _until_two_agree(pupil, window, settled, watch)
    reach = window_reach_um(*window)
    counts = first_counts(lens, source, reach, clip, MOST_NODES)
    smooth = interpolated_waves(lens, source, counts, reach)
    if smooth is None and settled and prod(counts) / 2 > watch.most:
        return _until_two_agree(pupil, window, settled, watch)
    rays = smooth or one_pass(pupil, window, watch)
    light = partial(blur_um2, pupil) if resolved(rays.waves.spread, pixel_um) else None
    reaching = partial(waves_reaching, pupil)
    psf = psf_of_waves(rays.waves, window, source.wavelength_um, "traced", light, reaching, quality)
    precision = "float64" if settled else "float32"
    return replace(
        psf.with_figures(predicted_error=TRACED_ERROR),
        rays=rays.traced,
        sampling=Message("{nodes}, {precision}", nodes=sampling_of(pupil, rays, None), precision=precision),
        error=SETTLED_TOLERANCE if settled else None,
        seconds=perf_counter() - started,
    )


def _until_two_agree(pupil: RayPupil, window: tuple[int, float], settled: bool, watch: Watch) -> Psf:
    """Return the PSF of rays that are added until two pictures agree, or, of a preview, of one pass."""
    found = sum_rays(pupil, window, EDGE_TOLERANCE if settled else None, watch)
    reached = 0.0 if found.error is None else found.error
    return replace(found.with_figures(predicted_error=max(EDGE_ERROR, reached**2)), method="traced")
