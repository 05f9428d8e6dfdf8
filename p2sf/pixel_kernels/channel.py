"""The kernel of one spectral channel anywhere on the sensor: fits along a radius, rotated, summed over wavelength."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import atan2, hypot
from typing import TypeAlias

import numpy as np

from p2sf.conventions import UM_PER_MM, vergence
from p2sf.errors import P2SFError
from p2sf.pixel_kernels.frequency_grid import FrequencyPupil, pupil_map, without
from p2sf.pixel_kernels.pixels import PixelWindow, half_width, pixel_kernel, samples_across
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
    it; ``drop_waves`` is the RMS phase that the omitted terms may have together.
    """

    method: str = "fitted"
    numbers: int | None = None
    fineness: float = 1.0
    margin: float = 0.0
    drop_waves: float = 0.0


@dataclass(frozen=True)
class Colour:
    """Wavelengths in µm and the share of a channel's light that each one carries."""

    wavelengths_um: tuple[float, ...]
    weights: tuple[float, ...]


@dataclass(eq=False)
class Kernels:
    """Kernels of one view, channel and pixel pitch; pupils are cached per height, since points on a circle share them.

    ``recipe_at(height_mm)`` may choose a cheaper method where it is accurate enough; ``tables`` by wavelength, if
    any, replace a fit for every height.
    """

    seen: SensorMap
    colour: Colour
    pixel_um: float
    recipe_at: Callable[[float], Recipe]
    half: int | None = None
    tables: Mapping[float, PupilTable] = field(default_factory=dict)
    kept: dict[float, list[tuple[Light, float]]] = field(default_factory=dict)

    def at(self, x_mm: float, y_mm: float, half: int | None = None) -> np.ndarray:
        """Return the kernel of the point that lands at (x, y up), (size, size) float32 of unit sum, row 0 the top."""
        height, angle = hypot(x_mm, y_mm), atan2(x_mm, y_mm)
        lights = self.lights(height)
        half = half or self.half or self.half_width(height)
        size = 2 * half + 1
        total = np.zeros((size, size), np.float32)
        for weight, (pupil, shift_mm) in zip(self.colour.weights, lights, strict=True):
            shift = shift_mm * UM_PER_MM * np.sin(angle), shift_mm * UM_PER_MM * np.cos(angle)
            total += np.float32(weight) * self._one(pupil, angle, half, shift, self.recipe_at(height))
        total /= total.sum(dtype=float).astype(np.float32)
        return total

    def _one(self, pupil: Light, angle: float, half: int, shift: tuple[float, float], recipe: Recipe) -> np.ndarray:
        """Return the kernel of one wavelength, (2·half + 1,)²."""
        if isinstance(pupil, RaySpread):
            return ray_kernel(pupil, angle, half, self.pixel_um, shift)
        samples = samples_across(pupil, self.pixel_um, recipe.fineness)
        # The transform is periodic: a pencil wider than the window would wrap around to its other side.
        need = half_width(pupil, self.pixel_um, hypot(*shift))
        wide = max(half, need) + int(np.ceil(recipe.margin * half))
        kernel = pixel_kernel(pupil, angle, PixelWindow(wide, self.pixel_um, samples), shift)
        cut = wide - half
        return kernel[cut : kernel.shape[0] - cut, cut : kernel.shape[1] - cut] if cut else kernel

    def pupils(self, height_mm: float) -> list[tuple[FrequencyPupil, float]]:
        """Return (pupil, lateral colour in mm) of every wavelength at one height; none of a recipe of rays."""
        return [(p, shift) for p, shift in self.lights(height_mm) if isinstance(p, FrequencyPupil)]

    def lights(self, height_mm: float) -> list[tuple[Light, float]]:
        """Return (pupil or rays, lateral colour in mm) of every wavelength at one height."""
        key = round(height_mm, 9)
        if key not in self.kept:
            recipe = self.recipe_at(height_mm)
            self.kept[key] = [self._light(height_mm, w, recipe) for w in self.colour.wavelengths_um]
        return self.kept[key]

    def _light(self, height_mm: float, wavelength_um: float, recipe: Recipe) -> tuple[Light, float]:
        if recipe.method == RAYS:
            return _own_rays(self.seen, height_mm, wavelength_um)
        table = self.tables.get(wavelength_um)
        found = table.at(height_mm, float(vergence(self.seen.depth_mm))) if table else None
        pupil, shift = found or own_pupil(self.seen, height_mm, wavelength_um, recipe)
        return (without(pupil, recipe.drop_waves) if recipe.drop_waves else pupil), shift

    def half_width(self, height_mm: float) -> int:
        """Return how many pixels on either side of the centre hold the whole kernel at this height."""
        return max(half_width(p, self.pixel_um, abs(s) * UM_PER_MM) for p, s in self.lights(height_mm))


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
