"""How the present lens was read from its file."""

from dataclasses import dataclass, replace

from p2sf.errors import P2SFError
from p2sf.lensfile.library import lenses_folder, shipped_lenses
from p2sf.lensfile.report import TITLES, ImportReport
from p2sf.messages import Message
from p2sf_explorer.compute.lens_files import import_of, is_file
from p2sf_explorer.compute.live import Live, View

REFUSED = Message("refused")


@dataclass(frozen=True)
class ImportView:
    """A heading, a line on file and format, and groups of (title, sentences) in reading order."""

    heading: str
    source: Message
    groups: tuple[tuple[Message, tuple[Message, ...]], ...]


def report(live: Live) -> View[ImportView]:
    """Return the import report of the state's lens."""
    state = live.state
    path = (
        str(lenses_folder() / f"{state.optics.lens}.toml")
        if state.optics.lens in shipped_lenses()
        else state.optics.lens
    )
    heading = live.setup.lens.title or live.setup.lens.name
    if not is_file(path):
        away = Message("{path} is not on this computer; the saved state carries the lens itself", path=path)
        return View(ImportView(heading, away, ()))
    try:
        as_filed = describe_report(heading, import_of(path).report)
    except P2SFError as error:
        as_filed = describe_refusal(heading, path, error.message)
    if state.optics.lens_text is None:
        return View(as_filed)
    edited = Message("{source}; {note}", source=as_filed.source, note=Message("edited since"))
    return View(replace(as_filed, source=edited))


def describe_report(heading: str, read: ImportReport) -> ImportView:
    """Return a report grouped by what happened to each thing of the file."""
    groups = ((Message(title), tuple(note.sentence for note in read.of(kind))) for kind, title in TITLES.items())
    source = Message(
        "{path} · {format} · {encoding}",
        path=read.path,
        format=Message(read.format),
        encoding=read.encoding,
    )
    return ImportView(heading, source, tuple((title, sentences) for title, sentences in groups if sentences))


def describe_refusal(heading: str, path: str, reason: Message) -> ImportView:
    """Return the report on a file that is refused; with consent to substitutes, what they would be."""
    groups = ((REFUSED, (without_path(reason),)),)
    try:
        accepted = describe_report(heading, import_of(path, True).report)
    except P2SFError:
        return ImportView(heading, Message("{path}", path=path), groups)
    consented = ((Message("with consent: {title}", title=title), notes) for title, notes in accepted.groups)
    return ImportView(heading, accepted.source, (*groups, *consented))


def without_path(reason: Message) -> Message:
    """Return the message of a `LensFileError` without its file's path, which stands above; any other as it is."""
    line, message = reason.values.get("line"), reason.values.get("message")
    if not isinstance(message, Message):
        return reason
    return Message("line {line}: {message}", line=line, message=message) if line else message
