"""Where a source is drawn, from the lens to infinity: to scale near the lens, in little room behind a broken axis.

Left of the break a source at the distance s from it is drawn at s/(s + middle) of the way to the left end, where
infinity is; its height is that at which its chief ray crosses the break. Both can be read backwards, so that a source
that is dragged stays under the pointer.
"""

from dataclasses import dataclass
from math import atan, degrees, inf, isfinite, radians, tan

END_PX, STRIP_PX, SHARE = 24.0, 92.0, 0.16  # left margin of infinity; room behind the break, and at most of the width
BEFORE_PX = 14.0  # between the break and the glass, at least
ABOVE_PX, BELOW_PX = 12.0, 26.0  # margins of the ring, which has its distance written below it
LEAST_SHARE = 0.25  # of the height, for the ring where the axis has been moved out of the view
KNEE = 0.7  # of the half height, up to which heights are drawn to scale
SNAP_PX = 1.5  # as near to the end is at infinity
NEAREST = 0.15  # of the glass's half height: how near the break counts as to the entrance pupil, at least
BEFORE_GLASS = 1e-3  # mm, as near to the glass as a source comes


def compress(value: float, knee: float, end: float) -> float:
    """Return a positive value as it is up to ``knee``, and beyond it ever nearer to ``end``."""
    beyond, room = value - knee, end - knee
    return value if beyond <= 0 else knee + room * (beyond / (beyond + room))


def expand(value: float, knee: float, end: float) -> float:
    """Return what `compress` has made this of; inf at the end."""
    beyond, room = value - knee, end - knee
    if beyond <= 0:
        return value
    return knee + room * beyond / (room - beyond) if beyond < room else inf


@dataclass(frozen=True)
class ObjectSpace:
    """The room of sources in one view.

    In pixels: ``origin`` of the first vertex, ``axis``, ``half`` of the height, where the axis is ``broken``, and the
    ``end`` that is infinity; ``scale`` is pixels per mm. In mm: ``nearest_z`` and ``entrance_z`` from the first vertex,
    ``middle`` from the break, drawn half-way to infinity, and ``least_reach``, by which the break counts as apart from
    the entrance pupil. ``widest`` is the largest slope of a field.
    """

    origin: float
    axis: float
    scale: float
    half: float
    broken: float
    end: float
    nearest_z: float
    entrance_z: float
    middle: float
    widest: float
    least_reach: float

    @property
    def break_z(self) -> float:
        """Return z of the break, mm."""
        return (self.broken - self.origin) / self.scale

    def _reach(self, z: float) -> float:
        """Return the distance from the entrance pupil to where the chief ray's height is drawn, mm, never nothing."""
        reach = max(z, self.break_z) - self.entrance_z
        return reach if abs(reach) >= self.least_reach else (self.least_reach if reach > 0 else -self.least_reach)

    def x(self, depth_mm: float) -> float:
        """Return the pixel column of a source at this depth."""
        beyond = depth_mm + self.break_z
        if beyond <= 0:
            return self.origin - depth_mm * self.scale
        part = beyond / (beyond + self.middle) if isfinite(beyond) else 1.0
        return self.broken - part * (self.broken - self.end)

    def depth(self, x: float) -> float:
        """Return the depth in mm of a source in a pixel column; inf at the left end."""
        if x >= self.broken:
            return -min((x - self.origin) / self.scale, self.nearest_z)
        if x <= self.end + SNAP_PX:
            return inf
        part = (self.broken - x) / (self.broken - self.end)
        return self.middle * part / (1 - part) - self.break_z

    def place(self, depth_mm: float, slope: float) -> tuple[float, float]:
        """Return the pixel of a source at this depth and field."""
        height = slope * self._reach(-depth_mm) * self.scale
        drawn = compress(abs(height), KNEE * self.half, self.half)
        return self.x(depth_mm), self.axis - (drawn if height > 0 else -drawn)

    def source(self, x: float, y: float) -> tuple[float, float]:
        """Return depth in mm and field in degrees of a source at a pixel, as far as the fields of the lens go."""
        depth, up = self.depth(x), self.axis - y
        height = expand(abs(up), KNEE * self.half, self.half) / self.scale
        slope = min(height / abs(self._reach(-depth)), self.widest)
        same = (up > 0) == (self._reach(-depth) > 0)
        return depth, degrees(atan(slope if same else -slope)) if up else 0.0


def object_space(
    view: tuple[float, float, float],
    size: tuple[float, float],
    glass: tuple[float, float],
    entrance_z: float,
    middle_mm: float | None,
    widest_deg: float,
    type_scale: float = 1.0,
) -> ObjectSpace:
    """Return the room of sources for a view: ``origin`` and ``axis`` in pixels and pixels per mm; its width and height.

    ``glass`` is z of its left end and its half height, mm; ``middle_mm`` the depth to draw in the middle behind the
    break, ``widest_deg`` the largest field that a hand can reach; the margins grow with ``type_scale``.
    """
    (origin, axis, scale), (width, height), (left, half) = view, size, glass
    room = min(STRIP_PX * type_scale, SHARE * width)
    nearest = min(left, 0.0) - BEFORE_GLASS
    broken = min(END_PX * type_scale + room, origin + nearest * scale - BEFORE_PX * type_scale)
    distance = (origin - broken) / scale
    return ObjectSpace(
        origin=origin,
        axis=axis,
        scale=scale,
        half=max(min(axis - ABOVE_PX * type_scale, height - BELOW_PX * type_scale - axis), LEAST_SHARE * height),
        broken=broken,
        end=broken - room,
        nearest_z=nearest,
        entrance_z=entrance_z,
        middle=max((middle_mm or 0.0) - distance, distance),
        widest=tan(radians(widest_deg)),
        least_reach=NEAREST * half,
    )
