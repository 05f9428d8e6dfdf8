"""Points over axes say of each what it says alone, bit for bit, with names on the axes."""

import pickle
import warnings
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from math import inf

import numpy as np
import pytest

import p2sf
from p2sf.camera import Camera
from p2sf.conventions import centred_axis
from p2sf.errors import ExportError, P2SFError, P2SFWarning
from p2sf.named_arrays import NamedArrays
from p2sf.object_points import ObjectPoints
from tests.benchmarks import object_points as benchmark

CAMERA = Camera("double_gauss_28", focus_mm=3000, pixel_um=4.0)
DEPTHS, FIELDS, WAVES, STOPS = [2500.0, inf], [0.0, 9.0, 14.0], [450.0, 620.0], [4.0, 8.0]
POINTS = CAMERA.at(wavelength_nm=WAVES, field_deg=FIELDS, depth_mm=DEPTHS, f_number=STOPS)
PLACES = [(n, d, f, w) for n in STOPS for d in DEPTHS for f in FIELDS for w in WAVES]
pytestmark = pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")


def loop(figure, *names, **how) -> list[np.ndarray]:
    """Return attributes of the figures of single points, in a loop over them, each (*shape, …)."""
    found = []
    for stop, depth, field, wave in PLACES:
        source = p2sf.Source(depth, field_deg=field, wavelength_nm=wave)
        found.append(figure(replace(CAMERA, f_number=stop, pixel_um=None).at(source), **how))
    columns = (np.array([getattr(one, name) for one in found]) for name in names)
    return [column.reshape(*POINTS.shape, *column.shape[1:]) for column in columns]


def assert_same(found: NamedArrays, names, expected) -> None:
    for name, values in zip(names, expected, strict=True):
        np.testing.assert_array_equal(found[name], values, err_msg=name)
        assert found.arrays[name][0][:4] == ("f_number", "depth_mm", "field_deg", "wavelength_nm")


def test_axes_stand_in_one_order_whatever_the_call_says():
    assert POINTS.sizes == {"f_number": 2, "depth_mm": 2, "field_deg": 3, "wavelength_nm": 2}
    assert CAMERA.at(depth_mm=3000, field_deg=FIELDS).shape == (3,)
    assert [one.source.depth_mm for one in POINTS.points] == [depth for _, depth, _, _ in PLACES]


@pytest.mark.parametrize("method", ["auto", "traced", "seidel"])
def test_psfs_and_peaks_are_those_of_a_loop(method):
    how = {"pixels": 24, "pixel_um": 4.0, "method": method}
    psf, energy, strehl, peak = loop(ObjectPoints.psf, "values", "energy", "strehl", "peak_um", **how)
    found = POINTS.psf(method, pixels=24)
    assert_same(found, ("psf", "energy"), (psf, energy))
    assert found.arrays["psf"][0][4:] == ("y_um", "x_um")
    np.testing.assert_array_equal(found["x_um"], centred_axis(24, 4.0))
    names = "strehl", "peak_x_um", "peak_y_um", "energy"
    assert_same(POINTS.strehl(method, pixels=24), names, (strehl, peak[..., 0], peak[..., 1], energy))


def test_measures_are_those_of_a_loop():
    names = "tangential", "sagittal", "perfect_tangential", "perfect_sagittal"
    assert_same(POINTS.mtf([20, 50]), names, loop(ObjectPoints.mtf, *names, frequency_per_mm=[20, 50]))
    (one,) = loop(ObjectPoints.mtf, "tangential", frequency_per_mm=50, turn_deg=30.0)
    assert_same(POINTS.mtf(50, turn_deg=30.0), ["tangential"], [one[..., 0]])
    names = "fraction", "radius_50_um", "radius_80_um", "rms_um", "centroid_um"
    found = POINTS.energy([5.0, 20.0])
    assert_same(found, names, loop(ObjectPoints.energy, *names, radius_um=[5.0, 20.0]))
    names = "line_x", "line_y", "edge_x", "edge_y"
    assert_same(POINTS.line_spread([-3.0, 0.0]), names, loop(ObjectPoints.line_spread, *names, position_um=[-3.0, 0.0]))


def test_wavefronts_are_those_of_a_loop():
    names = "waves", "rms_waves", "share", "rms", "residual", "marechal"
    assert_same(POINTS.zernike("fringe", 12), names, loop(ObjectPoints.zernike, *names, basis="fringe", terms=12))
    names = "w40", "w31", "w22", "w20", "w11", "wd", "na"
    assert_same(POINTS.coefficients(), names, loop(ObjectPoints.coefficients, *names))
    names = "method", "predicted_error", "numbers"
    assert_same(POINTS.choose_method(0.9), names, loop(ObjectPoints.choose_method, *names, min_r2=0.9))


def test_first_order_data_are_those_of_rays_traced_by_hand():
    """A ball of index 1.5: f = nR/(2(n − 1)), principal points in its middle; at 2f before that 1:1."""
    ball = p2sf.Lens([p2sf.Surface(10.0, 20.0, 1.5), p2sf.Surface(-10.0, 5.0)], 15.0, 1)
    points = Camera(ball).at(depth_mm=[20.0, inf], wavelength_nm=550)
    found, one = points.first_order(), points.points[0].first_order()
    np.testing.assert_allclose(found["focal_length_mm"], 15, rtol=1e-14)
    np.testing.assert_allclose(found["rear_principal_from_last_mm"], -10, rtol=1e-14)
    np.testing.assert_allclose(found["front_principal_from_first_mm"], 10, rtol=1e-14)
    np.testing.assert_allclose(found["magnification"], [-1, 0], atol=1e-14)
    np.testing.assert_allclose(found["image_from_last_mm"], [20, 5], rtol=1e-13)
    assert one.focal_length_mm == found["focal_length_mm"][0] and one.entrance_pupil_diameter_mm == pytest.approx(1)
    assert one.stop_surface == 1 and one.in_x is None and one.abcd[2] == pytest.approx(-1 / 15)


def test_angles_along_x_are_those_of_a_source():
    found = CAMERA.at(field_x_deg=[0.0, 3.0], field_deg=4.0, wavelength_nm=550).mtf(20)
    one = p2sf.Camera(CAMERA.lens, focus_mm=3000).at(p2sf.Source(3000, field_deg=(3, 4), wavelength_nm=550)).mtf(20)
    assert found["tangential"].shape == (2,) and found["tangential"][1] == one.tangential[0]


def test_without_pixels_all_windows_are_as_wide_as_the_widest():
    found = Camera("double_gauss_28", focus_mm=3000).at(depth_mm=[1000, 3000], wavelength_nm=550).psf(pixels=16)
    source = [p2sf.Source(depth, wavelength_nm=550) for depth in (1000, 3000)]
    own = [p2sf.render(CAMERA.lens, one, pixels=16, focus_mm=3000).pixel_um for one in source]
    assert found["pixel_um"] == max(own)


def test_nothing_is_computed_before_it_is_asked_and_progress_is_told():
    told = []
    points = CAMERA.at(wavelength_nm=WAVES, progress=told.append)
    assert not told and not any("setup" in vars(one) for one in points.points)
    points.coefficients()
    assert told == [0.5, 1.0]


def test_progress_is_shown(capsys):
    CAMERA.at(wavelength_nm=WAVES, progress=True).coefficients()
    assert capsys.readouterr().err.endswith("100%\n")


@pytest.mark.parametrize("threads", [1, 3])
def test_threads_and_executors_change_no_bit(threads):
    axes = {"field_deg": FIELDS, "wavelength_nm": 550.0}
    expected = CAMERA.at(**axes).psf(pixels=16)["psf"]
    assert np.array_equal(CAMERA.at(**axes, threads=threads).psf(pixels=16)["psf"], expected)
    with ThreadPoolExecutor(threads) as pool:
        assert np.array_equal(CAMERA.at(**axes, scheduler=pool).psf(pixels=16)["psf"], expected)


@pytest.mark.slow
def test_a_cluster_changes_no_bit():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(1, threads_per_worker=1, dashboard_address=None) as cluster:
        axes = {"field_deg": FIELDS, "wavelength_nm": 550.0}
        expected = CAMERA.at(**axes).mtf(20)["tangential"]
        for scheduler in (cluster.scheduler_address, distributed.Client(cluster, set_as_default=False)):
            found = CAMERA.at(**axes, scheduler=scheduler).mtf(20)["tangential"]
            assert np.array_equal(found, expected)


def test_points_travel():
    one = POINTS.points[3]
    again = pickle.loads(pickle.dumps(one))
    assert (again.source, again.camera) == (one.source, one.camera)


def test_one_warning_says_which_window_holds_least():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        CAMERA.at(field_deg=FIELDS, wavelength_nm=550).psf(pixels=6)
    assert [(each.category, each.filename) for each in caught] == [(P2SFWarning, __file__)]


@pytest.mark.parametrize(
    "axes",
    [
        {"depth": 3000},
        {"focus_mm": [3000]},
        {"depth_mm": [[1000, 2000]]},
        {"depth_mm": []},
        {"depth_mm": -5},
        {"field_deg": [0, 95]},
        {"wavelength_nm": ["blue"]},
        {"f_number": [2.8, 0]},
    ],
)
def test_what_cannot_be_an_axis_is_refused_at_once(axes):
    with pytest.raises(P2SFError):
        CAMERA.at(**axes)


def test_points_need_a_lens():
    with pytest.raises(P2SFError):
        Camera(f_number=8).at(depth_mm=3000)


def test_named_arrays_are_a_mapping_and_an_array():
    found = POINTS.mtf([20, 50])
    assert list(found) == ["tangential", "sagittal", "perfect_tangential", "perfect_sagittal"] and len(found) == 4
    assert np.array_equal(np.asarray(found), found["tangential"])
    assert found.sizes == POINTS.sizes | {"frequency_per_mm": 2}
    assert "tangential" in repr(found) and "frequency_per_mm" in found._repr_html_()
    with pytest.raises(KeyError):
        found["tangentail"]


def test_a_table_of_pandas_has_a_row_for_every_place():
    pytest.importorskip("pandas")
    found = POINTS.mtf([20, 50])
    table = found.to_dataframe()
    assert table.index.names == ["f_number", "depth_mm", "field_deg", "wavelength_nm", "frequency_per_mm"]
    assert table.loc[(8.0, inf, 9.0, 450.0, 50.0), "sagittal"] == found["sagittal"][1, 1, 1, 0, 1]
    one = CAMERA.at(field_deg=[0.0], wavelength_nm=550).mtf(20).to_dataframe()
    assert len(one) == 1 and one["wavelength_nm"].iloc[0] == 550
    terms = POINTS.zernike(terms=4).to_dataframe()
    assert list(terms["name"][:4]) == ["piston", "tilt", "tilt", "defocus"]


def test_a_dataset_of_xarray_has_coordinates_and_units():
    pytest.importorskip("xarray")
    found = POINTS.psf(pixels=8)
    data = found.to_xarray()
    assert data["psf"].dims == ("f_number", "depth_mm", "field_deg", "wavelength_nm", "y_um", "x_um")
    near = data["psf"].sel(f_number=8.0, depth_mm=2500.0, field_deg=9.0, wavelength_nm=620.0)
    assert np.array_equal(near.values, found["psf"][1, 0, 1, 1])
    assert data["depth_mm"].attrs == {"units": "mm"} and data["energy"].dims == tuple(POINTS.sizes)


def test_psfs_and_databases_are_datasets_too():
    pytest.importorskip("xarray")
    one = CAMERA.at(depth_mm=3000, field_deg=9, wavelength_nm=550).psf(pixels=9)
    data = one.to_xarray()
    assert data["psf"].dims == ("y_um", "x_um") and float(data["psf"].sel(x_um=0, y_um=4)) == one.values[5, 4]
    assert (float(data["wavelength_nm"]), data["pixel_um"].attrs) == (pytest.approx(550), {"units": "um"})
    both = replace(one, values=np.stack([one.values] * 2), wavelength_um=np.array([0.5, 0.6])).to_xarray()
    assert both["wavelength_nm"].dims == ("axis_0",) and both["psf"].shape == (2, 9, 9)
    both = CAMERA.at(depth_mm=3000, field_deg=[0, 9], wavelength_nm=550).psf(pixels=9).to_xarray()
    np.testing.assert_array_equal(both["psf"].sel(field_deg=9), one.values)
    database = CAMERA.database(depths_mm=[2000, inf], fields_deg=[0, 5, 9], wavelengths_nm=[500, 600])
    table = database.to_xarray()
    assert dict(table.sizes) == {"depth_mm": 2, "field_deg": 3, "wavelength_nm": 2}
    six = database.coefficients(p2sf.Source(2000, field_deg=5, wavelength_nm=600))
    assert float(table["w31"].sel(depth_mm=2000).isel(field_deg=1, wavelength_nm=1)) == pytest.approx(
        six.w31, rel=1e-12
    )
    assert table["w31"].attrs == {"units": "waves"} and table.attrs["lens"] == "double_gauss_28"


def test_rows_from_the_top_are_those_of_pictures():
    one = CAMERA.at(depth_mm=3000, field_deg=14, wavelength_nm=550).psf(pixels=9)
    assert np.array_equal(one.flipud()[0], one.values[-1]) and np.array_equal(one.flipud(), np.flipud(one))


def test_a_missing_library_is_named(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(ExportError):
        POINTS.coefficients().to_xarray()


def test_the_benchmark_finds_the_same_bits():
    axes = {"depth_mm": np.array([3000.0]), "field_deg": np.array([0.0, 9.0]), "wavelength_nm": np.array([550.0])}
    assert benchmark.main(axes, rounds=1) > 0


def test_points_say_how_many_there_are_along_each_axis():
    camera = Camera("achromat_f6")
    assert repr(camera.at()) == f"<ObjectPoints of {camera.its_lens.name}: one point>"
    assert repr(camera.at(f_number=[8.0, 11.0], field_deg=[0.0, 1.0, 2.0])).endswith(": f_number 2 × field_deg 3>")
