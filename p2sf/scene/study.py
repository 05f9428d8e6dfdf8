"""Measuring what a decision would cost in accuracy, by kernels that differ in nothing else.

No estimate here depends on the tolerance, so that a looser one can only stop earlier in a list and never costs more.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from p2sf.kernels import Colour, Kernels, Recipe, View, view
from p2sf.lens import Lens
from p2sf.rayfit import LEVELS, fit
from p2sf.scene.scene import Scene, depth_of
from p2sf.scene.spectrum import reduced
from p2sf.seidel import coefficients

RUNGS = (("seidel", None), *(("fitted", level.numbers) for level in LEVELS))
SAMPLINGS = ((1.0, 0.0), (1.0, 0.5), (1.5, 0.5), (2.0, 0.5), (3.0, 0.5), (4.0, 1.0))  # fineness and margin of `Recipe`
NODE_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49)
DEPTH_COUNTS = (1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193)
RINGS = 4
CONVERGED_WAVES = 3e-4
SCAN = 65


@dataclass(eq=False)
class Study:
    """Kernels of one lens and scene, made once each; ``check`` may raise before each measurement."""

    lens: Lens
    scene: Scene
    check: Callable[[], None] = lambda: None
    made: dict = field(default_factory=dict)

    def __post_init__(self):
        middle = self.scene.channels[len(self.scene.channels) // 2]
        self.reference_um = float(middle.wavelengths_um @ middle.shares)
        self.nearest_mm, self.farthest_mm = self.scene.sensor.corners_mm()
        self.single = self.colour_of(self.reference_um)
        middles = [float(channel.wavelengths_um @ channel.shares) for channel in self.scene.channels]
        self.waves = tuple(sorted({min(middles), self.reference_um, max(middles)}))
        self.levels: dict = {}

    def seen(self, vergence: float) -> View:
        """Return the view of one depth out to the sensor's corner."""
        key = ("view", round(vergence, 15))
        if key not in self.made:
            self.made[key] = view(self.lens, depth_of(vergence), self.reference_um, self.farthest_mm)
        return self.made[key]

    def heights(self) -> np.ndarray:
        """Return the rims of the rings, mm from the axis."""
        return np.linspace(self.nearest_mm, self.farthest_mm, RINGS + 1)

    def depths(self, wave: float) -> list[float]:
        """Return the vergences at which decisions are tried: five over the scene and the sharpest, on axis and off."""
        scan = self.scene.vergences(SCAN)
        depths = np.array([depth_of(v) for v in scan])[:, None]
        slopes = self.seen(scan[0]).slope(np.array([0.0, 0.6, 1.0]) * self.farthest_mm)
        six = coefficients(self.lens, depths, slopes, wave)
        blur = np.abs(six.wd + six.w40 + six.w20 + six.w22 / 2)
        return sorted({float(v) for v in (*scan[:: SCAN // 4], *scan[blur.argmin(0)])})

    def places(self, heights) -> list[tuple[float, float, float]]:
        """Return (height, vergence, wavelength) at which a decision is tried: every depth and the extreme colours."""
        return [(float(h), v, wave) for wave in self.waves for h in heights for v in self.depths(wave)]

    def kernels(self, recipe: Recipe, colour: Colour, vergence: float) -> Kernels:
        """Return the kernels of one way of making them."""
        key = (recipe, colour, round(vergence, 15))
        if key not in self.made:
            self.made[key] = Kernels(self.seen(vergence), colour, self.scene.sensor.pixel_um, lambda height: recipe)
        return self.made[key]

    @staticmethod
    def colour_of(wave: float) -> Colour:
        """Return one wavelength as a colour."""
        return Colour((wave,), (1.0,))

    def best(self, height_mm: float, vergence: float, wave: float) -> int:
        """Return the first rung whose residual is converged here, or the last."""
        self.check()
        key = (round(height_mm, 9), round(vergence, 15), wave)
        if key not in self.levels:
            source = self.seen(vergence).source(height_mm, wave)
            good = (
                n for n in range(1, len(RUNGS)) if fit(self.lens, source, RUNGS[n][1]).residual_waves < CONVERGED_WAVES
            )
            self.levels[key] = next(good, len(RUNGS) - 1)
        return self.levels[key]

    def recipe(self, height_mm: float, vergence: float, wave: float, sampling=SAMPLINGS[1]) -> Recipe:
        """Return the converged recipe at one place."""
        return Recipe(*RUNGS[self.best(height_mm, vergence, wave)], *sampling)

    def rung_error(self, rung: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the relative error of a rung's kernel against the converged one, and that one's own."""
        best = self.best(height_mm, vergence, wave)
        left = self.residual(min(rung, best), height_mm, vergence, wave) if rung else 0.0
        if rung >= best:
            return from_phase(left)
        good, tried = (Recipe(*RUNGS[n], *SAMPLINGS[3]) for n in (best, rung))
        return self.distance(tried, good, height_mm, vergence, wave)

    def residual(self, rung: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the phase residual of a fit in waves."""
        source = self.seen(vergence).source(height_mm, wave)
        return fit(self.lens, source, RUNGS[rung][1]).residual_waves

    def distance(self, tried: Recipe, good: Recipe, height_mm: float, vergence: float, wave: float) -> float:
        """Return the relative L2 distance of two recipes' kernels at one place."""
        single = self.colour_of(wave)
        one, two = (self.kernels(r, single, vergence).at(*oblique(height_mm)) for r in (tried, good))
        return distance(one, two)

    def sampling_error(self, number: int, height_mm: float, vergence: float, wave: float) -> float:
        """Return the error of a sampling against the finest."""
        tried, good = (self.recipe(height_mm, vergence, wave, SAMPLINGS[n]) for n in (number, -1))
        return self.distance(tried, good, height_mm, vergence, wave)

    def colour_error(self, channel, count: int, height_mm: float, vergence: float) -> float:
        """Return the error of fewer wavelengths against all of a channel's."""
        recipe = self.recipe(height_mm, vergence, self.reference_um, SAMPLINGS[3])  # a coarser one hides the change
        few, every = (reduced(channel, n) for n in (count, len(channel.wavelengths_nm)))
        return distance(*(self.kernels(recipe, c, vergence).at(*oblique(height_mm)) for c in (few, every)))

    def plain(self, vergence: float, x_mm: float, y_mm: float, wave: float) -> np.ndarray:
        """Return the kernel in one wavelength by one converged recipe for the whole field."""
        recipe = self.recipe(self.farthest_mm, vergence, wave)
        key = ("kernel", round(vergence, 15), round(x_mm, 9), round(y_mm, 9), wave)
        if key not in self.made:
            self.made[key] = self.kernels(recipe, self.colour_of(wave), vergence).at(x_mm, y_mm)
        return self.made[key]


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
