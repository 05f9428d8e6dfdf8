"""Paraxial solves of lens files: curvatures and thicknesses that follow from a marginal or a chief ray.

They are evaluated surface by surface, at the reference wavelength, from the surfaces before. With y and u the height
and the slope of a ray before a surface and u' behind it, n'u' = nu − yc(n' − n) (Welford 1986, ch. 3), indices negative
where light runs back.
"""

from collections.abc import Callable
from dataclasses import replace
from math import inf, isfinite
from typing import NamedTuple

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_aligned, surface_power
from p2sf.lensfile import conjugates
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.raw import ParaxialSolve, RawLens
from p2sf.lensfile.report import Notebook
from p2sf.messages import Message

NO_REFRACTION = "whose ray meets the surface on the axis, or where nothing refracts"
SAME = 1e-4  # relative: glasses of another catalogue, and digits that files leave out
CURVATURE, THICKNESS = Message("curvature"), Message("thickness")
FOCUS_KEPT = "a solve puts the paraxial focus {found:.7g} mm behind it; the file's thickness, {old:.7g} mm, is kept"
FOCUS = "its thickness, up to the paraxial focus, is {found:.9g} mm"
KEPT = "its {what} by the solve {solve} is {found:.7g} ({unit}); that of the file, {old:.7g}, is kept"
FOUND = "its {what} by the solve {solve} is {found:.9g} ({unit})"


class SolvedRay(NamedTuple):
    """A paraxial ray before a surface: its height in mm and n·u, and the indices before and behind."""

    y: float
    nu: float
    before: float
    behind: float


def with_solves(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with the curvatures and thicknesses that solves give, where the file states none.

    The value that the writing program stored stays, with a note where the solve gives another. Raises GeometryError
    for a solve without a stored value that its surfaces do not determine, as in a misaligned lens.
    """
    for number, stated in enumerate(raw.surfaces, 1):
        for what in ("curvature", "thickness"):
            if what in stated.solves:
                lens = _with_solve(lens, raw, number, stated.solves[what], notes)
    return lens


def _with_solve(lens: Lens, raw: RawLens, number: int, solve: ParaxialSolve, notes: Notebook) -> Lens:
    surface, stated, bends = lens.surfaces[number - 1], raw.surfaces[number - 1], solve.of == "curvature"
    old = surface.curvature if bends else surface.thickness
    try:
        check_aligned(lens, Message("a solve"))
        found = _curvature(lens, raw, number, solve) if bends else _thickness(lens, raw, number, solve)
    except GeometryError as failure:
        if not old:
            raise GeometryError(
                "surface {surface}: its {what} follows from the solve {solve}, {reason}; state the number instead",
                surface=number,
                what=CURVATURE if bends else THICKNESS,
                solve=solve.name,
                reason=failure,
            ) from failure
        return lens
    if not abs(found) < FAR or (old and abs(found - old) <= SAME * abs(found)):
        return lens
    values: dict[str, object] = {"found": found, "old": old} if old else {"found": found}
    focus = not bends and solve.ray == "marginal" and not solve.value
    told = (FOCUS_KEPT if old else FOCUS) if focus else (KEPT if old else FOUND)
    if not focus:
        values |= {"what": CURVATURE if bends else THICKNESS, "solve": solve.name, "unit": "1/mm" if bends else "mm"}
    notes.add("read", told, stated.number, stated.line, **values)
    if old:
        return lens
    radius = (1 / found if found else inf) if bends else surface.radius
    changed = replace(surface, radius=radius, thickness=surface.thickness if bends else found)
    return replace(lens, surfaces=(*lens.surfaces[: number - 1], changed, *lens.surfaces[number:]))


def _curvature(lens: Lens, raw: RawLens, number: int, solve: ParaxialSolve) -> float:
    """Return the curvature that a solve gives, per mm; GeometryError where no surface before determines it."""
    index = conjugates.indices_of(lens)[max(0, number - 2) : number + 1]
    if solve.kind == "power":
        return _second_curvature(lens, number, index, solve.value / raw.unit_mm)
    ray = _ray_before(lens, raw, number, solve)
    if not ray.y or ray.before == ray.behind:
        raise GeometryError(NO_REFRACTION)
    return CURVATURES[solve.kind](ray, solve.value)


CURVATURES: dict[str, Callable[[SolvedRay, float], float]] = {
    "angle": lambda ray, u: (ray.nu - ray.behind * u) / (ray.y * (ray.behind - ray.before)),
    "incidence": lambda ray, i: (i - ray.nu / ray.before) / ray.y,  # i = u + yc
    "aplanatic": lambda ray, _: -ray.nu * (ray.before + ray.behind) / (ray.before**2 * ray.y),  # u'/n' = u/n
}


def _second_curvature(lens: Lens, number: int, index: list[float], power: float) -> float:
    """Return the curvature of the second surface of an element of this power, φ = φ₁ + φ₂ − φ₁φ₂t/n."""
    if number < 2:
        raise GeometryError("before which no surface stands")
    first, (before, inside, behind) = lens.surfaces[number - 2], index
    one = first.vertex_curvature * (inside - before)
    height = 1 - one * lens.gaps[number - 2] / inside  # of a ray parallel to the axis, of height 1 at the first
    if not height or behind == inside:
        raise GeometryError(NO_REFRACTION)
    return (power - one) / height / (behind - inside)


def _thickness(lens: Lens, raw: RawLens, number: int, solve: ParaxialSolve) -> float:
    """Return the thickness, mm, behind which the ray has the height of a solve."""
    ray, surface = _ray_before(lens, raw, number, solve), lens.surfaces[number - 1]
    power = float(surface_power(surface, ray.before, ray.behind, lens.reference_wavelength_um))
    slope = (ray.nu - ray.y * power) / ray.behind
    if not slope:
        raise GeometryError("whose ray leaves parallel to the axis")
    shifted = lens.gaps[number - 1] - surface.thickness  # by breaks
    return (solve.value * raw.unit_mm - ray.y) / slope + solve.beyond * raw.unit_mm - shifted


def _ray_before(lens: Lens, raw: RawLens, number: int, solve: ParaxialSolve) -> SolvedRay:
    """Return the ray of a solve before a surface."""
    index, rows = conjugates.indices_of(lens), conjugates.running_matrices(lens)
    y, nu = _chief(raw, rows, index[0]) if solve.ray == "chief" else _marginal(raw, rows, index[0], bool(solve.value))
    if (solve.ray == "chief" or solve.value) and (raw.stop or number + 1) > number and _by_stop(raw, solve):
        raise GeometryError("whose ray depends on surfaces behind it, before the stop")
    a, b = rows[number - 1][:2]
    c, d = rows[number - 2][2:] if number > 1 else (0.0, 1.0)
    return SolvedRay(a * y + b * nu, c * y + d * nu, index[number - 1], index[number])


def _by_stop(raw: RawLens, solve: ParaxialSolve) -> bool:
    """Return whether a ray starts where the stop has it go."""
    kind = raw.aperture[0] if raw.aperture else ""
    return solve.ray == "chief" or (kind == "entrance_pupil_diameter" and isfinite(raw.object_distance))


def _marginal(raw: RawLens, rows: list[conjugates.Row], index: float, sized: bool) -> tuple[float, float]:
    """Return height and n·u of the marginal ray at the first surface, of any size where a solve has none."""
    distance = raw.object_distance * raw.unit_mm
    slope = 0.0 if not isfinite(distance) else 1 / distance if distance else 1.0
    height = 1.0 if distance else 0.0
    size = 1.0 if not sized else _height_at_first(raw, rows, index)
    return size * height, size * slope * index


def _height_at_first(raw: RawLens, rows: list[conjugates.Row], index: float) -> float:
    """Return the height of the marginal ray at the first surface, mm, or its slope for an object there."""
    kind, value = raw.aperture or ("", 0.0)
    distance = raw.object_distance * raw.unit_mm
    if kind == "entrance_pupil_diameter":
        share = (distance or 1.0) / _object_to_pupil(raw, rows, index) if isfinite(distance) else 1.0
        return value * raw.unit_mm / 2 * share
    if kind in ("object_na", "object_cone_angle") and isfinite(distance):
        return (distance or 1.0) * conjugates.object_slope(kind, value, index)
    raise GeometryError("whose ray depends on the whole lens by its aperture")


def _entrance(raw: RawLens, rows: list[conjugates.Row], index: float) -> float:
    """Return the place of the entrance pupil behind the first surface, mm."""
    a, b = rows[(raw.stop or 1) - 1][:2]
    if not a:
        raise GeometryError("whose entrance pupil is at infinity")
    return index * b / a


def _object_to_pupil(raw: RawLens, rows: list[conjugates.Row], index: float) -> float:
    """Return the distance from the object to the entrance pupil, mm."""
    distance = raw.object_distance * raw.unit_mm + _entrance(raw, rows, index)
    if not distance:
        raise GeometryError("whose entrance pupil is at the object")
    return distance


def _chief(raw: RawLens, rows: list[conjugates.Row], index: float) -> tuple[float, float]:
    """Return height and n·u of the chief ray of the largest field along y at the first surface."""
    pupil, fields = _entrance(raw, rows, index), [y for _, y in raw.fields]
    if raw.field_kind not in ("angle", "object_height") or not any(fields):
        raise GeometryError("whose chief ray depends on the whole lens by its fields")
    largest = max(fields, key=abs)
    if raw.field_kind == "angle":
        slope = conjugates.slope_of_angle(largest)
    else:
        slope = -largest * raw.unit_mm / _object_to_pupil(raw, rows, index)
    return -pupil * slope, index * slope
