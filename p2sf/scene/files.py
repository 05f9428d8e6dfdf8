"""Scenes in TOML files."""

import os
from dataclasses import fields
from math import inf
from pathlib import Path
from typing import Any

from p2sf.errors import RequestError
from p2sf.files.reading import read_text, toml_table
from p2sf.files.reasons import reason
from p2sf.lens.positions import PARAMETER
from p2sf.messages import Message
from p2sf.scene.filters import filter_channels
from p2sf.scene.scene import CAMERA_PARAMETERS, LIMITS, RGB, USUAL_RTOL, Channel, Scene, limit_of
from p2sf.scene.sensor import Sensor

KEYS = {
    "": {
        "name",
        "tolerance",
        "measure",
        *LIMITS,
        *CAMERA_PARAMETERS,
        "clip",
        "brightest",
        "sensor",
        "depth",
        "filters",
        "channel",
    },
    "sensor": {each.name for each in fields(Sensor)},
    "depth": {"near_mm", "far_mm", "gaps_mm", "map", "map_meaning"},
    "filters": {"curves", "light"},
    "channel": {"name", "wavelengths_nm", "weights"},
}
WHOLE = "rows", "columns", "bits", "black_level"
COUNTING = "full_well", "read_noise", "fill_factor"


def read_scene(path: str | os.PathLike[str], usual_mm: float = inf) -> Scene:
    """Return the scene of a TOML file, ``usual_mm`` away where it states no depth; RequestError."""
    try:
        table = toml_table(read_text(path))
    except OSError as error:
        raise RequestError(
            "{path} cannot be read, {reason}; give the path of a scene file", path=str(path), reason=reason(error)
        ) from error
    except ValueError as error:
        raise RequestError(
            "{path} is not valid TOML: {reason}; correct it", path=str(path), reason=reason(error)
        ) from error
    try:
        return scene_from(table, Path(path), usual_mm)
    except RequestError as error:
        # As text, so that keys of the file do not become options of the command line.
        raise RequestError("{path}: {error}", path=str(path), error=str(error)) from error
    except (TypeError, ValueError, LookupError, AttributeError, OverflowError) as error:
        raise RequestError(
            "{path}: a value is missing or of the wrong kind ({reason}); numbers stand without quotes",
            path=str(path),
            reason=str(error),
        ) from error


def scene_from(table: dict, path: Path, usual_mm: float = inf) -> Scene:
    """Return the scene of a parsed TOML table; paths are relative to the file."""
    _check_keys(table, "")
    sensor, depth = table.get("sensor"), table.get("depth", {})
    if not isinstance(sensor, dict):
        raise RequestError("there is no table [sensor]; add it, with rows, columns and pixel_um under it")
    if not isinstance(depth, dict):
        raise RequestError(
            "depth is {given}; write a table [depth] with near_mm, far_mm or map under it", given=f"{depth!r:.40}"
        )
    _check_keys(sensor, "sensor")
    _check_keys(depth, "depth")
    missing = {"rows", "columns", "pixel_um"} - set(sensor)
    if missing:
        raise RequestError("[sensor] lacks {missing}; add it", missing=tuple(sorted(missing)))
    far = _number("far_mm", depth.get("far_mm", depth.get("near_mm", usual_mm)))
    given: dict[str, Any] = {key: table[key] for key in ("name", "aim") if key in table}
    given |= {key: _number(key, table[key]) for key in (*LIMITS, "focus_mm", "f_number", "brightest") if key in table}
    if "tolerance" in table or "measure" in table:  # as before 0.3
        given |= limit_of(table.get("measure", "relative"), _number("tolerance", table.get("tolerance", USUAL_RTOL)))
    given |= {key: _place(key, table[key]) for key in PARAMETER.values() if key in table}
    if "gaps_mm" in depth:
        given["gaps_mm"] = tuple(_numbers("gaps_mm", gap) for gap in _list("gaps_mm", depth["gaps_mm"]))
    if "clip" in table:
        given["clip"] = _flag("clip", table["clip"])
    return Scene(
        _sensor(sensor),
        channels=_channels(table, path),
        near_mm=_number("near_mm", depth.get("near_mm", far)),
        far_mm=far,
        depth_map=str(path.parent / depth["map"]) if "map" in depth else None,
        map_meaning=depth.get("map_meaning"),
        **given,
    )


def _sensor(table: dict) -> Sensor:
    given: dict[str, Any] = {key: _number(key, table[key]) for key in ("pixel_um", *COUNTING) if key in table}
    given |= {key: _whole(table, key) for key in WHOLE if key in table}
    return Sensor(**given, centre_mm=_pair(table), mosaic=table.get("mosaic"))


def _channels(table: dict, path: Path) -> tuple[Channel, ...]:
    """Return the colours: those of the file, of its filters, or red, green and blue."""
    filters = table.get("filters")
    if filters is None:
        return tuple(map(_channel, table["channel"])) if "channel" in table else RGB
    if not isinstance(filters, dict) or not isinstance(filters.get("curves"), str):
        raise RequestError('there is no {key}; write a table [filters] with curves = "FILE.csv" under it', key="curves")
    _check_keys(filters, "filters")
    if "channel" in table:
        raise RequestError("there are both [filters] and [[channel]]; keep one of them")
    return filter_channels(path.parent / filters["curves"], filters.get("light", "equal"))


def _place(key: str, value: Any) -> float | str:
    """Return a position on a ring of the lens: a number, or the name of a column."""
    return value if isinstance(value, str) else _number(key, value)


def _flag(key: str, value: Any) -> bool:
    if not isinstance(value, bool):
        raise RequestError("{key} is {given}; write true or false, without quotes", key=key, given=f"{value!r:.40}")
    return value


def _number(key: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise RequestError(
            "{key} is {given}; give a number, without quotes", key=key, given=f"{value!r:.40}"
        ) from error


def _numbers(key: str, values: Any) -> tuple[float, ...]:
    return tuple(_number(key, value) for value in _list(key, values))


def _list(key: str, values: Any) -> list:
    if not isinstance(values, list):
        raise RequestError(
            "{key} is {given}; give numbers in brackets, such as [530, 560]", key=key, given=f"{values!r:.40}"
        )
    return values


def _whole(sensor: dict, key: str) -> int:
    """Return a number of pixels; a fraction is refused, since rounding would change the sensor."""
    value = _number(key, sensor[key])
    if not value.is_integer():
        raise RequestError("sensor {key} is {value:g}; give a whole number", key=key, value=value)
    return int(value)


def _pair(sensor: dict) -> tuple[float, float]:
    values = _numbers("centre_mm", sensor.get("centre_mm", [0.0, 0.0]))
    if len(values) != 2:
        raise RequestError("centre_mm has {count} numbers; give two, x and y", count=len(values))
    return values[0], values[1]


def _channel(table: dict) -> Channel:
    _check_keys(table, "channel")
    waves = _numbers("wavelengths_nm", table["wavelengths_nm"])
    weights = _numbers("weights", table.get("weights", [1.0] * len(waves)))
    return Channel(str(table.get("name", f"{waves[0]:g} nm" if waves else "without a name")), waves, weights)


def _check_keys(table: dict, place: str) -> None:
    unknown = sorted(set(table) - KEYS[place])
    if unknown:
        raise RequestError(
            '{table} has "{key}", which means nothing here; it takes {keys}',
            table=f"[{place}]" if place else Message("the scene"),
            key=unknown[0],
            keys=tuple(sorted(KEYS[place])),
        )
