"""Lens files: what is written is read back equal, and every mistake is an error with place, value and remedy."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from p2sf.disc.mask import PupilMap, PupilMask
from p2sf.errors import LensFileError
from p2sf.glass.media import ConstantIndex, TabulatedIndex, catalogue_glass, model_glass
from p2sf.lens.lens import Aperture, Lens, Surface, with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.shapes import Diffraction, Qcon, RadialPolynomial
from p2sf.lensfile.library import find_lens, load_lens, shipped_lenses
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml, read_toml, write_toml
from p2sf.lensfile.writing import write_lens
from p2sf.paraxial.first_order import cardinal_points

GOOD = """\
title = "Biconvex"
unit = "mm"
stop_surface = 1
fields_deg = [0, 5]
wavelengths_nm = [587.5618]

[aperture]
f_number = 8

[[surface]]  # 1
radius = 50
thickness = 4
glass = "SCHOTT N-BK7"
semi_diameter = 10

[[surface]]  # 2
radius = -50.0
thickness = 47.0
"""


@pytest.mark.parametrize("name", shipped_lenses())
def test_every_shipped_lens_survives_the_round_trip(name, tmp_path):
    lens = find_lens(name)
    write_toml(lens, tmp_path / "copy.toml")
    again = load_lens(tmp_path / "copy.toml")
    assert again == lens
    assert lens_to_toml(again) == lens_to_toml(lens)


numbers = st.floats(-1e12, 1e12).filter(lambda x: abs(x) > 1e-12)
positive = st.floats(1e-9, 1e9)
radii = st.floats(1e-6, 1e6)  # of normalisation
terms = st.lists(st.floats(-1, 1), min_size=1, max_size=7).map(tuple)
surfaces = st.builds(
    Surface,
    radius=st.one_of(numbers, st.just(inf)),
    thickness=st.floats(-1e9, 1e9),
    medium=st.one_of(
        st.builds(ConstantIndex, st.floats(1, 4)),
        st.builds(model_glass, st.floats(1.3, 2.2), st.floats(15, 95)),
        st.just(catalogue_glass("SCHOTT N-SF11")),
        st.just(TabulatedIndex((0.4, 0.7), (1.6, 1.5), "measured")),
    ),
    conic=st.floats(-1e3, 1e3),
    aspheric=st.lists(st.floats(-1, 1), max_size=4).map(tuple),
    semi_diameter=st.one_of(positive, st.just(inf)),
    shape=st.one_of(
        st.none(),
        st.builds(RadialPolynomial, terms),
        st.builds(RadialPolynomial, terms, radii),
        st.builds(Qcon, terms, radii),
    ),
    diffraction=st.one_of(st.none(), st.builds(Diffraction, terms, radii, st.floats(-5, 5))),
)
texts = st.text(st.characters(exclude_categories=("Cs",)), max_size=30)


@given(st.lists(surfaces, min_size=1, max_size=3), positive, texts, texts, st.integers(0, 1))
def test_any_lens_survives_the_round_trip(rows, opening, title, comment, stop):
    """Random numbers to the last bit, random texts with quotes, line ends and control characters."""
    aperture = Aperture("entrance_pupil_diameter", opening)
    lens = Lens(tuple(rows), aperture, stop or None, "any", title, comment=comment, fields_deg=(-1.5, 0.0, 20.25))
    assert parse_toml(lens_to_toml(lens)) == lens


def test_what_is_left_out_has_its_default():
    lens = parse_toml("[aperture]\nf_number=8\n[[surface]]\nradius=50\nthickness=4\nglass=1.5\n", "dir/plain.toml")
    assert lens.name == "plain" and lens.stop_surface is None and lens.fields_deg == (0.0,)
    assert lens.surfaces[0].semi_diameter == inf and lens.surfaces[0].conic == 0 and lens.surfaces[0].aspheric == ()
    assert lens.wavelengths_nm == (587.5618,) and lens.object_medium == ConstantIndex(1.0)


@pytest.mark.parametrize(
    ("glass", "medium"),
    [
        ('"SCHOTT N-BK7"', catalogue_glass("SCHOTT N-BK7")),
        ("1.5168", ConstantIndex(1.5168)),
        ("{ nd = 1.5168, vd = 64.17 }", model_glass(1.5168, 64.17)),
        ('"air"', ConstantIndex(1.0)),
        ("{ wavelengths_um = [0.4, 0.7], n = [1.6, 1.5] }", TabulatedIndex((0.4, 0.7), (1.6, 1.5))),
    ],
)
def test_glass_is_written_in_any_of_these_ways(glass, medium):
    assert parse_toml(GOOD.replace('"SCHOTT N-BK7"', glass)).surfaces[0].medium == medium


@pytest.mark.parametrize(("unit", "mm"), [("mm", 1.0), ("cm", 10.0), ("m", 1000.0), ("in", 25.4), ("inch", 25.4)])
def test_units_scale_every_length_and_nothing_else(unit, mm):
    """Focal length scales by the unit; the aspheric sag A4 y⁴ + A6 y⁶ does too when y does."""
    text = GOOD.replace("semi_diameter = 10", "semi_diameter = 10\nconic = -0.5\naspheric = [1e-5, 2e-8]")
    plain, scaled = parse_toml(text), parse_toml(text.replace('"mm"', f'"{unit}"'))
    ratio = float(cardinal_points(scaled, 0.5876).effective_focal_length) / float(
        cardinal_points(plain, 0.5876).effective_focal_length
    )
    assert ratio == pytest.approx(mm, rel=1e-14)
    first, base = scaled.surfaces[0], plain.surfaces[0]
    sag = [sum(a * (mm * 3.0) ** (2 * k + 4) for k, a in enumerate(first.aspheric))]
    assert sag[0] == pytest.approx(mm * sum(a * 3.0 ** (2 * k + 4) for k, a in enumerate(base.aspheric)), rel=1e-13)
    assert (first.conic, first.semi_diameter) == (base.conic, mm * base.semi_diameter)
    assert scaled.aperture == plain.aperture
    diameter = parse_toml(text.replace("f_number = 8", "entrance_pupil_diameter = 2").replace('"mm"', f'"{unit}"'))
    assert diameter.aperture.value == 2 * mm


SHAPES = {
    "odd": 'shape = { type = "odd asphere", coefficients = [0.1, 2e-3, 3e-4] }',
    "extended odd": 'shape = { type = "extended odd asphere", normalisation_radius = 4, coefficients = [0.1, 0.02] }',
    "extended": 'shape = { type = "extended asphere", normalisation_radius = 4, coefficients = [0.1, 0.02] }',
    "Qbfs": 'shape = { type = "Qbfs", normalisation_radius = 4, coefficients = [0.1, 0.02] }',
    "Qcon": 'shape = { type = "Qcon", normalisation_radius = 4, coefficients = [0.1, 0.02] }',
}


@pytest.mark.parametrize("kind", SHAPES)
def test_shapes_are_scaled_by_the_unit(kind):
    """A sag of y in one unit is that of y in the other."""
    text = GOOD.replace("semi_diameter = 10", "semi_diameter = 10\n" + SHAPES[kind])
    one, ten = (parse_toml(text.replace('"mm"', f'"{unit}"')).surfaces[0] for unit in ("mm", "cm"))
    r = np.linspace(0, 3, 7)
    assert ten.sag(0.0, 10 * r) == pytest.approx(10 * one.sag(0.0, r), rel=1e-13)
    u = (r / 4) ** 2
    known = {
        "odd": 0.1 * r + 2e-3 * r**2 + 3e-4 * r**3,
        "extended odd": 0.1 * r / 4 + 0.02 * u,
        "extended": 0.1 * u + 0.02 * u * u,
        "Qcon": u * u * (0.1 + 0.02 * (6 * u - 5)),
        "Qbfs": u * (1 - u) / np.sqrt(1 - (r / 50) ** 2) * (0.1 + 0.02 * (13 - 16 * u) / np.sqrt(19)),
    }
    assert one.sag(0.0, r) - replace(one, shape=None).sag(0.0, r) == pytest.approx(known[kind], abs=1e-15)


def test_a_phase_is_scaled_by_the_unit():
    line = "diffraction = { normalisation_radius = 4, coefficients = [-30, 2] }"
    text = GOOD.replace("semi_diameter = 10", "semi_diameter = 10\n" + line).replace('"mm"', '"cm"')
    assert parse_toml(text).surfaces[0].diffraction == Diffraction((-30.0, 2.0), 40.0)


# (what is changed in GOOD, into what, line, what the sentence holds)
MISTAKES = [
    ("thickness = 4\n", 'thickness = "abc"\n', 12, ["surface 1", 'thickness is "abc"', "as a number"]),
    ("thickness = 47.0", "thickness = inf", 18, ["surface 2", "thickness is inf", "as a number"]),
    ("thickness = 47.0", "thickness = true", 18, ["thickness is true"]),
    ("thickness = 47.0\n", "", 16, ["surface 2: thickness is missing", "distance to the next surface"]),
    ("radius = -50.0", "radius = 0", 17, ["surface 2: radius is 0", "inf for a plane"]),
    ("radius = -50.0", "radius = nan", 17, ["radius is nan", "inf for a plane"]),
    ("radius = 50\n", "", 10, ["surface 1: radius is missing", "inf for a plane"]),
    ("semi_diameter = 10", "semi_diameter = -1", 14, ["semi_diameter is -1", "positive"]),
    ("semi_diameter = 10", "semi_diametre = 10", 14, ['"semi_diametre" is unknown', 'did you mean "semi_diameter"']),
    ("semi_diameter = 10", "colour = 3", 14, ['key "colour" is unknown', "radius, thickness, glass"]),
    ("semi_diameter = 10", 'title = "x"', 14, ['"title" belongs to the top', "first [ heading"]),
    ("semi_diameter = 10", "conic = [1]", 14, ["conic is [1]", "finite number"]),
    ("semi_diameter = 10", "aspheric = 1e-5", 14, ["aspheric is 1e-05", "list of numbers"]),
    ("semi_diameter = 10", 'aspheric = [1e-5, "x"]', 14, ['aspheric is "x"', "finite number"]),
    ("semi_diameter = 10", "conic = 1" + 400 * "0", 14, ["conic is 1000", "finite number"]),
    ("semi_diameter = 10", "shape = 3", 14, ["shape is 3", "write { key = value, … }"]),
    ("semi_diameter = 10", 'shape = { type = "Q" }', 14, ['type "Q" of a shape is unknown', "Qbfs, Qcon"]),
    ("semi_diameter = 10", SHAPES["Qcon"].replace("= 4", "= 0"), 14, ["normalisation_radius is 0", "positive"]),
    ("semi_diameter = 10", SHAPES["Qcon"].replace("coef", "ceof"), 14, ['"ceofficients" is unknown', "did you mean"]),
    ("semi_diameter = 10", SHAPES["odd"].replace("[0.1", '["x"'), 14, ['coefficients is "x"', "finite number"]),
    ("semi_diameter = 10", "diffraction = { order = 1 }", 14, ["normalisation_radius is missing"]),
    ('"SCHOTT N-BK7"', '"SCHOTT N-BK8"', 13, ["surface 1", '"SCHOTT N-BK8"', "did you mean SCHOTT N-BK7"]),
    ('"SCHOTT N-BK7"', '"F2"', 13, ["sold with different indices", "SCHOTT F2", "write the one you mean"]),
    ('"SCHOTT N-BK7"', "{ nd = 1.5 }", 13, ["glass is {'nd': 1.5}", "vd = 64.17"]),
    ('"SCHOTT N-BK7"', "99", 13, ["refractive index is 99", "between 0.5 and 6"]),
    ("stop_surface = 1", "stop_surface = 99", 3, ["stop_surface is 99", "from 1 to 2"]),
    ("stop_surface = 1", "stop_surface = 0", 3, ["stop_surface is 0", "from 1 to 2"]),
    ("stop_surface = 1", "stop_surface = 1.5", 3, ["stop_surface is 1.5", "whole number"]),
    ("stop_surface = 1", "stop_surfaces = 1", 3, ['"stop_surfaces" is unknown', 'did you mean "stop_surface"']),
    ('unit = "mm"', 'unit = "feet"', 2, ['unit is "feet"', "mm, cm, m, in"]),
    ('unit = "mm"', "unit = 1", 2, ["unit is 1", "quotation marks"]),
    ("title = ", "title = 3 #", 1, ["title is 3", "quotation marks"]),
    ("[0, 5]", "[0, 90]", 4, ["fields_deg is 90", "below 90"]),
    ("[0, 5]", "5", 4, ["fields_deg is 5", "list of numbers"]),
    ("[0, 5]", "[]", 4, ["fields_deg is an empty list", "at least one"]),
    ("[587.5618]", "[0.5876]", 5, ["wavelengths_nm is 0.5876", "nanometres"]),
    ("[587.5618]", "[200.0, 587.6]", 5, ["wavelength 200 nm", "SCHOTT N-BK7, 300 to 2500 nm", "take it out"]),
    ("f_number = 8", "f_number = -8", 8, ["f_number is -8", "positive"]),
    ("f_number = 8", "f_nummer = 8", 8, ['"f_nummer" is unknown', 'did you mean "f_number"']),
    ("f_number = 8", "f_number = 8\nstop_semi_diameter = 3", 7, ["states 2 of", "exactly one"]),
    ("f_number = 8", "", 7, ["states 0 of", "exactly one"]),
    ("[aperture]\nf_number = 8\n", "", None, ["aperture is None", "write [aperture]", "f_number"]),
    ("[aperture]\nf_number = 8\n", "aperture = 8\n", 7, ["aperture is 8", "write [aperture]"]),
    ("[aperture]", "[aperture", 7, ["this is not TOML", "correct the line"]),
    ("radius = 50\n", "radius = 50 mm\n", 11, ["this is not TOML", "correct the line"]),
    (
        "radius = 50\n",
        "radius = -50,5e1\n",
        11,
        ["this is not TOML", 'write -50.5e1 with a decimal point, not "-50,5e1"'],
    ),
    ("radius = 50\n", 'radius = "50,5"\n', 11, ['radius is "50,5"; write the number 50.5 without quotation marks']),
    ("radius = 50\n", 'radius = "-1e3"\n', 11, ["write the number -1e3 without quotation marks"]),
    ("radius = 50\n", 'radius = "50 mm"\n', 11, ["write a number that is not 0, inf for a plane"]),
    ('glass = "SCHOTT N-BK7"', 'glass = "SCHOTT', 13, ["this is not TOML"]),
]


@pytest.mark.parametrize(("old", "new", "line", "said"), MISTAKES, ids=[m[1].strip()[:30] for m in MISTAKES])
def test_a_mistake_is_one_sentence_at_its_line(old, new, line, said):
    assert GOOD.count(old) == 1 or old in ("title = ",)
    with pytest.raises(LensFileError) as caught:
        parse_toml(GOOD.replace(old, new, 1), "my.toml")
    message = str(caught.value)
    assert caught.value.line == line and message.startswith(f"my.toml, line {line}: " if line else "my.toml: "), message
    assert all(part in message for part in said), message
    assert "\n" not in message and len(message) < 400


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[aperture]\nf_number = 8\n", "the lens has no surfaces; write a [[surface]] for each"),
        ("surface = 3\n[aperture]\nf_number = 8\n", "line 1: surface is not a list of tables"),
        ("[aperture]\nf_number = 8\n[surface]\nradius = 1\n", "line 3: surface is not a list of tables"),
        ("x = " + "[" * 5000, "nested too deep"),
        ("x = " + "9" * 5000, "too long"),
        ('title = """never closed', "this is not TOML"),
    ],
)
def test_files_that_are_no_lens(text, said):
    with pytest.raises(LensFileError, match=r"my\.toml") as caught:
        parse_toml(text, "my.toml")
    assert said in str(caught.value)


def test_the_line_is_right_beneath_a_long_string():
    text = 'comment = """\n[[surface]]\nthickness = 1\n"""\n' + GOOD.replace("thickness = 4\n", 'thickness = "abc"\n')
    with pytest.raises(LensFileError, match="line 16: surface 1: thickness"):
        parse_toml(text)


def test_a_medium_no_file_can_hold_is_refused():
    class Strange:
        label, range_um = "strange stuff", None

        def index(self, wavelength_um):
            return np.ones_like(wavelength_um)

    lens = parse_toml(GOOD)
    with pytest.raises(LensFileError, match="medium strange stuff cannot be written"):
        lens_to_toml(replace(lens, object_medium=Strange()))


MASKED = """\
[aperture]
f_number = 8
[pupil]
{entry}
[[surface]]
radius = 50.0
thickness = 90.0
"""


def test_a_mask_is_read_and_written():
    mask = PupilMask(
        0.3, 3, 0.03, 10.0, 6, 0.4, 5.0, 0.8, 4, (0, 0, 0, 0.1), 0.5, PupilMap(np.arange(16.0).reshape(4, 4))
    )
    lens = with_mask(parse_toml(MASKED.format(entry="")), mask)
    again = parse_toml(lens_to_toml(lens))
    assert again.mask == mask and hash(again) == hash(lens)


@pytest.mark.parametrize(
    "entry",
    [
        "obscuration = 1.5",
        "vanes = 2.5",
        "obscuratio = 1",
        "zernike_um = 3",
        "phase_map = [[1, 2], [3]]",
        "cubic_um = inf",
    ],
)
def test_a_mask_that_cannot_be_is_refused_with_its_line(entry):
    with pytest.raises(LensFileError, match=entry.split()[0]) as error:
        parse_toml(MASKED.format(entry=entry))
    assert error.value.line == 4


def test_a_mask_of_a_picture_stands_upright(tmp_path):
    from PIL import Image

    picture = np.zeros((8, 8), np.uint8)
    picture[0] = 255  # the top row
    Image.fromarray(picture).save(tmp_path / "plate.png")
    path = tmp_path / "lens.toml"
    path.write_text(MASKED.format(entry='phase_file = "plate.png"\nphase_file_um = 2.0'), encoding="utf-8")
    values = read_toml(path).mask.phase_map.values
    assert (values[-1] == 2).all() and not values[:-1].any()


def test_other_formats_say_that_they_hold_no_mask(tmp_path):
    lens = with_mask(parse_toml(MASKED.format(entry="")), PupilMask(vanes=3))
    with pytest.raises(LensFileError, match="mask"):
        write_lens(lens, tmp_path / "lens.zmx")


TILTED = """
unit = "cm"
stop_surface = 1
{sensor}
[aperture]
stop_semi_diameter = 0.5
[[surface]]
radius = 5.0
thickness = 0.4
glass = 1.5
{before}
[[surface]]
radius = -5.0
thickness = 4.8
{piece}
"""


def test_tilts_and_decentres_are_read_and_written():
    """Lengths are in the file's unit, and z may be left out; what is written reads as the same lens."""
    before = (
        "before = [{ decentre = [0.1, 0.2, 0.3], tilt_deg = [1, 2, 3], tilt_first = true, pivot = [0, 0, 2] }, { }]"
    )
    sensor, piece = "sensor_before = [{ tilt_deg = [5, 0] }]", "[[misaligned]]\nsurfaces = [1, 2]\ndecentre = [0, 0.01]"
    lens = parse_toml(TILTED.format(before=before, sensor=sensor, piece=piece))
    own = Placement(1.0, 2.0, 3.0, 1.0, 2.0, 3.0, True, (0.0, 0.0, 20.0))
    assert lens.surfaces[0].before == (Placement(decentre_y=0.1), own, Placement())
    assert lens.sensor_before == (Placement(tilt_x_deg=5.0),)
    plain = parse_toml(TILTED.format(before=before, sensor=sensor, piece=""))
    assert lens == displaced(plain, 1, 2, Placement(decentre_y=0.1))
    assert parse_toml(lens_to_toml(lens)) == lens


@pytest.mark.parametrize(
    ("entries", "said", "line"),
    [
        ({"before": "before = [{ decentre = [0.1] }]"}, "surface 1: decentre are 1 numbers", 11),
        ({"before": "before = [{ tilt_deg = [90, 0, 0] }]"}, "surface 1: a tilt of 90° about x", None),
        ({"before": "before = { decentre = [0, 0] }"}, "surface 1: before is .* write a list", 11),
        ({"before": "before = [{ tilt = [0, 0] }]"}, 'key "tilt" is unknown; did you mean "tilt_deg"', 11),
        ({"before": "before = [{ tilt_first = 1 }]"}, "tilt_first is 1; write true or false", 11),
        ({"sensor": "sensor_before = [{ tilt_deg = [0, -95] }]"}, "surface 3: a tilt of -95° about y", 4),
        ({"piece": "[[misaligned]]\nsurfaces = [2, 3]"}, "surfaces 2 to 3 do not exist", 16),
        ({"piece": "[[misaligned]]\ndecentre = [0, 1]"}, "surfaces is .*; write the first and the last", 15),
        ({"piece": "[misaligned]\nsurfaces = [1, 1]"}, "head every piece with", None),
    ],
)
def test_a_tilt_that_cannot_be_is_refused(entries, said, line):
    with pytest.raises(LensFileError, match=said) as error:
        parse_toml(TILTED.format(**({"before": "", "sensor": "", "piece": ""} | entries)))
    assert line is None or error.value.line == line
