"""Where a 3D scene is seen from. No Qt and no pyvista in here."""

from dataclasses import dataclass, replace

from p2sf_explorer.state.limits import RANGES


@dataclass(frozen=True)
class Camera:
    """Turn about the vertical and tilt in degrees, and how near: 1 shows the whole scene."""

    turn: float = 24.0
    tilt: float = 11.0
    near: float = 1.0


CAMERA = Camera()


def turned(eye: Camera, turn: float, tilt: float) -> Camera:
    """Return the eye moved around by some degrees; it never tilts over the top."""
    low, high = RANGES["eye_tilt_deg"][:2]
    return replace(eye, turn=(eye.turn + turn + 180) % 360 - 180, tilt=min(high, max(low, eye.tilt + tilt)))


def nearer(eye: Camera, factor: float) -> Camera:
    """Return the eye so many times nearer, within the state's limits."""
    low, high = RANGES["eye_near"][:2]
    return replace(eye, near=min(high, max(low, factor * eye.near)))
