"""Random misaligned systems: tilted and decentred surfaces and groups, folding mirrors, tilted sensors."""

from dataclasses import replace
from math import inf

import numpy as np

from p2sf.glass.media import AIR, MIRROR, ConstantIndex
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.misalignment import displaced, folding, with_tilted_sensor
from p2sf.lens.placement import Placement


def random_placement(rng: np.random.Generator, decentre: float = 0.5, tilt: float = 3.0) -> Placement:
    """Return any break: both orders, any pivot."""
    moved, turned = rng.uniform(-decentre, decentre, 3), rng.uniform(-tilt, tilt, 3)
    pivot = rng.uniform(-20, 20, 3) * (rng.random() < 0.5)
    return Placement(*moved.tolist(), *turned.tolist(), bool(rng.random() < 0.5), tuple(pivot.tolist()))


def random_system(seed: int) -> Lens:
    """Return two to four elements of any shape, some moved as wholes or by a surface, folded up to twice."""
    rng = np.random.default_rng(seed)
    rows: list[Surface] = [Surface(thickness=rng.uniform(1, 5), semi_diameter=4.0)]
    elements, direction = [], 1
    for _ in range(rng.integers(2, 5)):
        if rng.random() < 0.4:
            tilt = Placement(
                *rng.uniform(-1, 1, 3).tolist(), *rng.uniform(-40, 40, 3).tolist(), bool(rng.random() < 0.5)
            )
            rows.append(Surface(_radius(rng, 200), -direction * rng.uniform(15, 30), MIRROR, **folding(tilt)))
            direction = -direction
        glass = ConstantIndex(rng.uniform(1.4, 1.9))
        for medium, gap in ((glass, rng.uniform(2, 6)), (AIR, rng.uniform(1, 12))):
            figure = (rng.uniform(-2, 1), tuple(rng.uniform(-1e-6, 1e-6, 2))) if rng.random() < 0.5 else (0.0, ())
            rows.append(Surface(_radius(rng, 25), direction * gap, medium, *figure))
        elements.append(len(rows) - 1)
    lens = Lens(tuple(rows), Aperture("stop_semi_diameter", 2.0), 1)
    for first in elements:
        if rng.random() < 0.7:
            lens = displaced(lens, first, first + 1, random_placement(rng))
        if rng.random() < 0.4:
            lens = displaced(lens, first, first, random_placement(rng))
    if rng.random() < 0.5:
        lens = displaced(lens, elements[0], elements[-1] + 1, random_placement(rng))
    return with_tilted_sensor(lens, random_placement(rng)) if rng.random() < 0.5 else lens


def with_irregularities(lens: Lens, seed: int) -> Lens:
    """Return the lens with half of its surfaces irregular, up to 0.05 mm from peak to valley."""
    rng = np.random.default_rng(seed)
    surfaces = [
        replace(s, irregularity=Irregularity(*rng.uniform(-130, 130, 2), 8.0)) if rng.random() < 0.5 else s
        for s in lens.surfaces
    ]
    return replace(lens, surfaces=tuple(surfaces))


def _radius(rng: np.random.Generator, least: float) -> float:
    """Return a radius of either sign, a plane now and then."""
    return inf if rng.random() < 0.15 else float(rng.choice([-1, 1]) * rng.uniform(least, 10 * least))
