"""The handbook: every formula is drawn, every citation of it exists, every panel leads to its section."""

import re
from pathlib import Path

import pytest
from PySide6.QtCore import QUrl

from p2sf_explorer.charts.theme import DARK, LIGHT
from p2sf_explorer.handbook.pages import PAGES, formulas, headings, page, rendered, with_pictures
from p2sf_explorer.handbook.viewer import Handbook
from p2sf_explorer.panels import REGISTRY

ROOT = Path(__file__).parents[3]
CITATION = re.compile(r"\bhandbook (\d+(?:\.\d+)?)")
NUMBERS = {heading.number for heading in headings(page("theory")) if heading.number}


@pytest.mark.parametrize("name", PAGES)
def test_every_formula_is_drawn_and_none_is_left_as_text(name):
    found = formulas(page(name))
    for formula in found:
        assert rendered(formula, 15.0).opacity.max() > 0.9
    assert "$" not in with_pictures(page(name))


def test_a_formula_that_mathtext_does_not_know_is_an_error():
    with pytest.raises(ValueError, match="unknown"):
        rendered(r"\unknown", 15.0)


def test_sections_are_numbered_once_and_in_order():
    numbers = [heading.number for heading in headings(page("theory")) if heading.number]
    assert numbers == sorted(set(numbers), key=lambda number: [int(part) for part in number.split(".")])


def test_every_section_that_the_sources_cite_exists():
    cited = {
        (str(path.relative_to(ROOT)), number)
        for folder in ("p2sf", "app", "tests")
        for path in (ROOT / folder).rglob("*.py")
        for number in CITATION.findall(path.read_text(encoding="utf-8"))
    }
    assert len(cited) > 10
    assert not {(path, number) for path, number in cited if number not in NUMBERS}


def test_every_panel_leads_to_a_section():
    assert not {entry.key for entry in REGISTRY if entry.handbook not in NUMBERS}


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_a_section_opens_at_its_heading_with_formulas_in_the_themes_colour(qtbot, theme):
    book = Handbook(theme)
    qtbot.addWidget(book)
    book.show_section("theory", "3.2")
    top = book.text.cursorForPosition(book.text.viewport().rect().topLeft()).block()
    below = top.next()
    assert "3.2 Seidel sums" in (top.text(), below.text())
    picture = book.text.document().resource(2, QUrl("formula:0"))
    opaque = max(
        (picture.pixelColor(x, y) for x in range(picture.width()) for y in range(picture.height())),
        key=lambda colour: colour.alpha(),
    )
    assert opaque.alpha() == 255 and opaque.name() == theme.text


def test_links_between_pages_are_followed(qtbot):
    book = Handbook(LIGHT)
    qtbot.addWidget(book)
    book.show_section("theory")
    for name in PAGES:
        for link in re.findall(r"(?<!!)\[[^]]*\]\(([^)]+)\)", page(name)):  # not of pictures
            book.text.anchorClicked.emit(QUrl(link))
            assert book.text.document().firstBlock().text() == headings(page(link.removesuffix(".md")))[0].text


def test_the_window_opens_the_theory_from_the_palette_and_a_panel_its_section(window):
    window.commands.theory()
    assert window.commands.handbook.isVisible()
    window.open_panel("mtf")
    window.panels["mtf"].widget.theory_asked.emit()
    assert window.commands.handbook.shown == ("theory", "6.3")
    window.commands.handbook.close()
