"""What a PSF is judged by: transfer function, line and edge spread, encircled energy; from the pupil or a window."""
