"""How true the faint light far from the peak is, which R² does not see."""

from dataclasses import dataclass

import numpy as np

from p2sf.errors import SamplingError
from p2sf.figures.psf_data import PsfData

FAINTEST = 1e-6  # of the peak: where the azimuthal mean is fainter nothing is asked
FARTHEST = 200.0  # Airy radii; a clear disc reaches 28, spikes and blurs farther
RING = 1.0  # Airy radii that a ring is wide: a little more than the finest fringe


@dataclass(frozen=True)
class TailError:
    """The largest relative errors of the azimuthal mean and of the light within its rings, and how far these go, µm."""

    mean: float
    encircled: float
    radius_um: float


def azimuthal_mean(psf: PsfData, width_um: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean of samples in rings about the chief ray, and how many each has, (rings,)."""
    ring = (np.hypot(psf.x_um, psf.y_um[:, None]) / width_um).astype(int).ravel()
    count = np.bincount(ring)
    return np.bincount(ring, psf.values.ravel()) / np.maximum(count, 1), count


def tail_error(found: PsfData, reference: PsfData, airy_um: float) -> TailError:
    """Return the errors of a PSF's tails wherever the reference's mean is FAINTEST of its peak within FARTHEST.

    ``airy_um``: the radius of the first dark ring, by which distances count. Raises SamplingError for two windows.
    """
    if found.values.shape != reference.values.shape or found.pixel_um != reference.pixel_um:
        raise SamplingError("the tails of two different windows cannot be compared; compute both in one")
    (mean, count), (wanted, _) = (azimuthal_mean(psf, RING * airy_um) for psf in (found, reference))
    ring = np.arange(count.size)
    asked = (count > 0) & (wanted >= FAINTEST * reference.values.max()) & (ring < FARTHEST / RING)
    light, whole = np.cumsum(mean * count), np.cumsum(wanted * count)
    off, within = np.abs(mean / np.where(asked, wanted, 1) - 1)[asked], np.abs(light / whole - 1)[asked]
    return TailError(float(off.max()), float(within.max()), float((ring[asked].max() + 1) * RING * airy_um))
