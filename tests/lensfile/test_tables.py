"""Optical Bench texts and plain tables with named columns."""

from math import inf

import pytest

from p2sf.errors import LensFileError
from p2sf.lens.shapes import RadialPolynomial
from p2sf.lensfile.library import load_lens
from tests.support.lenses.lens_files import FOLDER, read, refused_at, text_of

BENCH, TABLE = "bench.txt", "singlet.csv"


def test_the_bench_is_read_and_shown_at_its_first_position():
    found = read(BENCH)
    lens = found.lens
    assert lens.title == "Zoom-like test lens" and len(lens.surfaces) == 9
    assert lens.surfaces[0].radius == 30.0 and lens.surfaces[0].semi_diameter == 10.0
    assert lens.surfaces[3].thickness == 5.0 and lens.sensor_mm == 41.0
    assert (lens.stop_surface, lens.aperture.kind, lens.aperture.value) == (5, "f_number", 4.0)
    assert lens.fields_deg == pytest.approx((0.0, 14.0, 20.0), rel=1e-10)
    assert "focus positions ∞, 1 m" in found.report.text


def test_bench_glasses_by_name_where_exact_else_by_their_own_nd_and_vd():
    lens = read(BENCH).lens
    assert lens.surfaces[0].medium.label == "SCHOTT N-SK16"
    assert (lens.surfaces[2].medium.nd, lens.surfaces[2].medium.vd) == (1.62004, 36.4)
    assert "GLASS-OF-NOBODY" in read(BENCH).report.text
    assert [s.medium.label for s in lens.surfaces[7:]] == ["nd 1.5168 vd 64.2", "1.0"]


def test_the_numbers_of_a_bench_row_win_over_another_glass_of_its_name():
    """J-BK7A has 1.51680, which is not what the row says; J-SF11 is 1.78472 and 25.64, which round to the row's."""
    found = read("bench_other_melts.txt")
    first, second, _ = found.lens.surfaces
    assert (first.medium.nd, first.medium.vd) == (1.51612, 64.1)
    assert second.medium.label == "HIKARI J-SF11"
    (note,) = found.report.of("caution")
    assert (note.surface, note.message.values["name"]) == (1, "J-BK7A")
    assert note.message.values["own"] == pytest.approx(1.5168, abs=1e-5)


def test_bench_aspheres_start_at_a4_or_at_a2_where_it_says_so():
    surface = read(BENCH).lens.surfaces[5]
    assert surface.conic == 0.2 and surface.aspheric == (1e-6, -3e-9)
    square = read(BENCH, ("[constants]\n", "[constants]\nAsphericalA2\t1\n")).lens.surfaces[5]
    assert square.shape == RadialPolynomial((0.0, 1e-6)) and square.aspheric == (-3e-9,)


def test_bench_rows_parted_by_spaces():
    text = "[lens data]\n1 50.0 4.0 1.5168 20.0 64.2\n2 -50.0 AB 20.0\n[variable distances]\n"
    spaced = read(BENCH, (text_of(BENCH), "[variable distances]\nAB 47.5\nF-Number 8\n" + text)).lens
    assert spaced.surfaces[1].medium.label == "1.0" and spaced.sensor_mm == 47.5


BENCH_REFUSED = {
    "a distance without a value": (("d4\t5.0", "dx\t5.0"), 'distance "d4" has no value'),
    "an asphere of no surface": (("\n6\t80.0\t0.2", "\n66\t80.0\t0.2"), 'aspherical data of "66"'),
    "two radii": (("6\t80.0\t0.2", "6\t81.0\t0.2"), "radius 81 differs"),
    "odd powers": (("[constants]\n", "[constants]\nAsphericalOddCount\t3\n"), "odd powers"),
    "a word for a radius": (("1\t30.0", "1\tround"), 'radius "round" is not a number'),
    "two stops": (("8\tCG", "8\tAS"), "surfaces 5 and 8 both are stops"),
    "a wild vd": (("\t36.4\t", "\t3.64\t"), "vd is 3.64"),
}


@pytest.mark.parametrize("case", BENCH_REFUSED)
def test_what_a_bench_text_is_refused_for(case):
    refused_at(BENCH, *BENCH_REFUSED[case])


def test_the_table_is_read_as_it_stands():
    lens = load_lens(FOLDER / TABLE)
    first, second = lens.surfaces
    assert (first.radius, first.thickness, first.medium.label) == (50.0, 4.0, "SCHOTT N-BK7")
    assert (first.conic, first.aspheric, first.semi_diameter) == (-0.5, (1e-6,), 10.0)
    assert second.medium.label == "1.0" and lens.stop_surface == 1 and lens.sensor_mm == 47.5
    assert (lens.aperture.kind, lens.aperture.value) == ("f_number", 8.0)
    assert lens.wavelengths_nm == (486.1327, 587.5618, 656.2725) and lens.fields_deg == (0.0, 5.0)


def test_semicolons_allow_a_decimal_comma(tmp_path):
    (tmp_path / "komma.csv").write_text(
        "radius;thickness;nd;vd;diameter;stop\n50,5;4,0;1,5168;64,17;20;1\nplano;90;;;20;\n"
    )
    lens = load_lens(tmp_path / "komma.csv")
    assert lens.surfaces[0].radius == 50.5 and lens.surfaces[0].medium.vd == 64.17
    assert lens.surfaces[0].semi_diameter == 10.0 and lens.surfaces[1].radius == inf


TABLE_REFUSED = {
    "no thickness": (("thickness,", "gap,"), 'column "gap" is unknown'),
    "two stops": (("10,,,", "10,,,x"), "surfaces 1 and 2 both are the stop"),
    "an unknown glass": (("N-BK7", "N-BOK7"), 'glass "N-BOK7" of SCHOTT is in no catalogue'),
    "a power too high": (("A4", "A50"), 'column "a50" is unknown'),
    "a word": (("47.5", "far"), 'distance "far" has no value'),
    "no stop, no aperture": (("# f_number: 8\n", "# f_number: -8\n"), "the aperture is -8"),
}


@pytest.mark.parametrize("case", TABLE_REFUSED)
def test_what_a_table_is_refused_for(case):
    refused_at(TABLE, *TABLE_REFUSED[case])


@pytest.mark.parametrize("content", ["", "hello", "a,b\n1,2\n", "PK\x03\x04", "[1, 2]", "NM X 2\n"])
def test_what_is_no_lens_at_all(content, tmp_path):
    (tmp_path / "thing").write_text(content)
    with pytest.raises(LensFileError):
        load_lens(tmp_path / "thing")
