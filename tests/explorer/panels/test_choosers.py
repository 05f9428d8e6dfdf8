"""Whatever a person can choose in the window is part of its state: undo, snapshots, links and sessions carry it."""

from dataclasses import fields

import pytest
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QTabBar, QToolButton

from p2sf.errors import Cancelled
from p2sf_explorer.compute.views import tolerances as analysis
from p2sf_explorer.panels.misalign import PIECE_TIP
from p2sf_explorer.panels.solid import SolidPanel
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import PanelChoices, State, entry
from tests.support.windows.events import choose

KINDS = QComboBox, QAbstractButton, QAbstractSpinBox, QTabBar
BARS = {
    "controls": lambda window: window.controls,
    "play": lambda window: window.play,
    "exactness": lambda window: window.top.tolerance.panel,
}


def choosers(part) -> list:
    """Return the widgets of a part that hold a choice, and the actions of its menus that do.

    Which piece *Misalign* shows is what is selected in the layout and the table too, and no part of the state.
    """
    found = [box for kind in KINDS for box in part.findChildren(kind) if box.toolTip() != PIECE_TIP]
    found = [box for box in found if not isinstance(box, QComboBox) or box.count()]  # a list may offer no numbers
    actions = [each for b in part.findChildren(QToolButton) if b.menu() for each in b.menu().actions()]
    return [box for box in (*found, *actions) if not isinstance(box, QAbstractButton | QAction) or box.isCheckable()]


def chosen(box):
    """Return what a chooser says."""
    if isinstance(box, QComboBox):
        return box.currentText()
    if isinstance(box, QTabBar):
        return box.currentIndex()
    return box.value() if isinstance(box, QAbstractSpinBox) else box.isChecked()


def use(box) -> None:
    """Choose something else."""
    if isinstance(box, QComboBox):
        choose(box, next(value for k in range(box.count()) if k != box.currentIndex() and (value := box.itemData(k))))
    elif isinstance(box, QTabBar):
        box.setCurrentIndex((box.currentIndex() + 1) % box.count())
    elif isinstance(box, QAbstractSpinBox):
        box.setValue(box.value() + 10 ** (1 - box.decimals()))
    else:
        box.trigger() if isinstance(box, QAction) else box.click()


def check(window, part) -> None:
    """Use every chooser of a part: the state, and a link to it, tell the choice, and undo takes it back."""
    for number in range(len(choosers(part))):
        box, before = choosers(part)[number], window.store.state
        was, name = chosen(box), f"{box.toolTip() or box.text()!r}, {chosen(box)!r}"
        use(box)
        state = window.store.state
        assert state != before, f"{name} is no part of the state: bind it to an entry"
        assert state_of_link(link(state)) == state
        window.store.undo()
        assert window.store.state == before, name
        assert chosen(choosers(part)[number]) == was, f"{name} does not follow the state"


@pytest.fixture
def idle(monkeypatch):
    """Leave panels without what takes them long: the view of 3D is there without its renderer, and no lens is built."""
    monkeypatch.setattr(SolidPanel, "_probe", lambda panel: None)
    monkeypatch.setattr(analysis.Analyst, "answer", lambda *_: (_ for _ in ()).throw(Cancelled("none")))


@pytest.mark.parametrize("key", [entry.key for entry in REGISTRY])
def test_every_chooser_of_a_panel_is_in_the_state(window, key, idle):
    """Those of every registered panel, one that is added later too."""
    window.open_panel(key)
    check(window, window.panels[key].widget)


@pytest.mark.parametrize("key", BARS)
def test_every_chooser_around_the_panels_is_in_the_state(window, key):
    window.store.update(playback_slider="field_deg")
    check(window, BARS[key](window))


def test_every_choice_of_a_panel_has_one_chooser_that_offers_its_values(window, idle):
    bound = [("exactness_measure", window.top.tolerance.panel.measure), ("playback_subject", window.play.subject)]
    for panel in REGISTRY:
        window.open_panel(panel.key)
        bound += window.panels[panel.key].widget.choosers.items()
    names = [name for name, _ in bound]
    assert all(names.count(field.name) == 1 for field in fields(PanelChoices))
    for name, box in bound:
        assert {box.itemData(k) for k in range(box.count())} == set(CHOICES[name]), name
        assert entry(State(), name) in CHOICES[name]
