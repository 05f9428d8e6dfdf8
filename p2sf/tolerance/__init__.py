"""Tolerance analysis: sensitivities, compensators, and the yield of random builds.

The wavefront of a build is a quadratic form in its errors (`differentials`), so that thousands of builds take a second.
"""

from p2sf.tolerance.builds import Builds, by_form, simulate
from p2sf.tolerance.criteria import Criterion, harms, of_worst_field, share_within
from p2sf.tolerance.differentials import Differentials, differentials, usual_sources
from p2sf.tolerance.errors_of_build import GRADES, Tolerance, build, usual_tolerances
from p2sf.tolerance.nodal import field_aberrations, nodal_sensitivities, third_order
from p2sf.tolerance.single import form_errors, sensitivities

__all__ = [
    "GRADES",
    "Builds",
    "Criterion",
    "Differentials",
    "Tolerance",
    "build",
    "by_form",
    "differentials",
    "field_aberrations",
    "form_errors",
    "harms",
    "nodal_sensitivities",
    "of_worst_field",
    "sensitivities",
    "share_within",
    "simulate",
    "third_order",
    "usual_sources",
    "usual_tolerances",
]
