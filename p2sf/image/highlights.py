"""Halos of bright light: few large kernels for it, where small ones end far above a millionth of its peak.

A scene whose measure is "hdr" has the light of its kernels beyond their windows too: where a picture is bright enough,
the difference between a kernel of full size and the one it was blurred by is added about it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil, pi

import numpy as np

from p2sf.disc.mask_cells import wings
from p2sf.figures.tails import FAINTEST, FARTHEST
from p2sf.image.lattice import pad_to_largest
from p2sf.image.region import Region, whole
from p2sf.parameters import LARGEST_SIDE
from p2sf.pixel_kernels.channel import RAYS, Colour, Kernels, Points
from p2sf.pixel_kernels.pixels import samples_each
from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.scene.planning.plan import Plan

FINENESS, MARGIN = 2.0, 1.0  # of the sum of waves: every fringe, and a window four times as wide as what is kept
GROUPS = 8  # along each side of the picture: bright light in one of these has one large kernel
AIRY = 0.61  # radius of the first dark ring times the pupil's radius in cycles/µm


@dataclass(frozen=True, eq=False)
class BrightLight:
    """Bright pixels: rows, columns and places among depth nodes (n,), and their light, (n, channels)."""

    rows: np.ndarray
    columns: np.ndarray
    places: np.ndarray
    light: np.ndarray

    def some(self, chosen: np.ndarray) -> "BrightLight":
        """Return some of them."""
        return BrightLight(self.rows[chosen], self.columns[chosen], self.places[chosen], self.light[chosen])


def gather(parts: list[BrightLight]) -> BrightLight:
    """Return the bright pixels of several parts of a picture."""
    columns = zip(*((part.rows, part.columns, part.places, part.light) for part in parts), strict=True)
    return BrightLight(*map(np.concatenate, columns))


def groups_of(bright: BrightLight, shape: tuple[int, ...]) -> Iterator[BrightLight]:
    """Yield the bright pixels that share a large kernel: those near each other at nearly one depth."""
    sides = [ceil(n / GROUPS) for n in shape[:2]]
    keys = np.stack([bright.rows // sides[0], bright.columns // sides[1], np.rint(bright.places).astype(int)])
    for number in range(len(found := np.unique(keys, axis=1).T)):
        yield bright.some((keys == found[number][:, None]).all(0))


@dataclass(frozen=True, eq=False)
class FullKernels:
    """Kernels of every wavelength of a scene's channels, out to where their light is faint enough."""

    planned: Plan

    def at(self, row: float, column: float, vergence: float) -> np.ndarray:
        """Return the kernels of a point of the sensor, (channels, size, size) of unit sum."""
        sensor = self.planned.scene.sensor
        x, y = float(sensor.x_mm(column)), float(sensor.y_mm(row))
        points = [self._point(number, x, y, vergence) for number in range(len(self.planned.colours))]
        half = max(map(self._half, points))
        return np.stack([point.kernels(np.array([half]))[0] for point in points])

    def _point(self, channel: int, x_mm: float, y_mm: float, vergence: float) -> Points:
        own, recipe = self.planned.scene.channels[channel], self.planned.recipe
        colour = Colour(tuple(own.wavelengths_um.tolist()), tuple(own.shares.tolist()))
        fine = replace(recipe, fineness=FINENESS, margin=MARGIN)
        seen, pixel = self.planned.sensor_map(vergence), self.planned.scene.sensor.pixel_um
        return Kernels(seen, colour, pixel, fine).points([x_mm], [y_mm])

    def _half(self, point: Points) -> int:
        """Return the half width, pixels, within which the azimuthal mean is FAINTEST of the peak, or FARTHEST."""
        pupils, pixel, own = _pupils(point), point.pixel_um, int(point.half_widths()[0])
        radius, mask = float(pupils.radius.min()), pupils.mask
        reach = FARTHEST * AIRY / radius
        if mask.round:
            # Light beyond r, seen from the edge of a disc: 1/(π²·r·radius) (Born & Wolf, 8.5.2, for large r).
            faint = FAINTEST * float(point.kernels(np.array([own]))[0].max())
            reach = min(reach, (wings(mask) * pixel**2 / (2 * pi**3 * radius * faint)) ** (1 / 3))
        most = int(LARGEST_SIDE / samples_each(pupils, pixel, FINENESS).max() / 2 - 1) // 2
        sensor = self.planned.scene.sensor
        return max(own, min(own + ceil(reach / pixel), most, max(sensor.rows, sensor.columns)))


def _pupils(point: Points) -> PupilStack:
    assert isinstance(point.lights.lights, PupilStack)
    return point.lights.lights


def has_halos(planned: Plan) -> bool:
    """Return whether a plan's pictures have halos: asked by the scene, and of kernels that are sums of waves."""
    return planned.scene.measure == "hdr" and planned.recipe.method != RAYS


def dimmest(full: np.ndarray, small: np.ndarray, brightest: float) -> float:
    """Return the light above which a pixel's halo counts: what kernels lose beyond their windows is FAINTEST below it.

    ``full``, ``small``: kernels of one place; ``brightest``: of the picture.
    """
    small, full = pad_to_largest([small, full])
    lost = 1 - np.minimum(small > 0, full).sum((1, 2))
    return float(FAINTEST * brightest * full.max() / max(lost.max(), FAINTEST))


def add_halo(out: np.ndarray, bright: BrightLight, difference: np.ndarray) -> None:
    """Add a group of bright pixels spread by ``difference``, (channels, size, size), to a picture, in place."""
    import scipy.fft

    half = difference.shape[-1] // 2
    box = Region(
        int(bright.rows.min()), int(bright.rows.max()) + 1, int(bright.columns.min()), int(bright.columns.max()) + 1
    )
    planes = np.zeros((out.shape[-1], *box.shape))
    planes[:, bright.rows - box.top, bright.columns - box.left] = bright.light.T
    wide = box.grown(half)
    fast = [scipy.fft.next_fast_len(n, real=True) for n in wide.shape]
    spread = scipy.fft.irfft2(scipy.fft.rfft2(planes, fast) * scipy.fft.rfft2(difference, fast), fast)
    seen = wide.meet(whole(out.shape))
    out[seen.within(whole(out.shape))] += np.moveaxis(spread, 0, -1)[seen.within(wide)]
