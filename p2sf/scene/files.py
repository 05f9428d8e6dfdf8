"""Scenes as TOML files that a person writes."""

import tomllib
from pathlib import Path

from p2sf.errors import RequestError
from p2sf.scene.scene import RGB, Channel, Scene
from p2sf.scene.sensor import Sensor

KEYS = {
    "": {"name", "tolerance", "measure", "focus_mm", "f_number", "sensor", "depth", "channel"},
    "sensor": {"rows", "columns", "pixel_um", "centre_mm"},
    "depth": {"near_mm", "far_mm", "map"},
    "channel": {"name", "wavelengths_nm", "weights"},
}


def read_scene(path) -> Scene:
    """Return the scene of a TOML file; RequestError names the file and what to correct."""
    try:
        table = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise RequestError(f"{path} cannot be read, {error.strerror}; give the path of a scene file") from error
    except (ValueError, RecursionError) as error:
        raise RequestError(f"{path} is no TOML: {error}; correct it") from error
    try:
        return scene_from(table, Path(path))
    except RequestError as error:
        raise RequestError(f"{path}: {error}") from error
    except (TypeError, ValueError, LookupError, AttributeError, OverflowError) as error:
        raise RequestError(
            f"{path}: a value is missing or of the wrong kind ({error}); numbers stand without quotes"
        ) from error


def scene_from(table: dict, path: Path) -> Scene:
    """Return the scene of a table as TOML gives it; paths are relative to the file."""
    _check_keys(table, "")
    sensor, depth = table.get("sensor"), table.get("depth", {})
    if not isinstance(sensor, dict):
        raise RequestError("there is no table [sensor]; add it, with rows, columns and pixel_um under it")
    if not isinstance(depth, dict):
        raise RequestError(f"depth is {depth!r:.40}; write a table [depth] with near_mm, far_mm or map under it")
    _check_keys(sensor, "sensor")
    _check_keys(depth, "depth")
    missing = {"rows", "columns", "pixel_um"} - set(sensor)
    if missing:
        raise RequestError(f"[sensor] lacks {', '.join(sorted(missing))}; add it")
    far = _number("far_mm", depth.get("far_mm", depth.get("near_mm", "inf")))
    given = {key: table[key] for key in ("name", "measure") if key in table}
    numbers = {key: _number(key, table[key]) for key in ("tolerance", "focus_mm", "f_number") if key in table}
    return Scene(
        Sensor(
            _whole(sensor, "rows"), _whole(sensor, "columns"), _number("pixel_um", sensor["pixel_um"]), _pair(sensor)
        ),
        channels=tuple(map(_channel, table["channel"])) if "channel" in table else RGB,
        near_mm=_number("near_mm", depth.get("near_mm", far)),
        far_mm=far,
        depth_map=str(path.parent / depth["map"]) if "map" in depth else None,
        **given,
        **numbers,
    )


def _number(key: str, value) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise RequestError(f"{key} is {value!r:.40}; give a number, without quotes") from error


def _numbers(key: str, values) -> tuple[float, ...]:
    if not isinstance(values, list):
        raise RequestError(f"{key} is {values!r:.40}; give numbers in brackets, such as [530, 560]")
    return tuple(_number(key, value) for value in values)


def _whole(sensor: dict, key: str) -> int:
    """Return a number of pixels; a fraction is refused, since rounded down it would be another sensor."""
    value = _number(key, sensor[key])
    if not value.is_integer():
        raise RequestError(f"sensor {key} is {value:g}; give a whole number")
    return int(value)


def _pair(sensor: dict) -> tuple[float, float]:
    values = _numbers("centre_mm", sensor.get("centre_mm", [0.0, 0.0]))
    if len(values) != 2:
        raise RequestError(f"centre_mm has {len(values)} numbers; give two, x and y")
    return values


def _channel(table: dict) -> Channel:
    _check_keys(table, "channel")
    waves = _numbers("wavelengths_nm", table["wavelengths_nm"])
    weights = _numbers("weights", table.get("weights", [1.0] * len(waves)))
    return Channel(str(table.get("name", f"{waves[0]:g} nm" if waves else "of no name")), waves, weights)


def _check_keys(table: dict, place: str) -> None:
    unknown = sorted(set(table) - KEYS[place])
    if unknown:
        where = f"[{place}]" if place else "the scene"
        raise RequestError(
            f'{where} has "{unknown[0]}", which means nothing here; it takes {", ".join(sorted(KEYS[place]))}'
        )
