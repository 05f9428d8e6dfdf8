"""Files written atomically, and files of unknown origin read within limits."""

from p2sf.files.atomic import DAMAGED, write_whole
from p2sf.files.reading import read_arrays
from p2sf.files.writing import check_place, plain, write_beside, write_json

__all__ = ["DAMAGED", "check_place", "plain", "read_arrays", "write_beside", "write_json", "write_whole"]
