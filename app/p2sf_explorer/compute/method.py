"""Which method makes the picture, and the picture itself. No Qt in here."""

from dataclasses import dataclass, replace
from math import floor, log10, sqrt
from typing import TYPE_CHECKING

from p2sf.errors import GeometryError
from p2sf.messages import Message, Number
from p2sf.metrics.perfect import airy_radius_um
from p2sf.paraxial.wavefront import steepest_slope
from p2sf.psf.result import Psf
from p2sf.psf.seidel import check_image, seidel_psf, suitable_pixel_um
from p2sf.psf.traced import in_rows
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.pencil import Pencil, pencil
from p2sf_explorer.compute.deferred_sums import SumCache, SumRequest, by_rays, row_nodes, slow, sum_request
from p2sf_explorer.compute.preview import (
    FAR,
    best_fit,
    clipped_psf,
    edge_points,
    landing_um,
    preview,
    preview_psf,
    preview_pupil,
)
from p2sf_explorer.compute.pupil import PupilMap
from p2sf_explorer.compute.ray_density import geometric_psf, main_reach_um
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State

if TYPE_CHECKING:
    from p2sf.psf.methods import Choice

PIXELS = {"preview": 64, "settled": 128}
WHOLE = 64  # samples over which the six coefficients give the window that shows all of the PSF
WINDOWS = (1, 1.5, 2, 3, 4, 5, 6, 8)
STEEPEST_IN_ALL = 210.0  # waves of slope and of the plane wave to the window's corner: samples carry both together
STEEPEST = 80.0  # waves of slope: beyond, a sample of the window is some four Airy radii wide
ALL_LIGHT = 0.995
NO_REASON = Message("")
FARTHEST = 160.0  # waves of slope of a ray: beyond, too, a sample is several Airy radii wide
QUICK_NODES = 60_000  # of a picture that moves: some 20 ms, and on a busy machine a few times that
ROOM = 5  # Airy radii around the rays, for what diffraction adds


@dataclass(frozen=True)
class Rendered:
    """A PSF, why this method made it, whether by exact rays or six coefficients, and which ``method`` was chosen.

    ``why`` is empty for a person's own choice. ``pupil`` is the wavefront where the picture's own rays give it too.
    ``pending`` is the sum of waves that this picture stands in for.
    """

    psf: Psf
    why: Message
    exact: bool
    method: str
    pupil: PupilMap | None = None
    pending: SumRequest | None = None


def rendered(
    state: State,
    setup: ParaxialSetup,
    quality: str,
    kept_method: str = "",
    at_least_um: float = 0.0,
    cache: SumCache | None = None,
) -> Rendered:
    """Return the PSF by the state's method, or by the one ``auto`` chooses, or by ``kept_method`` while moving.

    The window is as wide as the PSF asks for, and ``at_least_um``. What is altered by hand has no rays: the six
    coefficients make its picture. A sum too slow for a frame is taken from ``cache`` or left pending; without
    ``cache`` it is waited for. Raises GeometryError for an image at infinity.
    """
    check_image(setup.coefficients)
    if setup.altered:
        method = "seidel"
        why = Message("seidel from the six coefficients (what-if: coefficients altered by hand)")
    else:
        method, why = (kept_method, NO_REASON) if kept_method else chosen(state, setup)
    if quality == "preview" and method != "seidel":
        return moving(state, setup, method, at_least_um, cache)
    if too_blurred(setup, at_least_um):
        return blurred(state, setup, method, quality, at_least_um)
    if method != "seidel":
        return resting(state, setup, (method, why), at_least_um, cache)
    pitch = max(at_least_um, window_um(setup, method)) / PIXELS[quality]
    return Rendered(seidel_psf(setup.coefficients, PIXELS[quality], pitch, quality), why, False, method)


def resting(
    state: State, setup: ParaxialSetup, choice: tuple[str, Message], at_least_um: float, cache: SumCache | None
) -> Rendered:
    """Return the settled picture of a method that traces rays; its stand-in while it is pending, or where it failed."""
    (method, why), traced = choice, preview(setup) if cache else None
    landing = landing_um(traced.rays if traced else edge_pencil(setup))
    if slope(setup, landing) > FARTHEST:
        return blurred(state, setup, method, "settled", at_least_um)
    pixels = PIXELS["settled"]
    request = sum_request(state, setup, method, (pixels, max(at_least_um, ray_window_um(setup, landing)) / pixels))
    if cache is None or not slow(request, best_fit(traced) if traced else None):
        return Rendered(by_rays(request), why, True, method)
    result = cache.get(request)
    if isinstance(result, Psf):
        return Rendered(result, why, True, method)
    stand_in = moving(state, setup, method, at_least_um, cache, "settled")
    if result is not None:
        return replace(stand_in, why=result, pending=None)
    soon = Message("{method} follows: its sum of waves takes a moment", method=method)
    return replace(stand_in, why=soon, pending=request)


def moving(
    state: State,
    setup: ParaxialSetup,
    method: str,
    at_least_um: float = 0.0,
    cache: SumCache | None = None,
    quality: str = "preview",
) -> Rendered:
    """Return what is shown in place of a slower method: the density of rays where blur is large, else fitted.

    Where rays are lost and there is no ``cache``, traced is waited for. ``quality`` sets the number of samples.
    """
    pixels, traced = PIXELS[quality], preview(setup, state.optics.clip)
    pupil = preview_pupil(traced) if traced and quality == "preview" else None
    landing = landing_um(traced.rays if traced else edge_pencil(setup))
    window = pixels, max(at_least_um, ray_window_um(setup, landing)) / pixels
    fitted = best_fit(traced) if traced else None
    if too_blurred(setup, at_least_um) or (fitted and not quickly(setup, fitted, window)):
        return replace(blurred(state, setup, method, quality, at_least_um), pupil=pupil)
    why = NO_REASON
    if method != "fitted":
        why = Message("fitted while the slider moves, {method} when it rests", method=method)
    if traced:
        return Rendered(preview_psf(traced, *window, fitted), why, True, method, pupil)
    if cache is None:
        return Rendered(by_rays(sum_request(state, setup, "traced", window), "preview"), NO_REASON, True, method)
    return replace(rimmed(state, setup, method, window, quality), why=why)


def quickly(setup: ParaxialSetup, fitted: FittedPencil, window: tuple[int, float]) -> bool:
    """Return whether the sum of a fit, or of exact rays where it misses much, is done within a frame or two."""
    nodes = row_nodes(fitted, window, "preview")
    if fitted.error_waves > FAR:
        return nodes < QUICK_NODES / 3 and in_rows(setup.lens, setup.source)
    return nodes < QUICK_NODES


def rimmed(state: State, setup: ParaxialSetup, method: str, window: tuple[int, float], quality: str) -> Rendered:
    """Return the moving picture where rims clip: the fit to all rays, summed over those that pass, else ray density."""
    traced = preview(setup)
    try:
        few = traced is not None and quickly(setup, best_fit(traced), window)
        psf = clipped_psf(traced, *window) if traced and few else None
    except GeometryError:  # every ray is clipped, or the fit is no map: the density says which
        psf = None
    if psf is None:
        return blurred(state, setup, method, quality, window[0] * window[1])
    return Rendered(psf, NO_REASON, True, method)


def blurred(state: State, setup: ParaxialSetup, method: str, quality: str, at_least_um: float) -> Rendered:
    """Return the density of rays, in a window as wide as most of them reach."""
    exact, pixels = method != "seidel", PIXELS[quality]
    wide = min(window_um(setup, method), ray_window_um(setup, main_reach_um(setup, exact, state.optics.clip)))
    psf = geometric_psf(setup, exact, (pixels, max(at_least_um, wide) / pixels), quality, state.optics.clip)
    return Rendered(psf, density_reason(psf), exact, method)


def density_reason(psf: Psf) -> Message:
    """Return what a picture of ray density is, and how much of the light it holds."""
    percent = 100 * float(psf.energy or 0.0)
    if percent > 100 * ALL_LIGHT:
        return Message("geometric: ray density, no diffraction")
    return Message(
        "geometric: ray density, no diffraction; {percent:.0f} % of the pupil's light is in view", percent=percent
    )


def too_blurred(setup: ParaxialSetup, across_um: float = 0.0) -> bool:
    """Return whether a wave sum would take too long for a picture that shows only the density of rays anyway.

    Either the blur is large, or a window ``across_um`` wide, for another picture's sake, has coarse samples.
    """
    steep, corner = float(steepest_slope(setup.coefficients)), sqrt(2) * slope(setup, across_um / 2)
    return steep > STEEPEST or steep + corner > STEEPEST_IN_ALL


def slope(setup: ParaxialSetup, landing: float) -> float:
    """Return the slope of the wavefront, waves per pupil radius, of a ray that lands so far from the chief ray, µm."""
    return landing * float(setup.coefficients.na) / setup.source.wavelength_um


def window_um(setup: ParaxialSetup, method: str) -> float:
    """Return the width of the shown window, µm: a round number, so that axes stand still while sliders move."""
    if method == "seidel":
        return nice(float(suitable_pixel_um(setup.coefficients, WHOLE)) * WHOLE, WINDOWS)
    return ray_window_um(setup, landing_um(edge_pencil(setup)))


def ray_window_um(setup: ParaxialSetup, landing: float) -> float:
    """Return the width of a window that shows rays landing so far out, and what diffraction adds, µm."""
    airy = float(airy_radius_um(setup.source.wavelength_um, setup.coefficients.na))
    return nice(2 * (landing + ROOM * airy), WINDOWS)


def edge_pencil(setup: ParaxialSetup) -> Pencil:
    """Return the few rays at the rim that show how far light reaches."""
    return pencil(setup.lens, setup.source, *edge_points())


def chosen(state: State, setup: ParaxialSetup) -> tuple[str, Message]:
    """Return the method in use and why: a person's choice needs no reason."""
    if state.optics.method != "auto":
        return state.optics.method, NO_REASON
    from p2sf.psf.methods import choose

    choice = choose(setup.lens, setup.source, state.optics.tolerance, state.optics.clip)
    return choice.method, reason(choice, state.optics.tolerance)


def reason(choice: "Choice", tolerance: float) -> Message:
    """Return why ``auto`` took this method for a least R²."""
    r_squared = Number(at_least(1 - choice.predicted_error))
    if choice.method == "seidel":
        return Message("seidel: six coefficients are enough, predicted R² ≥ {r_squared}", r_squared=r_squared)
    if choice.method == "fitted":
        return Message(
            "fitted: {numbers} numbers from {rays} rays, predicted R² ≥ {r_squared}; the six Seidel coefficients "
            "would miss {tolerance:g}",
            numbers=choice.numbers,
            rays=choice.tried_rays,
            r_squared=r_squared,
            tolerance=tolerance,
        )
    if choice.lost_rays:
        return Message(
            "{method}: exact rays, predicted R² ≥ {r_squared}; {lost} of {count} rays are lost, and a smooth pupil "
            "does not describe that",
            method=choice.method,
            r_squared=r_squared,
            lost=choice.lost_rays,
            count=choice.tried_rays,
        )
    return Message(
        "{method}: exact rays, predicted R² ≥ {r_squared}; a smooth fit would miss {tolerance:g}",
        method=choice.method,
        r_squared=r_squared,
        tolerance=tolerance,
    )


def at_least(r_squared: float) -> str:
    """Return R² rounded down, with two digits of what it lacks to one, and four places at most."""
    places = min(4, 1 - floor(log10(max(1 - r_squared, 1e-9))))
    return f"{floor(r_squared * 10**places) / 10**places:.{places}f}".rstrip("0")
