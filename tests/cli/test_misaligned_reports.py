"""What is printed of a misaligned lens: that it is, where, and figures of its own rays."""

import json

import numpy as np
import pytest

import p2sf
from p2sf.cli import main
from p2sf.errors import P2SFWarning
from p2sf.lens.lens import with_sensor
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lensfile.toml.lens import lens_to_toml
from tests.raytrace.test_field_geometry import folded

MOVED = "before surface 3: axes decentred by (0, 0.2, 0) mm and tilted by (0, 0, 0)°"


@pytest.fixture
def moved(tmp_path):
    path = tmp_path / "moved.toml"
    path.write_text(lens_to_toml(displaced(p2sf.load_lens("cooke_triplet"), 3, 4, Placement(decentre_y=0.2))))
    return str(path)


def test_info_coefficients_and_spot_say_what_is_misaligned(moved, capsys):
    for command in ("info", "coefficients"):
        assert main([command, moved]) == 0
        said = capsys.readouterr()
        assert MOVED in said.err and "decentred" in said.out.splitlines()[0]
    assert main(["info", moved, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["misalignment"][0] == MOVED
    assert main(["info", "cooke_triplet", "--json"]) == 0
    assert "misalignment" not in json.loads(capsys.readouterr().out)
    assert main(["spot", moved]) == 0
    assert "decentred" in capsys.readouterr().out.splitlines()[0]


def test_coefficients_of_a_misaligned_lens_warn(moved):
    with pytest.warns(P2SFWarning, match="those of the aligned lens"):
        p2sf.Camera(p2sf.load_lens(moved)).at().coefficients()


def test_a_lens_moved_along_its_axis_is_aligned_and_warns_of_nothing(recwarn):
    lens = displaced(p2sf.load_lens("cooke_triplet"), 3, 4, Placement(decentre_z=0.2))
    p2sf.Camera(lens).at().coefficients()
    assert not recwarn.list


def test_focus_of_a_folded_lens_is_where_rays_meet():
    """The sensor goes where the file's own paraxial image is, whichever way the axis is folded."""
    lens = p2sf.load_lens("cooke_triplet")
    bent = folded(lens, 20.0)
    for depth in (np.inf, 800.0):
        source = p2sf.Source(depth, wavelength_nm=587.5618)
        one, other = (p2sf.Camera(each, focus_mm=depth).at(source).zernike().rms for each in (lens, bent))
        # Foci are found by rays 1e-3 of the radius from the chief ray, its square relative to the paraxial one.
        assert other == pytest.approx(one, rel=1e-4)
    off = with_sensor(bent, bent.sensor_mm + 0.3)
    one, other = (p2sf.Camera(each, focus_mm=np.inf).at().zernike().rms for each in (bent, off))
    assert other == pytest.approx(one, rel=1e-6)
