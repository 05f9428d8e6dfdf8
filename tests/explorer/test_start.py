"""What a start costs: nothing is loaded, read or searched that the first picture has no use for."""

from tests.support.interpreter import loaded_by

HEAVY = {"matplotlib", "PIL", "tifffile", "pyvista", "vtkmodules", "pyqtgraph", "zarr", "rich", "cyclopts"}
START = """
import builtins, gc, linecache
plain = builtins.__import__
from p2sf_explorer.__main__ import fast_imports
with fast_imports():
    assert not gc.isenabled()
    import p2sf_explorer.application
assert gc.isenabled() and gc.get_freeze_count() > 10_000
assert builtins.__import__ is plain
assert not any("p2sf" in name for name in linecache.cache), "PySide6 has read the sources"
"""


def test_the_window_is_imported_without_heavy_libraries_and_without_reading_sources():
    assert not {name.split(".")[0] for name in loaded_by(START.strip())} & HEAVY
