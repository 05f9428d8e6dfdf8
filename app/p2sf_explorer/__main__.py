"""Start the explorer: ``p2sf explore [LENS|STATE.json|SNAPSHOT|LINK]`` or ``python -m p2sf_explorer``."""

import sys

from p2sf.errors import P2SFError
from p2sf.threads import one_blas_thread
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.files.opening import is_file, opened
from p2sf_explorer.shell.display import display_problem
from p2sf_explorer.state.link import is_link, state_of_link
from p2sf_explorer.state.state import State


def starting_state(argv: list[str]) -> State:
    """Return the state to open: a saved one, one from a link, a lens by name or path, or the default."""
    if not argv:
        return State()
    if is_link(argv[0]):
        return state_of_link(argv[0])
    return opened(State(), argv[0]) if is_file(argv[0]) else default_state(argv[0])


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
    """Run `main`; where it cannot open, print why and return 2."""
    try:
        return main(argv)
    except P2SFError as error:
        print(f"Error: {error}", file=sys.stderr)
        return 2


def _open(asked: State | None) -> int:
    from PySide6.QtWidgets import QApplication

    from p2sf_explorer.charts.theme import configure_plots
    from p2sf_explorer.crash.dialog import UnexpectedErrors
    from p2sf_explorer.crash.recovery import offer_rescued, session_to_open
    from p2sf_explorer.files.session_keeper import RunMark, SessionKeeper
    from p2sf_explorer.shell.language_switch import LanguageSwitch
    from p2sf_explorer.shell.window import MainWindow

    application = QApplication.instance() or QApplication(sys.argv[:1])
    application.setApplicationName("P2SF Explorer")
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
    code = application.exec()
    mark.end()
    return code


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
