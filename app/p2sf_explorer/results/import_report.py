"""How the present lens was read from its file."""

from dataclasses import dataclass

from p2sf.errors import P2SFError
from p2sf.lensfile.library import lenses_folder, shipped_lenses
from p2sf.lensfile.report import TITLES, ImportReport
from p2sf_explorer.files.opening import imported, is_file
from p2sf_explorer.i18n.tr import tr

REFUSED = "refused"
AWAY = "{path} is not on this computer; the saved state carries the lens itself"


@dataclass(frozen=True)
class Report:
    """A heading, a line on file and format, and groups of (title, sentences) in reading order."""

    heading: str
    source: str
    groups: tuple[tuple[str, tuple[str, ...]], ...]


def report(live) -> Report:
    """Return the import report of the state's lens."""
    state = live.state
    path = str(lenses_folder() / f"{state.lens}.toml") if state.lens in shipped_lenses() else state.lens
    heading = live.setup.lens.title or live.setup.lens.name
    if not is_file(path):
        return Report(heading, tr(AWAY, path=path), ())
    try:
        found = described(heading, imported(path).report)
    except P2SFError as error:
        found = refused(heading, path, str(error))
    if state.lens_text is None:
        return found
    return Report(heading, f"{found.source}; {tr('edited since')}", found.groups)


def described(heading: str, read: ImportReport) -> Report:
    """Return a report grouped by what happened to each thing of the file."""
    groups = [(title, tuple(note.sentence for note in read.of(kind))) for kind, title in TITLES.items()]
    return Report(heading, f"{read.path} · {read.format} · {read.encoding}", tuple(g for g in groups if g[1]))


def refused(heading: str, path: str, sentence: str) -> Report:
    """Return the report on a file that is refused; with consent to substitutes, what they would be."""
    groups = ((REFUSED, (sentence.removeprefix(path).lstrip(",: "),)),)
    try:
        accepted = described(heading, imported(path, True).report)
    except P2SFError:
        return Report(heading, path, groups)
    return Report(heading, accepted.source, (*groups, *((f"with consent: {t}", s) for t, s in accepted.groups)))
