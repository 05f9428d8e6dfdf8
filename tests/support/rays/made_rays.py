"""Rays with given phases, frequencies and landing points, through no lens."""

import numpy as np

from p2sf.raytrace.pencil import Rays


def made_rays(phase: np.ndarray, fx: np.ndarray, fy: np.ndarray, x_um: np.ndarray, y_um: np.ndarray) -> Rays:
    """Return evenly lit rays of 1 µm in air, all (ray,): phase in waves, frequencies in cycles per µm."""
    one, zero = np.ones_like(phase), np.zeros_like(phase)
    dx, dy = x_um / 1000, y_um / 1000
    path = phase / 1000 + fx * dx + fy * dy
    ended, chief = np.zeros(phase.shape, np.int8), np.zeros(1)
    columns = zero, zero, one, dx, dy, fx, fy, one, path, ended, ended
    return Rays(*columns, chief_y=chief, chief_ky=chief, chief_kz=chief + 1, index=1.0, wavelength_um=np.ones(1))
