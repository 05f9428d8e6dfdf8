"""The handbook in a window: contents at the left, a page at the right, formulas in the text's own colour."""

import numpy as np
from PySide6.QtCore import QSize, Qt, QUrl
from PySide6.QtGui import (
    QColor,
    QImage,
    QTextBlock,
    QTextBlockFormat,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
    QTextFragment,
    QTextLength,
    QTextTable,
)
from PySide6.QtWidgets import QDialog, QSplitter, QTextBrowser, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.handbook.pages import (
    ENGLISH,
    FOLDER,
    PAGES,
    Formula,
    anchor,
    formulas,
    heading_in,
    headings,
    page,
    pictures,
    render_formula,
    translated,
    window_page,
    with_pictures,
)
from p2sf_explorer.i18n.language import current_language
from p2sf_explorer.i18n.tr import tr

TEXT_PX, FORMULA_PX, TABLE_PX = 14, 15, 11
WIDE, TALL, CONTENTS = 1100, 820, 260
PICTURE_PX = 720
MANY_COLUMNS = 8  # from which a table of numbers is set small and unbroken
DESCENT = 0.16  # of the text's size: what a letter hangs below the line
BODY = """
h1 {{ font-size: 26px; }} h2 {{ font-size: 19px; }} h3 {{ font-size: 16px; }}
table {{ border-color: {line}; }} td, th {{ padding: 3px 8px; }} a {{ color: {accent}; }}
"""


class Handbook(QDialog):
    """Shows pages: ``show_heading("panels", "MTF")``, or by a section's number ``show_section("theory", "3.2")``."""

    def __init__(self, theme: Tokens, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("window")
        self.setWindowTitle(tr("Handbook"))
        self._theme, self._page = theme, ""
        self.shown = "", ""  # the page and the heading it was last asked for
        self.contents, self.text = QTreeWidget(self), QTextBrowser(self)
        self.contents.setHeaderHidden(True)
        self.contents.setAccessibleName(tr("Contents"))
        self.text.setAccessibleName(tr("Handbook"))
        self.text.setOpenLinks(False)
        self.text.setFrameShape(QTextBrowser.Shape.NoFrame)
        self.text.anchorClicked.connect(self._follow)
        for name, title in PAGES.items():
            branch = _branch(name, title)
            self.contents.addTopLevelItem(branch)
            branch.setExpanded(name == next(iter(PAGES)))
        self.contents.itemClicked.connect(lambda item: self._open(*item.data(0, Qt.ItemDataRole.UserRole)))
        split = QSplitter(self)
        split.addWidget(self.contents)
        split.addWidget(self.text)
        split.setSizes([CONTENTS, WIDE - CONTENTS])
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addWidget(split)
        room = self.screen().availableGeometry()
        self.resize(QSize(WIDE, TALL).boundedTo(QSize(room.width() - 40, room.height() - 80)))

    def show_section(self, name: str = "theory", number: str = "") -> None:
        """Open a page, at the section of this number where one is given."""
        found = next(
            (
                heading.text
                for heading in headings(page(name, current_language()))
                if number and heading.number == number
            ),
            "",
        )
        self.show_heading(name, found)

    def show_heading(self, name: str, heading: str = "") -> None:
        """Open a page at a heading, by its text in English or in the window's language; at its beginning without."""
        self.shown = name, heading
        self.show()
        self.raise_()
        self.activateWindow()
        self._open(name, heading_in(name, heading, current_language()))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        if theme == self._theme:
            return
        self._theme, name, self._page = theme, self._page, ""
        if name:
            self._open(name, "")

    def _open(self, name: str, heading: str) -> None:
        if name != self._page:
            self._page = name
            self.text.setDocument(self._document(name))
        self._scroll_to(heading)
        for item in self.contents.findItems("", Qt.MatchFlag.MatchContains | Qt.MatchFlag.MatchRecursive):
            if item.data(0, Qt.ItemDataRole.UserRole) == (name, heading):
                self.contents.setCurrentItem(item)

    def _follow(self, link: QUrl) -> None:
        name = link.path().removesuffix(".md") or self._page
        if name in PAGES:
            texts = (heading.text for heading in headings(page(name)))  # links name the headings of the English page
            found = next((text for text in texts if anchor(text) == link.fragment()), "")
            self._open(name, heading_in(name, found, current_language()))

    def _document(self, name: str) -> QTextDocument:
        """Return a page as Qt lays it out; its formulas are pictures in the text's colour."""
        document, source, ratio = (
            QTextDocument(self.text),
            window_page(name, current_language()),
            self.devicePixelRatioF(),
        )
        scale = self._theme.scale
        document.setDefaultStyleSheet(BODY.format(line=self._theme.line, accent=self._theme.accent))
        font = self.text.font()
        font.setPixelSize(self._theme.px(TEXT_PX))
        document.setDefaultFont(font)
        document.setDocumentMargin(18)
        document.setMarkdown(with_pictures(source))  # which forgets the pictures known before
        for number, formula in enumerate(formulas(source)):
            picture = paint_formula(render_formula(formula, FORMULA_PX * scale * ratio), self._theme.text, ratio, scale)
            document.addResource(QTextDocument.ResourceType.ImageResource, QUrl(f"formula:{number}"), picture)
        for picture_file in pictures(source):
            picture = fit_width(
                QImage(str(FOLDER / "pictures" / picture_file)), round(PICTURE_PX * scale * ratio), ratio
            )
            document.addResource(QTextDocument.ResourceType.ImageResource, QUrl(f"pictures/{picture_file}"), picture)
        lay_out(document)
        rule_tables(document, self._theme)
        return document

    def _scroll_to(self, heading: str) -> None:
        """Put a heading at the top; the page's beginning for none."""
        document, bar, block = self.text.document(), self.text.verticalScrollBar(), self.text.document().begin()
        while block.isValid() and heading:
            if block.blockFormat().headingLevel() and block.text() == heading:
                bar.setValue(int(document.documentLayout().blockBoundingRect(block).top()) - 6)
                return
            block = block.next()
        bar.setValue(0)


def _branch(name: str, title: str) -> QTreeWidgetItem:
    """Return a page with its sections below it, as the contents list them."""
    language = current_language()
    english = language != ENGLISH and not translated(name, language)
    top = QTreeWidgetItem([tr("{page} (in English)", page=title) if english else tr(title)])
    top.setData(0, Qt.ItemDataRole.UserRole, (name, ""))
    parents = {1: top}
    for heading in headings(page(name, current_language())):
        if heading.level > 1:
            item = QTreeWidgetItem(parents.get(heading.level - 1, top), [heading.text])
            item.setData(0, Qt.ItemDataRole.UserRole, (name, heading.text))
            parents[heading.level] = item
    return top


def paint_formula(formula: Formula, colour: str, ratio: float, scale: float = 1.0) -> QImage:
    """Return a formula as a picture in one colour, as deep below the line as letters are, or deeper if it is."""
    rows, columns = formula.opacity.shape
    below = max(0, round(DESCENT * TEXT_PX * scale * ratio - formula.depth))  # so that picture and line end together
    shade = np.zeros((rows + below, columns), np.uint32)
    shade[:rows] = np.round(255 * formula.opacity).astype(np.uint32)
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    packed = (shade << 24) | (shade * red // 255 << 16) | (shade * green // 255 << 8) | (shade * blue // 255)
    picture = QImage(
        packed.tobytes(), columns, rows + below, 4 * columns, QImage.Format.Format_ARGB32_Premultiplied
    ).copy()
    picture.setDevicePixelRatio(ratio)
    return picture


def fit_width(picture: QImage, width: int, ratio: float) -> QImage:
    """Return a picture no wider than so many pixels of the screen."""
    made = picture.scaledToWidth(min(width, picture.width()), Qt.TransformationMode.SmoothTransformation)
    made.setDevicePixelRatio(ratio)
    return made


def fragments(block: QTextBlock) -> list[QTextFragment]:
    """Return the parts of a paragraph that look alike within themselves."""
    place, found = block.begin(), []
    while not place.atEnd():
        found.append(place.fragment())
        place += 1
    return found


def is_code(block: QTextBlock) -> bool:
    """Return whether a paragraph is a line of code between fences."""
    return block.isValid() and block.blockFormat().hasProperty(QTextFormat.Property.BlockCodeFence)


def lay_out(document: QTextDocument) -> None:
    """Give headings, paragraphs and formulas their room; let each formula end where its line of text ends."""
    block = document.begin()
    while block.isValid():
        pieces = fragments(block)
        pictures = [piece for piece in pieces if piece.charFormat().isImageFormat()]
        form, level = block.blockFormat(), block.blockFormat().headingLevel()
        in_table = QTextCursor(block).currentTable() is not None
        in_code, code_goes_on = is_code(block), is_code(block) and is_code(block.next())
        form.setTopMargin({0: 0 if in_table or in_code else 5, 1: 4, 2: 22}.get(level, 14))
        form.setBottomMargin(0 if in_table or code_goes_on else 5)
        form.setNonBreakableLines(in_table and QTextCursor(block).currentTable().columns() >= MANY_COLUMNS)
        if (len(pictures) == len(pieces) == 1 and not in_table) or in_code:
            form.setLeftMargin(32)
        elif not level and not in_table:
            form.setLineHeight(125, QTextBlockFormat.LineHeightTypes.ProportionalHeight.value)
        QTextCursor(block).setBlockFormat(form)
        for piece in pictures:
            cursor = QTextCursor(document)
            cursor.setPosition(piece.position())
            cursor.setPosition(piece.position() + piece.length(), QTextCursor.MoveMode.KeepAnchor)
            placed = piece.charFormat().toImageFormat()
            placed.setVerticalAlignment(QTextCharFormat.VerticalAlignment.AlignBottom)
            cursor.setCharFormat(placed)
        block = block.next()


def rule_tables(document: QTextDocument, theme: Tokens) -> None:
    """Let columns be as wide as what is in them, with thin rules; a table of many columns is set small."""
    for frame in document.rootFrame().childFrames():
        if not isinstance(frame, QTextTable):
            continue
        form = frame.format().toTableFormat()
        form.setColumnWidthConstraints([QTextLength()] * frame.columns())
        form.setWidth(QTextLength())
        form.setBorderCollapse(True)
        form.setBorder(1)
        form.setBorderBrush(QColor(theme.line))
        form.setCellPadding(4)
        form.setTopMargin(6)
        form.setBottomMargin(10)
        frame.setFormat(form)
        if frame.columns() >= MANY_COLUMNS:
            small = QTextCharFormat()
            small.setProperty(QTextFormat.Property.FontPixelSize, theme.px(TABLE_PX))
            cursor = frame.firstCursorPosition()
            cursor.setPosition(frame.lastCursorPosition().position(), QTextCursor.MoveMode.KeepAnchor)
            cursor.mergeCharFormat(small)
