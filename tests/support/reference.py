"""The independent witness's lenses and numbers (see tests/data/README.md for what they are)."""

import json
from collections.abc import Iterator
from functools import cache
from math import inf
from pathlib import Path

import numpy as np

from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.source import Source

DATA = Path(__file__).parents[1] / "data"


@cache
def prescriptions() -> dict:
    return json.loads((DATA / "prescriptions.json").read_text())


LENSES = tuple(prescriptions())


@cache
def reference(name: str) -> dict:
    """Return the witness's indices, first-order data, cases, sums and Huygens rows of one lens."""
    return json.loads((DATA / "reference" / f"{name}.json").read_text())


def listed_indices(name: str, wavelength_nm: float) -> list[float]:
    """Return the indices the witness used, object space first."""
    return next(n for key, n in reference(name)["indices"].items() if float(key) == wavelength_nm)


@cache
def prescription_lens(name: str, wavelength_nm: float) -> Lens:
    """Return a reference lens with exactly the indices the witness used at this wavelength, and its paraxial pupil."""
    data, index = prescriptions()[name], listed_indices(name, wavelength_nm)
    surfaces = tuple(_surface(row, n) for row, n in zip(data["surfaces"], index[1:], strict=True))
    rim = Aperture("stop_semi_diameter", data["stop_semi_diameter"])
    first = ConstantIndex(index[0])
    known = {"name": name, "wavelengths_nm": (wavelength_nm,), "object_medium": first, "aim": "paraxial"}
    return Lens(surfaces, rim, data["stop_surface"], **known)


def _surface(row: dict, index: float) -> Surface:
    radius = inf if row["radius"] is None else row["radius"]
    asphere = tuple(row["aspheric_A4_A6"])
    return Surface(radius, row["thickness"], ConstantIndex(index), row["conic"], asphere, row["semi_diameter"])


@cache
def _arrays(name: str) -> dict:
    with np.load(DATA / "reference" / f"{name}.npz") as file:
        return dict(file)


def huygens_rows(name: str) -> list[tuple[dict, np.ndarray, np.ndarray]]:
    """Return (row, PSF 32×32, displayed OPD 32×32 in waves) of every stored Huygens case; depth None is infinity."""
    arrays = _arrays(name)
    return [
        (row, arrays[f"psf_{row['array']}"], arrays[f"opd_{row['array']}"])
        for row in reference(name)["huygens"]["rows"]
    ]


def case(name: str, row: dict) -> tuple[Lens, Source]:
    """Return the lens and the source of a stored Huygens row."""
    lens = with_sensor(prescription_lens(name, row["wavelength_nm"]), row["sensor_mm"])
    depth = inf if row["depth_mm"] is None else row["depth_mm"]
    return lens, Source(depth, np.tan(np.deg2rad(row["field_deg"])), row["wavelength_nm"] / 1000)


def cases(name: str) -> Iterator[tuple[Lens, Source, float, np.ndarray]]:
    """Yield lens, source, pixel pitch in µm and stored PSF of every Huygens row of a lens."""
    for row, stored, _ in huygens_rows(name):
        yield *case(name, row), row["pixel_um"], stored
