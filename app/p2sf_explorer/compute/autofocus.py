"""Autofocus: the sensor shift at which the wavefront's RMS is smallest. No Qt in here."""

import numpy as np

from p2sf.disc.domain import ClearNodes
from p2sf.disc.tilt import without_tilt
from p2sf.errors import GeometryError
from p2sf.paraxial.balance import depth_of_focus_um
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.pencil import displayed_opd
from p2sf_explorer.compute.setup import ParaxialSetup, everywhere_by_coefficients, paraxial_setup
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.what_if import check_focusable

RAYS = 12, 32  # radii and directions over the disc
STEPS = 3  # W is nearly linear in the shift
TRIED_WAVES = 0.5  # of defocus, by which the sensor is shifted to see how W changes


def best_shift_um(state: State) -> float:
    """Return the sensor shift of smallest RMS wavefront, µm: of W for seidel, of exact rays for every other method.

    By Gauss and Newton's method: how W changes with the shift is seen by shifting the sensor, since off the axis it is
    not Wd·ρ² alone. Raises GeometryError where no shift can focus: the image is at infinity, or the what-if sets Wd
    aside.
    """
    check_focusable(state)
    setup = paraxial_setup(state)
    by_coefficients = everywhere_by_coefficients(state, setup)
    na = setup.cone.na
    if not na:
        raise GeometryError("the image is at infinity, so no sensor position is in focus; move the source")
    depth_um = depth_of_focus_um(float(setup.coefficients.image_index), setup.source.wavelength_um, na)
    tried_um = 2 * TRIED_WAVES * depth_um
    nodes = open_nodes(setup, not by_coefficients, state.optics.clip)
    shift = state.optics.sensor_shift_um
    for _ in range(STEPS):
        here, beside = (_waves(state, um, nodes, by_coefficients) for um in (shift, shift + tried_um))
        shift -= tried_um * amount(nodes, here, beside - here)
    return round(shift, 3)


def amount(nodes: ClearNodes, waves: np.ndarray, shape: np.ndarray) -> float:
    """Return how often a shape fits into a wavefront by least squares, piston and tilt set aside."""
    own, rest = without_tilt(np.stack([shape, waves]), nodes.weight, nodes.axes)
    weighted = nodes.weight * own
    return float(weighted @ rest / (weighted @ own))


def open_nodes(setup: ParaxialSetup, exact: bool, clip: bool) -> ClearNodes:
    """Return nodes over the part of the pupil that passes light; the six coefficients know no rims."""
    lens, source = setup.lens, setup.source
    return pupil_nodes(lens, source, RAYS, exact and clip, not exact or all_reach(lens, source))


def _waves(state: State, shift_um: float, nodes: ClearNodes, by_coefficients: bool) -> np.ndarray:
    """Return the displayed W at the nodes, waves, where the sensor is shifted."""
    setup = paraxial_setup(change(state, sensor_shift_um=shift_um))
    if by_coefficients:
        waves = np.asarray(wavefront(setup.coefficients, nodes.xi, nodes.eta))
    else:
        waves = displayed_opd(setup.lens, setup.source, nodes.xi, nodes.eta, stop=setup.stop)
    return waves - nodes.path_um / setup.source.wavelength_um
