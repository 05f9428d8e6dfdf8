"""The fitted method's numbers as Chebyshev series over the whole space, cut to what a tolerance asks for."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import product
from time import process_time

import numpy as np

from p2sf.database.fitted import FittedDatabase, powers, split
from p2sf.database.fitted_build import build_fitted
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import find_stop
from p2sf.psf.fitted import sum_fit
from p2sf.pupil.fit import fit, level_rays, levels
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.ray_field import steepness
from tests.benchmarks.representations.representation import Representation
from tests.benchmarks.representations.space import LensSpace, SpacePoints

# Most that a dropped term may change the phase where rays land, waves.
CUTS = {
    "fitted 26": (0.1, 0.03, 0.01, 3e-3, 1e-3),
    "fitted 46": (3e-3, 1e-3, 3e-4, 1e-4),
    "fitted adaptive": (3e-4, 1e-4, 1e-5),
}
ADAPTIVE_WAVES = 3e-4  # residual of a fit of as many numbers as that asks for
BUILT_WAVES = 2e-4  # interpolation error of the series before anything is cut
PLACE_BYTES, VALUE_BYTES = 2, 4
AXES = 7  # middles and half-widths of three axes, and the pupil's place


def fitted_representations(space: LensSpace, quick: bool = False) -> Iterator[Representation]:
    """Yield fits of 26 and 46 numbers and of as many as a residual asks for, each cut to several tolerances.

    Six or twelve numbers more per fit weigh the light of a pupil that fills the real stop.
    """
    known = levels(space.lens.aim)
    sizes = ("fitted 26", known[0].numbers), ("fitted 46", known[1].numbers), ("fitted adaptive", adaptive(space))
    for name, numbers in sizes:
        started = process_time()
        database = build_fitted(space.lens, space.nodes(2, 2, 2), find_stop(space.lens), BUILT_WAVES, numbers)
        seconds = process_time() - started
        for cut in CUTS[name][-1:] if quick else CUTS[name]:
            yield _cut(space, database, name, cut, seconds)


def adaptive(space: LensSpace) -> int:
    """Return how many numbers keep the residual of a fit below ADAPTIVE_WAVES in the corners of the space."""
    corners = product((space.near_mm, space.far_mm), space.slopes, space.wavelengths_um)
    return max(fit(space.lens, Source(*corner), residual_waves=ADAPTIVE_WAVES).numbers for corner in corners)


def _cut(space: LensSpace, database: FittedDatabase, name: str, cut_waves: float, seconds: float) -> Representation:
    """Return a database without the terms that change the phase by less than ``cut_waves``, in single precision."""
    started = process_time()
    kept = importance(space, database) > cut_waves
    series = np.where(kept, database.series, 0.0).astype(np.float32)
    numbers = int(kept.sum())
    nodes = " × ".join(map(str, series.shape[:3]))
    words = f"{database.level.numbers} numbers, {nodes} Chebyshev terms, those below {cut_waves:g} waves left out"
    thinned = replace(database, series=series.astype(float))
    seconds += process_time() - started
    nbytes = numbers * (VALUE_BYTES + PLACE_BYTES) + 8 * AXES
    return Representation(name, words, numbers + AXES, nbytes, seconds, partial(_psf, space, thinned))


def importance(space: LensSpace, database: FittedDatabase) -> np.ndarray:
    """Return by how much each term changes the phase of rays at most, RMS over the pupil, waves; shape of the series.

    A Chebyshev term is at most 1 and the polynomials of the pupil have unit mean square. A change of frequency counts
    as far from the chief ray as light lands, one of the amplitude 1/2π. Neither the piston, nor the mean of fy, nor the
    chief ray's height changes a picture.
    """
    level = database.level
    source = Source(space.near_mm, space.slopes[1], space.wavelengths_um[0])
    phase, fx, fy, weight, _ = split(level, powers(level, source, database.axes.fields))
    reach = _reach_um(space)
    scale = [phase, fx * reach, fy * reach, weight / (2 * np.pi) if level.weighted else weight[:0], [0.0]]
    scale[0][0] = scale[2][0] = 0.0
    found: np.ndarray = np.abs(database.series) * np.concatenate(scale)
    return found


def _reach_um(space: LensSpace) -> float:
    """Return how far from the chief ray the light lands in a corner of the space, RMS, µm."""
    xi, eta, _ = level_rays(levels(space.lens.aim)[0])
    found = []
    for depth in (space.near_mm, space.far_mm):
        source = Source(depth, space.slopes[1], space.wavelengths_um[0])
        rays = pencil(space.lens, source, xi, eta)
        landing = float(np.sqrt(np.mean(rays.x_um**2 + rays.y_um**2)))
        found.append(np.hypot(landing, steepness(rays, xi, eta).light_um))
    return float(max(found))


def _psf(space: LensSpace, database: FittedDatabase, points: SpacePoints) -> np.ndarray:
    pixels, pixel_um = space.window.fine
    pictures = [space.window.light(sum_fit(database.fit_at(s), pixels, pixel_um)[0]) for s in points.sources()]
    return np.stack(pictures)
