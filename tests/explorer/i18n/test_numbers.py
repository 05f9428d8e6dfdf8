"""Numbers on the screen: a decimal point in every language, and no line end between a number and its unit."""

import re

import pytest

from p2sf_explorer.i18n.language import texts
from p2sf_explorer.i18n.tr import unbroken
from p2sf_explorer.lessons.lesson import FOLDER
from p2sf_explorer.shell.help import POINT

GERMAN = texts("de")


def test_numbers_have_a_decimal_point_in_german_too():
    """As the figures beside them, which are computed; a list of wavelengths keeps its commas."""
    lessons = {path.name: path.read_text(encoding="utf-8") for path in (FOLDER / "de").glob("*.md")}
    told = {**GERMAN, **lessons}
    assert not {name for name, text in told.items() if re.search(r"(?<![\d,:])\d+,\d+(?![\d,])", text)}
    assert "Dezimalpunkt" in GERMAN[POINT]


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
