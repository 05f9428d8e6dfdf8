"""The colour PSF on screen: which colour lies where."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from p2sf.colour.spectrum import spectrum_of
from p2sf.lens.lens import with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.methods import render
from p2sf.psf.polychromatic import suitable_pitch_um
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.views import colour
from p2sf_explorer.state.state import change, new_state
from tests.support.windows.windows import settled

FIRST = new_state(method="seidel", theme="light")


def asked(**changes):
    question = colour.question(live(change(FIRST, **changes), "preview")).question
    return question, colour.answer(question, lambda: False, lambda share, found: None)


def channels(found):
    """Return red, green and blue of the picture on a linear scale, rows +y, 0 to 255."""
    pixels = colour.pixels(found.psf, "linear")
    return [(pixels >> shift & 255).astype(float) for shift in (16, 8, 0)]


def height(light, y_um):
    return (light.sum(1) @ y_um) / light.sum()


def test_blue_lands_above_red_where_the_chief_rays_say_so():
    _, found = asked(field_deg=14.0, f_number=16.0, spectrum="lines:450,640")
    red, _, blue = channels(found)
    above = height(blue, found.psf.y_um) - height(red, found.psf.y_um)
    own = np.interp((450, 640), 1e3 * found.psf.wavelengths_um, found.psf.shift_um)
    assert own[0] > own[1] and above > 0.4 * (own[0] - own[1]), (
        "the display's curve lifts the faint halo, not the order"
    )


@pytest.mark.parametrize("nm", [450.0, 640.0])
def test_light_of_one_line_is_the_psf_of_its_wavelength(nm):
    question, found = asked(field_deg=0.0, f_number=8.0, spectrum=f"lines:{nm:g}")
    lens = with_f_number(find_lens("double_gauss_28"), 8.0)
    one = render(lens, Source(wavelength_nm=nm), "seidel", *question.window).values
    light = found.psf.xyz[..., 1] / found.psf.xyz[..., 1].sum()
    assert np.linalg.norm(light - one) < 0.01 * np.linalg.norm(one)


def test_on_the_axis_the_picture_is_round_and_has_no_lateral_colour():
    _, found = asked(field_deg=0.0, f_number=8.0)
    assert not found.psf.shift_um.any()
    xyz = found.psf.xyz[1:, 1:]
    assert xyz == pytest.approx(xyz.transpose(1, 0, 2), abs=1e-6)


def test_tungsten_is_redder_than_daylight():
    warm, cold = (channels(asked(spectrum=name, f_number=8.0)[1]) for name in ("planck:2856", "d65"))
    share = [part[0].sum() / part[2].sum() for part in (warm, cold)]
    assert share[0] > 2 * share[1]


def test_the_sensor_stays_while_the_colours_change():
    question, _ = asked(focus_mm=2000.0)
    places = {
        paraxial_setup(change(question.state, wavelength_nm=nm)).lens.sensor_mm for nm in (450.0, 587.5618, 650.0)
    }
    assert len(places) == 1


def test_the_hue_of_a_wavelength_is_its_own():
    red, green, blue = colour.hues(np.array([0.64, 0.53, 0.45]))
    assert (red.argmax(), green.argmax(), blue.argmax()) == (0, 1, 2)


def test_what_is_added_by_hand_is_one_path_in_every_colour():
    """A step of a micrometre is more waves of blue than of red: W·λ stays (Welford 1986, ch. 7)."""
    state = change(FIRST, free_pupil=True, added_waves=(0.5, 0.0, 0.0, 0.0, 1.0, 0.0))
    made = [paraxial_setup(colour.at_wavelength(state, nm)).coefficients for nm in (450.0, 587.5618, 650.0)]
    for term, waves in (("w40", 0.5), ("wd", 1.0)):
        paths = [float(getattr(c, term) * c.wavelength_um) for c in made]
        assert paths == pytest.approx([waves * 0.5875618] * 3)


def test_a_free_pupil_has_no_lateral_colour():
    _, found = asked(field_deg=14.0, f_number=8.0, free_pupil=True, spectrum="lines:450,640")
    assert not found.psf.shift_um.any()
    assert asked(field_deg=14.0, f_number=8.0, spectrum="lines:450,640")[1].psf.shift_um.any()


@pytest.fixture
def panel(window, qtbot):
    window.store.update(tab="colour", f_number=8.0, spectrum="lines:486,656")
    made = window.panels["colour"]
    filled(made, qtbot)
    return made


def filled(made, qtbot):
    settled(made, qtbot)
    assert made.found[0] == made.late.asked


def test_choosing_and_typing_a_spectrum(window, panel, qtbot):
    assert panel.choice.currentText() == "typed" and panel.typed.text() == "lines:486,656"
    panel.choice.setCurrentIndex(0)
    panel.choice.activated.emit(0)
    assert window.store.state.display.spectrum == "d65" and panel.typed.text() == "d65"
    panel.typed.setFocus()
    panel.typed.selectAll()
    qtbot.keyClicks(panel.typed, "planck:4000")
    qtbot.keyClick(panel.typed, Qt.Key.Key_Return)
    assert window.store.state.display.spectrum == "planck:4000"
    panel.typed.selectAll()
    qtbot.keyClicks(panel.typed, "candle")
    qtbot.keyClick(panel.typed, Qt.Key.Key_Return)
    assert "candle" in window.banner.text.text() and window.store.state.display.spectrum == "planck:4000"
    assert panel.typed.text() == "planck:4000"
    filled(panel, qtbot)
    assert panel.found[1].psf.spectrum == "planck:4000"


def test_lines_stand_at_their_wavelengths_on_the_axis_of_the_spectrum(panel):
    assert panel.spectrum.shift.data()[0] == pytest.approx([486, 656])
    assert panel.spectrum.colours.wavelength_nm == pytest.approx([486, 656])


def test_a_spectrum_the_glass_does_not_pass_is_said_in_the_panel(window, panel, qtbot):
    window.store.update(spectrum="lines:200,550")
    assert "200" in panel.widget.overlay.text and not window.banner.isVisible()
    window.store.update(spectrum="lines:550")
    filled(panel, qtbot)
    assert not panel.widget.overlay.isVisible()
    assert "1 wavelengths" in panel.widget.readout.text()


def test_a_refused_spectrum_says_so_until_there_is_a_picture_again(window, panel, qtbot):
    """What was on its way when the spectrum was refused must not talk over the refusal, and the way back is open."""
    words = panel.widget.readout.text()
    window.store.update(f_number=11.0)
    assert panel.late.busy
    window.store.update(spectrum="lines:200")
    settled(panel, qtbot)
    assert "200" in panel.widget.overlay.text and panel.widget.overlay.isVisible()
    assert not panel.widget.readout.isVisible()
    window.store.update(f_number=8.0)
    window.store.update(spectrum="lines:486,656")
    filled(panel, qtbot)
    assert panel.widget.readout.text().split(" · ")[:2] == words.split(" · ")[:2]


@pytest.mark.parametrize("f_number", [2.8, 4.0, 8.0, 16.0])
def test_the_window_is_as_wide_as_the_light_needs_and_at_most_to_the_next_round_width(f_number):
    question, _ = asked(field_deg=10.0, f_number=f_number)
    setup, (pixels, pixel_um) = paraxial_setup(question.state), question.window
    pitch = suitable_pitch_um(setup.lens, setup.source, spectrum_of(question.spectrum), pixels, setup.stop)
    assert 1 - 1e-9 <= pixel_um / pitch <= 2.5
