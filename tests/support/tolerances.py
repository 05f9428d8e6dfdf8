"""RMS and Strehl ratio of a build by exact rays alone, over more rays than the differentials know."""

from collections.abc import Sequence

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.quadrature import whole_disc
from p2sf.raytrace.pencil import diffraction_phase, pencil
from p2sf.raytrace.ray_field import ray_data

NODES = 16, 40


def exact_quality(lens: Lens, sources: Sequence[Source]) -> tuple[np.ndarray, np.ndarray]:
    """Return RMS (waves) without piston and tilt, and the Strehl ratio without these, of every field."""
    xi, eta, area = whole_disc(*NODES)
    rms, strehl = [], []
    for source in sources:
        rays = pencil(lens, source, xi, eta)
        data, light = ray_data(rays), area * rays.weight
        light /= light.sum()
        terms = np.stack([np.ones_like(xi), data.fx, data.fy], axis=1) * np.sqrt(light)[:, None]
        waves = diffraction_phase(rays) * np.sqrt(light)
        left = waves - terms @ np.linalg.lstsq(terms, waves, rcond=None)[0]
        rms.append(np.sqrt((left**2).sum()))
        strehl.append(abs((light * np.exp(2j * np.pi * left / np.sqrt(light))).sum()) ** 2)
    return np.array(rms), np.array(strehl)
