"""The complete trade of the shipped lenses: what every representation of PSFs costs and misses, as data and files.

Each lens was taken over its depths, fields and wavelengths, in one window of 64² pixels, and judged at points at random
that no representation was made with, against exact rays; a few of them by Huygens sums too. The figures are measured
once and kept with the program.
"""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from functools import lru_cache
from os import PathLike
from pathlib import Path
from typing import Any

from p2sf.errors import RequestError
from p2sf.files.reading import parse_json, read_text
from p2sf.files.reasons import reason
from p2sf.files.writing import write_beside

SHIPPED = Path(__file__).with_name("complete_trade.json")
DIGITS = 3  # of measured numbers: times and errors are not known better
SPREADS = ("one_less_r2", "relative_l2", "mtf", "r80")


@dataclass(frozen=True)
class Spread:
    """How an error is spread over the points: what half, and what 95 % of them keep, and the largest."""

    median: float
    most: float
    worst: float


@dataclass(frozen=True)
class Row:
    """One representation of one space: what it costs, and its errors over ``points`` unseen ones.

    ``batch_us``, ``single_us``: CPU time of a PSF among all and alone. ``one_less_r2``: 1 − R²; ``relative_l2``;
    ``mtf``: largest difference of contrast along either axis, from the window's own OTF; ``r80``: of the radius that
    holds 80 % of the window's light about its centroid, relative. ``worst_at``: depth (mm), field (°) and wavelength
    (nm) of the largest relative L2 error.
    """

    family: str
    settings: str
    numbers: int
    nbytes: int
    build_seconds: float
    batch_us: float
    single_us: float
    one_less_r2: Spread
    relative_l2: Spread
    mtf: Spread
    r80: Spread
    worst_at: tuple[float, float, float]
    points: int


@dataclass(frozen=True)
class SpaceWords:
    """A `LensSpace` in a user's units: mm, degrees, nm, µm."""

    f_number: float | None
    near_mm: float
    far_mm: float
    fields_deg: tuple[float, float]
    wavelengths_nm: tuple[float, float]
    pixels: int
    pixel_um: float
    samples_per_pixel: int


@dataclass(frozen=True)
class LensTrade:
    """All representations of one lens.

    ``truth_error``: largest 1 − R² between exact rays in rows and the Huygens sum at the probed points. ``singles``: by
    field in degrees, rows of one PSF taken alone. ``refused``: families that this space refuses, with the reason.
    """

    lens: str
    title: str
    space: SpaceWords
    truth_error: float
    rows: tuple[Row, ...]
    singles: tuple[tuple[float, tuple[Row, ...]], ...]
    refused: tuple[tuple[str, str], ...]
    seconds: float


ROW = tuple(field.name for field in fields(Row))


def record(trades: Iterable[LensTrade]) -> dict[str, Any]:
    """Return trades as one JSON object.

    Rows are lists in the order of ``columns``. Their settings are places in ``settings``; an error is (median, 95 %,
    worst), or one number where these are the same.
    """
    settings: dict[str, int] = {}
    lenses = [_lens(trade, settings) for trade in trades]
    return {"columns": ROW, "errors": ("median", "95 %", "worst"), "settings": list(settings), "lenses": lenses}


def _lens(trade: LensTrade, settings: dict[str, int]) -> dict[str, Any]:
    plain = asdict(trade)
    plain["rows"] = [_row(row, settings) for row in trade.rows]
    plain["singles"] = [[_short(field), [_row(row, settings) for row in rows]] for field, rows in trade.singles]
    plain["truth_error"], plain["seconds"] = _short(trade.truth_error), _short(trade.seconds)
    return plain


def _row(row: Row, settings: dict[str, int]) -> list[Any]:
    place = settings.setdefault(row.settings, len(settings))
    return [place if name == "settings" else _cell(getattr(row, name)) for name in ROW]


def _cell(value: Any) -> Any:
    if isinstance(value, Spread):
        three = [_short(x) for x in (value.median, value.most, value.worst)]
        return three if len(set(three)) > 1 else three[0]
    if isinstance(value, tuple):
        return [_short(x) for x in value]
    return _short(value) if isinstance(value, float) else value


def _short(value: float) -> float | int:
    rounded = float(f"{value:.{DIGITS}g}")
    return int(rounded) if rounded.is_integer() else rounded


def trades_of(found: dict[str, Any]) -> list[LensTrade]:
    """Return the trades that `record` has put into JSON."""
    return [_trade(lens, found["columns"], found["settings"]) for lens in found["lenses"]]


def _trade(lens: dict[str, Any], columns: list[str], settings: list[str]) -> LensTrade:
    space: dict[str, Any] = {
        name: tuple(value) if isinstance(value, list) else value for name, value in lens["space"].items()
    }
    return LensTrade(
        **{
            **lens,
            "space": SpaceWords(**space),
            "rows": tuple(_read_row(row, columns, settings) for row in lens["rows"]),
            "singles": tuple(
                (field, tuple(_read_row(row, columns, settings) for row in rows)) for field, rows in lens["singles"]
            ),
            "refused": tuple((name, why) for name, why in lens["refused"]),
        }
    )


def _read_row(row: list[Any], columns: list[str], settings: list[str]) -> Row:
    cells = dict(zip(columns, row, strict=True))
    spreads = {name: _spread(cells[name]) for name in SPREADS}
    words = settings[cells["settings"]]
    return Row(**{**cells, **spreads, "settings": words, "worst_at": tuple(cells["worst_at"])})


def _spread(cell: Any) -> Spread:
    return Spread(*(cell if isinstance(cell, list) else (cell, cell, cell)))


def save_trades(path: str | PathLike[str], trades: Iterable[LensTrade]) -> Path:
    """Write trades as JSON, a lens's rows one a line, whole or not at all. Raises ExportError."""
    return write_beside(path, lambda handle: handle.write(text_of(trades).encode()))


def text_of(trades: Iterable[LensTrade]) -> str:
    """Return trades as compact JSON, one row a line, so that two versions can be compared."""
    text = json.dumps(record(trades), separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return text.replace('],["', '],\n["').replace('},{"lens"', '},\n{"lens"') + "\n"


def load_trades(path: str | PathLike[str]) -> list[LensTrade]:
    """Return the trades of a file that `save_trades` wrote; RequestError for any other."""
    try:
        return trades_of(parse_json(read_text(path)))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RequestError(
            "{path} holds no complete trade ({reason}); write one with p2sf tradeoff --complete -o",
            path=str(path),
            reason=reason(error),
        ) from error


@lru_cache(maxsize=1)
def shipped_trades() -> dict[str, LensTrade]:
    """Return the trades of the shipped lenses by name, measured once and kept with the program."""
    return {trade.lens: trade for trade in load_trades(SHIPPED)}
