"""The panels: one file each, one line each in the registry below, imported when first opened.

A panel is an object with a ``widget``, ``show(live)`` that paints what ``live`` holds and computes nothing, and
``restyle(theme)``. Its view, if it needs one, is a function ``view(live)`` without Qt in ``app.views``; its result
arrives as ``live.views[key]``.
"""

from dataclasses import dataclass
from importlib import import_module
from typing import Protocol

from PySide6.QtWidgets import QWidget

from app.compute import Live, View
from app.store import Store
from app.theme import Tokens


class Panel(Protocol):
    """What the window asks of a panel."""

    widget: QWidget

    def show(self, live: Live) -> None:
        """Paint an answer."""

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""


@dataclass(frozen=True)
class Entry:
    """One registered panel: module:class, place "main" or "tab", and module:function of its view."""

    key: str
    title: str
    panel: str
    place: str = "tab"
    view: str = ""


REGISTRY = (
    Entry("layout", "Layout", "app.panels.layout:LayoutPanel", "main"),
    Entry("pupil", "Pupil", "app.panels.pupil:PupilPanel", "main"),
    Entry("psf", "PSF", "app.panels.psf:PsfPanel", "main"),
    Entry("coefficients", "Coefficients", "app.panels.coefficients:CoefficientsPanel", "main"),
    Entry("profiles", "Profiles", "app.panels.profiles:ProfilesPanel", view="app.views.profiles:profiles"),
    Entry("mtf", "MTF", "app.panels.mtf:MtfPanel", view="app.views.mtf:contrast"),
    Entry("spot", "Spot", "app.panels.spot:SpotPanel", view="app.views.rays:spots"),
    Entry("ray_fan", "Ray fan", "app.panels.fans:RayFanPanel", view="app.views.rays:ray_errors"),
    Entry("opd_fan", "OPD fan", "app.panels.fans:OpdFanPanel", view="app.views.rays:path_errors"),
    Entry("seidel", "Seidel per surface", "app.panels.seidel:SeidelPanel", view="app.views.seidel:per_surface"),
    Entry("lens", "Lens table", "app.panels.lens_table:LensTablePanel", view="app.views.lens_table:rows"),
    Entry(
        "import", "Import report", "app.panels.import_report:ImportReportPanel", view="app.views.import_report:report"
    ),
    Entry("database", "Database", "app.panels.database:DatabasePanel", view="app.views.database:question"),
    Entry("accuracy", "Accuracy", "app.panels.accuracy:AccuracyPanel"),
)


def build(entry: Entry, store: Store) -> Panel:
    """Return a new panel of a registry line."""
    return _named(entry.panel)(store)


def view_of(entry: Entry) -> View | None:
    """Return the view function of a registry line, None when it needs none."""
    return _named(entry.view) if entry.view else None


def _named(path: str):
    module, name = path.split(":")
    return getattr(import_module(module), name)
