"""Figures of a wavefront that is given as an array over the pupil: contrast, energy, spreads, terms (handbook 6.3).

The transfer function is the autocorrelation of the pupil over its cells (Goodman 2005, eq. 6-28), by FFT; along an axis
it is the sum of those of all rows or columns. Energy within a radius is that of the cells' field on circles, which
needs no window: it is that of all light.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, number_list, real_array
from p2sf.conventions import UM_PER_MM
from p2sf.disc.domain import WHOLE, ClearNodes
from p2sf.disc.quadrature import cell_areas, even_count
from p2sf.disc.zernike_terms import ZernikeOrder, zernike_terms, zernike_values
from p2sf.errors import RequestError, SamplingError
from p2sf.figures.energy import EncircledLight, circles_of, energy_on_circles, light_of_cells, radius_of
from p2sf.figures.line_sums import LagSums
from p2sf.figures.measures import PARTS, Energy, LineSpread, Mtf
from p2sf.figures.perfect import circle_contrast
from p2sf.figures.transfer import OtfSlice, spreads
from p2sf.parameters import check_positive
from p2sf.psf.from_opd import Cells, cells_of, centres, psf_of_cells
from p2sf.psf.result import Psf, warn_of_window
from p2sf.pupil.zernike_fit import USUAL_TERMS, ZernikeFit, decompose
from p2sf.threads import one_blas_thread

FREQUENCIES, RADII, POINTS = 257, 129, 513
SMALLEST = 1e-12  # of a contrast: below, it is rounding
MOST_SAMPLES = 64  # a side, of the PSF whose peak is looked for
METHOD = "opd"


@dataclass(frozen=True, eq=False, init=False)
class Pupil:
    """A wavefront over a pupil, measured or imported, and its figures, which are of all light and need no window.

    `Pupil.from_opd` makes it of an array; it is not made by its own name, which raises RequestError.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> at = (2 * np.arange(128) - 127) / 128
    >>> spherical = 0.3 * (at**2 + at[:, None] ** 2) ** 2
    >>> pupil = p2sf.Pupil.from_opd(spherical, na=0.1, wavelength_nm=500)
    >>> pupil.mtf([100, 200]).tangential.round(2), pupil.encircled_energy([5.0]).fraction.round(2)
    (array([0.54, 0.26]), array([0.83]))
    >>> round(pupil.strehl, 2), round(pupil.zernike(terms=11).marechal, 2)
    (0.72, 0.73)
    """

    cells: Cells

    def __init__(self, *given: object, **named: object) -> None:
        raise RequestError("a pupil is made by p2sf.Pupil.from_opd(opd_waves, na, wavelength_nm)")

    @classmethod
    @check_arguments
    def from_opd(
        cls, opd_waves: ArrayLike, na: float, wavelength_nm: float, amplitude: ArrayLike | None = None
    ) -> "Pupil":
        """Return the pupil of a wavefront that is given as an array.

        Parameters
        ----------
        opd_waves : array_like
            W in waves on the cells of a square grid, (size, size), as `p2sf.psf_of_opd` has it; NaN is opaque.
        na : float
            Numerical aperture n'·sin u' of the image at the pupil's rim.
        wavelength_nm : float
            Wavelength, nm.
        amplitude : array_like, optional
            Amplitude that each cell lets through, same shape; how much of it the unit disc covers when not given.

        Returns
        -------
        Pupil
            With ``psf``, ``strehl``, ``mtf``, ``encircled_energy``, ``line_spread`` and ``zernike``.

        Raises
        ------
        RequestError, SamplingError
            As for `p2sf.psf_of_opd`.
        """
        pupil = object.__new__(cls)
        object.__setattr__(pupil, "cells", cells_of(opd_waves, na, wavelength_nm, amplitude))
        return pupil

    @check_arguments
    @one_blas_thread
    def psf(self, pixels: int = 64, pixel_um: float | None = None, integrated: bool | None = None) -> Psf:
        """Return the PSF, as `p2sf.psf_of_opd` computes it."""
        check_positive("pixel_um", pixel_um)
        return warn_of_window(psf_of_cells(self.cells, pixels, pixel_um, integrated), 5)

    @property
    def strehl(self) -> float:
        """Return the peak of the PSF over that of the same pupil without phase."""
        found = self.psf(min(MOST_SAMPLES, 2 * len(self.cells.opd)), integrated=False).strehl
        assert isinstance(found, float)
        return found

    def zernike(self, basis: ZernikeOrder = "noll", terms: int = USUAL_TERMS) -> ZernikeFit:
        """Return the terms of the wavefront where light passes, as `p2sf.fit_zernike` does, weighted by the light."""
        return fit_zernike(self.cells.opd, self.cells.light, terms, basis)

    @one_blas_thread
    def mtf(self, frequency_per_mm: ArrayLike | None = None) -> Mtf:
        """Return the contrast at frequencies, cycles per mm, by default even ones up to the cut-off.

        ``predicted_error``: how far the same cells are from the contrast of a disc.
        """
        if frequency_per_mm is None:
            frequency_per_mm = np.linspace(0, UM_PER_MM * self._along_y.cut_off, FREQUENCIES)
        given = number_list("frequency_per_mm", frequency_per_mm)
        frequency = np.abs(given) / UM_PER_MM
        (tangential, over_y), (sagittal, over_x) = (one.at(frequency) for one in (self._along_y, self._along_x))
        clear = circle_contrast(frequency / self._along_y.cut_off)
        own = np.abs(tangential), np.abs(sagittal), over_y, over_x
        return Mtf(given, *own, METHOD, clear, clear, predicted_error=self._disc_error)

    @one_blas_thread
    def encircled_energy(self, radius_um: ArrayLike | None = None) -> Energy:
        """Return the share of all light within radii, µm, of the centroid, by default even ones.

        Raises RequestError for a radius at which the PSF of these cells begins to repeat itself.
        """
        most = 1 / (2 * self.cells.step)
        given = np.linspace(0, most, RADII) if radius_um is None else np.abs(number_list("radius_um", radius_um))
        self._check_reach("radius_um", given, most)
        within, table = self._energy.within, np.linspace(0, most, RADII)
        half, most = (radius_of(part, within, table, within(table)) for part in PARTS)
        y, x = self._along_y_centroid, self._along_x_centroid
        fraction = np.clip(self._energy.within(given), 0.0, 1.0)
        made = given, fraction, y, half, most, self._rms_um, METHOD
        return Energy(*made, centroid_x_um=x, predicted_error=self._disc_error)

    @one_blas_thread
    def line_spread(self, position_um: ArrayLike | None = None) -> LineSpread:
        """Return the images of a line and of an edge at distances, µm, from the centroid, by default even ones.

        Raises RequestError for a position at which the PSF of these cells begins to repeat itself.
        """
        most = 1 / (2 * self.cells.step)
        given = np.linspace(-most, most, POINTS) if position_um is None else number_list("position_um", position_um)
        self._check_reach("position_um", given, most)
        (line_x, edge_x), (line_y, edge_y) = (
            spreads(one.values, one.perfect, one.step, given) for one in (self._along_x, self._along_y)
        )
        return LineSpread(given, line_x, line_y, edge_x, edge_y, self._along_y_centroid, METHOD, self._along_x_centroid)

    @cached_property
    def _field(self) -> np.ndarray:
        field: np.ndarray = self.cells.clear * np.exp(2j * np.pi * self.cells.opd)
        return field

    @property
    def _light(self) -> float:
        return float(self.cells.light.sum())

    @cached_property
    def _along_x_centroid(self) -> float:
        return self._centroid(1)

    @cached_property
    def _along_y_centroid(self) -> float:
        return self._centroid(0)

    def _centroid(self, axis: int) -> float:
        """Return the light's centroid along an axis, µm: the slope of the transfer function at no frequency."""
        before, after = np.moveaxis(self._field, axis, 0)[:-1], np.moveaxis(self._field, axis, 0)[1:]
        return -float(np.angle(np.vdot(before, after))) / (2 * np.pi * self.cells.step)

    @cached_property
    def _rms_um(self) -> float:
        """Return the RMS distance from the centroid of where the wavefront's slopes send light."""
        total = 0.0
        for axis in (0, 1):
            wave, light = (np.moveaxis(part, axis, 0) for part in (self.cells.opd, self.cells.light))
            both = light[1:] * light[:-1] > 0
            slope, weight = np.diff(wave, axis=0)[both], (light[1:] + light[:-1])[both]
            place = -slope / self.cells.step
            total += float(weight @ (place - weight @ place / weight.sum()) ** 2 / weight.sum())
        return float(np.sqrt(total))

    @cached_property
    def _along_x(self) -> OtfSlice:
        return self._slice(1, self._along_x_centroid)

    @cached_property
    def _along_y(self) -> OtfSlice:
        return self._slice(0, self._along_y_centroid)

    def _slice(self, axis: int, centroid_um: float) -> OtfSlice:
        """Return the transfer function along an axis about the centroid, and that of the pupil without phase."""
        size = len(self._field)
        own, perfect = (_autocorrelation(np.moveaxis(part, axis, -1)) for part in (self._field, np.abs(self._field)))
        own[0] = perfect[0] = self._light
        turn = np.exp(2j * np.pi * centroid_um * self.cells.step * np.arange(size + 1))
        factor = self._disc_factor(axis) / self._light
        return OtfSlice(self.cells.step, own * turn * factor, perfect.real * factor, axis == 0)

    @cached_property
    def _disc_error(self) -> float:
        """Return how far sums over the cells are from the contrast of a clear disc."""
        exact = circle_contrast(np.linspace(0, 1, len(self._field) + 1))
        return max(float(np.abs(self._disc(axis) - exact).max()) for axis in (0, 1))

    @property
    def _areas(self) -> np.ndarray:
        at = centres(len(self._field))
        return cell_areas(at, at, 2 / at.size)

    def _disc(self, axis: int) -> np.ndarray:
        """Return the contrast of a clear disc along an axis by the sums over its cells, (size + 1,)."""
        area = self._areas
        found = _autocorrelation(np.moveaxis(area, axis, -1)).real
        found[0] = area.sum()
        contrast: np.ndarray = found / found[0]
        return contrast

    def _disc_factor(self, axis: int) -> np.ndarray:
        """Return what takes the cells' error away from a clear disc, 1 for what is none."""
        exact = circle_contrast(np.linspace(0, 1, len(self._field) + 1))
        if not np.array_equal(self.cells.clear, self._areas):
            return np.ones_like(exact)
        disc = self._disc(axis)
        factor: np.ndarray = np.divide(exact, disc, out=np.ones_like(exact), where=disc > SMALLEST)
        return factor

    @cached_property
    def _energy(self) -> EncircledLight:
        """Return the energy about the centroid up to where the PSF of the cells repeats itself."""
        place = np.pi * centres(len(self._field)) * len(self._field) / 2
        top, centroid = 1 / (2 * self.cells.step), (self._along_x_centroid, self._along_y_centroid)
        across, up = (np.exp(1j * place * distance / top) for distance in centroid)
        reach = np.hypot(place, place[:, None])[self.cells.light > 0].max()
        circles = circles_of(even_count(float(reach) / (2 * np.pi)), WHOLE)
        # What cells bring that let a part of their light through.
        even = self._light - float(np.vdot(self._field, self._field).real)
        square = light_of_cells(self._field * across * up[:, None], circles)
        return energy_on_circles(square, circles, top, self.cells.step**2 / self._light, even)

    def _check_reach(self, name: str, values: np.ndarray, most: float) -> None:
        if np.abs(values).max(initial=0.0) > most * (1 + 1e-9):
            raise RequestError(
                "{parameter} reaches {value:.4g} µm, and a wavefront on {size} cells repeats its PSF beyond {most:.4g} "
                "µm; give it on a finer grid",
                parameter=name,
                value=float(np.abs(values).max()),
                size=len(self._field),
                most=most,
            )


def _autocorrelation(lines: np.ndarray) -> np.ndarray:
    """Return Σ line(j + k)·line(j)* over all lines, (lines, size), at the lags k = 0 … size."""
    size = lines.shape[-1]
    sums = LagSums(size)
    sums.add(lines)
    return sums.at_lags(size)


@check_arguments
@one_blas_thread
def fit_zernike(
    opd_waves: ArrayLike, mask: ArrayLike | None = None, terms: int = USUAL_TERMS, basis: ZernikeOrder = "noll"
) -> ZernikeFit:
    """Fit Zernike terms to a wavefront that is given as an array over the pupil, by least squares.

    Parameters
    ----------
    opd_waves : array_like
        W in waves on the cells of a square grid over the pupil, (size, size), as `p2sf.psf_of_opd` has it: rows towards
        +η, columns towards +ξ. A cell that is NaN does not count.
    mask : array_like, optional
        Which cells count, or the weight of each, 0 or more, same shape; how much of it the unit disc covers when not
        given, and of what the disc covers as much.
    terms : int
        Number of terms, from the first.
    basis : {"noll", "fringe"}
        Noll's order with waves RMS, or the Fringe order of 37 terms with peak waves.

    Returns
    -------
    ZernikeFit
        ``waves``: the terms, as defined on the disc, whose sum is nearest to the wavefront; ``rms_waves``: the RMS that
        each adds to those before it over the cells in force (Mahajan & Dai 2007), which is the same on a whole disc.
        RMS, residual and Maréchal's Strehl ratio are those of these cells.

    Raises
    ------
    RequestError
        For an order or a number of terms that does not exist.
    SamplingError
        For arrays that are no equal squares, and for fewer cells than terms.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> at = (2 * np.arange(64) - 63) / 64
    >>> coma = 0.1 * np.sqrt(8) * (3 * (at**2 + at[:, None] ** 2) - 2) * at[:, None]
    >>> found = p2sf.fit_zernike(coma, terms=8)
    >>> found.terms[6].name, round(float(found.waves[6]), 6)
    ('coma', 0.1)
    """
    opd = real_array("opd_waves", opd_waves)
    if opd.ndim != 2 or opd.shape[0] != opd.shape[1]:
        raise SamplingError("the wavefront has the shape {shape}; give a square array", shape=str(opd.shape))
    at = centres(len(opd))
    weight = cell_areas(at, at, 2 / at.size)
    if mask is not None:
        given = real_array("mask", np.asarray(mask, dtype=float), 0.0)
        if given.shape != opd.shape:
            raise SamplingError(
                "the amplitude has the shape {shape} and the wavefront {wavefront}; give both on the same cells",
                shape=str(given.shape),
                wavefront=str(opd.shape),
            )
        weight = np.where(weight > 0, given, 0.0)
    known = zernike_terms(basis, terms)
    weight = np.where(np.isfinite(opd), weight, 0.0)
    inside = weight > 0
    if int(inside.sum()) < len(known) or (weight < 0).any():
        raise SamplingError(
            "{cells} cells of the pupil count, too few for {terms} terms; give more, with weights of 0 or more",
            cells=int(inside.sum()),
            terms=len(known),
        )
    xi, eta = (axis[inside] for axis in np.meshgrid(at, at))
    share = float(np.minimum(weight, cell_areas(at, at, 2 / at.size)).sum() / cell_areas(at, at, 2 / at.size).sum())
    nodes = ClearNodes(xi, eta, weight[inside] / weight.sum(), share, domain=WHOLE)
    made = decompose(nodes, opd[inside], basis, known)
    root = np.sqrt(nodes.weight)
    scale = np.array([term.norm if basis == "fringe" else 1.0 for term in known])
    fitted, *_ = np.linalg.lstsq((zernike_values(known, xi, eta) * root).T, root * opd[inside], rcond=None)
    return replace(made, waves=fitted * scale, rays=0)
