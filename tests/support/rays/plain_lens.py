"""Lenses of spheres and conics from their files, traced and diffracted with numpy alone: nothing of `p2sf` is used.

Glasses by the Sellmeier coefficients of Schott's data sheets. Lengths in mm, patches in µm, fields in degrees; light
along +z, the first vertex at the origin.
"""

import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf, isinf, radians, tan
from pathlib import Path

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.interpolate import CubicSpline
from scipy.special import j0

LENSES = Path(__file__).parents[3] / "lenses"
SCHOTT = {  # B1, C1, B2, C2, B3, C3 of n² − 1 = Σ B λ²/(λ² − C), λ in µm
    "N-BK7": (1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653),
    "N-BAK1": (1.12365662, 0.00644742752, 0.309276848, 0.0222284402, 0.881511957, 107.297751),
    "SF2": (1.40301821, 0.0105795466, 0.231767504, 0.0493226978, 0.939056586, 112.405955),
    "N-SSK2": (1.4306027, 0.00823982975, 0.153150554, 0.0333736841, 1.01390904, 106.870822),
    "N-SK2": (1.28189012, 0.0072719164, 0.257738258, 0.0242823527, 0.96818604, 110.377773),
    "N-SK16": (1.34317774, 0.00704687339, 0.241144399, 0.0229005, 0.994317969, 92.7508526),
    "F2": (1.34533359, 0.00997743871, 0.209073176, 0.0470450767, 0.937357162, 111.886764),
    "F5": (1.3104463, 0.00958633048, 0.19603426, 0.0457627627, 0.96612977, 115.011883),
}
NEAR = 1e-4  # mm or of a slope: so close to the axis that third powers are below a rounding


def index_of(glass: str | None, wavelength_um: float) -> float:
    if glass is None:
        return 1.0
    square, c = wavelength_um**2, SCHOTT[glass.removeprefix("SCHOTT ")]
    return float(np.sqrt(1 + sum(b * square / (square - d) for b, d in zip(c[::2], c[1::2], strict=True))))


def read_lens(name: str, wavelength_um: float = 0.5875618, depth: float = inf) -> "PlainLens":
    """Return a lens, of the shipped ones unless it is a path, its stop as wide as the file says or else 1 mm."""
    file = tomllib.loads((LENSES / f"{name}.toml").read_text(encoding="utf-8"))
    surfaces = file["surface"]
    return PlainLens(
        tuple(0.0 if isinf(one["radius"]) else 1 / one["radius"] for one in surfaces),
        tuple(one["thickness"] for one in surfaces),
        (1.0, *(index_of(one.get("glass"), wavelength_um) for one in surfaces)),
        file["stop_surface"] - 1,
        file["aperture"].get("stop_semi_diameter", 1.0),
        wavelength_um,
        depth,
    )


@dataclass(frozen=True)
class Landing:
    """Rays at the sensor: place (2, ray), direction (3, ray), path from the source, height (2, ray) at the stop."""

    place: np.ndarray
    direction: np.ndarray
    path: np.ndarray
    at_stop: np.ndarray


@dataclass(frozen=True)
class PlainLens:
    """A lens at one wavelength; ``gaps[-1]`` is the way from the last vertex to the sensor, ``depth`` to the source."""

    curvatures: tuple[float, ...]
    gaps: tuple[float, ...]
    indices: tuple[float, ...]
    stop: int
    rim: float
    wavelength_um: float
    depth: float = inf

    @cached_property
    def focal_length(self) -> float:
        ray = replace(self, depth=inf).trace(np.array([NEAR])).direction
        return float((-NEAR * ray[2] / ray[1]).item())

    def at_f_number(self, number: float) -> "PlainLens":
        """Return the lens with its stop as wide as makes focal length over width of the entrance pupil this number."""
        height = replace(self, depth=inf).height_for(NEAR)
        return replace(self, rim=self.focal_length / (2 * number) * NEAR / height)

    @cached_property
    def aperture(self) -> float:
        """Return NA, the slope of the paraxial ray through the rim."""
        near = self.trace(np.array([self.height_for(NEAR)]))
        return float(abs(self.rim / NEAR * near.direction[1] / near.direction[2]).item())

    @property
    def defocus(self) -> float:
        """Return Wd = NA²Δz/2λ, waves, Δz from the image of rays close to the axis to the sensor (Welford 1986)."""
        return -(self.aperture**2) * self.image_mm() * 500 / self.wavelength_um

    def third_order(self, field_deg: float) -> dict[str, float]:
        """Return W40, W31, W22, W20 in waves at the rim, from rays near the axis, scaled up by the powers of each.

        W40 is from paths. The others are from where rays land: they meet at Δz = −2λ(W22 + W20)/NA² in the plane of
        axis and field, across it without W22; upper and lower ones land 3 W31 λ/NA from the chief ray in the mean
        (Welford 1986, ch. 8).
        """
        part, small = 0.02, 0.5
        height = np.linspace(0.05, 0.5, 30)
        pupil = self.rim / NEAR * self.height_for(NEAR)
        late = self.shifted(self.image_mm()).waves(height * pupil)
        powers = np.linalg.lstsq(height[:, None] ** np.array([4, 6, 8, 10]), late, rcond=None)[0]
        up = np.tan(np.radians(field_deg)) / np.tan(np.radians(small))
        chief = self.height_for(0.0, small)
        fan = np.array([self.height_for(h * self.rim * part, small) for h in (-1.0, 0.0, 1.0)])
        lands = self.trace(fan, small).place[1]
        in_plane = self.trace(chief + np.array([-NEAR, NEAR]), small)
        across = self.trace(np.array([chief]), small, NEAR)
        slope = np.diff(in_plane.direction[1] / in_plane.direction[2]).item()
        tangential = -np.diff(in_plane.place[1]).item() / slope - self.image_mm()
        sagittal = float((-across.place[0] * across.direction[2] / across.direction[0]).item()) - self.image_mm()
        waves = -(self.aperture**2) * 500 / self.wavelength_um * up**2
        return {
            "w40": -float(powers[0]),
            "w31": float(lands[0] + lands[2] - 2 * lands[1])
            / 2
            * self.aperture
            * 1000
            / (3 * self.wavelength_um)
            / part**2
            * up,
            "w22": waves * (tangential - sagittal),
            "w20": waves * sagittal,
        }

    def shifted(self, shift_mm: float) -> "PlainLens":
        """Return the lens with its sensor so much farther away."""
        return replace(self, gaps=(*self.gaps[:-1], self.gaps[-1] + shift_mm))

    def trace(self, height: np.ndarray, field_deg: float = 0.0, aside: float = 0.0) -> Landing:
        """Return the rays that meet the plane of the first vertex at these heights, ``aside`` of axis and field."""
        point = np.stack([aside + 0 * height, height, 0 * height])
        far = isinf(self.depth)
        along = [0.0, tan(radians(field_deg)), 1.0] if far else [0.0, 0.0, self.depth]
        ray = np.array(along)[:, None] + (0 if far else 1) * point
        length = np.sqrt((ray**2).sum(0))
        ray = ray / length
        path = (point * ray).sum(0) if far else length - self.depth
        for j, curvature in enumerate(self.curvatures):
            before, after = self.indices[j : j + 2]
            step, normal = _crossing(curvature, point, ray)
            path, point = path + before * step, point + step * ray
            if j == self.stop:
                at_stop = point[:2]
            onward = before / after * ray
            forward = (onward * normal).sum(0)
            ray = onward + (np.sqrt(1 - (onward**2).sum(0) + forward**2) - forward) * normal
            point = point - np.array([0.0, 0.0, self.gaps[j]])[:, None]
        step = -point[2] / ray[2]
        return Landing(point[:2] + step * ray[:2], ray, path + self.indices[-1] * step, at_stop)

    def height_for(self, stop_mm: float, field_deg: float = 0.0) -> float:
        """Return the height at the first vertex of the ray that meets the stop at ``stop_mm``, by secants."""

        def miss(height: float) -> float:
            return float(self.trace(np.array([height]), field_deg).at_stop[1, 0]) - stop_mm

        old, new = 0.0, 0.5 * self.rim
        missed = miss(old)
        for _ in range(50):
            now = miss(new)
            if abs(now) < 1e-13 or now == missed:
                return new
            old, new, missed = new, new - now * (new - old) / (now - missed), now
        raise ArithmeticError("no ray meets the stop there")

    def chief_mm(self, field_deg: float) -> float:
        """Return where the ray through the middle of the stop lands."""
        return float(self.trace(np.array([self.height_for(0.0, field_deg)]), field_deg).place[1, 0])

    @cached_property
    def highest(self) -> float:
        """Return the height of the ray through the rim of the stop."""
        return self.height_for(self.rim)

    def image_mm(self) -> float:
        """Return how far behind the sensor rays close to the axis meet."""
        near = self.trace(np.array([NEAR]))
        return float((-near.place[1] * near.direction[2] / near.direction[1]).item())

    def on_sphere(self, height: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return by how many waves rays come later than the one along the axis, and the sines of their places.

        Both on the sphere about the sensor's middle through the middle of the exit pupil.
        """
        field = np.rad2deg(NEAR)
        distant = replace(self, depth=inf)
        chief = distant.trace(np.array([distant.height_for(0.0, field)]), field)
        radius = float((chief.place[1] * chief.direction[2] / chief.direction[1]).item())
        rays = self.trace(np.append(0.0, height))
        along = (rays.place * rays.direction[:2]).sum(0)
        back = along + np.sign(radius) * np.sqrt(radius**2 + along**2 - (rays.place**2).sum(0))
        late = 1000 / self.wavelength_um * (rays.path - self.indices[-1] * back)
        place = rays.place[1] - back * rays.direction[1]
        return late[1:] - late[0], np.abs(place[1:] / radius)

    def waves(self, height: np.ndarray) -> np.ndarray:
        """Return by how many waves rays come later than the one along the axis."""
        return self.on_sphere(height)[0]

    def rms_waves(self) -> float:
        """Return the RMS of the wavefront on the axis over the area of the beam."""
        node, weight = leggauss(40)
        late = self.waves(self.highest * np.sqrt((1 + node) / 2))
        return float(np.sqrt(weight @ late**2 / 2 - (weight @ late / 2) ** 2))

    def patch(self, spherical: bool = False) -> "Patch":
        """Return the light of a star on the axis by the area of the beam: plane waves in the rays' directions.

        ``spherical``: spherical waves from the sphere of `on_sphere` (Born & Wolf 1999, §8.3.2).
        """
        node, weight = leggauss(max(80, int(16 * abs(self.waves(np.array([self.highest]))[0]))))
        height, share = self.highest * (1 + node) / 2, self.highest * weight / 2
        rays = self.trace(height)
        late = 1000 / self.wavelength_um * (rays.path - self.indices[-1] * (rays.place * rays.direction[:2]).sum(0))
        sines = [np.abs(self.trace(height + d).direction[1]) for d in (0.0, -NEAR, NEAR)]
        if spherical:
            late, sines[0] = self.on_sphere(height)
            sines[1:] = (self.on_sphere(height + d)[1] for d in (-NEAR, NEAR))
        scale = self.indices[-1] / self.wavelength_um
        amplitude = height / (sines[0] * (sines[2] - sines[1]) / (2 * NEAR) * scale**2)
        light = 2 * np.pi * (share * height * amplitude).sum()
        return Patch(scale * sines[0], late, amplitude, 2 * np.pi * share * height, float(light))


@dataclass(frozen=True)
class Patch:
    """A round patch as a sum of rings of the pupil, and all of its light.

    Of every ring the frequency in 1/µm, the waves by which it comes late, its field per area and its whole field.
    """

    frequency: np.ndarray
    late: np.ndarray
    amplitude: np.ndarray
    ring: np.ndarray
    total: float

    def light(self, radius_um: np.ndarray) -> np.ndarray:
        """Return the light at these radii."""
        field = self.ring * np.exp(2j * np.pi * self.late)
        return np.abs(j0(2 * np.pi * np.outer(radius_um, self.frequency)) @ field) ** 2

    def radius_80(self, widest_um: float) -> float:
        """Return the radius that holds 80 % of all light."""
        steps = int(100 * widest_um * self.frequency.max())
        edge = np.linspace(0, widest_um, steps + 1)
        middle, width = (edge[1:] + edge[:-1]) / 2, widest_um / steps
        within = np.cumsum(2 * np.pi * middle * self.light(middle)) * width / self.total
        assert within[-1] > 0.8, "look farther out"
        return float(np.interp(0.8, within, edge[1:]))

    def contrast(self, per_mm: float) -> float:
        """Return what a sine pattern keeps: the pupil times itself, pushed apart, over its overlap (Duffieux 1946)."""
        half, rim = per_mm / 2000, float(self.frequency.max())
        node, weight = leggauss(150)
        angle = np.pi / 2 * (1 + node) / 2  # v = V sin: even where the overlap has its corners
        highest = np.sqrt(rim**2 - half**2)
        v, dv = highest * np.sin(angle), highest * np.cos(angle) * weight * np.pi / 4
        widest = np.sqrt(rim**2 - v**2) - half
        u = widest[:, None] * node
        one, other = (self._pupil(np.hypot(u + s * half, v[:, None])) for s in (1, -1))
        return float(abs(2 * ((one * other.conj()) @ weight * widest) @ dv) / self.total)

    def _pupil(self, frequency: np.ndarray) -> np.ndarray:
        """Return the field per area of the pupil at frequencies within it."""
        late, amplitude = (CubicSpline(self.frequency, one)(frequency) for one in (self.late, self.amplitude))
        return np.asarray(amplitude * np.exp(2j * np.pi * late))

    def strehl(self) -> float:
        """Return the light in the middle over that without any error of the wavefront."""
        return float(self.light(np.zeros(1))[0] / self.ring.sum() ** 2)


def _crossing(c: float, point: np.ndarray, ray: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the way along rays to a sphere of this curvature, and its unit normals there."""
    to_plane = -point[2] / ray[2]
    flat = point + to_plane * ray
    square = c * (flat[0] ** 2 + flat[1] ** 2)
    b = ray[2] - c * (flat[0] * ray[0] + flat[1] * ray[1])
    step = to_plane + square / (b + np.sqrt(b * b - c * square))
    at = point + step * ray
    return step, np.stack([-c * at[0], -c * at[1], 1 - c * at[2]])


def circle_mtf(part: np.ndarray | float) -> np.ndarray:
    """Return the contrast of a sine pattern at this part of the limit behind a perfect round pupil (Duffieux 1946)."""
    v = np.minimum(np.asarray(part, float), 1.0)
    return 2 / np.pi * (np.arccos(v) - v * np.sqrt(1 - v * v))


def bars_contrast(mtf: Callable[[float], float], frequency: float, limit: float) -> float:
    """Return the contrast in the middle of black and white bars: 4/π Σ ±MTF(kν)/k over odd k (Coltman 1954)."""
    odd = np.arange(1, int(limit / frequency) + 1, 2)
    return float(4 / np.pi * sum((-1) ** (k // 2) * mtf(k * frequency) / k for k in odd.tolist()))
