"""Messages of the library and the explorer in the words of the window. No Qt in here."""

from p2sf.errors import P2SFError
from p2sf.messages import Message, Style
from p2sf.parameters import control
from p2sf_explorer.i18n.tr import decimal_separator, tr


def number(written: str) -> str:
    """Return a number as Python writes it, such as "-0.5" or "inf", as the window's language does."""
    return written.replace("inf", "∞").replace("-", "−").replace(".", decimal_separator())


WINDOW = Style(translate=tr, parameter=lambda name: tr(control(name)), number=number)


def said(message: Message | P2SFError) -> str:
    """Return a message, or that of an error, with a capital in front: language, numbers and names of the window."""
    words = (message.message if isinstance(message, P2SFError) else message).text(WINDOW)
    return words[:1].upper() + words[1:]
