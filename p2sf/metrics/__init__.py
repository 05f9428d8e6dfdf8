"""Quality measures of a PSF: transfer function, line and edge spread, encircled energy; from pupil or window."""
