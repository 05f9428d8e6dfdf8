"""OSLO files: commands, glasses, units, solves, and what is refused by surface and name."""

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.lens.lens import indices
from p2sf.lensfile.library import load_lens
from p2sf.paraxial.first_order import cardinal_points, image_distance
from tests.support.lenses.lens_files import FOLDER, read, refused_at
from tests.support.rays.paraxial_by_hand import first_order

TRIPLET = "triplet.len"
RADII = (22.01359, 1 / -0.002294838, -22.21328, 20.29192, 79.6836, -18.39533)
GAPS = (3.25896, 6.00755, 0.99997, 4.75041, 2.95208)


def test_the_prescription_is_read_as_it_stands():
    lens = load_lens(FOLDER / TRIPLET)
    assert lens.title == "Triplet of one's own"
    assert [s.radius for s in lens.surfaces] == pytest.approx(RADII, rel=1e-15)
    assert [s.thickness for s in lens.surfaces] == [*GAPS, pytest.approx(42.20778)]  # 42 and the image's 0.20778
    assert (lens.surfaces[1].conic, lens.surfaces[1].aspheric) == (-0.5, (1e-7, -2e-10))
    assert [s.semi_diameter for s in lens.surfaces] == [9.2, np.inf, np.inf, 3.8, np.inf, np.inf]
    assert lens.surfaces[2].medium.label == "SCHOTT F2" and float(lens.surfaces[4].medium.index(0.55)) == 1.6227
    assert float(lens.surfaces[0].medium.index(0.48613)) == 1.6321  # the second of the wavelengths
    assert lens.stop_surface == 4 and lens.fields_deg == (0.0, 14.0, 20.0)
    assert lens.wavelengths_nm == (587.56, 486.13, 656.27)


def test_first_order_data_are_those_of_the_numbers():
    """1e-12: rounding of a dozen operations, a thousand times over."""
    lens = load_lens(FOLDER / TRIPLET)
    index = [float(n) for n in indices(lens, 0.58756)]
    by_hand = first_order([1 / r for r in RADII], [*GAPS, 0], index)
    assert float(cardinal_points(lens, 0.58756).effective_focal_length) == pytest.approx(by_hand[0], rel=1e-12)
    assert float(image_distance(lens, np.inf, 0.58756)) == pytest.approx(by_hand[1], rel=1e-12)
    assert lens.aperture.value == 10.0  # twice the radius of the entering beam


@pytest.mark.parametrize(("old", "aperture"), [("FNO 4", ("f_number", 4.0)), ("EBR 3", ("entrance_pupil_diameter", 6))])
def test_apertures(old, aperture):
    # The primary wavelength is the first; it is the lens's own where it is the middle one too.
    waves = ("WV2 0.48613\nWV3 0.65627", ""), ("1.6227 1.6321 1.6187", "1.6227")
    found = read(TRIPLET, ("EBR 5.0", old), *waves).lens.aperture
    assert (found.kind, found.value) == aperture


def test_a_far_object_of_a_height_is_an_angle():
    lens = read(TRIPLET, ("ANG 20.0", "OBH -3.6397023426620e+19")).lens
    assert lens.fields_deg[-1] == pytest.approx(20.0, abs=1e-9) and lens.fields_deg[0] == 0  # only for TH 1e20 below
    near = read(TRIPLET, ("ANG 20.0", "OBH -10"), ("TH 1.0e+20", "TH 200.0"))
    assert "200 mm" in near.report.text


def test_a_solved_sensor_stands_at_the_focus():
    found = read(TRIPLET, ("TH 42.0", "PY 0.0"))
    assert found.lens.sensor_mm == pytest.approx(float(image_distance(found.lens, np.inf, 0.58756)), rel=1e-12)
    assert "does not say where the sensor is" in found.report.text


def test_units_mirrors_and_the_default_stop():
    lens = read(TRIPLET, ("UNI 1.0", "UNI 25.4"), ("GLA F2", "RFL"), ("AST\n", "")).lens
    assert lens.surfaces[0].radius == pytest.approx(22.01359 * 25.4) and lens.surfaces[2].reflects
    assert lens.stop_surface == 1 and lens.aperture.value == 254.0


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ("TLA 5.0", "surface 5 is tilted or decentred"),
        ("DCY 0.5", "surface 5 is tilted or decentred"),
        ("ASP ASI 4", "surface 5 has a shape that is not a sphere"),
        ("PFL 50", "surface 5 is an ideal lens"),
        ("DOE DFX 5", "surface 5 diffracts"),
        ("TH 1e20", "surface 5 has an infinite thickness"),
        ("RD five", '"five" is not a number'),
        ("RD", "RD: a number is missing"),
    ],
)
def test_what_cannot_be_read_is_refused_by_surface_and_line(command, said):
    refused_at(TRIPLET, ("GLA 1.6227", f"GLA 1.6227\n{command}"), said)


def test_the_rest_is_refused_too():
    refused_at(
        TRIPLET, ("1.6227 1.6321 1.6187", "1.6227 1.6321"), "private glass CROWN has not one index per wavelength"
    )
    refused_at(TRIPLET, ("WV 0.58756", "WV 587.56"), "is not that of light; give micrometres")
    refused_at(TRIPLET, ("UNI 1.0", "UNI 0"), 'lens unit "0" is not in mm')
    with pytest.raises(LensFileError, match="no surface between object and image"):
        read(TRIPLET, ("NXT", "XYZ"))
