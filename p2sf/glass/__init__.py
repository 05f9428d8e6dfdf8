"""Refractive media: dispersion formulas, makers' catalogues, and media of any kind with one interface."""
