"""How a wide and low panel shows a picture: as high as it can be, beside it enlarged details and the PSF."""

from dataclasses import dataclass

from PySide6.QtCore import QRectF

GAP = 8.0
LOUPE_SHARE, LOUPE_MOST = 0.42, 150.0  # of the picture's height, and pixels at most, where the PSF lies on it
PAD = 6.0
CLOSE_ROWS = 64  # of the picture in an enlarged detail
SLIMMEST = 0.7  # of its height: what an enlarged detail is wide at least


@dataclass(frozen=True)
class Rooms:
    """Where the picture lies, the PSF, and the enlarged details before and after the lens, if there is room."""

    picture: QRectF
    loupe: QRectF
    details: tuple[QRectF, ...]


def rooms(width: float, height: float, rows: int, columns: int) -> Rooms:
    """Return the rooms of a panel of this size: beside the picture a square for the PSF, details in what is left."""
    scale = min(width / columns, height / rows)
    picture = QRectF(0, (height - scale * rows) / 2, scale * columns, scale * rows)
    side = picture.height()
    left = width - picture.width() - side - GAP
    if left < 0:
        return Rooms(picture, overlaid(picture), ())
    count = min(2, int(left // (SLIMMEST * side + GAP)))
    wide = min(left / max(count, 1) - GAP, side * columns / CLOSE_ROWS)
    places = (picture.right() + GAP + k * (wide + GAP) for k in range(count))
    details = tuple(QRectF(place, picture.top(), wide, side) for place in places)
    return Rooms(picture, QRectF((details or (picture,))[-1].right() + GAP, picture.top(), side, side), details)


def overlaid(picture: QRectF) -> QRectF:
    """Return where the PSF lies on a picture that leaves no room beside it: at its top right."""
    side = min(LOUPE_MOST, LOUPE_SHARE * picture.height())
    return QRectF(picture.right() - side - PAD, picture.top() + PAD, side, side)


def close_up(place: tuple[float, float], shape: tuple[int, int], room: QRectF) -> QRectF:
    """Return the part of a picture, in its pixels, that a room about (row, column) shows: never beyond its rim."""
    tall = min(CLOSE_ROWS, shape[0])
    wide = min(tall * room.width() / room.height(), shape[1])
    top = min(max(place[0] + 0.5 - tall / 2, 0.0), shape[0] - tall)
    left = min(max(place[1] + 0.5 - wide / 2, 0.0), shape[1] - wide)
    return QRectF(left, top, wide, tall)
