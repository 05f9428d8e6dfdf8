"""The sums over a pupil that make a PSF: of plane waves, and of the six coefficients."""
