"""Which range an axis or a colour bar shows: automatic in coarse steps, locked, or zoomed by hand. No Qt in here."""

from dataclasses import dataclass, replace
from math import ceil, floor

from p2sf_explorer.state.scales import nice

Span = tuple[float, float]
STEPS = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)  # times a power of ten: the widths of automatic ranges
KEPT = 0.4  # of an automatic range that data fill at least: less than 3/5, so that the steps do not flicker
PARTS = 10  # into which the width of a range is divided for its round ends
DEEPEST, WIDEST = 1e-4, 20.0  # of the range without zoom, that zooming leads to


@dataclass(frozen=True)
class AxisView:
    """One axis: the ``automatic`` range, the one it is ``locked`` to, and the one it was ``moved`` to by hand.

    ``shared`` is the range of two plots side by side, in place of the automatic one.
    """

    automatic: Span = (0.0, 1.0)
    locked: Span | None = None
    moved: Span | None = None
    shared: Span | None = None

    @property
    def home(self) -> Span:
        """Return the range without zoom and pan."""
        return self.locked or self.shared or self.automatic

    @property
    def shown(self) -> Span:
        """Return the range on screen."""
        return self.moved or self.home

    def fitted(self, span: Span, steady: bool = False) -> "AxisView":
        """Return the axis for other data: exactly from end to end, or in ``steady`` coarse steps."""
        automatic = keep_or_grow(self.automatic, span) if steady else span
        return self if automatic == self.automatic else replace(self, automatic=automatic)

    def at_home(self) -> "AxisView":
        """Return the axis without zoom and pan."""
        return replace(self, moved=None)

    def with_lock(self, on: bool) -> "AxisView":
        """Return the axis locked to the range on screen, or automatic again where no hand has moved it."""
        return replace(self, locked=self.shown, moved=None) if on else replace(self, locked=None)

    def moved_to(self, span: Span) -> "AxisView":
        """Return the axis at another range, as far as zooming leads."""
        return replace(self, moved=span) if allowed(span, self.home) else self


def width(span: Span) -> float:
    """Return the length of a range."""
    return span[1] - span[0]


def allowed(span: Span, home: Span) -> bool:
    """Return whether a range is not too narrow and not too wide or far away beside the one without zoom."""
    far = abs(sum(span) - sum(home)) / 2
    return DEEPEST * width(home) <= width(span) <= WIDEST * width(home) and far <= WIDEST * width(home)


def zoom(span: Span, about: float, factor: float) -> Span:
    """Return a range ``factor`` times as wide, in which ``about`` has kept its place on screen."""
    return about + factor * (span[0] - about), about + factor * (span[1] - about)


def pan(span: Span, by: float) -> Span:
    """Return a range moved by some of its own units."""
    return span[0] + by, span[1] + by


def kind(span: Span) -> str:
    """Return which end follows from the other: "even" about zero, "up" or "down" from zero, else ""."""
    if span[0] == -span[1]:
        return "even"
    return "up" if span[0] == 0 else "down" if span[1] == 0 else ""


def keep_or_grow(kept: Span, wanted: Span) -> Span:
    """Return the automatic range for data from end to end: ``kept`` while they fit and fill it, else a round one.

    A drag thus changes the range rarely, and by a factor that is seen, with hysteresis.
    """
    fits = kept[0] <= wanted[0] and wanted[1] <= kept[1] and width(wanted) >= KEPT * width(kept)
    return kept if fits and kind(wanted) in ("", kind(kept)) else round_span(wanted)


def round_span(wanted: Span) -> Span:
    """Return a range of one of `STEPS`·10ᵏ, round ends and the symmetry of the data's.

    Where both ends are free, it is wider by a tenth if round ends ask for that.
    """
    if of := kind(wanted):
        end = nice(max(abs(wanted[0]), abs(wanted[1]), 1e-300), STEPS)
        return (-end if of != "up" else 0.0), (end if of != "down" else 0.0)
    middle, half = sum(wanted) / 2, max(width(wanted), 1e-12 * abs(wanted[0])) / 2
    whole = nice(2 * half, STEPS)
    step = whole / PARTS
    low = step * min(round((middle - whole / 2) / step), floor((middle - half) / step))
    return low, max(low + whole, step * ceil((middle + half) / step))
