"""The disc rules are exact to their degree, and their node counts keep SETTLED_TOLERANCE."""

from math import isqrt

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.special import j1

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import (
    MOST_KEPT,
    SETTLED_TOLERANCE,
    cell_areas,
    chord_rows,
    chords_for,
    disc_nodes,
    even_count,
    gauss_legendre,
    grid_rows,
    nodes_for,
)
from p2sf.disc.transform import sum_plane_waves
from p2sf.errors import SamplingError
from p2sf.paraxial.wavefront import steepest_chords, steepest_polar, steepest_slope, wavefront
from p2sf.psf.seidel_sum import intensities
from tests.support.waves import relative_l2, waves

ROUND_OFF = 1e-13


@pytest.mark.parametrize("count", [1, 2, 5, 32, 65])
def test_gauss_legendre_is_numpys_rule(count):
    for ours, theirs in zip(gauss_legendre(count), leggauss(count), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=ROUND_OFF)


def test_a_thousand_gauss_legendre_nodes_integrate_high_powers():
    x, weight = gauss_legendre(1000)
    assert abs((weight * x**50).sum() - 2 / 51) < ROUND_OFF


# Area means over the unit disc of ξ^a η^b, in closed form.
MOMENTS = {(0, 0): 1, (2, 0): 1 / 4, (0, 2): 1 / 4, (4, 0): 1 / 8, (2, 2): 1 / 24, (0, 1): 0, (2, 3): 0, (6, 0): 5 / 64}


@pytest.mark.parametrize(("powers", "mean"), MOMENTS.items(), ids=str)
def test_disc_nodes_are_exact_for_even_polynomials(powers, mean):
    nodes = disc_nodes(4, 16)
    assert abs((nodes.weight * nodes.xi ** powers[0] * nodes.eta ** powers[1]).sum() - mean) < ROUND_OFF


@pytest.mark.parametrize(("powers", "mean"), [(p, m) for p, m in MOMENTS.items() if p[1] % 2 == 0], ids=str)
def test_chord_rows_are_exact_for_even_polynomials(powers, mean):
    rows = chord_rows(12, 12)
    assert abs((rows.weight * rows.xi ** powers[0] * rows.eta[:, None] ** powers[1]).sum() - mean) < ROUND_OFF


def test_the_fold_is_exact_because_every_mirrored_direction_is_a_direction_of_the_rule():
    nodes = disc_nodes(3, 10)
    turns = np.concatenate([np.arctan2(nodes.xi, nodes.eta), np.arctan2(-nodes.xi, nodes.eta)]) / (2 * np.pi / 10)
    np.testing.assert_allclose(turns - np.floor(turns), 0.5, atol=1e-12)
    assert nodes.xi.min() > 0


def test_the_cached_nodes_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        disc_nodes(3, 8).xi[0] = 2


@pytest.mark.parametrize("make", [lambda: disc_nodes(3, 7), lambda: disc_nodes(0, 8), lambda: chord_rows(3, 4)])
def test_counts_that_cannot_be_folded_are_refused(make):
    with pytest.raises(SamplingError, match="even count"):
        make()


def test_an_odd_grid_is_refused():
    with pytest.raises(SamplingError, match="63 samples"):
        grid_rows(63)


def test_cell_areas_add_up_to_the_disc():
    centre = (np.arange(40) - 19.5) * (2.2 / 40)
    area = cell_areas(centre, centre, 2.2 / 40).sum() * (2.2 / 40) ** 2
    # Where the rim cuts a cell's corner, the integrand of the 16 Gauss strips has a corner: 6e-5 of π at this step.
    assert abs(area - np.pi) < 1e-4 * np.pi


def test_a_uniform_grid_converges_at_second_order_only():
    """The mean of exp(i2πkη) is 2J1(v)/v, v = 2πk; halving the step divides the error by about four."""
    v = 2 * np.pi * 3.0
    errors = []
    for size in (64, 256):
        rows = grid_rows(size)
        mean = (rows.weight.sum(1) * np.cos(v * rows.eta)).sum()
        errors.append(abs(mean - 2 * j1(v) / v))
    assert errors[0] > 4 * errors[1] > 0


def random_cases():
    """Wavefronts from 0.3 to 200 waves of slope, windows from far inside the blur to far outside it."""
    rng = np.random.default_rng(4)
    for number in range(16):
        numbers = rng.normal(size=5) * (rng.random(5) < 0.6)
        c = waves(*numbers[:4], wd=numbers[4])
        size = 10 ** rng.uniform(-0.5, 2.0) / max(0.3, float(steepest_slope(c)))
        c = waves(*(numbers[:4] * size), wd=numbers[4] * size)
        reach = 10 ** rng.uniform(-0.3, 1.3) if number % 2 else 0.5 + 1.1 * float(steepest_slope(c))
        yield pytest.param(c, reach, id=f"slope {float(steepest_slope(c)):.1f}, reach {reach:.1f}")
    # Two hundred waves; and astigmatism seen through a keyhole, where only the tails of the harmonics are left.
    yield pytest.param(waves(wd=100.0, w31=30), 12.0, id="200 waves of defocus slope")
    yield pytest.param(waves(w22=50.0, w20=-50), 1.0, id="astigmatism through a keyhole")


def polar(c, reach, radial, angular, pixels=16):
    nodes, axis = disc_nodes(radial, angular), centred_axis(pixels, 2 * reach / pixels)
    pupil = nodes.weight * np.exp(2j * np.pi * wavefront(c, nodes.xi, nodes.eta))
    return np.abs(sum_plane_waves(pupil, nodes.xi, nodes.eta, axis, axis)) ** 2


@pytest.mark.parametrize(("c", "reach"), list(random_cases()))
def test_the_rules_settle_every_psf(c, reach):
    """Against four times as many polar nodes; a tenth of the tolerance, which leaves the rest to other errors."""
    slope, twist = (float(x) for x in steepest_polar(c))
    corner = reach * 2**0.5
    radial, angular = nodes_for(slope, corner, twist)
    finer = polar(c, reach, 2 * radial, 2 * angular)
    assert relative_l2(polar(c, reach, radial, angular), finer) < SETTLED_TOLERANCE / 10
    rows = chord_rows(*chords_for(*steepest_chords(c), corner, reach))
    pixel_um = 2 * reach / 16 / 0.2  # the test coefficients have NA/λ = 0.2 per µm
    assert relative_l2(intensities(c, 16, pixel_um, rows, np.float64), finer) < SETTLED_TOLERANCE / 10


def test_a_quarter_of_the_nodes_would_not_settle():
    """The rule is not merely generous: half the radii or half the directions exceed the tolerance."""
    c = waves(w40=4.0, w31=6, w22=5)
    slope, twist = (float(x) for x in steepest_polar(c))
    radial, angular = nodes_for(slope, 8.0 * 2**0.5, twist)
    finer = polar(c, 8.0, 2 * radial, 2 * angular)
    assert relative_l2(polar(c, 8.0, radial // 2, angular // 4 * 2), finer) > SETTLED_TOLERANCE


@pytest.mark.parametrize("rule", [disc_nodes, chord_rows])
def test_a_rule_is_kept_unless_it_is_large(rule):
    """Tens of large ones would hold a gigabyte."""
    rule.cache_clear()
    assert rule(10, 12) is rule(10, 12)
    large = 2 * (isqrt(MOST_KEPT) // 2 + 1)
    assert rule(large, large) is not rule(large, large)
    assert MOST_KEPT * 24 / 2 * 32 < 1.1e8


@pytest.mark.parametrize("count", [1e30, float("inf"), float("nan")])
def test_counts_that_overflow_are_more_than_is_ever_summed(count):
    assert even_count(count) == 2**41
