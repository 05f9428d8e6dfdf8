"""The six coefficients as databases: exact polynomials, and nodes with the paper's or linear interpolation."""

from collections.abc import Iterator
from functools import partial
from time import process_time

import numpy as np

from p2sf.database.exact import ExactDatabase, exact_series
from p2sf.database.grid import GridDatabase, traced_grid
from p2sf.database.render import Database, Sampling, render_source
from p2sf.paraxial.pupils import find_stop
from tests.benchmarks.representations.representation import Representation
from tests.benchmarks.representations.space import LensSpace, SpacePoints

TERMS = 6, 24  # of a Chebyshev series in wavelength; 24 is what `build_database` starts with
GRIDS = (3, 3, 3), (5, 5, 3), (9, 9, 5)  # depths, fields, wavelengths
SCALARS = 3  # middle and half-width of 1/depth, and the sensor's place


def coefficient_representations(space: LensSpace, quick: bool = False) -> Iterator[Representation]:
    """Yield the six coefficients in every kind of database, smallest first."""
    for terms in TERMS[:1] if quick else TERMS:
        yield _exact(space, terms if space.spread[2] else 1)
        if not space.spread[2]:
            break
    for counts in GRIDS[1:2] if quick else GRIDS:
        for rule in ("table1", "linear"):
            yield _grid(space, counts, rule)


def _exact(space: LensSpace, terms: int) -> Representation:
    started = process_time()
    nodes = space.nodes(2, 2, 2)
    database = ExactDatabase(nodes, *exact_series(space.lens, nodes, find_stop(space.lens), terms), 0.0, {})
    database = database.with_sensor(space.lens.sensor_mm)
    numbers = database.series.size + SCALARS
    words = f"exact polynomials, {terms} Chebyshev terms in wavelength"
    return _representation(space, database, words, numbers, process_time() - started)


def _grid(space: LensSpace, counts: tuple[int, int, int], rule: str) -> Representation:
    started = process_time()
    nodes = space.nodes(*counts)
    grid = traced_grid(space.lens, nodes, find_stop(space.lens))
    database = GridDatabase(nodes, grid, rule, {})
    numbers = grid.depth.size + grid.wavelength.size + sum(nodes.shape)
    words = f"{rule}, {' × '.join(map(str, nodes.shape))} nodes"
    return _representation(space, database, words, numbers, process_time() - started)


def _representation(space: LensSpace, database: Database, words: str, numbers: int, seconds: float) -> Representation:
    return Representation("seidel", words, numbers, 8 * numbers, seconds, partial(_psf, space, database))


def _psf(space: LensSpace, database: Database, points: SpacePoints) -> np.ndarray:
    places = points.depth_mm, points.field_slope, points.wavelength_um
    return space.window.light(render_source(database, places, Sampling(*space.window.fine)))
