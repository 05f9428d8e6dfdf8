"""The table [pupil] of a lens file in TOML: what stands in the stop."""

from collections.abc import Iterator
from dataclasses import fields
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.disc.mask import PupilMap, PupilMask, check_map_shape
from p2sf.errors import P2SFError
from p2sf.files.atomic import DAMAGED
from p2sf.files.reading import read_array
from p2sf.files.reasons import reason
from p2sf.lensfile.source_text import digits
from p2sf.lensfile.toml.table import Constraint, Table, shorten
from p2sf.messages import Message

NUMBERS, COUNTS = (tuple(field.name for field in fields(PupilMask) if field.type is kind) for kind in (float, int))
PICTURES = ("PNG", "JPEG", "TIFF", "BMP", "GIF")
MAPS = {"phase_map": "µm", "amplitude_map": "1"}
FILES = {"phase_file": "phase_map", "amplitude_file": "amplitude_map"}
PUPIL = (*NUMBERS, *COUNTS, "zernike_um", *MAPS, *FILES, "phase_file_um")
NUMBER = Constraint(lambda x: x == x, Message("write a number"))
FINITE = Constraint(isfinite, Message("write a finite number"))


def read_mask(table: Table, elsewhere: tuple[str, ...]) -> PupilMask:
    """Return the mask of a table [pupil]; LensFileError with the line of what cannot be."""
    table.check_keys(PUPIL, elsewhere)
    values: dict[str, Any] = {key: table.number(key, NUMBER) for key in NUMBERS if key in table.values}
    values |= {key: table.count(key) for key in COUNTS if key in table.values}
    values["zernike_um"] = table.numbers("zernike_um", FINITE, ())
    values |= {key: _map(table, key) for key in MAPS if key in table.values}
    for key, name in FILES.items():
        if key not in table.values:
            continue
        if name in table.values:
            table.fail("{name} and {other} are both given; keep one of them", key, name=key, other=name)
        scale = table.number("phase_file_um", FINITE, 1.0) if name == "phase_map" else 1.0
        values[name] = _map_of_file(table, key, scale)
    try:
        return PupilMask(**values)
    except P2SFError as error:
        named = error.message.values.get("parameter", "")
        table.fail(error.message, str(named))


def _map(table: Table, key: str) -> PupilMap:
    rows = table.values[key]
    try:
        return PupilMap(np.array(rows, dtype=float))
    except P2SFError as error:
        table.fail(error.message, key)
    except (ValueError, TypeError):
        table.fail("{name} is {found}; write a square list of rows of numbers", key, name=key, found=shorten(rows))


def _map_of_file(table: Table, key: str, scale: float) -> PupilMap:
    """Return the map of a picture, black 0 and white ``scale``, or of a .npy array; the path is from the lens file."""
    name = table.string(key)
    path = Path(table.path).parent / name
    try:
        return PupilMap(scale * _array_of(path))
    except P2SFError as error:
        table.fail(error.message, key)
    except (OSError, ValueError, *DAMAGED) as error:
        table.fail(
            "{name} cannot be read ({reason}); name a picture or a .npy file", key, name=name, reason=reason(error)
        )


def _array_of(path: Path) -> np.ndarray:
    """Return the samples of a picture or of an array, from 0 to 1 in a picture; its shape is checked in its head."""
    from p2sf.files.picture_parts import open_picture

    if path.suffix.lower() == ".npy":
        found = read_array(path)
        check_map_shape(found.shape)
        return np.asarray(found, dtype=float)
    with open_picture(path, PICTURES) as picture:
        check_map_shape(picture.size)
        grey = np.asarray(picture.convert("F") if picture.mode != "I;16" else picture, dtype=float)
        full = 65535.0 if picture.mode.startswith("I") else 255.0
    return grey[::-1] / full  # the picture's top row is +η


def mask_lines(mask: PupilMask) -> Iterator[tuple[str, str, str]]:
    """Yield key, value and default of every entry of [pupil], as TOML writes them."""
    usual = PupilMask()
    for key in (*NUMBERS, *COUNTS):
        value = getattr(mask, key)
        yield key, _format_number(value), _format_number(getattr(usual, key))
    yield "zernike_um", _list(mask.zernike_um), "[]"
    for key in MAPS:
        found = getattr(mask, key)
        rows = () if found is None else found.values.tolist()
        yield key, f"[{', '.join(map(_list, rows))}]", "[]"


def _format_number(value: float) -> str:
    return repr(int(value)) if isinstance(value, int | np.integer) else digits(value)


def _list(numbers: Any) -> str:
    return f"[{', '.join(digits(x) for x in numbers)}]"
