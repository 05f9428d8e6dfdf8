"""Sections of the PSF through the chief ray."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Profiles:
    """Positions in µm from the chief ray; PSF along x and along y over its peak, and the Airy pattern."""

    position_um: np.ndarray
    along_x: np.ndarray
    along_y: np.ndarray
    airy: np.ndarray


def profiles(live) -> Profiles:
    """Return the sections through the chief ray's sample, over the PSF's peak, beside the Airy pattern."""
    psf = live.psf
    rows, columns = psf.values.shape
    peak = float(psf.values.max()) or 1.0
    position = psf.x_um
    return Profiles(
        position, psf.values[rows // 2] / peak, psf.values[:, columns // 2] / peak, airy(position, live.airy_radius_um)
    )


def airy(position_um: np.ndarray, radius_um: float) -> np.ndarray:
    """Return the Airy pattern (2J₁(v)/v)² (Airy 1835) of first dark ring ``radius_um``; J₁ by its integral."""
    v = 3.8317059702 * np.abs(position_um)[:, None] / radius_um
    turn = (np.arange(64) + 0.5) * np.pi / 64
    bessel = np.cos(turn - v * np.sin(turn)).mean(axis=1)  # J₁(v) = (1/π)∫cos(τ − v sin τ)dτ
    return np.where(v[:, 0] < 1e-9, 1.0, (2 * bessel / np.where(v[:, 0] < 1e-9, 1.0, v[:, 0])) ** 2)
