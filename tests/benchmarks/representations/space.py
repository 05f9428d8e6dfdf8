"""The PSFs that representations are to hold: a lens, its depths, fields and wavelengths, and one window for all."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import ceil, copysign, inf

import numpy as np

from p2sf.conventions import NM_PER_UM, slope_from_degrees, vergence
from p2sf.database.space import Space
from p2sf.errors import GeometryError
from p2sf.figures.pixel_light import ROUNDING
from p2sf.lens.lens import Lens, check_aligned, with_f_number
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import field_from_object_height, find_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.pupil.fit import fit
from p2sf.raytrace.ray_field import AIRY_RADIUS
from p2sf.spans import depth_nodes
from tests.support.binning import bin_samples

PIXELS = 64
DEFOCUS_WAVES = 4.0  # from one end of the depths to the other, at the reference wavelength
FAR = 1000.0  # times the nearest depth: a thousandth of that defocus away from infinity
USEFUL_WAVES = 50.0  # of defocus at infinity; beyond, the lens is one for near objects
STEEPEST_WAVES = 48.0  # of phase slope, which the window's fine samples can carry
F_NUMBERS = (1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 22.0)
AIRY_RADII = 5.0  # of light beyond the outermost ray that the window holds
NEAREST_FOCAL = 10.0  # focal lengths, the nearest depth of a lens whose blur grows little with it
NEAREST_MM, LARGE_MM, TRIED = 1.0, 1e7, 400  # between which depths a focus is sought, and at how many
EDGE = 0.0, 0.5, 0.75, 1.0  # of the largest field, where the steepest phase is sought


@dataclass(frozen=True, eq=False)
class SpacePoints:
    """Point sources as arrays, each (n,): depth (mm), field slope, wavelength (µm); ``cube``: (n, 3) in 0…1."""

    depth_mm: np.ndarray
    field_slope: np.ndarray
    wavelength_um: np.ndarray
    cube: np.ndarray

    def __len__(self) -> int:
        return len(self.cube)

    def __getitem__(self, some: slice | np.ndarray) -> "SpacePoints":
        return SpacePoints(*(column[some] for column in vars(self).values()))

    def sources(self) -> Iterator[Source]:
        """Yield the sources one by one."""
        for place in zip(self.depth_mm.tolist(), self.field_slope.tolist(), self.wavelength_um.tolist(), strict=True):
            yield Source(*place)


@dataclass(frozen=True)
class Window:
    """What every picture shows: ``pixels`` a side, µm apart, each the light of ``across`` × ``across`` samples."""

    pixels: int
    pixel_um: float
    across: int

    @property
    def fine(self) -> tuple[int, float]:
        """Return the samples a side of the sum behind the pixels, and their pitch, µm."""
        odd = 0 if self.pixels % 2 else self.across - 1  # sample N//2 is the chief ray's, as pixel N//2 is
        return self.pixels * self.across + odd, self.pixel_um / self.across

    def light(self, fine: np.ndarray) -> np.ndarray:
        """Return unit-sum pictures, (…, pixels, pixels), from `fine` samples of an intensity."""
        used = self.pixels * self.across
        light = fine if self.across == 1 else bin_samples(fine[..., :used, :used], self.pixels, self.across)
        values = np.asarray(light, dtype=float)
        unit: np.ndarray = values / values.sum((-2, -1), keepdims=True)
        return unit


@dataclass(frozen=True, eq=False)
class LensSpace:
    """A lens as it is used, the ranges of its point sources, and the window.

    ``near_mm``, ``far_mm``: depths; ``slopes``: fields; ``wavelengths_um``; each from the first to the last. Places in
    it are (1/depth, slope, wavelength), each mapped to 0…1 from the nearest depth, the first slope and the shortest
    wavelength. ``f_number``: what the lens was stopped down to, None where it is as its file has it.
    """

    lens: Lens
    near_mm: float
    far_mm: float
    slopes: tuple[float, float]
    wavelengths_um: tuple[float, float]
    window: Window
    f_number: float | None = None

    @property
    def spread(self) -> tuple[bool, bool, bool]:
        """Return which of depth, field and wavelength vary at all."""
        return (
            self.near_mm < self.far_mm,
            self.slopes[0] < self.slopes[1],
            self.wavelengths_um[0] < self.wavelengths_um[1],
        )

    def at(self, cube: np.ndarray) -> SpacePoints:
        """Return the points at places (n, 3) in 0…1."""
        near, far = float(vergence(self.near_mm)), float(vergence(self.far_mm))
        depth = 1 / (near + cube[:, 0] * (far - near))
        slope = self.slopes[0] + cube[:, 1] * (self.slopes[1] - self.slopes[0])
        wavelength = self.wavelengths_um[0] + cube[:, 2] * (self.wavelengths_um[1] - self.wavelengths_um[0])
        return SpacePoints(np.clip(depth, self.near_mm, self.far_mm), slope, wavelength, cube)

    def random(self, count: int, seed: int) -> SpacePoints:
        """Return points at random, even over 1/depth, slope and wavelength."""
        cube = np.random.default_rng(seed).random((count, 3))
        return self.at(np.where(self.spread, cube, 0.0))

    def grid(self, counts: tuple[int, int, int]) -> SpacePoints:
        """Return even nodes from end to end along depth, field and wavelength, the last fastest; 1: the middle."""
        axes = [axis_nodes(count) for count in counts]
        return self.at(np.array(list(product(*axes))))

    def nodes(self, depths: int, fields: int, wavelengths: int) -> Space:
        """Return the same space with even nodes, as databases take it."""
        slopes = np.linspace(*self.slopes, fields) if self.spread[1] else np.array(self.slopes[:1])
        waves = np.linspace(*self.wavelengths_um, wavelengths) if self.spread[2] else np.array(self.wavelengths_um[:1])
        return Space(depth_nodes(self.near_mm, self.far_mm, depths), slopes, waves)


def axis_nodes(count: int) -> np.ndarray:
    """Return even nodes on 0…1, the middle if only one."""
    return np.linspace(0, 1, count) if count > 1 else np.array([0.5])


def lens_space(lens: Lens, pixels: int = PIXELS) -> LensSpace:
    """Return the space in which a lens is compared, by one rule for all lenses.

    Depths: from (almost) infinity to where the paraxial defocus differs by DEFOCUS_WAVES; for a lens without a useful
    image of infinity, as much to either side of its focus. Fields: the file's, from the axis on. Wavelengths: the
    file's, from end to end. The lens is stopped down by whole stops until no phase is steeper than STEEPEST_WAVES.
    The window holds every ray and AIRY_RADII more; a pixel is as wide as that asks, λ/(4 NA) at least.
    Raises GeometryError where even the smallest stop does not do.
    """
    for f_number in (None, *F_NUMBERS):
        opened = lens if f_number is None else with_f_number(lens, f_number)
        if f_number is not None and not _smaller(opened, lens):
            continue
        try:
            depths = _depths(opened)
            slopes = _slopes(opened, depths)
            window = _window(opened, depths, slopes, pixels)
        except GeometryError as error:
            steep = error
        else:
            return LensSpace(opened, *depths, slopes, _waves(opened), window, f_number)
    raise steep


def _smaller(opened: Lens, lens: Lens) -> bool:
    return float(find_stop(opened).semi_diameter) < float(find_stop(lens).semi_diameter) * (1 - 1e-9)


def _depths(lens: Lens) -> tuple[float, float]:
    """Return the nearest and the farthest depth, mm."""
    if not lens.mask.clear:
        raise GeometryError("the descriptions compared are of a clear round stop; remove the mask")
    check_aligned(lens, Message("a comparison of descriptions"))
    far_waves = _defocus(lens, inf)
    if abs(far_waves) > USEFUL_WAVES:
        focus = _depth_at(lens, 0.0, (NEAREST_MM, LARGE_MM))
        low, high = (_depth_at(lens, w, (focus / 1.5, focus * 1.5)) for w in (-DEFOCUS_WAVES / 2, DEFOCUS_WAVES / 2))
        return low, high
    nearest = NEAREST_FOCAL * float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length)
    span = _defocus(lens, nearest) - far_waves
    if abs(span) > DEFOCUS_WAVES:
        nearest = _depth_at(lens, far_waves + copysign(DEFOCUS_WAVES, span), (nearest, LARGE_MM))
    return nearest, FAR * nearest


def _defocus(lens: Lens, depth_mm: float) -> float:
    return float(coefficients(lens, depth_mm, 0.0, lens.reference_wavelength_um).wd)


def _depth_at(lens: Lens, waves: float, between_mm: tuple[float, float]) -> float:
    """Return the nearest depth at which the paraxial defocus passes so many waves, mm."""
    from scipy.optimize import brentq

    def miss(log: float) -> float:
        return _defocus(lens, float(np.exp(log))) - waves

    low, high = np.log(between_mm).tolist()
    tried = np.linspace(low, high, TRIED)
    signs = np.sign([miss(log) for log in tried])
    first = int(np.flatnonzero(signs[1:] != signs[:-1])[0])
    return float(np.exp(brentq(miss, tried[first], tried[first + 1])))


def _slopes(lens: Lens, depths: tuple[float, float]) -> tuple[float, float]:
    """Return the field slopes; of a lens for near objects those of heights seen at the stated angles from its front."""
    largest = float(slope_from_degrees(lens.widest_field_deg))
    if depths[1] / depths[0] < FAR / 2:
        middle = (depths[0] + depths[1]) / 2
        largest = abs(float(field_from_object_height(lens, middle, lens.reference_wavelength_um, largest * middle)))
    return 0.0, largest


def _waves(lens: Lens) -> tuple[float, float]:
    return min(lens.wavelengths_nm) / NM_PER_UM, max(lens.wavelengths_nm) / NM_PER_UM


def _window(lens: Lens, depths: tuple[float, float], slopes: tuple[float, float], pixels: int) -> Window:
    """Return the window of all corners and edge middles. Raises GeometryError for a phase that is too steep or lost."""
    waves = _waves(lens)
    width, finest = 0.0, inf
    for depth, part, wave in product(depths, EDGE, waves):
        steep = fit(lens, Source(depth, slopes[0] + part * (slopes[1] - slopes[0]), wave)).steepness
        if steep.radial > STEEPEST_WAVES:
            raise GeometryError("the phase is {slope:.0f} waves steep; stop the lens down", slope=steep.radial)
        width = max(width, 2 * (steep.radial + AIRY_RADII * AIRY_RADIUS) / steep.spread)
        finest = min(finest, 1 / (4 * steep.spread))
    pixel = max(width / pixels, finest)
    return Window(pixels, pixel, ceil(pixel / finest * (1 - ROUNDING)) | 1)
