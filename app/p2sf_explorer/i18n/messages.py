"""A refusal in the window's own words: options of the command line become the names on the controls. No Qt in here."""

import re

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
