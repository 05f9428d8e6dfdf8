"""Systems of mirrors for tests: closed forms, and another program's telescope of three mirrors and three lenses."""

import json
from dataclasses import replace
from math import inf
from pathlib import Path

from p2sf.glass.media import MIRROR, ConstantIndex, catalogue_glass
from p2sf.lens.lens import Aperture, Lens, Surface

TELESCOPE = json.loads((Path(__file__).parents[2] / "data" / "telescope.json").read_text(encoding="utf-8"))


def mirror(radius: float, thickness: float, conic: float = 0.0, rim: float = 50.0) -> Lens:
    return Lens((Surface(radius, thickness, MIRROR, conic, semi_diameter=rim),), Aperture("stop_semi_diameter", rim), 1)


def mangin(conic: float = 0.0) -> Lens:
    """Return a mirror on the back of a meniscus, which light crosses twice."""
    glass = catalogue_glass("SCHOTT N-BK7")
    surfaces = Surface(-150.0, 6.0, glass), Surface(-220.0, -6.0, MIRROR, conic), Surface(-150.0, -130.0)
    return Lens(surfaces, Aperture("stop_semi_diameter", 20.0), 1)


def two_mirrors(
    conics: tuple[float, float], focal: float = 400.0, magnified: float = 4.0, behind: float = 60.0
) -> Lens:
    """Return a Cassegrain telescope of a primary's focal length, the secondary's magnification and the focus behind."""
    share = (focal + behind) / (magnified + 1) / focal
    apart, radius = focal * (1 - share), -2 * share * focal * magnified / (magnified - 1)
    primary = Surface(-2 * focal, -apart, MIRROR, conics[0], semi_diameter=50.0)
    secondary = Surface(radius, apart + behind, MIRROR, conics[1], semi_diameter=20.0)
    return Lens((primary, secondary), Aperture("stop_semi_diameter", 50.0), 1)


def classical() -> tuple[float, float]:
    """Return the conics −1 and −((m + 1)/(m − 1))² of a paraboloid and a hyperboloid that share a focus."""
    return -1.0, -((5 / 3) ** 2)


def aplanatic(focal: float = 400.0, m: float = 4.0, behind: float = 60.0) -> tuple[float, float]:
    """Return the conics of Ritchey and Chrétien (Schroeder 2000, ch. 6) that end S_I and S_II."""
    k = (focal + behind) / (m + 1) / focal
    first = -1 - 2 * k / ((1 - k) * m**2)
    return first, -(((m + 1) / (m - 1)) ** 2) - 2 * m / ((1 - k) * (m - 1) ** 3)


def folded(lens: Lens) -> Lens:
    """Return a lens with a plane mirror at two fifths of the way to its sensor."""
    before = 0.4 * lens.sensor_mm
    last = replace(lens.surfaces[-1], thickness=before)
    mirror = Surface(inf, before - lens.sensor_mm, MIRROR)
    return replace(lens, surfaces=(*lens.surfaces[:-1], last, mirror))


def telescope() -> Lens:
    rows = []
    for s in TELESCOPE["surfaces"]:
        medium = MIRROR if s["mirror"] else ConstantIndex(s["index_after"])
        rows.append(Surface(s["radius"] or inf, s["thickness"], medium, s["conic"], tuple(s["even_asphere_A4_A6_A8"])))
    return Lens(
        tuple(rows), Aperture("stop_semi_diameter", TELESCOPE["stop_semi_diameter"]), 1, wavelengths_nm=(500.0,)
    )
