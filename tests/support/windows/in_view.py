"""What a window shows at once: controls that take a click, and words, units and numbers left out.

``python -m tests.support.windows.in_view [--size 1280x800] [--language de]`` counts both after the first touch.
"""

import argparse
import re
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from html import unescape

from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QAbstractButton, QAbstractSlider, QApplication, QComboBox, QLabel, QLineEdit, QTabBar

from p2sf_explorer.panels.coefficients.mixer import LETTERS, Mixer
from p2sf_explorer.state.terms import TERMS

CLICKED = QAbstractButton, QComboBox, QLineEdit, QAbstractSlider
UNITS = {"mm", "μm", "nm", "ms"}  # in NFKC, which has one µ
WORD = re.compile(r"[^\W\d_][\w′'’-]*")
TWO_LETTERS = 2


def is_seen(widget) -> bool:
    """Return whether any of a widget is painted; without quiet tools, as of an earlier version, whether it is shown."""
    try:
        from p2sf_explorer.widgets.quiet import is_seen as seen
    except ImportError:
        return widget.isVisible() and not widget.visibleRegion().isEmpty()
    return seen(widget)


def controls(window) -> list[str]:
    """Return what takes a click or the keyboard and is seen, by name; plots, which are looked at, and what is painted.

    A slider and its number are one, each tab is one, and what is disabled is none. The rows of the mixer have a slider,
    mute and solo each where these are painted.
    """
    found = []
    for kind in CLICKED:
        for each in window.findChildren(kind):
            inner = isinstance(each.parentWidget(), QComboBox | QLineEdit)
            if is_seen(each) and each.isEnabled() and not inner and not _with_slider(each):
                found.append(f"{type(each).__name__} {each.accessibleName() or getattr(each, 'text', str)()}")
    for bar in window.findChildren(QTabBar):
        found += [f"tab {bar.tabText(k)}" for k in _tabs(bar)]
    for mixer in filter(is_seen, window.findChildren(Mixer)):
        if getattr(mixer, "tools_shown", True):
            found += [f"{term} {what}" for term in TERMS for what in ("slider", *(kind for kind, *_ in LETTERS))]
    return found


def _tabs(bar: QTabBar) -> list[int]:
    """Return the tabs of a bar of which any is seen."""
    return [
        k for k in range(bar.count()) if is_seen(bar) and bar.isTabVisible(k) and bar.tabRect(k).intersects(bar.rect())
    ]


def _with_slider(widget) -> bool:
    """Return whether a number stands in the row of a slider, which is counted."""
    return isinstance(widget, QLineEdit) and getattr(widget.parentWidget(), "slider", None) is not None


def words(window) -> list[str]:
    """Return the words that a window shows, painted ones too."""
    texts = [part.text() for kind in (QLabel, QAbstractButton) for part in window.findChildren(kind) if is_seen(part)]
    texts += [box.currentText() for box in window.findChildren(QComboBox) if is_seen(box)]
    texts += [bar.tabText(k) for bar in window.findChildren(QTabBar) for k in _tabs(bar)]
    with _painted() as painted:
        window.store.changed.emit(window.store.state)
        theme = window._theme
        for panel in window.panels.values():
            panel.restyle(theme)  # so that nothing comes from a picture kept
        window.controls.restyle(theme)
        window.grab()
    texts += painted
    plain = [unicodedata.normalize("NFKC", unescape(re.sub(r"<[^>]*>", " ", text))) for text in texts]
    found = [word for text in plain for word in WORD.findall(text)]
    return [word for word in found if len(word) >= TWO_LETTERS and word.casefold() not in UNITS]


@contextmanager
def _painted() -> Iterator[list[str]]:
    """Collect the texts that Python code paints within the block."""
    texts: list[str] = []
    plain, static = QPainter.drawText, QPainter.drawStaticText

    def draw_text(painter, *arguments):
        texts.extend(each for each in arguments if isinstance(each, str))
        return plain(painter, *arguments)

    def draw_static(painter, *arguments):
        texts.append(arguments[-1].text())
        return static(painter, *arguments)

    QPainter.drawText, QPainter.drawStaticText = draw_text, draw_static
    try:
        yield texts
    finally:
        QPainter.drawText, QPainter.drawStaticText = plain, static


def main() -> None:
    """Count from the command line."""
    from p2sf_explorer.compute.setup import first_state
    from p2sf_explorer.i18n.language import set_language
    from p2sf_explorer.state.state import change
    from p2sf_explorer.window.window import MainWindow

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", default="1280x800")
    parser.add_argument("--language", default="en")
    options = parser.parse_args()
    application = QApplication([])
    application.setStyle("Fusion")
    set_language(options.language)
    window = MainWindow(change(first_state(), field_deg=13.0, language=options.language), measured=False)
    window.resize(*map(int, options.size.split("x")))
    window.show()
    window.store.update(field_deg=14.0)  # the first touch: there is something to undo
    while window.is_busy():
        application.processEvents()
    application.processEvents()
    for name, found in (("controls", controls(window)), ("words", words(window))):
        print(f"{len(found)} {name}: {', '.join(found)}")
    window.close()


if __name__ == "__main__":
    main()
