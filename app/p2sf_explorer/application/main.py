"""Start the explorer: ``p2sf explore [LENS|STATE.json|SNAPSHOT|LINK]`` or ``python -m p2sf_explorer``.

The program of the bundle is this file too. In place of what to open it takes --version, and --register or --unregister
for its entry in the menu of programs.
"""

import sys
from collections.abc import Callable

from p2sf.errors import P2SFError
from p2sf.threads import one_blas_thread
from p2sf.version import version_text
from p2sf_explorer.application.display import display_problem
from p2sf_explorer.application.registration import as_path, register, unregister
from p2sf_explorer.compute.lens_files import is_file
from p2sf_explorer.compute.setup import default_state, first_state
from p2sf_explorer.files.opening import open_file
from p2sf_explorer.scene3d import opengl_probe
from p2sf_explorer.state.link import is_link, state_of_link
from p2sf_explorer.state.state import State


def starting_state(argv: list[str]) -> State:
    """Return the state to open: a saved one, one from a link, a lens by name or path, or that of a first start."""
    if not argv:
        return first_state()
    if is_link(argv[0]):
        return state_of_link(argv[0])
    place = as_path(argv[0])
    return open_file(State(), place) if is_file(place) else default_state(place)


def main(argv: list[str]) -> int:
    """Open the window on ``argv`` (a lens, a state, a snapshot or a link), else as it was left; return Qt's exit code.

    Raises P2SFError when it cannot open.
    """
    problem = display_problem()
    if problem:
        raise P2SFError(problem)
    state = starting_state(argv) if argv else None
    with one_blas_thread:  # for as long as the window is there, so that a drag's many calls need not set it
        from p2sf_explorer.application.run import run_application

        return run_application(state)


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


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
