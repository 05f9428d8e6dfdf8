"""`p2sf plan` and `p2sf image`, run as a user runs them."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from p2sf.camera import Camera
from p2sf.cli import main
from p2sf.cli.scenes import _warn_of_white, depth_map
from p2sf.errors import RequestError
from p2sf.image.deblur import photo_statistics
from p2sf.image.form import plan_lattice
from p2sf.io.photo_files import read_photo, write_photo
from p2sf.scene.files import read_scene
from tests.long.sharpening import texture

SCENE = """
rtol = 0.1
f_number = 5.6
[sensor]
rows = 40
columns = 60
pixel_um = 60.0
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    return path


def test_a_plan_explains_itself(scene, capsys):
    assert main(["plan", "double_gauss_28", str(scene)]) == 0
    told = capsys.readouterr().out
    assert "keeps the tolerance" in told and "full grid" in told
    assert main(["plan", "double_gauss_28", str(scene), "--check", "1", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["meets"] and facts["measured"]["kept"] and facts["predicted_error"] <= 0.1
    assert len(facts["decisions"]) == 5 + 3  # one for each kind, and for the colours of each channel


def test_a_plan_tells_its_progress_on_a_terminal(scene, capsys, monkeypatch):
    monkeypatch.setattr("p2sf.cli.scenes.TELL_EVERY_S", 0.0)
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    scene.write_text(SCENE.replace("rows = 40", "rows = 4").replace("columns = 60", "columns = 6"))
    assert main(["plan", "tessar", str(scene)]) == 0
    lines = capsys.readouterr().err.split("\r")
    assert "planning: 1 measurements" in lines[1] and len(lines) > 12 and not lines[-1].strip()


def test_a_picture_goes_through_the_lens(scene, tmp_path, capsys):
    out = tmp_path / "out.tif"
    assert main(["image", "double_gauss_28", str(scene), "chart:text", "-o", str(out), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["rows"] == 40
    formed = read_photo(out, "srgb").values
    assert formed.shape == (40, 60, 3)
    write_photo(tmp_path / "grey.png", np.full((40, 60), 0.5, np.float32), "srgb", "16")
    arguments = ["image", "double_gauss_28", str(scene), str(tmp_path / "grey.png"), "-o", str(tmp_path / "b.png")]
    assert main([*arguments, "--noise", "0.002", "--deblur", "wiener", "--method", "lowrank"]) == 0
    assert abs(read_photo(tmp_path / "b.png").values[15:25, 25:35].mean() - 0.5) < 0.02
    assert main([*arguments, "--preview"]) == 0


def test_a_region_and_a_screen_take_fewer_pixels(scene, tmp_path, capsys):
    out = tmp_path / "out.tif"
    given = ["image", "double_gauss_28", str(scene), "chart:text", "-o", str(out), "--json"]
    for flags, shape in ((["--longest", "25"], (13, 20)), (["--region", "4", "20", "10", "30"], (16, 20))):
        assert main([*given, *flags]) == 0
        facts = json.loads(capsys.readouterr().out)
        assert (facts["rows"], facts["columns"]) == shape == read_photo(out, "srgb").values.shape[:2]


def test_a_plan_has_the_depths_of_its_map_alone(scene, tmp_path, capsys):
    depth = np.where(np.arange(60) < 30, 20000.0, 0.0) * np.ones((40, 1))
    write_photo(tmp_path / "depth.tif", depth.astype(np.float32), "linear", "float")
    scene.write_text(SCENE + '[depth]\nnear_mm = 20000\nfar_mm = inf\nmap = "depth.tif"\n')
    assert main(["plan", "double_gauss_28", str(scene), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["nodes"]["depths"] <= 2
    scene.write_text(SCENE + "[depth]\nnear_mm = 20000\nfar_mm = inf\ngaps_mm = [[20000, inf]]\n")
    assert main(["plan", "double_gauss_28", str(scene), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["nodes"]["depths"] <= 2


def test_a_photo_is_sharpened(tmp_path, capsys):
    photo, out = tmp_path / "photo.tif", tmp_path / "sharp.tif"
    write_photo(photo, np.full((30, 40), 0.25, np.float32), "linear")
    arguments = ["sharpen", "achromat_f6", str(photo), "--focus-mm", "4000", "--rtol", "0.2", "-o", str(out)]
    assert main([*arguments, "--pixel-um", "20", "--noise", "0.01", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {
        "file": str(out),
        "rows": 30,
        "columns": 40,
        "encoding": "linear",
        "least_noise": 0.01,
        "noise": 0.01,
    }
    assert read_photo(out).values[..., 0] == pytest.approx(np.full((30, 40), 0.25), abs=1e-3)
    assert main(arguments) == 2 and "--pixel-um" in capsys.readouterr().err
    assert main([*arguments[:-1], str(photo), "--pixel-um", "20"]) == 2 and "--output" in capsys.readouterr().err


def test_the_noise_that_sharpening_assumes_is_printed(tmp_path, capsys):
    """Of a texture the noise is known between two limits only; the estimate alone is another number."""
    photo, values = tmp_path / "photo.tif", texture(80).astype(np.float32)[..., None]
    write_photo(photo, values, "linear", "float")
    camera = Camera("achromat_f6", focus_mm=4000, pixel_um=20)
    planned = camera.picture_plan(values, rtol=0.2)
    told = photo_statistics(values, plan_lattice(planned, planned.vergences[0]))
    assert told.low < 0.5 * told.high
    arguments = ["sharpen", "achromat_f6", str(photo), "--focus-mm", "4000", "--rtol", "0.2", "--pixel-um", "20"]
    assert main([*arguments, "-o", str(tmp_path / "sharp.tif"), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert (printed["least_noise"], printed["noise"]) == pytest.approx((told.low, told.high), rel=1e-6)
    assert main([*arguments, "-o", str(tmp_path / "sharp.tif")]) == 0
    assert f"noise {told.low:.2g} to {told.high:.2g} of white" in capsys.readouterr().out


def test_depths_come_from_a_float_tiff(scene, tmp_path, capsys):
    depth = np.zeros((40, 60), np.float32)
    depth[:, :30] = 20000.0
    write_photo(tmp_path / "depth.tif", depth, "linear", "float")
    rough = SCENE.replace("rtol = 0.1", "rtol = 0.4")  # its plan is made in a few seconds
    scene.write_text(rough + '[depth]\nnear_mm = 20000\nmap = "depth.tif"\nfar_mm = inf\n')
    assert main(["image", "double_gauss_28", str(scene), "chart:text", "-o", str(tmp_path / "o.png")]) == 0


@pytest.mark.parametrize(("bits", "meaning"), [("8", None), ("16", "near_black"), ("float", "m")])
def test_depths_of_whole_numbers_reach_from_far_to_near(scene, tmp_path, bits, meaning):
    """White is near and black far, or what the scene says of the numbers."""
    near_white = np.linspace(0, 1, 256)[None].repeat(2, 0)
    numbers = {"near_black": 1 - near_white, "m": 1 / (0.1 + 0.4 * near_white)}.get(meaning, near_white)
    write_photo(tmp_path / "depth.tif", numbers.astype(np.float32), "linear", bits)
    said = f'map_meaning = "{meaning}"' if meaning else ""
    scene.write_text(SCENE + f'[depth]\nnear_mm = 2000\nfar_mm = 10000\nmap = "depth.tif"\n{said}\n')
    asked = read_scene(scene)
    assert 1000 / depth_map(asked) == pytest.approx(0.1 + 0.4 * near_white, rel=1e-5)
    with pytest.raises(RequestError) as refused:
        depth_map(replace(asked, map_meaning="feet"))
    assert refused.value.message.values["meaning"] == "feet"


def test_a_missing_depth_map_is_told_before_the_plan(scene, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("p2sf.cli.scenes.plan", lambda *_: pytest.fail("seconds of planning for nothing"))
    scene.write_text(SCENE + '[depth]\nnear_mm = 20000\nmap = "absent.tif"\n')
    assert main(["image", "double_gauss_28", str(scene), "chart:text", "-o", str(tmp_path / "o.png")]) == 2
    assert "absent.tif cannot be read" in capsys.readouterr().err


@pytest.mark.parametrize("lost", ["in.png", "depth.tif"])
def test_a_picture_does_not_overwrite_what_it_is_made_of(scene, tmp_path, capsys, monkeypatch, lost):
    """By another path to the same file too, and before any work."""
    monkeypatch.setattr("p2sf.cli.scenes.plan", lambda *_: pytest.fail("work for nothing"))
    monkeypatch.chdir(tmp_path)
    scene.write_text(SCENE + '[depth]\nnear_mm = 20000\nmap = "depth.tif"\n')
    for name in ("in.png", "depth.tif"):
        write_photo(tmp_path / name, np.full((40, 60), 0.5, np.float32))
    before = (tmp_path / lost).read_bytes()
    elsewhere = tmp_path / "link" / lost
    elsewhere.parent.symlink_to(tmp_path)
    assert main(["image", "double_gauss_28", str(scene), "in.png", "-o", str(elsewhere)]) == 2
    assert f"{lost}; choose another name" in capsys.readouterr().err
    assert (tmp_path / lost).read_bytes() == before


@pytest.mark.parametrize("line", ["f_number = 0", "f_number = 5.6\nfocus_mm = 10"])
def test_a_scene_the_lens_cannot_take_is_told_in_the_scenes_words(scene, capsys, line):
    scene.write_text(SCENE.replace("f_number = 5.6", line))
    assert main(["plan", "double_gauss_28", str(scene)]) == 2
    told = capsys.readouterr().err
    assert f"scene.toml: {line.split()[-3]} is " in told and "--" not in told


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["plan", "double_gauss_28", "absent.toml"], "absent.toml"),
        (["plan", "double_gauss_28", "SCENE", "--check", "-1"], "--check"),
        (["image", "double_gauss_28", "SCENE", "chart:text"], "--output"),
        (["image", "double_gauss_28", "SCENE", "chart:text", "-o", "a.jpg"], ".jpg"),
        (["image", "double_gauss_28", "SCENE", "chart:txt", "-o", "a.png"], "did you mean text"),
        (["image", "double_gauss_28", "SCENE", "absent.png", "-o", "a.png"], "absent.png"),
        (["image", "double_gauss_28", "SCENE", "chart:text", "-o", "a.png", "--noise", "-1"], "--noise"),
        (
            ["image", "double_gauss_28", "SCENE", "chart:text", "-o", "a.png", "--preview", "--deblur", "wiener"],
            "--deblur",
        ),
        (["image", "tessar", "SCENE", "chart:text", "-o", "a.png", "--longest", "0"], "--longest"),
        (["image", "tessar", "SCENE", "chart:text", "-o", "a.png", "--region", "0", "41", "0", "9"], "--region"),
        (
            ["image", "tessar", "SCENE", "chart:text", "-o", "a.png", "--region", "0", "4", "0", "9", "--preview"],
            "--preview",
        ),
    ],
)
def test_every_mistake_is_one_sentence(scene, tmp_path, capsys, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    assert main([str(scene) if a == "SCENE" else a for a in arguments]) == 2
    told = capsys.readouterr().err
    assert words in told and told.count("\n") == 1 and "Traceback" not in told


def test_a_map_of_depths_is_not_sharpened_by_the_kernels_of_one(scene, tmp_path, capsys):
    write_photo(tmp_path / "depth.tif", np.full((40, 60), 20000.0, np.float32), "linear", "float")
    scene.write_text(SCENE + '[depth]\nnear_mm = 20000\nmap = "depth.tif"\nfar_mm = inf\n')
    arguments = ["image", "double_gauss_28", str(scene), "chart:text", "-o", str(tmp_path / "o.png")]
    assert main([*arguments, "--deblur", "richardson-lucy"]) == 2 and "wiener" in capsys.readouterr().err
    assert main([*arguments, "--surround", "black", "--preview"]) == 2 and "--surround" in capsys.readouterr().err


@pytest.mark.parametrize("depth", ["8", "16", "half", "float"])
def test_light_above_white_is_told_where_whole_numbers_cut_it_off(depth, capsys):
    formed = np.full((10, 20, 3), 0.5)
    _warn_of_white(Path("picture.tif"), formed, depth)
    assert not capsys.readouterr().err
    formed[0, 0, 1] = 2.0
    _warn_of_white(Path("picture.tif"), formed, depth)
    said = capsys.readouterr().err
    assert ("0.5 % of the picture is brighter than white" in said) == (depth in ("8", "16"))
