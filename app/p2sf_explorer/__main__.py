"""Start the explorer: ``p2sf explore [LENS|STATE.json|SNAPSHOT|LINK]`` or ``python -m p2sf_explorer``.

The program of the bundle is this file too. In place of what to open it takes --version, and --register or --unregister
for its entry in the menu of programs.
"""

import sys
from collections.abc import Callable

from p2sf.errors import P2SFError
from p2sf.threads import one_blas_thread
from p2sf.version import version_text
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.desktop.registration import ICON, NAME, as_path, register, unregister
from p2sf_explorer.files.opening import is_file, opened
from p2sf_explorer.scene3d import opengl_probe
from p2sf_explorer.shell.display import display_problem
from p2sf_explorer.state.link import is_link, state_of_link
from p2sf_explorer.state.state import State


def starting_state(argv: list[str]) -> State:
    """Return the state to open: a saved one, one from a link, a lens by name or path, or the default."""
    if not argv:
        return State()
    if is_link(argv[0]):
        return state_of_link(argv[0])
    place = as_path(argv[0])
    return opened(State(), place) if is_file(place) else default_state(place)


def main(argv: list[str]) -> int:
    """Open the window on ``argv`` (a lens, a state, a snapshot or a link), else as it was left; return Qt's exit code.

    Raises P2SFError when it cannot open.
    """
    problem = display_problem()
    if problem:
        raise P2SFError(problem)
    state = starting_state(argv) if argv else None
    with one_blas_thread:  # for as long as the window is there, so that a drag's many calls need not set it
        return _open(state)


def run(argv: list[str]) -> int:
    """Run `main`, or what an option asks for; where that cannot be, print why and return 2."""
    options: dict[str, Callable[[], object]] = {
        "--version": version_text,
        "--register": register,
        "--unregister": unregister,
    }
    try:
        if argv[:1] == [opengl_probe.OPTION]:
            return opengl_probe.main()
        if argv[:1] and argv[0] in options:
            print(options[argv[0]]())
            return 0
        return main(argv)
    except P2SFError as error:
        print(f"Error: {error}", file=sys.stderr)
        return 2


def _open(asked: State | None) -> int:
    from PySide6.QtGui import QIcon
    from PySide6.QtWidgets import QApplication

    from p2sf_explorer.charts.theme import configure_plots
    from p2sf_explorer.crash.dialog import UnexpectedErrors
    from p2sf_explorer.crash.recovery import offer_rescued, session_to_open
    from p2sf_explorer.desktop.open_events import OpenEvents
    from p2sf_explorer.files.session_keeper import RunMark, SessionKeeper
    from p2sf_explorer.shell.language_switch import LanguageSwitch
    from p2sf_explorer.shell.window import MainWindow

    application = QApplication.instance() or QApplication(sys.argv[:1])
    application.setApplicationName("P2SF Explorer")
    QApplication.setDesktopFileName(NAME)
    QApplication.setWindowIcon(QIcon(str(ICON)))
    QApplication.setStyle("Fusion")
    configure_plots()
    mark = RunMark()
    state, geometry = session_to_open(asked, crashed=mark.begin())
    keepers: list[SessionKeeper] = []

    def made(state: State) -> MainWindow:
        window = MainWindow(state)
        window.fit_screen()
        keepers[:] = [SessionKeeper(window, window.store, lambda: window.floating.open, geometry)]
        offer_rescued(window.store, window.column, window)
        window.teaching.offer_once()
        return window

    switch = LanguageSwitch(state, made, application)
    switch.window.show()
    errors = UnexpectedErrors(
        lambda: switch.window, lambda: switch.window.store.state, lambda: keepers[0].keep(), application
    )
    errors.install()
    OpenEvents(
        lambda path: switch.window.commands.open_path(path), lambda text: switch.window.sharing.open(text), application
    )
    code = application.exec()
    mark.end()
    return code


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
