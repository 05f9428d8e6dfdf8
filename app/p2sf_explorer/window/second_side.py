"""The panel of B beside that of A on the stage."""

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.panels import Panel, build, end_work
from p2sf_explorer.state.panels import PANELS
from p2sf_explorer.store.store import Store
from p2sf_explorer.window.stage import PanelPlace


class SecondSide(QObject):
    """A second panel of the kind that is on the stage, for as long as A and B stand side by side.

    It refuses to put values of B into A, and has no place of its own that a person could move it to.
    """

    def __init__(self, store: Store, place: PanelPlace) -> None:
        super().__init__(place)
        self._store, self._place = store, place
        self.panel: Panel | None = None
        self._first: QWidget | None = None
        self._theme: Tokens | None = None

    def follow(self, key: str, first: Panel | None) -> Panel | None:
        """Return the panel of B beside the ``first`` one, which is of A; None for none."""
        from p2sf_explorer.charts.linked import link

        card = first.widget if first else None
        if card is not self._first:
            self.stop()
            if first and card:
                self.panel, self._first = build(PANELS[key], self._store, "b"), card
                self.panel.widget.key = key
                self.panel.widget.stand_beside()
                self._place.put(self.panel.widget)
                link(card, self.panel.widget)
        return self.panel

    def share_scales(self) -> None:
        """Give the plots of both panels one scale."""
        from p2sf_explorer.charts.linked import share_scales

        if self.panel and self._first:
            share_scales(self._first, self.panel.widget)

    def restyle(self, theme: Tokens) -> None:
        """Take a theme."""
        if self.panel and theme != self._theme:
            self._theme = theme
            self.panel.restyle(theme)
            self.panel.widget.rescale(theme.scale)

    def stop(self) -> None:
        """Take the panel away, with its background work."""
        from p2sf_explorer.charts.linked import part

        gone, first, self.panel, self._first, self._theme = self.panel, self._first, None, None, None
        if gone is None or first is None:
            return
        end_work(gone)
        part(first)
        gone.widget.hide()
        gone.widget.deleteLater()
