"""Rays of other programs through tilted and decentred systems, for `tests/data/tilted_rays.json`.

``python -m tests.long.peer_tilts FOLDER > tests/data/tilted_rays.json`` where batoid and ray-optics are installed;
FOLDER holds the four files of the package rayoptics's ``codev/tests`` named below, with which it tests its reading of
tilts. Their objects are brought to 10 mm, since light from 1e11 mm has lost all digits that matter. batoid is given
`random_system`'s numbers and poses (`space_rays`), and traces them by its own formulas.
"""

import json
import sys
from pathlib import Path

import numpy as np

from tests.support.lenses.misaligned import random_system
from tests.support.rays.space_rays import poses

FILES = ("dar_test", "dec_rev_tilt_test", "dec_test", "tilt_test")
STARTS = ((0.0, 0.0, 0.0, 0.0), (1.5, -2.0, 0.01, 0.02), (-0.7, 1.1, -0.03, 0.015))
SEEDS = (0, 1, 3, 4, 5, 8)
UM = 0.55


def ray_optics(folder: Path) -> dict:
    """Return the text of every file and its rays in the axes of surface 1: origin, direction, points."""
    from rayoptics.environment import open_model
    from rayoptics.raytr import raytrace

    out = {}
    for name in FILES:
        path = folder / f"{name}.seq"
        sequence = open_model(path).seq_model
        sequence.gaps[0].thi = 10.0
        sequence.update_model()
        frames, rays = sequence.compute_global_coords(1), []
        for x, y, p, q in STARTS:
            start, along = np.array([x, y, 0.0]), np.array([p, q, np.sqrt(1 - p * p - q * q)])
            local = raytrace.trace(sequence, start, along, 1000 * UM)[0]
            points = [r @ one[0] + t for one, (r, t) in zip(local[1:], frames[1:], strict=True)]
            (turn, origin), last = frames[0], frames[-1][0] @ local[-1][1]
            rays.append(_ray(turn @ start + origin, turn @ along, points, last))
        out[name] = {"file": path.read_text(encoding="utf-8"), "rays": rays}
    return out


def batoid_rays() -> list[dict]:
    """Return seeds of `random_system` and rays through it."""
    import batoid

    out = []
    for seed in SEEDS:
        lens, rays = random_system(seed), []
        for x, y, p, q in STARTS:
            rays.append(_by_batoid(batoid, lens, np.array([x, y, -3.0]), np.array([p, q, np.sqrt(1 - p * p - q * q)])))
        out.append({"seed": seed, "rays": rays})
    return out


def _by_batoid(batoid, lens, start: np.ndarray, along: np.ndarray) -> dict:
    index = [float(medium.index(UM)) for medium in lens.media]
    ray = batoid.RayVector(*start, *(along / index[0]), t=0.0)
    points = []
    for number, pose in enumerate(poses(lens)):
        axes = batoid.CoordSys(pose.origin, pose.turn.as_matrix())
        surface = lens.surfaces[number] if number < len(lens.surfaces) else None
        shape = _shape(batoid, surface)
        if surface is None:
            shape.intersect(ray, coordSys=axes)
        elif surface.reflects:
            shape.reflect(ray, coordSys=axes)
        else:
            shape.refract(ray, batoid.ConstMedium(index[number]), batoid.ConstMedium(index[number + 1]), coordSys=axes)
        points.append(axes.toGlobal(ray.r[0]) if hasattr(axes, "toGlobal") else axes.rot @ ray.r[0] + axes.origin)
    last = pose.turn.as_matrix() @ ray.v[0] * index[-1]
    return _ray(start, along, points, last) | {"path": float(ray.t[0]), "lost": bool(ray.vignetted[0] or ray.failed[0])}


def _shape(batoid, surface):
    if surface is None or (np.isinf(surface.radius) and not any(surface.aspheric)):
        return batoid.Plane()
    if any(surface.aspheric):
        return batoid.Asphere(min(surface.radius, 1e15), surface.conic, np.array(surface.aspheric))
    return batoid.Quadric(surface.radius, surface.conic)


def _ray(origin, direction, points, last) -> dict:
    names = ("origin", "direction", "points", "last_direction")
    return {
        name: np.array(value).tolist() for name, value in zip(names, (origin, direction, points, last), strict=True)
    }


if __name__ == "__main__":
    made = "python -m tests.long.peer_tilts FOLDER, rayoptics 0.9.8, batoid 0.9.0"
    peers = {"made_by": made, "wavelength_um": UM, "ray_optics": ray_optics(Path(sys.argv[1])), "batoid": batoid_rays()}
    print(json.dumps(peers))
