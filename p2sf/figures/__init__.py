"""A PSF as data, and the figures that are read off its samples alone."""
