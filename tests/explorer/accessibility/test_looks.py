"""Contrast of all text, curves that differ without colour, and nothing that moves by itself."""

import re
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

import p2sf_explorer
from p2sf_explorer.charts.chart import VEIL
from p2sf_explorer.charts.painting import MARK_EVERY_PX, MARK_PX, MARKS, paint_line_marks, write
from p2sf_explorer.charts.plots import lookup
from p2sf_explorer.charts.theme import DARK, LIGHT, stylesheet
from p2sf_explorer.panels.matrix.tile_charts import NOTE_GROUND, WHITE

SOURCES = Path(p2sf_explorer.__file__).parent
THEMES = pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
LETTERS, DRAWN, IN_A_HALL = 4.5, 3.0, 7.0  # WCAG 2.1 asks these of text, of what is drawn, and of text at its level AAA
GROUNDS = "window", "card", "raised", "faint", "warning_back"


def contrast(one: str, other: str) -> float:
    """Return the contrast ratio as WCAG 2.1 defines it."""
    light = []
    for colour in (one, other):
        coded = np.array(QColor(colour).getRgbF()[:3])
        linear = np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)
        light.append(float(linear @ (0.2126, 0.7152, 0.0722)))
    return (max(light) + 0.05) / (min(light) + 0.05)


def test_contrast_of_black_on_white():
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)


@THEMES
@pytest.mark.parametrize("ink", ["text", "muted", "accent", "warning"])
def test_every_colour_of_text_is_read_on_every_ground(theme, ink):
    assert min(contrast(getattr(theme, ink), getattr(theme, ground)) for ground in GROUNDS) >= LETTERS


@THEMES
def test_what_is_selected_is_read(theme):
    assert contrast(theme.accent_text, theme.accent) >= LETTERS


@THEMES
def test_the_style_sheet_writes_in_no_other_colour(theme):
    inks = set(re.findall(r"(?<![-\w])color: (#\w+)", stylesheet(theme)))
    assert inks <= {getattr(theme, name) for name in ("text", "muted", "accent", "warning", "accent_text")}


@THEMES
@pytest.mark.parametrize("ink", ["marginal", "chief", "third", "positive", "negative", "mark", "glass_edge"])
def test_every_colour_of_a_line_is_seen_on_a_card(theme, ink):
    assert contrast(getattr(theme, ink), theme.card) >= DRAWN


@THEMES
@pytest.mark.parametrize("ink", ["marginal", "positive"])
def test_notes_in_the_colour_of_a_curve_are_read_on_a_card(theme, ink):
    """S and T through focus; no other note has the colour of a curve."""
    assert contrast(getattr(theme, ink), theme.card) >= LETTERS


@THEMES
@pytest.mark.parametrize("ink", ["text", "emphasis"])
def test_the_caption_is_read_from_the_last_row(theme, ink):
    assert contrast(getattr(theme, ink), theme.window) >= IN_A_HALL


@THEMES
def test_words_over_a_picture_are_read_on_its_brightest_colour(theme):
    """Axes stand on a veil over the picture, notes of tiles on three quarters of its darkest colour."""
    table = [QColor.fromRgb(int(value)) for value in lookup(theme.brightness)]
    brightest = np.array(max(table, key=lambda colour: contrast(colour.name(), "#000000")).getRgb()[:3])
    behind = QColor(*np.rint((1 - VEIL / 255) * brightest).astype(int).tolist()).name()
    assert contrast(DARK.text, behind) >= LETTERS
    darkest = np.array(table[0].getRgb()[:3])
    ground = QColor(*np.rint(brightest + NOTE_GROUND / 255 * (darkest - brightest)).astype(int).tolist()).name()
    assert contrast(WHITE, ground) >= LETTERS


def test_curves_that_stand_together_have_marks_of_their_own(qapp):
    """Along x, along y and the energy: without a mark, with discs, with diamonds."""
    assert len({MARKS.get(token) for token in ("marginal", "chief", "third")}) == 3
    assert len({MARKS.get(token) for token in ("positive", "negative")}) == 2


def test_marks_stand_at_even_distances_on_the_line_and_none_in_a_gap(qapp):
    image = QImage(400, 40, QImage.Format.Format_Grayscale8)
    image.fill(255)
    painter = QPainter(image)
    painter.setPen(QPen(QColor("#000000")))
    x = np.array([0.0, 100.0, np.nan, 200.0, 400.0])  # 300 px of line
    paint_line_marks(painter, x, np.full(5, 20.0), "●", LIGHT)
    painter.end()
    row = np.array([image.pixelColor(k, 20).value() for k in range(400)])
    starts = np.flatnonzero(np.diff((row < 128).astype(int)) == 1)
    along = (np.arange(4) + 0.5) * MARK_EVERY_PX
    assert np.allclose(starts, along + 100 * (along > 100) - MARK_PX, atol=2)  # the gap is as wide as 100 px


def test_the_legend_shows_the_marks_of_its_curves(window):
    window.open_panel("profiles")
    told = window.panels["profiles"].legend(LIGHT)
    assert "●" in told and told.count("━") > 1


def test_nothing_moves_unless_a_person_has_it_played():
    """There is no animation but that of the first start, which a setting for reduced motion stops."""
    moving = re.compile(r"PropertyAnimation|VariantAnimation|QTimeLine|QMovie|QParallelAnimation")
    found = {path.name for path in SOURCES.rglob("*.py") if moving.search(path.read_text(encoding="utf-8"))}
    assert found == {"start_screen.py"}


def test_a_number_keeps_its_unit_behind_it_in_a_mirrored_window(qapp):
    """A text without a letter of a language written from right to left is painted as anywhere else."""
    pictures = []
    for direction in (Qt.LayoutDirection.LeftToRight, Qt.LayoutDirection.RightToLeft):
        image = QImage(120, 24, QImage.Format.Format_RGB32)
        image.fill(0xFFFFFFFF)
        painter = QPainter(image)
        painter.setLayoutDirection(direction)
        write(painter, QRectF(0, 0, 120, 24), "⌀ 33.33 at 57.91 mm", -1)
        painter.end()
        pictures.append(image)
    assert pictures[0] == pictures[1]
