"""Reduction of the number of fitted pupils: the others, over field, depths and colours, are interpolated."""

from collections.abc import Sequence

import numpy as np

from p2sf.choice import first_within
from p2sf.pixel_kernels.pupil_table import chebyshev, pupil_table
from p2sf.scene.planning.adaptive_table import COUNTS, adaptive_table, grid_of
from p2sf.scene.planning.study import Study

TARGET_ERROR = 3e-3  # relative error of a kernel by interpolation along one axis, from which on no node is added

REMAINDER = 1e-4  # of a term of a polynomial over a wider range, which is not followed


def share_pupils(study: Study) -> None:
    """Set the table of pupils of a study, unless kernels would change by too much.

    Where pupils of the lens are kept, over wider ranges, as many nodes as these have describe the scene's own.
    """
    ends = (
        study.area.x_mm,
        study.area.y_mm,
        (study.ends[0], study.ends[-1]),
        (study.waves_um[0], study.waves_um[-1]),
    )
    if study.kept:
        x, y, depths, waves = (
            chebyshev(*end, fewer_nodes(nodes, end[1] - end[0])).tolist()
            for end, nodes in zip(ends, study.kept.table.axes, strict=True)
        )
        axes = x, y, depths, waves
        found, landed = study.from_lens(study.kept, places := grid_of(axes))
        study.table = pupil_table(axes, found, landed - np.array(places)[:, :2])
        study.table_error = 2 * study.kept.error  # that of what was kept, and as much between the nodes here
    else:
        study.table, study.table_error = adaptive_table(ends, study.fitted, TARGET_ERROR)


def fewer_nodes(nodes: Sequence[float], width: float) -> int:
    """Return how many Chebyshev nodes a part of a range, of this width, needs for the error of all nodes on the range.

    What n of them leave is a polynomial of degree n and above, which falls as the nth power of the width.
    """
    part = width / (nodes[-1] - nodes[0]) if width else 0.0
    errors = ((count, part**count if count < len(nodes) else 0.0) for count in (1, *COUNTS))
    return first_within(errors, REMAINDER)[0]
