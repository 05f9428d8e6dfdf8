"""Small files that cost much: bombs, devices, pipes and texts that patterns choke on, each read in a fresh process.

``python -m tests.fuzz.hostile [word …]`` makes those whose names hold a word, all without one, and prints the CPU
seconds and the peak memory of every reader, the largest last. A row is wrong where a reader took more than `SECONDS` or
`MEGABYTES`, or ended in anything but an answer or a sentence.
"""

import os
import resource
import signal
import struct
import sys
import tempfile
import traceback
import zipfile
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import product
from pathlib import Path

from p2sf.cli import main
from p2sf.errors import P2SFError
from p2sf.io.depth_files import read_scene_depths
from p2sf.io.photo_files import read_photo
from p2sf.lensfile.toml.lens import parse_toml
from p2sf.psf.reading import read_psf
from p2sf.scene.filters import filter_channels
from p2sf.studies.complete_trade import load_trades
from p2sf_explorer.files.opening import open_file, refusal
from p2sf_explorer.lessons.lesson import read_lesson
from p2sf_explorer.lessons.task_record import read_result
from p2sf_explorer.state.state import State

SECONDS, MEGABYTES = 2.0, 500.0  # of one reader; to start the program takes half a second more
WAIT = 20  # seconds by the clock, after which a process counts as hanging
MB, GB = 10**6, 10**9
TEXTS = (".toml", ".zmx", ".seq", ".len", ".roa", ".fx", ".json", ".dat", ".txt", ".csv", ".agf", ".md")
PICTURES = (".png", ".tif", ".jpg", ".exr", ".heic")
ARRAYS = (".npz", ".npy", ".fits", ".zip", ".zar")
LENS = "cooke_triplet"
Reader = Callable[[Path], object]


def command(*words: str) -> Reader:
    """Return what runs a command, in whose words {} is the file and {folder} its folder."""
    return lambda path: main([word.format(path, folder=path.parent) for word in words])


def window(path: Path) -> None:
    """Open a file as the window does when it is chosen or dropped: a state, a snapshot, a lens, or a refusal."""
    try:
        open_file(State(), str(path))
    except P2SFError as error:
        raise P2SFError(refusal(str(path), error).message) from error


def pupil_map(path: Path) -> None:
    surfaces = f'{SURFACE}glass = "SCHOTT N-BK7"\n[[surface]]\nradius = inf\nthickness = 50\n'
    aperture = "[aperture]\nstop_semi_diameter = 5\n"
    parse_toml(f'[pupil]\nphase_file = "{path.name}"\n{aperture}{surfaces}', path.with_name("lens.toml"))


ROADS: dict[str, Reader] = {
    "info": command("info", "{}"),
    "import": command("import", "{}"),
    "--agf": command("import", "tests/data/import/doublet.zmx", "--agf", "{}"),
    "plan": command("plan", LENS, "{}"),
    "tolerance --set": command("tolerance", LENS, "--set", "{}"),
    "sharpen": command("sharpen", LENS, "{}", "-o", "{folder}/sharp.png"),
    "measure": command("measure", "{}", "--pixel-um", "5"),
    "measure --target": command("measure", "{folder}/points.png", "--pixel-um", "5", "--target", "{}"),
    "compare": command("compare", "{}", "{}"),
    "database info": command("database", "info", "{}"),
    "export": command("export", "{}", "--to", "csv", "-o", "{folder}/table.csv"),
    "window": window,
    "lesson": read_lesson,
    "results": read_result,
    "trades": load_trades,
    "pupil map": pupil_map,
    "filters": lambda path: filter_channels(path, "d65"),
    "depths": lambda path: read_scene_depths(path, 100.0, 1000.0),
    "photo": read_photo,
    "PSF": read_psf,
}
BY_ENDING: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(TEXTS, ("info", "import", "window")),
    ".toml": ("info", "import", "plan", "tolerance --set", "window"),
    ".json": ("info", "import", "results", "trades", "window"),
    ".agf": ("--agf", "info"),
    ".md": ("lesson",),
    ".txt": ("info", "measure", "measure --target", "window"),
    ".csv": ("info", "filters", "PSF", "window"),
    **dict.fromkeys(PICTURES, ("photo", "measure", "pupil map", "depths", "window")),
    ".npz": ("database info", "export", "measure", "PSF", "compare", "window"),
    ".npy": ("measure", "pupil map"),
    ".fits": ("measure", "window"),
    ".zip": ("info", "import", "window"),
    ".zar": ("info", "import", "window"),
}
Maker = Callable[[Path], object]


@dataclass(frozen=True)
class Cost:
    """What one reader did with one file: its exit code (None for one that hung), last words, CPU time and memory."""

    name: str
    road: str
    code: int | None
    said: str
    seconds: float
    megabytes: float

    @property
    def sound(self) -> bool:
        """Return whether it ended within the limits, and in a sentence where it refused the file."""
        ended = self.code == 0 or (self.code == 2 and self.said.startswith("p2sf: "))
        return ended and self.seconds <= SECONDS and self.megabytes <= MEGABYTES


def text(piece: str, count: int, before: str = "", after: str = "") -> Maker:
    """Return the maker of a text of ``count`` pieces."""
    return lambda path: path.write_text(before + piece * count + after, encoding="utf-8")


def data(content: Callable[[], bytes]) -> Maker:
    """Return the maker of a file of bytes."""
    return lambda path: path.write_bytes(content())


def deflated_zeros(count: int) -> bytes:
    """Return so many zeros as a zlib stream, without holding them."""
    packer = zlib.compressobj(9)
    block = bytes(MB)
    return b"".join(packer.compress(block) for _ in range(count // MB)) + packer.flush()


def png(width: int, height: int, depth: int, colour: int, *chunks: tuple[bytes, bytes], zeros: int = 0) -> bytes:
    """Return a PNG that declares a size, its chunks, and ``zeros`` bytes of rows."""
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    parts = (b"IHDR", head), *chunks, (b"IDAT", deflated_zeros(zeros)), (b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body)) for name, body in parts
    )


def npy_head(shape: str, kind: str = "<f8") -> bytes:
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}"
    head += " " * (-(len(head) + 11) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode()


def archive(members: dict[str, Callable[[BytesIO], object]], seal: bytes = b"") -> bytes:
    """Return a zip archive whose members are written as streams."""
    made = BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as found:
        for name, write in members.items():
            with found.open(name, "w", force_zip64=True) as stream:
                write(stream)  # type: ignore[arg-type]
    return made.getvalue()


def zeros(count: int, head: bytes = b"") -> Callable[[BytesIO], object]:
    def write(stream: BytesIO) -> None:
        stream.write(head)
        for _ in range(count // MB):
            stream.write(bytes(MB))

    return write


def npz(count: int, name: str = "psf.npy", members: int = 1) -> bytes:
    """Return an .npz with arrays of ``count`` bytes of zeros each."""
    head = npy_head(f"({count // 8000}, 1000)")
    meta = zeros(0, npy_head("()", "<U2") + "{}".encode("utf-32-le"))
    return archive({"meta.npy": meta} | {f"{n}{name}" if n else name: zeros(count, head) for n in range(members)})


def overlapping(count: int) -> bytes:
    """Return a zip whose directory names one member of 100 MB again and again."""
    raw = archive({"psf.npy": zeros(100 * MB, npy_head("(12500, 1000)"))})
    end = raw.rindex(b"PK\x05\x06")
    size, start = struct.unpack("<II", raw[end + 12 : end + 20])
    entry = raw[start : start + size]
    head = b"PK\x05\x06" + struct.pack("<HHHHIIH", 0, 0, count, count, size * count, start, 0)
    return raw[:start] + entry * count + head


def tiff(width: int, height: int, bits: int, *more: tuple[int, int, int, int], tail: bytes = b"") -> bytes:
    """Return a TIFF with one directory: more entries are (tag, type, count, value)."""
    entries = sorted(
        [
            (256, 4, 1, width),
            (257, 4, 1, height),
            (258, 3, 1, bits),
            (259, 3, 1, 8),
            (262, 3, 1, 1),
            (277, 3, 1, 1),
            *more,
        ]
    )
    body = b"".join(struct.pack("<HHII", *entry) for entry in entries)
    return b"II*\0" + struct.pack("<I", 8) + struct.pack("<H", len(entries)) + body + bytes(4) + tail


def tiff_bomb(side: int, bits: int, *more: tuple[int, int, int, int]) -> bytes:
    packed = deflated_zeros(side * side * bits // 8 // MB * MB)
    place = 8 + 2 + 12 * (9 + len(more)) + 4
    strip = (273, 4, 1, place), (278, 4, 1, side), (279, 4, 1, len(packed))
    return tiff(side, side, bits, *strip, *more, tail=packed)


def jpeg(width: int, height: int, scans: int = 1) -> bytes:
    """Return a progressive JPEG that declares a size, with ``scans`` scans of nothing."""
    frame = struct.pack(">BHHB", 8, height, width, 1) + bytes((1, 0x11, 0))
    table = bytes(17) if not scans else bytes((0, 1, *[0] * 15, 0))
    scan = bytes((1, 1, 0, 0, 0, 0x01))

    def part(mark: int, body: bytes) -> bytes:
        return bytes((0xFF, mark)) + struct.pack(">H", len(body) + 2) + body

    head = b"\xff\xd8" + part(0xDB, bytes((0, *[1] * 64))) + part(0xC2, frame) + part(0xC4, table)
    return head + (part(0xDA, scan) + b"\0") * scans + b"\xff\xd9"


def fits(*cards: str, blocks: int = 1) -> bytes:
    written = "".join(f"{card:80}" for card in cards)
    return written.ljust(-(-len(written) // 2880) * 2880).encode() + bytes(2880 * blocks)


def exr(width: int, height: int) -> bytes:
    def attribute(name: str, kind: str, value: bytes) -> bytes:
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value

    channel = b"Y\0" + struct.pack("<IIII", 2, 0, 1, 1) + b"\0"
    box = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    head = attribute("channels", "chlist", channel) + attribute("compression", "compression", b"\3")
    head += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box)
    head += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", bytes(8)) + attribute("screenWindowWidth", "float", bytes(4))
    return b"v/1\x01\2\0\0\0" + head + b"\0" + bytes(4096)


def device(path: Path) -> None:
    path.symlink_to("/dev/zero")


def sparse(head: bytes) -> Maker:
    """Return the maker of a file of 20 GB that takes no room on the disk."""

    def make(path: Path) -> None:
        path.write_bytes(head)
        os.truncate(path, 20 * GB)

    return make


def lzw(count: int) -> bytes:
    """Return a .zar with a lens whose LZW codes unpack to ever longer words."""
    bits = "".join(f"{code:0{max(9, (code + 1).bit_length())}b}" for code in (65, *range(256, 256 + count)))
    packed = int(bits.ljust(-(-len(bits) // 8) * 8, "0"), 2).to_bytes(-(-len(bits) // 8), "big")
    head = bytearray(0x14C)
    head[:2], head[0x0C:0x10] = b"\xea\x00", struct.pack("<I", len(packed))
    name = b"lens.zmx.LZW\0"
    head[0x20 : 0x20 + len(name)] = name
    return bytes(head) + packed


CHEAP = {".png": b"\x89PNG\r\n\x1a\n", ".tif": b"II*\0\x08\0\0\0", ".jpg": b"\xff\xd8\xff", ".exr": b"v/1\x01"}
BEGINNINGS = CHEAP | {".heic": b"\0\0\0\x18ftypheic", ".npz": b"PK\3\4", ".zip": b"PK\3\4", ".zar": b"\xea\0"}
BEGINNINGS |= {".npy": npy_head("(1000000, 2500)"), ".fits": fits("SIMPLE  =                    T", blocks=0)}
SURFACE = "[[surface]]\nradius = 50\nthickness = 5\n"
INSIDE_JSON = '{"surfaces": '


def makers() -> Iterator[tuple[str, str, Maker]]:
    """Yield name, ending and maker of every file."""
    for ending in (*TEXTS, *PICTURES, *ARRAYS):
        yield "a pipe that nobody writes into", ending, lambda path: os.mkfifo(path)
        yield "/dev/zero", ending, device
        yield "20 GB of nothing", ending, sparse(BEGINNINGS.get(ending, b""))
        yield "a folder", ending, Path.mkdir
    for ending, (name, piece) in product(TEXTS, BLANK.items()):
        yield f"only {name}", ending, text(piece, 900_000 // len(piece))
    for (name, endings), (before, piece, count, after) in TANGLED.items():
        for ending in endings.split():
            yield name, ending, text(piece, count, before, after)
    yield from ((name, ending, data(content)) for (name, ending), content in BOMBS.items())


BLANK = {
    "blanks": " ",
    "line feeds": "\n",
    "carriage returns": "\r",
    "tabs and line feeds": "\t\n",
    "file separators": "\x1c",
    "wide blanks": "\u2003",
}
ALL = ".zmx .seq .len .roa .fx .json .dat .txt .csv"
TANGLED: dict[tuple[str, str], tuple[str, str, int, str]] = {
    ("a dotted key", ".toml"): ("", "a.", 20_000, "a = 1\n"),
    ("a dotted key of 400 000 digits", ".toml"): ("", "1.", 400_000, "1 = 1\n"),
    ("a dotted key in quotes", ".toml"): ("", '"=".', 100_000, "a = 1\n"),
    ("a dotted heading", ".toml"): ("[", "a . ", 100_000, "a]\n"),
    ("a dotted key in a list", ".toml"): ("x = [{", "a.", 100_000, "a = 1}]\n"),
    ("nested lists", ".toml .json"): ("x = ", "[", 100_000, ""),
    ("nested tables", ".toml"): ("x = ", "{a = ", 100_000, ""),
    ("surfaces without end", ".toml"): ("", SURFACE, 20_000, ""),
    ("headings without end", ".toml"): ("", "[[surface]]\n", 80_000, ""),
    ("a long number", ".toml"): ("name = ", "1", 900_000, "\n"),
    ("a long key that is wrong", ".toml"): ("", "a", 900_000, " = 1\n"),
    ("strings over several lines", ".toml"): ("", "'''", 200_000, ""),
    ("empty lines and a wrong key", ".toml"): ("wrong = 1\n", "\n ", 400_000, SURFACE),
    ("one quotation mark and another", ALL): ("", "'\"", 140_000, ""),
    ("quotation marks", ALL): ("", '"', 290_000, ""),
    ("brackets", ALL): ("", "[", 290_000, ""),
    ("nested JSON", ".json .roa"): (INSIDE_JSON, "[", 140_000, ""),
    ("many objects", ".json .roa"): (INSIDE_JSON + "[", '{"radius": 1},', 250_000, "{}]}"),
    ("one digit after another", ALL): ("", "1", 290_000, ""),
    ("numbers and blanks", ALL): ("", "1 ", 145_000, ""),
    ("one number and blanks", ALL): ("1", " ", 290_000, "x"),
    ("numbers on lines", ALL): ("", "1\n", 190_000, ""),
    ("radius, again and again", ALL): ("", "radius ", 41_000, ""),
    ("title, again and again", ALL): ("", "TIT ", 72_000, ""),
    ("a title and blanks", ALL): ("! EFL", " ", 290_000, "x"),
    ("numbers with zeros", ".seq"): ("RDM\nLEN\nS ", "0", 290_000, "x\nGO\n"),
    ("a ratio of digits", ".seq"): ("RDM\nLEN\nS 1.1:", "1", 290_000, "x\nGO\n"),
    ("semicolons", ".seq .len"): ("RDM\nLEN NEW\n", ";", 290_000, "\n"),
    ("lines that go on", ".seq"): ("RDM\nLEN\n", "&\n", 190_000, "GO\n"),
    ("headings in brackets", ".txt"): ("[lens data]\n", "x\t", 140_000, "\n"),
    ("a heading and blanks", ".csv"): ("radius,thickness", " ", 280_000, ",glass\n1,2,\n"),
    ("a heading of words", ".csv"): ("radius,", "a[", 140_000, ",thickness\n1,2\n"),
    ("a glass of digits", ".zmx"): ("VERS 1\nSURF 0\n  GLAS ", "1", 280_000, "\n"),
    ("an asphere of letters", ".fx"): ("[elements]\n", "a1", 140_000, "\n"),
    ("glasses without end", ".agf"): ("", "NM A 1 1 1 1\n", 190_000, ""),
    ("a PSF of commas", ".csv"): ("# point spread function\n# meta: {}\n", ",", 290_000, "\n1\n"),
    ("a listing of digits", ".txt"): ("Huygens PSF\n", "1", 290_000, "e\n"),
    ("a listing of rows", ".txt"): ("Huygens PSF\n0.5 mm at 0, 0\n", "1 2 3\n", 150_000, ""),
    ("a lesson of stars", ".md"): ("title: x\n\n## step\n", "*", 290_000, "\n"),
    ("a lesson of claims", ".md"): ("title: x\n\n## step\nclaim: ", "1", 290_000, "x\n"),
    ("escapes of a terminal", ".toml"): ('title = "\\u001b[31m', "\\u001b]0;x\\u0007", 3, f'"\n{SURFACE}'),
}
HUGE = 65_000
BOMBS: dict[tuple[str, str], Callable[[], bytes]] = {
    ("1 GB of zeros", ".npz"): lambda: npz(GB),
    ("190 MB of zeros", ".npz"): lambda: npz(190 * MB),
    ("40 arrays of 100 MB", ".npz"): lambda: npz(100 * MB, members=40),
    ("one array in 100 entries", ".npz"): lambda: overlapping(100),
    ("an array that is not there", ".npz"): lambda: archive({"psf.npy": zeros(0, npy_head("(1000000, 1000000)"))}),
    ("letters without end", ".npz"): lambda: archive({"meta.npy": zeros(400 * MB, npy_head("()", "<U100000000"))}),
    ("a database that is none", ".npz"): lambda: npz(GB, "p2sf_database.npy"),
    ("a hundred thousand members", ".npz"): lambda: archive({f"{n}.npy": zeros(0) for n in range(20_000)}),
    ("an array that is not there", ".npy"): lambda: npy_head("(1000000, 1000000)"),
    ("a head without end", ".npy"): lambda: b"\x93NUMPY\x02\x00" + struct.pack("<I", 400 * MB) + b" " * MB,
    ("1 GB of a lens", ".zip"): lambda: archive({"lens.zmx": zeros(GB)}),
    ("fifty catalogues", ".zip"): lambda: archive(
        {"lens.zmx": zeros(0, b"SURF 0\n")} | {f"{n}.agf": zeros(3 * MB, b"NM") for n in range(50)}
    ),
    ("fifty catalogues of names", ".zip"): lambda: archive(
        {"lens.zmx": zeros(0, b"SURF 0\n")} | {f"{n}.agf": zeros(0, b"NM A 1 1 1 1\n" * 190_000) for n in range(50)}
    ),
    ("a hundred thousand members", ".zip"): lambda: archive({f"{n}.txt": zeros(0) for n in range(20_000)}),
    ("an archive in an archive", ".zip"): lambda: archive({"lens.zmx": zeros(0, archive({"lens.zmx": zeros(GB)}))}),
    ("words that grow", ".zar"): lambda: lzw(60_000),
    ("many records", ".zar"): lambda: (b"\xea\0" + bytes(0x14A)) * 12_000,
    ("65 000 pixels on a side", ".png"): lambda: png(HUGE, HUGE, 8, 2, zeros=100 * MB),
    ("four gigabits", ".png"): lambda: png(HUGE, HUGE, 1, 0, zeros=500 * MB),
    ("16 bits, 65 000 pixels on a side", ".png"): lambda: png(HUGE, HUGE, 16, 2, zeros=100 * MB),
    ("16 bits, 4000 pixels on a side", ".png"): lambda: png(4000, 4000, 16, 2, zeros=97 * MB),
    ("16 bits and alpha, 3500 pixels on a side", ".png"): lambda: png(3500, 3500, 16, 6, zeros=99 * MB),
    ("16 bits of grey, 7000 pixels on a side", ".png"): lambda: png(7000, 7000, 16, 0, zeros=99 * MB),
    ("as many pixels as a map may have", ".png"): lambda: png(1024, 1024, 16, 0, zeros=3 * MB),
    ("a million parts", ".png"): lambda: png(9, 9, 8, 0, *[(b"abCd", b"")] * MB, zeros=MB),
    ("parts of 100 MB", ".png"): lambda: png(9, 9, 8, 0, *[(b"abCd", bytes(10 * MB))] * 10, zeros=MB),
    ("one row of 65 535 pixels", ".png"): lambda: png(65_535, 1, 16, 2, zeros=MB),
    ("16 bits in one column", ".png"): lambda: png(1, 65_535, 16, 2, zeros=MB),
    ("7000 pixels on a side", ".png"): lambda: png(7000, 7000, 8, 0, zeros=49 * MB),
    ("a text of 1 GB", ".png"): lambda: png(9, 9, 8, 0, (b"zTXt", b"a\0\0" + deflated_zeros(GB)), zeros=MB),
    ("a state of 1 GB", ".png"): lambda: png(
        9, 9, 8, 0, (b"iTXt", b"p2sf-state\0\1\0\0\0" + deflated_zeros(GB)), zeros=MB
    ),
    ("a hundred texts of 60 MB", ".png"): lambda: png(
        9, 9, 8, 0, *[(b"zTXt", b"a\0\0" + deflated_zeros(60 * MB))] * 100, zeros=MB
    ),
    ("a profile of 1 GB", ".png"): lambda: png(9, 9, 8, 0, (b"iCCP", b"a\0\0" + deflated_zeros(GB)), zeros=MB),
    ("65 000 pixels on a side", ".tif"): lambda: tiff_bomb(HUGE, 8)[: 2 * MB],
    ("7000 pixels on a side, 64 bits", ".tif"): lambda: tiff_bomb(7000, 64),
    ("7000 pixels on a side, 32 bits", ".tif"): lambda: tiff_bomb(7000, 32),
    ("7000 pixels on a side, floats", ".tif"): lambda: tiff_bomb(7000, 32, (339, 3, 1, 3)),
    ("7000 pixels on a side, 8 bits", ".tif"): lambda: tiff_bomb(7000, 8),
    ("a directory that names itself", ".tif"): lambda: tiff(9, 9, 8)[:-4] + struct.pack("<I", 8),
    ("strips without end", ".tif"): lambda: tiff(9, HUGE, 8, (273, 4, 10**9, 8), (279, 4, 10**9, 8)),
    ("65 000 pixels on a side", ".jpg"): lambda: jpeg(HUGE, HUGE),
    ("7000 pixels on a side, sixty scans", ".jpg"): lambda: jpeg(7000, 7000, scans=59),
    ("150 MB in which nothing begins", ".jpg"): lambda: b"\xff\xd8\xff" + bytes(150 * MB),
    ("segments without end", ".jpg"): lambda: b"\xff\xd8" + b"\xff\xe5\0\2" * 10 * MB,
    ("ten thousand scans", ".jpg"): lambda: jpeg(5000, 5000, scans=10_000),
    ("a million pixels on a side", ".exr"): lambda: exr(10**6, 10**6),
    ("7000 pixels on a side", ".exr"): lambda: exr(7000, 7000),
    ("65 000 pixels on a side", ".fits"): lambda: fits(
        "SIMPLE  =                    T",
        "BITPIX  =                  -64",
        "NAXIS   =                    2",
        f"NAXIS1  = {HUGE:20}",
        f"NAXIS2  = {HUGE:20}",
        "END",
    ),
    ("a head without end", ".fits"): lambda: fits("SIMPLE  =                    T", *["COMMENT"] * 2_000_000, blocks=0),
    ("gzip in place of FITS", ".fits"): lambda: b"\x1f\x8b\x08\0\0\0\0\0\0\0" + deflated_zeros(GB)[2:],
    ("units without end", ".fits"): lambda: b"".join(
        [
            fits(
                "SIMPLE  =                    T",
                "BITPIX  =                    8",
                "NAXIS   =                    0",
                "END",
                blocks=0,
            )
        ]
        + [
            fits(
                "XTENSION= 'IMAGE   '",
                "BITPIX  =                    8",
                "NAXIS   =                    0",
                "PCOUNT  =                    0",
                "GCOUNT  =                    1",
                "END",
                blocks=0,
            )
        ]
        * 20_000
    ),
}


def cost(name: str, road: str, path: Path) -> Cost:
    """Read a file on one road in a process of its own, which has loaded the program already."""
    with tempfile.TemporaryFile() as words:
        child = os.fork()
        if not child:
            code = 1
            try:
                signal.alarm(WAIT)
                resource.setrlimit(resource.RLIMIT_AS, (4 * GB, 4 * GB))
                os.dup2(words.fileno(), 1)
                os.dup2(words.fileno(), 2)
                code = answer(road, path)
            except BaseException:  # whatever it is, it is no sentence, and this process ends here
                traceback.print_exc()
            finally:
                sys.stdout.flush()
                sys.stderr.flush()
                os._exit(code)
        _, status, used = os.wait4(child, 0)
        words.seek(0)
        said = words.read(MB).decode("utf-8", "replace").strip().splitlines()
    exit_code = os.waitstatus_to_exitcode(status)
    unit = 1e6 if sys.platform == "darwin" else 1024.0  # of ru_maxrss in a megabyte
    seconds = used.ru_utime + used.ru_stime
    last = said[-1] if said else ""
    return Cost(name, road, None if exit_code < 0 else exit_code, last, seconds, used.ru_maxrss / unit)


def answer(road: str, path: Path) -> int:
    """Return the exit code of one reader; a refusal is a sentence on standard error and code 2."""
    try:
        found = ROADS[road](path)
    except P2SFError as error:
        print(f"p2sf: {error}", file=sys.stderr)
        return 2
    return found if isinstance(found, int) else 0


def costs(words: Sequence[str] = ()) -> Iterator[Cost]:
    """Yield what every reader makes of every file whose name holds one of the words, of all without words."""
    for name, ending, make in makers():
        called = f"{name}{ending}"
        if words and not any(word in called for word in words):
            continue
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "points.png").write_bytes(png(9, 9, 8, 0, zeros=MB))
            path = Path(folder) / f"hostile{ending}"
            make(path)
            for road in BY_ENDING[ending]:
                yield cost(called, road, path)


def report() -> int:
    for reader in ("info", LENS), ("database", "info", LENS), ("measure", LENS), ("export", LENS, "--to", "csv"):
        main(reader)  # loads what a first call loads
    found = []
    for each in costs(sys.argv[1:]):
        found.append(each)
        print(f"{'' if each.sound else 'WRONG '}{line(each)}", flush=True)
    wrong = [each for each in found if not each.sound]
    print(f"\n{len(found)} readings, {len(wrong)} wrong", *map(line, wrong), sep="\n")
    if found:
        print("largest:", line(max(found, key=lambda each: each.seconds)), line(max(found, key=lambda x: x.megabytes)))
    return int(bool(wrong))


def line(each: Cost) -> str:
    """Return one row of the report."""
    end = "hangs" if each.code is None else f"exit {each.code}"
    return f"{each.seconds:6.2f} s {each.megabytes:6.0f} MB {end:7} {each.road:16} {each.name}: {each.said[-150:]}"


if __name__ == "__main__":
    sys.exit(report())
