"""A known target: where its points are, and which of them each point of a picture is (handbook 11.3).

A target is seen turned, mirrored, moved and scaled: z = a·w + b, or −a·w̄ + b if mirrored, of complex places w of the
target. Two points with their neighbours give a and b; those are taken that put most points of the picture near one of
the target, and made better by all points that they match (random sample consensus, Fischler and Bolles 1981, with
every pair tried in place of random ones).
"""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, degrees
from typing import TYPE_CHECKING

import numpy as np

from p2sf.disc.mask import CLEAR
from p2sf.errors import RequestError
from p2sf.files.reading import read_text
from p2sf.lens.lens import Lens, with_mask
from p2sf.messages import Message
from p2sf.paraxial.pupils import field_from_object_height
from p2sf.pixel_kernels.sensor_points import chief_heights
from p2sf.raytrace.aiming import Sources

if TYPE_CHECKING:
    from scipy.spatial import KDTree

COLUMNS: dict[tuple[str, ...], str] = {("number", "x_mm", "y_mm"): "mm", ("number", "x_deg", "y_deg"): "deg"}
FEWEST = 3  # points of a target
SHARE = 0.6  # of the points found that must lie on the target
CERTAIN = 5  # points that chance hardly puts on it
NEAR = 0.25  # of the distance between neighbours, within which a point is that of the target
ANCHORS, NEIGHBOURS, TARGET_NEIGHBOURS = 4, 4, 8  # points of the picture whose pairs with so many neighbours are tried
SCALE = 1.3  # by which a scale that is known may be off
TRIED = 40  # points of the picture, around the anchors, by which placings are judged first
TOGETHER = 4096  # placings judged at a time
REFINED = 96  # of the best that differ
STEPS = 12
ROUNDING = 1e-9
CURVED = 8  # points from which a distortion is fitted too


@dataclass(frozen=True, eq=False)
class Target:
    """Points of a target: ``numbers`` (points,), and ``places`` (points, 2), x to the right and y up, from the axis.

    ``unit``: "mm" on the target, which is square to the axis, or "deg", angles of x and y at the entrance pupil.
    ``name``: of its file.
    """

    numbers: np.ndarray
    places: np.ndarray
    unit: str
    name: str = ""


@dataclass(frozen=True, eq=False)
class TargetMatch:
    """How a target lies in a picture.

    Attributes
    ----------
    which : numpy.ndarray
        The place in the target of every point of the picture, −1 for none, (points,).
    numbers : numpy.ndarray
        Those of the target's points.
    places_mm : numpy.ndarray
        Where the target's points belong, x and y in mm from ``axis_mm``, (points of the target, 2): turned and
        mirrored as they are seen, by the lens as designed if one is known, else without distortion.
    axis_mm : tuple of float
        Where the target's origin is seen, x and y in mm from the picture's axis as it was.
    scale : float
        Size of the picture over that expected, in the middle.
    rotation_deg : float
        By which the target is turned, from +x towards +y.
    mirrored : bool
        Whether x has the other sign, before it is turned.
    distortion : float
        k of r(1 + kr²), r over the farthest point's: what distortion there is beyond that expected.
    rms_mm : float
        Of the distances that remain.
    alike : int
        How many ways there are to lay the target on the picture that match as many points.
    """

    which: np.ndarray
    numbers: np.ndarray
    places_mm: np.ndarray
    axis_mm: tuple[float, float]
    scale: float
    rotation_deg: float
    mirrored: bool
    distortion: float
    rms_mm: float
    alike: int = 1

    @property
    def count(self) -> int:
        """Return how many points of the target were found."""
        return int((self.which >= 0).sum())

    @property
    def warnings(self) -> tuple[Message, ...]:
        """Return what a reader has to know before using it."""
        if self.alike == 1:
            return ()
        return (
            Message(
                "the target fits the picture in {count} ways, and is taken to be upright and in the middle; give it a "
                "point that no symmetry repeats",
                count=self.alike,
            ),
        )


def read_target(path: str | os.PathLike[str]) -> Target:
    """Return the target in a text file.

    One line for each point: number, x and y, separated by commas, semicolons or blanks; the first line names the
    columns, ``number x_mm y_mm`` or ``number x_deg y_deg``. Lines that begin with # are left out. Raises RequestError.
    """
    try:
        text = read_text(path)
    except (OSError, UnicodeDecodeError) as error:
        raise RequestError("{path} cannot be read as text; check the name", path=str(path)) from error
    unit, rows = "", dict[int, tuple[float, float]]()
    owners = dict[tuple[float, float], int]()  # of places
    for line, words in enumerate((re.split(r"[\s,;]+", row.strip(" \t,;")) for row in text.splitlines()), 1):
        if words == [""] or words[0].startswith("#"):
            continue
        if not unit:
            unit = COLUMNS.get(tuple(word.lower() for word in words), "")
            if not unit:
                raise RequestError(
                    "{path}, line {line}: name the columns first, number x_mm y_mm or number x_deg y_deg",
                    path=str(path),
                    line=line,
                )
            continue
        number, place = _row(words, str(path), line, unit)
        if number in rows or place in owners:
            raise RequestError(
                "{path}, line {line}: {words} is number {other} once more; give each point one number and place",
                path=str(path),
                line=line,
                words=" ".join(words),
                other=number if number in rows else owners[place],
            )
        rows[number], owners[place] = place, number
    if len(rows) < FEWEST:
        raise RequestError(
            "{path} holds {count} points of a target; at least {least} are needed",
            path=str(path),
            count=len(rows),
            least=FEWEST,
        )
    return Target(np.array([*rows]), np.array([*rows.values()], float), unit, str(path))


def _row(words: Sequence[str], path: str, line: int, unit: str) -> tuple[int, tuple[float, float]]:
    """Return the number of a line and its x and y. Raises RequestError."""
    try:
        number, x, y = words
        place = float(x), float(y)
        if np.isfinite(place).all() and (unit == "mm" or max(map(abs, place)) < 90):
            return int(number), place
    except ValueError:
        pass
    raise RequestError(
        '{path}, line {line}: "{text}" is not a point of a target; give a whole number, x and y',
        path=path,
        line=line,
        text=" ".join(words)[:60],
    )


def expected_places(target: Target, lens: Lens | None, depth_mm: float, wavelength_um: float) -> np.ndarray:
    """Return where the target's points would land upright, (points, 2), mm by a lens as designed; else in its own unit.

    Angles become their tangents. Raises RequestError for mm on a target at infinity, and what chief rays raise.
    """
    places = np.tan(np.deg2rad(target.places)) if target.unit == "deg" else target.places
    if lens is None:
        return places
    if target.unit == "mm" and np.isinf(depth_mm):
        raise RequestError(
            "the target's points are in mm, and it is infinitely far away; give {parameter}, or angles in degrees",
            parameter="depth_mm",
        )
    radius = np.hypot(*places.T)
    slopes = radius if target.unit == "deg" else field_from_object_height(lens, depth_mm, wavelength_um, radius)
    heights = np.abs(chief_heights(with_mask(lens, CLEAR), Sources(depth_mm, slopes, wavelength_um)))
    landed: np.ndarray = places * (heights / np.where(radius > 0, radius, 1.0))[:, None]
    return landed


def match_target(found_mm: np.ndarray, target: Target, expected: np.ndarray, known_scale: bool) -> TargetMatch:
    """Return how points at ``expected`` places, (points, 2), lie among those found, (points, 2), mm.

    Points may be missing among either. ``known_scale``: whether the expected places are mm on the sensor, to
    `SCALE`. Of several ways that match as many points, the upright one nearest the axis is returned. Raises
    RequestError where the points are not those of the target.
    """
    z, w = (places[:, 0] + 1j * places[:, 1] for places in (np.asarray(found_mm, float), np.asarray(expected, float)))
    least = max(FEWEST, min(z.size, CERTAIN), ceil(SHARE * z.size))
    step = _step(w)
    tried = _best_first(z, w, step, known_scale) if z.size >= FEWEST else []
    placings = [_refine(z, w, NEAR * step, a, b, mirrored) for a, b, mirrored in tried]
    most = max((one.count for one in placings), default=0)
    if most < least:
        raise RequestError(
            "{most} of {count} points of the picture lie where {path} has one, and {least} should; check the file, "
            "its unit, the distance, and whether it is that of this picture",
            most=most,
            count=z.size,
            path=target.name,
            least=least,
        )
    best = [one for one in placings if one.count == most]
    fewest = min(one.unseen for one in best)
    best = [one for one in best if one.unseen == fewest]
    closest = min(one.rms for one in best)
    best = [one for one in best if one.rms <= 2 * closest + ROUNDING * abs(one.a)]
    best.sort(key=lambda one: one.oddity(step))
    ways = {one.which.tobytes() for one in best}
    first = best[0]
    places = _plane(_mirror(w, first.mirrored) * (first.a / abs(first.a) if known_scale else first.a))
    axis = float(first.b.real), float(first.b.imag)
    turned = degrees(np.angle(first.a))
    shape = abs(first.a), turned, first.mirrored, first.k, first.rms
    return TargetMatch(first.which, target.numbers, places, axis, *shape, len(ways))


@dataclass(frozen=True, eq=False)
class _TargetPlacement:
    """One way to lay a target on a picture: z = a·w(1 + k|w|²/R²) + b, of −w̄ if mirrored; ``which`` point each is.

    ``unseen``: points of the target that should lie between others of the picture, and do not.
    """

    a: complex
    b: complex
    mirrored: bool
    k: float
    which: np.ndarray
    rms: float
    unseen: int

    @property
    def count(self) -> int:
        return int((self.which >= 0).sum())

    def oddity(self, step: float) -> float:
        """Return how far from upright and in the middle it is, of a mirror, 45° and the distance of neighbours each."""
        return self.mirrored + abs(np.angle(self.a)) / (np.pi / 4) + abs(self.b / self.a) / step


def _mirror(w: np.ndarray, mirrored: bool | np.ndarray) -> np.ndarray:
    """Return places of a target as they are seen; twice mirrored, they are as they were."""
    return np.where(mirrored, -w.conj(), w)


def _plane(z: np.ndarray) -> np.ndarray:
    return np.stack([z.real, z.imag], -1)


def _step(w: np.ndarray) -> float:
    """Return the median distance between neighbours."""
    from scipy.spatial import KDTree

    return float(np.median(KDTree(_plane(w)).query(_plane(w), 2)[0][:, 1]))


def _best_first(z: np.ndarray, w: np.ndarray, step: float, known_scale: bool) -> list[tuple[complex, complex, bool]]:
    """Return (a, b, mirrored) of the ways to lay a target on a picture that put most points near one of it."""
    from scipy.spatial import KDTree

    tree, seen = KDTree(_plane(w)), KDTree(_plane(z))
    order = np.argsort(np.abs(z - np.median(z.real) - 1j * np.median(z.imag)))
    ends = [(p, q) for p in order[:ANCHORS] for q in seen.query(_plane(z)[p], min(NEIGHBOURS + 1, z.size))[1][1:]]
    near = tree.query(tree.data, min(TARGET_NEIGHBOURS + 1, w.size))[1]
    k, other = np.repeat(near[:, 0], near.shape[1] - 1), near[:, 1:].ravel()
    ways = []
    for mirrored in (False, True):
        places = _mirror(w, mirrored)
        for p, q in ends:
            a = (z[q] - z[p]) / (places[other] - places[k])
            ways.append(np.stack([a, z[p] - a * places[k], np.full(a.size, mirrored)], 1))
    every = np.concatenate(ways)
    if known_scale:
        every = every[np.abs(np.log(np.abs(every[:, 0]))) < np.log(SCALE)]
    if not len(every):
        return []
    some = z[order[:TRIED]]
    counts = np.concatenate(
        [_counts(every[i : i + TOGETHER], some, tree, step) for i in range(0, len(every), TOGETHER)]
    )
    odd = np.abs(every[:, 2]) + np.abs(np.angle(every[:, 0])) / (np.pi / 4) + np.abs(every[:, 1] / every[:, 0]) / step
    out: dict[tuple[float, ...], tuple[complex, complex, bool]] = {}
    for place in np.lexsort([odd, -counts]):
        a, b, mirrored = every[place]
        alike = (bool(mirrored.real), *np.rint([4 * np.angle(a), 4 * np.log(abs(a)), *_plane(2 * b / a / step)]))
        out.setdefault(alike, (complex(a), complex(b), bool(mirrored.real)))
        if len(out) == REFINED:
            break
    return list(out.values())


def _counts(every: np.ndarray, z: np.ndarray, tree: "KDTree", step: float) -> np.ndarray:
    """Return how many points of a target have one of a picture near, for many ways to lay it, (ways,)."""
    a, b, mirrored = every[:, :1], every[:, 1:2], every[:, 2:].real
    distance, which = tree.query(_plane(_mirror((z - b) / a, mirrored)), distance_upper_bound=NEAR * step)
    found = np.sort(np.where(np.isfinite(distance), which, -1), axis=1)
    count: np.ndarray = (found[:, 1:] != found[:, :-1]).sum(1) + (found[:, 0] >= 0)
    return count


def _refine(z: np.ndarray, w: np.ndarray, near: float, a: complex, b: complex, mirrored: bool) -> _TargetPlacement:
    """Return a placing fitted to all points that lie ``near`` one of the target, in turns with which these are."""
    places = _mirror(w, mirrored)
    square, k, before = np.abs(places) ** 2 / (np.abs(places) ** 2).max(), 0.0, None
    for _ in range(STEPS):
        which = _assign(z, a * places * (1 + k * square) + b, near * abs(a))
        if before is not None and np.array_equal(which, before):
            break
        here, there = np.flatnonzero(which >= 0), which[which >= 0]
        if here.size < 2:
            break
        if here.size >= CURVED:
            columns = np.stack([places[there], places[there] * square[there], np.ones(there.size)], 1)
            first, cubic, _ = np.linalg.lstsq(columns, z[here], rcond=None)[0]
            k = float((cubic / first).real)
        bent = places[there] * (1 + k * square[there])
        a, b = np.linalg.lstsq(np.stack([bent, np.ones(there.size)], 1), z[here], rcond=None)[0]
        before = which
    here, there = np.flatnonzero(which >= 0), which[which >= 0]
    every = a * places * (1 + k * square) + b
    rms = float(np.sqrt(np.mean(np.abs(z[here] - every[there]) ** 2))) if here.size else np.inf
    low, high = _plane(z).min(0) - near * abs(a), _plane(z).max(0) + near * abs(a)
    inside = (_plane(every) > low).all(1) & (_plane(every) < high).all(1)
    inside[there] = False
    return _TargetPlacement(complex(a), complex(b), mirrored, k, which, rms, int(inside.sum()))


def _assign(z: np.ndarray, places: np.ndarray, near: float) -> np.ndarray:
    """Return the place nearest each point, −1 where none is ``near``; of points with one place only the nearest."""
    from scipy.spatial import KDTree

    distance, which = KDTree(_plane(places)).query(_plane(z), distance_upper_bound=near)
    which = np.where(np.isfinite(distance), which, -1)
    for k in np.argsort(-distance):
        rivals = np.flatnonzero(which == which[k])
        if which[k] >= 0 and distance[rivals].min() < distance[k]:
            which[k] = -1
    return which
