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
    """One registered panel: ``panel`` is its module:class, ``view`` the module:function of its view, if it has one.

    ``handbook`` is the section of the theory it leads to, ``group`` the one of `GROUPS` among whose tabs it stands.
    """

    key: str
    title: str
    panel: str
    handbook: str
    view: str = ""
    group: str = "Tools"


GROUPS = ("PSF", "Rays", "Aberrations", "Lens", "Tools")


def tab(group: str, key: str, title: str, handbook: str, panel: str, view: str = "") -> PanelEntry:
    """Return the entry of a tab; panel and view are module:name in their folders."""
    own = view.startswith(("matrix.", "measuring.", "tolerancing."))
    view = view and f"p2sf_explorer.{view if own else 'results.' + view}"
    return PanelEntry(key, title, f"p2sf_explorer.panels.{panel}", handbook, view, group)


REGISTRY = (
    PanelEntry("psf", "PSF", "p2sf_explorer.panels.psf:PsfPanel", "4.1", "p2sf_explorer.compute.finer:source", "PSF"),
    tab("PSF", "profiles", "Profiles", "6.3", "profiles:ProfilesPanel", "profiles:profiles"),
    tab("PSF", "mtf", "MTF", "6.3", "mtf:MtfPanel", "mtf:contrast"),
    tab("PSF", "through_focus", "Through focus", "3.3", "through_focus:ThroughFocusPanel", "through_focus:strip"),
    tab("PSF", "matrix", "Matrix", "6.4", "matrix:MatrixPanel", "matrix.pictures:matrix"),
    tab("PSF", "field_map", "Field map", "1.3", "field_map:FieldMapPanel", "field_map:field_map"),
    tab("PSF", "beside", "Perfect lens", "9.2", "pixels:BesidePanel", "pixels:beside"),
    tab("PSF", "colour", "Colour", "9.1", "colour:ColourPanel", "colour:question"),
    tab("Rays", "spot", "Spot", "8.3", "spot:SpotPanel", "rays:spots"),
    tab("Rays", "ray_fan", "Ray fan", "8.3", "fans:RayFanPanel", "rays:ray_errors"),
    tab("Rays", "opd_fan", "OPD fan", "4.3", "fans:OpdFanPanel", "rays:path_errors"),
    tab("Aberrations", "coefficients", "Coefficients", "3.2", "coefficients:CoefficientsPanel", "seidel:six"),
    tab("Aberrations", "pupil", "Pupil", "3.1", "pupil:PupilPanel"),
    tab("Aberrations", "seidel", "Seidel per surface", "3.2", "seidel:SeidelPanel", "seidel:per_surface"),
    tab("Aberrations", "zernike", "Zernike", "3.4", "zernike:ZernikePanel", "zernike:zernike"),
    tab("Aberrations", "field", "Field curves", "8.3", "field:FieldPanel", "field:field_curves"),
    tab("Aberrations", "chromatic", "Chromatic shift", "8.3", "chromatic:ChromaticPanel", "chromatic:chromatic"),
    tab("Lens", "layout", "Layout", "2.2", "layout:LayoutPanel", "rays:lens_drawn"),
    tab("Lens", "lens", "Table", "1.1", "lens_table:LensTablePanel", "lens_table:rows"),
    tab("Lens", "misalign", "Misalign", "8.5", "misalign:MisalignPanel", "lens_table:misalignment"),
    tab("Lens", "first_order", "First order", "2.1", "first_order:FirstOrderPanel", "first_order:first_order"),
    tab("Lens", "curves", "Overlays", "6.5", "overlays:OverlaysPanel", "matrix.overlays:overlay"),
    tab("Lens", "ybar", "y–ȳ", "8.4", "ybar:YBarPanel", "ybar:ybar"),
    tab(
        "Lens",
        "depth_of_field",
        "Depth of field",
        "10.3",
        "depth_of_field:DepthOfFieldPanel",
        "depth_of_field:depth_of_field",
    ),
    PanelEntry(
        "solid",
        "3D",
        "p2sf_explorer.panels.solid:SolidPanel",
        "8.1",
        "p2sf_explorer.scene3d.scene:scene",
        "Lens",
    ),
    tab("Tools", "image", "Image", "10.1", "image:ImagePanel", "image:question"),
    tab("Tools", "measured", "Measured", "11.3", "measured:MeasuredPanel", "measuring.measurement:question"),
    tab("Tools", "tolerances", "Tolerances", "8.8", "tolerances:TolerancesPanel", "tolerancing.analysis:question"),
    tab("Tools", "database", "Database", "7.1", "database:DatabasePanel", "database:question"),
    tab("Tools", "accuracy", "Accuracy", "6.1", "accuracy:AccuracyPanel"),
    tab("Tools", "import", "Import", "1.1", "import_report:ImportReportPanel", "import_report:report"),
)


def build(entry: PanelEntry, store: Store) -> Panel:
    """Return a new panel of a registry entry, whose store does not put values of B into A."""
    own = PanelStore(store)
    made: Panel = _named(entry.panel)(own)
    own.setParent(made.widget)
    return made


def view_of(entry: PanelEntry) -> ResultFunction | None:
    """Return the view function of a registry entry, None where it has none."""
    found: ResultFunction | None = _named(entry.view) if entry.view else None
    return found


def _named(path: str) -> Any:
    module, name = path.split(":")
    return getattr(import_module(module), name)
