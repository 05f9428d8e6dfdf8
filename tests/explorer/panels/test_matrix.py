"""The matrix in the window: it moves with the sliders, settles, and a click goes to a picture's point."""

from itertools import combinations

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtWidgets import QApplication

from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.methods import render
from p2sf_explorer.compute.framing import light_rings
from p2sf_explorer.compute.matrix.pictures import radius_figure
from p2sf_explorer.compute.matrix.points import nearest
from p2sf_explorer.panels.matrix.tile_charts import LightChart, LinesChart, TileGrid, arrange
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.state.state_files import state_from_json, state_to_json
from p2sf_explorer.state.workspaces import WORKSPACES, with_workspace
from tests.support.windows.events import choose
from tests.support.windows.windows import settled

QUICK = {"method": "seidel", "f_number": 8.0}


@pytest.fixture
def panel(window, qtbot):
    """Return the matrix's panel once all its pictures are settled."""
    window.store.update(tab="matrix", **QUICK)
    made = window.panels["matrix"]
    rested(made, qtbot)
    return made


def rested(panel, qtbot):
    settled(panel, qtbot)
    assert all(tile.settled for row in panel.shown[1] for tile in row)


def headings(panel):
    return [" ".join(chart.words.heading) for chart in panel.grid.charts]


def test_every_picture_is_labelled_and_the_present_one_is_marked(window, panel):
    assert headings(panel)[0] == "0° 486.1 nm" and headings(panel)[5] == "10° 656.3 nm"
    assert [chart.words.here for chart in panel.grid.charts] == ["", "", "", "", "exact", "", "", "", ""]
    assert all("Strehl" in chart.words.figure or "R80" in chart.words.figure for chart in panel.grid.charts)
    assert all("seidel" in chart.words.made for chart in panel.grid.charts) and "seidel" in panel.badge.text()
    window.store.update(field_deg=11.0)
    assert panel.grid.charts[4].words.here == "near"


def test_a_click_goes_to_the_point_and_undo_comes_back(window, panel, qtbot):
    before = window.store.state
    qtbot.mouseClick(panel.grid.chart(2, 0), Qt.MouseButton.LeftButton)
    here = window.store.state.optics
    assert (here.field_deg, round(here.wavelength_nm, 1)) == (14.0, 486.1)
    assert panel.grid.chart(2, 0).words.here == "exact" and panel.grid.chart(1, 1).words.here == ""
    window.store.undo()
    assert window.store.state == before and panel.grid.chart(1, 1).words.here == "exact"


def test_keys_go_from_picture_to_picture_and_enter_takes_one(window, panel, qtbot):
    first = panel.grid.chart(0, 0)
    first.setFocus()
    qtbot.keyClick(first, Qt.Key.Key_Right)
    qtbot.keyClick(QApplication.focusWidget(), Qt.Key.Key_Down)
    qtbot.keyClick(QApplication.focusWidget(), Qt.Key.Key_Down)
    assert QApplication.focusWidget() is panel.grid.chart(2, 1)
    qtbot.keyClick(QApplication.focusWidget(), Qt.Key.Key_Return)
    assert window.store.state.optics.field_deg == 14.0


def test_it_moves_with_the_slider_and_settles_when_that_rests(window, panel, qtbot):
    settled = panel.settled[0]
    with window.store.drag():
        for depth in (4000.0, 3000.0, 2000.0):
            window.store.update(depth_mm=depth)
            request, tiles = panel.shown
            assert request.states[0][0].optics.depth_mm == depth, "the picture of this very frame"
            assert not any(tile.settled for row in tiles for tile in row)
            assert panel.late.asked is None, "nothing is made in the background meanwhile"
    assert panel.late.asked == panel.shown[0] != settled
    rested(panel, qtbot)
    assert panel.settled[0].states[0][0].optics.depth_mm == 2000.0


def test_what_moves_again_ends_what_was_being_settled(window, panel):
    window.store.update(depth_mm=2500.0, method="huygens")
    assert panel.late.busy
    cancelled = panel.late._cancelled
    with window.store.drag():
        window.store.update(depth_mm=2600.0)
        assert cancelled.is_set()
        window.store.update(method="seidel")


@pytest.mark.parametrize("what", ["spot", "ray_fan", "opd_fan", "mtf", "pupil"])
def test_every_kind_has_its_picture(window, panel, qtbot, what):
    choose(panel.what, what)
    rested(panel, qtbot)
    assert panel.shown[0].what == what
    assert all(chart.words.figure and chart.words.extent for chart in panel.grid.charts)
    assert len({chart.words.extent for chart in panel.grid.charts}) == 1
    panel.shared.click()
    rested(panel, qtbot)
    assert len({chart.words.extent for chart in panel.grid.charts}) > 1 or what in ("opd_fan", "pupil")


def test_values_are_typed_and_counted(window, panel, qtbot):
    panel.fields.edit.setFocus()
    panel.fields.edit.selectAll()
    qtbot.keyClicks(panel.fields.edit, "0; 2,5; 5°; 7.5")
    qtbot.keyClick(panel.fields.edit, Qt.Key.Key_Return)
    assert window.store.state.matrix.fields_deg == (0.0, 2.5, 5.0, 7.5)
    assert panel.grid.shape == (4, 3) and panel.fields.count.currentData() == 4
    panel.fields.edit.selectAll()
    qtbot.keyClicks(panel.fields.edit, "0; near")
    qtbot.keyClick(panel.fields.edit, Qt.Key.Key_Return)
    assert window.banner.isVisible() and "near" in window.banner.text.text()
    assert window.store.state.matrix.fields_deg == (0.0, 2.5, 5.0, 7.5)
    panel.fields.count.setCurrentIndex(0)
    panel.fields.count.activated.emit(0)
    assert window.store.state.matrix.rows == 2 and panel.shown[0].rows == (0.0, 14.0)


def test_depths_are_typed_with_their_units(window, panel, qtbot):
    window.store.update(matrix_across="depth_mm")
    panel.values.edit.setFocus()
    panel.values.edit.selectAll()
    qtbot.keyClicks(panel.values.edit, "1 m; 2500; inf")
    qtbot.keyClick(panel.values.edit, Qt.Key.Key_Return)
    assert window.store.state.matrix.depths_mm == (1000.0, 2500.0, float("inf"))
    assert headings(panel)[:3] == ["0° 1 m", "0° 2.5 m", "0° ∞"]


@pytest.mark.slow
def test_a_and_b_stand_side_by_side_and_a_click_goes_to_either(window, panel, qtbot):
    window.store.update(matrix_across="side")
    assert "Ctrl+B" in panel.badge.text() and panel.grid.shape == (3, 1)
    window.store.replace(change(window.store.state, pinned=new_state(method="seidel", f_number=16.0, field_deg=3.0)))
    rested(panel, qtbot)
    assert headings(panel) == ["0° A", "0° B", "10° A", "10° B", "14° A", "14° B"]
    qtbot.mouseClick(panel.grid.chart(2, 1), Qt.MouseButton.LeftButton)
    state = window.store.state
    assert state.compare.shown == "b" and state.compare.pinned.optics.field_deg == 14.0
    assert state.optics.field_deg == 10.0 and panel.grid.chart(2, 1).words.here == "exact"
    qtbot.mouseClick(panel.grid.chart(0, 0), Qt.MouseButton.LeftButton)
    state = window.store.state
    assert state.compare.shown == "a" and state.optics.field_deg == 0.0
    assert panel.grid.chart(0, 0).words.here == "exact"
    window.store.undo()
    assert window.store.state.compare.shown == "b", "one step"


def test_the_matrix_is_part_of_the_state():
    state = new_state(
        matrix_what="mtf", matrix_across="depth_mm", matrix_depths_mm=(500.0, float("inf")), matrix_shared=False
    )
    assert state_from_json(state_to_json(state)) == state == state_of_link(link(state))
    assert state_from_json(state_to_json(new_state())).matrix == new_state().matrix


@pytest.mark.parametrize(
    "wrong",
    [
        *({"matrix_rows": 1}, {"matrix_columns": 6}, {"matrix_fields_deg": (5.0,)}, {"matrix_what": "zernike"}),
        *({"matrix_depths_mm": (1.0, -2.0)}, {"matrix_wavelengths_nm": (500.0, float("nan"))}, {"matrix_shared": 1}),
    ],
)
def test_a_value_that_cannot_be_is_refused_and_changes_nothing(window, wrong):
    before = window.store.state
    window.store.update(**wrong)
    assert window.banner.isVisible() and window.store.state == before


@pytest.mark.parametrize("square", [True, False])
@pytest.mark.parametrize("shape", [(2, 2), (3, 3), (3, 5), (5, 5), (3, 1)])
@pytest.mark.parametrize("room", [(650, 180), (1000, 640), (2600, 1700), (400, 900)])
def test_charts_stand_within_their_room_and_beside_each_other(room, shape, square):
    places, narrow = arrange(room, shape, 16, (6, 14), square)
    assert len(places) == shape[0] * shape[1] and min(p.width() for p in places) > 8
    assert all(QRect(0, 0, room[0] + 1, room[1] + 1).contains(place) for place in places)
    assert not any(a.intersects(b) for a, b in combinations(places, 2))
    if narrow:
        assert [p.x() for p in places] == sorted(p.x() for p in places)


@pytest.mark.parametrize(("size", "least"), [((1280, 800), 150), ((1920, 1080), 240), ((3840, 2160), 480)])
def test_on_the_stage_nine_pictures_fill_it(window, panel, qtbot, size, least):
    state = window.store.state
    window.store.replace(with_workspace(state, "inspect", WORKSPACES["inspect"]))
    window.resize(*size)
    QApplication.processEvents()
    assert window.width() == size[0] and window.store.state.display.stage == "matrix"
    for chart in panel.grid.charts:
        area = chart.area
        assert min(area.width(), area.height()) >= least and isinstance(chart, LightChart)
        assert chart.rect().contains(area.toRect())
    window.store.replace(state)


def test_in_the_rail_pictures_and_controls_have_room(window, panel):
    window.resize(1280, 800)
    QApplication.processEvents()
    assert all(min(chart.area.width(), chart.area.height()) > 30 for chart in panel.grid.charts)
    parts = (panel.what, panel.across, panel.fields, panel.values, panel.shared, panel.scale, panel.badge)
    assert all(part.visibleRegion().boundingRect().height() >= part.minimumSizeHint().height() for part in parts)
    edit = panel.values.edit
    assert edit.fontMetrics().horizontalAdvance(edit.text()) < edit.width() - 8, "three colours and their unit"


def test_zoom_of_one_is_that_of_all_on_one_scale(window, panel, qtbot):
    first, last = panel.grid.charts[0], panel.grid.charts[-1]
    first.zoom(first.area.center(), 0.5)
    assert last.ranges() == first.ranges() and last.moved
    before = window.store.state
    qtbot.mouseClick(last, Qt.MouseButton.LeftButton, pos=last.area.center().toPoint())
    assert window.store.state == before and len(last.pins) == 1, "there a click pins a marker"
    qtbot.mouseClick(last, Qt.MouseButton.LeftButton, pos=QPoint(20, 5))
    assert window.store.state.optics.field_deg == 14.0, "and one on the heading goes to the point"
    last.go_home()
    last.unpin_all()
    assert not first.moved


@pytest.mark.parametrize("what", ["psf", "pupil"])
def test_what_is_read_is_the_sample_under_the_pointer(window, panel, qtbot, what):
    window.store.update(matrix_what=what)
    rested(panel, qtbot)
    chart, content = panel.grid.chart(1, 2), panel.shown[1][1][2].content
    rows, columns = content.values.shape
    wide = content.width_um if what == "psf" else 2.0
    row, column = rows // 2 + 9, columns // 2 - 4
    if what == "psf":  # sample N/2 is the chief ray
        x, y = ((k - n // 2) * wide / n for k, n in ((column, columns), (row, rows)))
    else:
        x, y = ((2 * k + 1 - n) / n for k, n in ((column, columns), (row, rows)))
    reading = chart.read(x, y)
    assert reading.values[0].number == pytest.approx(float(content.values[row, column]), rel=1e-6)


def test_the_frame_does_not_depend_on_what_is_shown(window, panel):
    request = panel.shown[0]
    assert nearest(request, window.store.state)[:2] == (1, 1)


def test_curves_have_a_legend_and_pictures_have_none(window, panel, qtbot):
    assert panel.widget.readout.text() == ""
    for what, names in (("ray_fan", {"sagittal", "tangential"}), ("mtf", {"perfect lens", "sagittal", "tangential"})):
        window.store.update(matrix_what=what)
        rested(panel, qtbot)
        assert all(name in panel.widget.readout.text() for name in names)
    window.store.update(matrix_what="psf")
    rested(panel, qtbot)
    assert panel.widget.readout.text() == ""


@pytest.mark.parametrize("pixel_um", [0.5, 1.7])
def test_radii_have_the_digits_of_the_profiles(pixel_um):
    """Three significant digits, as *Profiles* writes R80."""
    psf = render(find_lens("double_gauss_28"), Source(field_deg=7), "fitted", pixels=256, pixel_um=pixel_um)
    rings = light_rings(psf.values, psf.pixel_um)
    assert str(radius_figure(psf, rings).values["radius"]) == f"{rings.radius_of(0.8):.3g}"


@pytest.mark.parametrize("size", [(1200, 500), (500, 900)])
def test_charts_of_curves_fill_the_room_there_is(qtbot, size):
    """Nine of them: the last ends where the room does, to the pixel that rounding leaves."""
    grid = TileGrid()
    qtbot.addWidget(grid)
    grid.resize(*size)
    grid.build(LinesChart, (3, 3))
    first, last = grid.charts[0].geometry(), grid.charts[-1].geometry()
    assert (first.x(), first.y()) == (0, 0)
    assert size[0] - 1 <= last.x() + last.width() <= size[0] and size[1] - 1 <= last.y() + last.height() <= size[1]
