"""The wavefront as a surface: what is seen of wavefronts whose shape is known, and how it is turned."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from p2sf.pupil.wavefront_map import disc
from p2sf_explorer.charts.surface_plot import HALF, HEIGHT, SurfaceView, Viewpoint, surface_picture
from p2sf_explorer.state.camera import SceneCamera
from p2sf_explorer.widgets.copying import data_of

COUNT = 200
PIXEL = 2 * HALF / COUNT
Y = (np.arange(COUNT) + 0.5) * PIXEL - HALF


def seen(function, turn, tilt, limit=10.0):
    xi, eta, inside = disc(96)
    return surface_picture(np.where(inside, function(xi, eta), np.nan), limit, Viewpoint(turn, tilt, COUNT)).waves


def column(waves, x=0.0):
    return waves[:, int((x + HALF) / PIXEL)]


def test_the_bowl_of_defocus_is_as_high_at_its_rim_as_its_waves():
    tilt, high = np.deg2rad(30.0), HEIGHT * 8.0 / 10.0
    middle = column(seen(lambda x, y: 8.0 * (x * x + y * y), 0.0, 30.0))
    shown = np.isfinite(middle)
    deepest = -np.tan(tilt) / (2 * high)  # where the line of sight touches the under side of D·sin + high·D²·cos
    ends = deepest * np.sin(tilt) + high * deepest**2 * np.cos(tilt), np.sin(tilt) + high * np.cos(tilt)
    # the map's outermost samples lie half a sample, 1/96, inside the rim, where a bowl of 8 λ is 0.17 λ lower
    assert (Y[shown][0], Y[shown][-1]) == pytest.approx(ends, abs=2 * PIXEL)
    assert middle[shown][-1] == pytest.approx(8.0, abs=0.4)
    assert np.nanmin(middle) == pytest.approx(0.0, abs=0.05)


def test_a_ridge_hides_the_plain_behind_it():
    middle = column(seen(lambda x, y: np.where(np.abs(y + 0.2) < 0.1, 10.0, 0.0), 0.0, 20.0))
    assert (middle[(Y > 0.0) & (Y < 0.3)] > 5.0).all()
    behind = column(seen(lambda x, y: np.where(np.abs(y + 0.2) < 0.1, 0.0, 0.0), 0.0, 20.0))
    assert (behind[(Y > 0.0) & (Y < 0.3)] == 0.0).all()


def test_what_is_vignetted_is_not_there():
    shown = np.isfinite(seen(lambda x, y: np.where(y > 0.4, np.nan, 0.0), 0.0, 90.0))
    step = 2 / 96 + 2 / (COUNT // 2)  # a sample of the map and a slice
    assert Y[column(shown)][-1] == pytest.approx(0.4, abs=step)
    assert Y[column(shown)][0] == pytest.approx(-1.0, abs=PIXEL)
    assert not shown[Y > 0.45].any()


def test_from_above_a_place_shows_its_own_waves_and_a_turn_takes_it_along():
    top = seen(lambda x, y: 3 * x + 5 * y, 0.0, 90.0)
    row, place = np.searchsorted(Y, 0.5), np.searchsorted(Y, -0.3)
    assert top[row, place] == pytest.approx(3 * -0.3 + 5 * 0.5, abs=8 * 2 * PIXEL)
    turned = seen(lambda x, y: 3 * x + 5 * y, 90.0, 90.0)  # η to the right, −ξ up
    assert turned[row, place] == pytest.approx(3 * -0.5 + 5 * -0.3, abs=8 * 2 * PIXEL)


def test_the_wave_of_a_lens_is_a_surface_that_mouse_and_keys_turn(window):
    window.store.update(phase="surface")
    view, store = window.panels["pupil"].surface, window.store
    assert view.isVisible() and not window.panels["pupil"].map.chart.isVisible()
    first = view.pixels
    QTest.keyClick(view, Qt.Key.Key_Left)
    QTest.keyClick(view, Qt.Key.Key_Up)
    assert (store.state.camera.surface_turn_deg, store.state.camera.surface_tilt_deg) == (-35.0, 40.0)
    assert view.pixels.shape == first.shape and (view.pixels != first).any()
    QTest.mousePress(view, Qt.MouseButton.LeftButton, pos=QPoint(60, 60))
    QTest.mouseMove(view, QPoint(40, 60))
    assert store.moving and view.pixels.shape < first.shape  # fewer pixels while it moves
    QTest.mouseRelease(view, Qt.MouseButton.LeftButton, pos=QPoint(40, 60))
    assert not store.moving and store.state.camera.surface_turn_deg == -25.0
    for _ in range(20):
        QTest.keyClick(view, Qt.Key.Key_Down)
    assert store.state.camera.surface_tilt_deg == 0.0
    QTest.keyClick(view, Qt.Key.Key_Home)
    assert (view.pixels == first).all()


def test_a_surface_follows_the_sliders_and_its_waves_are_copied(window):
    window.store.update(phase="surface", method="seidel")
    panel = window.panels["pupil"]
    before = panel.surface.pixels
    window.store.update(sensor_shift_um=200.0)
    assert (panel.surface.pixels != before).any()
    assert data_of(panel.widget).splitlines()[0].startswith('"W, waves')


def test_the_value_under_the_pointer_is_that_of_the_surface_and_the_wheel_enlarges_it(qtbot):
    """From above the surface is a map: W at a place of the pupil, whatever is tall beside it."""
    view = SurfaceView()
    qtbot.addWidget(view)
    view.resize(400, 400)
    place = np.linspace(-1, 1, 101)
    xi, eta = np.meshgrid(place, place)
    waves = np.where(xi**2 + eta**2 <= 1, 2 * xi + eta, np.nan)
    view.show_waves(waves, 5.0, "settled", SceneCamera(0.0, 90.0))
    for zoom in (1.0, 2.0):
        view.zoom = zoom
        for across, up in ((0.3, 0.1), (-0.4, 0.2), (0.05, -0.35)):
            point = QPointF(*(float(v) for v in view.to_pixels(across, up)))
            assert view.value_at(point) == pytest.approx(2 * across + up, abs=0.04), "within a pixel and its slope"
    view.zoom = 1.0
    assert np.isnan(view.value_at(QPointF(1, 1)))
    qtbot.keyClick(view, Qt.Key.Key_Plus)
    assert view.zoom > 1
    qtbot.keyClick(view, Qt.Key.Key_Home)
    assert view.zoom == 1
