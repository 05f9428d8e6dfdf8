"""The lens as built: what a frame tells of its sensor and spacings, put into the lens as designed (handbook 11.3)."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np

from p2sf.conventions import UM_PER_MM, slope_from_degrees
from p2sf.database.build import build_database
from p2sf.database.files.npz import save_database
from p2sf.database.space import Space
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens, with_sensor
from p2sf.lens.misalignment import with_tilted_sensor
from p2sf.lens.placement import Placement
from p2sf.lensfile.writing import write_lens
from p2sf.measure.fitting.frame_fit import FrameFit
from p2sf.measure.fitting.frame_terms import FIELD
from p2sf.messages import Message
from p2sf.spans import depth_nodes
from p2sf.tolerance.errors_of_build import build

NEAR_MM, LIGHT_UM = 500.0, (0.4, 0.7)  # of a database's depths and wavelengths, if the measurement is within
NODES = 20, 21, 31  # depths, fields and wavelengths
CERTAIN = 3.0  # standard deviations from which a number differs from 0


def lens_as_built(whole: FrameFit, tilted: bool = True) -> Lens:
    """Return the lens as designed with the errors, the stop and the sensor that the frame tells.

    ``tilted``: tilt the sensor too. Field polynomials are no part of a lens (`left_out`). Raises RequestError for a
    frame that was measured without a lens, or that its numbers do not explain.
    """
    if whole.model.lens is None:
        raise RequestError("the lens as built is the designed lens with its departures; measure relative to the lens")
    if not whole.reliable:
        raise RequestError("there is no lens as built: {why}", why=whole.warnings[0])
    lens = whole.known_stop.lens
    assert lens is not None
    told = dict(zip(whole.model.unknowns, whole.values.tolist(), strict=True))
    errors = whole.model.errors
    moved = build(lens, tuple(errors.values()), [told[name] for name in errors])
    moved = replace(moved, title=f"{lens.title or lens.name}, as built")
    moved = with_sensor(moved, lens.sensor_mm + told.get("sensor_shift_um", 0.0) / UM_PER_MM)
    # Right-handed angles: one about x takes +y along z, one about y takes +x against it.
    tilt = Placement(tilt_x_deg=told.get("tilt_y_deg", 0.0), tilt_y_deg=-told.get("tilt_x_deg", 0.0))
    return with_tilted_sensor(moved, tilt) if tilted and not tilt.idle else moved


def write_as_built(whole: FrameFit, path: str | os.PathLike[str]) -> None:
    """Write the lens as built as .toml, .zmx, .seq or .json, or its PSF database, which knows no tilt, as .npz.

    Raises P2SFError where the file cannot be written.
    """
    if Path(path).suffix.lower() == ".npz":
        lens = lens_as_built(whole, tilted=False)
        save_database(build_database(lens, _space(whole)), lens, path)
    else:
        write_lens(lens_as_built(whole), path)


def _space(whole: FrameFit) -> Space:
    """Return depths, fields and wavelengths about those of the measurement, wide enough for other pictures."""
    model, lens = whole.model, whole.model.lens
    assert lens is not None
    wave = model.optics.wavelength_um
    farthest = float(np.rad2deg(np.arctan(model.source(model.height_mm, 0.0).field_slope)))
    fields = np.linspace(0.0, max(1.0, farthest, lens.widest_field_deg), NODES[1])
    light = np.linspace(min(LIGHT_UM[0], wave), max(LIGHT_UM[1], wave), NODES[2])
    return Space(depth_nodes(min(NEAR_MM, model.depth_mm), np.inf, NODES[0]), slope_from_degrees(fields), light)


def left_out(whole: FrameFit, path: str | os.PathLike[str]) -> tuple[Message, ...]:
    """Return what the frame tells that a file of the lens as built does not hold."""
    certain = dict(zip(whole.model.unknowns, np.abs(whole.values) > CERTAIN * whole.errors, strict=True))
    fields = tuple(name for name in FIELD if certain.get(name))
    tilts = tuple(name for name in ("tilt_x_deg", "tilt_y_deg") if certain.get(name))
    out = []
    if fields:
        out.append(Message("{names}: not part of the lens as built; measure spacings instead", names=fields))
    if tilts and Path(path).suffix.lower() == ".npz":
        out.append(
            Message("{names}: a database cannot express a tilted sensor; write the lens as a .toml", names=tilts)
        )
    return tuple(out)
