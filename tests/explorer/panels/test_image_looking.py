"""Looking closer in the image panel: keys, details, dropped photos, and the plan told behind a button."""

from dataclasses import replace
from itertools import pairwise
from math import inf
from threading import Event

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QMouseEvent
from PySide6.QtWidgets import QApplication

from p2sf.errors import Cancelled
from p2sf.image.progress import Progress
from p2sf.io.photo_files import write_photo
from p2sf.messages import Message, Style
from p2sf.scene.planning.cost import Cost
from p2sf.scene.planning.plan import Decision
from p2sf_explorer.compute.views.image import (
    COLUMNS,
    PLANNING,
    ROWS,
    TOO_LARGE,
    TOO_WIDE,
    UNMEASURED,
    forming,
    frame_notes,
    local_psf,
    pixels,
    planning,
)
from p2sf_explorer.compute.views.photos import cut_away, scene_values
from p2sf_explorer.files.snapshot import write_picture
from p2sf_explorer.i18n.language import texts
from p2sf_explorer.i18n.tr import unbroken
from p2sf_explorer.panels.image.split_view import close_up, places
from p2sf_explorer.state.state import change
from p2sf_explorer.widgets.copying import png_of


def test_arrow_keys_move_the_place_looked_at_and_its_psf_with_it(window, image_panel, qtbot):
    split_view, split = image_panel.split_view, window.store.state.photo.split
    image_panel._look(100.0, 150.0)
    for key, place in (("Down", (108.0, 150.0)), ("Right", (108.0, 158.0)), ("Up", (100.0, 158.0))):
        qtbot.keyClick(split_view, getattr(Qt.Key, f"Key_{key}"))
        assert split_view.place == pytest.approx(place)
    image_panel._look(0.0, COLUMNS - 1.0)
    qtbot.keyClick(split_view, Qt.Key.Key_Right)
    assert split_view.place == pytest.approx((0.0, COLUMNS - 1.0)) and window.store.state.photo.split == split
    wanted = local_psf(image_panel._answer, 0.0, COLUMNS - 1.0)
    assert np.array_equal(split_view.psf, pixels(np.sqrt(wanted)))


def test_a_low_panel_has_details_and_the_psf_beside_the_picture_and_a_narrow_one_the_psf_on_it():
    low, narrow = places(940, 170, ROWS, COLUMNS), places(320, 300, ROWS, COLUMNS)
    assert low.picture.height() == 170 and len(low.details) == 2
    assert low.psf.right() == pytest.approx(940)  # all of the width is used
    edges = [low.picture, *low.details, low.psf]
    assert all(one.right() < two.left() for one, two in pairwise(edges))
    assert narrow.picture.width() == 320 and not narrow.details and narrow.picture.contains(narrow.psf)
    wide = places(500, 300, ROWS, COLUMNS)  # not enough for a PSF beside the picture
    assert not wide.details and wide.picture.center().x() == pytest.approx(250), "it stands in the middle"
    part = close_up((0.0, 300.0), (ROWS, COLUMNS), low.details[0])
    assert part.top() == 0 and part.right() == COLUMNS  # never beyond the rim
    assert part.width() / part.height() == pytest.approx(low.details[0].width() / low.details[0].height())


def test_the_details_are_the_two_pictures_at_the_place_looked_at(window, image_panel):
    split_view = image_panel.split_view
    split_view.resize(900, 160)
    before, after = np.full((ROWS, COLUMNS), 0xFF204060, np.uint32), np.full((ROWS, COLUMNS), 0xFFA08060, np.uint32)
    split_view.show_pictures(before, after, ("", ""))
    painted = split_view.grab().toImage()
    for room, colour in zip(split_view.places().details, (0xFF204060, 0xFFA08060), strict=True):
        assert painted.pixel(room.center().toPoint()) == colour
    image_panel._paint(image_panel._answer)


def drop(widget, path) -> QDropEvent:
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    place, actions = QPointF(5, 5), Qt.DropAction.CopyAction
    for kind in (QDragEnterEvent, QDropEvent):
        at = place.toPoint() if kind is QDragEnterEvent else place
        event = kind(at, actions, data, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier)
        QApplication.sendEvent(widget, event)
    return event


def test_a_dropped_photo_is_opened_another_picture_refused_and_a_lens_left_to_the_window(
    window, image_panel, qtbot, tmp_path
):
    write_photo(tmp_path / "grey.png", np.full((20, 30, 3), 0.5, np.float32))
    assert drop(image_panel.widget, tmp_path / "grey.png").isAccepted()
    assert window.store.state.photo.source == str(tmp_path / "grey.png")
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert image_panel.split_view.before[5, 5] & 0xFF == pytest.approx(188, abs=1)  # sRGB of half the light
    said = []
    window.store.refused.connect(said.append)
    drop(image_panel.widget, tmp_path / "holiday.webp")
    assert [message.values for message in said] == [{"file": "holiday.webp"}]
    assert not drop(image_panel.widget, tmp_path / "lens.zmx").isAccepted()
    window.store.update(photo_source="text")


def test_a_photo_dropped_beside_the_open_panel_is_photographed_and_a_snapshot_still_opens(
    window, image_panel, tmp_path
):
    before = window.store.state
    write_photo(tmp_path / "grey.png", np.full((20, 30, 3), 0.5, np.float32))
    assert drop(window, tmp_path / "grey.png").isAccepted()
    assert window.store.state == change(before, photo_source=str(tmp_path / "grey.png"))
    assert not window.banner.isVisible()
    window.store.update(photo_source="text")
    write_picture(change(before, field_deg=7.0), png_of(window), tmp_path / "snapshot.png")
    drop(window, tmp_path / "snapshot.png")
    assert window.store.state.optics.field_deg == 7.0 and window.store.state.photo.source == "text"


def test_the_plan_is_told_behind_a_button_and_a_few_words_stand_under_the_controls(window, image_panel):
    words = image_panel.words
    assert words.button.menu() is not None and not words.isVisible()
    words.button.menu().popup(words.button.mapToGlobal(words.button.rect().bottomLeft()))
    assert words.isVisible() and len(words.text()) > 40
    words.button.menu().close()
    assert (
        "PSFs" in image_panel.headline.text()
        and unbroken(image_panel.headline.toolTip()) == image_panel.headline.text()
    )


@pytest.fixture
def orders(window, image_panel, qtbot, monkeypatch):
    """Return what plans are ordered from now on: none is made, so that a test tells how far one is."""
    monkeypatch.undo()  # plans may be ordered
    qtbot.waitUntil(lambda: not image_panel.fine.busy)
    made = []
    monkeypatch.setattr(image_panel.fine, "submit", lambda key, job: made.append(key))
    image_panel._answer = replace(image_panel._answer, quality="coarse")
    yield made
    image_panel._ordered = image_panel._stopped = image_panel._unplanned = image_panel._planned = None


def test_where_no_plan_can_be_made_the_coarse_picture_stays_and_the_words_say_why(window, image_panel, orders):
    image_panel._on_failure(image_panel._asked, Message("points 500 mm away blur over 2.4 mm; stop down"))
    assert image_panel.headline.text().startswith("Points 500\u00a0mm away")
    assert image_panel.widget.readout.text().startswith("coarse") and not image_panel.overlay.text
    image_panel._refine()
    assert not orders  # a second try would end the same
    reason = Message("points {depth:g} mm away blur over 6 mm; stop down", depth=inf)
    image_panel._on_failure(image_panel._asked, reason)
    assert image_panel.headline.text().startswith("Points ∞\u00a0mm away")


def test_a_picture_without_a_plan_says_why_under_the_controls(window, image_panel, orders):
    image_panel._on_answer(image_panel._asked, replace(image_panel._answer, no_plan=TOO_LARGE))
    assert image_panel.headline.text().startswith("No plan: these pixels hide")
    known = texts("de")
    german = Style(translate=lambda text: known.get(text, text))
    for reason in (TOO_WIDE, TOO_LARGE):
        assert reason.text(german).startswith("Kein Plan")
        assert UNMEASURED[reason].text(german).startswith("Ungemessen. Für so")
    image_panel._on_answer(image_panel._asked, replace(image_panel._answer, no_plan=None))


def test_a_plan_says_how_far_it_is_and_is_stopped_and_made_after_all(window, image_panel, orders, qtbot):
    line, asked = image_panel.plan_line, image_panel._asked
    window.store.update(psf_scale="log")  # the sliders rest: a plan is ordered
    image_panel.fine.progressed.emit(asked, 0.63)
    image_panel.fine.progressed.emit(asked, 0.2)  # of another step; a bar that goes back is none
    assert orders == [asked] and line.bar.isVisible() and line.bar.text() == "planning 63\u00a0%"
    qtbot.mouseClick(line.turn, Qt.MouseButton.LeftButton)
    assert line.turn.text() == "Plan it after all" and not line.bar.isVisible()
    assert image_panel.widget.readout.text().startswith("coarse")
    window.store.update(psf_scale="linear")
    assert orders == [asked]  # and it stays stopped while the picture is the same
    qtbot.mouseClick(line.turn, Qt.MouseButton.LeftButton)
    assert orders == [asked, asked] and line.bar.value() == 0
    image_panel._on_answer(asked, replace(image_panel._answer, quality="planned"))
    assert not line.isVisible() and image_panel.headline.isVisible()


def test_a_planned_picture_that_came_too_late_to_be_cancelled_is_no_cancelled_one(window, image_panel, orders, qtbot):
    """As one that another photo's plan made, when the photo whose plan was cancelled stands there again."""
    line, asked = image_panel.plan_line, image_panel._asked
    window.store.update(psf_scale="log")
    qtbot.mouseClick(line.turn, Qt.MouseButton.LeftButton)
    assert line.isVisible()
    image_panel._on_answer(asked, replace(image_panel._answer, quality="planned"))
    assert not line.isVisible() and image_panel.headline.isVisible()


def test_a_plan_is_ordered_though_the_one_before_has_not_yet_stopped(window, image_panel, orders, qtbot, monkeypatch):
    monkeypatch.setattr(image_panel.fine, "_cancelled", Event())  # as while a job is running
    window.store.update(field_deg=3.0)
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert orders == [image_panel._asked]


def test_another_photo_is_made_by_the_plan_there_is(window, image_panel, orders, qtbot):
    price = Cost(1.0, 1.0, 1.0)
    plan = replace(
        image_panel._answer.plan,
        decisions=(Decision(Message("depth"), Message("1 node"), Message("one"), 0.0, "depth"),),
        cost=price,
        naive=price,
    )
    by_plan = replace(image_panel._answer, quality="planned", plan=plan)
    image_panel._on_answer(image_panel._asked, by_plan)
    window.store.update(photo_source="siemens_star")
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert image_panel._answer.plan is by_plan.plan and image_panel._answer.lattice is by_plan.lattice and not orders
    assert np.array_equal(image_panel._answer.before, scene_values("siemens_star", (ROWS, COLUMNS)))
    window.store.update(field_deg=5.0)
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert image_panel._answer.plan is not by_plan.plan and orders == [image_panel._asked]


def test_the_share_of_a_plan_grows_to_where_that_of_its_picture_begins():
    told = []
    watch = Progress(told.append)
    step, picture = planning(watch), forming(watch)
    for _ in range(1000):
        step()
    picture.expect(2)
    picture.advance()
    picture.advance()
    assert told == sorted(told) and told[0] < 0.05 and told[999] <= PLANNING and told[-1] == pytest.approx(1.0)
    with pytest.raises(Cancelled):
        planning(Progress(told.append, lambda: True))()


def test_a_low_panel_in_a_small_window_gives_the_picture_its_height(window, image_panel):
    window.resize(1280, 800)
    window.store.update(rail=(), rail_side="bottom", stage_share=0.7)
    QApplication.processEvents()
    assert image_panel.split_view.area().height() > 0.85 * image_panel.widget.height()
    assert len(image_panel.split_view.places().details) == 2
    window.resize(1440, 900)


def test_a_photo_of_other_proportions_is_cut_and_the_panel_says_where(window, image_panel, qtbot, tmp_path):
    write_photo(tmp_path / "wide.png", np.full((20, 60, 3), 0.5, np.float32))
    window.store.update(photo_source=str(tmp_path / "wide.png"))
    qtbot.waitUntil(lambda: not image_panel._stale())
    assert image_panel._answer.cut == Message("sides of the photo cut off")
    assert image_panel.headline.text().startswith("Sides of the photo cut off")
    frame = dict(image_panel._answer.notes)[Message("Frame")]
    assert frame.values["percent"] == pytest.approx(50)  # 60 columns where 20 × 3/2 fit
    assert cut_away(str(tmp_path / "wide.png"), (80, 60)) == pytest.approx((0.0, 0.75))
    assert cut_away(str(tmp_path / "wide.png"), (10, 60)) == pytest.approx((0.5, 0.0))
    assert frame_notes("text", (ROWS, COLUMNS)) is None


def test_a_tall_panel_has_details_and_psf_under_the_picture():
    tall = places(320, 600, ROWS, COLUMNS)
    assert tall.picture.width() == 320 and len(tall.details) == 2
    for part in (*tall.details, tall.psf):
        assert part.top() > tall.picture.bottom() and part.bottom() <= 600 and part.right() <= 320.001
    assert tall.details[0].right() < tall.details[1].left() < tall.psf.left()


BEFORE, AFTER = 0xFF204060, 0xFFA08060


@pytest.mark.parametrize("size", [(900, 160), (320, 600), (300, 200)])
def test_side_by_side_shows_both_pictures_whole_and_looks_in_either(window, image_panel, qtbot, size):
    split_view = image_panel.split_view
    split_view.resize(*size)
    split_view.show_pictures(
        np.full((ROWS, COLUMNS), BEFORE, np.uint32), np.full((ROWS, COLUMNS), AFTER, np.uint32), ("", "")
    )
    split_view.show_look("side")
    try:
        painted = split_view.grab().toImage()
        first, second = split_view.halves()
        assert not first.intersects(second) and first.size() == second.size()
        for room, colour in ((first, BEFORE), (second, AFTER)):
            assert split_view.rect().toRectF().adjusted(-1, -1, 1, 1).contains(room)
            corner = room.bottomLeft() + QPointF(6, -6)
            assert painted.pixel(corner.toPoint()) == colour
        looked: list[tuple[float, float]] = []
        split_view.looked.connect(lambda row, column: looked.append((row, column)))
        none, keys = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier
        for room in (first, second):
            at = room.center()
            split_view.mouseMoveEvent(QMouseEvent(QEvent.Type.MouseMove, at, at, none, none, keys))
        middle = (ROWS - 1) / 2, (COLUMNS - 1) / 2
        assert [place == pytest.approx(middle, abs=1e-6) for place in looked] == [True, True]
    finally:
        split_view.show_look("split")
        image_panel._paint(image_panel._answer)


def test_blinking_shows_one_picture_after_the_other_and_stops_with_another_look(window, image_panel):
    window.store.update(photo_look="blink")
    split_view = image_panel.split_view
    split_view.resize(900, 160)
    split_view.show_pictures(
        np.full((ROWS, COLUMNS), BEFORE, np.uint32), np.full((ROWS, COLUMNS), AFTER, np.uint32), ("", "")
    )
    spot = (split_view.area().topLeft() + QPointF(8, 8)).toPoint()
    seen = []
    for _ in range(3):
        seen.append(split_view.grab().toImage().pixel(spot))
        split_view._turn()
    assert seen == [BEFORE, AFTER, BEFORE]
    assert split_view._blink.isActive()
    window.store.update(photo_look="split")
    assert not split_view._blink.isActive()
    image_panel._paint(image_panel._answer)


def test_a_picture_of_megapixels_is_painted_reduced_and_its_detail_whole(window, image_panel):
    split_view = image_panel.split_view
    split_view.resize(300, 200)
    large = np.full((1000, 1500), BEFORE, np.uint32)
    split_view.show_pictures(large, large, ("", ""))
    reduced = split_view._to_paint(large, split_view.area())
    assert reduced.shape[1] < 1500 and reduced.shape[1] >= 300
    assert split_view._to_paint(large, split_view.area()) is reduced, "made once"
    image_panel._paint(image_panel._answer)


def test_every_pixel_of_the_photo_is_a_choice_that_the_state_keeps(window, image_panel):
    image_panel.pixel.setCurrentIndex(image_panel.pixel.findData("full"))
    image_panel._choose_pixel()
    photo = window.store.state.photo
    assert photo.full and photo.pixel_um is None
    window.store.undo()
    assert not window.store.state.photo.full and image_panel.pixel.currentData() != "full"
