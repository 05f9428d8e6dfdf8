"""Kernels of one lens and scene during planning: pupils from few fits, many kernels at once, each computed once.

No error measured here depends on the tolerance, so that a looser tolerance can only lead to a cheaper choice.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pixel_kernels import Recipe, SensorMap
from p2sf.pixel_kernels.channel import PointLights
from p2sf.pixel_kernels.frequency_grid import ORDERS, fitted_forms, pupils_of, seidel_pupils
from p2sf.pixel_kernels.pupil_stack import PixelPupil, PupilStack, stack_pupils
from p2sf.pixel_kernels.pupil_table import PupilTable, chebyshev, lagrange
from p2sf.pupil.mask_nodes import throughput
from p2sf.raytrace.fit import Level, PencilForms, levels_for
from p2sf.scene.field_area import FieldArea, Point, field_area
from p2sf.scene.planning.field_points import scene_maps
from p2sf.scene.scene import Scene

# Fineness and margin of `Recipe`, cheapest first.
SAMPLINGS = (1.0, 0.0), (1.25, 0.0), (1.5, 0.0), (2.0, 0.0), (2.0, 0.5), (3.0, 0.5), (4.0, 1.0)
# The first for errors that change a kernel as a whole, the second for those that only affect its fringes.
COARSE_SAMPLING, FINE_SAMPLING = SAMPLINGS[0], SAMPLINGS[4]
CONVERGED_WAVES = 3e-4
SCAN, DEPTHS = 65, 5  # depths among which the sharpest are sought, and at which nodes are also tried
SEEN_AT = 0.0, 0.6, 1.0  # fractions of the way to the farthest point at which the sharpest depths are sought

FOCUSED = 4  # depths between which the phase is interpolated in that search
CHIEF_RAYS = 65  # between which fields are interpolated linearly by height, to some 1e-6

Sampling = tuple[float, float]


class Place(NamedTuple):
    """A point of the sensor, mm, one depth and one wavelength."""

    x_mm: float
    y_mm: float
    vergence: float
    wave_um: float


class PupilAt(NamedTuple):
    """A point of a `FieldArea`, mm, one depth and one wavelength."""

    x_mm: float
    y_mm: float
    vergence: float
    wave_um: float


@dataclass(eq=False)
class Study:
    """Kernels of one lens and scene, each computed once; ``check`` may raise before each measurement, to stop.

    ``table``, set by `sharing.share_pupils`, interpolates all pupils from few fits, and ``table_error`` is the relative
    error that this adds to a kernel. ``waves_um``: the shortest, the reference and the longest wavelength.
    """

    lens: Lens
    scene: Scene
    check: Callable[[], None] = lambda: None
    table: PupilTable | None = None
    table_error: float = 0.0

    def __post_init__(self) -> None:
        middle = self.scene.channels[len(self.scene.channels) // 2]
        self.reference_um = float(middle.wavelengths_um @ middle.shares)
        every = [float(wave) for channel in self.scene.channels for wave in channel.wavelengths_um]
        self.waves_um = tuple(sorted({min(every), self.reference_um, max(every)}))
        self.ends = tuple(dict.fromkeys(map(float, self.scene.vergences(2))))  # the far and the near end of the depths
        self.scan = tuple(dict.fromkeys(map(float, self.scene.vergences(DEPTHS))))  # both, and depths between them
        self._maps: dict[float, SensorMap] = {}
        self._fits: dict[PupilAt, tuple[PixelPupil, np.ndarray]] = {}
        self._of_corners: dict[Level, tuple[PencilForms, np.ndarray]] = {}
        self._kernels: dict[tuple[Place, Sampling], np.ndarray] = {}

    @cached_property
    def area(self) -> FieldArea:
        """Return the area of the sensor over which pupils differ."""
        return field_area(self.sensor_map(self.ends[0]).fields, self.scene.sensor)

    def sensor_map(self, vergence: float) -> SensorMap:
        """Return the map from fields to the sensor at one depth, out to the sensor's corner."""
        self.map_depths([vergence])
        return self._maps[vergence]

    def map_depths(self, vergences: Iterable[float]) -> None:
        """Compute the maps of several depths together."""
        missing = [v for v in dict.fromkeys(vergences) if v not in self._maps]
        if missing:
            maps = scene_maps(self.lens, self.scene, missing, self.reference_um, CHIEF_RAYS)
            self._maps.update(zip(missing, maps, strict=True))

    def sharpest(self, wave: float) -> list[float]:
        """Return the vergences of the smallest blur at the fractions SEEN_AT of the field: axis, between, corner."""
        return self._sharpest[wave]

    @cached_property
    def _sharpest(self) -> dict[float, list[float]]:
        """Return the vergence of the least variance of the phase, which is a polynomial in the vergence."""
        scan = self.scene.vergences(SCAN)
        nodes = tuple(chebyshev(float(scan[0]), float(scan[-1]), FOCUSED if len(self.ends) > 1 else 1).tolist())
        points = [self.area.outwards(part) for part in SEEN_AT]
        pupils = [PupilAt(*point, v, wave) for wave in self.waves_um for point in points for v in nodes]
        phase = fitted_forms(self.lens, self._sources(pupils), self.level)[0].phase
        degree, _ = self.level.basis.phase.indices
        between = np.array([lagrange(nodes, v) for v in scan.tolist()])
        phases = between @ phase[:, degree > 1].reshape(len(self.waves_um), len(points), len(nodes), -1)
        least = np.square(phases).sum(-1).argmin(-1)
        return {wave: scan[at].tolist() for wave, at in zip(self.waves_um, least, strict=True)}

    def places(self, wave: float) -> list[Place]:
        """Return points for choices on single pupils: the corner, sharp and at both ends of depth, and the centre.

        At depths between these, errors in the description of a pupil matter less.
        """
        axis, _, corner = self.sharpest(wave)
        found = [self.place(self.area.far, v, wave) for v in (corner, *self.ends)]
        return list(dict.fromkeys((*found, self.place(self.area.near, axis, wave))))

    def place(self, point: Point, vergence: float, wave_um: float) -> Place:
        """Return a point of the sensor with the pupil of a point of the area."""
        return Place(*self.area.fields.oblique(*point), vergence, wave_um)

    def pupil_at(self, place: Place) -> PupilAt:
        """Return the pupil of a point of the sensor."""
        return PupilAt(*self.area.point_of(place.x_mm, place.y_mm), place.vergence, place.wave_um)

    @cached_property
    def level(self) -> Level:
        """Return the smallest fit with a residual below CONVERGED_WAVES at the ends of field, depth and colour."""
        return next((level for level in self.levels if self.residual(level) < CONVERGED_WAVES), self.levels[-1])

    @property
    def levels(self) -> tuple[Level, ...]:
        """Return the sizes of fit, smallest first."""
        return levels_for(self.lens)

    def residual(self, level: Level) -> float:
        """Return the largest RMS phase residual of fits of this size, waves, at the ends of field and depth."""
        share = 1.0 if self.lens.mask.clear else throughput(self.lens.mask).light  # all of it may be in the open part
        return float(self._corner_fits(level)[0].residual_waves.max() / np.sqrt(share))

    def _corner_fits(self, level: Level) -> tuple[PencilForms, np.ndarray]:
        """Return the fits of one size at the ends of field and depth, and the chief rays' points, (n, 2) mm."""
        if level not in self._of_corners:
            self.check()
            self._of_corners[level] = fitted_forms(self.lens, self._sources(self.corners), level)
        return self._of_corners[level]

    @property
    def corners(self) -> list[PupilAt]:
        """Return the pupils at both ends of field and depth at the shortest wavelength, which is the most sensitive."""
        return [PupilAt(*self.area.point_of(*p), v, self.waves_um[0]) for p in self.area.corners for v in self.ends]

    def _sources(self, pupils: Sequence[PupilAt]) -> list[Source]:
        """Return the object points of pupils."""
        self.map_depths(at.vergence for at in pupils)
        return [self._maps[at.vergence].source(at.x_mm, at.y_mm, at.wave_um) for at in pupils]

    def fitted(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils from their own rays, and their displacements from their points, (pupils, 2) mm; cached."""
        missing = [at for at in dict.fromkeys(pupils) if at not in self._fits]
        if missing:
            self.check()
            sources = self._sources(missing)
            known = missing == self.corners
            fits, landed = self._corner_fits(self.level) if known else fitted_forms(self.lens, sources, self.level)
            order = max((pupil.basis.wave_order for pupil, _ in self._fits.values()), default=ORDERS[0])
            made = pupils_of(self.lens, sources, fits, self.level, self.scene.clip, order)
            for k, at in enumerate(missing):
                self._fits[at] = made.one(k), landed[k] - at[:2]
        found = [self._fits[at] for at in pupils]
        return stack_pupils([pupil for pupil, _ in found]), np.array([shift for _, shift in found])

    def by_seidel(self, pupils: Sequence[PupilAt]) -> PupilStack:
        """Return pupils by their Seidel coefficients."""
        return seidel_pupils(self.lens, self._sources(pupils), self.scene.clip)

    def lights(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils as `fitted` does: from the table, or, if there is none yet, from their own rays."""
        if self.table is None:
            return self.fitted(pupils)
        return self.table.at(*zip(*pupils, strict=True))

    def kernels(self, places: Sequence[Place], sampling: Sampling = COARSE_SAMPLING) -> list[np.ndarray]:
        """Return the kernels of places, each computed once."""
        missing = [place for place in dict.fromkeys(places) if (place, sampling) not in self._kernels]
        if missing:
            self.check()
            made = self.rendered(missing, *self.lights([self.pupil_at(place) for place in missing]), sampling)
            self._kernels.update(zip(((place, sampling) for place in missing), made, strict=True))
        return [self._kernels[place, sampling] for place in places]

    def rendered(
        self, places: Sequence[Place], pupils: PupilStack, shifts_mm: np.ndarray, sampling: Sampling = COARSE_SAMPLING
    ) -> list[np.ndarray]:
        """Return the kernels of pupils, one for each place."""
        _, _, angles = self.area.fields.orient(*np.array(places)[:, :2].T)
        lights = PointLights(pupils, 0 * angles, shifts_mm * UM_PER_MM).turned(angles)
        pixel = self.scene.sensor.pixel_um
        return lights.kernels(lights.half_widths(pixel), pixel, Recipe("fitted", None, *sampling))


Tries = Sequence[tuple[int, int]]


def first_allowed(
    count: int, measure: Callable[[Tries], Sequence[float]], places: int, allowed: float, together: int = 4
) -> tuple[int, float]:
    """Return the first of ``count`` choices whose error is allowed at all places, else the last; and its error.

    ``measure`` gives the errors of (choice, index of a point), which decrease from choice to choice. Most choices fail
    where an earlier one did, so that the first that holds there is sought first, from point 0 on, and then tried at all
    points. ``together``: the number of choices tried at once, spread over the remaining ones.
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
    one, two = (pad_kernel(k, size) for k in (kernel, reference))
    return float(np.linalg.norm(one - two) / np.linalg.norm(two))


def pad_kernel(kernel: np.ndarray, size: int) -> np.ndarray:
    """Return a kernel with zeros around it, to an odd size."""
    edge = (size - kernel.shape[-1]) // 2
    if not edge:
        return kernel
    wide = np.zeros((size, size), kernel.dtype)
    wide[edge : size - edge, edge : size - edge] = kernel
    return wide


def weighted_sum(kernels: Sequence[np.ndarray], weights: Sequence[float]) -> np.ndarray:
    """Return a weighted sum of kernels of different sizes."""
    total = np.zeros(2 * [max(kernel.shape[-1] for kernel in kernels)], np.float32)
    for kernel, weight in zip(kernels, weights, strict=True):
        edge = (len(total) - kernel.shape[-1]) // 2
        total[edge : len(total) - edge, edge : len(total) - edge] += np.float32(weight) * kernel
    return total
