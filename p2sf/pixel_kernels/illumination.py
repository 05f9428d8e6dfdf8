"""The light that a lens collects from a point of an even object, and how thinly the sensor's area spreads it."""

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from p2sf.disc.domain import ClearNodes
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.pixel_kernels.sensor_points import SensorMap, landing_mm
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.pencil import pencil, rays_through
from p2sf.threads import map_threads

NODES = 12, 32


@lru_cache(maxsize=256)
def light_collected(lens: Lens, source: Source, clip: bool = False) -> float:
    """Return ∫cos θ dΩ over the pencil of a point of a Lambertian object, per unit d²(field slope).

    It is relative to the paraxial entrance pupil's area at normal incidence. A plane of depth D before the entrance
    pupil has dA = D²·d²s; for one at infinity dω = cos³θ·d²s. With dΩ = light·cos³θ_chief/D² both give the mean of
    light·cos θ·cos³θ_chief over the pupil (the cosine to the fourth of a pinhole; Welford 1986, §6.5). Rays that are
    lost carry no light. Raises GeometryError where all are.
    """
    nodes = _open_nodes(lens, source, clip)
    rays = rays_through(lens, source, nodes)
    entering = pupil_rays(seen_from(lens, source.azimuth_deg), source, nodes.xi, nodes.eta)
    cosine = 1 / np.sqrt(1 + entering.slope_x * entering.slope_x + entering.slope_y * entering.slope_y)
    mean = float((rays.share * rays.light * cosine).sum())
    return float(nodes.share * mean / (1 + source.field_slope**2) ** 1.5)


@lru_cache(maxsize=1024)
def light_passed(lens: Lens, source: Source, clip: bool = False) -> float:
    """Return the share of the energy of the rays that arrive which surfaces and media pass, 1 where nothing takes any.

    It is a mean over the open pupil by the light that enters. Raises GeometryError where all rays are lost.
    """
    rays = rays_through(lens, source, _open_nodes(lens, source, clip)).arrived
    entering = rays.share * rays.launch * np.square(rays.mask)
    return float((entering * rays.transmission).sum() / entering.sum())


def _open_nodes(lens: Lens, source: Source, clip: bool) -> ClearNodes:
    """Return nodes over what mask, rims and lost rays leave open."""
    nodes = pupil_nodes(lens, source, NODES, clip)
    if pencil(lens, source, nodes.xi, nodes.eta).passed.all():
        return nodes
    return pupil_nodes(lens, source, NODES, clip, whole=False)


def relative_illumination(seen: SensorMap, x_mm: ArrayLike, y_mm: ArrayLike) -> np.ndarray:
    """Return the irradiance of an even object at places over that where the field's centre lands; mm, shape kept.

    The light of d²s falls on the area d²s/`thinning`, which distortion changes over the field.
    """
    x, y = np.broadcast_arrays(np.asarray(x_mm, float), y_mm)
    centre = landing_mm(seen.lens, Source(seen.depth_mm, 0.0, seen.wavelength_um))
    places = [centre, *zip(x.ravel().tolist(), y.ravel().tolist(), strict=True)]
    sources = (seen.source(*place, seen.wavelength_um) for place in places)
    light = np.array(map_threads(lambda source: light_collected(seen.lens, source, seen.clip), sources))
    light *= seen.fields.thinning(*np.array(places).T)
    relative: np.ndarray = (light[1:] / light[0]).reshape(x.shape)
    return relative
