"""NPUPIL against NPSF: what the two sample counts of the paper's FFT cost in error, at one point of a lens.

The paper (Pieroni et al. 2015) asks for NPUPIL ≥ 2·NPSF and leaves the rest to "a specific application analysis". Here
NPSF samples show a window of given width, NPUPIL are those of the FFT behind them, and the error is that of the picture
between its samples too: drawn finely by a spline and held to the settled sum of the same six coefficients.
"""

from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from p2sf.conventions import NM_PER_UM, centred_axis, slope_from_degrees
from p2sf.errors import SamplingError
from p2sf.figures.pixel_light import critical_pixel_um
from p2sf.lens.lens import Lens, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.psf.seidel import fft_intensity, fft_samples, seidel_psf
from p2sf.studies.paper import LENS, PIXELS, WAVELENGTH_NM, WINDOW_UM

FIELD_DEG = 10.0
NPSF = 8, 12, 16, 24, 32, 48, 64, 96, 128
NPUPIL = 16, 32, 64, 128, 256, 512, 1024, 2048
FINE = 192  # samples of the pictures that are compared
SMALLEST, LARGEST = 1e-4, 1.0  # of the drawn scale


@dataclass(frozen=True, eq=False)
class SamplingMap:
    """Errors over both counts, and what is to be marked in them.

    ``errors``: relative L2, (NPUPIL, NPSF), NaN where NPUPIL < 2·NPSF. ``rule``: for every NPSF the NPUPIL that the
    program's FFT takes, by quality; 0 where it would be too large. ``critical``: samples λ/(4 NA) apart. ``paper``: its
    NPSF, and the smallest NPUPIL that it allows with that.
    """

    lens: str
    field_deg: float
    wavelength_nm: float
    window_um: float
    npsf: tuple[int, ...]
    npupil: tuple[int, ...]
    errors: np.ndarray
    rule: dict[str, tuple[int, ...]]
    critical: float
    paper: tuple[int, int]


def sampling_map(
    lens: Lens | None = None,
    field_deg: float = FIELD_DEG,
    wavelength_nm: float = WAVELENGTH_NM,
    window_um: float = WINDOW_UM,
) -> SamplingMap:
    """Return the map of one point at infinity; by default the paper's lens, window and colour."""
    lens = with_aim(find_lens(LENS), "paraxial") if lens is None else lens
    source = Source(field_slope=float(slope_from_degrees(field_deg)), wavelength_um=wavelength_nm / NM_PER_UM)
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    truth = seidel_psf(c, FINE, window_um / FINE).values
    errors = np.array([[_error(c, n, window_um, size, truth) for n in NPSF] for size in NPUPIL])
    rule = {quality: tuple(_rule(c, n, window_um, quality) for n in NPSF) for quality in ("preview", "settled")}
    critical = window_um / float(critical_pixel_um(c.wavelength_um, c.na))
    place = lens.name, field_deg, wavelength_nm, window_um
    return SamplingMap(*place, NPSF, NPUPIL, errors, rule, critical, (PIXELS, 2 * PIXELS))


def _error(c: Coefficients, npsf: int, window_um: float, npupil: int, truth: np.ndarray) -> float:
    """Return the relative L2 error of NPSF² samples by an FFT of NPUPIL², drawn as finely as the truth."""
    if npupil < 2 * npsf:
        return float("nan")
    found = drawn_finely(fft_intensity(c, npsf, window_um / npsf, npupil), window_um)
    return float(np.linalg.norm(found - truth) / np.linalg.norm(truth))


def drawn_finely(samples: np.ndarray, window_um: float, fine: int = FINE) -> np.ndarray:
    """Return unit-sum pictures (fine, fine) by a cubic spline through samples (n, n) of the same window."""
    from scipy.interpolate import RectBivariateSpline

    axis = centred_axis(len(samples), window_um / len(samples))
    wanted = centred_axis(fine, window_um / fine)
    values: np.ndarray = RectBivariateSpline(axis, axis, samples)(wanted, wanted)
    values /= values.sum()
    return values


def _rule(c: Coefficients, npsf: int, window_um: float, quality: str) -> int:
    try:
        return fft_samples(c, npsf, window_um / npsf, quality)
    except SamplingError:  # more than the program's largest FFT
        return 0


def draw_sampling(handle: BinaryIO, found: SamplingMap) -> None:
    """Write the map as a PNG into an open binary file, the program's rule and the paper's choice marked."""
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.4), dpi=150, layout="constrained")
    axes = figure.add_subplot(xlabel="NPSF: samples across the window", ylabel="NPUPIL: samples of the FFT")
    colours = LogNorm(SMALLEST, LARGEST)
    columns, rows = np.arange(len(found.npsf)), np.arange(len(found.npupil))
    picture = axes.imshow(found.errors, origin="lower", aspect="auto", norm=colours, cmap="viridis_r")
    figure.colorbar(picture, ax=axes, label="relative L2 error between samples too")
    for row, column in np.argwhere(np.isfinite(found.errors)):
        value = found.errors[row, column]
        light = value > 0.03
        axes.text(column, row, f"{value:.1g}", ha="center", va="center", fontsize=6, color="w" if light else "k")
    for quality, line in (("preview", "--"), ("settled", "-")):
        taken = np.array(found.rule[quality], float)
        taken[taken == 0] = np.nan
        height = np.log2(taken / found.npupil[0])
        axes.plot(columns, height, line, color="C1", label=f"the program's rule, {quality}")
    critical = np.interp(np.log(found.critical), np.log(found.npsf), columns)
    axes.axvline(critical, color="C3", linewidth=1, label="samples λ/(4 NA) apart")
    paper = found.npsf.index(found.paper[0]), np.log2(found.paper[1] / found.npupil[0])
    axes.plot(*paper, "*", color="C3", markersize=14, markeredgecolor="w", label="the paper: 32, NPUPIL = 2·NPSF")
    axes.set_xticks(columns, [str(n) for n in found.npsf])
    axes.set_yticks(rows, [str(n) for n in found.npupil])
    axes.set(xlim=(-0.5, columns[-1] + 0.5), ylim=(-0.5, rows[-1] + 0.5))
    place = f"{found.lens}, {found.field_deg:g}°, {found.wavelength_nm:g} nm, window {found.window_um:g} µm"
    axes.set_title(f"{place}\nsix coefficients, FFT against their settled sum", loc="left", fontsize=9)
    axes.legend(fontsize=7, loc="lower right")
    figure.savefig(handle, format="png")
