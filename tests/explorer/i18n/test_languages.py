"""German is complete: nothing the window shows is missing or passes it by, and every label fits."""

import ast
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QLabel, QTabWidget, QWidget

from p2sf.errors import P2SFError
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.i18n import language as languages
from p2sf_explorer.i18n.language import FOLDER, JOINTS, Translation, current_language, set_language, template, texts
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.messages import spoken as in_the_windows_words
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels import REGISTRY
from p2sf_explorer.panels.solid import SolidPanel
from p2sf_explorer.scene3d import opengl_probe as probe
from p2sf_explorer.shell.command_palette import named
from p2sf_explorer.shell.help import help_text
from p2sf_explorer.shell.language_switch import LanguageSwitch
from p2sf_explorer.shell.window import MainWindow
from p2sf_explorer.state.state import State

ROOT = Path(__file__).parents[3]
LETTERS = re.compile(r"[^\W\d_]{3}")
GERMAN = texts("de")
MADE = [template(said, source)[0] for source, said in GERMAN.items() if "{" in said]
# What a file, a lens, a glass, a key or a unit is called is not translated.
NAMES = re.compile(r"^&\d  |SCHOTT|OHARA|N-[A-Z]+\d+|P2SF|Ctrl\+|Alt\+|\d[\d.,]* (nm|mm|µm|ms)|f/\d")


def test_every_text_has_a_translation_with_the_same_braces():
    found = ElementTree.parse(FOLDER / "de.ts").findall(".//message")
    sources = [message.findtext("source") for message in found]
    assert len(sources) == len(set(sources)) > 500
    for message in found:
        source, said = message.findtext("source"), message.findtext("translation")
        assert said and said.strip(), source
        assert sorted(re.findall(r"{\w*}", source)) == sorted(re.findall(r"{\w*}", said)), source


def written() -> set[str]:
    """Return every text that stands in a call of `tr` in the source."""
    found = set()
    for path in (ROOT / "app").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "tr" and node.args:
                parts = ast.walk(node.args[0]) if not isinstance(node.args[0], ast.JoinedStr) else ()
                found |= {
                    part.value for part in parts if isinstance(part, ast.Constant) and isinstance(part.value, str)
                }
    return found


def test_no_text_in_the_source_is_missing():
    missing = sorted(text for text in written() if LETTERS.search(text) and text not in GERMAN)
    assert not missing, "\n".join(missing)


class Listening(Translation):
    """Speaks, and notes what it could not say and what it said."""

    missing: set[str]
    spoken: set[str]

    def said(self, source: str) -> str:
        found = super().said(source)
        self.__dict__.setdefault("heard", set()).add(found)
        if found == source and len(JOINTS.split(source)) == 1 and LETTERS.search(source) and not is_german(source):
            self.__dict__.setdefault("missed", set()).add(source)
        return found


def is_german(text: str) -> bool:
    return text in GERMAN.values() or NAMES.search(text) is not None or any(form(text) for form in MADE)


@pytest.fixture(scope="module")
def german(only_window):
    """Return a German window, every panel of which was opened, and its translator."""
    only_window.store.replace(State(method="seidel"))  # a file's warnings left there would be heard in English
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(languages, "Translation", Listening)
        patch.setattr(SolidPanel, "_probe", lambda panel: None)  # the renderer says nothing
        set_language("de")
        made = MainWindow(State(method="seidel", theme="light", language="de", f_number=8.0), measured=False)
        made.resize(1440, 900)
        made.show()
        for entry in REGISTRY:
            if entry.place != "main":
                made.open_panel(entry.key)
                made.grab()
        help_text(tuple(made.commands.commands))
        for command in made.commands.everything():
            named(command)
        yield made, QApplication.instance().findChild(Listening)
        made.close()
        set_language("en")


def test_nothing_shown_is_missing(german):
    _, translator = german
    missed = sorted(text for text in translator.missed if not is_german(text.strip()))
    assert not missed, "\n".join(missed)


def shown(window) -> set[str]:
    """Return the text of everything in a window that has one."""
    found = set()
    own = [w for w in window.findChildren(QWidget) if not w.objectName().startswith("Scroll")]  # these are Qt's
    for widget in [window, *own]:
        found |= {widget.toolTip(), widget.accessibleName()}
        if isinstance(widget, QAbstractButton | QLabel):
            found.add(widget.text())
        if isinstance(widget, QTabWidget):
            found |= {widget.tabText(k) for k in range(widget.count())}
        if isinstance(widget, QComboBox):
            found |= {widget.itemText(k) for k in range(widget.count())}
        found |= {action.text().split("\t")[0] for action in QWidget.actions(widget)}
    return {text.replace("\u00a0", " ") for text in found}


def test_nothing_shown_passes_the_language_by(german):
    window, translator = german
    pieces = {piece.strip() for text in shown(window) for piece in JOINTS.split(text)[::2]}
    passed = {p for p in pieces if LETTERS.search(p) and p not in translator.heard and not is_german(p)}
    assert not passed, "\n".join(sorted(passed))


def test_every_panel_and_control_is_defined_by_a_tooltip(german):
    window, _ = german
    for panel in window.panels.values():
        assert LETTERS.search(panel.widget.title.toolTip()), panel.widget.title.text()
    for part in (*window.controls.rows.values(), window.controls.stopping.stop, window.controls.stopping.clip):
        assert LETTERS.search(part.toolTip())
    for button in window.top.findChildren(QAbstractButton):
        assert button.toolTip(), button.text()


@pytest.mark.parametrize("size", [(1440, 900), (1280, 800)])
def test_every_label_and_button_fits(german, size):
    window, _ = german
    window.resize(*size)
    QApplication.processEvents()
    assert window.width() == size[0], "the words need more room than there is"
    parts = [w for w in window.findChildren(QAbstractButton) + window.findChildren(QLabel) if w.isVisible()]
    cut = {
        part.text()
        for part in parts
        if part.width() < part.minimumSizeHint().width() and part.objectName() != "readout" and part.text()
    }
    assert len(parts) > 40 and cut == set()


def test_what_is_sharp_is_said_whole_beside_the_german_curves(german):
    window, _ = german
    window.resize(1280, 800)
    window.store.update(tab="depth_of_field", depth_mm=12345.6, focus_mm=15000.0, f_number=8.0)
    QApplication.processEvents()
    readout = window.panels["depth_of_field"].widget.readout
    assert "scharf von" in readout.text() and readout.sizeHint().width() <= readout.width()


def test_qts_own_words_are_its_own_or_its_translators(qapp):
    set_language("de")
    try:
        assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Abbrechen"
        assert QCoreApplication.translate("nobody's", "words %1") == "words %1"
    finally:
        set_language("en")
    assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Cancel"


def test_english_needs_no_file_and_an_unknown_language_is_english(qapp):
    assert languages.languages() == {"en": "English", "de": "Deutsch"}
    assert languages.language_of("xx") == "en" and languages.language_of("de") == "de"


def test_a_change_of_language_reopens_the_window_and_undo_brings_it_back(only_window, qtbot):
    def made(state):
        return MainWindow(state, measured=False)

    speaking = LanguageSwitch(State(method="seidel", language="en"), made)
    try:
        first = speaking.window
        first.store.update(field_deg=7.0)
        first.store.update(language="de")
        speaking.reopen()
        assert current_language() == "de" and tr("Undo") == "Rückgängig"
        assert speaking.window is not first and speaking.window.top.undo.text() == "Rückgängig"
        speaking.window.store.undo()
        speaking.reopen()
        assert current_language() == "en" and speaking.window.top.undo.text() == "Undo"
        speaking.window.store.undo()
        assert speaking.window.store.state.field_deg == 10.0
    finally:
        set_language("en")
        speaking.window.close()


@pytest.mark.parametrize(
    ("changes", "german_words"),
    [
        ({"wavelength_nm": 150.0}, "Die Wellenlänge 150 nm liegt außerhalb der Daten von SCHOTT N-SSK2"),
        ({"field_deg": 95.0}, "Feldwinkel ist 95°; eine Zahl von −89 bis 89° angeben"),
        ({"field_deg": 60.0, "method": "fitted"}, "Der Hauptstrahl wird an Fläche 5 total reflektiert"),
        ({"focus_mm": 10.0}, "ist 10 mm, aber das Bild dieses Abstands liegt −456.132 mm vom letzten Scheitel"),
        ({"depth_mm": 29.32063039659634}, "liegt bei ∞ (NA 0), auf dem Sensor gibt es also keine PSF"),
    ],
)
def test_refusals_of_the_library_are_said_in_german(only_window, changes, german_words):
    with pytest.raises(P2SFError) as refused:
        live(replace(State(method="seidel"), **changes))
    assert german_words in Translation("de").said(in_the_windows_words(str(refused.value)))


def test_a_refusal_at_infinity_is_german_as_one_at_a_depth():
    corner = "No chief ray of an object at ∞ lands 5 mm from the axis, where the sensor's corner is; take"
    assert "eines Objekts bei ∞ landet 5 mm" in Translation("de").said(corner + " a smaller sensor")


def test_every_sentence_about_opengl_is_in_german():
    for code in (probe.NO_LIBRARY, probe.NO_CONTEXT):
        assert probe.sentence(code) in GERMAN
    assert probe.sentence(probe.WORKS) == ""


def test_a_reason_of_two_clauses_is_said_in_german_within_its_row():
    row = "26 numbers: 26 fitted numbers are the fewest that keep it; the next cheaper method does not (error 0.004)"
    assert "angepasste Zahlen" in Translation("de").said(row) and "(Fehler 0.004)" in Translation("de").said(row)


def test_oddities_of_a_lens_are_said_in_german(only_window):
    stop = "The stop on surface 3 has a semi-diameter of 9 mm, but a radius of 8 mm ends that surface at 8 mm; "
    nothing = "Every medium of this lens has the index 1, so no surface bends light; name its glasses."
    set_language("de")
    try:
        for warning in live(with_lens(State(), "relay")).warnings:
            assert is_german(said(warning)) and said(warning) != str(warning), warning
        assert "8 mm enden; abblenden" in tr(stop + "stop the lens down or move the stop.")
        assert "den Brechungsindex 1, also" in tr(nothing)
    finally:
        set_language("en")
