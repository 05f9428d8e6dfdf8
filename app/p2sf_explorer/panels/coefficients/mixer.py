"""The six coefficients as a mixer: bar, number, mute, solo, and a slider that adds waves."""

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QAccessible,
    QColor,
    QEnterEvent,
    QFocusEvent,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
)
from PySide6.QtWidgets import QToolTip, QWidget

from p2sf_explorer.charts.axes import LOCK_PX, paint_lock
from p2sf_explorer.charts.chart import blank_pixmap
from p2sf_explorer.charts.painting import fitting, write
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.charts.view import keep_or_grow
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.state.terms import FORMULAS, NAMES, TERMS, WORDS
from p2sf_explorer.widgets.value_edit import ShortField

SHORT = {
    "w40": "spherical",
    "w31": "coma",
    "w22": "astigmatism",
    "w20": "curvature",
    "wd": "defocus",
    "w11": "distortion",
}
LEFT, SYMBOL, NUMBER, BUTTON, GAP = 132.0, 34.0, 60.0, 19.0, 4.0
SCALE_HEIGHT, SMALLEST_PX = 18.0, 120
HANDLE = 5.0
LETTERS = (("muted", "M", "warning"), ("solo", "S", "accent"))


@dataclass(frozen=True)
class MixerPlaces:
    """The mixer's geometry for a size in pixels; rows in the order of `p2sf_explorer.state.terms.TERMS`.

    ``scale`` is that of type (`Tokens`), which names, numbers and buttons follow.
    """

    width: float
    height: float
    scale: float = 1.0

    @property
    def ends(self) -> tuple[float, float]:
        """Return the left and right end of bars and sliders."""
        return LEFT * self.scale, self.width - (NUMBER + 2 * BUTTON + 2 * GAP) * self.scale

    def row(self, number: int) -> QRectF:
        """Return the rectangle of a row."""
        tall = (self.height - SCALE_HEIGHT * self.scale) / len(TERMS)
        return QRectF(0, number * tall, self.width, tall)

    def lock(self) -> QRectF:
        """Return the rectangle of the lock of the scale, at the right of its numbers."""
        side = LOCK_PX * self.scale
        return QRectF(self.width - side, self.height - side - 1, side, side)

    def row_at(self, y: float) -> int:
        """Return the row at a height."""
        return min(len(TERMS) - 1, max(0, int(y * len(TERMS) / max(1.0, self.height - SCALE_HEIGHT * self.scale))))

    def button(self, number: int, kind: str) -> QRectF:
        """Return the rectangle of a row's "muted" or "solo" button."""
        place = [name for name, *_ in LETTERS].index(kind)
        side = BUTTON * self.scale
        left = self.width - (2 - place) * side - (1 - place) * GAP * self.scale / 2
        return QRectF(left, self.row(number).center().y() - side / 2, side - 1, side)

    def number(self, number: int) -> QRectF:
        """Return the rectangle of a row's number."""
        row = self.row(number)
        return QRectF(self.ends[1] + GAP * self.scale / 2, row.top(), (NUMBER - GAP / 2) * self.scale, row.height())

    def bar(self, number: int, part: float) -> QRectF:
        """Return the bar from the middle to a part (−1 to 1) of its half length."""
        row, (left, right) = self.row(number), self.ends
        middle, end = (left + right) / 2, (left + right) / 2 + part * (right - left) / 2
        thick = min(16.0 * self.scale, 0.42 * row.height())
        return QRectF(min(middle, end), row.top() + 0.36 * row.height() - thick / 2, abs(end - middle), thick)

    def handle(self, number: int, part: float) -> QPointF:
        """Return the place of a row's handle for a part (−1 to 1) of its half travel."""
        row, (left, right) = self.row(number), self.ends
        return QPointF((left + right) / 2 + part * (right - left) / 2, row.top() + 0.80 * row.height())

    def part_at(self, x: float) -> float:
        """Return the part (−1 to 1) of the half travel at a pixel."""
        left, right = self.ends
        return min(1.0, max(-1.0, (2 * x - left - right) / max(1.0, right - left)))


def clamp(value: float, limit: float) -> float:
    """Return a value as a part of the limit, from −1 to 1."""
    return max(-1.0, min(1.0, value / limit))


def paint_scale(painter: QPainter, places: MixerPlaces, theme: Tokens, limit: float) -> None:
    """Paint five lines and their numbers."""
    (left, right), bottom = places.ends, places.height - SCALE_HEIGHT * places.scale
    for part in (-1.0, -0.5, 0.0, 0.5, 1.0):
        x = (left + right) / 2 + part * (right - left) / 2
        painter.setPen(QPen(QColor(theme.line if part == 0 else theme.faint), theme.scale))
        painter.drawLine(QPointF(x, 0), QPointF(x, bottom))
        if part in (-1.0, 0.0, 1.0):
            painter.setPen(QColor(theme.muted))
            text = f"{limit * part:+g}".replace("-", "−") if part else "0"
            write(painter, QRectF(x - theme.px(40), bottom + 2, 2 * theme.px(40), theme.px(16)), text, 0, theme.tick)


def paint_names(painter: QPainter, places: MixerPlaces, theme: Tokens, number: int) -> None:
    """Paint a row's symbol and its name."""
    row, name = places.row(number), TERMS[number]
    two, symbol = row.height() >= theme.px(25), theme.px(SYMBOL)
    painter.setPen(QColor(theme.text))
    above = QRectF(0, row.center().y() - theme.px(15), theme.px(60), theme.px(16)) if two else row
    write(painter, above, NAMES[name], -1, theme.px(13))
    beside = QRectF(symbol, row.top(), places.ends[0] - symbol, row.height())
    room = QRectF(0, row.center().y(), places.ends[0], theme.px(13)) if two else beside
    painter.setPen(QColor(theme.muted))
    write(painter, room, fitting(tr(SHORT[name]), room.width() - GAP, theme.tick), -1, theme.tick)


def paint_slider(
    painter: QPainter, places: MixerPlaces, theme: Tokens, number: int, part: float, focused: bool
) -> None:
    """Paint a row's slider: groove, added waves, handle."""
    handle, zero = places.handle(number, part), places.handle(number, 0.0)
    left, right = places.ends
    painter.setPen(QPen(QColor(theme.line), 2 * theme.scale))
    painter.drawLine(QPointF(left, zero.y()), QPointF(right, zero.y()))
    painter.setPen(QPen(QColor(theme.accent), 2 * theme.scale))
    painter.drawLine(zero, handle)
    if focused:
        halo = QColor(theme.accent)
        halo.setAlpha(80)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(halo)
        painter.drawEllipse(handle, (HANDLE + 3) * theme.scale, (HANDLE + 3) * theme.scale)
    painter.setPen(QPen(QColor(theme.accent if part else theme.muted), 1.6 * theme.scale))
    painter.setBrush(QColor(theme.card))
    painter.drawEllipse(handle, (HANDLE - 0.8) * theme.scale, (HANDLE - 0.8) * theme.scale)


def paint_button(painter: QPainter, room: QRectF, theme: Tokens, letter: str, colour: str, on: bool) -> None:
    """Paint a mute or solo button."""
    painter.setPen(QPen(QColor(getattr(theme, colour) if on else theme.line), theme.scale))
    painter.setBrush(QColor(getattr(theme, colour) if on else theme.raised))
    painter.drawRoundedRect(room.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
    painter.setPen(QColor(theme.card if on else theme.muted))
    write(painter, room, letter, 0, theme.tick)


def paint_value(painter: QPainter, places: MixerPlaces, theme: Tokens, number: int, part: float, words: str) -> None:
    """Paint a row's bar and number; that of W11 pale, since it only moves the image."""
    colour = QColor(theme.positive if part >= 0 else theme.negative)
    colour.setAlpha(110 if TERMS[number] == "w11" else 255)
    painter.fillRect(places.bar(number, part), colour)
    painter.setPen(QColor(theme.text))
    write(painter, places.number(number), words, 1, theme.px(13))


def paint_overflow(painter: QPainter, bar: QRectF, theme: Tokens, right: bool) -> None:
    """Cut the bar's end with two slanted strokes, which say that it goes on beyond the scale."""
    unit = theme.scale
    painter.setPen(QPen(QColor(theme.card), 2 * unit))
    for shift in (6 * unit, 11 * unit):
        x = bar.right() - shift if right else bar.left() + shift
        painter.drawLine(QPointF(x - 3 * unit, bar.bottom() + 1), QPointF(x + 3 * unit, bar.top() - 1))


def waves(value: float) -> str:
    """Return a coefficient as text, no longer than its column."""
    size = abs(value)
    return f"{with_sign(value, 2 if size < 10 else 1 if size < 100 else 0)} λ"


STEPS: dict[int, float] = {
    Qt.Key.Key_Left: -0.02,
    Qt.Key.Key_Right: 0.02,
    Qt.Key.Key_PageDown: -0.2,
    Qt.Key.Key_PageUp: 0.2,
}
BACK = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)
BUTTON_TIPS = {"muted": "Mute: this term counts as zero (M)", "solo": "Solo: only this term counts (S)"}
HOLDS = 0.02  # of the travel: nearer to zero the slider snaps to it
ROW_TIP = (
    "From the lens: {own}. Added by hand: {added}. Drag the slider to add waves, double-click to remove them; click "
    "the number, or press Return, to type it."
)
SMALLEST_LIMIT = 0.5  # waves of a full bar, at least: a lens with less is as good as perfect


class NumberEdit(ShortField):
    """A field to type a number over the mixer; Return, Escape and losing the focus hide it."""

    def __init__(self, parent: QWidget):
        super().__init__(parent)
        self.setObjectName("cell")
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.editingFinished.connect(self.hide)
        self.hide()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Keep every key from the mixer behind; Escape gives it the focus."""
        super().keyPressEvent(event)
        event.accept()
        mixer = self.parentWidget()
        if event.key() == Qt.Key.Key_Escape and mixer:
            mixer.setFocus()


class Mixer(QWidget):
    """Six painted rows; sliders and buttons are painted while pointer or focus is here, or one of them is in use.

    ``limit`` is the value of a full bar and of a slider's end: a round number of waves.

    The rows share the keyboard focus: ↑ ↓ choose one, ← → and Page keys add waves, M mutes, S solos, Delete takes the
    added waves away, L locks the scale, Space sweeps, Return opens a field for a number.
    """

    accessible_role = QAccessible.Role.Grouping
    pressed, released = Signal(), Signal()
    added = Signal(str, float)
    typed = Signal(str, str)
    toggled = Signal(str, str)
    swept = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.values: dict[str, float] = dict.fromkeys(TERMS, 0.0)
        self.own, self.waves = dict(self.values), dict(self.values)
        self.on: dict[str, tuple[str, ...]] = {"muted": (), "solo": ()}
        self.limit, self.row, self.locked = 1.0, 0, False
        self._theme, self._dragged = LIGHT, False
        self._background: QPixmap | None = None
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("What-if: waves added to the six coefficients"))
        self.setMinimumHeight(SMALLEST_PX)
        self.edit = NumberEdit(self)
        self.edit.returnPressed.connect(self._take)

    def sizeHint(self) -> QSize:
        """Return a size with room for six rows."""
        return QSize(260, 220)

    @property
    def places(self) -> MixerPlaces:
        """Return the geometry of the present size."""
        return MixerPlaces(self.width(), self.height(), self._theme.scale)

    def rows_of_data(self) -> list[list[str]]:
        """Return the coefficients as they count, the lens's own, and the added waves, in waves, for the clipboard."""
        kept = zip(self.values, self.values.values(), self.own.values(), self.waves.values(), strict=True)
        return [["", "λ", tr("the lens's own"), tr("Added waves")], *([name, *map(str, row)] for name, *row in kept)]

    def show_values(
        self, values: dict[str, float], own: dict[str, float], added: dict[str, float], **on: tuple[str, ...]
    ) -> None:
        """Show coefficients as they count, the lens's own, and the waves added to each; ``on``: muted, solo."""
        before = self.limit, self.waves, self.on
        moved = [n for n, k in enumerate(TERMS) if (values[k], own[k]) != (self.values[k], self.own[k])]
        self.values, self.own, self.waves, self.on = values, own, added, on
        if not self._dragged:
            everything = [abs(v) for kind in (values, own, added) for name, v in kind.items() if name != "w11"]
            most = max(SMALLEST_LIMIT, abs(added["w11"]), *everything)
            self.limit = self.limit if self.locked else keep_or_grow((-self.limit, self.limit), (-most, most))[1]
        if before != (self.limit, self.waves, self.on):
            self._background = None
            self.update()
        for number in moved:
            self.update(self.places.row(number).toAlignedRect())

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme, self._background = theme, None
        self.setMinimumHeight(theme.px(SMALLEST_PX))
        self.update()

    @property
    def tools_shown(self) -> bool:
        """Return whether sliders, mute, solo and the lock are painted."""
        used = self.locked or any(self.waves.values()) or any(self.on.values())
        return used or self.underMouse() or self.hasFocus()

    def turn_lock(self) -> None:
        """Keep the scale of the bars as it is, or let it follow the coefficients again from the next ones on."""
        self.locked, self._background = not self.locked, None
        self.update()

    def choose(self, row: int) -> None:
        """Give a row the keyboard focus."""
        self.row, self._background = min(len(TERMS) - 1, max(0, row)), None
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the background, then bars and numbers."""
        if self._background is None or self._background.size() != self.size() * self.devicePixelRatioF():
            self._background = self._painted_background()
        painter, places = QPainter(self), self.places
        painter.drawPixmap(0, 0, self._background)
        for number, name in enumerate(TERMS):
            if not event.region().intersects(places.row(number).toAlignedRect()):
                continue
            value, part = self.values[name], clamp(self.values[name], self.limit)
            paint_value(painter, places, self._theme, number, part, waves(value))
            if abs(value) > self.limit:
                paint_overflow(painter, places.bar(number, part), self._theme, value > 0)
            if self.own[name] != value:
                painter.setPen(QPen(QColor(self._theme.muted), self._theme.scale, Qt.PenStyle.DotLine))
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.drawRect(places.bar(number, clamp(self.own[name], self.limit)))

    def _painted_background(self) -> QPixmap:
        theme, places = self._theme, self.places
        background = blank_pixmap(self, theme.card)
        painter = QPainter(background)
        paint_scale(painter, places, theme, self.limit)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        shown = self.tools_shown
        if shown:
            paint_lock(painter, places.lock(), QColor(theme.accent if self.locked else theme.muted), self.locked)
        for number, name in enumerate(TERMS):
            focused = self.hasFocus() and number == self.row
            paint_names(painter, places, theme, number)
            if not shown:
                continue
            paint_slider(painter, places, theme, number, clamp(self.waves[name], self.limit), focused)
            for kind, letter, colour in LETTERS:
                on = name in self.on.get(kind, ())
                paint_button(painter, places.button(number, kind), theme, letter, colour, on)
        painter.end()
        return background

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Press a button, or take hold of a slider."""
        if event.button() != Qt.MouseButton.LeftButton:
            return
        point, places = event.position(), self.places
        if places.lock().contains(point):
            self.turn_lock()
            return
        self.choose(places.row_at(point.y()))
        for kind, *_ in LETTERS:
            if places.button(self.row, kind).contains(point):
                self.toggled.emit(kind, TERMS[self.row])
                return
        if point.x() > places.ends[1] + 8:
            self._ask()
        elif point.x() >= places.ends[0] - 8:
            self._dragged = True
            self.pressed.emit()
            self._follow(point)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Follow the pointer while held."""
        if self._dragged:
            self._follow(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        if self._dragged:
            self._dragged = False
            self.released.emit()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Take the added waves away; a quick second click on a button is a click."""
        if event.position().x() > self.places.ends[1] + 8:
            self.mousePressEvent(event)
            return
        self.added.emit(TERMS[self.places.row_at(event.position().y())], 0.0)

    def _follow(self, point: QPointF) -> None:
        part = self.places.part_at(point.x())
        waves = 0.0 if abs(part) < HOLDS else round(part * self.limit, 4)
        self.added.emit(TERMS[self.row], waves)

    def _ask(self) -> None:
        """Open the field over the row's number."""
        rect = self.places.number(self.row).toRect()
        half = self._theme.px(13)
        self.edit.setGeometry(rect.left(), rect.center().y() - half, rect.width(), 2 * half)
        self.edit.setText(local(waves(self.values[TERMS[self.row]]).removesuffix(" λ")))
        self.edit.show()
        self.edit.setFocus()
        self.edit.selectAll()

    def _take(self) -> None:
        text = self.edit.text()
        self.setFocus()
        self.typed.emit(TERMS[self.row], text)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Choose a row, add waves or take them away, mute, solo, sweep, type."""
        key, name = event.key(), TERMS[self.row]
        if key in (Qt.Key.Key_Up, Qt.Key.Key_Down):
            self.choose(self.row + (1 if key == Qt.Key.Key_Down else -1))
        elif key in STEPS:
            self.added.emit(name, round(self.waves[name] + STEPS[key] * self.limit, 4))
        elif key in BACK:
            self.added.emit(name, 0.0)
        elif key in (Qt.Key.Key_M, Qt.Key.Key_S):
            self.toggled.emit("muted" if key == Qt.Key.Key_M else "solo", name)
        elif key == Qt.Key.Key_L:
            self.turn_lock()
        elif key == Qt.Key.Key_Space:
            self.swept.emit(name)
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._ask()
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show which row has the keyboard focus."""
        self.choose(self.row)

    focusOutEvent = focusInEvent

    def enterEvent(self, event: QEnterEvent) -> None:
        """Show the sliders and buttons."""
        self._background = None
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """Hide the sliders and buttons that are not in use."""
        self._background = None
        self.update()

    def event(self, event: QEvent) -> bool:
        """Define the part under the pointer."""
        if isinstance(event, QHelpEvent):
            QToolTip.showText(event.globalPos(), self._tip(event.pos()), self)
            return True
        return super().event(event)

    def _tip(self, point: QPoint) -> str:
        row = self.places.row_at(point.y())
        name = TERMS[row]
        if self.places.lock().contains(QPointF(point)):
            return tr("Lock the scale of this plot (L)")
        for kind, *_ in LETTERS:
            if self.places.button(row, kind).contains(QPointF(point)):
                return tr(BUTTON_TIPS[kind])
        moves = " " + tr("It only moves the image.") if name == "w11" else ""
        numbers = {"own": waves(self.own[name]), "added": waves(self.waves[name])}
        return f"{NAMES[name]}, {tr(WORDS[name])}: {NAMES[name]}·{FORMULAS[name]}.{moves} {tr(ROW_TIP, **numbers)}"
