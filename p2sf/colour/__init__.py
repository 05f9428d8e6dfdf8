"""Spectra of light sources, and what the eye and a screen make of them."""
