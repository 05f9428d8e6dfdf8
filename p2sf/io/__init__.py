"""Single PSFs and photos as files: npz, FITS, TIFF, CSV and PNG, read and written, and plots of a PSF."""
