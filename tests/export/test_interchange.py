"""Exports, read back by the programs they are for: Octave, astropy, tifffile, a csv reader."""

import csv
import json
import shutil
import subprocess
import sys

import numpy as np
import pytest

from p2sf.cli import main, screen
from p2sf.conventions import slope_from_degrees
from p2sf.database.build import build_database
from p2sf.database.files.npz import save_database
from p2sf.database.files.stack_write import write_stack
from p2sf.database.render import Sampling, rendered_light
from p2sf.database.space import Space
from p2sf.errors import DatabaseError, ExportError
from p2sf.export.coefficient_table import write_csv
from p2sf.export.fits import write_fits
from p2sf.export.iset import IsetOptions, polygon_area, ray_trace, write_iset
from p2sf.export.psf_cube import open_cube, open_database
from p2sf.export.tiff import write_tiff
from p2sf.figures.psf_data import facts
from p2sf.io.fits import FITS
from p2sf.io.psf_files import write_psf
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.reading import read_psf
from p2sf.psf.seidel import seidel_psf
from p2sf.spans import depth_nodes

SAMPLING = Sampling(32, 1.5)


@pytest.fixture(scope="module")
def lens():
    return find_lens("double_gauss_28")


@pytest.fixture(scope="module")
def database(lens):
    space = Space(depth_nodes(20_000, count=3), slope_from_degrees(np.linspace(0, 14, 5)), np.array([0.45, 0.55, 0.65]))
    return build_database(lens, space)


@pytest.fixture(scope="module")
def file(database, lens, tmp_path_factory):
    return save_database(database, lens, tmp_path_factory.mktemp("export") / "gauss.npz")


@pytest.fixture(scope="module")
def cube(file):
    return open_cube(file, SAMPLING)


def test_a_stack_and_a_database_give_the_same_cube(database, lens, cube, tmp_path):
    stack = open_cube(write_stack(database, lens, tmp_path / "a.zarr", SAMPLING).path)
    np.testing.assert_allclose(stack.values, cube.values, rtol=1e-5, atol=1e-9)  # float32 sums in other batches
    assert stack.pixel_um == cube.pixel_um == 1.5
    assert open_database(stack.stored and tmp_path / "a.zarr").meta["lens"] == cube.stored.meta["lens"]


def test_rendering_tells_how_far_it_is_and_can_be_stopped(file):
    """One step for each of 3 depths and 5 fields, and none once what is told raises, as Ctrl+C does."""
    told = []
    open_cube(file, SAMPLING, told.append)
    assert told == pytest.approx(np.arange(1, 16) / 15)

    def stop(share):
        told.append(share)
        raise KeyboardInterrupt

    told.clear()
    with pytest.raises(KeyboardInterrupt):
        open_cube(file, SAMPLING, stop)
    assert told == [pytest.approx(1 / 15)]


def test_an_export_shows_its_progress_in_a_log_too(file, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(screen, "EVERY", 0.0)
    assert main(["export", str(file), "--to", "tiff", "--pixels", "9", "-o", str(tmp_path / "a.tif")]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if "%" in line]
    assert [int(line.split()[0]) for line in lines] == [round(100 * n / 15) for n in range(1, 16)]


def test_csv_has_every_node_and_its_coefficients(file, lens, tmp_path):
    stored = open_database(file)
    lines = write_csv(stored, tmp_path / "a.csv").read_text().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert len(rows) == 3 * 5 * 3
    row = rows[-1]
    assert float(row["depth_mm"]) == np.inf
    direct = coefficients(lens, np.inf, slope_from_degrees(14), 0.65)
    for kind in ("w40", "w31", "w22", "w20", "w11", "wd", "na"):
        assert float(row[kind]) == pytest.approx(float(getattr(direct, kind)), rel=1e-10)
    assert json.loads(lines[1].removeprefix("# meta: "))["lens"]["name"] == "double_gauss_28"


@pytest.mark.filterwarnings("error")
def test_fits_is_verified_by_astropy(cube, lens, tmp_path):
    from astropy.io import fits

    path = write_fits(cube, tmp_path / "a.fits")
    with fits.open(path) as file:
        file.verify("exception")
        head = file[0].header
        assert file[0].data.shape == (3, 5, 3, 32, 32)
        np.testing.assert_array_equal(file[0].data, cube.values)
        assert head["WAVELEN"] == pytest.approx(550e-9)
        assert head["PIXELSCL"] == pytest.approx(1.5e-6)
        assert head["PIXUNIT"] == "meter"
        assert head["OVERSAMP"] == 1
        assert head["DIAM"] == pytest.approx(0.0333, rel=0.01)  # a 100 mm lens at f/3
        assert head["CRPIX2"] == 17
        assert head["AIM"] == lens.aim
        assert file["DEPTH"].data["DEPTH"].tolist() == cube.depths_mm.tolist()
        assert file["WAVELENGTH"].columns["WAVELENGTH"].unit == "nm"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("ending", FITS)
def test_one_psf_goes_to_fits_and_back_exactly_and_astropy_finds_its_axes(lens, tmp_path, ending):
    from astropy.io import fits

    psf = seidel_psf(coefficients(lens, np.inf, 0.2, 0.55), 24, 1.5)
    path = write_psf(psf, tmp_path / f"one{ending}", {"note": "long enough for a second card " * 9})
    again, meta = read_psf(path)
    np.testing.assert_array_equal(again.values, psf.values)
    assert str(again.sampling) == str(psf.sampling)
    assert {**facts(again), "seconds": psf.seconds} == facts(psf)
    assert meta["note"].startswith("long")
    with fits.open(path) as file:
        file.verify("exception")
        head = file[0].header
        assert [head[key] for key in ("CRPIX1", "CRPIX2", "CDELT1", "CUNIT2")] == [13, 13, 1.5, "um"]
    with pytest.raises(ExportError, match=r"none.fits cannot be read"):
        read_psf(tmp_path / "none.fits")
    path.write_bytes(path.read_bytes().replace(b"CONTINUE  '", b"CONTINUE  x", 1))
    with pytest.raises(ExportError, match="is not a PSF that this program wrote"):
        read_psf(path)


def test_fits_without_its_library_says_what_to_install(monkeypatch, cube, tmp_path):
    monkeypatch.setitem(sys.modules, "astropy.io", None)
    for write in (lambda: write_fits(cube, tmp_path / "a.fits"), lambda: read_psf(tmp_path / "a.fits")):
        with pytest.raises(ExportError, match=r"need astropy, which is not installed; pip install 'p2sf\[fits\]'"):
            write()


def test_tiff_is_an_imagej_hyperstack(cube, tmp_path):
    import tifffile

    with tifffile.TiffFile(write_tiff(cube, tmp_path / "a.tif")) as file:
        assert file.is_imagej
        assert len(file.pages) == 45
        np.testing.assert_array_equal(file.asarray(), cube.values)
        metadata = file.imagej_metadata
        assert json.loads(metadata["Info"])["aim"] == cube.stored.meta["aim"]
        assert (metadata["frames"], metadata["slices"], metadata["channels"]) == (3, 5, 3)
        assert metadata["unit"] == "um"
        assert metadata["Labels"][-1] == "depth inf mm, field 14 deg, 650 nm"
        top, bottom = file.pages[0].tags["XResolution"].value
        assert bottom / top == pytest.approx(1.5)


def test_iset_psfs_lie_as_iset_reads_them(file, database):
    """Field along +x, origin at sample N/2 counted from 1, unit sum; our own rendering turned gives the same."""
    fields = ray_trace(open_database(file), IsetOptions(pixels=32, pixel_um=1.5, heights=9))
    psf = fields["psf"]["function"]
    assert psf.shape == (32, 32, 9, 3)
    np.testing.assert_allclose(psf.sum((0, 1)), 1, rtol=1e-12)
    ours = rendered_light(database, (np.inf, database.space.field_slopes[-1], 0.55), Sampling(33, 1.5), np.float64)
    theirs = psf[:, :, -1, 1]
    assert theirs[15, 15] / ours[16, 16] == pytest.approx(theirs[15, 20] / ours[21, 16], rel=1e-9)
    assert theirs[15, 20] != pytest.approx(theirs[20, 15], rel=1e-3)
    np.testing.assert_allclose(theirs[:-1], theirs[-2::-1], rtol=1e-9, atol=1e-15)  # even across the field


def test_iset_geometry_and_light_are_traced(file, lens):
    """Real height differs from the ideal by the distortion; light falls off like cos⁴ at most a little otherwise."""
    fields = ray_trace(open_database(file), IsetOptions(pixels=2))
    ideal, real = fields["psf"]["fieldHeight"][:, 0], fields["geometry"]["function"][:, 1]
    assert ideal[0] == 0
    assert abs(real[0]) < 1e-12
    assert real.shape == (13,)
    third = coefficients(lens, np.inf, slope_from_degrees(7), 0.55)
    moved_mm = float(third.w11 * 0.55 / third.na) / 1000  # W11 ρcosθ is a tilt of W11·λ over NA
    assert abs(real[6] - ideal[6]) == pytest.approx(abs(moved_mm), rel=0.25)
    light = fields["relIllum"]["function"][:, 1]
    assert light[0] == 1
    assert 0.8 * np.cos(np.deg2rad(14)) ** 4 < light[-1] < 1
    assert fields["mag"] <= 0
    assert fields["effectiveFocalLength"] == pytest.approx(100, rel=0.01)
    assert fields["fNumber"] == pytest.approx(3, rel=0.01)
    assert fields["maxfov"] == pytest.approx(14)


def test_the_area_of_a_polygon_is_that_of_a_circle():
    turn = 2 * np.pi * np.arange(400) / 400
    assert polygon_area(np.cos(turn), np.sin(turn)) == pytest.approx(np.pi, rel=1e-4)


OCTAVE = """
pkg_free = load('{path}'); optics = pkg_free.optics; rt = optics.rayTrace;
n = size(rt.psf.function, 1); support = ((-n/2)+1:(n/2)) * rt.psf.sampleSpacing(2);
wide = squeeze(rt.psf.function(:, :, end, 2));
printf('%d ', size(rt.psf.function)); printf('\\n');
printf('%.15g ', max(abs(squeeze(sum(sum(rt.psf.function, 1), 2))(:) - 1))); printf('\\n');
printf('%.15g ', support(n/2)); printf('\\n');
[~, where] = max(squeeze(rt.psf.function(:, :, 1, 2))(:)); [row, column] = ind2sub([n n], where);
printf('%d %d\\n', row, column);
printf('%.15g ', max(max(abs(wide(1:n-1, :) - flipud(wide(1:n-1, :)))))); printf('\\n');
printf('%.15g %.15g %.15g\\n', rt.psf.fieldHeight(1), rt.psf.wavelength(2), rt.mag);
printf('%.15g ', polyfit(rt.geometry.function(:, 2), rt.psf.fieldHeight(:), 8)(end - 1)); printf('\\n');
printf('%s %s %s\\n', optics.model, class(rt.name), class(rt.program));
"""


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("octave"), reason="GNU Octave is not installed: apt-get install octave")
def test_octave_reads_the_iset_file_and_finds_sums_axes_and_centre(file, tmp_path):
    path = write_iset(open_database(file), tmp_path / "rt.mat", IsetOptions(depth_mm=20_000.0, pixels=64, pixel_um=1.5))
    script = tmp_path / "check.m"
    script.write_text(OCTAVE.format(path=path))
    said = subprocess.run(
        ["octave", "--no-gui", "--quiet", "--norc", str(script)],
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    ).stdout.splitlines()
    assert said[0].split() == ["64", "64", "13", "3"]
    assert float(said[1]) < 1e-12
    assert float(said[2]) == 0  # ISET's support puts zero at sample N/2
    assert said[3].split() == ["32", "32"]  # and there the axial PSF has its peak
    assert float(said[4]) < 1e-12
    zero, middle, mag = map(float, said[5].split())
    assert (zero, middle) == (0, pytest.approx(550))
    assert mag == pytest.approx(-100 / 20_000, rel=0.01)
    assert float(said[6]) == pytest.approx(1, abs=0.01)  # ideal over real height near the axis
    assert said[7].split() == ["rayTrace", "char", "char"]


@pytest.mark.parametrize("pixels", [33, 130, 0])
def test_iset_refuses_sizes_it_cannot_read(file, tmp_path, pixels):
    with pytest.raises(ExportError, match="an even number of samples up to 128"):
        write_iset(open_database(file), tmp_path / "rt.mat", IsetOptions(pixels=pixels))


def test_iset_needs_the_axis(lens, tmp_path):
    off = build_database(lens, Space([np.inf], [0.1, 0.2], [0.55]))
    stored = open_database(save_database(off, lens, tmp_path / "off.npz"))
    with pytest.raises(ExportError, match="field heights start at 0"):
        write_iset(stored, tmp_path / "rt.mat")


def test_a_cube_too_large_for_one_file_is_refused_before_any_work(file):
    with pytest.raises(DatabaseError, match="more than the 2 GiB one exported file may have"):
        open_cube(file, Sampling(4096, 1.0))
