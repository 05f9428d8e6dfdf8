"""The kernel of one spectral channel anywhere on the sensor: pupils, rotated, summed over wavelength."""

from dataclasses import dataclass, field, replace
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM, vergence
from p2sf.errors import P2SFError
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.pixels import PixelWindow, half_widths, pixel_kernels, samples_each
from p2sf.pixel_kernels.pupil_stack import PupilStack, stack_pupils
from p2sf.pixel_kernels.pupil_table import PupilTable
from p2sf.pixel_kernels.ray_spread import RaySpread, ray_kernel, ray_spread
from p2sf.pixel_kernels.sensor_points import SensorMap
from p2sf.pupil.seen_mask import mask_seen

RAYS = "rays"  # the method of recipes for kernels from densities of rays


Light: TypeAlias = PupilStack | RaySpread
"""What describes the light of one point: a pupil whose waves are summed, or rays."""


class ChannelLanding(NamedTuple):
    """The axes of a point's light, radians from +y towards +x, and its displacement from its nominal position, mm."""

    angle: float
    across_mm: float
    up_mm: float


@dataclass(frozen=True)
class Recipe:
    """How kernels are computed: method, its numbers (None: as the residual requires), samples per λ/(2NA), margin.

    ``method``: "seidel" or "fitted", whose waves are summed, or "rays", which ignores the other numbers.
    ``margin`` is a fraction of the window's half width, added on either side before the transform and cut off after
    it.
    """

    method: str = "fitted"
    numbers: int | None = None
    fineness: float = 1.0
    margin: float = 0.0


@dataclass(frozen=True)
class Colour:
    """Wavelengths in µm and their shares of a channel's light."""

    wavelengths_um: tuple[float, ...]
    weights: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class PointLights:
    """The light of several points in several wavelengths, (waves · points,), the points of one wavelength together.

    ``lights``: pupils, or rays of each, rotated by ``angles`` from +y towards +x; ``shifts_um``, (waves · points, 2):
    the displacement of each in x and y.
    """

    lights: PupilStack | list[RaySpread]
    angles: np.ndarray
    shifts_um: np.ndarray

    def turned(self, angles: np.ndarray) -> "PointLights":
        """Return the light of these points rotated about the axis, (waves · points,) radians from +y towards +x."""
        (across, along), sine, cosine = self.shifts_um.T, np.sin(angles), np.cos(angles)
        shifts = np.stack([across * cosine + along * sine, along * cosine - across * sine], axis=1)
        return PointLights(self.lights, self.angles + angles, shifts)

    def half_widths(self, pixel_um: float) -> np.ndarray:
        """Return the half width of each kernel in pixels, (waves · points,)."""
        shifts = np.hypot(*self.shifts_um.T)
        if isinstance(self.lights, PupilStack):
            return half_widths(self.lights, pixel_um, shifts)
        pairs = zip(self.lights, shifts, strict=True)
        return np.array([half_widths(light, pixel_um, shift) for light, shift in pairs], int)

    def kernels(self, halves: np.ndarray, pixel_um: float, recipe: Recipe) -> list[np.ndarray]:
        """Return each kernel, (2·half + 1,)² float32."""
        if isinstance(self.lights, PupilStack):
            return wave_kernels(self.lights, self.angles, halves, pixel_um, recipe, self.shifts_um)
        columns = (self.angles.tolist(), halves.tolist(), self.shifts_um.tolist())
        places = zip(self.lights, *columns, strict=True)
        return [ray_kernel(light, angle, half, pixel_um, (x, y)) for light, angle, half, (x, y) in places]


def wave_kernels(
    pupils: PupilStack, angles: np.ndarray, halves: np.ndarray, pixel_um: float, recipe: Recipe, shifts_um: np.ndarray
) -> list[np.ndarray]:
    """Return the kernels of pupils, each (2·half + 1,)² float32; those of equal windows are computed together.

    ``angles`` and ``halves`` (pupils,), ``shifts_um`` (pupils, 2).
    """
    samples = samples_each(pupils, pixel_um, recipe.fineness)
    # The transform is periodic: a pencil wider than the window would wrap around.
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
    """The light of points in all wavelengths of a channel, of these ``weights``, and the recipe of their kernels."""

    pixel_um: float
    weights: tuple[float, ...]
    recipe: Recipe
    lights: PointLights

    def half_widths(self) -> np.ndarray:
        """Return the half width of each point's kernel in pixels, (points,)."""
        halves: np.ndarray = self.lights.half_widths(self.pixel_um).reshape(len(self.weights), -1).max(0)
        return halves

    def kernels(self, halves: np.ndarray) -> list[np.ndarray]:
        """Return each point's kernel of this half width, (2·half + 1,)² float32 of unit sum, row 0 the top."""
        totals = [np.zeros((size, size), np.float32) for size in (2 * halves + 1).tolist()]
        waves, points = len(self.weights), len(halves)
        kernels = self.lights.kernels(np.tile(halves, waves), self.pixel_um, self.recipe)
        shares = np.repeat(np.array(self.weights, np.float32), points)
        for k, (share, kernel) in enumerate(zip(shares, kernels, strict=True)):
            totals[k % points] += share * kernel
        for total in totals:
            total /= total.sum(dtype=float).astype(np.float32)
        return totals


@dataclass(eq=False)
class Kernels:
    """Kernels of one view, channel and pixel pitch; pupils are cached, since points on a circle may share them.

    A ``table``, if any, replaces a fit for every point that it covers.
    """

    seen: SensorMap
    colour: Colour
    pixel_um: float
    recipe: Recipe
    table: PupilTable | None = None
    cache: dict[tuple[float, float], list[tuple[Light, ChannelLanding]]] = field(default_factory=dict)

    def at(self, x_mm: float, y_mm: float, half: int | None = None) -> np.ndarray:
        """Return the kernel of the point that lands at (x, y up), (size, size) float32 of unit sum, row 0 the top."""
        point = self.points([x_mm], [y_mm])
        return point.kernels(np.array([half]) if half else point.half_widths())[0]

    def points(self, x_mm: ArrayLike, y_mm: ArrayLike) -> Points:
        """Return the light of points that land at (x, y up), (points,) each."""
        x, y, angles = self.seen.fields.orient(*np.asarray((x_mm, y_mm), float))
        lights = self._lights_at(x, y).turned(np.tile(angles, len(self.colour.wavelengths_um)))
        return Points(self.pixel_um, self.colour.weights, self.recipe, lights)

    def _lights_at(self, x_mm: np.ndarray, y_mm: np.ndarray) -> PointLights:
        """Return the light of points as given by `Fields.oriented` in every wavelength."""
        waves, table, depth = self.colour.wavelengths_um, self.table, float(vergence(self.seen.depth_mm))
        if table is not None and self.recipe.method != RAYS and table.covers(x_mm, y_mm, depth):
            places = np.tile(x_mm, len(waves)), np.tile(y_mm, len(waves))
            pupils, shifts_mm = table.at(*places, depth, np.repeat(waves, len(x_mm)))
            return PointLights(pupils, np.zeros(len(pupils)), shifts_mm * UM_PER_MM)
        by_place = [self.lights(*place) for place in zip(x_mm.tolist(), y_mm.tolist(), strict=True)]
        lights, landings = zip(*(pairs[k] for k in range(len(waves)) for pairs in by_place), strict=True)
        rays = [light for light in lights if isinstance(light, RaySpread)]
        of_waves = [light for light in lights if isinstance(light, PupilStack)]
        landed = np.array(landings)
        return PointLights(rays or stack_pupils(of_waves), landed[:, 0], landed[:, 1:] * UM_PER_MM)

    def lights(self, x_mm: float, y_mm: float) -> list[tuple[Light, ChannelLanding]]:
        """Return the light of a point in every wavelength, from its own rays."""
        key = round(x_mm, 9), round(y_mm, 9)
        if key not in self.cache:
            waves = self.colour.wavelengths_um
            self.cache[key] = [own_light(self.seen, x_mm, y_mm, wave, self.recipe) for wave in waves]
        return self.cache[key]


def own_light(
    seen: SensorMap, x_mm: float, y_mm: float, wavelength_um: float, recipe: Recipe
) -> tuple[Light, ChannelLanding]:
    """Return the pupil of one point from its own rays, or these; P2SFError states the point."""
    try:
        source = seen.source(x_mm, y_mm, wavelength_um)
        light: Light
        if recipe.method == RAYS:
            light = ray_spread(seen.lens, source, seen.clip)
        else:
            light = pupil_map(seen.lens, source, recipe.method, recipe.numbers, seen.clip)
        light = replace(light, mask=mask_seen(seen.lens, replace(source, azimuth_deg=0.0)))
        return light, ChannelLanding(float(np.deg2rad(source.azimuth_deg)), *seen.shift_mm(x_mm, y_mm, wavelength_um))
    except P2SFError as error:
        height = float(np.hypot(x_mm, y_mm))
        raise type(error)("{height:.4g} mm from the axis of the sensor: {error}", height=height, error=error) from error
