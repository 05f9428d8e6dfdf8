"""Readers and writers of PSFs and photos, and the plot of a PSF."""
