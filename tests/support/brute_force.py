"""PSFs by brute force: every point of a square grid over the pupil is a plane wave, and all are added up.

The grid stands askew, so that no edge runs along its rows. It knows no quadrature, no symmetry and no engine of `p2sf`;
what the mask does is written out here from its numbers. A point counts for the part of its cell that the mask leaves
open; rays that a rim stops do not count, so that the error of a sum falls with the edges alone; grids grow until two
agree.
"""

from collections.abc import Callable
from itertools import product
from math import factorial

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.disc.mask import PupilMask
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import Coefficients
from p2sf.pupil.fit import FittedPencil
from p2sf.raytrace.pencil import pencil
from tests.support.waves import r_squared

SIDES = (160, 240, 360, 540, 810, 1215)  # points across the pupil
AGREED = 1e-5  # 1 − R² between two grids, of which the finer errs by a third of the coarser
INSIDE = 4  # squared, the points of a cell that tell which part of it is open
ASKEW = 0.3  # radians
AT_ONCE = 2**15  # points summed at a time
# (n, m), sin |m|θ where m < 0 (Noll 1976, table I)
NOLL = ((0, 0), (1, 1), (1, -1), (2, 0), (2, -2), (2, 2), (3, -1), (3, 1), (3, -3), (3, 3), (4, 0), (4, 2), (4, -2))

Field = tuple[np.ndarray, np.ndarray, np.ndarray]  # amplitude with phase, and fx and fy in cycles per µm, each (point,)
Description = Callable[[np.ndarray, np.ndarray], Field]  # of a pupil whose mask is open everywhere, by (ξ, η)


def mask_opens(mask: PupilMask, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return which points no part of a mask covers, from its numbers."""
    rho, angle = np.hypot(xi, eta), np.arctan2(xi, eta) - np.deg2rad(mask.turn_deg)
    across, up = rho * np.sin(angle), rho * np.cos(angle)
    opens: np.ndarray = np.hypot(across - mask.obscuration_x, up - mask.obscuration_y) >= mask.obscuration
    for k in range(mask.vanes):
        from_vane = angle - np.deg2rad(mask.vane_angle_deg + 360 * k / mask.vanes)
        opens &= (np.abs(rho * np.sin(from_vane)) >= mask.vane_width) | (np.cos(from_vane) < 0)
    for k in range(mask.blades):
        middle = np.deg2rad(mask.blade_angle_deg + 360 * (k + 0.5) / mask.blades)
        opens &= _inside_blade(mask, rho, angle - middle)
    return opens


def mask_light(mask: PupilMask, xi: np.ndarray, eta: np.ndarray, wavelength_um: float) -> np.ndarray:
    """Return amplitude and phase that a mask of plain numbers adds where it is open."""
    assert mask.phase_map is None and mask.amplitude_map is None
    rho, angle = np.hypot(xi, eta), np.arctan2(xi, eta) - np.deg2rad(mask.turn_deg)
    path = mask.cubic_um * rho**3 * (np.sin(angle) ** 3 + np.cos(angle) ** 3)
    for (n, m), value in zip(NOLL, mask.zernike_um, strict=False):
        path += value * _zernike(n, m, rho, np.pi / 2 - angle)  # which is from +ξ towards +η
    light = np.exp(-((rho / mask.apodisation) ** mask.apodisation_power))
    return light * np.exp(2j * np.pi * path / wavelength_um)


def _inside_blade(mask: PupilMask, rho: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Return what lies inside one blade's edge, a chord between corners on the rim or an arc through both."""
    half = np.pi / mask.blades
    if not mask.roundness:
        inside: np.ndarray = rho * np.cos(angle) <= np.cos(half)
        return inside
    radius = 1 / mask.roundness
    centre = np.cos(half) - np.sqrt(radius**2 - np.sin(half) ** 2)
    return np.hypot(rho * np.cos(angle) - centre, rho * np.sin(angle)) <= radius


def _zernike(n: int, m: int, rho: np.ndarray, theta: np.ndarray) -> np.ndarray:
    """Return Noll's term of RMS 1 over the disc."""
    k, f = abs(m), factorial
    radial = sum(
        (-1) ** s * f(n - s) / (f(s) * f((n + k) // 2 - s) * f((n - k) // 2 - s)) * rho ** (n - 2 * s)
        for s in range((n - k) // 2 + 1)
    )
    value: np.ndarray = np.sqrt(n + 1) * radial * (1 if m == 0 else np.sqrt(2))
    return value * (np.sin(k * theta) if m < 0 else np.cos(k * theta))


def of_rays(lens: Lens, source: Source, mask: PupilMask, clip: bool) -> Description:
    """Return exact rays behind a mask, which is as the source sees it; rays that do not arrive are dark."""

    def field(xi: np.ndarray, eta: np.ndarray) -> Field:
        rays = pencil(lens, source, xi, eta, clip)
        light = rays.amplitude * mask_light(mask, xi, eta, source.wavelength_um)
        phase, fx, fy = (np.where(rays.passed, value, 0.0) for value in (rays.phase, rays.fx, rays.fy))
        return light * np.exp(2j * np.pi * phase), fx, fy

    return field


def of_fit(found: FittedPencil, mask: PupilMask, wavelength_um: float) -> Description:
    """Return the polynomials of a fit behind a mask."""

    def field(xi: np.ndarray, eta: np.ndarray) -> Field:
        phase, fx, fy, light = found.function.at(xi, eta)
        light = light * mask_light(mask, xi, eta, wavelength_um)
        return light * np.exp(2j * np.pi * phase), fx, fy

    return field


def of_six(c: Coefficients, mask: PupilMask) -> Description:
    """Return W40ρ⁴ + W31ρ²η + W22η² + (W20 + Wd)ρ² behind a mask, evenly filled; its phase is −W (`conventions`)."""
    scale, wavelength = float(c.reduced_slope / c.wavelength_um), float(c.wavelength_um)

    def field(xi: np.ndarray, eta: np.ndarray) -> Field:
        square = xi**2 + eta**2
        waves = c.w40 * square**2 + c.w31 * square * eta + c.w22 * eta**2 + (c.w20 + c.wd) * square
        return mask_light(mask, xi, eta, wavelength) * np.exp(-2j * np.pi * waves), scale * xi, scale * eta

    return field


def within_rims(whole: Description, lens: Lens, source: Source) -> Description:
    """Return a description that is dark where rims or holes stop exact rays."""

    def field(xi: np.ndarray, eta: np.ndarray) -> Field:
        light, fx, fy = whole(xi, eta)
        return light * pencil(lens, source, xi, eta, True).passed, fx, fy

    return field


def brute_force(
    description: Description, mask: PupilMask, judged: np.ndarray, pixel_um: float
) -> tuple[np.ndarray, bool]:
    """Return the intensity (y, x) of unit sum in the window of a PSF, and whether it is known.

    That it is where a grid agrees with the one before, or with the PSF ``judged`` itself, which knows nothing of it.
    """
    before = judged
    for side in SIDES:
        here = _on_grid(description, mask, len(judged), pixel_um, side)
        if 1 - min(r_squared(judged, here), 1) <= AGREED or 1 - r_squared(before, here) <= AGREED:
            return here, True
        before = here
    return here, False


def _on_grid(description: Description, mask: PupilMask, pixels: int, pixel_um: float, side: int) -> np.ndarray:
    axis, total = centred_axis(pixels, pixel_um), np.zeros((pixels, pixels), complex)
    xi, eta, part = _cells(mask, side)
    for some in np.array_split(np.arange(xi.size), 1 + xi.size // AT_ONCE):
        field, fx, fy = description(xi[some], eta[some])
        across, along = (np.exp(2j * np.pi * np.outer(f, axis)) for f in (fx, fy))
        total += ((part[some] * field)[:, None] * along).T @ across
    intensity = np.abs(total) ** 2
    return intensity / intensity.sum()


def _cells(mask: PupilMask, side: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the cells of a grid that are not dark: ξ and η of their middles, inside the rim, and their open parts."""
    cells = (2 * np.arange(-1, side + 1) + 1 - side) / side
    u, v = (x.ravel() for x in np.meshgrid(cells, cells))
    offsets = (2 * np.arange(INSIDE) + 1 - INSIDE) / INSIDE / side
    part = np.zeros(u.size)
    for du, dv in product(offsets, offsets):
        xi, eta = _askew(u + du, v + dv)
        part += (xi**2 + eta**2 < 1) & mask_opens(mask, xi, eta)
    xi, eta = _askew(u, v)
    beyond = np.maximum(np.hypot(xi, eta), 1)  # a cell on the rim may have its middle outside
    seen = part > 0
    return (xi / beyond)[seen], (eta / beyond)[seen], part[seen] / INSIDE**2


def _askew(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return u * np.cos(ASKEW) + v * np.sin(ASKEW), v * np.cos(ASKEW) - u * np.sin(ASKEW)
