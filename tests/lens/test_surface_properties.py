"""The table of surface properties is complete: a new field of `Surface` fails here until everything knows it."""

from dataclasses import fields, replace
from inspect import isabstract

import numpy as np
import pytest

from p2sf.errors import GeometryError, LensFileError
from p2sf.glass.media import AIR, ConstantIndex
from p2sf.lens.anamorphic import Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag
from p2sf.lens.grating import Grating
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import Aperture, Lens, Surface, indices, scale_surface, seen_from
from p2sf.lens.misalignment import average_azimuths, straighten
from p2sf.lens.placement import Placement
from p2sf.lens.positions import Axis, interpolate_lens, steps_between, with_positions
from p2sf.lens.properties import BY_NAME, CODE_V, EVERY, ISET, PROPERTIES, TOML, ZEMAX, words_of
from p2sf.lens.rim import Rim
from p2sf.lens.shape_types import SHAPES
from p2sf.lens.shapes import Diffraction, Shape
from p2sf.lens.transmission import Transmission
from p2sf.lensfile.formats.codev_writing import lens_to_seq
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.toml.surface import ENTRIES
from p2sf.lensfile.writing import lens_to_iset, lens_to_zmx
from p2sf.paraxial.seidel import check_seidel
from p2sf.raytrace.trace import launch, per_ray, run, trace

PLAIN = Surface(40.0, 4.0, ConstantIndex(1.5), semi_diameter=8.0)
MIXED = (0.0, 0.01, 0.0, 0.02, -0.03, 0.01, 0.02, 0.005)  # mm, of every term of a shape
BY_TERMS = [kind for kind, each in SHAPES.items() if not each.keys]
SHAPE_SAMPLES = {kind: SHAPES[kind].of(MIXED, 8.0) for kind in BY_TERMS if "odd" not in kind} | {
    "odd asphere": SHAPES["odd asphere"].of((0.0, 1e-3, 2e-4, -1e-5), 1.0),
    "extended odd asphere": SHAPES["extended odd asphere"].of((0.0, 0.02, 0.01), 8.0),
    "biconic": Biconic(radius_x=60.0, radius_y=-45.0, conic_x=-2.0, conic_y=0.5, turn_deg=15.0),
    "toroid": Toroid(radius_x=-50.0, radius_y=40.0, conic_y=-0.7, coefficients=(0.0, 2e-5), turn_deg=-70.0),
}
# A value of every property, another than the default: of a new one, state it here.
SAMPLES = {
    "radius": 35.0,
    "thickness": 5.0,
    "medium": ConstantIndex(1.7),
    "conic": -0.6,
    "aspheric": (1e-5, -2e-8),
    "semi_diameter": 6.0,
    "shape": SHAPE_SAMPLES,
    "diffraction": {"diffractive": Diffraction((-250.0, 14.0), 10.0), "grating": Grating(90.0, -2.0, 25.0)},
    "before": (Placement(0.1, -0.2, 0.0, 0.5, 0.3),),
    "after": (Placement(-0.1, 0.2, 0.0, -0.5, -0.3),),
    "inner_radius": 1.0,
    "ideal_focal_length": 50.0,
    "rim": Rim((0.5, 1.0), (4.0, 3.0)),
    "irregularity": Irregularity(3.0, -2.0, 8.0),
    "transmission": Transmission(0.9, -0.004),
}
WAVELENGTH = 0.5875618
WRITERS = {TOML: lens_to_toml, ZEMAX: lens_to_zmx, CODE_V: lens_to_seq, ISET: lens_to_iset}
CASES = [
    *(pytest.param(name, value, id=name) for name, value in SAMPLES.items() if not isinstance(value, dict)),
    *(
        pytest.param(name, one, id=kind)
        for name, kinds in SAMPLES.items()
        if isinstance(kinds, dict)
        for kind, one in kinds.items()
    ),
]
each_case = pytest.mark.parametrize(("name", "value"), CASES)
UNBOUNDED = ("ideal_focal_length", "aspheric")  # inf, and no terms at all, are nothing to interpolate from


def sample(name: str, value: object) -> Surface:
    alone = name == "ideal_focal_length" or isinstance(value, Biconic | Toroid)  # which are whole surfaces
    base = Surface(thickness=4.0, medium=ConstantIndex(1.5), semi_diameter=8.0) if alone else PLAIN
    return replace(base, **{name: value})


def lens_of(surface: Surface) -> Lens:
    """Return a lens whose stop is its second surface, far wider than the rims of its first."""
    return Lens((surface, Surface(-90.0, 60.0)), Aperture("stop_semi_diameter", 25.0), 2)


def test_every_field_is_in_every_table():
    names = {field.name for field in fields(Surface)}
    assert {each.name for each in PROPERTIES} == names == {entry.name for entry in ENTRIES} == set(SAMPLES)


@each_case
def test_the_table_of_surfaces_has_a_column_for_it(name, value):
    from p2sf_explorer.compute.editing import cell_text
    from p2sf_explorer.compute.views.lens_table import COLUMNS

    column = BY_NAME[name].column
    assert column in COLUMNS
    two = replace(sample(name, value), **{name: default(name)}), sample(name, value)
    before, after = ((cell_text(s, column), words_of(s, column)) for s in two)
    assert before != after


def default(name: str) -> object:
    return getattr(PLAIN, name) if name not in ("shape", "before", "after") else getattr(Surface(), name)


@each_case
def test_a_lens_file_in_toml_keeps_it(name, value):
    lens = lens_of(sample(name, value))
    text = lens_to_toml(lens)
    assert parse_toml(text, "lens.toml").surfaces == lens.surfaces
    inches = parse_toml(text.replace('unit = "mm"', 'unit = "in"'), "lens.toml").surfaces[0]
    assert inches == scale_surface(lens.surfaces[0], 25.4) != lens.surfaces[0]


@each_case
@pytest.mark.parametrize("ending", [ZEMAX, CODE_V, ISET])
def test_every_other_format_keeps_it_or_refuses_it(name, value, ending):
    """Where a file is written, its lens has the same rays: a writer that forgets a property fails."""
    lens = lens_of(sample(name, value))
    try:
        text = WRITERS[ending](lens)
    except LensFileError as error:
        assert "surface" in error.message.values and str(error)
        return
    assert ending in BY_NAME[name].endings(value)
    read = import_text(LensText(f"lens{ending}", "utf-8", text), GlassSources()).lens
    assert rays(read) == pytest.approx(rays(lens), rel=1e-10, abs=1e-10, nan_ok=True)


GRID = np.stack([*(axis.ravel() for axis in np.meshgrid(np.linspace(-7, 7, 9), np.linspace(-7, 7, 9))), np.zeros(81)])
GRID[2] = -5.0
WAY = np.array([0.02, 0.05, 1.0])


def rays(lens: Lens, turn: np.ndarray = np.eye(3)) -> np.ndarray:  # noqa: B008
    """Return points, cosines and light of skew rays, turned about the axis, that rims clip; NaN where they are lost."""
    found = trace(lens, (turn @ GRID).T, turn @ WAY, WAVELENGTH, clip=True)
    return np.concatenate([found.points[-1], found.cosines, light(lens, turn)[:, None]], -1)


def light(lens: Lens, turn: np.ndarray = np.eye(3)) -> np.ndarray:  # noqa: B008
    """Return the share of the energy of the same rays, unclipped, that reaches the sensor."""
    index = per_ray(indices(lens, WAVELENGTH))
    beam = run(lens, launch(index[0], WAVELENGTH, turn @ GRID, (turn @ WAY / np.linalg.norm(WAY))[:, None]), index)
    return np.broadcast_to(beam.transmission, beam.x.shape)


def about_the_axis(angle_deg: float) -> np.ndarray:
    cosine, sine = np.cos(np.deg2rad(angle_deg)), np.sin(np.deg2rad(angle_deg))
    return np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1.0]])


@each_case
def test_a_surface_is_bare_exactly_where_it_is_a_plane_that_neither_turns_nor_dims_rays(name, value):
    around = value if name == "medium" else AIR
    surface = Surface(**{"medium": around, name: value})
    lens = replace(lens_of(surface), object_medium=around)
    plain = replace(lens_of(Surface(medium=around)), object_medium=around)
    cosines = (trace(each, GRID.T, WAY, WAVELENGTH).cosines for each in (lens, plain))
    same = np.allclose(*cosines, rtol=0, atol=1e-12, equal_nan=True) and np.all(light(lens) == 1)
    assert surface.bare == (same and not surface.sag(*GRID[:2]).any())


@each_case
def test_a_lens_is_misaligned_exactly_where_turned_rays_are_not_the_rays_turned(name, value):
    lens, turn = lens_of(sample(name, value)), about_the_axis(35.0)
    own, turned = rays(lens), rays(lens, turn)
    own[:, :3], own[:, 3:6] = own[:, :3] @ turn.T, own[:, 3:6] @ turn.T
    assert lens.misaligned != np.allclose(turned, own, rtol=0, atol=1e-11, equal_nan=True)


@each_case
def test_a_lens_shades_exactly_where_light_differs_over_the_pupil(name, value):
    lens = lens_of(sample(name, value))
    assert (lens.shading is not None) == (np.ptp(light(lens)) > 0)


@each_case
def test_paraxial_rays_see_the_mean_over_all_azimuths_without_shading(name, value):
    lens = lens_of(sample(name, value))
    mean = average_azimuths(lens)
    assert np.ptp(light(mean)) == 0
    r, theta = np.linspace(0, 5, 6)[:, None], np.linspace(0, 2 * np.pi, 64, endpoint=False)
    sags = (surface.sag(r * np.sin(theta), r * np.cos(theta)) for surface in (lens.surfaces[0], mean.surfaces[0]))
    own, found = (sag - sag[0] for sag in sags)
    assert found == pytest.approx(np.broadcast_to(own.mean(1, keepdims=True), own.shape), rel=1e-12, abs=1e-14)
    if not BY_NAME[name].unseen(getattr(mean.surfaces[0], name)):
        check_seidel(mean)


@each_case
def test_it_scales_with_the_lens(name, value):
    """Everything three times as large: rays from places three times as large land there, in the same directions."""
    lens = lens_of(sample(name, value))
    if name == "diffraction":  # whose phase stays: its slope is a third, as with three times the wavelength
        pytest.skip("scales with the wavelength too; its TOML units are tested above")
    large = replace(lens, surfaces=tuple(scale_surface(s, 3.0) for s in lens.surfaces))
    origins, ways = np.array([[0.3, 1.0, -2.0], [-1.5, 2.0, -2.0], [2.5, -2.5, -2.0]]), [0.03, -0.02, 1.0]
    one, three = trace(lens, origins, ways, 0.55, clip=True), trace(large, 3 * origins, ways, 0.55, clip=True)
    if name == "irregularity":  # fringes are of one height on every radius
        assert not np.array_equal(three.points, 3 * one.points)
        return
    assert three.points == pytest.approx(3 * one.points, rel=1e-12, abs=1e-12, nan_ok=True)


@each_case
def test_it_turns_with_the_lens(name, value):
    """A lens seen from another azimuth: the rays of the lens itself, turned."""
    lens, angle = lens_of(sample(name, value)), 35.0
    turn = about_the_axis(angle)
    origins, way = np.array([[0.3, 1.0, -2.0], [-3.5, 3.0, -2.0], [4.5, -2.5, -2.0]]), np.array([0.03, -0.02, 1.0])
    own = trace(lens, origins, way, 0.55, clip=True)
    turned = trace(seen_from(lens, angle), origins @ turn.T, turn @ way, 0.55, clip=True)
    assert turned.points[:-1] == pytest.approx(own.points[:-1] @ turn.T, abs=1e-11, nan_ok=True)


@each_case
def test_six_coefficients_know_it_or_refuse_it_or_the_lens_counts_as_misaligned(name, value):
    """What six coefficients do not see changes exact rays; then they refuse, or a warning says what they leave out."""
    lens = lens_of(sample(name, value))
    aligned = straighten(lens)
    assert not aligned.misaligned or name == "rim"
    if lens.misaligned:
        return
    if BY_NAME[name].unseen(value):
        with pytest.raises(GeometryError, match=r"surface 1 .* no six coefficients"):
            check_seidel(lens)
        return
    check_seidel(lens)
    assert aligned == lens


def test_a_shape_that_is_not_of_revolution_is_refused_with_one_sentence():
    for shape in (XYPolynomial((0.0, 0.0, 0.1), 8.0), ZernikeFringeSag((0.0,) * 4 + (0.1,), 8.0)):
        with pytest.raises(GeometryError, match=r"surface 1 has a shape that is not of revolution \(.*\), for which"):
            check_seidel(lens_of(sample("shape", shape)))


@each_case
def test_between_two_columns_of_a_zoom_it_is_interpolated_or_named(name, value):
    low, high = ends = replace(sample(name, value), **{name: default(name)}), sample(name, value)
    zoom = with_positions((Axis("zoom", ("wide", "tele"), (0.0, 1.0)),), tuple(map(lens_of, ends)))
    between = interpolate_lens(zoom.positions, (0.4,))
    found = getattr(between.surfaces[0], name)
    moved = replace(between, positions=replace(zoom.positions, place=(0.4,)))
    named = [message.values["what"] for message in steps_between(moved)]
    if BY_NAME[name].steps:
        assert BY_NAME[name].label in named and found == getattr(low, name)
    elif name not in UNBOUNDED:
        assert not named and found not in (getattr(low, name), getattr(high, name))


def _concrete(base: type) -> list[type]:
    """Return the classes of the program at or below one of which there are objects."""
    own = [base] * (not isabstract(base) and base.__module__.startswith("p2sf"))
    return [*own, *(found for each in base.__subclasses__() for found in _concrete(each))]


def test_every_shape_has_its_type_and_is_known_by_its_kind():
    """A shape without a type in lens files, or whose type makes another, fails."""
    assert {type(shape) for shape in SHAPE_SAMPLES.values()} == set(_concrete(Shape))
    for kind, each in SHAPES.items():
        if each.keys:
            assert each.of().kind == kind and TOML in each.of().endings <= EVERY
            assert {f.name for f in fields(each.of)} == set(each.keys)
            continue
        numbers = (0.01, 0.0, 0.02) if kind == "extended odd asphere" else (0.0, 0.01, 0.0, 0.02)
        shape = each.of(numbers, 1.0 if kind == "odd asphere" else 9.0)
        assert shape.kind == kind
        assert str(shape.name) and str(shape.words) and TOML in shape.endings <= EVERY


@pytest.mark.parametrize("shape", _concrete(Shape))
def test_every_class_of_shapes_states_its_own_words_and_files(shape):
    assert {"kind", "name", "endings"} <= vars(shape).keys()


class Undeclared(XYPolynomial):
    """A shape that inherits all that it does not state."""


class Misdeclared(XYPolynomial):
    """A shape that is in no table of a writer."""

    endings = EVERY


@pytest.mark.parametrize("ending", list(WRITERS))
def test_a_shape_that_states_no_files_is_refused_by_all_of_them(ending):
    with pytest.raises(LensFileError) as refusal:
        WRITERS[ending](lens_of(sample("shape", Undeclared(MIXED, 8.0))))
    assert refusal.value.message.values["surface"] == 1


@pytest.mark.parametrize("ending", [ZEMAX, CODE_V, ISET])
def test_a_shape_that_a_writer_does_not_know_is_refused_whatever_it_states(ending):
    with pytest.raises(LensFileError) as refusal:
        WRITERS[ending](lens_of(sample("shape", Misdeclared(MIXED, 8.0))))
    assert refusal.value.message.values["surface"] == 1
