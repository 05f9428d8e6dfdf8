"""Reduction of the number of fitted pupils: the others, over field, depths and colours, are interpolated."""

from p2sf.pixel_kernels.pupil_table import PupilTable, pupil_table
from p2sf.scene.planning.adaptive_table import adaptive_table, grid_of
from p2sf.scene.planning.study import Study

TARGET_ERROR = 3e-3  # relative error of a kernel by interpolation along one axis, from which on no node is added


def share_pupils(study: Study) -> None:
    """Set the table of pupils of a study, unless kernels would change by too much."""
    ends = (
        study.area.x_mm,
        study.area.y_mm,
        (study.ends[0], study.ends[-1]),
        (study.waves_um[0], study.waves_um[-1]),
    )
    study.table, between = adaptive_table(ends, study.fitted, TARGET_ERROR)
    study.table_error = between + study.kept_error


def seidel_table(study: Study, table: PupilTable) -> PupilTable:
    """Return the table of the pupils by Seidel coefficients at the same nodes."""
    return pupil_table(table.axes, study.by_seidel(grid_of(table.axes)), table.shifts_mm)
