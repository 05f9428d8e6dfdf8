"""Finding by a few letters: "psfm" finds "PSF field map". No Qt in here."""

from collections.abc import Iterable

START, NEXT, GAP = 8.0, 6.0, 0.3  # what a letter at a word's start and one right behind the last are worth; a gap costs


def score(sought: str, text: str) -> float | None:
    """Return how well letters in their order fit a text, None where they do not; case and spaces do not count."""
    letters, words = sought.casefold().replace(" ", ""), text.casefold()
    if not letters:
        return 0.0
    starts = (at for at, letter in enumerate(words) if letter == letters[0])
    return max((worth for at in starts for worth in _from(letters, words, at)), default=None)


def _from(letters: str, words: str, at: int):
    """Yield what the letters are worth when the first is taken at a place and each other as soon as it comes."""
    worth, last = 0.0, at - 1
    for letter in letters:
        found = _start(words, letter, last + 1)
        if found < 0:
            return
        worth += START if _begins(words, found) else NEXT if found == last + 1 else 0.0
        worth -= GAP * (found - last - 1)
        last = found
    yield worth - 0.01 * len(words)


def _start(words: str, letter: str, after: int) -> int:
    """Return where a letter comes next: right there, else at a word's start, else anywhere."""
    if words[after : after + 1] == letter:
        return after
    starts = [k for k in range(after, len(words)) if words[k] == letter and _begins(words, k)]
    return starts[0] if starts else words.find(letter, after)


def _begins(words: str, at: int) -> bool:
    return at == 0 or not words[at - 1].isalnum()


def ranked(sought: str, texts: Iterable[str]) -> list[int]:
    """Return the numbers of the texts that fit, the best first, equals in their order."""
    found = [(-worth, number) for number, text in enumerate(texts) if (worth := score(sought, text)) is not None]
    return [number for _, number in sorted(found)]
