"""Nodes over the open part of a pupil, in rows of equal spatial frequency fy (handbook 11.1).

A mask takes parts of the disc away: an obscuration is a disc of its own with negative weights, and what vanes and
blades cover lies in no rows. Amplitude and phase of a filter are factors at the nodes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.measure.frequency_rows import frequency_rows, scaled
from p2sf.measure.pupil_model import PupilModel
from p2sf.pupil.mask import CLEAR, PupilMask
from p2sf.pupil.mask_nodes import ClearNodes, edge_nodes, throughput
from p2sf.pupil.quadrature import chord_rows, chords_for, disc_nodes, even_count
from p2sf.raytrace.fit import FittedPencil, Level
from p2sf.raytrace.ray_field import Steepness

NO_SLOPES = Steepness(0.0, 0.0, 0.0, 0.0, 1.0)
FEWEST = 6  # more rows and columns than in proportion, of a part of the disc
SAME = 1e-9  # of the disc's amplitude, and waves

Place = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]
"""Gives fx and fy in cycles per µm and the light of unit area at pupil points (ξ, η)."""


@dataclass(frozen=True, eq=False)
class PupilRows:
    """Nodes of a disc in rows of equal fy: ``fy`` (rows,), the rest (rows, columns); weights are shares of the disc."""

    fy: np.ndarray
    fx: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray


@dataclass(frozen=True, eq=False)
class PupilNodes:
    """Nodes of the open pupil, (nodes,), weights of unit sum; ``waves``: the phase of a filter in front of them.

    ``blocks``: rows and columns of each group of nodes that lie in rows of equal fy, one after another.
    ``spreading``: mean A² over (mean A)², by which more of the light goes astray than from the clear disc.
    """

    fx: np.ndarray
    fy: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    waves: np.ndarray
    blocks: tuple[tuple[int, int], ...]
    spreading: float = 1.0


def open_nodes(
    mask: PupilMask, wavelength_um: float, counts: tuple[int, int], disc: Callable[[float], PupilRows], place: Place
) -> PupilNodes:
    """Return nodes over what a mask leaves open of a pupil.

    ``disc``: gives the nodes of the disc of a radius, over the pupil's; their weights are shares of the whole pupil.
    """
    blocks = [disc(1.0)]
    if mask.obscuration:
        inner = disc(mask.obscuration)
        blocks.append(replace(inner, weight=-inner.weight))
    rows, columns = counts
    edges = edge_nodes(mask, columns // 2 + FEWEST, 2 * rows)
    if edges is not None:
        covered = edges.unfolded()
        fx, fy, light = place(covered.xi, covered.eta)
        columns_of = (fx, covered.xi, covered.eta, covered.weight * light)
        blocks.append(PupilRows(fy, *(column[:, None] for column in columns_of)))
    found = _joined(blocks)
    weight = found.weight * mask.amplitude(found.xi, found.eta) if mask.shaded else found.weight
    # The mask's path is longer where light comes later: W counts what it is ahead.
    waves = -mask.path_um(found.xi, found.eta) / wavelength_um if mask.phased else found.waves
    return replace(found, weight=weight / weight.sum(), waves=waves, spreading=throughput(mask).spreading)


def placed_nodes(clear: ClearNodes, wavelength_um: float, place: Place) -> PupilNodes:
    """Return nodes of a pupil that ends elsewhere than at a disc, such as at rims; each is a row of its own."""
    whole = clear.unfolded()
    fx, fy, light = place(whole.xi, whole.eta)
    amplitude = whole.amplitude + np.zeros_like(fx)
    weight = whole.weight * amplitude * light
    path = whole.path_um
    waves = -path / wavelength_um if isinstance(path, np.ndarray) else np.zeros_like(fx)
    spreading = float(whole.weight @ amplitude**2 / (whole.weight @ amplitude) ** 2) / whole.share
    sizes = ((fx.size, 1),)
    return PupilNodes(fx, fy, whole.xi, whole.eta, weight / weight.sum(), waves, sizes, spreading)


def _joined(blocks: Sequence[PupilRows]) -> PupilNodes:
    columns = [
        np.concatenate([np.ravel(getattr(block, name)) for block in blocks]) for name in ("xi", "eta", "weight", "fx")
    ]
    fy = np.concatenate([np.repeat(block.fy, block.fx.shape[1]) for block in blocks])
    xi, eta, weight, fx = columns
    sizes = [block.fx.shape for block in blocks]
    return PupilNodes(fx, fy, xi, eta, weight, np.zeros_like(fx), tuple((rows, count) for rows, count in sizes))


def paraxial_nodes(
    counts: tuple[int, int],
    cycles: float,
    mask: PupilMask = CLEAR,
    wavelength_um: float = 1.0,
    clear: ClearNodes | None = None,
) -> PupilNodes:
    """Return nodes (Gauss–Chebyshev × Gauss–Legendre) whose frequencies are NA/λ·(ξ, η); ``clear``: take these."""

    def disc(radius: float) -> PupilRows:
        quarter = chord_rows(*counts_of(radius, counts))
        half = radius * np.concatenate([quarter.xi, quarter.xi[::-1]])
        eta = radius * np.concatenate([quarter.eta, -quarter.eta[::-1]])
        weight = radius**2 * np.concatenate([quarter.weight, quarter.weight[::-1]]) / 4
        xi = np.concatenate([-half[:, ::-1], half], axis=1)
        weight = np.concatenate([weight[:, ::-1], weight], axis=1)
        return PupilRows(cycles * eta, cycles * xi, xi, np.broadcast_to(eta[:, None], xi.shape), weight)

    def place(xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return cycles * xi, cycles * eta, np.ones_like(xi)

    if clear is not None:
        return placed_nodes(clear, wavelength_um, place)
    return open_nodes(mask, wavelength_um, counts, disc, place)


def mapped_nodes(
    model: PupilModel,
    numbers: np.ndarray,
    counts: tuple[int, int],
    cycles: float,
    mask: PupilMask = CLEAR,
    wavelength_um: float = 1.0,
    clear: ClearNodes | None = None,
) -> PupilNodes | None:
    """Return nodes for the pupil map of these numbers, None where the map folds the pupil over.

    ``clear``: the nodes to take, of a pupil that ends elsewhere than at the disc's rim and the mask.
    """
    _, across, along = model.split(numbers)
    level = Level(model.wave_order, model.map_order, 1, 2)
    fx, fy = cycles * across, cycles * np.append(0.0, along)
    whole = FittedPencil(level, np.zeros(1), fx, fy, 0.0, NO_SLOPES, 0.0, 0)

    def disc(radius: float) -> PupilRows:
        part = whole if radius == 1 else scaled(replace(whole, phase=np.zeros(len(model.wave_names) + 2)), radius)
        rows = frequency_rows(part, *counts_of(radius, counts))
        if rows is None:
            raise _FoldedError
        right = np.tensordot(part.fx, model.maps(rows.xi, rows.eta)[0], 1)
        return PupilRows(
            rows.fy,
            np.concatenate([-right[:, ::-1], right], axis=1),
            radius * np.concatenate([-rows.xi[:, ::-1], rows.xi], axis=1),
            radius * np.concatenate([rows.eta[:, ::-1], rows.eta], axis=1),
            radius**2 / 2 * np.concatenate([rows.weight[:, ::-1], rows.weight], axis=1),
        )

    def place(xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        odd, even = model.maps(xi, eta)
        return fx @ odd, fy[1:] @ even, np.ones_like(xi)

    if clear is not None:
        return placed_nodes(clear, wavelength_um, place)
    try:
        return open_nodes(mask, wavelength_um, counts, disc, place)
    except _FoldedError:
        return None


class _FoldedError(Exception):
    """A pupil map that no rows follow."""


def counts_for(slope: float, cycles: float, half_um: float) -> tuple[int, int]:
    """Return (rows, columns) for a wavefront's steepest slope, waves per unit radius, over a window."""
    return chords_for(slope, slope, cycles * half_um)


def counts_of(radius: float, counts: tuple[int, int]) -> tuple[int, int]:
    """Return (rows, columns) of the disc of a radius, from those of the whole pupil."""
    if radius == 1:
        return counts
    rows, columns = (even_count(radius * count + FEWEST) for count in counts)
    return rows, columns


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
