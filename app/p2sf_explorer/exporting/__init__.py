"""A set of PSFs from the window: what is asked for, and the dialog that asks. Made by `p2sf.interchange.psf_set`."""
