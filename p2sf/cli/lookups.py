"""`p2sf psf FILE.npz`: a PSF out of a database, with no lens."""

from math import isinf
from pathlib import Path

from p2sf.conventions import NM_PER_UM, UM_PER_MM, degrees_from_slope, slope_from_degrees
from p2sf.database.render import database_psf
from p2sf.database_files import Stored
from p2sf.errors import RequestError
from p2sf.files.writing import plain
from p2sf.lens.source import Source
from p2sf.psf.result import Psf
from p2sf.request import Request

FROM_THE_LENS = {"object_height_mm": None, "focus_mm": None, "f_number": None, "stop": "file"}


def is_database(name: str) -> bool:
    """Return whether a command's first word names a database or stack and not a lens."""
    return Path(name).suffix.lower() in (".npz", ".zarr")


def looked_up(name: str, request: Request, pixels: int, pixel_um: float | None) -> tuple[Psf, dict, str]:
    """Return the PSF a request means in a database file, what a file says about it, and a heading.

    Raises RequestError for what only the lens could answer, DatabaseError outside what the database covers.
    """
    from p2sf.interchange import open_stored

    stored = open_stored(name)
    for option, usual in FROM_THE_LENS.items():
        if getattr(request, option) != usual:
            flag = "--" + option.replace("_", "-")
            raise RequestError(f"{flag} needs the lens, which {name} does not trace; give p2sf psf the lens itself")
    database = shifted(stored.database, request.sensor_shift_um)
    source = source_of(database, request)
    psf = database_psf(database, source, pixels, pixel_um)
    return psf, description(stored, source), _heading(stored, source)


def shifted(database, shift_um: float):
    """Return the database with its sensor moved; RequestError where the interpolant fixes the sensor."""
    if not shift_um:
        return database
    if not hasattr(database, "with_sensor"):
        raise RequestError(
            f"--sensor-shift-um needs the exact interpolant and this is {database.interpolant}; leave it away"
        )
    return database.with_sensor(database.sensor_mm + shift_um / UM_PER_MM)


def source_of(database, request: Request) -> Source:
    """Return the source a request means; the database's middle wavelength when none is asked."""
    colours = database.space.wavelengths_um
    colour = float(colours[len(colours) // 2]) if request.wavelength_nm is None else request.wavelength_nm / NM_PER_UM
    if request.image_height_mm is not None:
        slope = _slope_of_height(database, request, colour)
    else:
        slope = float(slope_from_degrees(request.field_deg or 0.0))
    return Source(float(request.depth_mm), slope, colour)


def _slope_of_height(database, request: Request, colour: float) -> float:
    """Return the field slope of an image height, in proportion to that of the widest field; RequestError."""
    widest = float(database.space.field_slopes[-1])
    height = float(database.coefficients(request.depth_mm, widest, colour).image_height)
    if height == 0:
        raise RequestError(
            f"--image-height-mm is {request.image_height_mm:g} mm, and this database lands no field off the axis; "
            "leave it away, or build one with fields"
        )
    return request.image_height_mm / height * widest


def description(stored: Stored, source: Source) -> dict:
    """Return what a PSF file says about where its numbers come from, as `export.describe` does for a lens."""
    meta = stored.meta
    setup = {
        "depth_mm": source.depth_mm,
        "field_deg": float(degrees_from_slope(source.field_slope)),
        "wavelength_nm": source.wavelength_um * NM_PER_UM,
        "sensor_mm": meta["sensor_mm"],
    }
    lens = {key: value for key, value in meta["lens"].items() if key != "toml"}
    kept = {key: meta[key] for key in ("method", "interpolant", "errors_waves")}
    return plain(
        {"lens": lens, "setup": setup, "database": kept, **{k: meta[k] for k in ("units", "conventions", "versions")}}
    )


def _heading(stored: Stored, source: Source) -> str:
    lens, field = stored.meta["lens"], degrees_from_slope(source.field_slope)
    depth = "∞" if isinf(source.depth_mm) else f"{source.depth_mm:g} mm"
    place = f"object at {depth}, field {field:.6g}°, {source.wavelength_um * NM_PER_UM:.7g} nm"
    return f"{lens['title'] or lens['name']}: {place}"
