"""How far away the parts of a picture are: depths made for any picture, a photo's own, or a map from a file. No Qt."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import RequestError
from p2sf.image.charts import CHARTS
from p2sf.io.depth_files import USUAL_SCALE, DepthScale, depths_of, own_depths, read_depths
from p2sf.io.photo_files import turned_as
from p2sf.scene.depth_gaps import Gaps, ends_and_gaps
from p2sf_explorer.compute.views.photos import change_time, frame_box

WITH_DEPTHS = "lens", "sharpened"  # of what can be shown; the others have the PSFs of one distance
FLAT, SLOPE, STEPS, OWN = "", "slope", "steps", "photo"
DEPTH_WORDS = {
    FLAT: "one distance",
    SLOPE: "sloping",
    STEPS: "three steps",
    OWN: "its own depths",
}


@dataclass(frozen=True)
class DepthChoice:
    """Where the depths of a picture come from, one of DEPTH_WORDS or a path, and what the numbers of a map mean."""

    source: str = FLAT
    scale: DepthScale = USUAL_SCALE


ONE_DISTANCE = DepthChoice()


def depth_map(choice: DepthChoice, photo: str, shape: tuple[int, int]) -> np.ndarray | None:
    """Return the depths of a picture in a frame, (rows, columns) float32 mm; None where it has one distance.

    Raises RequestError for a map that cannot be read.
    """
    if choice.source == FLAT:
        return None
    return _map(choice, photo, _changes(choice, photo), shape)


def _changes(choice: DepthChoice, photo: str) -> tuple[int, int]:
    """Return when the files were changed on which a map depends: the photo, whose frame it has, and its own."""
    return change_time(photo), change_time(choice.source)


@lru_cache(maxsize=2)
def _map(choice: DepthChoice, photo: str, _changed: tuple[int, int], shape: tuple[int, int]) -> np.ndarray:
    if choice.source in (SLOPE, STEPS):
        return _ramp(choice.source, choice.scale, shape)
    depths = own_depths(photo) if choice.source == OWN else read_depths(choice.source, choice.scale)
    if depths is None:
        raise RequestError("{path} has no depths of its own; choose a map of depths", path=photo)
    return _in_frame(depths if photo in CHARTS else turned_as(photo, depths), shape)


def occupied_depths(choice: DepthChoice, photo: str, shape: tuple[int, int]) -> tuple[float, float, Gaps] | None:
    """Return the nearest and the farthest depth of a picture, mm, and its gaps, as `ends_and_gaps` does.

    None where it has one distance. Raises RequestError for a map that cannot be read.
    """
    return None if choice.source == FLAT else _occupied(choice, photo, _changes(choice, photo), shape)


@lru_cache(maxsize=2)
def _occupied(
    choice: DepthChoice, photo: str, changed: tuple[int, int], shape: tuple[int, int]
) -> tuple[float, float, Gaps]:
    return ends_and_gaps(_map(choice, photo, changed, shape))


def has_own_depths(photo: str) -> bool:
    """Return whether a photo brings depths with it that can be used."""
    try:
        return own_depths(photo) is not None
    except RequestError:
        return False


def _ramp(name: str, scale: DepthScale, shape: tuple[int, int]) -> np.ndarray:
    """Return depths even in 1/distance, from far at the top to near at the bottom, or in three steps from the left."""
    rows, columns = shape
    part = np.linspace(0, 1, rows)[:, None] if name == SLOPE else 1 - np.arange(columns)[None] * 3 // columns / 2
    far, near = vergence(scale.far_mm), vergence(scale.near_mm)
    return np.broadcast_to(depths_of(far + part * (near - far)), shape)


def _in_frame(depths: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return the middle of a map in another size: the nearest of its pixels, since no depth lies between two."""
    top, left, tall, wide = frame_box(depths.shape[:2], shape)
    rows = (top + (np.arange(shape[0]) + 0.5) * tall / shape[0]).astype(int)
    columns = (left + (np.arange(shape[1]) + 0.5) * wide / shape[1]).astype(int)
    return depths[np.ix_(np.minimum(rows, len(depths) - 1), np.minimum(columns, depths.shape[1] - 1))]
