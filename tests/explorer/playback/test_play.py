"""A slider that plays, and the film of it: the right values at the right moments, one step of undo, whole files."""

import sys
from math import inf
from threading import Event

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt
from pytest import approx

from p2sf.errors import ExportError, P2SFError
from p2sf_explorer.playback.film import FilmFrame, FrameQueue, check_film, write_film
from p2sf_explorer.playback.filming import frame_of, picture_of
from p2sf_explorer.playback.play_bar import seconds
from p2sf_explorer.playback.sweep import changes, present, sweep
from p2sf_explorer.state.limits import PLAYABLE
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.state.terms import NAMES
from tests.support.windows.events import choose
from tests.support.windows.windows import at_rest, settled


@pytest.mark.parametrize("key", PLAYABLE[1:])
def test_every_slider_can_be_swept_from_end_to_end_and_back(key):
    lens = {"zoom": "zoom_3x", "focus_position": "macro_floating"}.get(key, "double_gauss_28")
    state = new_state(lens=lens, playback_slider=key, playback_seconds=2.0)
    way = sweep(state)
    assert (way.at(0.0), way.at(2.0), way.at(4.0)) == approx((way.first, way.last, way.first))
    assert way.at(1.0) == approx(way.at(3.0))
    for part in (0.0, 0.3, 1.0):
        assert way.part(way.value(part)) == approx(part)
    assert present(change(state, **changes(state, way.value(0.25)))) == approx(way.value(0.25))


def test_half_way_is_even_in_what_the_slider_is_even_in():
    assert sweep(new_state(playback_slider="depth_mm", playback_range=(500.0, inf))).value(0.5) == approx(1000.0)
    assert sweep(new_state(playback_slider="f_number", playback_range=(2.0, 8.0))).value(0.5) == approx(4.0)
    assert sweep(new_state(playback_slider="field_deg", playback_range=(2.0, 8.0))).value(0.5) == approx(5.0)


@pytest.mark.parametrize("text", ["4", "4 s", "4.0s"])
def test_seconds_are_read(text):
    assert seconds(text) == 4.0


def test_nonsense_is_no_duration():
    with pytest.raises(P2SFError, match="duration"):
        seconds("soon")


def frames(count: int):
    return [FilmFrame(4, 2, bytes([20 * k] * 24)) for k in range(count)]


def test_a_gif_has_every_frame_in_order_and_repeats(tmp_path):
    write_film(iter(frames(5)), tmp_path / "a.gif", 80)
    with Image.open(tmp_path / "a.gif") as film:
        assert (film.n_frames, film.info["loop"], film.info["duration"]) == (5, 0, 80)
        for k in range(5):
            film.seek(k)
            assert film.convert("RGB").getpixel((1, 1)) == (20 * k,) * 3


@pytest.mark.parametrize("size", [(64, 48), (63, 47)])
def test_an_mp4_has_every_frame_in_order(tmp_path, size):
    """Read back by ffmpeg; 4 grey levels of 255: H.264 at the quality chosen keeps a flat picture to 2."""
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    wide, tall = size
    greys = [FilmFrame(wide, tall, bytes([40 * k]) * (3 * wide * tall)) for k in range(5)]
    write_film(iter(greys), tmp_path / "a.mp4", 80)
    found = ffmpeg.read_frames(tmp_path / "a.mp4")
    told = next(found)
    assert told["size"] == (64, 48) and told["fps"] == approx(12.5, rel=0.01)
    middles = [np.frombuffer(frame, np.uint8).reshape(48, 64, 3)[20, 20] for frame in found]
    assert len(middles) == 5
    for k, middle in enumerate(middles):
        assert middle.astype(int) == approx(np.full(3, 40 * k), abs=4)


def test_an_mp4_without_ffmpeg_is_refused_before_the_first_frame(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(ExportError, match="imageio-ffmpeg"):
        check_film(tmp_path / "a.mp4")


def test_numbered_frames_are_whole_and_exact(tmp_path):
    paths = write_film(iter(frames(3)), tmp_path / "way.png", 80)
    assert [path.name for path in paths] == ["way_0001.png", "way_0002.png", "way_0003.png"]
    assert sorted(p.name for p in tmp_path.iterdir()) == [path.name for path in paths]
    assert Image.open(paths[2]).getpixel((3, 1)) == (40, 40, 40)


@pytest.mark.parametrize("ending", [".gif", ".mp4", ".png"])
def test_a_cancelled_film_leaves_nothing_and_an_old_one_stays(tmp_path, ending):
    if ending == ".mp4":
        pytest.importorskip("imageio_ffmpeg")
    old = tmp_path / f"way{ending}"
    old.write_bytes(b"old")
    reel, cancelled = FrameQueue(), Event()
    reel.put(frames(1)[0])

    def handing():
        for frame in reel.frames(cancelled):
            cancelled.set()
            yield frame

    with pytest.raises(ExportError, match="cancelled"):
        write_film(handing(), old, 80)
    assert [path.name for path in tmp_path.iterdir()] == [old.name]
    assert old.read_bytes() == b"old"


@pytest.mark.parametrize("name", ["way.avi", "no/way.gif"])
def test_a_film_that_cannot_be_written_is_a_sentence(window, tmp_path, name):
    window.store.update(playback_slider="field_deg")
    assert not window.play.film(str(tmp_path / name))
    assert window.banner.isVisible()
    assert not window.play.filming.busy


def test_space_plays_the_focused_slider_as_one_step_of_undo(window, qtbot):
    slider = window.controls.rows["field_deg"].slider
    window.store.update(playback_slider="field_deg", playback_range=(2.0, 14.0), playback_seconds=0.5)
    before, seen = window.store.state, []
    window.store.changed.connect(lambda state: seen.append((state.optics.field_deg, window.store.moving)))
    slider.setFocus()
    qtbot.keyClick(slider, Qt.Key.Key_Space)
    assert window.play.player.playing
    qtbot.waitUntil(lambda: len({value for value, _ in seen}) >= 4)
    assert all(moving and 2 <= value <= 14 for value, moving in seen)
    qtbot.keyClick(slider, Qt.Key.Key_Space)
    assert not window.play.player.playing
    assert not window.store.moving
    assert window.live.quality == "settled"
    window.store.undo()
    assert window.store.state == before


def test_undo_and_a_hand_on_the_slider_pause(window, qtbot, drag):
    window.store.update(playback_slider="field_deg", playback_range=(2.0, 14.0))
    window.play.toggle()
    window.play.player.step()
    window.store.undo()
    assert not window.play.player.playing
    window.play.toggle()
    window.play.player.step()
    drag(window.controls.rows["field_deg"].slider, 0.9)
    assert not window.play.player.playing
    window.store.undo()
    assert window.store.state.optics.field_deg < 15  # where playing had brought it: the hand's way is one step


def test_space_on_the_desk_plays_the_waves_of_its_row(window, qtbot):
    desk = window.panels["coefficients"].bars
    desk.setFocus()
    desk.choose(1)
    qtbot.keyClick(desk, Qt.Key.Key_Space)
    window.play.player.step()
    window.play.player.pause()
    assert window.store.state.playback.slider == "added_w31"
    assert NAMES["w31"] in window.play.key.currentText()
    assert any(window.store.state.what_if.added_waves) or present(window.store.state) == approx(0.0, abs=0.2)


def test_the_bar_sets_range_and_speed_and_refuses_in_a_sentence(window, qtbot):
    bar = window.play
    window.store.update(playback_slider="f_number")
    assert bar.isVisible()
    for edit, text in ((bar.first, "f/2.8"), (bar.last, "16"), (bar.seconds, "2 s")):
        edit.selectAll()
        qtbot.keyClicks(edit, text)
        qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert (window.store.state.playback.range, window.store.state.playback.seconds) == ((2.8, 16.0), 2.0)
    bar.last.selectAll()
    qtbot.keyClicks(bar.last, "wide")
    qtbot.keyClick(bar.last, Qt.Key.Key_Return)
    assert window.banner.isVisible()
    assert bar.last.text() == "f/16.0"
    qtbot.mouseClick(bar.close_bar, Qt.MouseButton.LeftButton)
    assert not bar.isVisible()


def test_a_film_of_the_psf_shows_what_the_window_shows_at_each_moment(window, qtbot, tmp_path):
    window.store.update(playback_slider="added_wd", playback_range=(0.0, 1.0), playback_seconds=0.25, free_pupil=True)
    bar, path = window.play, tmp_path / "way.png"
    choose(bar.subject, "psf")
    state = window.store.state
    with qtbot.waitSignal(bar.filming.ended) as told:
        assert bar.film(str(path))
        assert bar.progress.isVisible()
    assert told.args[0].values["count"] == 3
    assert window.store.state == state
    assert not bar.progress.isVisible()
    for number, wd in enumerate((0.0, 0.5, 1.0), 1):
        window.store.update(added_waves=(0.0, 0.0, 0.0, 0.0, wd, 0.0))
        at_rest(window, qtbot)
        middle = frame_pixels(window.panels["psf"].map.chart)
        film = np.asarray(Image.open(tmp_path / f"way_{number:04d}.png").convert("RGB"))
        chart = window.panels["psf"].map.chart
        corner = chart.mapTo(window.panels["psf"].widget, chart.rect().topLeft())
        part = film[corner.y() : corner.y() + chart.height(), corner.x() : corner.x() + chart.width()]
        assert np.array_equal(part, middle)


def filmed(window, qtbot, path, subject: str, meanwhile=lambda: None) -> str:
    bar = window.play
    choose(bar.subject, subject)
    with qtbot.waitSignal(bar.filming.ended) as told:
        assert bar.film(str(path))
        assert not bar.close_bar.isEnabled()
        with qtbot.waitSignal(bar.filming.progressed):
            pass
        meanwhile()
    assert bar.close_bar.isEnabled()
    return str(told.args[0])


def part_of(path, widget, chart) -> np.ndarray:
    """Return where a chart stands in a filmed widget."""
    corner = chart.mapTo(widget, chart.rect().topLeft())
    film = np.asarray(Image.open(path).convert("RGB"))
    return film[corner.y() : corner.y() + chart.height(), corner.x() : corner.x() + chart.width()]


def test_what_changes_while_a_film_is_made_is_not_in_it(window, qtbot, tmp_path):
    """Undo takes the sweep out of the state, and another depth comes in: the film is the same to the pixel."""
    sweeping = dict(playback_slider="added_wd", playback_range=(0.0, 1.0), playback_seconds=0.25, free_pupil=True)
    sweeping |= dict(playback_subject="psf")

    def meddle():
        window.store.undo()
        assert not window.store.state.playback.slider
        window.store.update(wavelength_nm=450.0, free_pupil=True)

    for name, meanwhile in (("calm", lambda: None), ("busy", meddle)):
        window.store.replace(window.store.state)
        window.store.update(wavelength_nm=587.5618, **sweeping)
        assert "3 frames" in filmed(window, qtbot, tmp_path / f"{name}.png", "psf", meanwhile)
    assert window.live.state == window.store.state
    assert window.store.state.optics.wavelength_nm == 450.0
    chart = window.panels["psf"].map.chart
    for number in (1, 2, 3):
        both = [part_of(tmp_path / f"{name}_{number:04d}.png", window.panels["psf"].widget, chart)
                for name in ("calm", "busy")]  # fmt: skip
        assert np.array_equal(*both)


@pytest.mark.parametrize(("tab", "chart"), [("through_focus", "chart"), ("colour", "picture")])
def test_a_film_waits_for_the_panels_that_fill_in_the_background(window, qtbot, tmp_path, tab, chart):
    window.store.update(tab=tab, playback_slider="f_number", playback_range=(4.0, 8.0), playback_seconds=0.2)
    panel = window.panels[tab]
    assert "2 frames" in filmed(window, qtbot, tmp_path / "way.png", "tabs")
    for number, f_number in enumerate((4.0, 8.0), 1):
        window.store.update(f_number=f_number)
        settled(panel, qtbot)
        found = part_of(tmp_path / f"way_{number:04d}.png", window.tabs, getattr(panel, chart))
        assert np.array_equal(found, frame_pixels(getattr(panel, chart)))


def frame_pixels(widget) -> np.ndarray:
    found = frame_of(picture_of(widget))
    return np.frombuffer(found.rgb, np.uint8).reshape(found.height, found.width, 3)


def test_a_film_can_be_cancelled(window, qtbot, tmp_path):
    window.store.update(playback_slider="field_deg", playback_seconds=60.0)
    with qtbot.waitSignal(window.play.filming.ended) as told:
        assert window.play.film(str(tmp_path / "way.gif"))
        with qtbot.waitSignal(window.play.filming.progressed):
            pass
        qtbot.mouseClick(window.play.stop_film, Qt.MouseButton.LeftButton)
    assert "cancelled" in str(told.args[0])
    assert list(tmp_path.iterdir()) == []
    assert window.live.state == window.store.state


@pytest.mark.slow
@pytest.mark.parametrize("ending", [".png", ".gif"])
def test_a_film_keeps_its_size_while_the_window_is_resized(window, qtbot, tmp_path, ending):
    window.store.update(playback_slider="field_deg", playback_seconds=0.4)
    filmed(window, qtbot, tmp_path / f"way{ending}", "stack", lambda: window.resize(1300, 820))
    sizes = set()
    for path in tmp_path.iterdir():
        with Image.open(path) as picture:
            sizes.add(picture.size)
    assert len(sizes) == 1 and len(list(tmp_path.iterdir())) == (1 if ending == ".gif" else 5)
