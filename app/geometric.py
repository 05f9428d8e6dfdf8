"""The PSF where blur dwarfs diffraction: the density of rays on the sensor. No Qt in here.

A wave sum over a blur of hundreds of wavelengths of slope takes seconds and shows, at 64 pixels, nothing but the
density of rays; so the window shows that density at once and says so.
"""

from time import perf_counter

import numpy as np

from app.setting import Setting
from p2sf.conventions import UM_PER_MM
from p2sf.psf import Psf
from p2sf.raytrace import pencil

RADII, DIRECTIONS = 128, 360
TRACED = 20, 48  # exact rays, interpolated to the above


def geometric_psf(set_up: Setting, exact: bool, pixels: int, pixel_um: float) -> Psf:
    """Return the ray density over ``pixels``² samples: of exact rays, or of the rays of the Seidel wavefront."""
    begun = perf_counter()
    x, y, weight = exact_landing(set_up) if exact else seidel_landing(set_up)
    values = density(x, y, weight, pixels, pixel_um)
    strehl = float(values.max()) / unaberrated(set_up, pixel_um)
    words = f"density of {RADII} × {DIRECTIONS} rays; diffraction is too fine to see here"
    seconds, wavelength = perf_counter() - begun, set_up.source.wavelength_um
    rays = TRACED[0] * TRACED[1] if exact else 2
    return Psf(values, pixel_um, wavelength, "geometric", strehl, float(values.sum()), 0, rays, words, seconds)


def seidel_landing(set_up: Setting):
    """Return where the rays of W land, µm from the chief ray, and their weights: −∇W·λ/(n′u′) (Welford 1986, §7.2)."""
    c = set_up.coefficients
    xi, eta, weight = polar(RADII, DIRECTIONS)
    square, focus = xi * xi + eta * eta, float(c.w20 + c.wd)
    along_xi = 4 * c.w40 * square * xi + 2 * c.w31 * xi * eta + 2 * focus * xi
    along_eta = 4 * c.w40 * square * eta + c.w31 * (square + 2 * eta * eta) + 2 * c.w22 * eta + 2 * focus * eta
    scale = set_up.source.wavelength_um / float(c.reduced_slope)
    return scale * along_xi, scale * along_eta, weight


def exact_landing(set_up: Setting):
    """Return where exact rays land, µm from the chief ray, and their weights, interpolated between traced ones."""
    xi, eta, _ = polar(*TRACED)
    rays = pencil(set_up.lens, set_up.source, xi.ravel(), eta.ravel(), stop=set_up.stop)
    finer = [np.nan_to_num(finely(UM_PER_MM * v.reshape(TRACED)), nan=np.inf) for v in (rays.dx, rays.dy)]
    return *finer, polar(RADII, DIRECTIONS)[2]


def polar(radii: int, directions: int):
    """Return ξ, η and equal-area weights at cell centres in ρ² and θ of the half disc ξ > 0, (radii, directions)."""
    rho = np.sqrt((np.arange(radii) + 0.5) / radii)[:, None]
    theta = (np.arange(directions) + 0.5) * np.pi / directions
    return rho * np.sin(theta), rho * np.cos(theta), np.full((radii, directions), 0.5 / (radii * directions))


def finely(values: np.ndarray) -> np.ndarray:
    """Return values of the coarse polar cells on the fine ones, straight lines in ρ and θ."""
    coarse_rho, fine_rho = (np.sqrt((np.arange(n) + 0.5) / n) for n in (TRACED[0], RADII))
    coarse, fine = ((np.arange(n) + 0.5) / n for n in (TRACED[1], DIRECTIONS))
    along = np.stack([np.interp(fine, coarse, row) for row in values])
    return np.stack([np.interp(fine_rho, coarse_rho, column) for column in along.T]).T


def density(x, y, weight, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the weights that fall on each pixel, mirror half included, unit sum; (pixels, pixels)."""
    column, row = (np.rint(v / pixel_um).clip(-pixels, pixels) + pixels // 2 for v in (x, y))
    inside = (row >= 0) & (row < pixels)
    counted = np.zeros(pixels * pixels)
    for side in (column, 2 * (pixels // 2) - column):
        kept = inside & (side >= 0) & (side < pixels)
        place = (row[kept] * pixels + side[kept]).astype(np.intp)
        counted += np.bincount(place, weight[kept], pixels * pixels)
    return counted.reshape(pixels, pixels) / (counted.sum() or 1.0)


def unaberrated(set_up: Setting, pixel_um: float) -> float:
    """Return the share of light on one pixel at the peak of the unaberrated PSF, π(NA·pixel/λ)², by Parseval."""
    return np.pi * (float(set_up.coefficients.na) * pixel_um / set_up.source.wavelength_um) ** 2
