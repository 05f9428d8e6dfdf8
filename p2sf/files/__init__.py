"""Files written atomically, and archives of arrays read safely.

`raster_size` limits the size that an image file may declare, before it is unpacked; the readers of photos use it.
"""

from p2sf.files.atomic import DAMAGED, read_arrays, write_whole
from p2sf.files.writing import check_place, plain, write_beside, write_json

__all__ = ["DAMAGED", "check_place", "plain", "read_arrays", "write_beside", "write_json", "write_whole"]
