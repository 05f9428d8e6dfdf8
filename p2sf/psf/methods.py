"""The methods, what each will cost in error, and the cheapest that is good enough.

The prediction needs no reference. Where two descriptions of the same ray differ by a phase e(ray), the fields differ by
2πe and 1 − R² is of the order (2πσ)², σ the RMS of e over the pupil. For a ray that lands at x,

    e = Δw + Δf·x,

Δw the difference of phase and Δf of spatial frequency: for `seidel` against the traced rays themselves (higher
orders and the departure of the pupil map), for `fitted` on rays the fit has not seen. Diffraction spreads a
ray's light about x, by the Airy radius or by blur/√(Fresnel number), and Δf counts there too. How far 1 − R² can exceed
(2πσ)² is measured over random lenses and sources by ``python -m tests.long.method_choice``; SAFETY covers that.
"""

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from p2sf.errors import GeometryError, RequestError, SamplingError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.fitted import psf_of_fit
from p2sf.psf.gaussian_fit import gaussian_psf
from p2sf.psf.huygens import Filling, huygens_psf
from p2sf.psf.result import Psf
from p2sf.psf.seidel import seidel_psf, suitable_pixel_um
from p2sf.psf.traced import traced_psf
from p2sf.pupil.quadrature import SETTLED_TOLERANCE
from p2sf.raytrace.fit import LEVELS, RESIDUAL_WAVES, fit, fit_rays, level_rays
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.ray_field import RayData, ray_data, steepness

METHODS = ("gaussian", "seidel", "fitted", "traced", "huygens")
QUICK_LEVELS = LEVELS[:2]  # made from the same 64 rays
# Measured at most 2.9 (seidel) and 2.4 (fitted) in windows that show the whole PSF, and 8 where one shows but its core.
SAFETY = {"seidel": 5.0, "fitted": 8.0}
TRACED_ERROR = 5e-5  # 1 − R², largest over the stored rows 6e-7, over 300 random points 3e-5
EDGE_ERROR = 1e-4  # over a pupil that ends at rims or where rays are lost (`traced.FALLBACK_TOLERANCE`)


@dataclass(frozen=True)
class Choice:
    """The method to use, its predicted 1 − R², how many numbers it needs (0: rays), and a sentence why."""

    method: str
    predicted_error: float
    numbers: int
    why: str


def predicted_error(sigma_waves: float, method: str) -> float:
    """Return an upper bound of 1 − R² for an RMS phase error in waves."""
    return SAFETY[method] * (2 * np.pi * sigma_waves) ** 2


def residual_for(tolerance: float) -> float:
    """Return the RMS phase error in waves that keeps R² of a fit above ``tolerance``; at most the default's."""
    return min(RESIDUAL_WAVES, float(np.sqrt(max(1 - tolerance, 0) / SAFETY["fitted"]) / (2 * np.pi)))


def choose(lens: Lens, source: Source, tolerance: float = 0.99, clip: bool = False) -> Choice:
    """Return the cheapest method whose predicted R² is at least ``tolerance``, without running the reference.

    For the window that shows the whole PSF; one that shows only its core may do worse. Raises GeometryError where the
    chief ray does not reach the sensor, RequestError for a tolerance that is not below 1.
    """
    if not tolerance < 1:
        raise RequestError(f"a tolerance of {tolerance:g}; give the R² to hold, below 1")
    allowed = 1 - tolerance
    xi, eta, weight = level_rays(QUICK_LEVELS[0])
    rays = pencil(lens, source, xi, eta, clip=clip)
    if not rays.passed.all():
        return _for_lost_rays(int((~rays.passed).sum()), xi.size, allowed)
    data = ray_data(rays)
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    steep = steepness(data, xi, eta)
    errors = {"seidel": predicted_error(seidel_sigma(c, data, (xi, eta, weight), steep.light_um), "seidel")}
    if errors["seidel"] <= allowed:
        return Choice("seidel", errors["seidel"], 6, _sentence("six coefficients", errors["seidel"], allowed))
    for level in QUICK_LEVELS:
        found = fit_rays(data, level, level.rays, steep)
        error = predicted_error(found.error_waves, "fitted")
        if error <= allowed:
            why = _sentence(f"{level.numbers} numbers from {level.rays} rays", error, allowed)
            return Choice("fitted", error, level.numbers, f"{why}; six coefficients: {errors['seidel']:.1e}")
        errors["fitted"] = error
    because = f"{QUICK_LEVELS[-1].numbers} fitted numbers leave 1 − R² ≤ {errors['fitted']:.1e} only"
    return _by_rays(allowed, TRACED_ERROR, because)


def _for_lost_rays(lost: int, count: int, allowed: float) -> Choice:
    """Return the method that knows an edge: neither six coefficients nor a fit do."""
    return _by_rays(allowed, EDGE_ERROR, f"{lost} of {count} rays are lost, and a smooth pupil does not describe that")


def _by_rays(allowed: float, error: float, because: str) -> Choice:
    if error <= allowed:
        return Choice("traced", error, 0, f"exact rays, since {because}")
    return Choice("huygens", SETTLED_TOLERANCE**2, 0, f"the reference itself, since {because}")


def _sentence(what: str, error: float, allowed: float) -> str:
    return f"{what} keep 1 − R² ≤ {error:.1e}, where {allowed:.1e} is allowed"


def seidel_sigma(c: Coefficients, rays: RayData, points, spread: float) -> float:
    """Return the RMS phase error of the six coefficients in waves, over the rays at `rayfit.level_rays` points."""
    xi, eta, weight = points
    # The six coefficients' field is the conjugate of the rays' (DESIGN.md section 3): phase −W, frequency n'u'ξ/λ.
    scale = float(c.reduced_slope) / float(c.wavelength_um)
    miss_x, miss_y = rays.fx - scale * xi, rays.fy - scale * eta
    error = rays.phase + wavefront(c, xi, eta) + miss_x * rays.x_um + miss_y * rays.y_um
    own = slice(0, weight.size)
    variance = weight @ (error[own] - weight @ error[own]) ** 2
    departure = weight @ (miss_x[own] ** 2 + miss_y[own] ** 2)
    return float(np.sqrt(variance + departure * spread**2))


def render(
    lens: Lens,
    source: Source,
    method: str = "auto",
    pixels: int = 64,
    pixel_um: float | None = None,
    quality: str = "settled",
    tolerance: float = 0.99,
    clip: bool = False,
) -> Psf:
    """Return the PSF of one source by one method, or by the cheapest one that holds R² ≥ ``tolerance`` ("auto").

    Without ``pixel_um`` the pitch at which the six coefficients show the whole PSF. A fit takes as many numbers as
    ``tolerance`` asks for, 26 at least. ``clip`` applies the clear semi-diameters; methods that describe the whole
    pupil refuse it where a rim does clip. Raises P2SFError's kinds: an unknown method, no image, no rays.
    """
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    if pixel_um is None:
        pixel_um = float(suitable_pixel_um(c, pixels))
    numbers = None
    if method == "auto":
        choice = choose(lens, source, tolerance, clip)
        method, numbers = choice.method, choice.numbers
    if clip and method in ("seidel", "fitted"):
        _check_unclipped(lens, source, method)
    if method == "seidel":
        return seidel_psf(c, pixels, pixel_um, quality)
    if method == "fitted":
        started = perf_counter()
        found = fit(lens, source, numbers, residual_waves=residual_for(tolerance))
        return psf_of_fit(found, source.wavelength_um, (pixels, pixel_um), quality, started)
    return _by_tracing(lens, source, method, (pixels, pixel_um), quality, Filling(clip=clip))


def _by_tracing(lens, source, method, window, quality, filling: Filling) -> Psf:
    if quality not in ("settled", "preview"):
        raise SamplingError(f'quality "{quality}" is unknown; choose "settled" or "preview"')
    if method == "traced":
        return traced_psf(lens, source, *window, quality, filling)
    tolerance = SETTLED_TOLERANCE if quality == "settled" else None
    if method == "huygens":
        return huygens_psf(lens, source, *window, tolerance, filling=filling)
    if method == "gaussian":
        return gaussian_psf(huygens_psf(lens, source, *window, tolerance, filling=filling))
    raise RequestError(f'method "{method}" is unknown; choose auto, {", ".join(METHODS)}')


def _check_unclipped(lens, source, method) -> None:
    xi, eta, _ = level_rays(QUICK_LEVELS[0])
    lost = int((~pencil(lens, source, xi, eta, clip=True).passed).sum())
    if lost:
        raise GeometryError(
            f"rims clip {lost} of {xi.size} rays, and {method} describes the whole pupil; choose traced or huygens, or "
            "leave clip off"
        )
