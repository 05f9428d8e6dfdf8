"""Rows of equal frequency: their area, and what they refuse."""

import numpy as np
import pytest

from p2sf.measure.frequency_rows import frequency_rows
from p2sf.psf.fitted import fit
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.zernike import basis, columns, evaluate
from tests.support.reference import cases


@pytest.mark.parametrize("odd", [False, True])
@pytest.mark.parametrize("order", [1, 6, 24])
def test_powers_are_the_same_polynomials(order, odd):
    nodes = disc_nodes(9, 20)
    values = basis(order, nodes.xi, nodes.eta, odd)
    rng = np.random.default_rng(1)
    coefficients = rng.normal(size=len(values)) / (1 + np.arange(len(values))) ** 2
    found = evaluate(columns(coefficients, order, odd), nodes.xi**2, nodes.eta) * (nodes.xi if odd else 1)
    # The powers of degree 24 reach 1e8 and cancel: 1e-16 of that.
    assert np.allclose(found, coefficients @ values, atol=1e-7 if order == 24 else 1e-13)


def test_rows_have_one_frequency_each_and_the_area_of_the_disc():
    lens, source, _, _ = list(cases("double_gauss_28"))[2]
    found = fit(lens, source, 46)
    nodes = frequency_rows(found, 40, 40)
    _, _, fy = found.at(nodes.xi.ravel(), nodes.eta.ravel())
    assert np.max(np.abs(fy.reshape(nodes.xi.shape) - nodes.fy[:, None])) < 1e-9 * found.steepness.spread
    assert nodes.weight.sum() == pytest.approx(1.0, abs=1e-9)  # 40 rows carry the curvature of the map to that
    assert (nodes.weight * nodes.xi**2).sum() == pytest.approx(0.25, abs=1e-9)
    assert (nodes.weight * nodes.eta**2).sum() == pytest.approx(0.25, abs=1e-9)
    assert (nodes.xi**2 + nodes.eta**2).max() < 1


def test_rows_refuse_a_map_that_folds():
    lens, source, _, _ = next(cases("tessar"))
    found = fit(lens, source)
    folded = type(found)(**{**vars(found), "fy": found.fy * 0 + np.eye(len(found.fy))[3]})
    assert frequency_rows(folded, 20, 20) is None
