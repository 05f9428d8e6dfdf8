"""Zoom and focus positions on the command line, in databases and in scenes."""

import json

import numpy as np
import pytest

import p2sf
from p2sf.cli import main
from p2sf.lensfile.toml.lens import write_toml
from p2sf.scene.files import read_scene
from tests.support.lenses.zooms import focusing_zoom, two_group_zoom, zoom_lens_at


@pytest.fixture
def zoom(tmp_path):
    write_toml(two_group_zoom(), tmp_path / "zoom.toml")
    return str(tmp_path / "zoom.toml")


def printed(capsys, *arguments: str) -> dict:
    assert main([*arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(("asked", "focal"), [([], 30.0), (["--zoom", "tele"], 60.0), (["--zoom", "40"], 40.0)])
def test_info_is_of_the_position_asked_for(zoom, capsys, asked, focal):
    assert printed(capsys, "info", zoom, *asked)["effective_focal_length"] == pytest.approx(focal, rel=1e-13)


def test_tables_name_the_position(zoom, capsys):
    assert main(["coefficients", zoom, "--zoom", "47.5"]) == 0
    assert "zoom 47.5 mm: object at ∞" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--zoom", "90"], "--zoom is 90; give a number from 30 to 60 mm, or a column of the lens: wide, 40 mm, tele"),
        (["--focus-position", "1"], "--focus-position is 1, but the lens has no such ring; leave it out"),
        (["--focus-position", "1", "--focus-mm", "900"], "--focus-mm and --focus-position; keep one"),
    ],
)
def test_what_cannot_be_is_one_sentence(zoom, capsys, options, said):
    assert main(["info", zoom, *options]) == 2
    assert said in capsys.readouterr().err


def test_a_database_is_of_one_position_and_says_which(zoom, tmp_path, capsys):
    file = str(tmp_path / "zoom.npz")
    assert main(["database", "build", zoom, "--zoom", "40 mm", "--depths-mm", "inf", "-o", file]) == 0
    capsys.readouterr()
    assert main(["database", "info", file]) == 0
    assert "zoom 40 mm" in capsys.readouterr().out
    stored = p2sf.open_database(file)
    assert "zoom 40 mm" in repr(stored) and stored.lens.positions is None
    assert [s.thickness for s in stored.lens.surfaces] == [s.thickness for s in zoom_lens_at(40.0).surfaces]
    assert main(["psf", file, "--zoom", "tele"]) == 2
    assert "--zoom needs the lens" in capsys.readouterr().err


def test_the_library_turns_the_ring_with_lens_at():
    lens = p2sf.lens_at(two_group_zoom(), zoom="tele")
    alone = zoom_lens_at(60.0)
    source = p2sf.Source(field_deg=5)
    found, expected = (p2sf.render(each, source, "seidel", pixels=16, pixel_um=2.0) for each in (lens, alone))
    assert np.array_equal(found.values, expected.values)


def test_a_scene_takes_positions(tmp_path):
    (tmp_path / "scene.toml").write_text(
        'zoom = "tele"\nfocus_position = 1.5\n[sensor]\nrows = 4\ncolumns = 6\npixel_um = 9\n'
    )
    lens = read_scene(tmp_path / "scene.toml").camera(focusing_zoom())
    assert lens.positions.place == (60.0, 1.5)
