"""The Measured panel measures a picture beside the lens on screen, and takes what it finds into the window."""

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt

from p2sf.image.charts import draw_chart
from p2sf.image.deblur import psnr
from p2sf.image.form import Forming, form_image
from p2sf.io.photo_files import write_photo
from p2sf.lens.lens import with_f_number, with_sensor
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import read_toml
from p2sf.measure.frame import FrameGeometry
from p2sf.measure.measurement import read_measurement
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.views import image
from p2sf_explorer.compute.views.measured import SAMPLE_SHIFT_UM
from p2sf_explorer.state.state import change
from p2sf_explorer.state.state_files import state_from_json, state_to_json

SHIFT_UM = 60.0


@pytest.fixture(scope="module")
def picture(tmp_path_factory):
    """Return a picture of 3 × 2 points through the Cooke triplet at f/4, its sensor 60 µm too far."""
    path = tmp_path_factory.mktemp("frames") / "points.npy"
    lens = with_f_number(find_lens("cooke_triplet"), 4.0)
    exposure = Exposure(sensor_shift_um=SHIFT_UM)
    np.save(path, simulated_frame(lens, grid_of_points(3, 2, 1.2, 0.6), FrameGeometry(300, 480, 3.45), exposure).values)
    return path


@pytest.fixture
def panel(window):
    window.store.update(lens="cooke_triplet", f_number=4.0, wavelength_nm=550.0, tab="measured")
    yield window.panels["measured"]
    window.store.update(tab="profiles")


@pytest.mark.slow
def test_a_picture_is_measured_and_taken_into_the_window(panel, picture, window, qtbot, tmp_path):
    panel.open_picture(str(picture))
    assert panel.overlay.text and not panel.save.isVisibleTo(panel.widget)
    qtbot.waitUntil(lambda: panel._found is not None)
    assert panel.list.rowCount() == 6 and not panel.overlay.text
    assert panel.chart.read(*panel.chart.from_pixels(panel.chart.room(panel.chart.tiles[0]).center()))
    values = dict(zip((row[0] for row in panel.table.rows), panel.table.values, strict=True))
    stated, off = (
        float(values["W40"].split("(")[1].rstrip(")")),
        float(values["f-number"].replace("−", "-").split(" ± ")[0]),
    )
    assert stated == pytest.approx(3.862 * (1 + off / 100) ** -4, rel=0.01)  # of the lens, at the f-number found
    words = values["sensor shift"].removesuffix(" µm").split(" ± ")
    shift, error = map(float, words)
    assert len({len(text.partition(".")[2]) for text in words}) == 1, "a value has as many decimals as its error"
    assert abs(shift - SHIFT_UM) < 5 * error < 30
    panel.save_as(str(tmp_path / "coefficients.npz"))
    assert read_measurement(tmp_path / "coefficients.npz")[1]["lens"] == "cooke_triplet"
    panel.save_built(str(tmp_path / "built.toml"))
    moved = read_toml(tmp_path / "built.toml").sensor_mm - with_f_number(find_lens("cooke_triplet"), 4.0).sensor_mm
    assert 1000 * moved == pytest.approx(shift, abs=0.1 * error)  # the table shows two figures of the error
    panel.list.selectRow(3)
    panel.take.click()
    what_if = window.store.state.what_if
    assert what_if.free_pupil and what_if.added_waves[0] == pytest.approx(panel._found.fits[3].numbers[0], abs=1e-4)
    window.store.undo()
    assert not window.store.state.what_if.free_pupil
    sharpened_by_what_was_measured(panel, window.store, tmp_path, shift)
    assert state_from_json(state_to_json(window.store.state)).measured.picture == str(picture)


def sharpened_by_what_was_measured(panel, store, folder, shift):
    """Check that a noisy photo comes within 0.5 dB of what the true lens makes of it, and the design loses more."""
    before = store.state
    panel.sharpen.click()
    taken = store.state
    assert taken.display.stage == "image" and taken.photo.show == "taken" and taken.photo.pixel_um == 3.45
    assert taken.optics.sensor_shift_um == pytest.approx(shift, abs=0.05)
    store.undo()
    assert store.state == before
    truth = photographed(folder / "photo.tif")

    def quality(**changes):
        found = image.planned_picture(
            image.question(live(change(taken, photo_source=str(folder / "photo.tif"), **changes))).question
        )
        return psnr(found.after[16:-16, 16:-16, :1], truth[16:-16, 16:-16])

    as_measured, true, designed = quality(), quality(sensor_shift_um=SHIFT_UM), quality(sensor_shift_um=0.0)
    assert abs(as_measured - true) < 0.5 < true - designed


def photographed(path):
    """Write what the lens of `picture` makes of a landscape, with noise, and return the landscape."""
    lens = with_f_number(find_lens("cooke_triplet"), 4.0)
    lens = with_sensor(lens, lens.sensor_mm + SHIFT_UM / 1000)
    scene = Scene(Sensor(128, 160, 3.45), (Channel("green", (550.0,), (1.0,)),))
    truth = draw_chart("landscape", 128, 160)[..., 1:2]
    blurred = form_image(plan(lens, scene), truth, how=Forming(geometry=False))
    noise = np.random.default_rng(0).normal(0, 0.005, blurred.shape)
    write_photo(path, blurred + noise.astype(np.float32), "linear")
    return truth


@pytest.mark.slow
def test_the_encoding_is_chosen_and_what_was_done_is_said(panel, picture, window, qtbot, tmp_path):
    """8 bits of one picture, taken for sRGB by themselves and for counts when told so."""
    counts = np.load(picture)
    path = tmp_path / "points.png"
    Image.fromarray(np.clip(255 * (counts / counts.max()) ** (1 / 2.2), 0, 255).astype(np.uint8)).save(path)
    said = {}
    panel.open_picture(str(path))
    for choice in ("automatic", "linear"):
        panel.encoding.setCurrentIndex(panel.encoding.findData(choice))
        panel.encoding.activated.emit(panel.encoding.currentIndex())
        assert window.store.state.measured.encoding == choice
        wanted = "srgb" if choice == "automatic" else choice
        qtbot.waitUntil(lambda: not panel.worker.busy)
        assert panel._found.frames[0].encoding == wanted
        said[choice] = panel.widget.readout.text()
    assert "sRGB" in said["automatic"] and "linear counts" in said["linear"]
    window.store.update(measured_encoding="automatic")


def test_stop_ends_a_measurement_before_it_is_done(panel, picture, qtbot):
    panel.open_picture(str(picture))
    qtbot.waitUntil(lambda: "%" in panel.widget.readout.text())
    panel.stop_button.click()
    qtbot.waitUntil(lambda: not panel.worker.busy)
    assert panel._found is None and "stopped" in panel.overlay.text


def test_what_is_no_picture_of_points_is_said(panel, window, qtbot, tmp_path):
    np.save(tmp_path / "noise.npy", np.random.default_rng(0).normal(50, 5, (40, 40)))
    panel.open_picture(str(tmp_path / "noise.npy"))
    qtbot.waitUntil(lambda: bool(panel._refusal))
    assert "o point rises above" in panel._refusal
    assert not panel.save.isEnabled() and not panel.take.isEnabled() and not panel.sharpen.isEnabled()
    window.store.update(measured_picture=str(tmp_path / "moved.npy"))
    qtbot.waitUntil(lambda: "moved.npy is not in" in panel._refusal)
    window.store.undo()
    assert window.store.state.measured.picture.endswith("noise.npy")
    qtbot.waitUntil(lambda: "o point rises above" in panel._refusal)


@pytest.mark.slow
def test_without_a_picture_a_sample_is_offered_and_its_sensor_found(panel, window, qtbot):
    """Six points through the lens on screen, simulated with finer sums than a measurement takes."""
    window.store.update(measured_picture="")
    assert panel.empty.isVisibleTo(panel.widget) and not panel.body.isVisibleTo(panel.widget)
    qtbot.mouseClick(panel.sample, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: panel._found is not None)
    assert panel.body.isVisibleTo(panel.widget) and not panel.empty.isVisibleTo(panel.widget)
    found = dict(zip((row[0] for row in panel.table.rows), panel.table.values, strict=True))["sensor shift"]
    shift, error = map(float, found.removesuffix(" µm").split(" ± "))
    assert abs(shift - SAMPLE_SHIFT_UM) <= 5 * error <= 15
