"""A picture through a misaligned lens, which has no symmetry that would make the kernels of two places alike.

Every place of the sensor has the kernel of the object point whose chief ray lands there, by exact rays. Kernels stand
at the nodes of a lattice and are interpolated between them, as in other pictures (handbook 10.1); a lattice is made
finer until kernels computed in the middle of its cells keep the scene's tolerance.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebval2d, chebvander2d

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GeometryError, RequestError
from p2sf.image.form import Forming, checked
from p2sf.image.lattice import Lattice, build_lattice
from p2sf.image.overlap import overlap_add
from p2sf.image.progress import Progress
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source, source_at
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.illumination import light_collected
from p2sf.pixel_kernels.pixels import LARGEST_WINDOW, TAIL
from p2sf.pixel_kernels.sensor_points import slope_ratio
from p2sf.raytrace.pencil import hexapolar, pencil
from p2sf.raytrace.ray_field import ray_data
from p2sf.scene.reference import exact_pixels
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf.threads import mapped, one_blas_thread

ORDER, FIELDS, REACH = 9, 13, 1.12  # of the polynomial that finds fields; fields along each axis; beyond the sensor
MOST_MISS_PX = 0.1  # by which that polynomial may miss
FEWEST, MOST = 3, 17  # nodes of a lattice along each axis
TRIED = 5  # places in the middle of cells where a lattice is tried
LIGHT = 5  # places along each axis at which illumination is computed
RINGS = 8  # of rays that find how far a kernel reaches


@dataclass(frozen=True, eq=False)
class FieldMap:
    """Which field lands where on the sensor, at one depth and the reference wavelength.

    ``across``, ``up``: Chebyshev coefficients (y, x) of the slopes along x and y over the place on the sensor, which is
    ``middle_mm`` ± ``half_mm``. ``scale_mm``: paraxial height per slope of the lens set straight.
    """

    lens: Lens
    depth_mm: float
    wavelength_um: float
    middle_mm: tuple[float, float]
    half_mm: tuple[float, float]
    across: np.ndarray
    up: np.ndarray
    scale_mm: float

    def slopes(self, x_mm: np.ndarray, y_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the field slopes along x and y whose chief rays land at these places."""
        x, y = self._reduced(x_mm, y_mm)
        return chebval2d(y, x, self.across), chebval2d(y, x, self.up)

    def thinning(self, x_mm: np.ndarray, y_mm: np.ndarray) -> np.ndarray:
        """Return ∂(slopes)/∂(place), per mm²: how much of the object's light falls on unit area."""
        x, y = self._reduced(x_mm, y_mm)
        tables = [chebder(table, axis=axis) for table in (self.across, self.up) for axis in (1, 0)]
        one, two, three, four = (chebval2d(y, x, table) for table in tables)
        found: np.ndarray = np.abs(one * four - two * three) / (self.half_mm[0] * self.half_mm[1])
        return found

    def source(self, x_mm: float, y_mm: float, wavelength_um: float) -> Source:
        """Return the object point that lands at a place in the reference wavelength, for another wavelength."""
        across, up = (float(slope) for slope in self.slopes(np.asarray(x_mm), np.asarray(y_mm)))
        ratio = slope_ratio(self.lens, self.depth_mm, self.wavelength_um, wavelength_um)
        return source_at(self.depth_mm, ratio * across, ratio * up, wavelength_um)

    def _reduced(self, x_mm: np.ndarray, y_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        (across, up), (wide, high) = self.middle_mm, self.half_mm
        return (x_mm - across) / wide, (y_mm - up) / high


def landing_mm(lens: Lens, source: Source) -> tuple[float, float]:
    """Return where a chief ray lands, x and y in the sensor's own axes, mm."""
    rays, turn = pencil(lens, source, np.zeros(1), np.zeros(1)), np.deg2rad(source.azimuth_deg)
    right, up = (float(np.ravel(place)[0]) for place in (rays.chief_x, rays.chief_y))
    return float(right * np.cos(turn) + up * np.sin(turn)), float(up * np.cos(turn) - right * np.sin(turn))


def field_map(lens: Lens, depth_mm: float, wavelength_um: float, sensor: Sensor) -> FieldMap:
    """Return the map of a sensor. Raises GeometryError where chief rays do not reach all of it in good order."""
    scale = float(coefficients(lens, depth_mm, 1.0, wavelength_um).image_height)
    x, y = (
        np.array(ends) for ends in (sensor.x_mm([-0.5, sensor.columns - 0.5]), sensor.y_mm([sensor.rows - 0.5, -0.5]))
    )
    # A lens that is out of line moves the whole picture, by more than a small sensor's own width.
    middle_at = float(x.mean()), float(y.mean())
    landed = landing_mm(lens, source_at(depth_mm, middle_at[0] / scale, middle_at[1] / scale, wavelength_um))
    aside, above = (there - wanted for there, wanted in zip(landed, middle_at, strict=True))
    fields = [
        (across / scale, up / scale)
        for across in np.linspace(*_wider(x - aside), FIELDS)
        for up in np.linspace(*_wider(y - above), FIELDS)
    ]
    found = mapped(lambda field: _place(lens, depth_mm, wavelength_um, *field), fields)
    slopes = np.array([field for field, place in zip(fields, found, strict=True) if place])
    places = np.array([place for place in found if place]).reshape(-1, 2)
    if not len(places) or not ((places.min(0) <= (x[0], y[0])) & (places.max(0) >= (x[1], y[1]))).all():
        raise GeometryError("chief rays do not reach all of the sensor; take a smaller sensor")
    low, high = places.min(0), places.max(0)
    middle, half = (low + high) / 2, (high - low) / 2
    reduced = (places - middle) / half
    terms = [(a, b) for a in range(ORDER + 1) for b in range(ORDER + 1 - a)]
    basis = chebvander2d(reduced[:, 1], reduced[:, 0], (ORDER, ORDER))
    columns = np.stack([basis[:, a * (ORDER + 1) + b] for a, b in terms], -1)
    solved = np.linalg.lstsq(columns, slopes, rcond=1e-12)[0]
    miss = np.abs(columns @ solved - slopes).max() * abs(scale) / sensor.pixel_mm
    if not miss < MOST_MISS_PX:
        raise GeometryError(
            "chief rays land in no smooth order on the sensor, by {miss:.2g} pixels; take a smaller sensor or align "
            "the lens better",
            miss=float(miss),
        )
    tables = np.zeros((2, ORDER + 1, ORDER + 1))
    for (a, b), values in zip(terms, solved, strict=True):
        tables[:, a, b] = values
    ends = (float(middle[0]), float(middle[1])), (float(half[0]), float(half[1]))
    return FieldMap(lens, depth_mm, wavelength_um, *ends, tables[0], tables[1], scale)


def _wider(ends: np.ndarray) -> tuple[float, float]:
    middle, half = float(ends.mean()), float(np.ptp(ends)) / 2
    room = (REACH - 1) * float(np.abs(ends).max())
    return middle - half - room, middle + half + room


def _place(lens: Lens, depth_mm: float, wavelength_um: float, across: float, up: float) -> tuple[float, float] | None:
    try:
        return landing_mm(lens, source_at(depth_mm, across, up, wavelength_um))
    except GeometryError:  # beyond what the lens sees, which its sensor need not reach
        return None


@dataclass(frozen=True, eq=False)
class MisalignedPicture:
    """What the sensor receives, (rows, columns, channels) float32, and the lattice of kernels it was made with.

    ``error``: the largest relative L2 error of kernels in the middle of some cells; ``allowed``: what the scene allows.
    """

    values: np.ndarray
    lattice: Lattice
    error: float
    allowed: float


@one_blas_thread
def form_misaligned(
    lens: Lens, scene: Scene, values: np.ndarray, how: Forming | None = None, watch: Progress | None = None
) -> MisalignedPicture:
    """Return the picture of a scene at one depth through a misaligned lens, ``values`` as `form_image` has them.

    Raises RequestError for several depths and for shapes that do not fit, GeometryError where chief rays do not reach
    the sensor, Cancelled when ``watch`` is cancelled.
    """
    if scene.near_mm != scene.far_mm or scene.depth_map is not None:
        raise RequestError(
            "the scene has several depths, and a picture through a misaligned lens knows one; give near_mm and far_mm "
            "alike and leave depth_map out"
        )
    how, watch, values = how or Forming(), watch or Progress(), checked(scene, values)
    camera, middle = scene.camera(lens), scene.channels[len(scene.channels) // 2]
    reference = float(middle.shares @ middle.wavelengths_um)
    seen = field_map(camera, scene.far_mm, reference, scene.sensor)
    lattice, error, allowed = settled_lattice(seen, scene, watch)
    if how.geometry:
        values = _moved(values, seen, scene.sensor, how.spline) * shading(seen, scene)[..., None]
    border = lattice.half if how.surround == "edge" else 0
    if border:
        values = np.pad(values, ((border, border), (border, border), (0, 0)), mode="edge")
    whole = overlap_add(values, lattice, watch, border)
    cut = lattice.half + border
    formed = whole[cut : whole.shape[0] - cut, cut : whole.shape[1] - cut]
    return MisalignedPicture(formed, lattice, error, allowed)


def _moved(values: np.ndarray, seen: FieldMap, sensor: Sensor, order: int) -> np.ndarray:
    """Return the paraxial picture as real chief rays place it; beyond it its outermost pixels are repeated."""
    from scipy.ndimage import map_coordinates

    x, y = np.meshgrid(sensor.x_mm(np.arange(sensor.columns)), sensor.y_mm(np.arange(sensor.rows)))
    across, up = (seen.scale_mm * slope for slope in seen.slopes(x, y))
    column = (across - sensor.centre_mm[0]) / sensor.pixel_mm + (sensor.columns - 1) / 2
    row = (sensor.rows - 1) / 2 - (up - sensor.centre_mm[1]) / sensor.pixel_mm
    places = np.stack([row, column])

    def moved(plane: np.ndarray) -> np.ndarray:
        found: np.ndarray = map_coordinates(plane, places, order=order, mode="nearest")
        return found

    return np.stack(mapped(moved, np.moveaxis(values, -1, 0)), axis=-1).astype(np.float32)


def shading(seen: FieldMap, scene: Scene) -> np.ndarray:
    """Return the irradiance of an even object over that of the field's centre, (rows, columns) float32."""
    from scipy.interpolate import RectBivariateSpline

    sensor, degree = scene.sensor, 1 if scene.clip else 3
    rows, columns = (np.linspace(0, max(n - 1, 1), LIGHT) for n in (sensor.rows, sensor.columns))
    x, y = np.meshgrid(sensor.x_mm(columns), sensor.y_mm(rows))

    def irradiance(x_mm: float, y_mm: float) -> float:
        collected = light_collected(seen.lens, seen.source(x_mm, y_mm, seen.wavelength_um), scene.clip)
        return collected * float(seen.thinning(np.asarray(x_mm), np.asarray(y_mm)))

    light = np.array(mapped(lambda place: irradiance(*place), zip(x.ravel().tolist(), y.ravel().tolist(), strict=True)))
    centre = irradiance(*landing_mm(seen.lens, Source(seen.depth_mm, 0.0, seen.wavelength_um)))
    spline = RectBivariateSpline(rows, columns, light.reshape(x.shape) / centre, kx=degree, ky=degree)
    shade: np.ndarray = spline(np.arange(sensor.rows), np.arange(sensor.columns))
    return shade.astype(np.float32)


def settled_lattice(seen: FieldMap, scene: Scene, watch: Progress) -> tuple[Lattice, float, float]:
    """Return kernels whose interpolation keeps the tolerance, their largest error where tried, and what is allowed.

    With MOST nodes along an axis the error may be more than allowed.
    """
    sensor, known = scene.sensor, dict[tuple[float, float], np.ndarray]()

    def kernel_at(row: float, column: float) -> np.ndarray:
        if (row, column) not in known:
            known[row, column] = channel_kernels(seen, scene, row, column)
        return known[row, column]

    def kernels_at(rows: np.ndarray, columns: np.ndarray) -> list[np.ndarray]:
        return [kernel_at(*place) for place in zip(rows.tolist(), columns.tolist(), strict=True)]

    count = FEWEST
    while True:
        lattice = build_lattice(kernels_at, (sensor.rows, sensor.columns), (count, count), watch=watch)
        middle = kernel_at((sensor.rows - 1) / 2, (sensor.columns - 1) / 2)
        allowed = scene.relative_error(float(np.sqrt(np.square(middle).sum((1, 2)).max())))
        error = _worst_between(lattice, kernel_at)
        if error <= allowed or count >= MOST:
            return lattice, error, allowed
        count = 2 * count - 1  # the nodes there are stay nodes


def _worst_between(lattice: Lattice, kernel_at: Callable[[float, float], np.ndarray]) -> float:
    """Return the largest relative L2 error of interpolated kernels in the middle of cells, the corners' among them."""
    rows, columns = len(lattice.row_nodes) - 1, len(lattice.column_nodes) - 1
    if rows < 1 or columns < 1:
        return 0.0
    cells = [(0, 0), (0, columns - 1), (rows - 1, 0), (rows - 1, columns - 1), (rows // 2, columns // 2)][:TRIED]
    worst = 0.0
    for a, b in cells:
        exact = kernel_at(float(lattice.row_nodes[a : a + 2].mean()), float(lattice.column_nodes[b : b + 2].mean()))
        around = [lattice.kernels[a + i][b + j] for i in (0, 1) for j in (0, 1)]
        size = max(kernel.shape[-1] for kernel in (exact, *around))
        mean = np.mean([_padded(kernel, size) for kernel in around], axis=0)
        miss = np.square(mean - _padded(exact, size)).sum((1, 2)) / np.square(exact).sum((1, 2))
        worst = max(worst, float(np.sqrt(miss.max())))
    return worst


def _padded(kernel: np.ndarray, size: int) -> np.ndarray:
    edge = (size - kernel.shape[-1]) // 2
    return np.pad(kernel, ((0, 0), (edge, edge), (edge, edge)))


def channel_kernels(seen: FieldMap, scene: Scene, row: float, column: float) -> np.ndarray:
    """Return the light per pixel of the point that lands at a place, (channels, size, size), unit sum each."""
    x, y = float(scene.sensor.x_mm(column)), float(scene.sensor.y_mm(row))
    pixel = scene.sensor.pixel_um
    points = [
        [(share, *_moved_point(seen, x, y, float(wave))) for wave, share in _waves(channel)]
        for channel in scene.channels
    ]
    reach = max(
        _reach_um(seen.lens, source) + np.hypot(aside, shift) for one in points for _, source, aside, shift in one
    )
    half = min(max(1, ceil(reach / pixel - 0.5)), LARGEST_WINDOW)
    found = [
        sum(
            share * _pixels(seen.lens, source, half, pixel, (aside, shift), scene.clip)
            for share, source, aside, shift in one
        )
        for one in points
    ]
    return np.stack(found).astype(np.float32)


def _waves(channel: Channel) -> list[tuple[float, float]]:
    return list(zip(channel.wavelengths_um.tolist(), channel.shares.tolist(), strict=True))


def _moved_point(seen: FieldMap, x_mm: float, y_mm: float, wavelength_um: float) -> tuple[Source, float, float]:
    """Return the object point for a wavelength, and how far it lands from the place, µm across and along its field."""
    source = seen.source(x_mm, y_mm, wavelength_um)
    right, up = (UM_PER_MM * (a - b) for a, b in zip(landing_mm(seen.lens, source), (x_mm, y_mm), strict=True))
    sine, cosine = np.sin(np.deg2rad(source.azimuth_deg)), np.cos(np.deg2rad(source.azimuth_deg))
    return source, float(right * cosine - up * sine), float(right * sine + up * cosine)


def _reach_um(lens: Lens, source: Source) -> float:
    """Return how far from the chief ray light lands, rays and the nearest rings around them, µm."""
    data = ray_data(pencil(lens, source, *hexapolar(RINGS)))
    radius = float(np.nanmax(np.hypot(data.fx, data.fy)))
    return float(np.nanmax(np.hypot(data.x_um, data.y_um))) + TAIL / radius


def _pixels(
    lens: Lens, source: Source, half: int, pixel_um: float, places_um: tuple[float, float], clip: bool
) -> np.ndarray:
    aside, shift = places_um
    return exact_pixels(lens, source, np.deg2rad(source.azimuth_deg), half, pixel_um, shift, clip, aside)
