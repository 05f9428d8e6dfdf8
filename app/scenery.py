"""What stands before the lens: built-in charts and a person's photos, fitted to the picture's frame. No Qt in here."""

from functools import lru_cache
from pathlib import Path

import numpy as np

from app.setting import wavelength_range
from p2sf.charts import CHARTS, draw_chart
from p2sf.lens import Lens
from p2sf.photos import read_photo
from p2sf.scene.scene import RGB, Channel

NOISE = 0.005  # of white: what a small camera has in good light
CHART_WORDS = {
    "landscape": "Landscape",
    "text": "Print",
    "point_grid": "Points",
    "siemens_star": "Siemens star",
    "slanted_edge": "Slanted edge",
    "checkerboard": "Checkerboard",
}


def scene_values(photo: str, shape: tuple[int, int]) -> np.ndarray:
    """Return a chart by name or a photo by path in linear light, (rows, columns, 3) float32; RequestError."""
    if photo in CHARTS:
        return _chart(photo, shape)
    path = Path(photo)
    return _photo(photo, path.stat().st_mtime_ns if path.is_file() else 0, shape)


@lru_cache(maxsize=8)
def _chart(name: str, shape: tuple[int, int]) -> np.ndarray:
    return draw_chart(name, *shape)


@lru_cache(maxsize=4)
def _photo(path: str, _changed: int, shape: tuple[int, int]) -> np.ndarray:
    values = read_photo(path).values
    return fitted(np.repeat(values, 3, axis=-1) if values.shape[-1] == 1 else values, shape)


def fitted(values: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return the middle of a picture in another size, (rows, columns, 3): its sides cut to the frame's, averaged."""
    from PIL import Image

    rows, columns = values.shape[:2]
    tall, wide = min(rows, columns * shape[0] / shape[1]), min(columns, rows * shape[1] / shape[0])
    box = (columns - wide) / 2, (rows - tall) / 2, (columns + wide) / 2, (rows + tall) / 2
    planes = (Image.fromarray(np.ascontiguousarray(plane)) for plane in np.moveaxis(values, -1, 0))
    size, smooth = (shape[1], shape[0]), Image.Resampling.BILINEAR
    return np.stack([np.asarray(plane.resize(size, smooth, box)) for plane in planes], axis=-1)


def channels_of(lens: Lens) -> tuple[Channel, ...]:
    """Return red, green and blue, as far as the lens's glasses have data for them."""
    low, high = wavelength_range(lens)

    def within(channel: Channel) -> Channel:
        waves = tuple(float(np.clip(w, low, high)) for w in channel.wavelengths_nm)
        return Channel(channel.name, waves, channel.weights)

    return tuple(map(within, RGB))
