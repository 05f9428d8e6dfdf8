"""RMS and Strehl ratio of a build by exact rays alone, over more rays than the differentials know."""

from collections.abc import Sequence

import numpy as np

from p2sf.disc.quadrature import whole_disc
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.raytrace.pencil import displayed_opd, pencil
from tests.support.waves import rms_about_plane

NODES, GRID = (16, 40), 300


def brightest(light: np.ndarray, waves: np.ndarray, fx: np.ndarray, fy: np.ndarray) -> float:
    """Return the largest |Σ light·exp(2πi(waves + f·x))|² over a grid of places and a finer one about the best."""
    period = 1 / np.hypot(fx, fy).max()
    place, field = np.zeros(2), light * np.exp(2j * np.pi * waves)
    for reach, step in ((4.0, 0.1), (0.12, 0.005)):
        aside = period * np.arange(-reach, reach + step / 2, step)
        along_x, along_y = (np.exp(2j * np.pi * np.outer(f, at + aside)) for f, at in zip((fx, fy), place, strict=True))
        found = np.abs((along_y * field[:, None]).T @ along_x) ** 2
        row, column = np.unravel_index(found.argmax(), found.shape)
        place = place + np.array([aside[column], aside[row]])
    return float(found.max())


def exact_quality(lens: Lens, sources: Sequence[Source]) -> tuple[np.ndarray, np.ndarray]:
    """Return RMS (waves) of the displayed wavefront without piston and tilt, and the Strehl ratio of every field."""
    xi, eta, area = whole_disc(*NODES)
    rms, strehl = [], []
    for source in sources:
        rays = pencil(lens, source, xi, eta)
        light = area * rays.launch
        light /= light.sum()
        terms = np.stack([np.ones_like(xi), rays.fx, rays.fy], axis=1) * np.sqrt(light)[:, None]
        waves = rays.phase * np.sqrt(light)
        left = waves - terms @ np.linalg.lstsq(terms, waves, rcond=None)[0]
        rms.append(rms_about_plane(displayed_opd(lens, source, xi, eta), xi, eta, area))
        strehl.append(brightest(light, left / np.sqrt(light), rays.fx, rays.fy))
    return np.array(rms), np.array(strehl)


def masked_quality(lens: Lens, sources: Sequence[Source]) -> tuple[np.ndarray, np.ndarray]:
    """Return the same behind the mask in the stop, by rays on a square grid that it lets pass."""
    axis = (np.arange(GRID) + 0.5) * 2 / GRID - 1
    xi, eta = (each.ravel() for each in np.meshgrid(axis, axis))
    open_ = (xi**2 + eta**2 < 1) & lens.mask.opens(xi, eta)
    xi, eta = xi[open_], eta[open_]
    rms, strehl = [], []
    for source in sources:
        assert not source.azimuth_deg, "the mask would be seen turned"
        rays = pencil(lens, source, xi, eta)
        field = rays.launch * lens.mask.amplitude(xi, eta)
        field = field / field.sum()
        waves = rays.phase + lens.mask.path_um(xi, eta) / source.wavelength_um
        terms = np.stack([np.ones_like(xi), rays.fx, rays.fy])
        left = waves - np.linalg.solve(terms * field @ terms.T, terms * field @ waves) @ terms
        displayed = lens.mask.path_um(xi, eta) / source.wavelength_um - displayed_opd(lens, source, xi, eta)
        rms.append(rms_about_plane(displayed, xi, eta, np.full(xi.size, 1 / xi.size)))
        strehl.append(brightest(field, left, rays.fx, rays.fy))
    return np.array(rms), np.array(strehl)
