"""Measuring what a decision would cost in accuracy, by kernels that differ in nothing else.

No estimate here depends on the tolerance, so that a looser one can only stop earlier in a list and never costs more.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels import Colour, Kernels, Recipe, SensorMap, sensor_map
from p2sf.pixel_kernels.pupil_table import PupilTable
from p2sf.raytrace.fit import LEVELS, fit
from p2sf.scene.scene import Scene, depth_of
from p2sf.scene.spectrum import reduced

RUNGS = (("seidel", None), *(("fitted", level.numbers) for level in LEVELS))
# Fineness and margin of `Recipe`, cheapest first.
SAMPLINGS = (1.0, 0.0), (1.25, 0.0), (1.5, 0.0), (2.0, 0.0), (2.0, 0.5), (3.0, 0.5), (4.0, 1.0)
PLAIN, SHARP = SAMPLINGS[2], SAMPLINGS[4]  # for changes of whole kernels, and for those that fringes show
NODE_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49)
DEPTH_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193)
RINGS = 2
CONVERGED_WAVES = 3e-4
SCAN = 65


@dataclass(eq=False)
class Study:
    """Kernels of one lens and scene, made once each; ``check`` may raise before each measurement.

    ``tables`` hold the converged pupils by wavelength once `sharing.share_pupils` has found how few need fitting,
    and ``tables_error`` what that changes a kernel by.
    """

    lens: Lens
    scene: Scene
    check: Callable[[], None] = lambda: None
    made: dict = field(default_factory=dict)
    tables: dict[float, PupilTable] = field(default_factory=dict)
    tables_error: float = 0.0

    def __post_init__(self):
        middle = self.scene.channels[len(self.scene.channels) // 2]
        self.reference_um = float(middle.wavelengths_um @ middle.shares)
        self.nearest_mm, self.farthest_mm = self.scene.sensor.corners_mm()
        self.single = self.colour_of(self.reference_um)
        middles = [float(channel.wavelengths_um @ channel.shares) for channel in self.scene.channels]
        self.waves = tuple(sorted({min(middles), self.reference_um, max(middles)}))

    def seen(self, vergence: float) -> SensorMap:
        """Return the view of one depth out to the sensor's corner."""
        key = ("view", round(vergence, 15))
        if key not in self.made:
            self.made[key] = sensor_map(self.lens, depth_of(vergence), self.reference_um, self.farthest_mm)
        return self.made[key]

    def heights(self) -> np.ndarray:
        """Return the rims of the rings, mm from the axis."""
        return np.linspace(self.nearest_mm, self.farthest_mm, RINGS + 1)

    def depths(self, wave: float) -> list[float]:
        """Return the vergences at which decisions are tried: five over the scene and the sharpest, on axis and off."""
        if ("depths", wave) not in self.made:
            scan = self.scene.vergences(SCAN)
            found = {float(v) for v in (*scan[:: SCAN // 4], *self.sharpest(wave))}
            self.made["depths", wave] = sorted(found)
        return self.made["depths", wave]

    def sharpest(self, wave: float) -> list[float]:
        """Return the vergences of the smallest blur on the axis, at 0.6 of the field and in the corner."""
        scan = self.scene.vergences(SCAN)
        depths = np.array([depth_of(v) for v in scan])[:, None]
        slopes = self.seen(scan[0]).slope(np.array([0.0, 0.6, 1.0]) * self.farthest_mm)
        six = coefficients(self.lens, depths, slopes, wave)
        blur = np.abs(six.wd + six.w40 + six.w20 + six.w22 / 2)
        return [float(v) for v in scan[blur.argmin(0)]]

    def places(self, heights) -> list[tuple[float, float, float]]:
        """Return (height, vergence, wavelength) at which a pupil's own decisions are tried: extreme depths and colours.

        Between the sharpest depth and the ends what a pupil leaves out shows less than at one of these.
        """
        ends = self.scene.vergences(2).tolist()
        depths = {wave: sorted({*ends, *self.sharpest(wave)}) for wave in self.waves}
        return [(float(h), v, wave) for wave in self.waves for h in heights for v in depths[wave]]

    def kernels(self, recipe: Recipe, colour: Colour, vergence: float) -> Kernels:
        """Return the kernels of one way of making them."""
        key = (recipe, colour, round(vergence, 15))
        if key not in self.made:
            good = (recipe.method, recipe.numbers) == RUNGS[self.top]
            tables, recipe_at = (self.tables, partial(self._enough, recipe)) if good else ({}, lambda height: recipe)
            pixel = self.scene.sensor.pixel_um
            self.made[key] = Kernels(self.seen(vergence), colour, pixel, recipe_at, tables=tables)
        return self.made[key]

    def _enough(self, recipe: Recipe, height_mm: float) -> Recipe:
        """Return the converged recipe with no more numbers than converge at this height."""
        return recipe if self.tables else replace(recipe, numbers=RUNGS[self.method_at(height_mm)][1])

    @staticmethod
    def colour_of(wave: float) -> Colour:
        """Return one wavelength as a colour."""
        return Colour((wave,), (1.0,))

    @cached_property
    def top(self) -> int:
        """Return the first method that is converged at both ends of field and depth, in the colour that asks most."""
        return max(self.method_at(height) for height in (self.farthest_mm, self.nearest_mm))

    def method_at(self, height_mm: float) -> int:
        """Return the first method whose fit leaves next to nothing of the phase at both ends of the depths."""
        self.check()
        ends, wave = {float(v) for v in self.scene.vergences(2)}, min(self.waves)
        good = (
            n for n in range(1, len(RUNGS)) if all(self.residual(n, height_mm, v, wave) < CONVERGED_WAVES for v in ends)
        )
        return next(good, len(RUNGS) - 1)

    def recipe(self, sampling=PLAIN) -> Recipe:
        """Return the converged recipe."""
        return Recipe(*RUNGS[self.top], *sampling)

    def method_error(self, method: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the relative error of a method's kernel against the converged one, and that one's own."""
        if method >= self.top:
            return from_phase(self.residual(self.top, height_mm, vergence, wave))
        tried = Recipe(*RUNGS[method], *SHARP)
        return self.distance(tried, self.recipe(SHARP), height_mm, vergence, wave)

    def residual(self, method: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the phase residual of a fit in waves."""
        key = ("residual", method, round(height_mm, 9), round(vergence, 15), wave)
        if key not in self.made:
            source = self.seen(vergence).source(height_mm, wave)
            self.made[key] = fit(self.lens, source, RUNGS[method][1]).residual_waves
        return self.made[key]

    def distance(self, tried: Recipe, good: Recipe, height_mm: float, vergence: float, wave: float) -> float:
        """Return the relative L2 distance of two recipes' kernels at one place."""
        self.check()
        single, at = self.colour_of(wave), oblique(height_mm)
        return distance(*(self.kept(r, single, vergence, at) for r in (tried, good)))

    def kept(self, recipe: Recipe, colour: Colour, vergence: float, at: tuple[float, float]) -> np.ndarray:
        """Return one kernel, made once."""
        key = (recipe, colour, round(vergence, 15), round(at[0], 9), round(at[1], 9))
        if key not in self.made:
            self.made[key] = self.kernels(recipe, colour, vergence).at(*at)
        return self.made[key]

    def sampling_error(self, number: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the error of a sampling against the finest."""
        tried, good = (self.recipe(SAMPLINGS[n]) for n in (number, -1))
        return self.distance(tried, good, height_mm, vergence, wave)

    def colour_error(self, channel, count: int, height_mm: float, vergence: float) -> float:
        """Return the error of fewer wavelengths against all of a channel's."""
        self.check()
        recipe, at = self.recipe(SHARP), oblique(height_mm)  # a coarser one hides the change
        few, every = (reduced(channel, n) for n in (count, len(channel.wavelengths_nm)))
        return distance(*(self.kept(recipe, c, vergence, at) for c in (few, every))) if few != every else 0.0

    def plain(self, vergence: float, x_mm: float, y_mm: float, wave: float) -> np.ndarray:
        """Return the kernel in one wavelength by the converged recipe."""
        self.check()
        return self.kept(self.recipe(), self.colour_of(wave), vergence, (x_mm, y_mm))


def least(count: int, measure: Callable[..., float], places: Iterable[tuple], allowed: float) -> tuple[int, float]:
    """Return the first number whose error is allowed at all places, else the last below ``count``; and the error.

    The error is the largest of ``measure(number, *place)``. Most numbers fail where the one before did, so that
    place is asked first.
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
    """Return the relative L2 error of a PSF whose phase is wrong by this RMS: twice 2πσ, the field's own error."""
    return 4 * np.pi * residual_waves


def distance(kernel: np.ndarray, good: np.ndarray) -> float:
    """Return ‖kernel − good‖/‖good‖ of kernels of any two odd sizes."""
    size = max(kernel.shape[-1], good.shape[-1])
    one, two = (widened(k, size) for k in (kernel, good))
    return float(np.linalg.norm(one - two) / np.linalg.norm(two))


def widened(kernel: np.ndarray, size: int) -> np.ndarray:
    """Return a kernel with zeros around it, to an odd size."""
    edge = (size - kernel.shape[-1]) // 2
    return np.pad(kernel, edge) if edge else kernel
