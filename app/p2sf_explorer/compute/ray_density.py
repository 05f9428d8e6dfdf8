"""The PSF where blur dwarfs diffraction: the density of rays on the sensor. No Qt in here.

A wave sum over a blur of hundreds of wavelengths of slope takes seconds and shows, at 64 pixels, nothing but the
density of rays; so the window shows that density at once and says so.
"""

from functools import lru_cache
from time import perf_counter

import numpy as np

from p2sf.conventions import UM_PER_MM, protected
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.result import Psf
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.mask_nodes import throughput
from p2sf.raytrace.aiming import SUM_AIM_ERROR
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.seen_mask import mask_seen
from p2sf_explorer.compute.ranges import focused_distance
from p2sf_explorer.compute.setup import ParaxialSetup

GRIDS = {"preview": (64, 180), "settled": (128, 360)}  # radii, directions of the half disc
TOO_FAR = 2.0  # times the distance a lens is focused at
MOST_LIGHT, AROUND = 0.9, 1.25  # nine tenths of the light of an even disc lie within 1/1.18 of its half width
MOST_PIXELS = 128  # on a side: as many as the rays fill evenly
TRACED = {"preview": (12, 24), "settled": (20, 48)}  # exact rays, interpolated to the above

WITHIN = 3  # parts of a cell's sides, at which a mask's edges are looked for
SLOPE_STEP = 1e-4
NOTHING = np.zeros(())

Landing = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Two coordinates of each ray of the half disc, and its weight, (radii, directions)."""


def geometric_psf(
    setup: ParaxialSetup, exact: bool, window: tuple[int, float], quality: str = "settled", clip: bool = False
) -> Psf:
    """Return the ray density over a window (pixels, µm per pixel): of exact rays, or of the Seidel wavefront's.

    Raises GeometryError where no ray reaches the window.
    """
    begun, (pixels, pixel_um) = perf_counter(), window
    x, y, weight = exact_landing(setup, quality, clip) if exact else seidel_landing(setup, GRIDS[quality])
    blocks = max(1, pixels // MOST_PIXELS)
    mask, around = mask_seen(setup.lens, setup.source), exact and setup.lens.misaligned
    if mask.clear and not around:
        values = density(x, y, weight, pixels // blocks, pixel_um * blocks)
    elif mask.clear:
        values = one_sided(x, y, weight, pixels // blocks, pixel_um * blocks)
    else:
        sides = behind(mask, setup, (x, y, weight), around)
        values = sum((one_sided(*side, pixels // blocks, pixel_um * blocks) for side in sides), start=NOTHING)
    energy = float(values.sum())
    if not energy:
        raise GeometryError("no ray reaches the sensor; {remedy}", remedy=remedy(setup, clip))
    if blocks > 1:  # finer samples would show the single rays
        values = np.kron(values, np.full((blocks, blocks), blocks**-2.0))
    radii, directions = GRIDS[quality]
    sampling = Message(
        "density of {radii} × {directions} rays; diffraction is too fine to see here",
        radii=radii,
        directions=directions,
    )
    seconds, wavelength = perf_counter() - begun, setup.source.wavelength_um
    rays = TRACED[quality][0] * TRACED[quality][1] if exact else 2
    made = "geometric", None, energy, 0, rays, sampling, seconds
    return Psf(values / energy, pixel_um, wavelength, *made, integrated=True)


def remedy(setup: ParaxialSetup, clip: bool) -> Message:
    """Return what lets light through again; a lens made for near objects needs a nearer source."""
    if setup.source.depth_mm > TOO_FAR * focused_distance(setup.lens):
        return Message("this lens is for near objects, so choose a nearer depth")
    if not setup.source.field_slope:
        return Message("stop down, or leave clipping off") if clip else Message("stop down")
    if clip:
        return Message("choose a smaller field, stop down, or leave clipping off")
    return Message("choose a smaller field or stop down")


def main_reach_um(setup: ParaxialSetup, exact: bool, clip: bool = False) -> float:
    """Return the half width of the square about the chief ray that holds most of the light, and some room, µm.

    A fast lens throws a few rays ten times as far as the rest; a window as wide as they reach would show one dot.
    """
    grid, around = TRACED["preview"], exact and setup.lens.misaligned
    if exact:
        x, y = traced_landing(setup.lens, setup.source, grid, clip)
        weight = polar(*grid, around)[2]
    else:
        x, y, weight = seidel_landing(setup, grid)
    mask = mask_seen(setup.lens, setup.source)
    if not mask.clear:
        x, y, weight = (np.stack(column) for column in zip(*behind(mask, setup, (x, y, weight), around), strict=True))
    out = np.maximum(np.abs(x), np.abs(y)).ravel()
    order = np.argsort(out)
    light = np.cumsum(np.where(np.isfinite(out), weight.ravel(), 0.0)[order])
    if not light[-1]:
        return 0.0
    return AROUND * float(out[order][np.searchsorted(light, MOST_LIGHT * light[-1])])


def seidel_landing(setup: ParaxialSetup, grid: tuple[int, int]) -> Landing:
    """Return where the rays of W land, µm from the chief ray, and their weights: −∇W·λ/(n′u′) (Welford 1986, §7.2)."""
    c = setup.coefficients
    xi, eta, weight = polar(*grid)
    square, focus = xi * xi + eta * eta, float(c.w20 + c.wd)
    along_xi = 4 * c.w40 * square * xi + 2 * c.w31 * xi * eta + 2 * focus * xi
    along_eta = 4 * c.w40 * square * eta + c.w31 * (square + 2 * eta * eta) + 2 * c.w22 * eta + 2 * focus * eta
    scale = setup.source.wavelength_um / float(c.reduced_slope)
    return scale * along_xi, scale * along_eta, weight


def exact_landing(setup: ParaxialSetup, quality: str = "settled", clip: bool = False) -> Landing:
    """Return where exact rays land, µm from the chief ray, and their weights, interpolated between traced ones.

    A cell of the pupil with a lost ray at a corner is lost: its place is infinite.
    """
    coarse = traced_landing(setup.lens, setup.source, TRACED[quality], clip)
    x, y = (finely(values, GRIDS[quality]) for values in coarse)
    return x, y, polar(*GRIDS[quality], setup.lens.misaligned)[2]


@lru_cache(maxsize=4)
def traced_landing(lens: Lens, source: Source, grid: tuple[int, int], clip: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return where exact rays through the cells of a grid land, µm from the chief ray, (radii, directions).

    Kept for the frame: the window's width asks for them first.
    """
    xi, eta, _ = polar(*grid, lens.misaligned)
    rays = pencil(lens, source, xi.ravel(), eta.ravel(), clip=clip, aim_error=SUM_AIM_ERROR)
    return protected(UM_PER_MM * rays.dx.reshape(xi.shape)), protected(UM_PER_MM * rays.dy.reshape(xi.shape))


@lru_cache(maxsize=8)
def polar(radii: int, directions: int, around: bool = False) -> Landing:
    """Return ξ, η and weights of cells even in ρ and θ of the half disc ξ > 0, (radii, directions); their sum is ½.

    ``around``: of the whole disc, in as many directions, with weights whose sum is 1.
    Rings of equal area would begin so far out that an evenly lit blur has a dark hole in its middle.
    """
    rho = ((np.arange(radii) + 0.5) / radii)[:, None]
    theta = (np.arange(directions) + 0.5) * (2 if around else 1) * np.pi / directions
    weight = np.broadcast_to((2 if around else 1) * rho / (radii * directions), (radii, directions))
    return protected(rho * np.sin(theta)), protected(rho * np.cos(theta)), weight


def behind(mask: PupilMask, setup: ParaxialSetup, landing: Landing, around: bool = False) -> tuple[Landing, ...]:
    """Return where the rays of both halves of the disc land behind a mask, and their weights, which sum to 1.

    Of a landing all ``around``, it is where those of the whole disc do.
    Its phase turns the rays as it does paraxial ones: by −∇(path)/(n′u′).
    """
    x, y, weight = landing
    grid, made = (weight.shape[0], weight.shape[1]), []
    for side in (1,) if around else (1, -1):
        across, up = path_slopes(mask, grid, side, around) / -float(setup.coefficients.reduced_slope)
        made.append((side * x + across, y + up, weight * passing(mask, grid, side, around)))
    total = sum(float(part[2].sum()) for part in made) or 1.0
    return tuple((across, up, light / total) for across, up, light in made)


@lru_cache(maxsize=16)
def path_slopes(mask: PupilMask, grid: tuple[int, int], side: int, around: bool = False) -> np.ndarray:
    """Return ∂/∂ξ and ∂/∂η of a mask's path in the cells of the half disc, its left half for ``side`` −1.

    In µm per pupil radius, (2, radii, directions), by central differences.
    """
    xi, eta, _ = polar(*grid, around)
    if not mask.phased:
        return np.zeros((2, *xi.shape))
    across = mask.path_um(side * xi + SLOPE_STEP, eta) - mask.path_um(side * xi - SLOPE_STEP, eta)
    up = mask.path_um(side * xi, eta + SLOPE_STEP) - mask.path_um(side * xi, eta - SLOPE_STEP)
    return protected(np.stack([across, up]) / (2 * SLOPE_STEP))


@lru_cache(maxsize=16)
def passing(mask: PupilMask, grid: tuple[int, int], side: int, around: bool = False) -> np.ndarray:
    """Return what share of the light passes a mask in each cell of the half disc, its left half for ``side`` −1."""
    radii, directions = grid
    xi, eta, _ = polar(WITHIN * radii, WITHIN * directions, around)
    light = mask.opens(side * xi, eta) * np.square(mask.amplitude(side * xi, eta))
    return protected(light.reshape(radii, WITHIN, directions, WITHIN).mean(axis=(1, 3)))


def finely(values: np.ndarray, grid: tuple[int, int]) -> np.ndarray:
    """Return values of coarse polar cells on the cells of a finer grid, straight lines in ρ and θ."""
    radii, directions = (_between(coarse, fine) for coarse, fine in zip(values.shape, grid, strict=True))
    lost = ~np.isfinite(values)
    found = radii @ np.where(lost, 0.0, values) @ directions.T
    return np.where(np.abs(radii) @ lost @ np.abs(directions).T > 0, np.inf, found) if lost.any() else found


@lru_cache(maxsize=8)
def _between(coarse: int, fine: int) -> np.ndarray:
    """Return the linear interpolation from ``coarse`` cell centres to ``fine`` ones.

    Beyond the outermost centres the lines go on straight: ρ reaches the rim, where the farthest rays are.
    """
    known, wanted = ((np.arange(n) + 0.5) / n for n in (coarse, fine))
    left = np.clip(np.searchsorted(known, wanted) - 1, 0, coarse - 2)
    part = (wanted - known[left]) / (known[left + 1] - known[left])
    matrix = np.zeros((fine, coarse))
    matrix[np.arange(fine), left], matrix[np.arange(fine), left + 1] = 1 - part, part
    return matrix


def density(x: np.ndarray, y: np.ndarray, weight: np.ndarray, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the share of the light that falls on each pixel, mirror half included; (pixels, pixels)."""
    return one_sided(x, y, weight, pixels, pixel_um, mirrored=True)


def one_sided(
    x: np.ndarray, y: np.ndarray, weight: np.ndarray, pixels: int, pixel_um: float, mirrored: bool = False
) -> np.ndarray:
    """Return the share of the light that falls on each pixel, of the rays alone or of their mirror half too.

    Each ray is shared by the four pixels about its place, in proportion to how near it is to each, so that rays which
    stand in a pattern of their own leave none in the picture (cloud in cell: Birdsall & Fuss 1969).
    """
    middle, side = pixels // 2, pixels + 4  # room at the edges for what hangs over, and for what lies beyond
    column, row = (np.clip(v / pixel_um, -middle - 1, middle + 1) + (middle + 1) for v in (x, y))
    left, low = column.astype(np.intp), row.astype(np.intp)
    at, high = low * side + left, weight * (row - low)
    counted = np.zeros(side * side)
    for step, light in ((0, weight - high), (side, high)):
        right = light * (column - left)
        counted += np.bincount((at + step).ravel(), (light - right).ravel(), side * side)
        counted += np.bincount((at + step + 1).ravel(), right.ravel(), side * side)
    half = counted.reshape(side, side)[1 : pixels + 1, 1 : 2 * middle + 2]  # the chief ray's column in its middle
    return (half + half[:, ::-1])[:, :pixels] if mirrored else half[:, :pixels]


def over_unaberrated(psf: Psf, setup: ParaxialSetup) -> np.ndarray:
    """Return a ray density in units of the unaberrated peak, whose share of light on a sample is π(NA·pixel/λ)²."""
    share = np.pi * (float(setup.coefficients.na) * psf.pixel_um / setup.source.wavelength_um) ** 2
    mask = mask_seen(setup.lens, setup.source)
    spreading = 1.0 if mask.clear else throughput(mask).spreading  # a mask that dims the edge lowers its peak
    found: np.ndarray = psf.values * (float(psf.energy or 0.0) / share * spreading)
    return found
