"""Deprecated alias of `p2sf.camera`, kept for one more version."""

import warnings

from p2sf.camera import Request, set_up

__all__ = ["Request", "set_up"]
warnings.warn("p2sf.request is p2sf.camera now", DeprecationWarning, stacklevel=2)
