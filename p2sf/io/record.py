"""The facts that a file carries beside its numbers: lens, setup, units, versions, and those of a PSF."""

import json
from collections.abc import Mapping
from dataclasses import fields
from functools import lru_cache
from typing import Any

from p2sf.conventions import NM_PER_UM, depth_of
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.figures.psf_data import PsfData
from p2sf.figures.record import true_of_all
from p2sf.files.writing import plain
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import Stop, f_number
from p2sf.raytrace.focusing import focused_vergence
from p2sf.setting import Setup

MAPS = ("phase_map", "amplitude_map")
RECORD = "p2sf-record"
"""The name of the text in a formed picture that says what it is of."""


def describe(setup: Setup) -> dict:
    """Return the facts that a file carries beside its numbers: lens and hash, setup, units, versions."""
    lens, source = setup.prescription, setup.source
    known: dict = plain(
        {
            "lens": {
                "name": lens.name,
                "title": lens.title,
                "source": lens.source,
                "sha256_of_toml": lens_hash(lens),
            },
            "setup": {
                "depth_mm": source.depth_mm,
                "field_deg": setup.field_deg,
                **({"azimuth_deg": source.azimuth_deg} if source.azimuth_deg else {}),
                "wavelength_nm": source.wavelength_um * NM_PER_UM,
                **setting(setup.lens, setup.stop),
                "stop_surface": setup.stop.surface,
                "stop_semi_diameter_mm": setup.stop.semi_diameter,
                "stop_chosen_by": setup.stop.chosen_by,
            },
            **true_of_all(),
        }
    )
    return known


def describe_many(setup: Setup) -> dict:
    """Return the facts of `describe` that hold for every depth, field and wavelength of a set; its axes have those."""
    known = describe(setup)
    own = ("depth_mm", "field_deg", "azimuth_deg", "wavelength_nm")
    return {**known, "setup": {name: value for name, value in known["setup"].items() if name not in own}}


def csv_head(meta: Mapping[str, Any]) -> str:
    """Return the line of a .csv, before its names, that holds its facts; readers skip lines that begin with #."""
    return f"# meta: {json.dumps(plain(meta), ensure_ascii=False)}\n"


def setting(lens: Lens, stop: Stop) -> dict:
    """Return how a lens is set: sensor, object distance in focus (negative beyond infinity), f-number, rings, mask."""
    return {
        "sensor_mm": lens.sensor_mm,
        "focus_mm": depth_of(focused_vergence(lens)),
        "f_number": f_number(lens, lens.reference_wavelength_um, stop),
        "aim": lens.aim,
        **({"absorption": True} if lens.absorption else {}),
        **({"position": str(lens.positions.words)} if lens.positions else {}),
        **mask_numbers(lens.mask),
    }


def mask_numbers(mask: PupilMask) -> dict:
    """Return what a mask is other than a clear stop, a map by its size; nothing of one that is clear."""
    if mask.clear:
        return {}
    stated = {each.name: getattr(mask, each.name) for each in fields(mask)}
    other = {name: value for name, value in stated.items() if value != getattr(CLEAR, name)}
    return {"mask": {name: repr(value) if name in MAPS else value for name, value in other.items()}}


@lru_cache(maxsize=64)
def lens_hash(lens: Lens) -> str:
    """Return the SHA-256 of the lens written as TOML: two equal prescriptions have one hash."""
    from hashlib import sha256

    from p2sf.lensfile.toml.lens import lens_to_toml

    return sha256(lens_to_toml(lens).encode()).hexdigest()


def common(records: list[dict]) -> dict:
    """Return what all records state alike."""
    first, *others = records
    found = {}
    for name, value in first.items():
        same = [other.get(name) for other in others]
        if isinstance(value, dict):
            found[name] = common([value, *(each or {} for each in same)])
        elif all(each == value for each in same):
            found[name] = value
    return found


def with_facts(psf: PsfData, meta: Mapping[str, Any]) -> dict:
    """Return what the file of a PSF states: `Psf.record`, and ``meta`` beside it or in its place."""
    record = psf.record
    return {**record, **plain(meta), "psf": record["psf"]}


def caption(meta: dict) -> str:
    """Return one or two lines on what a picture shows."""
    setup, psf = meta.get("setup", {}), meta["psf"]
    depth = "∞" if setup.get("depth_mm") is None else f"{setup['depth_mm']:g} mm"
    where = f"object at {depth}, field {setup['field_deg']:g}°, " if setup else ""
    lens = meta.get("lens", {})
    name = lens.get("title") or lens.get("name") or "point spread function"
    peak = "" if psf["strehl"] is None else f" · Strehl {psf['strehl']:.3g}"
    name += f", {setup['position']}" if setup.get("position") else ""
    return f"{name}\n{where}{psf['wavelength_um'] * NM_PER_UM:g} nm · {psf['method']}{peak}"
