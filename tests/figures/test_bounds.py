"""What a least R² means for MTF and R80, against errors that were made."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.figures.bounds import mtf_error, r80_sensitivity
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.methods import render

LENS = with_f_number(find_lens("double_gauss_28"), 8.0)


def picture(method: str):
    return render(LENS, Source(field_deg=7.0), method, 64, 0.8)


def r80(values: np.ndarray) -> float:
    """Return the radius of 80 % of the light about its centroid, pixels, by sorting."""
    light = values / values.sum()
    rows, columns = np.indices(light.shape)
    distance = np.hypot(rows - (light * rows).sum(), columns - (light * columns).sum()).ravel()
    order = np.argsort(distance)
    return float(np.interp(0.8, np.cumsum(light.ravel()[order]), distance[order]))


@pytest.mark.parametrize("method", ["seidel", "fitted"])
def test_the_mtf_errs_by_no_more_than_r2_allows(method):
    """A bound: FFTs of the two pictures, all frequencies, on the window both share."""
    exact, rough = picture("traced"), picture(method)
    assert exact.values.shape == rough.values.shape
    q, p = (psf.values / psf.values.sum() for psf in (exact, rough))
    mtfs = [np.abs(np.fft.fft2(x)) for x in (q, p)]
    made = np.linalg.norm(mtfs[1] - mtfs[0]) / np.linalg.norm(mtfs[0])
    assert made <= mtf_error(1 - r_squared(p, q)) * (1 + 1e-6)


@pytest.mark.parametrize("scale", [0.9, 0.97, 1.03, 1.1])
def test_r80_errs_by_no_more_than_r2_allows(scale):
    """A Gaussian beside a slightly wider one, whose R80 are their σ times √(2 ln 5); the bound is of first order."""
    x = np.arange(-64, 65)
    square = x**2 + x[:, None] ** 2
    q, p = (np.exp(-square / (2 * sigma**2)) for sigma in (9.0, 9.0 * scale))
    psf = replace(picture("seidel"), values=q / q.sum())
    made = abs(r80(p) / r80(q) - 1)
    allowed = r80_sensitivity(psf) * mtf_error(1 - r_squared(p / p.sum(), q / q.sum()))
    assert made == pytest.approx(abs(scale - 1), abs=0.006), "to a sixteenth of a pixel"
    assert made <= allowed <= 10 * made, "a bound, and not an empty one"
