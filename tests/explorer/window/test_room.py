"""Little room, odd lenses and refusals: what is shown stays whole, sensible and in the window's own words."""

from math import inf

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QToolButton, QVBoxLayout, QWidget

from p2sf.errors import P2SFError
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.setting import Request
from p2sf_explorer.charts.painting import fitting, width_of
from p2sf_explorer.charts.plots import ColourBar, HeatMap
from p2sf_explorer.compute.glass_outlines import clear_rims, glass_of, still
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import default_state, load, paraxial_setup, shipped_names, with_lens
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.panels.lens_table.panel import LensTablePanel
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import new_state
from p2sf_explorer.widgets.card import Card, chooser
from p2sf_explorer.widgets.readout import BAR_AIR, Readout, Sentence
from p2sf_explorer.window.tabs import Tabs
from p2sf_explorer.window.window import MainWindow


@pytest.mark.parametrize("wrong", [{"depth_mm": -1.0}, {"f_number": 0.0}, {"focus_mm": 0.0}, {"stop": "x"}])
def test_no_option_of_the_command_line_is_left_in_a_sentence(wrong):
    with pytest.raises(P2SFError) as refused:
        Request(**wrong)
    assert "--" not in said(refused.value)


def test_the_banner_says_infinity_as_a_sign(window):
    window.store.update(depth_mm=-3.0)
    assert "∞" in window.banner.text.text() and "inf" not in window.banner.text.text()


@pytest.mark.parametrize("name", shipped_names())
def test_every_lens_opens_at_a_field_of_its_file(name):
    state = default_state(name)
    assert 0 < state.optics.field_deg <= max(map(abs, load(name).fields_deg))
    assert state.optics.depth_mm == np.inf or live(state, "preview").psf.method != "geometric"


def test_the_relay_opens_with_an_object_its_glass_can_see(window):
    state = default_state("relay")
    assert abs(paraxial_setup(state).object_y_mm) < 10
    rims = clear_rims(still(load("relay")))
    assert max(rims) < 25, "the file's 69 mm are more than its glass could have"
    for outline in glass_of(still(load("relay"))).outlines:
        half = len(outline.z) // 2
        assert np.isfinite(outline.z).all() and outline.z[:half].mean() < outline.z[half:].mean()


def test_no_other_lens_is_cut_by_its_edges():
    for name in set(shipped_names()) - {"relay"}:
        stated = [s.semi_diameter for s in load(name).surfaces]
        drawn = clear_rims(still(load(name)))
        assert all(d >= 0.9 * s or s == np.inf for d, s in zip(drawn, stated, strict=True)), name


def test_a_badge_with_little_room_is_short_and_not_cut(qapp):
    readout = Readout(pill=True)
    readout.set_text(
        "fitted · preview 7.1 / settled 77 ms · R² 0.9993 vs Huygens", short="fitted · 7.1/77 ms · R² 0.9993"
    )
    readout.resize(600, 20)
    assert readout._cut() == readout.text()
    readout.resize(220, 20)
    assert readout._cut() == "fitted · 7.1/77 ms · R² 0.9993"
    readout.resize(60, 20)
    assert readout._cut().endswith("…")


def test_no_fact_is_cut_where_the_banner_takes_room(window, qtbot):
    window.resize(1280, 800)
    window.store.update(depth_mm=-3.0)
    facts = window.controls.facts
    area = facts.parentWidget().parentWidget().parentWidget()
    qtbot.waitUntil(lambda: facts.height() == round(facts.ROW * len(facts._rows)))
    bar = area.verticalScrollBar()
    qtbot.waitUntil(lambda: bar.maximum() == 0 or bar.isVisible())
    air = lambda: area.viewport().width() - facts.mapTo(area, facts.rect().topRight()).x() - 1  # noqa: E731
    qtbot.waitUntil(lambda: air() == (BAR_AIR if bar.isVisible() else 0))
    window.resize(1440, 900)


@pytest.mark.parametrize("language", ["en", "de"])
def test_what_is_asked_first_is_seen_without_scrolling(only_window, language):
    set_language(language)
    try:
        made = MainWindow(new_state(theme="light", language=language), measured=False)
        made.resize(1280, 800)
        made.show()
        QApplication.processEvents()
        facts, area = made.controls.facts, made.controls.figures
        made.store.update(depth_mm=500.0, caption=())
        QApplication.processEvents()
        for name in ("Strehl ratio", "RMS wavefront", "Focal length", "Working f-number"):
            row = [row[0] for row in facts.rows].index(name)
            top = facts.mapTo(area.viewport(), facts._room(row).toRect().topLeft()).y()
            assert 0 <= top <= area.viewport().height() - facts.row, name
        assert not made.top.named.isVisible() and not made.top.method.isVisible()
        made.store.update(method="seidel")
        assert made.top.named.isVisible()
        assert made.top.method.currentText() != made.top.tolerance.text()
        made.close()
    finally:
        set_language("en")


def test_no_figure_stands_beside_the_controls_and_in_the_caption(window):
    """At infinity the working f-number is that of the slider; at 500 mm it is larger by the magnification."""

    def names():
        return {name for name, *_ in window.controls.facts.rows}

    window.store.update(depth_mm=inf)
    assert names() == {"Focal length"}
    window.store.update(depth_mm=500.0)
    assert names() == {"Focal length", "Working f-number"}
    window.store.update(caption=("lens", "rms"))
    assert names() == {"Focal length", "Working f-number", "Strehl ratio"}


def test_a_colour_bar_widens_for_its_longest_label_and_keeps_that_room(qapp):
    bar = ColourBar()
    usual = bar.sizeHint().width()
    bar.show_scale("CET-L4", "of light", ((0.0, "0"), (1.0, "0.181 %")))
    wide = bar.sizeHint().width()
    assert wide > usual and wide >= ColourBar.TICK + width_of("0.181 %")
    bar.show_scale("CET-L4", "of light", ((0.0, "0"), (1.0, "4 %")))
    assert bar.sizeHint().width() == wide


def test_the_contrast_fills_its_axis_and_marks_the_sensors_nyquist(window):
    window.store.update(tab="mtf", pixel_um=5.0, f_number=8.0)
    panel = window.panels["mtf"]
    (low, high), _ = panel.chart.ranges()
    cut_off = panel.curves["tangential"].data()[0][-1]
    assert low == 0.0 and 0.4 * high <= cut_off <= high, "an axis in round steps, filled by two fifths at least"
    assert panel.chart.uprights == ((100.0, "text"),)  # 1/(2·5 µm)


def test_the_spot_stands_in_a_square_beside_its_figures(window):
    window.store.update(tab="spot", field_deg=0.0)
    panel = window.panels["spot"]
    (left, right), (low, high) = panel.chart.ranges()
    assert right - left < 2 * (high - low), "no empty width"
    rows = {name: str(value) for name, value, _ in panel.facts.rows}
    assert rows["RMS in x"] == rows["RMS in y"], "round on the axis"
    both = np.hypot(*(float(rows[name].split()[0]) for name in ("RMS in x", "RMS in y")))
    assert both == pytest.approx(float(rows["RMS radius"].split()[0]), rel=1e-2)  # three digits each


def test_accuracy_says_what_will_be_there(window):
    window.open_panel("accuracy")
    panel = window.panels["accuracy"]
    assert panel.empty.isVisible() and "Huygens" in panel.empty.text()


def test_a_narrow_heat_map_keeps_its_picture_and_a_wide_one_its_colour_bar(qtbot):
    shown = HeatMap("x, µm", "y, µm")
    qtbot.addWidget(shown)
    for width, bar in ((176, False), (300, True), (176, False)):
        shown.resize(width, 200)
        shown.show()
        qtbot.waitUntil(lambda bar=bar: shown.bar.isVisible() is bar)
        qtbot.waitUntil(lambda width=width: shown.chart.area.width() > 0.55 * width)


def test_tools_that_do_not_fit_beside_the_title_stand_under_it(qtbot):
    card = Card("Pupil phase")
    qtbot.addWidget(card)
    card.add_tool(chooser((("waves", "W, waves"),), "How the phase is shown", card))
    card.set_body(QWidget())
    for width, below in ((180, True), (400, False)):
        card.resize(width, 200)
        card.show()
        qtbot.waitUntil(lambda below=below: (card.tools[0].y() > card.title.geometry().bottom()) is below)
        qtbot.waitUntil(lambda: card.title.width() >= card.title.sizeHint().width())


def test_a_label_that_is_too_long_leaves_out_what_stands_in_brackets(qapp):
    label = "y, µm (outwards)"
    assert fitting(label, 500) == label
    assert fitting(label, width_of(label) - 1) == "y, µm"
    assert fitting(label, width_of("y, µm") - 1) == "y"
    assert fitting("radius, µm", width_of("radius, µm") - 1) == "µm"
    assert fitting("energy within", width_of("energy within") - 1) == "energy"
    assert fitting("energy within", 12).endswith("…") and width_of(fitting("energy within", 12)) <= 12


def test_the_window_fits_a_screen_of_1920_by_1080_at_twice_the_size(window, qtbot):
    """That is 960 by 540 to a program: the column of controls scrolls, and no main panel is cut."""
    window.resize(960, 540)
    QApplication.processEvents()
    try:
        assert (window.width(), window.height()) == (960, 540)
        assert window.top.workspaces.menu.text() == "Explore" and not window.top.named.isVisible()
        row = [window.panels[key].widget for key in ("pupil", "psf", "coefficients")]
        for card in row:
            assert card.height() >= card.layout().minimumSize().height() and card.width() >= card.minimumWidth()
        button, before = window.controls.focus_button, window.controls.aiming.aim
        before.setFocus()
        qtbot.keyClick(before, Qt.Key.Key_Tab)
        assert not button.visibleRegion().isEmpty(), "what has the focus is scrolled to"
    finally:
        window.resize(1440, 900)
        QApplication.processEvents()
    assert window.top.workspaces.buttons["explore"].isVisible() and window.top.undo.accessibleName() == "Undo"


@pytest.mark.parametrize("language", ["en", "de"])
def test_every_groups_tabs_fit_a_small_window_and_no_column_of_the_lens_is_cut(window, language):
    set_language(language)
    try:
        tabs, table = Tabs(REGISTRY), LensTablePanel(window.store)
        tabs.setStyleSheet(window.styleSheet())
        tabs.resize(964, 200)  # what a window of 1280 pixels leaves them
        tabs.show()
        tabs.chosen.connect(tabs.bring_up)
        for button in tabs.buttons.named.values():
            button.click()
            QApplication.processEvents()
            assert not any(arrow.isVisible() for arrow in tabs.tabBar().findChildren(QToolButton)), button.text()
        head = table.view.horizontalHeader()
        assert all(head.sectionSize(k) >= head.sectionSizeHint(k) for k in range(head.count() - 1))
    finally:
        set_language("en")
        tabs.close()


def test_a_sentence_has_room_for_all_its_lines_when_it_becomes_narrower(qtbot):
    column = QWidget()
    qtbot.addWidget(column)
    words, rest = Sentence(column), QWidget(column)
    layout = QVBoxLayout(column)
    layout.addWidget(words)
    layout.addWidget(rest, 1)
    words.setText("mostly defocus: 94 % of the wavefront variance")
    column.show()
    heights = []
    for wide in (900, 160):
        column.resize(wide, 300)
        QApplication.processEvents()
        heights.append(words.height())
        assert words.height() >= words.heightForWidth(words.width())
    assert heights[1] > heights[0]


@pytest.mark.parametrize("percent", [100, 150])
def test_the_top_bar_shows_workspaces_beside_an_edited_lens_and_the_method_whole(window, percent):
    lens = lens_to_toml(find_lens("double_gauss_28"))
    window.store.replace(with_lens(window.store.state, "double_gauss_28", lens))
    window.store.update(scale_percent=percent, method="auto")
    window.resize(1280 * percent // 100, 800)
    QApplication.processEvents()
    top = window.top
    assert top.edited.isVisible() and top.workspaces.buttons["explore"].isVisible()
    assert top.method.width() >= top.method.sizeHint().width()
    window.resize(1000, 800)
    QApplication.processEvents()
    narrow = [part.geometry() for part in (top.lens, top.workspaces, top.more)]
    assert not top.workspaces.buttons["explore"].isVisible()
    top.fit()  # whose answer hangs on nothing but the room
    QApplication.processEvents()
    assert [part.geometry() for part in (top.lens, top.workspaces, top.more)] == narrow


@pytest.mark.parametrize("wide", [1280, 1920])
def test_the_top_bar_stays_in_place_while_b_is_pinned(window, qtbot, wide):
    window.resize(wide, 800)
    QApplication.processEvents()
    parts = window.top.workspaces, window.top.undo, window.top.pin
    before = [part.geometry() for part in parts]
    for pinned in (True, False):
        qtbot.mouseClick(window.top.pin, Qt.MouseButton.LeftButton)
        QApplication.processEvents()
        assert (window.store.state.compare.pinned is not None) == pinned == window.top.pin.isChecked()
        assert [part.geometry() for part in parts] == before
