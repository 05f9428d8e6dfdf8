"""The former place of `p2sf.measure.fitting.frame_terms`, for one version more."""

import warnings

from p2sf.measure.fitting.frame_terms import lens_optics

__all__ = ["lens_optics"]
warnings.warn("p2sf.measure.frame_terms is p2sf.measure.fitting.frame_terms now", DeprecationWarning, stacklevel=2)
