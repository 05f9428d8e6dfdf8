"""Kernels of a misaligned lens from its database over depth, field x, field y and wavelength.

There is no circle whose points share a pupil: each place of the sensor has the numbers of its own field, looked up, and
its pupil stands in the axes of the sensor.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM, depth_of
from p2sf.database import Space, depth_nodes
from p2sf.database.fitted import FittedDatabase, split
from p2sf.database.fitted_build import build_fitted, rays_on_sensor
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source, source_at
from p2sf.pixel_kernels import Colour, Recipe
from p2sf.pixel_kernels.channel import PointLights, Points, wave_kernels
from p2sf.pixel_kernels.frequency_grid import pupils_of
from p2sf.pixel_kernels.pixels import half_widths
from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.pixel_kernels.sensor_points import slope_ratio
from p2sf.pupil.zernike import terms
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.fit import SKEW, Level, PencilForms, pencil_forms
from p2sf.scene.field_points import FIELDS, FieldMap, field_map, fitted_map, sensor_ends_mm
from p2sf.scene.scene import Scene
from p2sf.scene.study import CONVERGED_WAVES, SCAN, SEEN_AT, Place, PupilAt, Sampling, Study

BORDER = 9  # places along each side of the sensor whose fields a database has to cover
MARGIN = 0.04  # of the fields' half width, by which it covers more


def scene_database(
    lens: Lens, scene: Scene, reference_um: float, tolerance_waves: float = CONVERGED_WAVES
) -> FittedDatabase:
    """Return the database of all fields, depths and wavelengths of a scene, fits and look-ups good to a tolerance.

    Raises RequestError for a scene whose rims clip, and P2SFError where chief rays do not reach the sensor or no fit
    describes the pencils.
    """
    if scene.clip:
        raise RequestError(
            "{parameter} needs a lens of rotational symmetry, and this one has none; leave it out",
            parameter="clip",
        )
    waves = np.unique([wave for channel in scene.channels for wave in channel.wavelengths_um])
    across, up = _slopes(lens, scene, reference_um, waves)
    depths = depth_nodes(scene.near_mm, scene.far_mm, 1 if scene.near_mm == scene.far_mm else 2)
    space = Space(depths, up, np.unique(waves[[0, -1]]), across)
    level = _level(lens, space, tolerance_waves)
    return build_fitted(lens, space, tolerance_waves=tolerance_waves, numbers=level.numbers)


def _slopes(lens: Lens, scene: Scene, reference_um: float, waves: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the greatest slope along x and along y of fields that land on the sensor."""
    x, y = np.meshgrid(*(np.linspace(ends[0], ends[1], BORDER) for ends in sensor_ends_mm(scene.sensor)))
    found = []
    for depth in dict.fromkeys((scene.near_mm, scene.far_mm)):
        slopes = np.stack(field_map(lens, depth, reference_um, scene.sensor).slopes(x, y))
        found += [slope_ratio(lens, depth, reference_um, float(wave)) * slopes for wave in waves]
    low, high = np.min(found, axis=(0, 2, 3)), np.max(found, axis=(0, 2, 3))
    wider = MARGIN * (high - low) / 2
    across, up = np.stack([low - wider, high + wider], axis=1)
    return across, up


def _level(lens: Lens, space: Space, tolerance_waves: float) -> Level:
    """Return the first size of fit that leaves less than the tolerance in the corners of a space, else the largest."""
    corners = [space.source(*place) for place in product(*(nodes[[0, -1]].tolist() for nodes in space.nodes))]

    def left(level: Level) -> float:
        rays = (rays_on_sensor(lens, [corner], level)[0] for corner in corners)
        return max(float(pencil_forms(data, level).residual_waves[0]) for data in rays)

    return next((level for level in SKEW if left(level) < tolerance_waves), SKEW[-1])


def database_map(database: FittedDatabase, lens: Lens, depth_mm: float, reference_um: float, scene: Scene) -> FieldMap:
    """Return the map of one depth by the chief rays of a database."""
    space = database.space
    assert space.field_x_slopes is not None
    ends = space.field_x_slopes[[0, -1]], space.field_slopes[[0, -1]]
    fields = [(float(a), float(b)) for a, b in product(*(np.linspace(pair[0], pair[1], FIELDS) for pair in ends))]
    landed = [landing(database, source_at(depth_mm, *slopes, reference_um)) for slopes in fields]
    return fitted_map(lens, depth_mm, reference_um, scene.sensor, (fields, landed))


def landing(database: FittedDatabase, source: Source) -> tuple[float, float]:
    """Return where a chief ray lands, x and y in the sensor's own axes, mm."""
    x, y = database.numbers_at(source)[-2:].tolist()
    return x, y


def pupils_at(
    database: FittedDatabase, seen: FieldMap, x_mm: np.ndarray, y_mm: np.ndarray, waves_um: Sequence[float]
) -> tuple[PupilStack, np.ndarray]:
    """Return the pupils of points that land at places, (points,), those of one wavelength together, and their shifts.

    (waves · points,) pupils; how far each lands from its place, (waves · points, 2) µm along x and y.
    """
    sources = [seen.source(x, y, wave) for wave in waves_um for x, y in zip(x_mm.tolist(), y_mm.tolist(), strict=True)]
    return looked_up(database, seen.lens, sources, np.tile(np.stack([x_mm, y_mm], axis=1), (len(waves_um), 1)))


def looked_up(
    database: FittedDatabase, lens: Lens, sources: Sequence[Source], places_mm: np.ndarray
) -> tuple[PupilStack, np.ndarray]:
    """Return the pupils of sources in the sensor's axes, and how far each lands from its place, (sources, 2) µm."""
    numbers = np.stack([database.numbers_at(source) for source in sources])
    forms = (np.stack(form) for form in zip(*(split(database.level, row)[:4] for row in numbers), strict=True))
    phase, fx, fy, amplitude = forms
    unknown = np.full(len(numbers), database.residual_waves)
    fits = PencilForms(phase, fx, fy, amplitude, unknown, 0 * unknown, 0 * unknown)
    several = Sources(*np.array([(s.depth_mm, s.field_slope, s.wavelength_um) for s in sources]).T)
    return pupils_of(lens, several, fits, database.level), (numbers[:, -2:] - places_mm) * UM_PER_MM


@dataclass(frozen=True, eq=False)
class PlacedLights(PointLights):
    """The light of points whose pupils stand in the sensor's axes; ``shifts_um``: (waves · points, 2) along x, y."""

    def half_widths(self, pixel_um: float) -> np.ndarray:
        """Return how many pixels on either side of the centre hold each kernel, (waves · points,)."""
        assert isinstance(self.lights, PupilStack)
        return half_widths(self.lights, pixel_um, np.hypot(*self.shifts_um.T))

    def kernels(self, angles: np.ndarray, halves: np.ndarray, pixel_um: float, recipe: Recipe) -> list[np.ndarray]:
        """Return each kernel, (2·half + 1,)² float32."""
        assert isinstance(self.lights, PupilStack)
        return wave_kernels(self.lights, angles, halves, pixel_um, recipe, self.shifts_um)


@dataclass(frozen=True, eq=False)
class SkewKernels:
    """Kernels of one depth, channel and pixel pitch, as `pixel_kernels.Kernels` has them, of a misaligned lens."""

    seen: FieldMap
    colour: Colour
    pixel_um: float
    recipe: Recipe
    database: FittedDatabase

    def at(self, x_mm: float, y_mm: float, half: int | None = None) -> np.ndarray:
        """Return the kernel of the point that lands at (x, y up), (size, size) float32 of unit sum, row 0 the top."""
        point = self.points([x_mm], [y_mm])
        return point.kernels(np.array([half]) if half else point.half_widths())[0]

    def points(self, x_mm: ArrayLike, y_mm: ArrayLike) -> Points:
        """Return the light of points that land at (x, y up), (points,) each."""
        x, y = np.asarray(x_mm, float), np.asarray(y_mm, float)
        lights = PlacedLights(*pupils_at(self.database, self.seen, x, y, self.colour.wavelengths_um))
        return Points(self.pixel_um, self.colour.weights, np.zeros(len(x)), self.recipe, lights)


class SkewStudy(Study):
    """The study of a misaligned lens: every pupil is looked up in ``database``, that of the scene."""

    @cached_property
    def database(self) -> FittedDatabase:
        """Return the database of the scene, built when first asked for."""
        self.check()
        return scene_database(self.lens, self.scene, self.reference_um)

    def field_map(self, vergence: float) -> FieldMap:
        """Return which field lands where at one depth."""
        if vergence not in self._fields:
            self._fields[vergence] = database_map(
                self.database, self.lens, depth_of(vergence), self.reference_um, self.scene
            )
        return self._fields[vergence]

    @cached_property
    def _fields(self) -> dict[float, FieldMap]:
        return {}

    @cached_property
    def _sharpest(self) -> dict[float, list[float]]:
        """Return, of every wavelength, where the variance of the phase is least at SEEN_AT of the way to a corner."""
        scan, level = self.scene.vergences(SCAN), self.database.level
        degree = np.array([n for odd in (False, True) for n, _ in terms(level.wave_order, odd)])
        found: dict[float, list[float]] = {}
        for wave in self.waves_um:
            places = [self.oblique(part * self.farthest_mm, self.ends[0], wave) for part in SEEN_AT]
            sources = [self.field_map(self.ends[0]).source(place.x_mm, place.y_mm, wave) for place in places]
            found[wave] = []
            for source in sources:
                pencils = [
                    split(level, self.database.numbers_at(replace(source, depth_mm=depth_of(v))))[0] for v in scan
                ]
                variance = [float(np.square(phase[degree > 1]).sum()) for phase in pencils]
                found[wave].append(float(scan[int(np.argmin(variance))]))
        return found

    def oblique(self, height_mm: float, vergence: float, wave_um: float) -> Place:
        """Return the place that is as far on the way from the sensor's middle to its farthest corner."""
        sensor, part = self.scene.sensor, height_mm / self.farthest_mm
        middle = np.array(sensor.centre_mm)
        half = np.array([sensor.columns, sensor.rows]) * sensor.pixel_mm / 2
        corner = middle + np.where(middle < 0, -half, half)
        x, y = middle + part * (corner - middle)
        return Place(float(x), float(y), vergence, wave_um)

    def fitted(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return pupils, looked up, and their lateral colour in mm, (pupils,)."""
        stack, shifts_um = self._looked_up([self.oblique(*at) for at in pupils])
        return stack, np.hypot(*shifts_um.T) / UM_PER_MM

    def made(self, places: Sequence[Place], sampling: Sampling) -> list[np.ndarray]:
        """Return the kernels of places."""
        pupils, shifts_um = self._looked_up(places)
        pixel = self.scene.sensor.pixel_um
        halves = half_widths(pupils, pixel, np.hypot(*shifts_um.T))
        recipe = Recipe("fitted", None, *sampling)
        return wave_kernels(pupils, np.zeros(len(pupils)), halves, pixel, recipe, shifts_um)

    def _looked_up(self, places: Sequence[Place]) -> tuple[PupilStack, np.ndarray]:
        sources = [self.field_map(place.vergence).source(place.x_mm, place.y_mm, place.wave_um) for place in places]
        return looked_up(self.database, self.lens, sources, np.array([place[:2] for place in places]))
