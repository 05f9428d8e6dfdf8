"""A coarse picture at once, while the planned one is computed."""

from dataclasses import replace

import numpy as np

from p2sf.image.form import Forming, form_image
from p2sf.lens.lens import Lens
from p2sf.pixel_kernels import Recipe
from p2sf.scene.bounds import check_colours
from p2sf.scene.cost import Cost
from p2sf.scene.plan import Plan
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor
from p2sf.scene.spectrum import reduced

LONGEST = 320  # pixels along the preview's longer side
COUNTS = 3, 3
COARSE = Recipe("fitted", 26)
UNKNOWN = Cost(0.0, 0.0, 0.0)


def preview(lens: Lens, scene: Scene, values: np.ndarray, depth_mm: float | None = None) -> np.ndarray:
    """Return a coarse picture of the scene's far end or one depth, (rows, columns, channels), at most 320 pixels long.

    One wavelength a channel, 26 numbers a pencil, 3 × 3 nodes, pixels averaged in blocks. Unlike a plan's, its error
    is not bounded.
    """
    camera = scene.camera(lens)
    check_colours(camera, scene)
    times = -(-max(scene.sensor.rows, scene.sensor.columns) // LONGEST)
    coarse = replace(scene, sensor=_coarser(scene.sensor, times), depth_map=None)
    if depth_mm is not None:
        coarse = replace(coarse, near_mm=depth_mm, far_mm=depth_mm)
    return form_image(preview_plan(camera, coarse), averaged(values, times), how=Forming(spline=1))


def preview_plan(camera: Lens, scene: Scene) -> Plan:
    """Return a plan without any measurement, whose error is unknown, of a lens already focused."""
    colours = tuple(reduced(channel, 1) for channel in scene.channels)
    middle = colours[len(colours) // 2].wavelengths_um[0]
    edge = scene.sensor.corners_mm()[1]
    vergence = float(scene.vergences(2)[0])
    zones = ((edge, COARSE),)
    return Plan(camera, scene, middle, zones, colours, COUNTS, (vergence,), (), float("nan"), UNKNOWN, UNKNOWN)


def _coarser(sensor: Sensor, times: int) -> Sensor:
    return replace(
        sensor,
        rows=max(1, sensor.rows // times),
        columns=max(1, sensor.columns // times),
        pixel_um=sensor.pixel_um * times,
    )


def averaged(values: np.ndarray, times: int) -> np.ndarray:
    """Return a picture averaged over blocks of ``times``² pixels; pixels that do not fill a block are dropped."""
    rows, columns = (n // times for n in values.shape[:2])
    cut = np.asarray(values, np.float32)[: rows * times, : columns * times]
    total: np.ndarray = np.zeros_like(cut[::times, ::times])
    for i in range(times):
        for j in range(times):
            total += cut[i::times, j::times]
    return total / np.float32(times * times)
