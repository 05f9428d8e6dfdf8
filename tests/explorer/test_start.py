"""What a start costs: no library is loaded that the first picture has no use for."""

from tests.support.interpreter import loaded_by

HEAVY = {"matplotlib", "PIL", "tifffile", "pyvista", "vtkmodules", "zarr", "rich", "cyclopts"}


def test_the_window_is_imported_without_heavy_libraries():
    assert not {name.split(".")[0] for name in loaded_by("import p2sf_explorer.application.run")} & HEAVY
