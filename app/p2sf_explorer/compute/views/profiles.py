"""Sections of the PSF through the chief ray, and its encircled energy."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from math import prod

import numpy as np

from p2sf.errors import P2SFError
from p2sf.figures.perfect import airy_curves
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.psf.fitted import fit
from p2sf.psf.measures import energy_in
from p2sf.psf.result import Psf
from p2sf.psf.seidel_stack import as_fit
from p2sf.pupil.plane_waves import counts_for
from p2sf.pupil.seen_mask import mask_seen
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.measured import (
    MeasureRequest,
    energy_is_live,
    measure_request,
    measured_parts,
    takes_long,
)

POINTS = {"preview": 257, "settled": 513}
NOTHING, LATER = Message(""), Message("the energy follows when the slider rests")
MOST_NODES = 500_000  # of a half disc: more takes a tenth of a second


@dataclass(frozen=True, eq=False)
class ProfileCurves:
    """Positions in µm from the chief ray; PSF along x and along y over its peak, and the Airy pattern.

    ``energy`` and ``perfect_energy``: share of all light within |position| of the centroid, of this picture's pupil and
    of the same pupil without aberration; ``clear_energy``: of a perfect lens with nothing in its stop. Where the energy
    is too slow for a frame it is NaN, and ``pending`` asks for it. ``radii_um``: what holds half and 80 % of the light,
    and the RMS distance of rays; ``method``: what described the pupil, or why there is no energy. ``highest``: of the
    picture, in units of the unaberrated peak; ``rough``: whether sections too slow for a frame may follow its samples.
    """

    position_um: np.ndarray
    along_x: np.ndarray
    along_y: np.ndarray
    airy: np.ndarray
    energy: np.ndarray
    perfect_energy: np.ndarray
    clear_energy: np.ndarray
    radii_um: tuple[float, float, float] = (np.nan, np.nan, np.nan)
    method: Message = NOTHING
    pending: MeasureRequest | None = None
    highest: float = 0.0
    rough: bool = False

    def __eq__(self, other: object) -> bool:
        """Return whether all is equal: the same question has one answer."""
        if not isinstance(other, ProfileCurves):
            return NotImplemented
        return all(_same(getattr(self, each.name), getattr(other, each.name)) for each in fields(self))


def _same(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=True)
    return one == other


def profiles(live: Live) -> View[ProfileCurves]:
    """Return sections finer than the picture's samples; summed at the points themselves once the sliders rest."""
    psf = live.psf
    half = (psf.values.shape[-1] // 2) * psf.pixel_um
    position, airy, perfect = airy_curves(POINTS[live.quality], half, live.airy_radius_um)
    # That between the samples takes as long to find as the picture.
    highest = float(_samples(psf).max()) if live.quality == "preview" else float(psf.strehl or 0.0)
    none = np.full(position.size, np.nan)
    masked = not live.setup.lens.mask.clear
    empty = ProfileCurves(position, none, none, airy, none, none if masked else perfect, perfect, highest=highest)
    curves = with_sections(empty, between_samples(psf, position))
    if live.quality == "preview":  # some 10 ms, of a frame's 16
        return View(replace(curves, method=LATER))
    request = measure_request(live)
    # No sum describes the density of rays, nor what rims clip.
    curves = replace(curves, rough=psf.method != "geometric" and not live.state.optics.clip)
    curves = curves if takes_long(live) else with_fine_sections(curves, request)
    try:
        if energy_is_live(live, request):
            return View(with_energy(curves, request))
    except P2SFError as error:  # the sections are there all the same
        return View(replace(curves, method=error.message))
    curves = replace(curves, pending=request)
    return View(curves, curves)


def with_sections(curves: ProfileCurves, lines: tuple[np.ndarray, np.ndarray]) -> ProfileCurves:
    """Return the curves with sections in units of the unaberrated peak, over the highest that is known."""
    peak = max(*(float(line.max()) for line in lines), curves.highest) or 1.0
    return replace(curves, along_x=lines[0] / peak, along_y=lines[1] / peak)


def with_fine_sections(curves: ProfileCurves, request: MeasureRequest) -> ProfileCurves:
    """Return the curves with sections summed at their own points, where those of the picture are rough."""
    lines = fine_lines(request, curves.position_um) if curves.rough else None
    return replace(with_sections(curves, lines) if lines else curves, rough=False)


def with_energy(curves: ProfileCurves, request: MeasureRequest) -> ProfileCurves:
    """Return the curves with the energy of a request; P2SFError where its pupil has none."""
    parts, outward = measured_parts(request), np.abs(curves.position_um)
    found, perfect = energy_in(parts, "", outward, wings=True), curves.perfect_energy
    if not request.lens.mask.clear:
        alone = [replace(part, pupil=part.pupil.without_phase()) for part in parts]
        perfect = energy_in(alone, "", outward, wings=True).fraction
    radii = found.radius_50_um, found.radius_80_um, found.rms_um
    said = Message("{method}; {note}", method=request.method, note=found.note) if found.note else request.method
    return replace(curves, energy=found.fraction, perfect_energy=perfect, radii_um=radii, method=said, pending=None)


def answer(curves: ProfileCurves, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> ProfileCurves:
    """Return the curves with the energy that they lack, and finer sections where these are rough, for a worker."""
    return with_energy(with_fine_sections(curves, curves.pending), curves.pending) if curves.pending else curves


def between_samples(psf: Psf, position: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the samples through the chief ray in units of the unaberrated peak, straight lines between them."""
    samples, (rows, columns) = _samples(psf), psf.values.shape
    row, column = samples[rows // 2], samples[:, columns // 2]
    return np.interp(position, psf.x_um, row), np.interp(position, psf.x_um, column)


def _samples(psf: Psf) -> np.ndarray:
    """Return the samples in units of the unaberrated peak, where that is unknown in units of the highest."""
    units = psf.over_unaberrated
    return psf.values / (float(psf.values.max()) or 1.0) if units is None else units


def fine_lines(request: MeasureRequest, position: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Return |field|² along x and along y in units of the unaberrated peak.

    None where rays are lost, and where a sum would take too long.
    """
    lens, source = request.lens, request.source
    try:
        six = Coefficients(*map(np.asarray, request.six)) if request.six else None
        found = as_fit(six, mask_seen(lens, source)) if six else fit(lens, source)
    except P2SFError:  # rays are lost: only the picture's own samples remain
        return None
    counts = counts_for(found.steepness, abs(float(position[0])))
    if prod(counts) / 2 > MOST_NODES:
        return None
    waves = found.sample(counts).waves
    middle = np.zeros(1)
    return waves.intensity(position, middle)[0], waves.intensity(middle, position)[:, 0]
