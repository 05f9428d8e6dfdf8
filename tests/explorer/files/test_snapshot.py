"""A snapshot reopened is the same state, and its data the PSF that was on screen."""

import io
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent, QImage

from p2sf.database.build import build_database
from p2sf.database.files.npz import save_database
from p2sf.database.space import Space
from p2sf.errors import LensFileError
from p2sf.io.png_text import HEADER, with_text
from p2sf.io.psf_files import write_psf
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.psf.methods import render
from p2sf.psf.reading import read_psf
from p2sf.psf.seidel import seidel_psf
from p2sf.spans import depth_nodes
from p2sf_explorer.application.display import NO_DISPLAY, display_problem
from p2sf_explorer.application.main import starting_state
from p2sf_explorer.compute.live import live
from p2sf_explorer.files.embedded_state import KEYWORD, foreign, state_inside, text_inside
from p2sf_explorer.files.opening import open_file
from p2sf_explorer.files.snapshot import DATA_ENDINGS, write_data
from p2sf_explorer.state.state import State, new_state
from p2sf_explorer.widgets.copying import png_of
from tests.explorer.conftest import FIRST
from tests.support.waves import waves


@pytest.fixture
def busy(window):
    window.store.update(depth_mm=3000.0, focus_mm=3000.0, field_deg=7.25, psf_scale="log", f_number=5.6)
    return window


@pytest.mark.parametrize("ending", [".npz", ".tiff", ".csv", ".png", ".json"])
def test_a_snapshot_alone_reopens_identically(busy, tmp_path, ending):
    path = tmp_path / f"shot{ending}"
    busy.store.update(theme="dark" if ending == ".json" else "light")
    assert busy.commands.save(str(path))
    assert list(tmp_path.iterdir()) == [path], "nothing is written beside it"
    assert starting_state([str(path)]) == busy.store.state
    before = busy.store.state
    busy.store.update(field_deg=1.0)
    assert busy.commands.open_path(str(path))
    assert busy.store.state == before


def exported(path) -> np.ndarray:
    """Return the samples in a snapshot of data."""
    return read_psf(path)[0].values


def drop(window, path) -> None:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    window.dropEvent(QDropEvent(QPointF(5, 5), Qt.DropAction.CopyAction, data, buttons, keys))


SETUPS = {
    "plain": {},
    "by hand": {"added_waves": (0.5, -1.0, 0.0, 0.0, 0.25, 0.0), "muted": ("w22",), "free_pupil": True},
    "compared": {"pinned": new_state(method="seidel", f_number=8.0), "shown": "b"},
    "edited": {"lens_text": lens_to_toml(find_lens("cooke_triplet")).replace("Cooke", "Cooke & Söhne's ")},
}


@pytest.mark.slow
@pytest.mark.parametrize("setup", SETUPS)
@pytest.mark.parametrize("ending", [".npz", ".tiff", ".fits", ".csv", ".png", ".json"])
def test_a_snapshot_dropped_on_the_window_is_the_same_state_and_the_same_psf(busy, tmp_path, ending, setup):
    busy.store.update(**SETUPS[setup])
    path = (tmp_path / "shot").with_suffix(ending)
    assert busy.commands.save(str(path))
    state, psf = busy.store.state, busy.live.psf.values
    busy.store.replace(FIRST)
    drop(busy, path)
    assert busy.store.state == state
    assert np.array_equal(busy.live.psf.values, psf)
    if ending in DATA_ENDINGS:
        kind = np.float32 if ending == ".tiff" else float
        assert np.array_equal(exported(path), busy.live.psf.values.astype(kind))


def test_the_picture_is_of_the_window_pixel_by_pixel(busy, tmp_path):
    before = busy.grab().toImage()
    busy.commands.save(str(tmp_path / "shot.png"))
    after = QImage(str(tmp_path / "shot.png")).convertToFormat(before.format())
    assert after.size() == before.size()
    assert bytes(after.constBits()) == bytes(before.constBits())


def test_a_picture_without_a_state_is_no_lens_and_says_so(window, tmp_path):
    plain = QImage(8, 8, QImage.Format.Format_RGB32)
    plain.save(str(tmp_path / "photo.png"))
    assert state_inside(tmp_path / "photo.png") is None
    assert not window.commands.open_path(str(tmp_path / "photo.png"))
    assert window.banner.isVisible()


@pytest.mark.parametrize("ending", [".npz", ".tiff", ".csv", ".png"])
def test_a_psf_of_the_command_line_holds_no_state_and_a_database_is_named(tmp_path, ending):
    psf = write_psf(seidel_psf(waves(), 16), tmp_path / f"psf{ending}", {})
    with pytest.raises(LensFileError, match="no readable state"):
        open_file(State(), str(psf))
    space = Space(depth_nodes(500), np.linspace(0, 0.1, 12), np.linspace(0.5, 0.6, 12))
    lens = find_lens("singlet_f6")
    kept = save_database(build_database(lens, space), lens, tmp_path / "kept.npz")
    with pytest.raises(LensFileError, match="a database of PSFs"):
        open_file(State(), str(kept))


def test_a_lens_in_a_zip_is_still_a_lens(tmp_path):
    with zipfile.ZipFile(tmp_path / "lens.zip", "w") as archive:
        archive.writestr("lens.zmx", "")
    assert foreign(tmp_path / "lens.zip") is None


@pytest.mark.parametrize("ending", [".npz", ".tiff", ".fits", ".csv", ".png"])
def test_a_torn_snapshot_is_a_sentence(busy, tmp_path, ending):
    path = (tmp_path / "shot").with_suffix(ending)
    busy.commands.save(str(path))
    path.write_bytes(path.read_bytes()[:700])
    assert not busy.commands.open_path(str(path))
    assert busy.banner.isVisible()


def test_the_state_inside_names_the_versions(busy, tmp_path):
    busy.commands.save(str(tmp_path / "shot.png"))
    assert '"versions"' in text_inside(tmp_path / "shot.png")


def test_a_place_that_cannot_be_written_is_a_sentence(busy, tmp_path):
    assert not busy.commands.save(str(tmp_path / "no" / "shot.npz"))
    assert busy.banner.isVisible()


def test_no_display_is_a_sentence_and_a_display_is_none():
    assert display_problem({}, "linux") == NO_DISPLAY
    assert display_problem({"WAYLAND_DISPLAY": "wayland-0"}, "linux") is None
    assert display_problem({"QT_QPA_PLATFORM": "offscreen"}, "linux") is None
    assert display_problem({}, "darwin") is None


def test_a_state_goes_into_a_picture_without_encoding_it_again(tmp_path, window):
    """Encoding held the window up for a third of a second: all but one chunk stays byte for byte."""
    image = window.grab().toImage()
    assert image.save(str(tmp_path / "bare.png"))
    bare = (tmp_path / "bare.png").read_bytes()
    whole = with_text(bare, KEYWORD, "{} ∞")
    assert whole[:HEADER] + whole[HEADER + len(whole) - len(bare) :] == bare
    with Image.open(io.BytesIO(whole)) as picture:
        picture.verify()
        assert picture.info["p2sf-state"] == "{} ∞"


def test_a_picture_of_the_window_is_packed_quickly(window):
    """The first two bytes of what is packed tell the effort (RFC 1950, 2.2): the least there is."""
    made = png_of(window.panels["psf"].widget)
    assert made[made.index(b"IDAT") + 4 :][:2] == b"\x78\x01"


def test_saved_data_are_the_light_of_pixels_where_samples_are_far_apart(tmp_path):
    """33² samples of 6 µm, where λ/4NA is 0.9: as if the picture had been blurred enough to be shown so."""
    shown = live(new_state(depth_mm=np.inf, focus_mm=np.inf, field_deg=0.0))
    setup, request = shown.setup, replace(shown.request, window=(33, 6.0))
    points = render(setup.lens, setup.source, "traced", 33, 6.0)
    written = write_data(replace(shown, psf=points, request=request), tmp_path / "light.npz")
    found, meta = read_psf(written)
    assert found.integrated and meta["psf"]["integrated"]
    assert (found.pixel_um, found.values.shape) == (6.0, (33, 33))
    middle = render(setup.lens, setup.source, "traced", 27, 6.0 / 27)  # one pixel by 27² samples
    assert found.values[16, 16] * found.energy == pytest.approx(middle.energy, rel=1e-2)
    assert found.values[16, 16] < 0.8 * points.values[16, 16]
