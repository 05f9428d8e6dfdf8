"""Coefficient databases (npz) and PSF stacks (Zarr) on disk, with a record of how they were made."""
