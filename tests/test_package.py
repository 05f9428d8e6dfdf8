"""The package holds: folders import only downwards, the core knows no Qt, and importing does no work."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from tests.support.interpreter import loaded_by

ROOT = Path(__file__).parents[1]
# A folder imports from those on the lines above its own and from itself; those of the first line from each other too.
LAYERS = (
    "p2sf.conventions p2sf.messages p2sf.errors p2sf.arguments p2sf.parameters p2sf.spans p2sf.threads p2sf.version "
    "p2sf.html p2sf.named_arrays p2sf.cluster",
    "p2sf.files p2sf.glass p2sf.colour p2sf.pupil",
    "p2sf.lens",
    "p2sf.paraxial",
    "p2sf.raytrace",
    "p2sf.setting p2sf.lensfile p2sf.psf p2sf.pixel_kernels",
    "p2sf.metrics p2sf.io p2sf.scene",
    "p2sf.tolerance p2sf.database p2sf.image",
    "p2sf.export p2sf.measure p2sf.studies",
    "p2sf.api p2sf_explorer.i18n p2sf_explorer.state",
    "p2sf.sweep p2sf_explorer.compute",
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
QT = {"PySide6", "pyqtgraph", "pyvista"}
WITHOUT_QT = (
    "p2sf.",
    "p2sf_explorer.state.",
    "p2sf_explorer.compute.",
    "p2sf_explorer.report.",
    "p2sf_explorer.notebook_widget.",
)


def sources() -> list[Path]:
    found = (path for folder in ("p2sf", "app/p2sf_explorer") for path in (ROOT / folder).rglob("*.py"))
    return sorted(found)


def folder_of(name: str) -> str:
    return ".".join(name.split(".")[:2])


def module_of(path: Path) -> str:
    inside = path.relative_to(ROOT / "app" if "app" in path.parts else ROOT)
    return ".".join(inside.with_suffix("").parts).removesuffix(".__init__")


@cache
def imported(path: Path) -> set[str]:
    """Return every module, or name in a module, that a file imports, inside functions too."""
    found = set()
    for node in statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return found


def statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and all statements in it, but no expressions, which are nine tenths of a file and import nothing."""
    yield node
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        for inner in getattr(node, part, ()):
            yield from statements(inner)


def test_folders_import_only_downwards():
    upwards = []
    for path in sources():
        own = folder_of(module_of(path))
        for name in imported(path):
            other = folder_of(name)
            if own in FLOOR and other in FLOOR and other != own and FLOOR[other] >= max(FLOOR[own], 1):
                upwards.append(f"{module_of(path)} imports {name} from above")
    assert not upwards


def test_private_modules_stay_in_their_folder():
    foreign = []
    for path in sources():
        for name in imported(path):
            private = any(part.startswith("_") and part[1] != "_" for part in name.split(".")[2:-1])
            if private and folder_of(name) != folder_of(module_of(path)):
                foreign.append(f"{module_of(path)} imports {name}")
    assert not foreign


def test_every_folder_has_its_floor():
    folders = {folder_of(module_of(path)) for path in sources()} - {
        "p2sf",
        "p2sf.__main__",
        "p2sf_explorer",
        "p2sf_explorer.__main__",
    }
    assert folders == set(FLOOR)


def test_no_folder_is_crowded():
    for folder in {path.parent for path in sources()} - {ROOT / "app/p2sf_explorer/panels"}:
        assert 2 <= len(list(folder.glob("*.py"))) <= 25, folder


def test_what_computes_loads_no_qt():
    """All in one process, which is as good: whichever of them loads Qt, it is there."""
    names = [n for n in map(module_of, sources()) if f"{n}.".startswith(WITHOUT_QT) and not n.endswith("__main__")]
    assert not {name.split(".")[0] for name in loaded_by(f"import {', '.join(names)}")} & QT


def test_heavy_libraries_are_loaded_on_use():
    heavy = {"matplotlib", "rich", "tifffile", "yaml", "PIL", "zarr", "dask", "astropy"}
    names = [n for n in map(module_of, sources()) if n.startswith("p2sf.") and folder_of(n) != "p2sf.cli"]
    loaded = loaded_by(f"import {', '.join(n for n in names if not n.endswith('__main__'))}")
    assert not {name.split(".")[0] for name in loaded} & heavy
    assert not loaded & {"scipy.optimize", "scipy.interpolate"}
