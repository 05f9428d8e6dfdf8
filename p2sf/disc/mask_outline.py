"""Outlines of a pupil mask for drawings: the opening of the rim or iris, and the obstructions in it."""

from math import cos, pi, sin

import numpy as np

from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import outline_radius

POINTS = 241  # of a circle, and at least of an iris


def opening(mask: PupilMask) -> np.ndarray:
    """Return ξ and η of the rim, or of the iris within it, a closed line, (2, points)."""
    corners = np.mod(mask.corner_angles, 2 * pi)
    theta = np.sort(np.append(np.linspace(0.0, 2 * pi, POINTS), corners))
    outline: np.ndarray = outline_radius(mask, theta) * np.stack([np.sin(theta), np.cos(theta)])
    return outline


def obstructions(mask: PupilMask) -> tuple[np.ndarray, ...]:
    """Return ξ and η of the obscuration and of each vane from the centre to the rim, closed lines, (2, points) each."""
    turn = np.linspace(0.0, 2 * pi, POINTS)
    disc = (np.stack(mask.disc.outline(turn)),) if mask.obscured else ()
    return *disc, *(vane(angle, mask.vane_width) for angle in mask.vane_angles)


def vane(angle: float, half_width: float, start: float = 0.0) -> np.ndarray:
    """Return the corners of a vane that runs from ``start`` to the rim, a closed line, (2, 5); ``angle`` in radians."""
    along, across = np.array([[sin(angle)], [cos(angle)]]), np.array([[cos(angle)], [-sin(angle)]])
    ends, sides = np.array([start, 1.0, 1.0, start, start]), half_width * np.array([-1.0, -1.0, 1.0, 1.0, -1.0])
    corners: np.ndarray = along * ends + across * sides
    return corners


def dark_heights(mask: PupilMask) -> tuple[tuple[float, float], ...]:
    """Return the parts of the line ξ = 0, −1 to 1, covered by obscuration and iris: pairs of η, the lower one first.

    Vanes are ignored: they are thin, and a vane on this line would hide everything else.
    """
    top, bottom = (float(radius) for radius in outline_radius(mask, np.array([0.0, pi])))
    middle = (float(end) for end in mask.disc.chord(np.zeros(()), np.zeros(()), 0.0, 1.0))
    low, high = (min(max(end, -bottom), top) for end in middle)
    covered = (-1.0, -bottom), (low, high), (top, 1.0)
    return tuple((low, high) for low, high in covered if high > low)
