"""A window that serves many tests, each of which finds it as it was at first."""

from PySide6.QtCore import QEvent, QRect
from PySide6.QtWidgets import QApplication, QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.panels import end_work
from p2sf_explorer.state.workspaces import on_show
from p2sf_explorer.store.store import Store
from p2sf_explorer.window.window import FIRST_SIZE


def settled(panel, qtbot) -> None:
    """Wait until a panel shows the answer to what it was asked last: nothing runs or waits."""
    qtbot.waitUntil(lambda: not panel.late.busy)


def at_rest(window, qtbot) -> None:
    """Wait until nothing that the window shows is still being computed, and all of it is laid out."""
    qtbot.waitUntil(lambda: not window.is_busy())
    before: list[QRect] = []
    while before != (before := places(window)):  # each round of events may move what the next one lays out
        QApplication.processEvents()


def places(window) -> list[QRect]:
    """Return where every widget on show is."""
    return [part.geometry() for part in window.findChildren(QWidget) if part.isVisible()]


def start_again(window, state) -> None:
    """Bring a window back to a state without steps of undo, selection, film, lesson, and panels opened since."""
    window.presentation.stop()
    window.play.player.pause()
    window.play.filming.cancel()
    for other in QApplication.topLevelWidgets():
        if other is not window and other.isVisible():
            other.hide()
    window.resize(*FIRST_SIZE)
    window.store.take_over(Store(state))
    window.store.select(None)
    window.store.point_at(0)
    close_panels(window, on_show(state.display))
    for chart in window.findChildren(Chart):
        chart.unpin_all()
        chart.go_home()
        if chart.locked:
            chart.turn_lock("all")
    window.store.changed.emit(state)


def close_panels(window, kept: tuple[str, ...]) -> None:
    """Give up every other panel with its background work: a new one is made where a test opens it."""
    for key in set(window.panels) - set(kept):
        panel = window.panels.pop(key)
        window._styled.pop(key, None)
        window.floating._at.pop(key, None)
        end_work(panel)
        panel.widget.hide()
        panel.widget.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
