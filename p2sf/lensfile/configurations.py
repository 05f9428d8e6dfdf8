"""Positions in other programs' files: from what such a file states of each configuration to one lens with rings."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf, isfinite

from p2sf.errors import GeometryError
from p2sf.lens.lens import Aperture, Lens
from p2sf.lens.positions import Axis, with_positions
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.conjugates import trace
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawLens
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText
from p2sf.paraxial.pupils import stop_rim

MM_PER_M = 1000.0
SAME_FOCAL = 0.01  # focal lengths nearer to each other than this part are no scale for a ring
MOST_COLUMNS = 100


@dataclass(frozen=True)
class Configuration:
    """One position as its file states it; ``focal_mm`` is the focal length that the file calls it by.

    ``keeps_stop``: its aperture is not stated, and the stop is as wide as in the first focus position of this zoom.
    """

    raw: RawLens
    name: str = ""
    focal_mm: float | None = None
    keeps_stop: bool = False

    @property
    def object_mm(self) -> float:
        """Return the distance of the object, mm."""
        return self.raw.object_distance * self.raw.unit_mm


def assemble_all(stated: Sequence[Configuration], sources: GlassSources, notes: Notebook, source: LensText) -> Lens:
    """Return the lens of a file with these configurations; LensFileError with its line.

    Configurations at one distance of the object differ by their zoom. Where groups of them follow for other distances,
    the lens has a ring of focus as well.
    """
    if len(stated) > MOST_COLUMNS:
        notes.add(
            "caution",
            "the file holds {count} positions; the first {most} are read",
            count=len(stated),
            most=MOST_COLUMNS,
        )
        stated = stated[:MOST_COLUMNS]
    lenses = [_assemble_one(each, number, sources, notes, source) for number, each in enumerate(stated, 1)]
    if len({replace(lens, object_distance=None) for lens in lenses}) == 1:
        if len({lens.object_distance for lens in lenses}) > 1:
            notes.add("caution", "the configurations differ only by the object's distance; that of the first is read")
        return lenses[0]
    zooms, focuses = _rings([each.object_mm for each in stated])
    if zooms * focuses < len(stated):
        notes.add(
            "caution",
            "the file holds {count} positions, of which {read} are so many zooms at every distance; these are read",
            count=len(stated),
            read=zooms * focuses,
        )
    try:
        order, axes = _zoom(stated[:zooms], lenses[:zooms]) if zooms > 1 else ([0], [])
        blocks, near = _focus(stated[: zooms * focuses], zooms) if focuses > 1 else ([0], [])
        lenses = _one_aperture(stated, lenses, zooms)
        columns = [lenses[block * zooms + place] for place in order for block in blocks]
        lens = with_positions([*axes, *near], columns)
    except GeometryError as error:
        raise source.error(error.message, len(source.lines)) from error
    for axis in (*axes, *near):
        notes.add("read", READ[axis.kind], columns=axis.columns)
    return lens


READ = {
    "zoom": "zoom positions {columns}; between them the lens is interpolated",
    "focus": "focus positions {columns}; between them the lens is interpolated",
}


def _assemble_one(stated: Configuration, number: int, sources: GlassSources, notes: Notebook, source: LensText) -> Lens:
    """Return the lens of one configuration; of all but the first only notes that a person has to see are kept."""
    own = notes if number == 1 else Notebook()
    lens = assemble(stated.raw, sources, own, source)
    for note in own.notes if number > 1 else ():
        if note.kind in ("substituted", "caution"):
            notes.add(note.kind, note.message, note.surface, note.line)
    return lens


def _rings(distances: Sequence[float]) -> tuple[int, int]:
    """Return how many zoom and how many focus positions there are: the first distance is that of every zoom."""
    zooms = next((k for k, distance in enumerate(distances) if distance != distances[0]), len(distances))
    return zooms, max(1, len(distances) // zooms)


def _one_aperture(stated: Sequence[Configuration], lenses: Sequence[Lens], zooms: int) -> list[Lens]:
    """Return the lenses with apertures of one kind: as stated, or all as the rim of the stop."""
    if len({lens.aperture.kind for lens in lenses}) == 1 and not any(each.keeps_stop for each in stated):
        return list(lenses)
    rims = [float(stop_rim(lens)) for lens in lenses]
    kept = [rims[k % zooms] if each.keeps_stop else rims[k] for k, each in enumerate(stated)]
    return [replace(lens, aperture=Aperture("stop_semi_diameter", r)) for lens, r in zip(lenses, kept, strict=True)]


def _zoom(stated: Sequence[Configuration], lenses: Sequence[Lens]) -> tuple[list[int], list[Axis]]:
    """Return the order of the columns along the zoom ring, and the ring: by focal length where these differ."""
    focal = [each.focal_mm or _focal_length(lens) for each, lens in zip(stated, lenses, strict=True)]
    order = sorted(range(len(focal)), key=focal.__getitem__)
    steps = [focal[b] - focal[a] for a, b in pairwise(order)]
    if all(map(isfinite, focal)) and min(steps) > SAME_FOCAL * max(map(abs, focal)):
        names = [stated[k].name or f"{focal[k]:.4g} mm" for k in order]
        return order, [Axis("zoom", _different(names), tuple(focal[k] for k in order), "mm")]
    names = [each.name or str(number) for number, each in enumerate(stated, 1)]
    return list(range(len(names))), [Axis("zoom", _different(names), _evenly(len(names)))]


def _focal_length(lens: Lens) -> float:
    power = -trace(lens, 1, lens.reference_wavelength_um).last[2]
    return 1 / power if power else inf


def _focus(stated: Sequence[Configuration], zooms: int) -> tuple[list[int], list[Axis]]:
    """Return the order of the distances along the focus ring, and the ring: by vergence where the zoom has one each."""
    blocks = [stated[start : start + zooms] for start in range(0, len(stated), zooms)]
    distances = [block[0].object_mm if len({each.object_mm for each in block}) == 1 else None for block in blocks]
    known = [MM_PER_M / mm for mm in distances if mm]
    names = [_distance(mm, number) for number, mm in enumerate(distances, 1)]
    if zooms == 1:
        names = [block[0].name or name for block, name in zip(blocks, names, strict=True)]
    if len(set(known)) < len(blocks):
        return list(range(len(blocks))), [Axis("focus", _different(names), _evenly(len(blocks)))]
    order = sorted(range(len(blocks)), key=known.__getitem__)
    return order, [Axis("focus", _different([names[k] for k in order]), tuple(known[k] for k in order), "dpt")]


def _distance(mm: float | None, number: int) -> str:
    if mm is None:
        return str(number)
    return "∞" if not isfinite(mm) else f"{mm / MM_PER_M:.3g} m"


def _evenly(count: int) -> tuple[float, ...]:
    return tuple(number / (count - 1) for number in range(count))


def _different(names: Sequence[str]) -> tuple[str, ...]:
    """Return names of which no two are equal."""
    found: list[str] = []
    for number, name in enumerate(names, 1):
        found.append(f"{name} ({number})" if name in found else name)
    return tuple(found)
