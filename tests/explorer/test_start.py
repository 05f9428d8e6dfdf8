"""What a start costs: no library is loaded that the first picture has no use for, and no renderer before its panel."""

from tests.support.interpreter import loaded_by

HEAVY = {"matplotlib", "PIL", "tifffile", "pyvista", "pyvistaqt", "vtkmodules", "vtk", "zarr", "rich", "cyclopts"}


def test_the_window_and_the_panel_of_3d_are_imported_without_heavy_libraries():
    modules = "application.run", "panels.solid", "scene3d.scene"
    loaded = loaded_by(f"import {', '.join(f'p2sf_explorer.{module}' for module in modules)}")
    assert not {name.split(".")[0] for name in loaded} & HEAVY
