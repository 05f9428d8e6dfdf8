"""The set-up in space: glass, stop, sensor, rays, wavefront, PSF. No Qt and no pyvista in here."""

from dataclasses import dataclass, replace

import numpy as np

from p2sf.lens.lens import seen_from
from p2sf.lens.placement import Motion, Placement
from p2sf.raytrace.pencil import pencil, tangent_axes
from p2sf_explorer.compute.brightness import stretch
from p2sf_explorer.compute.glass_outlines import last_end, still
from p2sf_explorer.compute.layout import shown_lens
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.quantities import visible_colour
from p2sf_explorer.scene3d.meshes import Element, Mesh, elements, filling, masked_stop, place_mesh, plate
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


def scene(live: Live) -> View[Scene3D]:
    """Return the scene of an answer. Raises GeometryError where the chief ray does not reach the sensor.

    Wavefront and PSF are made in the axes of the plane that touches the sensor at the chief ray's point, turned with
    the source's azimuth, and put there.
    """
    setup, drawn, half = live.setup, live.layout.drawing, live.layout.sensor_half
    rim, thick = drawn.stop_rim, THICKNESS * drawn.half_height
    shown, flat = shown_lens(live.state, setup), replace(drawn, sensor_z=0.0)
    lens, azimuth = setup.lens, setup.source.azimuth_deg
    stands = Placement(tilt_z_deg=-azimuth).motion.then(seen_from(lens, azimuth).frames[-1])
    chief = pencil(lens, setup.source, np.zeros(1), np.zeros(1))
    across, up = float(np.squeeze(chief.chief_x)), float(np.squeeze(chief.chief_y))
    deep = float(lens.sensor_surface.sag(across, up))
    stands = stands.then(Motion(tangent_axes(lens, across, up), np.array([across, up, deep])))
    wave = front(setup, flat, last_end(lens) - lens.sensor_mm)
    psf = psf_surface(live.psf, brightness(live), flat, half, lens.directions[-1])
    stop = masked_stop(lens.mask, rim, rim + 0.18 * drawn.half_height + 0.25 * rim, 0.0, thick)
    return View(
        Scene3D(
            glass=elements(still(shown)) + filling(shown),
            stop=place_mesh(stop, shown.frames[int(setup.stop.surface) - 1]),
            sensor=place_mesh(plate(half, thick, shown.sensor_surface), shown.frames[-1]),
            rays=ray_bundle(setup, drawn, live.state.optics.clip),
            colour=visible_colour(live.state.optics.wavelength_nm),
            front=replace(wave, mesh=place_mesh(wave.mesh, stands)),
            psf_surface=replace(psf, mesh=place_mesh(psf.mesh, stands)),
        )
    )


def brightness(live: Live) -> np.ndarray:
    """Return the PSF's samples on the scale the window shows, 0 to 1."""
    peak = float(live.psf.values.max()) or 1.0
    return stretch(live.psf.values / peak, live.state.display.psf_scale)
