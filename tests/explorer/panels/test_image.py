"""The image panel: the picture against the library, coarse then planned, stale marks, split, local PSF, sharpening."""

from dataclasses import replace
from time import process_time
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt

from p2sf.errors import Cancelled, GeometryError, RequestError
from p2sf.image.form import form_image
from p2sf.image.lattice import Lattice
from p2sf.image.progress import Progress
from p2sf.image.similarity import ssim
from p2sf.io.photo_files import read_photo, write_photo
from p2sf.io.transfer import srgb_from_linear
from p2sf.lens.lens import lens_range_um
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.messages import Message
from p2sf.pixel_kernels.channel import RAYS, Recipe
from p2sf.pixel_kernels.illumination import light_collected
from p2sf.scene.planning.reference import reference_kernel
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.setup import default_state, paraxial_setup
from p2sf_explorer.compute.views import image, photos
from p2sf_explorer.compute.views.image import (
    COLUMNS,
    RAY_NOTE,
    ROWS,
    TOLERANCE,
    TOO_LARGE,
    TOO_WIDE,
    UNMEASURED,
    by_rays,
    coarse,
    fine_enough,
    in_few_pixels,
    local_psf,
    moved_in,
    no_plan,
    on_stage,
    pixels,
    question,
    scene_of,
    shown_picture,
)
from p2sf_explorer.compute.views.photos import channels_of, crop_and_resize, full_shape, scene_values
from p2sf_explorer.files.embedded_state import state_inside
from p2sf_explorer.state.state import change, new_state

FAST = new_state(method="seidel", photo_pixel_um=16.0, theme="light")
LIVE = compute.live(FAST)


def asked(**changes):
    return question(compute.live(change(FAST, **changes))).question


@pytest.fixture(scope="module")
def found():
    return image.planned_picture(asked(lens="cooke_triplet", field_deg=4.0))


def test_the_planned_picture_is_the_librarys_own(found):
    values = scene_values("landscape", (ROWS, COLUMNS))
    again = form_image(found.plan, values)
    assert np.abs(found.after - again).max() < 1e-5  # float32, summed in threads
    assert found.plan.meets


def test_the_coarse_picture_resembles_the_planned_one(found):
    quick = coarse(found.question)
    assert quick.quality == "coarse" and found.quality == "planned"
    error = np.linalg.norm(quick.after - found.after) / np.linalg.norm(found.after)
    assert error < 2 * TOLERANCE  # it promises nothing, but a person must not see it jump
    assert np.array_equal(quick.before, found.before)


def test_the_words_count_the_psfs_and_explain_every_kind_of_decision(found):
    rows, columns = found.plan.counts
    waves = sum(len(colour.wavelengths_um) for colour in found.plan.colours)
    notes = {str(heading): note for heading, note in found.notes}
    assert found.headline.values == {"count": rows * columns * waves}  # off the axis there are no mirror images
    assert str(notes["PSFs"]) == f"{rows} × {columns} places × {waves} wavelengths"
    names = {heading.split(" ")[0] for heading in notes}
    assert names == {"Error", "PSFs", "Places", "Colour", "Method", "Sampling", "Depths", "Pupils"}
    assert "keeps 0.1" in str(notes["Error"])
    assert {f"Colour {channel.name}" for channel in found.plan.scene.channels} < set(notes)


def test_the_whole_field_uses_mirror_images_and_reaches_the_widest_chief_ray():
    whole = asked(lens="singlet_f6", photo_pixel_um=None)
    scene = scene_of(whole)
    assert scene.sensor.centred
    farthest = scene.sensor.corners_mm()[1]
    widest = np.tan(np.deg2rad(max(find_lens("singlet_f6").fields_deg)))
    focal = compute.live(new_state(lens="singlet_f6", method="seidel")).setup.focal_length_mm
    assert farthest == pytest.approx(focal * widest, rel=0.05)  # 3 % kept back, and some distortion
    assert coarse(whole).headline.values == {"count": 12}  # 2 × 2 of 3 × 3 in three colours


@pytest.mark.parametrize("field", [22.0, -22.0, 20.5])
def test_a_field_point_beyond_the_field_of_the_lens_has_no_picture(field):
    """The field of the Cooke triplet ends at 20°, to 1e-3° in every colour; the sensor used to be moved in."""
    with pytest.raises(GeometryError) as raised:
        scene_of(asked(lens="cooke_triplet", field_deg=field))
    assert raised.value.message.values == {"field": pytest.approx(abs(field), abs=1e-3), "widest": 20.0}
    for inside in (20.0, -20.0):
        assert scene_of(asked(lens="cooke_triplet", field_deg=inside)).sensor.centre_mm[1] * inside > 0


def test_a_picture_that_was_moved_off_its_field_point_says_so():
    """The picture's corners end at the field of the lens, and 20° lands above its upper edge."""
    kept, moved = (asked(lens="cooke_triplet", field_deg=field) for field in (10.0, 20.0))
    assert not moved_in(kept, SimpleNamespace(scene=scene_of(kept)))
    scene = scene_of(moved)
    ((_, note),) = moved_in(moved, SimpleNamespace(scene=scene))
    assert note.values["off"] == pytest.approx(moved.centre_mm - scene.sensor.centre_mm[1])
    assert note.values["off"] > scene.sensor.rows / 2 * scene.sensor.pixel_mm


def test_a_field_point_beyond_a_photo_is_not_another_one(tmp_path):
    write_photo(tmp_path / "photo.png", np.random.default_rng(2).random((300, 300, 3)).astype(np.float32))
    taken = dict(
        photo_source=str(tmp_path / "photo.png"), photo_pixel_um=30.0, photo_show="taken", lens="cooke_triplet"
    )
    assert image._taken_values(asked(**taken, field_deg=2.0)).shape[0] == ROWS
    with pytest.raises(RequestError) as raised:
        image._taken_values(asked(**taken, field_deg=8.0))  # 7 mm from the axis, and the photo reaches 4.5 mm
    assert raised.value.message.values["half"] == 4.5


@pytest.mark.slow
def test_large_pixels_get_no_plan_and_small_ones_do():
    whole, part = coarse(asked(photo_pixel_um=None)), coarse(asked())
    assert not fine_enough(whole) and fine_enough(part)
    assert whole.no_plan == TOO_LARGE and not part.no_plan
    for answer, reason in ((whole, TOO_LARGE), (part, None)):
        assert (Message("Coarse"), UNMEASURED[reason]) in answer.notes
    assert no_plan(coarse(asked(depth_mm=500.0)).plan) == TOO_WIDE


def test_sharpening_by_the_right_psfs_helps_and_by_the_axis_psf_does_not():
    quick = coarse(asked(photo_source="siemens_star", photo_show="sharpened", field_deg=14.0))
    told = dict(quick.notes)[Message("Sharpening")].values
    blurred, own, axis = (told[name].values for name in ("blurred", "own", "axis"))
    assert own["psnr"] > blurred["psnr"] + 3  # what knowing the PSF buys, in dB
    assert axis["psnr"] < own["psnr"] - 3
    assert 1 > own["ssim"] > blurred["ssim"] > 0 and own["ssim"] > axis["ssim"]
    assert [str(line) for line in quick.alike] == [f"blurred: {told['blurred']}", f"sharpened: {told['own']}"]
    levels = (srgb_from_linear(np.clip(x, 0, 1)) for x in (quick.after, scene_values("siemens_star", (ROWS, COLUMNS))))
    assert own["ssim"] == pytest.approx(ssim(*levels), abs=1e-6)


def test_the_local_psf_interpolates_the_kernels_between_nodes():
    one, two = np.zeros((2, 3, 3, 3), np.float32)
    one[:, 1, 1], two[:, 1, 2] = 1.0, 1.0
    lattice = Lattice(np.array([0.0, 10.0]), np.array([0.0, 20.0]), [[one, two], [one, two]])
    answer = replace(coarse_stub(), lattice=lattice)
    middle = local_psf(answer, 5.0, 10.0)
    assert middle[1, 1] == pytest.approx(1.0) and middle[1, 2] == pytest.approx(1.0)  # half and half, peak at 1
    near = local_psf(answer, 5.0, 5.0)
    assert near[1, 2] == pytest.approx(1 / 3)


def coarse_stub():
    empty = np.zeros((2, 2, 3), np.float32)
    return image.ImageResult(asked(), empty, empty, "coarse", None, None, 0.0, "", ())


def test_pixels_are_srgb_with_red_first():
    values = np.array([[[1.0, 0.0, 0.0], [0.0, 0.21586, 1.0]]])  # sRGB 128/255 (IEC 61966-2-1)
    assert pixels(values).tolist() == [[0xFFFF0000, 0xFF0080FF]]


def test_a_photo_is_cut_to_the_frame_and_averaged(tmp_path):
    values = np.zeros((40, 100, 3), np.float32)
    values[:, 50:, 0] = 1.0
    write_photo(tmp_path / "half.tif", values, "linear")
    small = scene_values(str(tmp_path / "half.tif"), (20, 30))
    assert small.shape == (20, 30, 3)
    assert small[:, :14, 0].max() == 0 and small[:, 16:, 0].min() == 1
    assert crop_and_resize(values, (8, 12))[..., 0].mean() == pytest.approx(0.5, abs=1e-6)  # the middle is half red
    with pytest.raises(RequestError, match="cannot be read"):
        scene_values(str(tmp_path / "none.png"), (20, 30))


def test_colours_stay_where_the_glasses_have_data():
    for channel in channels_of(find_lens("eye_navarro")):
        low, high = lens_range_um(find_lens("eye_navarro")) or (0.0, 9.0)
        assert low <= channel.wavelengths_um.min() and channel.wavelengths_um.max() <= high


def test_a_cancelled_picture_stops_in_the_plan_too():
    with pytest.raises(Cancelled):
        image.planned_picture(asked(), Progress(cancelled=lambda: True))


STATED = [(name, field) for name in shipped_lenses() for field in (None, *find_lens(name).fields_deg, "all")]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "field"), STATED, ids=[f"{name}-{field}" for name, field in STATED])
def test_every_shipped_lens_has_its_first_picture_within_a_second(name, field):
    """As first shown, at its stated fields, and over the whole field; a second of CPU time, since machines are busy."""
    state = default_state(name)
    if field == "all":
        state = change(state, photo_pixel_um=None)
    elif field is not None:
        state = change(state, field_deg=float(field))
    request = question(replace(LIVE, state=state, setup=paraxial_setup(state))).question
    spent = []
    for _ in range(2):  # the first time libraries are loaded and tables made
        began = process_time()
        answer = coarse(request)
        spent.append(process_time() - began)
        if spent[-1] < 0.5:
            break
    assert min(spent) < 1.0
    assert answer.after.shape == (ROWS, COLUMNS, 3) and np.isfinite(answer.after).all()
    assert 0.02 < answer.after.mean() < answer.before.max()


def test_a_picture_of_rays_says_so():
    state = default_state("fast_gauss_f14")
    found = coarse(question(replace(LIVE, state=state, setup=paraxial_setup(state))).question)
    assert by_rays(found.plan) and (Message("Rays"), RAY_NOTE) in found.notes and found.no_plan == TOO_WIDE
    near = coarse(asked())
    assert not by_rays(near.plan) and Message("Rays") not in dict(near.notes)


def test_the_picture_obeys_clipping():
    """The Double Gauss's whole field: rims take a part of the corner's light and blur, and none in the middle."""
    whole, clipped = (coarse(asked(photo_pixel_um=None, clip=clip)) for clip in (False, True))
    ratio = clipped.after[..., 1] / whole.after[..., 1]
    assert ratio[ROWS // 2, COLUMNS // 2] == pytest.approx(1, abs=1e-3)
    seen = clipped.plan.sensor_map(0.0)
    corner = seen.source(0.0, clipped.plan.scene.sensor.corners_mm()[1], seen.wavelength_um)
    light = [light_collected(seen.lens, corner, clip) for clip in (True, False)]
    assert ratio[0, 0] == pytest.approx(light[0] / light[1], abs=5e-3) and ratio[0, 0] < 0.98
    assert np.abs(clipped.lattice.kernels[0][0] - whole.lattice.kernels[0][0]).max() > 1e-3


def test_rays_make_nearly_the_picture_of_waves():
    """The Double Gauss at 14°, where a kernel of rays differs by a seventh: it is fringes that a picture hides."""
    found = coarse(asked(field_deg=14.0, photo_source="siemens_star"))
    rays = form_image(replace(found.plan, recipe=Recipe(RAYS)), found.before)
    apart = np.linalg.norm(found.after - rays) / np.linalg.norm(found.after)
    assert 0 < apart < 0.01 < 0.1 < np.linalg.norm(found.after - found.before) / np.linalg.norm(found.after)


@pytest.mark.parametrize("name", ["relay", "eye_navarro", "landscape"])
def test_other_lenses_have_a_picture(name):
    state = change(default_state(name), method="seidel", photo_pixel_um=16.0, field_deg=0.0)
    found = coarse(question(compute.live(state)).question)
    assert found.after.shape == (ROWS, COLUMNS, 3) and np.isfinite(found.after).all()


def test_the_panel_shows_the_split_picture_and_marks_an_earlier_one(window, image_panel, qtbot):
    assert np.array_equal(image_panel.split_view.before, pixels(scene_values("text", (ROWS, COLUMNS))))
    assert image_panel.split_view.names == ("scene", "image")
    window.store.update(field_deg=3.0)
    assert "earlier picture" in image_panel.widget.readout.text()
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert "earlier" not in image_panel.widget.readout.text()
    window.store.update(psf_scale="log")  # nothing the picture depends on
    assert not image_panel._stale()


def test_what_is_painted_is_the_scene_left_of_the_split_and_the_image_right_of_it(window, image_panel):
    split_view = image_panel.split_view
    before, after = np.full((20, 30), 0xFF204060, np.uint32), np.full((20, 30), 0xFFA08060, np.uint32)
    split_view.show_pictures(before, after, ("", ""))
    painted, area, x = split_view.grab().toImage(), split_view.area(), split_view.split_x()
    y = int(area.bottom()) - 12  # below the PSF
    assert painted.pixel(int(x) - 30, y) == 0xFF204060 and painted.pixel(int(x) + 30, y) == 0xFFA08060
    image_panel._paint(image_panel._answer)


def test_dragging_the_split_is_one_undo_and_hovering_moves_the_psf(window, image_panel, qtbot):
    split_view, first = image_panel.split_view, window.store.state
    area = split_view.area()
    places = [QPointF(area.left() + part * area.width(), area.center().y()).toPoint() for part in (0.5, 0.3, 0.25)]
    qtbot.mousePress(split_view, Qt.MouseButton.LeftButton, pos=places[0])
    for place in places[1:]:
        qtbot.mouseMove(split_view, place)
    qtbot.mouseRelease(split_view, Qt.MouseButton.LeftButton, pos=places[-1])
    assert window.store.state.photo.split == pytest.approx(0.25, abs=1.5 / area.width())
    window.store.undo()
    assert window.store.state == first and split_view.split == first.photo.split
    image_panel._look(0.0, 0.0)
    assert split_view.place == (0.0, 0.0)
    qtbot.keyClick(split_view, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert window.store.state.photo.split == pytest.approx(first.photo.split + 0.05)


def test_saving_writes_the_picture_and_the_state(window, image_panel, tmp_path):
    image_panel.save_as(str(tmp_path / "out.png"))
    written = read_photo(tmp_path / "out.png").values
    assert written.shape == (ROWS, COLUMNS, 3)
    assert np.abs(written - np.clip(image_panel._answer.after, 0, 1)).max() < 0.01  # 8 bits of sRGB
    assert state_inside(tmp_path / "out.png") == window.store.state


def test_a_photo_that_is_gone_is_one_sentence(window, image_panel, qtbot):
    window.store.update(photo_source="/nowhere/photo.png")
    qtbot.waitUntil(lambda: "cannot be read" in image_panel.empty.words.text())
    assert image_panel.widget.readout.text() == "no picture" and image_panel.empty.isVisible()
    window.store.update(psf_scale="log")  # nothing the picture depends on
    assert image_panel.widget.readout.text() == "no picture" and not image_panel.headline.isVisible()
    assert not image_panel.save.isEnabled() and not image_panel.words.button.isEnabled()
    image_panel.save_as("/nowhere/out.png")
    assert "there is no picture yet" in window.banner.text.text().lower()
    window.store.update(photo_source="text")
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert not image_panel.empty.isVisible() and image_panel.save.isEnabled() and image_panel.words.button.isEnabled()


def test_shown_pictures_have_the_scene_left_and_the_image_right(found):
    before, after, more = shown_picture("lens", found.plan, found.before, found.lattice, Progress())
    assert before is found.before and more == () and not np.array_equal(before, after)


def test_a_late_answer_to_an_earlier_question_does_not_cover_the_present_picture(window, image_panel, qtbot):
    """The worker that plans stops when it can, and may still hand over what was asked before."""
    present, asked_now = image_panel._answer, image_panel._asked
    earlier = replace(present, question=replace(asked_now, centre_mm=asked_now.centre_mm + 1.0), quality="planned")
    image_panel.fine.finished.emit(earlier.question, earlier)
    assert image_panel._answer is present and "earlier" not in image_panel.widget.readout.text()
    window.store.update(field_deg=2.0)
    image_panel.fine.finished.emit(earlier.question, earlier)
    assert image_panel._answer is earlier and "earlier" in image_panel.widget.readout.text(), (
        "better than one older still"
    )
    qtbot.waitUntil(lambda: not image_panel._stale())


def test_every_pixel_of_a_photo_goes_through_the_lens_and_is_planned_as_such(tmp_path):
    write_photo(tmp_path / "photo.png", np.random.default_rng(2).random((90, 60, 3)).astype(np.float32))
    full = dict(photo_source=str(tmp_path / "photo.png"), photo_pixel_um=None, photo_full=True, f_number=8.0)
    request = asked(lens="singlet_f6", **full)
    assert request.shape == (90, 60)
    sensor = scene_of(request).sensor
    other = scene_of(replace(request, shape=(ROWS, COLUMNS))).sensor
    assert sensor.centred and sensor.corners_mm()[1] == pytest.approx(other.corners_mm()[1]), "the same field"
    quick = coarse(request)
    assert quick.question == request and quick.after.shape == (90, 60, 3)
    assert np.array_equal(quick.before, read_photo(tmp_path / "photo.png").values)
    assert asked(lens="singlet_f6", **(full | {"photo_pixel_um": 8.0})).shape == (ROWS, COLUMNS)


def test_a_large_photo_is_coarse_at_once_and_planned_at_full_size(tmp_path):
    """The coarse picture has the photo's proportions and the usual size; whether a plan follows is the full one's."""
    request = asked(photo_source="siemens_star", photo_pixel_um=None, photo_full=True, lens="cooke_triplet")
    request = replace(request, shape=(330, 440))
    quick = coarse(request)
    assert quick.after.shape == (234, 312, 3) and quick.question == request
    told: list[float] = []
    whole = image.planned_picture(request, Progress(told.append))
    assert whole.after.shape == (330, 440, 3) and told == sorted(told) and told[-1] == pytest.approx(1.0)
    with pytest.raises(Cancelled):
        image.planned_picture(request, Progress(cancelled=lambda: bool(told)))


@pytest.mark.parametrize(
    ("shape", "expected"), [((300, 400), (300, 400)), ((3000, 4000), (3000, 4000)), ((6000, 8000), (3000, 4000))]
)
def test_more_than_twelve_megapixels_are_reduced(monkeypatch, shape, expected):
    monkeypatch.setattr(photos, "_shape", lambda path, stamp: shape)
    assert full_shape("photo.jpg") == expected


def test_the_map_shows_each_psf_at_its_place(found):
    shape = found.after.shape[:2]
    lattice, shown_map = found.lattice, image.psf_map(found.lattice, found.after.shape[:2])
    assert shown_map.shape == (*shape, 3) and shown_map.max() == 1.0
    place = round(float(lattice.row_nodes[0])), round(float(lattice.column_nodes[0]))
    tile = image.small_psf(lattice.kernels[0][0], 9)
    assert tile.shape == (9, 9, 3) and tile.max() == 1
    peak = np.unravel_index(tile.max(-1).argmax(), tile.shape[:2])
    assert np.abs(np.array(peak) - 4).max() <= 2, "the light is in its middle"
    assert place == (0, 0)
    pieces = image.cell_edges(lattice.column_nodes, shape[1])
    assert pieces[0] == 0 and pieces[-1] == shape[1] and pieces == sorted(pieces)


@pytest.mark.parametrize("clip", [False, True])
def test_a_photo_taken_by_a_tilted_sensor_is_sharpened_by_a_plan(tmp_path, clip):
    """Its kernels are those of exact rays; fits of a plan leave 2 %, where the scene allows 10 %."""
    write_photo(tmp_path / "taken.tif", np.random.default_rng(0).random((64, 96, 1), np.float32), "linear")
    taken = dict(photo_show="taken", photo_pixel_um=16.0, photo_source=str(tmp_path / "taken.tif"))
    state = change(new_state(), f_number=5.6, errors=(("tilt_x", 12, 12, 3.0),), clip=clip, **taken)
    asked = question(compute.live(state)).question
    found = image.planned_picture(asked)
    scene, lattice = found.plan.scene, found.lattice
    assert found.plan.decisions and asked.lens.sensor_before
    seen = found.plan.sensor_map(found.plan.vergences[0])
    assert seen.clip == clip
    for corner in (0, -1):
        kernel, sensor = lattice.kernels[corner][corner][0], scene.sensor
        x, y = float(sensor.x_mm(lattice.column_nodes[corner])), float(sensor.y_mm(lattice.row_nodes[corner]))
        exact = reference_kernel(seen, scene.channels[0], x, y, len(kernel) // 2, sensor.pixel_um)
        assert np.linalg.norm(kernel - exact) < 0.02 * np.linalg.norm(exact)
    top, bottom = (lattice.kernels[row][row].max() for row in (0, -1))
    assert abs(top - bottom) > 0.1 * bottom, "they are focused differently"


@pytest.mark.parametrize("view", [{"photo_show": "taken"}, {"photo_pixel_um": None, "photo_full": True}])
def test_a_photo_that_is_missing_leaves_the_button_to_choose_another(window, image_panel, qtbot, tmp_path, view):
    window.store.update(**view, photo_source=str(tmp_path / "moved.png"))
    qtbot.waitUntil(lambda: "cannot be read" in image_panel.empty.words.text())
    assert image_panel.show_box.currentData() == window.store.state.photo.show
    at = image_panel.open.mapTo(window, image_panel.open.rect().center())
    assert window.childAt(at) is image_panel.open


def test_the_picture_has_the_pixels_of_the_stage_as_far_as_the_field_goes():
    """The coarse picture shows the same part of the field in few pixels; the sensor stays within the field."""
    asked = question(compute.live(default_state("cooke_triplet"), "preview")).question
    assert on_stage(asked, (200, 300)) is asked and on_stage(asked, (230, 400)) == asked
    larger = on_stage(asked, (650, 900))
    assert larger.shape == (520, 780) and larger.pixel_um == asked.pixel_um
    few = in_few_pixels(larger)
    assert few.shape == (ROWS, COLUMNS)
    assert few.pixel_um * COLUMNS == pytest.approx(larger.pixel_um * larger.shape[1])
    small = question(compute.live(default_state("phone_f28"), "preview")).question
    found = on_stage(small, (1200, 1800))
    assert found.shape == (ROWS, COLUMNS), "12 mm are more than its field"
    scene_of(found)
    every = replace(asked, pixel_um=None)
    assert on_stage(every, (700, 1000)).shape == (624, 936)
    assert on_stage(replace(asked, show="taken"), (1200, 1800)).shape == (ROWS, COLUMNS)
