"""Which file of a checkout imports which, lazy imports included, and the circles that they form; nothing is run."""

import ast
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

CORE, APP = "p2sf", "p2sf_explorer"
FACE = "p2sf"  # which holds nothing of its own: a name imported from it is imported from the file that it stands for
Graph = dict[str, set[str]]


@dataclass(frozen=True)
class Import:
    """An import: the file, what it takes, as a file where it is one or a name in one, and whether for types alone."""

    module: str
    name: str
    line: int
    for_types: bool


def module_paths(root: Path) -> dict[str, Path]:
    """Return the Python files of core and explorer by their dotted names."""
    found = {}
    for inside, package in ((root, CORE), (root / "app", APP)):
        for path in sorted((inside / package).rglob("*.py")):
            found[".".join(path.relative_to(inside).with_suffix("").parts).removesuffix(".__init__")] = path
    return found


@cache
def imports(root: Path) -> tuple[Import, ...]:
    """Return every import of core and explorer, also within functions; names of the face as what they stand for."""
    paths = module_paths(root)
    behind = _behind_the_face(root)
    return tuple(
        Import(module, behind.get(name, name), line, for_types)
        for module, path in paths.items()
        if module != FACE
        for name, line, for_types in _named(path)
    )


def _behind_the_face(root: Path) -> dict[str, str]:
    """Return what each name of the face stands for, as its imports for type checkers say."""
    faces = [path for path in (root / CORE / "__init__.py", root / CORE / "__init__.pyi") if path.exists()]
    return {f"{FACE}.{name.rsplit('.', 1)[1]}": name for path in faces for name, _, _ in _named(path) if "." in name}


def _named(path: Path) -> Iterator[tuple[str, int, bool]]:
    for node, for_types in _statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from ((f"{node.module}.{alias.name}", node.lineno, for_types) for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno, for_types) for alias in node.names)


def _statements(node: ast.AST, for_types: bool = False) -> Iterator[tuple[ast.AST, bool]]:
    """Yield all statements in a node, but no expressions, which are nine tenths of a file and import nothing."""
    yield node, for_types
    within = for_types or (isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING")
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        for inner in getattr(node, part, ()):
            yield from _statements(inner, within)


def graph(root: Path, with_types: bool = False) -> Graph:
    """Return which files each file imports."""
    files, found = set(module_paths(root)), defaultdict(set)
    for one in imports(root):
        other = one.name if one.name in files else one.name.rpartition(".")[0]
        if other in files and other not in (one.module, FACE) and (with_types or not one.for_types):
            found[one.module].add(other)
    return dict(found)


def circles(towards: Graph) -> list[frozenset[str]]:
    """Return the largest sets of files that reach each other, of two files or more."""
    reached = {start: _reached(start, towards) for start in towards}
    found = {frozenset({a, *(b for b in reached[a] if a in reached.get(b, ()))}) for a in reached}
    return sorted((circle for circle in found if len(circle) > 1), key=sorted)


def _reached(start: str, towards: Graph) -> set[str]:
    found: set[str] = set()
    waiting = [start]
    while waiting:
        for other in towards.get(waiting.pop(), set()) - found:
            found.add(other)
            waiting.append(other)
    return found


def upward_imports(root: Path, floors: dict[str, int]) -> list[Import]:
    """Return the imports from one folder into another that is not on a lower floor; those of floor 0 are as one."""
    found = []
    for one in imports(root):
        own, other = (".".join(name.split(".")[:2]) for name in (one.module, one.name))
        if own in floors and other in floors and own != other and floors[other] >= max(floors[own], 1):
            found.append(one)
    return found
