"""Tilts and decentres: the axes of a surface relative to those of the surface before it."""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import asin, atan2, cos, degrees, hypot, isfinite, radians, sin
from typing import NamedTuple

import numpy as np

from p2sf.arguments import check_fields
from p2sf.conventions import write_protect
from p2sf.errors import GeometryError

MOST_TILT_DEG = 90.0  # about x or y: there a surface is edge-on
STEEP = 1e-12  # of a cosine: below it two of the angles are rotations about the same axis


UPRIGHT = np.eye(3).tolist()


class Motion(NamedTuple):
    """New axes in terms of old ones: the point ``p`` (3,) of the new axes is origin + rotation @ p in the old, mm."""

    rotation: np.ndarray
    origin: np.ndarray

    def then(self, other: "Motion") -> "Motion":
        """Return ``other``, given in the axes of this motion, in the axes in which this motion is given."""
        return Motion(self.rotation @ other.rotation, self.origin + self.rotation @ other.origin)

    @property
    def inverse(self) -> "Motion":
        """Return the old axes in terms of the new ones."""
        return Motion(self.rotation.T, -(self.rotation.T @ self.origin))

    @property
    def turns(self) -> bool:
        """Return whether the axes are rotated."""
        return bool(self.rotation.tolist() != UPRIGHT)  # np.array_equal takes ten times as long


@dataclass(frozen=True)
class Placement:
    """A coordinate break: everything behind it is given in shifted and rotated axes.

    The axes are first shifted by the decentre, then rotated about the new x, the new y and the new z axis; with
    ``tilt_first`` they are first rotated about z, the new y and the new x axis, and then shifted along the new axes. So
    the inverse has the opposite signs and the other order. Angles are right-handed: a positive one about x rotates y
    towards z. This is OpticStudio's coordinate break with its order flag; CODE V's ADE and BDE have the other sign, its
    CDE has this one.

    Parameters
    ----------
    decentre_x, decentre_y, decentre_z : float
        Shift of the axes, mm.
    tilt_x_deg, tilt_y_deg, tilt_z_deg : float
        Rotations of the axes, degrees, less than 90 about x and y.
    tilt_first : bool
        Rotate before shifting, in the opposite order of the axes.
    pivot : (float, float, float)
        The centre of rotation, mm from the old vertex.
    """

    decentre_x: float = 0.0
    decentre_y: float = 0.0
    decentre_z: float = 0.0
    tilt_x_deg: float = 0.0
    tilt_y_deg: float = 0.0
    tilt_z_deg: float = 0.0
    tilt_first: bool = False
    pivot: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def decentre(self) -> tuple[float, float, float]:
        """Return the decentre in x, y and z, mm."""
        return self.decentre_x, self.decentre_y, self.decentre_z

    @property
    def tilt_deg(self) -> tuple[float, float, float]:
        """Return the angles about x, y and z, degrees."""
        return self.tilt_x_deg, self.tilt_y_deg, self.tilt_z_deg

    @property
    def idle(self) -> bool:
        """Return whether the axes stay unchanged."""
        return not (any(self.decentre) or any(self.tilt_deg))

    @property
    def along_axis(self) -> bool:
        """Return whether the axes are at most shifted along z."""
        return not (self.decentre_x or self.decentre_y or any(self.tilt_deg))

    @property
    def motion(self) -> Motion:
        """Return the new axes in terms of the old ones."""
        return _motion(self)

    @property
    def inverse(self) -> "Placement":
        """Return the break that undoes this one if it follows immediately."""
        x, y, z = (-value for value in self.decentre)
        a, b, c = (-value for value in self.tilt_deg)
        return Placement(x, y, z, a, b, c, not self.tilt_first, self.pivot)

    @property
    def followed(self) -> "Placement":
        """Return the break behind a mirror with this break before it, so that the axes follow the reflected axis.

        With R the rotation of the mirror and S the reflection of z at a plane, the mirror maps points p of the axes
        before it to R·S·Rᵀ·p; after the rotation S·Rᵀ·S these have the coordinates S·p, as behind an untilted mirror. S
        changes the sign of the angles about x and y.
        """
        a, b, c = self.tilt_deg
        return Placement(tilt_x_deg=a, tilt_y_deg=b, tilt_z_deg=-c, tilt_first=not self.tilt_first)

    def behind(self, distance: float) -> "Placement":
        """Return the same break in axes ``distance`` mm farther along z, about the same pivot."""
        x, y, z = self.pivot
        return replace(self, pivot=(x, y, z - distance))

    def scaled(self, factor: float) -> "Placement":
        """Return the break scaled from lengths in units of ``factor`` mm to mm."""
        x, y, z = (factor * value for value in self.decentre)
        across, up, along = (factor * value for value in self.pivot)
        return replace(self, decentre_x=x, decentre_y=y, decentre_z=z, pivot=(across, up, along))

    def check(self, surface: int) -> None:
        """Raise GeometryError for invalid numbers; ``surface`` counts from 1."""
        if not all(map(isfinite, (*self.decentre, *self.tilt_deg, *self.pivot))):
            raise GeometryError(
                "surface {surface}: a tilt or decentre is not finite; give finite numbers", surface=surface
            )
        for axis, tilt in (("x", self.tilt_x_deg), ("y", self.tilt_y_deg)):
            if abs(tilt) >= MOST_TILT_DEG:
                raise GeometryError(
                    "surface {surface}: a tilt of {tilt:g}° about {axis} turns it edge-on or further; give less than "
                    "90°",
                    surface=surface,
                    tilt=tilt,
                    axis=axis,
                )


def placement_of(motion: Motion) -> Placement:
    """Return the break of a motion: shifted first, then rotated about x, y and z."""
    r = motion.rotation
    b = asin(float(np.clip(r[0, 2], -1, 1)))
    if hypot(r[0, 0], r[0, 1]) > STEEP:
        a, c = atan2(-r[1, 2], r[2, 2]), atan2(-r[0, 1], r[0, 0])
    else:
        a, c = atan2(r[2, 1], r[1, 1]), 0.0
    x, y, z = map(float, motion.origin)
    return Placement(x, y, z, degrees(a), degrees(b), degrees(c))


def along_z(distance: float) -> Motion:
    """Return axes ``distance`` mm farther along z."""
    return Motion(np.eye(3), np.array([0.0, 0.0, distance]))


@lru_cache(maxsize=512)
def _motion(placement: Placement) -> Motion:
    turns = [_turn(axis, radians(angle)) for axis, angle in enumerate(placement.tilt_deg)]
    shift, pivot = np.array(placement.decentre), np.array(placement.pivot)
    if placement.tilt_first:
        rotation = turns[2] @ turns[1] @ turns[0]
        return Motion(write_protect(rotation), write_protect(pivot + rotation @ (shift - pivot)))
    rotation = turns[0] @ turns[1] @ turns[2]
    return Motion(write_protect(rotation), write_protect(shift + pivot - rotation @ pivot))


def _turn(axis: int, angle: float) -> np.ndarray:
    """Return the right-handed rotation about an axis: its columns are the new axes in the old ones."""
    one, two = (axis + 1) % 3, (axis + 2) % 3
    out = np.eye(3)
    out[one, one] = out[two, two] = cos(angle)
    out[two, one], out[one, two] = sin(angle), -sin(angle)
    return out
