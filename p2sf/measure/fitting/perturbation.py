"""Errors of a known lens as unknowns of a frame, and what each adds to the wavefront of a point (handbook 11.3).

They are the errors of a build (`tolerance.errors_of_build`), named by kind and surfaces: decentre_y:3-4, thickness:2.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import cast

import numpy as np

from p2sf.disc.disc_function import DiscFunction
from p2sf.disc.domain import WHOLE
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.measure.fitting.pupil_model import rotate
from p2sf.measure.fitting.pupil_nodes import PupilNodes
from p2sf.raytrace.pencil import reaching
from p2sf.tolerance.errors_of_build import GRADES, MOVES, UNITS, Kind, Tolerance, build, source_of_build

NAME = re.compile(rf"({'|'.join(UNITS)}):(\d+)(?:-(\d+))?")
STEPS = GRADES["high"]  # of differences of rays: so small that W changes linearly
RAYS = 8, 20  # radii and directions, which describe a change of the wavefront to order 9


def perturbation(name: str, surfaces: int) -> Tolerance | None:
    """Return the error of a build that a name means, such as tilt_x:3-4; None for other names.

    Its amount is the step of its differences. Raises RequestError for surfaces that a lens of so many has not.
    """
    found = NAME.fullmatch(name)
    if found is None:
        return None
    kind, first = cast(Kind, found[1]), int(found[2])
    last = int(found[3] or first)
    if not 1 <= first <= last <= surfaces - (kind == "thickness") or (kind not in MOVES and last > first):
        raise RequestError(
            '"{name}": the lens has surfaces 1 to {count}; decentres and tilts take one, or the ends of a piece as in '
            "tilt_x:3-4; radius and index take one, and thickness any but the last",
            name=name,
            count=surfaces,
        )
    return Tolerance(kind, first, STEPS.get(kind, STEPS["tilt_x" if kind.startswith("tilt") else "decentre_x"]), last)


def unit_of(name: str) -> str | None:
    """Return the unit of an error of a build, None for other names."""
    found = NAME.fullmatch(name)
    return None if found is None else UNITS[cast(Kind, found[1])]


@dataclass(frozen=True, eq=False)
class Perturbed:
    """What errors of a build do to the wavefront of a point, in waves and along the sensor's axes.

    ``change``: of W at the errors given, and then per unit of each error, as channels. ``landing_um`` and
    ``landing_slopes``: how far the chief ray moves, (2,) and (errors, 2).
    """

    change: DiscFunction
    landing_um: np.ndarray
    landing_slopes: np.ndarray

    def at(self, nodes: PupilNodes, landed: "Perturbed") -> tuple[np.ndarray, np.ndarray]:
        """Return the change at nodes, (nodes,), and per unit, (errors, nodes), about where the ``landed`` chief ray is.

        That of another colour lands elsewhere, since errors add lateral colour.
        """
        (change, *slopes), frequencies = self.change.at(nodes.xi, nodes.eta), np.stack([nodes.fx, nodes.fy])
        aside, per_unit = self.landing_um - landed.landing_um, self.landing_slopes - landed.landing_slopes
        return change - aside @ frequencies, np.array(slopes) - per_unit @ frequencies


@lru_cache(maxsize=16)
def perturb(lens: Lens, source: Source, errors: tuple[Tolerance, ...], values: tuple[float, ...]) -> Perturbed:
    """Return what errors of these ``values`` do to a point's wavefront, by exact rays, and its derivatives.

    Those are central differences about the lens with these errors. Raises GeometryError where a ray does not reach the
    sensor.
    """
    at = np.array(values)
    still, here = (_trace_errors(lens, source, errors, some) for some in (np.zeros(at.size), at))
    slopes = []
    for k, error in enumerate(errors):
        step = np.zeros(at.size)
        step[k] = error.amount
        more, less = (_trace_errors(lens, source, errors, at + sign * step) for sign in (1, -1))
        slopes.append([(a - b) / (2 * error.amount) for a, b in zip(more, less, strict=True)])
    waves, landing = zip(*slopes, strict=True)
    change = DiscFunction(np.stack([here[0] - still[0], *waves]), RAYS, (False,) * (1 + at.size), WHOLE)
    return Perturbed(change, here[1] - still[1], np.array(landing))


def _trace_errors(
    lens: Lens, source: Source, errors: Sequence[Tolerance], values: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return W of the lens with errors, (rays,), and where its chief ray lands along the sensor's axes, µm."""
    nodes, built = WHOLE.nodes(RAYS), build(lens, errors, values.tolist())
    found = reaching(built, source_of_build(lens, built, source), nodes.xi, nodes.eta)
    # The way back from the field's axes to the sensor's.
    across, along = found.chief_um
    x, y = rotate(across, along, -float(np.deg2rad(source.azimuth_deg)))
    return -found.phase, np.array([x, y])  # W has the other sign than the phase of rays
