"""From the values of a map to parts of its colour bar, and the bar's labels; locked or not. No Qt in here."""

from dataclasses import dataclass, replace

import numpy as np

from p2sf_explorer.compute.brightness import DECADES, stretch

RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
Labels = tuple[tuple[float, str], ...]


@dataclass(frozen=True)
class ColourScale:
    """How values become colours of the map ``name``: from ``low`` to ``high``, stretched about zero where it is signed.

    ``unit`` stands over the bar, ``quantity`` where a value is read or copied, both in English. One in the unit of the
    values is ``absolute`` in that of ``measure``, in which scales of different pictures are compared; where the unit is
    ``relative``, it is one picture's own, and a lock keeps that one. ``steady`` ends are widened to coarse steps, and
    beyond a ``grounded`` picture there is the colour of zero.
    """

    name: str
    low: float
    high: float
    unit: str = ""
    quantity: str = ""
    stretch: str = "linear"
    measure: str = ""
    absolute: float = 1.0
    relative: bool = False
    steady: bool = False
    grounded: bool = False

    @property
    def signed(self) -> bool:
        """Return whether zero is in the middle."""
        return self.low == -self.high

    def parts(self, values: np.ndarray) -> np.ndarray:
        """Return the part of the bar, 0 to 1, of each value."""
        if self.signed:
            share = values / self.high
            if self.stretch != "linear":
                share = np.sign(share) * np.sqrt(np.abs(share))
            return (1 + share) / 2
        share = values / self.high if not self.low else (values - self.low) / (self.high - self.low)
        return stretch(share, self.stretch)

    def labels(self) -> Labels:
        """Return parts of the bar and the values there."""
        power = 1 if self.stretch == "linear" else 2
        if self.signed:
            halves = [(part, short(self.high * part**power)) for part in (0.5, 1.0)]
            return (
                (0.5, "0"),
                *(((1 + k * p) / 2, sign + text) for k, sign in ((-1, "−"), (1, "+")) for p, text in halves),
            )
        if self.stretch in DECADES:
            decades = DECADES[self.stretch]
            steps = range(0, decades + 1, 1 if decades < CLOSE_DECADES else 2)
            return tuple((1 - k / decades, decade(self.high, k)) for k in steps)
        return tuple((part, short(self.low + (self.high - self.low) * part**power)) for part in QUARTERS)


CLOSE_DECADES = 6  # from which on every other one is labelled
QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)


def short(value: float) -> str:
    """Return a number as short as a colour bar needs it."""
    text = f"{value:.3g}" if abs(value) >= 100 else f"{value:.2g}"
    return text.replace("e+0", "e").replace("e+", "e").replace("e-0", "e−").replace("-", "−")


def decade(top: float, decades: int) -> str:
    """Return ``top``·10^−decades as it is usually written."""
    if top == 1.0 and decades:
        return "10⁻" + RAISED[decades]
    return short(top * 10.0**-decades)


@dataclass(frozen=True)
class ScaleLock:
    """The ends of a scale that pictures keep, in the unit of ``measure``."""

    measure: str
    low: float
    high: float

    @classmethod
    def of(cls, scale: ColourScale) -> "ScaleLock":
        """Return the lock that keeps a scale as it is."""
        return cls(scale.measure, scale.low * scale.absolute, scale.high * scale.absolute)

    def apply_to(self, scale: ColourScale) -> tuple[ColourScale, float] | None:
        """Return the kept scale for another picture and the factor of its values; None for another measure."""
        if scale.measure != self.measure or not scale.absolute:
            return None
        if scale.relative:
            return scale, scale.absolute * scale.high / self.high
        return replace(scale, low=self.low / scale.absolute, high=self.high / scale.absolute), 1.0
