"""The wavefront over the pupil as a picture and as numbers. No Qt in here."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf_explorer.state.terms import WORDS


@dataclass(frozen=True)
class PupilMap:
    """W in waves over the unit disc, (y, x), NaN outside; RMS without piston, peak to valley, in waves."""

    waves: np.ndarray
    rms: float
    peak_to_valley: float
    kind: str


@lru_cache(maxsize=8)
def disc(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ, η of ``count``² samples over the pupil's square, and which of them lie inside."""
    axis = (centred_axis(count) + (0.5 if count % 2 == 0 else 0.0)) * 2 / count
    xi, eta = np.meshgrid(axis, axis)
    return xi, eta, xi**2 + eta**2 <= 1


def pupil_map(waves: np.ndarray, inside: np.ndarray, kind: str) -> PupilMap:
    """Return the map with its RMS and peak-to-valley over the samples inside that have a value."""
    kept = waves[inside]
    kept = kept[np.isfinite(kept)]
    if kept.size == 0:
        return PupilMap(np.full(waves.shape, np.nan), np.nan, np.nan, kind)
    shown = np.where(inside, waves, np.nan)
    return PupilMap(shown, float(kept.std()), float(kept.max() - kept.min()), kind)


def variance_parts(coefficients: Coefficients) -> dict[str, float]:
    """Return how the variance of W over the disc (waves²) splits into orthogonal shapes; tilt is left out.

    Spherical beyond its best focus W40²/180, coma beyond its tilt W31²/72, astigmatism about its medial focus W22²/24,
    and all focus together (W40 + W20 + Wd + W22/2)²/12 (Mahajan 1991, table 2-1). What pushes the focus the way it is
    off shares that part, each by its size; what pulls against it has none.
    """
    w40, w31, w22, w20, wd = (float(getattr(coefficients, name)) for name in ("w40", "w31", "w22", "w20", "wd"))
    causes = {"w40": w40, "w20": w20 + w22 / 2, "wd": wd}
    focus = sum(causes.values())
    pushes = {name: max(0.0, cause * focus) for name, cause in causes.items()}
    whole = sum(pushes.values()) or 1.0
    shares = {name: focus**2 / 12 * push / whole for name, push in pushes.items()}
    return {"w40": w40**2 / 180 + shares["w40"], "w31": w31**2 / 72, "w22": w22**2 / 24} | {
        name: shares[name] for name in ("w20", "wd")
    }


def strongest(coefficients: Coefficients) -> str:
    """Return the term that makes most of the variance of W."""
    parts = variance_parts(coefficients)
    return max(parts, key=parts.__getitem__)


def dominant(coefficients: Coefficients) -> Message:
    """Return what blurs most: a term and its share of the wavefront's variance."""
    parts = variance_parts(coefficients)
    total = sum(parts.values())
    if total < 1 / 14**2 / 10:
        return Message("Diffraction-limited: RMS {rms:.3f} λ", rms=np.sqrt(total))
    name = strongest(coefficients)
    percent, term = 100 * parts[name] / total, Message(WORDS[name])
    if percent > 50:
        return Message("Mostly {term}: {percent:.0f} % of the wavefront variance", term=term, percent=percent)
    return Message("Most of all {term}: {percent:.0f} % of the wavefront variance", term=term, percent=percent)
