"""Aperture and fields as files state them, turned into a stop rim and field angles by paraxial rays.

The two basis rays are traced in plain floats, because an import needs them at single wavelengths and before the lens
has its aperture.
"""

from dataclasses import dataclass
from math import asin, atan, degrees, inf, isfinite, radians, tan

from p2sf.errors import GeometryError
from p2sf.lens.lens import Aperture, Lens, surface_power
from p2sf.lensfile.raw import RawApertureKind, RawLens
from p2sf.messages import Message

# Above this a distance in a file means infinity; CODE V writes 1e13, ray-tracing programs 1e10.
FAR = 1e10
KINDS: dict[RawApertureKind, Message] = {
    "stop_semi_diameter": Message("stop semi diameter"),
    "entrance_pupil_diameter": Message("entrance pupil diameter"),
    "f_number": Message("f number"),
    "image_f_number": Message("image f number"),
    "object_na": Message("object na"),
    "object_cone_angle": Message("object cone angle"),
    "image_na": Message("image na"),
}


Row = tuple[float, float, float, float]


@dataclass(frozen=True)
class Paraxial:
    """Two basis rays (y, nu) = (1, 0) and (0, 1): heights at the stop, heights and angles behind the lens."""

    stop: tuple[float, float]
    last: tuple[float, float, float, float]
    object_index: float
    image_index: float

    @property
    def entrance_pupil(self) -> float:
        """Return the entrance pupil's position from the first vertex, mm; infinite for a telecentric lens."""
        a, b = self.stop
        return self.object_index * b / a if a else inf

    @property
    def focus(self) -> float:
        """Return the back focal distance, mm; infinite for an afocal lens."""
        a, _, c, _ = self.last
        return -self.image_index * a / c if c else inf


def trace(lens: Lens, stop: int, wavelength_um: float) -> Paraxial:
    """Return the basis rays at one wavelength; GlassError outside a glass's range."""
    index = _indices(lens, wavelength_um)
    rows = _running_matrices(lens, index, wavelength_um)
    return Paraxial(rows[stop - 1][:2], rows[-1], index[0], index[-1])


def indices_of(lens: Lens) -> list[float]:
    """Return the index of every medium at the reference wavelength, negative where light runs back."""
    return _indices(lens, lens.reference_wavelength_um)


def running_matrices(lens: Lens) -> list[Row]:
    """Return heights (a, b) at and reduced angles (c, d) behind every surface of both basis rays there."""
    return _running_matrices(lens, indices_of(lens), lens.reference_wavelength_um)


def _indices(lens: Lens, wavelength_um: float) -> list[float]:
    known = {medium: float(medium.index(wavelength_um)) for medium in dict.fromkeys(lens.media)}
    return [direction * known[medium] for medium, direction in zip(lens.media, lens.directions, strict=True)]


def _running_matrices(lens: Lens, index: list[float], wavelength_um: float) -> list[Row]:
    """Return heights (a, b) at and reduced angles (c, d) behind every surface of both basis rays."""
    a, b, c, d = 1.0, 0.0, 0.0, 1.0
    rows: list[Row] = []
    for number, surface in enumerate(lens.surfaces, 1):
        power = float(surface_power(surface, index[number - 1], index[number], wavelength_um))
        c, d = c - power * a, d - power * b
        rows.append((a, b, c, d))
        reduced = lens.gaps[number - 1] / index[number]
        a, b = a + reduced * c, b + reduced * d
    return rows


def limiting_rim(lens: Lens, wavelength_um: float) -> tuple[int, float]:
    """Return the surface whose rim limits the cone from infinity, and that rim in mm (Pieroni et al. 2015, qSIF)."""
    heights = [abs(row[0]) for row in _running_matrices(lens, _indices(lens, wavelength_um), wavelength_um)]
    filled = [height / surface.semi_diameter for height, surface in zip(heights, lens.surfaces, strict=True)]
    if not any(isfinite(surface.semi_diameter) for surface in lens.surfaces):
        raise GeometryError("the file states no aperture, no stop and no semi-diameter; add one of them")
    widest = max(range(len(filled)), key=filled.__getitem__)
    return widest + 1, lens.surfaces[widest].semi_diameter


def aperture(raw: RawLens, stated: tuple[RawApertureKind, float], rays: Paraxial) -> Aperture:
    """Return the ``stated`` aperture of a lens whose stop is known.

    One stated at a finite distance becomes the stop's semi-diameter. Raises GeometryError for an aperture that is
    impossible or fills nothing.
    """
    kind, value = stated
    if kind == "image_f_number" and not isfinite(raw.object_distance):
        kind = "f_number"  # the same for an object at infinity
    if kind == "stop_semi_diameter":
        return Aperture(kind, value * raw.unit_mm)
    if kind == "entrance_pupil_diameter":
        return Aperture(kind, value * raw.unit_mm)
    if kind == "f_number" and rays.last[2]:
        return Aperture(kind, value)
    rim = abs(_marginal_height(kind, value, raw, rays))
    if not (isfinite(rim) and rim > 0):
        raise GeometryError(
            "the aperture ({kind} {value:g}) fills the stop to {rim:g} mm; correct it",
            kind=KINDS[kind],
            value=value,
            rim=rim,
        )
    return Aperture("stop_semi_diameter", rim)


def _marginal_height(kind: RawApertureKind, value: float, raw: RawLens, rays: Paraxial) -> float:
    """Return the height of the marginal ray at the stop for a stated aperture, mm; infinite where it has none."""
    a, b = rays.stop
    _, _, c, d = rays.last
    distance = raw.object_distance * raw.unit_mm
    if kind == "f_number":
        return inf  # of an afocal lens
    if kind in ("object_na", "object_cone_angle") and not isfinite(distance):
        raise GeometryError("an object at infinity has no numerical aperture; state the pupil's diameter or f-number")
    start = rays.object_index / distance if distance else inf
    if not isfinite(start):
        raise GeometryError("the object lies at the first vertex, where no aperture angle fills the stop; move it")
    per_height = a + b * start
    if kind in ("object_na", "object_cone_angle"):
        return distance * object_slope(kind, value, rays.object_index) * per_height
    slope = c + d * start
    index = abs(rays.image_index)  # negative behind a mirror
    goal = 1 / (2 * value) if kind == "image_f_number" else index * tan(asin(_sine(value, index)))
    return goal / slope * per_height if slope else inf


def object_slope(kind: str, value: float, index: float) -> float:
    """Return the slope of the marginal ray of an object's numerical aperture or of the half angle of its cone."""
    return tan(asin(_sine(value, index)) if kind == "object_na" else radians(_angle(value)))


def _sine(numerical_aperture: float, index: float) -> float:
    if not 0 < numerical_aperture < index:
        raise GeometryError(
            "numerical aperture {value:g} is impossible in index {index:g}; correct it",
            value=numerical_aperture,
            index=index,
        )
    return numerical_aperture / index


def field_slopes(raw: RawLens, rays: Paraxial) -> list[tuple[float, float]]:
    """Return each field as the slopes (x, y) of its chief ray at the entrance pupil, upwards positive.

    Raises GeometryError where a height has no slope: an afocal lens, a telecentric one, an object at infinity.
    """
    if raw.field_kind == "angle":
        return [(slope_of_angle(x), slope_of_angle(y)) for x, y in raw.fields]
    if not any(map(any, raw.fields)):
        return [(0.0, 0.0)] * len(raw.fields)
    per_slope = _height_per_slope(raw, rays)
    if not (isfinite(per_slope) and per_slope):
        raise GeometryError("field heights have no angle for this lens")
    return [(x * raw.unit_mm / per_slope, y * raw.unit_mm / per_slope) for x, y in raw.fields]


def slope_of_angle(angle_deg: float) -> float:
    """Return the slope of a field angle; GeometryError from a right angle on."""
    return tan(radians(_angle(angle_deg)))


def _angle(angle_deg: float) -> float:
    if not abs(angle_deg) < 90:
        raise GeometryError("field angle {angle:g}° is not below 90°; correct it", angle=angle_deg)
    return angle_deg


def _height_per_slope(raw: RawLens, rays: Paraxial) -> float:
    """Return the object height, or the paraxial image height, of a chief ray of slope 1."""
    distance = raw.object_distance * raw.unit_mm
    pupil = rays.entrance_pupil
    if raw.field_kind == "object_height":
        return -(distance + pupil)
    if not isfinite(pupil):
        return inf
    a, b, c, d = rays.last
    start = rays.object_index / distance if distance else 0.0
    slope = c + d * start
    image = -rays.image_index * (a + b * start) / slope if slope else inf
    y, nu = -pupil, rays.object_index
    return a * y + b * nu + (c * y + d * nu) / rays.image_index * image


def degrees_of(slopes: list[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    """Return field angles (x, y) in degrees, each once, in the file's order."""
    return tuple(dict.fromkeys((_degrees(x), _degrees(y)) for x, y in slopes))


def _degrees(slope: float) -> float:
    return round(degrees(atan(slope)), 12) + 0.0  # + 0.0 turns −0 into 0
