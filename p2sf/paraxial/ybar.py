"""The y–ȳ diagram: the marginal ray's height against the chief ray's, surface by surface (Delano 1963)."""

from dataclasses import dataclass
from math import isfinite

import numpy as np

from p2sf.arguments import same_values
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import ParaxialRays, Stop


@dataclass(frozen=True)
class YBar:
    """Points (ȳ, y) in mm in the order light meets them, and a name for each; ``stop`` is the stop's place in them."""

    __eq__ = same_values

    chief_y: np.ndarray
    y: np.ndarray
    names: tuple[str, ...]
    stop: int

    @property
    def axial(self) -> bool:
        """Return whether the diagram is only a line: a source on the axis has no chief ray."""
        return not np.any(self.chief_y)


def ybar(lens: Lens, source: Source, stop: Stop, rays: ParaxialRays) -> YBar:
    """Return the polygon from the object (or, from infinity, the first surface) through every surface to the sensor.

    ``rays``: those of the source's depth and wavelength through this stop.
    """
    depth, reach = source.depth_mm, lens.sensor_mm / rays.index[-1]
    y, chief = (
        [*height, height[-1] + reach * angle[-1]]
        for height, angle in ((rays.y, rays.nu), (rays.chief_y, rays.chief_nu))
    )
    names = [*map(str, range(1, len(rays.y) + 1)), "sensor"]
    if isfinite(depth):
        y.insert(0, y[0] - depth * rays.nu[0] / rays.index[0])
        chief.insert(0, chief[0] - depth * rays.chief_nu[0] / rays.index[0])
        names.insert(0, "object")
    at = int(stop.surface) - 1 + isfinite(depth)
    return YBar(source.field_slope * np.array(chief, float), np.array(y, float), tuple(names), at)
