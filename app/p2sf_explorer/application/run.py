"""The application: its window, and what goes with the window from start to end."""

import sys

from PySide6.QtCore import QTimer
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QApplication

from p2sf_explorer.application.crash_dialog import UnexpectedErrors
from p2sf_explorer.application.file_warnings import FileWarnings
from p2sf_explorer.application.language_switch import LanguageSwitch
from p2sf_explorer.application.open_events import OpenEvents
from p2sf_explorer.application.recovery import offer_rescued, session_to_open
from p2sf_explorer.application.registration import ICON, NAME
from p2sf_explorer.files.session_keeper import RunMark, SessionKeeper
from p2sf_explorer.state.state import State
from p2sf_explorer.window.start_screen import first_start
from p2sf_explorer.window.window import MainWindow


def run_application(asked: State | None) -> int:
    """Open the window as ``asked``, else as it was left, and return Qt's exit code once it is closed."""
    application = _qt_application()
    mark = RunMark()
    state, geometry = session_to_open(asked, crashed=mark.begin())
    keepers: list[SessionKeeper] = []

    def made(state: State) -> MainWindow:
        window = MainWindow(state)
        window.fit_screen()
        keepers[:] = [SessionKeeper(window, window.store, lambda: window.floating.open, geometry)]
        offer_rescued(window.store, window.edge.add, window)
        if asked is None and first_start():
            QTimer.singleShot(0, window.show_start)
        return window

    switch = LanguageSwitch(state, made, application)
    switch.window.show()
    errors = UnexpectedErrors(
        lambda: switch.window, lambda: switch.window.store.state, lambda: keepers[0].keep(), application
    )
    errors.install()
    FileWarnings(lambda told: switch.window.refuse(told), application).install()
    OpenEvents(
        lambda path: switch.window.commands.open_path(path), lambda text: switch.window.sharing.open(text), application
    )
    code = application.exec()
    mark.end()
    return code


def _qt_application() -> QApplication:
    application = QApplication(sys.argv[:1])
    application.setApplicationName("P2SF Explorer")
    QApplication.setDesktopFileName(NAME)
    QApplication.setWindowIcon(QIcon(str(ICON)))
    QApplication.setStyle("Fusion")
    return application
