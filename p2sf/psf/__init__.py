"""The point spread function: one module per method, the choice between them, and figures of the result."""

from p2sf.psf.result import Psf

__all__ = ["Psf"]
