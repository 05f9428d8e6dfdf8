"""Spectra of light sources, and their colours for the standard observer and on a screen."""
