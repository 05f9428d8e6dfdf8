"""Refusals in German: every sentence with which something the window reaches can refuse, read from its source."""

import ast
import re
from math import inf
from pathlib import Path

import pytest

from p2sf.messages import Message
from p2sf_explorer.i18n.language import Translation
from p2sf_explorer.i18n.messages import spoken
from p2sf_explorer.i18n.tr import unbroken

ROOT = Path(__file__).parents[3]
RAISING = re.compile(r"Error$|^(fault|emit|fail|error|_fault|_error)$")
# Parts of the library that only the command line or a program reaches: databases on disk, scenes, stacks, FFTs.
ELSEWHERE = re.compile(
    r"p2sf/(cli|database|database_files|scene|interchange|image)/|p2sf/pupil/(transform|quadrature)\.py"
    r"|p2sf/psf/(opd_array|compare|gaussian_fit|metrics|methods)\.py|p2sf/raytrace/aiming\.py|io/colour_files"
)
ENGLISH = re.compile(r"\b(the|is|are|give|write|of|and|with|not|has|holds|choose|to|it|must|or|from|which|that)\b")
QUOTED = re.compile(r'"[^"]*"|field_deg 10, tab mtf|field="height"')
GERMAN = Translation("de")


def text_of(node) -> str | None:
    """Return a text of the source with what it fills in marked, ⟨path⟩; None where it is no text."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(v.value if isinstance(v, ast.Constant) else f"⟨{ast.unparse(v.value)}⟩" for v in node.values)
    return None


def refusals():
    """Yield (file, sentence) of every refusal written in the source."""
    for path in sorted((*(ROOT / "app").rglob("*.py"), *(ROOT / "p2sf").rglob("*.py"))):
        where = str(path.relative_to(ROOT))
        if ELSEWHERE.search(where):
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call):
                continue
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            for text in filter(None, map(text_of, node.args)) if RAISING.search(name) else ():
                if "; " in text and " " in text:
                    yield where, text


FOUND = sorted(set(refusals()))
DYNAMIC = ("⟨name⟩ is ⟨getattr(self, name)⟩; give", "⟨place_of(name)⟩ is ⟨value⟩⟨_unit(name)⟩; give ⟨what⟩")


def filled(text: str) -> str:
    """Return a sentence as it may be said: a path where a path stands, else a figure."""
    return re.sub(r"⟨([^⟩]*)⟩", lambda part: "/a/b.toml" if part[1] in ("path", "where", "str(path)") else "7", text)


def test_there_are_as_many_refusals_as_the_source_looks_like():
    assert len(FOUND) > 150


@pytest.mark.parametrize("where", sorted({where for where, _ in FOUND}))
def test_every_refusal_has_german(where):
    left = []
    for text in (text for place, text in FOUND if place == where and not text.startswith(DYNAMIC)):
        said = GERMAN.said(spoken(filled(text)))
        if ENGLISH.search(QUOTED.sub("", said)):
            left.append(f"{text}\n    → {said}")
    assert not left, "\n".join(left)


@pytest.mark.parametrize(
    ("sentence", "german"),
    [
        (
            "/a/lens.toml, line 3: the file is not text but binary; give the lens as a text file",
            "/a/lens.toml, Zeile 3: die Datei ist kein Text, sondern binär; das Objektiv als Textdatei angeben",
        ),
        (
            '/a/b c.toml, line 12: surface 2: radius is "5"; write the number 5 without quotation marks',
            '/a/b c.toml, Zeile 12: Fläche 2: radius ist "5"; die Zahl 5 ohne Anführungszeichen schreiben',
        ),
        (
            "/a/dg.npz: this is a database of PSFs, not a lens or a state; use it with p2sf psf, or open its lens",
            "/a/dg.npz: das ist eine Datenbank von PSFs, kein Objektiv und kein Zustand; mit p2sf psf benutzen "
            "oder ihr Objektiv öffnen",
        ),
        (
            "/a/psf.tiff: there is no readable state in this picture or PSF; open a snapshot, written by the window "
            "with Ctrl+E, or with the Image panel open drop a photo",
            "/a/psf.tiff: in diesem Bild oder dieser PSF ist kein lesbarer Zustand; einen Schnappschuss öffnen, den "
            "das Fenster mit Strg+E schreibt, oder bei offenem Feld Bild ein Foto ablegen",
        ),
        (
            "the link is cut off or changed; copy all of it again, from p2sf: to its last letter",
            "Der Link ist abgeschnitten oder verändert; noch einmal ganz kopieren, von p2sf: bis zum letzten Zeichen",
        ),
        (
            "the chief ray is stopped by the rim of surface 4; choose a smaller field",
            "Der Hauptstrahl wird vom Rand der Fläche 4 aufgehalten; ein kleineres Feld wählen",
        ),
        ("method is 5; give a text", "Methode ist 5; einen Text angeben"),
    ],
)
def test_a_refusal_with_its_place_is_said_whole(sentence, german):
    assert GERMAN.said(spoken(sentence)) == german


def test_what_is_no_refusal_is_left_alone():
    for text in ("PSF × 100 breit, Höhe: √", "kein Englisch: gar nichts", "N-BK7"):
        assert GERMAN.said(text) == text


def test_panels_that_work_behind_the_slider_refuse_in_the_windows_words(window):
    """As the banner does: ∞ for inf, and a capital in front."""
    rest = "away blur over 6 mm, which takes 7000² samples of 4096² at most; bring the depths nearer to the focus"
    raw = Message(f"points {{depth:g}} mm {rest} or stop down", depth=inf)
    words = unbroken(f"Points ∞ mm {rest} or stop down")
    window.store.update(tab="field_map")
    asking = window.panels["field_map"].asking
    asking.refuse(raw)
    assert unbroken(window.panels["field_map"].widget.readout.text()) == words
    window.store.update(field_deg=1.0)
    asking.worker.failed.emit(asking.asked, raw)
    assert unbroken(window.panels["field_map"].widget.readout.text()) == words
    window.store.update(tab="database")
    window.panels["database"].worker.failed.emit(None, raw)
    assert unbroken(window.panels["database"].note.text()) == words
    window.store.update(tab="accuracy")
    window.measuring.worker.failed.emit(None, raw)
    assert words in unbroken(window.panels["accuracy"].message.text())
