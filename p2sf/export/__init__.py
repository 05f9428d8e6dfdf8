"""Export of databases and PSF stacks to other programs: FITS, TIFF, CSV tables, ISETCam."""

from p2sf.export.coefficient_table import write_csv
from p2sf.export.fits import write_fits
from p2sf.export.iset import IsetOptions, write_iset
from p2sf.export.psf_cube import open_cube, open_database
from p2sf.export.tiff import write_tiff

__all__ = ["IsetOptions", "open_cube", "open_database", "write_csv", "write_fits", "write_iset", "write_tiff"]
