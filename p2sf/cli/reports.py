"""`p2sf report`, what an engineer reads first of a lens, and `p2sf course`, what a lecturer reads of a class."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from p2sf.cli.options import AS_IN_THE_FILE, Asked, Json, LensName, Output, check_output
from p2sf.cli.screen import percent_line, print_json, print_table, warn

ENDINGS = ".pdf", ".html", ".json"
Fields = Annotated[
    tuple[float, ...],
    Parameter(consume_multiple=True, negative="", help="Fields of the rows, degrees; five when not given."),
]
Frequencies = Annotated[
    tuple[float, ...],
    Parameter(consume_multiple=True, negative="", help="Cycles per mm on the sensor; 10 and 30 when not given."),
]
Results = Annotated[Path, Parameter(help="A folder with the files of results that students saved.")]
Clip = Annotated[bool, Parameter(negative="", help="Stop rays at every clear semi-diameter.")]


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
    from p2sf_explorer.compute.views.performance import answer, performance_request
    from p2sf_explorer.report.contents import report_of, requested_state
    from p2sf_explorer.report.writing import report_record, write_report
    from p2sf_explorer.state.state import change

    lists = {"curves_fields_deg": fields_deg, "curves_frequencies_per_mm": frequencies_per_mm}
    state = change(requested_state(lens, request), clip=clip, **lists)
    if output is None and not as_json:
        table = answer(performance_request(state), lambda: False, lambda *_: None)
        heads = tuple(", ".join(filter(None, head)) for head in table.headings())
        print_table(lens, heads, table.rows())
        for why in table.reasons:
            warn(why)
        return
    with percent_line() as tell:
        made = report_of(state, tell or (lambda _: None))
    if output:
        write_report(made, output)
    if as_json:
        print_json(report_record(made))
    for why in made.performance.reasons:
        warn(why)


def course(*, results: Results, output: Output = None) -> None:
    """Show the results of a class, students by tasks; write them as CSV with -o."""
    check_output(output, (".csv",))
    from p2sf_explorer.course.lectures import find_lectures, task_keys
    from p2sf_explorer.course.results_table import read_folder, write_table

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
