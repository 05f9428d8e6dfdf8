"""The measures of one source by one method, from the pupil: which pupils, their weights, and what is read off them.

A spectrum is a sum of pupils, each with its share of the light and the place where its chief ray lands, as the colour
PSF has them (`p2sf.psf.polychromatic`); a single wavelength is a sum of one.

See handbook 6.3.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import number_list
from p2sf.colour.spectrum import Spectrum
from p2sf.conventions import UM_PER_MM
from p2sf.disc.mask import CLEAR
from p2sf.errors import RequestError
from p2sf.figures.energy import EncircledLight, LandingPoints, energy_of, radius_of
from p2sf.figures.measures import PARTS, Energy, LineSpread, Mtf
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Alternatives
from p2sf.psf.choosing import choose
from p2sf.psf.methods import AUTO, METHODS
from p2sf.pupil.frequency_pupil import (
    FrequencyPupil,
    rotate_frequencies,
)
from p2sf.threads import never, one_blas_thread

if TYPE_CHECKING:
    from p2sf.figures.transfer import OtfSlice

FREQUENCIES = 257
COLOURS = 21  # wavelengths of a continuous spectrum, as the colour PSF has them
SHOWN = 4.0  # RMS radii, and periods of the cut-off, that a line spread is shown over
POINTS = 513


@dataclass(frozen=True, eq=False)
class PupilPart:
    """One wavelength's pupil, its share of the light, and how far above and beside the chief ray it lands, µm.

    That chief ray is the one of the source's own wavelength.
    """

    pupil: FrequencyPupil
    share: float = 1.0
    shift_um: float = 0.0
    aside_um: float = 0.0

    @property
    def centroid_um(self) -> float:
        """Return where the light's centroid lies along y, µm from the source's chief ray."""
        return self.pupil.centroid_um + self.shift_um

    @property
    def centroid_x_um(self) -> float:
        """Return where the light's centroid lies along x, µm from the source's chief ray."""
        return self.pupil.centroid_x_um + self.aside_um


Parts = Sequence[PupilPart]


def pupil_of(
    lens: Lens, source: Source, method: str = "traced", clip: bool = False, turn_deg: float = 0.0
) -> tuple[FrequencyPupil, str]:
    """Return the pupil that a method describes, and the method; "huygens" is "traced", the same rays.

    ``turn_deg``: by how much its axes are turned from those of the source's image, from +y towards +x.
    Raises GeometryError where rays do not reach the sensor, RequestError for a method that knows no pupil.
    """
    known = {each.name: each.over_frequency for each in METHODS if each.over_frequency}
    if method not in (AUTO, *known):
        raise RequestError(
            'method "{method}" describes no pupil; choose {methods}',
            method=method,
            methods=Alternatives((AUTO, *known)),
        )
    if method == AUTO:
        method = choose(lens, source, clip=clip).method
    return known[method](lens, source, clip, turn_deg), method


def _predicted_error(parts: "Parts") -> float:
    return min(sum(part.share * part.pupil.predicted_error for part in parts), 1.0)


@one_blas_thread
def parts_of(
    lens: Lens,
    source: Source,
    method: str = "traced",
    clip: bool = False,
    spectrum: Spectrum | None = None,
    turn_deg: float = 0.0,
    check: Callable[[FrequencyPupil], object] = lambda _: None,
) -> tuple[list[PupilPart], str]:
    """Return the pupils of a source by one method, of a spectrum one per wavelength, weighted by the eye's CIE Y.

    ``check`` is called with each of them, before the next is traced, and may refuse it.
    """
    from p2sf.psf.polychromatic import bands_through, chief_places_um

    if spectrum is None:
        pupil, used = pupil_of(lens, source, method, clip, turn_deg)
        return [PupilPart(pupil)], used
    waves, xyz = bands_through(lens, source, spectrum, COLOURS)
    share, (right, up) = xyz[:, 1] / xyz[:, 1].sum(), chief_places_um(lens, source, waves)
    aside, shifts = rotate_frequencies(right, up, turn_deg)
    found = []
    for wave, part, shift, beside in zip(waves, share, shifts, aside, strict=True):
        pupil, used = pupil_of(lens, replace(source, wavelength_um=float(wave)), method, clip, turn_deg)
        check(pupil)
        found.append(PupilPart(pupil, float(part), float(shift), float(beside)))
    return found, used


def centroid_of(parts: Parts) -> float:
    """Return the centroid of all parts' light along y, µm from the source's chief ray."""
    return sum(part.share * part.centroid_um for part in parts)


def centroid_x_of(parts: Parts) -> float:
    """Return the centroid of all parts' light along x, µm from the source's chief ray."""
    return sum(part.share * part.centroid_x_um for part in parts)


@one_blas_thread
def mtf_of(
    parts: Parts,
    method: str,
    frequency_per_mm: ArrayLike | None = None,
    cancelled: Callable[[], bool] = never,
    turn_deg: float = 0.0,
) -> Mtf:
    """Return the contrast at frequencies in cycles per mm, by default FREQUENCIES even ones up to the cut-off.

    ``turn_deg``: that of the parts, to be told with the curves.
    ``cancelled`` is polled now and then and ends the work with `Cancelled`.
    """
    from p2sf.figures.transfer import otf_slices

    slices = [otf_slices(part.pupil, cancelled) for part in parts]
    if frequency_per_mm is None:
        cut_off = max(one.cut_off for both in slices for one in both)
        frequency_per_mm = np.linspace(0, UM_PER_MM * cut_off, FREQUENCIES)
    given = number_list("frequency_per_mm", frequency_per_mm)
    curves = [_transfer(parts, [both[axis] for both in slices], np.abs(given) / UM_PER_MM) for axis in (1, 0)]
    (tangential, perfect_tangential), (sagittal, perfect_sagittal) = curves
    clear = perfect_tangential, perfect_sagittal
    if not all(part.pupil.mask.clear for part in parts):
        plain = [replace(part, pupil=replace(part.pupil, mask=CLEAR)) for part in parts]
        whole = [otf_slices(part.pupil.without_phase(), cancelled) for part in plain]
        found = (_transfer(plain, [both[axis] for both in whole], np.abs(given) / UM_PER_MM)[1] for axis in (1, 0))
        clear = next(found), next(found)
    perfect = perfect_tangential, perfect_sagittal
    return Mtf(given, np.abs(tangential), np.abs(sagittal), *perfect, method, *clear, turn_deg, _predicted_error(parts))


def _transfer(parts: Parts, slices: "Sequence[OtfSlice]", frequency: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return Σ share·OTF about the centroid of all parts, and the same of the pupils without phase."""
    total, bound = np.zeros(frequency.shape, complex), np.zeros(frequency.shape)
    up, right = centroid_of(parts), centroid_x_of(parts)
    for part, one in zip(parts, slices, strict=True):
        own, perfect = one.at(frequency)
        aside = part.centroid_um - up if one.along_y else part.centroid_x_um - right
        total += part.share * own * np.exp(-2j * np.pi * aside * frequency)
        bound += part.share * perfect
    return total, bound


@one_blas_thread
def energy_in(parts: Parts, method: str, radius_um: ArrayLike | None = None, wings: bool = False) -> Energy:
    """Return the energy within radii of the centroid, by default even ones from 0 to beyond the blur.

    ``wings``: farther out it is that of a hard edge's wings, and not summed, which takes up to ten times as long.
    """
    centre, right = centroid_of(parts), centroid_x_of(parts)
    given = None if radius_um is None else np.abs(number_list("radius_um", radius_um))
    largest = 0.0 if given is None or wings else float(given.max(initial=0.0))
    found = [energy_of(part.pupil, centre - part.shift_um, right - part.aside_um, largest) for part in parts]
    radius, fraction = _common_table(parts, found)
    half, most = (radius_of(part, lambda given: _within(parts, found, given), radius, fraction) for part in PARTS)
    if given is not None:
        radius, fraction = given, _within(parts, found, given)
    departure = max((one.departure for one in found if isinstance(one, LandingPoints)), default=0.0)
    return Energy(
        radius, fraction, centre, half, most, _rms_of_rays(parts), method, departure, right, _predicted_error(parts)
    )


def _rms_of_rays(parts: Parts) -> float:
    """Return the RMS distance of all parts' rays from their common centroid, µm."""
    share = np.array([part.share for part in parts])
    x = np.array([part.pupil.spot.x_um + part.aside_um for part in parts])
    y = np.array([part.pupil.spot.y_um + part.shift_um for part in parts])
    own = np.array([part.pupil.spot.rms_um for part in parts])
    return float(np.sqrt(share @ (own**2 + (x - share @ x) ** 2 + (y - share @ y) ** 2)))


Found = Sequence[EncircledLight | LandingPoints]


def _within(parts: Parts, found: Found, radius_um: np.ndarray) -> np.ndarray:
    total: np.ndarray = np.sum(
        [part.share * one.within(radius_um) for part, one in zip(parts, found, strict=True)], axis=0
    )
    return total


def _common_table(parts: Parts, found: Found) -> tuple[np.ndarray, np.ndarray]:
    """Return a curve over radii that cover the blur of every part."""
    if len(found) == 1:
        return found[0].table()
    radius = max((one.table()[0] for one in found), key=lambda radii: float(radii[-1]))
    return radius, _within(parts, found, radius)


@one_blas_thread
def spread_of(parts: Parts, method: str, position_um: ArrayLike | None = None) -> LineSpread:
    """Return the images of a line and of an edge, by default at POINTS even positions about the centroid."""
    from p2sf.figures.transfer import otf_slices, spreads

    slices = [otf_slices(part.pupil) for part in parts]
    most = 1 / (2 * min(one.step for both in slices for one in both))
    if position_um is None:
        half = max(SHOWN * part.pupil.spot.rms_um + SHOWN / min(part.pupil.cut_off_per_um) for part in parts)
        position_um = np.linspace(-min(half, most), min(half, most), POINTS)
    position = number_list("position_um", position_um)
    _check_positions(position, most)
    found = []
    for axis in (0, 1):
        own = [both[axis] for both in slices]
        step = min(one.step for one in own)
        frequency = step * np.arange(round(max(one.cut_off for one in own) / step) + 1)
        values, perfect = _transfer(parts, own, frequency)
        found.append(spreads(values, perfect, step, position))
    (line_x, edge_x), (line_y, edge_y) = found
    return LineSpread(position, line_x, line_y, edge_x, edge_y, centroid_of(parts), method, centroid_x_of(parts))


def _check_positions(position_um: np.ndarray, most: float) -> None:
    """Raise RequestError for positions beyond ``most``, from where on a sum over frequencies repeats itself."""
    if np.abs(position_um).max(initial=0.0) > most:
        raise RequestError(
            "{parameter} reaches {value:.4g} µm, and this line spread is known up to {most:.4g} µm from its centroid; "
            "give positions within that",
            parameter="position_um",
            value=float(np.abs(position_um).max()),
            most=most,
        )
