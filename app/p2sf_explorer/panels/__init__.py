"""The panels: one file each, one line each in the registry below, imported when first opened.

A panel is an object with a ``widget``, ``show(live)`` that paints what ``live`` holds and computes nothing, and
``restyle(theme)``. Its view, if it needs one, is a function ``view(live)`` without Qt in `p2sf_explorer.results`; its
result arrives as ``live.views[key]``.
"""

from dataclasses import dataclass
from importlib import import_module
from typing import Protocol

from PySide6.QtWidgets import QWidget

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live, ResultFunction
from p2sf_explorer.store.panel_store import PanelStore
from p2sf_explorer.store.store import Store


class Panel(Protocol):
    """What the window asks of a panel."""

    widget: QWidget

    def show(self, live: Live) -> None:
        """Paint an answer."""

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""


@dataclass(frozen=True)
class PanelEntry:
    """One registered panel: module:class, place "main" or "tab", module:function of its view.

    ``group``: the one of `GROUPS` whose tabs it stands among.
    """

    key: str
    title: str
    panel: str
    place: str = "tab"
    view: str = ""
    group: str = "Tools"


GROUPS = ("PSF", "Rays", "Aberrations", "Lens", "Tools")


def tab(group: str, key: str, title: str, panel: str, view: str = "") -> PanelEntry:
    """Return the line of a tab: its group, key and title, and module:name of panel and view in their folders."""
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
    """Return a new panel of a registry line; what it shows of B it does not put into A."""
    return _named(entry.panel)(PanelStore(store))


def view_of(entry: PanelEntry) -> ResultFunction | None:
    """Return the view function of a registry line, None when it needs none."""
    return _named(entry.view) if entry.view else None


def _named(path: str):
    module, name = path.split(":")
    return getattr(import_module(module), name)
