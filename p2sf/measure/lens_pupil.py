"""The pupil of a lens for a point anywhere on the sensor, in rows of equal fy (handbook 11.3).

A fit to traced rays gives f(ξ, η) about the meridian; a point at another azimuth turns it, and its rows are no longer
even in anything. Row j follows fy(u, v) = c_j between two points of the rim, c_j = middle + half·cos θ_j, which is
Gauss–Chebyshev quadrature as in `frequency_rows`, for any map that rises steadily.
"""

from dataclasses import dataclass, replace

import numpy as np

from p2sf.errors import SamplingError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.measure.frequency_rows import scaled
from p2sf.measure.point_model import Optics
from p2sf.measure.pupil_model import PupilModel, turned
from p2sf.measure.pupil_nodes import (
    FEWEST,
    NO_SLOPES,
    PupilNodes,
    PupilRows,
    counts_for,
    counts_of,
    mapped_nodes,
    open_nodes,
    placed_nodes,
)
from p2sf.pupil.mask_nodes import ClearNodes, throughput
from p2sf.pupil.quadrature import gauss_legendre
from p2sf.pupil.zernike import basis, gradient
from p2sf.raytrace.fit import FittedPencil, Level, fit
from p2sf.raytrace.seen_mask import mask_seen
from p2sf.raytrace.vignetting import pupil_nodes

NEWTON_STEPS = 10
SETTLED = 1e-9
SAME_SHARE = 1e-6  # of the pupil's area


@dataclass(frozen=True, eq=False)
class DesignedPupil:
    """What a lens as designed says of one point: a model's numbers, and the tilt in waves that they lack.

    ``clear``: nodes over what rims leave open, None where they end nothing.
    """

    numbers: np.ndarray
    tilt: float
    clear: ClearNodes | None = None


def designed_pupil(
    lens: Lens, source: Source, model: PupilModel, cycles: float, half_um: float, clip: bool
) -> DesignedPupil:
    """Return the numbers of a model with a map of a lens's pencil, its field along +y; windows are ±``half_um``.

    A fit's phase has the other sign than W, and its frequencies run the other way. ``clip``: the lens's rims end the
    pupil. Raises GeometryError where rays do not reach the sensor.
    """
    found = fit(lens, source, int(model.name))
    maps = -found.fx / cycles, -found.fy[1:] / cycles
    counts = counts_for(found.steepness.radial, cycles, half_um)
    clear = clear_part(lens, source, counts) if clip else None
    return DesignedPupil(np.concatenate([-found.phase[2:], *maps]), float(-2 * found.phase[1]), clear)  # Z(1, 1) = 2η


def clear_part(lens: Lens, source: Source, counts: tuple[int, int]) -> ClearNodes | None:
    """Return nodes over what the rims of a lens leave open, None where they end nothing; ``counts``: rows, columns."""
    rows, columns = counts
    nodes = pupil_nodes(lens, source, (columns // 3 + FEWEST, 4 * rows // 3), clip=True)
    open_share = throughput(mask_seen(lens, source)).amplitude
    ends = not isinstance(nodes.amplitude, float) or abs(nodes.share - open_share) > SAME_SHARE
    return nodes if ends else None


class TurnedMap:
    """The frequencies of a fit, cycles/µm with the sign of W's phase, over a pupil turned by an azimuth in radians."""

    def __init__(self, found: FittedPencil, azimuth: float):
        self.found, self.order = found, found.level.map_order
        self.azimuth = azimuth
        self.sine, self.cosine = np.sin(azimuth), np.cos(azimuth)

    def at(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return fx and fy along the sensor's axes, each of the points' shape."""
        xi, eta = turned(u.ravel(), v.ravel(), self.azimuth)
        across = -self.found.fx @ basis(self.order, xi, eta, True)
        along = -self.found.fy @ basis(self.order, xi, eta)
        return self._to_sensor(across, along, u.shape)

    def slopes_of_fy(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return ∂fy/∂u and ∂fy/∂v, each of the points' shape."""
        xi, eta = turned(u.ravel(), v.ravel(), self.azimuth)
        odd, even = gradient(self.order, xi, eta, True), gradient(self.order, xi, eta)
        by_xi, by_eta = (
            self._to_sensor(-self.found.fx @ a, -self.found.fy @ b, u.shape)[1] for a, b in zip(odd, even, strict=True)
        )
        # ξ = u·cos − v·sin and η = u·sin + v·cos
        return by_xi * self.cosine + by_eta * self.sine, by_eta * self.cosine - by_xi * self.sine

    def _to_sensor(
        self, across: np.ndarray, along: np.ndarray, shape: tuple[int, ...]
    ) -> tuple[np.ndarray, np.ndarray]:
        x = across * self.cosine + along * self.sine
        y = along * self.cosine - across * self.sine
        return x.reshape(shape), y.reshape(shape)


def lens_nodes(
    found: FittedPencil, azimuth: float, counts: tuple[int, int], clear: ClearNodes | None = None
) -> PupilNodes:
    """Return nodes of the open pupil of a fit, turned by ``azimuth`` radians from +y towards +x.

    ``fx`` and ``fy`` are relative to the chief ray, ξ across the field's plane and η in it; the mask stays as it is.
    ``clear``: the nodes to take, where rims end the pupil, in the field's own axes (`clear_part`).
    Raises SamplingError where fy does not rise across the pupil.
    """
    whole = TurnedMap(found, azimuth)

    def disc(radius: float) -> PupilRows:
        return _disc(TurnedMap(scaled(found, radius), azimuth), radius, counts_of(radius, counts))

    def place(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return *whole.at(u, v), found.amplitude_at(*turned(u, v, azimuth))

    if clear is not None:
        return placed_nodes(clear, found.wavelength_um, lambda xi, eta: place(*turned(xi, eta, -azimuth)))
    nodes = open_nodes(found.mask, found.wavelength_um, counts, disc, place)
    xi, eta = turned(nodes.xi, nodes.eta, azimuth)
    return replace(nodes, xi=xi, eta=eta)


def model_nodes(
    model: PupilModel,
    numbers: np.ndarray,
    optics: Optics,
    azimuth: float,
    counts: tuple[int, int],
    clear: ClearNodes | None = None,
) -> PupilNodes | None:
    """Return nodes for the pupil map of a model's numbers, ξ and η those of its field; None where the map folds over.

    ``clear``: the nodes to take, of a pupil that ends at rims.
    """
    if not azimuth:
        return mapped_nodes(model, numbers, counts, optics.cycles, optics.mask, optics.wavelength_um, clear)
    _, across, along = model.split(numbers)
    level = Level(model.wave_order, model.map_order, 1, 2)
    phase = np.zeros(len(model.wave_names) + 2)
    # The frequencies of a fit run the other way.
    fx, fy = -optics.cycles * across, -optics.cycles * np.append(0.0, along)
    whole = FittedPencil(level, phase, fx, fy, 0.0, NO_SLOPES, 0.0, 0)
    try:
        return lens_nodes(replace(whole, mask=optics.mask, wavelength_um=optics.wavelength_um), azimuth, counts, clear)
    except SamplingError:
        return None


def _disc(seen: TurnedMap, radius: float, counts: tuple[int, int]) -> PupilRows:
    """Return the nodes of a disc of the pupil, along the sensor's axes, from its map over its own unit disc."""
    rows, columns = counts
    low, high = (_extreme(seen, angle) for angle in (np.pi, 0.0))
    theta = np.arange(1, rows + 1) * (np.pi / (rows + 1))
    (bottom,), (top,) = (seen.at(np.sin(a), np.cos(a))[1] for a in (low, high))
    fy = (top + bottom) / 2 + (top - bottom) / 2 * np.cos(theta)
    right = _on_rim(seen, fy, high + theta * ((low - high) / np.pi))
    left = _on_rim(seen, fy, high - theta * ((high + 2 * np.pi - low) / np.pi))
    node, share = gauss_legendre(columns)
    ends = np.sin(left)[:, None], np.sin(right)[:, None]
    u = (ends[0] + ends[1]) / 2 + (ends[1] - ends[0]) / 2 * node
    v = (np.cos(left) + np.cos(right))[:, None] / 2 + (np.cos(right) - np.cos(left))[:, None] / 2 * node
    for _ in range(NEWTON_STEPS):
        slope = seen.slopes_of_fy(u, v)[1]
        step = (seen.at(u, v)[1] - fy[:, None]) / slope
        v = v - step
        if np.abs(step).max() < SETTLED:
            break
    else:
        raise SamplingError("the pupil map of this lens folds over; stop the lens down or take a smaller field")
    # (1/π)∫dfy∫du/|∂fy/∂v|, with dfy = (top − bottom)/2·sin θ dθ
    area = abs(top - bottom) / (4 * (rows + 1)) * (ends[1] - ends[0]) * share * np.sin(theta)[:, None] / np.abs(slope)
    light = seen.found.amplitude_at(*turned(u, v, seen.azimuth))
    return PupilRows(fy, seen.at(u, v)[0], radius * u, radius * v, radius**2 * area * light)


def _extreme(seen: TurnedMap, guess: float) -> np.ndarray:
    """Return the angle on the rim, (1,), from +v towards +u, where fy is greatest or least."""
    angle, step = np.array([guess]), 1e-3
    for _ in range(NEWTON_STEPS):
        before, here, after = (seen.at(np.sin(a), np.cos(a))[1] for a in (angle - step, angle, angle + step))
        angle = angle - step * (after - before) / 2 / (after - 2 * here + before)
    return angle


def _on_rim(seen: TurnedMap, fy: np.ndarray, guess: np.ndarray) -> np.ndarray:
    """Return the angles on the rim, from +v towards +u, at which fy has these values."""
    angle = guess
    for _ in range(2 * NEWTON_STEPS):
        sine, cosine = np.sin(angle), np.cos(angle)
        by_u, by_v = seen.slopes_of_fy(sine, cosine)
        step = (seen.at(sine, cosine)[1] - fy) / (by_u * cosine - by_v * sine)
        angle = angle - np.clip(step, -0.3, 0.3)
    return angle
