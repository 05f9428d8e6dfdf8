"""Plays a slider: a timer moves it as a drag would, in one step of undo."""

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal

from p2sf_explorer.playback.sweep import changes, present, sweep
from p2sf_explorer.store.store import Store

TICK_MS = 25


class Player(QObject):
    """``toggle`` plays or pauses the slider of a key; ``turned`` tells when playing begins or ends."""

    turned = Signal(bool)

    def __init__(self, store: Store, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._store, self._clock, self._start_s = store, QElapsedTimer(), 0.0
        self._timer = QTimer(self)
        self._timer.setInterval(TICK_MS)
        self._timer.timeout.connect(self.step)
        store.stepped.connect(self.pause)

    @property
    def playing(self) -> bool:
        """Return whether a slider is moving."""
        return self._timer.isActive()

    def toggle(self, key: str) -> None:
        """Play the slider of this key, or pause it if it is the one that plays."""
        again = self.playing and self._store.state.playback.slider == key
        self.pause()
        if again or not key:
            return
        if self._store.state.playback.slider != key:
            self._store.update(playback_slider=key, playback_range=None)
        self.play()

    def play(self) -> None:
        """Move the state's slider, from where it stands."""
        state = self._store.state
        if not state.playback.slider or self.playing:
            return
        self._start_s = state.playback.seconds * sweep(state).part(present(state))
        self._clock.start()
        self._timer.start()
        self.turned.emit(True)

    def pause(self) -> None:
        """Leave the slider where it is."""
        if self.playing:
            self._timer.stop()
            self._store.end()
            self.turned.emit(False)

    def pause_on(self, key: str) -> None:
        """Leave the slider where it is if it is the one of this key: a person has taken hold of it."""
        if self._store.state.playback.slider == key:
            self.pause()

    def step(self) -> None:
        """Put the slider where it belongs at this moment."""
        state = self._store.state
        if not state.playback.slider:
            self.pause()
            return
        self._store.begin()
        self._store.update(**changes(state, sweep(state).at(self._start_s + self._clock.elapsed() / 1000)))
