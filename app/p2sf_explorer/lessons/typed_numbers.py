"""Numbers with units as students type them: comma or point, ×10^, units of one kind converted. No Qt in here."""

import re
from math import degrees, isfinite

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.state.scales import APERTURE, read_number, significant

F_NUMBER = "f/"
KINDS: tuple[dict[str, float], ...] = (
    {"nm": 1e-6, "µm": 1e-3, "μm": 1e-3, "um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1e3},
    {
        **dict.fromkeys(("°", "deg", "degrees", "grad"), 1.0),
        **dict.fromkeys(("′", "'", "arcmin"), 1 / 60),
        **dict.fromkeys(("″", '"', "arcsec"), 1 / 3600),
        "rad": degrees(1.0),
        "mrad": degrees(1e-3),
    },
    {**dict.fromkeys(("λ", "lambda", "wave", "waves", "welle", "wellen"), 1.0), "mλ": 1e-3},
    dict.fromkeys(("/mm", "lp/mm", "c/mm", "cycles/mm", "mm⁻¹"), 1.0),
    {"%": 0.01, "": 1.0},
    {"db": 1.0},
    {"dpt": 1.0, "/m": 1.0},
    {F_NUMBER: 1.0},
)
"""Units by kind, in small letters, with what each is in a common unit of its kind."""
SHOWN = {"/mm": "1/mm", "db": "dB", F_NUMBER: ""}  # a unit as it is written, where that differs
OVER_MM = re.compile(r"(?<!\s)\s++1/(?=m)")  # 50 1/mm is 50 /mm
FRACTION = re.compile(r"([-+−]?\d+)\s*/\s*(\d+)(?!\S*\d)\s*(.*)")
WAVE_OVER = re.compile(r"(?:λ|lambda)\s*/\s*([\d.,]+)")
SUFFIXES = {"_um": "µm", "_mm": "mm", "_nm": "nm", "_deg": "°", "_waves": "λ", "_percent": "%", "_db": "db"}


def unit_of(name: str) -> str:
    """Return the unit of a measure or an entry of the state, which the end of its name states; "" for a bare number."""
    return next((unit for ending, unit in SUFFIXES.items() if name.endswith(ending)), "")


def is_unit(unit: str) -> bool:
    """Return whether a unit is known here."""
    return any(unit in kind for kind in KINDS)


def units_like(unit: str) -> dict[str, float]:
    """Return the units of the same kind, each with how many of ``unit`` it is; a bare number is one of ``unit``."""
    kind = next(kind for kind in KINDS if unit in kind)
    return {name: factor / kind[unit] for name, factor in kind.items()} | {"": 1.0}


def read_typed(text: str, unit: str) -> float:
    """Return a typed number in ``unit``; P2SFError says what is expected where it cannot be read."""
    plain = OVER_MM.sub(" /", text.strip())
    if unit == F_NUMBER:
        plain = APERTURE.sub("", plain)
    if over := WAVE_OVER.fullmatch(plain.lower()):
        plain = f"1/{over[1]} λ" if over[1].isdigit() else plain
    if (parts := FRACTION.fullmatch(plain)) and int(parts[2]):
        plain = f"{int(parts[1].replace('−', '-')) / int(parts[2])!r} {parts[3]}"
    value = read_number(plain, "answer", units_like(unit))
    if not isfinite(value):
        raise P2SFError('the answer "{text}" is too large; write a number such as 12.5', text=text.strip())
    return value


def written_value(value: float, unit: str, digits: int = 3) -> str:
    """Return a value with its unit to some significant digits, with a true minus."""
    word = SHOWN.get(unit, unit)
    before = F_NUMBER if unit == F_NUMBER else ""
    gap = "" if word in ("°", "′", "″", "") else " "
    return f"{before}{significant(value + 0.0, digits)}{gap}{word}"


def prompt(unit: str) -> Message:
    """Return what a field for an answer asks for."""
    if unit == F_NUMBER:
        return Message("an f-number, such as f/8")
    return Message("a number in {unit}", unit=SHOWN.get(unit, unit)) if unit else Message("a number")
