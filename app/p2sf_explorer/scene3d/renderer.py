"""The 3D picture: a scene of meshes rendered off screen by pyvista, which follows by moving their points.

It shows no window: the picture is an array, so that it works wherever OpenGL does, with or without a screen, and Qt
need not paint the window around it through OpenGL.
"""

from collections.abc import Callable
from math import cos, radians, sin, tan
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pyvista
from pyvista import PolyData
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkUnsignedCharArray

from p2sf.errors import ExportError, P2SFError
from p2sf.files.writing import check_place, write_beside
from p2sf_explorer.charts.plots import as_indices, lookup
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.scene3d.meshes import Mesh
from p2sf_explorer.scene3d.scene import Scene3D
from p2sf_explorer.state.camera import Camera

VIEW_DEG = 16.0  # the eye's angle: small, so that lengths along the axis compare
ROOM = 1.02
SAMPLES = 8  # a pixel, where edges are smooth
SHARP_DEG = 30.0  # glass is shaded smooth up to such an edge
GLASS = {"opacity": 0.42, "specular": 0.6, "specular_power": 30.0, "smooth_shading": True}
LOOKS = {
    "stop": {},
    "sensor": {},
    "rays": {"line_width": 1.6, "lighting": False},
    "front": {"opacity": 0.85},
    "relief": {},
}
WRITERS = {".gltf": "export_gltf", ".obj": "export_obj"}


class Renderer:
    """Renders scenes; what keeps its triangles only moves, and only what changes is made anew."""

    def __init__(self, size: tuple[int, int]):
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # it tells of every kind of window it tries
        self._plotter = pyvista.Plotter(off_screen=True, window_size=list(size), lighting="none")
        self._plotter.add_light(pyvista.Light(light_type="headlight"))
        self._plotter.camera.view_angle = VIEW_DEG
        self._plotter.renderer.SetUseOIT(False)  # sorting translucent glass costs as much as painting all the rest
        self._drawn: dict[str, PolyData] = {}
        self._asked: tuple = ()
        self._kept: tuple = ()  # so that no other glass takes its place in memory
        self._box = np.zeros((2, 3))
        self.remade = 0

    def follow(self, scene: Scene3D, theme: Tokens, maps: tuple[str, str]) -> None:
        """Take a new scene; ``maps`` name the colours of the wavefront and of the PSF."""
        self._follow_glass(scene, theme)
        self._put("stop", scene.stop, theme.text)
        self._put("sensor", scene.sensor, theme.mark)
        self._put("rays", scene.rays, scene.colour)
        limit = float(np.abs(scene.front.waves).max()) or 1.0
        self._put("front", scene.front.mesh, painted(scene.front.waves, (-limit, limit), maps[0]))
        self._put("relief", scene.psf_surface.mesh, painted(scene.psf_surface.values, (0.0, 1.0), maps[1]))
        self._box = _box(scene)

    def look(self, eye: Camera) -> None:
        """Set the eye so that the whole scene fits, then come nearer."""
        middle, back = self._box.mean(axis=0), direction(eye)
        width, height = self._plotter.window_size
        distance = ROOM * reach(self._box, back, width / height) / eye.near
        self._plotter.camera.position = tuple(middle + distance * back)
        self._plotter.camera.focal_point, self._plotter.camera.up = tuple(middle), (0.0, 1.0, 0.0)
        self._plotter.renderer.ResetCameraClippingRange()

    def resize(self, size: tuple[int, int], smooth: bool = True) -> None:
        """Render pictures of another size from now on; ``smooth`` edges take three times as long."""
        if tuple(self._plotter.window_size) != size:
            self._plotter.window_size = list(size)
        self._plotter.render_window.SetMultiSamples(SAMPLES if smooth else 0)

    def picture(self) -> np.ndarray:
        """Return the picture, (rows, columns, 4) bytes of red, green, blue, alpha, top row first."""
        window, pixels = self._plotter.render_window, vtkUnsignedCharArray()
        width, height = self._plotter.window_size
        window.Render()
        window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels)
        return np.ascontiguousarray(vtk_to_numpy(pixels).reshape(height, width, 4)[::-1])

    def save(self, path: str) -> None:
        """Write the scene as .gltf or .obj, whole or not at all; P2SFError for another ending or where it cannot be."""
        ending = Path(path).suffix.lower()
        if ending not in WRITERS:
            known = " or ".join(WRITERS)
            raise P2SFError(f'{Path(path).name} has the ending "{ending}"; give the scene a name in {known}')
        check_place(path)
        write_drafted(path, getattr(self._plotter, WRITERS[ending]))

    def close(self) -> None:
        """Give the graphics memory back."""
        self._plotter.close()

    def _follow_glass(self, scene: Scene3D, theme: Tokens) -> None:
        asked = *map(id, scene.glass), theme
        if asked == self._asked:
            return
        self._asked, self._kept = asked, scene.glass
        for name in list(self._drawn):
            self._plotter.remove_actor(name, render=False)
        self._drawn.clear()
        self._plotter.set_background(theme.card)
        for number, piece in enumerate(scene.glass):
            mesh = _data(piece.mesh).compute_normals(feature_angle=SHARP_DEG, split_vertices=True)
            self._add(f"glass {number}", mesh, color=theme.glass, **GLASS)

    def _put(self, name: str, mesh: Mesh | np.ndarray, colour: str | np.ndarray) -> None:
        """Move what is on stage under this name to new points, or put it there; a mesh, or rays as lines."""
        points = mesh.points if isinstance(mesh, Mesh) else mesh.reshape(-1, 3)
        look = {"color": colour} if isinstance(colour, str) else {"rgb": True, "scalars": "rgb"}
        before = self._drawn.get(name)
        if before is None or before.n_points != len(points):
            before = _data(mesh) if isinstance(mesh, Mesh) else _lines(mesh)
            if "rgb" in look:
                before["rgb"] = colour
            self._add(name, before, **look, **LOOKS[name])
            return
        _fill(before.GetPoints().GetData(), points)
        if "rgb" in look:
            _fill(before.GetPointData().GetArray("rgb"), colour)
        else:
            self._plotter.actors[name].prop.color = colour
        before.GetPoints().Modified()

    def _add(self, name: str, mesh: PolyData, **look) -> None:
        self.remade += 1
        self._drawn[name] = mesh
        self._plotter.add_mesh(mesh, name=name, reset_camera=False, render=False, show_scalar_bar=False, **look)


def write_drafted(path: str, write: Callable[[str], object]) -> None:
    """Let ``write`` fill a file of this name in a folder of its own, then put it, and what it wrote with it, in place.

    VTK says nothing of a disk that is full. So each file is written once more with a line's end after it: the byte more
    finds no room where the draft found too little. Raises ExportError.
    """
    target = Path(path).absolute()
    try:
        with TemporaryDirectory(suffix=".part", prefix=".", dir=target.parent) as folder:
            write(str(Path(folder) / target.name))
            made = {draft.name: draft.read_bytes() for draft in Path(folder).iterdir()}
    except OSError as error:
        raise ExportError(f"{path} cannot be written, {error.strerror}; choose a folder you may write to") from error
    if not all(made.get(name) for name in {target.name, *made}):
        raise ExportError(f"{path} cannot be written, the draft beside it stayed empty; choose another disk")
    for name in sorted(made, key=lambda name: name == target.name):
        write_beside(target.with_name(name), lambda handle, name=name: handle.write(made[name] + b"\n"))


def _fill(array, values: np.ndarray) -> None:
    """Write values into an array of VTK's in its own memory."""
    vtk_to_numpy(array)[:] = values
    array.Modified()


def direction(eye: Camera) -> np.ndarray:
    """Return the unit vector from the scene to the eye; turn 0 sees light go from left to right."""
    turn, tilt = radians(eye.turn), radians(eye.tilt)
    return np.array([-cos(tilt) * cos(turn), sin(tilt), -cos(tilt) * sin(turn)])


def painted(values: np.ndarray, levels: tuple[float, float], name: str) -> np.ndarray:
    """Return the colours of values, (value, 3) bytes."""
    colour = lookup(name)[as_indices(values, *levels)]
    return np.stack([colour >> 16 & 255, colour >> 8 & 255, colour & 255], -1).astype(np.uint8)


def reach(box: np.ndarray, back: np.ndarray, aspect: float) -> float:
    """Return how far from the middle of a box (2, 3) the eye must be, in the direction ``back``, to see all of it."""
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    corners = np.array(np.meshgrid(*(box - box.mean(axis=0)).T)).reshape(3, -1).T
    slope = tan(radians(VIEW_DEG / 2))
    across, up = np.abs(corners @ right) / (aspect * slope), np.abs(corners @ np.cross(back, right)) / slope
    return float((np.maximum(across, up) + corners @ back).max())


def _box(scene: Scene3D) -> np.ndarray:
    """Return the corners of what must be in sight, (2, 3): glass, stop, sensor, and rays some way before the lens."""
    parts = [scene.stop, scene.sensor, *(piece.mesh for piece in scene.glass)]
    low = np.min([part.points.min(axis=0) for part in parts], axis=0)
    high = np.max([part.points.max(axis=0) for part in parts], axis=0)
    low[2] -= 0.3 * (high[2] - low[2])
    return np.stack([low, high])


def _data(mesh: Mesh) -> PolyData:
    return PolyData(mesh.points.astype(np.float32), np.insert(mesh.faces, 0, 3, axis=1).ravel())


def _lines(rays: np.ndarray) -> PolyData:
    count, places, _ = rays.shape
    ids = np.arange(count * places).reshape(count, places)
    return PolyData(rays.reshape(-1, 3).astype(np.float32), lines=np.insert(ids, 0, places, axis=1).ravel())
