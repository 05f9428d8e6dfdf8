"""Reading age of the course and the lessons in English and German: ``python -m tests.long.reading_age [--sentences]``.

Printed: the school grade of every file, by Flesch and Kincaid in English and the Wiener Sachtextformel in German.
``--sentences`` adds the longest sentences of each.
"""

import argparse
import re
from collections.abc import Iterator

from p2sf_explorer.course.lectures import FOLDER as COURSE
from p2sf_explorer.lessons.lesson import FOLDER as LESSONS
from p2sf_explorer.lessons.lesson import Lesson, Step, lesson_files, read_lesson, with_words
from tests.support.reading_age import GRADES, SENTENCE, words_of

HIGHEST = 10.0  # the grade at which pupils are 16
CODE = re.compile(r"exp\[[^]]*\]²?\]?|\|Wd\||1/\([^)]*\)")


def texts_of(step: Step) -> list[str]:
    """Return the sentences that a reader reads in a step; titles, options and items, which are short, are left out."""
    texts = [step.text, step.attempt, step.question, step.answer, step.note]
    if step.task:
        words = step.task.words
        texts += [*words.option_hints, *words.wrong, *words.hints]
    return [CODE.sub("", text) for text in texts if text]


def text_of(lesson: Lesson) -> str:
    """Return all texts of a lesson, parted by blank lines."""
    return "\n\n".join([lesson.about, *(text for step in lesson.steps for text in texts_of(step))])


def read_all() -> Iterator[tuple[str, str, str]]:
    """Yield file, language and text of every lecture and lesson."""
    for path in (path for folder in (COURSE, LESSONS) for path in lesson_files(folder)):
        english = read_lesson(path)
        yield path.stem, "en", text_of(english)
        yield path.stem, "de", text_of(with_words(english, path.parent / "de" / path.name, "de"))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sentences", action="store_true")
    long = parser.parse_args().sentences
    for name, language, text in read_all():
        grade = GRADES[language](text)
        print(f"{name:36} {language} {grade:5.1f}{'  too hard' if grade > HIGHEST else ''}")
        if long:
            for sentence in sorted(SENTENCE.split(text), key=lambda part: -len(words_of(part)))[:3]:
                print(f"    {len(words_of(sentence)):3} {' '.join(sentence.split())}")


if __name__ == "__main__":
    main()
