"""The coefficient database: exact polynomials, the paper's rule, straight lines, and what each loses."""

import numpy as np
import pytest

from p2sf.database.build import build_database
from p2sf.database.departure import departures, largest, scatter
from p2sf.database.exact import LENGTHS, NUMBERS
from p2sf.database.parts import KINDS
from p2sf.database.space import Space
from p2sf.errors import DatabaseError, P2SFError
from p2sf.lens.lens import with_sensor
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.pupils import find_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.spans import depth_nodes
from tests.benchmarks.interpolants import points_in, space_for
from tests.support.lenses.dispersive_lenses import bent_lens, dispersive_lens
from tests.support.lenses.mirrors import aplanatic, mangin, telescope, two_mirrors
from tests.support.reference import LENSES

FIELDS = np.tan(np.deg2rad(np.linspace(0, 14, 21)))
WAVELENGTHS = np.linspace(0.4, 0.7, 31)
# The relay's entrance pupil stands 1.66 m before it, so its sources are between there and the lens.
DEPTHS = {name: depth_nodes(500) for name in LENSES} | {"relay": depth_nodes(150, 400)}


def space_of(name: str) -> Space:
    return Space(DEPTHS[name], FIELDS, WAVELENGTHS)


def random_points(space: Space, count: int, seed: int):
    rng = np.random.default_rng(seed)
    near, far = 1 / space.depths_mm[0], 1 / space.depths_mm[-1]
    with np.errstate(divide="ignore"):
        depth = 1 / rng.uniform(far, near, count)
    return depth, rng.uniform(0, space.field_slopes[-1], count), rng.uniform(0.4, 0.7, count)


@pytest.mark.parametrize("name", LENSES)
def test_exact_is_direct_evaluation_to_round_off(name):
    """1e-11 of the largest coefficient of its kind: the project's promise; 1e-12 waves where a design cancels one."""
    lens, space = dispersive_lens(name), space_of(name)
    database = build_database(lens, space)
    points = random_points(space, 10_000, seed=len(name))
    direct = coefficients(lens, *points)
    lost, top = departures(database.coefficients(*points), direct), largest(direct)
    assert all(lost[kind] <= 1e-11 * top[kind] + 1e-12 for kind in KINDS), lost
    scale = database.coefficients(*points)
    for part in ("reduced_slope", "image_height", "image_index"):
        np.testing.assert_allclose(getattr(scale, part), getattr(direct, part), rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize("lens", [two_mirrors(aplanatic()), mangin(), telescope()], ids=repr)
def test_exact_holds_with_mirrors(lens):
    nodes = depth_nodes(1e4) if lens.aperture.value < 100 else depth_nodes(1e7)
    database = build_database(lens, Space(nodes, np.linspace(0, 0.03, 11), WAVELENGTHS))
    points = points_in(database, count=1000)
    direct = coefficients(lens, *points)
    lost, top = departures(database.coefficients(*points), direct), largest(direct)
    assert all(lost[kind] <= 1e-11 * top[kind] + 1e-12 for kind in KINDS), lost


@pytest.mark.parametrize("name", shipped_lenses())
def test_exact_holds_for_every_shipped_lens_with_its_catalogue_glasses(name):
    """The same promise with real glasses, out to each lens's own widest field."""
    lens = find_lens(name)
    database = build_database(lens, space_for(lens))
    points = points_in(database, count=10_000)
    direct = coefficients(lens, *points)
    lost, top = departures(database.coefficients(*points), direct), largest(direct)
    assert all(lost[kind] <= 1e-11 * top[kind] for kind in KINDS), lost


def test_twenty_one_numbers_and_the_pupils_place_and_the_index_are_all_there_is():
    assert NUMBERS == 21 + 2
    assert [LENGTHS[k] for k in ("w40", "w31", "w22", "petzval", "w11")] == [5, 4, 3, 1, 2]


def test_the_degrees_in_s_are_the_least():
    """Dropping the highest power of any coefficient is seen, so no degree is higher than need be."""
    lens, space = dispersive_lens("double_gauss_28"), space_of("double_gauss_28")
    database = build_database(lens, space)
    top = np.cumsum(list(LENGTHS.values())) - 1
    for last, length in zip(top[:5], list(LENGTHS.values())[:5], strict=True):
        if length > 1:
            assert np.abs(database.series[:, last]).max() > 1e-9


def test_the_sensor_moves_without_a_new_trace():
    lens, space = dispersive_lens("double_gauss_28"), space_of("double_gauss_28")
    moved = build_database(lens, space).with_sensor(lens.sensor_mm + 0.3)
    points = random_points(space, 100, seed=3)
    direct = coefficients(with_sensor(lens, lens.sensor_mm + 0.3), *points)
    found = moved.coefficients(*points)
    np.testing.assert_allclose(found.wd, direct.wd, rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(found.image_height, direct.image_height, rtol=1e-12)


@pytest.mark.parametrize("interpolant", ["exact", "table1", "linear"])
def test_one_point_is_the_same_as_that_point_in_an_array(interpolant):
    database = build_database(dispersive_lens("tessar"), space_of("tessar"), interpolant)
    points = scatter(database.space, 20, getattr(database, "last_depth_mm", np.inf))
    many = database.coefficients(*points)
    for k, point in enumerate(zip(*(x.tolist() for x in points), strict=True)):
        one = database.coefficients(*point)
        for part in (*KINDS, "reduced_slope", "image_height", "image_distance"):
            assert getattr(one, part) == pytest.approx(
                np.broadcast_to(getattr(many, part), 20)[k], rel=1e-12, abs=1e-13
            )


@pytest.mark.parametrize("interpolant", ["exact", "table1", "linear"])
def test_nodes_infinity_included_are_met(interpolant):
    """Every rule passes through its nodes; 1e-9 relative since a node's weight is a quotient of rounded distances."""
    lens, space = dispersive_lens("double_gauss_28"), space_of("double_gauss_28")
    database = build_database(lens, space, interpolant)
    direct = coefficients(lens, *space.axes)
    lost, top = departures(database.coefficients(*space.axes), direct), largest(direct)
    assert all(lost[kind] <= 1e-9 * top[kind] for kind in KINDS), lost


def test_table1_is_exact_where_its_rule_is_the_truth():
    """Field powers 0, 1, 2, 2, 3, 0 are what the rule assumes, so only depth and wavelength can lose anything."""
    lens, space = dispersive_lens("double_gauss_28"), space_of("double_gauss_28")
    database = build_database(lens, space, "table1")
    depth, wavelength = space.depths_mm[3], space.wavelengths_um[7]
    between = (FIELDS[1:] + FIELDS[:-1]) / 2
    direct = coefficients(lens, depth, between, wavelength)
    lost, top = departures(database.coefficients(depth, between, wavelength), direct), largest(direct)
    assert all(lost[kind] <= 1e-12 * top[kind] for kind in KINDS), lost


def test_linear_errors_fall_as_the_square_of_the_step():
    """Straight lines lose f''·step²/8: halving every step divides the error by four (3.5 to 4.5 at these nodes)."""
    lens = dispersive_lens("double_gauss_28")
    coarse, fine = (
        build_database(
            lens, Space(depth_nodes(500, count=n), np.linspace(0, 0.25, n), np.linspace(0.5, 0.6, n)), "linear"
        )
        for n in (11, 21)
    )
    ratio = [lost[0] / lost[1] for lost in zip(*(middles(lens, x) for x in (coarse, fine)), strict=True)]
    assert all(3.5 < value < 4.5 for value in ratio), ratio


def middles(lens, database):
    """Return the largest error of each coefficient over the middles of all cells."""
    near = 1 / database.space.depths_mm
    depth = 2 / (near[1:] + near[:-1])
    slope, wavelength = ((x[1:] + x[:-1]) / 2 for x in (database.space.field_slopes, database.space.wavelengths_um))
    points = (depth[:, None, None], slope[:, None], wavelength)
    return [value for value in departures(database.coefficients(*points), coefficients(lens, *points)).values()]


@pytest.mark.parametrize("interpolant", ["exact", "table1", "linear"])
def test_a_database_carries_its_error(interpolant):
    """The figure is measured at points between the nodes; nowhere is it more than twice as much."""
    lens, space = dispersive_lens("double_gauss_28"), space_of("double_gauss_28")
    database = build_database(lens, space, interpolant)
    points = random_points(space, 2000, seed=5)
    if interpolant == "table1":
        points = (np.minimum(points[0], database.last_depth_mm), *points[1:])
    lost = departures(database.coefficients(*points), coefficients(lens, *points))
    for kind in KINDS:
        assert 0 < database.errors[kind]
        assert lost[kind] < 2 * database.errors[kind] + 1e-11


@pytest.mark.parametrize(
    ("point", "words"),
    [
        ((499.0, 0.1, 0.55), "depth 499 mm is outside this database, which covers 500 to inf mm"),
        (
            (1000.0, 0.3, 0.55),
            "field 16.6992 degrees is outside this database, which covers 0 to 14 degrees; ask inside",
        ),
        ((1000.0, -0.1, 0.55), "ask for 5.71059 degrees, whose PSF is the same upside down"),
        (
            (np.inf, 0.1, np.array([0.5, 0.71])),
            "wavelength 710 nm is outside this database, which covers 400 to 700 nm",
        ),
        ((float("nan"), 0.1, 0.55), "depth nan mm"),
    ],
)
@pytest.mark.parametrize("interpolant", ["exact", "table1", "linear"])
def test_extrapolation_is_refused_with_the_range(interpolant, point, words):
    database = build_database(dispersive_lens("tessar"), space_of("tessar"), interpolant)
    with pytest.raises(DatabaseError, match=words):
        database.coefficients(*point)


def test_table1_refuses_the_gap_before_infinity():
    database = build_database(dispersive_lens("tessar"), space_of("tessar"), "table1")
    beyond = database.last_depth_mm * 1.01
    for depth in (beyond, np.array([600, beyond])):
        with pytest.raises(DatabaseError, match="between the last finite node, 9500 mm, and infinity"):
            database.coefficients(depth, 0.1, 0.55)
    assert np.isfinite(database.coefficients(np.inf, 0.1, 0.55).w40)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"depths_mm": [500, 400]}, "depth nodes must be one or more numbers in ascending order"),
        ({"depths_mm": [-1, 400]}, "depth -1 mm is not in front of the lens"),
        ({"field_slopes": [0, np.inf]}, "field node is not finite"),
        ({"wavelengths_um": []}, "wavelength nodes must be one or more numbers"),
    ],
)
def test_a_bad_space_is_refused(change, words):
    with pytest.raises(DatabaseError, match=words):
        Space(**({"depths_mm": [500], "field_slopes": [0], "wavelengths_um": [0.5]} | change))


def test_a_pupil_among_the_depths_is_refused():
    with pytest.raises(P2SFError, match="lies among the depths, 500 to inf mm; build one database on either side"):
        build_database(dispersive_lens("relay"), Space(depth_nodes(500), [0.0], [0.5]))


def test_glass_with_a_kink_is_refused_by_exact_and_taken_by_linear():
    space = Space(depth_nodes(500), FIELDS, WAVELENGTHS)
    with pytest.raises(DatabaseError, match="the glass data have a kink between the wavelengths asked"):
        build_database(bent_lens("achromat_f6"), space)
    assert build_database(bent_lens("achromat_f6"), space, "linear").errors["wd"] > 0


def test_a_lens_for_near_objects_only_has_an_exact_database():
    """Its polynomials start from a ray of 10 000 waves of defocus, the infinite object's, and round as that does."""
    lens = find_lens("relay")
    space = Space(np.array([93.8, 95.0]), np.array([0.0, 0.002]), np.array([0.4861, 0.6563]))
    database = build_database(lens, space)
    found, direct = (f(94.3, 0.001, 0.55) for f in (database.coefficients, lambda *at: coefficients(lens, *at)))
    assert departures(found, direct)["wd"] < 1e-8


def test_unknown_interpolants_and_moving_stops_are_refused():
    lens, space = dispersive_lens("tessar"), space_of("tessar")
    with pytest.raises(DatabaseError, match='interpolant "cubic" is unknown; choose exact, table1 or linear'):
        build_database(lens, space, "cubic")
    with pytest.raises(DatabaseError, match="a database holds one stop"):
        build_database(lens, space, stop=find_stop(lens, space.depths_mm, mode="auto"))


@pytest.mark.parametrize("interpolant", ["exact", "table1", "linear"])
def test_single_nodes_make_a_database_of_one_point(interpolant):
    lens = dispersive_lens("landscape")
    far = build_database(lens, Space([np.inf], [0.1], [0.55]), interpolant)
    assert far.coefficients(np.inf, 0.1, 0.55).w31 == pytest.approx(
        float(coefficients(lens, np.inf, 0.1, 0.55).w31), rel=1e-12
    )
    database = build_database(lens, Space([800.0], [0.1], [0.55]), interpolant)
    assert database.coefficients(800.0, 0.1, 0.55).w31 == pytest.approx(
        float(coefficients(lens, 800, 0.1, 0.55).w31), rel=1e-12
    )
