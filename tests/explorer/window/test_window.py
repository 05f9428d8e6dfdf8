"""The window under a person's hands: real Qt events, and what the panels then show."""

from math import inf

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent

from p2sf_explorer.compute.setup import load, ranges, with_lens
from p2sf_explorer.i18n.messages import said
from tests.explorer.conftest import FIRST

KEYS = ("depth_mm", "field_deg", "wavelength_nm", "focus_mm", "sensor_shift_um", "f_number")


def pictures(window) -> dict[str, np.ndarray]:
    """Return what each panel shows at this moment, as the painted items hold it.

    Of the pupil its waves: the scale of their colours stays while they fill it, so that it depends on what was shown.
    """
    layout, bars = window.panels["layout"], window.panels["coefficients"].bars
    rays = np.concatenate([np.concatenate(curve.data()) for curve in layout.rays.values()])
    shown = layout.chart.live.layout
    return {
        "layout": np.append(rays, (shown.drawing.sensor_z, shown.sensor_half)),
        "pupil": window.panels["pupil"].map.values.copy(),
        "psf": window.panels["psf"].map.indices.copy(),
        "coefficients": np.array(list(bars.values.values())),
        "profiles": np.concatenate(window.panels["profiles"].curves["along y"].data()),
    }


def changed(before, after) -> set[str]:
    return {key for key in before if not np.array_equal(before[key], after[key], equal_nan=True)}


@pytest.mark.parametrize("key", KEYS)
def test_dragging_a_slider_moves_every_panel_together(window, drag, key):
    before = pictures(window)
    drag(window.controls.rows[key].slider, 0.62)
    assert changed(before, pictures(window)) == set(before)


@pytest.mark.slow
@pytest.mark.parametrize("key", KEYS)
def test_the_number_beside_the_slider_follows(window, drag, key):
    row = window.controls.rows[key]
    drag(row.slider, 0.4)
    scale = row.quantity.scale(ranges(load("double_gauss_28")))
    assert row.edit.text() == row.quantity.write(scale.value(row.slider.value() / 1000))


def test_while_held_the_preview_and_on_release_the_settled_picture(window, drag, qtbot):
    slider = window.controls.rows["field_deg"].slider
    drag(slider, 0.6, release=False)
    assert window.live.quality == "preview"
    qtbot.mouseRelease(slider, Qt.MouseButton.LeftButton, pos=QPoint(100, 11))
    assert window.live.quality == "settled"


def test_a_drag_is_one_undo(window, drag, qtbot):
    first = window.store.state
    drag(window.controls.rows["field_deg"].slider, 0.9)
    assert window.store.state != first
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)  # shortcuts are for the active window
    qtbot.keyClick(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.store.state == first
    qtbot.keyClick(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    assert window.store.state.optics.field_deg > 15


@pytest.mark.parametrize(
    ("key", "sign"), [(Qt.Key.Key_Right, 1), (Qt.Key.Key_Left, -1), (Qt.Key.Key_PageUp, 1), (Qt.Key.Key_PageDown, -1)]
)
def test_arrow_and_page_keys_move_the_field(window, qtbot, key, sign):
    before = window.store.state.optics.field_deg
    slider = window.controls.rows["field_deg"].slider
    slider.setFocus()
    qtbot.keyClick(slider, key)
    assert sign * (window.store.state.optics.field_deg - before) > 0


def test_double_click_resets(window, drag, qtbot):
    slider = window.controls.rows["wavelength_nm"].slider
    drag(slider, 0.1)
    qtbot.mouseDClick(slider, Qt.MouseButton.LeftButton, pos=QPoint(40, 11))
    assert window.store.state.optics.wavelength_nm == pytest.approx(587.5618)


def test_typing_a_distance(window, qtbot):
    edit = window.controls.rows["depth_mm"].edit
    edit.selectAll()
    qtbot.keyClicks(edit, "2 m")
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert window.store.state.optics.depth_mm == 2000
    assert edit.text() == "2.000 m"


def test_typing_nonsense_is_a_sentence_and_the_picture_stays(window, qtbot):
    before, edit = pictures(window), window.controls.rows["depth_mm"].edit
    edit.selectAll()
    qtbot.keyClicks(edit, "far")
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert window.banner.isVisible()
    assert "far" in window.banner.text.text()
    assert not changed(before, pictures(window))


def test_a_wavelength_outside_the_glass_is_refused_and_the_picture_stays(window):
    before = pictures(window)
    window.store.update(wavelength_nm=150.0)
    assert window.banner.isVisible()
    assert not changed(before, pictures(window))
    window.store.undo()
    assert not window.banner.isVisible()


def test_the_infinity_button(window, qtbot):
    window.store.update(depth_mm=2000.0)
    qtbot.mouseClick(window.controls.rows["depth_mm"].buttons[0], Qt.MouseButton.LeftButton)
    assert window.store.state.optics.depth_mm == inf


def test_focus_follows_the_source(window):
    window.store.update(depth_mm=2000.0)
    assert abs(float(window.live.setup.coefficients.wd)) > 10
    assert any("10 λ" in str(sentence) for sentence in window.live.warnings)
    window.store.update(focus_mm=2000.0)
    assert abs(float(window.live.setup.coefficients.wd)) < 1e-6  # sensor at this depth's own image: round-off
    assert not any("10 λ" in str(sentence) for sentence in window.live.warnings)


def test_autofocus_finds_the_smallest_rms(window, qtbot):
    qtbot.mouseClick(window.controls.focus_button, Qt.MouseButton.LeftButton)
    best, shift = window.live.pupil.rms, window.store.state.optics.sensor_shift_um
    for step in (-5.0, 5.0):
        window.store.update(sensor_shift_um=shift + step)
        assert window.live.pupil.rms > best


def test_dragging_the_source_turns_the_field(window, qtbot):
    chart = window.panels["layout"].chart
    ring, axis = chart.handle.pixel(chart.live), float(chart.to_pixels(0.0, 0.0)[1])

    def at(part):
        return QPointF(ring.x(), axis + (ring.y() - axis) * (1 - 0.7 * part)).toPoint()

    qtbot.mousePress(chart, Qt.MouseButton.LeftButton, pos=at(0.0))
    for part in (0.3, 0.7, 1.0):
        qtbot.mouseMove(chart, at(part))
    qtbot.mouseRelease(chart, Qt.MouseButton.LeftButton, pos=at(1.0))
    assert 0 < window.store.state.optics.field_deg < 6
    window.store.undo()
    assert window.store.state.optics.field_deg == 10.0


def test_the_arrow_of_a_positive_field_points_up_and_coma_follows_the_sign(window):
    window.store.update(field_deg=10.0)
    up = window.live.psf.values
    window.store.update(field_deg=-10.0)
    down = window.live.psf.values
    # The PSF of −field is that of +field upside down about the chief ray's sample, float32 and one row's sum apart.
    turned = np.roll(up[::-1], 1, axis=0)[1:]
    assert np.allclose(turned / turned.max(), down[1:] / down[1:].max(), atol=1e-5)


def test_only_the_open_tab_is_computed(window):
    always = {"layout", "psf", "coefficients"}
    assert set(window.live.views) == {*always, "profiles"}
    window.open_panel("seidel")
    assert set(window.live.views) == {*always, "seidel"}


def test_seidel_bars_add_up_to_the_coefficients(window):
    window.open_panel("seidel")
    waves, c = window.live.views["seidel"].found.waves, window.live.setup.coefficients
    expected = {name: float(getattr(c, name)) for name in ("w40", "w31", "w22", "w20", "w11")}
    expected["petzval"] = expected["w20"] - expected["w22"] / 2
    for name, value in expected.items():
        assert waves[name].sum() == pytest.approx(value, abs=1e-9)


def test_light_and_dark(window):
    for theme in ("dark", "light"):
        window.store.update(theme=theme)
        ground = window.grab().toImage().pixelColor(3, 3).lightness()
        assert (ground < 128) == (theme == "dark")


@pytest.mark.parametrize("name", ["cooke_triplet", "eye_navarro", "relay", "landscape"])
def test_every_kind_of_lens_opens(window, name):
    assert window.commands.open_lens(name)
    assert window.live.state.optics.lens == name
    assert not window.banner.isVisible()


def test_an_unknown_lens_is_a_sentence(window):
    assert not window.commands.open_lens("double_gaus_28")
    assert "double_gauss_28" in window.banner.text.text()
    assert window.top.lens.currentData() == "double_gauss_28"


def test_a_lens_file_dropped_on_the_window_opens(window, tmp_path):
    from p2sf.lensfile.library import lenses_folder

    path = tmp_path / "mine.toml"
    path.write_text((lenses_folder() / "achromat_f6.toml").read_text())
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    event = QDropEvent(QPointF(5, 5), Qt.DropAction.CopyAction, data, buttons, keys)
    window.dropEvent(event)
    assert window.live.state.optics.lens == str(path)


def test_what_no_workshop_could_make_is_told_with_the_warnings(window):
    """The relay's published rims reach beyond its spheres; the first is named, and how many there are."""
    assert not any("semi-diameter" in str(sentence) for sentence in window.live.warnings)
    window.store.replace(with_lens(FIRST, "relay"))
    *_, first, others = map(said, window.live.warnings)
    assert "69.5146 mm" in first and "61.8 mm" in first and " 1 " in first and " 4 " in others
    assert first in window.status.warning.toolTip()
