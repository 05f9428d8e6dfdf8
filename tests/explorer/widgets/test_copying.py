"""A panel's picture and numbers on the clipboard, and the printed page."""

import csv
import io
import re

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication

from p2sf_explorer.state.pinning import pin
from p2sf_explorer.widgets.copying import copy_menu, data_of, table
from tests.support.windows.windows import settled


def test_the_curves_of_the_panel_on_the_stage_are_copied_as_they_are(window, qtbot):
    window.store.update(f_number=8.0, field_deg=0.0, stage="profiles")  # the brightest point lies on the line
    qtbot.keyClick(window, Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    rows = list(csv.reader(io.StringIO(QGuiApplication.clipboard().text())))
    column = rows[0].index("along y: share of the peak")
    x, y = window.panels["profiles"].curves["along y"].data()
    assert y.max() == pytest.approx(1.0)
    read = np.array([[float(cell) for cell in row[column - 1 : column + 1]] for row in rows[1 : 1 + x.size]])
    assert read[:, 0] == pytest.approx(x, rel=1e-8) and read[:, 1] == pytest.approx(y, rel=1e-8, abs=1e-12)


def test_a_heat_map_is_copied_as_a_grid_with_its_places(window):
    window.store.update(psf_scale="linear")
    rows = list(csv.reader(io.StringIO(data_of(window.panels["psf"].widget))))
    psf = window.panels["psf"].psf_shown(window.live)
    count = psf.values.shape[0]
    grid = np.array([[float(cell) for cell in row] for row in rows[1 : count + 1]])
    np.testing.assert_allclose(grid[:, 1:], psf.values / psf.values.max(), rtol=1e-6, atol=1e-7)
    assert grid[:, 0] == pytest.approx(psf.x_um, abs=1e-5)
    assert [float(cell) for cell in rows[0][1:]] == pytest.approx(psf.x_um, abs=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("scale", ["sqrt", "log"])
def test_what_is_copied_is_light_and_not_brightness(window, scale):
    """A map is shown by root or logarithm; the numbers copied are the PSF's, in the bar's units."""
    window.store.update(psf_scale=scale, psf_units="sum", tab="beside", phase="contour")
    psf, maps = window.panels["psf"].psf_shown(window.live), window.panels["beside"].maps
    rows, grid = grid_of(window.panels["psf"].map)
    assert rows[0][0].startswith("PSF, sum = 1: y, µm") and grid == pytest.approx(psf.values, rel=1e-6, abs=1e-12)
    view = window.live.views["beside"].found
    for heat, values in zip(maps, (view.real, view.perfect, view.pixels), strict=True):
        assert grid_of(heat)[1] == pytest.approx(np.asarray(values), rel=1e-6, abs=1e-12)
    rows, grid = grid_of(window.panels["pupil"].map)
    waves = window.live.pupil.waves
    assert rows[0][0].startswith("W, waves: ") and grid == pytest.approx(waves, rel=1e-6, abs=1e-9, nan_ok=True)


def test_a_difference_is_copied_as_shares_of_the_higher_peak(window):
    window.store.replace(pin(window.store.state))
    window.store.update(f_number=8.0, shown="difference")
    rows, grid = grid_of(window.panels["psf"].map)
    assert rows[0][0].startswith("A − B") and grid == pytest.approx(window.live.difference.psf, rel=1e-6, abs=1e-9)


def grid_of(heat):
    """Return the rows of a map's CSV, and its numbers without their places."""
    rows = table(heat)
    return rows, np.array([[float(cell or "nan") for cell in row[1:]] for row in rows[1:]])


@pytest.mark.parametrize("key", ["coefficients", "lens", "first_order", "seidel", "spot", "ray_fan"])
def test_other_panels_have_their_numbers_too(window, key):
    window.open_panel(key) if key != "coefficients" else None
    text = data_of(window.panels[key].widget)
    assert sum(bool(re.search(r"\d", cell)) for row in csv.reader(io.StringIO(text)) for cell in row) >= 10


@pytest.mark.parametrize("key", ["through_focus", "field_map"])
def test_small_pictures_are_copied_as_one_grid_each(window, qtbot, key):
    window.open_panel(key)
    panel = window.panels[key]
    settled(panel, qtbot)
    asked, found = panel.found
    pictures = (found.light if key == "through_focus" else found).reshape(-1, *(asked.window[0],) * 2)
    kept = [picture for picture in pictures if np.isfinite(picture).any()]
    rows = list(csv.reader(io.StringIO(data_of(panel.widget))))
    heads = [k for k, row in enumerate(rows) if row and "\\" in row[0]]
    assert len(heads) == len(kept) > 5
    for at, picture in zip(heads, kept, strict=True):
        grid = np.array([[float(cell or "nan") for cell in row] for row in rows[at + 1 : at + 1 + asked.window[0]]])
        np.testing.assert_allclose(grid[:, 1:], picture, rtol=1e-6, atol=1e-9)
        assert grid[:, 0] == pytest.approx([float(cell) for cell in rows[at][1:]])
        assert grid[1, 0] - grid[0, 0] == pytest.approx(asked.window[1])


@pytest.mark.parametrize(
    ("key", "heads"),
    [
        ("layout", ["marginal rays, axial point: z, mm", "chief ray: y, mm"]),
        ("field", ["sagittal S: focus behind the sensor, mm", "distortion, third order: distortion, %"]),
        ("chromatic", ["0.7 of the pupil: focus, µm", "rim: wavelength, nm"]),
        ("depth_of_field", ["exact rays, this field: blur, µm"]),
    ],
)
def test_every_column_says_what_it_is(window, key, heads):
    window.open_panel(key)
    rows = list(csv.reader(io.StringIO(data_of(window.panels[key].widget))))
    found = [cell for row in rows for cell in row]
    assert set(heads) <= set(found) and not any(re.match(r"\d+: |^$|: $", cell) for cell in rows[0])


def test_a_panel_without_numbers_says_so(window, qtbot):
    window.take_stage("import")
    menu = copy_menu(window.panels["import"].widget)
    assert not menu.actions()[1].isEnabled()
    menu.deleteLater()
    told = []
    window.store.said.connect(told.append)
    qtbot.keyClick(window, Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    window.store.said.disconnect(told.append)
    assert [str(message) for message in told] == ["This panel has no numbers"]


def test_the_picture_on_the_clipboard_is_the_panel(window, qtbot):
    window.panels["psf"].map.chart.setFocus()
    widget = window.panels["psf"].widget
    menu = copy_menu(widget)
    first, second = menu.actions()
    assert second.isEnabled()
    first.trigger()
    assert QGuiApplication.clipboard().pixmap().size() == widget.grab().size()
    menu.deleteLater()
