"""Readers of maps of depth: whole numbers between two stated distances, mm or m, and what HEIF photos bring with them.

Everywhere else a map of depths is float32 in mm from the first vertex, inf allowed.
"""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from p2sf.arguments import check_fields, first_place
from p2sf.conventions import FARTHEST_MM, depth_of, vergence
from p2sf.errors import RequestError
from p2sf.messages import Alternatives
from p2sf.parameters import check_reach

MM_PER_M = 1000.0
UNITS = {"mm": 1.0, "m": MM_PER_M}
MEANINGS = ("near_white", "near_black", *UNITS)
# Kinds of depths in HEIF (ISO/IEC 23008-2, depth_representation_type).
INVERSE_DEPTH, DISPARITY, DEPTH = 0, 1, 2


@dataclass(frozen=True)
class DepthScale:
    """What the numbers of a map mean, one of MEANINGS: ``near_mm`` at white and ``far_mm`` at black, or vice versa.

    Between the two they are even in 1/distance, as disparity is. In mm or m, 0 stands for infinity.
    """

    meaning: str = "near_white"
    near_mm: float = 1000.0
    far_mm: float = 10000.0

    def __post_init__(self) -> None:
        check_fields(self)
        if self.meaning not in MEANINGS:
            raise RequestError(
                'a map of depths means "{meaning}"; choose {choices}',
                meaning=self.meaning,
                choices=Alternatives(MEANINGS),
            )
        for name in ("near_mm", "far_mm"):
            check_reach(name, getattr(self, name))
        if not 0 < self.near_mm <= self.far_mm:
            raise RequestError(
                "the map reaches from {near:g} mm to {far:g} mm; give positive depths, the near one first",
                near=self.near_mm,
                far=self.far_mm,
            )


USUAL_SCALE = DepthScale()


def read_depths(path: str | os.PathLike[str], scale: DepthScale) -> np.ndarray:
    """Return the depths of a PNG, TIFF or OpenEXR of one channel, (rows, columns) float32 mm.

    Whole numbers of 8 or 16 bits span ``scale``, floats 0 to 1 do; in mm or m they are taken as they are, where inf
    and more than FARTHEST_MM, as renderers write of the sky, are infinity. Raises RequestError for colours, numbers
    that are NaN, negative or beyond 1, and a map without any depth.
    """
    from p2sf.io.photo_files import read_samples

    return _scaled(read_samples(Path(path)), scale, path)


def read_scene_depths(
    path: str | os.PathLike[str], near_mm: float, far_mm: float, meaning: str | None = None
) -> np.ndarray:
    """Return the depths of a scene's map as `read_depths` does, or those that a HEIF photo brings with it.

    ``meaning``: as in `DepthScale`; by default floats are mm and whole numbers reach from far, black, to near, white.
    """
    from p2sf.io.photo_files import read_samples

    own = own_depths(path)
    if own is not None:
        return own
    raw = read_samples(Path(path))
    usual = "mm" if raw.dtype.kind == "f" else USUAL_SCALE.meaning
    return _scaled(raw, DepthScale(usual if meaning is None else meaning, near_mm, far_mm), path)


def _scaled(raw: np.ndarray, scale: DepthScale, path: str | os.PathLike[str]) -> np.ndarray:
    """Return the depths that samples of a file stand for, see `read_depths`."""
    from p2sf.io.photo_files import by_rows

    if raw.ndim == 3 and raw.shape[2] in (3, 4) and (raw[..., :1] == raw[..., :3]).all():
        raw = raw[..., 0]  # grey, saved in colours
    raw = raw[..., 0] if raw.ndim == 3 and raw.shape[2] in (1, 2) else raw
    if raw.ndim != 2 or not raw.size:
        raise RequestError(
            "{path} has the shape ({shape}); a map of depths has one grey channel", path=str(path), shape=raw.shape
        )
    _check_depths(raw, path)
    if scale.meaning in UNITS:
        return _in_mm(raw.astype(np.float32), np.float32(UNITS[scale.meaning]), path)
    full = np.float32(np.iinfo(raw.dtype).max if raw.dtype.kind == "u" else 1)
    most = float(raw.max() / full)
    if most > 1:
        raise RequestError(
            "{path} holds numbers up to {most:g}, between near and far they reach from 0 to 1; choose mm or m",
            path=str(path),
            most=most,
        )
    slope, start = (1, 0) if scale.meaning == "near_white" else (-1, 1)
    return by_rows(
        lambda rows: _between(start + slope * (rows.astype(np.float32) / full), scale.near_mm, scale.far_mm), raw
    )


def _check_depths(raw: np.ndarray, path: str | os.PathLike[str]) -> None:
    """Raise RequestError where numbers of a map are negative or NaN."""
    if raw.dtype.kind == "u":
        return
    wrong = ~(raw >= 0)
    if wrong.any():
        raise RequestError(
            "{path} holds depths that are negative or no numbers, {count} of them, the first {value:g} at row {row}, "
            "column {column} (from 0); correct them",
            path=str(path),
            value=float(raw[wrong][0]),
            **first_place(wrong),
        )


def _in_mm(depths: np.ndarray, unit_mm: np.float32, path: str | os.PathLike[str]) -> np.ndarray:
    """Return depths in mm, infinity in place of 0 and of more than FARTHEST_MM; RequestError where all of it is 0."""
    if not depths.any():
        raise RequestError("{path} holds no depth: all of it is 0; choose another map", path=str(path))
    found: np.ndarray = depths * unit_mm
    found[(found == 0) | (found > FARTHEST_MM)] = np.inf
    return found


def _between(nearness: np.ndarray, near_mm: float, far_mm: float) -> np.ndarray:
    """Return depths from numbers that are 1 at the near one and 0 at the far one, and even in 1/distance."""
    far, near = float(vergence(far_mm)), float(vergence(near_mm))
    return depths_of(far + nearness * (near - far))


def depths_of(vergences: np.ndarray) -> np.ndarray:
    """Return depths, float32 mm, from vergences, 1/mm; inf for 0."""
    beyond = vergences * FARTHEST_MM < 1
    found: np.ndarray = np.where(beyond, np.inf, 1 / np.where(beyond, 1.0, vergences)).astype(np.float32)
    return found


def own_depths(path: str | os.PathLike[str]) -> np.ndarray | None:
    """Return the depths that a HEIF photo brings with it, (rows, columns) float32 mm; None where it has none.

    Turned upright where the file says how. Needs pillow-heif. Raises RequestError where it does not say how far away
    its numbers are.
    """
    from p2sf.io.photo_files import HEIF, heif_depth_image

    if Path(path).suffix.lower() not in HEIF:
        return None
    found = heif_depth_image(path)
    return heif_depths(*found, path) if found else None


def heif_depths(raw: np.ndarray, stated: dict[str, Any], path: str | os.PathLike[str]) -> np.ndarray:
    """Return depths in mm from the samples of a HEIF depth image and what the file states of them, in 1/m and m.

    Disparity is taken as 1/distance in 1/m, as telephones store it. Raises RequestError without its limits.
    """
    kind = stated.get("representation_type")
    nearness = raw.reshape(raw.shape[:2]).astype(np.float32) / np.iinfo(raw.dtype).max
    low, high = (stated.get(name) for name in (("d_min", "d_max") if kind == DISPARITY else ("z_near", "z_far")))
    if kind not in (INVERSE_DEPTH, DISPARITY, DEPTH) or low is None or high is None or not 0 <= low < high:
        raise RequestError(
            "{path} does not state how far away its depths are; save them as a PNG and give near and far",
            path=str(path),
        )
    if kind == DEPTH:
        return _in_mm(low + nearness * np.float32(high - low), np.float32(MM_PER_M), path)
    near, far = (low, high) if kind == INVERSE_DEPTH else (1 / high, depth_of(low))
    return _between(nearness, MM_PER_M * near, MM_PER_M * float(far))
