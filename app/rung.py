"""Which rung of the ladder makes the picture, and the picture itself. No Qt in here."""

from dataclasses import dataclass

import numpy as np

from app.geometric import geometric_psf
from app.scales import nice
from app.setting import Setting
from app.state import State
from p2sf.conventions import UM_PER_MM
from p2sf.huygens import Filling, huygens_psf
from p2sf.measures import airy_radius_um
from p2sf.psf import Psf, seidel_psf, suitable_pixel_um
from p2sf.raytrace import pencil
from p2sf.wavefront import steepest_slope

PIXELS = 64
WINDOWS = (1, 1.5, 2, 3, 4, 5, 6, 8)
STEEPEST = 80.0  # waves of slope: beyond, a pixel of the window is some four Airy radii wide
BLURRED = "blur so large that rays alone describe it; bring focus and source together to see diffraction"
ROOM = 5  # Airy radii around what rays say, for what diffraction adds


@dataclass(frozen=True)
class Made:
    """A PSF, a sentence on why this rung made it, and whether exact rays describe it or six coefficients."""

    psf: Psf
    why: str
    exact: bool = True


def rendered(state: State, set_up: Setting, quality: str) -> Made:
    """Return the PSF by the state's method, or by the rung ``auto`` chooses for it."""
    method, why = chosen(state, set_up)
    if quality == "preview" and method == "huygens":
        method, why = "traced", "traced while the slider moves, huygens when it rests"
    pitch = window_um(set_up, method) / PIXELS
    if too_blurred(set_up):
        return Made(geometric_psf(set_up, method != "seidel", PIXELS, pitch), BLURRED, method != "seidel")
    if method == "seidel":
        return Made(seidel_psf(set_up.coefficients, PIXELS, pitch, quality), why, exact=False)
    if method == "huygens":  # the converged sum takes seconds and belongs to the accuracy worker
        return Made(huygens_psf(set_up.lens, set_up.source, PIXELS, pitch, None, filling=Filling(clip=state.clip)), why)
    from p2sf.ladder import render

    psf = render(set_up.lens, set_up.source, method, PIXELS, pitch, quality, state.tolerance, state.clip)
    return Made(psf, why)


def too_blurred(set_up: Setting) -> bool:
    """Return whether a wave sum would take too long for a picture that shows only the density of rays anyway."""
    return float(steepest_slope(set_up.coefficients)) > STEEPEST


def window_um(set_up: Setting, method: str) -> float:
    """Return the width of the shown window, µm: a round number, so that axes stand still while sliders move."""
    if method == "seidel":
        return nice(float(suitable_pixel_um(set_up.coefficients, PIXELS)) * PIXELS, WINDOWS)
    reach = landing_um(set_up) + ROOM * float(airy_radius_um(set_up.source.wavelength_um, set_up.coefficients.na))
    return nice(2 * reach, WINDOWS)


def landing_um(set_up: Setting) -> float:
    """Return how far from the chief ray the farthest of a few exact rays lands, in x or y, µm."""
    turn = np.linspace(0, np.pi, 9)
    edge = np.stack([np.sin(turn), np.cos(turn)])
    xi, eta = np.concatenate([edge, 0.7 * edge], axis=1)
    rays = pencil(set_up.lens, set_up.source, xi, eta, stop=set_up.stop)
    reach = np.abs(np.concatenate([rays.dx, rays.dy]))
    return UM_PER_MM * float(np.nanmax(reach)) if np.isfinite(reach).any() else 0.0


def chosen(state: State, set_up: Setting) -> tuple[str, str]:
    """Return the rung in use and why: a person's choice needs no reason."""
    if state.method != "auto":
        return state.method, ""
    from p2sf.ladder import choose

    choice = choose(set_up.lens, set_up.source, state.tolerance, state.clip)
    return choice.method, choice.why
