"""Nodes in the field where coma and astigmatism of a misaligned lens vanish (handbook 8.5).

To third order every surface of a misaligned lens has the aberrations of an aligned one about a field centre of its own
(R. A. Buchroeder 1976; R. V. Shack & K. Thompson, *Proc. SPIE* 251, 146 (1980)). So coma is linear in the field and
vanishes at one point, astigmatism is quadratic and vanishes at two (K. Thompson, *JOSA A* 22, 1389 (2005)).

A field, and the direction of an aberration, is a complex number here, the part along y plus i times that along x: H =
tan(angle in y) + i·tan(angle in x). In Seidel's sums S_II and S_III of a surface the chief ray's Ā and ȳ become such
numbers, those of the symmetric lens times H plus those of the chief ray of H = 0, which is traced exactly. Nothing is
divided by Ā, so that a surface concentric with the pupil needs no field centre at infinity.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial.polynomial import polyval

from p2sf.conventions import UM_PER_MM, degrees_from_slope, slope_from_degrees
from p2sf.disc.quadrature import whole_disc
from p2sf.disc.zernike_terms import ZernikeTerm, zernike_values
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.misalignment import displaced
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import ParaxialRays, paraxial_rays
from p2sf.paraxial.seidel import seidel_sums
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.chief_ray import check_chief_ray
from p2sf.raytrace.pencil import displayed_opd
from p2sf.raytrace.trace import run
from p2sf.threads import one_blas_thread
from p2sf.tolerance.errors_of_build import MOVES, UNITS, Kind, placement_of

RAYS = 8, 16  # radii and directions: coma and astigmatism of a wavefront up to degree 12, exactly
STEP = 1e-4  # mm and degrees: the error of a difference is its square plus 1e-13 divided by it
# Seidel's W31 and W22 whose Zernike term has unit RMS: ρ³cos θ is 1/3 of coma's 3ρ³ − 2ρ with √8 and tilt, ρ²cos²θ half
# of ρ²cos 2θ with √6 and defocus (Noll 1976, table I).
COMA, ASTIGMATISM = 3 * np.sqrt(8), 2 * np.sqrt(6)
TERMS = tuple(ZernikeTerm(number, n, m) for number, n, m in ((4, 2, 0), (7, 3, -1), (8, 3, 1), (5, 2, -2), (6, 2, 2)))
NEWTON_STEPS = 12
DIFFERENCE, SETTLED = 1e-3, 1e-5  # of the widest field: aimed rays are accurate to some 1e-9
SINGULAR = 1e-3  # determinant over the sum of squares, ½ of a conformal map: on a curve of zeros there is no node
NOTHING, APART = 1e-7, 1e-3  # waves that count as zero; share of the widest field within which two nodes are one


@dataclass(frozen=True, eq=False)
class ThirdOrder:
    """Coma and astigmatism of a misaligned lens to third order, as polynomials in the field H, waves.

    W31 = ``coma`` · (1, H), W22 = ``astigmatism`` · (1, H, H²), both complex: |W31| is the peak of coma and its
    argument the direction, |W22| that of astigmatism and half its argument the direction, from +y towards +x.
    """

    coma: np.ndarray
    astigmatism: np.ndarray

    @property
    def coma_node(self) -> complex:
        """Return the field H without coma; NaN if coma is constant over the field."""
        constant, linear = self.coma.tolist()
        return complex(-constant / linear) if linear else complex(np.nan, np.nan)

    @property
    def astigmatism_nodes(self) -> np.ndarray:
        """Return the two fields H without astigmatism, (2,) complex; NaN if it is not quadratic in the field."""
        constant, linear, square = self.astigmatism.tolist()
        if not square:
            return np.full(2, complex(np.nan, np.nan))
        middle = -linear / (2 * square)
        apart = np.sqrt(complex(middle * middle - constant / square))
        return np.array([middle - apart, middle + apart])

    def at(self, field: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return W31 and W22 at fields H of any shape."""
        return polyval(field, self.coma), polyval(field, self.astigmatism)


def third_order(lens: Lens, depth_mm: float, wavelength_um: float) -> ThirdOrder:
    """Return coma and astigmatism over the field to third order, from Seidel's sums about the chief ray of H = 0.

    Exact to the first power of tilts and decentres for coma, to the second for astigmatism, except for second-order
    changes of the chief ray. Irregular surfaces add the same astigmatism to all fields. Raises GeometryError if that
    ray does not reach the sensor, and for a surface with a term in r or r³.
    """
    rays = paraxial_rays(lens, depth_mm, wavelength_um)
    heights, angles = _base_ray(lens, Source(depth_mm, 0.0, wavelength_um))
    waves = UM_PER_MM / wavelength_um / 2
    found = []
    for field in (-1.0, 0.0, 1.0):
        chief = replace(rays, chief_y=rays.chief_y * field + heights, chief_nu=rays.chief_nu * field + angles)
        sums = seidel_sums(lens, chief)
        found.append((waves * sums.coma.sum(), waves * sums.astigmatism.sum()))
    (coma_less, less), (coma, still), (coma_more, more) = found
    linear = np.array([coma, (coma_more - coma_less) / 2])
    square = (more + less) / 2 - still
    return ThirdOrder(linear, np.array([still + _astigmatism_of_irregularities(lens, rays), (more - less) / 2, square]))


def _astigmatism_of_irregularities(lens: Lens, rays: ParaxialRays) -> complex:
    """Return W22 of irregular surfaces, waves: twice the part in cos 2θ of (n′ − n)·sag over the axial beam.

    A surface raised by δ shortens the path of a ray along the axis by (n′ − n)δ.
    """
    found = 0j
    for place, surface in enumerate(lens.surfaces):
        if surface.irregularity:
            step = float(rays.index[place + 1] - rays.index[place])
            found += 2 * step * float(rays.y[place]) ** 2 * complex(*surface.irregularity.terms)
    return found * UM_PER_MM / float(rays.wavelength_um)


def _base_ray(lens: Lens, source: Source) -> tuple[np.ndarray, np.ndarray]:
    """Return the chief ray's position on every surface, mm, and its optical cosines before each and behind the last.

    Both complex, y + ix in the axes of each surface, (surfaces,) and (surfaces + 1,).
    """
    check_chief_ray(lens, source)
    beam = start(rays := pupil_rays(lens, source, np.zeros(1), np.zeros(1)))
    heights, angles = [], []

    def visit(_: int) -> None:
        heights.append(complex(beam.y[0], beam.x[0]))
        angles.append(complex(beam.q[0], beam.p[0]))

    run(lens, beam, rays.index, visit=visit)
    return np.array(heights[:-1]), np.array(angles)


@dataclass(frozen=True)
class Move:
    """One tilt or decentre of the surfaces ``first`` to ``last``, from 1, as one piece about the first vertex."""

    kind: Kind
    first: int
    last: int

    @property
    def unit(self) -> str:
        """Return the unit of its amount, mm or °."""
        return UNITS[self.kind]


@dataclass(frozen=True, eq=False)
class NodalSensitivities:
    """Contribution of each move, per mm or degree, to third order: all arrays (moves,), complex as in `ThirdOrder`.

    ``coma``: W31, waves, constant over the field. ``astigmatism``: W22 over H, waves, which grows with the field.
    ``coma_node``, ``astigmatism_middle``: shift of the node of coma and of the middle between those of astigmatism, in
    H. ``landing_um``: shift of the chief ray of H = 0 on the sensor, µm: the tilt W11 of distortion, and boresight. W40
    does not change to first order, and W20 and Wd by a tilt of the focal surface only.
    """

    moves: tuple[Move, ...]
    coma: np.ndarray
    astigmatism: np.ndarray
    coma_node: np.ndarray
    astigmatism_middle: np.ndarray
    landing_um: np.ndarray


def nodal_sensitivities(
    lens: Lens, depth_mm: float, wavelength_um: float, pieces: Sequence[tuple[int, int]]
) -> NodalSensitivities:
    """Return the effect of decentres and tilts about x and y of pieces (first and last surface) on the nodes.

    Central differences of `third_order` and of the exact chief ray. Raises GeometryError if that is lost.
    """
    moves = tuple(Move(kind, first, last) for first, last in pieces for kind in MOVES)
    rows = []
    for move in moves:
        more, less = (
            _state(displaced(lens, move.first, move.last, placement_of({move.kind: step})), depth_mm, wavelength_um)
            for step in (STEP, -STEP)
        )
        rows.append((more - less) / (2 * STEP))
    constant, linear, landing = np.reshape(rows, (-1, 3)).T
    still = third_order(lens, depth_mm, wavelength_um)
    with np.errstate(divide="ignore", invalid="ignore"):
        node, middle = -constant / still.coma[1], -linear / (2 * still.astigmatism[2])
    return NodalSensitivities(moves, constant, linear, node, middle, landing)


def _state(lens: Lens, depth_mm: float, wavelength_um: float) -> np.ndarray:
    """Return the constant part of coma, the linear part of astigmatism, and the chief ray's landing point, µm."""
    found = third_order(lens, depth_mm, wavelength_um)
    heights = _landing_um(lens, Source(depth_mm, 0.0, wavelength_um))
    return np.array([found.coma[0], found.astigmatism[1], heights])


def _landing_um(lens: Lens, source: Source) -> complex:
    beam = start(rays := pupil_rays(lens, source, np.zeros(1), np.zeros(1)))
    run(lens, beam, rays.index)
    return UM_PER_MM * complex(beam.y[0], beam.x[0])


@dataclass(frozen=True, eq=False)
class FieldAberrations:
    """Coma, astigmatism and defocus of the exact wavefront over a grid of fields, and where the first two vanish.

    ``x_deg``, ``y_deg``: the grid's angles, (nx,) and (ny,). ``coma``, ``astigmatism``: (ny, nx) complex, waves, as in
    `ThirdOrder`, of the Zernike terms of the displayed OPD, so that higher orders are included; ``defocus`` the
    coefficient of ρ², halfway between the foci, waves. NaN where rays are lost. ``coma_nodes_deg`` and
    ``astigmatism_nodes_deg``, (nodes, 2): the fields (x, y), up to the corners of the grid, where they vanish. There
    may be more or fewer than to third order; those of ``third_order`` may lie outside the field.
    """

    x_deg: np.ndarray
    y_deg: np.ndarray
    coma: np.ndarray
    astigmatism: np.ndarray
    defocus: np.ndarray
    coma_nodes_deg: np.ndarray
    astigmatism_nodes_deg: np.ndarray
    third_order: ThirdOrder


@one_blas_thread
def field_aberrations(
    lens: Lens, depth_mm: float, wavelength_um: float, x_deg: np.ndarray, y_deg: np.ndarray
) -> FieldAberrations:
    """Return coma, astigmatism and defocus at all fields (x, y) of a grid, and the nodes of exact rays.

    Nodes are found by Newton's method from those of third order and from the minima of an aberration on the grid.
    Raises GeometryError if the chief ray of the centre of the field is lost.
    """
    known = third_order(lens, depth_mm, wavelength_um)
    x, y = (np.asarray(angles, dtype=float) for angles in (x_deg, y_deg))
    every = np.array(
        [[exact_aberrations(lens, _source(depth_mm, wavelength_um, across, up)) for across in x] for up in y]
    ).reshape(y.size, x.size, 3)
    fields = slope_from_degrees(y)[:, None] + 1j * slope_from_degrees(x)

    def nodes(place: int, guesses: Sequence[complex]) -> np.ndarray:
        def value(field: complex) -> complex:
            angles = (float(degrees_from_slope(part)) for part in (field.imag, field.real))
            return exact_aberrations(lens, _source(depth_mm, wavelength_um, *angles))[place]

        least = fields[_local_minima(np.abs(every[..., place]))].tolist()
        return _nodes(value, (*guesses, *least), float(np.abs(fields).max()))

    coma, astigmatism, defocus = np.moveaxis(every, -1, 0)
    found = nodes(0, [known.coma_node]), nodes(1, known.astigmatism_nodes.tolist())
    return FieldAberrations(x, y, coma, astigmatism, defocus.real, *found, known)


def _local_minima(values: np.ndarray) -> np.ndarray:
    """Return the local minima of values over a grid, (ny, nx), bool; NaN is never one."""
    bordered = np.pad(np.where(np.isnan(values), np.inf, values), 1, constant_values=np.inf)
    rows, columns = values.shape
    shifted = [bordered[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    least: np.ndarray = np.isfinite(values) & (values <= np.min(shifted, axis=0))
    return least


def _source(depth_mm: float, wavelength_um: float, x_deg: float, y_deg: float) -> Source:
    return Source(depth_mm, wavelength_um=wavelength_um, field_deg=(float(x_deg), float(y_deg)))


def exact_aberrations(lens: Lens, source: Source) -> tuple[complex, complex, complex]:
    """Return coma, astigmatism and defocus of the displayed OPD of exact rays, waves; NaN where rays are lost.

    In the axes of the lens, as in `FieldAberrations`, for any azimuth of the source.
    """
    lost = complex(np.nan, np.nan)
    xi, eta, weight = whole_disc(*RAYS)
    try:
        waves = displayed_opd(lens, source, xi, eta)
    except GeometryError:
        return lost, lost, lost
    defocus, coma_y, coma_x, turned, upright = zernike_values(TERMS, xi, eta) @ (weight * waves)
    turn = np.exp(1j * np.deg2rad(source.azimuth_deg))
    # Zernike's angles run from +ξ, where ρ²cos 2θ is −ρ²cos 2(θ from +η).
    coma, astigmatism = complex(coma_y, coma_x) * turn, complex(-upright, turned) * turn**2
    return COMA * coma, ASTIGMATISM * astigmatism, complex(2 * np.sqrt(3) * defocus)


def _nodes(value: Callable[[complex], complex], guesses: Sequence[complex], widest: float) -> np.ndarray:
    """Return the distinct fields (x, y), degrees, found by Newton's method from some guesses, (nodes, 2)."""
    found: list[complex] = []
    for guess in guesses:
        field = _node(value, guess, widest)
        if field is not None and all(abs(field - other) > APART * widest for other in found):
            found.append(field)
    places = np.array([[field.imag, field.real] for field in found]).reshape(-1, 2)
    return np.asarray(degrees_from_slope(places))


def _node(value: Callable[[complex], complex], guess: complex, widest: float) -> complex | None:
    """Return the field H near a guess where a complex aberration vanishes, by Newton's method; None if not found."""
    step, field = DIFFERENCE * widest, guess
    for _ in range(NEWTON_STEPS):
        if not abs(field) <= widest:
            return None
        here = value(field)
        if abs(here) < NOTHING:
            return field
        # Central differences: the curvature in one-sided ones would tilt the parallel slopes on a curve of zeros.
        up, aside = ((value(field + one * step) - value(field - one * step)) / (2 * step) for one in (1, 1j))
        slopes = np.array([[up.real, aside.real], [up.imag, aside.imag]])
        if not abs(np.linalg.det(slopes)) > SINGULAR * np.square(slopes).sum():  # NaN too
            return None
        along, across = np.linalg.solve(slopes, [here.real, here.imag]).tolist()
        field -= complex(along, across)
        if np.hypot(along, across) < SETTLED * widest:
            return field if abs(field) <= widest else None
    return None
