"""The rectangle of the sensor, the positions of its pixels, and how they count light."""

from dataclasses import dataclass, replace
from math import hypot

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_fields
from p2sf.conventions import UM_PER_MM
from p2sf.errors import RequestError
from p2sf.messages import Alternatives, ParameterName
from p2sf.parameters import check_between

MOST_ROWS = 2**15  # and columns
LARGEST_WELL = 1e9  # electrons, a thousand times what any pixel holds
MOST_BITS = 16
MOSAICS = ("rggb", "grbg", "gbrg", "bggr")
"""Colours of a block of 2 × 2 pixels, row by row from the top."""


@dataclass(frozen=True)
class Sensor:
    """Rows and columns of square pixels; the rectangle's centre lies at ``centre_mm`` (x, y up) from the axis.

    The pixels are ideal unless it says how they count light. ``full_well``: electrons in a pixel that is full, as light
    of 1 fills it, whose shot noise is then counted; ``read_noise``: electrons, RMS. ``bits`` of the raw numbers, whose
    largest is a full pixel; ``black_level``: the number of a dark one. ``mosaic``: one of MOSAICS if each pixel sees
    one of three colours. ``fill_factor``: the share of the light that arrives on the sensitive part of a pixel; it is
    a factor only and does not sharpen the picture.
    """

    rows: int
    columns: int
    pixel_um: float
    centre_mm: tuple[float, float] = (0.0, 0.0)
    full_well: float | None = None
    read_noise: float = 0.0
    bits: int | None = None
    black_level: int = 0
    mosaic: str | None = None
    fill_factor: float = 1.0

    def __post_init__(self) -> None:
        check_fields(self)
        self._check_whole("rows", 1, MOST_ROWS)
        self._check_whole("columns", 1, MOST_ROWS)
        if not 0 < self.pixel_um < 1e5:
            raise RequestError(
                "sensor pixel_um is {pitch:g} µm; give a positive pitch below 0.1 m", pitch=self.pixel_um
            )
        if not np.isfinite(self.centre_mm).all():
            raise RequestError("sensor centre_mm is ({centre}); give two finite numbers", centre=tuple(self.centre_mm))
        self._check_reading()

    def _check_reading(self) -> None:
        """Raise RequestError for a pixel that cannot count light."""
        for name, other in (("read_noise", "full_well"), ("black_level", "bits")):
            if getattr(self, name) and getattr(self, other) is None:
                raise RequestError(
                    "{parameter} means nothing without {other}; give both", parameter=name, other=ParameterName(other)
                )
        check_between("full_well", self.full_well, 1, LARGEST_WELL)
        check_between("read_noise", self.read_noise, 0, LARGEST_WELL)
        if self.bits is not None:
            self._check_whole("bits", 1, MOST_BITS)
            self._check_whole("black_level", 0, 2**self.bits - 2)
        if not 0 < self.fill_factor <= 1:
            raise RequestError("the fill factor is {fill:g}; give a part above 0 and up to 1", fill=self.fill_factor)
        if self.mosaic not in (None, *MOSAICS):
            raise RequestError(
                'the mosaic "{mosaic}" is unknown; choose {choices}', mosaic=self.mosaic, choices=Alternatives(MOSAICS)
            )

    def _check_whole(self, name: str, low: int, most: int) -> None:
        count = getattr(self, name)
        if not low <= count <= most or count % 1:
            raise RequestError(
                "sensor {name} is {count}; give a whole number from {low} to {most}",
                name=name,
                count=count,
                low=low,
                most=most,
            )

    @property
    def steps(self) -> int | None:
        """Return by how many raw numbers a full pixel exceeds a dark one; None without ``bits``."""
        return None if self.bits is None else 2**self.bits - 1 - self.black_level

    def noise(self, light: ArrayLike) -> np.ndarray:
        """Return the standard deviation of a pixel's reading below full well, light of 1 being a full one; shape kept.

        Electrons have the variance of their mean, and a step between raw numbers adds a twelfth of its square (EMVA
        Standard 1288, release 3.1, section 2.2).
        """
        variance = np.zeros(np.shape(light))
        if self.full_well is not None:
            electrons = np.maximum(light, 0) * self.fill_factor * self.full_well
            variance = (electrons + self.read_noise**2) / self.full_well**2
        if self.steps:
            variance = variance + 1 / (12 * self.steps**2)
        deviation: np.ndarray = np.sqrt(variance)
        return deviation

    def bin_pixels(self, times: int) -> "Sensor":
        """Return the sensor with ``times``² pixels joined to one; those left over are dropped at both ends.

        The centre stays, so that symmetry is kept: where an odd number is left over, places are half a pixel off.

        Electrons add up, and their read noise in squares. Raw numbers are those of single pixels: there are none, and
        RequestError for a mosaic.
        """
        if self.mosaic is not None:
            raise RequestError("the pixels of a mosaic have different colours and cannot be joined; leave it out")
        well = None if self.full_well is None else min(self.full_well * times**2, LARGEST_WELL)
        return replace(
            self,
            rows=max(1, self.rows // times),
            columns=max(1, self.columns // times),
            pixel_um=self.pixel_um * times,
            full_well=well,
            read_noise=self.read_noise * times,
            bits=None,
            black_level=0,
        )

    @property
    def pixel_mm(self) -> float:
        """Return the pitch in mm."""
        return self.pixel_um / UM_PER_MM

    @property
    def centred(self) -> bool:
        """Return whether the axis passes through the centre."""
        return self.centre_mm == (0.0, 0.0)

    def x_mm(self, column: ArrayLike) -> np.ndarray:
        """Return x of columns (from 0, fractions allowed) relative to the axis, mm to the right; shape kept."""
        x: np.ndarray = (np.asarray(column) - (self.columns - 1) / 2) * self.pixel_mm + self.centre_mm[0]
        return x

    def y_mm(self, row: ArrayLike) -> np.ndarray:
        """Return y of rows (from 0 at the top) relative to the axis, mm upwards; shape kept."""
        y: np.ndarray = ((self.rows - 1) / 2 - np.asarray(row)) * self.pixel_mm + self.centre_mm[1]
        return y

    def ends_mm(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the limits of the rectangle in x and in y, (2,) mm each."""
        return self.x_mm([-0.5, self.columns - 0.5]), self.y_mm([self.rows - 0.5, -0.5])

    def corners_mm(self) -> tuple[float, float]:
        """Return the least and the greatest distance of a pixel from the axis, mm."""
        x, y = self.x_mm(np.array([-0.5, self.columns - 0.5])), self.y_mm(np.array([-0.5, self.rows - 0.5]))
        nearest = (0.0 if values.min() <= 0 <= values.max() else float(np.abs(values).min()) for values in (x, y))
        return hypot(*nearest), hypot(float(np.abs(x).max()), float(np.abs(y).max()))
