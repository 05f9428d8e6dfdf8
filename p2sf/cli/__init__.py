"""The command line: `p2sf COMMAND`. Each command's module is loaded when it is called, none before."""

import os
import sys
import warnings
from collections.abc import Sequence
from io import TextIOWrapper
from typing import TYPE_CHECKING, TextIO

from p2sf.errors import FileWarning, P2SFError
from p2sf.messages import printable
from p2sf.parameters import COMMAND_LINE
from p2sf.version import version_text

if TYPE_CHECKING:
    from cyclopts import App, CycloptsError

FAILED, INTERRUPTED = 2, 130
COMMANDS = {  # by name: where it is, in a module of this folder unless another is named, and its summary
    "info": ("first_order:info", "First-order data of a lens: focal and principal points, stop, pupils, image."),
    "coefficients": ("first_order:coefficients_command", "The six wavefront coefficients and the Seidel sums."),
    "psf": ("images:psf", "The point spread function of one source, to a file or in a few figures."),
    "report": (
        "p2sf_explorer.commands:report",
        "What an engineer reads first of a lens; all of it as PDF, HTML or JSON.",
    ),
    "spot": ("spots:spot", "Where exact rays meet the sensor."),
    "tolerance": (
        "tolerances:tolerance",
        "Which errors of a built lens hurt, and the yield of random builds.",
    ),
    "nodes": ("nodes:nodes", "Where in the field of a misaligned lens coma and astigmatism vanish, and what moves it."),
    "zernike": ("zernikes:zernike", "The exact wavefront as Zernike terms, in waves and shares of its variance."),
    "measure": ("measuring:measure", "From a picture of points to the wavefronts that made it, with errors."),
    "compare": ("measuring:compare", "Two measurements of the same points beside each other."),
    "tradeoff": ("studies:tradeoff", "What every method costs in time and in error, measured."),
    "validate": ("studies:validate", "Figures that other programs published, beside this program's own."),
    "paper": ("studies:paper", "Redo the paper's two plots of results on this machine, and judge its claims."),
    "plan": ("scenes:plan_command", "The least model that a scene requires, each decision explained."),
    "image": ("scenes:image", "A picture through the lens, blurred as field, depth and colour demand."),
    "sharpen": ("scenes:sharpen", "A photo that the lens took, sharpened by the PSF of every place."),
    "course": (
        "p2sf_explorer.commands:course",
        "Sheets of the six lectures as PDF; the results of a class as a table.",
    ),
    "explore": ("p2sf_explorer.commands:explore", "The window: drag depth, field and wavelength, and watch."),
    "database": ("databases:app", "Every PSF of a lens as a file: build one, look into one."),
    "cluster": ("clusters:cluster", "How to render a stack on many machines, and who works there."),
    "export": ("exports:export", "A database or stack for ISETCam, FITS or ImageJ readers, or as a table."),
    "lenses": ("lenses:lenses", "The shipped lenses."),
    "import": (
        "importing:import_",
        "A lens of Zemax, CODE V, OSLO, ISET … with a report; --list does it for a folder.",
    ),
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command line, the process's own by default, and return its exit code.

    A failure is one sentence on standard error and code 2, without a traceback.
    """
    from cyclopts import CycloptsError

    _open_closed_streams()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")  # a terminal without ∞ or µ shows "?" and does not fail
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("always", FileWarning)
            warnings.showwarning = _show_warning
            code: int | None = _app()(arguments, exit_on_error=False, print_error=False)
        sys.stdout.flush()
        return code or 0
    except CycloptsError as error:
        return _fail(_usage(error))
    except P2SFError as error:
        return _fail(error.message.text(COMMAND_LINE))
    except BrokenPipeError:
        _forget_output()  # the reader, such as `head`, has seen enough
        return 0
    except OSError as error:
        _forget_output()
        return _fail(f"{error.filename or 'standard output'}: {error.strerror or error}; choose another place")
    except KeyboardInterrupt:
        return INTERRUPTED


def _open_closed_streams() -> None:
    """Give what is printed a place where the shell has closed it, as ``>&-`` does: Python has None there."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Print a warning of a writer of files as commands print theirs, others as Python does."""
    from p2sf.cli.screen import warn

    if isinstance(message, FileWarning):
        return warn(message.args[0])
    print(warnings.formatwarning(message, category, filename, lineno, line), end="", file=file or sys.stderr)
    return None


def _app() -> "App":
    """Return the tree of commands."""
    from cyclopts import App

    from p2sf.cli.options import check_whole_numbers

    app = App(
        name="p2sf",
        help="From a lens prescription to its point spread functions, with their accuracy.",
        version=version_text,
        version_format="plaintext",
        result_action="return_value",
        suppress_keyboard_interrupt=False,
        config=check_whole_numbers,
    )
    for name, (place, summary) in COMMANDS.items():
        app.command(place if "." in place else f"p2sf.cli.{place}", name=name, help=summary)
    return app


def command_line_markdown() -> str:
    """Return the help of every command as one page of Markdown."""
    return _app().generate_docs(output_format="markdown")


def _usage(error: "CycloptsError") -> str:
    """Return a wrong command line as one sentence that says where to look."""
    told, known, _ = str(error).partition("Available commands: ")
    names_eight = known and not error.command_chain  # of our commands, and leaves out the others
    text = f"{told}{known}{', '.join(COMMANDS)}" if names_eight else str(error)
    first, *others = text.removesuffix(", ...").rstrip(".").split(". ")
    parts = [first, *(part[:1].lower() + part[1:] for part in others)]
    command = " ".join(("p2sf", *(error.command_chain or ())))
    return f"{', '.join(parts)}; {command} --help lists what there is"


def _fail(sentence: str) -> int:
    line = printable(" ".join(sentence.split()))
    print(f"p2sf: {line}{'' if line.endswith(('.', '?')) else '.'}", file=sys.stderr)
    return FAILED


def _forget_output() -> None:
    """Point standard output nowhere, so that the interpreter's own last flush cannot fail again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
