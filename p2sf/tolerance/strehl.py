"""Strehl ratios of many builds at once: the peak of each picture, by Newton's method from a coarse look about it."""

from functools import lru_cache

import numpy as np

from p2sf.conventions import write_protect

SHARP = 0.5  # of the unaberrated peak: where the light at the point of least variance is above, the peak is near it
REACH, SPACING = 2.5, 0.4  # periods of the highest frequency about that point that are looked at, and between looks
LONGEST = 0.125  # of such a period, a step
STEPS = 8  # at most
ENOUGH = 1e-4  # of a peak: the next step gains about the square of it
SINGLE = np.float32  # rounds some waves to 1e-6, far below what rays leave; double takes four times as long


def strehl_ratios(waves: np.ndarray, weight: np.ndarray, frequencies: np.ndarray) -> np.ndarray:
    """Return the largest |Σ weight·exp(2πi(waves + f·x))|² over places x, (builds,).

    ``waves``: (builds, rays), without tilt; ``weight``: (rays,), of unit sum; ``frequencies``: fx and fy, (2, rays).
    Places farther than REACH periods from the point of least variance are left out.
    """
    turn, angle = (frequencies / np.hypot(*frequencies).max()).astype(SINGLE), (2 * np.pi * waves).astype(SINGLE)
    x, y = turn
    moments = (weight * np.stack([np.ones_like(x), x, y, x * x, x * y, y * y])).T.astype(SINGLE)
    place = _brightest_looks(angle, moments[:, 0], turn)
    peak, left = np.zeros(len(waves)), np.arange(len(waves))
    for _ in range(STEPS):
        here = angle[left] + (2 * np.pi * place[left]).astype(SINGLE) @ turn
        value, step, gain = _newton(np.cos(here) @ moments + 1j * (np.sin(here) @ moments))
        part = np.minimum(1.0, LONGEST / np.maximum(np.hypot(*step.T), 1e-300))
        done = (part == 1) & (gain < ENOUGH * value)
        peak[left] = np.maximum(peak[left], value + np.where(done, gain, 0.0))
        place[left] += part[:, None] * step
        left = left[~done]
        if not left.size:
            break
    return peak


def _brightest_looks(angle: np.ndarray, weight: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Return where to start, (builds, 2): the point of least variance or, of a blurred picture, the brightest look."""
    field = np.cos(angle) + 1j * np.sin(angle)
    place = np.zeros((len(angle), 2))
    blurred = np.abs(field @ weight) ** 2 < SHARP
    if blurred.any():
        away = (2 * np.pi * turn.T) @ _looks().T.astype(SINGLE)
        light = np.abs((field[blurred] * weight) @ (np.cos(away) + 1j * np.sin(away)))
        place[blurred] = _looks()[light.argmax(1)]
    return place


def _newton(sums: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return |E|², Newton's step towards its maximum (…, 2) and the gain expected, as `Waves.near` does of one field.

    ``sums``: of the waves times 1, fx, fy, fx², fx·fy and fy², (…, 6).
    """
    field, by_x, by_y, by_xx, by_xy, by_yy = np.moveaxis(sums, -1, 0)
    back = field.conjugate()
    slope_x, slope_y = -(back * by_x).imag, -(back * by_y).imag
    bend_x, bend_y = np.abs(by_x) ** 2 - (back * by_xx).real, np.abs(by_y) ** 2 - (back * by_yy).real
    bend_xy = (by_x.conjugate() * by_y).real - (back * by_xy).real
    determinant = bend_x * bend_y - bend_xy**2
    concave = (bend_x < 0) & (determinant > 0)
    steepest, safe = np.maximum(np.abs(bend_x) + np.abs(bend_y), 1e-300), np.where(concave, determinant, 1.0)
    step_x = np.where(concave, (bend_xy * slope_y - bend_y * slope_x) / safe, slope_x / steepest)
    step_y = np.where(concave, (bend_xy * slope_x - bend_x * slope_y) / safe, slope_y / steepest)
    gain = slope_x * step_x + slope_y * step_y
    return np.abs(field) ** 2, np.stack([step_x, step_y], -1) / (2 * np.pi), gain


@lru_cache(maxsize=1)
def _looks() -> np.ndarray:
    """Return the places of a round grid, periods, (places, 2)."""
    axis = np.arange(-REACH, REACH + SPACING / 2, SPACING)
    grid = np.stack(np.meshgrid(axis, axis), -1).reshape(-1, 2)
    return write_protect(grid[np.hypot(*grid.T) <= REACH])
