"""The gallery of shipped lenses: by mouse, by keys, and nothing of it at start."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from p2sf_explorer.compute.setup import shipped_names
from p2sf_explorer.state.state import State, new_state
from p2sf_explorer.window.lens_cards import lens_card, shown_title
from p2sf_explorer.window.lens_chooser import NAME
from p2sf_explorer.window.window import MainWindow


@pytest.fixture
def gallery(window, qtbot):
    """Return the open gallery, opened by a click."""
    qtbot.mouseClick(window.top.lens, Qt.MouseButton.LeftButton)
    yield window.top.lens.gallery
    window.top.lens.gallery.hide()


def index_of(gallery, name):
    model = gallery.list.model()
    return model.match(model.index(0, 0), NAME, name, 1, Qt.MatchFlag.MatchExactly)[0]


def test_the_gallery_opens_on_the_present_lens_and_draws_what_is_in_sight(window, gallery, qtbot):
    assert gallery.isVisible()
    assert gallery.list.currentIndex().data(NAME) == window.store.state.optics.lens
    assert gallery.list.model().rowCount() == len(shipped_names())
    qtbot.waitUntil(lambda: len(gallery.cards.known) >= 8)
    before = gallery.list.viewport().grab().toImage()
    gallery.cards.known = {}
    assert gallery.list.viewport().grab().toImage() != before


def test_a_click_opens_a_lens_as_one_undo(window, gallery, qtbot):
    first, index = window.store.state, index_of(gallery, "cooke_triplet")
    gallery.list.scrollTo(index)
    place = gallery.list.visualRect(index).center()
    qtbot.mouseClick(gallery.list.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert window.live.state.optics.lens == "cooke_triplet"
    assert not gallery.isVisible()
    window.store.undo()
    assert window.store.state == first


def test_keys_alone_choose_a_lens(window, qtbot):
    window.top.lens.setFocus()
    qtbot.keyClick(window.top.lens, Qt.Key.Key_Down)
    gallery = window.top.lens.gallery
    assert gallery.isVisible()
    qtbot.keyClick(gallery.list, Qt.Key.Key_Home)
    qtbot.keyClick(gallery.list, Qt.Key.Key_Right)
    wanted = gallery.list.currentIndex().data(NAME)
    qtbot.keyClick(gallery.list, Qt.Key.Key_Return)
    assert window.live.state.optics.lens == wanted == shipped_names()[1]


def test_escape_leaves_the_lens(window, gallery, qtbot):
    lens = window.store.state.optics.lens
    qtbot.keyClick(gallery.list, Qt.Key.Key_Right)
    qtbot.keyClick(gallery.list, Qt.Key.Key_Escape)
    assert not gallery.isVisible()
    assert window.store.state.optics.lens == lens


def test_letters_find_a_lens(window, gallery, qtbot):
    qtbot.keyClicks(gallery.list, "tess")
    assert gallery.list.currentIndex().data(NAME) == "tessar"


def test_a_new_window_has_worked_out_no_card(qapp):
    made = MainWindow(new_state(method="seidel", theme="light"), measured=False)
    made.show()
    QApplication.processEvents()
    assert made.top.lens.gallery is None
    made.close()


@pytest.mark.parametrize("name", shipped_names())
def test_every_shipped_lens_has_a_whole_card(name):
    card = lens_card(name)
    assert card.drawing
    assert card.character
    assert card.facts.startswith("f′")


def test_a_lens_that_cannot_be_read_says_why(tmp_path):
    path = tmp_path / "broken.toml"
    path.write_text("radius = ")
    card = lens_card(str(path))
    assert card.drawing is None
    assert "line 1" in str(card.problem)


def test_the_bar_names_a_foreign_lens_by_its_own_title(window):
    assert shown_title(State()) == "Double Gauss, 28 degree field, f/3, 100 mm"
    assert shown_title(new_state(lens="/nowhere/x.zmx")) == "/nowhere/x.zmx"
