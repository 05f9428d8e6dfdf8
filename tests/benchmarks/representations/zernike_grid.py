"""Zernike coefficients on nodes of the space, as optical programs export wavefronts: a wavefront on an ellipse.

The pupil is the ellipse of image-space direction cosines that the rim's rays span, evenly lit; the wavefront over it is
a sum of Zernike polynomials (even in ξ, since the field lies along η). With its two half-axes and its middle, each PSF
takes three numbers more than its terms.
"""

from collections.abc import Iterator
from functools import partial
from itertools import product
from time import process_time

import numpy as np

from p2sf.database.fitted import steepness
from p2sf.disc.basis import PupilBasis
from p2sf.disc.quadrature import disc_nodes
from p2sf.disc.zernike import basis, terms
from p2sf.lens.source import Source
from p2sf.psf.fitted import sum_fit
from p2sf.pupil.fit import UNIFORM, FittedPencil, Level
from p2sf.raytrace.pencil import pencil
from tests.benchmarks.representations.interpolation import Counts, Rule, node_weights
from tests.benchmarks.representations.pictures import used_counts
from tests.benchmarks.representations.representation import Representation
from tests.benchmarks.representations.space import LensSpace, SpacePoints

ORDERS = 4, 6, 8
# Depths, fields and wavelengths. Of few nodes the straight line did better, of more the spline, on the lenses tried.
GRIDS: tuple[tuple[Counts, Rule], ...] = ((2, 3, 2), "linear"), ((3, 5, 3), "cubic"), ((5, 9, 5), "cubic")
RAYS = 10, 36  # radii and directions
RIM = 73
MAP = 3  # numbers of the ellipse: half-axis along x, middle and half-axis along y
VALUE_BYTES = 4


def zernike_representations(space: LensSpace, quick: bool = False) -> Iterator[Representation]:
    """Yield every order on every grid."""
    for order, (counts, rule) in product(ORDERS[1:2] if quick else ORDERS, GRIDS[1:2] if quick else GRIDS):
        yield _on_grid(space, order, used_counts(space, counts), rule)


def _on_grid(space: LensSpace, order: int, counts: Counts, rule: Rule) -> Representation:
    started = process_time()
    nodes = space.grid(counts)
    table = np.array([wavefront(space, source, order) for source in nodes.sources()], np.float32)
    seconds = process_time() - started
    grid = " × ".join(map(str, counts))
    words = f"{len(terms(order))} terms up to order {order} and {MAP} of the pupil's ellipse, {grid} nodes, {rule}"
    psf = partial(_psf, space, order, counts, rule, table)
    return Representation("Zernike grid", words, table.size, VALUE_BYTES * table.size, seconds, psf)


def wavefront(space: LensSpace, source: Source, order: int) -> np.ndarray:
    """Return optical path (µm) in Zernike terms and n' times the half-axis, middle, half-axis of direction cosines.

    In these units everything varies least with wavelength.
    """
    nodes, turn = disc_nodes(*RAYS), np.linspace(0, np.pi, RIM)
    xi, eta = np.append(nodes.xi, np.sin(turn)), np.append(nodes.eta, np.cos(turn))
    rays = pencil(space.lens, source, xi, eta)
    across = float(rays.fx[np.abs(rays.fx).argmax()])
    low, high = float(rays.fy.min()), float(rays.fy.max())
    middle, along = (high + low) / 2, (high - low) / 2
    inside = slice(0, nodes.xi.size)
    values = basis(order, rays.fx[inside] / across, (rays.fy[inside] - middle) / along)
    root = np.sqrt(nodes.weight)
    waves = np.linalg.lstsq((values * root).T, rays.phase[inside] * root, rcond=None)[0]
    waves[0] = 0.0  # the piston changes no picture
    found: np.ndarray = np.concatenate([waves, [across, middle, along]]) * source.wavelength_um
    return found


def pencil_of(numbers: np.ndarray, order: int, wavelength_um: float) -> FittedPencil:
    """Return the pencil that the numbers of `wavefront` describe: a straight map from the disc to the ellipse."""
    scaled = np.asarray(numbers, float) / wavelength_um
    phase, (across, middle, along) = scaled[:-MAP], scaled[-MAP:]
    # The polynomials of degree 1 are 2ξ and 2η, to have unit mean square.
    fx, fy = np.array([across / 2]), np.array([middle, along / 2])
    level = Level(PupilBasis(order, 1), *RAYS)
    return FittedPencil(level, level.function(phase, fx, fy, UNIFORM), 0.0, steepness(level, phase, fx, fy), np.nan, 0)


def _psf(
    space: LensSpace, order: int, counts: Counts, rule: Rule, table: np.ndarray, points: SpacePoints
) -> np.ndarray:
    found = node_weights(counts, rule, points.cube) @ table
    pixels, pixel_um = space.window.fine
    pencils = (pencil_of(row, order, wave) for row, wave in zip(found, points.wavelength_um.tolist(), strict=True))
    return np.stack([space.window.light(sum_fit(one, pixels, pixel_um)[0]) for one in pencils])
