"""The bar of a sweep: which slider, from which value to which, how fast, and films of it and of random builds."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.playback.filming import FRAMES_PER_S, Filming, moments_of_sweep
from p2sf_explorer.playback.player import Player
from p2sf_explorer.playback.sweep import TITLES, Moment, sweep
from p2sf_explorer.state.scales import read_number
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import chooser, select
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.widgets.typed import typed
from p2sf_explorer.widgets.value_edit import ValueEdit

if TYPE_CHECKING:
    from p2sf_explorer.compute.views.tolerances import ToleranceQuestion, ToleranceResult

FILMS = "Animated GIF (*.gif);;MP4 film (*.mp4);;Numbered PNG frames (*.png)"
LINE_AIR = 32  # pixels beside the parts of the bar where they stand on one line
SUBJECTS = (
    ("stack", "all panels"),
    ("stage", "the stage"),
    ("psf", "the PSF"),
    ("pupil", "the pupil"),
    ("layout", "the layout"),
    ("coefficients", "the coefficients"),
    ("tabs", "the open tab"),
)


class PlayBar(QFrame):
    """Visible while the state names a slider to sweep, and while a film is made.

    ``part(key)`` returns the part of the window to film; ``builds()`` the builds that the Tolerances panel has drawn,
    or raises P2SFError where there are none yet.
    """

    def __init__(
        self,
        store: Store,
        filming: Filming,
        part: Callable[[str], QWidget],
        builds: "Callable[[], tuple[ToleranceQuestion, ToleranceResult]]",
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setObjectName("bar")
        self._store, self._part, self._builds = store, part, builds
        self.player, self.filming = Player(store, self), filming
        self._grasped = "field_deg"
        self.turn = self._button("▶", "Play or pause (Space on a slider)", self.toggle)
        self.key = chooser(tuple(TITLES.items()), "Which slider moves", self)
        self.first, self.last, self.seconds = (self._edit(name) for name in ("from", "to", "seconds one way"))
        self.subject = chooser(SUBJECTS, "What the film shows", self)
        self.export = self._button("Film…", "Save the sweep from the first value to the last as a film", self.ask_film)
        self.progress = QProgressBar(self)
        self.stop_film = self._button("Cancel", "Stop filming and leave no file", self.filming.cancel)
        self.close_bar = self._button("Close", "Put the sweep away", self.put_away)
        self._lay_out()
        self._connect()
        self.hide()

    def _button(self, text: str, tip: str, action: Callable[[], object]) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName("small")
        button.setText(tr(text))
        button.setToolTip(tr(tip))
        button.setAccessibleName(tr(tip))
        button.clicked.connect(lambda: action())
        return button

    def _edit(self, name: str) -> ValueEdit:
        edit = ValueEdit(self)
        edit.setProperty("short", True)
        edit.setAccessibleName(tr(name))
        edit.setToolTip(tr(name))
        return edit

    def _lay_out(self) -> None:
        self._rows = rows = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        rows.setContentsMargins(10, 4, 10, 4)
        rows.setSpacing(6)
        row, film = QHBoxLayout(), QHBoxLayout()
        for line, stretch in ((row, 1), (film, 0)):
            line.setSpacing(6)
            rows.addLayout(line, stretch)
        self.turn.setProperty("turns", True)
        self.progress.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._sweep = self.turn, self.key, self.first, QLabel("→"), self.last, QLabel(tr("in")), self.seconds
        for part in self._sweep:
            row.addWidget(part)
        row.addWidget(self.progress, 1)
        row.addWidget(self.stop_film)
        row.addStretch(1)
        film.addStretch(1)
        for part in (self.subject, self.export, self.close_bar):
            film.addWidget(part)
        self._show_filming(False)

    def _widths(self) -> list[int]:
        """Return the least widths of the two halves of the bar."""
        return [item.minimumSize().width() for k in range(self._rows.count()) if (item := self._rows.itemAt(k))]

    def minimumSizeHint(self) -> QSize:
        """Return the least size, that of two lines."""
        return QSize(max(self._widths()) + LINE_AIR, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Stand on one line, or on two where there is less room."""
        super().resizeEvent(event)
        one = sum(self._widths()) + LINE_AIR <= event.size().width()
        self._rows.setDirection(QBoxLayout.Direction.LeftToRight if one else QBoxLayout.Direction.TopToBottom)

    def _connect(self) -> None:
        store = self._store
        self.key.activated.connect(lambda: store.update(playback_slider=self.key.currentData(), playback_range=None))
        self.subject.activated.connect(lambda: store.update(playback_subject=self.subject.currentData()))
        self.first.committed.connect(lambda text: self._set_range(first=text))
        self.last.committed.connect(lambda text: self._set_range(last=text))
        for edit in (self.first, self.last):
            edit.reset.connect(lambda: store.update(playback_range=None))
        self.seconds.committed.connect(self._set_seconds)
        self.seconds.reset.connect(lambda: store.update(playback_seconds=4.0))
        self.player.turned.connect(lambda on: self.turn.setText("❚❚" if on else "▶"))
        self.filming.progressed.connect(lambda part: self.progress.setValue(round(100 * part)))
        self.filming.ended.connect(self._on_ended)

    def commands(self) -> tuple[Command, ...]:
        """Return what can be done by name or key."""
        return (
            Command("Play or pause the last slider", self.toggle, ("Ctrl+Space",), "Sweep"),
            Command("Film of the sweep…", self.ask_film, ("Ctrl+Shift+E",), "Sweep"),
            Command("Film of random builds…", self.ask_film_of_builds, (), "Sweep"),
        )

    def grasp(self, key: str) -> None:
        """Note that a person has taken hold of the slider of this key, and let it be."""
        self._grasped = key
        self.player.pause_on(key)

    def toggle(self) -> None:
        """Play or pause the state's slider; if it names none, that which a person moved last, the field at first."""
        self.player.toggle(self._store.state.playback.slider or self._grasped)

    def put_away(self) -> None:
        """Pause, and name no slider any more."""
        self.player.pause()
        self._store.update(playback_slider="", playback_range=None)

    def show_state(self, state: State) -> None:
        """Follow a state."""
        swept = bool(state.playback.slider)
        self.setVisible(swept or self.filming.busy)
        for part in (*self._sweep, self.subject, self.export, self.close_bar):
            part.setVisible(swept)
        if not swept:
            return
        select(self.key, state.playback.slider)
        select(self.subject, state.playback.subject)
        found = sweep(state)
        for edit, value in ((self.first, found.first), (self.last, found.last)):
            edit.set_text(found.write(value))
        self.seconds.set_text(f"{state.playback.seconds:g} s")

    def _set_range(self, first: str | None = None, last: str | None = None) -> None:
        found = sweep(self._store.state)

        def ends() -> dict[str, object]:
            pairs = ((first, found.first), (last, found.last))
            return {"playback_range": tuple(old if text is None else found.read(typed(text)) for text, old in pairs)}

        self._try(ends)

    def _set_seconds(self, text: str) -> None:
        self._try(lambda: {"playback_seconds": seconds(text)})

    def _try(self, read: Callable[[], dict[str, object]]) -> None:
        """Take over what was typed, or say why not; then show the values in force."""
        try:
            self._store.update(**read())
        except P2SFError as error:
            self._store.refused.emit(error)
        for edit in (self.first, self.last, self.seconds):
            edit.set_text("")
        self.show_state(self._store.state)

    def ask_film(self) -> None:
        """Ask for a name and film the sweep."""
        if not self._store.state.playback.slider:
            self._store.update(playback_slider="field_deg")
        if path := self._asked_path(self._store.state.playback.slider):
            self.film(path)

    def ask_film_of_builds(self) -> None:
        """Ask for a name and film random builds; say why where there are none."""
        from p2sf_explorer.playback.builds import moments_of_builds

        moments = self._moments(lambda: moments_of_builds(*self._builds()))
        if moments and (path := self._asked_path("builds")):
            self.film_builds(path, moments)

    def _asked_path(self, what: str) -> str:
        """Return where a person wants the film of something, "" for nowhere."""
        from p2sf_explorer.files.asking import ask_path

        first = f"{Path(self._store.state.optics.lens).stem}_{what}.gif"
        return ask_path(self.window(), tr("Save a film"), first, tr(FILMS))

    def film(self, path: str) -> bool:
        """Film the sweep to a file; return whether it began."""
        moments = self._moments(lambda: moments_of_sweep(self._store.state))
        return bool(moments) and self._film(path, self._store.state.playback.subject, moments, FRAMES_PER_S)

    def film_builds(self, path: str, moments: tuple[Moment, ...]) -> bool:
        """Film builds, all panels of the window, to a file; return whether it began."""
        from p2sf_explorer.playback.builds import BUILDS_PER_S

        return self._film(path, "stack", moments, BUILDS_PER_S)

    def _moments(self, make: Callable[[], tuple[Moment, ...]]) -> tuple[Moment, ...]:
        """Return the moments to film; say why where there are none."""
        try:
            return make()
        except P2SFError as error:
            self._store.refused.emit(error)
            return ()

    def _film(self, path: str, subject: str, moments: tuple[Moment, ...], frames_per_s: float) -> bool:
        self.player.pause()
        began = not self.filming.busy and self.filming.start(path, self._part(subject), moments, frames_per_s)
        self._show_filming(began or self.filming.busy)
        return began

    def _show_filming(self, on: bool) -> None:
        for part in (self.progress, self.stop_film):
            part.setVisible(on)
        for tool in (self.subject, self.export, self.turn, self.key, self.close_bar):
            tool.setEnabled(not on)
        self.progress.setValue(0)
        self.show_state(self._store.state)

    def _on_ended(self, message: Message | P2SFError) -> None:
        self._show_filming(False)
        self._store.said.emit(message)

    def stop(self) -> None:
        """End playing and filming with the window."""
        self.player.pause()
        self.filming.stop()


def seconds(text: str) -> float:
    """Return the seconds a person typed; P2SFError otherwise."""
    return read_number(typed(text.replace("s", " ")), "duration")
