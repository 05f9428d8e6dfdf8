"""At first some controls, the others under a fold; what differs from the lens file is never hidden."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QAbstractSlider, QComboBox, QLineEdit, QTabBar

from p2sf.lensfile.library import find_lens
from p2sf.lensfile.writing import lens_to_toml
from p2sf.parameters import PARAMETERS
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.lessons.lesson import FOLDER, read_lesson
from p2sf_explorer.state.limits import MASK
from p2sf_explorer.state.state import change

CLICKED = QAbstractButton, QComboBox, QLineEdit, QAbstractSlider, QTabBar


@pytest.fixture
def folded(window):
    """Return the window as a person first sees it, with the controls of a first look."""
    window.store.replace(change(window.store.state, show_more=False, method="auto", tolerance=0.99))
    return window


def below(window):
    """Return what stands under the fold, by name."""
    controls, top = window.controls, window.top
    return {
        "sensor_shift_um": controls.rows["sensor_shift_um"],
        "mask": controls.shape,
        "stop": controls.stopping,
        "aim": controls.aiming,
        "autofocus": controls.focus_button,
        "method": top.method,
        "tolerance": top.tolerance,
    }


def count(window) -> int:
    """Return how many widgets of the column and the bar a person can click or type into."""
    parts = (part for whole in (window.controls, window.top) for kind in CLICKED for part in whole.findChildren(kind))
    return sum(part.isVisible() for part in parts)


def test_the_fold_hides_and_shows_everything_below_it(folded, qtbot):
    assert not [name for name, part in below(folded).items() if part.isVisible()]
    few = count(folded)
    qtbot.mouseClick(folded.controls.more, Qt.MouseButton.LeftButton)
    assert all(part.isVisible() for part in below(folded).values()) and count(folded) >= few + 9
    qtbot.keyClick(folded, Qt.Key.Key_F8, Qt.KeyboardModifier.ControlModifier)
    assert count(folded) == few


@pytest.mark.parametrize(
    ("changed", "shown"),
    [
        ({"sensor_shift_um": 20.0}, {"sensor_shift_um"}),
        ({"obscuration": 0.3}, {"mask"}),
        ({"show_pupil_shape": True}, {"mask"}),
        ({"stop": "auto"}, {"stop"}),
        ({"clip": True}, {"stop"}),
        ({"aim": "paraxial"}, {"aim"}),
        ({"method": "seidel"}, {"method", "tolerance"}),
        ({"tolerance": 0.9}, {"method", "tolerance"}),
    ],
)
def test_what_differs_from_the_file_is_shown_above_the_fold_too(folded, changed, shown):
    folded.store.update(**changed)
    assert {name for name, part in below(folded).items() if part.isVisible()} == shown


def test_every_entry_below_the_fold_is_shown_when_it_is_set(folded, qtbot):
    """A number of the mask that is forgotten here would be hidden while it changes the picture."""
    for name in MASK:
        value = PARAMETERS[name].typed[0]
        folded.store.update(**{name: value})
        assert folded.controls.shape.isVisible(), name
        folded.store.update(**{name: None})
        assert folded.controls.shape.isVisible(), "what is set back stays under the hand"
        for _ in range(2):
            qtbot.keyClick(folded, Qt.Key.Key_F8, Qt.KeyboardModifier.ControlModifier)
        assert not folded.controls.shape.isVisible(), name


def test_a_lesson_points_to_a_slider_below_the_fold(folded):
    lesson = read_lesson(FOLDER / "14_hubble.md")
    number = next(n for n, step in enumerate(lesson.steps) if step.move == "sensor_shift_um")
    state = change(lesson.state(number, folded.store.state), sensor_shift_um=0.0, show_more=False)
    folded.store.replace(state)
    assert folded.controls.rows["sensor_shift_um"].isVisible()
    folded.store.replace(change(state, lesson_name=""))
    assert not folded.controls.rows["sensor_shift_um"].isVisible()


def test_a_slider_below_the_fold_stays_where_it_is_stepped_through_its_default(folded, qtbot):
    row = folded.controls.rows["sensor_shift_um"]
    folded.store.update(sensor_shift_um=0.5)
    row.slider.setFocus()
    for _ in range(6):
        qtbot.keyClick(row.slider, Qt.Key.Key_Left)
    assert row.isVisible() and folded.store.state.optics.sensor_shift_um < 0
    folded.store.update(sensor_shift_um=0.0, method="seidel")
    folded.store.update(method="auto")
    assert row.isVisible() and folded.top.method.isVisible()


def test_a_lens_whose_own_rays_fill_the_paraxial_pupil_hides_that_and_shows_another(folded, tmp_path):
    path = tmp_path / "paraxial.toml"
    path.write_text(lens_to_toml(replace(find_lens("singlet_f6"), aim="paraxial")), encoding="utf-8")
    folded.store.replace(change(default_state(str(path)), show_more=False))
    assert folded.store.state.optics.aim == "paraxial" and not folded.controls.aiming.isVisible()
    folded.store.update(aim="stop")
    assert folded.controls.aiming.isVisible()


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_the_slider_that_a_page_is_about_is_in_view(folded, qtbot, size):
    """Also where its row is below the fold, and on the next page with the same slider."""
    folded.resize(*size)
    lesson = read_lesson(FOLDER / "14_hubble.md")
    row = folded.controls.rows["sensor_shift_um"]
    for number in (n for n, step in enumerate(lesson.steps) if step.move == "sensor_shift_um"):
        folded.store.replace(lesson.state(number, change(folded.store.state, show_more=False)))
        qtbot.waitUntil(lambda: not row.slider.visibleRegion().isEmpty())  # the column scrolls once it is laid out
