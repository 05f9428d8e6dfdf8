"""How the travel of a slider, 0 to 1, maps to a quantity, and how quantities are written and read. No Qt in here."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, exp, floor, inf, isfinite, isinf, log, log10

from p2sf.conventions import FARTHEST_MM
from p2sf.errors import P2SFError
from p2sf.messages import Message

INFINITE = ("∞", "inf", "infinity")
MM_PER_UNIT = {"": 1.0, "mm": 1.0, "cm": 10.0, "m": 1000.0, "km": 1e6, "µm": 1e-3, "um": 1e-3}
NO_UNIT = {"": 1.0}
NUMBER = re.compile(r"([-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?)\s*(\D*)")  # and what stands behind it
POWER = re.compile(r"(?<!\s)\s*+[×x*·]\s*10\^?([-+]?\d+|[⁻⁺]?[⁰¹²³⁴-⁹]+)")  # 6.7×10^-3, 6.7·10⁻³
THOUSANDS = re.compile(r"[-+−]?[1-9]\d{0,2}([.,])\d{3}(?!\d|[.,]\d)")  # perhaps, by the language
RAISED = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")
SHORTEST_TRAVEL = 1e-300  # to the end: the division overflows nowhere
FAR_MM = 1e10  # as far as from pole to equator: more digits than anybody reads
APERTURE = re.compile(r"^\s*+([fF]\s*+/?|1\s*+:)\s*+(?=[\d.,])")  # f/5.6, F5.6, f 5.6, 1:5.6


@dataclass(frozen=True)
class Linear:
    """Equal travel, equal change."""

    low: float
    high: float

    def value(self, travel: float) -> float:
        """Return the quantity at this travel."""
        return self.low + travel * (self.high - self.low)

    def travel(self, value: float) -> float:
        """Return the travel of this quantity, held inside 0 to 1."""
        return _inside((value - self.low) / (self.high - self.low))

    def moved(self, value: float, by: float) -> float:
        """Return the quantity ``by`` so much travel farther, also beyond the slider's ends."""
        return value + by * (self.high - self.low)


@dataclass(frozen=True)
class Logarithmic:
    """Equal travel, equal ratio: f-numbers."""

    low: float
    high: float

    def value(self, travel: float) -> float:
        """Return the quantity at this travel."""
        return self.low * exp(travel * log(self.high / self.low))

    def travel(self, value: float) -> float:
        """Return the travel of this quantity, held inside 0 to 1."""
        return _inside(log(value / self.low) / log(self.high / self.low))

    def moved(self, value: float, by: float) -> float:
        """Return the quantity ``by`` so much travel farther, also beyond the slider's ends."""
        return value * exp(by * log(self.high / self.low))


@dataclass(frozen=True)
class Vergence:
    """Distances from ``low`` to infinity, with ``half`` in the middle of the travel; without it, twice ``low``.

    Equal travel is equal change of 1/(distance + ``offset``), which keeps infinity at a finite travel: far away it is
    even in dioptres, and the larger the offset, the less of the travel goes to distances near ``low``.
    """

    low: float
    half: float | None = None
    high: float = inf

    @property
    def offset(self) -> float:
        """Return the length added to the distance, mm: (low + offset)/(half + offset) = 1/2."""
        return 0.0 if self.half is None else self.half - 2 * self.low

    def value(self, travel: float) -> float:
        """Return the distance at this travel; infinity at the end, and where rounding leaves of that FARTHEST_MM."""
        distance = (self.low + self.offset) / max(1 - travel, SHORTEST_TRAVEL) - self.offset
        return distance if distance < FARTHEST_MM else inf

    def travel(self, value: float) -> float:
        """Return the travel of this distance, held inside 0 to 1; 1 for one beyond infinity, which is negative."""
        if value <= 0:
            return 1.0
        return _inside(1 - (self.low + self.offset) / (value + self.offset)) if value > self.low else 0.0

    def moved(self, value: float, by: float) -> float:
        """Return the distance ``by`` so much travel farther."""
        return self.value(_inside(self.travel(value) + by))


@dataclass(frozen=True)
class Stepped:
    """Some whole numbers in ascending order, evenly along the travel."""

    values: tuple[int, ...]

    @property
    def low(self) -> int:
        """Return the first number."""
        return self.values[0]

    @property
    def high(self) -> int:
        """Return the last number."""
        return self.values[-1]

    def value(self, travel: float) -> int:
        """Return the number nearest to this travel."""
        return self.values[round(_inside(travel) * (len(self.values) - 1))]

    def travel(self, value: float) -> float:
        """Return the travel of the first number that is not below this one."""
        at = next((k for k, number in enumerate(self.values) if number >= value), len(self.values) - 1)
        return at / (len(self.values) - 1)

    def moved(self, value: float, by: float) -> int:
        """Return the number ``by`` so much travel farther."""
        return self.value(self.travel(value) + by)


def _inside(travel: float) -> float:
    return min(1.0, max(0.0, travel))


def nice(value: float, steps: tuple[float, ...] = (1, 2, 5)) -> float:
    """Return the smallest number of the series ``steps``·10ᵏ that is not below ``value`` (> 0)."""
    decade = 10.0 ** floor(log10(value))
    return next((step * decade for step in steps if step * decade >= value * (1 - 1e-9)), 10 * steps[0] * decade)


def written_distance(mm: float) -> str:
    """Return a distance as people write it: ∞, metres from 1 m on, else millimetres; with an exponent beyond FAR_MM."""
    if isinf(mm):
        return "∞"
    if abs(mm) >= FAR_MM:
        return f"{mm / 1000:.4g} m"
    if abs(mm) >= 1000:
        return f"{significant(mm / 1000, 4)} m"
    return f"{significant(mm, 4)} mm"


def short_distance(mm: float, digits: int = 3) -> str:
    """Return a distance for a tick, with at most ``digits`` significant digits and no trailing zeros."""
    if isinf(mm):
        return "∞"
    return f"{mm / 1000:.{digits}g} m" if mm >= 1000 else f"{mm:.{digits}g} mm"


def distance_ticks(low: float) -> tuple[tuple[float, str], ...]:
    """Return round distances from ``low`` mm on and infinity with their texts, those that matter most first."""
    first = floor(log10(low))
    rounds = [step * 10.0**decade for step in (1, 2, 5) for decade in range(max(3, first + 3), first - 1, -1)]
    return tuple((mm, short_distance(mm)) for mm in (inf, *rounds) if mm >= low)


def told_apart(distances_mm: list[float]) -> list[str]:
    """Return the texts of distances for ticks, with three to seven digits: as few as tell all of them apart."""
    for digits in range(3, 8):
        words = [short_distance(mm, digits) for mm in distances_mm]
        if len(set(words)) == len(words):
            break
    return words


def significant(value: float, digits: int) -> str:
    """Return a number with a number of significant digits and no exponent, as tables want it."""
    if value == 0 or not isfinite(value):
        return f"{value:g}"
    places = max(0, digits - 1 - floor(log10(abs(value))))
    return f"{value:.{places}f}".replace("-", "−")


def with_sign(value: float, places: int) -> str:
    """Return a number with a true minus sign; a rounded zero has no sign."""
    text = f"{value:.{places}f}"
    return text.lstrip("-") if float(text) == 0 else text.replace("-", "−")


def written_r_squared(value: float) -> str:
    """Return R² with enough digits to keep 1 − R² readable; what would round to one is written as "> 0.9999"."""
    if value > 0.9999:
        return "> 0.9999"
    return f"{value:.4f}" if value > 0.99 else f"{value:.3f}".replace("-", "−")


def power_text(value: float) -> str:
    """Return a small number with its power of ten: "−1.5e−7"; zero is "0"."""
    digits, _, power = f"{value:.2e}".partition("e")
    return f"{float(digits):g}e{int(power)}".replace("-", "−") if value else "0"


MOST_PLACES = 4  # behind the point of a tick: an axis has no room for more


def ticks(low: float, high: float, most: float) -> list[tuple[float, str]]:
    """Return about ``most`` round values between two others, each with its text; never zero alone."""
    step = nice((high - low) / max(2.0, most))
    counts = _multiples(step, low, high)
    if len(counts) < 2:
        step = nice(step / 2.6)  # the round number below
        counts = _multiples(step, low, high)
        if len(counts) > 3:
            step, counts = 2 * step, _multiples(2 * step, low, high)
    places = max(0, -floor(log10(step) + 1e-9))
    write = with_sign if places <= MOST_PLACES else lambda value, _: power_text(value)
    return [(step * k, write(step * k, places)) for k in counts]


def _multiples(step: float, low: float, high: float) -> range:
    return range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)


def read_distance(text: str) -> float:
    """Return millimetres of "2 m", "350", "∞"; P2SFError otherwise."""
    plain = text.strip().lower()
    if plain in INFINITE:
        return inf
    number = plain.rstrip("abcdefghijklmnopqrstuvwxyzµ ")
    unit = plain[len(number) :].strip()
    if unit not in MM_PER_UNIT:
        raise P2SFError('the distance "{text}" has an unknown unit; write mm, cm, m or km, or ∞', text=text)
    return read_number(number, "distance") * MM_PER_UNIT[unit]


def read_f_number(text: str) -> float:
    """Return an f-number written bare or as photographers do, "f/5.6", "F5.6" or "1:5.6"; P2SFError otherwise."""
    return read_number(APERTURE.sub("", text), "f-number")


def one_reading(text: str, point: str) -> str:
    """Return a typed text; P2SFError if what stands before three digits may separate thousands, or decimals.

    ``point``: what stands before decimals in the language of the person; the other sign separates thousands there.
    """
    plain = text.strip()
    found = THOUSANDS.match(plain)
    if found and found[1] != point:
        raise P2SFError(
            '"{text}" can mean two numbers; write {thousands} or {decimals}',
            text=plain,
            thousands=plain.replace(found[1], "", 1),
            decimals=plain.replace(found[1], point, 1),
        )
    return text


def read_number(text: str, words: str, units: Mapping[str, float] = NO_UNIT) -> float:
    """Return the number that a person typed, in the quantity's own unit.

    A true minus, a decimal comma and ×10^ may be used. ``words`` name the quantity in English; ``units`` are the units
    that may follow the number, with their factors. Anything else raises P2SFError.
    """
    plain = text.strip().replace("−", "-").replace(",", ".").lower()
    plain = POWER.sub(lambda power: f"e{power[1].translate(RAISED)}", plain, count=1)
    found = NUMBER.fullmatch(plain)
    value, unit = (float(found[1]), found[2]) if found else (inf, "")
    if isinf(value):
        raise P2SFError(
            'the {quantity} "{text}" is not a number; write one such as 12.5',
            quantity=Message(words),
            text=text.strip(),
        )
    if unit not in units:
        known = tuple(name for name in units if name)
        raise P2SFError(
            'the {quantity} "{text}" has the unit "{unit}"; {remedy}',
            quantity=Message(words),
            text=text.strip(),
            unit=unit,
            remedy=Message("write {units} or no unit", units=known) if known else Message("write the number alone"),
        )
    return value * units[unit]
