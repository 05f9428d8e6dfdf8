"""The page of shortcuts, made from the commands themselves."""

from html import escape

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QDialog, QTextBrowser, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.command import Command

MOUSE_AND_KEYS = (
    ("← → ↑ ↓, Page Up/Down", "move the slider that has the focus"),
    ("Shift, Alt", "with wheel, arrows or a dragged number: ten times as coarse, ten times as fine"),
    ("drag or wheel on a number", "change it; a click types"),
    ("Escape", "while something is dragged: give up, as it was before"),
    ("double-click", "back to the lens's own value"),
    ("wheel, drag, double-click", "zoom, pan or see the whole of the plot under the pointer; also + −, arrows, Home"),
    ("click or P, L", "pin a marker to a plot; lock its scales"),
    ("Tab, Shift+Tab", "to the next or the previous control"),
    ("drop a file", "open it: Zemax .zmx (also zipped), CODE V .seq, OSLO .len, ray-optics .roa, .json of ISET, "
     "Optiland, DeepLens, ray-optics-web and of patents, .fx of renderers, ISET .dat, "
     "Optical Bench .txt, .csv with named columns, .toml, or a saved state"),
)  # fmt: skip
POINT = "Typed numbers may have a decimal point or a decimal comma; files and the command line take a decimal point."
LEAD = "Drag a slider: lens, pupil and PSF follow. Hover over a name for its definition."


def help_text(commands: tuple[Command, ...]) -> str:
    """Return the page as HTML: mouse and slider keys, then every command with keys, group by group."""
    rows = [_row(tr(keys), tr(words)) for keys, words in MOUSE_AND_KEYS]
    for group in dict.fromkeys(command.group for command in commands):
        known = [command for command in commands if command.group == group and command.keys]
        if known:
            rows.append(f'<tr><td colspan="2"><b>{escape(tr(group))}</b></td></tr>')
            rows += [_row(", ".join(command.keys), tr(command.title)) for command in known]
    lead, point = escape(tr(LEAD)), escape(tr(POINT))
    return f'<h3>P2SF Explorer</h3><p>{lead}</p><table cellpadding="2">{"".join(rows)}</table><p>{point}</p>'


def _row(keys: str, words: str) -> str:
    return f"<tr><td><code>{escape(keys)}</code>&nbsp;&nbsp;</td><td>{escape(words)}</td></tr>"


WIDE, TALL = 620, 860


class HelpPage(QDialog):
    """Shows a page of HTML; Escape or its frame closes it."""

    def __init__(self, html: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("window")
        self.setWindowTitle(tr("Help"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.text = QTextBrowser(self)
        self.text.setHtml(html)
        self.text.setFrameShape(QTextBrowser.Shape.NoFrame)
        self.text.setAccessibleName(tr("Shortcuts"))
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addWidget(self.text)
        room = self.screen().availableGeometry()
        self.resize(QSize(WIDE, TALL).boundedTo(QSize(room.width() - 40, room.height() - 80)))
