"""Random systems of every kind of surface: shapes, phases, gratings, rims, chains of breaks, in glass and mirrors."""

from dataclasses import replace
from math import inf

import numpy as np

from p2sf.glass.media import AIR, MIRROR, ConstantIndex, ModelGlass
from p2sf.lens.anamorphic import Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.grating import Grating
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.placement import Placement
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial

HALF = 4.0  # mm, within which rays meet the first surface


def _numbers(rng: np.random.Generator, size: float, count: int) -> tuple[float, ...]:
    return tuple(rng.uniform(-size, size, count).tolist())


def _radius(rng: np.random.Generator) -> float:
    return float(rng.choice([-1, 1]) * rng.uniform(25.0, 120.0))


def _base(rng: np.random.Generator) -> dict:
    return {"radius": _radius(rng), "conic": float(rng.uniform(-1.5, 1))}


def _even(rng: np.random.Generator) -> dict:
    return {**_base(rng), "aspheric": (*_numbers(rng, 1e-5, 1), *_numbers(rng, 1e-7, 1))}


def _biconic(rng: np.random.Generator, turn: float = 0.0) -> dict:
    conics = dict(zip(("conic_x", "conic_y"), _numbers(rng, 1.0, 2), strict=True))
    return {"shape": Biconic(radius_x=_radius(rng), radius_y=_radius(rng), turn_deg=turn, **conics)}


def _toroid(rng: np.random.Generator, turn: float = 0.0) -> dict:
    terms = (0.0, *_numbers(rng, 1e-5, 1), *_numbers(rng, 1e-7, 1))
    radii = {"radius_x": _radius(rng), "radius_y": _radius(rng)}
    return {"shape": Toroid(**radii, conic_y=float(rng.uniform(-1, 1)), coefficients=terms, turn_deg=turn)}


def _cylinder(rng: np.random.Generator) -> dict:
    return {"shape": Toroid(radius_x=inf, radius_y=_radius(rng), turn_deg=float(rng.choice([0.0, 90.0, 30.0])))}


def _grating(rng: np.random.Generator) -> dict:
    lines, order = float(rng.uniform(10, 300)), float(rng.integers(1, 3) * rng.choice([-1, 1]))
    return {**_base(rng), "diffraction": Grating(lines, order, float(rng.choice([0.0, 90.0, 20.0])))}


KINDS = {
    "sphere": lambda rng: {"radius": _radius(rng)},
    "conic": _base,
    "even asphere": _even,
    "odd asphere": lambda rng: {**_base(rng), "shape": RadialPolynomial((0.0, *_numbers(rng, 1e-3, 1), 1e-4, -1e-6))},
    "extended asphere": lambda rng: {**_base(rng), "shape": RadialPolynomial((0.0, 0.0, 0.0, 0.02, 0.0, 0.01), 9.0)},
    "Qcon": lambda rng: {**_base(rng), "shape": Qcon(_numbers(rng, 0.02, 4), 9.0)},
    "Qbfs": lambda rng: {**_base(rng), "shape": Qbfs(_numbers(rng, 0.02, 4), 9.0)},
    "XY polynomial": lambda rng: {**_base(rng), "shape": XYPolynomial(_numbers(rng, 0.03, 20), 9.0)},
    "Zernike standard sag": lambda rng: {**_base(rng), "shape": ZernikeStandardSag(_numbers(rng, 0.01, 13), 9.0)},
    "Zernike fringe sag": lambda rng: {**_base(rng), "shape": ZernikeFringeSag(_numbers(rng, 0.02, 13), 9.0)},
    "biconic": _biconic,
    "biconic, turned": lambda rng: _biconic(rng, float(rng.uniform(-90, 90))),
    "toroid": _toroid,
    "toroid, turned": lambda rng: _toroid(rng, float(rng.uniform(-90, 90))),
    "cylinder": _cylinder,
    "grating": _grating,
    "diffractive": lambda rng: {**_base(rng), "diffraction": Diffraction(_numbers(rng, 200.0, 2), 10.0, 1.0)},
    "ideal lens": lambda rng: {"ideal_focal_length": float(rng.uniform(50, 200))},
    "rim": lambda rng: {**_base(rng), "rim": Rim((0.3, -0.2), (3.0, 3.5))},
    "decentred rim": lambda rng: {**_base(rng), "rim": Rim((0.3, -0.2)), "semi_diameter": 3.5},
    "hole": lambda rng: {**_base(rng), "inner_radius": 1.0},
}


def breaks(rng: np.random.Generator, most: int = 3) -> tuple[Placement, ...]:
    """Return up to ``most`` breaks in any order of decentre and tilt, with pivots."""
    found = []
    for _ in range(rng.integers(0, most + 1)):
        x, y, z = _numbers(rng, 0.4, 3)
        pivot = (0.0, 0.0, float(rng.uniform(0, 5))) if rng.random() < 0.3 else (0.0, 0.0, 0.0)
        found.append(Placement(x, y, z, *_numbers(rng, 4.0, 3), bool(rng.integers(2)), pivot))
    return tuple(found)


def system_of(kind: str, seed: int, broken: bool = True) -> Lens:
    """Return a system of four surfaces, one of them of this kind, one a mirror in every third system."""
    rng = np.random.default_rng([seed, *kind.encode()])
    glass = [ConstantIndex(float(rng.uniform(1.4, 1.9))), ModelGlass(float(rng.uniform(1.5, 1.8)), 50.0)][seed % 2]
    own = {"semi_diameter": 9.0, **KINDS[kind](rng)}
    folds = seed % 3 == 0 and "ideal_focal_length" not in own
    way = -1.0 if folds else 1.0
    special = Surface(thickness=way * 6.0, medium=MIRROR if folds else AIR, **own)
    behind = Surface(_radius(rng), way * 3.0, glass, semi_diameter=20.0)
    rows = [
        Surface(thickness=2.0, semi_diameter=8.0),
        special,
        behind,
        Surface(_radius(rng), way * 30.0, semi_diameter=25.0),
    ]
    if broken:
        rows = [replace(row, before=breaks(rng), after=breaks(rng, 1)) for row in rows]
    return Lens(tuple(rows), Aperture("stop_semi_diameter", 3.0), 1, wavelengths_nm=(587.5618,))


def rays(seed: int, count: int = 12) -> tuple[np.ndarray, np.ndarray]:
    """Return origins (ray, 3), mm, and directions of random skew rays."""
    rng = np.random.default_rng(seed)
    origins = np.column_stack([rng.uniform(-HALF, HALF, (count, 2)), np.full(count, -5.0)])
    return origins, np.column_stack([rng.uniform(-0.08, 0.08, (count, 2)), np.ones(count)])
