"""Every PSF of a lens as a few numbers: coefficients over (depth, field, wavelength)."""

from p2sf.database.build import INTERPOLANTS, build_database
from p2sf.database.exact import ExactDatabase
from p2sf.database.grid import GridDatabase
from p2sf.database.space import Space
from p2sf.spans import depth_nodes

__all__ = ["INTERPOLANTS", "ExactDatabase", "GridDatabase", "Space", "build_database", "depth_nodes"]
