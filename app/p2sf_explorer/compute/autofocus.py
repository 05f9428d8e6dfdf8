"""Autofocus: the sensor shift at which the wavefront's RMS is smallest. No Qt in here."""

import numpy as np

from p2sf.errors import GeometryError
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.mask_nodes import mask_nodes
from p2sf.pupil.quadrature import disc_nodes, whole_disc
from p2sf.raytrace.pencil import displayed_opd
from p2sf.raytrace.seen_mask import mask_seen
from p2sf_explorer.compute.setup import ParaxialSetup, paraxial_setup
from p2sf_explorer.state.state import State, changed
from p2sf_explorer.state.what_if import check_focusable, is_altered

RAYS = 12, 32  # radii and directions over the disc
STEPS = 3  # the reference sphere depends on the sensor, so the projection is repeated


def best_shift_um(state: State) -> float:
    """Return the sensor shift of smallest RMS wavefront, µm: of W for seidel, of exact rays for every other method.

    Raises GeometryError where no shift can focus: the image is at infinity, or the what-if sets Wd aside.
    """
    check_focusable(state)
    by_coefficients = state.optics.method == "seidel" or is_altered(state)
    for _ in range(1 if by_coefficients else STEPS):
        setup = paraxial_setup(state)
        if not setup.lens.mask.clear:
            focus = masked_focus(setup, by_coefficients)
        else:
            focus = seidel_focus(setup.coefficients) if by_coefficients else traced_focus(setup)
        na = float(setup.coefficients.na)
        if not na:
            raise GeometryError("the image is at infinity, so no sensor position is in focus; move the source")
        index = float(setup.coefficients.image_index)
        shift = -focus * 2 * index * setup.source.wavelength_um / na**2  # Wd = NA²Δz/(2n′λ)
        state = changed(state, sensor_shift_um=state.optics.sensor_shift_um + shift)
    return round(state.optics.sensor_shift_um, 3)


def seidel_focus(c: Coefficients) -> float:
    """Return the focus in W about which the variance splits: W40 + W20 + Wd + W22/2 (Mahajan 1991, table 2-1)."""
    return float(c.w40 + c.w20 + c.wd + c.w22 / 2)


def masked_focus(setup: ParaxialSetup, by_coefficients: bool) -> float:
    """Return the ρ² part of the wavefront over what a mask leaves open, tilt and piston set aside, in waves."""
    nodes = mask_nodes(mask_seen(setup.lens, setup.source), *RAYS)
    nodes = nodes.unfolded() if setup.lens.misaligned else nodes
    waves = (
        np.asarray(wavefront(setup.coefficients, nodes.xi, nodes.eta))
        if by_coefficients
        else displayed_opd(setup.lens, setup.source, nodes.xi, nodes.eta, stop=setup.stop)
    )
    waves = waves - nodes.path_um / setup.source.wavelength_um
    kept = np.isfinite(waves)
    parts = np.stack([nodes.xi**2 + nodes.eta**2, np.ones_like(nodes.xi), nodes.eta, nodes.xi])
    parts = (parts[:3] if nodes.even else parts) * kept
    weighted = parts * nodes.weight
    return float(np.linalg.lstsq(weighted @ parts.T, weighted @ np.where(kept, waves, 0.0), rcond=1e-12)[0][0])


def traced_focus(setup: ParaxialSetup) -> float:
    """Return the ρ² part of the exact wavefront, tilt and piston set aside, in waves: its projection on 2ρ² − 1."""
    half = disc_nodes(8, 16)
    xi, eta, weight = whole_disc(8, 16) if setup.lens.misaligned else (half.xi, half.eta, half.weight)
    waves = displayed_opd(setup.lens, setup.source, xi, eta, stop=setup.stop)
    kept = np.isfinite(waves)
    zernike = 2 * (xi**2 + eta**2) - 1
    weight = weight * kept
    share = (weight * zernike * np.where(kept, waves, 0.0)).sum() / (weight * zernike**2).sum()
    return 2 * float(share)
