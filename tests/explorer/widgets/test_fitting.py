"""Names, values and choices that share a line: all can be read where there is room, and none is painted over."""

from dataclasses import replace

import pytest
from PySide6.QtGui import QFont, QFontMetricsF
from PySide6.QtWidgets import QApplication, QComboBox, QWidget

from p2sf.messages import Message
from p2sf_explorer.charts.theme import LIGHT, stylesheet
from p2sf_explorer.state.state import change
from p2sf_explorer.state.workspaces import WORKSPACES, on_stage, with_workspace
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import TurningRow
from p2sf_explorer.widgets.readout import Columns, FactTable
from p2sf_explorer.widgets.value_edit import ValueList

ROWS = (("secondary spherical aberration", Message("Z22: −0.0277 λ"), ""), ("piston", Message("Z1: 3.8658 λ"), ""))


def wide(words, px):
    font = QFont()
    font.setPixelSize(px)
    return QFontMetricsF(font).horizontalAdvance(words)


@pytest.mark.parametrize("scale", [1.0, 2.0])
@pytest.mark.parametrize("share", [1.0, 0.7, 0.3])
def test_a_name_is_cut_before_it_meets_its_value(qapp, scale, share):
    table = FactTable()
    table.restyle(replace(LIGHT, scale=scale))
    table.show_rows(ROWS)
    table.resize(round(share * table.sizeHint().width()), 40)
    px = round(12 * scale)
    for number, (name, _, _) in enumerate(ROWS):
        whole, shown = table._name(number)
        room = table.width() - wide(table.values[number], px)
        assert whole == name and (shown == name) == (wide(name, px) + 14 * scale <= room + 0.5)
        assert shown in ("", "…") or wide(shown, px) < room
    assert (table._name(0)[1] == ROWS[0][0]) == (share == 1.0)
    assert ("secondary spherical aberration" in table._tip(0)) == (share < 1.0), "the tooltip has the whole name"


def test_a_table_keeps_its_width_while_its_values_change(qapp):
    table = FactTable()
    table.show_rows(ROWS)
    first = table.sizeHint().width()
    table.show_rows((ROWS[0], ("piston", Message("Z1: 0.0 λ"), "")))
    assert table.sizeHint().width() == first
    table.show_rows((ROWS[0], ("piston", Message("Z1: " + 40 * "8" + " λ"), "")))
    assert table.sizeHint().width() > first


def test_tables_stand_below_one_another_where_a_name_would_be_cut(qapp):
    tables = FactTable(), FactTable()
    columns = Columns(tables)
    columns.restyle(LIGHT)
    for table in tables:
        table.show_rows(ROWS)
    needed = 2 * tables[0].sizeHint().width()
    for room, beside in ((needed + 60, True), (needed - 10, False), (needed + 60, True)):
        columns.resize(room, 300)
        columns.show()
        QApplication.processEvents()
        first, second = (table.geometry() for table in tables)
        assert (first.top() == second.top(), first.left() == second.left()) == (beside, not beside)
        assert not first.intersects(second)


@pytest.mark.parametrize("width", [60, 400])
def test_an_empty_readout_takes_no_line(qapp, width):
    card = Card("Overlays")
    card.resize(width, 200)
    card.show()
    QApplication.processEvents()
    bare = card.column.minimumSize().height()
    card.readout.hide()
    QApplication.processEvents()
    assert card.column.minimumSize().height() == bare
    card.readout.show()
    card.set_readout("Strehl 0.8")
    QApplication.processEvents()
    assert (card.column.minimumSize().height() > bare) == (width == 60), "below the title where it is narrow"


def test_a_panel_keeps_its_height_while_its_curves_arrive(window):
    window.open_panel("curves")
    QApplication.processEvents()
    heights, card = set(), window.panels["curves"].widget
    while window.is_busy():
        QApplication.processEvents()
        heights.add(card.height())
    assert len(heights) == 1 and window.panels["curves"].legend.text()


@pytest.mark.parametrize("size", [(600, 300), (300, 600)])
def test_charts_stand_along_the_longer_side(qapp, size):
    charts = QWidget(), QWidget()
    row = TurningRow(charts, (1, 1))
    row.resize(*size)
    row.show()
    QApplication.processEvents()
    first, second = (chart.geometry() for chart in charts)
    assert not first.intersects(second) and (first.top() == second.top()) == (size[0] > size[1])
    assert max(first.width(), first.height()) < 1.2 * min(first.width(), first.height())


@pytest.mark.parametrize("workspace", ["inspect", "explore"])  # on a wide stage, and on a narrow one
@pytest.mark.parametrize(("percent", "size"), [(100.0, (1280, 800)), (200.0, (2560, 1600))])
def test_every_choice_of_the_matrix_can_be_read(window, qtbot, percent, size, workspace):
    state = with_workspace(window.store.state, workspace, WORKSPACES[workspace])
    state = change(state, **on_stage(state.display, "matrix"))
    window.resize(*size)
    window.store.replace(change(state, scale_percent=percent))
    card = window.panels["matrix"].widget
    QApplication.processEvents()
    lists = card.findChildren(ValueList)
    assert [part.edit.text() for part in lists] == ["0; 10; 14°", "486.1; 587.6; 656.3 nm"]

    def cut():
        texts = [(part.edit, part.edit.text()) for part in lists]
        texts += [(box, box.currentText()) for box in card.findChildren(QComboBox) if box.isVisible()]
        return [text for box, text in texts if box.width() < box.fontMetrics().horizontalAdvance(text) + 10]

    qtbot.waitUntil(lambda: not cut())


@pytest.mark.parametrize("scale", [1.0, 2.0, 3.0])
def test_lengths_of_single_widgets_follow_the_type(scale):
    plain, large = stylesheet(LIGHT), stylesheet(replace(LIGHT, scale=scale))
    for selector, px in (("SetDialog", 560), ('QLineEdit#value[wide="true"]', 120), ("QTabBar::scroller", 36)):
        rule = next(line for line in large.splitlines() if line.strip().startswith(selector))
        assert f"width: {round(px * scale)}px" in rule
        assert any(line.strip().startswith(selector) and f"width: {px}px" in line for line in plain.splitlines())


def test_the_first_order_data_of_a_small_window_are_not_painted_over(window, qtbot):
    window.resize(1280, 800)
    window.store.replace(
        change(window.store.state, stage_share=0.5, **on_stage(window.store.state.display, "first_order"))
    )
    panel = window.panels["first_order"]

    def whole():
        return [table._name(k)[0] == table._name(k)[1] for table in panel.tables for k in range(len(table.rows))]

    qtbot.waitUntil(lambda: whole() and all(whole()))


def test_the_picture_of_image_takes_the_width_of_a_narrow_stage(window, qtbot):
    window.resize(1280, 800)
    state = with_workspace(window.store.state, "explore", WORKSPACES["explore"])
    window.store.replace(change(state, **on_stage(state.display, "image")))
    panel = window.panels["image"]
    qtbot.waitUntil(lambda: panel.split_view.width() > 0.9 * panel.widget.width())
    assert panel.look.width() > panel.look.fontMetrics().horizontalAdvance(panel.look.currentText())


def test_every_row_of_a_table_of_facts_is_written_in_its_own_line(qtbot):
    table = FactTable()
    qtbot.addWidget(table)
    table.show_rows(tuple((f"name {k}", Message("value"), "what it is") for k in range(4)))
    table.resize(300, table.height())
    image = table.grab().toImage()
    dark = [min(image.pixelColor(x, y).lightness() for x in range(300)) for y in range(image.height())]
    assert all(min(dark[round(k * table.row) : round((k + 1) * table.row)]) < 128 for k in range(4))
