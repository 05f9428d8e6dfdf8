"""A refusal in the window's own words: options of the command line become the names on the controls. No Qt in here."""

import re

from p2sf.errors import P2SFError
from p2sf.messages import Message, Style
from p2sf.parameters import control
from p2sf_explorer.i18n.tr import tr

NAMES = {
    "depth-mm": "Depth",
    "focus-mm": "Focus distance",
    "sensor-shift-um": "Sensor shift",
    "field-deg": "Field",
    "wavelength-nm": "Wavelength",
    "f-number": "f-number",
    "object-height-mm": "the object height",
    "image-height-mm": "the image height",
    "stop": "Stop",
    "method": "Method",
    "tolerance": "the tolerance",
    "clip": "Clip at rims",
}
OPTION = re.compile(r"--([a-z][a-z-]*[a-z])")
INFINITE = re.compile(r"(?<![\w.])(-?)inf(?:inity)?(?![\w.])( (?:mm|µm|nm|°))?")


def spoken(sentence: str) -> str:
    """Return a sentence with options named as the window names them, ∞ for inf, and a capital in front."""
    named = OPTION.sub(lambda found: NAMES.get(found[1], found[1].replace("-", " ")), sentence)
    plain = INFINITE.sub(lambda found: ("−" if found[1] else "") + "∞", named)
    plain = re.sub(r"(?<![\w-])-(?=\d)", "−", plain)
    return plain[:1].upper() + plain[1:]


def number(written: str) -> str:
    """Return a number as Python writes it, such as "-0.5" or "inf", as the window's language does."""
    separator = tr("decimal separator")
    plain = written.replace("inf", "∞").replace("-", "−")
    return plain.replace(".", separator) if separator != "decimal separator" else plain


WINDOW = Style(translate=tr, parameter=lambda name: tr(control(name)), number=number)


def said(message: Message | P2SFError | str) -> str:
    """Return a message, or an error's, as the window says it: its language, its numbers, the names on its controls."""
    if isinstance(message, str):
        return tr(spoken(message))
    words = (message.message if isinstance(message, P2SFError) else message).text(WINDOW)
    return words[:1].upper() + words[1:]
