"""Zemax files: what is read, in every encoding and unit, and what is refused by surface number and name."""

import zipfile
from math import inf

import numpy as np
import pytest

from p2sf.colour.colorimetry import bands, matching
from p2sf.colour.spectrum import spectrum_of
from p2sf.errors import LensFileError
from p2sf.lens.lens import with_sensor
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial
from p2sf.lensfile.library import load_lens
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import (
    field_from_image_height,
    field_from_object_height,
    paraxial_rays,
    pupils,
    stop_rim,
    working_f_number,
)
from tests.support.lenses.lens_files import FOLDER, read, read_file, refused_at, text_of

DOUBLET = "doublet.zmx"
ENCODINGS = ("utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-16-le", "utf-16-be")


def efl(lens):
    return float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length)


def test_the_prescription_is_read_as_it_stands():
    lens = load_lens(FOLDER / DOUBLET)
    assert lens.title == "Ø 25 mm cemented doublet, written for these tests"
    assert [s.radius for s in lens.surfaces] == [1 / 0.016, -1 / 0.022, -1 / 0.0078]
    assert [s.thickness for s in lens.surfaces] == [6.0, 2.5, 96.0]
    assert [s.medium.label for s in lens.surfaces] == ["SCHOTT N-BK7", "SCHOTT N-SF5", "1.0"]
    assert lens.surfaces[2].conic == -0.5 and lens.surfaces[2].aspheric == (1e-7, -2e-10)
    assert (lens.stop_surface, lens.aperture.kind, lens.aperture.value) == (1, "entrance_pupil_diameter", 20.0)
    assert lens.fields_deg == (0.0, 1.0) and lens.wavelengths_nm == (486.1327, 587.5618, 656.2725)


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_every_encoding_gives_the_same_lens(encoding, newline, tmp_path):
    path = tmp_path / DOUBLET
    path.write_bytes(text_of(DOUBLET).replace("\n", newline).encode(encoding))
    assert load_lens(path) == load_lens(FOLDER / DOUBLET)


def test_big_endian_with_a_byte_order_mark(tmp_path):
    (tmp_path / DOUBLET).write_bytes(b"\xfe\xff" + text_of(DOUBLET).encode("utf-16-be"))
    assert load_lens(tmp_path / DOUBLET) == load_lens(FOLDER / DOUBLET)


def test_a_lens_in_a_zip_archive(tmp_path):
    with zipfile.ZipFile(tmp_path / "lens.zip", "w") as archive:
        archive.writestr("readme.txt", "nothing")
        archive.writestr("folder/doublet.zmx", text_of(DOUBLET).encode("utf-16"))
    assert load_lens(tmp_path / "lens.zip") == load_lens(FOLDER / DOUBLET)


def test_the_content_tells_the_format_whatever_the_ending(tmp_path):
    (tmp_path / "doublet.txt").write_text(text_of(DOUBLET), encoding="utf-8")
    assert load_lens(tmp_path / "doublet.txt") == load_lens(FOLDER / DOUBLET)


@pytest.mark.parametrize(("unit", "mm"), [("CM", 10.0), ("IN", 25.4), ("INCH", 25.4), ("M", 1000.0), ("METER", 1000.0)])
def test_units_scale_every_length(unit, mm):
    """A lens of k times every length has k times the focal length, and each A_p by k^(1−p)."""
    small, large = read(DOUBLET).lens, read(DOUBLET, ("UNIT MM", f"UNIT {unit}")).lens
    assert efl(large) == pytest.approx(mm * efl(small), rel=1e-12)  # rounding of ten operations
    assert large.aperture.value == 20 * mm and large.surfaces[0].semi_diameter == 12.5 * mm
    assert large.surfaces[2].aspheric == pytest.approx((1e-7 * mm**-3, -2e-10 * mm**-5), rel=1e-12)


def test_missing_type_and_catalogue_lines_do_no_harm():
    plain = read(DOUBLET, ("  TYPE STANDARD\n", ""), ("GCAT SCHOTT\n", "")).lens
    assert plain.surfaces == read(DOUBLET).lens.surfaces


def test_filler_wavelengths_and_fields_are_left_out():
    assert len(read(DOUBLET).lens.wavelengths_nm) == 3 and len(read(DOUBLET).lens.fields_deg) == 2


def test_stated_f_number_is_kept():
    lens = read(DOUBLET, ("ENPD 2.0E+1", "FNUM 5.0 0")).lens
    assert (lens.aperture.kind, lens.aperture.value) == ("f_number", 5.0)


def test_floating_stop_opens_to_its_semi_diameter():
    lens = read(DOUBLET, ("ENPD 2.0E+1", "FLOA")).lens
    assert (lens.aperture.kind, lens.aperture.value) == ("stop_semi_diameter", 12.5)


def test_object_side_aperture_fills_the_cone_it_states():
    """The marginal ray of OBNA leaves the axial object point at asin(NA)."""
    found = read(DOUBLET, ("ENPD 2.0E+1", "OBNA 0.05 0"), ("DISZ INFINITY", "DISZ 150.0"))
    rays = paraxial_rays(found.lens, 150.0, found.lens.reference_wavelength_um)
    assert float(rays.nu[0]) == pytest.approx(np.tan(np.arcsin(0.05)), rel=1e-12)
    assert "150 mm" in found.report.text and found.lens.object_distance == 150.0


def test_primary_wavelength_beside_the_middle_one_is_respected():
    """f-number 5 at 656 nm means a rim that gives 5 there, not at the middle wavelength."""
    lens = read(DOUBLET, ("ENPD 2.0E+1", "FNUM 5.0 0"), ("PWAV 2", "PWAV 3")).lens
    assert lens.reference_wavelength_nm == lens.reference_nm == 656.2725
    assert read(DOUBLET).lens.reference_nm is None
    red = float(cardinal_points(lens, 0.6562725).effective_focal_length)
    assert red / float(pupils(lens, 0.6562725).entrance_diameter) == pytest.approx(5.0, rel=1e-12)


def test_the_aperture_may_be_the_half_angle_of_the_cone():
    """6°, not a numerical aperture of 6: the stop on the first surface, 60 mm away, has a radius of 60·tan 6°."""
    lens = read("microscope_cone.zmx").lens
    assert stop_rim(lens) == pytest.approx(60 * np.tan(np.deg2rad(6)), rel=1e-12)
    refused_at("microscope_cone.zmx", ("OBNA 6 1", "OBNA 95 1"), "95")


def test_primary_wavelength_weights_and_aim_are_the_files():
    lens = read("microscope_cone.zmx").lens
    assert (lens.reference_nm, lens.wavelength_weights, lens.aim) == (656.2725, (1.0, 3.0, 0.5), "paraxial")
    light = spectrum_of(lens.spectrum)
    assert light.weights == (1.0, 3.0, 0.5) and spectrum_of(light.name) == light
    waves, shares = bands(light, 1)
    plain = matching(waves)[:, 1] * (1.0, 3.0, 0.5)
    assert shares[:, 1] == pytest.approx(plain / plain.sum(), rel=1e-12)
    aims = {mode: read("microscope_cone.zmx", ("RAIM 0 0", f"RAIM 0 {mode}")) for mode in (1, 2)}
    assert {mode: each.lens.aim for mode, each in aims.items()} == {1: "stop", 2: "stop"}
    assert [len(each.report.of("caution")) for each in aims.values()] == [1, 0]


def test_a_wavelength_that_is_stated_twice_counts_twice():
    lens = read("microscope_cone.zmx", ("WAVM 1 0.4861327 1", "WAVM 1 0.5875618 1")).lens
    assert (lens.wavelengths_nm, lens.wavelength_weights) == ((587.5618, 656.2725), (4.0, 0.5))


STOP_BEHIND = (("  STOP\n", ""), ("SURF 3\n", "SURF 3\n  STOP\n"))


def test_a_pupil_diameter_at_another_primary_wavelength_is_respected():
    lens = read(DOUBLET, ("PWAV 2", "PWAV 3"), *STOP_BEHIND).lens
    assert (lens.aperture.kind, lens.aperture.value) == ("entrance_pupil_diameter", 20.0)
    assert float(pupils(lens, 0.6562725).entrance_diameter) == pytest.approx(20.0, rel=1e-12)


def test_a_working_f_number_is_that_of_the_finite_object():
    lens = read(DOUBLET, ("ENPD 2.0E+1", "FNUM 5.0 1"), ("DISZ INFINITY", "DISZ 150.0")).lens
    assert float(working_f_number(lens, 150.0, lens.reference_wavelength_um)) == pytest.approx(5.0, rel=1e-12)


def test_paraxial_image_heights_become_angles():
    lens = read(DOUBLET, ("FTYP 0", "FTYP 2")).lens
    focus = float(cardinal_points(lens, lens.reference_wavelength_um).back_focal_distance)
    slope = field_from_image_height(with_sensor(lens, focus), lens.reference_wavelength_um, 1.0)
    assert np.tan(np.deg2rad(lens.fields_deg[1])) == pytest.approx(float(slope), rel=1e-10)


def test_object_heights_become_angles():
    lens = read(DOUBLET, ("FTYP 0", "FTYP 1"), ("DISZ INFINITY", "DISZ 150.0"), *STOP_BEHIND).lens
    slope = field_from_object_height(lens, 150.0, lens.reference_wavelength_um, 1.0)
    assert np.tan(np.deg2rad(lens.fields_deg[1])) == pytest.approx(-float(slope), rel=1e-10)  # above the axis


def test_fields_in_x_and_y_lie_at_their_distance_from_the_axis():
    lens = read(DOUBLET, ("XFLN 0 0", "XFLN 0 1.0")).lens
    wide = np.tan(np.deg2rad(lens.widest_field_deg))
    assert wide == pytest.approx(np.sqrt(2) * np.tan(np.deg2rad(1.0)), rel=1e-10)


def test_a_square_term_on_a_plane_is_the_paraboloid_it_is():
    lens = read(DOUBLET, ("CURV -0.0078 0", "CURV 0.0 0"), ("PARM 1 0", "PARM 1 -0.0039")).lens
    assert lens.surfaces[2].radius == -1 / 0.0078 and lens.surfaces[2].conic == -1.0


def test_glass_forms():
    lens = read(DOUBLET, ("GLAS N-BK7 0 0 1.5 4.0E+1", "GLAS ___BLANK 1 0 1.5168 64.17"), ("N-SF5", "673322")).lens
    assert (lens.surfaces[0].medium.nd, lens.surfaces[0].medium.vd) == (1.5168, 64.17)
    assert lens.surfaces[1].medium.label == "nd 1.673 vd 32.2"
    constant = read(DOUBLET, ("GLAS N-BK7 0 0 1.5 4.0E+1", "GLAS ___BLANK 1 0 1.5168 0")).lens
    assert constant.surfaces[0].medium.value == 1.5168


def test_object_and_image_media():
    lens = read(DOUBLET, ("  DISZ INFINITY", "  DISZ INFINITY\n  GLAS ___BLANK 1 0 1.33 0")).lens
    assert lens.object_medium.value == 1.33
    wet = read(DOUBLET, ("  DISZ 96.0", "  DISZ 96.0\n  GLAS ___BLANK 1 0 1.34 0")).lens
    assert wet.surfaces[-1].medium.value == 1.34


def test_dummy_surfaces_and_empty_coordinate_breaks_are_kept():
    dummy = "SURF 3\n  TYPE COORDBRK\n  CURV 0\n  PARM 3 0\n  DISZ 1.5\nSURF 4\n  TYPE EVENASPH"
    lens = read(DOUBLET, ("SURF 4", "SURF 5"), ("SURF 3\n  TYPE EVENASPH", dummy)).lens
    assert len(lens.surfaces) == 4 and lens.surfaces[2].radius == inf and lens.surfaces[2].thickness == 1.5


def test_a_mirror_keeps_the_medium_that_it_stands_in():
    lens = read(DOUBLET, ("GLAS N-SF5", "GLAS MIRROR")).lens
    assert lens.surfaces[1].reflects and lens.media[2] == lens.media[1] and lens.directions == (1, 1, -1, -1)


def test_configurations_that_differ_in_nothing_are_one_lens():
    assert read(DOUBLET, ("MNUM 1 1", "MNUM 3 1")).lens == read(DOUBLET).lens


def test_a_square_term_beside_a_radius_is_kept():
    surface = read(DOUBLET, ("PARM 1 0", "PARM 1 1e-3")).lens.surfaces[2]
    assert surface.shape == RadialPolynomial((0.0, 1e-3)) and surface.aspheric == (1e-7, -2e-10)


def extra(*numbers: float) -> str:
    return "".join(f'  XDAT {place} {x:.12E} 0 0 1.0 0.0 0 ""\n' for place, x in enumerate(numbers, 1))


@pytest.mark.parametrize(("unit", "mm"), [("MM", 1.0), ("IN", 25.4)])
def test_odd_and_extended_aspheres_and_phases(unit, mm):
    """Parameters as OpticStudio's manual has them: XDAT 1 is the number of terms, 2 the normalisation radius."""

    def surface(kind: str, data: str = ""):
        return read(
            DOUBLET, ("  TYPE EVENASPH\n", f"  TYPE {kind}\n{data}"), ("UNIT MM", f"UNIT {unit}")
        ).lens.surfaces[2]

    odd = surface("ODDASPHE")  # its parameters 2 and 3 are now those of r² and r³
    assert odd.shape.coefficients == pytest.approx((0.0, 1e-7 / mm, -2e-10 / mm**2), rel=1e-14) and not odd.aspheric
    even = surface("XASPHERE", extra(2, 4.0, 0.01, -0.02))
    assert even.shape == RadialPolynomial((0.0, 0.01 * mm, 0.0, -0.02 * mm), 4.0 * mm)
    assert surface("XASPHERE", extra(3, 1.0, 0.0, 0.01, -0.02)).aspheric == pytest.approx((0.01 / mm**3, -0.02 / mm**5))
    assert surface("XOSPHERE", extra(3, 4.0, 0.01, -0.02, 0.03)).shape.coefficients == (
        0.01 * mm,
        -0.02 * mm,
        0.03 * mm,
    )
    phase = surface("BINARY_2", "  PARM 0 2\n" + extra(2, 5.0, -300.0, 20.0, 99.0))
    assert phase.diffraction == Diffraction((-300.0, 20.0), 5.0 * mm, 2.0)
    assert phase.aspheric == pytest.approx((1e-7 / mm**3, -2e-10 / mm**5), rel=1e-14)
    assert surface("BINARY_2", "  PARM 0 0\n" + extra(1, 5.0, -300.0)).diffraction is None, "order 0"
    for number, kind in enumerate((Qbfs, Qcon)):
        forbes = surface("QED_TYPE", extra(number, 2, 4.0, 0.01, -0.02))
        assert forbes.shape == kind((0.01 * mm, -0.02 * mm), 4.0 * mm) and forbes.conic == -0.5


REFUSED = {
    "an irregular surface": (("TYPE EVENASPH", "TYPE IRREGULA"), "surface 3 has type IRREGULA"),
    "a gradient": (("TYPE EVENASPH", "TYPE GRINSUR1"), "surface 3 has type GRINSUR1"),
    "a black box": (("TYPE EVENASPH", "TYPE BLACKBOX"), "surface 3 has type BLACKBOX, a black box"),
    "an unknown type": (("TYPE EVENASPH", "TYPE US_MINE"), "surface 3 has type US_MINE"),
    "a tilt of its own": (
        ("  MAZH 0 0", "  SCBD 1 0 0 0.0 0.0 9.0E+1 0.0 0.0"),
        "surface 3 is tilted or decentred by its",
    ),
    "non-sequential": (("MODE SEQ", "MODE NSC"), "mode NSC is not sequential"),
    "a power too high": (("PARM 1 0", "PARM 21 1e-3"), r"surface 3: aspheric term r\^42; powers from 1 to 40"),
    "Forbes's polynomials": (("TYPE EVENASPH", "TYPE QED_TYPE\n  XDAT 1 2"), "surface 3 has Forbes's .* of type 2"),
    "half a term": (("TYPE EVENASPH", "TYPE XASPHERE\n  XDAT 1 1.5"), "surface 3 has 1.5 terms"),
    "no radius": (
        ("TYPE EVENASPH", "TYPE BINARY_2\n  XDAT 1 1\n  XDAT 2 0"),
        "a normalisation radius of 0 in its extra",
    ),
    "an unknown unit": (("UNIT MM", "UNIT FURLONG"), "lens unit"),
    "an unknown glass": (
        ("N-BK7", "N-NOTHING7"),
        r'surface 1 \(FRONT\): glass "N-NOTHING7" of SCHOTT is in no catalogue',
    ),
    "an index of 0.1": (("GLAS N-BK7 0 0 1.5 4.0E+1", "GLAS ___BLANK 1 0 0.1 0"), "surface 1"),
    "a word for a number": (("DISZ 2.5", "DISZ thick"), 'thickness "thick" is not a number'),
    "an infinite gap": (("DISZ 2.5", "DISZ INFINITY"), "surface 2 has an infinite thickness"),
    "a stop on the image": (("  DISZ 0\n", "  DISZ 0\n  STOP\n"), "the stop is on the object or the image"),
    "a primary wavelength no glass has": (("5.875618E-1", "40.0"), "outside the data"),
    "a surface left out": (("SURF 2", "SURF 7"), "surface 2 is missing before surface 7"),
    "an aperture of no object": (("ENPD 2.0E+1", "OBNA 0.1 0"), "an object at infinity has no numerical aperture"),
    "a field of 90°": (("YFLN 0 1.0", "YFLN 0 90"), "field angle 90° is not below 90°"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused_says_where_and_why(case):
    refused_at(DOUBLET, *REFUSED[case])


def test_a_refusal_carries_its_line_and_its_values_as_data():
    with pytest.raises(LensFileError) as caught:
        read(DOUBLET, ("TYPE EVENASPH", "TYPE BINARY_1"))
    place = caught.value.message.values
    said = place["message"]
    assert (place["path"], place["line"]) == (DOUBLET, caught.value.line)
    assert said.template.startswith("{surface} has type {kind}, {description}")
    assert (said.values["surface"].values, said.values["kind"]) == ({"surface": 3}, "BINARY_1")


def test_an_error_of_the_lens_stands_on_the_line_of_its_surface():
    with pytest.raises(LensFileError, match=r"surface 3: aspheric term r\^42") as caught:
        read(DOUBLET, ("PARM 1 0", "PARM 21 1e-3"))
    assert text_of(DOUBLET).splitlines()[caught.value.line - 1] == "SURF 3"


def test_numbers_beside_a_name_are_leftovers():
    """The triplet's file says 1.5168 beside SK16 and N-F2; a trace by hand with 1.62041 and 1.62004 gives the focus."""
    lens = read("cooke_old_glasses.zmx", accept=True).lens
    y, u, index = 1.0, 0.0, 1.0
    for surface, behind in zip(lens.surfaces, (1.62041, 1.0, 1.62005, 1.0, 1.62041, 1.0), strict=True):
        u = (index * u - y * (behind - index) / surface.radius) / behind
        y, index = y + surface.thickness * u, behind
    assert efl(lens) == pytest.approx(-1 / u, rel=1e-4) and -1 / u == pytest.approx(50.02, abs=0.01)
    unknown = ("GLAS N-BK7 0 0 1.5 4.0E+1", "GLAS NOBODY-7 0 0 1.62 36.4")
    with pytest.raises(LensFileError, match="NOBODY-7"):
        read(DOUBLET, unknown)


def test_a_substitute_is_offered_and_only_taken_with_consent():
    change = ("N-BK7", "S-BK7")  # which nobody sells
    with pytest.raises(LensFileError, match="accept a substitute") as caught:
        read(DOUBLET, change)
    offers = caught.value.message.values["message"].values["error"].message.values["offers"]
    assert {offer.values["glass"]: offer.values["nd"] for offer in offers}["SCHOTT N-BK7"] == pytest.approx(1.5168)
    found = read(DOUBLET, change, accept=True)
    assert found.lens.surfaces[0].medium.label == "SCHOTT N-BK7"
    (note,) = found.report.of("substituted")
    assert note.surface == 1 and note.line == 26 and note.message.values["substitute"].values["nd"] > 1.5


def test_a_wavelength_without_data_is_left_out_and_said():
    found = read(DOUBLET, ("4.861327E-1", "40.0"))
    assert found.lens.wavelengths_nm == (587.5618, 656.2725)
    left_out = found.report.of("caution")[0].message.values
    assert (left_out["wavelength"], left_out["glass"]) == (pytest.approx(40000), "SCHOTT N-BK7")


def test_the_report_lists_what_was_read_and_left_out():
    report = read_file(FOLDER / DOUBLET).report
    assert (report.format, report.encoding) == ("Zemax", "utf-8")
    assert "3 surfaces, stop on surface 1" in report.text and "a solve puts" in report.text
