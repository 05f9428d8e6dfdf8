"""Files written whole or not at all, and limits to the size of picture files, checked before they are unpacked."""

from p2sf.files.atomic import DAMAGED, read_arrays, write_whole
from p2sf.files.raster_size import OversizedError, check_samples, first_page
from p2sf.files.writing import check_place, plain, write_beside, write_json

__all__ = [
    "DAMAGED",
    "OversizedError",
    "check_place",
    "check_samples",
    "first_page",
    "plain",
    "read_arrays",
    "write_beside",
    "write_json",
    "write_whole",
]
