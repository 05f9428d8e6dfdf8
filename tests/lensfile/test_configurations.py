"""Zoom and focus positions in other programs' files: each is what the file says of it, read by hand."""

from math import inf

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens
from p2sf.lens.positions import with_positions
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import Import, import_text
from p2sf.lensfile.library import load_lens
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.writing import write_lens
from p2sf.paraxial.first_order import abcd, image_distance
from p2sf.paraxial.positions import lens_at
from p2sf.paraxial.pupils import stop_rim
from tests.support.lenses.zooms import focusing_zoom, spaces, two_group_zoom

# Radius, thickness (or one for every zoom), index: two groups, the stop in front of the second.
ROWS = (
    (inf, 2.0, 1.5),
    (30.0, [round(spaces(focal)[0] - 0.5, 4) for focal in (30, 40, 60)], 1.0),
    (inf, 0.5, 1.0),
    (inf, 2.0, 1.5),
    (-20.0, [round(spaces(focal)[1], 4) for focal in (30, 40, 60)], 1.0),
)
F_NUMBERS = (3.0, 4.0, 5.0)
ANGLES = (20.0, 15.0, 10.0)


def imported(name: str, text: str) -> Import:
    return import_text(LensText(name, "utf-8", text), GlassSources())


def matrix(column: int, moved: dict[int, float] | None = None) -> np.ndarray:
    """Return the ABCD matrix of a column of `ROWS`, first to last vertex; ``moved`` are other thicknesses by row."""
    found, before = np.eye(2), 1.0
    for number, (radius, gap, index) in enumerate(ROWS):
        found = np.array([[1, 0], [-(index - before) / radius, 1]]) @ found
        gap = (moved or {}).get(number, gap[column] if isinstance(gap, list) else gap)
        if number < len(ROWS) - 1:
            found = np.array([[1, gap / index], [0, 1]]) @ found
        before = index
    return found


def test_positions_that_differ_by_the_object_only_are_one_lens():
    """Nothing moves: TOML has no columns for it, and a ring would do nothing."""
    rows = "d0\tInfinity\t1000\nF-Number\t4\t4\nBf\t40\t40\n[lens data]\n1\t30\t4\t1.62\t20\t60.3\n2\t-200\tBf\t\t18\n"
    text = f"[variable distances]\n{rows}"
    assert import_text(LensText("one.txt", "utf-8", text), GlassSources()).lens.positions is None


def check_columns(lens: Lens) -> None:
    """Check the first-order data of the three zoom positions against those of their numbers, read by hand."""
    assert [axis.kind for axis in lens.positions.axes] == ["zoom"]
    for column, name in enumerate(lens.positions.axes[0].columns):
        found = lens_at(lens, zoom=name)
        # Some ten roundings of numbers near 1.
        np.testing.assert_allclose(abcd(found, 0.5876), matrix(column), rtol=1e-13, atol=1e-15)
        assert found.sensor_mm == pytest.approx(ROWS[-1][1][column], rel=1e-15)
        assert found.fields_deg[-1] == pytest.approx(ANGLES[column], rel=1e-12)
        assert found.stop_surface == 3
        assert found.aperture.kind == "f_number" and found.aperture.value == F_NUMBERS[column]
    assert parse_toml(lens_to_toml(lens)) == lens


def zemax() -> str:
    """Return the zoom as Zemax has it, in its third configuration."""
    lines = [
        "VERS 1 2 3",
        "MODE SEQ",
        "NAME Zoom",
        "UNIT MM",
        "FNUM 5 0",
        "FTYP 0 0 2 1 0 0 0",
        "XFLN 0 0",
        "YFLN 0 10",
    ]
    lines += ["WAVM 1 0.5875618 1", "PWAV 1", "SURF 0", "  TYPE STANDARD", "  CURV 0", "  DISZ INFINITY"]
    for number, (radius, gap, index) in enumerate(ROWS, 1):
        lines += [f"SURF {number}", "  TYPE STANDARD", f"  CURV {1 / radius!r}"]
        lines += [f"  DISZ {gap[2] if isinstance(gap, list) else gap}"]
        lines += ["  STOP"] * (number == 3) + [f"  GLAS ___BLANK 1 0 {index} 0"] * (index != 1)
    lines += [f"SURF {len(ROWS) + 1}", "  TYPE STANDARD", "  CURV 0", "  DISZ 0", "MNUM 3 3"]
    lines += [f'LTTL 0 {k} "{name}" 0 0 0 1 1 0 0.0 "" 0' for k, name in enumerate(("at 30", "at 40", "at 60"), 1)]
    for number, (_, gap, _) in enumerate(ROWS, 1):
        if isinstance(gap, list):
            lines += [f'THIC   {number}   {k} {value} 0 0 0 1 1 1 0 0 "" 0' for k, value in enumerate(gap, 1)]
    lines += [f'APER   0   {k} {value} 0 0 0 1 1 1 0 0 "" 0' for k, value in enumerate(F_NUMBERS, 1)]
    lines += [f'YFIE   2   {k} {value} 0 0 0 1 1 1 0 0 "" 0' for k, value in enumerate(ANGLES, 1)]
    return "\n".join(lines) + "\n"


def code_v() -> str:
    """Return the zoom as CODE V has it."""
    lines = ["RDM;LEN", "TIT 'Zoom'", "EPD 10", "DIM M", "WL 587.5618", "REF 1", "YAN 0 20", "SO 0 1e13"]
    for number, (radius, gap, index) in enumerate(ROWS, 1):
        glass = " 500.99999" if index != 1 else ""  # 1.5 and hardly any dispersion
        lines += [f"S {0 if radius == inf else radius} {gap[0] if isinstance(gap, list) else gap}{glass}"]
        lines += ["  STO"] * (number == 3)
    lines += ["SI 0 0", "ZOO 3", "ZOO TIT", *(f"TIT Z{k} 'at {f}'" for k, f in enumerate((30, 40, 60), 1))]
    lines += [f"ZOO EPD {' '.join(map(str, F_NUMBERS))}"]
    for number, (_, gap, _) in enumerate(ROWS, 1):
        if isinstance(gap, list):
            lines += [f"ZOO THI S{number} {' '.join(map(str, gap))}", f"ZOO THC S{number} 100 100 100"]
    lines += [f"ZOO YAN F2 {' '.join(map(str, ANGLES))}", "GO"]
    return "\n".join(lines) + "\n"


def bench(extra: int = 0) -> str:
    """Return the zoom as the Optical Bench has it: at infinity, and twice with its front group 1 and 3 mm out.

    ``extra`` are columns more, which are of no zoom.
    """
    first, back = ([row[1] for row in ROWS if isinstance(row[1], list)][k] for k in (0, 1))
    gaps = [round(gap + out, 4) for out in (0, 1, 3) for gap in first] + [9.0] * extra
    undefined = "\tundefined" * (6 + extra)
    far = ["Infinity"] * 3 + [str(mm) for mm in (3000, 3010, 3020, 1000, 1010, 1020)] + ["500"] * extra
    lines = ["[descriptive data]", "title\tZoom", "[constants]", "[variable distances]"]
    tab = "\t"
    lines += ["Focal Length\t30\t40\t60" + undefined, "F-Number\t" + tab.join(map(str, F_NUMBERS)) + undefined]
    lines += ["Angle of View\t" + tab.join(str(2 * angle) for angle in ANGLES) + undefined]
    lines += ["Image Height\t43.2", "Magnification\t0\t0\t0" + "\t-0.1" * (6 + extra), "d0\t" + tab.join(far)]
    lines += [
        "d2\t" + tab.join(map(str, gaps)),
        "Bf\t" + tab.join(map(str, back * 3 + back[:1] * extra)),
        "[lens data]",
    ]
    for number, (radius, gap, index) in enumerate(ROWS, 1):
        kind = "AS" if number == 3 else "Infinity" if radius == inf else radius
        name = {2: "d2", 5: "Bf"}.get(number, gap)
        lines += [f"{number}\t{kind}\t{name}\t{index if index != 1 else ''}\t40"]
    return "\n".join(lines) + "\n"


def test_zemax_configurations_are_the_columns_of_a_zoom():
    found = imported("zoom.zmx", zemax())
    check_columns(found.lens)
    assert found.lens.positions.axes[0].columns == ("at 30", "at 40", "at 60")
    assert found.lens.positions.axes[0].at == pytest.approx((30, 40, 60), abs=1e-3)  # thicknesses have four decimals
    assert "zoom positions at 30, at 40, at 60" in found.report.text
    assert not found.report.of("caution")


def test_zemax_operands_that_are_not_read_are_named_where_they_differ():
    more = zemax() + "".join(f'PRAM 2 {k} {k} 0 0 0 1 1 1 0 0 "" 0\nFVCY 1 {k} 0 0 0\n' for k in (1, 2, 3))
    (said,) = imported("zoom.zmx", more).report.of("caution")
    assert "configurations differ in PRAM, which are not read" in str(said.message)


def test_zemax_operands_set_radii_conics_glasses_rims_and_wavelengths():
    more = zemax()
    for name, place, values in (
        ("CRVT", 2, (1 / 30, 1 / 31, 1 / 32)),
        ("CONN", 2, (0, -0.5, -1)),
        ("SDIA", 1, (20, 21, 22)),
        ("GLSS", 1, ("N-BK7", "N-BK7", "N-SF5")),
        ("WAVE", 1, (0.55, 0.55, 0.6)),
    ):
        more += "".join(f'{name} {place} {k} {value} 0 0 0 1 1 1 0 0 "" 0\n' for k, value in enumerate(values, 1))
    lens = imported("zoom.zmx", more.replace("PWAV 1", "PWAV 1\nGCAT SCHOTT")).lens
    last = lens_at(lens, zoom="at 60")
    assert (last.surfaces[1].radius, last.surfaces[1].conic, last.surfaces[0].semi_diameter) == (32, -1, 22)
    assert last.surfaces[0].medium.label == "SCHOTT N-SF5" and last.wavelengths_nm == (600.0,)
    assert lens.surfaces[0].medium.label == "SCHOTT N-BK7" and lens.wavelengths_nm == (550.0,)


@pytest.mark.parametrize(("solve", "total"), [("TCOM 2 90", 90), ("TOLE 2 92.5", 92.5)])
def test_zemax_thicknesses_that_keep_a_sum_follow_in_every_configuration(solve, total):
    lines = [line for line in zemax().splitlines() if not line.startswith("THIC   5")]
    text = "\n".join(lines).replace("SURF 6", f"  {solve}\nSURF 6")
    lens = imported("zoom.zmx", text).lens
    for name, gap in zip(lens.positions.axes[0].columns, sorted(ROWS[1][1], reverse=True), strict=False):
        others = gap if solve.startswith("TCOM") else gap + 0.5 + 2.0
        assert lens_at(lens, zoom=name).sensor_mm == pytest.approx(total - others, rel=1e-14)


def solved(below: int, *lines: str, without: str = "THIC   5") -> Lens:
    """Return the zoom with lines below a surface, and without an operand."""
    text = "\n".join(line for line in zemax().splitlines() if not line.startswith(without))
    more = "\n".join(f"  {line}" for line in lines)
    return imported("zoom.zmx", text.replace(f"SURF {below + 1}\n", f"{more}\nSURF {below + 1}\n")).lens


def columns_of(lens: Lens) -> list[Lens]:
    return [lens_at(lens, zoom=name) for name in lens.positions.axes[0].columns]


def test_a_marginal_ray_solve_of_zemax_puts_the_image_at_the_paraxial_focus_of_every_configuration():
    for column in columns_of(solved(5, "MAZH 0 0")):
        (a, _), (c, _) = abcd(column, 0.5875618)
        assert column.sensor_mm == pytest.approx(-a / c, rel=1e-13)


def test_thickness_pickups_of_zemax_follow_in_every_configuration():
    for column in columns_of(solved(5, "PZUP 2 -0.5 100 0")):
        assert column.sensor_mm == pytest.approx(100 - 0.5 * column.surfaces[1].thickness, rel=1e-15)


def test_curvature_pickups_of_zemax_follow_in_every_configuration():
    more = "".join(f'CRVT 2 {k} {value} 0 0 0 1 1 1 0 0 "" 0\n' for k, value in enumerate((0.03, 0.031, 0.032), 1))
    text = zemax().replace("SURF 6\n", "  CURV 0.5 4 2 -0.4\nSURF 6\n")
    for column in columns_of(imported("zoom.zmx", text + more).lens):
        assert column.surfaces[4].curvature == pytest.approx(-0.4 * column.surfaces[1].curvature, rel=1e-15)


def test_edge_solves_of_zemax_keep_the_edge_in_every_configuration():
    for column in columns_of(solved(5, "EDGE 90 4")):
        last = column.surfaces[-1]
        assert last.thickness - last.sag(0.0, 4.0) == pytest.approx(90, rel=1e-14)


def test_parameters_of_zemax_differ_between_configurations_and_are_picked_up():
    """The tilt of a coordinate break in front of the last lens, and another that turns back by the same angle."""
    text = zemax().replace("SURF 6\n", "SURF 8\n").replace("SURF 5\n", "SURF 6\n")
    into = "SURF 5\n  TYPE COORDBRK\n  PARM 3 0\n  DISZ 0\nSURF 6\n"
    back = "SURF 7\n  TYPE COORDBRK\n  PARM 3 0\n  PPAR 3 5 -1 0 0\n  DISZ 0\nSURF 8\n"
    text = text.replace("SURF 6\n", into).replace("SURF 8\n", back)
    text += "".join(f'PAR3 5 {k} {0.5 * k} 0 0 0 1 1 1 0 0 "" 0\n' for k in (1, 2, 3))
    for number, column in enumerate(columns_of(imported("zoom.zmx", text).lens), 1):
        (into,), (back,) = column.surfaces[4].before, column.surfaces[6].before
        assert (into.tilt_x_deg, back.tilt_x_deg) == (0.5 * number, -0.5 * number)


@pytest.mark.parametrize(("defocus", "stated"), [(0.0, ""), (0.25, ""), (0.25, "90")])
def test_the_paraxial_image_of_code_v_is_found_where_no_thickness_is_stated(defocus, stated):
    text = (
        f"RDM;LEN\nDIM M\nEPD 8\nWL 550\nSO 0 200\nS 40 4 1.5:60\nSTO\nS -60 {stated or 0}\nPIM\nSI 0 {defocus}\nGO\n"
    )
    found = imported("pim.seq", text)
    (a, b), (c, d) = abcd(found.lens, 0.55)
    focus = -(a + b / 200) / (c + d / 200)
    assert found.lens.sensor_mm == pytest.approx((float(stated) if stated else focus) + defocus, rel=1e-13)
    (note,) = (note for note in found.report.notes if "focus" in note.message.template and note.surface == 2)
    assert note.message.values["found"] == pytest.approx(focus + defocus, rel=1e-13)


def test_code_v_zoom_positions_are_the_columns_of_a_zoom():
    text = code_v()
    lens = imported("zoom.seq", text).lens
    assert lens.positions.axes[0].columns == ("at 30", "at 40", "at 60")
    for column, name in enumerate(lens.positions.axes[0].columns):
        found = lens_at(lens, zoom=name)
        # The glass is 0.50099999 in its code, and its dispersion tiny: n(d) = 1.50099999 exactly.
        assert found.surfaces[1].thickness == ROWS[1][1][column] and found.sensor_mm == ROWS[-1][1][column]
        assert found.aperture.value == F_NUMBERS[column] and found.aperture.kind == "entrance_pupil_diameter"
        assert found.fields_deg == pytest.approx((0.0, ANGLES[column]), rel=1e-12)


def test_code_v_positions_may_be_named_with_each_number():
    gaps = ROWS[1][1]
    by_line = "\n".join(f"THI S2 Z{k} {gap}" for k, gap in enumerate(gaps, 1))
    text = code_v().replace(f"ZOO THI S2 {' '.join(map(str, gaps))}", "ZOO THI S2\n" + by_line)
    assert imported("zoom.seq", text).lens == imported("zoom.seq", code_v()).lens


def test_code_v_refuses_another_number_of_values_than_positions():
    with pytest.raises(LensFileError, match="ZOO EPD has 2 values for 3 zoom positions") as caught:
        imported("zoom.seq", code_v().replace("ZOO EPD 3.0 4.0 5.0", "ZOO EPD 3.0 4.0"))
    assert caught.value.line == 21


def test_the_bench_has_a_ring_of_zoom_and_one_of_focus():
    lens = imported("zoom.txt", bench()).lens
    zoom, focus = lens.positions.axes
    assert (zoom.columns, zoom.at, zoom.unit) == (("30 mm", "40 mm", "60 mm"), (30.0, 40.0, 60.0), "mm")
    assert focus.columns == ("∞", "2", "3")
    for column, name in enumerate(zoom.columns):
        rim = float(stop_rim(lens_at(lens, name, "∞")))
        for out, near in ((0, "∞"), (1, "2"), (3, "3")):
            found = lens_at(lens, name, near)
            moved = {1: ROWS[1][1][column] + out}
            np.testing.assert_allclose(abcd(found, 0.5876), matrix(column, moved), rtol=1e-12, atol=1e-15)
            assert found.sensor_mm == ROWS[-1][1][column]
            assert float(stop_rim(found)) == pytest.approx(rim, rel=1e-14)  # an iris does not open when focused
    focal = -1 / matrix(0)[1, 0]
    assert 2 * float(stop_rim(lens_at(lens, "30 mm", "∞"))) > focal / F_NUMBERS[0]  # seen larger by the front group


def test_the_bench_at_infinity_alone_is_a_zoom():
    lines = bench().splitlines()
    start = lines.index("[variable distances]")
    end = lines.index("[lens data]")
    lines[start:end] = ["\t".join(line.split("\t")[:4]) for line in lines[start:end]]
    check_columns(imported("zoom.txt", "\n".join(lines)).lens)


def test_bench_columns_of_no_zoom_are_left_out_and_said():
    found = imported("zoom.txt", bench(extra=2))
    assert found.lens == imported("zoom.txt", bench()).lens
    assert "11 positions, of which 9" in found.report.text


def test_a_lens_with_near_columns_has_a_ring_of_focus_in_dioptres():
    text = (
        "[variable distances]\nF-Number\t8\nAngle of View\t40\nd0\tInfinity\t1000\t500\n"
        "d1\t1\t2\t3.5\nBf\t97\t97\t97\n[lens data]\n1\tAS\td1\t\t10\n2\t50\t3\t1.5\t20\n3\tInfinity\tBf\t\t20\n"
    )
    lens = imported("macro.txt", text).lens
    (focus,) = lens.positions.axes
    assert (focus.kind, focus.columns, focus.at, focus.unit) == ("focus", ("∞", "1 m", "0.5 m"), (0.0, 1.0, 2.0), "dpt")
    assert [lens_at(lens, focus_position=k).surfaces[0].thickness for k in (0.0, "1 m", 2)] == [1.0, 2.0, 3.5]


def test_positions_in_which_the_lens_is_one_are_no_positions():
    text = zemax()
    for line in [line for line in text.splitlines() if line.startswith(("THIC", "APER", "YFIE"))]:
        text = text.replace(line + "\n", "")
    lens = imported("zoom.zmx", text).lens
    assert lens.positions is None
    assert float(image_distance(lens, inf, 0.5876)) == pytest.approx(ROWS[-1][1][2], abs=1e-3)


def test_a_zoom_is_written_as_zemax_configurations_and_read_back(tmp_path):
    zoom = two_group_zoom()
    write_lens(zoom, tmp_path / "zoom.zmx")
    again = load_lens(tmp_path / "zoom.zmx")
    assert again.positions.axes[0].columns == zoom.positions.axes[0].columns
    for column, other in zip(zoom.positions.lenses, again.positions.lenses, strict=True):
        assert [s.thickness for s in other.surfaces] == [s.thickness for s in column.surfaces]
        # The file has curvatures, and 1/(1/r) is r to a rounding.
        assert [s.radius for s in other.surfaces] == pytest.approx([s.radius for s in column.surfaces], rel=1e-15)
        assert other.aperture == column.aperture and other.fields_deg == pytest.approx(column.fields_deg, rel=1e-12)


def test_a_ring_of_focus_is_written_with_the_distances_it_is_focused_on(tmp_path):
    lens = focusing_zoom().positions
    columns = lens.lenses[:3]  # the wide one, whose front group moves out
    write_lens(with_positions(lens.axes[1:], columns), tmp_path / "macro.zmx")
    again = load_lens(tmp_path / "macro.zmx")
    assert again.positions.axes[0].kind == "focus"
    for column, there in zip(columns, again.positions.axes[0].at, strict=True):
        distance = 1000 / there if there > 1e-6 else inf
        assert float(image_distance(column, distance, 0.5875618)) == pytest.approx(column.sensor_mm, rel=1e-9)


def test_what_other_files_cannot_hold_of_positions_is_refused(tmp_path):
    with pytest.raises(LensFileError, match="a zoom ring and a focus ring"):
        write_lens(focusing_zoom(), tmp_path / "lens.zmx")
    assert not list(tmp_path.iterdir())


def test_iset_holds_the_present_position(tmp_path):
    write_lens(lens_at(two_group_zoom(), zoom=50.0), tmp_path / "lens.json")
    assert '"description": ", zoom 50 mm"' in (tmp_path / "lens.json").read_text()
    again = load_lens(tmp_path / "lens.json")
    assert again.positions is None
    assert again.sensor_mm == lens_at(two_group_zoom(), zoom=50.0).sensor_mm
