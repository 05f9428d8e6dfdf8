"""`p2sf database build` and `p2sf database info`: every PSF of a lens as a file."""

import sys
from dataclasses import dataclass
from math import inf
from pathlib import Path
from time import perf_counter
from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import App, Parameter

from p2sf.cli.cautions import open_lens
from p2sf.cli.lookups import accuracy_rows
from p2sf.cli.options import AS_IN_ITS_FILE, CameraFlags, Json, LensName, Threads
from p2sf.cli.screen import FILLED, Row, print_json, print_table, text, warn
from p2sf.conventions import NM_PER_UM, degrees_from_slope, slope_from_degrees
from p2sf.database.accuracy import DatabaseAccuracy, accuracy, build_by, check_kind
from p2sf.database.files.npz import load_database, save_database
from p2sf.database.files.place import is_stack, place_of, size_bytes
from p2sf.database.files.provenance import axis_names, provenance
from p2sf.database.render import Database, Sampling
from p2sf.database.space import Space
from p2sf.errors import RequestError
from p2sf.files.writing import check_ending, check_place, plain
from p2sf.lens.lens import Lens
from p2sf.messages import Message, ParameterName
from p2sf.parameters import check_samples
from p2sf.psf.methods import by_six
from p2sf.raytrace.focusing import object_distance
from p2sf.setting import Request, set_up, usual_depths
from p2sf.spans import check_ascending, depths, numbers
from p2sf.threads import using_threads

NEAR_MM, DEPTHS = 500.0, 20  # of the depths, where none are asked for
RECTANGLE_NODES = 9  # along either side, where none are asked for

app = App(name="database", help="Every PSF of a lens as a file: build one, look into one.")


@dataclass(frozen=True)
class Nodes:
    """Which points the database covers: numbers and ranges LOW:HIGH:COUNT, separated by commas.

    Attributes
    ----------
    depths_mm
        Object distances from the first vertex, mm; uniform in 1/depth, HIGH may be inf. 500:inf:20 when not given, or
        20 within ten per cent of the distance of a near object that the lens is made for.
    fields_deg
        Chief-ray angles at the entrance pupil, degrees; uniform in angle.
    fields_x_deg
        Angles along x as well, for the fitted method and a lens with tilts or decentres; the others are then those
        along y. Of such a lens the largest square within its field when neither is given.
    wavelengths_nm
        Wavelengths, nm.
    """

    depths_mm: str | None = None
    fields_deg: str | None = None
    fields_x_deg: str | None = None
    wavelengths_nm: str = "400:700:31"


@dataclass(frozen=True)
class DatabaseKind:
    """Which numbers are kept, and as what kind of file.

    Attributes
    ----------
    method
        Method whose numbers are kept; auto takes the six coefficients (seidel) where they keep R² ≥ 0.99 everywhere,
        and fits to exact rays (fitted) elsewhere.
    interpolant
        How values between the nodes are found: exact polynomials, the paper's table 1, or straight lines.
    stack
        Write the rendered PSFs too, as a Zarr v3 folder or to a URL, such as s3://bucket/name.zarr; a stack that was
        stopped continues where it was.
    pixels
        Samples along each side of a stack's PSFs.
    pixel_um
        Their distance, µm; what the finest PSF needs when not given.
    scheduler
        Address of a dask.distributed scheduler that renders the stack (p2sf cluster); this machine's threads when not
        given.
    """

    method: Literal["auto", "seidel", "fitted"] = "auto"
    interpolant: Literal["exact", "table1", "linear"] = "exact"
    stack: bool = False
    pixels: int = 64
    pixel_um: float | None = None
    scheduler: str | None = None

    def __post_init__(self) -> None:
        check_samples(self.pixels, self.pixel_um, least=2)
        check_kind(self.method, self.interpolant, False)


@app.command
def build(
    lens: LensName,
    /,
    *,
    output: Annotated[
        str, Parameter(["--output", "-o"], negative="", help="File to write: .npz, a stack .zarr, which may be a URL.")
    ],
    nodes: Annotated[Nodes, Parameter(name="*")] = Nodes(),
    camera: CameraFlags = AS_IN_ITS_FILE,
    kind: Annotated[DatabaseKind, Parameter(name="*")] = DatabaseKind(),
    threads: Threads = None,
    as_json: Json = False,
) -> None:
    """Build the PSF database of a lens and write it, with its error, measured.

    The stop auto is the narrowest rim for an object at infinity.
    """
    _check_output(output, kind.stack)
    found = open_lens(lens)
    setup = set_up(found, Request(depth_mm=inf, **vars(camera)))
    check_kind(kind.method, kind.interpolant, bool(nodes.fields_x_deg))
    start = perf_counter()
    database = build_by(setup.lens, space_of(nodes, found, kind.method), kind.method, kind.interpolant, setup.stop)
    seconds = perf_counter() - start
    known = accuracy(database, setup.lens)
    if kind.stack:
        with using_threads(threads):
            _write_stack(database, setup.lens, output, kind)
    else:
        save_database(database, setup.lens, output, setup.stop)
    size = size_bytes(place_of(output)) if kind.stack else Path(output).stat().st_size
    about = {
        "file": output,
        "aim": setup.lens.aim,
        "bytes": size,
        "nodes": database.space.shape,
        "build_seconds": seconds,
    }
    if as_json:
        stated = {"method": database.method, "predicted_error": plain(known.record), "errors_waves": database.errors}
        return print_json({**about, **stated})
    warn(known.caution)
    rows: list[Row] = [("method", database.method, ""), _nodes_row(provenance(database, setup.lens, setup.stop))]
    rows += [("coefficients built in", 1e3 * seconds, "ms"), ("file", output, ""), ("size", size / 1e3, "kB")]
    return print_table(
        f"{found.title or found.name}: PSF database",
        ("", "value", "unit"),
        rows + accuracy_rows(known) + error_rows(database.errors),
    )


def space_of(nodes: Nodes, lens: Lens, method: str) -> Space:
    """Return the space of the nodes asked for, without fields 21 up to the lens's widest; RequestError.

    One of a misaligned lens has fields along x as well, but for the six coefficients.
    """
    low, high = usual_depths(object_distance(lens), NEAR_MM)
    text = nodes.depths_mm or f"{low!r}:{high!r}:{DEPTHS}"
    distances = depths(text, "depths_mm")
    check_ascending(distances, text, "depths_mm")
    widest = max(1.0, lens.widest_field_deg)
    usual, usual_x = f"0:{widest!r}:21", nodes.fields_x_deg
    if usual_x or (lens.misaligned and not by_six(method) and nodes.fields_deg is None):
        half = float(degrees_from_slope(slope_from_degrees(widest) / np.sqrt(2)))
        usual = f"{-half!r}:{half!r}:{RECTANGLE_NODES}"
        usual_x = usual_x or usual
    fields = _angles(nodes.fields_deg or usual, "fields_deg", -90.0 if usual_x else 0.0)
    fields_x = slope_from_degrees(_angles(usual_x, "fields_x_deg", -90.0)) if usual_x else None
    colours = numbers(nodes.wavelengths_nm, "wavelengths_nm")
    check_ascending(colours, nodes.wavelengths_nm, "wavelengths_nm")
    if not colours[0] > 0:
        raise RequestError(
            "{parameter} is {value}; give wavelengths above 0", parameter="wavelengths_nm", value=nodes.wavelengths_nm
        )
    return Space(distances, slope_from_degrees(fields), colours / NM_PER_UM, fields_x)


def _angles(text: str, name: str, least: float) -> np.ndarray:
    """Return field angles, degrees, from 0 or −90 (itself excluded) to below 90; RequestError."""
    angles = numbers(text, name)
    check_ascending(angles, text, name)
    if least == 0 and not (0 <= angles[0] and angles[-1] < 90):
        raise RequestError("{parameter} is {value}; give angles from 0 to below 90 degrees", parameter=name, value=text)
    if not (-90 < angles[0] and angles[-1] < 90):
        raise RequestError("{parameter} is {value}; give angles between −90 and 90 degrees", parameter=name, value=text)
    return angles


def _check_output(output: str, stack: bool) -> None:
    if stack:
        return check_ending("output", output, ".zarr", Message("a stack is a .zarr folder"))
    either = Message("a database is a .npz file, a {stack} a .zarr", stack=ParameterName("stack"))
    check_ending("output", output, ".npz", either)
    return check_place(output)


def _write_stack(database: Database, lens: Lens, output: str, kind: DatabaseKind) -> None:
    """Fill a stack, with a line of progress on a terminal."""
    from p2sf.database.files.stack_work import StackProgress, StackStatus
    from p2sf.database.files.stack_write import write_stack

    def tell(now: StackStatus) -> None:
        line = f"{now.done} of {now.total} chunks, {now.psfs_per_second:.0f} PSFs/s, {now.seconds_left:.0f} s left"
        print(f"\r{line:60}", end="", file=sys.stderr, flush=True)

    watch = StackProgress(progress=tell) if sys.stderr.isatty() else StackProgress()
    write_stack(database, lens, output, Sampling(kind.pixels, kind.pixel_um), watch, kind.scheduler)
    if sys.stderr.isatty():
        print(file=sys.stderr)


@app.command
def info(file: str, /, *, as_json: Json = False) -> None:
    """Show what a database or a stack holds, where it comes from, and how exact it is."""
    held: dict[str, Any] = {}
    if is_stack(file):
        from p2sf.database.files.stack import open_stack

        stack = open_stack(file)
        stored = stack.stored
        held = {"psfs": stack.psf.shape, "pixel_um": stack.pixel_um, "complete": stack.complete}
    else:
        stored = load_database(file)
    meta = stored.meta
    known = stored.accuracy
    if as_json:
        stated = {key: value for key, value in meta.items() if key != "numbers"}
        return print_json({**stated, "predicted_error": plain(known.record), **held})
    warn(known.caution)
    return print_table(
        f"{file}: {meta['lens']['title'] or meta['lens']['name']}",
        ("", "value", "unit"),
        about_rows(meta, held, known),
    )


def about_rows(meta: dict[str, Any], held: dict[str, Any], known: DatabaseAccuracy) -> list[Row]:
    """Return the rows that tell a person what a database holds."""
    covers = {
        key: f"{text(low)} to {'∞' if high is None else text(high)}" for key, (low, high) in meta["covers"].items()
    }
    rows: list[Row] = [
        ("lens", meta["lens"]["name"], ""),
        ("method", meta["method"], ""),
        ("interpolant", meta["interpolant"], ""),
        _nodes_row(meta),
        *((name.rpartition("_")[0].replace("_", " "), covers[name], name.rpartition("_")[2]) for name in covers),
        *(("position", place, "") for place in [meta.get("position")] if place),
        ("exact rays fill", FILLED[meta["aim"]], ""),
        ("sensor from the last vertex", meta["sensor_mm"], "mm"),
        ("glasses", ", ".join(glass["glass"] for glass in meta["glasses"]), ""),
        ("made with p2sf", meta["versions"]["p2sf"], ""),
    ]
    if held:
        rows += [("PSFs", " × ".join(map(str, held["psfs"])), ""), ("pixel", held["pixel_um"], "µm")]
        rows += [("complete", "yes" if held["complete"] else "no, build it again to continue", "")]
    return rows + accuracy_rows(known) + error_rows(meta["errors_waves"])


def _nodes_row(meta: dict[str, Any]) -> Row:
    return f"nodes, {axis_names(meta)}", " × ".join(map(str, meta["nodes"])), ""


def error_rows(errors: dict[str, float]) -> list[Row]:
    """Return one row per coefficient: the largest error against direct evaluation."""
    return [(f"largest error of {kind.capitalize()} looked up", value, "waves") for kind, value in errors.items()]
