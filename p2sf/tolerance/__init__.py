"""What tolerances do to a lens: sensitivities, compensators, and the yield of builds drawn at random.

The wavefront of a build is a quadratic form in its errors (`differentials`), so that thousands of builds take a second.
"""

from p2sf.tolerance.builds import Builds, sensitivities, simulate
from p2sf.tolerance.differentials import Differentials, differentials
from p2sf.tolerance.errors_of_build import GRADES, Tolerance, build, usual_tolerances
from p2sf.tolerance.nodal import field_aberrations, nodal_sensitivities, third_order

__all__ = [
    "GRADES",
    "Builds",
    "Differentials",
    "Tolerance",
    "build",
    "differentials",
    "field_aberrations",
    "nodal_sensitivities",
    "sensitivities",
    "simulate",
    "third_order",
    "usual_tolerances",
]
