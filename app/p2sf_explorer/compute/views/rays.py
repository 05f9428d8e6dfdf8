"""Exact rays of the present source: spot diagram with its figures, ray fan, OPD fan."""

from typing import SupportsFloat

import numpy as np

from p2sf.errors import P2SFError
from p2sf.figures.fans import Fan, opd_fan, ray_fan
from p2sf.figures.spot import DRAWN_RINGS, Spot, spot
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message, Number
from p2sf.raytrace.aiming import Sources
from p2sf_explorer.compute.layout import Layout
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.views.first_order import Row
from p2sf_explorer.state.scales import significant

RINGS = {"preview": 6, "settled": DRAWN_RINGS}
FAN_RAYS = 41
ARRIVE = "That arrive, of those traced."
WITHIN_RIMS = "Share of the traced rays that pass every rim and arrive."


def lens_drawn(live: Live) -> View[Layout]:
    """Return the drawing of lens and rays; P2SFError with a free pupil, in whose picture the lens has no part."""
    if live.state.what_if.free_pupil:
        raise P2SFError(
            'the lens is set aside, and only the six sliders make the picture; switch "Free pupil" off to see the lens'
        )
    return View(live.layout)


def spots(live: Live) -> View[Spot]:
    """Return where hexapolar rays meet the sensor, µm from the chief ray; fewer rays while a slider moves."""
    return View(spot_of(live.setup.lens, live.setup.source, live.state.optics.clip, live.quality))


def ray_errors(live: Live) -> View[Fan]:
    """Return transverse ray errors along the two axes of the pupil, µm."""
    return View(ray_fan(live.setup.lens, live.setup.source, FAN_RAYS, live.state.optics.clip))


def path_errors(live: Live) -> View[Fan]:
    """Return optical path differences along the two axes of the pupil, waves."""
    return View(opd_fan(live.setup.lens, live.setup.source, FAN_RAYS, live.state.optics.clip))


def spot_of(lens: Lens, source: Source | Sources, clip: bool, quality: str) -> Spot:
    """Return the spot; rims are followed, which takes several traces, once the sliders rest."""
    return spot(lens, source, RINGS[quality], clip, follow_rims=quality == "settled")


def landing_points(spot: Spot) -> np.ndarray:
    """Return x and y, (rays, 2) in µm, of the rays that reach the sensor."""
    points = np.stack([spot.x_um, spot.y_um], axis=-1)
    return points[np.isfinite(points).all(axis=-1)]


def figures(spot: Spot, airy_um: float, clip: bool = False) -> tuple[Row, ...]:
    """Return name, value and definition of a spot's figures; ``airy_um`` is the radius of the Airy disc."""
    return (
        ("RMS radius", micrometres(spot.rms_um), "Root mean square distance from the centroid."),
        ("RMS in x", micrometres(spot.rms_x_um), "Root mean square of x about the centroid."),
        ("RMS in y", micrometres(spot.rms_y_um), "Root mean square of y about the centroid."),
        ("Farthest ray", micrometres(spot.farthest_um), "Largest distance of a ray from the centroid."),
        (
            "Centroid y",
            Message("{value:z.2f} µm", value=float(spot.centroid_y_um)),
            "Of the centroid, from the chief ray.",
        ),
        ("Airy radius, the circle", micrometres(airy_um), "First dark ring of a perfect lens, 0.61 λ/NA."),
        (
            "Rays within the rims" if clip else "Rays",
            Message("{count} / {all}", count=len(landing_points(spot)), all=np.size(spot.x_um)),
            WITHIN_RIMS if clip else ARRIVE,
        ),
    )


def micrometres(value: SupportsFloat) -> Message:
    """Return a length with three digits."""
    return Message("{value} µm", value=Number(significant(float(value), 3)))
