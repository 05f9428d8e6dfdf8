"""German is complete: nothing the window shows is missing or passes it by, and every label fits."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QLabel, QLineEdit, QTabWidget, QWidget

from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.i18n import extract
from p2sf_explorer.i18n import language as languages
from p2sf_explorer.i18n.language import FOLDER, Translation, current_language, set_language, texts
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.panels.solid import SolidPanel
from p2sf_explorer.scene3d import opengl_probe as probe
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import State, entry, new_state
from p2sf_explorer.widgets.readout import FactTable, Readout
from p2sf_explorer.window.commands.command_palette import full_name
from p2sf_explorer.window.commands.help import help_text
from p2sf_explorer.window.window import MainWindow

ROOT = Path(__file__).parents[3]
LETTERS = re.compile(r"[^\W\d_]{3}")
GERMAN = texts("de")
FIELD = re.compile(r"\{[^{}]*\}")
JOINTS = re.compile(r"(<[^>]*>|&nbsp;| · |   ⚠ |^⚠ |\n)")  # between the texts on one line
FILLED = [
    re.compile(".+?".join(map(re.escape, FIELD.split(text)))).fullmatch
    for text in GERMAN.values()
    if "{" in text and LETTERS.search(FIELD.sub("", text))
]
# What a file, a lens, a glass, a key, a unit or a language is called is not translated.
NAMES = re.compile(
    r"^English$|^Deutsch$|^&\d  |^utf-8$|SCHOTT|OHARA|N-[A-Z]+\d+|P2SF|Ctrl\+|Alt\+|\d[\d.,]* (nm|mm|µm|ms)|f/\d"
)


def test_every_text_has_a_translation_with_the_same_braces():
    found = ElementTree.parse(FOLDER / "de.ts").findall(".//message")
    sources = [message.findtext("source") for message in found]
    assert len(sources) == len(set(sources)) > 500
    for message in found:
        source, said = message.findtext("source"), message.findtext("translation")
        assert said and said.strip(), source
        assert sorted(FIELD.findall(source)) == sorted(FIELD.findall(said)), source


class Listening(Translation):
    """A translator that notes the texts it has no translation for, and all that it returned."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.missed, self.heard = set(), set()

    def translate(self, context, source, disambiguation=None, n=-1):
        found = super().translate(context, source, disambiguation, n)
        if found is not None:
            self.heard.add(found)
            if source not in self.texts and LETTERS.search(FIELD.sub("", source)) and not is_german(source):
                self.missed.add(source)
        return found


def is_german(text: str) -> bool:
    return text in GERMAN.values() or NAMES.search(text) is not None or any(form(text) for form in FILLED)


START = new_state(method="seidel", theme="light", language="de", f_number=8.0)


@pytest.fixture(scope="module")
def german_window(only_window):
    """Return a German window, every panel of which was opened, and its translator."""
    only_window.store.replace(new_state(method="seidel"))  # a file's warnings left there would be heard in English
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(languages, "Translation", Listening)
        patch.setattr(SolidPanel, "_probe", lambda panel: None)  # the renderer says nothing
        set_language("de")
        made = MainWindow(START, measured=False)
        made.show()
        for entry in REGISTRY:
            made.open_panel(entry.key)
            made.grab()
        help_text(tuple(made.commands.commands))
        for command in made.commands.everything():
            full_name(command)
        yield made, QApplication.instance().findChild(Listening)
        made.close()
        set_language("en")


@pytest.fixture
def german(german_window):
    """Return the German window as it was at first, whatever the test before did, and its translator."""
    made, translator = german_window
    assert current_language() == "de", "a test of this module changed the language under the window"
    made.resize(1440, 900)
    made.store.replace(START)
    QApplication.processEvents()
    return made, translator


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
    heard = translator.heard | {text.partition(",")[0] for text in translator.heard}  # a lens's title, as far as that
    passed = {p for p in pieces if LETTERS.search(p) and p not in heard and not is_german(p)}
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
    window.store.update(stage="depth_of_field", stage_share=0.8, depth_mm=12345.6, focus_mm=15000.0, f_number=8.0)
    QApplication.processEvents()
    readout = window.panels["depth_of_field"].widget.readout
    assert "scharf von" in readout.text() and readout.sizeHint().width() <= readout.width()


@pytest.mark.parametrize("aim", ["stop", "paraxial"])
def test_pupils_of_the_matrix_are_read_in_german_as_rays_fill_them(german, aim):
    window, _ = german
    window.store.update(stage="matrix", matrix_what="pupil", aim=aim)
    matrix, pupil = (window.panels[key] for key in ("matrix", "pupil"))
    window.open_panel("pupil")
    assert matrix.grid.charts[0].labels == pupil.map.chart.labels
    assert set(matrix.grid.charts[0].labels) <= set(GERMAN.values())


def test_every_number_shown_has_a_comma(german):
    window, _ = german
    texts = shown(window)
    for kind in (Readout, QLineEdit):
        texts |= {part.text() for part in window.findChildren(kind)}
    for table in window.findChildren(FactTable):
        texts |= set(table.values)
    assert sum("," in text for text in texts) > 30
    assert not {text for text in texts if re.search(r"(?<!\d\.)\b\d+\.\d", text)}


def test_a_cell_of_the_lens_table_has_a_comma_and_is_typed_with_either(german):
    window, _ = german
    window.open_panel("lens")
    panel = window.panels["lens"]
    first = panel.model.index(0, 0)
    shown_text = panel.view.itemDelegate().displayText(first.data(), QLocale())
    edited = first.data(Qt.ItemDataRole.EditRole)
    assert "," in shown_text and "," in edited and "." in first.data(), "copied with a point"
    assert not panel.model.setData(first, edited), "nothing was changed"
    for typed in ("55,5", "55.5"):
        panel.model.setData(first, typed)
        assert window.live.setup.lens.surfaces[0].radius == 55.5
        window.store.undo()


def test_english_needs_no_file_and_an_unknown_language_is_english(qapp):
    assert languages.languages() == {"en": "English", "de": "Deutsch"}
    assert languages.language_of("xx") == "en" and languages.language_of("de") == "de"


def test_every_sentence_about_opengl_is_in_german():
    for code in (probe.NO_LIBRARY, probe.NO_CONTEXT):
        assert probe.sentence(code) in GERMAN
    assert probe.sentence(probe.WORKS) == ""


def test_warnings_on_a_lens_are_said_in_german(german):
    for warning in live(with_lens(State(), "relay")).warnings:
        assert is_german(said(warning)) and said(warning) != str(warning)


@pytest.mark.slow
def test_one_command_begins_a_new_language(tmp_path, monkeypatch, capsys):
    """It is written whole, lists all as missing, and a text that is then translated is no longer listed."""
    monkeypatch.setattr(extract, "FOLDER", tmp_path)
    monkeypatch.setattr(languages, "FOLDER", tmp_path)
    assert extract.main(["fr"]) == 1
    path, told = tmp_path / "fr.ts", capsys.readouterr().out
    assert str(path) in told and f"{len(extract.required_texts())} texts missing in fr" in told
    assert texts("fr") == {} and languages.languages() == {"en": "English", "fr": "Français"}
    pattern = "<source>Field</source>" + extract.UNFINISHED
    written = path.read_text(encoding="utf-8")
    assert written.count(pattern) == 1
    path.write_text(
        written.replace(pattern, "<source>Field</source><translation>Champ</translation>"), encoding="utf-8"
    )
    assert extract.main(["fr"]) == 1
    assert f"{len(extract.required_texts()) - 1} texts missing in fr" in capsys.readouterr().out
    assert texts("fr") == {"Field": "Champ"}
    assert extract.main(["nonsense"]) == 2 and not (tmp_path / "nonsense.ts").exists()


@pytest.mark.parametrize("key", ["depth_mm", "focus_mm"])
def test_a_depth_that_can_mean_two_numbers_is_refused_with_both(german, key):
    """1.500 mm was taken for 1.5 mm, while a point separates thousands in German."""
    window, _ = german
    before = entry(window.store.state, key)
    said = []
    window.store.refused.connect(said.append)
    row = window.controls.rows[key]
    row.edit.setText("1.500 mm")
    row.edit.setModified(True)
    row.edit._commit()
    assert entry(window.store.state, key) == before
    assert len(said) == 1 and "1500" in str(said[0]) and "1,500" in str(said[0])
    for text, value in (("1500 mm", 1500.0), ("1500,5 mm", 1500.5), ("2,500 m", 2500.0)):
        row.edit.setText(text)
        row.edit.setModified(True)
        row.edit._commit()
        assert entry(window.store.state, key) == value
    assert len(said) == 1
