"""Films a sweep or builds: the window shows its frames one by one, and a worker writes them."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QRect, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QImage, QPainter, QPalette
from PySide6.QtWidgets import QWidget

from p2sf.errors import P2SFError
from p2sf.messages import Message, Number
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.playback.film import FilmFrame, FrameQueue, check_film, write_film
from p2sf_explorer.playback.sweep import TITLES, Moment, SliderSweep, changes, sweep
from p2sf_explorer.state.pinning import with_links
from p2sf_explorer.state.state import State, change
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store

FRAMES_PER_S = 12
TICK_MS = 4  # between looks at what is being computed
CAPTION_LINES = 1.8  # heights of type that the strip of a caption takes


class Filming(QObject):
    """``start`` films moments one after the other; ``cancel`` leaves no file.

    ``show(state)`` shows a state without storing it, ``busy_panels()`` says whether something on show is still being
    computed, and ``pause_accuracy(on)`` stops and resumes the measuring of accuracy. Each frame waits for the panels
    that compute in the background. Changes made meanwhile are not filmed, and the state stays as it is.
    """

    progressed = Signal(float)  # the share of the frames filmed
    ended = Signal(object)  # a Message or P2SFError: what was written, or why nothing was

    def __init__(
        self,
        store: Store,
        show: Callable[[State], None],
        busy_panels: Callable[[], bool],
        pause_accuracy: Callable[[bool], None],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._store, self._show, self._busy_panels, self._pause_accuracy = store, show, busy_panels, pause_accuracy
        self._worker = LateAnswers(self)
        self._worker.finished.connect(lambda key, paths: self._end(files_message(paths)))
        self._worker.failed.connect(lambda key, error: self._end(error))
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._next)
        self._queue, self._number, self._shown = FrameQueue(), 0, False
        self._moments: tuple[Moment, ...] = ()
        self._subject: QWidget | None = None
        self._size: QSize | None = None
        store.changed.connect(self._disturb)

    @property
    def busy(self) -> bool:
        """Return whether a film is being made."""
        return self._worker.busy

    def start(
        self, path: str, subject: QWidget, moments: tuple[Moment, ...], frames_per_s: float = FRAMES_PER_S
    ) -> bool:
        """Film the window or one of its parts to a .gif, an .mp4 or numbered .png files; return whether it began."""
        try:
            check_film(path)
        except P2SFError as error:
            self._store.refused.emit(error)
            return False
        self._moments, self._subject, self._queue = moments, subject, FrameQueue()
        self._number, self._shown, self._size = 0, False, None
        self._pause_accuracy(True)
        queue, frame_ms = self._queue, round(1000 / frames_per_s)
        self._worker.submit(path, lambda cancelled, _: write_film(queue.frames(cancelled), path, frame_ms))
        self._timer.start(TICK_MS)
        return True

    def cancel(self) -> None:
        """Stop, and leave no file."""
        self._timer.stop()
        self._worker.cancel()

    def stop(self) -> None:
        """End the worker's thread."""
        self._timer.stop()
        self._worker.stop()

    def _disturb(self) -> None:
        """Note that the window no longer shows the state to be filmed."""
        self._shown = False

    def _next(self) -> None:
        """Show a state, and queue its frame once all panels are done, unless the writer is behind."""
        if self._queue.full or self._subject is None:
            return
        if self._number == len(self._moments):
            self._timer.stop()
            self._queue.put(None)
            return
        moment = self._moments[self._number]
        if not self._shown:
            self._shown = True
            self._show(moment.state)
            return  # until the next tick, before which the panels are laid out for what they say now
        if self._busy_panels():
            return
        picture = picture_of(self._subject, said(moment.caption) if moment.caption else "")
        self._size = self._size or picture.size()
        if picture.size() != self._size:  # the window was resized meanwhile, and a film has one size
            picture = picture.scaled(self._size, mode=Qt.TransformationMode.SmoothTransformation)
        self._queue.put(frame_of(picture))
        self._number, self._shown = self._number + 1, False
        self.progressed.emit(self._number / len(self._moments))

    def _end(self, message: Message | P2SFError) -> None:
        self._timer.stop()
        self._pause_accuracy(False)
        self._show(self._store.state)
        self.ended.emit(message)


def files_message(paths: tuple[Path, ...]) -> Message:
    """Return the message on the files of a film."""
    if len(paths) == 1:
        return Message("Saved {name}", name=paths[0].name)
    first, last = paths[0].name, paths[-1].name
    return Message("Saved {count} frames, {first} to {last}", count=len(paths), first=first, last=last)


def moments_of_sweep(state: State) -> tuple[Moment, ...]:
    """Return the frames of the state's sweep, once, with B following where it is linked."""
    way, count = sweep(state), max(2, round(FRAMES_PER_S * state.playback.seconds))
    values = [way.value(number / (count - 1)) for number in range(count)]
    return tuple(
        Moment(change(state, **with_links(state, changes(state, value))), moving_value(way, value)) for value in values
    )


def moving_value(way: SliderSweep, value: float) -> Message:
    """Return the words below a frame: the slider's name and its value."""
    return Message("{name}: {value}", name=Message(TITLES[way.key]), value=Number(way.write(value)))


def picture_of(widget: QWidget, caption: str = "") -> QImage:
    """Return a widget's picture, with a caption in a strip below it."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    return _with_caption(image, widget, caption) if caption else image


def frame_of(image: QImage) -> FilmFrame:
    """Return a picture, of 8 bits red, green and blue, as a frame."""
    rows = bytes(image.constBits())
    line, width = image.bytesPerLine(), 3 * image.width()
    packed = rows if line == width else b"".join(rows[k * line : k * line + width] for k in range(image.height()))
    return FilmFrame(image.width(), image.height(), packed)


def _with_caption(image: QImage, widget: QWidget, caption: str) -> QImage:
    """Return a picture of a widget with a strip below it, in the widget's colours and type."""
    strip, ratio = round(CAPTION_LINES * widget.fontMetrics().height()), image.devicePixelRatio()
    made = QImage(image.width(), image.height() + round(ratio * strip), image.format())
    made.setDevicePixelRatio(ratio)
    made.fill(widget.palette().color(QPalette.ColorRole.Window))
    painter = QPainter(made)
    painter.drawImage(0, 0, image)
    painter.setFont(widget.font())
    painter.setPen(widget.palette().color(QPalette.ColorRole.WindowText))
    painter.drawText(QRect(0, widget.height(), widget.width(), strip), Qt.AlignmentFlag.AlignCenter, caption)
    painter.end()
    return made
