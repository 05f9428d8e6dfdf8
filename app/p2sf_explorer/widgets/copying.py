"""A panel's picture and its data, to the clipboard or into a file."""

import csv
import io
from typing import Protocol, cast

import numpy as np
from PySide6.QtCore import QBuffer, QIODevice, QMimeData, Qt
from PySide6.QtGui import QGuiApplication, QPixmap
from PySide6.QtWidgets import QApplication, QMenu, QTableView, QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.overlay import Overlay
from p2sf_explorer.charts.plots import HeatMap
from p2sf_explorer.charts.reading import pin_rows
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.readout import FactTable

QUICKLY = 85  # Qt's quality for the fastest compression of a PNG: a tenth more bytes in two thirds of the time
Rows = list[list[str]]


class HasRows(Protocol):
    """A widget that knows its own rows to copy."""

    def rows_of_data(self) -> Rows:
        """Return the rows, heads first."""


def copy_menu(card: QWidget) -> QMenu:
    """Return the menu of a panel: copy its picture, and its data where it has any."""
    menu = QMenu(card)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    menu.addAction(tr("Copy picture"), lambda: copy_picture(card))
    action = menu.addAction(tr("Copy data as CSV") + "\tCtrl+Shift+D", lambda: copy_data(card))
    action.setEnabled(bool(data_of(card)))
    return menu


def card_in_hand(window: QWidget, in_front: QWidget) -> QWidget:
    """Return the panel that has the focus, else the one under the pointer, else the one ``in_front`` of the tabs."""
    for found in (QApplication.focusWidget(), QApplication.widgetAt(window.cursor().pos())):
        widget: QWidget | None = found
        while widget is not None and widget.objectName() != "card":
            widget = widget.parentWidget()
        if widget is not None:
            return widget
    return in_front


def png_of(widget: QWidget) -> bytes:
    """Return a widget's picture as PNG."""
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    picture_of(widget).save(buffer, "PNG", QUICKLY)
    return bytes(buffer.data().data())


def picture_of(widget: QWidget) -> QPixmap:
    """Return a widget's picture with its pinned markers, without the crosshair of the moment."""
    for chart in widget.findChildren(Chart):
        chart.hand.point(None)
    return widget.grab()


def copy_picture(widget: QWidget) -> None:
    """Put a widget's picture on the clipboard."""
    QGuiApplication.clipboard().setPixmap(picture_of(widget))


def copy_data(widget: QWidget) -> bool:
    """Put a panel's data on the clipboard as CSV; return whether it has any."""
    text = data_of(widget)
    if text:
        data = QMimeData()
        data.setText(text)
        data.setData("text/csv", text.encode())
        QGuiApplication.clipboard().setMimeData(data)
    return bool(text)


def data_of(widget: QWidget) -> str:
    """Return what a panel shows as CSV (RFC 4180), one table after the other.

    Nothing where there are no numbers, and where an overlay covers those of an earlier set-up.
    """
    overlay = widget.findChild(Overlay, options=Qt.FindChildOption.FindDirectChildrenOnly)
    if overlay and overlay.text:
        return ""
    tables = [rows for part in [widget, *widget.findChildren(QWidget)] for rows in (table(part), markers(part)) if rows]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\r\n")
    for number, rows in enumerate(tables):
        if number:
            writer.writerow([])
        writer.writerows(rows)
    return out.getvalue()


def table(widget: QWidget) -> Rows:
    """Return the rows of one widget, heads first; widgets with a ``rows_of_data`` give their own."""
    if hasattr(widget, "rows_of_data"):
        return cast("HasRows", widget).rows_of_data()
    if isinstance(widget, Chart) and widget.grids:
        return [row for number, one in enumerate(widget.grids) for row in _apart(number) + grid(*one)]
    if isinstance(widget, HeatMap):
        return _of_heat_map(widget)
    if isinstance(widget, Chart) and not isinstance(widget.parentWidget(), HeatMap):
        return _of_chart(widget)
    if isinstance(widget, FactTable):
        return [[name, value] for (name, _, _), value in zip(widget.rows, widget.values, strict=True)]
    return _of_view(widget) if isinstance(widget, QTableView) else []


def markers(widget: QWidget) -> Rows:
    """Return the pinned markers of a chart, heads first."""
    if not isinstance(widget, Chart):
        return []
    return pin_rows([reading for _, reading in widget.pinned()], widget.reading_labels)


def _of_heat_map(heat: HeatMap) -> Rows:
    """Return the values behind the map: x along the first row, y down the first column, rows +y."""
    if heat.values is None or heat.rect_shown is None:
        return []
    rows, columns = heat.values.shape
    left, bottom, width, height = heat.rect_shown
    x = left + (np.arange(columns) + 0.5) * width / columns
    y = bottom + (np.arange(rows) + 0.5) * height / rows
    bottom_label, left_label = heat.chart.labels
    quantity = f"{tr(heat.quantity)}: " if heat.quantity else ""
    return grid(f"{quantity}{left_label} \\ {bottom_label}", x, y, heat.values)


def _apart(number: int) -> Rows:
    """Return an empty row before every table but the first."""
    return [[]] if number else []


def grid(head: str, x: np.ndarray, y: np.ndarray, values: np.ndarray) -> Rows:
    """Return (y, x) values with their places: x along the first row behind the head, y down the first column."""
    return [[head, *map(_number, x)], *([_number(at), *map(_number, row)] for at, row in zip(y, values, strict=True))]


def _of_chart(chart: Chart) -> Rows:
    """Return every curve that has points as two columns, its name in the head; only named ones if there are any."""
    shown = [curve for curve in chart.curves if curve.x.size and curve.token != "line"]
    shown = [curve for curve in shown if curve.name] or shown
    bottom, left = map(tr, chart.columns) if chart.columns else chart.labels
    names = [curve.name or f"{number}" for number, curve in enumerate(shown, 1)]
    head = [f"{name}: {label}" for name in names for label in (bottom, left)]
    columns = [values for curve in shown for values in (curve.x, curve.y)]
    longest = max((column.size for column in columns), default=0)
    body = [[_number(c[k]) if k < c.size else "" for c in columns] for k in range(longest)]
    return [head, *body] if columns else []


def _of_view(view: QTableView) -> Rows:
    """Return the cells of a table as they are shown."""
    model = view.model()
    if model is None:
        return []
    heads = [str(model.headerData(k, Qt.Orientation.Horizontal) or "") for k in range(model.columnCount())]
    cells = [[str(model.index(r, k).data() or "") for k in range(model.columnCount())] for r in range(model.rowCount())]
    return [heads, *cells]


def _number(value: float) -> str:
    return "" if np.isnan(value) else f"{float(value):.9g}"
