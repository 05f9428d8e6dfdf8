"""At first some controls, the others under a fold; what differs from the lens file is never hidden."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QAbstractSlider, QComboBox, QLineEdit, QTabBar

from p2sf.parameters import PARAMETERS
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
    assert all(part.isVisible() for part in below(folded).values()) and count(folded) >= few + 10
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


def test_every_entry_below_the_fold_is_shown_when_it_is_set(folded):
    """A number of the mask that is forgotten here would be hidden while it changes the picture."""
    for name in MASK:
        value = PARAMETERS[name].typed[0]
        folded.store.update(**{name: value})
        assert folded.controls.shape.isVisible(), name
        folded.store.update(**{name: None})
        assert not folded.controls.shape.isVisible(), name


def test_a_lesson_points_to_a_slider_below_the_fold(folded):
    lesson = read_lesson(FOLDER / "14_hubble.md")
    number = next(n for n, step in enumerate(lesson.steps) if step.move == "sensor_shift_um")
    state = change(lesson.state(number, folded.store.state), sensor_shift_um=0.0, show_more=False)
    folded.store.replace(state)
    assert folded.controls.rows["sensor_shift_um"].isVisible()
    folded.store.replace(change(state, lesson_name=""))
    assert not folded.controls.rows["sensor_shift_um"].isVisible()
