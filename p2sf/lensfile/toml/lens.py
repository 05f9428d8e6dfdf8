"""Lens files in TOML, meant to be written by hand.

title = "Biconvex singlet"       # also: name, character (one line), source, comment
unit = "mm"                      # of every length below; cm, m, in as well
stop_surface = 1                 # from 1; left out, the narrowest rim is the stop
fields_deg = [0, 5]              # chief-ray angle at the entrance pupil along y; also fields_x_deg, left out: 0
wavelengths_nm = [486.1327, 587.5618, 656.2725]
wavelength_weights = [1, 2, 1]   # of their light; left out: all the same
reference_nm = 587.5618          # where pupil and f-number hold; left out: the middle one
aim = "stop"                     # rays fill the real stop; or "paraxial", the paraxial entrance pupil
object_medium = "air"
sensor_radius = -40.0            # of a curved sensor, also sensor_conic; left out: a plane
object_distance = 95.0           # where the object stands before the first vertex, inf allowed; left out: in focus
absorption = true                # rays lose what the media of catalogues absorb; left out: false

[aperture]                       # exactly one: stop_semi_diameter, entrance_pupil_diameter, f_number
f_number = 8

[pupil]                          # what stands in the stop; left out: nothing. All keys may be left out
obscuration = 0.3                # dark disc, radius over the rim's; also obscuration_x, obscuration_y: its middle
vanes = 4                        # also vane_width (over the rim's diameter), vane_angle_deg (from +y towards +x)
blades = 6                       # also roundness (0 straight, 1 a circle), blade_angle_deg
apodisation = 0.8                # 1/e of the amplitude at this radius over the rim's; apodisation_power 2, 4, …
zernike_um = [0, 0, 0, 0.1]      # path added, µm RMS, by Noll's terms; also cubic_um
phase_file = "plate.png"         # black 0, white phase_file_um; or phase_map, rows in µm from −y up
amplitude_file = "filter.npy"    # pictures from 0 to 1; or amplitude_map

[[surface]]                      # in the order light meets them
radius = 50.0                    # > 0: centre of curvature to the right; inf is a plane
thickness = 4.0                  # to the next surface, the last one to the sensor; < 0 where light runs back
glass = "SCHOTT N-BK7"           # or 1.5168, or { nd = 1.5168, vd = 64.17 }, or "mirror"; left out: air
semi_diameter = 10.0             # clear rim; left out: unlimited
rim = { decentre = [0, 5.0] }    # the clear rim is elsewhere, or also half_widths = [4, 3], turn_deg: a rectangle
inner_radius = 2.0               # rays within are lost: a hole, a shadow; left out: 0
conic = -1.0
aspheric = [1e-6, 0.0]           # A4, A6, … in unit⁻³, unit⁻⁵, …
shape = { type = "Qcon", normalisation_radius = 10.0, coefficients = [1e-3] }  # added to it, see `shape_types`
ideal_focal_length = 100.0       # an ideal lens in this plane, which needs no radius; left out: a real surface
diffraction = { order = 1, normalisation_radius = 10.0, coefficients = [-300.0] }  # radians, of ρ², ρ⁴, …
irregularity = { fringes = 0.5, fringes_45 = 0, normalisation_radius = 10.0 }  # a cylinder, 273 nm a fringe
transmission = { vertex = 0.96, per_area = -1e-3 }  # of energy at height h: vertex + per_area·h², in unit⁻²
before = [{ decentre = [0, 0.1, 0], tilt_deg = [0.5, 0, 0] }]  # how its axes stand in those before it: moved, then
after = [{ tilt_deg = [-0.5, 0, 0], tilt_first = true }]       # turned about x, y, z; tilt_first: z, y, x, then moved

[[misaligned]]                   # a piece that is moved and nothing else; also tilt_first, and on the top of the
surfaces = [2, 3]                # file sensor_before for the sensor
decentre = [0.05, 0]             # x, y, z
tilt_deg = [0, 0.2, 0]           # about x, y, z, right-handed
pivot = [0, 0, 10]               # about this point, from the first one's vertex

A lens that zooms, or focuses inside, has a table of columns, and entries with a value for each (`columns`).
"""

import os
import re
import tomllib
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import Any, cast

from p2sf.conventions import FARTHEST_MM, NM_PER_UM
from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError, LensFileError
from p2sf.files.reading import toml_table
from p2sf.files.reasons import reason
from p2sf.lens.lens import (
    D_NM,
    USUAL_AIM,
    Aim,
    Aperture,
    ApertureKind,
    Lens,
    Surface,
    with_absorption,
    with_aim,
    with_mask,
)
from p2sf.lens.positions import KEPT, Axis, without_positions
from p2sf.lens.properties import TOML
from p2sf.lensfile.source_text import digits, read_text, write_text
from p2sf.lensfile.toml.columns import KINDS as RINGS
from p2sf.lensfile.toml.columns import axis_text, columns_of, join_columns, read_columns
from p2sf.lensfile.toml.mask import mask_lines, read_mask
from p2sf.lensfile.toml.placement import apply_misalignments, placements_text, read_placements
from p2sf.lensfile.toml.surface import FINITE, OPENING, RADIUS, medium_text, read_surface, surface_lines
from p2sf.lensfile.toml.table import Constraint, Table, find_line, list_text, shorten, text_of
from p2sf.messages import Message
from p2sf.paraxial.positions import matches_columns


@dataclass(frozen=True)
class _Line:
    """One assignment, as text; empty when the value is the default."""

    key: str
    value: str
    default: str = ""

    def __str__(self) -> str:
        return "" if self.value == self.default else f"{self.key} = {self.value}\n"


def lens_to_toml(lens: Lens) -> str:
    """Return the lens as TOML; reading it gives an equal lens, of a zoom its first column.

    A lens that is not what its columns say for its position is written as it is, without them. LensFileError for a
    medium or a shape that no file can hold, and for columns with different stops or kinds of aperture.
    """
    from p2sf.lensfile.surface_endings import check_endings

    check_endings(lens, TOML)
    lens = lens if matches_columns(lens) else without_positions(lens)
    columns, axes = columns_of(lens), lens.positions.axes if lens.positions else ()
    same = {name: getattr(lens, name) for name in KEPT}
    head = _join_lines(axes, [_head(replace(column, **same)) for column in columns])
    rings = "".join(axis_text(axis, text_of, list_text) for axis in axes)
    opening = join_columns(axes, lens.aperture.kind, [digits(column.aperture.value) for column in columns])
    aperture = f"\n[aperture]\n{lens.aperture.kind} = {opening}\n"
    surfaces = [_surface_text(lens, columns, number) for number in range(1, len(lens.surfaces) + 1)]
    pupil = "".join(str(_Line(*line)) for line in mask_lines(lens.mask))
    return head + rings + aperture + (f"\n[pupil]\n{pupil}" if pupil else "") + "".join(surfaces)


def _head(lens: Lens) -> tuple[_Line, ...]:
    stop = "" if lens.stop_surface is None else str(lens.stop_surface)
    return (
        _Line("title", text_of(lens.title), '""'),
        _Line("name", text_of(lens.name)),
        _Line("character", text_of(lens.character), '""'),
        _Line("source", text_of(lens.source), '""'),
        _Line("comment", text_of(lens.comment), '""'),
        _Line("unit", '"mm"'),
        _Line("stop_surface", stop),
        _Line("fields_deg", list_text(lens.fields_deg)),
        _Line("fields_x_deg", list_text(lens.fields_x_deg), "[]"),
        _Line("wavelengths_nm", list_text(lens.wavelengths_nm)),
        _Line("wavelength_weights", list_text(lens.wavelength_weights), "[]"),
        _Line("reference_nm", "" if lens.reference_nm is None else digits(lens.reference_nm)),
        _Line("aim", text_of(lens.aim), text_of(USUAL_AIM)),
        _Line("object_medium", medium_text(lens.object_medium), '"air"'),
        _Line("sensor_before", placements_text(lens.sensor_before), "[]"),
        _Line("sensor_radius", digits(lens.sensor_radius), "inf"),
        _Line("sensor_conic", digits(lens.sensor_conic), "0.0"),
        _Line("object_distance", "" if lens.object_distance is None else digits(lens.object_distance)),
        _Line("absorption", str(lens.absorption).lower(), "false"),
    )


def _join_lines(axes: tuple[Axis, ...], columns: list[tuple[_Line, ...]]) -> str:
    """Return the text of lines that every column has, each with its value, or with one for each column."""
    rows = zip(*columns, strict=True)
    return "".join(
        str(replace(row[0], value=join_columns(axes, row[0].key, [line.value for line in row]))) for row in rows
    )


def _surface_text(lens: Lens, columns: tuple[Lens, ...], number: int) -> str:
    note = " the stop" if number == lens.stop_surface else " the sensor follows" if number == len(lens.surfaces) else ""
    axes = lens.positions.axes if lens.positions else ()
    return f"\n[[surface]]  # {number}{note}\n" + _join_lines(axes, [_lines(c.surfaces[number - 1]) for c in columns])


def _lines(surface: Surface) -> tuple[_Line, ...]:
    return tuple(_Line(*line) for line in surface_lines(surface))


MM = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "inch": 25.4}
TEXTS = ("title", "name", "character", "source", "comment")
TOP = (
    *(*TEXTS, "unit", "stop_surface", "fields_deg", "fields_x_deg", "wavelengths_nm", "wavelength_weights"),
    *("reference_nm", "aim", "object_medium", "absorption", "sensor_radius", "sensor_conic", "object_distance"),
    *("aperture", "pupil", "surface"),
)
TILTED = ("sensor_before", "misaligned")
APERTURES = ("stop_semi_diameter", "entrance_pupil_diameter", "f_number")

FIELD = Constraint(lambda x: abs(x) < 90, Message("write an angle in degrees below 90"))
WAVELENGTH = Constraint(lambda x: 50 <= x <= 50_000, Message("write a wavelength in nanometres, 50 to 50000"))

DISTANCE = Constraint(lambda x: 0 < x <= FARTHEST_MM or x == inf, Message("write a positive number up to 1e16, or inf"))
WEIGHT = Constraint(lambda x: 0 <= x < inf, Message("write a weight that is not negative"))


def read_toml(path: str | os.PathLike) -> Lens:
    """Return the lens of a TOML file, lengths converted to mm; LensFileError says line, value and remedy."""
    return parse_toml(read_text(path), path)


def write_toml(lens: Lens, path: str | os.PathLike) -> None:
    """Write a lens as TOML, whole or not at all; LensFileError where that is impossible."""
    write_text(lens_to_toml(lens), path)


def parse_toml(text: str, path: str | os.PathLike = "lens.toml") -> Lens:
    """Return the lens of a TOML text; LensFileError.

    ``path`` stands in errors, and its stem is the name of a lens that has none.
    """
    top = Table(str(path), text, _values(text, str(path)))
    top.check_keys((*TOP, *TILTED, *RINGS))
    return read_columns(top, _plain)


def _plain(top: Table) -> Lens:
    """Return the lens of a file's values, or of one of its columns."""
    scale = _scale(top)
    surfaces = tuple(read_surface(table, scale, TOP) for table in _surface_tables(top))
    texts = {key: top.string(key) for key in TEXTS}
    texts["name"] = texts["name"] or Path(top.path).stem.encode("utf-8", "replace").decode("utf-8")
    lens = _with_curved_sensor(top, with_mask(_lens(top, surfaces, _aperture(top, scale), texts), _mask(top)), scale)
    lens = with_absorption(lens, top.flag("absorption"))
    if "object_distance" in top.values:
        lens = replace(lens, object_distance=scale * top.number("object_distance", DISTANCE))
    lens = _with_placements(top, lens, scale)
    _check_wavelengths(top, lens)
    return lens


def _values(text: str, path: str) -> dict[str, Any]:
    try:
        return toml_table(text)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r" \(at line (\d+), column \d+\)", str(error))
        line = int(found[1]) if found else len(text.rstrip().splitlines()) or 1  # it ends too early
        problem = re.sub(r" \(at .*\)$", "", str(error)).rstrip(".")
        raise LensFileError(
            "this is not TOML ({reason}); {remedy}", path, line, reason=problem, remedy=_remedy(text, line)
        ) from None
    except ValueError as error:
        raise LensFileError("{reason}; this is not a lens file", path, reason=reason(error)) from None


def _remedy(text: str, line: int) -> Message:
    """Return what to do about a line that is not TOML; a number with a decimal comma is the likeliest reason."""
    wrong = "".join(text.split("\n")[line - 1 : line])
    found = re.search(r"=\s*([-+]?\d+),(\d+(?:[eE][-+]?\d+)?)", wrong)
    if not found:
        return Message("correct the line")
    return Message(
        'write {number} with a decimal point, not "{found}"',
        number=f"{found[1]}.{found[2]}",
        found=f"{found[1]},{found[2]}",
    )


def _scale(top: Table) -> float:
    unit = top.string("unit", "mm")
    if unit not in MM:
        top.fail('unit is "{unit}"; write one of {units}', "unit", unit=unit, units=tuple(MM))
    return MM[unit]


def _surface_tables(top: Table) -> list[Table]:
    rows = top.values.get("surface", [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        line = find_line(top.text, "", None, "surface") or find_line(top.text, "surface", 1, "")
        raise LensFileError("surface is not a list of tables; head every surface with [[surface]]", top.path, line)
    if not rows:
        top.fail("the lens has no surfaces; write a [[surface]] for each")
    return [Table(top.path, top.text, row, "surface", number) for number, row in enumerate(rows, 1)]


def _aperture(top: Table, scale: float) -> Aperture:
    values = top.values.get("aperture")
    if not isinstance(values, dict):
        top.fail(
            "aperture is {found}; write [aperture] and one of {names}",
            "aperture",
            found=shorten(values),
            names=APERTURES,
        )
    table = Table(top.path, top.text, values, "aperture")
    table.check_keys(APERTURES, TOP)
    if len(values) != 1:
        table.fail("[aperture] states {count} of {names}; keep exactly one", count=len(values), names=APERTURES)
    kind: ApertureKind = next(iter(values))
    return Aperture(kind, table.number(kind, OPENING) * (1.0 if kind == "f_number" else scale))


def _mask(top: Table) -> PupilMask:
    values = top.values.get("pupil", {})
    if not isinstance(values, dict):
        top.fail("pupil is {found}; write [pupil] and what stands in the stop", "pupil", found=shorten(values))
    return read_mask(Table(top.path, top.text, values, "pupil"), TOP)


def _lens(top: Table, surfaces: tuple[Surface, ...], aperture: Aperture, texts: dict[str, Any]) -> Lens:
    stop = top.count("stop_surface")
    if stop is not None and not 1 <= stop <= len(surfaces):
        top.fail(
            "stop_surface is {number}; write a surface from 1 to {count}",
            "stop_surface",
            number=stop,
            count=len(surfaces),
        )
    fields, across = top.numbers("fields_deg", FIELD, (0.0,)), top.numbers("fields_x_deg", FIELD, ())
    waves = top.numbers("wavelengths_nm", WAVELENGTH, (D_NM,))
    weights, reference = top.numbers("wavelength_weights", WEIGHT, ()), top.number("reference_nm", WAVELENGTH, 0.0)
    for key, values in (("fields_deg", fields), ("wavelengths_nm", waves)):
        if not values:
            top.fail("{name} is an empty list; write at least one number", key, name=key)
    medium = top.medium("object_medium")
    try:
        lens = Lens(surfaces, aperture, stop, **texts, fields_deg=fields, wavelengths_nm=waves, object_medium=medium)
        lens = replace(lens, fields_x_deg=across, wavelength_weights=weights, reference_nm=reference or None)
        return with_aim(lens, cast("Aim", top.string("aim", USUAL_AIM)))
    except GeometryError as error:
        raise LensFileError(error.message, top.path) from None


def _with_curved_sensor(top: Table, lens: Lens, scale: float) -> Lens:
    radius, conic = top.number("sensor_radius", RADIUS, inf), top.number("sensor_conic", FINITE, 0.0)
    return replace(lens, sensor_radius=scale * radius, sensor_conic=conic)


def _with_placements(top: Table, lens: Lens, scale: float) -> Lens:
    """Return the lens with its sensor and its pieces placed as the file says."""
    sensor = read_placements(top, "sensor_before", scale)
    try:
        return apply_misalignments(top, replace(lens, sensor_before=sensor) if sensor else lens, scale)
    except GeometryError as error:
        top.fail(error.message, "sensor_before")


def _check_wavelengths(top: Table, lens: Lens) -> None:
    """Raise LensFileError for a wavelength of the file at which one of its glasses has no data."""
    for medium in lens.media:
        low, high = (NM_PER_UM * edge for edge in medium.range_um or (0.0, inf))
        for wave in lens.wavelengths_nm:
            if not low <= wave <= high:
                top.fail(
                    "wavelength {wavelength:g} nm is outside the data of {glass}, {low:g} to {high:g} nm; "
                    "take it out or change the glass",
                    "wavelengths_nm",
                    wavelength=wave,
                    glass=medium.label,
                    low=low,
                    high=high,
                )
