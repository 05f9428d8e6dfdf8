"""The point spread function: one module a method, the choice between them, and what is read off the result."""

from p2sf.psf.result import Psf

__all__ = ["Psf"]
