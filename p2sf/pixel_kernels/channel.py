"""The kernel of one spectral channel anywhere on the sensor: fits along a radius, rotated, summed over wavelength."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM, vergence
from p2sf.errors import P2SFError
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.pixels import PixelWindow, half_widths, pixel_kernels, samples_each
from p2sf.pixel_kernels.pupil_stack import FrequencyPupil, PupilStack, stacked
from p2sf.pixel_kernels.pupil_table import PupilTable
from p2sf.pixel_kernels.ray_spread import RaySpread, ray_kernel, ray_spread
from p2sf.pixel_kernels.sensor_points import SensorMap

RAYS = "rays"  # the method of a recipe whose kernels are densities of rays


Light: TypeAlias = FrequencyPupil | RaySpread
"""What describes the light of one point: a pupil whose waves are summed, or rays."""


@dataclass(frozen=True)
class Recipe:
    """How kernels are computed: method, its numbers (None: as the residual requires), samples per λ/(2NA), margin.

    ``method``: "seidel" or "fitted", whose waves are summed, or "rays", to which the other numbers mean nothing.
    ``margin`` is a fraction of the window's half width, added on either side before the transform and cut off after
    it.
    """

    method: str = "fitted"
    numbers: int | None = None
    fineness: float = 1.0
    margin: float = 0.0


@dataclass(frozen=True)
class Colour:
    """Wavelengths in µm and the share of a channel's light that each one carries."""

    wavelengths_um: tuple[float, ...]
    weights: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class PointLights:
    """The light of several points in several wavelengths, (waves · points,), the points of one wavelength together.

    ``lights``: pupils, or rays of each; ``shifts_um``, (waves · points,), outwards.
    """

    lights: PupilStack | list[RaySpread]
    shifts_um: np.ndarray

    def half_widths(self, pixel_um: float) -> np.ndarray:
        """Return how many pixels on either side of the centre hold each kernel, (waves · points,)."""
        if isinstance(self.lights, PupilStack):
            return half_widths(self.lights, pixel_um, self.shifts_um)
        pairs = zip(self.lights, self.shifts_um, strict=True)
        return np.array([half_widths(light, pixel_um, shift) for light, shift in pairs], int)

    def kernels(self, angles: np.ndarray, halves: np.ndarray, pixel_um: float, recipe: Recipe) -> list[np.ndarray]:
        """Return each kernel, (2·half + 1,)² float32; fields along ``angles`` from +y towards +x."""
        shifts = self.shifts_um[:, None] * np.stack([np.sin(angles), np.cos(angles)], axis=1)
        if isinstance(self.lights, PupilStack):
            return wave_kernels(self.lights, angles, halves, pixel_um, recipe, shifts)
        places = zip(self.lights, angles.tolist(), halves.tolist(), shifts.tolist(), strict=True)
        return [ray_kernel(light, angle, half, pixel_um, (x, y)) for light, angle, half, (x, y) in places]


def wave_kernels(
    pupils: PupilStack, angles: np.ndarray, halves: np.ndarray, pixel_um: float, recipe: Recipe, shifts_um: np.ndarray
) -> list[np.ndarray]:
    """Return the kernels of pupils, each (2·half + 1,)² float32; those of equal windows are computed together.

    ``angles`` and ``halves`` (pupils,), ``shifts_um`` (pupils, 2).
    """
    samples = samples_each(pupils, pixel_um, recipe.fineness)
    # The transform is periodic: a pencil wider than the window would wrap around to its other side.
    need = half_widths(pupils, pixel_um, np.hypot(*shifts_um.T))
    wide = np.maximum(halves, need) + np.ceil(recipe.margin * halves).astype(int)
    kernels: list[np.ndarray] = [np.empty(0)] * len(pupils)
    for window in np.unique(np.stack([wide, samples, halves]), axis=1).T.tolist():
        chosen = np.flatnonzero((wide == window[0]) & (samples == window[1]) & (halves == window[2]))
        where = PixelWindow(window[0], pixel_um, window[1])
        cut = slice(window[0] - window[2], window[0] + window[2] + 1)
        made = pixel_kernels(pupils.some(chosen), angles[chosen], where, shifts_um[chosen])[:, cut, cut]
        for k, kernel in zip(chosen.tolist(), made, strict=True):
            kernels[k] = kernel
    return kernels


@dataclass(frozen=True, eq=False)
class Points:
    """The light of points in all wavelengths of a channel, and the recipe that makes kernels of it.

    ``weights`` of the wavelengths; ``angles``, (points,), of their fields from +y towards +x.
    """

    pixel_um: float
    weights: tuple[float, ...]
    angles: np.ndarray
    recipe: Recipe
    lights: PointLights

    def half_widths(self) -> np.ndarray:
        """Return how many pixels on either side of the centre hold each point's kernel, (points,)."""
        halves: np.ndarray = self.lights.half_widths(self.pixel_um).reshape(len(self.weights), -1).max(0)
        return halves

    def kernels(self, halves: np.ndarray) -> list[np.ndarray]:
        """Return each point's kernel of this half width, (2·half + 1,)² float32 of unit sum, row 0 the top."""
        totals = [np.zeros((size, size), np.float32) for size in (2 * halves + 1).tolist()]
        waves, points = len(self.weights), len(self.angles)
        made = self.lights.kernels(np.tile(self.angles, waves), np.tile(halves, waves), self.pixel_um, self.recipe)
        shares = np.repeat(np.array(self.weights, np.float32), points)
        for k, (share, kernel) in enumerate(zip(shares, made, strict=True)):
            totals[k % points] += share * kernel
        for total in totals:
            total /= total.sum(dtype=float).astype(np.float32)
        return totals


@dataclass(eq=False)
class Kernels:
    """Kernels of one view, channel and pixel pitch; pupils are cached per height, since points on a circle share them.

    A ``table``, if any, replaces a fit for every height that it covers.
    """

    seen: SensorMap
    colour: Colour
    pixel_um: float
    recipe: Recipe
    half: int | None = None
    table: PupilTable | None = None
    kept: dict[float, list[tuple[Light, float]]] = field(default_factory=dict)

    def at(self, x_mm: float, y_mm: float, half: int | None = None) -> np.ndarray:
        """Return the kernel of the point that lands at (x, y up), (size, size) float32 of unit sum, row 0 the top."""
        half, point = half or self.half, self.points([x_mm], [y_mm])
        return point.kernels(np.array([half]) if half else point.half_widths())[0]

    def points(self, x_mm: ArrayLike, y_mm: ArrayLike) -> "Points":
        """Return the light of points that land at (x, y up), (points,) each."""
        x, y = np.asarray(x_mm, float), np.asarray(y_mm, float)
        lights = self._lights_at(np.hypot(x, y))
        return Points(self.pixel_um, self.colour.weights, np.arctan2(x, y), self.recipe, lights)

    def _lights_at(self, heights_mm: np.ndarray) -> PointLights:
        """Return the light of points at some heights in every wavelength."""
        waves = self.colour.wavelengths_um
        depth = float(vergence(self.seen.depth_mm))
        table = self.table
        if (
            table is not None
            and self.recipe.method != RAYS
            and all(table.covers(height, depth) for height in heights_mm)
        ):
            every = np.repeat(waves, len(heights_mm))
            pupils, shifts_mm = table.at(np.tile(heights_mm, len(waves)), depth, every)
            return PointLights(pupils, shifts_mm * UM_PER_MM)
        by_height = [self.lights(height) for height in heights_mm.tolist()]
        lights, shifts = zip(*(pairs[k] for k in range(len(waves)) for pairs in by_height), strict=True)
        rays = [light for light in lights if isinstance(light, RaySpread)]
        of_waves = [light for light in lights if isinstance(light, FrequencyPupil)]
        return PointLights(rays or stacked(of_waves), np.array(shifts) * UM_PER_MM)

    def pupils(self, height_mm: float) -> list[tuple[FrequencyPupil, float]]:
        """Return (pupil, lateral colour in mm) of every wavelength at one height; none of a recipe of rays."""
        return [(p, shift) for p, shift in self.lights(height_mm) if isinstance(p, FrequencyPupil)]

    def lights(self, height_mm: float) -> list[tuple[Light, float]]:
        """Return (pupil or rays, lateral colour in mm) of every wavelength at one height."""
        key = round(height_mm, 9)
        if key not in self.kept:
            self.kept[key] = [self._light(height_mm, w) for w in self.colour.wavelengths_um]
        return self.kept[key]

    def _light(self, height_mm: float, wavelength_um: float) -> tuple[Light, float]:
        if self.recipe.method == RAYS:
            return _own_rays(self.seen, height_mm, wavelength_um)
        depth = float(vergence(self.seen.depth_mm))
        if self.table is not None and self.table.covers(height_mm, depth):
            pupils, shifts_mm = self.table.at(height_mm, depth, wavelength_um)
            return pupils.one(0), float(shifts_mm[0])
        return own_pupil(self.seen, height_mm, wavelength_um, self.recipe)

    def half_width(self, height_mm: float) -> int:
        """Return how many pixels on either side of the centre hold the whole kernel at this height."""
        return int(self.points([0.0], [height_mm]).half_widths()[0])


def own_pupil(seen: SensorMap, height_mm: float, wavelength_um: float, recipe: Recipe) -> tuple[FrequencyPupil, float]:
    """Return the pupil at one height from its own rays, and its lateral colour in mm; P2SFError names the height."""
    with _at_height(height_mm):
        source = seen.source(height_mm, wavelength_um)
        pupil = pupil_map(seen.lens, source, recipe.method, recipe.numbers, seen.clip)
        return pupil, seen.shift_mm(height_mm, wavelength_um)


def _own_rays(seen: SensorMap, height_mm: float, wavelength_um: float) -> tuple[RaySpread, float]:
    """Return the rays of one height, and its lateral colour in mm; P2SFError names the height."""
    with _at_height(height_mm):
        spread = ray_spread(seen.lens, seen.source(height_mm, wavelength_um), seen.clip)
        return spread, seen.shift_mm(height_mm, wavelength_um)


@contextmanager
def _at_height(height_mm: float) -> Iterator[None]:
    """Name the height in a P2SFError."""
    try:
        yield
    except P2SFError as error:
        raise type(error)(
            "{height:.4g} mm from the axis of the sensor: {error}", height=height_mm, error=error
        ) from error
