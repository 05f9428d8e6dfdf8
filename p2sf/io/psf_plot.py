"""Plots for a file: a PSF with its scale, or a spot diagram, drawn without a screen and without global state."""

from math import floor, log10
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from p2sf.arguments import argument
from p2sf.colour.colorimetry import srgb_from_linear
from p2sf.figures.colour_psf import ColourPsf, faint_rgb
from p2sf.figures.psf_data import PsfData

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BAR_SHARE = 0.25  # the scale bar takes at most this share of the width


def draw_psf(handle: "BinaryIO | Axes", psf: PsfData, title: str = "", metadata: dict | None = None) -> None:
    """Draw one PSF: µm axes, scale bar, colour bar in fractions of the peak.

    ``handle``: an open binary file, to which a PNG is written, or axes of matplotlib.
    Colours follow the square root of the intensity, so that faint light shows; the colour bar says so.
    ``metadata`` becomes the PNG's text entries, ASCII keys and values.
    """
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    psf = argument("psf", psf, PsfData)
    if isinstance(handle, Axes):
        return _draw(handle, psf, title)
    figure = Figure(figsize=(6.4, 5.4), dpi=150, layout="constrained")
    _draw(figure.add_subplot(), psf, title)
    return _write_png(figure, handle, metadata)


def _draw(axes: "Axes", psf: PsfData, title: str) -> None:
    from matplotlib.colors import PowerNorm

    root = PowerNorm(0.5, vmin=0, vmax=1)
    picture = axes.imshow(relative(psf.values), extent=edges_um(psf), origin="lower", cmap="magma", norm=root)
    x, y = ("across the field", "along the field") if psf.azimuth_deg else ("x on the sensor", "y on the sensor")
    axes.set(xlabel=f"{x}, µm", ylabel=f"{y}, µm")
    axes.set_title(title, fontsize=9, loc="left")
    axes.figure.colorbar(
        picture, ax=axes, ticks=[0, 0.01, 0.1, 0.25, 0.5, 1], label="intensity / peak (square-root colours)"
    )
    _draw_scale_bar(axes, psf)


def draw_colour_psf(handle: BinaryIO, found: ColourPsf, title: str = "", metadata: dict | None = None) -> None:
    """Write a colour PSF as a PNG into an open binary file: sRGB, µm axes, scale bar.

    The light's square root is shown, so that faint colours show. ``metadata`` becomes the PNG's text entries.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.6, 5.4), dpi=150, layout="constrained")
    axes = figure.add_subplot()
    axes.imshow(srgb_from_linear(faint_rgb(found)), extent=edges_um(found), origin="lower", interpolation="nearest")
    axes.set(xlabel="x on the sensor, µm", ylabel="y on the sensor, µm")
    axes.set_title(title, fontsize=9, loc="left")
    _draw_scale_bar(axes, found)
    _write_png(figure, handle, metadata)


def relative(values: np.ndarray) -> np.ndarray:
    """Return intensities as fractions of the highest one."""
    fractions: np.ndarray = values / values.max()
    return fractions


def edges_um(psf: PsfData | ColourPsf) -> tuple[float, float, float, float]:
    """Return (left, right, bottom, top) of the picture in µm; samples lie in the middle of their pixels."""
    half = psf.pixel_um / 2
    x, y = psf.x_um, psf.y_um
    return x[0] - half, x[-1] + half, y[0] - half, y[-1] + half


def round_length(longest: float) -> float:
    """Return the largest of 1, 2, 5 times a power of ten that is no longer than ``longest``."""
    decade = 10.0 ** floor(log10(longest))
    return max(step * decade for step in (1, 2, 5) if step * decade <= longest * (1 + 1e-9))


def _write_png(figure: "Figure", handle: BinaryIO, metadata: dict | None = None) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas: Any = FigureCanvasAgg(figure)  # matplotlib leaves this method without types
    canvas.print_png(handle, metadata=metadata)


def _draw_scale_bar(axes: "Axes", psf: PsfData | ColourPsf) -> None:
    """Draw a white bar and its length, with a dark edge that keeps them readable on bright light."""
    from matplotlib.patches import Rectangle
    from matplotlib.patheffects import withStroke

    left, right, bottom, top = edges_um(psf)
    width, height = right - left, top - bottom
    length = round_length(BAR_SHARE * width)
    x, y = left + 0.05 * width, bottom + 0.05 * height
    edge: dict[str, Any] = {"path_effects": [withStroke(linewidth=3, foreground="black")]}
    axes.add_patch(Rectangle((x, y), length, 0.012 * height, facecolor="white", **edge))
    axes.text(x + length / 2, y + 0.025 * height, f"{length:g} µm", color="white", ha="center", va="bottom", **edge)


def draw_spot(
    handle: BinaryIO, points_um: np.ndarray, airy_radius_um: float, title: str = "", metadata: dict | None = None
) -> None:
    """Write a spot diagram as a PNG: rays (rays, 2) in µm from the chief ray, and the Airy circle around it.

    ``metadata`` becomes the PNG's text entries.
    """
    from matplotlib.figure import Figure
    from matplotlib.patches import Circle

    figure = Figure(figsize=(5.4, 5.4), dpi=150, layout="constrained")
    axes = figure.add_subplot(aspect="equal", xlabel="x on the sensor, µm", ylabel="y on the sensor, µm")
    axes.plot(*points_um.T, ".", markersize=2.5)
    axes.add_patch(Circle((0, 0), airy_radius_um, fill=False, linestyle="--", label="Airy circle"))
    axes.plot(0, 0, "+", color="black", label="chief ray")
    axes.set_title(title, fontsize=9, loc="left")
    axes.legend(fontsize=8, loc="upper right")
    axes.grid(alpha=0.3)
    _write_png(figure, handle, metadata)
