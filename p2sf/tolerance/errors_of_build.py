"""Manufacturing errors of a lens: tolerances, their usual amounts, and the perturbed lens."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite, isinf
from typing import Literal

from p2sf.errors import GeometryError
from p2sf.glass.media import AIR, ShiftedIndex
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import Lens, Surface
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import needed_radii, pupils, with_fixed_stop

Kind = Literal[
    "decentre_x", "decentre_y", "tilt_x", "tilt_y", "radius", "thickness", "index", "irregularity", "irregularity_45"
]
UNITS: dict[Kind, str] = {
    "decentre_x": "mm",
    "decentre_y": "mm",
    "tilt_x": "°",
    "tilt_y": "°",
    "radius": "%",
    "thickness": "mm",
    "index": "",
    "irregularity": "fringes",
    "irregularity_45": "fringes",
}
IRREGULAR: tuple[Kind, ...] = ("irregularity", "irregularity_45")
MOVES: tuple[Kind, ...] = ("decentre_x", "decentre_y", "tilt_x", "tilt_y")
Grade = Literal["commercial", "precision", "high"]
# ± amounts in the units above, typical of what manufacturers offer under these names.
GRADES: dict[Grade, dict[Kind, float]] = {
    "commercial": {
        "decentre_x": 0.1,
        "tilt_x": 0.05,
        "radius": 0.5,
        "thickness": 0.15,
        "index": 1e-3,
        "irregularity": 1.0,
    },
    "precision": {
        "decentre_x": 0.03,
        "tilt_x": 0.017,
        "radius": 0.1,
        "thickness": 0.05,
        "index": 5e-4,
        "irregularity": 0.5,
    },
    "high": {
        "decentre_x": 0.01,
        "tilt_x": 0.005,
        "radius": 0.03,
        "thickness": 0.01,
        "index": 2e-4,
        "irregularity": 0.2,
    },
}


@dataclass(frozen=True)
class Tolerance:
    """Tolerance ±``amount`` of one number of a lens, in the unit of its kind (`UNITS`).

    ``first``, ``last``: the surfaces, from 1, that are decentred or tilted as one piece about the first vertex; for the
    other kinds only ``first`` counts: the surface whose radius, thickness or index behind it, or irregularity
    (`Irregularity` over its clear radius) has the error.

    Raises GeometryError for impossible surfaces or amounts.
    """

    kind: Kind
    first: int
    amount: float
    last: int = 0

    def __post_init__(self) -> None:
        if self.kind not in UNITS:
            raise GeometryError(
                'tolerance "{kind}" is unknown; choose one of {kinds}', kind=self.kind, kinds=tuple(UNITS)
            )
        if not (isfinite(self.amount) and self.amount >= 0):
            raise GeometryError(
                "the tolerance of {kind} at surface {surface} is {amount}; give a finite number, 0 or more",
                kind=self.kind,
                surface=self.first,
                amount=self.amount,
            )

    @property
    def piece(self) -> tuple[int, int]:
        """Return the first and the last surface."""
        return self.first, max(self.first, self.last)


def usual_tolerances(lens: Lens, grade: Grade = "precision") -> tuple[Tolerance, ...]:
    """Return the tolerances of a grade for every surface, thickness and glass."""
    amounts, found = GRADES[grade], []
    for number, surface in enumerate(lens.surfaces, 1):
        if affects_light(lens, number) and not surface.ideal:
            found += [Tolerance(kind, number, amounts["decentre_x"]) for kind in ("decentre_x", "decentre_y")]
            found += [Tolerance(kind, number, amounts["tilt_x"]) for kind in ("tilt_x", "tilt_y")]
            found += [Tolerance(kind, number, amounts["irregularity"]) for kind in IRREGULAR]
        if not isinf(surface.radius):
            found.append(Tolerance("radius", number, amounts["radius"]))
        if number < len(lens.surfaces):
            found.append(Tolerance("thickness", number, amounts["thickness"]))
        if not surface.reflects and surface.medium != AIR:
            found.append(Tolerance("index", number, amounts["index"]))
    return tuple(found)


def affects_light(lens: Lens, number: int) -> bool:
    """Return whether a surface, from 1, has any effect on light."""
    surface = lens.surfaces[number - 1]
    return not surface.bare or surface.medium != lens.media[number - 1]


def build(lens: Lens, tolerances: Sequence[Tolerance], errors: Sequence[float]) -> Lens:
    """Return the lens with these errors, one per tolerance in its unit; index errors are the same at all wavelengths.

    Errors of one piece form one coordinate break, and later pieces are moved in addition to earlier ones. The surface
    behind the last one is the sensor, which can be moved alone. The radius of the stop is that of ``lens``.
    """
    count = len(lens.surfaces)
    surfaces, moves = list(lens.surfaces), dict[tuple[int, int], dict[Kind, float]]()
    for tolerance, error in zip(tolerances, errors, strict=True):
        sensor = tolerance.piece == (count + 1, count + 1) and tolerance.kind in MOVES
        if not (1 <= tolerance.first <= tolerance.piece[1] <= count or sensor):
            raise GeometryError(
                "surfaces {first} to {last} do not exist; the lens has surfaces 1 to {count}",
                first=tolerance.piece[0],
                last=tolerance.piece[1],
                count=count,
            )
        if not error:
            continue
        if tolerance.kind in MOVES:
            piece = moves.setdefault(tolerance.piece, {})
            piece[tolerance.kind] = piece.get(tolerance.kind, 0.0) + error
        else:
            place = tolerance.first - 1
            surfaces[place] = _alter(lens, surfaces[place], tolerance, error)
    built = replace(with_fixed_stop(lens), surfaces=tuple(surfaces))
    for (first, last), numbers in moves.items():
        if first > count:
            built = replace(built, sensor_before=(*lens.sensor_before, placement_of(numbers)))
        else:
            built = displaced(built, first, last, placement_of(numbers))
    return built


def source_of_build(designed: Lens, built: Lens, source: Source) -> Source:
    """Return the source at its position in front of ``designed``, by its slope at the entrance pupil of ``built``.

    An object at a finite depth is a fixed point: errors move the entrance pupil, to which its field angle refers, but
    not the object. Nearly telecentric lenses, whose pupil moves by metres, would otherwise image another object.
    """
    if isinf(source.depth_mm) or not source.field_slope:
        return source
    planes = (float(pupils(lens, source.wavelength_um).entrance_from_first) for lens in (designed, built))
    before, after = (source.depth_mm + plane for plane in planes)
    # An object in a pupil, or a pupil at infinity, has no field slope; the trace raises the error.
    if before == after or not after:
        return source
    return replace(source, field_slope=source.field_slope * before / after)


def _alter(lens: Lens, surface: Surface, tolerance: Tolerance, error: float) -> Surface:
    """Return surface ``tolerance.first`` with an error other than a displacement, added to its earlier errors."""
    if tolerance.kind == "radius":
        return replace(surface, radius=surface.radius * (1 + error / 100))
    if tolerance.kind == "thickness":
        return replace(surface, thickness=surface.thickness + error)
    if tolerance.kind in IRREGULAR:
        upright, turned = (error if tolerance.kind == kind else 0.0 for kind in IRREGULAR)
        radius = clear_radius(lens, tolerance.first)
        before = surface.irregularity or Irregularity(0.0, 0.0, radius)
        return replace(surface, irregularity=before.added(upright, turned, radius))
    if surface.reflects:
        raise GeometryError("surface {surface} is a mirror, which has no refractive index", surface=tolerance.first)
    return replace(surface, medium=ShiftedIndex(surface.medium, error))


def clear_radius(lens: Lens, number: int) -> float:
    """Return the clear radius of a surface, from 1, or, without one, that required by the widest field, mm."""
    stated = lens.surfaces[number - 1].semi_diameter
    return stated if isfinite(stated) else float(needed_radii(lens)[number - 1])


def placement_of(errors: Mapping[Kind, float]) -> Placement:
    """Return the coordinate break of a piece with these decentres and tilts."""
    x, y, a, b = (errors.get(kind, 0.0) for kind in MOVES)
    return Placement(decentre_x=x, decentre_y=y, tilt_x_deg=a, tilt_y_deg=b)
