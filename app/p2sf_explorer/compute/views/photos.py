"""What stands in front of the lens: built-in charts and a person's photos, fitted to the picture's frame. No Qt."""

from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from p2sf.image.charts import CHARTS, draw_chart
from p2sf.io.photo_files import Photo, photo_shape, read_photo
from p2sf.lens.lens import Lens
from p2sf.scene.scene import RGB, Channel
from p2sf_explorer.compute.setup import wavelength_range

NOISE = 0.005  # of white: what a small camera has in good light
MOST_PIXELS = 12_000_000
MOST_KEPT = 2_000_000  # pixels of a photo that is kept in memory for the next picture
CHART_SHAPE = 2000, 3000  # of a chart with every pixel
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
    return source_photo(photo, shape).values


def source_photo(photo: str, shape: tuple[int, int]) -> Photo:
    """Return a chart or photo as `scene_values` does, with what its file is; RequestError."""
    return Photo(_chart(photo, shape), "srgb", "8") if photo in CHARTS else _read(photo, shape)


def _read(path: str, shape: tuple[int, int]) -> Photo:
    return (_cached_photo if shape[0] * shape[1] <= MOST_KEPT else _fitted_photo)(path, change_time(path), shape)


def cut_away(photo: str, shape: tuple[int, int]) -> tuple[float, float]:
    """Return what share of a photo's height and of its width does not fit the frame; RequestError."""
    if photo in CHARTS:
        return 0.0, 0.0
    rows, columns = own_shape(photo)
    tall, wide = middle(rows, columns, shape)
    return 1 - tall / rows, 1 - wide / columns


def change_time(photo: str) -> int:
    """Return when a photo's file was changed, ns; 0 where there is none."""
    path = Path(photo)
    return path.stat().st_mtime_ns if path.is_file() else 0


def _chart(name: str, shape: tuple[int, int]) -> np.ndarray:
    return _kept_chart(name, shape) if shape[0] * shape[1] <= MOST_KEPT else draw_chart(name, *shape)


@lru_cache(maxsize=8)
def _kept_chart(name: str, shape: tuple[int, int]) -> np.ndarray:
    return draw_chart(name, *shape)


def full_shape(photo: str) -> tuple[int, int]:
    """Return the rows and columns of a photo, or of one reduced to `MOST_PIXELS`; RequestError."""
    rows, columns = CHART_SHAPE if photo in CHARTS else own_shape(photo)
    shrink = max(1.0, (rows * columns / MOST_PIXELS) ** 0.5)
    return max(1, int(rows / shrink)), max(1, int(columns / shrink))


def own_shape(photo: str) -> tuple[int, int]:
    """Return the rows and columns of a photo; RequestError."""
    return _shape(photo, change_time(photo))


@lru_cache(maxsize=16)
def _shape(path: str, _changed: int) -> tuple[int, int]:
    return photo_shape(path)


@lru_cache(maxsize=4)
def _cached_photo(path: str, stamp: int, shape: tuple[int, int]) -> Photo:
    return _fitted_photo(path, stamp, shape)


def _fitted_photo(path: str, _changed: int, shape: tuple[int, int]) -> Photo:
    photo = read_photo(path)
    values = photo.values
    colours = np.repeat(values, 3, axis=-1) if values.shape[-1] == 1 else values
    return replace(photo, values=crop_and_resize(colours, shape))


def middle(rows: int, columns: int, shape: tuple[int, int]) -> tuple[float, float]:
    """Return the height and width of the largest part of a picture that has a frame's proportions."""
    return min(rows, columns * shape[0] / shape[1]), min(columns, rows * shape[1] / shape[0])


def frame_box(own: tuple[int, int], shape: tuple[int, int]) -> tuple[float, float, float, float]:
    """Return top, left, height and width of `middle` in a picture of its own rows and columns."""
    tall, wide = middle(*own, shape)
    return (own[0] - tall) / 2, (own[1] - wide) / 2, tall, wide


def crop_and_resize(values: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return the middle of a picture in another size, (rows, columns, 3): its sides cut to the frame's, averaged."""
    from PIL import Image

    if values.shape[:2] == shape:
        return values
    top, left, tall, wide = frame_box(values.shape[:2], shape)
    box = left, top, left + wide, top + tall
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
