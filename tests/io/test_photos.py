"""Pictures are read back as they were written, at any depth, and other files are refused by name."""

import struct
import sys
import time
import tracemalloc
import warnings
import zlib
from contextlib import nullcontext

import numpy as np
import pytest
import tifffile
from PIL import Image, ImageOps

from p2sf.errors import ExportError, P2SFError, RequestError
from p2sf.files.picture_parts import MOST_SCANS
from p2sf.io.photo_files import kept_depth, photo_shape, read_photo, read_samples, write_photo
from p2sf.io.png16 import write_deep
from p2sf.io.transfer import linear_from_srgb, srgb_from_linear
from tests.fuzz.hostile import jpeg


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


@pytest.mark.parametrize("ending", [".tif", ".exr"])
@pytest.mark.parametrize(("depth", "kind"), [("half", np.float16), ("float", np.float32), (None, np.float32)])
@pytest.mark.parametrize("channels", [1, 3])
def test_floats_keep_light_from_a_millionth_to_a_thousand_whites(tmp_path, ending, depth, kind, channels):
    """To a rounding of the kind, 2⁻¹¹ or 2⁻²⁴, and of numbers too small for one to half its least, 2⁻²⁵."""
    if ending == ".exr":
        pytest.importorskip("OpenEXR")
    path, values = tmp_path / f"p{ending}", 10 ** np.linspace(-6, 3, 13 * 17 * channels, dtype=np.float32)
    values = values.reshape(13, 17, channels)
    write_photo(path, values, "linear", depth)
    back = read_photo(path)
    assert (back.encoding, back.depth) == ("linear", "float")
    tiny = float(np.finfo(kind).smallest_subnormal) / 2
    np.testing.assert_allclose(back.values, values, rtol=np.finfo(kind).eps / 2, atol=tiny)


def test_an_exr_is_linear_and_holds_depths_or_colours_beside_others(tmp_path):
    exr = pytest.importorskip("OpenEXR")
    colours = picture()
    write_photo(tmp_path / "a.exr", colours, "srgb")  # as a copy of a PNG asks
    assert np.array_equal(read_photo(tmp_path / "a.exr").values, colours)
    header = {"compression": exr.ZIP_COMPRESSION, "type": exr.scanlineimage}
    planes = {name: np.ascontiguousarray(colours[..., k]) for k, name in enumerate("RGB")}
    for name, kept, wanted in (
        ("layers", {**planes, "A": planes["R"], "Z": 5 * planes["G"]}, colours),
        ("depth", {"Z": 5 * planes["G"], "A": planes["R"]}, 5 * colours[..., 1:2]),
    ):
        with exr.File(header, kept) as file:
            file.write(str(tmp_path / f"{name}.exr"))
        assert np.array_equal(read_photo(tmp_path / f"{name}.exr").values, wanted)
    with exr.File(header, {"U": planes["R"], "V": planes["G"]}) as file:
        file.write(str(tmp_path / "uv.exr"))
    with pytest.raises(RequestError, match="Y or Z"):
        read_photo(tmp_path / "uv.exr")


def test_a_damaged_exr_and_a_missing_library_are_said(tmp_path, monkeypatch):
    pytest.importorskip("OpenEXR")
    write_photo(tmp_path / "a.exr", picture())
    whole = (tmp_path / "a.exr").read_bytes()
    for part in (whole[:200], whole[: len(whole) // 2], whole[:4]):
        (tmp_path / "part.exr").write_bytes(part)
        with pytest.raises(RequestError, match="damaged"):
            read_photo(tmp_path / "part.exr")
    monkeypatch.setitem(sys.modules, "OpenEXR", None)
    for work in (lambda: read_photo(tmp_path / "a.exr"), lambda: write_photo(tmp_path / "b.exr", picture())):
        with pytest.raises(RequestError, match="p2sf\\[exr"):
            work()


def deep_png(raw: bytes, width: int, height: int, colour_type: int) -> bytes:
    """Return a 16-bit PNG of filtered rows."""

    def chunk(name: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    head = struct.pack(">IIBBBBB", width, height, 16, colour_type, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        chunk(*part) for part in ((b"IHDR", head), (b"IDAT", zlib.compress(raw)), (b"IEND", b""))
    )


def test_what_is_written_with_16_bits_is_read_with_16_bits(tmp_path):
    values = np.random.default_rng(5).integers(0, 65536, (6, 5, 3), dtype=np.uint16)
    path = tmp_path / "deep.png"
    path.write_bytes(write_deep(values))
    assert np.array_equal(read_samples(path), values)


def paeth(left: int, up: int, corner: int) -> int:
    """Return the neighbour nearest to the plane through them, as ISO/IEC 15948 has it in 9.4."""
    guess = left + up - corner
    return min((left, up, corner), key=lambda value: abs(guess - value))


@pytest.mark.parametrize(("colour_type", "channels"), [(0, 1), (2, 3), (4, 2), (6, 4)])
@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 9), (9, 1), (23, 5)])
def test_filters_are_undone_byte_by_byte(tmp_path, rows, columns, colour_type, channels):
    """Filtered here one byte after the other, each row by another filter."""
    random, step = np.random.default_rng(rows), 2 * channels
    plain = random.integers(0, 256, (rows, columns * step), dtype=np.uint8).astype(int)
    raw = []
    for y, line in enumerate(plain.tolist()):
        kind, out = int(random.integers(0, 5)), []
        above = plain[y - 1].tolist() if y else [0] * len(line)
        for x, value in enumerate(line):
            left, corner = (line[x - step], above[x - step]) if x >= step else (0, 0)
            guess = (0, left, above[x], (left + above[x]) // 2, paeth(left, above[x], corner))[kind]
            out.append((value - guess) % 256)
        raw.append(bytes((kind, *out)))
    path = tmp_path / "deep.png"
    path.write_bytes(deep_png(b"".join(raw), columns, rows, colour_type))
    wanted = (256 * plain[:, ::2] + plain[:, 1::2]).reshape(rows, columns, channels)
    assert np.array_equal(read_samples(path).reshape(wanted.shape), wanted)


@pytest.mark.parametrize("turn", range(1, 9))
@pytest.mark.parametrize("depth", [8, 16])
@pytest.mark.parametrize("channels", [1, 3])
def test_pictures_are_turned_upright_whatever_their_bits(tmp_path, turn, depth, channels):
    """As Pillow turns the same picture of 8 bits; one of 16 bits has the same numbers times 257."""
    values = np.random.default_rng(turn).integers(0, 256, (4, 7, channels), dtype=np.uint8)
    eight = Image.fromarray(np.squeeze(values))
    exif = Image.Exif()
    exif[274] = turn
    eight.save(tmp_path / "8.png", exif=exif)
    with Image.open(tmp_path / "8.png") as stored:
        wanted = np.asarray(ImageOps.exif_transpose(stored))
    path = tmp_path / f"{depth}.png"
    if depth == 16:
        data = write_deep(257 * values.astype(np.uint16))
        body = exif.tobytes().removeprefix(b"Exif\0\0")
        chunk = struct.pack(">I", len(body)) + b"eXIf" + body + struct.pack(">I", zlib.crc32(b"eXIf" + body))
        path.write_bytes(data[:33] + chunk + data[33:])
    found = read_samples(path)
    assert np.array_equal(found, wanted * np.uint16(257 if depth == 16 else 1)) and photo_shape(path) == found.shape[:2]


def test_a_large_photo_is_read_within_a_small_multiple_of_its_samples(tmp_path):
    """A tenth of 50 megapixels of noise with 16 bits: one pass by Python took some 20 s for these."""
    values = np.random.default_rng(1).integers(0, 65536, (1700, 3000, 3), dtype=np.uint16)
    path = tmp_path / "large.png"
    path.write_bytes(write_deep(values))
    took, most = [], []
    for _ in range(2):  # the first may import, or meet a thread that another test left at work
        tracemalloc.start()
        try:
            begun = time.process_time()
            found = read_photo(path, "linear")
            took.append(time.process_time() - begun)
            most.append(tracemalloc.get_traced_memory()[1])
        finally:
            tracemalloc.stop()
    np.testing.assert_allclose(found.values[::100], values[::100] / 65535, atol=1e-7)
    assert min(took) < 3 and min(most) < 10 * values.size  # 4 bytes a sample remain


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
        (0, 5, "(a damaged PNG|not a PNG)"),
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


def upright() -> np.ndarray:
    """Return a dark picture with a bright top left corner, (40, 60, 3) bytes."""
    values = np.full((40, 60, 3), 30, np.uint8)
    values[:10, :15] = 220
    return values


@pytest.mark.parametrize(("name", "kind"), [("a.jpg", "JPEG"), ("a.jpeg", "JPEG"), ("a.png", "JPEG")])
def test_a_jpeg_is_read_by_its_content(tmp_path, name, kind):
    """JPEG keeps flat parts to some levels of 255 at this quality."""
    Image.fromarray(upright()).save(tmp_path / name, kind, quality=95)
    photo = read_photo(tmp_path / name)
    assert (photo.encoding, photo.depth) == ("srgb", "8") and photo_shape(tmp_path / name) == (40, 60)
    expected = linear_from_srgb(upright()[::20, ::20].astype(np.float32) / 255)
    assert photo.values[::20, ::20] == pytest.approx(expected, abs=0.02)


@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_photo_taken_sideways_is_turned_upright(tmp_path, orientation):
    """Each of Exif's eight orientations is undone: its picture is the upright one, turned by Pillow's own inverse."""
    turn = {2: 0, 3: 3, 4: 1, 5: 5, 6: 2, 7: 6, 8: 4}  # Image.Transpose that makes the stored picture
    stored = Image.fromarray(upright())
    if orientation > 1:
        stored = stored.transpose(Image.Transpose(turn[orientation]))
    exif = Image.Exif()
    exif[274] = orientation
    stored.save(tmp_path / "a.jpg", quality=95, exif=exif)
    assert photo_shape(tmp_path / "a.jpg") == (40, 60)
    values = read_photo(tmp_path / "a.jpg").values
    assert values.shape == (40, 60, 3)
    assert values[:8, :12].min() > 0.5 and values[15:].max() < 0.1


def test_a_grey_jpeg_has_one_channel_and_a_cut_one_is_one_sentence(tmp_path):
    Image.fromarray(upright()[..., 0]).save(tmp_path / "grey.jpg")
    assert read_photo(tmp_path / "grey.jpg").values.shape == (40, 60, 1)
    whole = (tmp_path / "grey.jpg").read_bytes()
    (tmp_path / "cut.jpg").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(RequestError, match=r"cut\.jpg is a damaged JPEG"):
        read_photo(tmp_path / "cut.jpg")


def test_heif_is_read_where_its_library_is_installed(tmp_path):
    heif = pytest.importorskip("pillow_heif")
    heif.from_pillow(Image.fromarray(upright())).save(tmp_path / "a.heic", quality=95)
    assert photo_shape(tmp_path / "a.heic") == (40, 60)
    values = read_photo(tmp_path / "a.heic").values
    assert values[:8, :12].min() > 0.4 and values[15:].max() < 0.1


def test_heif_without_its_library_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pillow_heif", None)
    (tmp_path / "a.heic").write_bytes(b"\0\0\0\x18ftypheic" + bytes(12))
    for read in (read_photo, photo_shape):
        with pytest.raises(RequestError, match="pillow-heif"):
            read(tmp_path / "a.heic")


@pytest.mark.parametrize("ending", [".png", ".tif"])
def test_the_shape_is_told_without_reading_the_picture(tmp_path, ending):
    write_photo(tmp_path / f"a{ending}", picture())
    assert photo_shape(tmp_path / f"a{ending}") == (13, 17)


@pytest.mark.parametrize("kind", ["png", "png16", "tif", "exr", "palette"])
@pytest.mark.parametrize("clear", [0, 5, 20])
def test_transparency_that_is_left_out_is_told(tmp_path, kind, clear):
    """Colours are those of the file, whatever its alpha, and the share of pixels that are not opaque is counted."""
    ending = {"png16": ".png", "palette": ".png"}.get(kind, f".{kind}")
    path, deep = tmp_path / f"p{ending}", kind in ("png16", "tif")
    white = 65535 if deep else 255
    raw = np.full((4, 5, 4), white, np.uint16 if deep else np.uint8)
    raw[..., :3] = white // 3
    raw.reshape(-1, 4)[:clear, 3] = white // 2
    if kind == "exr":
        exr = pytest.importorskip("OpenEXR")
        channels = {"RGBA": (raw / white).astype(np.float32)}
        with exr.File({"compression": exr.ZIP_COMPRESSION, "type": exr.scanlineimage}, channels) as file:
            file.write(str(path))
    elif kind == "tif":
        tifffile.imwrite(path, raw, photometric="rgb", extrasamples=["unassalpha"])
    elif kind == "png16":
        lines = zlib.compress(b"".join(b"\0" + row.astype(">u2").tobytes() for row in raw))
        parts = (b"IHDR", struct.pack(">IIBBBBB", 5, 4, 16, 6, 0, 0, 0)), (b"IDAT", lines), (b"IEND", b"")
        packed = (
            struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
            for name, body in parts
        )
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(packed))
    elif kind == "palette":
        indices = np.zeros((4, 5), np.uint8)
        indices.flat[:clear] = 1
        image = Image.fromarray(indices).convert("P")
        image.putpalette([85] * 6)
        image.save(path, transparency=bytes([255, 100]))
    else:
        Image.fromarray(raw).save(path)
    found = read_photo(path, "linear")
    np.testing.assert_allclose(found.values, np.broadcast_to(1 / 3, (4, 5, 3)), atol=1e-6)
    assert found.transparent == clear / 20 and (found.caution is None) == (clear == 0)
    assert f"{5 * clear} %" in str(found.caution) or not clear


@pytest.mark.parametrize(
    ("given", "to", "kept"),
    [
        ("8", ".tif", "8"),
        ("16", ".tif", "16"),
        ("16", ".png", "16"),
        ("8", ".png", "8"),
        ("float", ".png", "16"),
        ("float", ".tif", "float"),
        ("16", ".exr", "float"),
    ],
)
def test_what_is_made_of_a_photo_keeps_its_bits(tmp_path, given, to, kept):
    write_photo(tmp_path / "p.tif", picture(), "linear" if given == "float" else "srgb", given)
    assert kept_depth(tmp_path / f"o{to}", read_photo(tmp_path / "p.tif")) == kept


def parts(*bodies: bytes) -> bytes:
    return b"".join(b"\xff\xfe" + struct.pack(">H", len(body) + 2) + body for body in bodies)


def test_a_film_that_a_phone_appends_to_a_photo_is_no_part_of_it(tmp_path):
    """In six million bytes of a film the mark of a scan occurs some ninety times by chance."""
    plain, moving = tmp_path / "plain.jpg", tmp_path / "moving.jpg"
    Image.fromarray((255 * picture()).astype(np.uint8)).save(plain, progressive=True)
    film = np.random.default_rng(1).bytes(6_000_000)
    moving.write_bytes(plain.read_bytes() + film)
    assert film.count(b"\xff\xda") > MOST_SCANS
    assert (read_samples(moving) == read_samples(plain)).all()


@pytest.mark.parametrize("beside", [b"", parts(b"\xff\xd9"), b"\xff\xd0\xff\x00", b"\xff\xff"])
def test_no_end_that_is_none_hides_the_scans_of_a_photo(beside, tmp_path):
    path, (head, *_) = tmp_path / "p.jpg", jpeg(90, 90).split(b"\xff\xda")
    scan = jpeg(90, 90)[len(head) : -2]
    for scans in (MOST_SCANS, MOST_SCANS + 1):
        path.write_bytes(head + (scan + beside) * scans + b"\xff\xd9")
        with nullcontext() if scans == MOST_SCANS else pytest.raises(RequestError, match="passes over its pixels"):
            read_samples(path)


def test_a_deep_picture_of_many_pixels_is_read_without_a_warning(tmp_path, monkeypatch):
    path, values = tmp_path / "p.png", np.arange(105, dtype=np.uint16).reshape(5, 7, 3)
    path.write_bytes(write_deep(values))
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 30)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert (read_samples(path) == values).all()
