"""Stacks of rendered PSFs in Zarr v3, for software that wants arrays."""

from p2sf.database.render import Sampling
from p2sf.stack.layout import Stack, open_stack, read_psfs
from p2sf.stack.write import Watch, write_stack

__all__ = ["Sampling", "Stack", "Watch", "open_stack", "read_psfs", "write_stack"]
