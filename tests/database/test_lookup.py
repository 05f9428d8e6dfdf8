"""Arrays of sources are looked up as one source after the other is, and a database opened is saved as it was."""

from math import inf

import numpy as np
import pytest

import p2sf
from p2sf.database import points
from p2sf.database.parts import KINDS
from p2sf.errors import P2SFError
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement

LENS = p2sf.load_lens("double_gauss_28")
NODES = [800.0, 3000.0, inf], [0.0, 7.0, 14.0], [450.0, 550.0, 650.0]
DEPTHS, FIELDS, WAVES = [[900.0], [inf]], [0.0, 3.0, 12.0], 500.0
pytestmark = pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")


@pytest.fixture(scope="module", params=["seidel", "fitted", "linear"])
def database(request):
    how = {"interpolant": request.param} if request.param == "linear" else {"method": request.param}
    return p2sf.build_database(LENS, *NODES, **how)


def sources():
    return [p2sf.Source(depth, field_deg=field, wavelength_nm=WAVES) for (depth,) in DEPTHS for field in FIELDS]


def test_coefficients_of_arrays_are_those_of_each_source(database):
    found = database.coefficients(depth_mm=DEPTHS, field_deg=FIELDS, wavelength_nm=WAVES)
    each = [database.coefficients(source) for source in sources()]
    for name in (*KINDS, "na", "image_height", "wavelength_um"):
        values = getattr(found, name)
        assert values.shape == (2, 3)
        np.testing.assert_allclose(values.ravel(), [getattr(one, name) for one in each], rtol=1e-12, atol=1e-12)


def test_psfs_of_arrays_are_those_of_each_source(database):
    """A relative L2 error of 1e-4 is what each settled sum promises; batches share the nodes of the steepest."""
    found = database.psfs(depth_mm=DEPTHS, field_deg=FIELDS, wavelength_nm=WAVES, pixels=24, pixel_um=2.0)
    assert found.shape == (2, 3, 24, 24) and found.dtype == np.float32
    for values, source in zip(found.reshape(-1, 24, 24), sources(), strict=True):
        one = database.psf(source, 24, 2.0).values
        assert np.linalg.norm(values - one) < 2e-4 * np.linalg.norm(one)


def test_psfs_are_written_where_asked_in_blocks(database, tmp_path, monkeypatch):
    whole = database.psfs(depth_mm=DEPTHS, field_deg=FIELDS, wavelength_nm=WAVES, pixels=16)
    monkeypatch.setattr(points, "AT_ONCE", 1)
    room = np.lib.format.open_memmap(tmp_path / "a.npy", "w+", whole.dtype, whole.shape)
    again = database.psfs(depth_mm=DEPTHS, field_deg=FIELDS, wavelength_nm=WAVES, pixels=16, out=room)
    assert again is room
    np.testing.assert_allclose(np.load(tmp_path / "a.npy"), whole, atol=2e-4 * whole.max())
    assert database.psfs(depth_mm=900, pixels=16).shape == (16, 16)


def test_a_database_says_its_axes(database):
    np.testing.assert_array_equal(database.depths_mm, NODES[0])
    np.testing.assert_allclose(database.fields_deg, NODES[1], rtol=1e-14)
    np.testing.assert_allclose(database.wavelengths_nm, NODES[2], rtol=1e-14)
    assert database.fields_x_deg is None


def test_a_database_is_saved_as_it_is(database, tmp_path):
    again = p2sf.open_database(database.save(tmp_path / "a.npz"))
    assert again.save(tmp_path / "b.npz").read_bytes() == (tmp_path / "a.npz").read_bytes()
    assert again.coefficients(sources()[4]) == database.coefficients(sources()[4])
    with pytest.raises(P2SFError):
        database.save(tmp_path / "a.csv")


@pytest.mark.parametrize(
    "asked",
    [
        {"depth_mm": [700]},
        {"field_deg": [0, 15]},
        {"wavelength_nm": np.nan},
        {"depth_mm": [1000, 2000], "field_deg": [1, 2, 3]},
        {"field_x_deg": [1.0]},
        {"depth_mm": "near"},
    ],
)
def test_what_is_not_covered_is_refused(database, asked):
    for call in (database.coefficients, database.psfs):
        with pytest.raises(P2SFError):
            call(**asked)


def test_a_room_of_another_shape_is_refused(database):
    with pytest.raises(P2SFError):
        database.psfs(depth_mm=[1000, 2000], pixels=16, out=np.empty((2, 16, 15)))


@pytest.mark.slow
def test_fields_of_a_rectangle_have_angles_along_x():
    tilted = displaced(LENS, 1, 2, Placement(tilt_x_deg=0.1))
    database = p2sf.build_database(tilted, 3000, [-2.0, 2.0], [500.0, 600.0], fields_x_deg=[-2.0, 2.0])
    np.testing.assert_allclose(database.fields_x_deg, [-2, 2], rtol=1e-14)
    found = database.psfs(depth_mm=3000, field_deg=[[0.5], [1.0]], field_x_deg=[-1.0, 1.5], pixels=16, pixel_um=3.0)
    source = p2sf.Source(3000, field_deg=(1.5, 1.0), wavelength_nm=600)
    one = database.psf(source, 16, 3.0).values
    assert np.linalg.norm(found[1, 1] - one) < 2e-4 * np.linalg.norm(one)
