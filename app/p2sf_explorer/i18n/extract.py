"""Begins the file of a new language, and lists the texts that a language lacks, and those it no longer needs.

``python -m p2sf_explorer.i18n.extract [LANGUAGE]`` reads the sources of the library and the explorer (`ast`). A text
needs a translation where it is a literal that reaches `tr`, a `Message` or a `P2SFError`: as an argument, through a
constant, a loop over one, or the parameter of a function that hands it on, such as the title of a card. Texts made in
other ways are found by the test that listens to an open window.
"""

import ast
import re
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from xml.sax.saxutils import escape

from PySide6.QtCore import QLocale

import p2sf
import p2sf_explorer
from p2sf.lensfile.library import lenses_folder
from p2sf.lensfile.source_text import write_text
from p2sf_explorer.i18n.language import FOLDER, texts

UNREACHED = (
    "p2sf.cli",
    "p2sf.studies",
    "p2sf.cluster",
    "p2sf.database.files",
    "p2sf.export.iset",
    "p2sf.export.psf_cube",
    "p2sf_explorer.commands",
)  # by any window
FIELD, LETTERS = re.compile(r"\{[^{}]*\}"), re.compile(r"[^\W\d_]{2}")
ERROR = "P2SFError"
BEGINNING = """<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="{language}">
<context>
<name>p2sf</name>
"""
UNFINISHED, END = '<translation type="unfinished"></translation>', "</context>\n</TS>\n"
LESSONS = Path(p2sf_explorer.__file__).parent / "lessons"
# Fields of dataclasses that are translated where they are shown.
SHOWN = {
    "ColourScale": ("unit", "quantity"),
    "Command": ("title", "group"),
    "PanelEntry": ("title", "group"),
    "Parameter": ("control", "tip"),
    "Preset": ("title", "shows"),
    "Quantity": ("title", "tip"),
}

Parameter = tuple[str, int | None]
"""A parameter, and None where it is a text, or k where it is a list of tuples whose item k is one."""


@dataclass
class Module:
    """One source file: its constants, and what it imports as (module, name), a whole module as (module, "").

    ``nodes``: all of the tree, which is walked once.
    """

    name: str
    tree: ast.Module
    nodes: tuple[ast.AST, ...] = ()
    constants: dict[str, ast.expr] = field(default_factory=dict)
    imports: dict[str, tuple[str, str]] = field(default_factory=dict)


@dataclass(frozen=True)
class Function:
    """A function or a class as it is called: ``name``, the names of its parameters, and its body, None for a class."""

    module: str
    name: str
    parameters: tuple[str, ...]
    body: ast.AST | None


def missing(language: str) -> tuple[str, ...]:
    """Return the texts that a language has no translation for."""
    known = texts(language)
    return tuple(sorted(text for text in required_texts() if text not in known))


def obsolete_texts(language: str) -> tuple[str, ...]:
    """Return the texts of a language file that are no longer written anywhere in the sources."""
    written = {
        node.value
        for module in _modules().values()
        for node in module.nodes
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    return tuple(sorted(set(texts(language)) - written - _lens_texts()))


@cache
def required_texts() -> frozenset[str]:
    """Return all texts that need a translation."""
    return frozenset(text for text in _Sources().texts() | _lens_texts() if LETTERS.search(FIELD.sub("", text)))


@cache
def _lens_texts() -> frozenset[str]:
    """Return titles and characters of the shipped lenses and of those of lessons."""
    found: set[str] = set()
    for path in (*lenses_folder().glob("*.toml"), *LESSONS.glob("*.toml")):
        lens = tomllib.loads(path.read_text(encoding="utf-8"))
        found |= {str(lens[key]) for key in ("title", "character") if key in lens}
    return frozenset(found)


@cache
def _modules() -> dict[str, Module]:
    """Return the modules that a window may reach, by their dotted names."""
    found = {}
    for package in (p2sf, p2sf_explorer):
        root = Path(str(package.__file__)).parent
        for path in root.rglob("*.py"):
            parts = path.relative_to(root.parent).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            if not name.startswith(UNREACHED):
                found[name] = _module(name, ast.parse(path.read_text(encoding="utf-8")))
    return found


def _module(name: str, tree: ast.Module) -> Module:
    made = Module(name, tree, tuple(_below(tree)))
    for node in made.nodes:
        if isinstance(node, ast.ImportFrom) and node.module and not node.level:
            made.imports |= {alias.asname or alias.name: (node.module, alias.name) for alias in node.names}
        elif isinstance(node, ast.Import):
            made.imports |= {alias.asname or alias.name: (alias.name, "") for alias in node.names}
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            made.constants[node.targets[0].id] = node.value
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value:
            made.constants[node.target.id] = node.value
    return made


class _Sources:
    """All functions of the sources, and which of their parameters are shown: the fixed point of handing them on."""

    def __init__(self) -> None:
        self.functions = [function for module in _modules().values() for function in _functions(module)]
        self.by_name: dict[str, list[Function]] = {}
        for function in self.functions:
            self.by_name.setdefault(function.name, []).append(function)
        self.shown: dict[Function, set[Parameter]] = {}
        errors = _subclasses(ERROR)
        for function in self.functions:
            if function.name in errors or function.name in ("Message", "tr"):
                self.shown[function] = {(function.parameters[0], None)}
            elif function.name in SHOWN:
                self.shown[function] = {(name, None) for name in SHOWN[function.name]}

    def texts(self) -> set[str]:
        """Return the literals that reach a shown parameter."""
        while any([self._hand_on(function) for function in self.functions]):
            pass
        found = set()
        for module in _modules().values():
            for scope in _scopes(module):
                for argument, item in self._shown_arguments(module, scope):
                    nodes = _values(argument, module, scope)
                    nodes = nodes if item is None else _items(nodes, item, module, scope)
                    found |= {n.value for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, str)}
        return found

    def _hand_on(self, function: Function) -> bool:
        """Mark the parameters that a function hands on to shown ones; return whether any is new."""
        if function.body is None:
            return False
        before = self.shown.get(function, set())
        after = set(before)
        module = _modules()[function.module]
        for argument, item in self._shown_arguments(module, function.body):
            for name in _names(argument):
                if name in function.parameters:
                    after.add((name, item))
                for source, position in _loops(function.body).get(name, ()):
                    if isinstance(source, ast.Name) and source.id in function.parameters and item is None:
                        after.add((source.id, position))
        if after == before:
            return False
        self.shown[function] = after
        return True

    def _shown_arguments(self, module: Module, scope: ast.AST) -> Iterator[tuple[ast.expr, int | None]]:
        """Yield the arguments of a scope's calls that are shown, each with the item that is."""
        for call in _calls(scope):
            for function in self._functions_of(call, module):
                if shown := self.shown.get(function):
                    named = _arguments(call, function, module, scope)
                    yield from ((named[name], item) for name, item in shown if name in named)

    def _functions_of(self, call: ast.Call, module: Module) -> list[Function]:
        """Return the functions that a call may mean: those of the method's name where the object is not known."""
        if isinstance(call.func, ast.Name):
            where, name = module.imports.get(call.func.id, (module.name, call.func.id))
            known = self.by_name.get(name, [])
            return [function for function in known if function.module == where] or (known if len(known) == 1 else [])
        if not isinstance(call.func, ast.Attribute):
            return []
        known = self.by_name.get(call.func.attr, [])
        owner = call.func.value.id if isinstance(call.func.value, ast.Name) else ""
        if owner in module.imports and not module.imports[owner][1]:
            return []  # a function of a library
        own = owner in ("self", "cls", "super")
        here = [function for function in known if function.module == module.name]
        return here if own and here else known


def _functions(module: Module) -> Iterator[Function]:
    """Yield the functions of a module, methods without their first parameter, and classes as their constructors."""
    methods = {
        id(part): node.name
        for node in module.nodes
        if isinstance(node, ast.ClassDef)
        for part in node.body
        if isinstance(part, ast.FunctionDef)
    }
    for node in module.nodes:
        if isinstance(node, ast.FunctionDef):
            arguments = node.args
            names = [a.arg for a in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
            bound = id(node) in methods and names[:1] in (["self"], ["cls"])
            name = methods[id(node)] if node.name == "__init__" and id(node) in methods else node.name
            yield Function(module.name, name, tuple(names[1:] if bound else names), node)
        elif isinstance(node, ast.ClassDef) and not any(getattr(n, "name", "") == "__init__" for n in node.body):
            fields = [n.target.id for n in node.body if isinstance(n, ast.AnnAssign) and isinstance(n.target, ast.Name)]
            inherited = any(isinstance(base, ast.Name) for base in node.bases)
            yield Function(module.name, node.name, tuple(fields) or (("template",) if inherited else ()), None)


def _subclasses(name: str) -> set[str]:
    """Return a class's name and those of all classes derived from it."""
    found, before = {name}, 0
    classes = [n for m in _modules().values() for n in m.nodes if isinstance(n, ast.ClassDef)]
    while len(found) > before:
        before = len(found)
        found |= {c.name for c in classes if any(isinstance(b, ast.Name) and b.id in found for b in c.bases)}
    return found


def _scopes(module: Module) -> Iterator[ast.AST]:
    """Yield a module and the functions in it."""
    yield module.tree
    yield from (node for node in module.nodes if isinstance(node, ast.FunctionDef))


def _own(scope: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes of a scope without those of the functions in it."""
    return _below(scope, ast.FunctionDef)


def _below(root: ast.AST, closed: type[ast.AST] | tuple[()] = ()) -> Iterator[ast.AST]:
    """Yield the nodes below one, those of a closed kind without what is in them; `ast.walk` is far slower."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node is not root:
            yield node
            if isinstance(node, closed):
                continue
        for value in vars(node).values():
            if isinstance(value, list):
                waiting += [part for part in value if isinstance(part, ast.AST)]
            elif isinstance(value, ast.AST):
                waiting.append(value)


@cache
def _calls(scope: ast.AST) -> tuple[ast.Call, ...]:
    return tuple(node for node in _own(scope) if isinstance(node, ast.Call))


def _arguments(call: ast.Call, function: Function, module: Module, scope: ast.AST) -> dict[str, ast.expr]:
    """Return the arguments of a call by the names of the parameters; a starred constant is spread."""
    given: list[ast.expr] = []
    for argument in call.args:
        if isinstance(argument, ast.Starred):
            spread = [n for n in _values(argument.value, module, scope) if isinstance(n, ast.Tuple)]
            columns = zip(*(n.elts for n in spread), strict=False)
            given += [ast.Tuple(list(column), ast.Load()) for column in columns]
        else:
            given.append(argument)
    named = dict(zip(function.parameters, given, strict=False))
    return named | {word.arg: word.value for word in call.keywords if word.arg}


def _values(node: ast.expr, module: Module, scope: ast.AST) -> list[ast.expr]:
    """Return the literals that an expression may stand for."""
    if isinstance(node, ast.IfExp):
        return _values(node.body, module, scope) + _values(node.orelse, module, scope)
    if isinstance(node, ast.BoolOp):
        return [value for part in node.values for value in _values(part, module, scope)]
    if isinstance(node, ast.Name):
        return _of_name(node.id, module, scope)
    if isinstance(node, ast.Subscript):
        at = node.slice.value if isinstance(node.slice, ast.Constant) else None
        parts = [part for base in _values(node.value, module, scope) for part in _elements(base, at)]
        return [value for part in parts for value in _values(part, module, scope)]
    if isinstance(node, ast.Tuple) and isinstance(node.ctx, ast.Load) and not hasattr(node, "lineno"):
        return [value for part in node.elts for value in _values(part, module, scope)]  # a column of `_arguments`
    return [node]


def _names(node: ast.expr) -> list[str]:
    """Return the variables that an expression may stand for as they are."""
    if isinstance(node, ast.Name):
        return [node.id]
    if isinstance(node, ast.IfExp):
        return _names(node.body) + _names(node.orelse)
    return [name for part in node.values for name in _names(part)] if isinstance(node, ast.BoolOp) else []


def _of_name(name: str, module: Module, scope: ast.AST) -> list[ast.expr]:
    """Return the literals that a name may stand for: of a loop, assigned in the function, or a constant."""
    looped = _loops(scope).get(name, [])
    if looped:
        return [
            value
            for source, position in looped
            for value in _items(_values(source, module, scope), position, module, scope)
        ]
    local = [] if isinstance(scope, ast.Module) else _assignments(scope).get(name, [])
    if local:
        return [value for node in local for value in _values(node, module, scope)]
    where, original = module.imports.get(name, (module.name, name))
    home = _modules().get(where)
    return _values(home.constants[original], home, home.tree) if home and original in home.constants else []


@cache
def _assignments(scope: ast.AST) -> dict[str, list[ast.expr]]:
    found: dict[str, list[ast.expr]] = {}
    for node in _own(scope):
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            target = node.targets[0]
            if isinstance(target, ast.Name):
                found.setdefault(target.id, []).append(node.value)
            elif isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
                for part, value in zip(target.elts, node.value.elts, strict=False):
                    if isinstance(part, ast.Name):
                        found.setdefault(part.id, []).append(value)
    return {
        name: [n for n in nodes if name not in {m.id for m in ast.walk(n) if isinstance(m, ast.Name)}]
        for name, nodes in found.items()
    }


@cache
def _loops(scope: ast.AST) -> dict[str, list[tuple[ast.expr, int]]]:
    """Return for each loop variable the collection of the loop and which item of its members it is, −1 for all."""
    found: dict[str, list[tuple[ast.expr, int]]] = {}
    for node in _own(scope):
        if isinstance(node, ast.For | ast.comprehension):
            target, source = node.target, node.iter
            if isinstance(source, ast.Call) and isinstance(source.func, ast.Attribute) and not source.args:
                position = {"items": None, "values": 1, "keys": 0}.get(source.func.attr, None)
                source = source.func.value
                if position is not None and isinstance(target, ast.Name):
                    found.setdefault(target.id, []).append((source, position))
            if isinstance(target, ast.Name) and not isinstance(node.iter, ast.Call):
                found.setdefault(target.id, []).append((source, -1))
            elif isinstance(target, ast.Tuple):
                for position, part in enumerate(target.elts):
                    if isinstance(part, ast.Name):
                        found.setdefault(part.id, []).append((source, position))
    return found


def _items(nodes: list[ast.expr], position: int, module: Module, scope: ast.AST) -> list[ast.expr]:
    """Return one item of every tuple in lists of tuples, or of every pair of a dict; −1 for the members themselves."""
    found: list[ast.expr] = []
    for node in nodes:
        if isinstance(node, ast.Dict):
            members = [key for key in node.keys if key] if position < 1 else node.values
        else:
            members = [part for member in _elements(node, None) for part in _pick(member, position, module, scope)]
        found += members
    return [value for node in found for value in _values(node, module, scope)]


def _pick(member: ast.expr, position: int, module: Module, scope: ast.AST) -> list[ast.expr]:
    if position < 0:
        return [member]
    return [part for node in _values(member, module, scope) for part in _elements(node, position)]


def _elements(node: ast.expr, at: object) -> list[ast.expr]:
    """Return the element of a tuple, list or dict at an index or key, all where that is not known."""
    if isinstance(node, ast.Dict):
        pairs = zip(node.keys, node.values, strict=True)
        return [v for k, v in pairs if at is None or (isinstance(k, ast.Constant) and k.value == at)]
    if not isinstance(node, ast.Tuple | ast.List):
        return []
    if at is None:
        return node.elts
    return [node.elts[at]] if isinstance(at, int) and -len(node.elts) <= at < len(node.elts) else []


def begin(language: str) -> Path:
    """Write the file of a new language with every text still to be translated, and return its path."""
    path = FOLDER / f"{language}.ts"
    entries = (f"<message><source>{escape(text)}</source>{UNFINISHED}</message>\n" for text in sorted(required_texts()))
    write_text(BEGINNING.format(language=language) + "".join(entries) + END, path)
    return path


def main(arguments: list[str]) -> int:
    """Print what a language lacks and no longer needs, its file written where there is none; 1 if it lacks any."""
    language = arguments[0] if arguments else "de"
    if QLocale(language).language() == QLocale.Language.C:
        print(f'"{language}" is no language that Qt knows; give its code of two or three letters, such as fr or pt_BR')
        return 2
    if not (FOLDER / f"{language}.ts").is_file():
        print(f"{begin(language)} is new; translate it with Qt Linguist or an editor")
    lacking = missing(language)
    for title, listed in (("missing", lacking), ("no longer needed", obsolete_texts(language))):
        print(f"{len(listed)} texts {title} in {language}")
        for text in listed:
            print(f"  {text}")
    return int(bool(lacking))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
