"""Polynomials over the disc as sums of powers."""

import numpy as np
import pytest

from p2sf.disc.quadrature import disc_nodes
from p2sf.disc.zernike import basis, columns, evaluate


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
