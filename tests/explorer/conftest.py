import os
from functools import lru_cache

os.environ["QT_QPA_PLATFORM"] = "offscreen"  # before Qt is imported: tests need no screen

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from p2sf.psf import methods
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.views import tolerances as analysis
from p2sf_explorer.panels.image import panel as image
from p2sf_explorer.state.state import new_state
from p2sf_explorer.window.window import MainWindow
from tests.support.windows.windows import start_again

LONGEST_MS = 60_000  # that a test waits, on a machine with other work


class PatientBot(QtBot):
    """Waits as long as a machine with other work may take, where pytest-qt gives up after five seconds."""

    def waitUntil(self, callback, *, timeout=LONGEST_MS):
        super().waitUntil(callback, timeout=timeout)

    def waitSignal(self, signal, *, timeout=LONGEST_MS, **options):
        return super().waitSignal(signal, timeout=timeout, **options)


@pytest.fixture
def qtbot(qapp, request):
    return PatientBot(request)


@pytest.fixture(autouse=True, scope="session")
def own_memory(tmp_path_factory):
    """Keep the list of recent files of a test run out of the person's own."""
    with pytest.MonkeyPatch.context() as patch:
        path = tmp_path_factory.mktemp("memory") / "p2sf" / "recent.json"
        patch.setattr("p2sf_explorer.files.recent.recent_path", lambda: path)
        yield path


FEW_BUILDS = 400  # enough for what is told apart here


@pytest.fixture(autouse=True, scope="session")
def known_answers():
    """Work out once, for all tests, what the window asks again and again: sums of six coefficients, and builds."""
    work_out, known, live = analysis.Analyst.answer, {}, compute.live

    def answer(analyst, asked, *others):
        if asked not in known:
            known[asked] = work_out(analyst, asked, *others)
        return known[asked]

    def first_live(state, quality="settled", views=None, kept_method="", least=compute.ALONE, cache=None, before=None):
        """Answer for the state to which every test's window is brought back first, as it was answered before."""
        if state != FIRST or (quality, kept_method, least) != ("settled", "", compute.ALONE):
            return live(state, quality, views, kept_method, least, cache, before)
        key = tuple((views or {}).items())
        if key not in known:
            known[key] = live(state, views=views, cache=cache)
        return known[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(methods, "seidel_psf", lru_cache(maxsize=100)(methods.seidel_psf))
        patch.setattr(compute, "live", first_live)
        patch.setattr(analysis, "BUILDS", FEW_BUILDS)
        patch.setattr(analysis.Analyst, "answer", answer)
        yield


# The stage is so small that the PSF on it has no more samples than the answer.
FIRST = new_state(
    method="seidel", theme="light", show_more=True, rail=("layout", "pupil", "coefficients"), stage_share=0.3
)


@pytest.fixture(scope="session")
def only_window(qapp):
    qapp.setStyle("Fusion")
    made = MainWindow(FIRST, measured=False)
    made.resize(1440, 900)
    made.show()
    yield made
    made.close()


@pytest.fixture
def window(only_window, qtbot):
    """Return the one window as it was at first: to make a new one each time takes ten times as long."""
    start_again(only_window, FIRST)
    for button in QApplication.mouseButtons():
        qtbot.mouseRelease(only_window, button)  # a double-click of QTest ends without a release: moves would drag
    if focused := QApplication.focusWidget():
        focused.clearFocus()  # a shortcut is about the panel that has the focus
    only_window.activateWindow()  # shortcuts and editors answer in the active window only
    QApplication.processEvents()
    return only_window


@pytest.fixture
def image_panel(window, qtbot, monkeypatch):
    """Return the image panel of the window, photographing print; no plans are made."""
    monkeypatch.setattr(image, "fine_enough", lambda _: False)
    window.store.update(tab="image", photo_pixel_um=16.0, photo_source="text")
    made = window.panels["image"]
    qtbot.waitUntil(lambda: not made._stale())
    return made


@pytest.fixture
def drag(qtbot):
    """Return a function that drags a slider's handle to a travel with the mouse; ``release=False`` holds it there."""

    def move(slider, travel: float, release: bool = True, steps: int = 4) -> None:
        middle, start = 11, slider.handle_x()
        end = 9 + travel * (slider.width() - 18)
        qtbot.mousePress(slider, Qt.MouseButton.LeftButton, pos=QPointF(start, middle).toPoint())
        for k in range(1, steps + 1):
            at = start + (end - start) * k / steps
            qtbot.mouseMove(slider, QPointF(at, middle).toPoint())
        if release:
            qtbot.mouseRelease(slider, Qt.MouseButton.LeftButton, pos=QPointF(end, middle).toPoint())

    return move
