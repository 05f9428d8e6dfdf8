"""Pictures in and out: PNG and TIFF of 8 and 16 bits and float, in linear light inside."""

from p2sf.photos.files import READABLE, Photo, read_photo, write_photo
from p2sf.photos.transfer import ENCODINGS, linear_from_srgb, srgb_from_linear

__all__ = ["ENCODINGS", "READABLE", "Photo", "linear_from_srgb", "read_photo", "srgb_from_linear", "write_photo"]
