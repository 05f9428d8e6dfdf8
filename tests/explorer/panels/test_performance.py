"""The panel of figures over the field, and the fields that it shares with the overlaid curves."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from p2sf import Camera
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import new_state
from tests.support.windows.windows import settled


@pytest.fixture
def panel(window, qtbot):
    window.store.update(tab="performance", f_number=8.0)
    made = window.panels["performance"]
    settled(made, qtbot)
    return made


def cells(panel) -> list[list[str]]:
    table = panel.table
    return [[table.item(row, k).text() for k in range(table.columnCount())] for row in range(table.rowCount())]


def test_it_shows_five_fields_by_itself_and_the_librarys_figures(window, panel):
    state, fields = window.store.state, panel._shown.fields_deg
    assert len(fields) == panel.table.rowCount() == 5
    points = Camera(paraxial_setup(state).lens).at(field_deg=fields, wavelength_nm=state.optics.wavelength_nm)
    found = points.performance(panel.table.table.frequency_per_mm)
    for row, cell in enumerate(cells(panel)):
        assert cell[1:4] == [
            f"{found['rms_waves'][row]:.3f}",
            f"{found['strehl'][row]:.3f}",
            f"{found['sagittal'][row, 0]:.3f}",
        ]
        assert cell[-1] == f"{found['lateral_colour_um'][row]:+z.2f}".replace("-", "−")


def test_fields_are_typed_and_shared_with_the_curves(window, panel, qtbot):
    panel.fields.listed.emit((0.0, 4.0, 9.5))
    settled(panel, qtbot)
    assert [row[0] for row in cells(panel)] == ["0", "4", "9.5"]
    window.store.update(tab="curves", curves_of="fields")
    settled(window.panels["curves"], qtbot)
    assert len(window.panels["curves"].found[1].names) == 3
    state = new_state(curves_fields_deg=(1.0, 2.0), curves_count=7)
    assert state_of_link(link(state)) == state


def test_seven_fields_have_seven_curves_of_their_own_colours(window, qtbot):
    window.store.update(tab="curves", curves_of="fields", curves_count=7, f_number=8.0)
    panel = window.panels["curves"]
    settled(panel, qtbot)
    drawn = {curve.token for curve in panel.curves if curve.x.size}
    assert len(drawn) == len(panel.found[1].names) == 7


def test_a_row_goes_to_its_field_and_the_present_one_is_chosen(window, panel, qtbot):
    panel.table.taken.emit(3)
    assert window.store.state.optics.field_deg == panel._shown.fields_deg[3]
    assert [index.row() for index in panel.table.selectionModel().selectedRows()] == [3]


def test_it_is_copied_with_all_its_digits(window, panel, qtbot):
    qtbot.mouseClick(panel.copy, Qt.MouseButton.LeftButton)
    lines = QApplication.clipboard().text().splitlines()
    assert len(lines) == 6 and len(lines[1].split(",")) == panel.table.columnCount()
    assert float(lines[1].split(",")[1]) == pytest.approx(panel.table.table.found[0].rms_waves, rel=1e-9)


def test_too_many_fields_are_refused(window, panel):
    before = window.store.state
    panel.fields.listed.emit(tuple(float(k) for k in range(13)))
    assert window.store.state == before and window.banner.isVisible()
