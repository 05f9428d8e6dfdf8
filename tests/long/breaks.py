"""Single breaks of the code: a sign, a factor, swapped axes, one too many, a unit, a dropped guard.

`places` finds every expression of a file that a rule of `RULES` can break. A rule takes an expression and yields what
stands instead of a part of it: (node, or span between two nodes, what stands there then). Only that part of the text
changes, so that a break reads as a slip of the hand would.
"""

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from hashlib import sha1

Edit = tuple[int, int, str]  # bytes from, to, and what stands there instead
Rule = Callable[["Text", ast.AST], Iterator[Edit]]

TWINS = {
    **{"x": "y", "width": "height", "rows": "columns", "left": "right", "top": "bottom"},
    **{"tangential": "sagittal", "minimum": "maximum", "flipud": "fliplr"},
}
TWINS |= {twin: name for name, twin in TWINS.items()}
UNIT = re.compile(r"[A-Z_]*_PER_[A-Z_]+|1e-?[369]|1e-?12|1_?000(_?000)?(\.0)?")
ANGLES = ("deg2rad", "rad2deg", "radians", "degrees")
BOUNDS = ("min", "max", "minimum", "maximum", "clip", "abs", "fabs")
APPEARANCE = re.compile(  # where things stand in the window, and texts: no numbers that a user reads
    r"set(Contents)?Margins|(set|add)Spacing|add(Widget|Layout|Item|Stretch)|set\w*(Stretch|Width|Height|Size)|QSize"
    r"|QFont|add_axes|setMinimum\w+|setFixed\w+|setPointSize\w*|resize|adjusted|tr|singleShot|setInterval|warn|setStyleSheet"
)


@dataclass(frozen=True)
class Break:
    """One break: its file, line, function and rule, the bytes it replaces, and the line before and after."""

    file: str
    line: int
    inside: str
    rule: str
    edit: Edit
    before: str
    after: str

    def applied(self, source: bytes) -> bytes:
        start, end, text = self.edit
        return source[:start] + text.encode() + source[end:]

    def compiles(self, source: bytes) -> bool:
        try:
            compile(self.applied(source), self.file, "exec")
        except SyntaxError:
            return False
        return True

    def rank(self, seed: int) -> str:
        """Return its place in a random order that stays the same where the code does."""
        return sha1(f"{seed} {self.file} {self.rule} {self.before} {self.after}".encode()).hexdigest()


class Text:
    """The source of a file in bytes, and where its nodes stand."""

    def __init__(self, source: bytes):
        self.source = source
        self.lines = [0]
        for line in source.splitlines(keepends=True):
            self.lines.append(self.lines[-1] + len(line))

    def start(self, node: ast.AST) -> int:
        return self.lines[node.lineno - 1] + node.col_offset

    def end(self, node: ast.AST) -> int:
        return self.lines[node.end_lineno - 1] + node.end_col_offset

    def of(self, node: ast.AST) -> str:
        return self.source[self.start(node) : self.end(node)].decode()

    def instead(self, node: ast.AST, text: str) -> Edit:
        return self.start(node), self.end(node), text

    def between(self, left: ast.AST, right: ast.AST, old: str, new: str) -> Edit:
        """Return the edit of an operator, which stands between two nodes and perhaps between brackets."""
        at = self.source.index(old.encode(), self.end(left), self.start(right))
        return at, at + len(old), new

    def without(self, before: ast.AST, last: ast.AST) -> Edit:
        """Return the edit that drops the last of several operands with its operator and its own brackets."""
        between, end = self.source[self.end(before) : self.start(last)], self.end(last)
        for _ in range(between.count(b"(")):
            end = self.source.index(b")", end) + 1
        return self.end(before), end, ")" * between.count(b")")


def sign(text: Text, node: ast.AST) -> Iterator[Edit]:
    match node:
        case ast.BinOp(op=ast.Add()) if not _is_sequence(node):
            yield text.between(node.left, node.right, "+", "-")
        case ast.BinOp(op=ast.Sub()):
            yield text.between(node.left, node.right, "-", "+")
        case ast.UnaryOp(op=ast.USub()) if not isinstance(node.operand, ast.Constant):
            yield text.instead(node, f"({text.of(node.operand)})")
        case ast.AugAssign(op=ast.Add()) if not _is_sequence(node):
            yield text.between(node.target, node.value, "+=", "-=")


def factor(text: Text, node: ast.AST) -> Iterator[Edit]:
    match node:
        case ast.BinOp(op=ast.Mult() | ast.Div()) if not _is_sequence(node):
            yield text.instead(node, f"(2 * ({text.of(node)}))")
        case ast.BinOp(op=ast.Pow(), right=ast.Constant(value=int(power))):
            yield text.instead(node.right, str(power + 1))


def axes(text: Text, node: ast.AST) -> Iterator[Edit]:
    match node:
        case ast.Subscript(slice=ast.Constant(value=0 | 1 as index)) if not isinstance(index, bool):
            yield text.instead(node.slice, str(1 - index))
        case ast.Subscript(slice=ast.Tuple(elts=[*_, ast.Constant(value=0 | 1 as index)] as elements)):
            yield text.instead(elements[-1], str(1 - index))
        case ast.Slice(step=ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=1))):
            yield text.instead(node.step, "1")
        case ast.keyword(arg="axis", value=ast.Constant(value=0 | 1 as axis)):
            yield text.instead(node.value, str(1 - axis))
        case ast.Assign(targets=[ast.Tuple(elts=[ast.Name(a), ast.Name(b)]) as target]):
            yield text.instead(target, f"{b}, {a}")
        case ast.Attribute(attr="T"):
            yield text.instead(node, text.of(node.value))
        case ast.Attribute(attr=name, ctx=ast.Load()) if name in TWINS:
            yield text.end(node) - len(name), text.end(node), TWINS[name]


def one_off(text: Text, node: ast.AST) -> Iterator[Edit]:
    match node:
        case ast.Compare(ops=[ast.Lt() | ast.LtE() | ast.Gt() | ast.GtE() as op], comparators=[right]):
            if any(_is_count(side) for side in (node.left, right)):
                old = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}[type(op)]
                yield text.between(node.left, right, old, old[0] if "=" in old else f"{old}=")
        case ast.Call(func=ast.Name("range"), args=[*_, last]):
            yield text.instead(last, f"{text.of(last)} + 1")
        case ast.BinOp(op=ast.FloorDiv()):
            yield text.instead(node, f"({text.of(node)} + 1)")
        case ast.BinOp(op=ast.Add() | ast.Sub(), right=ast.Constant(value=int(number))):
            yield text.instead(node.right, str(number + 1))
        case ast.Slice():
            for bound in (node.lower, node.upper):
                if isinstance(bound, ast.Constant):
                    yield text.instead(bound, str(bound.value + 1))


def unit(text: Text, node: ast.AST) -> Iterator[Edit]:
    match node:
        case ast.BinOp(op=ast.Mult() | ast.Div()) if not _is_sequence(node):
            for side in (node.left, node.right):
                if UNIT.fullmatch(text.of(side)):
                    yield text.instead(side, "1")
        case ast.Call(args=[argument], keywords=[]) if _called(node) in ANGLES:
            yield text.instead(node, f"({text.of(argument)})")


def guard(text: Text, node: ast.AST) -> Iterator[Edit]:
    match node:
        case ast.If(body=[ast.Raise() | ast.Return() | ast.Continue() | ast.Break()], orelse=[]):
            yield text.instead(node.test, "False")
        case ast.BoolOp(values=[*_, before, last]):
            yield text.without(before, last)
        case ast.IfExp():
            yield text.instead(node, f"({text.of(node.body)})")
        case ast.Call(args=[_, *_] as arguments, keywords=[]) if _called(node) in BOUNDS[:-2]:
            kept = next((a for a in arguments if not isinstance(a, ast.Constant)), arguments[0])
            yield text.instead(node, f"({text.of(kept)})")
        case ast.Call(args=[argument], keywords=[]) if _called(node) in BOUNDS[-2:]:
            yield text.instead(node, f"({text.of(argument)})")


RULES: tuple[Rule, ...] = (sign, factor, axes, one_off, unit, guard)


def places(file: str, source: bytes) -> Iterator[Break]:
    """Yield every break of a file."""
    text = Text(source)
    for node, inside in _looked_at(ast.parse(source)):
        for rule in RULES:
            for edit in rule(text, node):
                yield _break(file, text, inside, rule.__name__, edit)


def _break(file: str, text: Text, inside: str, rule: str, edit: Edit) -> Break:
    start, end, new = edit
    first, last = text.source.rfind(b"\n", 0, start) + 1, text.source.index(b"\n", end)
    before = text.source[first:last].decode()
    after = (text.source[first:start] + new.encode() + text.source[end:last]).decode()
    line = text.source.count(b"\n", 0, start) + 1
    return Break(file, line, inside, rule, edit, before.strip(), after.strip())


def _looked_at(node: ast.AST, inside: str = "", above: ast.AST | None = None) -> Iterator[tuple[ast.AST, str]]:
    """Yield the nodes below one, each with its function, but no types, decorators and texts; of a product the whole."""
    if not (isinstance(node, ast.BinOp) and _same_product(node, above)):
        yield node, inside
    inside = node.name if isinstance(node, ast.FunctionDef) else inside
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list", "type_params"):
            continue
        for child in value if isinstance(value, list) else (value,):
            if isinstance(child, ast.AST) and not _is_text(child):
                yield from _looked_at(child, inside, node)


def _same_product(node: ast.BinOp, above: ast.AST | None) -> bool:
    kinds = (ast.Mult, ast.Div)
    return isinstance(node.op, kinds) and isinstance(above, ast.BinOp) and isinstance(above.op, kinds)


def _is_text(node: ast.AST) -> bool:
    match node:
        case ast.JoinedStr() | ast.Raise() | ast.Assert():
            return True
        case ast.Call():
            return bool(APPEARANCE.fullmatch(_called(node)))
        case ast.Assign(value=ast.Subscript(value=ast.Name("Callable" | "Literal" | "tuple" | "dict"))):
            return True
    return False


def _called(node: ast.Call) -> str:
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def _is_sequence(node: ast.BinOp | ast.AugAssign) -> bool:
    """Whether it adds or repeats texts and lists, or joins paths, where a break is a plain TypeError."""
    sides = (node.value,) if isinstance(node, ast.AugAssign) else (node.left, node.right)
    plain = (ast.JoinedStr, ast.Tuple, ast.List, ast.ListComp)
    return any(
        isinstance(side, plain)
        or (isinstance(side, ast.Constant) and isinstance(side.value, str | bytes))
        or (isinstance(side, ast.Call) and _called(side) in ("tr", "said", "list", "tuple", "join"))
        or (isinstance(side, ast.BinOp) and _is_sequence(side))
        for side in sides
    )


def _is_count(node: ast.AST) -> bool:
    match node:
        case ast.Constant(value=int()):
            return True
        case ast.Call():
            return _called(node) == "len"
    return False
