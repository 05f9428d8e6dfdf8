"""Every PSF of a lens as a few numbers: coefficients over (depth, field, wavelength)."""
