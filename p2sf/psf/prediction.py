"""Prediction of the error of a method without a reference (handbook 5.6).

If two descriptions of the same ray differ by a phase e(ray), the fields differ by 2πe and 1 − R² is of the order
(2πσ)², σ the RMS of e over the pupil. For a ray that lands at x,

    e = Δw + Δf·x,

Δw the difference of phase and Δf of spatial frequency: for `seidel` against the traced rays themselves (higher orders
and the departure of the pupil map), for `fitted` on rays that were held out of the fit. Diffraction spreads a ray's
light about x, by the Airy radius or by blur/√(Fresnel number), and Δf acts there too. The largest ratio of 1 − R² to
(2πσ)² is measured over random lenses and sources by ``python -m tests.long.method_choice``; SAFETY covers it.
"""

from math import inf

import numpy as np

from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients, reason_against_coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.fit import RESIDUAL_WAVES, CheckRays, trace_check_rays
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import PROBE, coarse_pencil, coarse_points, coarse_weights
from p2sf.raytrace.pencil import Rays
from p2sf.raytrace.ray_field import steepness

# Measured: at most 2.9 (seidel) and 2.4 (fitted) in windows that show the whole PSF, and of those that show its core
# times their flatness (`flatness_of`), by which errors count more there: 1.7 and 1.2 over 106 and 93 random states.
SAFETY = {"seidel": 3.0, "fitted": 8.0}
TRACED_ERROR = 5e-5  # 1 − R², largest over the stored rows 6e-7, over 300 random points 3e-5
EDGE_ERROR = 1e-4  # over a pupil bounded by rims or lost rays (`traced.EDGE_TOLERANCE`)
ALLOWED = 0.01  # 1 − R² that may be missed where nothing else is asked for
CAUTION = 1e-3  # 1 − R² of plane waves above which R² refers to spherical ones
VECTOR_NA = 0.383  # sine of the steepest ray above which scalar light leaves CAUTION (`studies.vector_light`)

USELESS = 1.0  # 1 − R² above which an estimate for small phases only shows that the PSFs differ
TOO_FAR = Message("none: too far from exact rays to predict how far")


def predicted_error(sigma_waves: float, method: str) -> float:
    """Return an upper bound of 1 − R² for an RMS phase error in waves."""
    return SAFETY[method] * (2 * np.pi * sigma_waves) ** 2


def seidel_sigma(
    c: Coefficients, rays: Rays, points: tuple[np.ndarray, np.ndarray, np.ndarray], spread: float
) -> float:
    """Return the RMS phase error of the six coefficients in waves, over the rays at ``points``.

    ``points``: ξ, η and area weights, of all rays or the first of them. ``spread``: how far diffraction spreads
    light, µm.
    """
    xi, eta, weight = points
    # The field of the six coefficients is the conjugate of that of the rays: phase −W, frequency n'u'ξ/λ.
    scale = float(c.reduced_slope) / float(c.wavelength_um)
    miss_x, miss_y = rays.fx - scale * xi, rays.fy - scale * eta
    error = rays.phase + wavefront(c, xi, eta) + miss_x * rays.x_um + miss_y * rays.y_um
    own = slice(0, weight.size)
    variance = weight @ (error[own] - weight @ error[own]) ** 2
    departure = weight @ (miss_x[own] ** 2 + miss_y[own] ** 2)
    # The six coefficients describe a uniform pupil; an amplitude error acts as a phase of 1/2π of it.
    amplitude = rays.amplitude[own] / (weight @ rays.amplitude[own] / weight.sum())
    uneven = weight @ (amplitude - 1) ** 2 / (2 * np.pi) ** 2
    return float(np.sqrt(variance + departure * spread**2 + uneven))


def residual_for(min_r2: float) -> float:
    """Return the RMS phase error in waves that keeps R² of a fit above ``min_r2``; at most RESIDUAL_WAVES."""
    return min(RESIDUAL_WAVES, float(np.sqrt(max(1 - min_r2, 0) / SAFETY["fitted"]) / (2 * np.pi)))


def seidel_error(lens: Lens, source: Source, c: Coefficients) -> float:
    """Return the predicted 1 − R² of six coefficients ``c``; infinite if they do not apply.

    They do not if rays are lost, or for a lens refused by `reason_against_coefficients`.
    """
    if reason_against_coefficients(lens):
        return inf
    try:
        rays = coarse_pencil(lens, source, PROBE)
    except GeometryError:  # not even the chief ray arrives
        return inf
    if not rays.passed.all():
        return inf
    mask = mask_seen(lens, source)
    checks = None if mask.clear else trace_check_rays(lens, source, mask)
    return error_of_six(lens, c, rays, checks, mask)


def error_of_six(lens: Lens, c: Coefficients, data: Rays, checks: CheckRays | None, mask: PupilMask) -> float:
    """Return the predicted 1 − R² of six coefficients from a coarse pencil, behind a mask from rays that pass it."""
    points = *coarse_points(lens.pupil_domain), coarse_weights(lens.pupil_domain)
    # A narrow ring spreads its light more by this factor.
    spread = steepness(data, *points[:2]).light_um / (1 - mask.obscuration)
    if checks is not None:
        points, data = (checks.xi, checks.eta, checks.share), checks.data
    return predicted_error(seidel_sigma(c, data, points, spread), "seidel")
