"""The model of measured points and frames, and its fit: pupil, noise, starting values, least squares."""
