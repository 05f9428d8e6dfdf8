"""The panels: one file each, one line each in the registry below, imported when first opened.

A panel is a `Panel`: it paints an answer and computes nothing. What it shows beyond the answer, its view, is a function
``view(live)`` without Qt in `p2sf_explorer.results`, whose result arrives as ``live.views[key]``.
"""

from dataclasses import dataclass
from importlib import import_module
from typing import Any, Protocol, runtime_checkable

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


@dataclass(frozen=True)
class PanelEntry:
    """One registered panel: ``panel`` is its module:class, ``view`` the module:function of its view, if it has one.

    ``place`` is "main" or "tab", ``group`` the one of `GROUPS` among whose tabs it stands.
    """

    key: str
    title: str
    panel: str
    place: str = "tab"
    view: str = ""
    group: str = "Tools"


GROUPS = ("PSF", "Rays", "Aberrations", "Lens", "Tools")


def tab(group: str, key: str, title: str, panel: str, view: str = "") -> PanelEntry:
    """Return the entry of a tab; panel and view are module:name in their folders."""
    return PanelEntry(
        key, title, f"p2sf_explorer.panels.{panel}", "tab", view and f"p2sf_explorer.results.{view}", group
    )


REGISTRY = (
    PanelEntry("layout", "Layout", "p2sf_explorer.panels.layout:LayoutPanel", "main"),
    PanelEntry("pupil", "Pupil", "p2sf_explorer.panels.pupil:PupilPanel", "main"),
    PanelEntry("psf", "PSF", "p2sf_explorer.panels.psf:PsfPanel", "main"),
    PanelEntry("coefficients", "Coefficients", "p2sf_explorer.panels.coefficients:CoefficientsPanel", "main"),
    tab("PSF", "profiles", "Profiles", "profiles:ProfilesPanel", "profiles:profiles"),
    tab("PSF", "mtf", "MTF", "mtf:MtfPanel", "mtf:contrast"),
    tab("PSF", "through_focus", "Through focus", "through_focus:ThroughFocusPanel", "through_focus:strip"),
    tab("PSF", "field_map", "Field map", "field_map:FieldMapPanel", "field_map:field_map"),
    tab("PSF", "beside", "Perfect lens", "pixels:BesidePanel", "pixels:beside"),
    tab("PSF", "colour", "Colour", "colour:ColourPanel", "colour:question"),
    tab("Rays", "spot", "Spot", "spot:SpotPanel", "rays:spots"),
    tab("Rays", "ray_fan", "Ray fan", "fans:RayFanPanel", "rays:ray_errors"),
    tab("Rays", "opd_fan", "OPD fan", "fans:OpdFanPanel", "rays:path_errors"),
    tab("Aberrations", "seidel", "Seidel per surface", "seidel:SeidelPanel", "seidel:per_surface"),
    tab("Aberrations", "field", "Field curves", "field:FieldPanel", "field:field_curves"),
    tab("Aberrations", "chromatic", "Chromatic shift", "chromatic:ChromaticPanel", "chromatic:chromatic"),
    tab("Lens", "lens", "Table", "lens_table:LensTablePanel", "lens_table:rows"),
    tab("Lens", "first_order", "First order", "first_order:FirstOrderPanel", "first_order:first_order"),
    tab("Lens", "ybar", "y–ȳ", "ybar:YBarPanel", "ybar:ybar"),
    tab(
        "Lens", "depth_of_field", "Depth of field", "depth_of_field:DepthOfFieldPanel", "depth_of_field:depth_of_field"
    ),
    PanelEntry(
        "solid", "3D", "p2sf_explorer.panels.solid:SolidPanel", "tab", "p2sf_explorer.scene3d.scene:scene", "Lens"
    ),
    tab("Lens", "import", "Import", "import_report:ImportReportPanel", "import_report:report"),
    tab("Tools", "image", "Image", "image:ImagePanel", "image:question"),
    tab("Tools", "database", "Database", "database:DatabasePanel", "database:question"),
    tab("Tools", "accuracy", "Accuracy", "accuracy:AccuracyPanel"),
)


def build(entry: PanelEntry, store: Store) -> Panel:
    """Return a new panel of a registry entry, whose store does not put values of B into A."""
    made: Panel = _named(entry.panel)(PanelStore(store))
    return made


def view_of(entry: PanelEntry) -> ResultFunction | None:
    """Return the view function of a registry entry, None where it has none."""
    found: ResultFunction | None = _named(entry.view) if entry.view else None
    return found


def _named(path: str) -> Any:
    module, name = path.split(":")
    return getattr(import_module(module), name)
