"""The error of each choice in a plan, measured on kernels that differ in nothing else.

No error here depends on the tolerance, so a looser tolerance can only stop earlier in a list of choices and never
costs more.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels import Colour, Kernels, Recipe, SensorMap, sensor_map
from p2sf.pixel_kernels.pupil_table import PupilTable
from p2sf.raytrace.fit import fit, levels
from p2sf.scene.scene import Channel, Scene, depth_of
from p2sf.scene.spectrum import reduced

# Fineness and margin of `Recipe`, cheapest first.
SAMPLINGS = (1.0, 0.0), (1.25, 0.0), (1.5, 0.0), (2.0, 0.0), (2.0, 0.5), (3.0, 0.5), (4.0, 1.0)
# The first for errors that change a kernel as a whole, the second for those that only show in its fringes.
COARSE_SAMPLING, FINE_SAMPLING = SAMPLINGS[2], SAMPLINGS[4]
NODE_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49)
DEPTH_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193)
ZONES = 2
CONVERGED_WAVES = 3e-4
SCAN = 65


@dataclass(eq=False)
class Study:
    """Kernels of one lens and scene, each computed once; ``check`` may raise before each measurement, to stop.

    ``tables`` hold the converged pupils by wavelength once `sharing.share_pupils` has found how few need fitting,
    and ``tables_error`` is the relative error that this adds to a kernel.
    """

    lens: Lens
    scene: Scene
    check: Callable[[], None] = lambda: None
    tables: dict[float, PupilTable] = field(default_factory=dict)
    tables_error: float = 0.0

    def __post_init__(self) -> None:
        middle = self.scene.channels[len(self.scene.channels) // 2]
        self.reference_um = float(middle.wavelengths_um @ middle.shares)
        self.nearest_mm, self.farthest_mm = self.scene.sensor.corners_mm()
        self.single = self.colour_of(self.reference_um)
        means = [float(channel.wavelengths_um @ channel.shares) for channel in self.scene.channels]
        self.waves = tuple(sorted({min(means), self.reference_um, max(means)}))
        # What describes a pupil, cheapest first: the method and how many numbers it fits.
        self.methods = (("seidel", None), *(("fitted", level.numbers) for level in levels(self.lens.aim)))
        self._sensor_maps: dict[float, SensorMap] = {}
        self._depths: dict[float, list[float]] = {}
        self._kernels: dict[tuple[Recipe, Colour, float], Kernels] = {}
        self._residuals: dict[tuple[int, float, float, float], float] = {}
        self._arrays: dict[tuple[Recipe, Colour, float, float, float], np.ndarray] = {}

    def sensor_map(self, vergence: float) -> SensorMap:
        """Return where the points of one depth land, out to the sensor's corner."""
        key = round(vergence, 15)
        if key not in self._sensor_maps:
            place = depth_of(vergence), self.reference_um, self.farthest_mm
            self._sensor_maps[key] = sensor_map(self.lens, *place, self.scene.clip)
        return self._sensor_maps[key]

    def heights(self) -> np.ndarray:
        """Return the edges of the zones of the field, mm from the axis."""
        return np.linspace(self.nearest_mm, self.farthest_mm, ZONES + 1)

    def depths(self, wave: float) -> list[float]:
        """Return the vergences at which errors are measured: five over the scene and the sharpest of `sharpest`."""
        if wave not in self._depths:
            scan = self.scene.vergences(SCAN)
            self._depths[wave] = sorted({float(v) for v in (*scan[:: SCAN // 4], *self.sharpest(wave))})
        return self._depths[wave]

    def sharpest(self, wave: float) -> list[float]:
        """Return the vergences of the smallest blur on the axis, at 0.6 of the field and in the corner."""
        scan = self.scene.vergences(SCAN)
        depths = np.array([depth_of(v) for v in scan])[:, None]
        slopes = self.sensor_map(scan[0]).slope(np.array([0.0, 0.6, 1.0]) * self.farthest_mm)
        six = coefficients(self.lens, depths, slopes, wave)
        blur = np.abs(six.wd + six.w40 + six.w20 + six.w22 / 2)
        return [float(v) for v in scan[blur.argmin(0)]]

    def places(self, heights: Iterable[float]) -> list[tuple[float, float, float]]:
        """Return (height, vergence, wavelength) where choices about single pupils are tried: end and sharpest depths.

        At depths between these, what a description of the pupil leaves out shows less.
        """
        ends = self.scene.vergences(2).tolist()
        depths = {wave: sorted({*ends, *self.sharpest(wave)}) for wave in self.waves}
        return [(float(h), v, wave) for wave in self.waves for h in heights for v in depths[wave]]

    def kernels(self, recipe: Recipe, colour: Colour, vergence: float) -> Kernels:
        """Return the kernels of one recipe in one colour at one depth."""
        key = (recipe, colour, round(vergence, 15))
        if key not in self._kernels:
            converged = (recipe.method, recipe.numbers) == self.methods[self.converged_method]
            tables = self.tables if converged else {}
            recipe_at = partial(self._fewest_numbers, recipe) if converged else partial(_same_everywhere, recipe)
            pixel = self.scene.sensor.pixel_um
            self._kernels[key] = Kernels(self.sensor_map(vergence), colour, pixel, recipe_at, tables=tables)
        return self._kernels[key]

    def _fewest_numbers(self, recipe: Recipe, height_mm: float) -> Recipe:
        """Return the converged recipe with the fewest numbers that converge at this height."""
        return recipe if self.tables else replace(recipe, numbers=self.methods[self.converged_at(height_mm)][1])

    @staticmethod
    def colour_of(wave: float) -> Colour:
        """Return one wavelength as a colour."""
        return Colour((wave,), (1.0,))

    @cached_property
    def converged_method(self) -> int:
        """Return the first entry of ``methods`` converged at both ends of field and depth, in the bluest colour."""
        return max(self.converged_at(height) for height in (self.farthest_mm, self.nearest_mm))

    def converged_at(self, height_mm: float) -> int:
        """Return the first of ``methods`` whose fit leaves less than CONVERGED_WAVES at both ends of the depths."""
        self.check()
        ends, wave = {float(v) for v in self.scene.vergences(2)}, min(self.waves)
        for method in range(1, len(self.methods)):
            if all(self.residual(method, height_mm, v, wave) < CONVERGED_WAVES for v in ends):
                return method
        return len(self.methods) - 1

    def recipe(self, sampling: tuple[float, float] = COARSE_SAMPLING) -> Recipe:
        """Return the converged recipe."""
        return Recipe(*self.methods[self.converged_method], *sampling)

    def method_error(self, method: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the relative error of a method's kernel against the converged one, and that one's own."""
        if method >= self.converged_method:
            return from_phase(self.residual(self.converged_method, height_mm, vergence, wave))
        tried = Recipe(*self.methods[method], *FINE_SAMPLING)
        return self.distance(tried, self.recipe(FINE_SAMPLING), height_mm, vergence, wave)

    def residual(self, method: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the RMS phase residual of a fit in waves."""
        key = (method, round(height_mm, 9), round(vergence, 15), wave)
        if key not in self._residuals:
            source = self.sensor_map(vergence).source(height_mm, wave)
            self._residuals[key] = fit(self.lens, source, self.methods[method][1]).residual_waves
        return self._residuals[key]

    def distance(self, tried: Recipe, reference: Recipe, height_mm: float, vergence: float, wave: float) -> float:
        """Return the relative L2 distance of two recipes' kernels at one place."""
        self.check()
        single, at = self.colour_of(wave), oblique(height_mm)
        return distance(*(self.cached_kernel(r, single, vergence, at) for r in (tried, reference)))

    def cached_kernel(self, recipe: Recipe, colour: Colour, vergence: float, at: tuple[float, float]) -> np.ndarray:
        """Return one kernel, computed once."""
        key = (recipe, colour, round(vergence, 15), round(at[0], 9), round(at[1], 9))
        if key not in self._arrays:
            self._arrays[key] = self.kernels(recipe, colour, vergence).at(*at)
        return self._arrays[key]

    def sampling_error(self, number: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the error of an entry of SAMPLINGS against the finest."""
        tried, finest = (self.recipe(SAMPLINGS[n]) for n in (number, -1))
        return self.distance(tried, finest, height_mm, vergence, wave)

    def colour_error(self, channel: Channel, count: int, height_mm: float, vergence: float) -> float:
        """Return the error of fewer wavelengths against all of a channel's."""
        self.check()
        recipe, at = self.recipe(FINE_SAMPLING), oblique(height_mm)  # a coarser one hides the change
        few, every = (reduced(channel, n) for n in (count, len(channel.wavelengths_nm)))
        return distance(*(self.cached_kernel(recipe, c, vergence, at) for c in (few, every))) if few != every else 0.0

    def kernel(self, vergence: float, x_mm: float, y_mm: float, wave: float) -> np.ndarray:
        """Return the kernel in one wavelength by the converged recipe."""
        self.check()
        return self.cached_kernel(self.recipe(), self.colour_of(wave), vergence, (x_mm, y_mm))


def _same_everywhere(recipe: Recipe, height_mm: float) -> Recipe:
    return recipe


def first_allowed(
    count: int, measure: Callable[..., float], places: Iterable[tuple], allowed: float
) -> tuple[int, float]:
    """Return the first number whose error is allowed at all places, else the last below ``count``; and the error.

    The error is the largest of ``measure(number, *place)``. Most numbers fail where the one before did, so that
    place is tried first.
    """
    places = list(places)
    for number in range(count):
        worst = 0.0
        for n, place in enumerate(places):
            worst = max(worst, measure(number, *place))
            if worst > allowed and number < count - 1:
                places.insert(0, places.pop(n))
                break
        else:
            break
    return number, worst


def oblique(height_mm: float) -> tuple[float, float]:
    """Return a point at this height in a direction that no pixel grid shares."""
    return 0.6 * height_mm, 0.8 * height_mm


def from_phase(residual_waves: float) -> float:
    """Return the relative L2 error of a PSF whose phase has an RMS error of σ waves: twice the field's own, 2πσ."""
    return 4 * np.pi * residual_waves


def distance(kernel: np.ndarray, reference: np.ndarray) -> float:
    """Return ‖kernel − reference‖/‖reference‖ of kernels of any two odd sizes."""
    size = max(kernel.shape[-1], reference.shape[-1])
    one, two = (widened(k, size) for k in (kernel, reference))
    return float(np.linalg.norm(one - two) / np.linalg.norm(two))


def widened(kernel: np.ndarray, size: int) -> np.ndarray:
    """Return a kernel with zeros around it, to an odd size."""
    edge = (size - kernel.shape[-1]) // 2
    return np.pad(kernel, edge) if edge else kernel
