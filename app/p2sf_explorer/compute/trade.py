"""What the complete trade has measured of the lens on show: error and time of each method over all its PSFs. No Qt."""

from dataclasses import dataclass

from p2sf.studies.complete_trade import LensTrade, Row, Spread, shipped_trades
from p2sf_explorer.compute.method_bounds import PredictedCost
from p2sf_explorer.state.state import State

# Families of the trade, by the method that the window offers; from fast to exact.
FAMILIES = {
    "seidel": "seidel",
    "fitted 26": "fitted",
    "fitted 46": "fitted",
    "fitted adaptive": "fitted",
    "traced": "traced",
    "huygens": "huygens",
}
# The slider's measures, as rows have them.
MEASURES = {"r2": "one_less_r2", "mtf": "mtf", "r80": "r80", "hdr": "one_less_r2", "time": "one_less_r2"}
SMALLEST = 1e-8  # below it errors of rays are those of their own rounding


@dataclass(frozen=True)
class TradeCurve:
    """One family at its most exact: the method it belongs to, how it was made, its time alone, ms, and its errors."""

    family: str
    method: str
    settings: str
    milliseconds: float
    row: Row

    def errors(self, measure: str) -> Spread:
        """Return the errors in a measure of the slider, SMALLEST at least."""
        found: Spread = getattr(self.row, MEASURES[measure])
        return Spread(*(max(value, SMALLEST) for value in (found.median, found.most, found.worst)))


def trade_of(state: State) -> LensTrade | None:
    """Return the complete trade of a state's lens; None of a lens that is not shipped, or was changed."""
    return None if state.optics.lens_text else shipped_trades().get(state.optics.lens)


def curves(trade: LensTrade) -> tuple[TradeCurve, ...]:
    """Return each method's most exact row of a trade, from fast to exact."""
    found = []
    for family, method in FAMILIES.items():
        rows = [row for row in trade.rows if row.family == family]
        if rows:
            best = min(rows, key=lambda row: row.relative_l2.median)
            found.append(TradeCurve(family, method, best.settings, best.single_us / 1e3, best))
    return tuple(found)


def typical_costs(found: tuple[TradeCurve, ...]) -> tuple[PredictedCost, ...]:
    """Return what methods cost over the whole lens: the time alone, and the 1 − R² that 95 % of the PSFs keep."""
    return tuple(PredictedCost(curve.method, curve.milliseconds, curve.errors("r2").most) for curve in found)
