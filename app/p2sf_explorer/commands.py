"""The commands of `p2sf` that need the explorer: its window, the report on a lens, sheets and results of the course."""

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName, Output, check_output
from p2sf.cli.screen import percent_line, print_json, print_table, warn
from p2sf.errors import ExportError, P2SFError
from p2sf.lens.misalignment import misalignments
from p2sf.messages import Message
from p2sf.paraxial.lens_checks import negative_glass

What = Annotated[str | None, Parameter(help="A lens, or a STATE.json, a snapshot or a p2sf:… link of the explorer.")]
ENDINGS = ".pdf", ".html", ".json"
Fields = Annotated[
    tuple[float, ...],
    Parameter(consume_multiple=True, negative="", help="Fields of the rows, degrees; five when not given."),
]
Frequencies = Annotated[
    tuple[float, ...],
    Parameter(consume_multiple=True, negative="", help="Cycles per mm on the sensor; 10 and 30 when not given."),
]
Results = Annotated[Path | None, Parameter(help="A folder with the files of results that students saved.")]
Sheets = Annotated[
    Path | None,
    Parameter(["--output", "-o"], negative="", help="Folder for the sheets; with --results a .csv file."),
]
Language = Annotated[str, Parameter(help="Language of the sheets, such as en or de.")]
PaperName = Annotated[Literal["a4", "letter"], Parameter(help="Paper of the sheets.")]
Clip = Annotated[bool, Parameter(negative="", help="Stop rays at every clear semi-diameter.")]


def explore(what: What = None, /) -> int:
    """Open the explorer on a lens, a saved state, a snapshot or a link, else as it was left; return its exit code."""
    missing = [name for name in ("PySide6", "pyqtgraph") if find_spec(name) is None]
    if missing:
        both = Message("{one} and {other}", one=missing[0], other=missing[-1])
        raise P2SFError(
            "the explorer needs {packages}, not installed here; run pip install 'p2sf[app]'",
            packages=both if len(missing) > 1 else missing[0],
        )
    from p2sf_explorer.application.main import main

    return int(main([what] if what else []))


def report(
    lens: LensName,
    /,
    *,
    request: Asked = AS_IN_THE_FILE,
    fields_deg: Fields = (),
    frequencies_per_mm: Frequencies = (),
    clip: Clip = False,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Show RMS, Strehl ratio, contrast, R80, distortion, light and colour over the field; write the report with -o.

    The file has prescription, first order, drawing, this table, MTF, MTF through focus, field curves, spots and PSFs,
    and a link that opens the lens in the window.
    """
    check_output(output, ENDINGS, lens)
    from p2sf_explorer.compute.setup import prescription
    from p2sf_explorer.compute.views.performance import answer, performance_request
    from p2sf_explorer.report.contents import report_of, requested_state
    from p2sf_explorer.report.writing import report_record, write_report
    from p2sf_explorer.state.state import change

    lists = {"curves_fields_deg": fields_deg, "curves_frequencies_per_mm": frequencies_per_mm}
    state = change(requested_state(lens, request), clip=clip, **lists)
    for fault in negative_glass(prescription(state)):
        warn(fault)
    if output is None and not as_json:
        table = answer(performance_request(state), lambda: False, lambda *_: None)
        heads = tuple(", ".join(filter(None, head)) for head in table.headings())
        print_table(lens, heads, table.rows())
        for why in (*misalignments(prescription(state)), *table.reasons):
            warn(why)
        return
    with percent_line() as tell:
        made = report_of(state, tell)
    if output:
        write_report(made, output)
    if as_json:
        print_json(report_record(made))
    for why in (*made.misalignment, *made.performance.reasons):
        warn(why)


def course(
    *, results: Results = None, output: Sheets = None, language: Language = "en", paper: PaperName = "a4"
) -> None:
    """Write the sheets of the course into a folder with -o: for students, with solutions, and a state for every page.

    With --results show the results of a class instead, students by tasks, or write them as CSV with -o.
    """
    if results is None:
        _write_sheets(output, language, paper)
        return
    check_output(output, (".csv",))
    from p2sf_explorer.course.lectures import find_lectures, task_keys
    from p2sf_explorer.course.results_table import concept_gain, read_folder, write_table

    lectures, _ = find_lectures()
    table = read_folder(results, task_keys(lectures.values()))
    for fault in table.faults:
        warn(fault.message)
    if output:
        write_table(table, output)
        return
    rows = []
    for task in table.tasks:
        found = table.summary(task)
        wrong = ", ".join(f"{answer} ({count})" for answer, count in found.wrong)
        rows.append((task, str(found.count), f"{100 * found.share_right:.0f} %", wrong))
    print_table(str(results), ("task", "tried", "right", "wrong at first"), rows)
    if gain := concept_gain(table):
        shares = f"{100 * gain.before:.0f} % right before, {100 * gain.after:.0f} % after"
        print(f"concept check of {gain.count}: {shares}, gain {gain.share_gained:.2f}")


def _write_sheets(output: Path | None, language: str, paper: str) -> None:
    from p2sf_explorer.course.sheets import write_course
    from p2sf_explorer.report.pages import PAPERS

    if output is None:
        raise ExportError("a folder for the sheets is missing; name one with -o, or results of a class with --results")
    with percent_line() as tell:
        written = write_course(output, language, PAPERS[paper], tell)
    sheets = sum(path.suffix == ".pdf" for path in written)
    print_table(str(output), ("sheets", "pages of lectures"), [(str(sheets), str(len(written) - sheets))])
