"""Every saved result says what it is of: one record, on every road out of the library."""

import csv
import hashlib
import io
import json
import pickle
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import p2sf
from p2sf.cli import main
from p2sf.database.render import Sampling
from p2sf.io.psf_files import write_psf
from p2sf.io.record import describe
from p2sf.lens.lens import indices
from p2sf.lensfile.library import shipped_lenses
from p2sf.paraxial.first_order import abcd
from p2sf.psf.reading import read_psf
from p2sf.setting import Request, set_up

CAMERA = p2sf.Camera("tessar", focus_mm=1500, f_number=6.7, blades=7)
AT = {"depth_mm": 2100, "field_deg": 4, "wavelength_nm": 546}
STATED = {"depth_mm": 2100, "field_deg": 4.0, "wavelength_nm": 546.0, "focus_mm": 1500.0, "f_number": 6.7}


@pytest.fixture(scope="module")
def psf():
    return CAMERA.at(**AT).psf(pixels=16)


def check(record, psf):
    """Compare a record with what was asked of the camera, and with the samples themselves."""
    setup, own = record["setup"], record["psf"]
    assert {name: setup[name] for name in STATED} == pytest.approx(STATED, rel=1e-12)
    assert setup["mask"]["blades"] == 7 and record["lens"]["name"] == "tessar"
    assert own["window_um"] == pytest.approx([16 * psf.pixel_um] * 2)
    assert (own["method"], own["predicted_error"]) == (psf.method, psf.predicted_error)
    assert own["predicted_error"] is not None and 0.5 < own["energy"] <= 1
    assert record["versions"]["p2sf"] == p2sf.__version__ and "µm" in record["units"].values()
    assert "+y" in record["conventions"]


@pytest.mark.parametrize("ending", ["npz", "tiff", "csv", "nc"])
def test_a_saved_psf_is_read_back_with_all_it_is_of(psf, tmp_path, ending):
    again, meta = p2sf.read_psf(psf.save(tmp_path / f"psf.{ending}"))
    check(meta, psf)
    assert again.record == psf.record
    twice, _ = p2sf.read_psf(again.save(tmp_path / f"twice.{ending}"))
    assert twice.record == psf.record


ELSEWHERE = """
import json, sys
import numpy as np
import p2sf
folder, ending = sys.argv[1:]
p2sf.load_lens = None
psf, meta = p2sf.read_psf(f"{folder}/psf.{ending}")
np.save(f"{folder}/values.npy", psf.values)
print(json.dumps(psf.record))
"""


@pytest.mark.parametrize("ending", ["npz", "tiff", "csv", "fits", "nc"])
def test_a_file_is_understood_in_a_fresh_process_without_the_lens(psf, tmp_path, ending):
    """The same samples, of a TIFF to float32, and the same record; of a lens of which there is no file."""
    if ending == "fits":
        pytest.importorskip("astropy")
    psf.save(tmp_path / f"psf.{ending}")
    command = [sys.executable, "-c", ELSEWHERE, str(tmp_path), ending]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == psf.record
    kept = psf.values.astype(np.float32) if ending == "tiff" else psf.values
    np.testing.assert_array_equal(np.load(tmp_path / "values.npy"), kept)


@pytest.mark.parametrize("fact", [{"mode": "x"}, {"variables": 3.5}, {"fp": "x"}, {"version_byte": 7}, {"run": 2**40}])
def test_facts_of_any_name_and_size_are_kept(psf, tmp_path, fact):
    """As are names that the writer of the format has itself, and whole numbers beyond four bytes."""
    _, meta = read_psf(write_psf(psf, tmp_path / "psf.nc", fact))
    assert fact.items() <= meta.items()


@pytest.mark.parametrize("rings", [0, -1, 2.5, 1001])
@pytest.mark.parametrize("field_deg", [4.0, [0.0, 4.0]])
def test_rings_of_rays_are_a_number_of_rings(rings, field_deg):
    with pytest.raises(p2sf.RequestError, match="rings"):
        CAMERA.at(field_deg=field_deg).rays(rings)


def test_other_programs_find_the_same_samples_and_record(psf, tmp_path):
    """By xarray, astropy and tifffile alone."""
    xarray, tifffile = pytest.importorskip("xarray"), pytest.importorskip("tifffile")
    with xarray.open_dataset(psf.save(tmp_path / "psf.nc"), engine="scipy") as data:
        np.testing.assert_array_equal(data["psf"].values, psf.values)
        np.testing.assert_array_equal(data["x_um"].values, psf.x_um)
        assert data["psf"].dims == ("y_um", "x_um") and data["y_um"].attrs == {"units": "um"}
        assert {name: data.attrs[name] for name in STATED} == pytest.approx(STATED, rel=1e-12)
        assert (data.attrs["lens"], data.attrs["mask_blades"], data.attrs["method"]) == ("tessar", 7, psf.method)
        assert json.loads(data.attrs["p2sf_meta"]) == psf.record
    with tifffile.TiffFile(psf.save(tmp_path / "psf.tiff")) as file:
        np.testing.assert_array_equal(file.asarray(), psf.values.astype(np.float32))
        assert json.loads(file.pages.first.description) == psf.record
    fits = pytest.importorskip("astropy.io.fits")
    with fits.open(psf.save(tmp_path / "psf.fits")) as units:
        np.testing.assert_array_equal(units[0].data, psf.values)
        assert json.loads(units[0].header["P2SFMETA"]) == psf.record


def test_pictures_and_fits_say_the_same(psf, tmp_path):
    from PIL import Image

    with Image.open(psf.save(tmp_path / "psf.png")) as picture:
        assert json.loads(picture.text["Description"]) == psf.record
    pytest.importorskip("astropy")
    again, meta = read_psf(write_psf(psf, tmp_path / "psf.fits", {"state": "{}"}))
    check(meta, psf)
    assert (again.record, meta["state"]) == (psf.record, "{}")


def test_the_hash_is_that_of_the_lens_and_of_no_other(psf, tmp_path):
    """The lens as TOML, with the mask that the camera puts into its stop, is what `write_lens` writes of it."""
    lens = p2sf.with_mask(p2sf.load_lens("tessar"), p2sf.PupilMask(blades=7))
    p2sf.write_lens(lens, tmp_path / "tessar.toml")
    assert (
        psf.provenance["lens"]["sha256_of_toml"] == hashlib.sha256((tmp_path / "tessar.toml").read_bytes()).hexdigest()
    )
    other = p2sf.Camera("cooke_triplet", focus_mm=1500).at(depth_mm=2100).psf("seidel", pixels=8)
    assert other.provenance["lens"]["sha256_of_toml"] != psf.provenance["lens"]["sha256_of_toml"]


def test_the_command_line_writes_the_record_of_the_library(psf, tmp_path, capsys):
    asked = "--depth-mm 2100 --field-deg 4 --wavelength-nm 546 --focus-mm 1500 --f-number 6.7 --blades 7 --pixels 16"
    assert main(["psf", "tessar", *asked.split(), "-o", str(tmp_path / "psf.npz"), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    _, meta = p2sf.read_psf(tmp_path / "psf.npz")
    own, stated = meta.pop("psf"), dict(psf.record)
    assert meta == {name: value for name, value in stated.items() if name != "psf"}
    assert own | {"seconds": 0.0} == stated["psf"] | {"seconds": 0.0}
    assert said["window_um"] == own["window_um"]


def test_a_dataset_of_one_psf_has_its_record_and_its_energy(psf):
    pytest.importorskip("xarray")
    data = psf.to_xarray()
    assert float(data["energy"]) == psf.energy
    assert {name: data.attrs[name] for name in STATED} == pytest.approx(STATED, rel=1e-12)
    assert (data.attrs["lens"], data.attrs["method"], data.attrs["mask_blades"]) == ("tessar", psf.method, 7)
    assert data.attrs["predicted_error"] == psf.predicted_error
    far = CAMERA.at(depth_mm=np.inf).psf("seidel", pixels=8).to_xarray()
    assert far.attrs["depth_mm"] == np.inf
    stack = replace(
        psf.with_figures(energy=np.array([0.5, 0.6]), strehl=None, peak_um=None), values=np.stack([psf.values] * 2)
    )
    assert stack.to_xarray()["energy"].dims == ("axis_0",)


def test_a_dataset_can_be_stored(psf, tmp_path):
    """By any format of xarray: netCDF knows texts and numbers only."""
    xarray = pytest.importorskip("xarray")
    several = CAMERA.at(**AT | {"depth_mm": [1000, np.inf]}).psf(pixels=8).to_xarray()
    for number, data in enumerate((psf.to_xarray(), several)):
        data.to_netcdf(tmp_path / f"{number}.nc", engine="scipy")
        with xarray.open_dataset(tmp_path / f"{number}.nc", engine="scipy") as again:
            assert (again.attrs["lens"], again.attrs["f_number"]) == ("tessar", pytest.approx(6.7))


def test_points_say_what_they_share_and_each_point_the_rest():
    pytest.importorskip("xarray")
    camera = p2sf.Camera("tessar", focus_mm=1500)
    points = camera.at(f_number=[5.6, 8], field_deg=[0, 9], wavelength_nm=546)
    data = points.psf(pixels=8, pixel_um=2.0).to_xarray()
    shared = {"focus_mm": 1500.0, "depth_mm": 1500.0, "wavelength_nm": 546.0}
    assert {name: data.attrs[name] for name in shared} == pytest.approx(shared, rel=1e-12)
    assert data.attrs["lens"] == "tessar" and not {"f_number", "field_deg", "stop_semi_diameter_mm"} & set(data.attrs)
    one = (
        p2sf.Camera("tessar", focus_mm=1500, f_number=8).at(field_deg=9, wavelength_nm=546).psf(pixels=8, pixel_um=2.0)
    )
    there = data.sel(f_number=8, field_deg=9)
    assert (str(there["method"].values), float(there["energy"])) == (one.method, one.energy)
    assert float(there["predicted_error"]) == one.predicted_error
    table = points.mtf([10, 20]).to_dataframe()
    assert table.attrs["lens_sha256_of_toml"] == one.provenance["lens"]["sha256_of_toml"]


def test_a_psf_looked_up_says_in_what(tmp_path):
    made = CAMERA.database("seidel", depths_mm=[1000, np.inf], fields_deg=[0, 4], wavelengths_nm=[500, 600])
    looked_up = made.psf(p2sf.Source(2100, field_deg=4, wavelength_nm=546), pixels=8)
    again, meta = p2sf.read_psf(looked_up.save(tmp_path / "psf.npz"))
    assert {name: meta["setup"][name] for name in STATED} == pytest.approx(STATED, rel=1e-12)
    assert (meta["database"]["interpolant"], meta["lens"]["name"]) == ("exact", "tessar")
    assert again.record == looked_up.record
    file = made.save(tmp_path / "all.npz")
    asked = "--depth-mm 2100 --field-deg 4 --wavelength-nm 546 --pixels 8 --sensor-shift-um 30".split()
    assert main(["psf", str(file), *asked, "-o", str(tmp_path / "moved.npz")]) == 0
    moved = p2sf.read_psf(tmp_path / "moved.npz")[1]["setup"]
    assert moved["sensor_mm"] == pytest.approx(meta["setup"]["sensor_mm"] + 0.03, abs=1e-9)
    assert "focus_mm" not in moved


def test_other_programs_get_the_record_of_a_database(tmp_path):
    from p2sf.export.coefficient_table import write_csv
    from p2sf.export.fits import write_fits
    from p2sf.export.iset import write_iset
    from p2sf.export.psf_cube import open_cube
    from p2sf.export.tiff import write_tiff

    camera = p2sf.Camera("tessar", focus_mm=1500, f_number=6.7, obscuration=0.25)
    made = camera.database("seidel", depths_mm=[1000, np.inf], fields_deg=[0, 4], wavelengths_nm=[500, 600])
    cube = open_cube(made.save(tmp_path / "all.npz"), Sampling(8, 2.0))
    tifffile = pytest.importorskip("tifffile")
    with tifffile.TiffFile(write_tiff(cube, tmp_path / "all.tif")) as file:
        said = [json.loads(file.imagej_metadata["Info"])]
    scipy_io = pytest.importorskip("scipy.io")
    iset = scipy_io.loadmat(write_iset(made, tmp_path / "all.mat"), simplify_cells=True)
    said.append(json.loads(iset["optics"]["rayTrace"]["provenance"]))
    fits = pytest.importorskip("astropy.io.fits")
    with fits.open(write_fits(cube, tmp_path / "all.fits")) as file:
        said.append(json.loads(file[0].header["P2SFMETA"]))
    lines = write_csv(made, tmp_path / "all.csv").read_text(encoding="utf-8").splitlines()
    said.append(json.loads(lines[1].removeprefix("# meta: ")))
    for record in said:
        assert (record["f_number"], record["focus_mm"]) == pytest.approx((6.7, 1500.0), rel=1e-12)
        assert record["lens"]["sha256_of_toml"] == made.meta["lens"]["sha256_of_toml"] and record["mask"] == {
            "obscuration": 0.25
        }


def test_a_wavefront_map_says_what_it_was_given(tmp_path):
    psf = p2sf.psf_of_opd(np.zeros((32, 32)), na=0.1, wavelength_nm=550, pixels=8)
    _, meta = p2sf.read_psf(psf.save(tmp_path / "opd.npz"))
    assert meta["wavefront"] == {"cells": 32, "na": 0.1, "wavelength_nm": 550}
    assert meta["versions"]["p2sf"] == p2sf.__version__


def test_a_psf_of_another_process_keeps_its_record(psf):
    assert pickle.loads(pickle.dumps(psf)).record == psf.record


@pytest.mark.parametrize("name", shipped_lenses())
def test_the_sensor_of_every_lens_lies_where_its_record_says(name):
    """The paraxial image of ``focus_mm`` is on the sensor, to the rounding of a focus a million focal lengths away."""
    setup = set_up(p2sf.load_lens(name), Request(depth_mm=1000.0))
    stated = describe(setup)["setup"]
    # Of an object anywhere, also behind the first vertex, where no source stands: (A + Bs, C + Ds), s = n/distance.
    start = 0.0 if stated["focus_mm"] is None else 1 / stated["focus_mm"]
    um = setup.lens.reference_wavelength_um
    height, angle = abcd(setup.lens, um) @ (1.0, float(indices(setup.lens, um)[0]) * start)
    image = -float(indices(setup.lens, um)[-1]) * height / angle
    assert image == pytest.approx(stated["sensor_mm"], rel=1e-9)
    assert stated["f_number"] > 0


def test_a_file_of_a_psf_is_still_one_table(psf, tmp_path):
    text = psf.save(tmp_path / "psf.csv").read_text(encoding="utf-8")
    rows = list(csv.reader(io.StringIO("".join(x for x in text.splitlines(True) if not x.startswith("#")))))
    assert len(rows) == 17 and {len(row) for row in rows} == {17}


ASKED = "--focus-mm 1500 --f-number 6.7 --blades 7".split()
SOURCE = "--depth-mm 2100 --field-deg 4 --wavelength-nm 546".split()


def csv_record(path):
    return json.loads(path.read_text(encoding="utf-8").splitlines()[0].removeprefix("# meta: "))


def check_camera(record):
    """Compare with what `ASKED` says, word by word."""
    setup = record["setup"]
    assert (setup["focus_mm"], setup["f_number"]) == pytest.approx((1500.0, 6.7), rel=1e-12)
    assert setup["mask"] == {"blades": 7} and record["lens"]["name"] == "tessar"
    assert record["versions"]["p2sf"] == p2sf.__version__


@pytest.mark.parametrize("command", ["spot", "zernike"])
def test_tables_of_rays_say_what_they_are_of(command, tmp_path):
    path = tmp_path / "table.csv"
    assert main([command, "tessar", *ASKED, *SOURCE, "-o", str(path)]) == 0
    record = csv_record(path)
    check_camera(record)
    setup = record["setup"]
    assert (setup["depth_mm"], setup["field_deg"], setup["wavelength_nm"]) == pytest.approx((2100, 4, 546), rel=1e-12)
    rows = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    if command == "spot":
        places = np.array([[float(x) for x in row.split(",")] for row in rows[1:]])
        assert record["spot"]["rays"] - record["spot"]["lost"] == len(places)
    else:
        assert record["zernike"]["basis"] == "noll" and rows[0].startswith("term,n,m")


@pytest.mark.parametrize("ending", [".npz", ".tif", ".fits", ".mat", ".csv"])
def test_a_set_of_psfs_says_what_it_is_of(ending, tmp_path):
    """Its depths, fields and colours stand in its axes, and no single one in the setting."""
    path = tmp_path / f"set{ending}"
    axes = "--depths-mm 1000,inf --fields-deg 0,4 --wavelengths-nm 546 --pixels 9".split()
    assert main(["psf", "tessar", *ASKED, *axes, "-o", str(path)]) == 0
    if ending == ".npz":
        with np.load(path) as found:
            record = json.loads(str(found["meta"]))
    elif ending == ".tif":
        with pytest.importorskip("tifffile").TiffFile(path) as file:
            record = json.loads(file.imagej_metadata["Info"])
    elif ending == ".fits":
        with pytest.importorskip("astropy.io.fits").open(path) as file:
            record = json.loads(file[0].header["P2SFMETA"])
    elif ending == ".mat":
        record = json.loads(str(pytest.importorskip("scipy.io").loadmat(path, simplify_cells=True)["record"]))
    else:
        record = csv_record(path)
    check_camera(record)
    assert not {"depth_mm", "field_deg", "wavelength_nm"} & set(record["setup"])


def test_a_formed_picture_says_what_it_is_of(tmp_path):
    from PIL import Image

    scene, path = tmp_path / "scene.toml", tmp_path / "out.png"
    scene.write_text(
        'name = "wall"\nfocus_mm = 1500\nf_number = 6.7\n[sensor]\nrows = 24\ncolumns = 32\npixel_um = 40\n'
    )
    assert main(["image", "tessar", str(scene), "chart:checkerboard", "-o", str(path)]) == 0
    with Image.open(path) as picture:
        record = json.loads(picture.text["p2sf-record"])
    assert (record["setup"]["focus_mm"], record["setup"]["f_number"]) == pytest.approx((1500.0, 6.7), rel=1e-12)
    assert record["lens"]["name"] == "tessar" and record["scene"] == {
        "file": str(scene),
        "name": "wall",
        "picture": "chart:checkerboard",
    }
