"""Lectures on paper: a sheet to write on for students, one with solutions and notes for who teaches. No window in here.

Beside the sheets lies a state for every page of a lecture, which the window opens at that page.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from p2sf.errors import ExportError
from p2sf.files.reasons import reason
from p2sf.files.writing import check_own, write_beside
from p2sf.messages import Message, Style
from p2sf_explorer.compute.layout import layout
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.course.lectures import BEFORE, CHECKS, FOLDER
from p2sf_explorer.files.snapshot import write_state
from p2sf_explorer.i18n.language import texts
from p2sf_explorer.lessons.lesson import ENGLISH, Lesson, Step, found_lessons
from p2sf_explorer.lessons.task import (
    SURE,
    ChoiceAnswer,
    Exercise,
    GoalAnswer,
    NumericAnswer,
    OrderAnswer,
    display_order,
    reason_order,
)
from p2sf_explorer.lessons.typed_numbers import written_value
from p2sf_explorer.report.figures import draw_lens
from p2sf_explorer.report.pages import A4, EDGE_MM, HEADING, Lettering, Paper, Sheet, pdf_of, wrap_lines

TITLE, BODY, SMALL = Lettering(16, bold=True), Lettering(9.5), Lettering(8, grey=True)
QUESTION = replace(BODY, bold=True)
FOOT_MM = 14.0  # at the lower edge, for the number of the page
INDENT_MM = 5.0
GAP_MM = 3.0  # between steps
DRAWING_MM = 36.0  # height of the lens
RULE_MM = 8.0  # between lines to write on
UNIT_GAP = re.compile(r"(?<=\d) (?=(?:[nµmk]?m|%|λ|waves?|Wellen?)(?!\w))")
ROOM = {NumericAnswer: 4, ChoiceAnswer: 2, OrderAnswer: 1, GoalAnswer: 3, type(None): 3}
"""Lines to write on below a question, by the kind of its answer."""
ENDINGS = ".pdf", "_solutions.pdf"
CREATOR = "P2SF Explorer"


class SheetWriter:
    """Writes onto sheets from top to bottom, and takes another one where the last is full."""

    def __init__(self, paper: Paper, words: Style) -> None:
        self.paper, self.words = paper, words
        self.pages = [Sheet(paper)]

    @property
    def page(self) -> Sheet:
        """Return the sheet that is written on."""
        return self.pages[-1]

    def keep(self, high_mm: float) -> None:
        """Take another sheet where less than this height is left."""
        if self.page.y + high_mm > self.paper.high_mm - FOOT_MM:
            self.pages.append(Sheet(self.paper))

    def gap(self, high_mm: float) -> None:
        """Leave some space, but none at the head of a sheet."""
        if self.page.y > EDGE_MM:
            self.page.y += high_mm

    def paragraph(self, text: str, lettering: Lettering = BODY, indent_mm: float = 0.0, mark: str = "") -> None:
        """Write a paragraph of Markdown, with a mark before its first line."""
        text = UNIT_GAP.sub("\u00a0", " ".join(text.split()))
        lines = wrap_lines(text, lettering, self.page.inner_mm - indent_mm)
        self.keep(min(len(lines), 2) * lettering.line_mm)
        if mark:
            self.page.put(EDGE_MM + indent_mm - INDENT_MM, self.page.y, mark, lettering)
        for line in lines:
            self.keep(lettering.line_mm)
            self.page.write_line(line, EDGE_MM + indent_mm)
        self.page.y += 1.2

    def markdown(self, text: str) -> None:
        """Write paragraphs and lists."""
        for block in filter(None, (part.strip() for part in text.split("\n\n"))):
            if block.startswith("- "):
                for item in block[2:].split("\n- "):
                    self.paragraph(item, indent_mm=INDENT_MM, mark="•")
            else:
                self.paragraph(block)

    def sentence(self, template: str, **values: object) -> str:
        """Return a text in the language of the sheets."""
        return Message(template, **values).text(self.words)

    def rules(self, count: int) -> None:
        """Draw lines to write on."""
        for _ in range(count):
            self.keep(RULE_MM)
            self.page.y += RULE_MM
            self.page.rule(self.page.y)
        self.page.y += 2.5


def lecture_sheets(lecture: Lesson, paper: Paper = A4, solved: bool = False) -> list[Sheet]:
    """Return the sheets of a lecture; with ``solved`` solutions, hints and notes stand where students write."""
    known = texts(lecture.language)
    point = known.get("decimal separator", ".")
    words = Style(translate=lambda text: known.get(text, text), number=lambda text: text.replace(".", point))
    out = SheetWriter(paper, words)
    _write_head(out, lecture, solved)
    for number, step in enumerate(lecture.steps):
        trial = SheetWriter(paper, out.words)
        _write_step(trial, step, solved)
        if len(trial.pages) == 1:  # a step that fits a page is not split
            out.keep(trial.page.y - EDGE_MM + GAP_MM)
        out.gap(GAP_MM)
        if lecture.name not in CHECKS:
            name = _file_name(lecture, number)
            out.page.put(paper.wide_mm - EDGE_MM, out.page.y + 0.8, name, replace(SMALL, side="right"))
        _write_step(out, step, solved)
    for number, page in enumerate(out.pages, 1):
        foot = paper.high_mm - FOOT_MM + 5
        page.put(EDGE_MM, foot, f"{_title(out, lecture, solved)} · P2SF Explorer", SMALL)
        page.put(paper.wide_mm - EDGE_MM, foot, f"{number}/{len(out.pages)}", replace(SMALL, side="right"))
    return out.pages


def _title(out: SheetWriter, lecture: Lesson, solved: bool) -> str:
    return out.sentence("{title}: solutions and notes", title=lecture.title) if solved else lecture.title


def _write_head(out: SheetWriter, lecture: Lesson, solved: bool) -> None:
    page = out.page
    for line in wrap_lines(_title(out, lecture, solved), TITLE, page.inner_mm):
        page.write_line(line)
    page.y += 1
    out.paragraph(lecture.about, replace(BODY, grey=True))
    if not solved:
        page.y += 4
        page.put(EDGE_MM, page.y, out.sentence("Name"))
        page.put(EDGE_MM + 0.7 * page.inner_mm, page.y, out.sentence("Date"))
        page.rule(page.y + 4.5, EDGE_MM + 14, 0.66 * page.inner_mm - 14)
        page.rule(page.y + 4.5, EDGE_MM + 0.7 * page.inner_mm + 14)
        page.y += 9
    state = lecture.state(0)
    axes = page.axes(EDGE_MM, page.y, page.inner_mm, DRAWING_MM)
    draw_lens(axes, layout(paraxial_setup(state), state.optics.clip, "field", 3))
    axes.set_axis_off()
    page.y += DRAWING_MM + 1
    page.write(paraxial_setup(state).lens.title, SMALL)
    if lecture.name not in CHECKS:
        page.write(
            out.sentence("Each page is in the window under Course…, and a file beside this sheet opens it."), SMALL
        )
    page.y += 2


def _write_step(out: SheetWriter, step: Step, solved: bool) -> None:
    out.page.write(step.title, HEADING)
    out.page.y += 1
    out.markdown(step.text)
    if step.attempt:
        out.paragraph(f"**{out.sentence('Try')}.** {step.attempt}")
    if step.question:
        out.paragraph(step.question, QUESTION)
    if step.task:
        _write_offers(out, step.task, solved)
    if solved:
        _write_solution(out, step)
    elif step.question:
        out.rules(ROOM[type(step.task.answer if step.task else None)])


def _write_offers(out: SheetWriter, task: Exercise, solved: bool) -> None:
    """Write what there is to choose from, or the items to be put in order, as the window shuffles them."""
    answer = task.answer
    if isinstance(answer, ChoiceAnswer):
        for k in display_order(task):
            picked = solved and k == answer.right
            out.paragraph(answer.options[k], BODY, 2 * INDENT_MM, "☒" if picked else "☐")
            if solved and answer.hints[k]:
                out.paragraph(answer.hints[k], SMALL, 2 * INDENT_MM)
        if answer.reasons:
            out.paragraph(out.sentence("Because …"))
            for k in reason_order(task):
                out.paragraph(answer.reasons[k], BODY, 2 * INDENT_MM, "☒" if solved and k == answer.why else "☐")
            sure = (f"☐\u00a0{out.sentence(words)}" for words in SURE)
            out.paragraph(f"{out.sentence('How sure are you?')} {'  '.join(sure)}")
    if isinstance(answer, OrderAnswer):
        for k in display_order(task):
            out.paragraph(answer.items[k], BODY, 3 * INDENT_MM, f"{k + 1}." if solved else "__")


def _write_solution(out: SheetWriter, step: Step) -> None:
    if step.answer:
        out.paragraph(f"**{out.sentence('Solution')}.** {step.answer}")
    if step.task:
        for number, hint in enumerate(step.task.hints, 1):
            out.paragraph(f"{out.sentence('Hint {number}', number=number)}: {hint}", SMALL, INDENT_MM)
        for wrong, hint in _mistakes(out, step.task):
            out.paragraph(f"{wrong}: {hint}", SMALL, INDENT_MM)
    if step.note:
        out.paragraph(f"**{out.sentence('For the lecturer')}.** {step.note}", replace(BODY, italic=True))


def _mistakes(out: SheetWriter, task: Exercise) -> list[tuple[str, str]]:
    """Return wrong answers that are foreseen, as text, with their hints; those of a choice stand beside it."""
    answer = task.answer
    if isinstance(answer, NumericAnswer):
        told = [out.words.number(written_value(part.number, part.unit)) for part, _ in answer.wrong]
    elif isinstance(answer, OrderAnswer):
        told = [" ".join(str(k + 1) for k in order) for order, _ in answer.wrong]
    else:
        return [(out.sentence("A mistake to expect"), hint) for hint in task.words.wrong]
    return [(out.sentence("Who answers {answer}", answer=one), hint)
            for one, hint in zip(told, task.words.wrong, strict=True)]  # fmt: skip


def _file_name(lecture: Lesson, number: int) -> str:
    return f"{lecture.name}_{number + 1}.json"


def sheet_languages() -> tuple[str, ...]:
    """Return the languages of the lectures."""
    return ENGLISH, *sorted(path.name for path in FOLDER.iterdir() if (path / f"{BEFORE}.md").is_file())


def write_course(
    folder: Path, language: str = ENGLISH, paper: Paper = A4, tell: Callable[[float], object] = lambda _: None
) -> tuple[Path, ...]:
    """Write sheets and solutions of every lecture as PDF, and the state of each page; return the paths.

    ``tell`` is called with the share that is done. Raises ExportError for a language that the lectures are not in, and
    where the folder cannot be made or written.
    """
    known = sheet_languages()
    if language not in known:
        raise ExportError(
            "{parameter} is {value}; choose one of {choices}", parameter="language", value=language, choices=known
        )
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(
            "{path} cannot be made ({reason}); choose another folder", path=str(folder), reason=reason(error)
        ) from None
    lectures, faults = found_lessons((FOLDER,), language)
    if faults:
        raise faults[0]
    written: list[Path] = []
    for done, lecture in enumerate(lectures.values(), 1):
        for ending, solved in zip(ENDINGS, (False, True), strict=True):
            written.append(_write_sheets(folder / f"{lecture.name}{ending}", lecture, paper, solved))
        if lecture.name not in CHECKS:
            pages = range(len(lecture.steps))
            written += [write_state(lecture.state(k), folder / _file_name(lecture, k)) for k in pages]
        tell(done / len(lectures))
    return tuple(written)


def _write_sheets(path: Path, lecture: Lesson, paper: Paper, solved: bool) -> Path:
    document = pdf_of(lecture_sheets(lecture, paper, solved), {"Title": lecture.title, "Creator": CREATOR})
    check_own(path, CREATOR.encode())
    write_beside(path, lambda handle: handle.write(document))
    return path
