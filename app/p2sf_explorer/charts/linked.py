"""Plots of A and B side by side: one range, one zoom, one crosshair, one scale of colours."""

from typing import TypeVar

from PySide6.QtWidgets import QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.colour_scale import ScaleLock
from p2sf_explorer.charts.plots import HeatMap
from p2sf_explorer.charts.view import Span

Kind = TypeVar("Kind", bound=QWidget)


def link(first: QWidget, second: QWidget) -> None:
    """Have the plots in two widgets of one kind follow each other's zoom and crosshair."""
    for one, other in pairs(first, second, Chart):
        for leads, follows in ((one, other), (other, one)):
            leads.zoomed.connect(follows.zoom_to)
            leads.pointed.connect(follows.point_at)
        other.zoom_to((one.x_axis.moved, one.y_axis.moved))


def share_scales(first: QWidget, second: QWidget) -> None:
    """Give the plots in two widgets of one kind one range and one scale of colours, which hold the data of both."""
    for one, other in pairs(first, second, Chart):
        x = union(one.x_axis.automatic, other.x_axis.automatic)
        y = union(one.y_axis.automatic, other.y_axis.automatic)
        for chart in (one, other):
            chart.share(x, y)
    for picture, beside in pairs(first, second, HeatMap):
        ends = common_ends(picture.bar.own_ends, beside.bar.own_ends)
        for shown in (picture, beside):
            shown.share_colours(ends)


def part(widget: QWidget) -> None:
    """Let the plots in a widget have their own range and colours again."""
    for chart in widget.findChildren(Chart):
        chart.share(None, None)
    for shown in widget.findChildren(HeatMap):
        shown.share_colours(None)


def pairs(first: QWidget, second: QWidget, kind: type[Kind]) -> tuple[tuple[Kind, Kind], ...]:
    """Return the parts of a kind that stand at the same places of two widgets; none where they differ in number."""
    ones, others = first.findChildren(kind), second.findChildren(kind)
    return tuple(zip(ones, others, strict=True)) if len(ones) == len(others) else ()


def union(one: Span, other: Span) -> Span:
    """Return the range from the lower to the higher end of two."""
    return min(one[0], other[0]), max(one[1], other[1])


def common_ends(one: ScaleLock | None, other: ScaleLock | None) -> ScaleLock | None:
    """Return the ends that hold both scales; None where they measure different things."""
    if one is None or other is None or not one.measure or one.measure != other.measure:
        return None
    return ScaleLock(one.measure, min(one.low, other.low), max(one.high, other.high))
