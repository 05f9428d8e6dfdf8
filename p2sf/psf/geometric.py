"""The geometric PSF, the density of rays on the sensor, for blur much larger than diffraction (handbook 8.3).

A wave sum over a blur of hundreds of wavelengths of slope takes seconds and shows, at 64 pixels, only the density of
rays. Each ray carries the light of its cell of the pupil, as in a spot diagram: share of the area times energy of unit
share. The field of waves is linear in the launch weight and their energy quadratic, so that their centroid differs off
axis.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from time import perf_counter

import numpy as np

from p2sf.conventions import vergence, write_protect
from p2sf.disc.domain import HALF, WHOLE, PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import throughput
from p2sf.errors import GeometryError
from p2sf.figures.psf_data import PsfFigures
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.psf.result import Psf
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.aiming import SUM_AIM_ERROR
from p2sf.raytrace.focusing import focused_vergence
from p2sf.raytrace.pencil import pencil

GRIDS = {"preview": (64, 180), "settled": (128, 360)}  # radii, directions of the half disc
TOO_FAR = 2.0  # times the distance on which a lens is focused
FARTHEST_FOCUS = 1e-6  # 1/mm: six digits in a file do not distinguish a focus at a kilometre from infinity
MOST_LIGHT, AROUND = 0.9, 1.25  # nine tenths of the light of an even disc lie within 1/1.18 of its half width
MOST_PIXELS = 128  # on a side: as many as the rays fill uniformly
TRACED = {"preview": (12, 24), "settled": (20, 48)}  # exact rays, interpolated to the above

WITHIN = 3  # subdivisions of a cell's sides at which a mask is sampled
SLOPE_STEP = 1e-4

Columns = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Two coordinates and the light of cells of the pupil, each (radii, directions)."""


@dataclass(frozen=True, eq=False)
class RayBlur:
    """Landing points of the light of pupil cells, µm from the chief ray, (radii, directions).

    ``light``: of each cell, as a share of all light that enters; if none of it arrives the point is infinite.
    ``domain``: the part of the pupil that the cells cover; light of HALF lands in the mirror image too.
    """

    x_um: np.ndarray
    y_um: np.ndarray
    light: np.ndarray
    domain: PupilDomain


def geometric_psf(
    lens: Lens,
    source: Source,
    window: tuple[int, float],
    quality: str = "settled",
    clip: bool = False,
    six: Coefficients | None = None,
) -> Psf:
    """Return the ray density over a window (pixels, µm per pixel): of exact rays, or of those of ``six`` coefficients.

    Its ``energy`` is the share of the pupil's light that lands in the window. Raises GeometryError if no ray does.
    """
    begun, (pixels, pixel_um) = perf_counter(), window
    blur, blocks = ray_blur(lens, source, quality, clip, six), max(1, pixels // MOST_PIXELS)
    values = density(blur, pixels // blocks, pixel_um * blocks)
    energy = float(values.sum())
    if not energy:
        raise GeometryError("no ray reaches the sensor; {remedy}", remedy=remedy(lens, source, clip))
    values = values / energy
    if blocks > 1:  # finer samples would show individual rays
        values = (values * blocks**-2.0).repeat(blocks, axis=0).repeat(blocks, axis=1)
    radii, directions = GRIDS[quality]
    sampling = Message(
        "density of {radii} × {directions} rays; diffraction is too fine to see here",
        radii=radii,
        directions=directions,
    )
    rays = 2 if six else TRACED[quality][0] * TRACED[quality][1]
    made = "geometric", PsfFigures(energy=energy), 0, rays, sampling, perf_counter() - begun
    return Psf(values, pixel_um, source.wavelength_um, *made, integrated=True)


def remedy(lens: Lens, source: Source, clip: bool) -> Message:
    """Return advice for a source without light; a lens designed for near objects needs a nearer source."""
    focus = focused_vergence(lens)
    if focus > max(TOO_FAR * float(vergence(source.depth_mm)), FARTHEST_FOCUS):
        return Message("this lens is for near objects, so choose a nearer depth")
    if not source.field_slope:
        return Message("stop down, or leave clipping off") if clip else Message("stop down")
    if clip:
        return Message("choose a smaller field, stop down, or leave clipping off")
    return Message("choose a smaller field or stop down")


def main_reach_um(lens: Lens, source: Source, clip: bool = False, six: Coefficients | None = None) -> float:
    """Return the half width of the square about the chief ray that contains most of the light with a margin, µm.

    In a fast lens a few rays land ten times as far away as the rest; a window for all of them would show one dot.
    """
    blur = _behind_mask(lens, source, _coarse_blur(lens, source, "preview", clip, six), six)
    out = np.maximum(np.abs(blur.x_um), np.abs(blur.y_um)).ravel()
    order = np.argsort(out)
    light = np.cumsum(np.where(np.isfinite(out), blur.light.ravel(), 0.0)[order])
    if not light[-1]:
        return 0.0
    return AROUND * float(out[order][np.searchsorted(light, MOST_LIGHT * light[-1])])


def ray_blur(
    lens: Lens, source: Source, quality: str = "settled", clip: bool = False, six: Coefficients | None = None
) -> RayBlur:
    """Return the blur of exact rays, interpolated between traced ones, or of the rays of ``six`` coefficients.

    Between a ray that arrives and one that is lost, the light of cells is interpolated linearly.
    """
    if six:
        return _behind_mask(lens, source, _seidel_blur(six, GRIDS[quality]), six)
    x, y, sent = _trace_grid(lens, source, TRACED[quality], clip)
    passed = np.isfinite(x)
    x, y = (_of_passed(values, passed, GRIDS[quality]) for values in (x, y))
    blur = _lit(x, y, finely(sent, GRIDS[quality]), lens.pupil_domain)
    blur = _behind_mask(lens, source, blur, None)
    if passed.all():
        return blur
    arriving = np.clip(finely(passed.astype(float), GRIDS[quality]), 0.0, 1.0)
    return replace(blur, light=blur.light * np.concatenate([arriving] * (len(blur.light) // len(arriving))))


def _coarse_blur(lens: Lens, source: Source, quality: str, clip: bool, six: Coefficients | None) -> RayBlur:
    """Return the blur without the mask from the traced rays alone."""
    grid = TRACED[quality]
    return _seidel_blur(six, grid) if six else _lit(*_trace_grid(lens, source, grid, clip), lens.pupil_domain)


def _seidel_blur(c: Coefficients, grid: tuple[int, int]) -> RayBlur:
    """Return the landing points of the rays of W: −∇W·λ/(n′u′) (Welford 1986, §7.2)."""
    xi, eta, share = polar(*grid)
    square, focus = xi * xi + eta * eta, float(c.w20 + c.wd)
    along_xi = 4 * c.w40 * square * xi + 2 * c.w31 * xi * eta + 2 * focus * xi
    along_eta = 4 * c.w40 * square * eta + c.w31 * (square + 2 * eta * eta) + 2 * c.w22 * eta + 2 * focus * eta
    scale = float(c.wavelength_um) / float(c.reduced_slope)
    return RayBlur(scale * along_xi, scale * along_eta, share, HALF)


def _lit(x_um: np.ndarray, y_um: np.ndarray, light: np.ndarray, domain: PupilDomain) -> RayBlur:
    """Return the blur of cells with this light per unit share."""
    light = polar(*light.shape, domain)[2] * light
    return RayBlur(x_um, y_um, light / light.sum(), domain)


@lru_cache(maxsize=4)
def _trace_grid(lens: Lens, source: Source, grid: tuple[int, int], clip: bool) -> Columns:
    """Return the landing points of exact rays through the cells of a grid, and their light per unit share.

    A ray that cannot be aimed has none. Cached, since the width of the window is computed from them first.
    """
    xi, eta, _ = polar(*grid, lens.pupil_domain)
    rays = pencil(lens, source, xi.ravel(), eta.ravel(), clip=clip, aim_error=SUM_AIM_ERROR)
    columns = rays.x_um, rays.y_um, np.nan_to_num(rays.launch * rays.transmission)
    x, y, light = (write_protect(column.reshape(xi.shape)) for column in columns)
    return x, y, light


@lru_cache(maxsize=8)
def polar(radii: int, directions: int, domain: PupilDomain = HALF) -> Columns:
    """Return ξ, η and shares of cells even in ρ and θ of a part of the disc, (radii, directions), of unit sum.

    Rings of equal area would start so far out that a uniform blur would have a dark hole in its centre.
    """
    rho = ((np.arange(radii) + 0.5) / radii)[:, None]
    theta = (np.arange(directions) + 0.5) * domain.turn / directions
    share = np.broadcast_to(2 * rho / (radii * directions), (radii, directions))
    return write_protect(rho * np.sin(theta)), write_protect(rho * np.cos(theta)), share


def _behind_mask(lens: Lens, source: Source, blur: RayBlur, six: Coefficients | None) -> RayBlur:
    """Return the blur behind the pupil mask, for both halves of the disc.

    Its phase deflects the rays like paraxial ones: by −∇(path)/(n′u′).
    """
    mask = mask_seen(lens, source)
    if mask.clear:
        return blur
    sides = blur.domain.images
    x, y, light = (np.concatenate([column] * len(sides)) for column in (blur.x_um, blur.y_um, blur.light))
    grid = blur.light.shape[0], blur.light.shape[1]
    x = np.repeat(sides, grid[0])[:, None] * x
    if mask.phased:
        six = six or coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
        slopes = np.concatenate([path_slopes(mask, grid, side, blur.domain) for side in sides], axis=1)
        across, up = slopes / -float(six.reduced_slope)
        x, y = x + across, y + up
    light = light * np.concatenate([passing(mask, grid, side, blur.domain) for side in sides])
    return RayBlur(x, y, light / (light.sum() or 1.0), WHOLE)


@lru_cache(maxsize=16)
def path_slopes(mask: PupilMask, grid: tuple[int, int], side: int, domain: PupilDomain = HALF) -> np.ndarray:
    """Return ∂/∂ξ and ∂/∂η of a mask's path in the cells of the domain, of its mirror image for ``side`` −1.

    In µm per pupil radius, (2, radii, directions), by central differences.
    """
    xi, eta, _ = polar(*grid, domain)
    across = mask.path_um(side * xi + SLOPE_STEP, eta) - mask.path_um(side * xi - SLOPE_STEP, eta)
    up = mask.path_um(side * xi, eta + SLOPE_STEP) - mask.path_um(side * xi, eta - SLOPE_STEP)
    return write_protect(np.stack([across, up]) / (2 * SLOPE_STEP))


@lru_cache(maxsize=16)
def passing(mask: PupilMask, grid: tuple[int, int], side: int, domain: PupilDomain = HALF) -> np.ndarray:
    """Return the share of light that passes a mask in each cell of the domain, of its mirror image for ``side`` −1."""
    radii, directions = grid
    xi, eta, _ = polar(WITHIN * radii, WITHIN * directions, domain)
    light = mask.opens(side * xi, eta) * np.square(mask.amplitude(side * xi, eta))
    return write_protect(light.reshape(radii, WITHIN, directions, WITHIN).mean(axis=(1, 3)))


def finely(values: np.ndarray, grid: tuple[int, int]) -> np.ndarray:
    """Return values of coarse polar cells on the cells of a finer grid, linear in ρ and θ."""
    radii, directions = (_between(coarse, fine) for coarse, fine in zip(values.shape, grid, strict=True))
    found: np.ndarray = radii @ values @ directions.T
    return found


def _of_passed(values: np.ndarray, passed: np.ndarray, grid: tuple[int, int]) -> np.ndarray:
    """Return points as `finely`, from the neighbouring rays that arrive only; infinite if none does."""
    if passed.all():
        return finely(values, grid)
    part = finely(passed.astype(float), grid)
    return np.where(part > 0, finely(np.where(passed, values, 0.0), grid) / np.where(part > 0, part, 1.0), np.inf)


@lru_cache(maxsize=8)
def _between(coarse: int, fine: int) -> np.ndarray:
    """Return the linear interpolation from ``coarse`` cell centres to ``fine`` ones.

    Beyond the outermost centres they are extrapolated: ρ reaches the rim, where the farthest rays are.
    """
    known, wanted = ((np.arange(n) + 0.5) / n for n in (coarse, fine))
    left = np.clip(np.searchsorted(known, wanted) - 1, 0, coarse - 2)
    part = (wanted - known[left]) / (known[left + 1] - known[left])
    matrix = np.zeros((fine, coarse))
    matrix[np.arange(fine), left], matrix[np.arange(fine), left + 1] = 1 - part, part
    return matrix


def density(blur: RayBlur, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the share of the light that falls on each pixel, (pixels, pixels).

    Each ray is distributed over the four pixels around it by bilinear weights, so that the regular pattern of the rays
    leaves none in the picture (cloud in cell: Birdsall & Fuss 1969).
    """
    middle, side = pixels // 2, pixels + 4  # a margin for light beyond the edges
    places = blur.x_um, blur.y_um
    column, row = (np.clip(v / pixel_um, -middle - 1, middle + 1) + (middle + 1) for v in places)
    left, low = column.astype(np.intp), row.astype(np.intp)
    at, high = low * side + left, blur.light * (row - low)
    counted = np.zeros(side * side)
    for step, light in ((0, blur.light - high), (side, high)):
        right = light * (column - left)
        counted += np.bincount((at + step).ravel(), (light - right).ravel(), side * side)
        counted += np.bincount((at + step + 1).ravel(), right.ravel(), side * side)
    own = counted.reshape(side, side)[1 : pixels + 1, 1 : 2 * middle + 2]  # the chief ray in the middle of its column
    images = blur.domain.images
    return np.asarray(sum(own[:, ::image] for image in images) / len(images))[:, :pixels]


def over_unaberrated(psf: Psf, na: float, mask: PupilMask) -> np.ndarray:
    """Return a ray density in units of the unaberrated peak, whose share of light on a sample is π(NA·pixel/λ)².

    ``mask``: in the pupil coordinates of the source.
    """
    share = np.pi * (na * psf.pixel_um / psf.wavelength_um) ** 2
    spreading = 1.0 if mask.clear else throughput(mask).spreading  # a mask that dims the edge lowers its peak
    found: np.ndarray = psf.values * (float(psf.energy or 0.0) / share * spreading)
    return found
