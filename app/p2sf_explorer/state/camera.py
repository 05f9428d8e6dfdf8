"""The viewpoint of a 3D scene. Uses neither Qt nor pyvista."""

from dataclasses import dataclass, replace

from p2sf_explorer.state.limits import RANGES


@dataclass(frozen=True)
class SceneCamera:
    """Turn about the vertical and tilt in degrees, and the enlargement ``near``: 1 shows the whole scene."""

    turn: float = 24.0
    tilt: float = 11.0
    near: float = 1.0


CAMERA = SceneCamera()


def turn_camera(camera: SceneCamera, turn: float, tilt: float) -> SceneCamera:
    """Return the camera moved around the scene by some degrees; it never tilts over the top."""
    low, high = RANGES["camera_tilt_deg"][:2]
    return replace(camera, turn=(camera.turn + turn + 180) % 360 - 180, tilt=min(high, max(low, camera.tilt + tilt)))


def nearer(camera: SceneCamera, factor: float) -> SceneCamera:
    """Return the camera moved nearer by a factor, within the limits of the state."""
    low, high = RANGES["camera_zoom"][:2]
    return replace(camera, near=min(high, max(low, factor * camera.near)))
