"""Showing A − B in a panel that otherwise shows A or B: about zero, in two colours."""

import numpy as np

from p2sf_explorer.charts.plots import HeatMap
from p2sf_explorer.compute.live import Live
from p2sf_explorer.state.scales import nice

DIFFERENCE_MAP = "CET-D1A"
SMALLEST = 1e-6  # of the peak; pictures that differ by less are equal
STEPS = (1, 1.5, 2, 3, 5, 7)


def limit(*values: np.ndarray) -> float:
    """Return a round number that no magnitude exceeds."""
    return nice(max(SMALLEST, *(float(np.nanmax(np.abs(v), initial=0.0)) for v in values)), STEPS)


def show_signed(
    heat: HeatMap, values: np.ndarray, rect: tuple[float, float, float, float], scale: str, unit: str
) -> None:
    """Show a map of differences about zero over (x, y, width, height), linear or by their signed square root."""
    top, power = limit(values), 1 if scale == "linear" else 2
    heat.set_map(DIFFERENCE_MAP)
    heat.show_values(np.sign(values) * np.abs(values / top) ** (1 / power), (-1.0, 1.0), rect)
    heat.means(values, "A − B, share of the higher peak")
    parts = [(0.5, top * 0.5**power), (1.0, top)]
    ends = ((-1, "−"), (1, "+"))
    labels = (((1 + side * part) / 2, f"{sign}{value:.2g}") for side, sign in ends for part, value in parts)
    heat.bar.show_scale(DIFFERENCE_MAP, unit, ((0.5, "0"), *labels))


def signed_range(live: Live, curves: dict[str, np.ndarray], usual: tuple[float, float]) -> tuple[float, float]:
    """Return the range for curves: about zero for A − B, else the ``usual`` one."""
    if not live.difference:
        return usual
    top = 1.04 * limit(*curves.values())
    return -top, top
