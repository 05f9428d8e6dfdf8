"""Sizes of the program and counts of what should become fewer: ``python -m tests.long.structure [FOLDER]``.

Printed: lines of code (without blanks, comments and docstrings) and syntax nodes of every folder; then branches on
symmetry, comparisons with names of methods, functions of many parameters, class names that occur twice, names that are
a bare participle, and circles between folders. ``--list branches`` names every place of that count.
"""

import argparse
import ast
import io
import tokenize
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

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


def circles(root: Path) -> list[set[str]]:
    """Return the sets of folders that import each other in circles, within one package."""
    towards: dict[str, set[str]] = defaultdict(set)
    for package in PACKAGES[:2]:
        for path in sources(root, package):
            own = _folder(path.relative_to(root / package).parts, Path(package).name)
            for name in _imports(path):
                parts = name.split(".")
                if parts[0] == Path(package).name and len(parts) > 2:
                    towards[own].add(".".join(parts[:2]))
    reached = {folder: _reached(folder, towards) for folder in towards}
    found = {frozenset({a, *(b for b in reached[a] if a in reached.get(b, ()))}) for a in reached if a in reached[a]}
    return [set(circle) for circle in sorted(found, key=sorted) if len(circle) > 1]


def _folder(parts: tuple[str, ...], package: str) -> str:
    return f"{package}.{parts[0].removesuffix('.py')}"


def _imports(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _reached(start: str, towards: dict[str, set[str]]) -> set[str]:
    found: set[str] = set()
    waiting = [start]
    while waiting:
        for other in towards.get(waiting.pop(), set()) - found:
            found.add(other)
            waiting.append(other)
    return found


def counts(root: Path) -> dict[str, list[Place]]:
    """Return the places of every count over core and app."""
    found: dict[str, list[Place]] = {"branches": [], "methods": [], "parameters": [], "classes": [], "participles": []}
    named: dict[str, list[Place]] = defaultdict(list)
    for package in PACKAGES[:2]:
        for path in sources(root, package):
            tree, short = ast.parse(path.read_text(encoding="utf-8")), path.relative_to(root)
            found["branches"] += branches(short, tree)
            found["methods"] += method_comparisons(short, tree)
            found["parameters"] += long_signatures(short, tree)
            found["participles"] += participles(short, tree)
            for place in classes(short, tree):
                named[place[2]].append(place)
    found["classes"] = [place for name in sorted(named) if len(named[name]) > 1 for place in named[name]]
    return found


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
    parser.add_argument(
        "--list", choices=("branches", "methods", "parameters", "classes", "participles"), help="name every place"
    )
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
    print(f"circles between folders: {circles(given.root) or 'none'}")


if __name__ == "__main__":
    main()
