"""Compare the built-in glasses with AGF catalogues: the largest difference in index per maker, and all above 1e-5.

``python -m tests.long.glass_catalogues FILE.agf …`` compares at F, d and C and at the ends of the range that both have.
The maker is the first word of the file's name. AGF formulas are evaluated here, from the text, by a few lines of their
own. Exit code 1 where a difference above 1e-5 has no reason in `REASONS`.
"""

import re
import sys
from math import sqrt
from pathlib import Path

from p2sf.errors import GlassError
from p2sf.glass.catalogue import find_entry
from p2sf.glass.media import CatalogueGlass

ABOVE = 1e-5
LINES = {"F": 0.4861327, "d": 0.5875618, "C": 0.6562725}
POWERS = {1: (2, -2, -4, -6, -8), 10: (2, -2, -4, -6, -8, -10, -12), 12: (2, -2, -4, -6, -8, 4, 6)}
POWERS[13] = (2, 4, -2, -4, -6, -8, -10, -12)
REASONS = {
    "LZOS": "the catalogue's formula is fitted to the maker's table, at some to its misprints; the table counts",
    "CDGM": "the database has the maker's later edition",
    "HOYA M-TAF1": "the catalogue of 2022, of the maker, counts",
    "HOYA MC-TAF1": "the catalogue of 2022, of the maker, counts",
    "HOYA E-FL6": "the catalogue of 2022, of the maker, counts",
    "OHARA L-BBH1": "the database has the maker's later edition",
    "OHARA L-TIM28": "the database has the maker's later edition",
    "OHARA L-LAH84": "the database has the maker's later edition",
    "OHARA L-LAH53": "the database has the maker's later edition",
    "SUMITA K-GIR79": "the later edition, 1.85920, counts",
    "LIGHTPATH BD-2": "the database has the maker's table",
}


def index_at(formula: int, c: list[float], wave: float) -> float:
    """Return n of an AGF formula, by the sheet of formulas of OpticStudio's manual."""
    square, c = wave * wave, [*c, *[0.0] * 12]
    if formula in POWERS:
        return sqrt(c[0] + sum(a * wave**power for a, power in zip(c[1:], POWERS[formula], strict=False)))
    if formula in (2, 6, 11):
        pairs = {2: 3, 6: 4, 11: 5}[formula]
        return sqrt(1 + sum(c[2 * k] * square / (square - c[2 * k + 1]) for k in range(pairs) if c[2 * k]))
    if formula == 3:
        pole = 1 / (square - 0.028)
        return c[0] + c[1] * pole + c[2] * pole**2 + c[3] * square + c[4] * square**2 + c[5] * square**3
    if formula == 4:
        return sqrt(1 + c[0] + c[1] * square / (square - c[2] ** 2) + c[3] / (square - c[4] ** 2))
    if formula == 5:
        return c[0] + c[1] / wave + c[2] / wave**3.5
    if formula in (7, 8):
        return sqrt(c[0] + c[1] * (square if formula == 8 else 1) / (square - c[2]) - c[3] * square)
    return sqrt(c[0] + c[1] * square / (square - c[2]) + c[3] * square / (square - c[4]))


def entries(path: Path) -> list[tuple[str, int, list[float], tuple[float, float]]]:
    """Return name, formula, coefficients and range of every glass of a catalogue."""
    data = path.read_bytes()
    text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "latin-1")
    found, name, formula, c, last = [], "", 0, [], []
    for words in map(str.split, text.splitlines()):
        if words[:1] == ["NM"]:
            name, formula = words[1], int(float(words[2]))
        elif words[:1] == ["CD"]:
            c = [float(word) for word in words[1:]]
        elif words and words[0][0] in "+-.0123456789" and last == ["CD"]:
            c += [float(word) for word in words]  # some makers' files wrap the coefficients
            continue
        elif words[:1] == ["LD"]:
            found.append((name, formula, c, (float(words[1]), float(words[2]))))
        last = words[:1]
    return found


def differences(maker: str, entry: tuple) -> dict[str, float] | None:
    """Return the differences at the lines and the ends of the common range, None for a glass that is not built in."""
    name, formula, c, (low, high) = entry
    try:
        glass = CatalogueGlass(find_entry(f"{maker} {name}"))
    except GlassError:
        return None
    own_low, own_high = glass.range_um
    waves = {**LINES, "shortest": max(low, own_low), "longest": min(high, own_high)}
    inside = {at: wave for at, wave in waves.items() if max(low, own_low) <= wave <= min(high, own_high)}
    return {at: float(glass.index(wave)) - index_at(formula, c, wave) for at, wave in inside.items()}


def main(paths: list[str]) -> int:
    unexplained = 0
    for path in map(Path, paths):
        maker = re.split(r"[^A-Z]", path.stem.upper())[0].replace("NIKON", "HIKARI")
        rows = [(entry[0], differences(maker, entry)) for entry in entries(path)]
        known = [(max(map(abs, found.values()), default=0.0), name, found) for name, found in rows if found is not None]
        missing = sum(found is None for _, found in rows)
        worst = {
            at: max((abs(found.get(at, 0.0)) for *_, found in known), default=0.0)
            for at in (*LINES, "shortest", "longest")
        }
        print(
            f"{path.name}: {len(known)} glasses, {missing} not built in;",
            *(f"{at} {value:.1e}" for at, value in worst.items()),
        )
        for largest, name, found in sorted(known, reverse=True, key=lambda item: item[0]):
            if largest > ABOVE:
                reason = REASONS.get(f"{maker} {name}", REASONS.get(maker, ""))
                unexplained += not reason
                print(f"  {name}", *(f"{at} {value:+.1e}" for at, value in found.items()), reason or "NO REASON")
    print(f"{unexplained} differences above {ABOVE:g} without a reason")
    return int(unexplained > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
