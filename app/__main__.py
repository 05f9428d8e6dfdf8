"""Start the explorer: ``p2sf explore [LENS|STATE.json]`` or ``python -m app``."""

import sys

from app.display import display_problem
from app.opening import is_file, opened
from app.setting import default_state
from app.state import State
from p2sf.errors import P2SFError


def starting_state(argv: list[str]) -> State:
    """Return the state to open: a saved one, a lens by name or path, or the default."""
    if not argv:
        return State()
    return opened(State(), argv[0]) if is_file(argv[0]) else default_state(argv[0])


def main(argv: list[str]) -> int:
    """Open the window on ``argv`` (a lens or a state file), return Qt's exit code; P2SFError when it cannot open."""
    problem = display_problem()
    if problem:
        raise P2SFError(problem)
    state = starting_state(argv)
    from threadpoolctl import threadpool_limits

    with threadpool_limits(limits=1):  # two BLAS threads double these small products
        return _open(state)


def run(argv: list[str]) -> int:
    """Do what `main` does, but say a refusal in one sentence and return 2."""
    try:
        return main(argv)
    except P2SFError as error:
        print(f"Error: {error}", file=sys.stderr)
        return 2


def _open(state: State) -> int:
    from PySide6.QtWidgets import QApplication

    from app.theme import configure_plots
    from app.window import Window

    application = QApplication.instance() or QApplication(sys.argv[:1])
    application.setApplicationName("P2SF Explorer")
    application.setStyle("Fusion")
    configure_plots()
    window = Window(state)
    window.show()
    return application.exec()


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
