"""The contrast (MTF) of many builds at one frequency: the autocorrelation of their pupils at a fixed set of points.

With D(f) the density of rays over frequencies f = n'K/λ and w their phase (see `p2sf.pupil.frequency_pupil`),

    OTF(ν) = ∫ D(f)·D(f − ν)·exp(2πi(w(f) − w(f − ν))) df / ∫ D² df

(Goodman 2005, eq. 6-28). Pairs of points of the stop whose frequencies differ by ν are determined once for the lens
without errors; a build changes their phases. It also stretches the pupil by 1 + ε along the pattern, since its iris
stays but its focal length changes, so that the frequencies of these pairs differ by ν(1 + ε): their contrast is
extrapolated to ν along the chord from a slightly smaller frequency. Changes in the shape of the pupil are neglected.
Behind a mask both D include its amplitude, and rows of points are split where an edge of the mask crosses them.
"""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.disc_function import DiscFunction
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.disc.open_part import edges_of, places_between
from p2sf.disc.phasors import cosine_sine
from p2sf.disc.quadrature import gauss_legendre
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.parameters import check_positive
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.pencil import reaching
from p2sf.tolerance.differentials import FINEST, Differentials

NODES = 16, 32  # radii and directions of the rays that give the pupil, as polynomials of order 15
SIZES = (12, 16), (18, 24), (26, 34), (38, 50), (56, 72)  # rows and columns of pairs
DISTORTION = 1.1  # largest excess of the pupil's radius over that extrapolated from the scale at its centre
SETTLED = 1e-3  # by which the lens's contrast may change from one size to the next, which is then used
FEWEST, ALONG, STEPS, HALVINGS = 6, 17, 128, 14  # of a part of a row: points; of a row: where its edges are sought
NEAR = 0.02  # by which the second frequency of a pattern is smaller: several times the stretch of a build's pupil
ROUNDS = 7  # iterations: each multiplies the error by the pupil's distortion, some per cent


@dataclass(frozen=True, eq=False)
class Pairs:
    """Pairs of points in the stop, ``ends`` (2, 2, points), of frequencies that differ by that of the contrast.

    ``light``: (points,), D·D′·df over ∫D²df. ``still``: the difference of the waves of the lens without errors.
    """

    ends: np.ndarray
    light: np.ndarray
    still: np.ndarray

    def contrast(self, waves: np.ndarray) -> np.ndarray:
        """Return the contrast of builds that add differences of waves, (builds, points), at the pairs."""
        cosine, sine = cosine_sine(waves + self.still.astype(np.float32), np.float32)
        light = self.light.astype(np.float32)
        contrast: np.ndarray = np.hypot(cosine @ light, sine @ light)
        return contrast


class _PupilMap:
    """Frequencies and amplitude over the stop, by rays through the nodes of functions over the disc."""

    def __init__(self, known: Differentials, field: int):
        lens, source, nodes = known.lens, known.sources[field], known.lens.pupil_domain.nodes(NODES)
        rays = reaching(lens, source, nodes.xi, nodes.eta)
        self._map, self._light = (
            DiscFunction(np.stack(columns), NODES, odd, lens.pupil_domain)
            for columns, odd in (((rays.fx, rays.fy), (True, False)), ((rays.amplitude,), (False,)))
        )
        self.mask = mask_seen(lens, source)
        nodes = mask_nodes(self.mask, *FINEST).unfolded()
        place = np.stack([nodes.xi, nodes.eta])
        density = np.square(self.amplitude(place)) / np.abs(np.linalg.det(self.jacobian(*place)))
        self.square = float((nodes.weight * np.square(nodes.amplitude) * density).sum()) * np.pi * nodes.share

    def at(self, place: np.ndarray) -> np.ndarray:
        """Return the frequencies (2, points) at points (2, points) of the stop."""
        return self._map.at(*place)

    def amplitude(self, place: np.ndarray) -> np.ndarray:
        """Return the field of unit pupil area at points, without that of the mask."""
        amplitude: np.ndarray = self._light.at(*place)[0]
        return amplitude

    def jacobian(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return ∂(fx, fy)/∂(ξ, η), (points, 2, 2)."""
        return np.stack(self._map.slopes_at(xi, eta), axis=-1).swapaxes(0, 1)

    def reaches(self, frequency: np.ndarray) -> bool:
        """Return whether two points of the stop may differ by a frequency, allowing for the pupil's distortion."""
        across = np.linalg.inv(self.jacobian(np.zeros(1), np.zeros(1))[0]) @ frequency
        return bool(np.hypot(*across) < 2 * DISTORTION)

    def apart(self, middle: np.ndarray, frequency: np.ndarray) -> np.ndarray:
        """Return the separation, (2, points), of two points about each middle that differ by ``frequency``."""
        inverse = np.linalg.inv(self.jacobian(np.zeros(1), np.zeros(1))[0])
        found = np.broadcast_to((inverse @ frequency)[:, None], middle.shape)
        for _ in range(ROUNDS):
            difference = self.at(middle + found / 2) - self.at(middle - found / 2)
            found = found + inverse @ (frequency[:, None] - difference)
        return found


def pairs_of(known: Differentials, field: int, frequency_per_mm: float) -> tuple[Pairs | None, Pairs | None]:
    """Return the pairs for patterns along x (sagittal) and along y (tangential); None beyond the cut-off."""
    check_positive("frequency_per_mm", frequency_per_mm)
    pupil, shift = _PupilMap(known, field), frequency_per_mm / UM_PER_MM
    source, lens = known.sources[field], known.lens
    sagittal, tangential = (_settle(pupil, lens, source, shift * np.array(axis)) for axis in ((1.0, 0.0), (0.0, 1.0)))
    return sagittal, tangential


def at_frequency(contrast: np.ndarray, near: np.ndarray, stretch: np.ndarray) -> np.ndarray:
    """Return the contrast of builds, (builds,), whose pairs differ by ν(1 + stretch); ``near``: that at ν(1 − NEAR)."""
    moved: np.ndarray = np.maximum(contrast - stretch * (contrast - near) / NEAR, 0.0)
    return moved


def _settle(pupil: _PupilMap, lens: Lens, source: Source, frequency: np.ndarray) -> Pairs | None:
    """Return as many pairs as the waves of the lens require."""
    corners = _corners(pupil, frequency)
    if corners is None:
        return None
    last, none = np.inf, np.zeros((1, 1))
    for size in SIZES[2 * pupil.mask.edged :]:
        found = _pairs(pupil, lens, source, frequency, _overlap(pupil, frequency, corners, size))
        contrast = float(found.contrast(none)[0])
        if abs(contrast - last) <= SETTLED:
            return found
        last = contrast
    raise RequestError(
        "the contrast at {frequency:g} cycles per mm is too small to be summed, at {field:.4g}°; choose a lower one",
        frequency=UM_PER_MM * float(np.hypot(*frequency)),
        field=source.field_deg,
    )


def _pairs(
    pupil: _PupilMap, lens: Lens, source: Source, frequency: np.ndarray, middles: tuple[np.ndarray, np.ndarray]
) -> Pairs:
    middle, area = middles
    apart = pupil.apart(middle, frequency)
    ends = np.stack([middle + apart / 2, middle - apart / 2])
    area = area * pupil.mask.amplitude(*ends[0]) * pupil.mask.amplitude(*ends[1])
    first, second = (pupil.jacobian(*end) for end in ends)
    # From F(m + δ/2) − F(m − δ/2) = ν: ∂δ/∂m = 2(J + J′)⁻¹(J′ − J), and df = |J(1 + ½∂δ/∂m)| dm.
    turned = np.eye(2) + np.linalg.solve(first + second, second - first)
    area = area * np.abs(np.linalg.det(first @ turned))
    density = [pupil.amplitude(end) / np.abs(np.linalg.det(by)) for end, by in zip(ends, (first, second), strict=True)]
    light = density[0] * density[1] * area / pupil.square
    phase = reaching(lens, source, *ends.swapaxes(0, 1).reshape(2, -1)).phase.reshape(2, -1)
    phase = phase + pupil.mask.path_um(ends[:, 0], ends[:, 1]) / source.wavelength_um
    return Pairs(ends, light, phase[0] - phase[1])


def _corners(pupil: _PupilMap, frequency: np.ndarray) -> np.ndarray | None:
    """Return the two middles, (2, 2), whose points are both on the rim; None if the frequency is beyond the cut-off."""
    if not pupil.reaches(frequency):
        return None
    sign, middle = np.array([1.0, -1.0]), np.zeros((2, 2))
    for _ in range(ROUNDS):
        apart = pupil.apart(middle, frequency)
        long = np.hypot(*apart)
        if (long >= 2).any():
            return None
        middle = sign * np.sqrt(1 - long**2 / 4) * np.stack([-apart[1], apart[0]]) / long
    return middle


def _overlap(
    pupil: _PupilMap, frequency: np.ndarray, corners: np.ndarray, size: tuple[int, int]
) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss-Legendre nodes (2, points) in rows between the corners, and the area of each.

    Rows end where one point of the pair is on the rim. Even steps of an angle φ, sin φ along the corners' line, resolve
    both a full circle and the corners of its overlap with another, and likewise the ends of a mask's edges.
    """
    centre, half = corners.mean(1), (corners[:, 0] - corners[:, 1]) / 2
    along = np.array([half[1], -half[0]]) / np.hypot(*half)
    along = along * np.sign(along @ pupil.apart(centre[:, None], frequency)[:, 0])
    inner, dark = edges_of(pupil.mask)
    heights = [half @ (np.stack(edge) - centre[:, None]) / (half @ half) for edge in (*inner, *dark)]
    line = np.array([-1.0, 1.0])
    places, share = places_between([np.stack([one, one]) for one in (line, *heights)], size[0])
    base = centre[:, None] + half[:, None] * places
    ends = [np.zeros(places.size), np.zeros(places.size)]
    for _ in range(ROUNDS):
        for which, sign in enumerate((1.0, -1.0)):
            point = base + along[:, None] * ends[which]
            start = base + sign * pupil.apart(point, frequency) / 2
            across = along @ start
            root = np.sqrt(np.maximum(across**2 - (start * start).sum(0) + 1, 0.0))
            ends[which] = -across + sign * root
    row, low, high = _open_parts(pupil, frequency, base, along, ends[1], ends[0])
    counts = np.maximum(FEWEST, np.ceil(size[1] * (high - low) / (ends[0] - ends[1])[row])).astype(int)
    points, areas = [], []
    for count in np.unique(counts):
        some = counts == count
        node, part = gauss_legendre(int(count))
        middle, reach = (high + low)[some] / 2, (high - low)[some] / 2
        place = middle[:, None] + reach[:, None] * node
        points.append((base[:, row[some], None] + along[:, None, None] * place).reshape(2, -1))
        areas.append(((share[row[some]] * np.hypot(*half) * reach)[:, None] * part).ravel())
    return np.concatenate(points, axis=1), np.concatenate(areas)


def _open_parts(
    pupil: _PupilMap, frequency: np.ndarray, base: np.ndarray, along: np.ndarray, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the parts of rows from ``low`` to ``high`` where a mask leaves both points open: row, low and high.

    They are found at even steps, their ends by bisection. ``base``: (2, rows), the zero of each row.
    """
    if not pupil.mask.edged:
        return np.arange(low.size), low, high
    middle = base[:, :, None] + along[:, None, None] * np.linspace(low, high, ALONG, axis=1)
    halves = pupil.apart(middle.reshape(2, -1), frequency).reshape(middle.shape) / 2

    def is_open(row: np.ndarray, part: np.ndarray) -> np.ndarray:
        cell = np.minimum((part * (ALONG - 1)).astype(int), ALONG - 2)
        rest = part * (ALONG - 1) - cell
        half = halves[:, row, cell] * (1 - rest) + halves[:, row, cell + 1] * rest
        place = base[:, row] + along[:, None] * (low[row] + part * (high - low)[row])
        both: np.ndarray = pupil.mask.opens(*(place + half)) & pupil.mask.opens(*(place - half))
        return both

    steps = np.linspace(0, 1, STEPS)
    rows, parts = (each.ravel() for each in np.meshgrid(np.arange(low.size), steps, indexing="ij"))
    open_ = np.pad(is_open(rows, parts).reshape(low.size, STEPS), ((0, 0), (1, 1)))
    row, step = np.nonzero(open_[:, 1:] != open_[:, :-1])  # for each row in turn, where it opens and closes
    before, after = steps[np.maximum(step - 1, 0)], steps[np.minimum(step, STEPS - 1)]
    for _ in range(HALVINGS):
        half_way = (before + after) / 2
        same = is_open(row, half_way) == open_[row, step]
        before, after = np.where(same, half_way, before), np.where(same, after, half_way)
    ends = low[row] + (before + after) / 2 * (high - low)[row]
    return row[::2], ends[::2], ends[1::2]
