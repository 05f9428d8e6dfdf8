"""Zooms made for tests: two groups of thin plano-convex lenses, whose spaces follow from the focal length by hand."""

from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.positions import Axis, with_positions

FRONT, REAR = -60.0, 40.0  # focal lengths of the groups, mm
INDEX, THICK = 1.5, 2.0
FOCAL = (30.0, 40.0, 60.0)
PUPIL = 8.0
INF = float("inf")


def spaces(focal: float) -> tuple[float, float]:
    """Return the space between the groups and that behind them, mm, of a lens focused at infinity.

    A plane followed by a sphere has its principal planes at the vertex of the sphere and THICK/INDEX in front of it;
    1/f = 1/a + 1/b - d/(a*b) for two thin groups d apart, and the image is at b(a - d)/(a + b - d).
    """
    apart = FRONT + REAR - FRONT * REAR / focal
    return apart - THICK / INDEX, REAR * (FRONT - apart) / (FRONT + REAR - apart)


def zoom_lens_at(focal: float) -> Lens:
    """Return the plain lens of one focal length, mm: planes in front, the stop on the plane of the rear group."""
    glass = ConstantIndex(INDEX)
    between, behind = spaces(focal)
    front, rear = (group * (1 - INDEX) for group in (FRONT, REAR))
    surfaces = (
        Surface(INF, THICK, glass, semi_diameter=20.0),
        Surface(front, between, semi_diameter=20.0),
        Surface(INF, THICK, glass, semi_diameter=15.0),
        Surface(rear, behind, semi_diameter=15.0),
    )
    return Lens(surfaces, Aperture("stop_semi_diameter", PUPIL), 3, fields_deg=(0.0, 600.0 / focal))


def two_group_zoom() -> Lens:
    """Return a zoom of 30 to 60 mm, whose columns are focused at infinity."""
    axis = Axis("zoom", ("wide", "40 mm", "tele"), FOCAL, "mm")
    return with_positions([axis], [zoom_lens_at(focal) for focal in FOCAL])


def focusing_zoom() -> Lens:
    """Return the same zoom with a ring of focus, which moves its front group by 0, 1 and 3 mm at any focal length."""
    zoom, focus = (
        Axis("zoom", ("wide", "tele"), (30.0, 60.0), "mm"),
        Axis("focus", ("far", "1", "near"), (0.0, 1.0, 3.0)),
    )
    return with_positions([zoom, focus], [_extended(zoom_lens_at(f), by) for f in zoom.at for by in focus.at])


def _extended(lens: Lens, by: float) -> Lens:
    first, front, *rest = lens.surfaces
    moved = Surface(front.radius, front.thickness + by, front.medium, semi_diameter=front.semi_diameter)
    return Lens((first, moved, *rest), lens.aperture, lens.stop_surface, fields_deg=lens.fields_deg)
