"""Damage lens files at random and read them: the outcome is a lens, or a LensFileError that names a line.

``python -m tests.long.damaged_files [count [file …]]`` tries ``count`` (10 000) inputs per format and
prints what came of them.
"""

import io
import random
import sys
import zipfile
from collections import Counter
from pathlib import Path

from p2sf.errors import LensFileError
from p2sf.lensfile.agf import read_agf_text
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.source_text import source_of
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from tests.support.lenses.lens_files import FILES, FOLDER


def zar_of(name: str) -> bytes:
    """Return a .zar archive of one file: version, size, name, data at their places."""
    body = (FOLDER / name).read_bytes()
    head = bytearray(0x14C)
    head[:2], head[0x0C:0x10], head[0x20 : 0x20 + len(name)] = (
        b"\xea\x00",
        len(body).to_bytes(4, "little"),
        name.encode(),
    )
    return bytes(head) + body


def zip_of(*names: str) -> bytes:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name in names:
            archive.write(FOLDER / name, name)
    return packed.getvalue()


SAMPLES = {
    **{name: (FOLDER / name).read_bytes() for name in (*FILES, "own.agf")},
    "doublet.zar": zar_of("doublet.zmx"),
    "doublet.zip": zip_of("doublet.zmx", "own.agf"),
    "tessar.toml": (Path(__file__).parents[2] / "lenses" / "tessar.toml").read_bytes(),
}
NUMBERS = (
    "0 -0 1 -1 1e-320 1e308 -1e308 1e999 nan inf -inf 1e-9 1e9 0x1f 1_000 ١٢ 9999999999999999999999 .5. 1e 1,5".split()
)
WORDS = (
    *"MIRROR STOP NaN null true [] {} [[ ]] ; & ! ' \" # S SO SI REFL GLAS ___BLANK 517642 N-BK7 é Ω".split(),
    *("\x00", "\t", "\ufeff", ""),
)


def damaged(data: bytes, chance: random.Random) -> bytes:
    """Return a copy with one to four kinds of damage."""
    for _ in range(chance.randint(1, 4)):
        data = chance.choice(DAMAGES)(data, chance)
    return data


def flip_a_byte(data: bytes, chance: random.Random) -> bytes:
    place = chance.randrange(len(data) + 1)
    return data[:place] + bytes([chance.randrange(256)]) + data[place + chance.randrange(2) :]


def cut(data: bytes, chance: random.Random) -> bytes:
    first, last = sorted(chance.randrange(len(data) + 1) for _ in range(2))
    return data[:first] + data[last:] if chance.random() < 0.5 else data[:last]


def shuffle_lines(data: bytes, chance: random.Random) -> bytes:
    lines = data.split(b"\n")
    one, two = chance.randrange(len(lines)), chance.randrange(len(lines))
    lines[one] = lines[two] if chance.random() < 0.5 else lines[one] + b"\n" + lines[two]
    return b"\n".join(lines)


def lose_a_line(data: bytes, chance: random.Random) -> bytes:
    lines = data.split(b"\n")
    del lines[chance.randrange(len(lines))]
    return b"\n".join(lines)


def change_a_word(data: bytes, chance: random.Random) -> bytes:
    words = data.split(b" ")
    words[chance.randrange(len(words))] = chance.choice((*NUMBERS, *WORDS)).encode()
    return b" ".join(words)


def change_a_number(data: bytes, chance: random.Random) -> bytes:
    places = [i for i, byte in enumerate(data) if 48 <= byte < 58]
    if not places:
        return data
    place = chance.choice(places)
    end = place
    while end < len(data) and data[end : end + 1] in b"0123456789.eE+-":
        end += 1
    return data[:place] + chance.choice(NUMBERS).encode() + data[end:]


def recode(data: bytes, chance: random.Random) -> bytes:
    return data.decode("latin-1").encode(chance.choice(("utf-16", "utf-16-le", "utf-16-be", "utf-8-sig")))


DAMAGES = (flip_a_byte, cut, shuffle_lines, lose_a_line, change_a_word, change_a_number, change_a_number, recode)


def outcome(name: str, data: bytes, accept: bool) -> str:
    """Return "lens" or "refused"; any other exception is raised, an error without a line as AssertionError."""
    try:
        source = source_of(data, name)
        if name.endswith(".agf"):
            read_agf_text(source)
        else:
            lens = import_text(source, GlassSources((), {}, accept)).lens
            assert parse_toml(lens_to_toml(lens), "again.toml") == lens
        return "lens"
    except LensFileError as failure:
        # A table or key that is missing from a TOML file has no line, and neither has an archive.
        assert failure.line or name.endswith(".toml") or "archive" in str(failure), failure
        return "refused"


def attempt(name: str, count: int, seed: int = 0) -> Counter:
    """Return how often ``count`` damaged copies of a sample were a lens, and how often refused."""
    results: Counter = Counter()
    for number in range(count):
        chance = random.Random(f"{name} {seed} {number}")
        data = damaged(SAMPLES[name], chance)
        with Labelled(f"{name}, seed {seed}, number {number}: {data[:2000]!r}"):
            results[outcome(name, data, chance.random() < 0.5)] += 1
    return results


class Labelled:
    """Adds the input as a note to an exception that leaves the block."""

    def __init__(self, label: str):
        self.label = label

    def __enter__(self):
        return self

    def __exit__(self, kind, failure, trace):
        if failure is not None:
            failure.add_note(self.label)


if __name__ == "__main__":
    for sample in sys.argv[2:] or SAMPLES:
        print(sample, dict(attempt(sample, int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)), flush=True)
