"""The table of surface properties is complete: a new field of `Surface` fails here until everything knows it."""

from dataclasses import fields, replace

import numpy as np
import pytest

from p2sf.errors import GeometryError, LensFileError
from p2sf.glass.media import ConstantIndex
from p2sf.lens import (
    Aperture,
    Diffraction,
    Irregularity,
    Lens,
    Placement,
    Rim,
    Surface,
    Transmission,
    XYPolynomial,
    ZernikeFringeSag,
    ZernikeStandardSag,
)
from p2sf.lens.lens import scale_surface, seen_from
from p2sf.lens.misalignment import straighten
from p2sf.lens.positions import Axis, interpolate_lens, steps_between, with_positions
from p2sf.lens.properties import BY_NAME, CODE_V, EVERY, ISET, PROPERTIES, TOML, ZEMAX, words_of
from p2sf.lens.shape_types import SHAPES
from p2sf.lens.shapes import Shape
from p2sf.lensfile.formats.codev_writing import lens_to_seq
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.toml.surface import ENTRIES
from p2sf.lensfile.writing import lens_to_iset, lens_to_zmx
from p2sf.paraxial.seidel import check_seidel
from p2sf.raytrace.trace import trace

PLAIN = Surface(40.0, 4.0, ConstantIndex(1.5), semi_diameter=8.0)
# A value of every property, another than the default: of a new one, state it here.
SAMPLES = {
    "radius": 35.0,
    "thickness": 5.0,
    "medium": ConstantIndex(1.7),
    "conic": -0.6,
    "aspheric": (1e-5, -2e-8),
    "semi_diameter": 6.0,
    "shape": ZernikeStandardSag((0.0, 0.0, 0.0, 0.01, 0.02, -0.03, 0.01, 0.02, 0.005), 8.0),
    "diffraction": Diffraction((-250.0, 14.0), 10.0),
    "before": (Placement(0.1, -0.2, 0.0, 0.5, 0.3),),
    "after": (Placement(-0.1, 0.2, 0.0, -0.5, -0.3),),
    "inner_radius": 1.0,
    "ideal_focal_length": 50.0,
    "rim": Rim((0.5, 1.0), (4.0, 3.0)),
    "irregularity": Irregularity(3.0, -2.0, 8.0),
    "transmission": Transmission(0.9, -0.004),
}
WRITERS = {TOML: lens_to_toml, ZEMAX: lens_to_zmx, CODE_V: lens_to_seq, ISET: lens_to_iset}
NAMES = tuple(SAMPLES)
UNBOUNDED = ("ideal_focal_length", "aspheric")  # inf, and no terms at all, are nothing to interpolate from


def sample(name: str, value: object = None) -> Surface:
    base = Surface(thickness=4.0, medium=ConstantIndex(1.5)) if name == "ideal_focal_length" else PLAIN
    return replace(base, **{name: SAMPLES[name] if value is None else value})


def lens_of(surface: Surface) -> Lens:
    """Return a lens whose stop is its second surface, far wider than the rims of its first."""
    return Lens((surface, Surface(-90.0, 60.0)), Aperture("stop_semi_diameter", 25.0), 2)


def test_every_field_is_in_every_table():
    names = {field.name for field in fields(Surface)}
    assert {each.name for each in PROPERTIES} == names == {entry.name for entry in ENTRIES} == set(SAMPLES)


def test_the_table_of_surfaces_has_a_column_for_every_property():
    from p2sf_explorer.compute.editing import cell_text
    from p2sf_explorer.compute.views.lens_table import COLUMNS

    for name in NAMES:
        column = BY_NAME[name].column
        assert column in COLUMNS, name
        two = replace(sample(name), **{name: default(name)}), sample(name)
        before, after = ((cell_text(s, column), words_of(s, column)) for s in two)
        assert before != after, f"the table does not show {name}"


def default(name: str) -> object:
    return getattr(PLAIN, name) if name not in ("shape", "before", "after") else getattr(Surface(), name)


@pytest.mark.parametrize("name", NAMES)
def test_a_lens_file_in_toml_keeps_it(name):
    lens = lens_of(sample(name))
    text = lens_to_toml(lens)
    assert parse_toml(text, "lens.toml").surfaces == lens.surfaces
    inches = parse_toml(text.replace('unit = "mm"', 'unit = "in"'), "lens.toml").surfaces[0]
    assert inches == scale_surface(lens.surfaces[0], 25.4) != lens.surfaces[0]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("ending", [ZEMAX, CODE_V, ISET])
def test_every_other_format_keeps_it_or_refuses_it(name, ending):
    """Where a file is written, its lens has the same rays: a writer that forgets a property fails."""
    lens = lens_of(sample(name))
    try:
        text = WRITERS[ending](lens)
    except LensFileError as error:
        assert "surface" in error.message.values and str(error)
        return
    assert ending in BY_NAME[name].endings(SAMPLES[name])
    read = import_text(LensText(f"lens{ending}", "utf-8", text), GlassSources()).lens
    assert rays(read) == pytest.approx(rays(lens), rel=1e-10, abs=1e-10, nan_ok=True)


def rays(lens: Lens) -> np.ndarray:
    """Return the last points and cosines of a few skew rays that rims clip, and which of them are lost."""
    x, y = np.meshgrid(np.linspace(-7, 7, 9), np.linspace(-7, 7, 9))
    origins = np.stack([x.ravel(), y.ravel(), np.full(x.size, -5.0)], -1)
    found = trace(lens, origins, [0.02, 0.05, 1.0], 0.5875618, clip=True)
    return np.concatenate([found.points[-1], found.cosines], -1)


@pytest.mark.parametrize("name", NAMES)
def test_it_scales_with_the_lens(name):
    """Everything three times as large: rays from places three times as large land there, in the same directions."""
    lens = lens_of(sample(name))
    if name == "diffraction":  # whose phase stays: its slope is a third, as with three times the wavelength
        pytest.skip("scales with the wavelength too; its TOML units are tested above")
    large = replace(lens, surfaces=tuple(scale_surface(s, 3.0) for s in lens.surfaces))
    origins, ways = np.array([[0.3, 1.0, -2.0], [-1.5, 2.0, -2.0], [2.5, -2.5, -2.0]]), [0.03, -0.02, 1.0]
    one, three = trace(lens, origins, ways, 0.55, clip=True), trace(large, 3 * origins, ways, 0.55, clip=True)
    if name == "irregularity":  # fringes are of one height on every radius
        assert not np.array_equal(three.points, 3 * one.points)
        return
    assert three.points == pytest.approx(3 * one.points, rel=1e-12, abs=1e-12, nan_ok=True)


@pytest.mark.parametrize("name", NAMES)
def test_it_turns_with_the_lens(name):
    """A lens seen from another azimuth: the rays of the lens itself, turned."""
    lens, angle = lens_of(sample(name)), 35.0
    cosine, sine = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    turn = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1.0]])
    origins, way = np.array([[0.3, 1.0, -2.0], [-3.5, 3.0, -2.0], [4.5, -2.5, -2.0]]), np.array([0.03, -0.02, 1.0])
    own = trace(lens, origins, way, 0.55, clip=True)
    turned = trace(seen_from(lens, angle), origins @ turn.T, turn @ way, 0.55, clip=True)
    assert turned.points[:-1] == pytest.approx(own.points[:-1] @ turn.T, abs=1e-11, nan_ok=True)


@pytest.mark.parametrize("name", NAMES)
def test_six_coefficients_know_it_or_refuse_it_or_the_lens_counts_as_misaligned(name):
    """What six coefficients do not see changes exact rays; then they refuse, or a warning says what they leave out."""
    lens = lens_of(sample(name))
    aligned = straighten(lens)
    assert not aligned.misaligned or name == "rim"
    if lens.misaligned:
        return
    if BY_NAME[name].unseen(SAMPLES[name]):
        with pytest.raises(GeometryError, match=r"surface 1 .* no six coefficients"):
            check_seidel(lens)
        return
    check_seidel(lens)
    assert aligned == lens


def test_a_shape_that_is_not_of_revolution_is_refused_with_one_sentence():
    for shape in (XYPolynomial((0.0, 0.0, 0.1), 8.0), ZernikeFringeSag((0.0,) * 4 + (0.1,), 8.0)):
        with pytest.raises(GeometryError, match=r"surface 1 has a shape that is not of revolution \(.*\), for which"):
            check_seidel(lens_of(sample("shape", shape)))


@pytest.mark.parametrize("name", NAMES)
def test_between_two_columns_of_a_zoom_it_is_interpolated_or_named(name):
    low, high = ends = replace(sample(name), **{name: default(name)}), sample(name)
    zoom = with_positions((Axis("zoom", ("wide", "tele"), (0.0, 1.0)),), tuple(map(lens_of, ends)))
    between = interpolate_lens(zoom.positions, (0.4,))
    found = getattr(between.surfaces[0], name)
    moved = replace(between, positions=replace(zoom.positions, place=(0.4,)))
    named = [message.values["what"] for message in steps_between(moved)]
    if BY_NAME[name].steps:
        assert BY_NAME[name].label in named and found == getattr(low, name)
    elif name not in UNBOUNDED:
        assert not named and found not in (getattr(low, name), getattr(high, name))


def test_every_shape_has_its_type_and_is_known_by_its_kind():
    """A shape without a type in lens files, or whose type makes another, fails."""
    assert {type(each.of((0.0, 0.01, 0.0, 0.02), 9.0)) for each in SHAPES.values()} == _concrete(Shape)
    for kind, each in SHAPES.items():
        numbers = (0.01, 0.0, 0.02) if kind == "extended odd asphere" else (0.0, 0.01, 0.0, 0.02)
        shape = each.of(numbers, 1.0 if kind == "odd asphere" else 9.0)
        assert shape.kind == kind
        assert str(shape.name) and str(shape.words) and TOML in shape.endings <= EVERY


def _concrete(base: type) -> set[type]:
    below = base.__subclasses__()
    return {base} if not below else {found for each in below for found in _concrete(each)}
