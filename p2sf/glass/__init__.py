"""Refractive media: an index, a catalogue glass, a glass by nd and vd, or a table, all with ``index(wavelength_um)``.

`dispersion` contains the makers' formulas, `catalogue` finds a glass by its name, `media` gives both one interface.
"""
