"""The 3D picture: a scene of meshes that pyvista renders off screen, and that changes by moving their points.

The picture is an array and not a window: it works wherever OpenGL does, with or without a screen, and Qt need not paint
the window around it through OpenGL.
"""

from collections.abc import Callable
from functools import partial
from math import cos, radians, sin, tan
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO

import numpy as np
import pyvista
from pyvista import PolyData
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderWindow

from p2sf.errors import ExportError, P2SFError
from p2sf.files.reasons import reason
from p2sf.files.writing import check_own, check_place, write_beside
from p2sf.messages import Alternatives
from p2sf_explorer.charts.plots import as_indices, lookup
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.scene3d.meshes import Mesh
from p2sf_explorer.scene3d.scene import Scene3D
from p2sf_explorer.state.camera import SceneCamera

VIEW_DEG = 16.0  # the camera's angle of view: small, so that lengths along the axis can be compared
MARGIN = 1.02  # of the distance at which the scene just fits
SAMPLES = 8  # a pixel, for smooth edges
SHARP_DEG = 30.0  # glass is shaded smoothly over flatter edges
GLASS: dict[str, Any] = {"opacity": 0.22, "specular": 0.8, "specular_power": 40.0, "smooth_shading": True}
EDGE: dict[str, Any] = {"line_width": 1.4, "lighting": False, "opacity": 0.8}  # of glass: one sees into it all the same
LOOKS: dict[str, dict[str, Any]] = {
    "stop": {},
    "sensor": {"opacity": 0.35},  # the spot is seen from behind too
    "rays": {"line_width": 1.4, "lighting": False},
    "front": {"opacity": 0.85},
    "psf": {},
}
WRITERS = {".gltf": "export_gltf", ".obj": "export_obj"}


class Renderer:
    """Renders scenes; a mesh that keeps its triangles is moved, and only one that changes is built again."""

    def __init__(self, size: tuple[int, int]):
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # it logs every kind of window it tries
        self._plotter = pyvista.Plotter(off_screen=True, window_size=list(size), lighting="none")
        self._plotter.add_light(pyvista.Light(light_type="headlight"))
        self._plotter.camera.view_angle = VIEW_DEG
        self._plotter.renderer.SetUseOIT(False)  # sorting translucent glass takes as long as rendering all the rest
        self._drawn: dict[str, PolyData] = {}
        self._shown: tuple[object, ...] = ()
        self._kept: tuple[object, ...] = ()  # so that no other glass gets the same id
        self._box = np.zeros((2, 3))
        self.built = 0

    def follow(self, scene: Scene3D, theme: Tokens, maps: tuple[str, str]) -> None:
        """Take a new scene; ``maps`` are the colour maps of the wavefront and of the PSF."""
        self._follow_glass(scene, theme)
        self._put("stop", scene.stop, theme.text)
        self._put("sensor", scene.sensor, theme.mark)
        self._put("rays", scene.rays, scene.colour)
        limit = float(np.abs(scene.front.waves).max()) or 1.0
        self._put("front", scene.front.mesh, paint_values(scene.front.waves, (-limit, limit), maps[0]))
        self._put("psf", scene.psf_surface.mesh, paint_values(scene.psf_surface.values, (0.0, 1.0), maps[1]))
        self._box = _box(scene)

    def look(self, camera: SceneCamera) -> None:
        """Place the camera so that the whole scene fits, then move it nearer."""
        middle, back = self._box.mean(axis=0), direction(camera)
        width, height = self._plotter.window_size
        distance = MARGIN * fitting_distance(self._box, back, width / height) / camera.near
        self._plotter.camera.position = tuple(middle + distance * back)
        self._plotter.camera.focal_point, self._plotter.camera.up = tuple(middle), (0.0, 1.0, 0.0)
        self._plotter.renderer.ResetCameraClippingRange()

    def resize(self, size: tuple[int, int], smooth: bool = True) -> None:
        """Render pictures of another size from now on; ``smooth`` edges take three times as long."""
        if tuple(self._plotter.window_size) != size:
            self._plotter.window_size = list(size)
        self._window.SetMultiSamples(SAMPLES if smooth else 0)
        self._plotter.renderer.SetUseFXAA(not smooth)  # one pass over the picture: rays are smooth in a drag too

    @property
    def _window(self) -> vtkRenderWindow:
        window = self._plotter.render_window
        assert window is not None, "the plotter is closed"
        return window

    def picture(self) -> np.ndarray:
        """Return the picture, (rows, columns, 4) bytes of red, green, blue, alpha, top row first."""
        window, pixels = self._window, vtkUnsignedCharArray()
        width, height = self._plotter.window_size
        window.Render()
        window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
        return np.ascontiguousarray(vtk_to_numpy(pixels).reshape(height, width, 4)[::-1])

    def save(self, path: str) -> None:
        """Write the scene as .gltf or .obj, whole or not at all; P2SFError for another ending or where it fails."""
        ending = Path(path).suffix.lower()
        if ending not in WRITERS:
            raise P2SFError(
                '{name} has the ending "{ending}"; give the scene a name in {names}',
                name=Path(path).name,
                ending=ending,
                names=Alternatives(WRITERS),
            )
        check_place(path)
        write_drafted(path, getattr(self._plotter, WRITERS[ending]))

    def close(self) -> None:
        """Free the graphics memory."""
        self._plotter.close()

    def _follow_glass(self, scene: Scene3D, theme: Tokens) -> None:
        wanted = *map(id, scene.glass), theme
        if wanted == self._shown:
            return
        self._shown, self._kept = wanted, scene.glass
        for name in list(self._drawn):
            self._plotter.remove_actor(self._plotter.actors[name], render=False)
        self._drawn.clear()
        self._plotter.background_color = pyvista.Color(theme.card)
        for number, piece in enumerate(scene.glass):
            solid = _data(piece.mesh)
            mesh = solid.compute_normals(feature_angle=SHARP_DEG, split_vertices=True)
            self._add(f"glass {number}", mesh, color=theme.glass, **GLASS)
            edges = solid.extract_feature_edges(SHARP_DEG, non_manifold_edges=False)
            if edges.n_points:
                self._add(f"edge {number}", edges, color=theme.glass_edge, **EDGE)

    def _put(self, name: str, mesh: Mesh | np.ndarray, colour: str | np.ndarray) -> None:
        """Move the mesh of this name, or the lines of rays, to new points; add it where there is none."""
        points = mesh.points if isinstance(mesh, Mesh) else mesh.reshape(-1, 3)
        look: dict[str, Any] = {"color": colour} if isinstance(colour, str) else {"rgb": True, "scalars": "rgb"}
        before = self._drawn.get(name)
        if before is None or before.n_points != len(points):
            before = _data(mesh) if isinstance(mesh, Mesh) else _lines(mesh)
            if not isinstance(colour, str):
                before["rgb"] = colour
            self._add(name, before, **look, **LOOKS[name])
            return
        _fill(before.GetPoints().GetData(), points)
        if isinstance(colour, str):
            self._plotter.actors[name].prop.color = colour
        else:
            _fill(before.GetPointData().GetArray("rgb"), colour)
        before.GetPoints().Modified()

    def _add(self, name: str, mesh: PolyData, **look: Any) -> None:
        self.built += 1
        self._drawn[name] = mesh
        self._plotter.add_mesh(mesh, name=name, reset_camera=False, render=False, show_scalar_bar=False, **look)


def write_drafted(path: str, write: Callable[[str], object]) -> None:
    """Let ``write`` fill a file of this name in a temporary folder, then put all that is there in place.

    VTK does not report a full disk. So each file is written once more with a newline after it: where the draft found
    too little room, the byte more finds none. Raises ExportError.
    """
    target = Path(path).absolute()
    try:
        with TemporaryDirectory(suffix=".part", prefix=".", dir=target.parent) as folder:
            write(str(Path(folder) / target.name))
            drafts = {draft.name: draft.read_bytes() for draft in Path(folder).iterdir()}
    except OSError as error:
        raise ExportError(
            "{path} cannot be written, {reason}; choose a folder you may write to", path=path, reason=reason(error)
        ) from error
    if not all(drafts.get(name) for name in {target.name, *drafts}):
        raise ExportError("{path} cannot be written, the draft beside it stayed empty; choose another disk", path=path)
    for name, draft in drafts.items():
        if name != target.name:  # the materials of an OBJ; VTK says in the first line that it wrote them
            check_own(target.with_name(name), draft.split(b"\n")[0])
    for name in sorted(drafts, key=lambda name: name == target.name):
        write_beside(target.with_name(name), partial(_write, drafts[name] + b"\n"))


def _write(content: bytes, handle: BinaryIO) -> None:
    handle.write(content)


def _fill(array: Any, values: np.ndarray) -> None:
    """Write values into the memory of a VTK array."""
    vtk_to_numpy(array)[:] = values
    array.Modified()


def direction(camera: SceneCamera) -> np.ndarray:
    """Return the unit vector from the scene to the camera; at turn 0 light goes from left to right."""
    turn, tilt = radians(camera.turn), radians(camera.tilt)
    return np.array([-cos(tilt) * cos(turn), sin(tilt), -cos(tilt) * sin(turn)])


def paint_values(values: np.ndarray, levels: tuple[float, float], name: str) -> np.ndarray:
    """Return the colours of values, (value, 3) bytes."""
    colour = lookup(name)[as_indices(values, *levels)]
    return np.stack([colour >> 16 & 255, colour >> 8 & 255, colour & 255], -1).astype(np.uint8)


def fitting_distance(box: np.ndarray, back: np.ndarray, aspect: float) -> float:
    """Return the distance from the middle of a box (2, 3), in the direction ``back``, at which all of it is seen."""
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    corners = np.array(np.meshgrid(*(box - box.mean(axis=0)).T)).reshape(3, -1).T
    slope = tan(radians(VIEW_DEG / 2))
    across, up = np.abs(corners @ right) / (aspect * slope), np.abs(corners @ np.cross(back, right)) / slope
    return float((np.maximum(across, up) + corners @ back).max())


def _box(scene: Scene3D) -> np.ndarray:
    """Return the corners of what must be seen, (2, 3): glass, stop, sensor, and rays some way before the lens."""
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
