"""Files written whole or not at all, and archives of arrays read safely.

`raster_size` limits the size that a picture file may claim, before it is unpacked; it loads with the readers of photos.
"""

from p2sf.files.atomic import DAMAGED, read_arrays, write_whole
from p2sf.files.writing import check_place, plain, write_beside, write_json

__all__ = ["DAMAGED", "check_place", "plain", "read_arrays", "write_beside", "write_json", "write_whole"]
