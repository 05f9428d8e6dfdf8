"""Numbers on the screen: no line ends between a number and its unit."""

import pytest

from p2sf_explorer.i18n.tr import unbroken


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
    assert "\u00a0%" in window.controls.sentence.text() and " %" not in window.controls.sentence.text()
