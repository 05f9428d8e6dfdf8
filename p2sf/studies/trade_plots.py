"""Pictures of complete trades: median error against bytes and against time, of one lens or typical of many."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from p2sf.studies.complete_trade import LensTrade
from p2sf.studies.trade_fronts import GROUPS, Cost, batch_us, error, front, group_of, nbytes, place_words, typical

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARKERS = "vosD^PX*p"
AXES: tuple[tuple[str, Cost, tuple[float, float]], ...] = (
    ("bytes of all PSFs of a lens", nbytes, (30.0, 2e6)),
    ("CPU time of a PSF among many, µs", batch_us, (8.0, 3e5)),
)
STEPS = 160  # budgets along an axis


def draw_trades(handle: BinaryIO, trades: Sequence[LensTrade]) -> None:
    """Write error against bytes and against time as a PNG into an open binary file.

    One lens: every representation, the Pareto front marked. Several: the best that each group does within a budget,
    median over the lenses.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.6, 4.6), dpi=150, layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    for axes, (label, cost, ends) in zip(panels, AXES, strict=True):
        axes.set(xscale="log", yscale="log", xlabel=label)
        axes.grid(alpha=0.3)
        if len(trades) == 1:
            _points(axes, trades[0], cost)
        else:
            _steps(axes, trades, cost, ends)
    panels[0].set_ylabel("relative L2 error, median over unseen points")
    figure.suptitle(_title(trades), x=0.01, ha="left", fontsize=9)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right center", fontsize=7)
    figure.savefig(handle, format="png")


def _title(trades: Sequence[LensTrade]) -> str:
    if len(trades) == 1:
        return f"{trades[0].title}: {place_words(trades[0])}"
    return f"All PSFs of a lens by every representation: the best within a budget, median of {len(trades)} lenses"


def _points(axes: "Axes", trade: LensTrade, cost: Cost) -> None:
    for number, (group, marker) in enumerate(zip(GROUPS, MARKERS, strict=True)):
        some = [row for row in trade.rows if group_of(row) == group]
        place = [cost(row) for row in some], [error(row) for row in some]
        axes.plot(*place, marker, color=f"C{number}", linestyle="none", markersize=4, label=group)
    best = front(trade.rows, cost)
    axes.plot([cost(r) for r in best], [error(r) for r in best], "-", color="0.5", linewidth=1, zorder=0, label="front")


def _steps(axes: "Axes", trades: Sequence[LensTrade], cost: Cost, ends: tuple[float, float]) -> None:
    budgets = np.geomspace(*ends, STEPS)
    for number, (group, marker) in enumerate(zip(GROUPS, MARKERS, strict=True)):
        errors = np.array([typical(trades, group, cost, budget) for budget in budgets])
        errors[np.isinf(errors)] = np.nan
        new = np.flatnonzero(np.isfinite(errors) & (np.diff(errors, prepend=np.inf) != 0))
        axes.step(budgets, errors, where="post", color=f"C{number}", linewidth=1)
        axes.plot(budgets[new], errors[new], marker, color=f"C{number}", linestyle="none", markersize=4, label=group)
