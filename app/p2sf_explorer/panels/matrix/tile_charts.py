"""Small charts in rows and columns, each with a heading and a figure in its corner: the pictures of a matrix."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.cursor import ARROWS, TAKES
from p2sf_explorer.charts.painting import fitting, polygon, small_font, width_of, write
from p2sf_explorer.charts.plots import BRIGHTNESS, EMPTY, as_indices, colour_map_name, lookup
from p2sf_explorer.charts.reading import Reading, Samples, closest, point_reading
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.brightness import stretch
from p2sf_explorer.compute.finer import fade
from p2sf_explorer.compute.matrix.tiles import Light
from p2sf_explorer.i18n.tr import local, tr

WAVES_MAP = "CET-D1A"
WHITE = "#ffffff"  # on the dark ground of a PSF in both themes
LOOKS = {"perfect lens": ("muted", 1), "sagittal": ("marginal", 2), "tangential": ("chief", 2)}
LINE_PX = 16  # the height of a line of text at scale 1
NOTE_GROUND = 190  # opacity of the ground of words over a picture
GAP_PX, GROUP_PX = 6, 14  # between charts, and between the rows of a matrix that stands in one line
FLATTEST = 1.6  # width over height of a chart of curves that has no use for more width
SMALL_UNITS = re.compile(r"([.,]\d+)? (nm|µm)$")
TURN = np.linspace(0, 2 * np.pi, 73)


@dataclass(frozen=True)
class Words:
    """The texts of a chart, as they are: which point it shows, how that was made, figure, extent, why it is empty.

    ``here`` is how a frame marks the chart: "exact", "near" or "".
    """

    heading: tuple[str, ...] = ()
    made: str = ""
    figure: str = ""
    extent: str = ""
    why: str = ""
    here: str = ""


class TileChart(Chart):
    """A chart without axes under a heading, with its main figure and its extent.

    They stand in the lower corners of the picture, in its upper right one if ``above``, or where it is ``narrow`` in
    lines of their own above and below it.
    A click, or Enter, is told by ``taken``; zoomed in, where a drag pans and a click pins a marker, one on the heading.
    """

    taken = Signal()
    arrow = Signal(int, int)
    square = True
    narrow = above = False
    takes_arrows = True
    axes = "x, µm", "y, µm"

    def __init__(self) -> None:
        super().__init__(*self.axes, aspect=self.square, framed=False)
        self.setMinimumSize(24, 24)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.words = Words()

    @property
    def area(self) -> QRectF:
        """Return the rectangle of the picture."""
        line = self.theme.px(LINE_PX)
        above, below = (2 * line, 2 * line) if self.narrow else (line, 2)
        return QRectF(2, above, max(4, self.width() - 4), max(4, self.height() - above - below))

    def takes(self, point: QPointF) -> bool:
        """Return whether a press takes this chart's point."""
        return not self.moved or not self.area.contains(point)

    def set_narrow(self, narrow: bool) -> None:
        """Have the texts in lines of their own, or within the picture."""
        if narrow != self.narrow:
            self.narrow = narrow
            self.forget_background()

    def tell(self, words: Words) -> None:
        """Show texts."""
        if words == self.words:
            return
        self.words = words
        told = local(" · ".join(filter(None, (*words.heading, words.why or words.figure, words.made))))
        self.setAccessibleName(told)
        self.setToolTip(told)
        self.update()

    def paint_over(self, painter: QPainter) -> None:
        """Paint heading, figure, extent, and the frame of the present point."""
        painter.setClipping(False)
        line, area = self.theme.px(LINE_PX), self.area
        rows = [QRectF(3, k * line, self.width() - 6, line) for k in range(2)]
        below = [QRectF(3, area.bottom() + 1 + k * line, self.width() - 6, line) for k in range(2)]
        strong = self.theme.accent if self.words.here == "exact" else self.theme.text
        if self.narrow:
            for row, words in zip(rows, self.words.heading, strict=False):
                self._write(painter, row, words, strong, 0)
            self._write(painter, below[0], self._figure_in(below[0].width()), self.theme.text, 0)
            self._write(painter, below[1], self.words.extent, self.theme.muted, 0)
        else:
            heading = self._heading_in(rows[0].width())
            self._write(painter, rows[0], heading, strong, -1)
            if width_of(heading, self.theme.small) + width_of(self.words.made, self.theme.small) + 12 < rows[0].width():
                self._write(painter, rows[0], self.words.made, self.theme.muted, 1)
            self._paint_corners(painter, area)
        if self.words.why:
            painter.setPen(QColor(self.note_colour))
            painter.setFont(small_font(self.theme.small))
            wrapped = int(Qt.AlignmentFlag.AlignCenter) | int(Qt.TextFlag.TextWordWrap)
            painter.drawText(area.adjusted(6, 4, -6, -4), wrapped, self.words.why)
        self._paint_frame(painter, area)

    def _heading_in(self, room: float) -> str:
        """Return the heading on one line, without units and decimals where it does not fit otherwise."""
        whole = " · ".join(self.words.heading)
        if width_of(whole, self.theme.small) <= room:
            return whole
        return SMALL_UNITS.sub("", whole)

    def _figure_in(self, room: float) -> str:
        """Return the figure as it fits: whole, without its part in brackets, or without the word in front."""
        for words in (self.words.figure, self.words.figure.partition(" (")[0]):
            if width_of(words, self.theme.small) <= room:
                return words
        return self.words.figure.partition(" (")[0].partition(" ")[2]

    def _write(self, painter: QPainter, row: QRectF, words: str, colour: str, side: int) -> None:
        painter.setPen(QColor(colour))
        write(painter, row, fitting(words, row.width(), self.theme.small), side, self.theme.small)

    def _paint_corners(self, painter: QPainter, area: QRectF) -> None:
        """Paint the figure in the lower left corner, the extent in the right one where both fit."""
        tall, size = self.theme.px(LINE_PX), self.theme.small
        line = QRectF(area.left() + 1, area.bottom() - tall - 1, area.width() - 2, tall)
        if self.above:
            self._paint_note(
                painter, line.translated(0, tall + 2 - area.height()), self._figure_in(line.width() - 6), 1
            )
            self._paint_note(painter, line.translated(0, 2 * tall + 2 - area.height()), self.words.extent, 1)
            return
        self._paint_note(painter, line, self._figure_in(line.width() - 6), -1)
        if width_of(self.words.figure, size) + width_of(self.words.extent, size) + 20 < line.width():
            self._paint_note(painter, line, self.words.extent, 1)

    def _paint_note(self, painter: QPainter, line: QRectF, words: str, side: int) -> None:
        """Paint words over the picture on a ground on which they can be read."""
        if not words:
            return
        words = fitting(words, line.width() - 6, self.theme.small)
        wide = min(line.width(), width_of(words, self.theme.small) + 6)
        left = line.left() if side < 0 else line.right() - wide
        ground = QColor(self.note_ground)
        ground.setAlpha(NOTE_GROUND)
        painter.fillRect(QRectF(left, line.top(), wide, line.height()), ground)
        self._write(painter, QRectF(left + 3, line.top(), wide - 5, line.height()), words, self.note_colour, -1)

    @property
    def note_ground(self) -> str:
        """Return the colour behind words over the picture."""
        return self.theme.card

    @property
    def note_colour(self) -> str:
        """Return the colour of words over the picture."""
        return self.theme.text

    def clear(self) -> None:
        """Show no picture."""
        self._image = self.samples = None
        for curve in self.curves:
            curve.set_data([], [])
        self.update()

    def _paint_frame(self, painter: QPainter, area: QRectF) -> None:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        style = Qt.PenStyle.DashLine if self.words.here == "near" else Qt.PenStyle.SolidLine
        wide = 2.0 * self.theme.scale if self.words.here else self.theme.scale
        painter.setPen(QPen(QColor(self.theme.accent if self.words.here else self.theme.line), wide, style))
        painter.drawRect(area)
        if self.hasFocus():
            painter.setPen(QPen(QColor(self.theme.text), self.theme.scale, Qt.PenStyle.DotLine))
            inset = self.theme.px(3)
            painter.drawRect(area.adjusted(inset, inset, -inset, -inset))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take this chart's point."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.taken.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take this chart's point with Enter; go to the next chart with an arrow."""
        if event.key() in TAKES:
            self.taken.emit()
        elif event.key() in ARROWS and not event.modifiers():
            self.arrow.emit(*ARROWS[event.key()])
        else:
            super().keyPressEvent(event)


class LightChart(TileChart):
    """A PSF on the ground of its darkest colour, with the Airy circle."""

    smooth = True

    def __init__(self) -> None:
        super().__init__()
        self.airy = self.add_curve(WHITE, 1, 150)

    @property
    def note_ground(self) -> str:
        """Return the darkest colour of the map."""
        return self._darkest().name()

    @property
    def note_colour(self) -> str:
        """Return a colour that can be read there."""
        return WHITE

    def _darkest(self) -> QColor:
        return QColor.fromRgb(int(lookup(colour_map_name(BRIGHTNESS, self.theme))[0]))

    def paint_background(self, painter: QPainter) -> None:
        """Paint the ground beside the window of the PSF."""
        painter.fillRect(self.area, self._darkest())

    def show_light(self, light: Light, across_um: float, peak: float, scale: str) -> None:
        """Show ``across_um`` about the middle of the light, ``peak`` brightest, on a brightness scale."""
        count, half = light.values.shape[-1], across_um / 2
        start = -(count // 2 + 0.5) * light.width_um / count
        x, y = light.circle.x_um, light.circle.y_um
        self.set_view((x, y), half)
        covered = max(abs(x), abs(y)) + half <= light.width_um / 2
        bright = stretch((light.painted if covered else fade(light.painted)) / (peak or 1.0), scale)
        pixels = lookup(colour_map_name(BRIGHTNESS, self.theme))[as_indices(bright, 0.0, 1.0)]
        rect = start, start, light.width_um, light.width_um
        self.show_pixels(pixels, rect, Samples(light.values, rect, tr("share of the light, 1/µm²")))

    def show_airy(self, radius_um: float) -> None:
        """Show the first dark ring of a perfect lens."""
        self.airy.set_data(radius_um * np.cos(TURN), radius_um * np.sin(TURN))


class WavesChart(TileChart):
    """A wavefront over the pupil within its outline."""

    def __init__(self) -> None:
        super().__init__()
        self.rim = self.add_curve("line")
        self.set_range((-1.04, 1.04), (-1.04, 1.04))

    def show_waves(self, values: np.ndarray, outline: np.ndarray, limit: float) -> None:
        """Show W between −limit and limit."""
        table = lookup(WAVES_MAP).copy()
        table[EMPTY] = QColor(self.theme.card).rgb()
        self.rim.set_data(*outline)
        rect = -1.0, -1.0, 2.0, 2.0
        pixels = table[as_indices(values.astype(float), -limit, limit)]
        self.show_pixels(pixels, rect, Samples(values, rect, tr("W, waves")))


class PointsChart(TileChart):
    """Where rays land, with the Airy circle."""

    def __init__(self) -> None:
        super().__init__()
        self.airy = self.add_curve("chief", 1)
        self.points = np.zeros((0, 2))

    def show_points(self, points: np.ndarray, airy_um: float, half: float) -> None:
        """Show (rays, 2) x and y in µm within ±half."""
        self.points = points
        self.airy.set_data(airy_um * np.cos(TURN), airy_um * np.sin(TURN))
        self.set_range((-half, half), (-half, half))
        self.update()

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the ray that lands nearest."""
        number = closest(self.points, np.array([x, y]), self.pixel_size())
        if number is None:
            return None
        landed_x, landed_y = self.points[number].tolist()
        return point_reading(landed_x, landed_y, self.axes, "marginal", tr("ray"))

    def rows_of_data(self) -> list[list[str]]:
        """Return the points as rows: x and y in µm."""
        return [[*self.axes], *([f"{x:.9g}", f"{y:.9g}"] for x, y in self.points)] if len(self.points) else []

    def paint_over(self, painter: QPainter) -> None:
        """Paint the points, then the texts."""
        side = min(self.area.width(), self.area.height())
        pen = QPen(QColor(self.theme.marginal), max(1.4, min(3.0 * self.theme.scale, side / 70)))
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        painter.drawPoints(polygon(*self.to_pixels(*self.points.T)))
        super().paint_over(painter)


class LinesChart(TileChart):
    """Curves over common positions, with a line at zero."""

    square = False

    def __init__(self) -> None:
        super().__init__()
        self.zero = self.add_curve("line")
        self.named = {name: self.add_curve(token, width, name=name) for name, (token, width) in LOOKS.items()}

    def show_lines(
        self, x: np.ndarray, curves: Mapping[str, np.ndarray], across: tuple[float, float], up: tuple[float, float]
    ) -> None:
        """Show curves by their names in `LOOKS` over these ranges."""
        for name, curve in self.named.items():
            curve.set_data(x if name in curves else [], curves.get(name, []))
        self.set_range(across, up)
        self.zero.set_data(across, (0.0, 0.0))
        self.update()


def arrange(
    room: tuple[int, int], shape: tuple[int, int], line_px: int, gaps: tuple[int, int], square: bool
) -> tuple[list[QRect], bool]:
    """Return the places of rows × columns of charts, and whether they are narrow: all in one line.

    They stand in one line where the pictures are larger there. ``line_px``: of a line of text; ``gaps``: between
    charts, and between the rows of those in one line.
    """
    (wide, tall), (rows, columns), (gap, between) = room, shape, gaps
    count, shape_of = rows * columns, 1 if square else FLATTEST
    grid = (wide - (columns - 1) * gap) / columns, (tall - (rows - 1) * gap) / rows
    line = (wide - rows * (columns - 1) * gap - (rows - 1) * between) / count, tall
    in_line, in_rows = min(line[0] / shape_of, line[1] - 4 * line_px), min(grid[0] / shape_of, grid[1] - line_px)
    if in_line > in_rows:
        step, high = line[0] + gap, min(tall, int(line[0]) + 4 * line_px) if square else tall
        lefts = [number * step + number // columns * (between - gap) for number in range(count)]
        return [QRect(round(left), (tall - high) // 2, max(1, int(line[0])), high) for left in lefts], True
    places = [(number // columns, number % columns) for number in range(count)]
    steps = grid[0] + gap, grid[1] + gap
    size = max(1, int(grid[0])), max(1, int(grid[1]))
    return [QRect(round(column * steps[0]), round(row * steps[1]), *size) for row, column in places], False


class TileGrid(QWidget):
    """Charts in rows and columns; ``taken`` tells the row and the column of the one whose point is wanted.

    While they are ``linked``, zoom, pan and lock of one are those of all.
    """

    taken = Signal(int, int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(180, 90)
        self.charts: tuple[TileChart, ...] = ()
        self.shape = 0, 0
        self.linked = True
        self._theme: Tokens | None = None

    def build(self, kind: type[TileChart], shape: tuple[int, int]) -> None:
        """Have rows × columns of charts of a kind; those there are stay where they are of that kind and number."""
        if shape == self.shape and all(type(chart) is kind for chart in self.charts):
            return
        for chart in self.charts:
            chart.hide()
            chart.deleteLater()
        self.shape = shape
        self.charts = tuple(self._chart(kind, number) for number in range(shape[0] * shape[1]))
        self._arrange()

    def _chart(self, kind: type[TileChart], number: int) -> TileChart:
        chart = kind()
        chart.setParent(self)
        if self._theme:
            chart.restyle(self._theme)
        row, column = divmod(number, self.shape[1])
        chart.viewed.connect(lambda: self._follow(chart))
        chart.taken.connect(lambda: self.taken.emit(row, column))
        chart.arrow.connect(lambda right, down: self._go(row + down, column + right))
        chart.show()
        return chart

    def _follow(self, seen: TileChart) -> None:
        """Show the part that one chart shows in all of them, while they have one scale."""
        for chart in self.charts if self.linked else ():
            if (chart.x_axis, chart.y_axis) != (seen.x_axis, seen.y_axis):
                chart.x_axis, chart.y_axis = seen.x_axis, seen.y_axis
                chart.forget_background()

    def _go(self, row: int, column: int) -> None:
        if 0 <= row < self.shape[0] and 0 <= column < self.shape[1]:
            self.charts[row * self.shape[1] + column].setFocus(Qt.FocusReason.TabFocusReason)

    def chart(self, row: int, column: int) -> TileChart:
        """Return one chart."""
        return self.charts[row * self.shape[1] + column]

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the charts their places in the new size."""
        super().resizeEvent(event)
        self._arrange()

    def _arrange(self) -> None:
        if not self.charts:
            return
        first = self.charts[0]
        px, room = first.theme.px, (self.width(), self.height())
        places, narrow = arrange(room, self.shape, px(LINE_PX), (px(GAP_PX), px(GROUP_PX)), first.square)
        for chart, place in zip(self.charts, places, strict=True):
            chart.set_narrow(narrow)
            chart.setGeometry(place)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours and the scale of a theme."""
        self._theme = theme
        for chart in self.charts:
            chart.restyle(theme)
        self._arrange()
