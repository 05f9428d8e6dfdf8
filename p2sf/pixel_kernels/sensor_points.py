"""Where the points of one object plane land: from sensor height to field, distortion, lateral colour."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import FloatOrArray, vergence
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_aligned
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.pupils import find_stop, pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import pencil

CHIEF_RAYS = 257
REACHES = (1.35, 1.15, 1.04, 1.0, 0.9, 0.75)  # of the paraxial slope: the fields out to which chief rays are tried


@dataclass(frozen=True, eq=False)
class SensorMap:
    """One object plane seen through one lens: chief rays from the axis to the sensor's corner.

    ``heights_mm``: where real chief rays of ``slopes`` land, increasing from 0; ``scale_mm``: paraxial height per
    unit slope, negative where the entrance pupil lies beyond the object, as a relay's does. At the reference
    wavelength. ``clip``: whether rims clip the pencils of its points.
    """

    lens: Lens
    depth_mm: float
    wavelength_um: float
    slopes: np.ndarray
    heights_mm: np.ndarray
    scale_mm: float
    clip: bool = False

    def slope(self, height_mm: FloatOrArray) -> FloatOrArray:
        """Return field slopes whose chief rays land at radial heights, mm."""
        slope: FloatOrArray = np.interp(height_mm, self.heights_mm, self.slopes)
        return slope

    def ideal_height(self, height_mm: FloatOrArray) -> FloatOrArray:
        """Return the undistorted (paraxial) height of what lands at these heights, mm."""
        return self.slope(height_mm) * self.scale_mm

    def source(self, height_mm: float, wavelength_um: float) -> Source:
        """Return the object point that lands at a height in the reference wavelength, for another wavelength."""
        return Source(self.depth_mm, float(self.slopes_at(height_mm, wavelength_um)), float(wavelength_um))

    def slopes_at(self, heights_mm: FloatOrArray, wavelength_um: float) -> FloatOrArray:
        """Return, for another wavelength, the slopes of the object points that land at heights in the reference one."""
        return self.slope(heights_mm) * self._slope_ratio(wavelength_um)

    def shift_mm(self, height_mm: float, wavelength_um: float) -> float:
        """Return lateral colour: how much farther out another wavelength lands, mm."""
        if wavelength_um == self.wavelength_um:
            return 0.0
        return float(chief_heights(self.lens, self.source(height_mm, wavelength_um))) - float(height_mm)

    def _slope_ratio(self, wavelength_um: float) -> float:
        """Return how the chief ray's slope to one object point changes as the entrance pupil moves with colour."""
        return slope_ratio(self.lens, self.depth_mm, self.wavelength_um, wavelength_um)


def slope_ratio(lens: Lens, depth_mm: float, reference_um: float, wavelength_um: float) -> float:
    """Return the slope to an object point in one wavelength over that in the reference, whose pupil is elsewhere."""
    close = float(vergence(depth_mm))
    if close == 0 or wavelength_um == reference_um:
        return 1.0
    here, there = (_entrance(lens, w) for w in (reference_um, wavelength_um))
    return (1 + close * here) / (1 + close * there)


def sensor_map(lens: Lens, depth_mm: float, wavelength_um: float, height_mm: float, clip: bool = False) -> SensorMap:
    """Return the map out to radial ``height_mm`` on the sensor; GeometryError where no chief ray lands that far."""
    return sensor_maps(lens, [depth_mm], wavelength_um, height_mm, clip)[0]


def sensor_maps(
    lens: Lens,
    depths_mm: Sequence[float],
    wavelength_um: float,
    height_mm: float,
    clip: bool = False,
    rays: int = CHIEF_RAYS,
) -> list[SensorMap]:
    """Return `sensor_map` of several depths, whose chief rays are traced together where that is possible."""
    check_aligned(lens, Message("the forming of images"))
    depths = np.array(depths_mm, float)
    scale = np.broadcast_to(coefficients(lens, depths, 1.0, wavelength_um).image_height, depths.shape)
    if not (np.isfinite(scale) & (scale != 0)).all():
        raise GeometryError("every chief ray meets the sensor on the axis, so it contains no picture; move the stop")
    for reach in REACHES:
        slopes = np.linspace(0, reach * height_mm / scale, rays, axis=-1)
        try:
            heights = chief_heights(lens, Sources(depths[:, None], slopes, wavelength_um))
        except GeometryError:
            continue
        if (heights[:, -1] >= height_mm).all() and (np.diff(heights) > 0).all():
            maps = zip(depths.tolist(), slopes, heights, scale.tolist(), strict=True)
            return [SensorMap(lens, d, float(wavelength_um), s, h, size, clip) for d, s, h, size in maps]
    if len(depths) > 1:  # some may need another reach than others
        return [sensor_maps(lens, [d], wavelength_um, height_mm, clip, rays)[0] for d in depths.tolist()]
    raise GeometryError(
        "no chief ray of an object at {depth} lands {height:.4g} mm from the axis, where the sensor's "
        "corner is; take a smaller sensor",
        depth="∞" if np.isinf(depths[0]) else Message("{depth:g} mm", depth=float(depths[0])),
        height=height_mm,
    )


def chief_heights(lens: Lens, source: Source | Sources) -> np.ndarray:
    """Return where real chief rays land, mm from the axis along the field's direction, in the shape of the source."""
    heights: np.ndarray = pencil(lens, source, [0.0], [0.0]).chief_y[..., 0]
    return heights


def distortion_at(seen: SensorMap, height_mm: FloatOrArray) -> np.ndarray:
    """Return (real − paraxial)/paraxial height of what lands at these heights; 0 on the axis."""
    ideal = np.asarray(seen.ideal_height(height_mm))
    return np.where(ideal > 0, np.asarray(height_mm) / np.where(ideal > 0, ideal, 1) - 1, 0.0)


@lru_cache(maxsize=256)
def _entrance(lens: Lens, wavelength_um: float) -> float:
    return float(pupils(lens, wavelength_um, find_stop(lens)).entrance_from_first)
