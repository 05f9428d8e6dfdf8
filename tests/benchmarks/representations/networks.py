"""Small neural networks trained on exact PSFs, by numpy on one core.

Two kinds that are published: a network of place and pixel that gives the intensity there (lens blur fields, Lin et al.
2023; sinusoidal units, Sitzmann et al. 2020), and a network of place that gives the scores of principal components, as
PSF networks do with their last, linear layer.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from time import process_time
from typing import NamedTuple

import numpy as np

from p2sf.conventions import centred_axis
from tests.benchmarks.representations.pictures import BUDGETS, SMALL_BUDGET, best_grids, principal, quantise, scores_of
from tests.benchmarks.representations.representation import (
    ExactPsfs,
    Representation,
    clipped_to_unit_sum,
    mirror_halves,
    right_half,
)
from tests.benchmarks.representations.space import LensSpace, SpacePoints

Weights = list[np.ndarray]
"""A matrix (inputs, outputs) and a vector (outputs,) for each layer, in turn."""


class FieldSize(NamedTuple):
    """How large a network of pixels is: units a layer, layers, and steps of its training."""

    units: int
    layers: int
    steps: int


class ScoreSize(NamedTuple):
    """How large a network of scores is: units a layer, layers, components, and steps of its training."""

    units: int
    layers: int
    rank: int
    steps: int


FIELDS = FieldSize(16, 3, 1500), FieldSize(32, 3, 3000)
SCORES = ScoreSize(16, 2, 2, 2000), ScoreSize(32, 2, 8, 4000), ScoreSize(64, 2, 16, 4000)
TRAINED, TRAINED_SEED = 150, 11  # points at random beside the nodes
PIXELS_A_STEP, DRAWN, PLACES_A_STEP = 4096, 32, 256
LEARNING_RATE = 1.5e-2
FIRST_FREQUENCY = 6.0  # of the sines that take the pixel's place, radians over half a window
DECAYS = 0.9, 0.999  # of Adam's means (Kingma & Ba 2015, algorithm 1)
TINY = 1e-8
SEED = 5
FLOOR = 0.01  # of the intensity's weight, relative to the picture's norm


def started_weights(sizes: list[int], generator: np.random.Generator) -> Weights:
    """Return random weights of layers of such ``sizes``, inputs first (Sitzmann et al. 2020, §3.2, with ω0 = 1)."""
    weights: Weights = []
    for inputs, outputs in pairwise(sizes):
        most = np.sqrt(6 / inputs)
        weights.append(generator.uniform(-most, most, (inputs, outputs)).astype(np.float32))
        weights.append(np.zeros(outputs, np.float32))
    return weights


def outputs_of(weights: Weights, inputs: np.ndarray) -> np.ndarray:
    """Return the last, linear layer's values, (n, outputs), of inputs (n, inputs); all layers before it take sines."""
    value = inputs
    for matrix, offset in zip(weights[:-2:2], weights[1:-2:2], strict=True):
        value = np.sin(value @ matrix + offset)
    last: np.ndarray = value @ weights[-2] + weights[-1]
    return last


def gradient_of(weights: Weights, inputs: np.ndarray, wanted: np.ndarray, share: np.ndarray) -> Weights:
    """Return the gradient of Σ share·|outputs − wanted|²/2 by the chain rule; ``share``: (n, 1)."""
    values, sums = [inputs], []
    for matrix, offset in zip(weights[:-2:2], weights[1:-2:2], strict=True):
        sums.append(values[-1] @ matrix + offset)
        values.append(np.sin(sums[-1]))
    slope = (values[-1] @ weights[-2] + weights[-1] - wanted) * share
    gradient: Weights = [values[-1].T @ slope, slope.sum(0)]
    for layer in range(len(sums) - 1, -1, -1):
        slope = (slope @ weights[2 * layer + 2].T) * np.cos(sums[layer])
        gradient = [values[layer].T @ slope, slope.sum(0), *gradient]
    return gradient


Batch = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Inputs, outputs wanted, and how much each counts."""
Batches = Iterator[Batch]


def train(weights: Weights, batches: Batches, steps: int) -> Weights:
    """Return the weights after ``steps`` of Adam, the rate falling to nothing along half a cosine."""
    first, second = ([np.zeros_like(w) for w in weights] for _ in range(2))
    for step, batch in zip(range(1, steps + 1), batches, strict=False):
        rate = LEARNING_RATE * 0.5 * (1 + np.cos(np.pi * step / steps))
        rate *= np.sqrt(1 - DECAYS[1] ** step) / (1 - DECAYS[0] ** step)
        for weight, mean, square, slope in zip(weights, first, second, gradient_of(weights, *batch), strict=True):
            mean += (1 - DECAYS[0]) * (slope - mean)
            square += (1 - DECAYS[1]) * (slope * slope - square)
            weight -= (rate * mean / (np.sqrt(square) + TINY)).astype(np.float32)
    return weights


def network_representations(space: LensSpace, exact: ExactPsfs, quick: bool = False) -> Iterator[Representation]:
    """Yield networks of growing size."""
    counts = best_grids(space, exact, SMALL_BUDGET if quick else BUDGETS[-1])[-1]
    cube = np.concatenate([space.grid(counts).cube, space.random(TRAINED, TRAINED_SEED).cube])
    points = space.at(cube)
    pictures = exact.at(points)
    for of_field in FIELDS[:1] if quick else FIELDS:
        yield _blur_field(space, exact, points, pictures, of_field)
    started = process_time()
    basis = principal(pictures, max(size.rank for size in SCORES))
    lessons = Lessons(points, pictures, basis, len(points) * exact.seconds + process_time() - started)
    for size in SCORES[:1] if quick else SCORES:
        yield _score_network(space, lessons, size)


def _in_half_precision(weights: Weights) -> tuple[Weights, int]:
    """Return weights rounded to 16 bits, and their bytes."""
    rounded = [w.astype(np.float16) for w in weights]
    return [w.astype(np.float32) for w in rounded], sum(w.nbytes for w in rounded)


def _places(cube: np.ndarray) -> np.ndarray:
    """Return places as a network takes them, −1…1."""
    places: np.ndarray = (2 * cube - 1).astype(np.float32)
    return places


def _pixels(space: LensSpace) -> np.ndarray:
    """Return |x| and y of the half picture's pixels, (pixels, 2), in units that make sines of FIRST_FREQUENCY."""
    count = space.window.pixels
    along = centred_axis(count, 2 / count)
    x, y = np.meshgrid(np.arange(count // 2 + 1) * (2 / count), along)
    found: np.ndarray = FIRST_FREQUENCY * np.stack([x.ravel(), y.ravel()], 1).astype(np.float32)
    return found


def _blur_field(
    space: LensSpace, exact: ExactPsfs, points: SpacePoints, pictures: np.ndarray, size: FieldSize
) -> Representation:
    """Return a network of (place, pixel) that gives the root of the intensity, relative to the picture's norm."""
    started = process_time()
    generator = np.random.default_rng(SEED)
    halves = right_half(pictures)
    norms = np.linalg.norm(pictures, axis=(1, 2))
    roots = np.sqrt(halves / norms[:, None]).astype(np.float32)
    places, pixels = _places(points.cube), _pixels(space)

    def batch(drawn: np.ndarray, chance: np.ndarray) -> Batch:
        which, pixel = np.divmod(drawn, roots.shape[1])
        inputs = np.concatenate([places[which], pixels[pixel]], 1)
        wanted = roots.ravel()[drawn][:, None]
        # An error of the root counts as one of the intensity, 2·root; drawn more often, a pixel counts less.
        share = (FLOOR + wanted**2) / (chance[drawn][:, None] * roots.size * PIXELS_A_STEP)
        return inputs, wanted, share.astype(np.float32)

    def batches() -> Batches:
        chance = 0.5 / roots.size + 0.5 * (roots / roots.sum()).ravel()
        edges = np.cumsum(chance)
        while True:
            # In ascending order at once, which stays in the cache, then mixed: four times as fast as one by one.
            at = np.sort(generator.random(DRAWN * PIXELS_A_STEP)) * edges[-1]
            found = generator.permutation(np.minimum(np.searchsorted(edges, at), roots.size - 1))
            yield from (batch(drawn, chance) for drawn in np.split(found, DRAWN))

    weights = started_weights([5, *[size.units] * size.layers, 1], generator)
    kept, nbytes = _in_half_precision(train(weights, batches(), size.steps))
    seconds = len(points) * exact.seconds + process_time() - started
    layers = f"{size.layers} layers of {size.units} sines"
    words = f"place and pixel to intensity, {layers}, 16 bits, {size.steps} steps of Adam"
    numbers = sum(w.size for w in kept)
    return Representation("neural", words, numbers, nbytes, seconds, partial(_field_psf, space, kept))


def _field_psf(space: LensSpace, weights: Weights, points: SpacePoints) -> np.ndarray:
    pixels, places = _pixels(space), _places(points.cube)
    roots = [outputs_of(weights, np.concatenate([np.tile(p, (len(pixels), 1)), pixels], 1))[:, 0] for p in places]
    return clipped_to_unit_sum(mirror_halves(np.square(np.maximum(roots, 0)), space.window.pixels))


@dataclass(frozen=True, eq=False)
class Lessons:
    """What networks of scores learn from: pictures at points, their principal components, and what these took."""

    points: SpacePoints
    pictures: np.ndarray
    components: np.ndarray
    seconds: float


def _score_network(space: LensSpace, lessons: Lessons, size: ScoreSize) -> Representation:
    """Return a network of place that gives the scores of principal components."""
    started = process_time()
    generator = np.random.default_rng(SEED)
    basis, nbytes = quantise(lessons.components[: size.rank + 1], 8)
    scores = scores_of(lessons.pictures, basis).astype(np.float32)
    scale = float(np.sqrt(np.square(scores).sum(1).mean()))
    # Relative errors of a picture are to count alike for all.
    share = 1 / np.square(np.linalg.norm(lessons.pictures, axis=(1, 2)))[:, None]
    share = (share / share.mean() / PLACES_A_STEP).astype(np.float32)
    places = _places(lessons.points.cube)

    def batches() -> Batches:
        while True:
            which = generator.integers(len(places), size=PLACES_A_STEP)
            yield places[which], scores[which] / scale, share[which]

    weights = started_weights([3, *[size.units] * size.layers, size.rank], generator)
    weights = train(weights, batches(), size.steps)
    weights[-2:] = [scale * w for w in weights[-2:]]
    kept, own = _in_half_precision(weights)
    seconds = lessons.seconds + process_time() - started
    layers = f"{size.layers} layers of {size.units} sines"
    words = f"place to {size.rank} scores, {layers}, components in 8 bits, {size.steps} steps of Adam"
    numbers = sum(w.size for w in kept) + right_half(basis).size
    psf = partial(_score_psf, space, right_half(basis), kept)
    return Representation("neural", words, numbers, own + nbytes, seconds, psf)


def _score_psf(space: LensSpace, halves: np.ndarray, weights: Weights, points: SpacePoints) -> np.ndarray:
    found = halves[0] + outputs_of(weights, _places(points.cube)) @ halves[1:]
    return clipped_to_unit_sum(mirror_halves(found, space.window.pixels))
