"""Sentences as data: a template with named values, put into words last and once, by whoever shows it.

Errors, warnings, reasons and notes carry a `Message`. The command line formats it with its flags, a window with the
names on its controls, in its language and with that language's numbers; a script gets plain English. A template is
English, is the key of its translations, and names its values: ``Message("{path} has {count} lines", path=…, count=…)``.
"""

from collections.abc import Callable
from dataclasses import dataclass
from numbers import Real
from string import Formatter
from typing import Any


def identity(text: str) -> str:
    """Return a text as it is."""
    return text


class ParameterName(str):
    """The name of a parameter as Python has it, such as ``field_deg``; each program shows its own name for it."""

    __slots__ = ()


class Number(str):
    """A number in digits already, such as "12.50" or "−3.1 mm", where no format specification writes it that way."""

    __slots__ = ()


class Alternatives(tuple[object, ...]):
    """Choices of which one is to be taken: written "a, b or c"."""

    __slots__ = ()


@dataclass(frozen=True)
class Style:
    """How messages are put into words: the language of templates, the names of parameters, the writing of numbers.

    ``number`` takes a number as Python writes it, such as "-0.5" or "inf".
    """

    translate: Callable[[str], str] = identity
    parameter: Callable[[str], str] = identity
    number: Callable[[str], str] = identity


PLAIN = Style()


class Message:
    """A sentence or a part of one. Without values the template is a text and its braces mean nothing.

    Values are texts, numbers, other messages, `ParameterName`, `Number`, `Alternatives`, or tuples of these, which are
    joined by commas. A format specification behind a name, ``{angle:.0f}``, belongs to the template.
    """

    __slots__ = ("template", "values")

    def __init__(self, template: str, /, **values: object):
        self.template = template
        self.values = values

    def text(self, style: Style = PLAIN) -> str:
        """Return the message in words."""
        said = style.translate(self.template)
        return _Filling(style).vformat(said, (), self.values) if self.values else said

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return f"Message({str(self)!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Message) and (self.template, self.values) == (other.template, other.values)

    def __hash__(self) -> int:
        return hash(self.template)  # equal values, such as 1 and 1.0, may read differently


class _Filling(Formatter):
    """Fills a template's braces in a style."""

    def __init__(self, style: Style):
        self.style = style

    def format_field(self, value: Any, format_spec: str) -> str:
        """Return one value in words."""
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
        said = format(value, format_spec)
        return self.style.number(said) if isinstance(value, Number | Real) and not isinstance(value, bool) else said
