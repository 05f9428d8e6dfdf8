"""What a complete trade says: Pareto fronts of error against bytes and time, and who is ahead at equal bytes."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import inf, isfinite
from statistics import median

from p2sf.studies.complete_trade import LensTrade, Row

GROUPS = {  # families that are told apart in pictures and tables, by what a legend calls them
    "six coefficients": ("seidel",),
    "fitted numbers": ("fitted 26", "fitted 46", "fitted adaptive"),
    "Zernike grid": ("Zernike grid",),
    "PSF grid": ("PSF grid",),
    "PCA": ("PCA",),
    "neural": ("neural",),
    "Gaussian, Moffat": ("Gaussian", "generalised Gaussian", "Moffat"),
    "traced": ("traced",),
    "huygens": ("huygens",),
}
OURS = "fitted numbers"
OTHERS = "Zernike grid", "PSF grid", "PCA", "neural", "Gaussian, Moffat", "six coefficients"
BUDGETS = 1024, 2048, 4096, 8192, 65536, 1048576  # bytes per lens
SMALLEST_ERROR = 1e-7  # below it sums of rays differ by their own rounding and sampling

Cost = Callable[[Row], float]


def nbytes(row: Row) -> float:
    """Return the bytes of a representation."""
    return float(row.nbytes)


def batch_us(row: Row) -> float:
    """Return the CPU time of a PSF among many, µs."""
    return row.batch_us


def error(row: Row) -> float:
    """Return the median relative L2 error, SMALLEST_ERROR at least."""
    return max(row.relative_l2.median, SMALLEST_ERROR)


def group_of(row: Row) -> str:
    """Return the group of a row's family."""
    return next(name for name, families in GROUPS.items() if row.family in families)


def front(rows: Iterable[Row], cost: Cost) -> list[Row]:
    """Return the Pareto front, cheapest first: rows that no other beats in both cost and median error."""
    best, out = inf, []
    for row in sorted(rows, key=lambda row: (cost(row), error(row))):
        if error(row) < best:
            best = error(row)
            out.append(row)
    return out


def within(rows: Iterable[Row], cost: Cost, budget: float) -> Row | None:
    """Return the row of the smallest median error that keeps a budget, None where none does."""
    kept = [row for row in rows if cost(row) <= budget]
    return min(kept, key=error) if kept else None


@dataclass(frozen=True)
class EqualBytes:
    """One lens and budget: the best row of our fitted numbers and of another group, None where it has none."""

    lens: str
    budget: int
    group: str
    ours: Row | None
    other: Row | None

    @property
    def ahead(self) -> float:
        """Return by what factor our median error is smaller; infinite where the other has nothing so small."""
        if self.ours is None:
            return 0.0
        return inf if self.other is None else error(self.other) / error(self.ours)


def equal_bytes(trade: LensTrade, groups: Sequence[str] = OTHERS) -> list[EqualBytes]:
    """Return the comparison of our fitted numbers with other groups at every budget."""
    found = []
    for budget in BUDGETS:
        ours = within((row for row in trade.rows if group_of(row) == OURS), nbytes, budget)
        for group in groups:
            other = within((row for row in trade.rows if group_of(row) == group), nbytes, budget)
            found.append(EqualBytes(trade.lens, budget, group, ours, other))
    return found


def typical(trades: Sequence[LensTrade], group: str, cost: Cost, budget: float) -> float:
    """Return the median over lenses of a group's best median error within a budget; inf where most have none."""
    best = (within((r for r in trade.rows if group_of(r) == group), cost, budget) for trade in trades)
    return median(inf if row is None else error(row) for row in best)


def findings(trades: Sequence[LensTrade]) -> list[dict[str, object]]:
    """Return what each lens's trade says, for JSON: places in ``rows`` on the fronts, and how far ours is ahead."""
    return [
        {
            "lens": trade.lens,
            "front_bytes": [trade.rows.index(row) for row in front(trade.rows, nbytes)],
            "front_time": [trade.rows.index(row) for row in front(trade.rows, batch_us)],
            "ahead": [
                {"bytes": one.budget, "of": one.group, "factor": one.ahead} for one in equal_bytes(trade) if one.other
            ],
        }
        for trade in trades
    ]


def summary(trades: Sequence[LensTrade]) -> list[tuple[str, ...]]:
    """Return a table, headings first: the typical error of each group by budget, and how far ours is ahead of it."""
    head = ("median error within", *(_bytes(budget) for budget in BUDGETS), "µs per PSF", "ours ahead at 8 kB")
    rows = []
    for group in GROUPS:
        errors = [typical(trades, group, nbytes, budget) for budget in BUDGETS]
        rows.append((group, *map(_error, errors), _times(trades, group), _ahead(trades, group)))
    return [head, *rows]


def _times(trades: Sequence[LensTrade], group: str) -> str:
    """Return the median over lenses of the time of the group's most exact row within a megabyte."""
    best = [within((r for r in trade.rows if group_of(r) == group), nbytes, BUDGETS[-1]) for trade in trades]
    known = [row.batch_us for row in best if row]
    return _two_digits(median(known)) if known else "–"


def _ahead(trades: Sequence[LensTrade], group: str) -> str:
    """Return the median and the smallest factor over lenses by which our fitted numbers are ahead at 8 kB."""
    if group not in OTHERS:
        return "–"
    found = [one.ahead for trade in trades for one in equal_bytes(trade, (group,)) if one.budget == 8192]
    known = [factor for factor in found if isfinite(factor)]
    return f"{_two_digits(median(known))} ×, at least {_two_digits(min(known))} ×" if known else "nothing so small"


def _two_digits(value: float) -> str:
    return f"{float(f'{value:.2g}'):.10g}"


def _bytes(budget: int) -> str:
    return f"{budget // 1024} kB" if budget < 2**20 else f"{budget // 2**20} MB"


def _error(value: float) -> str:
    return "–" if not isfinite(value) else f"{value:.1e}"


COST_COLUMNS = "numbers", "bytes", "made in s", "µs each", "µs alone"
ERROR_COLUMNS = "1 − R²", "rel. L2, half", "95 %", "worst", "worst at", "MTF, 95 %", "R80, 95 %"
COLUMNS = ("representation", "settings", *COST_COLUMNS, *ERROR_COLUMNS)


def lines(rows: Iterable[Row]) -> list[tuple[str, ...]]:
    """Return rows as text, in the order of COLUMNS."""
    return [_line(row) for row in rows]


def _line(row: Row) -> tuple[str, ...]:
    depth, field, wave = row.worst_at
    l2 = row.relative_l2
    cost = f"{row.build_seconds:.2g}", f"{row.batch_us:.3g}", f"{row.single_us:.3g}"
    errors = f"{row.one_less_r2.median:.1e}", f"{l2.median:.1e}", f"{l2.most:.1e}", f"{l2.worst:.1e}"
    place = f"{depth:.4g} mm, {field:.3g}°, {wave:.4g} nm"
    return (
        row.family, row.settings, str(row.numbers), str(row.nbytes), *cost, *errors, place,
        f"{row.mtf.most:.1e}", f"{row.r80.most:.1e}",
    )  # fmt: skip


def place_words(trade: LensTrade) -> str:
    """Return the space and the window of a trade in words."""
    space = trade.space
    opened = f"f/{space.f_number:g}, " if space.f_number else ""
    ranges = f"{space.near_mm:.4g} to {space.far_mm:.4g} mm, {space.fields_deg[0]:g} to {space.fields_deg[1]:.3g}°"
    waves = f"{space.wavelengths_nm[0]:.4g} to {space.wavelengths_nm[1]:.4g} nm"
    return f"{opened}{ranges}, {waves}; {space.pixels} × {space.pixels} pixels of {space.pixel_um:.3g} µm"
