"""The light that square pixels receive, for files that others read: a finer PSF, added up over each pixel.

Samples farther apart than λ/(4 NA) miss the rings between them, and none stands for the light around it (handbook 6.6).
"""

from collections.abc import Callable
from dataclasses import replace
from math import ceil

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.gaussian_fit import gaussian_psf
from p2sf.psf.methods import render, whole_pixel_um
from p2sf.psf.result import Psf
from p2sf.psf.seidel import check_samples
from p2sf.pupil.binning import binned

LARGEST = 2048  # fine samples a side: beyond, sums take minutes
ROUNDING = 1e-9


def critical_pixel_um(wavelength_um: float | np.ndarray, na: float | np.ndarray) -> np.ndarray:
    """Return λ/(4 NA), µm, up to which samples hold all of a PSF.

    An incoherent image holds no frequency above 2NA/λ (Goodman 2005, §6.3).
    """
    critical: np.ndarray = np.asarray(wavelength_um) / (4 * np.asarray(na))
    return critical


def samples_across(pixels: int, pixel_um: float, finest_um: float) -> int:
    """Return an odd number of samples across each pixel, within half of ``finest_um`` of each other; 1 for points.

    A sum over samples errs at the pixel's edges alone, by their pitch to the fourth power: in the middle of an Airy
    pattern by 4e-3 with 5 samples at ``finest_um``, 3e-4 at half. So far apart they are where that takes more than
    LARGEST a side, and at points where even this does, as where pixels are as narrow as ``finest_um``.
    """
    ratio = pixel_um / finest_um * (1 - ROUNDING)
    counts = (ceil(2 * ratio) | 1, ceil(ratio) | 1) if ratio > 1 else ()
    return next((across for across in counts if fine_side(pixels, across) <= LARGEST), 1)


def fine_side(pixels: int, across: int) -> int:
    """Return the samples a side whose first ``pixels``·``across`` cover the pixels.

    Sample N//2 is the chief ray in either grid, so an even number of pixels begins half a pixel lower.
    """
    return pixels * across + (0 if pixels % 2 else across - 1)


def light_per_pixel(fine: np.ndarray, pixels: int, across: int) -> np.ndarray:
    """Return the light per pixel, (…, pixels, pixels), of `fine_side` samples a side."""
    count = pixels * across
    planes = fine.reshape(-1, *fine.shape[-2:])[:, :count, :count]
    light = np.stack([binned(plane, pixels, across) for plane in planes])
    return light.reshape(*fine.shape[:-2], pixels, pixels)


def integrated(render_at: Callable[[int, float], Psf], pixels: int, pixel_um: float, finest_um: float) -> Psf:
    """Return the PSF that ``render_at(samples, µm)`` makes, as light per pixel where the pitch exceeds ``finest_um``.

    Where that takes more than ``LARGEST`` samples a side they are those of ``render_at``, and not ``integrated``.
    """
    check_samples(pixels, pixel_um)
    across = samples_across(pixels, pixel_um, finest_um)
    if across == 1:
        return render_at(pixels, pixel_um)
    fine = render_at(fine_side(pixels, across), pixel_um / across)
    light = light_per_pixel(fine.values, pixels, across)
    share = light.sum((-2, -1))  # of the light in the finer window, which may be a little larger
    return replace(
        fine,
        values=light / share[..., None, None],
        pixel_um=pixel_um,
        energy=None if fine.energy is None else fine.energy * (share if share.ndim else float(share)),
        sampling=Message("{sampling}; {across} × {across} samples per pixel", sampling=fine.sampling, across=across),
        tolerance=None,
        integrated=True,
    )


def render_integrated(
    lens: Lens,
    source: Source,
    method: str = "auto",
    pixels: int = 64,
    pixel_um: float | None = None,
    tolerance: float = 0.99,
) -> Psf:
    """Return `methods.render`'s PSF, as light per pixel where the pitch exceeds λ/(4 NA). Raises P2SFError as it."""
    check_samples(pixels, pixel_um)
    if method == "gaussian":  # fitted to what pixels see
        return gaussian_psf(render_integrated(lens, source, "huygens", pixels, pixel_um))
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return integrated(
        lambda count, pitch: render(lens, source, method, count, pitch, tolerance=tolerance),
        pixels,
        pixel_um or whole_pixel_um(lens, source, pixels),
        float(critical_pixel_um(c.wavelength_um, c.na)),
    )
