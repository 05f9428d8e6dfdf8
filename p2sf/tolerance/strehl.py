"""Strehl ratios of many builds at once: the peak of each picture, by Newton's method from a coarse grid."""

from collections.abc import Iterator

import numpy as np

from p2sf.disc.transform import newton_step

SHARP = 0.5  # of the unaberrated peak: where the light at the point of least variance is above, the peak is near it
REACH = 2.5  # periods of the highest frequency that a grid reaches about that point
SIDE = 21  # places of the grid along a side
STARTS = 3  # of its maxima: with one of them a blurred build is up to 7 % too low, with three 1 %
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
        for start in _brightest_places(field[blurred] * moments[:, 0], turn):
            peak[blurred] = np.maximum(peak[blurred], _climb(angle[blurred], turn, moments, start))
    return peak


def _climb(angle: np.ndarray, turn: np.ndarray, moments: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Return the maxima, (builds,), that Newton's method finds from places, (builds, 2) periods, which it moves."""
    peak, left = np.zeros(len(angle)), np.arange(len(angle))
    for _ in range(STEPS):
        here = angle[left] + (2 * np.pi * place[left]).astype(SINGLE) @ turn
        value, step, gain = newton_step(np.cos(here) @ moments + 1j * (np.sin(here) @ moments))
        part = LONGEST / np.maximum(np.hypot(*step.T), LONGEST)
        done = (part == 1) & (gain < ENOUGH * value)
        peak[left] = np.maximum(peak[left], value + np.where(done, gain, 0.0))
        place[left] += part[:, None] * step
        left = left[~done]
        if not left.size:
            break
    return peak


def _brightest_places(field: np.ndarray, turn: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the brightest places of a square grid that no neighbour exceeds, STARTS of each build, (builds, 2)."""
    axis = np.linspace(-REACH, REACH, SIDE)
    grid = np.stack(np.meshgrid(axis, axis), -1).reshape(-1, 2)
    away = (2 * np.pi * turn.T) @ grid.T.astype(SINGLE)
    light = np.abs(field @ (np.cos(away) + 1j * np.sin(away))).reshape(-1, SIDE, SIDE)
    wide = np.pad(light, ((0, 0), (1, 1), (1, 1)))
    around = [wide[:, i : SIDE + i, k : SIDE + k] for i in range(3) for k in range(3)]
    tops = np.where(light == np.max(around, axis=0), light, 0).reshape(len(field), -1)
    for start in np.argsort(-tops, axis=1)[:, :STARTS].T:
        yield grid[start]
