"""Nodes over the open part of a pupil, each a plane wave at the sensor (handbook 11.1)."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.disc.domain import ClearNodes
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.disc.quadrature import disc_nodes, nodes_for
from p2sf.errors import SamplingError
from p2sf.measure.fitting.pupil_model import PupilModel, rotate
from p2sf.messages import ParameterName
from p2sf.pupil.fit import FittedPencil
from p2sf.pupil.plane_waves import Counts

MOST_NODES = 1 << 19  # beyond, a fit takes gigabytes and minutes: hundreds of waves of defocus need fewer
SAME = 1e-9  # of the disc's amplitude, and waves


@dataclass(frozen=True, eq=False)
class PupilNodes:
    """Nodes of the open pupil, (nodes,), weights of unit sum; ``waves``: the phase of a filter in front of them.

    ``fx`` and ``fy`` in cycles/µm along the sensor's axes. ``spreading``: mean A² over (mean A)², by which more of the
    light goes astray than from the clear disc.
    """

    fx: np.ndarray
    fy: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    waves: np.ndarray
    spreading: float = 1.0


def counts_for(slope: float, cycles: float, half_um: float) -> Counts:
    """Return (radial, angular) counts for a wavefront's steepest slope, waves per unit radius, over ±``half_um``.

    Raises SamplingError for more nodes than a fit can sum.
    """
    counts = nodes_for(slope, cycles * half_um * np.sqrt(2))
    if counts[0] * counts[1] > MOST_NODES:
        raise SamplingError(
            "a picture {width:.3g} µm wide is {times:.2g} times as wide as the PSF of a perfect lens, λ/(2 NA) of "
            "{perfect:.2g} µm, and its fit needs {nodes} pupil samples; check that {wavelength} is in nm and {pixel} "
            "in µm, or crop the picture",
            width=2 * half_um,
            times=4 * half_um * cycles,
            perfect=0.5 / cycles,
            nodes=counts[0] * counts[1],
            wavelength=ParameterName("wavelength_nm"),
            pixel=ParameterName("pixel_um"),
        )
    return counts


def open_nodes(mask: PupilMask, counts: Counts, clear: ClearNodes | None, azimuth: float) -> ClearNodes:
    """Return nodes over all of the open pupil along the sensor's axes.

    ``clear``: the nodes to take, where rims end the pupil, along the axes of a field at ``azimuth``, radians.
    """
    if clear is None:
        return mask_nodes(mask, *counts).unfolded()
    whole = clear.unfolded()
    xi, eta = rotate(whole.xi, whole.eta, -azimuth)
    return replace(whole, xi=xi, eta=eta)


def paraxial_nodes(
    counts: Counts,
    cycles: float,
    mask: PupilMask = CLEAR,
    wavelength_um: float = 1.0,
    clear: ClearNodes | None = None,
    azimuth: float = 0.0,
) -> PupilNodes:
    """Return nodes along the sensor's axes whose frequencies are NA/λ·(ξ, η); the rest as in `open_nodes`."""
    nodes = open_nodes(mask, counts, clear, azimuth)
    return _waves_at(nodes, (nodes.xi, nodes.eta), (cycles * nodes.xi, cycles * nodes.eta), 1.0, wavelength_um)


def mapped_nodes(
    model: PupilModel,
    numbers: np.ndarray,
    nodes: ClearNodes,
    cycles: float,
    wavelength_um: float = 1.0,
    azimuth: float = 0.0,
) -> PupilNodes:
    """Return open nodes with the pupil map of a model's numbers, ξ and η along the axes of its field."""
    xi, eta = rotate(nodes.xi, nodes.eta, azimuth)
    _, across, along = model.split(numbers)
    odd, even = model.maps(xi, eta)
    frequencies = rotate(cycles * (across @ odd), cycles * (along @ even), -azimuth)
    return _waves_at(nodes, (xi, eta), frequencies, 1.0, wavelength_um)


def lens_nodes(found: FittedPencil, azimuth: float, counts: Counts, clear: ClearNodes | None = None) -> PupilNodes:
    """Return nodes of the open pupil of a fit whose field lies at ``azimuth`` radians from +y towards +x.

    ``xi`` and ``eta`` are along the axes of the field; the mask stays as it is. ``clear`` as in `open_nodes`. A fit's
    frequencies run the other way than those of W (`conventions`).
    """
    nodes = open_nodes(found.mask, counts, clear, azimuth)
    xi, eta = rotate(nodes.xi, nodes.eta, azimuth)
    _, across, along, amplitude = found.function.at(xi, eta)
    return _waves_at(nodes, (xi, eta), rotate(-across, -along, -azimuth), amplitude, found.wavelength_um)


def _waves_at(
    nodes: ClearNodes,
    place: tuple[np.ndarray, np.ndarray],
    frequencies: tuple[np.ndarray, np.ndarray],
    light: np.ndarray | float,
    wavelength_um: float,
) -> PupilNodes:
    """Return the waves of nodes, where the mask's amplitude and the light of unit area weight them."""
    amplitude = nodes.amplitude + np.zeros_like(nodes.xi)
    weight = nodes.weight * amplitude * light
    spreading = float(nodes.weight @ amplitude**2 / (nodes.weight @ amplitude) ** 2) / nodes.share
    # The mask's path is longer where light comes later: W counts what it is ahead.
    path = nodes.path_um
    ahead = -path / wavelength_um if isinstance(path, np.ndarray) else np.zeros_like(nodes.xi)
    return PupilNodes(*frequencies, *place, weight / weight.sum(), ahead, spreading)


@lru_cache(maxsize=16)
def has_twin(mask: PupilMask) -> bool:
    """Return whether W(ξ, η) and −W(−ξ, −η) give one picture: a pupil alike at both points, its own phase odd."""
    if mask.clear:
        return True
    half = disc_nodes(24, 96)
    here, there = (half.xi, half.eta), (-half.xi, -half.eta)
    light, other = (mask.opens(*at) * mask.amplitude(*at) for at in (here, there))
    even = mask.path_um(*here) + mask.path_um(*there) if mask.phased else np.zeros(1)
    return bool(np.abs(light - other).max() < SAME and np.ptp(even) < SAME)
