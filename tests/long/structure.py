"""Sizes of the program and counts of what should become fewer: ``python -m tests.long.structure [FOLDER]``.

Printed: lines of code (without blanks, comments and docstrings) and syntax nodes of every folder; then branches on
symmetry, comparisons with names of methods, functions of many parameters, class names that occur twice, names that are
a bare participle, types that hold a phase over a pupil, functions whose results are kept, small files, circles between
folders and between files, and imports that run upwards. ``--list branches`` names every place of that count.
"""

import argparse
import ast
import io
import tokenize
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

from tests.support.imports import Graph, circles, graph, imports, module_paths, upward_imports
from tests.test_package import FLOOR

HERE = Path(__file__).resolve().parents[2]
PACKAGES = ("p2sf", "app/p2sf_explorer", "tests")
# What a lens or pupil is asked in order to take another road where it has no mirror symmetry.
# Words that mean shapes and sides of windows, not lenses, are not counted there, nor is the function `round`.
DRAWN = tuple(f"app/p2sf_explorer/{folder}/" for folder in ("charts", "widgets", "window"))
SYMMETRY = {"misaligned", "skew", "symmetric", "even", "mirrored", "unfolded", "around", "folded", "round"}
METHODS = {"seidel", "fitted", "traced", "huygens", "gaussian", "auto", "spherical"}
MOST_PARAMETERS = 7
# Signatures that people call by name: the public functions, and those from which the command line makes its flags.
EXEMPT = ("p2sf/api.py", "p2sf/cli/")  # whose keywords a user reads, as those of three functions elsewhere
EXEMPT_FUNCTIONS = {
    "p2sf/database/files/building.py": "build_database",
    "p2sf/image/picture.py": "form_image",
    "p2sf/studies/tradeoff.py": "tradeoff",
}
NOT_COUNTED = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER}
# Participles that do not end in "ed"; those that are also a verb or a noun, such as read, set or spread, are none.
IRREGULAR = set(
    """
    begun bent bound broken brought built caught chosen come done drawn driven fallen felt flown forgotten found frozen
    given gone grown heard held hidden kept known laid led left lost made meant met paid risen said seen sent shown sold
    sought spoken spun stolen stood struck sunk swept taken taught thought thrown told torn understood won worn woven
    written behind
    """.split()
)
NO_PARTICIPLES = {"seed", "speed", "need", "feed"}
FEW_LINES = 45
# Types of the core that say what phase, path or OPD light has over a pupil, as values, terms or series.
HOLD_A_PHASE = set(
    """
    Cells Coefficients DesignedPupil Differentials ExactDatabase FittedDatabase FittedPencil FrequencyPupil NodeGrid
    OpenRays Parts PointFit PointPupil PupilMap PupilNodes PupilSamples PupilStack PupilTable Rays
    WavefrontMap Waves ZernikeFit
    """.split()
)
PHASE_FIELDS = {"phase", "waves", "wavefront", "opd", "opd_waves", "path"}
# With such a field, but the terms of a basis, a ray's own way through the lens, or a first guess of six numbers.
NO_PHASE = {"Projection", "PupilRays", "PupilValues", "Start", "Trace"}
Place = tuple[Path, int, str]


def sources(root: Path, package: str) -> list[Path]:
    """Return the Python files of a package."""
    return sorted((root / package).rglob("*.py"))


def lines_of_code(source: str) -> int:
    """Return how many lines hold code: no blank lines, comments or docstrings."""
    text: set[int] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef) and _docstring(node):
            text |= set(range(node.body[0].lineno, (node.body[0].end_lineno or 0) + 1))
    lines: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type not in NOT_COUNTED:
            lines |= set(range(token.start[0], token.end[0] + 1))
    return len(lines - text)


def _docstring(node: ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    first = node.body[0] if node.body else None
    return isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str)


def branches(path: Path, tree: ast.Module) -> Iterator[Place]:
    """Yield the conditions that ask for symmetry: of if, while, conditional expressions, and of ``not`` and ``and``."""
    if path.as_posix().startswith(DRAWN):
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.If | ast.IfExp | ast.While):
            calls = [n.func for n in ast.walk(node.test) if isinstance(n, ast.Call) and isinstance(n.func, ast.Name)]
            names = {n.attr if isinstance(n, ast.Attribute) else n.id for n in _names(node.test) if n not in calls}
            if names & SYMMETRY:
                yield path, node.lineno, ast.unparse(node.test)


def _names(tree: ast.AST) -> Iterator[ast.Attribute | ast.Name]:
    return (node for node in ast.walk(tree) if isinstance(node, ast.Attribute | ast.Name))


def method_comparisons(path: Path, tree: ast.Module) -> Iterator[Place]:
    """Yield the comparisons with the name of a method, and the cases of match statements."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare) and _asks_for_method(node):
            yield path, node.lineno, ast.unparse(node)
        elif isinstance(node, ast.match_case) and _constants(node.pattern) & METHODS:
            yield path, node.pattern.lineno, ast.unparse(node.pattern)


def _asks_for_method(node: ast.Compare) -> bool:
    """Return whether a comparison has a method's name; "auto" alone may be a stop or a size left to the program."""
    found = _constants(node) & METHODS
    about = {n.attr if isinstance(n, ast.Attribute) else n.id for n in _names(node)}
    return bool(found - {"auto"}) or (bool(found) and any("method" in name for name in about))


def _constants(tree: ast.AST) -> set[str]:
    return {n.value for n in ast.walk(tree) if isinstance(n, ast.Constant) and isinstance(n.value, str)}


def long_signatures(path: Path, tree: ast.Module) -> Iterator[Place]:
    """Yield the functions with more than seven parameters."""
    if str(path).startswith(EXEMPT):
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name != EXEMPT_FUNCTIONS.get(str(path)):
            arguments = node.args
            names = [a.arg for a in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
            if len([name for name in names if name not in ("self", "cls")]) > MOST_PARAMETERS:
                yield path, node.lineno, node.name


def classes(path: Path, tree: ast.Module) -> Iterator[Place]:
    """Yield the classes of a module."""
    return ((path, node.lineno, node.name) for node in ast.walk(tree) if isinstance(node, ast.ClassDef))


def participles(path: Path, tree: ast.Module) -> Iterator[Place]:
    """Yield functions, classes and annotated fields whose whole name is a participle.

    Not counted: what is true or false, for which an adjective is right, and methods that return a changed copy of what
    they belong to, as ``turned`` and ``scaled`` do.
    """
    for owner in ast.walk(tree):
        for node in ast.iter_child_nodes(owner):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                gives = ast.unparse(node.returns).strip("'\"").split("[")[0] if node.returns else ""
                if isinstance(owner, ast.ClassDef) and gives in ("Self", owner.name, *map(ast.unparse, owner.bases)):
                    continue
                name, kind = node.name, gives
            elif isinstance(node, ast.ClassDef):
                name, kind = node.name, ""
            elif isinstance(owner, ast.ClassDef) and isinstance(node, ast.AnnAssign):
                name, kind = ast.unparse(node.target), ast.unparse(node.annotation)
            else:
                continue
            if kind != "bool" and _is_participle(name.strip("_")):
                yield path, node.lineno, name


def _is_participle(word: str) -> bool:
    return word in IRREGULAR or (
        word.isalpha() and word.islower() and word.endswith("ed") and word not in NO_PARTICIPLES
    )


def folder_circles(root: Path) -> list[set[str]]:
    """Return the sets of folders that import each other in circles, within one package."""
    towards: Graph = defaultdict(set)
    for one in imports(root):
        own, other = (name.split(".") for name in (one.module, one.name))
        if own[0] == other[0] and len(other) > 2 and len(own) > 1:
            towards[".".join(own[:2])].add(".".join(other[:2]))
    return [set(circle) for circle in circles(dict(towards))]


def file_circles(root: Path, with_types: bool = False) -> Iterator[Place]:
    """Yield a place for each circle of files, imports within functions included; those for types alone if asked."""
    paths = module_paths(root)
    for circle in circles(graph(root, with_types)):
        names = sorted(circle)
        yield paths[names[0]].relative_to(root), 1, ", ".join(names)


def upwards(root: Path) -> Iterator[Place]:
    """Yield the imports into a folder that stands no lower, as the layers of this checkout are."""
    paths = module_paths(root)
    for one in upward_imports(root, FLOOR):
        yield paths[one.module].relative_to(root), one.line, one.name


def memoised(path: Path, tree: ast.Module) -> Iterator[Place]:
    """Yield the functions whose results are kept by `functools.lru_cache` or `cache`; a cached property is none."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            kept = [each for each in node.decorator_list if _keeps(each.func if isinstance(each, ast.Call) else each)]
            yield from ((path, node.lineno, node.name) for _ in kept)
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Call) and _keeps(node.func.func):
            yield path, node.lineno, ast.unparse(node)


def _keeps(node: ast.expr) -> bool:
    return ast.unparse(node).removeprefix("functools.") in ("lru_cache", "cache")


def phases(path: Path, tree: ast.Module) -> Iterator[Place]:
    """Yield the classes of `HOLD_A_PHASE`, and those with a field of such a name that no list knows."""
    if path.parts[0] != "p2sf":
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef) and node.name in HOLD_A_PHASE:
            yield path, node.lineno, node.name
        elif isinstance(node, ast.ClassDef) and node.name not in NO_PHASE and _may_hold_a_phase(node):
            yield path, node.lineno, f"{node.name}, in neither list"


def _may_hold_a_phase(owner: ast.ClassDef) -> bool:
    fields = (node for node in owner.body if isinstance(node, ast.AnnAssign))
    return any(
        ast.unparse(field.target) in PHASE_FIELDS and "rray" in ast.unparse(field.annotation) for field in fields
    )


def small(path: Path, source: str) -> Iterator[Place]:
    """Yield a file with so few lines of code that it may belong into another; packages' own files are none."""
    count = lines_of_code(source)
    if path.stem not in ("__init__", "__main__") and count < FEW_LINES:
        yield path, 1, f"{count} lines"


def counts(root: Path) -> dict[str, list[Place]]:
    """Return the places of every count over core and app."""
    found: dict[str, list[Place]] = {name: [] for name in COUNTS}
    named: dict[str, list[Place]] = defaultdict(list)
    for package in PACKAGES[:2]:
        for path in sources(root, package):
            source, short = path.read_text(encoding="utf-8"), path.relative_to(root)
            tree = ast.parse(source)
            for name, places in BY_FILE.items():
                found[name] += places(short, tree)
            found["small"] += small(short, source)
            for place in classes(short, tree):
                named[place[2]].append(place)
    found["classes"] = [place for name in sorted(named) if len(named[name]) > 1 for place in named[name]]
    found["circles"] = list(file_circles(root))
    found["type-circles"] = list(file_circles(root, with_types=True))
    found["upwards"] = list(upwards(root))
    return found


BY_FILE: dict[str, Callable[[Path, ast.Module], Iterator[Place]]] = {
    "branches": branches,
    "methods": method_comparisons,
    "parameters": long_signatures,
    "participles": participles,
    "phases": phases,
    "memoised": memoised,
}
COUNTS = (*BY_FILE, "classes", "small", "circles", "type-circles", "upwards")


def sizes(root: Path) -> dict[str, tuple[int, int]]:
    """Return lines of code and syntax nodes of every folder."""
    lines: Counter[str] = Counter()
    nodes: Counter[str] = Counter()
    for package in PACKAGES:
        for path in sources(root, package):
            source, parts = path.read_text(encoding="utf-8"), path.relative_to(root / package).parts
            folder = f"{package}/{parts[0]}" if len(parts) > 1 else package
            lines[folder] += lines_of_code(source)
            nodes[folder] += sum(1 for _ in ast.walk(ast.parse(source)))
    return {folder: (lines[folder], nodes[folder]) for folder in sorted(lines)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=Path, nargs="?", default=HERE, help="folder of a checkout")
    parser.add_argument("--list", choices=COUNTS, help="name every place")
    given = parser.parse_args()
    found = counts(given.root)
    if given.list:
        for path, line, what in found[given.list]:
            print(f"{path}:{line}: {what}")
        return
    table = sizes(given.root)
    for folder, (lines, nodes) in table.items():
        print(f"{folder:36s} {lines:7d} lines {nodes:8d} nodes")
    for package in PACKAGES:
        inside = [table[folder] for folder in table if folder == package or folder.startswith(f"{package}/")]
        print(f"{package + ', all':36s} {sum(n for n, _ in inside):7d} lines {sum(n for _, n in inside):8d} nodes")
    print(f"{len(found['branches'])} branches on symmetry in {len({p for p, _, _ in found['branches']})} files")
    print(f"{sum('misaligned' in what for _, _, what in found['branches'])} of them on `misaligned`")
    print(f"{len(found['methods'])} comparisons with names of methods")
    print(f"{len(found['parameters'])} functions of more than {MOST_PARAMETERS} parameters")
    print(f"{len({name for _, _, name in found['classes']})} class names that occur more than once")
    print(f"{len(found['participles'])} names of functions, classes and fields that are a bare participle")
    print(f"{len(found['phases'])} types of the core that hold a phase over a pupil{_faults(found['phases'])}")
    print(f"{len(found['memoised'])} functions whose results are kept, cached properties not counted")
    print(f"{len(found['small'])} files below {FEW_LINES} lines of code")
    print(f"circles between folders: {folder_circles(given.root) or 'none'}")
    for name, words in {"circles": "circles between files", "type-circles": "of them and of imports for types"}.items():
        print(f"{len(found[name])} {words}, of {sum(len(what.split(', ')) for *_, what in found[name])} files")
    print(f"{len(found['upwards'])} imports that run upwards, from {len({p for p, *_ in found['upwards']})} files")


def _faults(places: list[Place]) -> str:
    """Return what the list of types and the code do not have in common."""
    unknown = [what.split(",")[0] for *_, what in places if "," in what]
    gone = sorted(HOLD_A_PHASE - {what for *_, what in places})
    return "".join(f"; {words}: {', '.join(names)}" for words, names in (("new", unknown), ("gone", gone)) if names)


if __name__ == "__main__":
    main()
