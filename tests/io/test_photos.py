"""Pictures are read back as they were written, at any depth, and other files are refused by name."""

import struct
import zlib

import numpy as np
import pytest
import tifffile

from p2sf.errors import ExportError, P2SFError, RequestError
from p2sf.io.photo_files import read_photo, write_photo
from p2sf.io.png16 import BAND, read_deep, unfiltered, write_deep
from p2sf.io.transfer import linear_from_srgb, srgb_from_linear


def picture(channels: int = 3) -> np.ndarray:
    return np.random.default_rng(3).random((13, 17, channels)).astype(np.float32)


def test_srgb_is_its_own_inverse_and_has_the_standards_knee():
    values = np.linspace(-0.1, 1.2, 400)
    assert np.allclose(srgb_from_linear(linear_from_srgb(values)), values, atol=1e-7)
    assert np.isclose(linear_from_srgb(np.array(0.5)), 0.21404114, atol=1e-7)  # IEC 61966-2-1


@pytest.mark.parametrize("ending", [".png", ".tif"])
@pytest.mark.parametrize("encoding", ["srgb", "linear"])
@pytest.mark.parametrize(("depth", "step"), [("8", 1 / 255), ("16", 1 / 65535), ("float", 1e-6)])
@pytest.mark.parametrize("channels", [1, 3])
def test_writing_and_reading_keeps_every_value_to_half_a_step(tmp_path, ending, encoding, depth, step, channels):
    if (ending, depth) == (".png", "float"):
        return
    path, values = tmp_path / f"p{ending}", picture(channels)
    write_photo(path, values, encoding, depth)
    back = read_photo(path, encoding)
    assert back.depth == depth and back.values.shape == values.shape
    stored, wanted = (srgb_from_linear(v) if encoding == "srgb" else v for v in (back.values, values))
    assert np.abs(stored - wanted).max() <= step * 0.51 + 1e-6


def test_not_stated_whole_numbers_are_srgb_and_floats_linear(tmp_path):
    write_photo(tmp_path / "a.png", picture())
    write_photo(tmp_path / "b.tif", picture(), "linear")
    assert read_photo(tmp_path / "a.png").encoding == "srgb"
    assert read_photo(tmp_path / "b.tif").encoding == "linear"


def test_every_png_filter_is_undone():
    """Pillow's own 8-bit reader is the witness: the same bytes filtered as 16-bit pairs by hand for each filter."""
    values = np.random.default_rng(5).integers(0, 65536, (6, 5, 3), dtype=np.uint16)
    assert (read_deep(write_deep(values), "x") == values).all()


def paeth(left: int, up: int, corner: int) -> int:
    """Return the neighbour nearest to the plane through them, as ISO/IEC 15948 has it in 9.4."""
    guess = left + up - corner
    return min((left, up, corner), key=lambda value: abs(guess - value))


@pytest.mark.parametrize("step", [2, 6])
@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 9), (9, 1), (2 * BAND + 3, 5)])
def test_filters_are_undone_byte_by_byte(rows, columns, step):
    """Filtered here one byte after the other, each row by another filter, over more than two bands of rows."""
    random = np.random.default_rng(rows)
    plain = random.integers(0, 256, (rows, columns * step), dtype=np.uint8).astype(int)
    raw = []
    for y, line in enumerate(plain.tolist()):
        kind, out = int(random.integers(0, 5)), []
        above = plain[y - 1].tolist() if y else [0] * len(line)
        for x, value in enumerate(line):
            left, corner = (line[x - step], above[x - step]) if x >= step else (0, 0)
            guess = (0, left, above[x], (left + above[x]) // 2, paeth(left, above[x], corner))[kind]
            out.append((value - guess) % 256)
        raw.append([kind, *out])
    assert (unfiltered(np.array(raw, np.uint8), step) == plain).all()


def claimed(width: int, height: int, deep: bool) -> bytes:
    """Return a small PNG whose head is altered to claim another size."""
    data = bytearray(write_deep(np.zeros((4, 4, 3), np.uint16)))
    data[16:25] = struct.pack(">IIB", width, height, 16 if deep else 8)
    data[29:33] = struct.pack(">I", zlib.crc32(bytes(data[12:29])))
    return bytes(data)


@pytest.mark.parametrize("deep", [True, False])
@pytest.mark.parametrize(
    ("width", "height", "words"),
    [
        (60_000, 60_000, "too large a PNG .*; save it smaller$"),
        (6000, 4000, "too large a PNG .*4000 × 6000 × 3 samples"),
        (70_000, 2, "too large a PNG"),
        (2**31 - 1, 1, "too large a PNG"),
        (0, 5, "(a damaged PNG|neither a PNG)"),
    ],
)
def test_a_size_that_its_bytes_cannot_mean_is_refused_before_it_is_unpacked(tmp_path, width, height, words, deep):
    (tmp_path / "huge.png").write_bytes(claimed(width, height, deep))
    with pytest.raises(RequestError, match=rf"huge\.png is {words}"):
        read_photo(tmp_path / "huge.png")


def test_a_tiff_of_more_strips_than_bytes_is_refused(tmp_path):
    """What fuzzing found: eight million strips in a file of 400 bytes, each looked for."""
    tifffile.imwrite(tmp_path / "strips.tif", np.zeros((3000, 4), np.uint8), rowsperstrip=1, compression="zlib")
    assert read_photo(tmp_path / "strips.tif").values.shape == (3000, 4, 1)
    with tifffile.TiffFile(tmp_path / "strips.tif", mode="r+b") as file:
        file.pages[0].tags["ImageLength"].overwrite(65_000)
    assert (tmp_path / "strips.tif").stat().st_size < 65_000
    with pytest.raises(RequestError, match=r"strips\.tif is a TIFF that cannot be read \(65000 parts.*save it again"):
        read_photo(tmp_path / "strips.tif")


def test_what_is_no_picture_is_one_sentence(tmp_path):
    (tmp_path / "text.png").write_text("no picture")
    (tmp_path / "cut.png").write_bytes(write_deep(np.zeros((4, 4, 3), np.uint16))[:48])
    (tmp_path / "cut.tif").write_bytes(b"II*\x00\x08\x00\x00\x00")
    for name in ("text.png", "cut.png", "cut.tif", "absent.png"):
        with pytest.raises(RequestError, match=name):
            read_photo(tmp_path / name)
    with pytest.raises(ExportError, match="ending"):
        write_photo(tmp_path / "a.jpg", picture())
    with pytest.raises(RequestError, match="float"):
        write_photo(tmp_path / "a.png", picture(), depth="float")
    with pytest.raises(P2SFError, match="encoding"):
        read_photo(tmp_path / "a.png", "gamma") if write_photo(tmp_path / "a.png", picture()) else None
