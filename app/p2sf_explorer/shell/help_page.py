"""The page of shortcuts in a window that scrolls where the screen is short."""

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QDialog, QTextBrowser, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import tr

WIDE, TALL = 620, 860


class HelpPage(QDialog):
    """Shows a page of HTML; Escape or its frame closes it."""

    def __init__(self, html: str, parent: QWidget):
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
