"""Building a database: trace the lens at its nodes, and measure what interpolation loses between them."""

from dataclasses import replace

import numpy as np

from p2sf.database.departure import cell_middles, departures, largest, path_scale, scatter
from p2sf.database.exact import ExactDatabase, exact_series
from p2sf.database.grid import RULES, GridDatabase, traced_grid
from p2sf.database.space import Space
from p2sf.disc.mask import PupilMask
from p2sf.errors import DatabaseError
from p2sf.lens.lens import Lens, check_aligned
from p2sf.lens.source import Source
from p2sf.messages import Alternatives, Message
from p2sf.paraxial.pupils import Stop, find_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.pupil.seen_mask import mask_seen
from p2sf.threads import one_blas_thread

INTERPOLANTS = ("exact", *RULES)
# A smooth glass needs some 20 terms over the visible; one that needs more than 192 is not smooth.
TERMS = (24, 48, 96, 192)
TOLERANCE = 1e-12
ROUND_OFF = 1e-13
HELD_OUT = 64
STALLED = 10  # times the tolerance: smaller errors that do not halve with twice the terms count as rounding


@one_blas_thread
def build_database(
    lens: Lens, space: Space, interpolant: str = "exact", stop: Stop | None = None
) -> ExactDatabase | GridDatabase:
    """Return the coefficient database of a lens over ``space``, at one stop for all depths.

    ``interpolant``: "exact" (polynomials, exact to round-off), "table1" (the rule of Pieroni et al. 2015, table 1) or
    "linear". Its ``errors`` against direct evaluation are in waves. A pupil mask does not change the coefficients; the
    database stores it and applies it in rendering. Raises DatabaseError, GeometryError and GlassError.
    """
    if interpolant not in INTERPOLANTS:
        raise DatabaseError(
            'interpolant "{interpolant}" is unknown; choose {interpolants}',
            interpolant=interpolant,
            interpolants=Alternatives(INTERPOLANTS),
        )
    check_aligned(lens, Message("a database of the six coefficients"), Message("build a fitted one, or align it"))
    stop = stop or find_stop(lens)
    return build_exact(lens, space, stop) if interpolant == "exact" else _grid(lens, space, interpolant, stop)


def build_exact(lens: Lens, space: Space, stop: Stop) -> ExactDatabase:
    """Return the database of polynomials, at one stop for all depths; errors as `build_database`."""
    _check_one_stop(stop)
    points = depth, slope, wavelength = scatter(space, HELD_OUT)
    direct = coefficients(lens, depth, slope, wavelength, stop)
    # The polynomials start from the ray of an infinite object, whose path may be far longer than any in the space.
    base = coefficients(lens, np.inf, 0.0, wavelength, stop)
    floor = ROUND_OFF * max(path_scale(direct), path_scale(base))
    allowed = {kind: TOLERANCE * top + floor for kind, top in largest(direct).items()}
    before = dict.fromkeys(allowed, 0.0)
    for terms in TERMS if np.ptp(space.wavelengths_um) else (1,):
        series = exact_series(lens, space, stop, terms)
        database = ExactDatabase(space, *series, lens.sensor_mm, {}, mask=mask_of(lens, space))
        database = replace(database, sensor_curvature=lens.sensor_surface.curvature)
        errors = departures(database.coefficients(*points), direct)
        # With a distant pupil, rounding errors of the direct coefficients themselves are larger than usual.
        rounded = {kind: STALLED * top if errors[kind] > before[kind] / 2 > 0 else top for kind, top in allowed.items()}
        if all(errors[kind] <= rounded[kind] for kind in allowed):
            return replace(database, errors=errors)
        before = errors
    worst = max(errors, key=lambda kind: errors[kind] / allowed[kind])
    raise DatabaseError(
        "{coefficient} is {error:.2g} waves off with {terms} terms in wavelength, so the glass data have a kink "
        "between the wavelengths asked; build with the linear interpolant, or narrow the wavelengths",
        coefficient=worst,
        error=errors[worst],
        terms=terms,
    )


def mask_of(lens: Lens, space: Space) -> PupilMask:
    """Return the pupil mask in the coordinates of a source whose chief ray lands at +y."""
    return mask_seen(lens, Source(wavelength_um=float(space.wavelengths_um[len(space.wavelengths_um) // 2])))


def _check_one_stop(stop: Stop) -> None:
    if np.ndim(stop.surface):
        raise DatabaseError("the stop changes with depth or wavelength; a database holds one stop, choose it")


def _grid(lens: Lens, space: Space, interpolant: str, stop: Stop) -> GridDatabase:
    _check_one_stop(stop)
    database = GridDatabase(space, traced_grid(lens, space, stop), interpolant, {}, mask=mask_of(lens, space))
    points = depth, slope, wavelength = cell_middles(space, database.last_depth_mm)
    direct = coefficients(lens, depth, slope, wavelength, stop)
    return replace(database, errors=departures(database.coefficients(*points), direct))
