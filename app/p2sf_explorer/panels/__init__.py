"""The panels: one file each, one line each in the registry below, imported when first opened.

A panel is a `Panel`: it paints an answer and computes nothing. What it shows beyond the answer, its view, is a function
``view(live)`` without Qt in `p2sf_explorer.results`, whose result arrives as ``live.views[key]``.
"""

from dataclasses import dataclass
from importlib import import_module
from typing import Any, Protocol, runtime_checkable

from PySide6.QtWidgets import QToolButton

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live, ResultFunction
from p2sf_explorer.store.panel_store import PanelStore
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card


@runtime_checkable
class Panel(Protocol):
    """What the window asks of every panel.

    Through the panel's card the window covers it with a sentence where it has nothing to show (``show_overlay``), names
    the side of a comparison (``show_side``), and hears that the panel is wanted in a window of its own
    (``apart_asked``).
    """

    @property
    def widget(self) -> Card:
        """The card that the panel stands in."""

    def show(self, live: Live) -> None:
        """Paint an answer."""

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""


@runtime_checkable
class BackgroundPanel(Panel, Protocol):
    """A panel with threads, processes or graphics memory of its own, which it gives up with the window."""

    def stop(self) -> None:
        """End the background work for good."""


@runtime_checkable
class PreparingPanel(Panel, Protocol):
    """A panel that needs some time before it can show its first picture."""

    @property
    def busy(self) -> bool:
        """Whether it is still being prepared."""


@runtime_checkable
class FilmedPanel(Panel, Protocol):
    """A panel whose builds can be filmed."""

    film: QToolButton
    """The button that asks for the film."""


@dataclass(frozen=True)
class PanelEntry:
    """One registered panel, of the group of `GROUPS` among whose tabs it stands.

    ``handbook`` is the section of the theory it leads to, ``panel`` its module:class in this folder, ``view`` the
    module:function of its view in the explorer, if it has one.
    """

    group: str
    key: str
    title: str
    handbook: str
    panel: str
    view: str = ""


GROUPS = ("PSF", "Rays", "Aberrations", "Lens", "Tools")
tab = PanelEntry
REGISTRY = (
    tab("PSF", "psf", "PSF", "4.1", "psf:PsfPanel", "compute.finer:source"),
    tab("PSF", "profiles", "Profiles", "6.3", "profiles:ProfilesPanel", "results.profiles:profiles"),
    tab("PSF", "mtf", "MTF", "6.3", "mtf:MtfPanel", "results.mtf:contrast"),
    tab(
        "PSF", "through_focus", "Through focus", "3.3", "through_focus:ThroughFocusPanel", "results.through_focus:strip"
    ),
    tab("PSF", "matrix", "Matrix", "6.4", "matrix:MatrixPanel", "matrix.pictures:matrix"),
    tab("PSF", "field_map", "Field map", "1.3", "field_map:FieldMapPanel", "results.field_map:field_map"),
    tab("PSF", "beside", "Perfect lens", "9.2", "pixels:BesidePanel", "results.pixels:beside"),
    tab("PSF", "colour", "Colour", "9.1", "colour:ColourPanel", "results.colour:question"),
    tab("Rays", "spot", "Spot", "8.3", "spot:SpotPanel", "results.rays:spots"),
    tab("Rays", "ray_fan", "Ray fan", "8.3", "fans:RayFanPanel", "results.rays:ray_errors"),
    tab("Rays", "opd_fan", "OPD fan", "4.3", "fans:OpdFanPanel", "results.rays:path_errors"),
    tab("Aberrations", "coefficients", "Coefficients", "3.2", "coefficients:CoefficientsPanel", "results.seidel:six"),
    tab("Aberrations", "pupil", "Pupil", "3.1", "pupil:PupilPanel"),
    tab("Aberrations", "seidel", "Seidel per surface", "3.2", "seidel:SeidelPanel", "results.seidel:per_surface"),
    tab("Aberrations", "zernike", "Zernike", "3.4", "zernike:ZernikePanel", "results.zernike:zernike"),
    tab("Aberrations", "field", "Field curves", "8.3", "field:FieldPanel", "results.field:field_curves"),
    tab(
        "Aberrations", "chromatic", "Chromatic shift", "8.3", "chromatic:ChromaticPanel", "results.chromatic:chromatic"
    ),
    tab("Lens", "layout", "Layout", "2.2", "layout:LayoutPanel", "results.rays:lens_drawn"),
    tab("Lens", "lens", "Table", "1.1", "lens_table:LensTablePanel", "results.lens_table:rows"),
    tab("Lens", "misalign", "Misalign", "8.5", "misalign:MisalignPanel", "results.lens_table:misalignment"),
    tab("Lens", "first_order", "First order", "2.1", "first_order:FirstOrderPanel", "results.first_order:first_order"),
    tab("Lens", "curves", "Overlays", "6.5", "overlays:OverlaysPanel", "matrix.overlays:overlay"),
    tab("Lens", "ybar", "y–ȳ", "8.4", "ybar:YBarPanel", "results.ybar:ybar"),
    tab(
        "Lens",
        "depth_of_field",
        "Depth of field",
        "10.3",
        "depth_of_field:DepthOfFieldPanel",
        "results.depth_of_field:depth_of_field",
    ),
    tab("Lens", "solid", "3D", "8.1", "solid:SolidPanel", "scene3d.scene:scene"),
    tab("Tools", "image", "Image", "10.1", "image:ImagePanel", "results.image:question"),
    tab("Tools", "measured", "Measured", "11.3", "measured:MeasuredPanel", "measuring.measurement:question"),
    tab("Tools", "tolerances", "Tolerances", "8.8", "tolerances:TolerancesPanel", "tolerancing.analysis:question"),
    tab("Tools", "database", "Database", "7.1", "database:DatabasePanel", "results.database:question"),
    tab("Tools", "accuracy", "Accuracy", "6.1", "accuracy:AccuracyPanel"),
    tab("Tools", "import", "Import", "1.1", "import_report:ImportReportPanel", "results.import_report:report"),
)


def build(entry: PanelEntry, store: Store) -> Panel:
    """Return a new panel of a registry entry, whose store does not put values of B into A."""
    own = PanelStore(store)
    made: Panel = _named(f"panels.{entry.panel}")(own)
    own.setParent(made.widget)
    return made


def view_of(entry: PanelEntry) -> ResultFunction | None:
    """Return the view function of a registry entry, None where it has none."""
    found: ResultFunction | None = _named(entry.view) if entry.view else None
    return found


def _named(path: str) -> Any:
    module, name = path.split(":")
    return getattr(import_module(f"p2sf_explorer.{module}"), name)
