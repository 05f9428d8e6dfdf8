"""Kernels of one lens and scene while a plan is made: pupils from few fits, many kernels at once, each computed once.

No error measured here depends on the tolerance, so that a looser tolerance can only take a cheaper choice.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from math import hypot
from typing import NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM, depth_of
from p2sf.lens.lens import Lens
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels import Recipe, SensorMap, sensor_maps
from p2sf.pixel_kernels.channel import wave_kernels
from p2sf.pixel_kernels.frequency_grid import ORDERS, fitted_forms, pupils_of, seidel_pupils
from p2sf.pixel_kernels.pixels import half_widths
from p2sf.pixel_kernels.pupil_stack import FrequencyPupil, PupilStack, stacked
from p2sf.pixel_kernels.pupil_table import PupilTable
from p2sf.pupil.mask_nodes import throughput
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.fit import Level, PencilForms, levels
from p2sf.scene.scene import Scene

# Fineness and margin of `Recipe`, cheapest first.
SAMPLINGS = (1.0, 0.0), (1.25, 0.0), (1.5, 0.0), (2.0, 0.0), (2.0, 0.5), (3.0, 0.5), (4.0, 1.0)
# The first for errors that change a kernel as a whole, the second for those that only show in its fringes.
COARSE_SAMPLING, FINE_SAMPLING = SAMPLINGS[0], SAMPLINGS[4]
CONVERGED_WAVES = 3e-4
SCAN, DEPTHS = 65, 5  # depths among which the sharpest are sought, and at which nodes are tried besides
SEEN_AT = 0.0, 0.6, 1.0  # of the farthest height: where the sharpest depths are sought

CHIEF_RAYS = 65  # between which fields are found by height: linearly to some 1e-6
DIGITS = 12  # of heights in mm, so that the same height is one pupil however it was computed

Sampling = tuple[float, float]


class Place(NamedTuple):
    """A point of the sensor, mm, one depth and one wavelength."""

    x_mm: float
    y_mm: float
    vergence: float
    wave_um: float


class PupilAt(NamedTuple):
    """A height on the sensor, mm, one depth and one wavelength: all points of a circle share their pupil."""

    height_mm: float
    vergence: float
    wave_um: float


@dataclass(eq=False)
class Study:
    """Kernels of one lens and scene, each computed once; ``check`` may raise before each measurement, to stop.

    ``table``, once `sharing.share_pupils` has found how few pupils need fitting, gives all others, and
    ``table_error`` is the relative error that this adds to a kernel. ``waves_um``: the shortest, the reference and the
    longest wavelength.
    """

    lens: Lens
    scene: Scene
    check: Callable[[], None] = lambda: None
    table: PupilTable | None = None
    table_error: float = 0.0

    def __post_init__(self) -> None:
        middle = self.scene.channels[len(self.scene.channels) // 2]
        self.reference_um = float(middle.wavelengths_um @ middle.shares)
        self.nearest_mm, self.farthest_mm = self.scene.sensor.corners_mm()
        every = [float(wave) for channel in self.scene.channels for wave in channel.wavelengths_um]
        self.waves_um = tuple(sorted({min(every), self.reference_um, max(every)}))
        self.ends = tuple(dict.fromkeys(map(float, self.scene.vergences(2))))  # the far and the near end of the depths
        self.scan = tuple(dict.fromkeys(map(float, self.scene.vergences(DEPTHS))))  # both, and depths between them
        self._maps: dict[float, SensorMap] = {}
        self._fits: dict[PupilAt, tuple[FrequencyPupil, float]] = {}
        self._of_corners: dict[Level, tuple[PencilForms, np.ndarray]] = {}
        self._kernels: dict[tuple[Place, Sampling], np.ndarray] = {}

    def sensor_map(self, vergence: float) -> SensorMap:
        """Return where the points of one depth land, out to the sensor's corner."""
        self.map_depths([vergence])
        return self._maps[vergence]

    def map_depths(self, vergences: Iterable[float]) -> None:
        """Compute the maps of several depths together."""
        missing = [v for v in dict.fromkeys(vergences) if v not in self._maps]
        if missing:
            depths = [depth_of(v) for v in missing]
            found = sensor_maps(self.lens, depths, self.reference_um, self.farthest_mm, self.scene.clip, CHIEF_RAYS)
            self._maps.update(zip(missing, found, strict=True))

    def sharpest(self, wave: float) -> list[float]:
        """Return the vergences of the smallest blur at SEEN_AT of the field: on the axis, between, in the corner."""
        return self._sharpest[wave]

    @cached_property
    def _sharpest(self) -> dict[float, list[float]]:
        scan = self.scene.vergences(SCAN)
        depths = np.array([depth_of(v) for v in scan])[:, None, None]
        slopes = np.asarray(self.sensor_map(self.ends[0]).slope(np.array(SEEN_AT) * self.farthest_mm))
        six = coefficients(self.lens, depths, slopes[:, None], np.array(self.waves_um))
        blur = np.abs(six.wd + six.w40 + six.w20 + six.w22 / 2)
        return {wave: scan[at].tolist() for wave, at in zip(self.waves_um, blur.argmin(0).T, strict=True)}

    def places(self, wave: float) -> list[Place]:
        """Return where choices on single pupils are tried: the corner, sharp and at both ends of depth, and the axis.

        At depths between these, what a description of the pupil leaves out shows less.
        """
        axis, _, corner = self.sharpest(wave)
        found = [self.oblique(self.farthest_mm, v, wave) for v in (corner, *self.ends)]
        return list(dict.fromkeys((*found, self.oblique(self.nearest_mm, axis, wave))))

    def oblique(self, height_mm: float, vergence: float, wave_um: float) -> Place:
        """Return a place at this height in a direction that no pixel grid shares."""
        return Place(0.6 * height_mm, 0.8 * height_mm, vergence, wave_um)

    @cached_property
    def level(self) -> Level:
        """Return the first size of fit that leaves less than CONVERGED_WAVES at the ends of field, depth and colour."""
        return next((level for level in self.levels if self.residual(level) < CONVERGED_WAVES), self.levels[-1])

    @property
    def levels(self) -> tuple[Level, ...]:
        """Return the sizes of fit, smallest first."""
        return levels(self.lens.aim)

    def residual(self, level: Level) -> float:
        """Return the largest RMS phase residual of fits of this size, waves, at the ends of field and depth."""
        share = 1.0 if self.lens.mask.clear else throughput(self.lens.mask).light  # all of it may be where that is open
        return float(self._corner_fits(level)[0].residual_waves.max() / np.sqrt(share))

    def _corner_fits(self, level: Level) -> tuple[PencilForms, np.ndarray]:
        """Return the fits of one size at the ends of field and depth, and where their chief rays land, mm."""
        if level not in self._of_corners:
            self.check()
            self._of_corners[level] = fitted_forms(self.lens, self._sources(self.corners), level)
        return self._of_corners[level]

    @property
    def corners(self) -> list[PupilAt]:
        """Return the pupils at both ends of field and depth in the shortest wavelength, which shows most."""
        return [
            PupilAt(round(h, DIGITS), v, self.waves_um[0])
            for h in (self.farthest_mm, self.nearest_mm)
            for v in self.ends
        ]

    def _sources(self, pupils: Sequence[PupilAt]) -> Sources:
        """Return the object points of pupils; those of one depth and colour, which share a map, next to each other."""
        self.map_depths(at.vergence for at in pupils)
        slopes = np.empty(len(pupils))
        for (vergence, wave), group in groupby(range(len(pupils)), lambda k: pupils[k][1:]):
            here = list(group)
            slopes[here] = self._maps[vergence].slopes_at(np.array([pupils[k].height_mm for k in here]), wave)
        depths, waves = (
            np.array(column) for column in zip(*((depth_of(at.vergence), at.wave_um) for at in pupils), strict=True)
        )
        return Sources(depths, slopes, waves)

    def fitted(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils from their own rays, and their lateral colour in mm, (pupils,); each is fitted once."""
        missing = [at for at in dict.fromkeys(pupils) if at not in self._fits]
        if missing:
            self.check()
            sources = self._sources(missing)
            known = missing == self.corners
            fits, landed = self._corner_fits(self.level) if known else fitted_forms(self.lens, sources, self.level)
            order = max((pupil.order for pupil, _ in self._fits.values()), default=ORDERS[0])
            made = pupils_of(self.lens, sources, fits, self.level, self.scene.clip, order)
            for k, at in enumerate(missing):
                self._fits[at] = made.one(k), float(landed[k]) - at.height_mm
        found = [self._fits[at] for at in pupils]
        return stacked([pupil for pupil, _ in found]), np.array([shift for _, shift in found])

    def by_seidel(self, pupils: Sequence[PupilAt]) -> PupilStack:
        """Return pupils by their Seidel coefficients."""
        return seidel_pupils(self.lens, self._sources(pupils), self.scene.clip)

    def lights(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils and their lateral colour in mm, (pupils,): from the table, or while there is none fitted."""
        if self.table is None:
            return self.fitted(pupils)
        return self.table.at(*zip(*pupils, strict=True))

    def kernels(self, places: Sequence[Place], sampling: Sampling = COARSE_SAMPLING) -> list[np.ndarray]:
        """Return the kernels of places, each computed once."""
        missing = [place for place in dict.fromkeys(places) if (place, sampling) not in self._kernels]
        if missing:
            self.check()
            made = self.made(missing, sampling)
            self._kernels.update(zip(((place, sampling) for place in missing), made, strict=True))
        return [self._kernels[place, sampling] for place in places]

    def made(self, places: Sequence[Place], sampling: Sampling) -> list[np.ndarray]:
        """Return the kernels of places."""
        return self.rendered(places, *self.lights([pupil_at(place) for place in places]), sampling)

    def rendered(
        self, places: Sequence[Place], pupils: PupilStack, shifts_mm: np.ndarray, sampling: Sampling = COARSE_SAMPLING
    ) -> list[np.ndarray]:
        """Return the kernels of pupils, one for each place."""
        x, y, pixel, shifts = *np.array(places)[:, :2].T, self.scene.sensor.pixel_um, shifts_mm * UM_PER_MM
        angles, halves = np.arctan2(x, y), half_widths(pupils, pixel, shifts)
        along = shifts[:, None] * np.stack([np.sin(angles), np.cos(angles)], axis=1)
        return wave_kernels(pupils, angles, halves, pixel, Recipe("fitted", None, *sampling), along)


def pupil_at(place: Place) -> PupilAt:
    """Return the pupil of a place."""
    return PupilAt(round(hypot(place.x_mm, place.y_mm), DIGITS), place.vergence, place.wave_um)


Tries = Sequence[tuple[int, int]]


def first_allowed(
    count: int, measure: Callable[[Tries], Sequence[float]], places: int, allowed: float, together: int = 4
) -> tuple[int, float]:
    """Return the first of ``count`` choices whose error is allowed at all places, else the last; and its error.

    ``measure`` gives the errors of (choice, number of a place), which fall from choice to choice. Most choices fail
    where one before did, so that the first that holds there is sought first, from place 0 on, and then tried at all.
    ``together``: how many choices are tried at once, spread over those left.
    """
    low, hardest = 0, 0
    while True:
        high = count - 1
        while low < high:
            tried = sorted({low + (high - low) * part // together for part in range(together)})
            errors = measure([(choice, hardest) for choice in tried])
            held = [error <= allowed for error in errors]
            first = held.index(True) if any(held) else len(tried)
            low, high = (tried[first - 1] + 1 if first else low), (tried[first] if any(held) else high)
        errors = measure([(low, place) for place in range(places)])
        worst = float(max(errors))
        if worst <= allowed or low == count - 1:
            return low, worst
        low, hardest = low + 1, int(np.argmax(errors))


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
    if not edge:
        return kernel
    wide = np.zeros((size, size), kernel.dtype)
    wide[edge : size - edge, edge : size - edge] = kernel
    return wide


def weighted(kernels: Sequence[np.ndarray], weights: Sequence[float]) -> np.ndarray:
    """Return a weighted sum of kernels of different sizes."""
    total = np.zeros(2 * [max(kernel.shape[-1] for kernel in kernels)], np.float32)
    for kernel, weight in zip(kernels, weights, strict=True):
        edge = (len(total) - kernel.shape[-1]) // 2
        total[edge : len(total) - edge, edge : len(total) - edge] += np.float32(weight) * kernel
    return total
