"""Numbers on the screen: no line ends between a number and its unit."""

import pytest

from p2sf.lensfile.library import find_lens
from p2sf.messages import Message
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf_explorer.compute.views.image import plan_notes
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr, unbroken


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("Mostly coma: 52 % of the variance", "52_%"),
        ("sharp from 149.8 mm to ∞ mm", "149.8_mm"),
        ("R² ≥ 0.9986; 64 rays", "≥_0.9986"),
        ("at 10 minutes", "10 minutes"),
    ],
)
def test_no_line_end_parts_a_number_from_its_unit(text, kept):
    assert kept in unbroken(text).replace("\u00a0", "_")


def test_the_sentence_on_the_dominant_term_breaks_at_no_unit(window):
    assert "\u00a0%" in window.foot.sentence.text() and " %" not in window.foot.sentence.text()


def test_the_reasons_of_a_plan_name_its_channels_in_german():
    camera = find_lens("singlet_f6")
    planned = plan(camera, Scene(Sensor(24, 32, 20.0), rtol=0.2))
    set_language("de")
    try:
        headings = [said(heading) for heading, _ in plan_notes(planned)]
        refused = said(Message("channel {channel}: {error}", channel=planned.scene.channels[1].label, error="x"))
    finally:
        set_language("en")
    assert {"Farbe Rot", "Farbe Grün", "Farbe Blau"} < set(headings)
    assert refused == "Kanal Grün: x"
    assert Channel("H-alpha", (656.3,), (1.0,)).label == "H-alpha"  # a person's own name


@pytest.mark.parametrize(
    ("english", "german"),
    [
        ("RMS 2.63 λ · PV −10.5 λ", "RMS 2,63 λ · PV −10,5 λ"),
        ("f/2.8 at (0.5, 1.25)", "f/2,8 at (0,5, 1,25)"),
        ("R² ≥ 0.9984.", "R² ≥ 0,9984."),
        ("1.5e−3", "1,5e−3"),
        ("version 0.1.0, section 4.2.1", "version 0.1.0, section 4.2.1"),
        ("lens_v2.5.zmx, 2.5.toml, F2.8", "lens_v2.5.zmx, 2.5.toml, F2.8"),
    ],
)
def test_german_numbers_have_a_comma_and_names_keep_their_points(qapp, english, german):
    assert local(english) == english
    set_language("de")
    try:
        assert local(english) == german
        assert tr("image {h} mm", h="1.234") == "Bild 1,234 mm"
    finally:
        set_language("en")
