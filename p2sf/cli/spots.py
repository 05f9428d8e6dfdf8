"""`p2sf spot`: where exact rays meet the sensor."""

import json
from math import inf
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from cyclopts import Parameter

from p2sf.cli.cautions import crossed_surfaces, open_lens
from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName, Output, check_output
from p2sf.cli.screen import FILLED, heading, print_json, print_table, warn
from p2sf.figures.perfect import airy_radius_um
from p2sf.figures.spot import DRAWN_RINGS
from p2sf.figures.spot import spot as spot_of
from p2sf.files.writing import plain, write_beside, write_json
from p2sf.io.record import csv_head, describe
from p2sf.parameters import check_whole
from p2sf.raytrace.field_geometry import cone
from p2sf.setting import Setup, set_up

MOST_RINGS = 200  # 120 601 rays

Clip = Annotated[bool, Parameter(negative="", help="Stop rays at every clear semi-diameter.")]
Rings = Annotated[int, Parameter(help="Rings of rays to draw; the figures do not depend on them.")]


def spot(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    rings: Rings = DRAWN_RINGS,
    clip: Clip = False,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Trace exact rays and show the spot they make on the sensor; write it as .csv, .json or .png."""
    check_whole("rings", rings, 1, MOST_RINGS)
    check_output(output, WRITERS, lens)
    setup = set_up(open_lens(lens), request)
    points, figures = trace_spot(setup, rings, clip)
    if output:
        WRITERS[output.suffix.lower()](points, {**describe(setup), "spot": figures}, output)
    if as_json:
        about = {"file": None if output is None else str(output), "aim": setup.lens.aim}
        return print_json({**about, **figures, "points_um": points.tolist()})
    warn(setup.stop.warning)
    if not clip:
        warn(crossed_surfaces(setup))
    rows = [(name, figures[key], unit) for key, name, unit in ROWS]
    rows.append(("rays fill", FILLED[setup.lens.aim], ""))
    return print_table(heading(setup), ("spot", "value", "unit"), rows)


ROWS = (
    ("rms_um", "RMS radius about the centroid", "µm"),
    ("largest_um", "farthest ray from the centroid", "µm"),
    ("centroid_x_um", "centroid from the chief ray, along x", "µm"),
    ("centroid_y_um", "centroid from the chief ray, along y", "µm"),
    ("airy_radius_um", "Airy radius 0.61 λ/NA, for comparison", "µm"),
    ("rays", "rays traced", ""),
    ("lost", "rays that never arrive", ""),
)


def trace_spot(setup: Setup, rings: int, clip: bool) -> tuple[np.ndarray, dict[str, Any]]:
    """Return the arriving rays' (x, y) in µm from the chief ray, shape (rays, 2), and the spot's figures."""
    found = spot_of(setup.lens, setup.source, rings, clip)
    all_points = np.stack([found.x_um, found.y_um], axis=-1)
    points = all_points[np.isfinite(all_points).all(axis=-1)]
    na = cone(setup.lens, setup.source, setup.stop).na
    return points, {
        "rms_um": float(found.rms_um),
        "largest_um": float(found.farthest_um),
        "centroid_x_um": float(found.centroid_x_um),
        "centroid_y_um": float(found.centroid_y_um),
        "airy_radius_um": float(airy_radius_um(setup.source.wavelength_um, na)) if na else inf,
        "rays": len(all_points),
        "lost": len(all_points) - len(points),
    }


def _write_csv(points: np.ndarray, record: dict[str, Any], output: Path) -> None:
    lines = ["x_um,y_um", *(f"{x!r},{y!r}" for x, y in points.tolist())]
    text = csv_head(record) + "\n".join(lines) + "\n"
    write_beside(output, lambda handle: handle.write(text.encode()))


def _write_json(points: np.ndarray, record: dict[str, Any], output: Path) -> None:
    write_json(output, {**record, "points_um": points})


def _write_png(points: np.ndarray, record: dict[str, Any], output: Path) -> None:
    from p2sf.io.psf_plot import draw_spot

    figures, setup = record["spot"], record["setup"]
    title = f"{record['lens']['title']}\nfield {setup['field_deg']:g}°, RMS radius {figures['rms_um']:.3g} µm"
    about = {"Description": json.dumps(plain(record))}
    write_beside(output, lambda handle: draw_spot(handle, points, figures["airy_radius_um"], title, about))


WRITERS = {".csv": _write_csv, ".json": _write_json, ".png": _write_png}
