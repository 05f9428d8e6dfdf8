"""CODE V files: commands, comments, continued lines, glasses, units, and what is refused by surface number."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.lens.shapes import RadialPolynomial
from p2sf.lensfile.library import load_lens
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.pupils import paraxial_rays, working_f_number
from tests.support.lenses.lens_files import FOLDER, read, read_file, refused_at

DOUBLET, PRIVATE = "doublet.seq", "private.seq"


def efl(lens):
    return float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length)


def test_the_prescription_is_read_as_it_stands():
    lens = load_lens(FOLDER / DOUBLET)
    assert lens.title == "Doublet; with a semicolon & an ampersand!"
    assert [round(s.radius, 9) for s in lens.surfaces] == [62.5, -45.454545455, -128.205128205]
    assert [s.thickness for s in lens.surfaces] == [6.0, 2.5, 96.0]  # 95.5 and the image's 0.5 of defocus
    assert [s.medium.label for s in lens.surfaces] == ["SCHOTT N-BK7", "SCHOTT N-SF5", "1.0"]
    assert lens.surfaces[2].conic == -0.5 and lens.surfaces[2].aspheric == (1e-7, -2e-10)
    assert [s.semi_diameter for s in lens.surfaces] == [12.5, np.inf, 12.5]  # EDG is no clear rim
    assert (lens.stop_surface, lens.aperture.kind, lens.aperture.value) == (1, "entrance_pupil_diameter", 20.0)
    assert lens.fields_deg == (0.0, 1.0)


def test_it_is_the_lens_of_the_zemax_file():
    """Both files state one doublet; their 1/radius differ in the sixteenth digit."""
    assert efl(load_lens(FOLDER / DOUBLET)) == pytest.approx(efl(load_lens(FOLDER / "doublet.zmx")), rel=1e-12)


def test_private_glass_codes_units_and_finite_object():
    lens = load_lens(FOLDER / PRIVATE)
    first, second, third, fourth = (s.medium for s in lens.surfaces)
    assert float(first.index(0.55)) == pytest.approx(1.495, abs=1e-12)  # halfway between 500 and 600 nm
    assert (second.nd, second.vd) == (1.517, 64.2) and (third.nd, third.vd) == (1.62, 36.4) and fourth.label == "1.0"
    assert lens.surfaces[0].radius == 25.4 / 0.5 and lens.surfaces[0].thickness == 0.2 * 25.4
    assert lens.stop_surface == 2


def test_the_image_f_number_is_the_working_one_of_a_finite_object():
    lens = load_lens(FOLDER / PRIVATE)
    assert float(working_f_number(lens, 254.0, 0.55)) == pytest.approx(4.0, rel=1e-10)


@pytest.mark.parametrize("aperture", ["FNO 4", "NA 0.124034735"])  # sin(arctan(1/8))
def test_an_image_sided_aperture_holds_behind_a_mirror_too(aperture):
    folded = ("S 0.0 0.05 620.364", "S -4.0 -0.2 REFL"), ("S 0.0 1.4", "S 0.0 -1.4"), ("FNO 4", aperture)
    lens = read(PRIVATE, *folded).lens
    assert lens.directions[-1] == -1
    assert abs(float(working_f_number(lens, 254.0, 0.55))) == pytest.approx(4.0, rel=1e-8)  # the digits of NA


def test_the_image_f_number_of_an_object_at_infinity_is_the_f_number():
    aperture = read(DOUBLET, ("EPD   20.0", "FNO 5")).lens.aperture
    assert (aperture.kind, aperture.value) == ("f_number", 5.0)


def test_image_heights_of_a_finite_object_become_angles():
    """The chief ray of the field meets the paraxial image plane at the stated height."""
    lens = load_lens(FOLDER / PRIVATE)
    rays = paraxial_rays(lens, 254.0, 0.55)
    plane = float(image_distance(lens, 254.0, 0.55))
    height = np.tan(np.deg2rad(lens.fields_deg[1])) * float(rays.chief_y[-1] + rays.chief_nu[-1] * plane)
    assert abs(height) == pytest.approx(2.54, rel=1e-10)


def test_without_a_radius_mode_numbers_are_curvatures():
    found = read(PRIVATE, ("RDM N", ""))
    assert found.lens.surfaces == load_lens(FOLDER / PRIVATE).surfaces and "RDM" not in found.report.text


def test_without_a_radius_mode_numbers_that_no_lens_has_as_curvatures_are_radii():
    """A sphere of 1/62.5 mm cannot hold a pupil of 20 mm; what stands in RDY or CUY is what it says all the same."""
    found = read(DOUBLET, ("RDM;LEN", "LEN"))
    assert found.lens.surfaces == load_lens(FOLDER / DOUBLET).surfaces
    assert "the file does not say RDM; its numbers are read as radii" in found.report.text
    stated = read(DOUBLET, ("RDM;LEN", "LEN"), ("  STO\n", "  STO\n  CUY 0.01\n")).lens
    assert [s.radius for s in stated.surfaces] == [100.0, *[s.radius for s in found.lens.surfaces[1:]]]


def test_a_glass_may_be_an_index_and_an_abbe_number():
    first = read(DOUBLET, ("NBK7_SCHOTT", "1.5168:64.17")).lens.surfaces[0].medium
    assert (first.nd, first.vd) == (1.5168, 64.17)


def test_a_crystal_may_be_named_by_its_page_of_refractiveindex_info():
    """Malitson's calcium fluoride at d, 1.43385 (I. H. Malitson, Appl. Opt. 2, 1103, 1963)."""
    medium = read(DOUBLET, ("NBK7_SCHOTT", "CAF2_MALITSON")).lens.surfaces[0].medium
    assert medium.label == "main/CaF2/Malitson" and float(medium.index(0.5875618)) == pytest.approx(1.43385, abs=2e-5)


@pytest.mark.parametrize("word", ["inf", "INFINITY", "1e20"])
def test_the_object_may_be_infinitely_far_in_words(word):
    assert read(DOUBLET, ("SO    0.0 0.1e14", f"SO 0 {word}")).lens.object_distance == np.inf
    refused_at(DOUBLET, ("62.5 6.0", f"62.5 {word}"), "surface 1 has an infinite thickness")


def test_without_a_stop_it_is_surface_1_and_said():
    found = read(DOUBLET, ("  STO\n", ""))
    assert found.lens.stop_surface == 1 and "no stop (STO)" in found.report.text


def test_later_commands_address_surfaces_by_number():
    lens = read(DOUBLET, ("GO", "THI S2 3.5; RDY S1 60.0; GLA S2 SF5_SCHOTT; STO S3; K S3 -0.25")).lens
    assert (lens.surfaces[1].thickness, lens.surfaces[0].radius, lens.stop_surface) == (3.5, 60.0, 3)
    assert lens.surfaces[1].medium.label == "SCHOTT SF5" and lens.surfaces[2].conic == -0.25


@pytest.mark.parametrize(
    ("code", "nd", "vd"), [("517642", 1.517, 64.2), ("517.642", 1.517, 64.2), ("517000.520000", 1.517, 52.0)]
)
def test_glass_codes(code, nd, vd):
    medium = read(DOUBLET, ("NBK7_SCHOTT", code)).lens.surfaces[0].medium
    assert (medium.nd, medium.vd) == (pytest.approx(nd, abs=1e-12), pytest.approx(vd, abs=1e-12))


@pytest.mark.parametrize("change", [("NSF5_SCHOTT", "REFL"), ("NSF5_SCHOTT", "AIR; RMD REFL")])
def test_a_mirror(change):
    surfaces = read(DOUBLET, change).lens.surfaces
    assert [surface.reflects for surface in surfaces[:3]] == [False, True, False]


def test_zero_tilts_are_no_tilts():
    assert read(DOUBLET, ("  PIM", "  ADE 0.0; YDE 0.0")).lens == read(DOUBLET).lens


def test_a_published_hybrid_of_plastic():
    """CODE V's sample 65988: 15 mm, its own thickness the focus of its reference wavelength, F and C as one."""
    lens = load_lens(FOLDER / "hybrid.seq")
    phase = lens.surfaces[0].diffraction
    assert (phase.order, phase.normalisation_mm) == (1.0, 1.0)
    assert phase.coefficients == (pytest.approx(-0.001807322521767816 * 2 * np.pi / 587.5618e-6, rel=1e-14),)
    assert "diffracts in order 1: normalisation radius 1 mm" in read_file(FOLDER / "hybrid.seq").report.text
    back = {nm: float(cardinal_points(lens, nm / 1e3).back_focal_distance) for nm in lens.wavelengths_nm}
    assert back[587.5618] == pytest.approx(lens.sensor_mm, abs=1e-4)
    assert back[486.1327] == pytest.approx(back[656.2725], abs=1e-3)
    plain = replace(lens, surfaces=(replace(lens.surfaces[0], diffraction=None), lens.surfaces[1]))
    away = [float(cardinal_points(plain, nm / 1e3).back_focal_distance) for nm in (486.1327, 656.2725)]
    assert away[1] - away[0] > 0.2, "without its phase it is a singlet"


def test_an_odd_polynomial_by_names_and_by_numbers_in_any_unit():
    named = "SPS ODD 0.0; SCO K -1.0; SCO AR2 1e-4; SCO AR3 2e-5"
    numbered = "SPS ODD 1.0; SCO C1 -1.0; SCO C3 1e-4; SCO C4 2e-5"
    for change in (named, numbered):
        surface = read(DOUBLET, ("  PIM", f"  {change}")).lens.surfaces[2]
        assert surface.shape == RadialPolynomial((0.0, 1e-4, 2e-5)) and surface.conic == -1.0
    normalised = read(DOUBLET, ("  PIM", "  SPS ODD 5.0; SCO AR3 2e-5"), ("DIM   M", "DIM   C")).lens.surfaces[2]
    assert normalised.shape == RadialPolynomial((0.0, 0.0, 2e-4), 50.0)


def test_a_phase_in_centimetres_is_that_in_millimetres():
    """C₂ in cm⁻³ adds C₂r⁴ cm of path."""
    change = ("  PIM", "  DIF DOE; HOR 2; HWL 500; HCT R; HCO C2 3e-3"), ("DIM   M", "DIM   C")
    phase = read(DOUBLET, *change).lens.surfaces[2].diffraction
    assert phase.phase_and_slope(100.0)[0] == pytest.approx(2 * 2 * np.pi / 500e-6 * 3e-2, rel=1e-14)


REFUSED = {
    "a tilt about another point": (
        ("  PIM", "  YOD 3.0"),
        "surface 3 is tilted or decentred otherwise than by",
    ),
    "a tilt in other axes": (("  PIM", "  GLB"), "surface 3 is tilted or decentred otherwise than by"),
    "a tilt edge on": (("  PIM", "  ADE 90.0"), "surface 3: a tilt of -90° about x"),
    "a grating without a spacing": (("  PIM", "  DIF GRT"), "surface 3 is a grating without a spacing"),
    "a hologram": (("  PIM", "  DIF DOE; HX1 3.0"), "surface 3 diffracts"),
    "a phase in x and y": (("  PIM", "  DIF DOE; HCT XY"), "surface 3 diffracts by HCT XY"),
    "a phase of no wavelength": (("  PIM", "  DIF DOE; HCO C1 1e-3"), "surface 3 diffracts without a wavelength"),
    "a special surface": (("  PIM", "  SPS SCN"), "surface 3 is a special surface of type SCN"),
    "a term of no special surface": (("  PIM", "  SCO AR3 1e-3"), "surface 3: coefficient AR3 of a special surface"),
    "a term too high": (("  PIM", "  SPS ODD; SCO C32 1"), "surface 3: coefficient C32"),
    "a term of a polynomial too high": (("  PIM", "  SPS XYP; SCO C67 1"), "surface 3: coefficient C67"),
    "a radius in x of no toroid": (("  PIM", "  RDX 40"), "surface 3 has a radius or a conic constant in x"),
    "an unknown glass": (("NBK7_SCHOTT", "NNIX7_SCHOTT"), 'glass "NNIX7" of SCHOTT is in no catalogue'),
    "a number that is no glass": (("NBK7_SCHOTT", "1.5168"), "neither a name nor a six-digit code"),
    "a word for a number": (("62.5", "sixty"), 'radius "SIXTY|radius "sixty" is not a number'),
    "an unknown unit": (("DIM   M", "DIM   X"), "lens unit"),
    "an infinite gap": ((" 6.0 ", " 1e12 "), "surface 1 has an infinite thickness"),
    "no surface": (("S  ", "!  "), "no surface"),
    "a surface that is not there": (("GO", "THI S9 1.0"), "refers to surface 9"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused_says_where_and_why(case):
    refused_at(DOUBLET, *REFUSED[case])


def test_a_private_glass_without_one_index_per_wavelength_is_refused():
    with pytest.raises(LensFileError, match="private glass PLA has not one index per wavelength"):
        read(PRIVATE, ("1.48 1.49 1.50&", "1.48 1.49&"))


def test_a_solve_for_a_curvature_leaves_the_stored_one():
    plain, solved = read(DOUBLET).lens, read(DOUBLET, ("SI ", "CUY UMY -0.1\nSI ")).lens
    assert solved == plain


def test_an_image_that_is_too_curved_is_refused_by_its_line():
    with pytest.raises(LensFileError) as caught:
        read(DOUBLET, ("SI    0.0", "SI    1e-320"))
    assert caught.value.line


def test_a_bare_name_that_several_makers_sell_is_decided_and_said():
    """F2 of Schott, Hoya and Hikari is CDGM's F4; CDGM's own F2 has nd 1.61293 and vd 36.96."""
    found = read(DOUBLET, ("NSF5_SCHOTT", "F2"))
    assert found.lens.surfaces[1].medium.label == "SCHOTT F2"
    (note,) = (note for note in found.report.of("caution") if note.surface == 2)
    said = note.message.values
    assert said["other"] == "CDGM F2" and said["d_line"] == pytest.approx(1.61293 - 1.62004, abs=1e-5)
    named = read(DOUBLET, ("NSF5_SCHOTT", "F2_CDGM"))
    assert named.lens.surfaces[1].medium.label == "CDGM F2" and not named.report.of("caution")
