"""The import report: what was read from the lens file, substituted, ignored or refused."""

from html import escape
from pathlib import Path

from PySide6.QtWidgets import QPushButton, QTextBrowser

from p2sf.errors import P2SFError
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.import_report import REFUSED, ImportView, describe_refusal
from p2sf_explorer.files.opening import Refusal, with_substitutes
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import tr, unbroken
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card

TIP = "Import report: what the reader of the lens file took, replaced, ignored or refused, and why."


class ImportReportPanel:
    """The report of the present lens, or of a file just refused, with the offer of substitute glasses."""

    def __init__(self, store: Store):
        self._store, self._theme = store, LIGHT
        self.widget, self.text = Card("Import", TIP), QTextBrowser()
        self.text.setFrameShape(QTextBrowser.Shape.NoFrame)
        self.text.setOpenLinks(False)
        self.text.setAccessibleName(tr("Import report"))
        self.accept = QPushButton(tr("Accept substitutes"), self.widget)
        self.accept.setObjectName("small")
        self.accept.setToolTip(tr("Open the file with the substitute glasses listed; the lens then counts as edited"))
        self.accept.clicked.connect(self._accept)
        self.widget.add_tool(self.accept)
        self.widget.set_body(self.text)
        self._refusal: Refusal | None = None
        self._report: ImportView | None = None
        self._refused_beside: tuple[str, str | None] | None = None

    def show(self, live: Live) -> None:
        """Show the report of the present lens, unless a file was refused while this lens was open."""
        if self._refusal and self._refused_beside != (live.state.optics.lens, live.state.optics.lens_text):
            self._refusal = None
        if not self._refusal:
            self._write(live.views["import"].found)
        self.accept.setVisible(bool(self._refusal and self._refusal.substituted))

    def show_refusal(self, refusal: Refusal) -> None:
        """Show why a file was not opened; the present lens stays."""
        self._refusal = refusal
        self._refused_beside = self._store.state.optics.lens, self._store.state.optics.lens_text
        self._write(describe_refusal(Path(refusal.path).name, refusal.path, refusal.message))
        self.accept.setVisible(bool(refusal.substituted))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.text.setStyleSheet(f"QTextBrowser {{ background: {theme.card}; color: {theme.text}; }}")
        if self._report:
            report, self._report = self._report, None
            self._write(report)

    def _write(self, report: ImportView) -> None:
        if report != self._report:
            self._report = report
            self.text.setHtml(unbroken(page(report, self._theme)))

    def _accept(self) -> None:
        if self._refusal is None:
            return
        try:
            self._store.replace(with_substitutes(self._store.state, self._refusal.path))
        except P2SFError as error:
            self._store.refused.emit(error)


def page(report: ImportView, theme: Tokens) -> str:
    """Return a report as a page."""
    source = escape(report.source.text(WINDOW))
    parts = [f"<p><b>{escape(report.heading)}</b><br><span style='color:{theme.muted}'>{source}</span>"]
    for title, messages in report.groups:
        colour = theme.warning if title == REFUSED else theme.text
        items = "".join(f"<li>{escape(message.text(WINDOW))}</li>" for message in messages)
        parts.append(f"<p style='color:{colour}; margin-bottom:2px'><b>{escape(said(title))}</b>")
        parts.append(f"<ul style='margin-top:0; -qt-list-indent:0; margin-left:14px'>{items}</ul>")
    return "".join(parts)
