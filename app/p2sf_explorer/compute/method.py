"""Which rung of the ladder makes the picture, and the picture itself. No Qt in here."""

from dataclasses import dataclass, replace
from math import floor, log10, sqrt

from p2sf.errors import GeometryError
from p2sf.paraxial.wavefront import steepest_slope
from p2sf.psf.metrics import airy_radius_um
from p2sf.psf.result import Psf
from p2sf.psf.seidel import check_image, seidel_psf, suitable_pixel_um
from p2sf.psf.traced import in_rows
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.compute.deferred_sums import Asked, Done, asked, by_rays, row_nodes, slow
from p2sf_explorer.compute.preview import (
    FAR,
    best_fit,
    clipped_psf,
    edge_points,
    landing_um,
    quick,
    quick_psf,
    quick_pupil,
)
from p2sf_explorer.compute.pupil import PupilMap
from p2sf_explorer.compute.ray_density import geometric_psf, main_reach_um
from p2sf_explorer.compute.setup import Setting
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State
from p2sf_explorer.state.what_if import NOTE

PIXELS = {"preview": 64, "settled": 128}
WHOLE = 64  # samples over which the six coefficients are asked for a window that shows all of the PSF
WINDOWS = (1, 1.5, 2, 3, 4, 5, 6, 8)
STEEPEST_IN_ALL = 210.0  # waves of slope and of the plane wave to the window's corner: samples carry both together
STEEPEST = 80.0  # waves of slope: beyond, a sample of the window is some four Airy radii wide
BLURRED = "geometric: ray density, no diffraction"
PARTLY = BLURRED + "; {:.0f} % of the pupil's light is in view"
ALL_LIGHT = 0.995
MOVING = "fitted while the slider moves, {0} when it rests"
SOON = "{0} follows: its sum of waves takes a moment"
FARTHEST = 160.0  # waves of slope of a ray: beyond, too, a sample is several Airy radii wide
QUICK_NODES = 60_000  # of a picture that moves: some 20 ms, and on a busy machine a few times that
ROOM = 5  # Airy radii around what rays say, for what diffraction adds


@dataclass(frozen=True)
class Made:
    """A PSF, why this rung made it, whether exact rays describe it or six coefficients, and which ``rung`` was chosen.

    ``pupil`` is the wavefront where the picture's own rays gave it at once. ``owed`` is the sum of waves that this
    picture stands in for.
    """

    psf: Psf
    why: str
    exact: bool
    rung: str
    pupil: PupilMap | None = None
    owed: Asked | None = None


def rendered(
    state: State, set_up: Setting, quality: str, held: str = "", at_least_um: float = 0.0, done: Done | None = None
) -> Made:
    """Return the PSF by the state's method, or by the rung ``auto`` chooses, or by the one ``held`` while moving.

    The window is as wide as the PSF asks for, and ``at_least_um``. What is altered by hand has no rays: the six
    coefficients make its picture. A sum too slow for a frame is taken from ``done``, or owed; without ``done`` it is
    waited for. Raises GeometryError for an image at infinity.
    """
    check_image(set_up.coefficients)
    if set_up.altered:
        method, why = "seidel", f"seidel from the six coefficients ({NOTE})"
    else:
        method, why = (held, "") if held else chosen(state, set_up)
    if quality == "preview" and method != "seidel":
        return moving(state, set_up, method, at_least_um, done)
    if too_blurred(set_up, at_least_um):
        return blurred(state, set_up, method, quality, at_least_um)
    if method != "seidel":
        return resting(state, set_up, (method, why), at_least_um, done)
    pitch = max(at_least_um, window_um(set_up, method)) / PIXELS[quality]
    return Made(seidel_psf(set_up.coefficients, PIXELS[quality], pitch, quality), why, False, method)


def resting(state: State, set_up: Setting, choice: tuple[str, str], at_least_um: float, done: Done | None) -> Made:
    """Return the settled picture of a rung that traces rays; what stands in for it while it is owed, or failed."""
    (method, why), made = choice, quick(set_up) if done else None
    landing = landing_um(made.rays if made else edge_pencil(set_up))
    if slope(set_up, landing) > FARTHEST:
        return blurred(state, set_up, method, "settled", at_least_um)
    pixels = PIXELS["settled"]
    wanted = asked(state, set_up, method, (pixels, max(at_least_um, ray_window_um(set_up, landing)) / pixels))
    if done is None or not slow(wanted, best_fit(made) if made else None):
        return Made(by_rays(wanted), why, True, method)
    found = done.get(wanted)
    if isinstance(found, Psf):
        return Made(found, why, True, method)
    stand_in = moving(state, set_up, method, at_least_um, done, "settled")
    return replace(stand_in, why=found or SOON.format(method), owed=None if found else wanted)


def moving(
    state: State,
    set_up: Setting,
    method: str,
    at_least_um: float = 0.0,
    done: Done | None = None,
    quality: str = "preview",
) -> Made:
    """Return what is shown in place of a slower rung: the density of rays where blur is large, else fitted.

    Where rays are lost traced is waited for, without ``done``. ``quality`` tells how many samples the picture has.
    """
    pixels, made = PIXELS[quality], quick(set_up, state.clip)
    pupil = quick_pupil(made) if made and quality == "preview" else None
    landing = landing_um(made.rays if made else edge_pencil(set_up))
    window = pixels, max(at_least_um, ray_window_um(set_up, landing)) / pixels
    found = best_fit(made) if made else None
    if too_blurred(set_up, at_least_um) or (found and not quickly(set_up, found, window)):
        return replace(blurred(state, set_up, method, quality, at_least_um), pupil=pupil)
    why = MOVING.format(method) if method != "fitted" else ""
    if made:
        return Made(quick_psf(made, *window, found), why, True, method, pupil)
    if done is None:
        return Made(by_rays(asked(state, set_up, "traced", window), "preview"), "", True, method)
    return replace(rimmed(state, set_up, method, window, quality), why=why)


def quickly(set_up: Setting, found: FittedPencil, window: tuple[int, float]) -> bool:
    """Return whether the sum of a fit, or of exact rays where it misses much, is done within a frame or two."""
    nodes = row_nodes(found, window, "preview")
    if found.error_waves > FAR:
        return nodes < QUICK_NODES / 3 and in_rows(set_up.lens, set_up.source)
    return nodes < QUICK_NODES


def rimmed(state: State, set_up: Setting, method: str, window: tuple[int, float], quality: str) -> Made:
    """Return what moves where rims clip: the fit to all rays, summed over those that pass, else their density."""
    made = quick(set_up)
    try:
        few = made is not None and quickly(set_up, best_fit(made), window)
        found = clipped_psf(made, *window) if few else None
    except GeometryError:  # every ray is clipped, or the fit is no map: the density says which
        found = None
    if found is None:
        return blurred(state, set_up, method, quality, window[0] * window[1])
    return Made(found, "", True, method)


def blurred(state: State, set_up: Setting, method: str, quality: str, at_least_um: float) -> Made:
    """Return the density of rays, in a window as wide as most of them reach."""
    exact, pixels = method != "seidel", PIXELS[quality]
    wide = min(window_um(set_up, method), ray_window_um(set_up, main_reach_um(set_up, exact, state.clip)))
    psf = geometric_psf(set_up, exact, (pixels, max(at_least_um, wide) / pixels), quality, state.clip)
    return Made(psf, BLURRED if psf.energy > ALL_LIGHT else PARTLY.format(100 * psf.energy), exact, method)


def too_blurred(set_up: Setting, across_um: float = 0.0) -> bool:
    """Return whether a wave sum would take too long for a picture that shows only the density of rays anyway.

    Either the blur is large, or a window ``across_um`` wide, for another picture's sake, has coarse samples.
    """
    steep, corner = float(steepest_slope(set_up.coefficients)), sqrt(2) * slope(set_up, across_um / 2)
    return steep > STEEPEST or steep + corner > STEEPEST_IN_ALL


def slope(set_up: Setting, landing: float) -> float:
    """Return the slope of the wavefront, waves per pupil radius, of a ray that lands so far from the chief ray, µm."""
    return landing * float(set_up.coefficients.na) / set_up.source.wavelength_um


def window_um(set_up: Setting, method: str) -> float:
    """Return the width of the shown window, µm: a round number, so that axes stand still while sliders move."""
    if method == "seidel":
        return nice(float(suitable_pixel_um(set_up.coefficients, WHOLE)) * WHOLE, WINDOWS)
    return ray_window_um(set_up, landing_um(edge_pencil(set_up)))


def ray_window_um(set_up: Setting, landing: float) -> float:
    """Return the width of a window that shows rays landing so far out, and what diffraction adds, µm."""
    airy = float(airy_radius_um(set_up.source.wavelength_um, set_up.coefficients.na))
    return nice(2 * (landing + ROOM * airy), WINDOWS)


def edge_pencil(set_up: Setting):
    """Return the few rays that tell how far light reaches."""
    return pencil(set_up.lens, set_up.source, *edge_points())


def chosen(state: State, set_up: Setting) -> tuple[str, str]:
    """Return the rung in use and why: a person's choice needs no reason."""
    if state.method != "auto":
        return state.method, ""
    from p2sf.psf.methods import choose

    choice = choose(set_up.lens, set_up.source, state.tolerance, state.clip)
    return choice.method, reason(choice, state.tolerance)


def reason(choice, tolerance: float) -> str:
    """Return in words why ``auto`` took this rung."""
    promise = f"predicted R² ≥ {at_least(1 - choice.predicted_error)}"
    if choice.method == "seidel":
        return f"seidel: six coefficients are enough, {promise}"
    if choice.method == "fitted":
        from p2sf.raytrace.fit import LEVELS

        rays = next(level.rays for level in LEVELS if level.numbers == choice.numbers)
        numbers = f"fitted: {choice.numbers} numbers from {rays} rays, {promise}"
        return f"{numbers}; the six Seidel coefficients would miss {tolerance:g}"
    lost = "are lost" in choice.why
    because = choice.why.partition("since ")[2] if lost else f"a smooth fit would miss {tolerance:g}"
    return f"{choice.method}: exact rays, {promise}; {because}"


def at_least(r_squared: float) -> str:
    """Return R² rounded down, with two digits of what it lacks to one, and four places at most."""
    places = min(4, 1 - floor(log10(max(1 - r_squared, 1e-9))))
    return f"{floor(r_squared * 10**places) / 10**places:.{places}f}".rstrip("0")
