"""What files state is read, or refused or named; nothing is dropped in silence, and no caution is false."""

import json
import zipfile
from math import asin, inf, sin, tan

import numpy as np
import pytest

from p2sf.cli import main
from p2sf.errors import LensFileError
from p2sf.lens.source import Source
from p2sf.lensfile.archives import unpack
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import Import, import_lens, import_text
from p2sf.lensfile.library import load_lens
from p2sf.lensfile.source_text import LensText
from p2sf.paraxial.first_order import abcd, cardinal_points
from p2sf.pixel_kernels.sensor_points import landing_mm
from tests.support.lenses.lens_files import FOLDER, read

FILES = FOLDER.parent / "lens_files"


def found(name: str, *changes: tuple[str, str], accept: bool = False) -> Import:
    text = (FILES / name).read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return import_text(LensText(name, "utf-8", text), GlassSources((), {}, accept))


def cautions(read_file: Import) -> list[str]:
    return [str(note.message) for note in read_file.report.of("caution")]


def focal_mm(name: str) -> float:
    lens = found(name).lens
    return float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length)


def test_a_grating_of_ray_optics_web_turns_rays_by_its_equation():
    """Behind 600 lines per mm on glass sin θ = mλT/n inside, mλT in the air behind its plane back; f tan θ at a lens.

    Two planes and a thin gap keep directions; the landing height follows from trigonometry alone. Exact rays of the
    axis round some 1e-12 mm.
    """
    lens = found("grating_ray_optics_web.json").lens
    for wave, sine in ((0.5, 0.30), (0.6, 0.36)):
        glass, lens_glass = (float(lens.surfaces[k].medium.index(wave)) for k in (0, 2))
        height = 2 * tan(asin(sine / glass)) + 10 * tan(asin(sine))  # at the vertex plane of the third surface
        y, _ = trace_sphere(height, asin(sine), lens_glass)
        assert landing_mm(lens, Source(inf, 0.0, wave))[1] == pytest.approx(-y, rel=1e-9)


def trace_sphere(height: float, angle: float, index: float) -> tuple[float, float]:
    """Return height and slope on the sensor of a ray through the plano-convex lens of the file, in the plane yz."""
    radius, thick, back = 50.0, 5.0, 93.4
    direction = np.array([sin(angle), np.sqrt(1 - sin(angle) ** 2)])
    point = np.array([height, 0.0])
    centre = np.array([0.0, radius])
    away = point - centre
    along = -(away @ direction) - np.sqrt((away @ direction) ** 2 - (away @ away - radius**2))
    point = point + along * direction
    normal = (point - centre) / radius
    cosine = -(normal @ direction)
    ratio = 1 / index
    direction = ratio * direction + (ratio * cosine - np.sqrt(1 - ratio**2 * (1 - cosine**2))) * normal
    point = point + (thick - point[1]) / direction[1] * direction
    up = direction[0] * index
    slope = up / np.sqrt(1 - up**2)
    return float(point[0] + back * slope), float(slope)


def test_a_grating_on_a_sphere_of_ray_optics_web_is_refused():
    with pytest.raises(LensFileError, match="only plane gratings"):
        found(
            "grating_ray_optics_web.json", ('"curvatureRadius":0,"thickness":2,', '"curvatureRadius":90,"thickness":2,')
        )


def test_a_diffractive_element_of_deeplens_is_refused_unless_it_does_nothing():
    name, block = "deeplens_grating_behind_lens.json", '"type":"Grating","d":60.0'
    with pytest.raises(LensFileError, match="diffractive element"):
        found(name)
    idle = '"type":"DOE","order2":0.0,"order4":0.0,"d":60.0'
    assert len(found(name, (block, idle), (',"theta":0.0,"alpha":1000.0', "")).lens.surfaces) == 3
    with pytest.raises(LensFileError, match="diffractive element"):
        found(name, (block, idle.replace('"order4":0.0', '"order4":1e-3')))


def test_words_of_json_that_no_reader_knows_are_named():
    for name, old, new in (
        ("lens_web.json", '"label": "Window"', '"label": "Window", "ronchi": 3'),
        ("deeplens.json", '"type": "Plane"', '"type": "Plane", "ronchi": 3'),
        ("optiland.json", '"comment": "FRONT"', '"comment": "FRONT", "ronchi": 3'),
        ("patent.json", '"thickness_mm": 2.5', '"thickness_mm": 2.5, "ronchi": 3'),
        ("triplet.json", '"radius"', '"ronchi": 3, "radius"'),
    ):
        assert not any("ronchi" in str(note.message) for note in read(name).report.of("unknown"))
        assert any("ronchi" in str(note.message) for note in read(name, (old, new)).report.of("unknown")), name


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("lens_web.json", ('"image": {"curvatureRadius": 0}', '"image": {"curvatureRadius": -40}')),
        (
            "optiland.json",
            (
                '"geometry": {"type": "Plane", "cs": {"x": 0.0, "y": 0.0, "z": 38.25',
                '"geometry": {"type": "StandardGeometry", "radius": -40, "cs": {"x": 0.0, "y": 0.0, "z": 38.25',
            ),
        ),
    ],
)
def test_curved_images_of_json_are_read(name, change):
    assert read(name).lens.sensor_radius == inf
    assert read(name, change).lens.sensor_radius == -40


def test_extra_data_of_a_type_that_has_none_are_named():
    (told,) = cautions(found("f_evenx.zmx"))
    assert "XDAT 1, 2, 4" in told and "EVENASPH" in told
    extended = found("f_evenx.zmx", ("TYPE EVENASPH", "TYPE XASPHERE"))
    assert not cautions(extended)
    sag = [float(each.lens.surfaces[0].sag(0.0, 5.0)) for each in (extended, found("f_evenx.zmx"))]
    # The second of its terms, −0.01 at (r/10)⁴; parameter 2 of the other, 1e-6 r⁴, is none of an extended asphere.
    assert sag[0] - sag[1] == pytest.approx(-0.01 * 0.5**4 - 1e-6 * 5**4, rel=1e-9)


def test_surfaces_that_a_configuration_ignores_do_nothing():
    """1/f = (n − 1)/R of the plano-convex lens that is left, by Schott's formula; the sensor stands 10 mm behind it."""
    name = "ignored_surfaces_configurations.zmx"
    alone = found(name)
    wave = alone.lens.reference_wavelength_um
    expected = 50 / (float(alone.lens.surfaces[0].medium.index(wave)) - 1)
    assert focal_mm(name) == pytest.approx(expected, rel=1e-12)
    assert sum(surface.thickness for surface in alone.lens.surfaces) == 15.0
    assert any("ignore" in told for told in cautions(alone))
    both = found(name, ("MNUM 2 1", "MNUM 2 2")).lens
    assert float(abcd(both, wave)[1, 0]) < -1.5 / expected and both.sensor_mm == 40
    same = found(name, ("IGNM   3   2 0.0", "IGNM   3   2 1.0"))
    assert same.lens.positions is None and not cautions(same)
    single = found(name, ("MNUM 2 1\n", ""), ('IGNM   3   2 0.0 0 4 0 1 1 1.0 0.0 0 "" 0', ""))
    assert single.lens.surfaces == alone.lens.surfaces


def test_numbers_of_surfaces_with_a_gap_are_refused_for_that():
    with pytest.raises(LensFileError, match="surface 5 is missing before surface 6"):
        found("surface_number_gap.zmx")


def test_all_unknown_glasses_are_named_and_their_numbers_are_taken_when_asked_for():
    """Nd and vd stand beside the names: 1/f = (n₁ − 1)(c₁ − c₂) − … of two thick surfaces, by matrices here."""
    with pytest.raises(LensFileError, match=r"H-QQ1.*1\.62041.*60\.32.*H-QQ2.*1\.7552.*27\.53"):
        found("unk2.zmx")
    taken = found("unk2.zmx", accept=True)
    assert len(taken.report.of("substituted")) == 2
    system = np.eye(2)
    for curvature, before, behind, gap in ((0.02, 1.0, 1.62041, 5), (-0.02, 1.62041, 1.7552, 2), (0.0, 1.7552, 1.0, 0)):
        refract = np.array([[1, 0], [-curvature * (behind - before), 1]])
        system = np.array([[1, gap / behind], [0, 1]]) @ refract @ system
    power = float(abcd(taken.lens, taken.lens.reference_wavelength_um)[1, 0])
    assert power == pytest.approx(system[1, 0], rel=1e-9)
    with pytest.raises(LensFileError, match=r"nd 1\.738 and vd 32\.33"):
        found("glass_with_index_in_row.zmx")


def test_lf7_of_schott_reaches_into_the_infrared():
    """Sellmeier's formula with Schott's coefficients of LF7, whose catalogue has it from 0.334 to 1.06 µm."""
    taken = found("lf7_900nm.zmx")
    assert taken.lens.wavelengths_nm == (550.0, 900.0) and not cautions(taken)
    pairs = (1.26879731, 0.00919553925), (0.156697051, 0.0447256764), (0.887676301, 106.8203610)
    index = np.sqrt(1 + sum(b * 0.81 / (0.81 - c) for b, c in pairs))
    assert float(taken.lens.surfaces[0].medium.index(0.9)) == pytest.approx(index, rel=1e-12)


@pytest.mark.parametrize("name", ["minus_infinity.txt", "bf_remark.txt", "metadata_unit.fx"])
def test_planes_remarks_and_units_are_understood(name):
    """Each has one curved pair of surfaces, of nd 1.5168: f by the equation of thick lenses."""
    behind = {"metadata_unit.fx": -50.0}.get(name, inf)
    n, t, first = 1.5168, 5.0, 50.0
    second = 1 / behind
    power = (n - 1) * (1 / first - second + (n - 1) * t * second / (n * first))
    assert focal_mm(name) == pytest.approx(1 / power, rel=1e-5)  # nd and vd are a model, whose nd is rounded


def test_a_focal_length_with_a_unit_is_compared():
    (told,) = (note.message.values for note in found("metadata_unit.fx").report.of("caution"))
    assert told["stated"] == 60.0


@pytest.mark.parametrize("title", ["f/2.8E", "f/2.8", "F/2.8 macro", "f/2.8-4"])
def test_f_numbers_in_titles_are_whole(title):
    found_by = read("singlet.csv", ("\n", f"\n# title: a lens {title}\n"))
    stated = [n.message.values.get("stated") for n in found_by.report.notes if "stated" in n.message.values]
    assert 2.8 in stated and 2 not in stated


def test_no_caution_compares_what_a_column_leaves_undefined():
    assert not cautions(found("f_over_2.8E.txt"))


def test_a_radius_that_is_rounded_elsewhere_is_no_reason_to_refuse():
    taken = found("rounded_radius.txt")
    assert taken.lens.surfaces[0].radius == pytest.approx(119.367, rel=1e-15)
    assert any("119.37" in told for told in cautions(taken))
    with pytest.raises(LensFileError, match="differs from the lens data"):
        found("rounded_radius.txt", ("119.370", "121"))


@pytest.mark.parametrize("name", ["lde_inf_image.csv", "lde_zero_image.csv"])
def test_the_image_row_of_a_table_is_no_surface(name):
    with pytest.raises(LensFileError, match="no aperture"):
        found(name)
    lens = found(
        name, ("Surface", "# f_number: 4\nSurface"), ("Material", "Material,stop"), ("N-BK7", "N-BK7,yes")
    ).lens
    assert len(lens.surfaces) == 2 and lens.sensor_mm == 47 and lens.object_distance == inf


def test_an_infinite_thickness_between_surfaces_is_still_refused():
    with pytest.raises(LensFileError, match="surface 1 has an infinite thickness"):
        found("lde_inf_image.csv", ("1,,50,5,N-BK7", "1,,50,inf,N-BK7"))


def test_an_archive_of_2010_opens(tmp_path):
    """Its records begin with EA 03; all else stands where it does behind EA 00."""
    text = (FILES / "lf7_900nm.zmx").read_bytes()
    head = bytearray(0x14C)
    head[:2], head[0x0C:0x10] = b"\xea\x03", len(text).to_bytes(4, "little")
    head[0x20 : 0x20 + 8] = b"lens.zmx"
    path = tmp_path / "old.zar"
    path.write_bytes(bytes(head) + text)
    assert [name for name, _ in unpack(path.read_bytes(), "old.zar")] == ["lens.zmx"]
    assert import_lens(path).lens.surfaces == load_lens(FILES / "lf7_900nm.zmx").surfaces
    assert not zipfile.is_zipfile(path)


def test_cylinders_have_a_focal_length_in_each_meridian(capsys):
    """1/f = (n − 1)/R in the one, and no power in the other; the file's 96.7 mm is right, so that nothing is cautioned.

    nd and vd of the file make a model of glass, whose nd is exact.
    """
    expected = 50 / 0.5168
    assert not cautions(found("cylinder.fx"))
    assert main(["info", str(FILES / "cylinder.fx"), "--json"]) in (0, None)
    facts = json.loads(capsys.readouterr().out)
    assert facts["in_x"]["effective_focal_length"] == pytest.approx(expected, rel=1e-5)
    assert facts["effective_focal_length"] is None  # infinite
    assert main(["info", str(FILES / "crossed_cylinders.fx"), "--json"]) in (0, None)
    crossed = json.loads(capsys.readouterr().out)
    for part in (crossed, crossed["in_x"]):
        assert part["effective_focal_length"] == pytest.approx(expected, rel=1e-5)
    assert crossed["back_focal_distance"] != pytest.approx(crossed["in_x"]["back_focal_distance"], rel=0.05)
