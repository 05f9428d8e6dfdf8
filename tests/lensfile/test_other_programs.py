"""Lens files of DeepLens, Optiland, ray-optics-web, renderers and patents: what they state, number by number."""

from math import inf, tan

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.glass.dispersion import LINES_UM
from p2sf.lens.lens import Lens
from p2sf.lensfile.formats.json_parts import JsonPart
from p2sf.lensfile.importing import recognise
from p2sf.lensfile.source_text import LensText
from tests.support.lenses.lens_files import FOLDER, read, read_file, refused_at

# Radius, thickness, nd, conic constant, A4 and A6, semi-diameter of every surface; then stop, aperture, fields.
FILES = {
    "deeplens.json": [
        (22.0, 3.25, 1.62041, 0, (), 9),
        (-436.0, 6, 1, 0.5, (1e-6, 2e-9), 9),
        (-22.2, 1, 1.62005, 0, (), 6),
        (20.3, 0.75, 1, 0, (), 6),
        (inf, 4, 1, 0, (), 5),
        (79.7, 3, 1.5855, 0, (-1e-6,), 7),
        (inf, 44, 1, 0, (), 7),
    ],
    "optiland.json": [
        (22.0, 3.25, 1.62041, -0.5, (1e-6,), 9),
        (-436.0, 33.25, 1, 0, (), inf),
        (inf, 1, 1.5168, 0, (), inf),
        (inf, 0.75, 1, 0, (), inf),
    ],
    "patent.json": [
        (inf, 2, 1.50839, 0, (), inf),
        (-50.839, 2.5, 1, 0, (), inf),
        (inf, 1.5, 1, 0, (), 15),
        (50.839, 2, 1.50839, 0, (1e-8,), inf),
        (inf, 99, 1, 0, (), inf),
    ],
    "sections.fx": [
        (22, 3.25, 1.62041, 0, (), 9),
        (-436, 6, 1, 0.5, (1e-6, 2e-9), 9),
        (-22.2, 1, 1.62004, 0, (), 6),
        (20.3, 0.75, 1, 0, (), 6),
        (inf, 4, 1, 0, (), 5),
        (79.7, 3, 1.7, 0, (), 7),
        (-18.4, 42, 1, 0, (), 7),
    ],
    "rows.fx": [
        (22, 3.25, 1.62041, 0, (), 9),
        (-436, 6, 1, 0, (), 9),
        (50000, 4, 1, 0, (), 5),
        (-22.2, 1, 1.62004, 0, (), 6),
        (80, 35, 1, 0.5, (8e-7,), 6),  # the shortest focal length comes first
    ],
    "prescription.csv": [
        (40, 2.5, 1.5168, 0, (), inf),
        (-30, 1, 1, -0.5, (1e-7, 2e-10), inf),
        (inf, 1, 1, 0, (), inf),
        (50, 2, 1.51633, 0, (), inf),
        (-50, 20, 1, 0, (1e-6,), inf),
    ],
    "patent_table.csv": [
        (40, 2.5, 1.5168, 0, (), 10),
        (-30, 1, 1, 0, (), 10),
        (inf, 2, 1, 0, (), 5),
        (-50, 2, 1.62004, 0, (), 6),
        (50, 30, 1, 0, (), 6),
    ],
    "commands.len": [
        (50, 2, 1.5168, 0, (), 6),
        (-50, 5, 1, 0, (), inf),
        (inf, 60, 1, 0, (), inf),
    ],
}
STOPS = {
    "deeplens.json": 5,
    "optiland.json": 2,
    "lens_web.json": 1,
    "patent.json": 3,
    "sections.fx": 5,
    "rows.fx": 3,
    "prescription.csv": 3,
    "patent_table.csv": 3,
    "commands.len": 1,
}
FORMATS = {
    "deeplens.json": "DeepLens (JSON)",
    "optiland.json": "Optiland (JSON)",
    "lens_web.json": "ray-optics-web (JSON)",
    "patent.json": "patent prescription (JSON)",
    "triplet.json": "ISET lens (JSON)",
    "sections.fx": "renderer's lens (.fx)",
    "rows.fx": "renderer's lens (.fx)",
    "prescription.csv": "table with named columns",
    "commands.len": "OSLO",
}


def lens_of(name: str) -> Lens:
    return read_file(FOLDER / name).lens


@pytest.mark.parametrize("name", FILES)
def test_every_number_of_every_surface(name):
    """To the digits of the files; a catalogue's glass to its fifth decimal, an index of 248 nm as it is stated."""
    lens = lens_of(name)
    assert len(lens.surfaces) == len(FILES[name])
    for surface, (radius, thickness, nd, conic, terms, rim) in zip(lens.surfaces, FILES[name], strict=True):
        assert (surface.radius, surface.thickness) == pytest.approx((radius, thickness), rel=1e-12)
        assert float(surface.medium.index(LINES_UM["d"])) == pytest.approx(nd, abs=1e-5)
        assert surface.conic == conic and surface.aspheric == pytest.approx(terms, rel=1e-12)
        assert surface.semi_diameter == rim and surface.shape is None


@pytest.mark.parametrize("name", STOPS)
def test_the_stop_is_the_files(name):
    assert lens_of(name).stop_surface == STOPS[name]


@pytest.mark.parametrize("name", FORMATS)
def test_the_content_tells_the_format_whatever_the_ending(name):
    text = (FOLDER / name).read_text(encoding="utf-8")
    assert recognise(LensText("lens.unknown", "utf-8", text)).name == FORMATS[name]


@pytest.mark.parametrize("text", ['{"a": 1}', '{"surface": [1]}', "[1, 2]", "{}"])
def test_a_json_that_is_no_lens_says_so(text):
    for path in ("x.json", "x.roa", "x"):
        with pytest.raises(LensFileError) as caught:
            recognise(LensText(path, "utf-8", text))
        assert caught.value.line == 1 and "DeepLens (JSON)" in caught.value.message.values["message"].values["formats"]


def test_conditions_of_optiland():
    lens = lens_of("optiland.json")
    assert (lens.aperture.kind, lens.aperture.value) == ("entrance_pupil_diameter", 10)
    assert lens.fields_deg == (0, 14) and lens.fields_x_deg == (0, -3)
    assert (
        lens.wavelengths_nm == (480, 550) and lens.wavelength_weights == (1, 2) and lens.reference_wavelength_nm == 550
    )
    assert [s.medium.label for s in lens.surfaces[:1]] == ["SCHOTT SK16"] and lens.surfaces[2].medium.vd == 64.17


def test_a_folded_mirror_of_ray_optics_web():
    """A paraboloid whose light is bent by 90° onto a window: media, tilt, terms, fields as shares of the largest."""
    found = read_file(FOLDER / "lens_web.json")
    primary, fold, window, last = found.lens.surfaces
    assert (primary.radius, primary.thickness, primary.conic) == (-1200, -400, -1)
    assert primary.aspheric == (1e-14,) and [s.medium.label for s in (primary, fold)] == ["mirror", "mirror"]
    assert (fold.before[0].tilt_x_deg, fold.after[0].tilt_x_deg) == (-45, -45)  # ADE and BEN of CODE V
    assert window.medium.label == "SCHOTT N-BK7" and last.thickness == 46.7
    assert found.lens.fields_deg == pytest.approx((0, 0.35, 0.5)) and found.lens.reference_wavelength_nm == 546.073


def test_cylinders_of_renderers_and_toroids_of_optiland():
    """A circle of the radius across the axis along which the cylinder is straight; z = R − √((R − g(y))² − x²)."""
    x, y = 2.0, 3.0
    for name, across in (("CYLINDER_Y", x), ("CYLINDER_X", y)):
        lens = read("sections.fx", ("AIR          SPHERICAL", f"AIR          {name}")).lens
        assert float(lens.surfaces[3].sag(x, y)) == pytest.approx(20.3 - np.sqrt(20.3**2 - across**2), rel=1e-12)
    old = '"StandardGeometry"'
    new = '"ToroidalGeometry", "radius_x": 50.0, "radius_y": -80.0, "conic_yz": -0.5, "coeffs_poly_y": [0.0, 1e-5]'
    curve = -(y**2) / 80 / (1 + np.sqrt(1 - 0.5 * y**2 / 80**2)) + 1e-5 * y**4
    sag = float(read("optiland.json", (old, new)).lens.surfaces[1].sag(x, y))
    assert sag == pytest.approx(50 - np.sqrt((50 - curve) ** 2 - x**2), rel=1e-12)


def test_a_planar_surface_of_a_renderer_is_flat_whatever_its_radius():
    assert read("sections.fx").lens.surfaces[3].vertex_curvature == pytest.approx(1 / 20.3)
    assert read("sections.fx", ("AIR          SPHERICAL", "AIR          PLANAR")).lens.surfaces[3].vertex_curvature == 0


def test_the_object_of_a_patent():
    """Marginal rays of NA 0.1 at the image of a relay of two lenses, 97 mm before the first: by a paraxial trace."""
    lens = lens_of("patent.json")
    assert lens.wavelengths_nm == (248.4,)
    y, u, index, heights = 97.0, 1.0, 1.0, []
    for surface, behind in zip(lens.surfaces, (1.50839, 1, 1, 1.50839, 1), strict=True):
        heights.append(y)
        u = (index * u - y * (behind - index) / surface.radius) / behind
        y, index = y + surface.thickness * u, behind
    assert lens.aperture.value == pytest.approx(abs(heights[2] / u) * tan(np.arcsin(0.1)), rel=1e-9)
    assert max(map(abs, lens.fields_deg)) == pytest.approx(np.degrees(np.arctan(2 / (97 + pupil_of(lens)))), rel=1e-6)


def pupil_of(lens: Lens) -> float:
    """Return where the middle of the stop, surface 3, is seen from before the lens: one lens and two gaps by hand."""
    power = 0.50839 / 50.839
    from_lens = 2.5 / (1 - 2.5 * power)  # the lens's image of the stop, behind its second vertex
    return from_lens + 2 / 1.50839


def test_positions_of_rows_and_of_a_prescription():
    zoom, other = lens_of("rows.fx"), lens_of("prescription.csv")
    assert [axis.kind for axis in (*zoom.positions.axes, *other.positions.axes)] == ["zoom", "zoom"]
    rows = [[s.thickness for s in each.surfaces] for each in (*zoom.positions.lenses, *other.positions.lenses)]
    assert sorted((row[1], row[4]) for row in rows) == [(1, 20), (1, 40), (2, 19), (3, 38), (6, 35)]


def test_what_the_file_states_stands_beside_what_is_found():
    """A paraxial trace by hand has 111.271 mm; 0.4 % beside it is a reading, 0.6 % a caution."""
    y, u, index = 1.0, 0.0, 1.0
    for radius, thickness, behind, *_ in FILES["deeplens.json"]:
        u = (index * u - y * (behind - index) / radius) / behind
        y, index = y + thickness * u, behind
    for share, kind in ((1.004, "read"), (1.006, "caution")):
        report = read("deeplens.json", ('"foclen": 111.3', f'"foclen": {share / abs(u)}')).report
        (note,) = (n for n in report.of(kind) if "off" in n.message.values and n.line == 3)
        # N-F2 by its formula and by its five decimals
        assert note.message.values["found"] == pytest.approx(abs(1 / u), rel=1e-4)
        assert note.message.values["off"] == pytest.approx(1 / share - 1, abs=1e-4)


@pytest.mark.parametrize(
    ("title", "kind", "value"),
    [
        ("NAME Doublet, EFL = 80 mm", "focal length, mm", 80),
        ("NAME Doublet f/5.6 of these tests", "f-number", 5.6),
        ("NAME BFL: 71.25 mm", "back focal length, mm", 71.25),
        ("NAME HFOV 12.5 deg", "half field, °", 12.5),
        ("NOTE 0 focal length 81.5 mm", "focal length, mm", 81.5),
    ],
)
def test_numbers_in_titles_and_notes(title, kind, value):
    text = (FOLDER / "doublet.zmx").read_text(encoding="utf-8")
    name = next(line for line in text.splitlines() if line.startswith("NAME"))
    report = read("doublet.zmx", (name, title)).report
    (note,) = (n for n in report.notes if "off" in n.message.values)
    assert str(note.message.values["what"]) == kind and note.message.values["stated"] == value and note.line


REFUSED = {
    "deeplens.json": [
        (('"type": "Plane"', '"type": "Cubic"'), "surface 7 has type Cubic"),
        (('"roc": 22.0', '"roc": "big"'), "surface 1: roc is big"),
        (('"r": 5.0', '"pos_xy": [0.1, 0], "r": 5.0'), "surface 5 is tilted or decentred"),
        (('"surfaces": [', '"surfaces": 3, "other": ['), "lists its"),
    ],
    "optiland.json": [
        (('"EvenAsphere"', '"BiconicGeometry"'), "surface 1 has type BiconicGeometry"),
        (('"z": 3.25, "rx": 0.0', '"z": 3.25, "rx": 0.1'), "surface 2 is tilted or decentred"),
        (('"type": "EPD"', '"type": "other"'), "aperture is of type other"),
        (('"value": 0.48', '"value": 480'), "not that of light"),
    ],
    "lens_web.json": [
        (('"bend"', '"twist"'), "surface 2 is tilted by twist"),
        (('"EvenAspherical"', '"XToroid"'), "surface 1 has type XToroid"),
        (
            ('"thickness": 5,', '"thickness": 5, "diffractiveElement": {"diffractionGrating": {"lpmm": 600}},'),
            "diffracts",
        ),
    ],
    "patent.json": [(('"stop_surface": 3', '"stop_surface": 9'), "the stop is on the object or the image")],
    "sections.fx": [
        (("AIR          ASPHERICAL", "AIR          CONE"), "surface 2 has type CONE"),
        (("1: k=0.5", "9: k=0.5"), 'aspherical data of "9"'),
        (("-436    6 ", "-436    x "), '"x" is not a number'),
    ],
    "rows.fx": [
        (("#!scale 0.5", "#!scale 0"), "not a number"),
        (("SK16  1.62041", "cx_SK16  1.62041"), "surface 1 has type cx_"),
        (("60.32  18", ""), "a row of glass"),
    ],
    "patent_table.csv": [(("Note\n", "Type\n"), "surface 1 has type first page")],
    "prescription.csv": [
        (("2,-0.5,1E-3", "7,-0.5,1E-3"), 'aspherical data of "7"'),
        (("d2,1,2", "d3,1,2"), 'distance "d2" has no value'),
        (("normalized,10", "normalized,0"), "normalization radius 0"),
    ],
    "commands.len": [(("PFL 60", "PFL 60; PFM 2"), "an ideal lens for one magnification")],
}


@pytest.mark.parametrize(("name", "change", "said"), [(n, *case) for n, cases in REFUSED.items() for case in cases])
def test_what_is_refused_says_where_and_why(name, change, said):
    refused_at(name, change, said)


def test_a_radius_of_json_may_be_infinite_in_several_ways():
    part = JsonPart({"a": 0, "b": "infinity", "c": inf, "d": 1e14, "e": -20.0}, LensText("x", "utf-8", ""))
    assert [part.curvature(name) for name in "abcde"] == [0, 0, 0, 0, -0.05]
    assert part.number("none", default=3.0) == 3
