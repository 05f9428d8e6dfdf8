"""Rare statements in other programs' lens files: each is read, or noted in the report, or refused by an error."""

import zipfile
from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.shapes import Diffraction, Qbfs, RadialPolynomial
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.library import find_lens, load_lens
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import parse_toml
from p2sf.lensfile.writing import lens_to_zmx, write_lens
from p2sf.paraxial.first_order import magnification
from p2sf.paraxial.pupils import numerical_aperture, stop_rim
from tests.support.lenses.lens_files import read, refused_at

PHASE = Diffraction((-300.0, 20.0), 5.0)
ZEMAX, TABLE = "doublet.zmx", "singlet.csv"
GLAS = "GLAS N-BK7 0 0 1.5 4.0E+1 0 0 0 0 0 0"

TOLD = {
    "telecentric": (("FTYP 0 0 2 3", "FTYP 0 1 2 3"), "telecentric object space"),
    "a central hole": (("  DISZ 6.0\n", "  DISZ 6.0\n  CLAP 1.0 9.0\n"), "a hole or an obscuration"),
    "an obscuration": (("  MAZH 0 0\n", "  OBSC 0 3.0\n"), "a hole or an obscuration"),
    "a ring": (("  DISZ 6.0\n", "  DISZ 6.0\n  OBSC 2.0 3.0\n"), "its obscuration is left out"),
    "partial dispersion": ((GLAS, "GLAS ___BLANK 1 0 1.52 64.0 0.02"), "deviation in partial dispersion is left out"),
}
REFUSED = {
    "a numerical aperture of 2": (("ENPD 2.0E+1", "OBNA 2.0"), "no numerical aperture"),
    "a field of a right angle": (("YFLN 0 1.0", "YFLN 0 90.0"), "not below 90"),
    "a wavelength that is none": (("WAVM 1 4.861327E-1", "WAVM 1 4861"), "wavelength"),
}
TABLE_REFUSED = {
    "an unknown unit": (("# f_number: 8", "# f_number: 8\n# unit: furlong"), 'unit "furlong" is none of'),
    "X-rays": (("486.1327,", "4.9,"), "a wavelength is not that of light"),
    "two stops": (("air,10,,,", "air,10,,,x"), "both are the stop"),
}
ONE_INDEX = {
    "an index column": (("glass,semi", "index,semi"), ("SCHOTT N-BK7", "1.5"), (",air,", ",,")),
    "a number for a glass": (("SCHOTT N-BK7", "1.5"),),
    "nd without vd": (("glass,semi", "nd,semi"), ("SCHOTT N-BK7", "1.5"), (",air,", ",,")),
}


@pytest.mark.parametrize("what", TOLD)
def test_what_a_zemax_file_asks_for_and_does_not_get_is_told(what):
    change, words = TOLD[what]
    assert words in read(ZEMAX, change).report.text
    assert words not in read(ZEMAX).report.text


@pytest.mark.parametrize("what", REFUSED)
def test_what_no_lens_can_be_is_refused(what):
    change, words = REFUSED[what]
    with pytest.raises(LensFileError, match=words):
        read(ZEMAX, change)


def test_a_lens_whose_stop_makes_it_telecentric_is_read_as_it_is_asked_for():
    text = lens_to_zmx(find_lens("telecentric_relay")).replace("FTYP 0 0 ", "FTYP 0 1 ")
    report = import_text(LensText("relay.zmx", "utf-8", text), GlassSources()).report
    assert not any("telecentric" in note.message.template for note in report.notes)


def test_wavelengths_in_one_line_replace_those_before():
    assert read(ZEMAX, ("PWAV 2", "WAVL 0.5 0.6\nPWAV 2")).lens.wavelengths_nm == (500.0, 600.0)


@pytest.mark.parametrize(
    ("name", "change"),
    [
        (ZEMAX, ("  DISZ 6.0\n", "  DISZ 6.0\n  CLAP 1.5 9.0\n")),
        (ZEMAX, ("  MAZH 0 0\n", "  OBSC 0 1.5\n")),
        ("doublet.seq", ("  PIM", "  CIR OBS 1.5")),
        ("doublet.seq", ("  PIM", "  CIR HOL 1.5")),
    ],
)
def test_what_is_dark_in_the_middle_is_read_and_written_back(name, change, tmp_path):
    lens = read(name, change).lens
    (number,) = (n for n, surface in enumerate(lens.surfaces) if surface.inner_radius)
    assert lens.surfaces[number].inner_radius == 1.5
    write_lens(lens, tmp_path / "back.zmx")
    again = load_lens(tmp_path / "back.zmx").surfaces[number]
    assert (again.inner_radius, again.semi_diameter) == (1.5, lens.surfaces[number].semi_diameter)
    with pytest.raises(LensFileError, match="surface"):
        write_lens(lens, tmp_path / "back.json")


@pytest.mark.parametrize(
    ("name", "change"),
    [
        (ZEMAX, ("  DISZ 6.0\n", "  DISZ 6.0\n  OBSC 0 3.0\n  OBDC 1.0 -2.0\n")),
        ("doublet.seq", ("STO\n", "STO\nCIR OBS 3.0\nADX 1.0\nADY -2.0\n")),
    ],
)
@pytest.mark.parametrize("ending", [".zmx", ".seq"])
def test_an_obscuration_of_the_stop_is_a_part_of_the_mask_and_is_written_back(name, change, ending, tmp_path):
    """The entrance pupil has a radius of 10 mm and stands on the first surface, the stop."""
    lens = read(name, change).lens
    found = [getattr(lens.mask, name) for name in ("obscuration", "obscuration_x", "obscuration_y")]
    assert found == pytest.approx([0.3, 0.1, -0.2], rel=1e-14)
    assert not any(surface.inner_radius or surface.rim for surface in lens.surfaces)
    write_lens(lens, tmp_path / f"back{ending}")
    again = load_lens(tmp_path / f"back{ending}")
    assert again.mask == lens.mask and again.surfaces[0].semi_diameter == lens.surfaces[0].semi_diameter


def test_an_outer_rim_bounds_the_light_and_one_of_zero_does_not():
    outer, none = (read(ZEMAX, ("  DISZ 6.0\n", f"  DISZ 6.0\n  CLAP 0 {rim}\n")).lens for rim in (9.0, 0.0))
    surface = read(ZEMAX).lens.surfaces[0]
    assert outer.surfaces[0].semi_diameter in (9.0, surface.semi_diameter)
    assert none.surfaces[0].semi_diameter == surface.semi_diameter


def test_a_stop_size_stands_as_it_is():
    aperture = read(ZEMAX, ("ENPD 2.0E+1", "FLOA"), ("  STOP\n", "  STOP\n")).lens.aperture
    assert (aperture.kind, aperture.value) == ("stop_semi_diameter", 12.5)


def test_an_object_sided_aperture_is_kept_at_its_distance():
    finite = read(ZEMAX, ("DISZ INFINITY", "DISZ 300.0"), ("ENPD 2.0E+1", "OBNA 0.02")).lens
    # sin of the marginal ray in object space, where paraxial rays are taken for tangents: NA·|m| is the image's.
    m = abs(float(magnification(finite, 300.0, finite.reference_wavelength_um)))
    na = float(numerical_aperture(finite, 300.0, finite.reference_wavelength_um))
    assert na * m == pytest.approx(np.tan(np.arcsin(0.02)), rel=1e-10)


@pytest.mark.parametrize("what", TABLE_REFUSED)
def test_a_table_with_a_wrong_key_is_refused(what):
    change, words = TABLE_REFUSED[what]
    with pytest.raises(LensFileError, match=words):
        read(TABLE, change)


@pytest.mark.parametrize("what", ONE_INDEX)
def test_a_table_may_give_one_index_in_any_column(what):
    lens = read(TABLE, *ONE_INDEX[what]).lens
    assert [float(medium.index(0.55)) for medium in lens.media] == [1.0, 1.5, 1.0]


def test_a_table_in_inches_is_in_millimetres_afterwards():
    lens = read(TABLE, ("# f_number: 8", "# f_number: 8\n# unit: in"), ("radius (mm)", "radius")).lens
    assert lens.surfaces[0].radius == pytest.approx(50 * 25.4, rel=1e-15)


@pytest.mark.parametrize(
    ("ending", "change", "words"),
    [
        ("json", {"object_medium": ConstantIndex(1.33)}, "which an ISET file cannot express; save as TOML"),
        ("zmx", {"aspheric": (1e-6,), "shape": Qbfs((1e-3,), 5.0)}, "beside its shape .* save as TOML"),
        ("zmx", {"shape": RadialPolynomial((1e-3,)), "diffraction": PHASE}, "surface 1 diffracts and .* save as TOML"),
        ("json", {"shape": RadialPolynomial((1e-3,))}, "which a file for ISET cannot express; save as TOML"),
        ("json", {"conic": 0.0, "shape": Qbfs((1e-3,), 5.0)}, "surface 1: .* cannot express its shape; save as TOML"),
        ("json", {"diffraction": PHASE}, "surface 1: .* cannot express its diffraction; save as TOML"),
    ],
)
def test_what_a_format_cannot_say_is_refused_and_not_left_out(tmp_path, ending, change, words):
    lens = find_lens("asphere")
    if "object_medium" not in change:
        lens = replace(lens, surfaces=(replace(lens.surfaces[0], **change), *lens.surfaces[1:]))
    else:
        lens = replace(lens, **change)
    with pytest.raises(LensFileError, match=words):
        write_lens(lens, tmp_path / f"lens.{ending}")
    assert not list(tmp_path.iterdir())


def test_a_lens_in_water_goes_through_zemax_and_back(tmp_path):
    lens = replace(find_lens("asphere"), object_medium=ConstantIndex(1.33))
    write_lens(lens, tmp_path / "wet.zmx")
    again = load_lens(tmp_path / "wet.zmx")
    assert float(again.object_medium.index(0.55)) == pytest.approx(1.33, abs=1e-9)


FORMULA = '{name = "X1", agf_formula = 1, coefficients = [2.25], range_um = [0.4, 0.7]}'
LENS = "[aperture]\nf_number = 8\n\n[[surface]]\nradius = 50.0\nthickness = 90.0\nglass = "


def test_a_glass_by_its_formula_stands_alone():
    lens = parse_toml(LENS + FORMULA)
    assert float(lens.surfaces[0].medium.index(0.55)) == pytest.approx(1.5, abs=1e-15)
    assert lens.surfaces[0].medium.range_um == (0.4, 0.7)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("agf_formula = 1", "agf_formula = 99", "agf_formula is 99; write a number from 1 to 13"),
        ("agf_formula = 1", "agf_formula = []", r"agf_formula is \[\]; write a number from 1 to 13"),
        ("agf_formula = 1", "agf_formula = true", "agf_formula is True; write a number from 1 to 13"),
        ("[2.25]", '["a"]', "coefficients of X1 are not up to"),
        ("[0.4, 0.7]", "[0.7, 0.4]", "write the shortest and the longest wavelength"),
        ('name = "X1", ', "", "glass has the keys"),
        *(
            ("range_um", f"internal_transmittance = {records}, range_um", "write a list of .wavelength in µm, share")
            for records in ("[[0.5, 0.9]]", "[[0.5, 0.9, 25, 1]]", "[0.5, 0.9, 25]", '[[0.5, 0.9, "25"]]', "0.9")
        ),
    ],
)
def test_a_broken_formula_is_refused(old, new, words):
    with pytest.raises(LensFileError, match=words):
        parse_toml(LENS + FORMULA.replace(old, new))


@pytest.mark.parametrize("factors", ["0 0", "0 0.1"])
def test_vignetting_factors_are_told_apart_from_zeros(factors):
    """Those that are none are ignored; others are compared with the rims of the file."""
    notes = read(ZEMAX, ("PWAV 2", f"PWAV 2\nVCYN {factors}")).report.notes
    assert any(note.message.template == "vignetting factors, all of them 0" for note in notes) == (factors == "0 0")
    assert any("missed" in note.message.values for note in notes) == (factors != "0 0")


def test_a_rim_that_is_not_round_and_a_word_nobody_knows_are_told():
    report = read(ZEMAX, ("  DISZ 6.0\n", "  DISZ 6.0\n  ELAP 9 8\n" + "  XYZZY 1\n" * 341)).report
    (unknown,) = report.of("unknown")  # once, not 341 times
    assert unknown.message.values == {"name": "XYZZY", "count": 341} and unknown.line
    assert report.of("caution")[0].message.values == {"keyword": "ELAP"}
    assert not any("XYZZY" in str(note.sentence) for note in report.of("ignored"))


def test_an_archive_without_a_lens_and_a_folder_are_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "none.zip", "w") as archive:
        archive.writestr("readme.md", "nothing")
    with pytest.raises(LensFileError, match=r"the archive contains no \.zmx or \.seq file"):
        load_lens(tmp_path / "none.zip")
    (tmp_path / "lens.zmx").mkdir()
    with pytest.raises(LensFileError, match="this is a folder"):
        load_lens(tmp_path / "lens.zmx")


def test_a_gaussian_pupil_is_the_mask_of_the_lens(tmp_path):
    """Zemax: amplitude exp(−2.25ρ²). CODE V: intensity 0.6 at half the radius, or amplitude 0.6^(1/2)."""
    zemax, codev = read("gaussian_pupil.zmx").lens, read("gaussian.seq").lens
    edge = np.array([0.0]), np.array([1.0])
    assert zemax.mask.amplitude(*edge) == pytest.approx(np.exp(-2.25), rel=1e-12)
    assert codev.mask.amplitude(np.array([0.5]), np.array([0.0])) == pytest.approx(0.6**0.5, rel=1e-12)
    for ending, lens in (("zmx", zemax), ("seq", codev), ("seq", zemax), ("toml", codev)):
        write_lens(lens, tmp_path / f"out.{ending}")
        assert load_lens(tmp_path / f"out.{ending}").mask.apodisation == pytest.approx(lens.mask.apodisation, rel=1e-12)
    plain = read("gaussian.seq", ("PUI 0.6", "PUI 1.0")).lens
    assert plain.mask.clear
    refused_at("gaussian.seq", ("PUY 0.5", "PUY 0.7"), "0.7")


def test_the_plane_at_the_object_is_left_out():
    """The object stands 80 mm before the glass, of whose rim 80·tan(asin 0.05) is filled."""
    lens = read("gaussian_pupil.zmx").lens
    assert (len(lens.surfaces), lens.stop_surface) == (2, 1) and lens.object_distance == 80
    assert float(stop_rim(lens)) == pytest.approx(80 * np.tan(np.arcsin(0.05)), rel=1e-12)


def test_a_private_glass_that_no_surface_has_need_not_be_whole():
    assert read("gaussian.seq").lens.surfaces[0].medium.label == "USED"
    refused_at("gaussian.seq", ("4.0 'USED'", "4.0 'UNUSED'"), "UNUSED")


def test_an_obscuration_that_is_left_out_is_no_trifle():
    cautions = read("gaussian.seq").report.of("caution")
    assert [note.message.values["name"] for note in cautions] == ["REX", "REY"]


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [("gaussian_pupil.zmx", "ENVD 20 1 1", "ENVD 20 0 1"), ("gaussian_pupil.zmx", "ENVD 20 1 1", "ENVD -40 1 1")],
)
def test_glasses_in_other_air_are_refused_unless_nothing_follows_it(name, old, new):
    refused_at(name, (old, new), "atm")
    assert read(name, (old, f"{new[:-1]}0")).lens == read(name).lens
    assert len(read(name, (old, "ENVD 22 1 1")).report.of("caution")) == 1


def test_an_empty_conic_constant_is_none():
    lens = read("triplet.json", ('"radius"', '"conic_constant": [], "radius"')).lens  # keys of later ones win
    assert lens == read("triplet.json").lens
