"""Strehl ratios of many builds at once: the peak of each picture, by Newton's method from a coarse look about it."""

from collections.abc import Iterator

import numpy as np

SHARP = 0.5  # of the unaberrated peak: where the light at the point of least variance is above, the peak is near it
REACH, LOOKS = 2.5, 21  # periods of the highest frequency about that point that are looked at, and looks along them
STARTS = 3  # with which 1 of 194 blurred builds is 1 % too low; a quarter of a period is between looks
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
    field = np.cos(angle) + 1j * np.sin(angle)
    least_variance = np.abs(field @ moments[:, 0]) ** 2
    sharp, blurred = np.flatnonzero(least_variance >= SHARP), np.flatnonzero(~(least_variance >= SHARP))
    peak = np.where(np.isnan(least_variance), np.nan, 0.0)
    peak[sharp] = _climb(angle[sharp], turn, moments, np.zeros((sharp.size, 2)))
    if blurred.size:
        for start in _brightest_looks(field[blurred] * moments[:, 0], turn):
            peak[blurred] = np.maximum(peak[blurred], _climb(angle[blurred], turn, moments, start))
    return peak


def _climb(angle: np.ndarray, turn: np.ndarray, moments: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Return the maxima, (builds,), that Newton's method finds from places, (builds, 2) periods, which it moves."""
    peak, left = np.zeros(len(angle)), np.arange(len(angle))
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


def _brightest_looks(field: np.ndarray, turn: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the brightest places of a square grid that no neighbour exceeds, STARTS of each build, (builds, 2)."""
    axis = np.linspace(-REACH, REACH, LOOKS)
    looks = np.stack(np.meshgrid(axis, axis), -1).reshape(-1, 2)
    away = (2 * np.pi * turn.T) @ looks.T.astype(SINGLE)
    light = np.abs(field @ (np.cos(away) + 1j * np.sin(away))).reshape(-1, LOOKS, LOOKS)
    wide = np.pad(light, ((0, 0), (1, 1), (1, 1)))
    around = [wide[:, i : LOOKS + i, k : LOOKS + k] for i in range(3) for k in range(3)]
    tops = np.where(light == np.max(around, axis=0), light, 0).reshape(len(field), -1)
    for start in np.argsort(-tops, axis=1)[:, :STARTS].T:
        yield looks[start]


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
