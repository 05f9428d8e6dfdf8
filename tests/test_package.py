"""The package holds: imports run downwards and in no circle, the core knows no Qt, and importing does no work."""

import ast
from pathlib import Path

import pytest

import p2sf
from tests.support.imports import circles, graph, imports, module_paths, upward_imports
from tests.support.interpreter import loaded_by

ROOT = Path(__file__).parents[1]
MODULES = tuple(module_paths(ROOT))
# A folder imports from those on the lines above its own and from itself; those of the first line from each other too.
LAYERS = (
    "p2sf.conventions p2sf.messages p2sf.errors p2sf.arguments p2sf.parameters p2sf.spans p2sf.threads "
    "p2sf.version p2sf.choice p2sf.html p2sf.named_arrays p2sf.cluster",
    "p2sf.files p2sf.glass p2sf.colour p2sf.disc",
    "p2sf.lens",
    "p2sf.paraxial",
    "p2sf.raytrace",
    "p2sf.pupil",
    "p2sf.setting p2sf.lensfile p2sf.figures",
    "p2sf.io",
    "p2sf.psf p2sf.pixel_kernels",
    "p2sf.scene",
    "p2sf.tolerance p2sf.database p2sf.image",
    "p2sf.export p2sf.measure p2sf.studies p2sf.performance",
    "p2sf.api p2sf_explorer.i18n p2sf_explorer.state",
    "p2sf.object_points p2sf_explorer.compute",
    "p2sf.camera p2sf_explorer.charts p2sf_explorer.store p2sf_explorer.report p2sf_explorer.notebook_widget",
    "p2sf.cli p2sf_explorer.files p2sf_explorer.handbook",
    "p2sf_explorer.widgets",
    "p2sf_explorer.compare p2sf_explorer.lessons p2sf_explorer.scene3d",
    "p2sf_explorer.course",
    "p2sf_explorer.panels p2sf_explorer.playback",
    "p2sf_explorer.window",
    "p2sf_explorer.application",
    "p2sf_explorer.commands",
    "p2sf_explorer.site",
)
FLOOR = {folder: floor for floor, line in enumerate(LAYERS) for folder in line.split()}
# A lens holds its zoom positions, which are lenses; a chart holds its hand and what paints it, which read the chart.
FOR_TYPES_ALONE = (
    frozenset({"p2sf.lens.lens", "p2sf.lens.positions"}),
    frozenset(f"p2sf_explorer.charts.{name}" for name in ("axes", "chart", "crosshair", "hand")),
)
QT = {"PySide6", "pyqtgraph", "pyvista"}
WITHOUT_QT = (
    "p2sf.",
    "p2sf_explorer.state.",
    "p2sf_explorer.compute.",
    "p2sf_explorer.report.",
    "p2sf_explorer.notebook_widget.",
)


def folder_of(name: str) -> str:
    return ".".join(name.split(".")[:2])


def test_folders_import_only_downwards():
    assert not [(one.module, one.line, one.name) for one in upward_imports(ROOT, FLOOR)]


def test_no_circle_between_files():
    """Nor by imports within functions; those for types alone are listed."""
    assert not circles(graph(ROOT))
    assert circles(graph(ROOT, with_types=True)) == sorted(FOR_TYPES_ALONE, key=sorted)


def test_what_lies_behind_lazy_imports_and_the_face_is_found(tmp_path):
    """A circle of a and b by a name of the package itself, and one of c and d for types alone."""
    files = {
        "__init__": "if TYPE_CHECKING:\n    from p2sf.b import high",
        "a": "def low():\n    try:\n        from p2sf import high\n    except ImportError:\n        pass",
        "b": "from p2sf.a import low",
        "c": "if TYPE_CHECKING:\n    from p2sf.d import Held",
        "d": "from p2sf.c import Holder",
    }
    (tmp_path / "p2sf").mkdir()
    for name, text in files.items():
        (tmp_path / "p2sf" / f"{name}.py").write_text(text)
    of_values, of_types = ({f"p2sf.{name}" for name in pair} for pair in ("ab", "cd"))
    assert circles(graph(tmp_path)) == [of_values]
    assert circles(graph(tmp_path, with_types=True)) == [of_values, of_types]
    [found] = upward_imports(tmp_path, {"p2sf.a": 1, "p2sf.b": 2})
    assert (found.module, found.name, found.line) == ("p2sf.a", "p2sf.b.high", 3)


def test_private_modules_stay_in_their_folder():
    foreign = []
    for one in imports(ROOT):
        private = any(part.startswith("_") and part[1] != "_" for part in one.name.split(".")[2:-1])
        if private and folder_of(one.name) != folder_of(one.module):
            foreign.append(f"{one.module} imports {one.name}")
    assert not foreign


def test_every_folder_has_its_floor():
    folders = {folder_of(name) for name in MODULES} - {
        "p2sf",
        "p2sf.__main__",
        "p2sf_explorer",
        "p2sf_explorer.__main__",
    }
    assert folders == set(FLOOR)


def test_what_computes_loads_no_qt():
    """All in one process, which is as good: whichever of them loads Qt, it is there."""
    names = [n for n in MODULES if f"{n}.".startswith(WITHOUT_QT) and not n.endswith("__main__")]
    assert not {name.split(".")[0] for name in loaded_by(f"import {', '.join(names)}")} & QT


def test_heavy_libraries_are_loaded_on_use():
    heavy = {"matplotlib", "rich", "tifffile", "yaml", "PIL", "zarr", "dask", "astropy"}
    names = [n for n in MODULES if n.startswith("p2sf.") and folder_of(n) != "p2sf.cli"]
    loaded = loaded_by(f"import {', '.join(n for n in names if not n.endswith('__main__'))}")
    assert not {name.split(".")[0] for name in loaded} & heavy
    assert not loaded & {"scipy.optimize", "scipy.interpolate"}


FIRST_PICTURE = """
import os
os.environ["QT_QPA_PLATFORM"] = "offscreen"
from PySide6.QtWidgets import QApplication
application = QApplication([])
from p2sf_explorer.window.window import MainWindow
window = MainWindow(measured=False)
window.show()
application.processEvents()
window.grab()
window.close()
application.processEvents()
"""
# Whole subjects, and libraries that take a tenth of a second or more, by what does not need them.
NOT_NEEDED = {
    "import p2sf": ("numpy", "scipy", "p2sf.lens", "p2sf.setting"),
    "from p2sf.cli import main; main(['info', 'double_gauss_28'])": (
        *("scipy", "finufft", "p2sf.psf", "p2sf.figures", "p2sf.pixel_kernels", "p2sf.scene", "p2sf.image.form"),
        *("p2sf.database", "p2sf.tolerance", "p2sf.measure", "p2sf.studies", "p2sf.export", "p2sf_explorer"),
    ),
    FIRST_PICTURE: (
        *("scipy", "pyqtgraph", "cyclopts", "p2sf.api", "p2sf.image.form", "p2sf.scene", "p2sf.pixel_kernels"),
        *("p2sf.database", "p2sf.tolerance.builds", "p2sf.measure", "p2sf.export", "p2sf.lensfile.formats"),
        *("p2sf_explorer.course.lectures", "p2sf_explorer.lessons.lesson", "p2sf_explorer.lessons.lesson_panel"),
        *("p2sf_explorer.report", "p2sf_explorer.compare.differences", "p2sf_explorer.handbook"),
    ),
}


@pytest.mark.parametrize("statement", NOT_NEEDED, ids=["import", "info", "first picture"])
def test_a_start_loads_only_what_it_needs(statement):
    loaded = loaded_by(f"{statement}\n")
    assert {name for name in NOT_NEEDED[statement] if name in loaded} == set()


def test_every_public_name_is_declared_once_and_is_there():
    stub = ast.parse((ROOT / "p2sf" / "__init__.pyi").read_text(encoding="utf-8"))
    declared = {alias.name for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert {*p2sf.__all__, "conventions"} == declared and "widget" in declared
    assert all(getattr(p2sf, name).__name__ for name in p2sf.__all__)
