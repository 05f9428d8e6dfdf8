"""Refractive media: an index, a catalogue glass, a glass by nd and vd, or a table, all with ``index(wavelength_um)``.

`dispersion` contains the makers' formulas, `catalogue` finds a glass by its name, `media` gives both one interface.
"""

from p2sf.glass.media import (
    AIR,
    CatalogueGlass,
    ConstantIndex,
    Medium,
    ModelGlass,
    TabulatedIndex,
    catalogue_glass,
    constant_index,
    measured_index,
    model_glass,
    parse_medium,
)

__all__ = [
    "AIR",
    "CatalogueGlass",
    "ConstantIndex",
    "Medium",
    "ModelGlass",
    "TabulatedIndex",
    "catalogue_glass",
    "constant_index",
    "measured_index",
    "model_glass",
    "parse_medium",
]
