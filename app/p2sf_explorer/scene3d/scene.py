"""The set-up in space: glass, stop, sensor, rays, wavefront, PSF. No Qt and no pyvista in here."""

from dataclasses import dataclass

import numpy as np

from p2sf_explorer.charts.brightness import stretched
from p2sf_explorer.compute.glass_outlines import still
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.quantities import visible_colour
from p2sf_explorer.scene3d.meshes import Element, Mesh, elements, filling, masked_stop, plate
from p2sf_explorer.scene3d.ray_bundle import Front, PsfSurface, front, psf_surface, ray_bundle

THICKNESS = 0.012  # of stop and sensor, of the lens's half height


@dataclass(frozen=True)
class Scene3D:
    """Everything the 3D view shows, mm; ``rays`` (ray, place, 3); ``colour`` of the light, #rrggbb."""

    glass: tuple[Element, ...]
    stop: Mesh
    sensor: Mesh
    rays: np.ndarray
    colour: str
    front: Front
    psf_surface: PsfSurface


def scene(live: Live) -> Scene3D:
    """Return the scene of an answer. Raises GeometryError where the chief ray does not reach the sensor."""
    setup, drawn = live.setup, live.layout.drawing
    standing = still(setup.lens)
    wedge, thick = 0.18 * drawn.half_height + 0.25 * drawn.stop_rim, THICKNESS * drawn.half_height
    rays = ray_bundle(setup, drawn, live.state.optics.clip)
    half = live.layout.sensor_half
    return Scene3D(
        glass=elements(standing) + filling(standing, drawn.sensor_z),
        stop=masked_stop(setup.lens.mask, drawn.stop_rim, drawn.stop_rim + wedge, drawn.stop_z, thick),
        sensor=plate(half, drawn.sensor_z, thick),
        rays=rays,
        colour=visible_colour(live.state.optics.wavelength_nm),
        front=front(setup, drawn, float(drawn.glass.last[0].max())),
        psf_surface=psf_surface(
            live.psf, brightness(live), drawn, half, float(rays[0, -1, 1]), live.setup.lens.directions[-1]
        ),
    )


def brightness(live: Live) -> np.ndarray:
    """Return the PSF's samples on the scale the window shows, 0 to 1."""
    peak = float(live.psf.values.max()) or 1.0
    return stretched(live.psf.values / peak, live.state.display.psf_scale)
