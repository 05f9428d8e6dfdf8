"""Databases, stacks and PSFs of older versions are read as they were; each version looked the numbers up itself.

``tests/data/older_versions/write.py`` says which versions these are, and by which commands they wrote the files.
"""

import json

import numpy as np
import pytest

from p2sf.database.files.npz import load_database
from p2sf.database.files.stack import open_stack
from p2sf.database.fitted_build import build_fitted
from p2sf.database.render import database_psf
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.psf.reading import read_psf
from tests.support.reference import DATA

FILES = DATA / "older_versions"
OLDEST = FILES / "0.1"
PLACES = {"0.1": (2000.0, 0.13, 0.55), "0.2.1": (2000.0, 0.02, 0.55), "0.3.0": (2000.0, 0.02, 0.55)}
FITTED = {"0.1": Source(4000.0, 0.05, 0.57), "0.2.1": Source(4000.0, 0.02, 0.57), "0.3.0": Source(4000.0, 0.02, 0.57)}
AIMS = {"0.1": "paraxial", "0.2.1": "stop", "0.3.0": "stop"}  # 0.1 knew no other and does not name it
WITH_PSFS = ("0.2.1", "0.3.0")
STATED = ("strehl", "peak_um", "energy", "predicted_error", "fresnel_number", "pixel_um", "wavelength_um", "method")
each_version = pytest.mark.parametrize("version", PLACES)


def expected(version: str) -> dict:
    """Return what a version told of its own files."""
    told = json.loads((FILES / version / "expected.json").read_text(encoding="utf-8"))
    return told if version in WITH_PSFS else {"looked_up": json.loads((OLDEST / "looked_up.json").read_text("utf-8"))}


@each_version
@pytest.mark.parametrize("interpolant", ["exact", "table1", "linear"])
def test_coefficients_looked_up_are_what_they_were(version, interpolant):
    """Of some ten waves, to the rounding of another order of sums."""
    database = load_database(FILES / version / f"{interpolant}.npz").database
    found = database.coefficients(*PLACES[version])
    for name, value in expected(version)["looked_up"][interpolant].items():
        assert float(getattr(found, name)) == pytest.approx(value, abs=1e-11)


@each_version
def test_a_fitted_psf_looked_up_is_what_it_was(version):
    stored = load_database(FILES / version / "fitted.npz")
    psf = database_psf(stored.database, FITTED[version], 8, 2.0)
    assert np.allclose(psf.values, expected(version)["looked_up"]["fitted"], rtol=0, atol=1e-13)


@each_version
@pytest.mark.parametrize("name", ["exact", "table1", "linear", "fitted"])
def test_the_aim_of_an_old_database_is_the_one_it_was_built_with(version, name):
    stored = load_database(FILES / version / f"{name}.npz")
    assert stored.meta["aim"] == stored.lens.aim == AIMS[version]
    assert f"aim {AIMS[version]}" in repr(stored)


def test_a_fitted_database_is_the_one_that_is_built_today_for_the_paraxial_pupil(glasses_of_version_0_1):
    """To the rounding of another order of sums; for the real stop it is another one, of the same nodes."""
    old = load_database(OLDEST / "fitted.npz")
    again, stop = (build_fitted(with_aim(old.lens, aim), old.database.space).series for aim in ("paraxial", "stop"))
    scale = np.abs(old.database.series).max()
    assert again.shape == old.database.series.shape
    assert np.abs(again - old.database.series).max() <= 1e-9 * scale
    assert stop.shape != again.shape or np.abs(stop - again).max() > 1e-4 * scale


@each_version
def test_a_stack_reads_as_it_did(version):
    stack = open_stack(FILES / version / "stack.zarr")
    assert stack.stored.lens.aim == AIMS[version]
    assert stack.complete
    assert np.array_equal(np.asarray(stack.psf[1, 1, 0]), np.asarray(expected(version)["looked_up"]["stack"]))


@pytest.mark.parametrize("version", WITH_PSFS)
@pytest.mark.parametrize("ending", ["npz", "csv", "tiff"])
def test_a_psf_states_the_figures_that_were_printed(version, ending):
    """Exactly; the samples of a .tiff are float32, of some 0.1."""
    psf, _ = read_psf(FILES / version / f"psf.{ending}")
    told = expected(version)["psf"]
    assert np.allclose(psf.values, told["values"], rtol=0, atol=1e-8 if ending == "tiff" else 0)
    assert {name: getattr(psf, name) for name in told["printed"]} == told["printed"]


@pytest.mark.parametrize("version", WITH_PSFS)
def test_a_snapshot_is_the_same_psf_in_every_format(version):
    """Exactly; the samples of a .tiff are float32, of some 0.1 at most."""
    files = FILES / version
    psf, _ = read_psf(files / "snapshot_moved.npz")
    assert psf.values.tolist() == expected(version)["pictures"]["moved"]["middle"]
    for again, _ in (read_psf(files / f"snapshot_moved.{ending}") for ending in ("csv", "fits")):
        assert np.array_equal(again.values, psf.values)
        assert {name: getattr(again, name) for name in STATED} == {name: getattr(psf, name) for name in STATED}
    single, _ = read_psf(files / "snapshot_moved.tiff")
    assert np.allclose(single.values, psf.values, rtol=0, atol=1e-8)
