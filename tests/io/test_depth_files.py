"""Maps of depth from files: what their numbers mean, those of HEIF photos, and files that are none."""

from math import inf
from types import SimpleNamespace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.io import photo_files
from p2sf.io.depth_files import DepthScale, heif_depths, own_depths, read_depths
from p2sf.io.photo_files import write_photo

RAMP = np.linspace(0, 1, 12, dtype=np.float32).reshape(3, 4)


@pytest.mark.parametrize("depth", ["8", "16"])
@pytest.mark.parametrize("meaning", ["near_white", "near_black"])
def test_whole_numbers_are_even_in_1_over_distance_between_near_and_far(tmp_path, depth, meaning):
    write_photo(tmp_path / "map.png", RAMP, "linear", depth)
    found = read_depths(tmp_path / "map.png", DepthScale(meaning, 500.0, 4000.0))
    nearness = RAMP if meaning == "near_white" else 1 - RAMP
    step = 2.0 ** -int(depth)  # half a level
    assert np.abs(1 / found - (1 / 4000 + nearness * (1 / 500 - 1 / 4000))).max() < step * (1 / 500)
    assert found.dtype == np.float32 and found.min() == pytest.approx(500) and found.max() == pytest.approx(4000)


def test_far_may_be_infinity(tmp_path):
    write_photo(tmp_path / "map.png", RAMP, "linear", "16")
    found = read_depths(tmp_path / "map.png", DepthScale("near_white", 500.0, inf))
    assert found[0, 0] == inf and found[-1, -1] == pytest.approx(500)


@pytest.mark.parametrize(("meaning", "unit"), [("mm", 1.0), ("m", 1000.0)])
def test_millimetres_and_metres_are_taken_as_they_are_and_0_is_infinity(tmp_path, meaning, unit):
    write_photo(tmp_path / "map.tif", np.array([[0.0, 1.5], [2.5, 4.0]], np.float32), "linear", "float")
    found = read_depths(tmp_path / "map.tif", DepthScale(meaning))
    assert found.tolist() == [[inf, 1.5 * unit], [2.5 * unit, 4.0 * unit]]
    import tifffile

    tifffile.imwrite(tmp_path / "whole.tif", np.array([[1200, 65535]], np.uint16))
    assert read_depths(tmp_path / "whole.tif", DepthScale("mm")).tolist() == [[1200.0, 65535.0]]


def test_infinity_and_what_renderers_write_of_the_sky_are_far_away(tmp_path):
    values = np.array([[inf, 1e14], [2.5, 4.0]], np.float32)
    write_photo(tmp_path / "map.tif", values, "linear", "float")
    assert read_depths(tmp_path / "map.tif", DepthScale("m")).tolist() == [[inf, inf], [2500.0, 4000.0]]
    library = pytest.importorskip("OpenEXR")
    header = {"compression": library.ZIP_COMPRESSION, "type": library.scanlineimage}
    with library.File(header, {"Z": values}) as file:
        file.write(str(tmp_path / "map.exr"))
    assert read_depths(tmp_path / "map.exr", DepthScale("m")).tolist() == [[inf, inf], [2500.0, 4000.0]]


def test_grey_saved_in_colours_is_a_map_and_colours_are_none(tmp_path):
    write_photo(tmp_path / "grey.png", np.repeat(RAMP[..., None], 3, -1), "linear")
    write_photo(tmp_path / "colours.png", np.random.default_rng(0).random((3, 4, 3)), "linear")
    assert read_depths(tmp_path / "grey.png", DepthScale()).shape == (3, 4)
    with pytest.raises(RequestError) as raised:
        read_depths(tmp_path / "colours.png", DepthScale())
    assert raised.value.message.values["shape"] == (3, 4, 3)


@pytest.mark.parametrize(
    ("values", "scale"),
    [
        ([[0.5, -1.0], [0.5, -1.0]], DepthScale()),
        ([[0.5, np.nan], [0.5, np.nan]], DepthScale()),
        ([[0.5, np.nan], [0.5, np.nan]], DepthScale("m")),
        ([[0.5, inf], [0.5, inf]], DepthScale()),
        ([[0.5, 3.0], [0.5, 3.0]], DepthScale()),
        ([[0.0, 0.0], [0.0, 0.0]], DepthScale("mm")),
    ],
    ids=["negative", "nan", "nan metres", "infinite share", "beyond 1", "all 0"],
)
def test_numbers_that_are_no_depths_are_one_sentence(tmp_path, values, scale):
    write_photo(tmp_path / "map.tif", np.array(values, np.float32), "linear", "float")
    with pytest.raises(RequestError) as raised:
        read_depths(tmp_path / "map.tif", scale)
    assert str(tmp_path / "map.tif") in str(raised.value)


def test_files_that_are_no_pictures_are_one_sentence(tmp_path):
    (tmp_path / "map.png").write_bytes(b"no picture")
    for name in ("map.png", "none.png"):
        with pytest.raises(RequestError):
            read_depths(tmp_path / name, DepthScale())


@pytest.mark.parametrize("wrong", [{"meaning": "feet"}, {"near_mm": 0.0}, {"near_mm": 5.0, "far_mm": 4.0}])
def test_a_scale_that_means_nothing_is_refused(wrong):
    with pytest.raises(RequestError):
        DepthScale(**wrong)


LIMITS = {"d_min": 0.25, "d_max": 2.0, "z_near": 0.5, "z_far": 4.0}  # 1/m and m: the same depths


@pytest.mark.parametrize(("kind", "middle"), [(0, 1 / 1.125), (1, 1 / 1.125), (2, 2.25)])
def test_depths_of_heif_are_disparities_inverse_depths_or_depths(kind, middle):
    raw = np.array([[0, 65535 // 2, 65535]], np.uint16)[..., None]
    found = heif_depths(raw, LIMITS | {"representation_type": kind}, "photo.heic")[0]
    assert sorted(found.tolist()) == [
        pytest.approx(500),
        pytest.approx(1000 * middle, rel=1e-4),  # of 65535 steps
        pytest.approx(4000),
    ]


@pytest.mark.parametrize("stated", [{}, {"representation_type": 1}, LIMITS | {"representation_type": 3}])
def test_depths_of_heif_without_limits_are_refused(stated):
    with pytest.raises(RequestError):
        heif_depths(np.zeros((2, 2), np.uint8), stated, "photo.heic")


class DepthImage:
    def __init__(self):
        self.info = {"metadata": LIMITS | {"representation_type": 1}}

    def __array__(self, dtype=None, copy=None):
        return np.array([[0, 255]], np.uint8)


def heif_of(images):
    return lambda path: SimpleNamespace(open_heif=lambda path: SimpleNamespace(info={"depth_images": images}))


def test_a_photos_own_depths_are_those_of_its_first_depth_image(monkeypatch, tmp_path):
    photo = tmp_path / "photo.heic"
    photo.touch()
    monkeypatch.setattr(photo_files, "pillow_heif", heif_of([DepthImage()]))
    assert own_depths(photo).tolist() == [[pytest.approx(4000), pytest.approx(500)]]
    monkeypatch.setattr(photo_files, "pillow_heif", heif_of([]))
    assert own_depths(photo) is None and own_depths("photo.jpg") is None


def test_a_damaged_heif_is_one_sentence(monkeypatch, tmp_path):
    class Damaged:
        def __array__(self, dtype=None, copy=None):
            raise SyntaxError("no colours")  # as pillow-heif says of what it cannot convert

    monkeypatch.setattr(photo_files, "pillow_heif", heif_of([Damaged()]))
    photo = tmp_path / "photo.heic"
    photo.touch()
    with pytest.raises(RequestError) as raised:
        own_depths(photo)
    assert raised.value.message.values["why"] == "no colours"


SIDES = np.arange(12.0).reshape(3, 4)


@pytest.mark.parametrize("orientation", [5, 6, 7, 8])
def test_a_map_that_lies_on_its_side_is_turned_as_its_photo(tmp_path, orientation):
    from PIL import Image

    exif, grey = Image.Exif(), np.round(20 * SIDES).astype(np.uint8)
    exif[photo_files.ORIENTATION] = orientation
    Image.fromarray(grey).save(tmp_path / "photo.png", exif=exif)
    upright = photo_files.read_samples(tmp_path / "photo.png")
    assert upright.shape == (4, 3)
    assert (photo_files.turned_as(tmp_path / "photo.png", grey) == upright).all()
    assert (photo_files.turned_as(tmp_path / "photo.png", upright) == upright).all()
    square = SIDES[:, :3]
    assert photo_files.turned_as(tmp_path / "photo.png", square) is square


CORNERS = {1: [500.0, 4000.0, 886.2, 886.2], 3: [886.2, 886.2, 4000.0, 500.0], 6: [886.2, 500.0, 886.2, 4000.0]}


@pytest.mark.parametrize("orientation", CORNERS)
@pytest.mark.parametrize("of_depth", [True, False], ids=["both stated", "the photo's stated"])
def test_depths_of_a_heif_photo_lie_as_its_colours(tmp_path, orientation, of_depth):
    pytest.importorskip("pillow_heif")
    from tests.support.heif_with_depth import write_heif_with_depth

    if orientation == 3 and not of_depth:
        pytest.skip("proportions do not tell")
    path, near = tmp_path / "photo.heic", np.full((48, 72), 128, np.uint8)
    near[:24, :36], near[:24, 36:] = 255, 0
    colours = np.repeat(np.where(near == 255, 255, 0).astype(np.uint8)[..., None], 3, -1).repeat(2, 0).repeat(2, 1)
    write_heif_with_depth(path, colours, near, (0.25, 2.0), (orientation, orientation if of_depth else 1))
    found, seen = photo_files.turned_as(path, own_depths(path)), photo_files.read_photo(path).values[..., 0]
    assert found[[0, 0, -1, -1], [0, -1, 0, -1]] == pytest.approx(np.array(CORNERS[orientation]), rel=5e-3)  # of 255
    assert found.shape[0] * 2 == seen.shape[0]
    assert ((seen > 0.5) == (found < 600).repeat(2, 0).repeat(2, 1)).mean() > 0.99  # HEVC blurs the edges
