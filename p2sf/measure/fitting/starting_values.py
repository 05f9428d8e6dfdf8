"""Wavefronts to start a fit from: many candidates of the right width, the most alike of them first (handbook 11.2).

The sum of squares has many minima, of which only the deepest is the answer. The mean square of |∇W| over the pupil is
the mean square distance at which rays land, in units of λ/NA. So candidates are random directions in the space of
coefficients, scaled to the width of the pictures seen; their PSFs, all sums over the same waves, are compared with the
pictures, both a little blurred. Of a whole frame, the second moments of all points are quadratic in the unknowns, and
have few minima: those are the candidates (`frame_starts`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.errors import RequestError
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum, wave
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.fitting.pupil_model import SIX, pupil_model
from p2sf.measure.fitting.pupil_nodes import PupilNodes, counts_for, paraxial_nodes

CANDIDATES = 1024
FRAME_CANDIDATES, MOMENT_STEPS = 512, 40
SPREADS = 0.5, 1.0, 2.0, 4.0  # of a frame's candidates, in units of ``scale``
RAY_ORDER = 6  # of polynomials of the wavefront over directions
PULL = 0.03  # towards 0, where moments do not determine an unknown
CANDIDATES_APART = 0.25  # of the largest number of any: neighbours in a narrower mesh end in one minimum
APART = 0.3  # by which candidates of a frame differ, in units of ``scale``
FIRST_DAMPING, WEAKER, STRONGER, MOST_DAMPING = 1e-2, 0.3, 5.0, 1e6
GENERAL_GOLDEN = 1.1673039782614187
TOGETHER = 128  # candidates summed at a time
BLUR_PIXELS = 1.0
SIGNIFICANT = 3.0  # standard deviations of noise that light exceeds
SPIKE, SPIKE_SIGMA = 2.0, 10.0  # times what the sharpest point is above its neighbours, and deviations of noise
LEAST_SPIKE = 4.0
NARROWEST = 0.2  # least scale of a candidate, waves of RMS slope: a point without aberration has no direction


@dataclass(frozen=True)
class Seen:
    """Where the light of one picture is: centroid in µm from the middle pixel, all light and background.

    ``moments_um2``: the second moments xx, xy and yy about the centroid.
    """

    x: float
    y: float
    flux: float
    background: float
    moments_um2: tuple[float, float, float]

    @property
    def square_um2(self) -> float:
        """Return the mean square distance from the centroid."""
        return self.moments_um2[0] + self.moments_um2[2]


@dataclass(frozen=True, eq=False)
class Start:
    """Starting values: the six model's numbers, and x, y, flux and background of every picture, (pictures, 4)."""

    waves: np.ndarray
    frames: np.ndarray


def locate(picture: PointPicture, optics: PictureOptics) -> Seen:
    """Return where a picture's light is. Raises RequestError where nothing exceeds the noise."""
    good = without_spikes(picture, optics)
    border = np.zeros(good.shape, bool)
    border[[0, -1]] = border[:, [0, -1]] = True
    edge = picture.values[border & good]
    background = float(np.median(edge if edge.size else picture.values[good]))
    values = np.where(good, picture.values - background, 0.0)
    noise = np.sqrt(np.broadcast_to(picture.variance, values.shape))
    light = np.where(significant(values, noise), values, 0.0)
    flux = light.sum()
    if not flux > SIGNIFICANT * np.sqrt(np.sum(noise[light != 0] ** 2)):
        raise RequestError(
            "no point rises above the noise in a window of {shape} pixels; expose longer, or choose another point",
            shape=" × ".join(map(str, values.shape[::-1])),
        )
    y, x = ((np.arange(count) - count // 2) * optics.pixel_um for count in values.shape)
    at_x, at_y = (light.sum(0) @ x) / flux, (light.sum(1) @ y) / flux
    across, up = x - at_x, y - at_y
    moments = light.sum(0) @ across**2, up @ light @ across, light.sum(1) @ up**2
    wide_x, both, wide_y = (float(moment / flux) for moment in moments)
    return Seen(float(at_x), float(at_y), float(flux), background, (max(wide_x, 0.0), both, max(wide_y, 0.0)))


def significant(light: np.ndarray, noise: np.ndarray) -> np.ndarray:
    """Return where light, a little blurred, exceeds the noise, (y, x)."""
    # Averaging over a Gaussian of this width leaves 1/(2√π·width) of white noise.
    bright: np.ndarray = blur(light) > SIGNIFICANT * noise / (2 * np.sqrt(np.pi) * BLUR_PIXELS)
    return bright


def blur(picture: np.ndarray) -> np.ndarray:
    """Return a picture (y, x), a little blurred."""
    down, across = (blurring(count, BLUR_PIXELS) for count in picture.shape)
    out: np.ndarray = down @ picture @ across.T
    return out


def without_spikes(picture: PointPicture, optics: PictureOptics) -> np.ndarray:
    """Return the usable pixels but those that stand alone, far above all their neighbours: no point is so narrow."""
    most = SPIKE * max(_sharpest(optics), LEAST_SPIKE / SPIKE)
    good = picture.usable
    values = np.where(good, picture.values, -np.inf)
    around = np.pad(values, 1, constant_values=-np.inf)
    rows, columns = values.shape
    moves = [(i, j) for i in range(3) for j in range(3) if (i, j) != (1, 1)]
    neighbours = np.max([around[i : i + rows, j : j + columns] for i, j in moves], axis=0)
    base = float(np.median(values[good]))
    noise = np.sqrt(np.broadcast_to(picture.variance, values.shape))
    lone: np.ndarray = values - base > most * np.maximum(neighbours - base, 0.0) + SPIKE_SIGMA * noise
    kept: np.ndarray = good & ~lone
    return kept


@lru_cache(maxsize=16)
def _sharpest(optics: PictureOptics) -> float:
    """Return how many times brighter than its neighbours the pixel is on which an unaberrated point is centred."""
    nodes = paraxial_nodes(counts_for(0.0, optics.cycles, 2 * optics.pixel_um), optics.cycles, optics.mask)
    light = PixelSum(nodes, (3, 3), optics).light(np.zeros_like(nodes.xi))
    return float(light[1, 1] / light[1, 0])


def blurring(count: int, width: float) -> np.ndarray:
    """Return the matrix of a Gaussian blur along an axis, (count, count), of rows of unit sum."""
    place = np.arange(count)
    kernel = np.exp(-0.5 * ((place[:, None] - place) / width) ** 2)
    blur: np.ndarray = (kernel / kernel.sum(1, keepdims=True)).astype(np.float32)
    return blur


def starts(pictures: Sequence[PointPicture], optics: PictureOptics, azimuth: float, keep: int) -> list[Start]:
    """Return ``keep`` candidates whose pictures are most like those given, the best first. Raises RequestError.

    They are apart, so that not all of them lead to one minimum.
    """
    found = [locate(picture, optics) for picture in pictures]
    waves = candidates(found, pictures, optics, azimuth)
    mean, _ = slope_moments(azimuth, optics.mask)
    offset = waves @ mean.T / optics.cycles  # the centroid of light is −⟨∇W⟩·λ/NA
    places = [np.stack([one.x + offset[:, 0], one.y + offset[:, 1]], 1) for one in found]
    unlike = _unlikeness(pictures, found, optics, azimuth, waves, places)
    frames = np.stack(
        [
            np.column_stack([place, np.tile([one.flux, one.background], (len(place), 1))])
            for one, place in zip(found, places, strict=True)
        ],
        1,
    )
    twin = [waves] if len(pictures) > 1 else [waves, _twins(waves, pictures[0])]
    return [Start(waves[k], frames[k]) for k in _apart(np.argsort(unlike), twin, keep)]


def _twins(waves: np.ndarray, picture: PointPicture) -> np.ndarray:
    """Return the wavefronts of the same pictures as those of candidates, (candidates, 4)."""
    model = pupil_model(SIX)
    return np.array([model.twin(each, picture.defocus_waves) for each in waves])


def _apart(order: np.ndarray, alike: Sequence[np.ndarray], keep: int) -> list[int]:
    """Return the first ``keep`` of an order that differ from each other, then others if these are too few.

    ``alike``: wavefronts of the candidates, and those that make the same pictures, each (candidates, 4).
    """
    apart = CANDIDATES_APART * float(np.abs(alike[0]).max())
    kept: list[int] = []
    for k in order.tolist():
        if all(np.abs(each[kept] - alike[0][k]).max(1, initial=0.0).min(initial=np.inf) >= apart for each in alike):
            kept.append(k)
        if len(kept) == keep:
            return kept
    return [*kept, *(k for k in order.tolist() if k not in kept)][:keep]


def candidates(
    found: Sequence[Seen], pictures: Sequence[PointPicture], optics: PictureOptics, azimuth: float
) -> np.ndarray:
    """Return wavefronts of the six model, (candidates, 4), as wide as all pictures together were seen to be."""
    from scipy.special import ndtri

    _, square = slope_moments(azimuth, optics.mask)
    known = np.array([picture.defocus_waves for picture in pictures])
    # Directions from an additive recurrence of low discrepancy: powers of the root of x⁵ = x + 1 (Roberts 2018).
    step = GENERAL_GOLDEN ** -np.arange(1.0, 5.0)
    direction = ndtri((0.5 + np.arange(1, CANDIDATES + 1)[:, None] * step) % 1)
    direction /= np.sqrt(np.einsum("ck,kl,cl->c", direction, square, direction))[:, None]
    # Σ over pictures of the mean square slope of t·direction + known·ρ² is that seen: a quadratic equation in t.
    linear = known.sum() * direction @ square[:, 3]
    constant = square[3, 3] * float(known @ known) - optics.cycles**2 * sum(one.square_um2 for one in found)
    root = np.sqrt(np.maximum(linear**2 - known.size * constant, 0.0))
    waves: np.ndarray = direction * np.maximum((root - linear) / known.size, NARROWEST)[:, None]
    return waves


def landings(waves: np.ndarray, fx: np.ndarray, fy: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return where rays land, x and y in µm without unknowns and per unit of each, (2, nodes, 1 + unknowns).

    ``waves``: W without unknowns, then what each adds, (1 + unknowns, nodes). A ray lands at ∂W/∂f: the derivatives
    are those of a polynomial in (fx, fy). ``weight``: of each node's light.
    """
    scale = max(float(np.abs(fx).max()), float(np.abs(fy).max()))
    u, v = fx / scale, fy / scale
    powers = [(i, j) for i in range(RAY_ORDER + 1) for j in range(RAY_ORDER + 1 - i)]
    root = np.sqrt(np.abs(weight))
    columns = np.stack([u**i * v**j for i, j in powers], 1)
    factors = np.linalg.lstsq(columns * root[:, None], (waves * root).T, rcond=None)[0]
    by_u = np.stack([i * u ** max(i - 1, 0) * v**j for i, j in powers], 1)
    by_v = np.stack([j * u**i * v ** max(j - 1, 0) for i, j in powers], 1)
    slopes: np.ndarray = np.stack([by_u @ factors, by_v @ factors]) / scale
    return slopes


def ray_moments(rays: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the moments xx, xy and yy about the centroid, as forms in (1, unknowns), (3, 1 + u, 1 + u), µm².

    ``rays``: where they land (`landings`); ``weight``: of each one's light, (nodes,).
    """
    share = weight / weight.sum()
    x, y = rays - np.einsum("n,anu->au", share, rays)[:, None]
    both = (share[:, None] * x).T @ y
    return np.stack([(share[:, None] * x).T @ x, (both + both.T) / 2, (share[:, None] * y).T @ y])


def frame_starts(moments: np.ndarray, wide: np.ndarray, beyond: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Return unknowns of a frame under which points are as wide as seen, (starts, u), the best first.

    ``moments``: of every point's rays as forms (`ray_moments`), (points, 3, 1 + u, 1 + u). ``wide``: those of the light
    seen, and ``beyond``: those of a model's light less those of its rays, (points, 3), µm². ``scale``: steps of the
    unknowns that change pictures clearly, (u,). Many random starts descend at once by Levenberg's and Marquardt's
    method; those that end together are one.
    """
    steps, count = np.append(1.0, scale), scale.size
    size = np.repeat(wide[:, 0] + wide[:, 2], 3)
    forms = moments.reshape(-1, *moments.shape[2:]) * np.multiply.outer(steps, steps) / size[:, None, None]
    right = (wide - beyond).ravel() / size

    def residuals(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        whole = np.concatenate([np.ones((len(values), 1)), values], 1)
        half = np.einsum("rij,cj->cri", forms, whole)
        pull = np.broadcast_to(PULL * np.eye(count), (len(values), count, count))
        rest = np.einsum("cri,ci->cr", half, whole) - right
        return np.concatenate([rest, PULL * values], 1), np.concatenate([2 * half[..., 1:], pull], 1)

    random = np.random.default_rng(0)
    values = random.normal(size=(FRAME_CANDIDATES, count)) * random.choice(SPREADS, size=(FRAME_CANDIDATES, 1))
    damping = np.full(FRAME_CANDIDATES, FIRST_DAMPING)
    rest, slopes = residuals(values)
    for _ in range(MOMENT_STEPS):
        matrix = np.einsum("cri,crj->cij", slopes, slopes)
        matrix += damping[:, None, None] * np.einsum("cii->ci", matrix)[:, None] * np.eye(count)
        step = np.linalg.solve(matrix, np.einsum("cri,cr->ci", slopes, rest)[..., None])[..., 0]
        new_rest, new_slopes = residuals(values - step)
        lower = np.sum(new_rest**2, 1) < np.sum(rest**2, 1)
        values = np.where(lower[:, None], values - step, values)
        rest = np.where(lower[:, None], new_rest, rest)
        slopes = np.where(lower[:, None, None], new_slopes, slopes)
        damping = np.clip(damping * np.where(lower, WEAKER, STRONGER), 0.0, MOST_DAMPING)
    kept: list[np.ndarray] = []
    for k in np.argsort(np.sum(rest**2, 1)):
        if all(np.abs(values[k] - other).max() > APART for other in kept):
            kept.append(values[k])
    starts: np.ndarray = np.array(kept) * scale
    return starts


@lru_cache(maxsize=64)
def slope_moments(azimuth: float, mask: PupilMask = CLEAR) -> tuple[np.ndarray, np.ndarray]:
    """Return ⟨∇b⟩ of the six model's terms, (2, terms) across and up, and ⟨∇b·∇b⟩ without them, (terms, terms).

    Means are over the light behind the mask.
    """
    nodes = mask_nodes(mask, 8, 24).unfolded()
    xi, eta, weight = nodes.xi, nodes.eta, nodes.weight * np.square(nodes.amplitude)
    weight = weight / weight.sum()
    model, step = pupil_model(SIX), 1e-4
    slopes = np.stack(
        [
            (model.waves(xi + dx, eta + dy, azimuth) - model.waves(xi - dx, eta - dy, azimuth)) / (2 * step)
            for dx, dy in ((step, 0.0), (0.0, step))
        ]
    )
    mean = slopes @ weight
    rest = slopes - mean[..., None]
    return write_protect(mean), write_protect(np.einsum("akp,alp,p->kl", rest, rest, weight))


def _unlikeness(
    pictures: Sequence[PointPicture],
    found: Sequence[Seen],
    optics: PictureOptics,
    azimuth: float,
    waves: np.ndarray,
    places: Sequence[np.ndarray],
) -> np.ndarray:
    """Return what each candidate leaves of the blurred pictures' squares, summed over pictures, (candidates,)."""
    nodes = _coarse_nodes(pictures, optics)
    basis = pupil_model(SIX).waves(nodes.xi, nodes.eta, azimuth)
    every = np.stack([*basis, -nodes.fx, -nodes.fy]).astype(np.float32)
    out = np.zeros(len(waves))
    for picture, one, place in zip(pictures, found, places, strict=True):
        total = PixelSum(nodes, picture.values.shape, optics, optics.coarse_parts)
        known = picture.defocus_waves * (nodes.xi**2 + nodes.eta**2) + nodes.waves
        down, across = (blurring(count, BLUR_PIXELS) for count in picture.values.shape)
        good = without_spikes(picture, optics)
        data = down @ np.where(good, picture.values - one.background, 0.0).astype(np.float32) @ across.T
        square = float(np.sum(data * data))
        numbers = np.concatenate([waves, place], 1).astype(np.float32)
        for start in range(0, len(waves), TOGETHER):
            some = slice(start, start + TOGETHER)
            light = total.many(wave(numbers[some] @ every + known.astype(np.float32)))
            blurred = down @ (light * good) @ across.T
            overlap = np.einsum("cyx,yx->c", blurred, data)
            out[some] += 1 - overlap**2 / (np.einsum("cyx,cyx->c", blurred, blurred) * square)
    return out


def _coarse_nodes(pictures: Sequence[PointPicture], optics: PictureOptics) -> PupilNodes:
    """Return nodes that carry what lands in the windows, to some per cent."""
    half = max(max(picture.values.shape) for picture in pictures) / 2 * optics.pixel_um
    counts = counts_for(0.8 * optics.cycles * half, optics.cycles, half / 2)
    return paraxial_nodes(counts, optics.cycles, optics.mask, optics.wavelength_um)
