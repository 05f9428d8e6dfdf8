"""The space and the window in which representations of a lens are compared, and interpolation in it."""

import numpy as np
import pytest

from p2sf.lens.lens import with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.traced import traced_psf
from tests.benchmarks.representations.interpolation import node_weights
from tests.benchmarks.representations.representation import mirror_halves, right_half
from tests.benchmarks.representations.space import DEFOCUS_WAVES, Window, lens_space


@pytest.fixture(scope="module")
def space():
    return lens_space(find_lens("cooke_triplet"))


def test_the_depths_span_the_stated_defocus(space):
    near, far = (
        float(coefficients(space.lens, depth, 0.0, space.lens.reference_wavelength_um).wd)
        for depth in (space.near_mm, np.inf)
    )
    assert abs(near - far) == pytest.approx(DEFOCUS_WAVES, rel=1e-6)


def test_a_lens_for_near_objects_has_depths_about_its_focus():
    space = lens_space(find_lens("relay"))
    waves = [
        float(coefficients(space.lens, d, 0.0, space.lens.reference_wavelength_um).wd)
        for d in (space.near_mm, space.far_mm)
    ]
    assert waves == pytest.approx([-DEFOCUS_WAVES / 2, DEFOCUS_WAVES / 2], abs=1e-6)
    assert space.near_mm < 94.4 < space.far_mm, "its paraxial focus"


def test_a_lens_of_too_steep_a_phase_is_stopped_down():
    lens = find_lens("asphere")
    space = lens_space(lens)
    assert space.lens == with_f_number(lens, space.f_number) and space.f_number > 2


def test_the_window_holds_nearly_all_light_everywhere(space):
    """A circular pupil leaves about 2/(π²·v/π) of the light beyond v = 2·5·0.61π, some 3 %; the blur more inside."""
    points = space.random(6, 3)
    light = [traced_psf(space.lens, source, *space.window.fine).energy for source in points.sources()]
    assert min(light) > 0.97


def test_places_are_even_in_vergence_slope_and_wavelength(space):
    ends = space.at(np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.5, 0.5, 0.5]]))
    assert ends.depth_mm[:2] == pytest.approx([space.near_mm, space.far_mm])
    assert 1 / ends.depth_mm[2] == pytest.approx((1 / space.near_mm + 1 / space.far_mm) / 2)
    assert ends.field_slope.tolist() == pytest.approx([*space.slopes, np.mean(space.slopes)])
    assert ends.wavelength_um.tolist() == pytest.approx([*space.wavelengths_um, np.mean(space.wavelengths_um)])
    assert [s.wavelength_um for s in ends.sources()] == ends.wavelength_um.tolist()


def test_points_at_random_stay_where_nothing_varies():
    space = lens_space(find_lens("eye_navarro"))
    assert space.spread == (True, True, False)
    assert set(space.random(20, 1).wavelength_um) == {0.543}


def test_a_wide_pixel_has_the_light_of_its_samples():
    window = Window(4, 6.0, 3)
    count, pitch = window.fine
    assert pitch == 2.0
    fine = np.random.default_rng(2).random((count, count))
    light = window.light(fine)
    plain = fine[:12, :12].reshape(4, 3, 4, 3).sum((1, 3))
    # The midpoint rule's correction moves light between neighbours, 1/24 of the samples' difference, and loses none.
    assert light.sum() == pytest.approx(1) and light == pytest.approx(plain / plain.sum(), rel=0.15)


def test_an_even_picture_is_its_right_half():
    picture = np.random.default_rng(1).random((3, 8, 8))
    even = (picture + np.roll(picture[..., ::-1], 1, axis=-1)) / 2
    assert right_half(even).shape == (3, 8 * 5)
    np.testing.assert_allclose(mirror_halves(right_half(even), 8)[..., 1:], even[..., 1:])
    assert mirror_halves(right_half(even), 8)[..., 0] == pytest.approx(even[..., 0])


@pytest.mark.parametrize(("rule", "degree"), [("nearest", 0), ("linear", 1), ("cubic", 3)])
def test_a_rule_is_exact_for_its_polynomials(rule, degree):
    counts = (5, 4, 6)
    nodes = np.array([np.linspace(0, 1, n) for n in counts], dtype=object)
    grid = np.stack(np.meshgrid(*nodes, indexing="ij"), -1).reshape(-1, 3).astype(float)
    places = np.random.default_rng(4).random((30, 3))

    def polynomial(at):
        return 1 + 2 * at[:, 0] ** degree - at[:, 1] ** degree * at[:, 2] ** degree

    assert node_weights(counts, rule, places) @ polynomial(grid) == pytest.approx(polynomial(places), abs=1e-12)
    assert node_weights(counts, rule, grid) == pytest.approx(np.eye(len(grid)), abs=1e-12)


def test_the_nearest_node_is_the_nearest():
    weights = node_weights((3, 1, 1), "nearest", np.array([[0.2, 0.9, 0.9], [0.3, 0.0, 0.0], [1.0, 0.5, 0.5]]))
    assert weights.argmax(1).tolist() == [0, 1, 2]


def test_a_source_beyond_the_ends_is_the_end(space):
    assert space.at(np.array([[1.0 + 1e-12, 1.0, 0.0]])).depth_mm[0] <= space.far_mm
    assert isinstance(next(space.random(1, 1).sources()), Source)
