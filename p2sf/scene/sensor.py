"""The rectangle of the sensor and the positions of its pixels."""

from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_fields
from p2sf.conventions import UM_PER_MM
from p2sf.errors import RequestError

LARGEST_SIDE = 2**15


@dataclass(frozen=True)
class Sensor:
    """Rows and columns of square pixels; the rectangle's centre lies at ``centre_mm`` (x, y up) from the axis."""

    rows: int
    columns: int
    pixel_um: float
    centre_mm: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("rows", "columns"):
            count = getattr(self, name)
            if not 1 <= count <= LARGEST_SIDE or count % 1:
                raise RequestError(
                    "sensor {name} is {count}; give a whole number from 1 to {most}",
                    name=name,
                    count=count,
                    most=LARGEST_SIDE,
                )
        if not 0 < self.pixel_um < 1e5:
            raise RequestError(
                "sensor pixel_um is {pitch:g} µm; give a positive pitch below 0.1 m", pitch=self.pixel_um
            )
        if not np.isfinite(self.centre_mm).all():
            raise RequestError("sensor centre_mm is ({centre}); give two finite numbers", centre=tuple(self.centre_mm))

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
