"""Colours and shapes of the window, light and dark, as named tokens."""

import re
from dataclasses import dataclass, replace
from functools import lru_cache

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QGuiApplication, QPalette

# Colour maps of brightness, readable with every kind of colour blindness (tests/explorer/charts/test_theme.py).
BRIGHTNESS = {"standard": "inferno", "viridis": "viridis", "cividis": "cividis", "grey": "CET-L1"}
DONE = "#66"  # opacity of a progress bar's done part, AARRGGBB: its text must be readable on either part
SPACE = 8  # pixels; every gap of the window is this, or half or twice this
USUAL_SCREEN = 1920, 1080  # logical pixels of a screen at which type and strokes have their plain size
SCALES = 0.5, 3.0  # the smallest and the largest type
SMALL_PX = 11  # type of ticks and labels, the smallest there is
TICK_PX, LABEL_PX = 12, 13  # type in plots: of ticks, of names and readings
PIXELS = re.compile(r"(\d+)px")


@dataclass(frozen=True)
class Tokens:
    """The look of one theme; the data colours are Okabe and Ito's (2008), which colour-blind people tell apart.

    ``scale`` is the size of type, strokes and paddings, 1.0 for the plain one.
    """

    dark: bool
    window: str
    card: str
    raised: str
    line: str
    text: str
    muted: str
    faint: str
    accent: str
    accent_text: str
    emphasis: str  # of words that a hall reads
    warning: str
    warning_back: str
    glass: str
    glass_edge: str
    marginal: str
    chief: str
    positive: str
    negative: str
    third: str
    mark: str
    brightness: str = BRIGHTNESS["standard"]
    scale: float = 1.0

    def px(self, plain: float) -> int:
        """Return a length in whole pixels at this scale, at least one; ``plain`` is that at scale 1."""
        return max(1, round(plain * self.scale))

    @property
    def small(self) -> int:
        """Return the size in pixels of the type of ticks and labels."""
        return self.px(SMALL_PX)

    @property
    def tick(self) -> int:
        """Return the size in pixels of the type of a plot's ticks."""
        return self.px(TICK_PX)

    @property
    def label(self) -> int:
        """Return the size in pixels of the type of names and readings in plots."""
        return self.px(LABEL_PX)


LIGHT = Tokens(
    dark=False,
    window="#eef0f3",
    card="#ffffff",
    raised="#f6f7f9",
    line="#d5d9e0",
    text="#1b2430",
    muted="#5a6675",
    faint="#e4e8ed",
    accent="#0b63b5",
    accent_text="#ffffff",
    emphasis="#084a8a",
    warning="#7a4b00",
    warning_back="#fdf1d8",
    glass="#8fb8dc",
    glass_edge="#4d7ba6",
    marginal="#0072b2",
    chief="#d55e00",
    positive="#0072b2",
    negative="#d55e00",
    third="#009e73",
    mark="#5a6675",
)
DARK = Tokens(
    dark=True,
    window="#14181e",
    card="#1c222a",
    raised="#262d37",
    line="#343d49",
    text="#e6ebf1",
    muted="#9aa7b6",
    faint="#2a323d",
    accent="#5aa9f0",
    accent_text="#0c1218",
    emphasis="#5aa9f0",
    warning="#f5cf86",
    warning_back="#3a2f18",
    glass="#5f8fbd",
    glass_edge="#8fb8dc",
    marginal="#56b4e9",
    chief="#f0883e",
    positive="#56b4e9",
    negative="#f0883e",
    third="#f0e442",
    mark="#9aa7b6",
)


def tokens(choice: str, colours: str = "standard", scale: float = 1.0) -> Tokens:
    """Return the tokens of "light", "dark" or "system", with a colour map of `BRIGHTNESS` for the heat maps."""
    return _complete(_theme(choice), colours, scale)


@lru_cache(maxsize=8)
def _complete(theme: Tokens, colours: str, scale: float) -> Tokens:
    return replace(theme, brightness=BRIGHTNESS[colours], scale=scale)


def screen_scale(screen: QSize) -> float:
    """Return the scale of type for a screen of this many logical pixels: 1 up to `USUAL_SCREEN`, 2 on twice that."""
    wide, tall = USUAL_SCREEN
    return min(SCALES[1], max(1.0, min(screen.width() / wide, screen.height() / tall)))


def _theme(choice: str) -> Tokens:
    if choice == "system":
        return LIGHT if system_scheme() == Qt.ColorScheme.Light else DARK  # also where the system does not say
    return DARK if choice == "dark" else LIGHT


def system_scheme() -> Qt.ColorScheme:
    """Return whether the system is light or dark at present."""
    return QGuiApplication.styleHints().colorScheme()


def palette(theme: Tokens) -> QPalette:
    """Return the palette for Qt's own widgets."""
    roles = QPalette.ColorRole
    colours = {
        roles.Window: theme.window,
        roles.WindowText: theme.text,
        roles.Base: theme.card,
        roles.AlternateBase: theme.raised,
        roles.Text: theme.text,
        roles.Button: theme.raised,
        roles.ButtonText: theme.text,
        roles.Link: theme.accent,
        roles.Highlight: theme.accent,
        roles.HighlightedText: theme.accent_text,
        roles.ToolTipBase: theme.raised,
        roles.ToolTipText: theme.text,
        roles.PlaceholderText: theme.muted,
        roles.Mid: theme.line,
    }
    found = QPalette()
    for role, colour in colours.items():
        found.setColor(role, QColor(colour))
    for role in (roles.WindowText, roles.Text, roles.ButtonText):
        found.setColor(QPalette.ColorGroup.Disabled, role, QColor(theme.muted))
    return found


def stylesheet(theme: Tokens) -> str:
    """Return the style sheet of the window; every length in it is written at scale 1."""
    plain = _frames(theme) + _inputs(theme) + _tools(theme) + _lists(theme)
    if QGuiApplication.isRightToLeft():  # Qt mirrors layouts, and leaves these as they are written
        plain = plain.replace("padding-right", "padding-left").replace("text-align: left", "text-align: right")
    return PIXELS.sub(lambda length: f"{theme.px(int(length[1])) if int(length[1]) else 0}px", plain)


def _frames(t: Tokens) -> str:
    """Return the look of cards, labels and the banner."""
    return f"""
    QWidget {{ color: {t.text}; font-size: 13px; }}
    QMainWindow, QWidget#window {{ background: {t.window}; }}
    QFrame#card, QWidget#controls, QFrame#bar {{
        background: {t.card}; border: 1px solid {t.line}; border-radius: 6px; }}
    Place[target="true"] {{ border: 2px solid {t.accent}; border-radius: 7px; }}
    QLabel {{ background: transparent; border: none; }}
    QLabel#title {{ font-weight: 600; }}
    QLabel#muted, QLabel#readout {{ color: {t.muted}; font-size: 12px; }}
    QLabel#fact {{ font-size: 12px; }}
    QLabel#task {{ background: {t.faint}; border-radius: 5px; padding: 7px 9px; }}
    QWidget#page {{ background: transparent; }}
    QWidget[pointed="true"] QLabel {{ color: {t.accent}; font-weight: 600; }}
    QLabel#sentence {{ font-size: 13px; font-weight: 600; }}
    QLabel#badge {{ background: {t.faint}; color: {t.text}; border-radius: 4px; padding: 2px 7px; font-size: 12px; }}
    QLabel#badge[stale="true"] {{ color: {t.muted}; }}
    QLabel#warning {{ color: {t.warning}; font-size: 12px; }}
    QFrame#banner {{ background: {t.warning_back}; border: 1px solid {t.warning}; border-radius: 6px; }}
    QFrame#banner QLabel {{ color: {t.warning}; }}
    QCheckBox {{ border: 1px solid transparent; border-radius: 4px; padding: 1px 3px; }}
    QCheckBox::indicator {{ width: 12px; height: 12px; background: {t.raised};
        border: 1px solid {t.muted}; border-radius: 3px; }}
    QCheckBox::indicator:checked {{ background: {t.accent}; border: 1px solid {t.accent}; }}
    QCheckBox:focus {{ border: 1px solid {t.accent}; }}
    QScrollBar:vertical {{ background: transparent; width: 10px; }}
    QScrollBar:horizontal {{ background: transparent; height: 10px; }}
    QScrollBar::handle {{ background: {t.line}; border-radius: 4px; }}
    QScrollBar::handle:vertical {{ min-height: 24px; }}
    QScrollBar::handle:horizontal {{ min-width: 24px; }}
    QScrollBar::add-line, QScrollBar::sub-line {{ width: 0; height: 0; }}
    QScrollBar::add-page, QScrollBar::sub-page {{ background: transparent; }}
    SetDialog {{ min-width: 560px; max-width: 560px; }}
    QLabel#reasons {{ font-size: 12px; padding: 10px; min-width: 460px; max-width: 460px; }}
    """


def _inputs(t: Tokens) -> str:
    """Return the look of plain buttons, choosers and text fields."""
    return f"""
    QLineEdit, QComboBox, QPushButton, QToolButton, QDoubleSpinBox {{
        background: {t.raised}; border: 1px solid {t.line}; border-radius: 5px; padding: 3px 8px; min-height: 20px; }}
    QComboBox#small {{ padding: 1px 6px; font-size: 12px; min-height: 18px; }}
    QDoubleSpinBox {{ padding: 1px 0; font-size: 12px; min-height: 18px; }}
    QDoubleSpinBox QLineEdit {{ background: transparent; border: none; padding: 0 6px; font-size: 12px;
        min-height: 0; }}
    QDoubleSpinBox::up-button, QDoubleSpinBox::down-button {{ border: none; width: 0; }}
    QLineEdit#cell {{ padding: 1px 6px; min-height: 18px; }}
    QLineEdit#value {{ padding: 1px 6px; min-height: 18px; min-width: 82px; max-width: 82px; }}
    QLineEdit#value[short="true"] {{ min-width: 66px; max-width: 66px; }}
    QLineEdit#value[wide="true"] {{ min-width: 120px; max-width: 120px; }}
    QLineEdit#value[list="true"] {{ min-width: 60px; max-width: 1000px; }}
    QLineEdit:focus, QComboBox:focus, QPushButton:focus, QToolButton:focus, QDoubleSpinBox:focus {{
        border: 1px solid {t.accent}; }}
    QPushButton:hover, QToolButton:hover, QComboBox:hover {{ border: 1px solid {t.muted}; }}
    QPushButton:disabled, QToolButton:disabled {{ color: {t.muted}; background: {t.card}; }}
    QPushButton#small, QToolButton#small {{ padding: 1px 7px; font-size: 12px; min-height: 18px; }}
    QToolButton#small[tight="true"] {{ padding: 1px 2px; }}
    QToolButton#small[turns="true"] {{ min-width: 28px; max-width: 28px; }}
    """


def _tools(t: Tokens) -> str:
    """Return the look of buttons that are not plain, of progress bars, and of choosers' arrows and lists."""
    return f"""
    QPushButton#lens {{ text-align: left; padding-right: 22px; }}
    QPushButton#segment {{ padding: 3px 9px; color: {t.muted}; background: transparent;
        border: 1px solid transparent; }}
    QPushButton#segment:checked {{ background: {t.faint}; color: {t.text}; border: 1px solid {t.line}; }}
    QPushButton#segment:hover, QPushButton#segment:focus {{ border: 1px solid {t.accent}; }}
    QToolButton#menu {{ padding: 1px 22px 1px 8px; font-size: 12px; min-height: 18px; }}
    QToolButton#menu[bare="true"] {{ padding: 1px 12px; background: transparent; border: 1px solid transparent; }}
    QToolButton#menu:hover, QToolButton#menu:focus {{ border: 1px solid {t.accent}; }}
    QPushButton#group {{ padding: 1px 9px; font-size: 12px; min-height: 17px; background: transparent;
        border: 1px solid transparent; color: {t.muted}; }}
    QPushButton#group:checked {{ background: {t.faint}; color: {t.text}; border: 1px solid {t.line}; }}
    QPushButton#group:hover, QPushButton#group:focus {{ border: 1px solid {t.accent}; }}
    QToolButton:checked {{ background: {t.faint}; border: 1px solid {t.muted}; }}
    QToolButton#small:checked {{ background: {t.accent}; color: {t.accent_text}; border: 1px solid {t.accent}; }}
    QToolButton#play {{ background: transparent; border: 1px solid transparent; padding: 0; font-size: 11px;
        color: {t.muted}; min-width: 17px; min-height: 17px; }}
    QToolButton#play:hover, QToolButton#play:focus {{ border: 1px solid {t.accent}; color: {t.text}; }}
    QToolButton#heading {{ background: transparent; border: 1px solid transparent; padding: 0 2px 0 0; }}
    QToolButton#heading:hover, QToolButton#heading:focus {{ border: 1px solid {t.accent}; }}
    QToolButton#flat {{ background: transparent; border: 1px solid transparent; padding: 0; min-height: 18px;
        font-size: 11px; color: {t.muted}; }}
    QToolButton#flat:hover, QToolButton#flat:focus {{ border: 1px solid {t.accent}; color: {t.text}; }}
    QProgressBar {{ background: {t.faint}; border: none; border-radius: 4px; max-height: 14px; text-align: center;
        font-size: 11px; color: {t.text}; }}
    QProgressBar::chunk {{ background: {DONE + t.accent[1:]}; border-radius: 4px; }}
    QToolButton::menu-indicator {{ image: none; width: 0; }}
    QComboBox {{ padding-right: 20px; }}
    QComboBox#small {{ padding-right: 18px; }}
    QComboBox::drop-down {{ border: none; width: 0; }}
    QComboBox::down-arrow {{ image: none; }}
    QComboBox QAbstractItemView {{ background: {t.card}; border: 1px solid {t.line};
        selection-background-color: {t.accent}; selection-color: {t.accent_text}; outline: none; }}
    """


def _lists(t: Tokens) -> str:
    """Return the look of menus, tabs and tooltips."""
    return f"""
    QMenu {{ background: {t.card}; border: 1px solid {t.line}; padding: 4px; }}
    QMenu::item {{ padding: 4px 20px 4px 12px; border-radius: 4px; }}
    QMenu::item:selected {{ background: {t.accent}; color: {t.accent_text}; }}
    QTabWidget::pane {{ border: none; }}
    QTabWidget::tab-bar {{ left: 4px; }}
    QTabBar {{ background: transparent; qproperty-drawBase: 0; }}
    QTabBar QToolButton {{ padding: 0; min-height: 0; border-radius: 3px; }}
    QTabBar::scroller {{ width: 36px; }}
    QTabBar::tear {{ width: 0; }}
    QTabBar::tab {{ padding: 4px 11px; color: {t.muted}; border: none; border-bottom: 2px solid transparent; }}
    QTabBar::tab:selected {{ color: {t.text}; border-bottom: 2px solid {t.accent}; }}
    QTabBar::tab:focus {{ color: {t.accent}; }}
    QToolTip {{ background: {t.raised}; color: {t.text}; border: 1px solid {t.line}; padding: 4px; }}
    QSplitter::handle {{ background: transparent; }}
    """
