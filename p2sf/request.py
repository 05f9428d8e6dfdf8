"""The former place of `p2sf.camera`, for one version more."""

import warnings

from p2sf.camera import Request, set_up

__all__ = ["Request", "set_up"]
warnings.warn("p2sf.request is p2sf.camera now", DeprecationWarning, stacklevel=2)
