"""The colour PSF: the sum of one PSF per wavelength at its position, in CIE XYZ (handbook 9.1)."""

from collections.abc import Callable
from dataclasses import replace
from math import isfinite, pi
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from p2sf.colour.colorimetry import bands
from p2sf.colour.spectrum import Spectrum
from p2sf.conventions import UM_PER_MM
from p2sf.disc.mask_nodes import throughput
from p2sf.errors import RequestError
from p2sf.figures.colour_psf import ColourPsf
from p2sf.lens.lens import Lens, lens_range_um, seen_from
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.methods import render, whole_pixel_um
from p2sf.psf.result import Psf
from p2sf.psf.seidel import check_focus, suitable_pixel_um
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.field_geometry import cone
from p2sf.raytrace.pencil import Sources, pencil, rays_through
from p2sf.threads import one_blas_thread

COUNT = 21  # bands of a continuous spectrum: neighbours then differ by some 12 nm
MOST = 400
PASSING = 6, 20  # nodes over the pupil, across which absorption changes slowly
TRIED = 9  # wavelengths that determine the width of a window

Renderer = Callable[[Lens, Source, int, float], Psf]
"""A function that renders one PSF: (lens, source at one wavelength, pixels, µm per pixel)."""


@one_blas_thread
def colour_psf(
    lens: Lens,
    source: Source,
    spectrum: Spectrum,
    window: tuple[int, float],
    method: str | Renderer = "auto",
    count: int = COUNT,
) -> ColourPsf:
    """Return the PSF of a point with this spectrum over (pixels, µm per pixel), centred on the source's own wavelength.

    ``method``: the name of a method, or a function that renders one PSF. The PSF of each wavelength is shifted to where
    its chief ray lands (lateral colour), by linear interpolation, which keeps light and sign. Raises RequestError for a
    count outside its range, GlassError for a line outside the data of a glass.
    """
    started = perf_counter()
    if not 1 <= count <= MOST:
        raise RequestError(
            "{count} wavelengths for a colour PSF; give a whole number from 1 to {most}", count=count, most=MOST
        )
    make = method if callable(method) else by_method(method)
    wavelengths, weights = bands_through(lens, source, spectrum, count)
    aside, shifts = chief_places_um(lens, source, wavelengths)
    made = [make(lens, replace(source, wavelength_um=float(wave)), *window) for wave in wavelengths]
    each = zip(made, shares(lens, source, made), shifts / window[1], aside / window[1], strict=True)
    layers = (shifted_up(shifted_up(share * psf.values, up).T, right).T for psf, share, up, right in each)
    xyz = np.asarray(sum(layer[..., None] * weight for layer, weight in zip(layers, weights, strict=True)))
    methods = tuple(dict.fromkeys(psf.method for psf in made))
    light = None if any(psf.energy is None for psf in made) else float(xyz[..., 1].sum())
    seconds = perf_counter() - started
    return ColourPsf(xyz, window[1], spectrum.name, wavelengths, shifts, methods, seconds, light, aside)


def suitable_pitch_um(lens: Lens, source: Source, spectrum: Spectrum, pixels: int, stop: Stop | None = None) -> float:
    """Return the pitch at which the window shows the PSF of every colour, lateral colour included, µm.

    Raises GeometryError if the image of the source's own colour lies at infinity.
    """
    own = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um, stop)
    check_focus(cone(lens, source, stop).na)
    waves, _ = bands_through(lens, source, spectrum, TRIED)
    if lens.misaligned or not np.isfinite(own.w40):
        each = [whole_pixel_um(lens, replace(source, wavelength_um=float(wave)), pixels) for wave in waves]
        return float(np.max(each + 2 * np.abs(chief_places_um(lens, source, waves)).max(0) / pixels))
    c = coefficients(lens, source.depth_mm, source.field_slope, waves, stop)
    shift = np.abs(chief_places_um(lens, source, waves)).max(0)
    return float(np.max(suitable_pixel_um(c, pixels) + 2 * shift / pixels))


def by_method(method: str) -> Renderer:
    """Return the function that renders by a method of this name."""
    return lambda lens, source, pixels, pixel_um: render(lens, source, method, pixels, pixel_um)


def bands_through(lens: Lens, source: Source, spectrum: Spectrum, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the `bands` of a spectrum within the data of all glasses, weighted by transmission, ΣY = 1."""
    known = lens_range_um(lens)
    waves, weights = bands(spectrum, count, *((known,) if known else ()))
    if any(lens.absorbs):
        weights = weights * [[_passing_share(lens, replace(source, wavelength_um=float(wave)))] for wave in waves]
        weights /= weights[:, 1].sum()
    return waves, weights


def _passing_share(lens: Lens, source: Source) -> float:
    """Return the transmission of surfaces and media for the light that enters the pupil."""
    nodes = pupil_nodes(lens, source, PASSING)
    rays = rays_through(lens, source, nodes)
    light, entering = rays.share * rays.light, rays.share * rays.launch * np.square(rays.mask)
    return float(light.sum() / entering.sum())


def shares(lens: Lens, source: Source, made: list[Psf]) -> np.ndarray:
    """Return the share of all its light that the PSF of each wavelength has in the window.

    All by one rule, so that wavelengths are weighted alike: ``energy`` if every PSF has it, else `estimated_share`.
    """
    known = [float(psf.energy) for psf in made if psf.energy is not None]
    if len(known) == len(made):
        return np.minimum(1.0, known)
    each = [(psf, cone(lens, replace(source, wavelength_um=float(psf.wavelength_um))).na) for psf in made]
    spreading = throughput(lens.mask).spreading
    return np.array([estimated_share(psf, na, spreading) for psf, na in each])


def estimated_share(psf: Psf, na: float, spreading: float = 1.0) -> float:
    """Return Σ samples·π(NA·pixel/λ)² as `seidel.energy_fraction` does, even if samples are too far apart for it.

    ``spreading``: that of the pupil mask (`mask_nodes.Throughput`).
    """
    units = psf.over_unaberrated
    total = np.nan if units is None else float(units.sum())
    if not isfinite(total):
        return 1.0 if psf.energy is None else min(1.0, float(psf.energy))
    return min(1.0, total * pi * (na * psf.pixel_um / float(psf.wavelength_um)) ** 2 / spreading)


def chief_shifts_um(lens: Lens, source: Source, wavelengths_um: ArrayLike) -> np.ndarray:
    """Return the height of the exact chief ray of each wavelength above that of the source, µm: lateral colour."""
    shift: np.ndarray = chief_places_um(lens, source, wavelengths_um)[1]
    return shift


def chief_places_um(lens: Lens, source: Source, wavelengths_um: ArrayLike) -> np.ndarray:
    """Return x and y of the chief ray of each wavelength relative to that of the source, (2, wavelengths) µm.

    In the axes of the source's image: in a symmetric lens x is 0.
    """
    waves = np.append(np.asarray(wavelengths_um, dtype=float), source.wavelength_um)
    every = Sources(source.depth_mm, source.field_slope, waves)  # one trace for all wavelengths
    rays = pencil(seen_from(lens, source.azimuth_deg), every, np.zeros(1), np.zeros(1))
    landed = np.stack(np.broadcast_arrays(rays.chief_x, rays.chief_y))[..., 0]
    places: np.ndarray = UM_PER_MM * (landed[:, :-1] - landed[:, -1:])
    return places


def shifted_up(values: np.ndarray, rows: float) -> np.ndarray:
    """Return samples shifted up by a number of rows, by linear interpolation; light that leaves the window is lost."""
    whole = int(np.floor(rows))
    part = rows - whole
    return (1 - part) * _move_rows(values, whole) + (part * _move_rows(values, whole + 1) if part else 0.0)


def _move_rows(values: np.ndarray, rows: int) -> np.ndarray:
    out = np.zeros_like(values)
    count = len(values)
    if abs(rows) < count:
        out[max(0, rows) : count + min(0, rows)] = values[max(0, -rows) : count - max(0, rows)]
    return out
