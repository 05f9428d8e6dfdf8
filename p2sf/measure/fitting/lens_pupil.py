"""What a lens as designed says of the pupil of a point anywhere on the sensor (handbook 11.3)."""

from dataclasses import dataclass

import numpy as np

from p2sf.disc.domain import ClearNodes
from p2sf.disc.mask_nodes import throughput
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.measure.fitting.pupil_model import PupilModel
from p2sf.measure.fitting.pupil_nodes import counts_for
from p2sf.pupil.fit import fit
from p2sf.pupil.plane_waves import Counts
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.vignetting import pupil_nodes

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
    phase, fx, fy, _ = found.level.coefficients(found.function)
    maps = -fx / cycles, -fy[1:] / cycles
    counts = counts_for(found.steepness.radial, cycles, half_um)
    clear = clear_part(lens, source, counts) if clip else None
    return DesignedPupil(np.concatenate([-phase[2:], *maps]), float(-2 * phase[1]), clear)  # Z(1, 1) = 2η


def clear_part(lens: Lens, source: Source, counts: Counts) -> ClearNodes | None:
    """Return nodes over what the rims of a lens leave open, None where they end nothing."""
    nodes = pupil_nodes(lens, source, counts, clip=True)
    open_share = throughput(mask_seen(lens, source)).amplitude
    ends = not isinstance(nodes.amplitude, float) or abs(nodes.share - open_share) > SAME_SHARE
    return nodes if ends else None
