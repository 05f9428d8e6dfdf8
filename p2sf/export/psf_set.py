"""PSFs of chosen depths, fields and wavelengths as a sensor's pixels receive them, with what goes with each."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product
from math import prod

import numpy as np

from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.database.accuracy import where
from p2sf.errors import GeometryError, RequestError, SamplingError
from p2sf.figures.pixel_light import LARGEST
from p2sf.image.progress import Progress
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.parameters import check_samples
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.illumination import light_collected
from p2sf.pixel_kernels.pixels import PixelWindow, half_width, part_filled_kernel, samples_across
from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.pixel_kernels.ray_spread import RaySpread, part_filled_rays, ray_spread
from p2sf.psf.prediction import predicted_error
from p2sf.raytrace.pencil import pencil
from p2sf.threads import for_each, one_blas_thread

EVERY_FRINGE = 2.0  # samples a λ/2NA, as `part_filled_kernel` needs
MOST_PIXELS = 1024  # a side
LEAST_LIGHT = 0.9  # of a PSF in its pixels: below, a warning is due
PIXELS = 65  # a side, of one that nobody names: odd, for a chief ray on the middle one
PIXEL_UM = 4.0  # of a sensor that nobody names
MOST_BYTES = 1 << 31  # of the PSFs of one set

Light = PupilStack | RaySpread


@dataclass(frozen=True)
class SetAxes:
    """Depths in mm (inf allowed), field angles in degrees and wavelengths in nm, at least one of each."""

    depths_mm: tuple[float, ...]
    fields_deg: tuple[float, ...]
    wavelengths_nm: tuple[float, ...]

    def __post_init__(self) -> None:
        if not all((self.depths_mm, self.fields_deg, self.wavelengths_nm)):
            raise RequestError("a set of PSFs needs a depth, a field and a wavelength at least; give one of each")

    @property
    def shape(self) -> tuple[int, int, int]:
        """Return how many depths, fields and wavelengths there are."""
        return len(self.depths_mm), len(self.fields_deg), len(self.wavelengths_nm)


@dataclass(frozen=True)
class PixelGrid:
    """Pixels ``pixel_um`` apart, of whose area ``fill_factor`` is sensitive: a square in the middle.

    ``pixels``: how many along each side of a PSF; None: an odd number that holds the widest PSF of the set.
    """

    pixel_um: float
    fill_factor: float = 1.0
    pixels: int | None = None

    def __post_init__(self) -> None:
        check_samples(self.pixels, self.pixel_um, most=MOST_PIXELS)
        if not 0 < self.fill_factor <= 1:
            raise RequestError("the fill factor is {fill:g}; give a part above 0 and up to 1", fill=self.fill_factor)


@dataclass(frozen=True, eq=False)
class PsfSet:
    """PSFs (depth, field, wavelength, y, x) float32: the share of a point's light that each pixel receives.

    Rows are +y, along the field; the chief ray of each PSF's own wavelength meets the centre of pixel N//2 (from 0).
    ``chief_mm``: where that is on the sensor, mm from the axis, along y; ``chief_x_mm`` along x, which is 0 but for a
    lens without symmetry. ``captured``: the share of the point's light that these
    pixels receive. ``collected``: the light that the lens lets through from a point of an even object, over that on the
    axis. ``error``: the predicted 1 − R² of waves, NaN for rays. ``methods``: "fitted", whose waves are summed, or
    "rays", whose density is taken where waves cannot be summed. These all have the shape (depth, field, wavelength).
    """

    lens: Lens
    axes: SetAxes
    grid: PixelGrid
    clip: bool
    values: np.ndarray
    chief_mm: np.ndarray
    chief_x_mm: np.ndarray
    captured: np.ndarray
    collected: np.ndarray
    error: np.ndarray
    methods: np.ndarray

    @property
    def pixel_um(self) -> float:
        """Return the distance between pixels, µm."""
        return self.grid.pixel_um

    @property
    def depths_mm(self) -> np.ndarray:
        """Return the depths, mm."""
        return np.array(self.axes.depths_mm, dtype=float)

    @property
    def fields_deg(self) -> np.ndarray:
        """Return the field angles, degrees."""
        return np.array(self.axes.fields_deg, dtype=float)

    @property
    def wavelengths_nm(self) -> np.ndarray:
        """Return the wavelengths, nm."""
        return np.array(self.axes.wavelengths_nm, dtype=float)


@one_blas_thread
def psf_set(lens: Lens, axes: SetAxes, grid: PixelGrid, clip: bool = False, watch: Progress | None = None) -> PsfSet:
    """Return the PSFs of every depth, field and wavelength of a lens, focused and opened already.

    ``clip`` lets the clear rims clip. Raises GeometryError where no ray of a point arrives, naming the point,
    RequestError where the set would be too large, Cancelled through ``watch``.
    """
    watch = watch or Progress()
    _check_size(prod(axes.shape), grid.pixels or 1)
    points = [
        Source(depth, float(slope_from_degrees(field)), wave / NM_PER_UM)
        for depth, field, wave in product(axes.depths_mm, axes.fields_deg, axes.wavelengths_nm)
    ]
    watch.expect(2 * len(points))
    lights = []
    for point in points:
        lights.append(_light(lens, point, grid, clip))
        watch.advance()
    pixels = grid.pixels or 2 * min(MOST_PIXELS // 2 - 1, max(half_width(light, grid.pixel_um) for light in lights)) + 1
    _check_size(len(points), pixels)
    values = np.empty((len(points), pixels, pixels), np.float32)

    def fill(number: int) -> None:
        values[number] = _on_pixels(lights[number], grid, pixels)

    for_each(fill, range(len(points)), lambda _: watch.advance())
    figures = np.array([_figures(lens, point, clip) for point in points])
    return PsfSet(
        lens=lens,
        axes=axes,
        grid=grid,
        clip=clip,
        values=values.reshape(*axes.shape, pixels, pixels),
        chief_mm=figures[:, 0].reshape(axes.shape),
        chief_x_mm=figures[:, 1].reshape(axes.shape),
        captured=values.sum((1, 2), dtype=float).reshape(axes.shape),
        collected=figures[:, 2].reshape(axes.shape),
        error=np.array([_error(light) for light in lights]).reshape(axes.shape),
        methods=np.array(["rays" if isinstance(x, RaySpread) else "fitted" for x in lights]).reshape(axes.shape),
    )


def _check_size(count: int, pixels: int) -> None:
    size = 4 * count * pixels**2
    if size > MOST_BYTES:
        raise RequestError(
            "{count} PSFs of {pixels}² pixels are {size:.1f} GiB; ask for fewer, or for fewer pixels a side",
            count=count,
            pixels=pixels,
            size=size / (1 << 30),
        )


def _light(lens: Lens, point: Source, grid: PixelGrid, clip: bool) -> Light:
    """Return the pupil of a point; its rays where a fit fails or its sum would take too large a transform."""
    try:
        pupil = pupil_map(lens, point, "fitted", None, clip)
        half = half_width(pupil, grid.pixel_um)
        if (2 * half + 1) * _samples(pupil, grid) <= LARGEST:
            return pupil
    except (GeometryError, SamplingError):  # rays are lost: their density says where the others go
        pass
    try:
        return ray_spread(lens, point, clip)
    except GeometryError as error:
        raise GeometryError(
            "the point {where}: {error}",
            where=where(point.depth_mm, point.field_deg, point.wavelength_um * NM_PER_UM),
            error=error.message,
        ) from error


def _samples(pupil: PupilStack, grid: PixelGrid) -> int:
    """Return an odd number of samples along a pixel that resolves every fringe."""
    return samples_across(pupil, grid.pixel_um, EVERY_FRINGE) | 1


def _on_pixels(light: Light, grid: PixelGrid, pixels: int) -> np.ndarray:
    """Return one PSF on so many pixels a side, rows +y, cut from a window that holds all of it."""
    half, own = pixels // 2, half_width(light, grid.pixel_um)
    if isinstance(light, RaySpread):
        wide = half
        found = part_filled_rays(light, wide, grid.pixel_um, grid.fill_factor)
    else:
        samples = _samples(light, grid)
        # Twice as wide as need be: what wraps around at the edge of the transform is the light of the far wings.
        wide = max(own, min(2 * max(half, own), (LARGEST // samples - 1) // 2))
        found = part_filled_kernel(light, PixelWindow(wide, grid.pixel_um, samples), grid.fill_factor)
    whole = np.pad(found[::-1], max(0, half - wide))  # beyond the largest transform there is no light to speak of
    first = max(wide, half) - half
    return whole[first : first + pixels, first : first + pixels]


def _figures(lens: Lens, point: Source, clip: bool) -> tuple[float, float, float]:
    """Return where the chief ray lands along y and x, mm, and the light collected over that on the axis."""
    axis = Source(point.depth_mm, 0.0, point.wavelength_um)
    share = light_collected(lens, point, clip) / light_collected(lens, axis, clip)
    rays = pencil(lens, point, [0.0], [0.0])
    x, y = (float(np.ravel(place)[0]) for place in (rays.chief_x, rays.chief_y))
    return y, x, share


def _error(light: Light) -> float:
    return predicted_error(light.residual_waves.item(), "fitted") if isinstance(light, PupilStack) else float("nan")


def left_out(found: PsfSet) -> Message | None:
    """Return a warning where the pixels of a PSF receive little of the light that falls on its sensor."""
    shares = found.captured / found.grid.fill_factor
    little = int((shares < LEAST_LIGHT).sum())
    if not little:
        return None
    return Message(
        "{count} of {total} PSFs are wider than their windows, which hold as little as {share:.2g} % of the light; "
        "ask for more pixels a side, or larger ones",
        count=little,
        total=shares.size,
        share=100 * float(shares.min()),
    )


def axes_of(depths_mm: Iterable[float], fields_deg: Iterable[float], wavelengths_nm: Iterable[float]) -> SetAxes:
    """Return axes from any numbers, each once and in order."""
    return SetAxes(*(tuple(sorted({float(x) for x in axis})) for axis in (depths_mm, fields_deg, wavelengths_nm)))
