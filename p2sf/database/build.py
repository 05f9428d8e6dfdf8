"""Building a database: trace where it must, keep the numbers, measure what was lost."""

from dataclasses import replace

import numpy as np

from p2sf.database.departure import cell_middles, departures, largest, path_scale, scattered
from p2sf.database.exact import ExactDatabase, exact_series
from p2sf.database.grid import RULES, GridDatabase, traced_grid
from p2sf.database.space import Space
from p2sf.errors import DatabaseError
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import Stop, find_stop
from p2sf.paraxial.seidel import coefficients

INTERPOLANTS = ("exact", *RULES)
# A smooth glass needs some 20 terms over the visible; what still departs at 192 is not smooth.
TERMS = (24, 48, 96, 192)
TOLERANCE = 1e-12
ROUND_OFF = 1e-13
HELD_OUT = 64


def build_database(lens: Lens, space: Space, interpolant: str = "exact", stop: Stop | None = None):
    """Return the coefficient database of a lens over ``space``, at one stop for all depths.

    ``interpolant``: "exact" (polynomials, exact to round-off), "table1" (the rule of Pieroni et al. 2015,
    table 1) or "linear". What the interpolant loses against direct evaluation is in ``errors``, in waves.
    Raises DatabaseError, GeometryError and GlassError.
    """
    if interpolant not in INTERPOLANTS:
        raise DatabaseError(f'interpolant "{interpolant}" is unknown; choose {", ".join(INTERPOLANTS)}')
    stop = stop or find_stop(lens)
    if np.ndim(stop.surface):
        raise DatabaseError("the stop changes with depth or wavelength; a database holds one stop, choose it")
    return _exact(lens, space, stop) if interpolant == "exact" else _grid(lens, space, interpolant, stop)


def _exact(lens: Lens, space: Space, stop: Stop) -> ExactDatabase:
    points = scattered(space, HELD_OUT)
    direct = coefficients(lens, *points, stop)
    floor = ROUND_OFF * path_scale(direct)
    allowed = {kind: TOLERANCE * top + floor for kind, top in largest(direct).items()}
    for terms in TERMS if np.ptp(space.wavelengths_um) else (1,):
        database = ExactDatabase(space, *exact_series(lens, space, stop, terms), lens.sensor_mm, {})
        errors = departures(database.coefficients(*points), direct)
        if all(errors[kind] <= allowed[kind] for kind in allowed):
            return replace(database, errors=errors)
    worst = max(errors, key=lambda kind: errors[kind] / allowed[kind])
    raise DatabaseError(
        f"{worst} is {errors[worst]:.2g} waves off with {terms} terms in wavelength, so the glass data have a kink "
        "between the wavelengths asked; build with the linear interpolant, or narrow the wavelengths"
    )


def _grid(lens: Lens, space: Space, interpolant: str, stop: Stop) -> GridDatabase:
    database = GridDatabase(space, traced_grid(lens, space, stop), interpolant, {})
    points = cell_middles(space, database.last_depth_mm)
    return replace(database, errors=departures(database.coefficients(*points), coefficients(lens, *points, stop)))
