"""Each representation does what it says: held to the pictures, formulas and derivatives it is made from."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.database.fitted_build import build_fitted
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.pupils import find_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.fitted import fitted_psf, sum_fit
from p2sf.psf.seidel import seidel_psf
from p2sf.pupil.fit import levels
from tests.benchmarks.representations import pictures
from tests.benchmarks.representations.coefficients import coefficient_representations
from tests.benchmarks.representations.fits import _cut, importance
from tests.benchmarks.representations.networks import LEARNING_RATE, gradient_of, outputs_of, started_weights, train
from tests.benchmarks.representations.pictures import (
    best_grids,
    grid_representations,
    pca_representations,
    principal,
    quantise,
    scores_of,
)
from tests.benchmarks.representations.rays import prescription_numbers
from tests.benchmarks.representations.representation import ExactPsfs, traced_picture
from tests.benchmarks.representations.shapes import fitted_shape, shape_values
from tests.benchmarks.representations.space import lens_space
from tests.benchmarks.representations.zernike_grid import pencil_of, wavefront


@pytest.fixture(scope="module")
def space():
    return lens_space(find_lens("reverse_telephoto"), 32)


@pytest.fixture(scope="module")
def exact(space):
    return ExactPsfs(space)


def error(found, wanted):
    return np.linalg.norm(found - wanted, axis=(1, 2)) / np.linalg.norm(wanted, axis=(1, 2))


def test_exact_pictures_are_traced_once(space, exact):
    points = space.random(2, 1)
    first = exact.at(points)
    known = len(exact._pictures)
    assert exact.at(points) is not first and len(exact._pictures) == known and exact.seconds > 0
    assert first[0] == pytest.approx(traced_picture(space, next(points.sources())), abs=1e-7)
    assert first.sum((1, 2)) == pytest.approx(1, abs=1e-5)


def test_databases_of_six_coefficients_look_up_what_is_computed(space):
    points = space.random(4, 2)
    direct = []
    for source in points.sources():
        c = coefficients(space.lens, source.depth_mm, source.field_slope, source.wavelength_um)
        direct.append(space.window.light(seidel_psf(c, *space.window.fine).values))
    made = {one.settings.split(",")[0]: one for one in coefficient_representations(space)}
    # Six Chebyshev terms hold 0.17 µm of a smooth glass to 1e-5 waves or so; nodes are as good as their rule.
    for name, most in (("exact polynomials", 1e-4), ("table1", 0.05), ("linear", 0.05)):
        assert error(made[name].psf(points), np.array(direct)).max() < most
        assert made[name].nbytes == 8 * made[name].numbers


def test_a_database_cut_by_nothing_is_the_fit_itself_and_a_bound_holds_for_more(space):
    """Dropped terms below ε each change the phase by √(their number)·ε RMS at most, a picture by some 4π of that."""
    known = levels(space.lens.aim)[1].numbers
    database = build_fitted(space.lens, space.nodes(2, 2, 2), find_stop(space.lens), 2e-4, known)
    points = space.random(4, 3)
    direct = np.array(
        [
            space.window.light(fitted_psf(space.lens, s, *space.window.fine, numbers=known).values)
            for s in points.sources()
        ]
    )
    sizes = importance(space, database)
    bytes_before = np.inf
    for cut in (1e-5, 1e-3, 1e-2):
        made = _cut(space, database, "fitted 46", cut, 0.0)
        dropped = np.sqrt(np.square(sizes[sizes <= cut]).sum())
        assert error(made.psf(points), direct).max() < 2e-3 + 4 * np.pi * dropped
        assert made.nbytes < bytes_before and made.nbytes < database.series.nbytes
        bytes_before = made.nbytes


def test_a_wavefront_on_an_ellipse_nearly_is_the_lens(space):
    """What is missing are higher orders, the curved map and the uneven light: 2e-2 is their size in such lenses."""
    points = space.random(3, 4)
    for source, wanted in zip(points.sources(), (traced_picture(space, s) for s in points.sources()), strict=True):
        found = pencil_of(wavefront(space, source, 8), 8, source.wavelength_um)
        picture = space.window.light(sum_fit(found, *space.window.fine)[0])
        assert np.linalg.norm(picture - wanted) < 2e-2 * np.linalg.norm(wanted)


@pytest.fixture
def coarse(monkeypatch):
    """Try few nodes along one line, so that few PSFs are traced."""
    monkeypatch.setattr(pictures, "NODES", (1, 2, 3, 5))
    monkeypatch.setattr(pictures, "LINES", pictures.LINES[:1])


def test_a_grid_is_right_at_its_own_nodes_and_keeps_its_budget(space, exact, coarse):
    grids = best_grids(space, exact, 16)
    assert [int(np.prod(counts)) for counts in grids] == sorted({int(np.prod(counts)) for counts in grids})
    nodes = space.grid(grids[-1])
    assert len(nodes) <= 16
    for made in (one for one in grid_representations(space, exact, quick=True) if "nearest" not in one.settings):
        counts = tuple(int(n) for n in made.settings.split(" nodes")[0].split(" × "))
        # The root of a value in steps of 1/127 is off by 1/254 at most, a value by 2·root/254.
        assert error(made.psf(space.grid(counts)), exact.at(space.grid(counts))).max() < 0.02


def test_few_bits_keep_the_root_to_half_a_step():
    drawn = np.random.default_rng(5).standard_normal((3, 16, 16))
    for bits, steps in ((8, 127), (16, 32767)):
        kept, nbytes = quantise(drawn, bits)
        top = np.abs(drawn).max((1, 2), keepdims=True)
        roots = [np.sign(x) * np.sqrt(np.abs(x) / top) for x in (kept, drawn)]
        assert np.abs(roots[0] - roots[1]).max() <= 0.5 / steps + 1e-6
        assert nbytes == 3 * (16 * 9 * bits // 8 + 4)


def test_principal_components_are_those_of_a_singular_value_decomposition():
    drawn = np.random.default_rng(6).random((12, 8, 8))
    flat = drawn.reshape(12, -1)
    wanted = np.linalg.svd(flat - flat.mean(0), full_matrices=False)[2][:4]
    found = principal(drawn, 4)
    assert found[0] == pytest.approx(flat.mean(0).reshape(8, 8))
    overlap = np.abs(found[1:].reshape(4, -1) @ wanted.T)
    assert overlap == pytest.approx(np.eye(4), abs=1e-6)
    scores = scores_of(drawn, principal(drawn, 11))
    assert np.tensordot(scores, principal(drawn, 11)[1:], 1) + flat.mean(0).reshape(8, 8) == pytest.approx(drawn)


def test_more_components_err_less(space, exact, coarse):
    points = space.random(4, 7)
    wanted = exact.at(points)
    [made] = pca_representations(space, exact, quick=True)
    mean = exact.at(space.grid(best_grids(space, exact, 64)[-1])).mean(0)
    assert np.median(error(made.psf(points), wanted)) < np.median(error(np.array([mean] * 4), wanted))


def test_the_gradient_of_a_network_is_that_of_its_loss():
    """Against central differences in double precision, whose error is some h² = 1e-8 of the gradient."""
    generator = np.random.default_rng(8)
    weights = [w.astype(float) for w in started_weights([3, 5, 4, 2], generator)]
    inputs, wanted = generator.random((6, 3)), generator.random((6, 2))
    share = generator.random((6, 1))

    def loss():
        return float((share * (outputs_of(weights, inputs) - wanted) ** 2).sum() / 2)

    for weight, slope in zip(weights, gradient_of(weights, inputs, wanted, share), strict=True):
        for place in np.ndindex(weight.shape):
            kept, sides = weight[place], []
            for step in (1e-4, -1e-4):
                weight[place] = kept + step
                sides.append(loss())
            weight[place] = kept
            assert slope[place] == pytest.approx((sides[0] - sides[1]) / 2e-4, rel=1e-5, abs=1e-8)


def test_the_first_step_of_adam_is_as_long_as_its_rate():
    """Its two means are then the gradient and its square, corrected for their start, whose ratio is a sign."""
    generator = np.random.default_rng(9)
    batch = (generator.random((5, 2)), generator.random((5, 1)), np.ones((5, 1)))
    weights = started_weights([2, 3, 1], generator)
    before = [w.copy() for w in weights]
    slopes = gradient_of(weights, *batch)
    train(weights, iter([batch] * 2), 2)  # half the rate at half the way, nothing at its end
    for one, other, slope in zip(weights, before, slopes, strict=True):
        assert one - other == pytest.approx(-LEARNING_RATE / 2 * np.sign(slope), rel=1e-3)


def test_adam_learns_a_smooth_function():
    """A parabola by eight sines: the mean square error falls a hundred times."""
    generator = np.random.default_rng(9)
    x = np.linspace(-1, 1, 64, dtype=np.float32)[:, None]
    batch = (x, x**2, np.full((64, 1), 1 / 64, np.float32))
    weights = started_weights([1, 8, 1], generator)
    before = np.square(outputs_of(weights, x) - x**2).mean()
    assert np.square(outputs_of(train(weights, iter([batch] * 600), 600), x) - x**2).mean() < 0.01 * before


@pytest.mark.parametrize(
    ("shape", "numbers"),
    [
        ("Gaussian", [np.log(3.0), np.log(5.0), 1.3]),
        ("generalised Gaussian", [np.log(3.0), np.log(4.0), -0.7, np.log(0.7)]),
        ("Moffat", [np.log(3.0), np.log(4.0), 0.4, np.log(2.5)]),
    ],
)
def test_a_shape_is_found_again(shape, numbers):
    picture = shape_values(np.array(numbers), shape, 32)
    assert picture.sum() == pytest.approx(1)
    assert fitted_shape(picture, shape) == pytest.approx(numbers, abs=1e-3)
    rows = picture.sum(1) @ centred_axis(32)
    assert rows == pytest.approx(numbers[2], abs=0.2), "the third number is the centre along y"


def test_a_prescription_is_counted():
    """Six surfaces of three numbers, three glasses of six, and the aperture."""
    lens = find_lens("cooke_triplet")
    glasses = {s.medium for s in lens.surfaces if s.medium.label != "air"}
    assert prescription_numbers(lens) == 3 * len(lens.surfaces) + 6 * len(glasses) + 1
