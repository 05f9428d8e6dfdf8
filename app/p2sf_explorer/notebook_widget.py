"""The explorer in a notebook: layout, pupil and PSF with sliders; state and link are those of the window.

It does not use Qt and requires ``p2sf[notebook]``.
"""

from html import escape
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from p2sf.errors import P2SFError
from p2sf.io.psf_plot import edges_um, relative
from p2sf.lens.lens import Lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.compute.live import Live, live
from p2sf_explorer.compute.quantities import SOURCE_QUANTITIES, Quantity
from p2sf_explorer.compute.setup import default_state, prescription, ranges
from p2sf_explorer.state.link import is_link, link, state_of_link
from p2sf_explorer.state.state import State, change, entry

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RAYS = {"marginal": "tab:blue", "chief": "tab:orange", "rim": "tab:orange"}
STEPS = 400  # of a slider from end to end


def widget(lens: Lens | Path | str) -> "LensWidget":
    """Return a widget with layout, pupil and PSF of a lens and sliders, to be shown by a notebook cell.

    Parameters
    ----------
    lens : Lens, str or path
        A lens, the name of a shipped one, a lens file, or a link that the window copied ("p2sf:…").

    Returns
    -------
    LensWidget
        ``.link`` is a link to what it shows, which the window opens; ``.state`` is the state, ``.live`` the results.

    Raises
    ------
    P2SFError
        For a lens or link that cannot be read, and if ipywidgets is not installed.
    """
    if isinstance(lens, Lens):
        return LensWidget(default_state(lens.name, lens_to_toml(lens)))
    text = str(lens)
    return LensWidget(state_of_link(text) if is_link(text) else default_state(text))


class LensWidget:
    """Sliders of source and camera beside a picture; Jupyter shows it as the last expression of a cell.

    Attributes
    ----------
    state : State
        The state, as in the window.
    live : Live
        The last results.
    sliders : dict
        The ipywidgets slider of each quantity by its name in the state, such as "field_deg"; its value is its position
        from 0 to 1.
    """

    def __init__(self, state: State):
        try:
            import ipywidgets
        except ImportError as error:
            raise P2SFError("ipywidgets is not installed; run pip install 'p2sf[notebook]'") from error
        self._following = False  # while sliders are set from the state
        self.sliders: dict[str, Any] = {}
        self._numbers = {quantity.key: ipywidgets.Label() for quantity in SOURCE_QUANTITIES}
        for quantity in SOURCE_QUANTITIES:
            slider = ipywidgets.FloatSlider(
                min=0, max=1, step=1 / STEPS, readout=False, description=quantity.title, continuous_update=False
            )
            slider.observe(lambda change, quantity=quantity: self._on_moved(quantity, change["new"]), "value")
            self.sliders[quantity.key] = slider
        rows = [ipywidgets.HBox([self.sliders[key], self._numbers[key]]) for key in self.sliders]
        self._link = ipywidgets.Text(description="Link", continuous_update=False)
        self._link.observe(lambda change: self._on_pasted(change["new"]), "value")
        self._said = ipywidgets.HTML()
        self._picture = ipywidgets.Image(format="png")
        self.box = ipywidgets.HBox([ipywidgets.VBox([*rows, self._link, self._said]), self._picture])
        self.show(state)

    @property
    def link(self) -> str:
        """Return a link to what is shown."""
        return link(self.state)

    def set(self, **values: Any) -> None:
        """Set entries of the state, such as ``field_deg=7, f_number=None``; P2SFError for impossible values."""
        self.show(change(self.state, **values))

    def show(self, state: State) -> None:
        """Show a state; raises P2SFError if it has no picture, and then keeps the previous one."""
        found = live(state)
        self.state, self.live = state, found
        self._picture.value = png(found)
        self._follow()
        self._said.value = escape(str(found.why))

    def _follow(self) -> None:
        """Set sliders, numbers and link from the state."""
        within = ranges(prescription(self.state))
        self._following = True
        for quantity in SOURCE_QUANTITIES:
            value = quantity.shown(self.state, within)
            self.sliders[quantity.key].value = quantity.scale(within).travel(value)
            self._numbers[quantity.key].value = quantity.write(value)
        self._link.value = self.link
        self._following = False

    def _on_moved(self, quantity: Quantity, travel: float) -> None:
        if not self._following:
            within = ranges(prescription(self.state))
            self._try(lambda: self.set(**{quantity.key: quantity.scale(within).value(travel)}))

    def _on_pasted(self, text: str) -> None:
        if not self._following:
            self._try(lambda: self.show(state_of_link(text)))

    def _try(self, change: Any) -> None:
        """Apply a change by the user; if it is impossible, say why and leave everything unchanged."""
        try:
            change()
        except P2SFError as error:
            self._follow()
            self._said.value = f"<b>{escape(str(error))}</b>"

    def _repr_mimebundle_(self, **options: Any) -> Any:
        return self.box._repr_mimebundle_(**options)


def png(found: Live) -> bytes:
    """Return layout, pupil and PSF of results as a PNG."""
    from matplotlib.figure import Figure

    figure: Figure = Figure(figsize=(9, 6), dpi=90, layout="constrained")
    places = figure.subplot_mosaic([["layout", "layout"], ["pupil", "psf"]], height_ratios=(2, 3))
    draw_layout(places["layout"], found)
    draw_pupil(figure, places["pupil"], found)
    draw_psf(figure, places["psf"], found)
    written = BytesIO()
    figure.savefig(written, format="png")
    return written.getvalue()


def draw_layout(axes: "Axes", found: Live) -> None:
    """Draw glass, stop, sensor and rays, mm."""
    drawn = found.layout.drawing
    for outline in drawn.outlines:
        axes.fill(outline.z, outline.y, facecolor="lightsteelblue", edgecolor="slategray", linewidth=0.8)
    for ray in found.layout.rays:
        axes.plot(ray.z, ray.y, color=RAYS.get(ray.kind, "gray"), linewidth=0.7)
    for sign in (1, -1):
        axes.plot([drawn.stop_z] * 2, [sign * drawn.stop_rim, sign * drawn.half_height], color="black", linewidth=2)
    axes.plot(*drawn.sensor_line(found.layout.sensor_half), color="black")
    wide = drawn.right - drawn.left
    axes.set_xlim(drawn.left - 0.15 * wide, drawn.right + 0.05 * wide)
    half = 1.1 * max(drawn.half_height, found.layout.sensor_half)
    axes.set_ylim(-half, half)
    axes.set_aspect("equal")
    axes.set(xlabel="z, mm", ylabel="y, mm")


def draw_pupil(figure: "Figure", axes: "Axes", found: Live) -> None:
    """Draw the wavefront over the pupil, waves."""
    waves = found.pupil.waves
    most = float(np.nanmax(np.abs(waves))) or 1.0
    picture = axes.imshow(waves, origin="lower", extent=(-1, 1, -1, 1), cmap="RdBu_r", vmin=-most, vmax=most)
    figure.colorbar(picture, ax=axes, label="wavefront, waves")
    axes.set(xlabel="ξ", ylabel="η", title=f"RMS {found.pupil.rms:.3g} waves")


def draw_psf(figure: "Figure", axes: "Axes", found: Live) -> None:
    """Draw the square root of the PSF, so that faint light shows; axes in µm."""
    picture = axes.imshow(
        np.sqrt(relative(found.psf.values)), extent=edges_um(found.psf), origin="lower", cmap="inferno"
    )
    figure.colorbar(picture, ax=axes, label="√(light / peak)")
    axes.set(xlabel="x, µm", ylabel="y, µm", title=f"PSF, {entry(found.state, 'field_deg'):.4g}°")
