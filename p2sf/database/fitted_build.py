"""Building a fitted database: fits at Chebyshev nodes, more of them until points between the nodes agree."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from p2sf.database.build import build_exact
from p2sf.database.departure import scatter
from p2sf.database.fitted import Axes, FittedDatabase, axes_of, powers, split
from p2sf.database.space import Space
from p2sf.disc.mask import CLEAR
from p2sf.errors import DatabaseError
from p2sf.lens.lens import Lens, check_aligned, with_mask
from p2sf.lens.misalignment import average_azimuths
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.pupils import Stop, find_stop
from p2sf.pupil.fit import FittedPencil, Level, fit, fit_rays, fit_terms, level_rays, levels, levels_for
from p2sf.raytrace.pencil import Rays, all_reaching, on_sensor
from p2sf.threads import one_blas_thread

START = {3: (4, 4, 4), 4: (4, 5, 5, 4)}  # nodes along s, h² and wavelength, or s, h_y, h_x and wavelength
MOST_NODES = 24
TOLERANCE_WAVES = 1e-3  # RMS phase at the landing points; the fit itself is allowed three times that
HELD_OUT = {3: 12, 4: 24}  # points between the nodes, by the number of axes


ACROSS = Message("give fields along x as well, or align it")


@one_blas_thread
def build_fitted(
    lens: Lens,
    space: Space,
    stop: Stop | None = None,
    tolerance_waves: float = TOLERANCE_WAVES,
    numbers: int | None = None,
) -> FittedDatabase:
    """Return the fitted database of a lens; nodes are added until points between them agree to the tolerance.

    ``numbers`` of each fit, those of a level; by default as many as the residuals at the corners require. A lens
    without rotational symmetry requires a space whose fields fill a rectangle; any other lens may have one. Raises
    DatabaseError if MOST_NODES are not enough, GeometryError if rays do not reach the sensor.
    """
    if space.field_x_slopes is None:
        check_aligned(lens, Message("a database of fields along one line"), ACROSS)
    stop = stop or find_stop(lens)
    seidel = replace(build_exact(average_azimuths(lens), space.line, stop), space=space)
    axes = axes_of(space, seidel)
    level, left = _level_for(lens, axes, stop, numbers)
    lens = with_mask(lens, CLEAR)  # fits are over the whole disc, their residuals over its open part
    held = list(held_out(lens, space, level, stop))
    counts = [count if spread else 1 for count, spread in zip(START[len(axes.spread)], axes.spread, strict=True)]
    while max(counts) <= MOST_NODES:
        series = traced_series(lens, axes, level, counts, stop)
        database = FittedDatabase(seidel, series, level, {}, left)
        worst = max(ray_error(database, *point) for point in held)
        if worst <= tolerance_waves:
            return replace(database, errors={"phase": worst})
        counts[_least_settled(series, level)] += 2
    raise DatabaseError(
        "between {depths} × {fields} × {wavelengths} nodes the fits are still wrong by {error:.2g} waves; narrow "
        "the depths, the fields or the wavelengths, or use the seidel method",
        error=worst,
        depths=counts[0],
        fields=" × ".join(map(str, counts[1:-1])),
        wavelengths=counts[-1],
    )


def _level_for(lens: Lens, axes: Axes, stop: Stop, numbers: int | None) -> tuple[Level, float]:
    """Return the highest level required at a corner of the space, and the largest residual at that level."""
    corners = [axes.source(place) for place in product(*([-1.0, 1.0] if spread else [0.0] for spread in axes.spread))]
    level = max((fit(lens, corner, numbers, stop=stop).level for corner in corners), key=lambda level: level.numbers)
    left = max(fit(lens, corner, level.numbers, stop=stop).residual_waves for corner in corners)
    return levels(lens.aim, axes.fields.domain)[levels_for(lens).index(level)], left


def traced_series(lens: Lens, axes: Axes, level: Level, counts: Sequence[int], stop: Stop) -> np.ndarray:
    """Return the Chebyshev series from fits at the tensor of Chebyshev nodes, (*counts, numbers + 1)."""
    nodes = [np.cos(np.pi * (np.arange(count) + 0.5) / count) for count in counts]
    series = _rows_at(lens, axes, level, nodes, stop).reshape(*counts, -1)
    for axis, (points, count) in enumerate(zip(nodes, counts, strict=True)):
        kernel = np.cos(np.outer(np.arange(count), np.arccos(points))) * (2 / count)
        kernel[0] /= 2
        series = np.moveaxis(np.tensordot(kernel, series, (1, axis)), 0, axis)
    return series


def _rows_at(lens: Lens, axes: Axes, level: Level, nodes: Sequence[np.ndarray], stop: Stop) -> np.ndarray:
    """Return the numbers of all sources at the nodes, divided by `powers`: (depths, fields, waves, numbers).

    The depths and wavelengths of one field are traced together, since they share an azimuth.
    """
    depths, *fields, waves = nodes
    found = []
    for place in product(*fields):
        sources = [axes.source((depth, *place, wave)) for depth, wave in product(depths, waves)]
        rays, chief = rays_on_sensor(lens, sources, level, stop)
        terms = fit_terms(rays, level)[: 3 + level.weighted]
        numbers = np.concatenate([*terms, chief[:, -axes.fields.chief_numbers :]], axis=1)
        scale = np.stack([powers(level, source, axes.fields) for source in sources])
        rows = np.divide(numbers, scale, out=np.zeros_like(numbers), where=scale != 0)
        found.append(rows.reshape(len(depths), len(waves), -1))
    return np.moveaxis(np.array(found), 0, 1)


def rays_on_sensor(
    lens: Lens, sources: Sequence[Source], level: Level, stop: Stop | None = None
) -> tuple[Rays, np.ndarray]:
    """Return the rays of a level, (source, ray), in the sensor's axes, and chief rays' landing points, (source, 2) mm.

    The sources share one azimuth. The pupil's axes are those of the sensor as well. Raises GeometryError where a ray
    does not reach the sensor.
    """
    rays = all_reaching(on_sensor(lens, sources, *level_rays(level)[:2], stop=stop))
    return rays, np.concatenate(np.broadcast_arrays(rays.chief_x, rays.chief_y), axis=1)


def held_out(
    lens: Lens, space: Space, level: Level, stop: Stop
) -> Iterator[tuple[Source, FittedPencil, np.ndarray, np.ndarray]]:
    """Yield (source, fit, landing x, landing y in µm) at points between the nodes."""
    for point in zip(*(x.tolist() for x in scatter(space, HELD_OUT[len(space.nodes)])), strict=True):
        source = space.source(*point)
        several, _ = rays_on_sensor(lens, [source], level, stop)
        rays = several.of_source(0)
        yield source, fit_rays(rays, level, level.rays), rays.x_um, rays.y_um


def ray_error(
    database: FittedDatabase, source: Source, direct: FittedPencil, x_um: np.ndarray, y_um: np.ndarray
) -> float:
    """Return the RMS phase error in waves of looked-up numbers against the fit itself, at the landing points."""
    xi, eta, _ = level_rays(database.level)
    *terms, _ = split(database.level, database.numbers_at(source))
    wave, across, along, _ = (database.level.function(*terms) - direct.function).at(xi, eta)
    return float(np.sqrt(np.mean((wave + across * x_um + along * y_um) ** 2)))


def _least_settled(series: np.ndarray, level: Level) -> int:
    """Return the axis whose highest Chebyshev terms of the phase are the largest."""
    phase = np.abs(series[..., : level.basis.phase.count])
    tails = [phase.take([-1], axis).max() if phase.shape[axis] > 1 else 0.0 for axis in range(phase.ndim - 1)]
    return int(np.argmax(tails))
