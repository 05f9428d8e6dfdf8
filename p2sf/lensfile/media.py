"""Media as a lens file of this program writes them: what `p2sf.glass.media` knows, and glasses of AGF catalogues."""

from p2sf.errors import GlassError
from p2sf.glass.media import Medium, parse_medium
from p2sf.lensfile.agf import FormulaGlass
from p2sf.lensfile.agf_formulas import COEFFICIENTS, DIRECT, SQUARED

KEYS = {"agf_formula", "coefficients", "range_um", "name"}


def read_medium(value) -> Medium:
    """Return the medium of a lens file's value; GlassError.

    Beside what `glass.parse_medium` reads: ``{agf_formula = 2, coefficients = […], range_um = [low, high],
    name = "…"}``, a glass of an AGF catalogue with its dispersion formula, so that the file stands alone.
    """
    if isinstance(value, dict) and "agf_formula" in value:
        return _formula_glass(value)
    return parse_medium(value)


def _formula_glass(table: dict) -> FormulaGlass:
    if set(table) != KEYS or not isinstance(table["name"], str):
        raise GlassError(f"glass has the keys {', '.join(table)}; write {', '.join(sorted(KEYS))}")
    formula, coefficients, limits = table["agf_formula"], table["coefficients"], table["range_um"]
    if (formula not in DIRECT and formula not in SQUARED) or not isinstance(formula, int):
        raise GlassError(f"agf_formula is {formula}; write a number from 1 to 13")
    if not _numbers(coefficients) or len(coefficients) > COEFFICIENTS:
        raise GlassError(f"coefficients of {table['name']} are not up to {COEFFICIENTS} numbers; correct them")
    if not _numbers(limits) or len(limits) != 2 or not 0 < limits[0] < limits[1]:
        raise GlassError(f"range_um of {table['name']} is {limits}; write the shortest and the longest wavelength")
    return FormulaGlass(table["name"], formula, tuple(map(float, coefficients)), tuple(map(float, limits)))


def _numbers(values) -> bool:
    plain = isinstance(values, list) and all(isinstance(x, int | float) and not isinstance(x, bool) for x in values)
    return plain and all(abs(x) < 1e100 for x in values)
