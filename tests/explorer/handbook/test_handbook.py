"""The handbook: every formula is drawn, every citation of it exists, every panel leads to its section."""

import re
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QUrl

from p2sf_explorer.charts.theme import DARK, LIGHT
from p2sf_explorer.handbook.pages import (
    CODE,
    FOLDER,
    PAGES,
    PICTURE,
    anchor,
    formulas,
    heading_in,
    headings,
    page,
    render_formula,
    translated,
    window_page,
    with_pictures,
)
from p2sf_explorer.handbook.viewer import Handbook, fragments
from p2sf_explorer.i18n.language import set_language, texts
from p2sf_explorer.state.panels import GROUPS, REGISTRY
from p2sf_explorer.window.commands.actions import PARTS, handbook_place
from tests.support.tiers import in_tiers

ROOT = Path(__file__).parents[3]
FIELDS = re.compile(r"{[^{}]*}")
ITALICS, CODE_BLOCK = re.compile(r"(?<![*\w])\*([^*\n]+)\*(?!\*)"), re.compile(r"```.*?```", re.DOTALL)
CITATION = re.compile(r"\bhandbook (\d+(?:\.\d+)?)")
NUMBERS = {heading.number for heading in headings(page("theory")) if heading.number}


@pytest.mark.parametrize("name", in_tiers(PAGES, set(PAGES) - {"theory"}))
def test_every_formula_is_drawn_and_none_is_left_as_text(name):
    found = formulas(page(name))
    for formula in found:
        assert render_formula(formula, 15.0).opacity.max() > 0.9
    assert "$" not in re.sub(CODE, "", with_pictures(page(name)), flags=re.MULTILINE | re.DOTALL)


def test_a_formula_that_mathtext_does_not_know_is_an_error():
    with pytest.raises(ValueError, match="unknown"):
        render_formula(r"\unknown", 15.0)


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


LINKS = [(name, link) for name in PAGES for link in re.findall(r"(?<!!)\[[^]]*\]\(([^)]+)\)", page(name))]


def test_links_between_pages_lead_to_a_page_and_a_heading():
    anchors = {name: {anchor(heading.text) for heading in headings(page(name))} for name in PAGES}
    for name, link in LINKS:
        target, _, section = link.partition("#")
        if not target.startswith("lessons/"):  # pages of the site alone; the window has the lessons themselves
            assert not section or section in anchors[target.removesuffix(".md") or name], link
            assert target.removesuffix(".md") in {"", *PAGES}, link


def test_a_link_to_a_section_scrolls_there(qtbot):
    book = Handbook(LIGHT)
    qtbot.addWidget(book)
    book.show_section("find")
    book.text.anchorClicked.emit(QUrl("theory.md#61-the-coefficient-of-determination"))
    top = book.text.cursorForPosition(book.text.viewport().rect().topLeft()).block()
    assert "6.1 The coefficient of determination" in (top.text(), top.next().text())


def test_the_pages_pictures_are_shown(qtbot):
    book = Handbook(LIGHT)
    qtbot.addWidget(book)
    book.show_section("speed")
    picture = book.text.document().resource(2, QUrl("pictures/complete_trade.png"))
    assert picture.width() == 720 * book.devicePixelRatioF()


def test_the_window_leaves_out_what_is_for_the_site():
    text = window_page("tutorial")
    assert "made/" in page("tutorial") and "made/" not in text and "<!--" not in text


def test_a_panels_context_menu_leads_to_its_section_of_the_theory(window):
    window.commands.theory()
    assert window.commands.handbook.isVisible()
    window.open_panel("mtf")
    window.panels["mtf"].widget.theory_asked.emit()
    assert window.commands.handbook.shown == ("theory", "6.3 Strehl ratio, encircled energy, contrast")
    window.commands.handbook.close()


def test_the_page_of_panels_has_a_paragraph_for_every_panel_and_none_besides():
    found = [heading.text for heading in headings(page("panels")) if heading.level == 3]
    assert found == [entry.title for entry in sorted(REGISTRY, key=lambda entry: GROUPS.index(entry.group))]


def test_f1_opens_the_handbook_at_what_has_the_focus(window, qtbot):
    parts = {
        ("panels", "PSF"): window.panels["psf"].map.chart,
        ("window", "Controls"): window.controls.rows["field_deg"].slider,
        ("window", "Top bar"): window.top.method,
    }
    for place, part in parts.items():
        part.setFocus()
        qtbot.keyClick(part, Qt.Key.Key_F1)
        book = window.commands.handbook
        assert book.isVisible() and book.shown == place
        top = book.text.cursorForPosition(book.text.viewport().rect().topLeft()).block()
        assert place[1] in (top.text(), top.next().text())
        book.close()


def test_every_part_of_the_window_has_its_section():
    known = {heading.text for heading in headings(page("window"))}
    assert PARTS and set(PARTS.values()) <= known
    assert handbook_place(None) == ("find", "")


@pytest.mark.parametrize(("name", "theme"), [("light", LIGHT), ("dark", DARK)])
def test_links_have_the_accent_of_the_theme(window, name, theme):
    window.store.update(theme=name)
    window.commands.open_handbook()
    document, links = window.commands.handbook.text.document(), set()
    block = document.begin()
    while block.isValid():
        links |= {
            piece.charFormat().foreground().color().name()
            for piece in fragments(block)
            if piece.charFormat().isAnchor()
        }
        block = block.next()
    assert links == {theme.accent}
    window.commands.handbook.close()


def test_the_contents_mark_the_heading_on_show(qtbot):
    book = Handbook(LIGHT)
    qtbot.addWidget(book)
    book.show_heading("panels", "MTF")
    item = book.contents.currentItem()
    assert item.text(0) == "MTF" and item.parent().parent().text(0) == "Panels"


def emphasised(text: str) -> list[str]:
    """Return what stands in italics outside code: the names of things on screen."""
    return ITALICS.findall(CODE_BLOCK.sub("", text))


@pytest.mark.parametrize("name", [path.stem for path in (FOLDER / "de").glob("*.md")])
def test_a_german_page_has_the_same_parts_code_and_names_as_the_window(name):
    """Names in italics are those of the window in German, one for each name of the English page."""
    english, german = page(name), page(name, "de")
    assert german != english
    assert [one.level for one in headings(german)] == [one.level for one in headings(english)]
    assert CODE_BLOCK.findall(german) == CODE_BLOCK.findall(english)
    assert PICTURE.findall(german) == PICTURE.findall(english)
    known = {FIELDS.sub("…", one): FIELDS.sub("…", other) for one, other in texts("de").items()}
    pairs = zip(emphasised(english), emphasised(german), strict=True)
    titles = {one.text: other.text for one, other in zip(headings(english), headings(german), strict=True)}
    for one, other in pairs:
        assert other == known.get(one, titles.get(one, one)), one


@pytest.mark.parametrize("name", [path.stem for path in (FOLDER / "de").glob("*.md")])
def test_links_of_a_german_page_are_those_of_the_english_one_and_lead_to_its_own_headings(name, qapp):
    both = [re.findall(r"(?<!!)\[[^]]*\]\(([^)]+)\)", page(name, language)) for language in ("en", "de")]
    assert both[0] == both[1]
    for one, other in zip(headings(page(name)), headings(page(name, "de")), strict=True):
        assert heading_in(name, one.text, "de") == other.text == heading_in(name, other.text, "de")
        assert heading_in(name, one.text, "en") == one.text


def test_in_german_a_part_of_the_window_leads_to_its_own_section(qtbot):
    set_language("de")
    try:
        book = Handbook(LIGHT)
        qtbot.addWidget(book)
        book.show_heading("window", "Pupil shape")
        for heading in ("Pupillenform", "Dejustieren"):
            top = book.text.cursorForPosition(book.text.viewport().rect().topLeft()).block()
            assert heading in (top.text(), top.next().text())
            book.text.anchorClicked.emit(QUrl("panels.md#misalign"))
    finally:
        set_language("en")


def test_a_page_that_is_not_translated_says_so_in_the_list(qapp):
    set_language("de")
    try:
        book = Handbook(LIGHT)
        listed = [book.contents.topLevelItem(k).text(0) for k in range(book.contents.topLevelItemCount())]
    finally:
        set_language("en")
    for name, title, words in zip(PAGES, PAGES.values(), listed, strict=True):
        assert words == (texts("de")[title] if translated(name, "de") else f"{title} (englisch)")
    book.deleteLater()
