"""Looking closer in the image panel: keys, details, dropped photos, and the plan told behind a button."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QApplication

from app.copying import png_of
from app.roominess import close_up, rooms
from app.snapshot import write_picture
from app.views.image import COLUMNS, ROWS, local_psf, pixels
from p2sf.photos import write_photo


@pytest.fixture
def panel(window, qtbot):
    window.store.update(tab="image", photo_pixel_um=16.0, photo="text")
    made = window.panels["image"]
    qtbot.waitUntil(lambda: not made._stale(), timeout=30000)
    yield made
    window.store.update(tab="profiles")


def test_arrow_keys_move_the_place_looked_at_and_its_psf_with_it(window, panel, qtbot):
    wipe, split = panel.wipe, window.store.state.photo_split
    panel._look(100.0, 150.0)
    for key, place in (("Down", (108.0, 150.0)), ("Right", (108.0, 158.0)), ("Up", (100.0, 158.0))):
        qtbot.keyClick(wipe, getattr(Qt.Key, f"Key_{key}"))
        assert wipe.place == pytest.approx(place)
    panel._look(0.0, COLUMNS - 1.0)
    qtbot.keyClick(wipe, Qt.Key.Key_Right)
    assert wipe.place == pytest.approx((0.0, COLUMNS - 1.0)) and window.store.state.photo_split == split
    wanted = local_psf(panel._answer, 0.0, COLUMNS - 1.0)
    assert np.array_equal(wipe.loupe, pixels(np.sqrt(wanted)))


def test_a_low_panel_has_details_and_the_psf_beside_the_picture_and_a_narrow_one_the_psf_on_it():
    low, narrow = rooms(940, 170, ROWS, COLUMNS), rooms(320, 400, ROWS, COLUMNS)
    assert low.picture.height() == 170 and len(low.details) == 2
    assert low.loupe.right() == pytest.approx(940)  # all of the width is used
    edges = [low.picture, *low.details, low.loupe]
    assert all(one.right() < two.left() for one, two in pairwise(edges))
    assert narrow.picture.width() == 320 and not narrow.details and narrow.picture.contains(narrow.loupe)
    part = close_up((0.0, 300.0), (ROWS, COLUMNS), low.details[0])
    assert part.top() == 0 and part.right() == COLUMNS  # never beyond the rim
    assert part.width() / part.height() == pytest.approx(low.details[0].width() / low.details[0].height())


def test_the_details_are_the_two_pictures_at_the_place_looked_at(window, panel):
    wipe = panel.wipe
    wipe.resize(900, 160)
    before, after = np.full((ROWS, COLUMNS), 0xFF204060, np.uint32), np.full((ROWS, COLUMNS), 0xFFA08060, np.uint32)
    wipe.show_pictures(before, after, ("", ""))
    painted = wipe.grab().toImage()
    for room, colour in zip(wipe.rooms().details, (0xFF204060, 0xFFA08060), strict=True):
        assert painted.pixel(room.center().toPoint()) == colour
    panel._paint()


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
    window, panel, qtbot, tmp_path
):
    write_photo(tmp_path / "grey.png", np.full((20, 30, 3), 0.5, np.float32))
    assert drop(panel.widget, tmp_path / "grey.png").isAccepted()
    assert window.store.state.photo == str(tmp_path / "grey.png")
    qtbot.waitUntil(lambda: not panel._stale(), timeout=30000)
    assert panel.wipe.before[5, 5] & 0xFF == pytest.approx(188, abs=1)  # sRGB of half the light
    said = []
    window.store.refused.connect(said.append)
    drop(panel.widget, tmp_path / "holiday.jpg")
    assert said == ["holiday.jpg is no PNG or TIFF; save the photo as one of these and drop that"]
    assert not drop(panel.widget, tmp_path / "lens.zmx").isAccepted()
    window.store.update(photo="text")


def test_a_photo_dropped_beside_the_open_panel_is_photographed_and_a_snapshot_still_opens(window, panel, tmp_path):
    before = window.store.state
    write_photo(tmp_path / "grey.png", np.full((20, 30, 3), 0.5, np.float32))
    assert drop(window, tmp_path / "grey.png").isAccepted()
    assert window.store.state == replace(before, photo=str(tmp_path / "grey.png"))
    assert not window.banner.isVisible()
    window.store.update(photo="text")
    write_picture(replace(before, field_deg=7.0), png_of(window), tmp_path / "snapshot.png")
    drop(window, tmp_path / "snapshot.png")
    assert window.store.state.field_deg == 7.0 and window.store.state.photo == "text"


def test_the_plan_is_told_behind_a_button_and_one_line_stands_under_the_picture(window, panel):
    assert panel.why.menu() is not None and not panel.words.isVisible()
    panel.why.menu().popup(panel.why.mapToGlobal(panel.why.rect().bottomLeft()))
    assert panel.words.isVisible() and len(panel.words.text()) > 40
    panel.why.menu().close()
    assert "PSFs" in panel.headline.text() and panel.headline.toolTip() == panel.headline.text()


def test_where_no_plan_can_be_made_the_coarse_picture_stays_and_the_line_says_why(window, panel, qtbot, monkeypatch):
    asked = []
    monkeypatch.setattr(panel.fine, "submit", lambda *job: asked.append(job))
    panel.fine.cancel()
    qtbot.waitUntil(lambda: not panel.fine.busy, timeout=30000)
    panel._answer, asked[:] = replace(panel._answer, quality="coarse"), []
    panel._on_failure(panel._asked, "points 500 mm away blur over 2.4 mm; stop down")
    assert panel.headline.text().startswith("Points 500 mm away") and panel.widget.readout.text() == "coarse"
    panel._refine()
    assert not asked  # a second try would end the same
    panel._unplanned = None
