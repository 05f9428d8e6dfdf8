"""Opening files of every kind: dialog, drop, report, refusal, recent files, and a file that changes on disk."""

import json
import os
import shutil
import zipfile
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDropEvent
from PySide6.QtWidgets import QFileDialog

from p2sf.lensfile.library import lenses_folder
from p2sf.messages import Style
from p2sf_explorer.compute.lens_files import import_of
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.compute.views.import_report import describe_report
from p2sf_explorer.files import recent
from p2sf_explorer.files.recent import recent_files, remember
from p2sf_explorer.files.snapshot import write_state
from p2sf_explorer.i18n.language import texts
from p2sf_explorer.state.state import change, new_state

FILES = Path(__file__).parents[2] / "data" / "import"
FOREIGN = ("bench.txt", "doublet.seq", "doublet.zmx", "gauss.dat", "singlet.csv", "triplet.json")


@pytest.fixture
def zemax(tmp_path) -> Path:
    return Path(shutil.copy(FILES / "doublet.zmx", tmp_path))


@pytest.fixture
def obsolete(zemax) -> Path:
    """Return a file whose glass is no longer sold, so that a substitute needs consent."""
    zemax.write_text(zemax.read_text().replace("GLAS N-BK7", "GLAS S-BK7"))
    return zemax


def drop(window, path) -> None:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(QPointF(5, 5).toPoint(), Qt.DropAction.CopyAction, data, buttons, keys)
    window.dragEnterEvent(enter)
    assert enter.isAccepted()
    window.dropEvent(QDropEvent(QPointF(5, 5), Qt.DropAction.CopyAction, data, buttons, keys))


@pytest.mark.parametrize("name", FOREIGN)
def test_every_kind_of_file_dropped_shows_its_lens_and_report(window, name):
    drop(window, FILES / name)
    assert not window.banner.isVisible()
    assert window.live.state.optics.lens == str(FILES / name)
    text = window.panels["import"].text.toPlainText()
    assert name in text
    assert "Read" in text


def test_a_report_is_in_german_where_the_window_is():
    known = texts("de")
    german = Style(translate=lambda text: known.get(text, text))
    for path in (*(FILES / name for name in FOREIGN), lenses_folder() / "tessar.toml"):
        for title, sentences in describe_report("", import_of(str(path)).report).groups:
            for english in (title, *sentences):
                assert english.text(german) != str(english), english
                assert not {"the", "of", "is", "are", "as", "on"} & set(english.text(german).split()), english


def test_a_zipped_lens_from_the_open_dialog_by_its_key(window, qtbot, tmp_path, zemax, monkeypatch):
    path = tmp_path / "mine.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(zemax, "lens.zmx")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)  # a shortcut answers in the active window only
    qtbot.keyClick(window, Qt.Key.Key_O, Qt.KeyboardModifier.ControlModifier)
    assert window.live.state.optics.lens == str(path)
    assert "lens.zmx" in window.panels["import"].text.toPlainText()


def test_a_state_is_known_by_its_content_not_its_ending(window, tmp_path):
    state = new_state(lens="tessar", field_deg=3.0, method="seidel", theme="light")
    path = Path(shutil.move(write_state(state, tmp_path / "a.json"), tmp_path / "state.txt"))
    drop(window, path)
    assert window.store.state == state


@pytest.mark.parametrize("name", FOREIGN[1:])
def test_opening_is_one_undo(window, name):
    first = window.store.state
    window.commands.open_path(str(FILES / name))
    window.store.undo()
    assert window.store.state == first


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("mirror.zmx", "SURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.1\n  GLAS MIRROR\nSURF 2\n", "mirror"),
        ("letter.txt", "dear friend,\n", "no lens surface"),
        ("broken.json", "{", "line 1"),
    ],
)
def test_a_file_that_is_no_lens_is_refused_in_banner_and_report(window, tmp_path, name, text, words):
    lens = window.store.state.optics.lens
    path = tmp_path / name
    path.write_text(text)
    drop(window, path)
    assert window.store.state.optics.lens == lens
    assert words in window.banner.text.text().lower()
    report = window.panels["import"]
    assert "Refused" in report.text.toPlainText()
    assert words in report.text.toPlainText().lower()
    assert not report.accept.isVisible()
    window.store.update(field_deg=5.0)
    assert "Refused" in report.text.toPlainText()  # until another lens comes
    window.commands.open_lens("tessar")
    assert "Refused" not in report.text.toPlainText()


def test_substitutes_need_consent_and_then_count_as_an_edit(window, qtbot, obsolete):
    drop(window, obsolete)
    report = window.panels["import"]
    assert "accept a substitute" in window.banner.text.text()
    assert "With consent: substituted" in report.text.toPlainText()
    qtbot.mouseClick(report.accept, Qt.MouseButton.LeftButton)
    assert window.live.state.optics.lens == str(obsolete)
    assert window.live.setup.lens.surfaces[0].medium.label == "SCHOTT N-BK7"
    assert window.top.edited.isVisible()
    assert not report.accept.isVisible()


def test_the_report_of_a_shipped_lens_and_of_a_lens_whose_file_is_gone(window, zemax):
    window.open_panel("import")
    assert "exactly as written" in window.panels["import"].text.toPlainText()
    lens_text = (lenses_folder() / "tessar.toml").read_text()
    window.store.replace(change(window.store.state, lens="/nowhere/mine.zmx", lens_text=lens_text))
    assert not window.banner.isVisible()
    assert "not on this computer" in window.panels["import"].text.toPlainText()


def test_a_file_changed_on_disk_is_read_again(window, qtbot, zemax):
    window.commands.open_path(str(zemax))
    beside = zemax.with_suffix(".new")  # as editors save: a new file renamed into its place
    beside.write_text(zemax.read_text().replace("DISZ 6.0", "DISZ 6.5"))
    os.replace(beside, zemax)
    qtbot.waitUntil(lambda: prescription(window.live.state).surfaces[0].thickness == 6.5)
    qtbot.waitUntil(lambda: window.live.setup.lens.surfaces[0].thickness == 6.5)
    zemax.write_text(zemax.read_text().replace("DISZ 6.5", "DISZ 7.5"))  # and written in place, a second time
    qtbot.waitUntil(lambda: window.live.setup.lens.surfaces[0].thickness == 7.5)
    assert "read again" in window.status.warning.text()


def test_a_file_spoilt_on_disk_is_a_sentence_and_the_picture_stays(window, qtbot, zemax):
    window.commands.open_path(str(zemax))
    live = window.live
    zemax.write_text("nothing")
    qtbot.waitUntil(window.banner.isVisible)
    assert window.live is live


def test_edits_outlive_a_change_on_disk(window, qtbot, zemax):
    window.commands.open_path(str(zemax))
    window.open_panel("lens")
    model = window.panels["lens"].model
    model.setData(model.index(0, 0), "70")
    zemax.write_text(zemax.read_text().replace("DISZ 6.0", "DISZ 6.5"))
    qtbot.waitUntil(lambda: "your edits are kept" in window.status.warning.text())
    assert window.live.setup.lens.surfaces[0].radius == 70


def test_recent_files_are_listed_newest_first_and_open(window, tmp_path):
    paths = [Path(shutil.copy(FILES / name, tmp_path)) for name in FOREIGN[:3]]
    for path in paths:
        window.commands.open_path(str(path))
    entries = [action for action in window.top.open.menu().actions() if action.toolTip().startswith(str(tmp_path))]
    assert [action.toolTip() for action in entries] == [str(path) for path in reversed(paths)]
    entries[-1].trigger()
    assert window.store.state.optics.lens == str(paths[0])
    assert recent_files()[0] == str(paths[0])


def test_at_most_ten_are_kept_gone_ones_are_dropped_and_a_damaged_list_is_none(tmp_path):
    paths = [tmp_path / f"{k}.toml" for k in range(12)]
    for path in paths:
        path.write_text("x")
        remember(str(path))
    assert recent_files() == tuple(str(path) for path in reversed(paths[2:]))
    paths[-1].unlink()
    assert recent_files()[0] == str(paths[-2])
    for damaged in ("{", '{"a": 1}', "[1, null]", json.dumps(["\0"])):
        recent.recent_path().write_text(damaged)
        assert recent_files() == ()


def test_a_folder_that_cannot_be_written_to_costs_only_the_memory(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setattr("p2sf_explorer.files.recent.recent_path", lambda: tmp_path / "file" / "recent.json")
    remember(str(tmp_path / "file"))
    assert recent_files() == ()


def test_the_banner_itself_accepts_substitutes(window, qtbot, obsolete):
    drop(window, obsolete)
    assert window.banner.remedy.isVisible()
    qtbot.mouseClick(window.banner.remedy, Qt.MouseButton.LeftButton)
    assert window.live.setup.lens.surfaces[0].medium.label == "SCHOTT N-BK7"
    assert not window.banner.isVisible()
    window.commands.open_path("/nowhere/at_all.zmx")
    assert window.banner.isVisible() and not window.banner.remedy.isVisible(), "nothing to accept"


def test_what_is_dragged_over_the_window_is_framed_until_it_leaves_or_falls(window, zemax):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(zemax))])
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(QPointF(5, 5).toPoint(), Qt.DropAction.CopyAction, data, buttons, keys)
    frame = window.drop_frame
    assert not frame.isVisible()
    window.dragEnterEvent(enter)
    assert frame.isVisible() and frame.geometry() == window.rect() and zemax.name in frame.words
    window.dragLeaveEvent(QDragLeaveEvent())
    assert not frame.isVisible()
    drop(window, zemax)
    assert not frame.isVisible()
    empty = QMimeData()  # the event does not keep it
    nothing = QDragEnterEvent(QPointF(5, 5).toPoint(), Qt.DropAction.CopyAction, empty, buttons, keys)
    window.dragEnterEvent(nothing)
    assert not frame.isVisible(), "nothing that could be opened"
