"""One PSF alone, by everything that can describe it without its neighbours."""

from collections.abc import Iterator
from functools import partial
from time import process_time

import numpy as np

from p2sf.disc.zernike import terms
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.fitted import sum_fit
from p2sf.psf.seidel import seidel_psf
from p2sf.pupil.fit import FittedPencil, fit, levels
from tests.benchmarks.representations.fits import ADAPTIVE_WAVES
from tests.benchmarks.representations.pictures import STEPS, quantise
from tests.benchmarks.representations.rays import ray_representations
from tests.benchmarks.representations.representation import ExactPsfs, Representation, right_half
from tests.benchmarks.representations.shapes import SHAPES, fitted_shape, shape_values
from tests.benchmarks.representations.space import LensSpace, SpacePoints
from tests.benchmarks.representations.zernike_grid import MAP, ORDERS, pencil_of, wavefront

VALUE_BYTES = 4


def point_representations(space: LensSpace, exact: ExactPsfs, point: SpacePoints) -> Iterator[Representation]:
    """Yield every description of one point's PSF; their ``psf`` knows no other point."""
    [source] = point.sources()
    yield _six(space, source)
    yield from _fits(space, source)
    yield from _wavefronts(space, source)
    yield from _shapes(space, exact.at(point)[0])
    yield from _pictures(exact.at(point))
    yield from ray_representations(space)


def _six(space: LensSpace, source: Source) -> Representation:
    started = process_time()
    c = coefficients(space.lens, source.depth_mm, source.field_slope, source.wavelength_um)
    seconds = process_time() - started

    def psf(points: SpacePoints) -> np.ndarray:
        return space.window.light(seidel_psf(c, *space.window.fine).values)[None]

    return Representation("seidel", "six coefficients", 6, 6 * VALUE_BYTES, seconds, psf)


def _fits(space: LensSpace, source: Source) -> Iterator[Representation]:
    known = levels(space.lens.aim)
    for name, numbers in (("fitted 26", known[0].numbers), ("fitted 46", known[1].numbers), ("fitted adaptive", None)):
        started = process_time()
        found = fit(space.lens, source, numbers, residual_waves=ADAPTIVE_WAVES)
        seconds = process_time() - started
        words = f"{found.numbers} numbers"
        yield Representation(
            name, words, found.numbers, VALUE_BYTES * found.numbers, seconds, partial(_sum_waves, space, found)
        )


def _sum_waves(space: LensSpace, found: FittedPencil, points: SpacePoints) -> np.ndarray:
    return space.window.light(sum_fit(found, *space.window.fine)[0])[None]


def _wavefronts(space: LensSpace, source: Source) -> Iterator[Representation]:
    for order in ORDERS:
        started = process_time()
        numbers = wavefront(space, source, order).astype(np.float32)
        seconds = process_time() - started
        found = pencil_of(numbers, order, source.wavelength_um)
        words = f"{len(terms(order))} terms up to order {order} and {MAP} of the pupil's ellipse"
        yield Representation(
            "Zernike grid", words, numbers.size, numbers.nbytes, seconds, partial(_sum_waves, space, found)
        )


def _shapes(space: LensSpace, picture: np.ndarray) -> Iterator[Representation]:
    for shape, count in SHAPES.items():
        started = process_time()
        numbers = fitted_shape(picture, shape)
        seconds = process_time() - started

        def psf(points: SpacePoints, shape: str = shape, numbers: np.ndarray = numbers) -> np.ndarray:
            return shape_values(numbers, shape, space.window.pixels)[None]

        yield Representation(shape, f"{count} numbers", count, VALUE_BYTES * count, seconds, psf)


def _pictures(picture: np.ndarray) -> Iterator[Representation]:
    for bits in STEPS:
        kept, nbytes = quantise(picture, bits)

        def psf(points: SpacePoints, kept: np.ndarray = kept) -> np.ndarray:
            unit: np.ndarray = kept / kept.sum()
            return unit

        yield Representation(
            "PSF grid", f"roots of half the picture in {bits} bits", right_half(kept).size, nbytes, 0.0, psf
        )
