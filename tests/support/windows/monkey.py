"""Random use of the explorer by mouse and keys, with the CPU time of the GUI thread for each event.

An event is what Qt would send to the window: a press, a move, a release, a key with its repeats one by one, a turn of
the wheel, a menu entry, an edit. The window computes an answer to each. Events come in bursts, as from a person: a drag
has tens of moves and a held key repeats, and those that arrive while a frame is painted share one repaint (`FRAME`).
"""

import random
import sys
from collections import Counter
from dataclasses import dataclass, field
from statistics import median
from time import thread_time

from PySide6.QtCore import QPoint, QSize, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication

from p2sf_explorer.state.state import State, new_state
from p2sf_explorer.window.window import MainWindow
from tests.support.windows.events import send_key, turn_wheel, type_text

STALL_MS = 250.0
SPACE = "p2sf_explorer.scene3d.renderer"  # loaded at the first opening of 3D, which may take its time
FRAME = 8  # moves of a mouse that reports 500 times a second, or repeats of a key, in one frame
LEFT, KEY = Qt.MouseButton.LeftButton, Qt.Key
TYPED = "0 1 2 m;inf;∞;-5;500 mm;3 cm;far;1e3;1e300;nan;12°;550 nm;0.5 µm;f/4;2,5;;1e-9;89.9".split(";")
EDITS = "0 1 -1 50 -50 1e6 inf 1.5 N-BK7 SF6 UNOBTAINIUM 0.001 nan x".split()
KEYS = (KEY.Key_Left, KEY.Key_Right, KEY.Key_PageUp, KEY.Key_PageDown, KEY.Key_Home, KEY.Key_End, KEY.Key_Up)


@dataclass
class Ledger:
    """CPU ms of the GUI thread per event, by the kind of event; of the first opening of 3D apart."""

    cost: list[float] = field(default_factory=list)
    slow: list[str] = field(default_factory=list)
    worst: tuple[float, str] = (0.0, "")
    done: Counter = field(default_factory=Counter)
    first_3d: float = 0.0

    def note(self, name: str, milliseconds: float, state: State) -> None:
        self.cost.append(milliseconds)
        self.done[name] += 1
        self.worst = max(self.worst, (milliseconds, name))
        if milliseconds > STALL_MS:
            o = state.optics
            setup = f"{o.lens[-30:]}, {o.method}, {state.display.tab}, {o.field_deg:g}°, {o.depth_mm:g} mm"
            self.slow.append(f"{name} {milliseconds:.0f} ms ({setup})")


class Person:
    """Does one random thing after another to the window, by mouse and keys."""

    def __init__(self, window: MainWindow, chance: random.Random):
        self.window, self.chance, self.ledger, self.drawn = window, chance, Ledger(), False

    def act(self) -> None:
        """Do one thing, weighted as a person would."""
        names, weights = zip(*HABITS.items(), strict=True)
        getattr(self, self.chance.choices(names, weights)[0])()
        self.clear_away()

    def clear_away(self) -> None:
        """Close what a click has opened above the window."""
        for _ in range(3):
            popup = QApplication.activePopupWidget() or QApplication.activeModalWidget()
            if popup is None:
                return
            popup.close()

    def event(self, name: str, action, *arguments, painted: bool = True, **words) -> None:
        """Send an event, let the window answer and paint, and charge what that cost the GUI thread."""
        begun, loaded = thread_time(), SPACE in sys.modules
        action(*arguments, **words)
        if painted:
            QApplication.processEvents()
        if self.first_in_space(loaded):
            self.ledger.first_3d += 1e3 * (thread_time() - begun)
            return
        self.ledger.note(name, 1e3 * (thread_time() - begun), self.window.store.state)

    def first_in_space(self, loaded: bool) -> bool:
        """Return whether the event loaded what draws the lens in space, or asked it for its first picture."""
        solid = self.window.panels.get("solid")
        first = not self.drawn and solid is not None and solid.renderer is not None and solid.widget.isVisible()
        self.drawn = self.drawn or first
        return first or (SPACE in sys.modules and not loaded)

    def quiet(self) -> None:
        """Let the background finish, so that two looks at the memory see the same."""
        workers = self.window.measuring.late, self.window.late_sums
        for worker in workers:
            worker.forget()
        for _ in range(1000):
            if not any(worker.busy for worker in workers):
                return
            QTest.qWait(20)

    def slider(self):
        return self.chance.choice(list(self.window.controls.rows.values())).slider

    def drag(self) -> None:
        slider = self.slider()
        places = [QPoint(self.chance.randrange(-5, slider.width() + 5), 11) for _ in range(2)]
        self.carry(slider, *places, "drag a slider")

    def carry(self, widget, first: QPoint, last: QPoint, name: str) -> None:
        """Press, move in steps, let go."""
        steps = self.chance.randrange(10, 90)
        self.event(name, QTest.mousePress, widget, LEFT, pos=first)
        for k in range(1, steps + 1):
            place = first + (last - first) * (k / steps)
            self.event(name, QTest.mouseMove, widget, pos=place, painted=k % FRAME == 0)
        self.event(name, QTest.mouseRelease, widget, LEFT, pos=last)

    def press_keys(self) -> None:
        """Tap a key a few times, or hold it: its repeats come without releases."""
        slider = self.slider()
        slider.setFocus()
        if self.chance.random() < 0.5:
            for _ in range(self.chance.randrange(1, 6)):
                self.event("keys on a slider", QTest.keyClick, slider, self.chance.choice(KEYS))
            return
        key = self.chance.choice(KEYS)
        for k in range(1, self.chance.randrange(10, 40)):
            self.event("hold a key on a slider", send_key, slider, key, k > 1, painted=k % FRAME == 0)
        self.event("keys on a slider", QTest.keyRelease, slider, key)

    def type_a_value(self) -> None:
        edit = self.chance.choice(list(self.window.controls.rows.values())).edit
        edit.selectAll()
        self.event("type a value", type_text, edit, self.chance.choice(TYPED))
        self.event("type a value", QTest.keyClick, edit, self.chance.choice((KEY.Key_Return, KEY.Key_Escape)))

    def reset(self) -> None:
        self.event("double-click a slider", QTest.mouseDClick, self.slider(), LEFT)

    def press_a_button(self) -> None:
        """Press any button on show; those with a menu hold the event loop, see `take_an_entry`."""
        buttons = [b for b in self.window.findChildren(QAbstractButton) if b.isVisible() and not has_menu(b)]
        button = self.chance.choice(buttons)
        self.event(f"press {button.text() or type(button).__name__}", QTest.mouseClick, button, LEFT)

    def choose_a_lens(self) -> None:
        chooser = self.window.top.lens
        self.event("open the gallery", QTest.mouseClick, chooser, LEFT)
        listed = chooser.gallery.list
        for key in self.chance.choices((KEY.Key_Down, KEY.Key_Right, KEY.Key_Up, KEY.Key_PageDown), k=4):
            self.event("browse the gallery", QTest.keyClick, listed, key)
        self.event("choose a lens", QTest.keyClick, listed, KEY.Key_Return)

    def choose_a_method(self) -> None:
        box = self.window.top.method
        self.event("choose a method", QTest.keyClick, box, self.chance.choice((KEY.Key_Down, KEY.Key_Up)))

    def open_a_tab(self) -> None:
        bar = self.window.tabs.tabBar()
        place = bar.tabRect(self.chance.randrange(bar.count())).center()
        self.event("open a tab", QTest.mouseClick, bar, LEFT, pos=place)

    def close_a_window(self) -> None:
        """Put a panel that stands in a window of its own back, as one does before there are too many."""
        if self.window.floating.open:
            own = self.chance.choice(list(self.window.floating.open.values()))
            self.event("close a window", own.close)

    def step_in_time(self) -> None:
        button = self.chance.choice((self.window.top.undo, self.window.top.redo))
        for _ in range(self.chance.randrange(1, 5)):
            self.event("undo, redo", QTest.mouseClick, button, LEFT)

    def touch_a_panel(self) -> None:
        """Click, drag, double-click or turn the wheel anywhere on a panel."""
        panels = [panel.widget for panel in self.window.panels.values() if panel.widget.isVisible()]
        panel = self.chance.choice(panels)
        place, other = (QPoint(*(self.chance.randrange(max(1, side)) for side in size_of(panel))) for _ in range(2))
        target = panel.childAt(place) or panel
        if isinstance(target, QAbstractButton) and has_menu(target):
            return
        place, other = target.mapFrom(panel, place), target.mapFrom(panel, other)
        kind = self.chance.randrange(4)
        if kind == 0:
            self.carry(target, place, other, "drag on a panel")
        elif kind == 1:
            self.event("double-click a panel", QTest.mouseDClick, target, LEFT, pos=place)
        elif kind == 2:
            for _ in range(self.chance.randrange(1, 8)):
                self.event("wheel on a panel", turn_wheel, target, place, self.chance.choice((-120, 120, 1200)))
        else:
            self.event("point at a panel", QTest.mouseMove, target, pos=place)

    def edit_the_lens(self) -> None:
        """Type into a cell of the lens table."""
        self.window.open_panel("lens")
        model = self.window.panels["lens"].model
        cell = model.index(self.chance.randrange(model.rowCount()), self.chance.randrange(model.columnCount()))
        if model.flags(cell) & Qt.ItemFlag.ItemIsEditable:
            self.event("edit the lens", model.setData, cell, self.chance.choice(EDITS))

    def take_an_entry(self) -> None:
        """Take an entry of the snapshot or the open menu; the file dialogs are answered."""
        menu = self.chance.choice((self.window.top.snapshot.menu(), self.window.top.open.menu()))
        entries = [action for action in menu.actions() if not action.menu() and not action.isSeparator()]
        entry = self.chance.choice(entries)
        self.event(f"menu: {entry.text().split(chr(9))[0].lstrip('&1234567890 ')}", entry.trigger)

    def resize(self) -> None:
        size = QSize(self.chance.randrange(1000, 1920), self.chance.randrange(700, 1080))
        self.event("resize", self.window.resize, size)

    def probe(self) -> float:
        """Return the median CPU milliseconds of one and the same drag of the field."""
        self.window.store.replace(new_state(method="seidel", theme="light"))
        self.window.resize(1440, 900)
        QApplication.processEvents()
        slider, costs = self.window.controls.rows["field_deg"].slider, []
        QTest.mousePress(slider, LEFT, pos=QPoint(20, 11))
        for x in range(20, 220, 5):
            begun = thread_time()
            QTest.mouseMove(slider, pos=QPoint(x, 11))
            QApplication.processEvents()
            costs.append(1e3 * (thread_time() - begun))
        QTest.mouseRelease(slider, LEFT, pos=QPoint(220, 11))
        return median(costs)


HABITS = {
    **{"drag": 24, "press_keys": 12, "type_a_value": 6, "reset": 3, "press_a_button": 5, "choose_a_lens": 3},
    **{"choose_a_method": 5, "open_a_tab": 8, "step_in_time": 4, "touch_a_panel": 20, "edit_the_lens": 3},
    **{"take_an_entry": 1, "resize": 1, "close_a_window": 4},
}


def has_menu(button) -> bool:
    return bool(hasattr(button, "menu") and button.menu())


def size_of(widget) -> tuple[int, int]:
    return widget.width(), widget.height()
