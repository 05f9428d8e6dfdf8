"""The reading age of texts, by indices of their words and sentences."""

import re

MARKS = re.compile(r"[*_`#]|\(\S+\.md\)|^- ", re.MULTILINE)
WORD = re.compile(r"[A-Za-zÀ-ÿ’'-]*[A-Za-zÀ-ÿ]")
SENTENCE = re.compile(r"(?<=[.!?])[\s”“)]+|\n\n+|\n- ")
VOWELS = {"en": re.compile(r"[aeiouy]+"), "de": re.compile(r"aa|ee|oo|ie|ei|ai|eu|äu|au|[aeiouyäöü]")}
SILENT = re.compile(r"(?<=[^aeiouyl])e$|(?<=[^aeiouydt])ed$|(?<=[^aeiouyscxgz])es$")


def words_of(text: str) -> list[str]:
    """Return the words; numbers, symbols and units of one letter are none."""
    return [word for word in WORD.findall(MARKS.sub("", text)) if len(word) > 1 or word in "aAI"]


def sentences_of(text: str) -> int:
    """Return how many sentences there are; a heading, a paragraph and an item of a list end one."""
    return sum(bool(words_of(part)) for part in SENTENCE.split(text))


def syllables(word: str, language: str) -> int:
    """Return the syllables of a word: its groups of vowels, in English without silent endings."""
    plain = word.lower()
    if language == "en" and len(plain) > 3:
        plain = SILENT.sub("", plain)
    return max(1, len(VOWELS[language].findall(plain)))


def flesch_kincaid(text: str) -> float:
    """Return the grade of an English text: 0.39 words a sentence + 11.8 syllables a word − 15.59.

    Kincaid, Fishburne, Rogers and Chissom (1975), Naval Technical Training Command, Report 8-75.
    """
    words = words_of(text)
    spoken = sum(syllables(word, "en") for word in words)
    return 0.39 * len(words) / sentences_of(text) + 11.8 * spoken / len(words) - 15.59


def wiener_sachtextformel(text: str) -> float:
    """Return the grade of a German text: 0.1935 MS + 0.1672 SL + 0.1297 IW − 0.0327 ES − 0.875.

    MS, IW and ES are the shares of words of three syllables or more, of more than six letters, and of one syllable,
    per cent; SL is the mean length of sentences (Bamberger and Vanecek 1984, first formula).
    """
    words = words_of(text)
    spoken = [syllables(word, "de") for word in words]
    many, one = (100 * sum(map(share, spoken)) / len(words) for share in (lambda n: n >= 3, lambda n: n == 1))
    long = 100 * sum(len(word) > 6 for word in words) / len(words)
    return 0.1935 * many + 0.1672 * len(words) / sentences_of(text) + 0.1297 * long - 0.0327 * one - 0.875


GRADES = {"en": flesch_kincaid, "de": wiener_sachtextformel}
