"""Photos with depths in the image panel: the picture that moves with the lens, what is kept of it, and its controls."""

import os
from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import GeometryError, RequestError
from p2sf.image.focus_pull import MOVING
from p2sf.image.kernel_octaves import setting
from p2sf.io.photo_files import write_photo
from p2sf.io.transfer import srgb_from_linear
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.views import depths, moving_image
from p2sf_explorer.compute.views.depths import DepthChoice, depth_map
from p2sf_explorer.compute.views.image import local_psf, no_plan, pixels, question, scene_of, unmeasured_plan
from p2sf_explorer.compute.views.moving_image import Keeper, moved_px, moving, no_plan_of
from p2sf_explorer.state.state import change, new_state
from tests.benchmarks import focus_pull

STEPS = new_state(
    lens="cooke_triplet", method="seidel", photo_pixel_um=16.0, photo_source="text", field_deg=0.0, photo_depths="steps"
)


def asked(**changes):
    return question(compute.live(change(STEPS, **changes))).question


@pytest.fixture(scope="module")
def keeper():
    return Keeper()


@pytest.fixture(scope="module")
def near(keeper):
    return moving(asked(focus_mm=1000.0), keeper=keeper)


def test_the_picture_moves_with_the_focus_and_keeps_what_it_can(keeper, near):
    kept = keeper._kept
    far = moving(asked(focus_mm=10000.0), keeper=keeper)
    assert keeper._kept is kept and kept.slabs is not None, "the picture was cut once"
    left, right = slice(20, 80), slice(-80, -20)
    blurs = [
        [float(np.abs(np.diff(found.after[:, part], axis=1)).mean()) for part in (left, right)] for found in (near, far)
    ]
    assert blurs[0][0] > 1.5 * blurs[1][0] and blurs[1][1] > 1.5 * blurs[0][1]
    assert near.error > 0 and near.quality == "coarse" and near.after.shape == near.before.shape


def test_another_photo_or_another_distortion_is_kept_anew(keeper):
    moving(asked(), keeper=keeper)
    kept = keeper._kept
    moving(asked(photo_source="checkerboard"), keeper=keeper)
    assert keeper._kept is not kept
    seen, sensor = keeper._seen
    far_off = replace(seen, scale_mm=1.01 * seen.scale_mm)
    assert moved_px(seen, sensor, seen, sensor) == 0
    moved = moved_px(seen, sensor, far_off, sensor)
    assert moved == pytest.approx(0.01 * np.hypot(*np.subtract(keeper._kept.shape, 1)) / 2, rel=0.1)


@pytest.mark.parametrize(
    "changes", [{}, {"photo_pixel_um": 64.0}, {"photo_near_mm": 120.0, "photo_depths": "", "depth_mm": 120.0}]
)
def test_a_plan_follows_a_moving_picture_where_it_follows_a_coarse_one(changes):
    request = asked(focus_mm=1000.0, **changes)
    made = setting(scene_of(request).camera(request.lens), scene_of(request), MOVING)
    assert no_plan_of(made) == no_plan(unmeasured_plan(request))


def test_the_psf_of_a_place_is_that_of_its_depth(near):
    rows, columns = near.after.shape[:2]
    sharp, wide = (local_psf(near, rows / 2, column) for column in (columns // 6, 5 * columns // 6))
    assert (wide > 0.1).sum() > 2 * (sharp > 0.1).sum()
    assert min(sharp.min(), wide.min()) >= 0


def test_the_psf_of_a_place_needs_no_map_once_the_picture_is_made(tmp_path):
    path = tmp_path / "map.png"
    write_photo(path, np.linspace(0, 1, 30)[:, None].repeat(45, 1), "linear")
    found = moving(asked(photo_depths=str(path)))
    before = local_psf(found, 100.0, 20.0)
    path.unlink()
    assert (local_psf(found, 100.0, 20.0) == before).all()
    assert moving(asked(photo_depths="")).psfs is None


def test_the_picture_by_rays_answers_what_was_asked(monkeypatch):
    def fail(kept, made, moved_px):
        raise GeometryError("no polynomials")

    monkeypatch.setattr(moving_image, "focused_picture", fail)
    assert moving(asked()).question == asked()


def test_pixels_of_a_frame_elsewhere_move_by_distortion_alone():
    request = asked()
    scene = scene_of(request)
    seen, beside = setting(scene.camera(request.lens), scene, MOVING).seen, replace(scene.sensor, centre_mm=(0.0, 0.5))
    assert moved_px(seen, scene.sensor, seen, beside) < 1.0 < 0.5 / scene.sensor.pixel_mm


@pytest.mark.parametrize(
    "changes",
    [{"clip": True}, {"errors": (("thickness", 2, 2, 3.0),)}, {"errors": (("index", 3, 3, 0.1),)}],
    ids=["rims", "a thickness", "a glass"],
)
def test_what_is_kept_is_of_the_picture_and_nothing_of_the_lens(tmp_path, changes):
    write_photo(tmp_path / "white.png", np.ones((20, 30, 3)))  # in which distortion does not show
    white = {"photo_depths": "", "photo_source": str(tmp_path / "white.png"), "photo_pixel_um": 64.0}
    keeper = Keeper()
    before = moving(asked(**white), keeper=keeper).after
    kept, anew = (moving(asked(**white, **changes), keeper=one).after for one in (keeper, Keeper()))
    assert np.abs(kept - anew).max() < 2e-4 < 1e-3 < np.abs(kept - before).max()  # the spline of a constant


def test_depths_count_through_the_lens_and_where_that_is_sharpened():
    assert asked().depths.source == asked(photo_show="sharpened").depths.source == "steps"
    assert all(asked(photo_show=show).depths.source == "" for show in ("psfs", "axis"))
    assert scene_of(asked()).near_mm == 1000.0 and scene_of(asked()).far_mm == 10000.0
    backwards = asked(photo_near_mm=9000.0, photo_far_mm=3000.0)
    assert (scene_of(backwards).near_mm, scene_of(backwards).far_mm) == (3000.0, 9000.0)
    assert asked(photo_depths="").depth_mm == STEPS.optics.depth_mm


def test_a_map_is_cut_and_resized_as_its_photo_and_no_depth_lies_between_two(tmp_path):
    write_photo(tmp_path / "map.png", np.repeat([[0.0], [1.0]], 10, 0).repeat(60, 1), "linear")
    found = depth_map(DepthChoice(str(tmp_path / "map.png")), "text", (208, 312))
    assert found.shape == (208, 312) and np.unique(found) == pytest.approx([1000.0, 10000.0], rel=1e-6)
    with pytest.raises(RequestError):
        depth_map(DepthChoice("photo"), "photo.png", (208, 312))
    assert not depths.has_own_depths("photo.heic")


def test_a_map_is_read_once_and_anew_when_it_or_its_photo_changes(tmp_path, monkeypatch):
    photo, choice = str(tmp_path / "photo.png"), DepthChoice(str(tmp_path / "map.png"))
    for path in (photo, choice.source):
        write_photo(path, np.full((20, 30, 3), 0.5), "linear")
    reads, read = [], depths.read_depths
    monkeypatch.setattr(depths, "read_depths", lambda *given: reads.append(given) or read(*given))
    for number, path in enumerate((photo, photo, choice.source)):
        os.utime(path, ns=(number + 1, number + 1))
        found = depth_map(choice, photo, (20, 30))
        assert depths.occupied_depths(choice, photo, (20, 30)) == (found.min(), found.max(), ())
        assert len(reads) == number + 1


def test_pixels_are_the_levels_of_srgb():
    light = np.linspace(-0.1, 1.1, 3000, dtype=np.float32).reshape(20, 50, 3)
    exact = np.rint(255 * srgb_from_linear(np.clip(light, 0, 1)))
    shown = pixels(light)
    levels = np.stack([shown >> 16 & 255, shown >> 8 & 255, shown & 255], axis=-1)
    assert (shown >> 24 == 255).all() and np.abs(levels - exact).max() <= 1 and (levels == exact).mean() > 0.95


def test_the_badge_says_the_error_and_depths_have_their_controls(window, image_panel, qtbot):
    row = image_panel.depth_row
    assert not row.near.isVisible() and not row.meaning.isVisible()
    for show, usable in (("axis", False), ("sharpened", True), ("psfs", False), ("lens", True)):
        window.store.update(photo_show=show)
        assert image_panel.depth_row.source.isEnabled() == usable
    window.store.update(photo_depths="slope", photo_near_mm=800.0)
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert f"{100 * image_panel._answer.error:.2g}" in image_panel.widget.readout.text()
    assert row.near.isVisible() and row.near.value() == pytest.approx(0.8) and not row.meaning.isVisible()
    assert (row.near.text(), row.far.text()) == ("near 0.800 m", "far 10.000 m")
    for box in (row.near, row.far):
        edit = box.lineEdit()
        assert edit.fontMetrics().horizontalAdvance(box.text()) < edit.width(), "nothing of it is cut"
    row.far.setValue(5.0)
    assert window.store.state.photo.far_mm == 5000.0
    window.store.update(photo_depths="/nowhere/map.png")
    qtbot.waitUntil(lambda: image_panel.empty.isVisible())
    assert "/nowhere/map.png" in image_panel.empty.words.text() and row.meaning.isVisible()
    image_panel.empty.findChildren(type(image_panel.open))[1].click()  # the sample
    qtbot.waitUntil(lambda: image_panel.split_view.isVisible() and not image_panel._stale())


def test_a_photo_takes_its_own_depths_with_it(window, image_panel, monkeypatch, tmp_path):
    write_photo(tmp_path / "one.png", np.full((20, 30, 3), 0.5, np.float32))
    names = image_panel.take_photo.__globals__
    for own, kept, wanted in ((True, "slope", "photo"), (False, "photo", ""), (False, "slope", "slope")):
        monkeypatch.setitem(names, "has_own_depths", lambda path, own=own: own)
        window.store.update(photo_depths=kept)
        image_panel.take_photo(str(tmp_path / "one.png"))
        assert window.store.state.photo.depths == wanted


@pytest.mark.slow
@pytest.mark.parametrize(("drag", "lens"), [("focus", "cooke_triplet"), ("f-number", "tessar"), ("zoom", "zoom_3x")])
def test_the_badge_says_no_less_than_the_error_of_the_benchmark(tmp_path, drag, lens):
    """The short form of ``python -m tests.benchmarks.focus_pull``."""
    scenes = focus_pull.SCENES | {"star before a landscape": focus_pull.star_before_a_landscape(tmp_path, (208, 312))}
    for scene in scenes.items():
        found = focus_pull.row(drag, lens, scene, (230, 330), 0.05, False)
        assert found.shape == (208, 312) and 0 < found.true <= found.stated
