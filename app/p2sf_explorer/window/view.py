"""How the window is looked at: the size of type, what is shown beside the stage, and where the keyboard goes."""

from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, QPoint, Qt
from PySide6.QtWidgets import QApplication, QWidget

from p2sf_explorer.state.limits import RANGES
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command

BAR = "bar"  # the object name of a bar, whose parts stand in a row
LOW, HIGH = RANGES["scale_percent"][:2]
PERCENTS = (LOW, 67.0, 75.0, 80.0, 90.0, 100.0, 110.0, 125.0, 150.0, 175.0, 200.0, 250.0, HIGH)


class View(QObject):
    """The commands of the view. ``scale()`` is the present size of type, 1.0 for the plain one.

    ``parts()`` are the parts of the window that F6 goes through, from the top left.
    """

    def __init__(
        self, store: Store, scale: Callable[[], float], parts: Callable[[], tuple[QWidget, ...]], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._store, self._scale, self._parts = store, scale, parts

    def commands(self) -> tuple[Command, ...]:
        """Return what can be done by name or key."""
        return (
            Command("Larger type", lambda: self.step(1), ("Ctrl++", "Ctrl+="), "View"),
            Command("Smaller type", lambda: self.step(-1), ("Ctrl+-",), "View"),
            Command("Type that suits the screen", self.reset, ("Ctrl+0",), "View"),
            Command("Show or hide the controls", lambda: self._turn("show_controls"), ("F8",), "View"),
            Command("More or fewer controls", lambda: self._turn("show_more"), ("Ctrl+F8",), "View"),
            Command("Fold or unfold the pupil shape", lambda: self._turn("show_pupil_shape"), ("Shift+F8",), "View"),
            Command(
                "Picture to the edges, or within its axes", lambda: self._turn("full_bleed"), ("Shift+F10",), "View"
            ),
            Command("Show or hide what stands beside the stage", lambda: self._turn("show_rail"), ("F9",), "View"),
            Command("Rail at the right or at the bottom", self._turn_rail, ("Shift+F9",), "View"),
            Command("To the next part of the window", lambda: self.go(1), ("F6",), "View"),
            Command("To the previous part of the window", lambda: self.go(-1), ("Shift+F6",), "View"),
        )

    def step(self, step: int) -> None:
        """Take the next larger or smaller size of type."""
        now = 100 * self._scale()
        larger = [size for size in PERCENTS if size > now + 0.5]
        smaller = [size for size in PERCENTS if size < now - 0.5]
        if found := larger[:1] if step > 0 else smaller[-1:]:
            self._store.update(scale_percent=found[0])

    def reset(self) -> None:
        """Take the size of type that suits the screen."""
        self._store.update(scale_percent=None)

    def _turn(self, name: str) -> None:
        self._store.update(**{name: not getattr(self._store.state.display, name)})

    def _turn_rail(self) -> None:
        sides = {"right": "bottom", "bottom": "right"}
        self._store.update(rail_side=sides[self._store.state.display.rail_side], show_rail=True)

    def go(self, step: int) -> None:
        """Give the keyboard to the next or previous part of the window."""
        parts = [part for part in self._parts() if part.isVisible() and stops(part)]
        focused = QApplication.focusWidget()
        at = next((k for k, part in enumerate(parts) if focused and part.isAncestorOf(focused)), -1 if step > 0 else 0)
        if parts:
            stops(parts[(at + step) % len(parts)])[0].setFocus(Qt.FocusReason.TabFocusReason)


def stops(part: QWidget) -> list[QWidget]:
    """Return the widgets of a part at which Tab stops: in a bar from left to right, else in Qt's own order."""
    return _stops_within(part, _focus_ring(part))


def _focus_ring(first: QWidget) -> list[QWidget]:
    """Return a widget and those that follow it in Qt's own order, which is a ring."""
    ring = [first]
    while (after := ring[-1].nextInFocusChain()) is not None and after is not first:
        ring.append(after)
    return ring


def _stops_within(part: QWidget, ring: list[QWidget]) -> list[QWidget]:
    at = ring.index(part)
    inside = [each for each in (*ring[at + 1 :], *ring[:at]) if part.isAncestorOf(each) and each.isVisibleTo(part)]
    able = [each for each in inside if each.focusPolicy() & Qt.FocusPolicy.TabFocus and not each.focusProxy()]
    found = [each for each in able if each.isEnabled()]
    return sorted(found, key=lambda each: each.mapTo(part, QPoint()).x()) if part.objectName() == BAR else found


def next_stop(window: QWidget, parts: Iterable[QWidget], focused: QWidget | None, step: int) -> QWidget | None:
    """Return where Tab (step 1) or Shift+Tab (−1) goes: through the parts in their order, and then whatever is left.

    Qt's own order cannot be kept up while panels move: `QWidget.setTabOrder` breaks the ring that it is at widgets
    which lend their focus to a parent, such as the viewport of a scroll area.
    """
    ring = _focus_ring(window)
    shown = (part for part in (*parts, window) if part.isVisible())
    found = (_stops_within(part, ring) if part in ring else stops(part) for part in shown)  # some in other windows
    every = list(dict.fromkeys(stop for each in found for stop in each))
    if focused not in every:
        return None
    return every[(every.index(focused) + step) % len(every)]
