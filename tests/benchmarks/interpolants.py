"""What each interpolant loses on the shipped lenses; `python -m tests.benchmarks.interpolants` prints a table of it.

20 × 20 × 31 nodes: depths 500 mm to infinity, uniform in 1/depth (or what lies before the lens's entrance
pupil), fields to the lens's widest, 400 to 700 nm. Errors are the largest over 20 000 random points, in waves for the
Double Gauss and, over all lenses, as a share of the largest coefficient of the kind. "on nodes' λ": at the
nodes' own wavelengths, of which the paper's table says nothing.
"""

import numpy as np

from p2sf.conventions import slope_from_degrees
from p2sf.database.build import build_database
from p2sf.database.departure import departures, largest
from p2sf.database.parts import KINDS
from p2sf.database.space import Space
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.pupils import pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.spans import depth_nodes

POINTS = 20_000


def space_for(lens) -> Space:
    """Return the space of a lens; a pupil before the lens (the relay's) bounds the depths."""
    pupil = float(pupils(lens, lens.reference_wavelength_um).entrance_from_first)
    depths = depth_nodes(500) if pupil > -500 else depth_nodes(-pupil / 10, -pupil / 4)
    widest = slope_from_degrees(max((5.0, *lens.fields_deg)))
    return Space(depths, np.linspace(0, widest, 20), np.linspace(0.4, 0.7, 31))


def points_in(database, on_colours: bool = False, count: int = POINTS):
    """Return random points of a database, all inside what its rule covers."""
    space, rng = database.space, np.random.default_rng(0)
    far = min(float(space.depths_mm[-1]), getattr(database, "last_depth_mm", np.inf))
    depth = np.clip(1 / rng.uniform(1 / far, 1 / space.depths_mm[0], count), space.depths_mm[0], far)
    slope, wavelength = (rng.uniform(x[0], x[-1], count) for x in (space.field_slopes, space.wavelengths_um))
    return depth, slope, rng.choice(space.wavelengths_um, count) if on_colours else wavelength


def losses(name: str, interpolant: str, on_colours: bool) -> tuple[dict, dict]:
    """Return the largest error and the largest value of each coefficient of one lens, waves."""
    lens = find_lens(name)
    database = build_database(lens, space_for(lens), interpolant)
    points = points_in(database, on_colours)
    direct = coefficients(lens, *points)
    return departures(database.coefficients(*points), direct), largest(direct)


def main() -> None:
    """Print the table in Markdown."""
    print("| interpolant | | " + " | ".join(kind.upper() for kind in KINDS) + " |")
    print("|---" * (len(KINDS) + 2) + "|")
    for interpolant, on_colours in (("exact", False), ("table1", True), ("table1", False), ("linear", False)):
        found = {name: losses(name, interpolant, on_colours) for name in shipped_lenses()}
        where = f"{interpolant}, on nodes' λ" if on_colours else interpolant
        gauss = [f"{found['double_gauss_28'][0][kind]:.1e}" for kind in KINDS]
        shares = [[lost[kind] / top[kind] for lost, top in found.values()] for kind in KINDS]
        print(f"| {where} | Double Gauss, waves | " + " | ".join(gauss) + " |")
        print("| | median lens | " + " | ".join(f"{np.median(share):.1e}" for share in shares) + " |")
        print("| | worst lens | " + " | ".join(f"{max(share):.1e}" for share in shares) + " |")


if __name__ == "__main__":
    main()
