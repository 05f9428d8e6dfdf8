"""The reference sphere of a field: where rays leave its exit pupil, and how they look from there.

The centre of the exit pupil of a field is where chief rays of neighbouring fields come closest to its own, and the
sphere through it is centred on the focus of the chief ray, where rays beside it come closest. From a point s of the
sphere a ray K reaches the sensor at I = s + tK. Seen from s, the chief ray's point C of the sensor lies at a distance L
in the direction M. t, L and the distance of the sphere have one sign, that of the way of light (`conventions`), so that
a pupil behind the sensor, or behind a mirror, is no special case.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf, isinf

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.raytrace.field_geometry import closest, pupil_about
from p2sf.raytrace.pencil import Rays, pencil

BESIDE = 0.02  # of the pupil's radius, of the rays whose focus is that of the chief ray


@dataclass(frozen=True)
class ExitSphere:
    """The sphere in the exit pupil of a field: ``distance`` from it to the sensor along the chief ray, mm.

    ``curvature``: 1/mm, positive where its centre lies in the way of light; ``chief``: direction cosines of the chief
    ray; ``waves_per_um``: n'/λ.
    """

    distance: float
    curvature: float
    chief: tuple[float, float, float]
    waves_per_um: float

    def to_sensor(self, rays: Rays) -> np.ndarray:
        """Return the distance t of each ray from the sphere to the sensor, mm, (ray,).

        With E the centre of the pupil, it solves c|s − E|² = 2(s − E)·K chief for s = I − tK. NaN for a ray that does
        not meet the sphere.
        """
        (dx, dy), (kx, ky, kz), d = (rays.dx, rays.dy), self.chief, self.distance
        # s − E of a ray that goes as far as the chief ray; the rest is small, so that no digits are lost.
        x, y, z = dx + d * (kx - rays.kx), dy + d * (ky - rays.ky), d * (kz - rays.kz)
        along, c = rays.kx * kx + rays.ky * ky + rays.kz * kz, self.curvature
        slope = along - c * (x * rays.kx + y * rays.ky + z * rays.kz)
        square = c * (x * x + y * y + z * z) - 2 * (x * kx + y * ky + z * kz)
        with np.errstate(invalid="ignore"):
            t: np.ndarray = d - square / (slope + np.sqrt(slope * slope - c * square))
        return t

    def seen_from(self, rays: Rays) -> tuple[Rays, np.ndarray]:
        """Return rays as they go from the sphere to the chief ray's point of the sensor, and that distance L, mm.

        Their phase is that of the spherical wavelet at that point, (path − n't + n'L)/λ, and their frequencies are
        those that it has there; they are plane waves that agree with the wavelets to second order in the place on the
        sensor. They land where they did.
        """
        t = self.to_sensor(rays)
        if not np.isfinite(t[rays.passed]).all():
            raise GeometryError("rays do not meet the sphere in the exit pupil; stop the lens down")
        across, up = t * rays.kx - rays.dx, t * rays.ky - rays.dy
        length = np.copysign(np.sqrt(across * across + up * up + (t * rays.kz) ** 2), t)
        square = rays.dx * rays.dx + rays.dy * rays.dy
        # L − t, without subtracting the two.
        more = (square - 2 * t * (rays.kx * rays.dx + rays.ky * rays.dy)) / (length + t)
        kx, ky, kz = (k - (more * k + d) / length for k, d in ((rays.kx, rays.dx), (rays.ky, rays.dy), (rays.kz, 0.0)))
        path = rays.path + rays.index * (more + kx * rays.dx + ky * rays.dy)
        return replace(rays, kx=kx, ky=ky, kz=kz, path=path, crossings=None), length

    def radius(self, rays: Rays, share: np.ndarray) -> float:
        """Return the radius of a disc with the RMS radius of the rays about the chief ray on the sphere, mm."""
        t, d = self.to_sensor(rays), self.distance
        across = np.stack([rays.dx, rays.dy, 0 * rays.dx]) - t * np.stack([rays.kx, rays.ky, rays.kz])
        chief = np.array(self.chief)[:, None]
        across = across + d * chief
        across = across - (chief * across).sum(0) * chief
        return float(np.sqrt(2 * (share @ (across**2).sum(0)) / share.sum()))


@lru_cache(maxsize=64)
def exit_sphere(lens: Lens, source: Source) -> ExitSphere | None:
    """Return the reference sphere of a source; None where its exit pupil is at infinity.

    Raises GeometryError where the chief ray, one beside it or one of a neighbouring field does not reach the sensor.
    """
    beside = pencil(lens, source, BESIDE * np.array([1.0, -1, 0, 0]), BESIDE * np.array([0.0, 0, 1, -1]))
    if not beside.passed.all():
        raise GeometryError("rays beside the chief ray do not reach the sensor; reduce the field")
    kx, ky, kz = (float(np.ravel(k)[0]) for k in (beside.chief_kx, beside.chief_ky, beside.chief_kz))
    if lens.sensor_surface.curvature:  # neighbouring fields have tangent planes of their own
        sag = Placement(decentre_z=float(lens.sensor_surface.sag(*(beside.chief_um / UM_PER_MM))))
        flat = replace(lens, sensor_radius=inf, sensor_conic=0.0, sensor_before=(*lens.sensor_before, sag))
        found = exit_sphere(flat, source)
        return None if found is None else replace(found, chief=(kx, ky, kz))
    distance = pupil_about(lens, source).distance_mm
    if isinf(distance):
        return None
    places, cosines = np.stack([beside.dx, beside.dy, np.zeros(4)]), np.stack([beside.kx, beside.ky, beside.kz])
    behind, bend = closest(places, cosines, np.array([kx, ky, kz]))
    radius = distance * bend - behind
    waves_per_um = float(beside.index) / source.wavelength_um
    return ExitSphere(distance, bend / radius if radius else 0.0, (kx, ky, kz), waves_per_um)
