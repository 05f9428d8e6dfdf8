"""The widget of notebooks: what it shows is the state, and the window opens its link."""

from io import BytesIO

import numpy as np
import pytest

import p2sf
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import new_state

pytest.importorskip("ipywidgets")


@pytest.fixture(scope="module")
def shown():
    return p2sf.widget("cooke_triplet")


def picture(widget) -> np.ndarray:
    from PIL import Image

    return np.asarray(Image.open(BytesIO(widget._picture.value)))


def test_a_slider_asks_for_another_psf(shown):
    shown.set(field_deg=0.0, f_number=5.6)
    before = picture(shown)
    star = shown.live.psf.values
    assert np.allclose(
        star, np.roll(star[:, ::-1], 1, axis=1), rtol=0, atol=1e-6 * star.max()
    )  # on the axis it is round
    slider = shown.sliders["field_deg"]
    slider.value = 0.5  # the slider's end is beyond the largest field that the file states, 20°
    assert shown.state.optics.field_deg == pytest.approx(12.5)
    assert shown._numbers["field_deg"].value == "12.50°"
    assert picture(shown).shape == before.shape and (picture(shown) != before).any()


@pytest.mark.slow
def test_the_link_is_the_windows_own_and_can_be_pasted(shown):
    shown.set(field_deg=7.0)
    assert state_of_link(shown.link).optics.field_deg == 7.0
    other = new_state(lens="tessar", field_deg=3.0, wavelength_nm=550.0)
    shown._link.value = link(other)
    assert shown.state == other and p2sf.widget(link(other)).state == other
    shown.show(p2sf.widget("cooke_triplet").state)


def test_what_cannot_be_is_said_and_changes_nothing(shown):
    before, text = shown.state, shown.link
    shown._link.value = "p2sf:nonsense"
    assert "cut off or changed" in shown._said.value
    assert shown.state == before and shown._link.value == text
    with pytest.raises(p2sf.P2SFError):
        shown.set(field_deg=120.0)
    assert shown.state == before


def test_a_lens_of_ones_own_is_shown_and_goes_with_the_link():
    lens = p2sf.load_lens("singlet_f6")
    shown = p2sf.widget(lens)
    assert np.allclose(shown.live.psf.values, p2sf.widget("singlet_f6").live.psf.values, rtol=0, atol=1e-9)
    assert state_of_link(shown.link).optics.lens_text


def test_jupyter_gets_a_widget(shown):
    assert "application/vnd.jupyter.widget-view+json" in shown._repr_mimebundle_()
