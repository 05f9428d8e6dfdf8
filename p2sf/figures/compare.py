"""Differences between two PSFs on the same grid in the usual quality measures (handbook 6.1)."""

from dataclasses import dataclass

import numpy as np

from p2sf.errors import SamplingError
from p2sf.figures.psf_data import PsfData
from p2sf.figures.window import centroid, radius_of_energy
from p2sf.messages import Message

SAME_PITCH = 1e-9  # relative: the rounding of a pitch stored in a file
FLATTEST = 1e6  # `flatness_of`: of a flatter window the reference, exact to 1e-8, keeps no R² of 0.99


@dataclass(frozen=True)
class Errors:
    """A PSF against a reference, both normalised to unit sum in the window they share.

    ``r_squared`` is 1 − Σ(reference − psf)²/Σ(reference − mean)², negative if the mean itself fits better;
    ``relative_l2`` the root of Σ(reference − psf)²/Σreference². ``strehl`` is the difference of Strehl ratios, None if
    one has none, ``radius_50_um`` and ``radius_80_um`` of encircled-energy radii about each one's centroid,
    ``centroid_um`` the distance between the centroids. Differences are this PSF minus the reference.
    """

    r_squared: float
    relative_l2: float
    strehl: float | None
    radius_50_um: float
    radius_80_um: float
    centroid_um: float


def compare(psf: PsfData, reference: PsfData) -> Errors:
    """Return the errors of a PSF against the reference; SamplingError unless both have the same samples and pitch."""
    _check_same_grid(psf, reference)
    (x, y), (x_reference, y_reference) = centroid(psf), centroid(reference)
    radii = [float(radius_of_energy(psf, part) - radius_of_energy(reference, part)) for part in (0.5, 0.8)]
    return Errors(
        r_squared=r_squared(psf.values, reference.values),
        relative_l2=relative_l2(psf.values, reference.values),
        strehl=_difference(psf.strehl, reference.strehl),
        radius_50_um=radii[0],
        radius_80_um=radii[1],
        centroid_um=float(np.hypot(x - x_reference, y - y_reference)),
    )


def _difference(one: float | np.ndarray | None, other: float | np.ndarray | None) -> float | None:
    return None if one is None or other is None else float(one - other)


def _check_same_grid(psf: PsfData, reference: PsfData) -> None:
    same = abs(psf.pixel_um / reference.pixel_um - 1) < SAME_PITCH
    if psf.values.shape != reference.values.shape or not same:
        raise SamplingError(
            "cannot compare {psf} with {reference}; render both on the same grid",
            psf=_grid(psf),
            reference=_grid(reference),
        )


def _grid(psf: PsfData) -> Message:
    """Return a description of the grid of a PSF."""
    shape = " × ".join(map(str, psf.values.shape))
    return Message("{shape} samples at {pixel_um:g} µm", shape=shape, pixel_um=psf.pixel_um)


def r_squared(values: np.ndarray, reference: np.ndarray) -> float:
    """Return R² of two windows (y, x) after both are given unit sum; 1 of the same ones, single samples too."""
    found, wanted = _unit_sum(values), _unit_sum(reference)
    missed = float(np.square(wanted - found).sum())
    return float(1 - missed / np.square(wanted - wanted.mean()).sum()) if missed else 1.0


def relative_l2(values: np.ndarray, reference: np.ndarray) -> float:
    """Return the relative L2 distance of two windows (y, x) after both are given unit sum."""
    found, wanted = _unit_sum(values), _unit_sum(reference)
    return float(np.sqrt(np.square(wanted - found).sum() / np.square(wanted).sum()))


def flatness_of(values: np.ndarray) -> float:
    """Return Σp²/Σ(p − mean)² of a picture: 1 of a PSF on a dark ground, more where a window shows a part of it.

    R² compares errors with what the picture varies, so that of the same relative L2 error 1 − R² is this times as much.
    """
    values = values.astype(float, copy=False)
    apart = values - values.mean()
    varying = float(np.vdot(apart, apart))
    return min(float(np.vdot(values, values)) / varying, FLATTEST) if varying else 1.0


def _unit_sum(values: np.ndarray) -> np.ndarray:
    unit: np.ndarray = np.asarray(values, dtype=float)
    return unit / float(unit.sum())
