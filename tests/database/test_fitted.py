"""The fitted method as a database: looked up equals fitted, to the error it states."""

import numpy as np
import pytest

from p2sf.database.departure import departures
from p2sf.database.files.npz import load_database, save_database
from p2sf.database.fitted import FieldLine, powers, split
from p2sf.database.fitted_build import TOLERANCE_WAVES, build_fitted, held_out, ray_error
from p2sf.database.render import Sampling, database_psf, render_source
from p2sf.database.space import Space
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import DatabaseError
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.pupils import find_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.fitted import fitted_intensity, fitted_psf, sum_fit
from p2sf.pupil.fit import LEVELS, fit, levels
from p2sf.raytrace.pencil import pencil
from p2sf.spans import depth_nodes
from tests.support.waves import relative_l2

SPACE = Space(depth_nodes(3000), np.tan(np.deg2rad(np.linspace(0, 14, 5))), np.linspace(0.5, 0.6, 5))
SOURCES = [Source(4000.0, 0.2, 0.53), Source(np.inf, 0.0, 0.58), Source(9000.0, 0.11, 0.51)]


@pytest.fixture(scope="module")
def lens():
    return find_lens("double_gauss_28")


@pytest.fixture(scope="module")
def database(lens):
    return build_fitted(lens, SPACE)


def test_the_stated_error_is_below_the_tolerance_and_holds_elsewhere(lens, database):
    """The points held out set the node counts; 12 others, of another space inside, may lose twice as much."""
    assert 0 < database.errors["phase"] <= TOLERANCE_WAVES
    inside = Space(depth_nodes(3500), SPACE.field_slopes[:-1], SPACE.wavelengths_um[1:])
    for point in held_out(lens, inside, database.level, find_stop(lens)):
        assert ray_error(database, *point) <= 2 * TOLERANCE_WAVES


@pytest.mark.parametrize("source", SOURCES)
def test_psfs_looked_up_are_those_fitted(lens, database, source):
    """An RMS phase error σ changes a PSF by some 2πσ relative: 0.6 % at the tolerance, far less found."""
    looked = database_psf(database, source, 48, 2.0)
    direct = fitted_psf(lens, source, 48, 2.0, database.level.numbers)
    assert np.linalg.norm(looked.values - direct.values) <= 6e-3 * np.linalg.norm(direct.values)
    assert looked.method == "fitted"
    assert looked.rays == 0
    assert looked.numbers == database.level.numbers


def test_a_fit_has_the_numbers_asked_for(lens):
    few = Space(SPACE.depths_mm[:1], SPACE.field_slopes[[0, -1]], SPACE.wavelengths_um[:1])
    for level in levels(lens.aim)[:2]:
        assert build_fitted(lens, few, numbers=level.numbers).level == level


def test_the_chief_rays_height_is_the_traced_one(lens, database):
    for source in SOURCES:
        height = split(database.level, database.numbers_at(source))[-1]
        traced = pencil(lens, source, np.zeros(1), np.zeros(1)).chief_y.item()
        assert height == pytest.approx(traced, abs=1e-5)  # mm; a hundredth of a pixel


def test_numbers_are_even_or_odd_in_the_field_as_their_polynomials_are(lens):
    """The parity that the database is built on: a fit at −h has the same numbers, the odd ones negated."""
    above, below = (fit(lens, Source(5000.0, slope, 0.55), LEVELS[1].numbers) for slope in (0.15, -0.15))
    signs = np.sign(powers(above.level, Source(5000.0, -0.15, 0.55), FieldLine()))
    one_by_one = (one.level.coefficients(one.function)[:3] for one in (above, below))
    for one, other, sign in zip(*one_by_one, split(above.level, signs)[:3], strict=True):
        other = other * sign
        np.testing.assert_allclose(one, other, atol=1e-7 * np.abs(one).max())


def test_the_seidel_numbers_are_there_too(lens, database):
    point = (4000.0, 0.2, 0.53)
    assert departures(database.coefficients(*point), coefficients(lens, *point))["w40"] < 1e-10


def test_a_fitted_database_comes_back_from_its_file(lens, database, tmp_path):
    stored = load_database(save_database(database, lens, tmp_path / "fitted.npz"))
    assert stored.meta["method"] == "fitted"
    assert stored.database.errors == database.errors
    for source in SOURCES:
        np.testing.assert_allclose(stored.database.numbers_at(source), database.numbers_at(source), atol=1e-12)


def test_stacks_are_rendered_from_it(database):
    psfs = render_source(database, SPACE.axes, Sampling(16, 2.0))
    assert psfs.shape == (20, 5, 5, 16, 16)
    np.testing.assert_allclose(psfs.sum((-2, -1)), 1, atol=1e-5)
    one = database.psf(Source(np.inf, float(SPACE.field_slopes[2]), 0.55), 16, 2.0).values
    assert np.linalg.norm(psfs[-1, 2, 2] - one) <= 1e-4 * np.linalg.norm(one)


def test_extrapolation_is_refused(database):
    for source in (Source(2000.0, 0.1, 0.55), Source(4000.0, 0.4, 0.55), Source(4000.0, 0.1, 0.4)):
        with pytest.raises(DatabaseError, match="is outside this database"):
            database.numbers_at(source)


def test_a_single_point_needs_a_single_fit(lens):
    one = build_fitted(lens, Space([5000.0], [0.1], [0.55]))
    assert one.series.shape[:3] == (1, 1, 1)
    assert one.level in levels(lens.aim)
    assert one.errors["phase"] < 1e-9


def test_a_database_of_the_real_stop_knows_the_weights_of_its_rays(lens, tmp_path):
    """Weights are even in h, or odd with η, as the phase is; saved and loaded they are the same numbers."""
    lens = with_aim(lens, "stop")
    database = build_fitted(lens, Space(depth_nodes(3000), SPACE.field_slopes[:4], SPACE.wavelengths_um[1:3]))
    assert database.level.weighted
    path = save_database(database, lens, tmp_path / "stop.npz")
    for source in (Source(4000.0, 0.15, 0.53), Source(np.inf, 0.11, 0.54)):
        direct = fit(lens, source, database.level.numbers)
        for known in (database, load_database(path).database):
            found = known.fit_at(source)
            # Between its nodes the map's numbers are as good as the phase: 1e-3 waves of some hundreds.
            np.testing.assert_allclose((found.function - direct.function).values[-1], 0, atol=1e-5)
            assert (
                relative_l2(
                    database_psf(known, source, 32, 2.0).values,
                    fitted_psf(lens, source, 32, 2.0, database.level.numbers).values,
                )
                <= 6e-3
            )


@pytest.mark.parametrize("source", [Source(3000.0, 0.2, 0.53), Source(np.inf, 0.24, 0.5), Source(4000.0, 0.0, 0.6)])
def test_the_settled_sum_of_what_is_looked_up_is_settled(database, source):
    """Against the plain sum over many nodes; the rows are chosen by the steepness of the looked-up polynomials."""
    found, (pixels, pixel_um) = database.fit_at(source), (48, 2.0)
    settled, _ = sum_fit(found, pixels, pixel_um)
    dense = fitted_intensity(found, (300, 800), pixels, pixel_um)
    assert np.linalg.norm(settled - dense) <= SETTLED_TOLERANCE * np.linalg.norm(dense)
