"""Lens files as text: size limits, encodings, archives, numbers with their line, and writing whole."""

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from p2sf.conventions import FloatOrArray
from p2sf.errors import LensFileError
from p2sf.files.reading import open_file
from p2sf.files.reasons import reason
from p2sf.messages import Message

LARGEST_FILE = 1_000_000  # bytes of a file of this program; a lens takes a few thousand
MOST_LINES = 100_000  # a thousand surfaces take 15 000, the largest glass catalogue 20 000
LONGEST_LINE = 300_000
BYTE_ORDER_MARKS = (("utf-8-sig", b"\xef\xbb\xbf"), ("utf-16", b"\xff\xfe"), ("utf-16", b"\xfe\xff"))


@dataclass(frozen=True)
class LensText:
    """A lens file as text, with the path it was read from and the encoding it was written in.

    ``beside`` are the glass catalogues that lie with it in an archive.
    """

    path: str
    encoding: str
    text: str
    beside: tuple["LensText", ...] = ()

    @cached_property
    def lines(self) -> tuple[str, ...]:
        """Return the lines; only line feeds and carriage returns end one, as every editor counts them."""
        return tuple(self.text.replace("\r\n", "\n").replace("\r", "\n").split("\n"))

    def error(self, template: str | Message, /, line: int | None = None, **values: object) -> LensFileError:
        """Return the error that names this file and a line (from 1), with the values its template names."""
        return LensFileError(
            template if isinstance(template, Message) else Message(template, **values), self.path, line
        )


def read_source(path: str | os.PathLike) -> LensText:
    """Return the text of a lens file, or of the first lens inside a zip or .zar archive.

    Raises LensFileError for a missing or unreadable file, one of over 4 MB, and an archive without a lens.
    """
    return source_of(read_bytes(path), str(path))


def source_of(data: bytes, path: str) -> LensText:
    """Return the text of a lens file's bytes; an archive is opened, another binary file refused."""
    from p2sf.lensfile.archives import is_archive, unpack

    if is_archive(data):
        first, *others = unpack(data, path)
        return replace(_text(first[1], f"{path}/{first[0]}"), beside=tuple(_texts(others, path)))
    return _text(data, path)


def _text(data: bytes, path: str) -> LensText:
    text, encoding = decode(data)
    if "\0" in text:
        line = text[: text.index("\0")].count("\n") + 1
        told = "the file is not text but binary; give the lens as a text file"
        if path.lower().endswith(".zos"):
            told = "a .zos file is in a form of OpticStudio's own; open it there and save it as .zmx or .zar"
        raise LensFileError(told, path, line)
    source = LensText(path, encoding, text)
    _check_lines(source)
    return source


def _texts(members: list[tuple[str, bytes]], path: str) -> Iterator[LensText]:
    """Yield the catalogues of an archive; one that is not text is left out, as one in the folder of a lens is."""
    for name, data in members:
        try:
            yield _text(data, f"{path}/{name}")
        except LensFileError:
            continue


def _check_lines(source: LensText) -> None:
    if len(source.lines) > MOST_LINES:
        raise source.error(
            "the file has over {count} lines; a prescription is far smaller", MOST_LINES, count=MOST_LINES
        )
    long = next((n for n, line in enumerate(source.lines, 1) if len(line) > LONGEST_LINE), None)
    if long:
        raise source.error("the line has over {count} characters; this is not a lens file", long, count=LONGEST_LINE)


def read_bytes(path: str | os.PathLike) -> bytes:
    """Return the bytes of a file; LensFileError when it is missing, a folder, or over 4 MB."""
    from p2sf.lensfile.archives import LARGEST_BYTES, check_size

    try:
        with open_file(path) as stream:
            data = stream.read(LARGEST_BYTES + 1)
    except FileNotFoundError:
        raise LensFileError("there is no such file; check the path", path) from None
    except IsADirectoryError:
        raise LensFileError("this is a folder; name a file in it", path) from None
    except (OSError, ValueError) as failure:
        raise LensFileError(
            "the file cannot be read ({reason}); check its path and permissions",
            path,
            reason=reason(failure),
        ) from None
    check_size(len(data), str(path))
    return data


def decode(data: bytes) -> tuple[str, str]:
    """Return text and encoding name: by byte order mark, by UTF-16's zero bytes, else UTF-8, else Latin-1."""
    for encoding, mark in BYTE_ORDER_MARKS:
        if data.startswith(mark):
            return data.decode(encoding, errors="replace"), encoding
    for encoding, zeros in (("utf-16-le", data[1:200:2]), ("utf-16-be", data[0:200:2])):
        if len(zeros) > 1 and not any(zeros):
            return data.decode(encoding, errors="replace"), encoding
    try:
        return data.decode("utf-8"), "utf-8"
    except UnicodeDecodeError:
        return data.decode("latin-1"), "latin-1"


def number(word: str, what: str | Message, source: LensText, line: int) -> float:
    """Return a finite number; LensFileError with its line for any other word.

    ``what`` names the number in the error: a Message for words of the language, a str for a name in the file.
    """
    try:
        value = float(word.upper().replace("D", "E"))
    except ValueError:
        value = math.nan
    if not abs(value) < 1e100:
        raise source.error('{what} "{word}" is not a number; correct it', line, what=what, word=word[:40])
    return value


def is_infinite(word: str) -> bool:
    """Return whether a word of a file stands for infinity, of either sign."""
    return word.strip().lstrip("+-").lower() in ("inf", "infinity", "∞")


def curvature(word: str, what: str | Message, source: LensText, line: int) -> float:
    """Return the curvature of a radius, which is 0, infinite or a word for a plane; LensFileError."""
    if is_infinite(word) or word.strip().lower() in ("", "plano", "plane", "flat"):
        return 0.0
    radius = number(word, what, source, line)
    return 1 / radius if radius else 0.0


def whole(word: str, what: str | Message, source: LensText, line: int) -> int:
    """Return a whole number; LensFileError with its line for any other word."""
    value = number(word, what, source, line)
    if value != int(value) or abs(value) > 1e6:
        raise source.error('{what} "{word}" is not a whole number; correct it', line, what=what, word=word[:40])
    return int(value)


def digits(value: FloatOrArray) -> str:
    """Return a number, also one of numpy's, in the digits that read back as itself."""
    return repr(float(value))


def read_text(path: str | os.PathLike) -> str:
    """Return the text of a lens file of this program.

    Raises LensFileError for a file that is missing, unreadable, empty, huge or not UTF-8.
    """
    try:
        return _decode(_bytes(Path(path)), path)
    except FileNotFoundError:
        raise LensFileError("there is no such file; check the path", path) from None
    except IsADirectoryError:
        raise LensFileError("this is a folder; name a file in it", path) from None
    except LensFileError:
        raise
    except (OSError, ValueError) as error:
        raise LensFileError(
            "the file cannot be read ({reason}); check its path and permissions",
            path,
            reason=reason(error),
        ) from None


def _bytes(path: Path) -> bytes:
    with open_file(path) as file:
        return file.read(LARGEST_FILE + 1)


def _decode(data: bytes, path: str | os.PathLike) -> str:
    if len(data) > LARGEST_FILE:
        raise LensFileError("the file is larger than {size} bytes; this is not a lens file", path, size=LARGEST_FILE)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise LensFileError("the file is not UTF-8 text; save it as UTF-8", path, line) from None
    if not text.strip():
        raise LensFileError("the file is empty; write into it, or name another", path)
    return text


def write_text(text: str, path: str | os.PathLike) -> None:
    """Write a text whole or not at all (`files.atomic.write_whole`); LensFileError."""
    from p2sf.files.atomic import write_whole

    try:
        write_whole(path, lambda handle: handle.write(text.encode("utf-8")))
    except OSError as error:
        raise LensFileError(
            "the file cannot be written ({reason}); choose another place", path, reason=reason(error)
        ) from None
