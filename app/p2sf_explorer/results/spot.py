"""The figures of the spot diagram."""

from typing import SupportsFloat

import numpy as np

from p2sf.messages import Message, Number
from p2sf.raytrace.pencil import Spot
from p2sf_explorer.results.first_order import Row
from p2sf_explorer.state.scales import significant


def landed(spot: Spot) -> np.ndarray:
    """Return x and y, (rays, 2) in µm, of the rays that reach the sensor."""
    points = np.stack([spot.x_um, spot.y_um], axis=-1)
    return points[np.isfinite(points).all(axis=-1)]


def figures(spot: Spot, airy_um: float) -> tuple[Row, ...]:
    """Return name, value and definition of the spot's figures; ``airy_um`` is the radius of the Airy disc."""
    points = landed(spot)
    apart = points - points.mean(axis=0)
    across, up = apart.std(axis=0)
    farthest, traced = np.hypot(*apart.T).max(), np.size(spot.x_um)
    return (
        ("RMS radius", micrometres(spot.rms_um), "Root mean square distance from the centroid."),
        ("RMS in x", micrometres(across), "Root mean square of x about the centroid."),
        ("RMS in y", micrometres(up), "Root mean square of y about the centroid."),
        ("Farthest ray", micrometres(farthest), "Largest distance of a ray from the centroid."),
        (
            "Centroid y",
            Message("{value:z.2f} µm", value=float(spot.centroid_y_um)),
            "Of the centroid, from the chief ray.",
        ),
        ("Airy radius, the circle", micrometres(airy_um), "First dark ring of a perfect lens, 0.61 λ/NA."),
        ("Rays", Message("{count} / {all}", count=len(points), all=traced), "That arrive, of those traced."),
    )


def micrometres(value: SupportsFloat) -> Message:
    """Return a length with three digits."""
    return Message("{value} µm", value=Number(significant(float(value), 3)))
