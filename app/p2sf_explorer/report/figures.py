"""The drawings of a report on axes of matplotlib: the lens, curves, spots and PSFs."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from p2sf.messages import Message, Style
from p2sf_explorer.compute.framing import frame_of
from p2sf_explorer.compute.layout import Layout
from p2sf_explorer.compute.matrix.overlays import CurveOverlay
from p2sf_explorer.compute.matrix.points import MatrixRequest, heading_texts
from p2sf_explorer.compute.matrix.tiles import Light, MatrixTile, SpotTile, Tiles, figures, scales
from p2sf_explorer.compute.views.field import FieldView
from p2sf_explorer.report.contents import LensReport

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

HUES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#a6761d", "#56b4e9", "#7570b3", "#e6ab02", "#666666")
INK, FAINT, GLASS = "#222222", "#bbbbbb", "#cfe3f2"
MARGIN = 0.08  # of a drawing's extent, left free around it
SMALL, TINY = 7.5, 6.5  # points
LEAST_SHOWN = 0.1  # per cent of distortion, on both sides of 0
BEFORE = 0.3  # of the lens's length, that rays are drawn before it


def style_axes(axes: "Axes", across: str, up: str) -> None:
    """Name axes, and draw them fine."""
    axes.set_xlabel(across, fontsize=SMALL)
    axes.set_ylabel(up, fontsize=SMALL)
    axes.tick_params(labelsize=SMALL, width=0.5, length=2.5)
    axes.grid(color="#e6e6e6", linewidth=0.5)
    axes.set_axisbelow(True)
    for spine in axes.spines.values():
        spine.set_linewidth(0.5)


def draw_lens(axes: "Axes", shown: Layout) -> None:
    """Draw glass, mirrors, stop and sensor to scale, and rays of every field that the lens states."""
    drawn = shown.drawing
    for outline in drawn.outlines:
        axes.fill(outline.z, outline.y, facecolor=GLASS, edgecolor=INK, linewidth=0.6)
    for mirror in drawn.glass.mirrors:
        axes.plot(mirror.z, mirror.y, color=INK, linewidth=1.6)
    for lens in drawn.glass.ideal:
        axes.annotate("", (lens.z, lens.half), (lens.z, -lens.half), arrowprops={"arrowstyle": "<->"})
    length = drawn.right - drawn.left
    for ray in shown.rays:
        axes.plot(ray.z, ray.y, color=HUES[ray.group % len(HUES)], linewidth=0.6)
    for side in (-1, 1):
        ends = np.array([side * drawn.stop_rim, side * (drawn.stop_rim + 0.2 * drawn.half_height)])
        axes.plot(*drawn.stop.placed(0.0, ends), color=INK, linewidth=1.8)
    axes.plot(*drawn.sensor.placed(0.0, np.array([-1, 1]) * shown.sensor_half), color=INK, linewidth=1.2)
    axes.axhline(0, color=FAINT, linewidth=0.4, zorder=0)
    half = (1 + MARGIN) * max(drawn.half_height, shown.sensor_half)
    axes.set_xlim(drawn.left - BEFORE * length, drawn.right + MARGIN * length)
    axes.set_ylim(-half, half)
    axes.set_aspect("equal")
    style_axes(axes, "z, mm", "y, mm")


def draw_curves(axes: "Axes", found: CurveOverlay, words: Style) -> None:
    """Draw curves that are laid over each other: tangential ones solid, sagittal ones dashed."""
    labelled = set()
    for line in found.lines:
        hue = HUES[(line.hue - 1) % len(HUES)] if line.hue else INK
        name = "" if line.hue in labelled else found.names[line.hue - 1].text(words)
        labelled.add(line.hue)
        dash = "-" if line.width > 1 else (0, (4, 2))
        axes.plot(found.x, line.values, color=hue, linewidth=1.0, linestyle=dash, label=name or None)
    style_axes(axes, *(Message(name).text(words) for name in found.axes))
    axes.set_xlim(found.x[0], found.x[-1])
    axes.set_ylim(0, 1.02)
    axes.legend(fontsize=TINY, frameon=False, loc="upper right", ncols=2 if len(found.names) > 4 else 1)


def draw_foci(axes: "Axes", found: FieldView, words: Style) -> None:
    """Draw the sagittal and the tangential focus over the field by exact rays, mm behind the sensor."""
    for name, hue, dash in (("sagittal", HUES[0], "--"), ("tangential", HUES[1], "-")):
        axes.plot(
            getattr(found.real, name), found.field_deg, dash, color=hue, linewidth=1.0, label=Message(name).text(words)
        )
    axes.axvline(0, color=FAINT, linewidth=0.6)
    style_axes(axes, Message("focus, mm behind the sensor").text(words), Message("field, °").text(words))
    axes.legend(fontsize=TINY, frameon=False)


def draw_distortion(axes: "Axes", found: FieldView, words: Style) -> None:
    """Draw the distortion over the field by exact rays, per cent."""
    axes.plot(100 * found.heights.distortion, found.field_deg, color=HUES[2], linewidth=1.0)
    axes.axvline(0, color=FAINT, linewidth=0.6)
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, -LEAST_SHOWN), max(high, LEAST_SHOWN))
    axes.locator_params(axis="x", nbins=5)
    style_axes(axes, Message("distortion, %").text(words), Message("field, °").text(words))


def draw_matrix(figure: "Figure | SubFigure", found: tuple[MatrixRequest, Tiles], words: Style) -> None:
    """Draw the small pictures of spots or PSFs: fields in rows, wavelengths in columns, all of one scale."""
    request, tiles = found
    rows, columns = heading_texts(request)
    sizes, numbers = scales(request.what, tiles, True), figures(tiles)
    grid: Any = figure.subplots(len(rows), len(columns), squeeze=False, gridspec_kw={"hspace": 0.32, "wspace": 0.04})
    for (row, column), axes in np.ndenumerate(grid):
        tile, size = tiles[row][column], sizes[row][column]
        axes.set(xticks=[], yticks=[])
        _draw_tile(axes, tile, size, words)
        axes.set_xlabel(numbers[row][column].text(words), fontsize=TINY, labelpad=2)
        if not row:
            axes.set_title(words.number(columns[column]), fontsize=SMALL)
        if not column:
            axes.set_ylabel(words.number(rows[row]), fontsize=SMALL, rotation=0, ha="right", va="center")
        for spine in axes.spines.values():
            spine.set_linewidth(0.5)


def _draw_tile(axes: "Axes", tile: MatrixTile, size: float, words: Style) -> None:
    content = tile.content
    if isinstance(content, Light):
        half, frame = content.width_um / 2, frame_of(content.circle)
        bright = np.sqrt(np.clip(content.painted / content.painted.max(), 0, None))
        axes.set_facecolor("black")
        axes.imshow(bright, extent=(-half, half, -half, half), origin="lower", cmap="inferno", vmin=0, vmax=1)
        axes.set_xlim(frame.x_um - size / 2, frame.x_um + size / 2)
        axes.set_ylim(frame.y_um - size / 2, frame.y_um + size / 2)
    elif isinstance(content, SpotTile):
        from matplotlib.patches import Circle as Ring

        axes.plot(*content.points.T, ".", color=HUES[0], markersize=0.9)
        axes.add_patch(Ring((0, 0), content.airy_um, fill=False, linewidth=0.5, edgecolor=INK))
        axes.set_xlim(-size, size)
        axes.set_ylim(-size, size)
    else:
        axes.text(0.5, 0.5, "–", ha="center", va="center", transform=axes.transAxes)
        if tile.why:
            axes.set_title(tile.why.text(words), fontsize=TINY, wrap=True)
    axes.set_aspect("equal")


def matrix_scale(found: tuple[MatrixRequest, Tiles]) -> float:
    """Return the common scale of small pictures: the width of PSFs, half that of spots, µm."""
    return max((size for row in scales(found[0].what, found[1], True) for size in row), default=0.0)


Draw = Callable[["Axes"], None]


def curve_drawings(report: LensReport, words: Style) -> list[tuple[Message, list[Draw] | Message]]:
    """Return the drawings of curves by their headings, each beside each other, or why there is none."""
    fields = report.field_curves

    def drawn(found: CurveOverlay | Message) -> list[Draw] | Message:
        return found if isinstance(found, Message) else [lambda axes: draw_curves(axes, found, words)]

    foci: list[Draw] | Message = (
        fields
        if isinstance(fields, Message)
        else [lambda axes: draw_foci(axes, fields, words), lambda axes: draw_distortion(axes, fields, words)]
    )
    return [
        (Message("MTF: tangential solid, sagittal dashed"), drawn(report.contrast)),
        (Message("MTF through focus: tangential solid, sagittal dashed"), drawn(report.through_focus)),
        (Message("Field curves"), foci),
    ]
