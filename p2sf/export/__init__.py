"""Export of databases and PSF stacks to other programs: FITS, TIFF, CSV tables, ISETCam."""
