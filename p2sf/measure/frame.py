"""A frame: counts of an exposure on square pixels, what is known of its noise, and where its pixels lie."""

from dataclasses import dataclass, field
from functools import cached_property
from math import inf

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import RequestError
from p2sf.messages import Message
from p2sf.parameters import check_positive

FEWEST_FLAT = 3  # pixels side by side of one value that make a flat top
AROUND = 3  # pixels about four equal ones by which a computed point is told
NEAR_TOP = 0.02  # of the peak's height: the pixels just below a top
MAD = 1.4826  # median absolute deviation to standard deviation of a normal distribution


@dataclass(frozen=True)
class FrameGeometry:
    """Rows and columns of square pixels of ``pixel_um``; row 0 is the top, x runs along columns, y up.

    ``axis``: row and column of the optical axis, by default the middle.
    """

    rows: int
    columns: int
    pixel_um: float
    axis: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        check_positive("pixel_um", self.pixel_um)

    @property
    def _middle(self) -> tuple[float, float]:
        return self.axis or ((self.rows - 1) / 2, (self.columns - 1) / 2)

    def pixel_at(self, x_mm: float, y_mm: float) -> tuple[int, int]:
        """Return the row and column of the pixel at a place, which may lie off the frame."""
        row, column = self._middle
        pitch = self.pixel_um / UM_PER_MM
        return round(row - y_mm / pitch), round(column + x_mm / pitch)

    def place_of(self, row: float, column: float) -> tuple[float, float]:
        """Return x and y in mm from the axis."""
        middle, pitch = self._middle, self.pixel_um / UM_PER_MM
        return (column - middle[1]) * pitch, (middle[0] - row) * pitch


@dataclass(frozen=True)
class Noise:
    """What is known of a sensor's noise: ``gain`` in electrons per count, inf where shot noise does not matter.

    ``read_noise``: standard deviation of a dark pixel in counts; ``full_scale``: counts from which one is saturated.
    Raises RequestError for numbers that are not positive.
    """

    gain: float = inf
    read_noise: float | None = None
    full_scale: float = inf

    def __post_init__(self) -> None:
        check_positive("gain", self.gain, infinite=True)
        check_positive("read_noise", self.read_noise)
        check_positive("full_scale", self.full_scale, infinite=True)


@dataclass(frozen=True, eq=False)
class Frame:
    """Counts (rows, columns), row 0 the top, with dark and flat field already applied; ``bad``: pixels not to use.

    ``psf``: the whole frame is the intensity of one point, its chief ray at the sample of row (rows − 1)//2 and column
    columns//2. ``integrated``: its samples are light of whole pixels, as those of a photograph always are, and not
    intensities at points. ``field_deg``: of a PSF, the angle of its field, along +y; None where it is not known.
    ``encoding``: "srgb" or "linear", as which whole numbers of a file were read; "" for others. ``notes``: what a
    reader has to know of how the file was read.
    """

    values: np.ndarray
    geometry: FrameGeometry
    noise: Noise = field(default_factory=Noise)
    bad: np.ndarray | None = None
    psf: bool = False
    integrated: bool = True
    field_deg: float | None = None
    encoding: str = ""
    notes: tuple[Message, ...] = ()

    def __post_init__(self) -> None:
        if self.values.ndim != 2 or self.values.shape != (self.geometry.rows, self.geometry.columns):
            raise RequestError(
                "a frame of shape {shape}; give rows and columns of counts", shape=str(self.values.shape)
            )
        if not np.isfinite(self.values).any():
            raise RequestError("a frame without a finite count; check the file and its dark and flat fields")

    @cached_property
    def background(self) -> float:
        """Return the median of all counts: points cover few pixels."""
        return float(np.median(self.values[np.isfinite(self.values)]))

    @property
    def read_noise(self) -> float:
        """Return the stated noise of a dark pixel in counts, or that of the background."""
        return self.background_noise if self.noise.read_noise is None else self.noise.read_noise

    @cached_property
    def background_noise(self) -> float:
        """Return the noise beside the points in counts, from the median absolute deviation.

        It contains the background's shot noise, and its unevenness. A frame without noise has that stated.
        """
        finite = self.values[np.isfinite(self.values)]
        deviation = MAD * float(np.median(np.abs(finite - self.background)))
        return deviation or self.noise.read_noise or float(np.std(finite)) or 1.0

    def variance(self, light: np.ndarray) -> np.ndarray:
        """Return the variance of counts whose mean is ``light``: read noise, and shot noise where the gain is known."""
        dark = 0.0 if self.noise.read_noise is not None else self.background  # an estimate contains its shot noise
        shot = np.maximum(light - dark, 0.0) / self.noise.gain
        variance: np.ndarray = self.read_noise**2 + shot
        return variance

    @property
    def saturated_pixels(self) -> np.ndarray:
        """Return which pixels have reached full scale, (rows, columns)."""
        full: np.ndarray = np.greater_equal(self.values, min(self.noise.full_scale, self.clipped_at))
        return full

    @cached_property
    def clipped_at(self) -> float:
        """Return the counts at which pixels were clipped, told by flat tops; inf where there are none.

        That is the highest value, if more pixels have it than there are just below it, some of them side by side: the
        top of a smooth peak has few pixels, and fewer the higher. Four equal ones about the middle of a point that is
        symmetric to its last digit are none: such a point is computed, and its middle lies between them.
        """
        from scipy import ndimage

        top = float(np.nanmax(self.values[np.isfinite(self.values)]))
        at, under = self.values == top, self.values < top
        if at.sum() < FEWEST_FLAT or not under.any() or self._symmetric_about(at):
            return inf
        below = min(float(self.values[under].max()), top - NEAR_TOP * (top - self.background))
        labels, _ = ndimage.label(at)
        sizes = np.bincount(labels.ravel())[1:]
        return top if sizes.max() >= FEWEST_FLAT and at.sum() > (under & (self.values >= below)).sum() else inf

    def _symmetric_about(self, at: np.ndarray) -> bool:
        """Return whether these pixels are two by two, and those around them the same when turned by half a turn."""
        rows, columns = np.nonzero(at)
        top, left = int(rows.min()), int(columns.min())
        low_row, low_column = top - AROUND, left - AROUND
        if at.sum() != 4 or not at[top : top + 2, left : left + 2].all() or min(low_row, low_column) < 0:
            return False
        around = self.values[low_row : top + 2 + AROUND, low_column : left + 2 + AROUND]
        return around.shape == (2 + 2 * AROUND,) * 2 and np.allclose(around, around[::-1, ::-1], rtol=1e-9, atol=0)

    @property
    def clipped(self) -> Message | None:
        """Return a warning where pixels were clipped below the full scale that is stated; else None."""
        if self.clipped_at >= self.noise.full_scale:
            return None
        return Message(
            "{count} pixels have the highest count, {top:g}, side by side: they were clipped, and do not count; expose "
            "less, or state the full scale",
            count=int((self.values == self.clipped_at).sum()),
            top=self.clipped_at,
        )

    @property
    def usable(self) -> np.ndarray:
        """Return which pixels count, (rows, columns)."""
        good: np.ndarray = np.isfinite(self.values) & ~self.saturated_pixels
        if self.bad is not None:
            good &= ~self.bad
        return good


def calibrate(values: np.ndarray, dark: np.ndarray | None = None, flat: np.ndarray | None = None) -> np.ndarray:
    """Return (values − dark)/(flat − dark), the flat field's mean taken as 1; NaN where the flat field is dark.

    Raises RequestError for fields of another shape.
    """
    for other in (dark, flat):
        if other is not None and other.shape != values.shape:
            raise RequestError(
                "the dark or flat field has shape {shape} and the picture {wanted}; take both with the same sensor",
                shape=str(other.shape),
                wanted=str(values.shape),
            )
    light = values if dark is None else values - dark
    if flat is None:
        return light
    gain = flat if dark is None else flat - dark
    mean = float(gain[np.isfinite(gain)].mean())
    if not mean > 0:
        raise RequestError("the flat field is not brighter than the dark field; expose it longer")
    with np.errstate(divide="ignore", invalid="ignore"):
        corrected: np.ndarray = np.where(gain > 0.01 * mean, light / (gain / mean), np.nan)
    return corrected
