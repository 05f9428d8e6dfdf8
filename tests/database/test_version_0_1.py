"""Databases and stacks that version 0.1 wrote are read as they were (written and looked up by that version itself)."""

import json

import numpy as np
import pytest

from p2sf.database.files.npz import load_database
from p2sf.database.files.stack import open_stack
from p2sf.database.fitted_build import build_fitted
from p2sf.database.render import database_psf
from p2sf.lens.lens import with_aim
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


@pytest.mark.parametrize("name", ["exact", "table1", "linear", "fitted"])
def test_without_a_word_on_it_rays_fill_the_paraxial_pupil(name):
    stored = load_database(FILES / f"{name}.npz")
    assert stored.meta["aim"] == stored.lens.aim == "paraxial"
    assert "aim paraxial" in repr(stored)


def test_a_fitted_database_is_the_one_that_is_built_today_for_the_paraxial_pupil(glasses_of_version_0_1):
    """To the rounding of another order of sums; for the real stop it is another one, of the same nodes."""
    old = load_database(FILES / "fitted.npz")
    again, stop = (build_fitted(with_aim(old.lens, aim), old.database.space).series for aim in ("paraxial", "stop"))
    scale = np.abs(old.database.series).max()
    assert again.shape == old.database.series.shape
    assert np.abs(again - old.database.series).max() <= 1e-9 * scale
    assert stop.shape != again.shape or np.abs(stop - again).max() > 1e-4 * scale


def test_a_stack_reads_as_it_did():
    stack = open_stack(FILES / "stack.zarr")
    assert stack.stored.lens.aim == "paraxial"
    assert stack.complete
    assert np.array_equal(np.asarray(stack.psf[1, 1, 0]), np.asarray(LOOKED_UP["stack"]))
