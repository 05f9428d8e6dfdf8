"""Sentences as data: a template with named values, formatted by the program that shows it.

Errors, warnings, reasons and notes carry a `Message`. The command line formats it with its flags, the window with the
labels of its controls, in its language and number format; a script gets plain English. A template is in English, is the
key of its translations, and names its values: ``Message("{path} has {count} lines", path=…, count=…)``.
"""

from collections.abc import Callable
from dataclasses import dataclass
from numbers import Real
from string import Formatter
from typing import Any


def identity(text: str) -> str:
    """Return a text as it is."""
    return text


CONTROLS = dict.fromkeys({*range(0x20), *range(0x7F, 0xA0)} - {*b"\t\n"}, "\ufffd")


def printable(text: str) -> str:
    """Return a text without control characters: those in a stranger's file would steer the terminal."""
    return text.translate(CONTROLS)


class ParameterName(str):
    """The Python name of a parameter, such as ``field_deg``; each program shows its own name for it."""

    __slots__ = ()


class Number(str):
    """A number already formatted, such as "12.50" or "−3.1 mm", where no format specification would do."""

    __slots__ = ()


class Alternatives(tuple[object, ...]):
    """A list of alternatives, written "a, b or c"."""

    __slots__ = ()


@dataclass(frozen=True)
class Style:
    """How messages are formatted: the language of templates, the names of parameters and the format of numbers.

    ``number`` takes a number as Python writes it, such as "-0.5" or "inf".
    """

    translate: Callable[[str], str] = identity
    parameter: Callable[[str], str] = identity
    number: Callable[[str], str] = identity


PLAIN = Style()


class Message:
    """A sentence or part of one. Without values the template is plain text, and its braces are literal.

    Values are texts, numbers, other messages, `ParameterName`, `Number`, `Alternatives`, or tuples of these, which are
    joined by commas. A format specification behind a name, ``{angle:.0f}``, belongs to the template.
    """

    __slots__ = ("template", "values")

    def __init__(self, template: str, /, **values: object):
        self.template = template
        self.values = values

    def text(self, style: Style = PLAIN) -> str:
        """Return the message as text."""
        said = style.translate(self.template)
        return _StyledFormatter(style).vformat(said, (), self.values) if self.values else said

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return f"Message({str(self)!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Message) and (self.template, self.values) == (other.template, other.values)

    def __hash__(self) -> int:
        return hash(self.template)  # equal values such as 1 and 1.0 may be formatted differently


class _StyledFormatter(Formatter):
    """Formatter that fills the braces of a template in a style."""

    def __init__(self, style: Style):
        self.style = style

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return one value as text."""
        if isinstance(value, ParameterName):
            return self.style.parameter(value)
        message = getattr(value, "message", value)  # of an error
        if isinstance(message, Message):
            return message.text(self.style)
        if isinstance(value, Alternatives) and len(value) > 1:
            *others, last = (self.format_field(item, format_spec) for item in value)
            return f"{', '.join(others)} {self.style.translate('or')} {last}"
        if isinstance(value, tuple | list):
            return ", ".join(self.format_field(item, format_spec) for item in value)
        said = format(printable(value) if isinstance(value, str) else value, format_spec)
        return self.style.number(said) if isinstance(value, Number | Real) and not isinstance(value, bool) else said
