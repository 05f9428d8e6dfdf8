"""The extent of the light in a picture, and the frame around it for the stage. Uses no Qt."""

from dataclasses import dataclass
from math import ceil, hypot, log

import numpy as np

from p2sf.conventions import centred_axis

SHARE = 0.9  # of the light of the picture, within the circle
LEAST_AIRY = 1.5  # Airy radii that the circle has at least: 3 across
FILLED = 0.78  # of half a frame, the circle's radius at most
KEPT = 0.3, 0.9  # of half a frame, the circle's radius while a slider moves and the frame, and with it the axes, stay
STEP = 1.15  # between the sizes of frames
PARTS = 10  # of half a frame, to which its middle is rounded, for the same reason
BLOCKS = 128  # a side of what the circle is counted on


@dataclass(frozen=True)
class Circle:
    """A circle about the centroid of a picture, µm from the chief ray."""

    x_um: float
    y_um: float
    radius_um: float


@dataclass(frozen=True)
class ShownSquare:
    """The square that is shown whole: its middle and half its side, µm from the chief ray."""

    x_um: float
    y_um: float
    half_um: float


@dataclass(frozen=True, eq=False)
class LightRings:
    """The centroid of a picture, µm from the chief ray, and the share of its light within each radius about it, µm."""

    x_um: float
    y_um: float
    radius_um: np.ndarray
    share: np.ndarray

    def radius_of(self, share: float) -> float:
        """Return the radius that holds a share of the light, µm."""
        return float(np.interp(share, self.share, self.radius_um))

    def circle(self, airy_um: float) -> Circle:
        """Return the circle of `SHARE` of the light, at least 3 Airy radii across."""
        return Circle(self.x_um, self.y_um, max(self.radius_of(SHARE), LEAST_AIRY * airy_um))


DARK = LightRings(0.0, 0.0, np.zeros(2), np.array([0.0, 1.0]))


def light_rings(values: np.ndarray, pixel_um: float) -> LightRings:
    """Return the light of a picture within circles about its centroid; ``values``: samples (n, n) as of a `Psf`.

    To a fraction of a pixel: a sample's light is spread over one pixel along the radius, which takes a fifth of the
    time of `p2sf.figures.window.radius_of_energy`.
    """
    count = len(values)
    block = max(1, count // BLOCKS)
    kept = count // block * block
    light = values[:kept, :kept].reshape(kept // block, block, kept // block, block).sum((1, 3), dtype=float)
    at = centred_axis(count, pixel_um)[:kept].reshape(-1, block).mean(1)
    total = float(light.sum())
    if not total > 0:
        return DARK
    x, y = float(light.sum(0) @ at) / total, float(light.sum(1) @ at) / total
    pitch = block * pixel_um
    outer = np.hypot(at - x, (at - y)[:, None]).ravel() / pitch + 0.5
    rings = outer.astype(np.intp)
    beyond = light.ravel() * (outer - rings)
    shares, nearer = np.bincount(rings, beyond), np.bincount(rings, light.ravel() - beyond)
    shares[:-1] += nearer[1:]
    shares[0] += nearer[0]
    within = np.append(0.0, np.cumsum(shares)) / total
    return LightRings(x, y, pitch * np.arange(len(within)), within)


def light_circle(values: np.ndarray, pixel_um: float, airy_um: float) -> Circle:
    """Return the circle about the centroid that holds `SHARE` of a picture's light, at least 3 Airy radii across."""
    return light_rings(values, pixel_um).circle(airy_um)


def frame_of(circle: Circle, kept: ShownSquare | None = None) -> ShownSquare:
    """Return the frame that the circle fills to 0.68 to 0.78; the one ``kept`` while the circle is well within it."""
    if kept and KEPT[0] <= circle.radius_um / kept.half_um <= KEPT[1]:
        if max(abs(circle.x_um - kept.x_um), abs(circle.y_um - kept.y_um)) <= kept.half_um / PARTS:
            return kept
    half = STEP ** ceil(log(circle.radius_um / FILLED) / log(STEP))
    x, y = (round(PARTS * at / half) * half / PARTS for at in (circle.x_um, circle.y_um))
    return ShownSquare(x, y, half)


def crop(pictures: np.ndarray, airy_pixels: float = 0.0) -> slice:
    """Return the rows, and the columns, about the middle that show the light of all pictures, (count, n, n).

    ``airy_pixels``: the Airy radius in samples. Pictures without light, which are NaN, do not count.
    """
    count = pictures.shape[-1]
    circles = [light_circle(np.abs(each), 1.0, airy_pixels) for each in pictures if np.isfinite(each).all()]
    reach = max((hypot(c.x_um, c.y_um) + c.radius_um for c in circles), default=float(count))
    half = min(count // 2, int(reach / FILLED) + 1)
    return slice(count // 2 - half, count // 2 + half + count % 2)
