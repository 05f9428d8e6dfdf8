"""Kernels of one lens and scene during planning: pupils from few fits, many kernels at once, each computed once.

No error measured here depends on the tolerance, so that a looser tolerance can only lead to a cheaper choice.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from math import ceil
from typing import NamedTuple

import numpy as np

from p2sf.choice import first_within
from p2sf.conventions import UM_PER_MM
from p2sf.disc.mask_nodes import throughput
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pixel_kernels.channel import Colour, PointLights
from p2sf.pixel_kernels.frequency_grid import Fits, fits_of, pupils_of
from p2sf.pixel_kernels.pixels import PixelWindow, half_widths, pixel_kernels, samples_each
from p2sf.pixel_kernels.pupil_stack import PupilStack, with_reach
from p2sf.pixel_kernels.pupil_table import PupilTable, chebyshev, lagrange
from p2sf.pixel_kernels.sensor_points import SensorMap
from p2sf.pupil.fit import Level, levels_for
from p2sf.scene.field_area import FieldArea, Point, field_area
from p2sf.scene.planning.adaptive_table import KnownPupils, PupilAt, kernel_errors
from p2sf.scene.planning.field_points import scene_maps
from p2sf.scene.planning.lens_pupils import LensPupils, lens_pupils
from p2sf.scene.scene import Scene

SAMPLINGS = (1.25, 0.0), (1.5, 0.0), (1.5, 0.5), (2.0, 1.0)  # fineness and margin of `Recipe`, cheapest first
SAMPLING_ERRORS = 0.019, 0.009, 0.0035, 0.002  # of kernels by these: 95 in 100 have smaller ones, also behind masks
# The first for errors that change a kernel as a whole, the second for those that only affect its fringes.
COARSE_SAMPLING, FINE_SAMPLING = (1.0, 0.0), SAMPLINGS[1]
CONVERGED_WAVES = 3e-4
AGREES = 0.07  # of the tolerance: the largest error of a kernel by pupils that were kept
COARSE_REACH = 8, 16  # nodes at which the windows of kernels are found, which are then widened
SCAN, DEPTHS = 65, 5  # depths among which the sharpest are sought, and at which nodes are also tried
SEEN_AT = 0.0, 0.6, 1.0  # fractions of the way to the farthest point at which the sharpest depths are sought

SPARED_SAMPLES = 2**13  # take as long as the overhead of computing kernels of one more size
FOCUSED = 4  # depths between which the phase is interpolated in that search
MAPPED = 5  # depths that are mapped at once: among them those of the first pupils to be fitted

Sampling = tuple[float, float]


class Place(NamedTuple):
    """A point of the sensor, mm, one depth and one wavelength."""

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
        self.scan = tuple(self.scene.scan(DEPTHS).tolist())  # both, and depths between them
        self._maps: dict[float, SensorMap] = {}
        self._fits = KnownPupils()
        self._of_corners: dict[Level, tuple[Fits, np.ndarray]] = {}
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
        if missing and len(self.ends) > 1 and not self._maps:
            missing = list(dict.fromkeys((*missing, *chebyshev(self.ends[0], self.ends[-1], MAPPED).tolist())))
        if missing:
            maps = scene_maps(self.lens, self.scene, missing, self.reference_um)
            self._maps.update(zip(missing, maps, strict=True))

    def sharpest(self, wave: float) -> list[float]:
        """Return the vergences of the smallest blur at the fractions SEEN_AT of the field: axis, between, corner.

        In the wavelength nearest to ``wave`` of those of the study.
        """
        return self._sharpest[min(self._sharpest, key=lambda known: abs(known - wave))]

    @cached_property
    def _sharpest(self) -> dict[float, list[float]]:
        """Return the vergence of the least variance of the phase, which is a polynomial in the vergence."""
        scan = self.scene.scan(SCAN)
        nodes = tuple(chebyshev(float(scan[0]), float(scan[-1]), FOCUSED if len(self.ends) > 1 else 1).tolist())
        points = [self.area.outwards(part) for part in SEEN_AT]
        waves = sorted({*self.waves_um, *(float(c.wavelengths_um @ c.shares) for c in self.scene.channels)})
        found, _ = self.lights([PupilAt(*point, v, wave) for wave in waves for point in points for v in nodes])
        degree, _ = found.basis.phase.indices
        between = lagrange(nodes, scan)
        phases = between @ found.phase[:, degree > 1].reshape(len(waves), len(points), len(nodes), -1)
        least = np.square(phases).sum(-1).argmin(-1)
        return {wave: scan[at].tolist() for wave, at in zip(waves, least, strict=True)}

    def places(self, wave: float) -> list[Place]:
        """Return points for choices on single pupils: the corner, sharp and at both ends of depth, and the centre.

        At depths between these, errors in the description of a pupil matter less.
        """
        axis, _, corner = self.sharpest(wave)
        found = [self.place(self.area.far, v, wave) for v in (corner, *self.ends)]
        return list(dict.fromkeys((*found, self.place(self.area.near, axis, wave))))

    def place(self, point: Point, vergence: float, wave_um: float) -> Place:
        """Return a point of the sensor with the pupil of a point of the area."""
        return Place(*self.spot(point, vergence), wave_um)

    def spot(self, point: Point, vergence: float) -> tuple[float, float, float]:
        """Return a point of the sensor with the pupils of a point of the area, and a vergence."""
        return (*self.area.fields.oblique(*point), vergence)

    def pupils_at(self, places: Sequence[Place]) -> list[PupilAt]:
        """Return the pupils of points of the sensor."""
        x, y, vergences, waves = np.array(places).T
        points = self.area.points_of(x, y)
        return [PupilAt(*at) for at in zip(*points, vergences.tolist(), waves.tolist(), strict=True)]

    @cached_property
    def level(self) -> Level:
        """Return the smallest fit with a residual below CONVERGED_WAVES at the ends of field, depth and colour."""
        return first_within(((level, self.residual(level)) for level in self.levels), CONVERGED_WAVES)[0]

    @property
    def levels(self) -> tuple[Level, ...]:
        """Return the sizes of fit, smallest first."""
        return levels_for(self.lens)

    def residual(self, level: Level) -> float:
        """Return the largest RMS phase residual of fits of this size, waves, at the ends of field and depth."""
        share = 1.0 if self.lens.mask.clear else throughput(self.lens.mask).light  # all of it may be in the open part
        return float(self._corner_fits(level)[0][1].max() / np.sqrt(share))

    def _corner_fits(self, level: Level) -> tuple[Fits, np.ndarray]:
        """Return the fits of one size at the ends of field and depth, and the chief rays' points, (n, 2) mm."""
        if level not in self._of_corners:
            self.check()
            self._of_corners[level] = fits_of(self.lens, self._sources(self.corners), level)
        return self._of_corners[level]

    @property
    def corners(self) -> list[PupilAt]:
        """Return the pupils at both ends of field and depth at the shortest wavelength, which is the most sensitive."""
        points = zip(*self.area.points_of(*np.array(self.area.corners).T), strict=True)
        return [PupilAt(*point, v, self.waves_um[0]) for point in points for v in self.ends]

    def _sources(self, pupils: Sequence[PupilAt]) -> list[Source]:
        """Return the object points of pupils."""
        self.map_depths(at.vergence for at in pupils)
        return [self._maps[at.vergence].source(at.x_mm, at.y_mm, at.wave_um) for at in pupils]

    def fitted(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils from their own rays, and their displacements from their points, (pupils, 2) mm; cached."""
        missing = self._fits.missing(pupils)
        if missing:
            self.check()
            made, landed = self.from_lens(self.kept, missing) if self.kept else self.from_rays(missing)
            self._fits.add(missing, with_reach(made) if self.kept else made, landed - np.array(missing)[:, :2])
        return self._fits.of(pupils)

    def from_rays(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils from their own rays, and where their chief rays land, (pupils, 2) mm."""
        known, sources = pupils == self.corners, self._sources(pupils)
        fits, landed = self._corner_fits(self.level) if known else fits_of(self.lens, sources, self.level)
        return pupils_of(self.lens, sources, fits, self.level, self.scene.clip, self._fits.order), landed

    @cached_property
    def kept(self) -> LensPupils | None:
        """Return the pupils that are kept of the lens, if they agree with rays at the corners."""
        if self.scene.clip or self.area.x_mm[0] < self.area.x_mm[1]:
            return None
        slopes = [source.field_slope for source in self._sources(self.corners)]
        kept = lens_pupils(
            self.lens, max(slopes, key=abs), (self.ends[0], self.ends[-1]), (self.waves_um[0], self.waves_um[-1])
        )
        if kept is None:
            return None
        (true, landed), (found, there) = self.from_rays(self.corners), self.from_lens(kept, self.corners)
        error = float(kernel_errors(found, true, UM_PER_MM * (there - landed)).max())
        return replace(kept, error=kept.error + error) if error <= AGREES * self.scene.relative_tolerance else None

    def from_lens(self, kept: LensPupils, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils from those kept of the lens, whose reach is not known, and where their chief rays land, mm."""
        x, y, vergences, waves = np.array(pupils).T
        self.map_depths(vergences.tolist())
        slopes = np.empty(len(pupils))
        for v in np.unique(vergences).tolist():
            at = vergences == v
            slopes[at] = self._maps[v].field_slopes(x[at], y[at], waves[at])
        return kept.between(slopes, vergences, waves)

    def lights(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils as `fitted` does: from the table, or, if there is none yet, from their own rays."""
        if self.table is None:
            return self.fitted(pupils)
        numbers = {at: number for number, at in enumerate(dict.fromkeys(pupils))}
        found, shifts = self.table.between(*zip(*numbers, strict=True))
        every = np.array([numbers[at] for at in pupils])
        return with_reach(found, COARSE_REACH).some(every), shifts[every]

    @cached_property
    def of_corner(self) -> tuple[PupilStack, np.ndarray]:
        """Return the pupils of the corner at the ends of depth and where it is sharpest, as `lights` does."""
        depths = dict.fromkeys((*self.ends, *self.sharpest(self.reference_um)))
        return self.lights([PupilAt(*self.area.far, v, self.reference_um) for v in depths])

    def kernels(self, places: Sequence[Place], sampling: Sampling = COARSE_SAMPLING) -> list[np.ndarray]:
        """Return the kernels of places, each computed once."""
        missing = [place for place in dict.fromkeys(places) if (place, sampling) not in self._kernels]
        if missing:
            made = self.rendered(missing, *self.lights(self.pupils_at(missing)), sampling)
            self._kernels.update(zip(((place, sampling) for place in missing), made, strict=True))
        return [self._kernels[place, sampling] for place in places]

    def channel_kernels(
        self, spots: Sequence[tuple[Colour, tuple[float, float, float]]], sampling: Sampling = COARSE_SAMPLING
    ) -> list[np.ndarray]:
        """Return the kernels of channels at points of the sensor and vergences, all wavelengths together."""
        places = [Place(*spot, wave) for colour, spot in spots for wave in colour.wavelengths_um]
        kernels = iter(self.kernels(places, sampling))
        return [weighted_sum(list(islice(kernels, len(c.weights))), c.weights) for c, _ in spots]

    def rendered(
        self,
        places: Sequence[Place],
        pupils: PupilStack,
        shifts_mm: np.ndarray,
        sampling: Sampling = COARSE_SAMPLING,
        shared: bool = True,
    ) -> list[np.ndarray]:
        """Return the kernels of pupils, one for each place.

        ``shared``: in windows of few sizes, so that many come together; else in those of the picture, on which errors
        of sampling depend.
        """
        self.check()
        _, _, angles = self.area.fields.orient(*np.array(places)[:, :2].T)
        shifts = PointLights(pupils, 0 * angles, shifts_mm * UM_PER_MM).turned(angles).shifts_um
        (fineness, margin), pixel = sampling, self.scene.sensor.pixel_um
        halves, samples = half_widths(pupils, pixel, np.hypot(*shifts.T)), samples_each(pupils, pixel, fineness)
        if shared:
            samples = np.full_like(samples, samples.max())
            halves = _shared_sizes(halves, int(samples[0]))
        kernels: list[np.ndarray] = [np.empty(0)] * len(places)
        for half, across in np.unique(np.stack([halves, samples]), axis=1).T.tolist():
            chosen, edge = np.flatnonzero((halves == half) & (samples == across)), ceil(margin * half)
            window = PixelWindow(half + edge, pixel, across)
            made = pixel_kernels(pupils.some(chosen), angles[chosen], window, shifts[chosen])
            for k, kernel in zip(chosen.tolist(), made, strict=True):
                inner = kernel[edge : edge + 2 * half + 1, edge : edge + 2 * half + 1]
                kernels[k] = inner / inner.sum() if edge else inner
        return kernels


def _shared_sizes(halves: np.ndarray, samples: int) -> np.ndarray:
    """Return half widths, each at least its own, so few that computing more kernels together pays for wider ones."""
    shared, widest = halves.copy(), halves.max()
    for size in np.unique(halves)[::-1]:
        alike = halves == size
        if alike.sum() * ((2 * widest + 1) ** 2 - (2 * size + 1) ** 2) * samples**2 > SPARED_SAMPLES:
            widest = size
        shared[alike] = widest
    return shared


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
    if len(kernels) == 1 and weights[0] == 1:
        return kernels[0]
    total = np.zeros(2 * [max(kernel.shape[-1] for kernel in kernels)], np.float32)
    for kernel, weight in zip(kernels, weights, strict=True):
        edge = (len(total) - kernel.shape[-1]) // 2
        total[edge : len(total) - edge, edge : len(total) - edge] += np.float32(weight) * kernel
    return total
