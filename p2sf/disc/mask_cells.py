"""Effect of a mask on the cells of a grid over the pupil: an edge leaves part of a cell open."""

from functools import lru_cache
from math import pi

import numpy as np

from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import outline_radius, throughput

OUTLINE = 2048  # chords around the iris, which give its length to 1e-6


def open_share(mask: PupilMask, xi: np.ndarray, eta: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Return the share of each cell of this width, in rim radii, that obscuration, blades and vanes leave open.

    Linear across every edge, the average over orientations of a cell; a vane narrower than a cell covers its share.
    """
    share = np.ones(np.shape(xi), np.result_type(xi))
    if mask.obscured:
        share *= inside_share(-mask.disc.depth(xi, eta), width)
    for edge in mask.edges:
        share *= inside_share(edge.depth(xi, eta), width)
    for angle in mask.vane_angles:
        sine, cosine = np.float32(np.sin(angle)), np.float32(np.cos(angle))
        along, aside = eta * cosine + xi * sine, xi * cosine - eta * sine
        covered = inside_share(aside + np.float32(mask.vane_width), width)
        covered -= inside_share(aside - np.float32(mask.vane_width), width)
        share *= 1 - covered * inside_share(along, width)
    return share


def inside_share(within: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Return the share of cells where ``within``, changing by ``width`` across one, is positive: linear at a rim."""
    share = within / (width + np.float32(1e-30)) + 0.5
    return np.clip(share, 0, 1, out=share)


@lru_cache(maxsize=64)
def wings(mask: PupilMask) -> float:
    """Return the light that a mask's edges diffract far from the image relative to that of the clear disc's rim.

    Far out every element of an edge diffracts equally, so this is the ratio of edge length to open area divided by that
    of the disc, which is 2; for a ring 1/(1 − ε), in agreement with the asymptote of J₁.
    """
    theta = np.sort(np.append(np.linspace(0, 2 * pi, OUTLINE), np.mod(mask.corner_angles, 2 * pi)))
    outline = outline_radius(mask, theta)
    xi, eta = outline * np.sin(theta), outline * np.cos(theta)
    length = float(np.hypot(np.diff(xi), np.diff(eta)).sum()) + 2 * pi * mask.obscuration
    length += 2 * len(mask.vane_angles) * (1 - mask.obscuration)
    return max(1.0, length / (2 * pi * throughput(mask).light))


def turned_back(xi: np.ndarray, eta: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return pupil points of fields at these azimuths, radians from +y towards +x, in the axes of the field at +y."""
    sine, cosine = np.sin(angle).astype(xi.dtype), np.cos(angle).astype(xi.dtype)
    return xi * cosine + eta * sine, eta * cosine - xi * sine
