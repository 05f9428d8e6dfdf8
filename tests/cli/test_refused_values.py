"""Values that no lens has, and that contradict each other, are refused or warned of by name."""

import pytest

from p2sf import Aperture, GeometryError, Lens, RequestError, Surface
from p2sf.camera import Camera
from p2sf.cli import main
from p2sf.glass.media import ConstantIndex
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.parameters import MASK_PARAMETERS

SINGLET = """
stop_surface = 1
[aperture]
stop_semi_diameter = 2.5
[[surface]]
radius = 20.0
thickness = {thickness}
glass = "1.5"
[[surface]]
radius = inf
thickness = 30.0
"""


@pytest.mark.parametrize("name", ["blades", "vanes", "apodisation_power"])
def test_a_count_with_a_fraction_is_refused_not_rounded(name, capsys):
    assert name in {each.name for each in MASK_PARAMETERS}
    assert main(["psf", "tessar", "--" + name.replace("_", "-"), "5.5"]) == 2
    assert '"5.5" is no whole number' in capsys.readouterr().err


def test_every_whole_number_of_a_tuple_is_one(capsys):
    assert main(["image", "tessar", "scene.png", "out.png", "--region", "1", "2.5", "3", "4"]) == 2
    assert '"2.5" is no whole number' in capsys.readouterr().err


def test_a_spectrum_and_a_wavelength_contradict_each_other(capsys):
    assert main(["psf", "tessar", "--spectrum", "d65", "--wavelength-nm", "500"]) == 2
    assert "--spectrum and --wavelength-nm are both given" in capsys.readouterr().err


@pytest.mark.parametrize("values", [{"f_number": 1e-300}, {"f_number": 1e300}, {"sensor_shift_um": 1e308}])
def test_a_camera_of_no_size_is_refused(values):
    with pytest.raises(RequestError, match="give a number from"):
        Camera(**values)


@pytest.mark.parametrize("kind", ["f_number", "stop_semi_diameter", "entrance_pupil_diameter"])
@pytest.mark.parametrize("value", [1e-300, 1e308])
def test_an_aperture_of_no_size_is_refused(kind, value):
    with pytest.raises(GeometryError, match="give a number from"):
        Lens((Surface(20.0, 5.0, 1.5), Surface(-20.0, 20.0)), Aperture(kind, value), 1)


def test_a_thickness_beyond_every_object_is_refused():
    with pytest.raises(GeometryError, match=r"surface 1: thickness 1e\+308 mm; give a number from"):
        Lens((Surface(20.0, 1e308, 1.5), Surface(-20.0, 20.0)), Aperture("stop_semi_diameter", 2.0), 1)


@pytest.mark.parametrize(("thickness", "warned"), [(-3.0, True), (3.0, False)])
def test_glass_of_negative_thickness_is_pointed_out_with_its_psf(thickness, warned, tmp_path, capsys):
    file = tmp_path / "lens.toml"
    file.write_text(SINGLET.format(thickness=thickness), "utf-8")
    assert main(["psf", str(file), "--pixels", "16"]) == 0
    assert ("opposite to the direction of light" in capsys.readouterr().err) is warned


@pytest.mark.parametrize("command", ["info", "coefficients", "psf", "spot", "zernike", "nodes"])
def test_every_command_warns_of_a_glass_of_negative_thickness(command, tmp_path, capsys):
    surfaces = Surface(50.0, -3.0, ConstantIndex(1.5)), Surface(-50.0, 48.0)
    lens = Lens(surfaces, Aperture("stop_semi_diameter", 4.0), 1, fields_deg=(0.0, 3.0))
    path = tmp_path / "negative.toml"
    path.write_text(lens_to_toml(lens))
    assert main([command, str(path)]) in (0, None)
    said = capsys.readouterr().err
    assert said.count("the glass behind surface 1 has a thickness of -3 mm") == 1
