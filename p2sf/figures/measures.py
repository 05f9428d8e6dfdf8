"""Contrast, encircled energy and line spread as results, of a pupil or of samples (handbook 6.3)."""

from dataclasses import dataclass

import numpy as np

from p2sf.messages import Message

ROADS_AGREE = 1e-3  # of energy by landing points and by waves
LAST_DIGIT = 1e-3  # of contrast and energy as they are shown: a smaller error is not pointed out
PARTS = (0.5, 0.8)  # of the light, whose radii are quoted


@dataclass(frozen=True, eq=False)
class Mtf:
    """Contrast of sine patterns against cycles per mm on the sensor, all (n,).

    ``tangential``: of patterns that vary along y, the direction of the field, or along an axis that is ``turn_deg``
    from it towards x; ``sagittal``: of those across. Beside them those
    of the same pupils without phase, which nothing exceeds, and of clear pupils without phase, the same where no mask
    stands in the stop. ``method`` names what described the pupil; ``predicted_error`` is the most that a contrast is
    predicted to differ from that of exact rays.
    """

    frequency_per_mm: np.ndarray
    tangential: np.ndarray
    sagittal: np.ndarray
    perfect_tangential: np.ndarray
    perfect_sagittal: np.ndarray
    method: str
    clear_tangential: np.ndarray
    clear_sagittal: np.ndarray
    turn_deg: float = 0.0
    predicted_error: float = 0.0

    @property
    def note(self) -> Message | None:
        """Return what is to be said of an error that shows in the last digit, else None."""
        return _off_by(self.predicted_error)

    def __repr__(self) -> str:
        top = float(np.max(self.frequency_per_mm, initial=0.0))
        parts = [self.method, f"{self.frequency_per_mm.size} frequencies up to {top:.4g} per mm"]
        return f"<Mtf: {', '.join(parts + _words(self.note))}>"


@dataclass(frozen=True, eq=False)
class Energy:
    """The share of all light within each radius, µm, of its centroid, both (n,).

    ``centroid_um``: along y from the chief ray, ``centroid_x_um`` along x, 0 of an even pupil. ``radius_50_um``,
    ``radius_80_um``: what holds half and 80 % of all light. ``rms_um``: RMS distance of the exact rays from
    their own centroid, that of the spot diagram, by every method; that of waves is infinite behind any hard edge.
    ``departure``: of a blur too large for a sum of waves it is that of landing points, the geometric limit, and this is
    how far from waves it may lie; above ROADS_AGREE it is not to be trusted so far. 0 for waves.
    ``predicted_error``: the most that a share is predicted to differ from that of exact rays.
    """

    radius_um: np.ndarray
    fraction: np.ndarray
    centroid_um: float
    radius_50_um: float
    radius_80_um: float
    rms_um: float
    method: str
    departure: float = 0.0
    centroid_x_um: float = 0.0
    predicted_error: float = 0.0

    @property
    def note(self) -> Message | None:
        """Return what is to be said of a geometric limit, or of a predicted error that shows; else None."""
        if not self.departure:
            return _off_by(self.predicted_error)
        if max(self.departure, self.predicted_error) <= ROADS_AGREE:
            return Message("geometric limit, by the landing points of rays")
        return Message(
            "geometric limit, by the landing points of rays: departs from waves by up to {departure:.1g}, "
            "not to be trusted beyond that",
            departure=max(self.departure, self.predicted_error),
        )

    def __repr__(self) -> str:
        radii = [f"{name} {size:.4g} µm" for name, size in (("R50", self.radius_50_um), ("R80", self.radius_80_um))]
        return f"<Energy: {', '.join([self.method, *radii, *_words(self.note)])}>"


def _off_by(error: float) -> Message | None:
    return Message("predicted error up to {error:.1g}", error=error) if error > LAST_DIGIT else None


def _words(note: Message | None) -> list[str]:
    return [str(note)] if note else []


@dataclass(frozen=True, eq=False)
class LineSpread:
    """Images of a line and of an edge across x and across y: positions in µm from the centroid, all (n,).

    ``line_x``, ``line_y``: shares of the light per µm, of lines along y and along x. ``edge_x``, ``edge_y``: edges that
    are dark below 0, their bright side 1. ``centroid_um``, ``centroid_x_um``: as `Energy` has them.
    """

    position_um: np.ndarray
    line_x: np.ndarray
    line_y: np.ndarray
    edge_x: np.ndarray
    edge_y: np.ndarray
    centroid_um: float
    method: str
    centroid_x_um: float = 0.0
