"""Scenes and pictures that cannot be: each is refused by the entry that is wrong; and pictures of other shapes."""

import json
from dataclasses import replace

import numpy as np
import pytest
import tifffile

from p2sf.cli import main
from p2sf.errors import RequestError
from p2sf.io.photo_files import read_photo, write_photo
from p2sf.lens.lens import AIMS, with_aim
from p2sf.lensfile.library import find_lens
from p2sf.scene.files import read_scene
from p2sf.scene.scene import Channel, Scene, limit_of
from p2sf.scene.sensor import Sensor
from tests.cli.test_scene import SCENE

SIMPLE = Scene(Sensor(40, 60, 60.0))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"near_mm": 0.0}, "give positive depths, the near one first"),
        ({"near_mm": 5.0, "far_mm": 4.0}, "from 5 mm to 4 mm"),
        ({"min_psnr_db": -3.0}, "min_psnr_db is -3; give the least peak signal-to-noise"),
        ({"min_psnr_db": 60.0}, "tighter than"),
        ({"rtol": 1.0}, "rtol is 1; give a number between 0 and 1"),
        ({"rtol": 1e-9}, "tighter than .* render single PSFs with method huygens"),
        ({"channels": ()}, "the scene has no channel"),
        ({"aim": "high"}, 'aim is "high"; choose stop or paraxial'),
    ],
)
def test_a_scene_that_cannot_be_is_refused(change, words):
    with pytest.raises(RequestError, match=words):
        replace(SIMPLE, **change)


def test_a_file_of_before_0_3_with_an_unknown_measure_is_refused():
    with pytest.raises(RequestError, match='measured as "ssim"; choose relative, r2, mtf, psnr or hdr'):
        limit_of("ssim", 0.1)


@pytest.mark.parametrize(("line", "aim"), [("", None), ('aim = "paraxial"', "paraxial"), ('aim = "real"', "stop")])
def test_a_scene_says_how_rays_fill_the_pupil_or_leaves_it_to_the_lens(tmp_path, line, aim):
    (tmp_path / "scene.toml").write_text(line + SCENE)
    scene, lens = read_scene(tmp_path / "scene.toml"), find_lens("double_gauss_28")
    for own in AIMS:
        assert scene.camera(with_aim(lens, own)).aim == (aim or own)
    (tmp_path / "scene.toml").write_text('aim = "high"' + SCENE)
    with pytest.raises(RequestError, match=r'scene\.toml: aim is "high"'):
        read_scene(tmp_path / "scene.toml")


@pytest.mark.parametrize(
    ("waves", "weights", "words"),
    [
        ((), (), "0 wavelengths and 0 weights"),
        ((500.0,), (1.0, 2.0), "as many of both"),
        ((500.0,), (0.0,), "positive"),
    ],
)
def test_a_channel_without_light_is_refused(waves, weights, words):
    with pytest.raises(RequestError, match=words):
        Channel("grey", waves, weights)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (np.full((4, 5), np.nan, np.float32), "not finite"),
        (np.zeros((4, 5), np.uint32), "uint32 samples; save it with 8 or 16 bits or as float"),
        (np.zeros((6, 7, 5), np.float32), "has the shape"),
    ],
)
def test_a_picture_that_is_none_is_refused(values, words, tmp_path):
    tifffile.imwrite(tmp_path / "bad.tif", values, photometric="minisblack", planarconfig="contig")
    with pytest.raises(RequestError, match=words):
        read_photo(tmp_path / "bad.tif")


def test_planar_colours_are_turned_round(tmp_path):
    planes = np.random.default_rng(0).random((3, 8, 9)).astype(np.float32)
    tifffile.imwrite(tmp_path / "planes.tif", planes, photometric="rgb", planarconfig="separate")
    np.testing.assert_array_equal(read_photo(tmp_path / "planes.tif").values, np.moveaxis(planes, 0, -1))


GREY = '[[channel]]\nname = "grey"\nwavelengths_nm = [550]\n'


@pytest.fixture
def grey(tmp_path):
    path = tmp_path / "grey.toml"
    # Up to 20°, within the tessar's field: beyond it no ray reaches parts of its stop.
    path.write_text(SCENE.replace("60.0", "40.0") + GREY)
    return path


def test_a_coloured_picture_in_a_grey_scene_is_its_luminance(grey, tmp_path, capsys):
    """Green counts ten times as much as blue (IEC 61966-2-1); the lens keeps the mean of an even picture."""
    colours = np.zeros((40, 60, 3), np.float32)
    colours[..., 1] = 0.5
    write_photo(tmp_path / "green.png", colours, "srgb", "16")
    out = tmp_path / "out.tif"
    command = [
        "image",
        "cooke_triplet",
        str(grey),
        str(tmp_path / "green.png"),
        "-o",
        str(out),
        "--deblur",
        "richardson-lucy",
    ]
    assert main([*command, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["deblur"]
    assert read_photo(out).values[15:25, 25:35].mean() == pytest.approx(0.5 * 0.7152, rel=0.02)


def test_two_channels_fit_neither_a_colour_picture_nor_a_file(grey, tmp_path, capsys):
    grey.write_text(SCENE.replace("60.0", "40.0") + GREY + GREY.replace("grey", "other").replace("550", "600"))
    write_photo(tmp_path / "rgb.png", np.full((40, 60, 3), 0.5, np.float32))
    assert main(["image", "cooke_triplet", str(grey), str(tmp_path / "rgb.png"), "-o", str(tmp_path / "o.png")]) == 2
    assert "has 3 channels and the scene 2; give the scene 1 or 3" in capsys.readouterr().err
    write_photo(tmp_path / "one.png", np.full((40, 60), 0.5, np.float32))
    assert main(["image", "cooke_triplet", str(grey), str(tmp_path / "one.png"), "-o", str(tmp_path / "o.png")]) == 2
    assert "the scene has 2 channels, but a picture file has 1 or 3" in capsys.readouterr().err


def test_a_plan_says_what_random_points_found(grey, capsys):
    assert main(["plan", "cooke_triplet", str(grey), "--check", "1"]) == 0
    assert "At 1 random points exact rays find" in capsys.readouterr().out
