"""Every road begins at the object distance and the primary wavelength of the lens's file, on the axis."""

import json
from dataclasses import replace
from math import inf

import pytest

import p2sf
from p2sf.cli import main
from p2sf.errors import LensFileError
from p2sf.lens.lens import with_sensor
from p2sf.lens.positions import Axis, with_positions
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.paraxial.positions import lens_at
from p2sf.raytrace.focusing import object_distance
from p2sf.setting import Request, set_up
from p2sf_explorer.compute.setup import default_state, ranges
from p2sf_explorer.report.contents import requested_state
from tests.support.lenses.lens_files import FOLDER, read

FILE = str(FOLDER / "finite_object.zmx")
AWAY_MM, PRIMARY_NM = 95.0, 656.2725
STATED = "--depth-mm", "95", "--field-deg", "0", "--wavelength-nm", "656.2725"
COMMANDS = ("info",), ("spot",), ("zernike",), ("coefficients",), ("psf", "--pixels", "8"), ("nodes", "--fields", "3")


def image_by_hand_mm(away_mm: float) -> float:
    """Return where two refractions put the image behind the second vertex: n′/s′ − n/s = (n′ − n)/R, twice."""
    index = float(p2sf.load_lens(FILE).surfaces[0].medium.index(PRIMARY_NM / 1000))
    inside = index / ((index - 1) / 50 - 1 / away_mm)
    return 1 / ((1 - index) / -50 + index / (inside - 5))


@pytest.fixture
def answer(capsys):
    def ask(*words: object) -> dict:
        assert main([*map(str, words), "--json"]) in (0, None)
        return json.loads(capsys.readouterr().out)

    return ask


def without_times(found: dict) -> dict:
    return {name: value for name, value in found.items() if name not in ("seconds", "milliseconds")}


@pytest.mark.parametrize("words", COMMANDS, ids=lambda words: words[0])
def test_commands_begin_at_the_object_of_the_file(words, answer):
    name, *rest = words
    assert without_times(answer(name, FILE, *rest)) == without_times(answer(name, FILE, *rest, *STATED))


def test_the_image_is_that_of_two_refractions(answer):
    """Both sides are sums of some ten terms, each rounded once."""
    expected = image_by_hand_mm(AWAY_MM)
    lens = p2sf.load_lens(FILE)
    six = p2sf.Camera(lens).at().coefficients()
    assert float(six.image_distance) == pytest.approx(expected, rel=1e-12)
    assert answer("info", FILE)["image_distance"] == pytest.approx(expected, rel=1e-12)
    assert p2sf.Camera(lens).source() == p2sf.Source(AWAY_MM, wavelength_nm=PRIMARY_NM)
    assert p2sf.Camera(lens, focus_mm=300).source().depth_mm == 300
    assert set_up(lens, Request(focus_mm=300)).source.depth_mm == AWAY_MM


def test_the_library_renders_the_source_of_the_file():
    lens = p2sf.load_lens(FILE)
    own, stated = (p2sf.render(lens, *source, pixels=8) for source in ((), (p2sf.Camera(lens).source(),)))
    assert (own.values == stated.values).all() and own.wavelength_um == PRIMARY_NM / 1000
    rows = p2sf.tradeoff(lens, fields_deg=[0], methods=["seidel"], pixels=16)
    assert {(row.depth_mm, row.wavelength_nm) for row in rows} == {(AWAY_MM, PRIMARY_NM)}


def test_the_window_and_the_report_begin_there():
    for state in (default_state(FILE), requested_state(FILE, Request())):
        assert (state.optics.depth_mm, state.optics.wavelength_nm) == (AWAY_MM, PRIMARY_NM)
    assert requested_state(FILE, Request(depth_mm=inf)).optics.depth_mm == inf
    assert ranges(p2sf.load_lens(FILE)).closest_mm < AWAY_MM


@pytest.mark.parametrize("distance", [2000.0, 500.0, 590.0])
def test_the_sensor_need_not_be_in_focus_for_the_object_of_the_file(distance):
    lens = read("finite_object.zmx", ("DISZ 95\nSURF 1", f"DISZ {distance}\nSURF 1")).lens
    assert object_distance(lens) == lens.object_distance == distance


def test_an_object_at_infinity_is_not_sought_where_the_sensor_seems_in_focus():
    """A paraboloid images infinity without error; paths of 400 mm round to 1e-7 of a wavelength."""
    name = str(FOLDER / "parabola_90.seq")
    assert default_state(name).optics.depth_mm == inf
    assert p2sf.Camera(p2sf.load_lens(name)).at().zernike().rms < 1e-6


def test_a_file_without_an_object_has_it_in_focus():
    """That of a relay is near, and beyond thirty focal lengths the object is at infinity; the report says which."""
    relay = read("finite_object.zmx").lens
    text = lens_to_toml(relay)
    unknown = parse_toml(text.replace("object_distance = 95.0\n", ""), "x.toml")
    assert unknown.object_distance is None
    away = object_distance(unknown)
    assert image_by_hand_mm(away) == pytest.approx(95.0, rel=1e-5)  # the distance is rounded to six digits
    assert object_distance(p2sf.load_lens("double_gauss_28")) == inf
    assert "does not say where its object is" in read("sections.fx").report.text


@pytest.mark.parametrize("ending", ["toml", "zmx", "seq"])
def test_files_keep_the_distance(ending, tmp_path):
    lens = p2sf.load_lens(FILE)
    p2sf.write_lens(lens, tmp_path / f"out.{ending}")
    assert p2sf.load_lens(tmp_path / f"out.{ending}").object_distance == AWAY_MM


def test_an_object_behind_the_lens_is_named():
    found = read("finite_object.zmx", ("DISZ 95\nSURF 1", "DISZ -95\nSURF 1"))
    assert found.lens.object_distance is None
    assert any("-95 mm" in str(note.message) for note in found.report.of("caution"))


@pytest.mark.parametrize("value", ["0", "-3", "nan", "1e17"])
def test_a_distance_that_cannot_be_is_refused(value):
    text = lens_to_toml(p2sf.load_lens(FILE)).replace("object_distance = 95.0", f"object_distance = {value}")
    with pytest.raises(LensFileError, match="object_distance"):
        parse_toml(text, "x.toml")


def test_a_ring_of_focus_takes_the_object_along(tmp_path):
    """Between its columns the vergence is interpolated, so that infinity is a distance as any other."""
    lens = p2sf.load_lens(FILE)
    near, far = (replace(lens, object_distance=away) for away in (200.0, inf))
    ring = Axis("focus", ("∞", "near"), (0.0, 1.0))
    both = with_positions([ring], [far, with_sensor(near, 90.0)])
    assert [object_distance(lens_at(both, focus_position=place)) for place in (0.0, 0.5, 1.0)] == [inf, 400.0, 200.0]
    assert parse_toml(lens_to_toml(both), "x.toml").positions.lenses == both.positions.lenses
    assert set_up(both, Request(focus_position="near")).source.depth_mm == 200.0
