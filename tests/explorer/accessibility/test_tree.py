"""Whoever does not see the window is told what everything in it is: names, roles, values, a lesson read aloud."""

import re

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QApplication, QScrollArea, QWidget

from p2sf_explorer.application.crash_dialog import CrashDialog
from p2sf_explorer.panels.solid import SolidPanel
from p2sf_explorer.state.panels import REGISTRY
from tests.support.windows.screen_reader import EMPTY, nodes, transcript

ROLE = QAccessible.Role
LETTER = re.compile(r"[^\W\d_]")
# Widgets that only scroll, and the parts of Qt's own that have no name in any program.
PASSIVE = QScrollArea


def wanting(window) -> dict[str, str]:
    """Return what is wrong with each interactive node: no name in letters, or no role."""
    found = {}
    for node in nodes(window):
        if not node.focusable or isinstance(node.widget, PASSIVE) or node.role == ROLE.Cell:  # whose name is its text
            continue
        # On Linux Qt gives a combo box its present choice as name; what it chooses is its description.
        name = node.description if node.role == ROLE.ComboBox else node.name
        where = f"{type(node.widget).__name__} {node.name!r} {node.widget.objectName() if node.widget else ''}"
        if not LETTER.search(name):
            found[where] = "no name"
        elif node.role in EMPTY:
            found[where] = f"no role: {node.role.name}; give its class an accessible_role"
    return found


@pytest.mark.parametrize("key", [entry.key for entry in REGISTRY])
def test_everything_interactive_has_a_name_and_a_role(window, key, monkeypatch):
    """Every registered panel, one that is added later too, and what is around them."""
    monkeypatch.setattr(SolidPanel, "_probe", lambda panel: None)  # the view is there without its renderer
    window.open_panel(key)
    window.store.update(show_pupil_shape=True, playback_slider="field_deg")
    QApplication.processEvents()
    part = window if key == REGISTRY[0].key else window.panels[key].widget
    assert not (wrong := wanting(part)), "\n".join(f"{where}: {why}" for where, why in wrong.items())


OPENED = {
    "handbook": lambda window: window.commands.theory(),
    "shortcuts": lambda window: window.commands.help(),
    "palette": lambda window: window.commands.find(),
    "lenses": lambda window: window.top.lens.open_gallery(),
    "exactness": lambda window: window.top.tolerance.click(),
    "set of exports": lambda window: window.commands.ask_set(),
    "crash": lambda window: CrashDialog("what happened", True, window).open(),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", OPENED)
def test_what_opens_above_the_window_has_names_and_roles_too(window, name):
    OPENED[name](window)
    QApplication.processEvents()
    above = [part for part in window.findChildren(QWidget) if part.isWindow() and part.isVisible()]
    try:
        assert above
        for part in above:
            assert not (wrong := wanting(part)), "\n".join(f"{where}: {why}" for where, why in wrong.items())
    finally:
        for part in above:
            part.close()


def test_the_tree_has_the_sliders_with_what_they_stand_at(window):
    window.store.update(field_deg=7.5)
    told = [node.words() for node in nodes(window.controls)]
    assert "Field, slider" in told and "Field, entry, 7.50°" in told


def test_panels_are_groups_and_their_pictures_charts(window):
    window.open_panel("mtf")
    roles = {node.name: node.role for node in nodes(window)}
    assert roles["MTF"] in (ROLE.Grouping, ROLE.PageTab)
    assert any(node.role == ROLE.Chart and node.name.startswith("Plot") for node in nodes(window))


def test_the_first_lesson_read_aloud_makes_sense(window):
    """Title, text, what to try, the question and the buttons, in the order in which they stand, step by step."""
    window.teaching.toggle()
    lesson = window.teaching.lessons()[window.store.state.lesson.name]
    for number, step in enumerate(lesson.steps, 1):
        window.teaching.reveal()
        QApplication.processEvents()
        told = transcript(window.teaching.panel)
        print(*told, sep="\n")
        text = " | ".join(told)
        hoped = (f"step {number} of {len(lesson.steps)}", "Exit, button", step.title, step.question, "Next")
        at = [text.index(part) for part in hoped if part]
        assert at == sorted(at)
        assert not step.attempt or "Try" in text
        assert not re.search(r"<\w+|&\w+;|\*\*", text), "no mark-up is read out"
        assert all(LETTER.search(line) for line in told)
        if number < len(lesson.steps):
            window.teaching.move(1)
    window.teaching.leave()


@pytest.mark.parametrize("key", ["mtf", "lens", "image"])
def test_from_right_to_left_nothing_overlaps_and_everything_is_there(window, key):
    """As for Arabic or Hebrew; plots, sliders and numbers stay as they are, what stands beside them is mirrored."""
    window.open_panel(key)
    QApplication.processEvents()
    before = window.top.lens.mapTo(window, window.top.lens.rect().center()).x()
    QApplication.setLayoutDirection(Qt.LayoutDirection.RightToLeft)
    try:
        QApplication.processEvents()
        window.refresh(window.store.state)
        QApplication.processEvents()
        assert window.top.lens.mapTo(window, window.top.lens.rect().center()).x() > window.width() / 2 > before
        for bar in (window.top, window.controls, *window.controls.rows.values()):
            assert not (over := overlapping(bar)), over
        assert window.grab().width() == window.width()
    finally:
        QApplication.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        QApplication.processEvents()


def overlapping(parent) -> list[str]:
    """Return the visible children of a widget that lie on each other, or reach beyond it."""
    parts = [w for w in parent.children() if w.isWidgetType() and w.isVisible() and w.width() and w.height()]
    met = [
        f"{type(a).__name__} on {type(b).__name__}"
        for k, a in enumerate(parts)
        for b in parts[k + 1 :]
        if (both := a.geometry().intersected(b.geometry())).width() > 1 and both.height() > 1
    ]
    return met
