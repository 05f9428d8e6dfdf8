"""An exported file carries its facts, is read back as it was written, and is written whole or not at all."""

import errno
import json
import os
import subprocess
import sys
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest

from p2sf.errors import ExportError
from p2sf.figures.psf_data import PsfFigures, facts
from p2sf.files.writing import check_place, plain, write_beside, write_json
from p2sf.io import psf_plot
from p2sf.io.psf_files import write_psf
from p2sf.io.psf_plot import edges_um, round_length
from p2sf.messages import Message
from p2sf.psf.reading import psf_from, read_psf
from p2sf.psf.result import Psf

META = {"lens": {"name": "made_up"}, "setup": {"depth_mm": np.inf, "field_deg": 14.0}}


def blob(rows=24, columns=17) -> Psf:
    """Return a lopsided spot, so that a flip or a transposition shows."""
    y, x = np.mgrid[:rows, :columns]
    values = np.exp(-((y - 15) ** 2) / 9 - ((x - 5) ** 2) / 4)
    return Psf(
        values / values.sum(),
        0.69125,
        0.6562725,
        "seidel",
        PsfFigures(strehl=0.37, energy=0.99, predicted_error=2.5e-3),
        numbers=6,
        sampling=Message("test"),
    )


@pytest.mark.parametrize(("ending", "tolerance"), [("npz", 0), ("csv", 0), ("tiff", 6e-8), ("tif", 6e-8)])
def test_what_is_written_is_read_back(tmp_path, ending, tolerance):
    psf = blob()
    back, meta = read_psf(write_psf(psf, tmp_path / f"spot.{ending}", META))
    np.testing.assert_allclose(back.values, psf.values, rtol=tolerance)  # float32 rounds to 2^-24 = 6e-8
    assert (back.pixel_um, back.method, back.strehl, back.error) == (psf.pixel_um, "seidel", 0.37, None)
    assert back.predicted_error == 2.5e-3
    assert back.sampling == psf.sampling and meta["psf"]["sampling"] == "test"
    assert meta["setup"] == {"depth_mm": None, "field_deg": 14.0}
    assert os.listdir(tmp_path) == [f"spot.{ending}"]


def test_a_file_from_before_errors_were_predicted_is_read():
    known = facts(blob())
    del known["predicted_error"]
    assert psf_from(blob().values, known).predicted_error is None


def test_npz_has_the_four_keys_and_the_axes(tmp_path):
    psf = blob()
    with np.load(write_psf(psf, tmp_path / "a.npz", META)) as file:
        assert sorted(file) == ["meta", "psf", "x_um", "y_um"]
        assert (file["x_um"].tolist(), file["y_um"].tolist()) == (psf.x_um.tolist(), psf.y_um.tolist())
        assert file["x_um"][17 // 2] == file["y_um"][24 // 2] == 0


def test_tiff_carries_float32_pitch_and_which_way_is_up(tmp_path):
    import tifffile

    psf = blob()
    with tifffile.TiffFile(write_psf(psf, tmp_path / "a.tiff", META)) as file:
        page = file.pages[0]
        assert page.dtype == np.float32
        pixels, cm = page.tags["XResolution"].value
        assert 1e4 * cm / pixels == pytest.approx(psf.pixel_um, rel=1e-6)  # TIFF keeps a ratio of 32-bit integers
        assert page.tags["ResolutionUnit"].value == 3  # centimetres
        assert page.tags["Orientation"].value == 4  # row 0 is the bottom, as +y is up


def test_csv_is_readable_by_a_plain_table_reader(tmp_path):
    psf = blob()
    table = np.genfromtxt(write_psf(psf, tmp_path / "a.csv", META), delimiter=",", comments="#", skip_header=4)
    np.testing.assert_array_equal(table[:, 0], psf.y_um)
    np.testing.assert_array_equal(table[:, 1:], psf.values)


def test_png_shows_the_spot_where_it_is(tmp_path):
    """The spot lies 7 of 24 rows above its mirror image and 6 of 17 columns left of it; a picture's rows count down."""
    from matplotlib.image import imread

    def coloured(values):
        picture = imread(write_psf(replace(blob(), values=values), tmp_path / "a.png", META))[..., :3]
        assert min(picture.shape[:2]) >= 600
        half = picture[:, : picture.shape[1] * 3 // 4]  # without the colour bar
        return np.argwhere(np.ptp(half, axis=-1) > 0.3).mean(0)

    values = blob().values
    row, column = coloured(values)
    assert coloured(values[::-1])[0] - row > 100
    assert coloured(values[:, ::-1])[1] - column > 50


def test_png_says_what_it_shows(tmp_path):
    from PIL import Image

    with Image.open(write_psf(blob(), tmp_path / "a.png", META)) as picture:
        assert json.loads(picture.text["Description"])["psf"]["method"] == "seidel"


def test_pixels_lie_around_their_samples():
    psf = blob(4, 4)
    assert edges_um(psf) == pytest.approx([-2.5 * 0.69125, 1.5 * 0.69125] * 2)


@pytest.mark.parametrize(("longest", "length"), [(9.9, 5), (10, 10), (0.31, 0.2), (1.99, 1), (512, 500)])
def test_a_scale_bar_has_a_round_length(longest, length):
    assert round_length(longest) == pytest.approx(length)


@pytest.mark.parametrize("name", ["spot.jpeg", "spot", "spot.fits.gz"])
def test_an_unknown_ending_lists_the_known_ones(tmp_path, name):
    with pytest.raises(ExportError, match=r"\.csv, \.fit, \.fits, \.fts, \.nc, \.npz, \.png, \.tif, \.tiff"):
        write_psf(blob(), tmp_path / name, META)
    assert not os.listdir(tmp_path)


def test_a_stack_is_not_one_psf(tmp_path):
    stack = Psf(np.ones((2, 4, 4)) / 16, 1.0, 0.5, "seidel", PsfFigures(strehl=np.ones(2)))
    with pytest.raises(ExportError, match=r"\(2, 4, 4\)"):
        write_psf(stack, tmp_path / "a.npz", META)


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(ExportError, match="make the folder"):
        write_psf(blob(), tmp_path / "nowhere" / "a.npz", META)


def test_a_place_is_checked_before_the_work(tmp_path):
    check_place(tmp_path / "a.npz")
    with pytest.raises(ExportError, match=r"nowhere.*make the folder first"):
        check_place(tmp_path / "nowhere" / "a.npz")
    with pytest.raises(ExportError, match="give the name of a file in it"):
        check_place(tmp_path)


def test_a_folder_is_not_a_file(tmp_path):
    (tmp_path / "a.npz").mkdir()
    with pytest.raises(ExportError, match="give the name of a file"):
        write_psf(blob(), tmp_path / "a.npz", META)
    assert os.listdir(tmp_path) == ["a.npz"]


@pytest.mark.parametrize("ending", ["npz", "tiff", "csv", "png"])
def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch, ending):
    path = tmp_path / f"a.{ending}"
    path.write_bytes(b"old")

    def full(_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(ExportError, match="no space left on device; free some space"):
        write_psf(blob(), path, META)
    assert path.read_bytes() == b"old" and len(os.listdir(tmp_path)) == 1


LIMITED = """
import resource, signal, sys
import matplotlib.font_manager  # it keeps a cache on disk, which is not to break off as well
import numpy as np
from p2sf.errors import ExportError
from p2sf.io.psf_files import write_psf
from p2sf.psf.result import Psf
from p2sf.figures.psf_data import PsfFigures, facts
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
noise = np.random.default_rng(1).random((64, 64))
try:
    write_psf(Psf(noise, 1.0, 0.5, "seidel", PsfFigures(strehl=1.0)), sys.argv[1], {})
except ExportError as error:
    print(error)
"""


@pytest.mark.slow
@pytest.mark.parametrize("ending", ["npz", "tiff", "csv", "png"])
def test_a_write_that_breaks_off_in_the_middle_is_one_sentence(tmp_path, ending):
    path = tmp_path / f"a.{ending}"
    command = [sys.executable, "-c", LIMITED, str(path)]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert "cannot be written" in run.stdout and run.stdout.count("\n") == 1
    assert not os.listdir(tmp_path)


def test_writing_through_a_link_keeps_the_link(tmp_path):
    (tmp_path / "real.json").write_text("old")
    (tmp_path / "link.json").symlink_to("real.json")
    write_json(tmp_path / "link.json", {"a": 1})
    assert (tmp_path / "link.json").is_symlink()
    assert json.loads((tmp_path / "real.json").read_text()) == {"a": 1}


def test_an_error_of_our_own_passes_and_leaves_nothing(tmp_path):
    with pytest.raises(ZeroDivisionError):
        write_beside(tmp_path / "a.bin", lambda handle: 1 / 0)
    assert not os.listdir(tmp_path)


@pytest.mark.parametrize("name", ["a.npz", "a.tiff", "a.csv"])
@pytest.mark.parametrize("content", [b"", b"hello", b"PK\x03\x04nonsense", b"# meta: {}\n1,2\n"])
def test_a_foreign_file_is_refused_in_a_sentence(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ExportError, match="not a PSF that this program wrote"):
        read_psf(tmp_path / name)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ExportError, match="no such file"):
        read_psf(tmp_path / "a.npz")


def test_plain_values_are_strict_json():
    value = plain({"a": np.float64(np.inf), "b": np.arange(2), "c": (np.nan, -0.0), "d": np.bool_(True), 5: None})
    assert json.dumps(value, allow_nan=False) == '{"a": null, "b": [0, 1], "c": [null, 0.0], "d": true, "5": null}'


def test_a_spot_diagram_has_its_rays_at_their_x_and_y(monkeypatch):
    drawn, points = [], np.array([[1.0, 2.0], [3.0, -4.0], [5.0, 6.0]])
    monkeypatch.setattr(psf_plot, "_write_png", lambda figure, *_: drawn.append(figure.axes[0].lines[0].get_xydata()))
    psf_plot.draw_spot(BytesIO(), points, 1.0)
    assert np.array_equal(drawn[0], points)
