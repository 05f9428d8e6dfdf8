"""Kernels of wide blurs: the density of rays over the pixels, which average what diffraction would add (handbook 10.1).

A sum of waves takes a transform as wide as the blur and as fine as its fringes. Rays cost the same however wide it
is, and one that is lost on its way leaves dark no more than its own place.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import cos, pi, sin

import numpy as np

from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.mask_cells import turned_back
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_rays
from p2sf.lens.source import Source
from p2sf.pixel_kernels.nodes import hats
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.pencil import pencil

TRACED = 40, 120  # steps of radius, and of direction in each half of the disc: exact rays at their ends
FINER = 5  # times as many cells either way, with rays interpolated between the exact ones
CELLS = 7  # along the side of a pixel, in which rays are counted where part of it is sensitive


@dataclass(frozen=True, eq=False)
class RaySpread:
    """Where the light of a pencil lands, in the axes of its field, µm from the chief ray, and its shares.

    Half a pencil has two ``sides``, 1 as it is and −1 mirrored; that of a lens without symmetry is whole.

    ``x_um``, ``y_um``, ``light``: (radii, directions). ``reach_um``: the radius that holds all light.
    ``radius``: the largest spatial frequency, cycles/µm. ``lost``: share of the pupil whose rays do not arrive.
    ``mask``: what of the light stands in the pupil keeps, in the axes of the field at +y; the shares are those without.
    """

    x_um: np.ndarray
    y_um: np.ndarray
    light: np.ndarray
    reach_um: float
    radius: float
    lost: float
    mask: PupilMask = CLEAR
    sides: tuple[int, ...] = (1, -1)

    def passing(self, side: int, angle: float) -> np.ndarray:
        """Return the shares of light that pass the mask, (radii, directions): the half pencil's, its mirror's for −1.

        ``angle`` of the field, radians from +y towards +x.
        """
        if self.mask.clear:
            return self.light
        xi, eta = turned_back(*_grid(len(self.sides)).at_middles(side), np.asarray(angle))
        return np.where(self.mask.opens(xi, eta), self.light * self.mask.amplitude(xi, eta) ** 2, 0.0)


def ray_spread(lens: Lens, source: Source, clip: bool = False) -> RaySpread:
    """Return the rays of one source; GeometryError where none reaches the sensor, and behind a phase, which bends them.

    A cell's light is that of the sum of waves, amplitude²·|∂(ξ, η)/∂f|·dξ dη (Parseval).
    """
    sides, mask = lens.pupil_domain.images, mask_seen(lens, source)
    grid = _grid(len(sides))
    check_rays(lens)
    rays = pencil(lens, source, grid.xi.ravel(), grid.eta.ravel(), clip).along_axis(lens)
    passed = rays.passed.reshape(grid.xi.shape)
    if not passed.any():
        raise GeometryError("no ray reaches the sensor; choose a smaller field or stop the lens down")
    share = grid.at_cells(passed.astype(float))
    columns = (column.reshape(passed.shape) for column in (rays.x_um, rays.y_um, rays.amplitude))
    x, y, amplitude = (grid.between_passed(column, passed, share) for column in columns)
    area = grid.at_cells(grid.frequency_area(rays.fx.reshape(passed.shape), rays.fy.reshape(passed.shape)))
    light = share * amplitude**2 * grid.rho**2 / area
    light /= light.sum() * len(sides)
    lost = 1 - float((share * grid.rho).sum() / (grid.rho + 0 * share).sum())
    spread = float(np.nanmax(np.hypot(rays.fx, rays.fy)))
    made = RaySpread(x, y, light, 0.0, spread, lost, mask.round_part, sides)
    reach = np.where(made.passing(1, 0.0) > 0, np.hypot(x, y), 0.0).max()
    return replace(made, reach_um=float(reach), mask=mask)


@dataclass(frozen=True, eq=False)
class _Grid:
    """Exact rays over the disc or its half ξ ≥ 0, and the matrices that carry their values to cells between them."""

    radii: np.ndarray
    directions: np.ndarray
    to_radii: np.ndarray
    to_directions: np.ndarray
    rho: np.ndarray
    theta: np.ndarray

    @property
    def xi(self) -> np.ndarray:
        """Return ξ of the rays, (radii, directions)."""
        return np.outer(self.radii, np.sin(self.directions))

    @property
    def eta(self) -> np.ndarray:
        """Return η of the rays, (radii, directions)."""
        return np.outer(self.radii, np.cos(self.directions))

    def at_cells(self, values: np.ndarray) -> np.ndarray:
        """Return values on the rays at the cells between them, linear in radius and direction."""
        found: np.ndarray = self.to_radii @ values @ self.to_directions
        return found

    def at_middles(self, side: int) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η of the cells' middles, (radii, directions); of the mirror half for ``side`` −1."""
        return side * self.rho * np.sin(self.theta), self.rho * np.cos(self.theta)

    def between_passed(self, values: np.ndarray, passed: np.ndarray, share: np.ndarray) -> np.ndarray:
        """Return values at the cells, interpolated between those rays about a cell that arrived; 0 where none did."""
        found: np.ndarray = self.at_cells(np.where(passed, values, 0.0)) / np.where(share > 0, share, 1.0)
        return found

    def frequency_area(self, fx: np.ndarray, fy: np.ndarray) -> np.ndarray:
        """Return |∂(fx, fy)/∂(ρ, θ)| by central differences; beside a lost ray, of the mean |∂(fx, fy)/∂(ξ, η)|."""
        (x_out, x_round), (y_out, y_round) = (np.gradient(f, self.radii, self.directions) for f in (fx, fy))
        area = np.abs(x_out * y_round - x_round * y_out)
        known, rho = np.isfinite(area), np.broadcast_to(self.radii[:, None], area.shape)
        found: np.ndarray = np.where(known, area, rho * (area[known].sum() / rho[known].sum()))
        return found


@lru_cache(maxsize=2)
def _grid(sides: int) -> _Grid:
    ends, counts = (1.0, 2 * pi / sides), (TRACED[0], 2 * TRACED[1] // sides)
    radii, directions = (np.linspace(0, end, count + 1) for end, count in zip(ends, counts, strict=True))
    middles = [(np.arange(FINER * n) + 0.5) * (end / (FINER * n)) for end, n in zip(ends, counts, strict=True)]
    return _Grid(
        radii, directions, hats(radii, middles[0]).T, hats(directions, middles[1]), middles[0][:, None], middles[1]
    )


def ray_kernel(
    spread: RaySpread, angle: float, half: int, pixel_um: float, shift_um: tuple[float, float] = (0.0, 0.0)
) -> np.ndarray:
    """Return the share of a point's light per pixel, (2·half + 1,)² float32 of unit sum, row 0 at the top.

    As `pixels.pixel_kernel`, from rays. Raises GeometryError where no ray lands in the window.
    """
    total = _landing(spread, angle, half, pixel_um, shift_um)
    if not total.any():
        raise GeometryError("no ray lands within {half} pixels of the chief ray; take larger pixels", half=half)
    kernel: np.ndarray = (total / total.sum()).astype(np.float32)
    return kernel


def _landing(
    spread: RaySpread, angle: float, half: int, pixel_um: float, shift_um: tuple[float, float] = (0.0, 0.0)
) -> np.ndarray:
    """Return the share of all light that lands on each pixel, (2·half + 1,)², row 0 at the top."""
    size, sine, cosine = 2 * half + 1, sin(angle), cos(angle)
    total = np.zeros(size * size)
    for side in spread.sides:
        across, light = side * spread.x_um, spread.passing(side, angle)
        x = across * cosine + spread.y_um * sine + shift_um[0]
        y = spread.y_um * cosine - across * sine + shift_um[1]
        column, row = np.rint(x / pixel_um) + half, half - np.rint(y / pixel_um)
        inside = (column >= 0) & (column < size) & (row >= 0) & (row < size)
        place = (row[inside] * size + column[inside]).astype(np.intp)
        total += np.bincount(place, light[inside], total.size)
    return total.reshape(size, size)


def part_filled_rays(spread: RaySpread, half: int, pixel_um: float, fill_factor: float) -> np.ndarray:
    """Return the share of a point's light that each pixel's sensitive square receives, as `pixels.part_filled_kernel`.

    From rays counted in `CELLS`² cells of every pixel, each cell with the part of it that is sensitive.
    """
    size, side = 2 * half + 1, fill_factor**0.5
    fine = _landing(spread, 0.0, CELLS * half + CELLS // 2, pixel_um / CELLS)
    edges = np.linspace(-0.5, 0.5, CELLS + 1)
    inside = np.clip(edges, -side / 2, side / 2)
    part = CELLS * np.diff(inside)
    cells = fine.reshape(size, CELLS, size, CELLS)
    kernel: np.ndarray = np.einsum("iajb,a,b->ij", cells, part, part)
    return kernel
