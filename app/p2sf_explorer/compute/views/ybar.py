"""The y–ȳ diagram: the marginal ray's height against the chief ray's, surface by surface (Delano 1963)."""

from dataclasses import dataclass
from math import isfinite

import numpy as np

from p2sf_explorer.compute.live import Live


@dataclass(frozen=True)
class YBar:
    """Points (ȳ, y) in mm in the order light meets them, and a name for each; ``stop`` is the stop's place in them."""

    chief_y: np.ndarray
    y: np.ndarray
    names: tuple[str, ...]
    stop: int


def ybar(live: Live) -> YBar:
    """Return the polygon from the object (or, from infinity, the first surface) through every surface to the sensor."""
    setup = live.setup
    rays, slope, depth = setup.rays, setup.source.field_slope, setup.source.depth_mm
    reach = setup.lens.sensor_mm / rays.index[-1]
    y, chief = (
        [*rays.y, rays.y[-1] + reach * rays.nu[-1]],
        [*rays.chief_y, rays.chief_y[-1] + reach * rays.chief_nu[-1]],
    )
    names = [*map(str, range(1, len(rays.y) + 1)), "sensor"]
    if isfinite(depth):
        y.insert(0, y[0] - depth * rays.nu[0] / rays.index[0])
        chief.insert(0, chief[0] - depth * rays.chief_nu[0] / rays.index[0])
        names.insert(0, "object")
    stop = int(setup.stop.surface) - 1 + isfinite(depth)
    return YBar(slope * np.array(chief, float), np.array(y, float), tuple(names), stop)


def field_free(view: YBar) -> bool:
    """Return whether the diagram is only a line: a source on the axis has no chief ray."""
    return not np.any(view.chief_y)
