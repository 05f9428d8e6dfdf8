"""Databases and stacks that version 0.1 wrote are read as they were (written and looked up by that version itself)."""

import json

import numpy as np
import pytest

from p2sf.database.render import database_psf
from p2sf.database_files import load_database
from p2sf.database_files.stack import open_stack
from p2sf.lens.source import Source
from tests.support.reference import DATA

FILES = DATA / "version_0_1"
LOOKED_UP = json.loads((FILES / "looked_up.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("interpolant", ["exact", "table1", "linear"])
def test_coefficients_looked_up_are_what_they_were(interpolant):
    """Of some ten waves, to the rounding of another order of sums."""
    found = load_database(FILES / f"{interpolant}.npz").database.coefficients(2000.0, 0.13, 0.55)
    for name, value in LOOKED_UP[interpolant].items():
        assert float(getattr(found, name)) == pytest.approx(value, abs=1e-11)


def test_a_fitted_psf_looked_up_is_what_it_was():
    psf = database_psf(load_database(FILES / "fitted.npz").database, Source(4000.0, 0.05, 0.57), 8, 2.0)
    assert np.allclose(psf.values, LOOKED_UP["fitted"], rtol=0, atol=1e-13)


def test_a_stack_reads_as_it_did():
    stack = open_stack(FILES / "stack.zarr")
    assert stack.complete
    assert np.array_equal(np.asarray(stack.psf[1, 1, 0]), np.asarray(LOOKED_UP["stack"]))
