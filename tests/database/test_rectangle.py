"""Databases over depth, field x, field y and wavelength: what is looked up is what rays of the lens itself give."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.conventions import slope_from_degrees
from p2sf.database.build import build_database
from p2sf.database.files.npz import load_database, save_database
from p2sf.database.files.provenance import Stored, provenance
from p2sf.database.files.stack import open_stack, read_psfs
from p2sf.database.files.stack_write import write_stack
from p2sf.database.fitted_build import TOLERANCE_WAVES, build_fitted
from p2sf.database.render import Sampling, database_psf, render_source
from p2sf.database.space import Space
from p2sf.disc.domain import WHOLE
from p2sf.disc.mask import PupilMask
from p2sf.errors import DatabaseError, GeometryError
from p2sf.export.coefficient_table import write_csv
from p2sf.export.psf_cube import open_cube
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.sensor_points import landing_mm
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import render

ACROSS, UP = slope_from_degrees([-5.0, 0.0, 6.0]), slope_from_degrees([-6.0, 0.0, 7.0])
SPACE = Space([5000.0, np.inf], UP, [0.5, 0.6], ACROSS)
SOURCES = [
    Source(np.inf, field_deg=(3.0, -5.0), wavelength_um=0.53),
    Source(8000.0, field_deg=(-4.0, -2.0), wavelength_um=0.58),
    Source(6000.0, field_deg=(5.5, 6.5), wavelength_um=0.5),
    Source(np.inf, 0.0, 0.55),
]
# An RMS phase error σ changes a PSF by some 2πσ relative; the tolerance is 1e-3 waves.
LOOKED_UP = 2 * np.pi * TOLERANCE_WAVES


def distance(found, wanted):
    return np.linalg.norm(found - wanted) / np.linalg.norm(wanted)


@pytest.fixture(scope="module")
def straight():
    return with_f_number(find_lens("double_gauss_28"), 5.6)


@pytest.fixture(scope="module")
def bad(straight):
    return displaced(straight, 3, 5, Placement(0.15, 0.1, 0.02, 0.2, 0.3))


@pytest.fixture(scope="module")
def database(bad):
    return build_fitted(bad, SPACE)


@pytest.mark.parametrize("source", SOURCES)
def test_psfs_looked_up_are_those_of_the_misaligned_lens(straight, bad, database, source):
    """By exact rays of this one source, in its own axes; what the fit leaves adds at most 4πσ (σ: its residual)."""
    looked = database_psf(database, source, 33, 2.0).values
    exact = huygens_psf(bad, source, 33, 2.0).values
    assert distance(looked, exact) <= LOOKED_UP + 4 * np.pi * database.residual_waves
    assert distance(looked, huygens_psf(straight, source, 33, 2.0).values) > 0.05  # it is another lens


def test_the_stated_error_is_within_the_tolerance(database):
    assert 0 < database.errors["phase"] <= TOLERANCE_WAVES
    assert database.series.ndim == 5
    assert database.level.basis.domain == WHOLE


def test_chief_rays_land_where_the_numbers_have_them(bad, database):
    for source in SOURCES:
        assert database.numbers_at(source)[-2:] == pytest.approx(landing_mm(bad, source), abs=1e-4)  # mm: 0.1 µm


def test_a_straight_lens_has_the_psfs_of_its_symmetric_database(straight):
    """Both are within the tolerance of the same fits, whose terms without symmetry have nothing to add."""
    both = build_fitted(straight, SPACE), build_fitted(straight, SPACE.line)
    for source in SOURCES:
        one, other = (database_psf(known, source, 33, 2.0).values for known in both)
        assert distance(one, other) <= 2 * LOOKED_UP


def test_a_mirrored_lens_has_mirrored_psfs(straight, database):
    mirrored = displaced(straight, 3, 5, Placement(-0.15, 0.1, 0.02, 0.2, -0.3))
    other = build_fitted(mirrored, Space(SPACE.depths_mm, UP, SPACE.wavelengths_um, -ACROSS[::-1]))
    for source in SOURCES:
        one = database_psf(database, source, 33, 2.0).values
        two = database_psf(other, replace(source, azimuth_deg=-source.azimuth_deg), 33, 2.0).values
        assert distance(two[:, ::-1], one) <= 2 * LOOKED_UP
        assert distance(two, one) > 10 * LOOKED_UP


def test_a_mask_turns_with_the_field(bad):
    """One vane, whose light shows its direction; the sum through the mask of this source's own rays is the witness."""
    masked = with_mask(bad, PupilMask(obscuration=0.3, vanes=1, vane_width=0.2))
    known = build_fitted(masked, Space([np.inf], UP, [0.55], ACROSS))
    source = Source(np.inf, field_deg=(4.0, 3.0), wavelength_um=0.55)
    looked = database_psf(known, source, 33, 2.0).values
    exact = render(masked, source, "fitted", 33, 2.0).values
    unturned = render(masked, replace(source, azimuth_deg=0.0), "fitted", 33, 2.0).values
    assert distance(looked, exact) <= LOOKED_UP + 4 * np.pi * known.residual_waves
    assert distance(looked, unturned) > 0.1


def test_it_comes_back_from_its_file(bad, database, tmp_path):
    stored = load_database(save_database(database, bad, tmp_path / "bad.npz"))
    assert stored.lens.misaligned
    assert stored.meta["schema"] == 3
    assert stored.meta["nodes"] == [2, 3, 3, 2]
    assert stored.meta["covers"]["field_x_deg"] == pytest.approx([-5, 6])
    assert "depth × field y × field x × wavelength" in repr(stored)
    for source in SOURCES:
        np.testing.assert_array_equal(stored.database.numbers_at(source), database.numbers_at(source))
        assert stored.psf(source, 16).azimuth_deg == source.azimuth_deg


def test_stacks_hold_a_psf_for_every_field(bad, database, tmp_path):
    write_stack(database, bad, tmp_path / "bad.zarr", Sampling(16, 1.0), threads=1)
    stack = open_stack(tmp_path / "bad.zarr")
    assert stack.complete
    psfs = read_psfs(stack, ...)
    assert psfs.shape == (2, 3, 3, 2, 16, 16)
    source = Source(5000.0, field_deg=(6.0, -6.0), wavelength_um=0.6)
    one = database_psf(database, source, 16, 1.0).values
    assert distance(psfs[0, 0, 2, 1], one) <= 1e-4  # the sum's own tolerance
    np.testing.assert_array_equal(render_source(database, SPACE.axes, Sampling(16, 1.0)), psfs)


@pytest.mark.parametrize(
    ("source", "words"),
    [
        (Source(field_deg=(6.5, 0.0), wavelength_um=0.55), "field x 6.5 degrees is outside this database"),
        (Source(field_deg=(0.0, -6.5), wavelength_um=0.55), "field y -6.5 degrees is outside this database"),
        (Source(4000.0, wavelength_um=0.55), "depth 4000 mm is outside this database"),
        (Source(wavelength_um=0.61), "wavelength 610 nm is outside this database"),
    ],
)
def test_extrapolation_is_refused(database, source, words):
    with pytest.raises(DatabaseError, match=words):
        database.numbers_at(source)


def test_a_misaligned_lens_needs_fields_along_both_axes(bad, database, tmp_path):
    with pytest.raises(GeometryError, match="give fields along x as well, or align it"):
        build_fitted(bad, SPACE.line)
    with pytest.raises(
        GeometryError, match="the six coefficients supports only rotational symmetry; build a fitted one"
    ):
        build_database(bad, SPACE.line)
    stored = Stored(database, provenance(database, bad))
    with pytest.raises(DatabaseError, match="one axis of fields"):
        write_csv(stored, tmp_path / "bad.csv")
    with pytest.raises(DatabaseError, match="one axis of fields"):
        open_cube(save_database(database, bad, tmp_path / "bad.npz"))
