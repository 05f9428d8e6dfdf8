"""Test charts and a landscape, drawn in linear light.

Every chart is float32 (rows, columns, 3), 0…1, row 0 the top, edges averaged over the pixel they cross.
"""

from collections.abc import Callable
from difflib import get_close_matches

import numpy as np

from p2sf.errors import RequestError
from p2sf.messages import Message

FINER = 4  # samples across a pixel if an edge has no simple average
EDGE_DEGREES = 5.0
DARK, BRIGHT = 0.05, 0.95
PRINTED = "P2SF  every point source has its own picture  "
SMALLEST, LARGEST = 8, 2**14


def draw_chart(name: str, rows: int, columns: int) -> np.ndarray:
    """Return the chart of this name, (rows, columns, 3); RequestError ("did you mean")."""
    if name not in CHARTS:
        close = get_close_matches(name, CHARTS, 1)
        hint = (
            Message("did you mean {name}?", name=close[0]) if close else Message("choose {names}", names=tuple(CHARTS))
        )
        raise RequestError('chart "{name}" is unknown; {hint}', name=name, hint=hint)
    if not (SMALLEST <= rows <= LARGEST and SMALLEST <= columns <= LARGEST):
        raise RequestError(
            "a chart of {columns} × {rows} pixels; give {least} to {most} each way",
            columns=columns,
            rows=rows,
            least=SMALLEST,
            most=LARGEST,
        )
    drawn = CHARTS[name](rows, columns).astype(np.float32)
    return np.repeat(drawn[..., None], 3, axis=-1) if drawn.ndim == 2 else drawn


def point_grid(rows: int, columns: int, across: int = 9) -> np.ndarray:
    """Return single bright pixels on black, about ``across`` of them along the width, one in the centre."""
    step = max(2, columns // across)
    picture = np.zeros((rows, columns))
    picture[rows // 2 % step :: step, columns // 2 % step :: step] = 1.0
    return picture


def slanted_edge(rows: int, columns: int, degrees: float = EDGE_DEGREES) -> np.ndarray:
    """Return an edge through the centre, dark on the left, tilted from the vertical (ISO 12233)."""
    x, y = _axes(rows, columns, 1)
    angle = np.deg2rad(degrees)
    distance = x * np.cos(angle) + y * np.sin(angle)
    return DARK + (BRIGHT - DARK) * _edge_coverage(distance, angle)


def _edge_coverage(distance: np.ndarray, angle: float) -> np.ndarray:
    """Return the share of a unit pixel beyond a straight edge: a box of cos wide convolved with one of sin."""
    wide, narrow = max(np.cos(angle), 1e-12), max(abs(np.sin(angle)), 1e-12)

    def ramp(t: np.ndarray) -> np.ndarray:
        half_square: np.ndarray = np.square(np.maximum(t, 0)) / 2
        return half_square

    half, less = (wide + narrow) / 2, (wide - narrow) / 2
    corners = ramp(distance + half) - ramp(distance + less) - ramp(distance - less) + ramp(distance - half)
    coverage: np.ndarray = corners / (wide * narrow)
    return coverage


def siemens_star(rows: int, columns: int, spokes: int = 36) -> np.ndarray:
    """Return a star of ``spokes`` bright binary spokes, grey where they are finer than pixels resolve."""
    x, y = _axes(rows, columns, FINER)
    bright = np.cos(np.arctan2(y, x) * spokes) > 0
    inside = np.hypot(x, y) < 0.47 * min(rows, columns)
    return _block_means(np.where(inside, np.where(bright, BRIGHT, DARK), 0.5), FINER)


def checkerboard(rows: int, columns: int, across: int = 16) -> np.ndarray:
    """Return squares, ``across`` of them along the width."""
    step = max(1, columns // across)
    odd = (np.arange(rows)[:, None] // step + np.arange(columns) // step) % 2
    return np.where(odd == 1, BRIGHT, DARK)


def text(rows: int, columns: int) -> np.ndarray:
    """Return dark lines of print on white, larger towards the top."""
    from PIL import Image, ImageDraw, ImageFont

    page = Image.new("L", (columns, rows), 255)
    pen, top, size = ImageDraw.Draw(page), 0, max(8, rows // 10)
    while top < rows:
        font = ImageFont.load_default(size)
        line = PRINTED * (1 + 3 * columns // (size * len(PRINTED)))
        pen.text((size // 3, top), line, fill=0, font=font)
        top, size = top + int(1.25 * size), max(7, int(size * 0.86))
    return DARK + (BRIGHT - DARK) * np.asarray(page) / 255.0


def landscape(rows: int, columns: int) -> np.ndarray:
    """Return hills behind a lake under an evening sky, drawn from noise with the statistics of natural pictures."""
    random = np.random.default_rng(7)
    horizon = int(0.62 * rows)
    picture = _sky(horizon, columns, random)
    for number in range(4):
        _hill(picture, number, random)
    lake = picture[::-1][: rows - horizon]
    lake = np.concatenate([lake, np.repeat(lake[-1:], max(0, rows - horizon - len(lake)), axis=0)])
    ripple = 1 + 0.25 * _noise((rows - horizon, columns), random, (1.0, 6.0))
    whole = np.concatenate([picture, 0.7 * lake * ripple[..., None] * np.array([0.8, 0.95, 1.1])])
    return np.clip(whole * (1 + 0.03 * random.standard_normal((rows, columns, 1))), 0, 1)


def _sky(rows: int, columns: int, random: np.random.Generator) -> np.ndarray:
    height = np.linspace(1, 0, rows)[:, None, None]
    blue, gold = np.array([0.12, 0.25, 0.55]), np.array([0.9, 0.55, 0.25])
    sky = height * blue + (1 - height) * gold
    cloud = np.clip(_noise((rows, columns), random, (3.0, 1.0)), 0, 2)[..., None] * 0.12
    y, x = np.mgrid[:rows, :columns]
    sun = np.hypot(x - 0.7 * columns, y - 0.35 * rows) < 0.03 * columns
    return np.where(sun[..., None], np.array([1.0, 0.95, 0.8]), sky + cloud)


def _hill(picture: np.ndarray, number: int, random: np.random.Generator) -> None:
    """Paint one range of hills over the picture, nearer ones lower, darker and rougher."""
    rows, columns, _ = picture.shape
    ridge = rows * (0.5 + 0.12 * number) + 0.1 * rows * _noise((1, columns), random, (1.0, 1.0))[0]
    below = np.arange(rows)[:, None] > ridge
    rough = 1 + 0.35 * _noise((rows, columns), random, (1.0, 1.0), 0.6)
    colour = np.array([0.25, 0.3, 0.4]) * 0.65**number + np.array([0.0, 0.02, -0.01]) * number
    picture[below] = np.clip((rough[..., None] * colour)[below], 0.002, 1)


def _noise(
    shape: tuple[int, int], random: np.random.Generator, stretch: tuple[float, float], falloff: float = 1.2
) -> np.ndarray:
    """Return noise of unit variance whose amplitude falls with frequency, as natural pictures' does (Field 1987)."""
    fy = np.fft.fftfreq(shape[0])[:, None] * stretch[1] if shape[0] > 1 else np.zeros((1, 1))
    fx = np.fft.rfftfreq(shape[1]) * stretch[0]
    size = np.hypot(fx, fy)
    weight = np.where(size > 0, 1 / np.maximum(size, 1e-9) ** falloff, 0)
    noise = np.fft.irfft2(np.fft.rfft2(random.standard_normal(shape)) * weight, s=shape)
    scaled: np.ndarray = noise / max(noise.std(), 1e-12)
    return scaled


def _axes(rows: int, columns: int, finer: int) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y (up) from the centre in pixels, ``finer`` samples a pixel."""
    y, x = (((np.arange(n * finer) + 0.5) / finer - 0.5 - n // 2) for n in (rows, columns))
    return x[None], -y[:, None]


def _block_means(fine: np.ndarray, times: int) -> np.ndarray:
    rows, columns = (n // times for n in fine.shape)
    blocks: np.ndarray = fine.reshape(rows, times, columns, times).mean((1, 3))
    return blocks


CHARTS: dict[str, Callable[[int, int], np.ndarray]] = {
    "point_grid": point_grid,
    "siemens_star": siemens_star,
    "slanted_edge": slanted_edge,
    "checkerboard": checkerboard,
    "text": text,
    "landscape": landscape,
}
