"""P2SF: from a lens prescription to its point spread functions, with measured accuracy.

The modules stand in layers and import only downwards; see ``conventions`` for every sign and unit.
"""

__version__ = "0.1.0"
