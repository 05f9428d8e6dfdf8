"""Spectra of light sources, and their colours as an observer sees them and a screen shows them."""
