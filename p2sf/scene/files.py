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
    if not isinstance(sensor, dict) or not isinstance(depth, dict):
        raise RequestError("there is no table [sensor], or [depth] is none; add rows, columns and pixel_um under it")
    _check_keys(sensor, "sensor")
    _check_keys(depth, "depth")
    missing = {"rows", "columns", "pixel_um"} - set(sensor)
    if missing:
        raise RequestError(f"[sensor] lacks {', '.join(sorted(missing))}; add it")
    far = float(depth.get("far_mm", depth.get("near_mm", "inf")))
    given = {key: table[key] for key in ("name", "measure") if key in table}
    numbers = {key: float(table[key]) for key in ("tolerance", "focus_mm", "f_number") if key in table}
    return Scene(
        Sensor(_whole(sensor, "rows"), _whole(sensor, "columns"), float(sensor["pixel_um"]), _pair(sensor)),
        channels=tuple(map(_channel, table["channel"])) if "channel" in table else RGB,
        near_mm=float(depth.get("near_mm", far)),
        far_mm=far,
        depth_map=str(path.parent / depth["map"]) if "map" in depth else None,
        **given,
        **numbers,
    )


def _whole(sensor: dict, key: str) -> int:
    """Return a number of pixels; a fraction is refused, since rounded down it would be another sensor."""
    if sensor[key] != int(sensor[key]):
        raise RequestError(f"sensor {key} is {sensor[key]:g}; give a whole number")
    return int(sensor[key])


def _pair(sensor: dict) -> tuple[float, float]:
    x, y = sensor.get("centre_mm", (0.0, 0.0))
    return float(x), float(y)


def _channel(table: dict) -> Channel:
    _check_keys(table, "channel")
    waves = tuple(map(float, table["wavelengths_nm"]))
    weights = tuple(map(float, table.get("weights", [1.0] * len(waves))))
    return Channel(str(table.get("name", f"{waves[0]:g} nm")), waves, weights)


def _check_keys(table: dict, place: str) -> None:
    unknown = sorted(set(table) - KEYS[place])
    if unknown:
        where = f"[{place}]" if place else "the scene"
        raise RequestError(
            f'{where} has "{unknown[0]}", which means nothing here; it takes {", ".join(sorted(KEYS[place]))}'
        )
