"""The baseline of the paper: one 2-D Gaussian fitted to the reference, for comparison only."""

from collections.abc import Iterator
from dataclasses import replace
from time import perf_counter

import numpy as np

from p2sf.figures.compare import r_squared
from p2sf.messages import Message
from p2sf.psf.result import Psf
from p2sf.threads import one_blas_thread

WIDTHS = (0.5, 1.0, 2.0)  # of the starting points, in units of the reference's spread: narrow core, whole, wide skirt
NARROWEST = 0.3  # in pixels: below it a sampled Gaussian is one sample, whatever its width


@one_blas_thread
def gaussian_psf(reference: Psf) -> Psf:
    """Return the elliptical Gaussian, free along y, that fits one reference PSF best in least squares.

    Three numbers: σx, σy and the centre's y (for a field along y the centre is at x = 0). Both have unit sum
    in the window, so this maximises R². Baseline of Pieroni et al. 2015, section 3.
    """
    from scipy.optimize import least_squares

    started = perf_counter()
    x, y = reference.x_um, reference.y_um
    wanted = np.asarray(reference.values, dtype=float)
    scale = np.linalg.norm(wanted)

    def misfit(parameters: np.ndarray) -> np.ndarray:
        width_x, width_y = np.exp(parameters[:2])
        difference: np.ndarray = (gaussian(x, y, width_x, width_y, parameters[2]) - wanted) / scale
        return difference.ravel()

    low, high = np.log(NARROWEST * reference.pixel_um), np.log(10 * np.ptp(x) + reference.pixel_um)
    bounds = ([low, low, y[0] - reference.pixel_um], [high, high, y[-1] + reference.pixel_um])
    trials = [least_squares(misfit, np.clip(start, *bounds), bounds=bounds) for start in _starts(reference)]
    width_x, width_y, centre = min(trials, key=lambda found: found.cost).x
    values = gaussian(x, y, np.exp(width_x), np.exp(width_y), centre)
    return replace(
        reference,
        values=values,
        method="gaussian",
        figures=replace(
            reference.figures,
            other_peaks=0,
            strehl=None,  # a fit has no pupil, and if narrower than the reference it would peak above 1
            predicted_error=1 - r_squared(values, wanted),  # measured, since the reference is at hand
        ),
        numbers=3,
        rays=0,
        sampling=Message(
            "σx {sigma_x:.3g} µm, σy {sigma_y:.3g} µm, centre {centre:.3g} µm",
            sigma_x=float(np.exp(width_x)),
            sigma_y=float(np.exp(width_y)),
            centre=float(centre),
        ),
        seconds=perf_counter() - started,
        error=None,
    )


def gaussian(x_um: np.ndarray, y_um: np.ndarray, sigma_x: float, sigma_y: float, centre_y: float) -> np.ndarray:
    """Return a sampled Gaussian of unit sum in its window, shape (y, x)."""
    across = np.exp(-np.square(x_um / sigma_x) / 2)
    along = np.exp(-np.square((y_um - centre_y) / sigma_y) / 2)
    values: np.ndarray = np.outer(along, across)
    values /= max(values.sum(), np.finfo(float).tiny)
    return values


def _starts(reference: Psf) -> Iterator[list[float]]:
    """Return starting points (log σx, log σy, centre y): about the centroid and about the peak."""
    centre = reference.values.sum(1) @ reference.y_um / reference.values.sum()
    highest = reference.y_um[np.unravel_index(reference.values.argmax(), reference.values.shape)[0]]
    for place in (float(centre), float(highest)):
        spread_x = np.sqrt((reference.values.sum(0) * reference.x_um**2).sum())
        spread_y = np.sqrt((reference.values.sum(1) * (reference.y_um - place) ** 2).sum())
        for width in WIDTHS:
            yield [np.log(max(s * width, reference.pixel_um)) for s in (spread_x, spread_y)] + [place]
