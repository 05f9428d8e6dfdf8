"""Showing A − B in a panel that otherwise shows A or B: about zero, in two colours."""

import numpy as np

from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.plots import HeatMap
from p2sf_explorer.compute.live import Live

DIFFERENCE_MAP = "CET-D1A"
SMALLEST = 1e-6  # of the peak; pictures that differ by less are equal


def show_signed(
    heat: HeatMap,
    values: np.ndarray,
    rect: tuple[float, float, float, float],
    scale: str,
    unit: str,
    painted: np.ndarray | None = None,
) -> None:
    """Show a map of differences about zero over (x, y, width, height), linear or by their signed square root.

    ``painted``: the same map on finer samples, as it is coloured.
    """
    top = max(SMALLEST, float(np.nanmax(np.abs(values), initial=0.0)))
    scale_shown = ColourScale(
        DIFFERENCE_MAP,
        -top,
        top,
        unit=unit,
        quantity="A − B, share of the higher peak",
        stretch="linear" if scale == "linear" else "sqrt",
        measure="difference",
        steady=True,
        grounded=True,
    )
    heat.show_map(values, rect, scale_shown, painted)


def signed_range(live: Live, curves: dict[str, np.ndarray], usual: tuple[float, float]) -> tuple[float, float]:
    """Return the range of curves: about zero for A − B, as far as they reach, else the ``usual`` one."""
    if not live.difference:
        return usual
    top = max(SMALLEST, *(float(np.nanmax(np.abs(values), initial=0.0)) for values in curves.values()))
    return -top, top
