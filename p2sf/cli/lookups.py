"""`p2sf psf FILE.npz`: a PSF looked up in a database, without the lens."""

from dataclasses import dataclass, replace
from math import inf, isinf
from pathlib import Path
from typing import TYPE_CHECKING

from p2sf.cli.screen import Row, field_text
from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.database.accuracy import DatabaseAccuracy
from p2sf.database.exact import ExactDatabase
from p2sf.database.files.provenance import Stored
from p2sf.database.render import pixels_psf
from p2sf.errors import RequestError
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.prediction import TOO_FAR, USELESS
from p2sf.psf.result import Psf
from p2sf.setting import Request, explicit_values

if TYPE_CHECKING:
    from p2sf.database.fitted import FittedDatabase
    from p2sf.database.grid import GridDatabase

    Database = ExactDatabase | GridDatabase | FittedDatabase

LOOKED_UP = ("depth_mm", "field_deg", "field_x_deg", "image_height_mm", "wavelength_nm", "sensor_shift_um")
"""What a database itself can answer; any other parameter needs the lens."""


def is_database(name: str) -> bool:
    """Return whether a command's first word names a database or stack and not a lens."""
    return Path(name).suffix.lower() in (".npz", ".zarr")


@dataclass(frozen=True)
class LookedUp:
    """A PSF from a database, a heading, what rays fill, and what is predicted of the whole database."""

    psf: Psf
    aim: str
    title: str
    accuracy: DatabaseAccuracy


def looked_up(name: str, request: Request, pixels: int, pixel_um: float | None) -> LookedUp:
    """Return the PSF a request means in a database file.

    Raises RequestError for what only the lens could answer, DatabaseError outside what the database covers.
    """
    from p2sf.export.psf_cube import open_database

    stored = open_database(name)
    for parameter in explicit_values(request):
        if parameter not in LOOKED_UP:
            raise RequestError(
                "{parameter} needs the lens, which {path} does not trace; give p2sf psf the lens itself",
                parameter=parameter,
                path=name,
            )
    moved = with_sensor_shift(stored, request.sensor_shift_um)
    if request.depth_mm is None:
        request = replace(request, depth_mm=stored.object_distance_mm)
    source = source_of(moved.database, request)
    psf = pixels_psf(moved.database, source, pixels, pixel_um).with_figures(provenance=moved.describe(source))
    return LookedUp(psf, stored.meta["aim"], _heading(stored, source), stored.accuracy)


def accuracy_rows(known: DatabaseAccuracy, of: str = "") -> list[Row]:
    """Return the predicted 1 − R² of the PSFs against exact rays, its median and the worst, and where that is.

    Neither is a number where the estimate tells no more than that PSFs are not alike.
    """
    median: tuple[float | None, Message | str] = (known.median, "")
    worst: tuple[float | None, Message] = (known.worst, known.where)
    if known.median >= USELESS:
        median = (None, TOO_FAR)
    if known.worst >= USELESS:
        worst = (None, Message("{why}, {where}", why=TOO_FAR, where=known.where))
    return [(f"predicted 1 − R²{of}, median", *median), (f"predicted 1 − R²{of}, worst", *worst)]


def with_sensor_shift(stored: Stored, shift_um: float) -> Stored:
    """Return the database with its sensor moved; RequestError where the interpolant fixes the sensor."""
    database = stored.database
    if not shift_um:
        return stored
    if not isinstance(database, ExactDatabase):
        raise RequestError(
            "{parameter} needs a seidel database of the exact interpolant, and this one is {kind}; leave it out",
            parameter="sensor_shift_um",
            kind="fitted" if database.interpolant == "exact" else database.interpolant,
        )
    moved = database.with_sensor(database.sensor_mm + shift_um / UM_PER_MM)
    meta = {name: value for name, value in stored.meta.items() if name != "focus_mm"}  # which moves with the sensor
    return Stored(moved, meta | {"sensor_mm": moved.sensor_mm})


def source_of(database: "Database", request: Request) -> Source:
    """Return the source that a request with a depth means; the database's middle wavelength when none is asked."""
    depth = inf if request.depth_mm is None else request.depth_mm
    colours = database.space.wavelengths_um
    colour = float(colours[len(colours) // 2]) if request.wavelength_nm is None else request.wavelength_nm / NM_PER_UM
    if request.image_height_mm is not None:
        return Source(depth, _slope_of_height(database, depth, request.image_height_mm, colour), colour)
    angles = request.field_x_deg or 0.0, request.field_deg or 0.0
    return Source(depth, wavelength_um=colour, field_deg=angles)


def _slope_of_height(database: "Database", depth_mm: float, height_mm: float, colour: float) -> float:
    """Return the field slope of an image height, in proportion to that of the widest field; RequestError."""
    widest = float(database.space.field_slopes[-1])
    height = float(database.coefficients(depth_mm, widest, colour).image_height)
    if height == 0:
        raise RequestError(
            "{parameter} is {value:g} mm, but in this database no field lands off the axis; "
            "leave it out, or build one with fields",
            parameter="image_height_mm",
            value=height_mm,
        )
    return height_mm / height * widest


def _heading(stored: Stored, source: Source) -> str:
    lens = stored.meta["lens"]
    depth = "∞" if isinf(source.depth_mm) else f"{source.depth_mm:g} mm"
    place = f"object at {depth}, field {field_text(source)}, {source.wavelength_um * NM_PER_UM:.7g} nm"
    turned = f", {stored.meta['position']}" if stored.meta.get("position") else ""
    return f"{lens['title'] or lens['name']}{turned}: {place}"
