"""Measures that a lesson may claim something about, by name: each a number of the window's state. No Qt in here."""

from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING, SupportsFloat

import numpy as np

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.disc.quadrature import disc_nodes
from p2sf.disc.tilt import rms
from p2sf.figures.compare import r_squared as fidelity
from p2sf.figures.measures import Energy
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.balance import depth_of_focus_um
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import find_stop
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.measures import energy_in, mtf_of
from p2sf.psf.methods import render
from p2sf.psf.result import Psf
from p2sf.raytrace.pencil import displayed_opd
from p2sf.studies.paper import PIXELS, WINDOW_UM
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.measured import measure_request, measured_parts
from p2sf_explorer.compute.setup import ParaxialSetup, paraxial_setup
from p2sf_explorer.state.state import State, change

if TYPE_CHECKING:
    from p2sf_explorer.compute.views.image import ImageResult

CONTRAST_PER_MM = 50.0  # the frequency at which contrast is quoted: a line pair of 20 µm
FINE = 4000  # points from the middle of the PSF to its window's edge
DIRECTIONS = 720
SPIKES = np.linspace(3, 5, 21)  # Airy radii between which spikes are looked for
CORNERS = np.linspace(0.92, 0.96, 5)  # of the blur's radius, where a disc is bright and a polygon between corners dark
LEFT_OUT = 16, 40  # radii and directions of the rays
BLUE_RED_NM = 486.1327, 656.2725  # Fraunhofer's F and C

Measure = Callable[[State], float]


def of_setup(value: Callable[[ParaxialSetup], SupportsFloat]) -> Measure:
    """Return a measure of the paraxial setup."""
    return lambda state: float(value(paraxial_setup(state)))


def of_live(value: Callable[[Live], SupportsFloat]) -> Measure:
    """Return a measure of the settled answer that the panels show."""
    return lambda state: float(value(_live(state)))


@lru_cache(maxsize=64)
def _live(state: State) -> Live:
    return compute.live(state)


def coefficient(term: str) -> Measure:
    """Return the measure of one coefficient as the window shows it, waves."""
    return of_setup(lambda made: getattr(made.coefficients, term))


ASTIGMATISM = {"petzval": -0.5, "sagittal": 0.0, "tangential": 1.0}  # of W22 in the ρ² term of each focus


def focus_um(which: str) -> Measure:
    """Return where a fan comes to focus, µm behind the sensor: Δz = −2n′λW/NA² (Welford 1986, ch. 8)."""

    def shift(made: ParaxialSetup) -> SupportsFloat:
        c = made.coefficients
        waves = c.w20 + c.wd + ASTIGMATISM[which] * c.w22
        return -2 * depth_of_focus_um(c.image_index, c.wavelength_um, c.na) * waves

    return of_setup(shift)


def ray_focus_um(which: str) -> Measure:
    """Return where real rays close to the chief ray meet, µm behind the sensor."""

    def shift(state: State) -> float:
        from p2sf.raytrace.field_curves import real_foci

        made = paraxial_setup(state)
        return UM_PER_MM * float(getattr(real_foci(made.lens, made.source, made.source.field_slope, made.stop), which))

    return shift


def left_out_waves(state: State) -> float:
    """Return the RMS of what the exact wavefront has beyond that of the six coefficients, waves."""
    made, nodes = paraxial_setup(state), disc_nodes(*LEFT_OUT)
    exact = displayed_opd(made.lens, made.source, nodes.xi, nodes.eta, stop=made.stop)
    return rms(exact - wavefront(made.coefficients, nodes.xi, nodes.eta), nodes.weight, nodes.eta[None])


def distortion_percent(state: State) -> float:
    """Return how much farther out than the paraxial image the real chief ray lands, %."""
    from p2sf.raytrace.field_curves import heights

    made = paraxial_setup(state)
    return 100 * float(heights(made.lens, made.source, made.source.field_slope, made.stop).distortion)


def axial_colour_um(state: State) -> float:
    """Return how far red (C) comes to focus behind blue (F) on the axis, µm."""
    made = paraxial_setup(state)
    blue, red = (float(image_distance(made.lens, state.optics.depth_mm, nm / NM_PER_UM)) for nm in BLUE_RED_NM)
    return UM_PER_MM * (red - blue)


@lru_cache(maxsize=16)
def r_squared(state: State) -> float:
    """Return R² of the picture against the Huygens sum in the window of the picture, as the Accuracy panel does."""
    from p2sf_explorer.compute.reference import measure

    return measure(_live(state), False, lambda: False, lambda part: None).r_squared


def r_squared_narrow(state: State) -> float:
    """Return R² of the state's method against the Huygens sum, in the paper's window of 32² samples over 22.12 µm."""
    made = paraxial_setup(state)
    shown = render(made.lens, made.source, method=state.optics.method, pixels=PIXELS, pixel_um=WINDOW_UM / PIXELS)
    return float(fidelity(shown.values, _reference(made.lens, made.source).values))


@lru_cache(maxsize=8)
def _reference(lens: Lens, source: Source) -> Psf:
    return render(lens, source, method="huygens", pixels=PIXELS, pixel_um=WINDOW_UM / PIXELS)


def database_error(rule: str) -> Measure:
    """Return the largest error of a database's rule in W22, waves, as the database panel shows it first."""

    def error(state: State) -> float:
        from p2sf_explorer.compute.views.database import answer, question

        return answer(question(_live(state)).question).largest[rule]["w22"]

    return error


def photo_psfs(state: State) -> float:
    """Return how many PSFs the coarse picture computes, as the panel counts them."""
    from p2sf_explorer.compute.views.image import psf_counts

    count, _ = psf_counts(_coarse(state).plan)
    return float(str(count.values["count"]))


def sharpening_db(state: State) -> float:
    """Return what sharpening gains over the blurred photo, dB; ``photo_show axis`` takes the PSF of the axis for it."""
    from p2sf.image.deblur import psnr
    from p2sf_explorer.compute.views.image import COLUMNS, ROWS
    from p2sf_explorer.compute.views.photos import scene_values

    found = _coarse(state)
    truth = scene_values(state.photo.source, (ROWS, COLUMNS))
    return psnr(found.after, truth) - psnr(found.before, truth)


@lru_cache(maxsize=8)
def _coarse(state: State) -> "ImageResult":
    from p2sf_explorer.compute.views.image import coarse, question

    return coarse(question(_live(change(state, method="seidel"))).question)


def _spread(axis: str) -> Measure:
    """Return the measure of the PSF's standard deviation along an axis in the window shown, µm."""

    def spread(live: Live) -> SupportsFloat:
        values = live.psf.values.sum(0 if axis == "x" else 1, dtype=float)
        place = live.psf.x_um if axis == "x" else live.psf.y_um
        share = values / values.sum()
        return np.sqrt(share @ place**2 - (share @ place) ** 2)

    return of_live(spread)


def _contrast(direction: str) -> Measure:
    def contrast(live: Live) -> float:
        found = mtf_of(measured_parts(measure_request(live)), "", np.array([CONTRAST_PER_MM]))
        return float(getattr(found, direction)[0])

    return of_live(contrast)


def _beside_centre(live: Live) -> tuple[float, float]:
    """Return the radius of the first dark ring, µm, and the brightest light beyond it over that in the middle."""
    from scipy.interpolate import CubicSpline

    psf = live.psf
    fine = np.linspace(0, psf.x_um[-1], FINE)
    values = CubicSpline(psf.x_um, psf.values[np.abs(psf.y_um).argmin()])(fine)
    dark = int(np.argmax(np.diff(values) > 0))
    return float(fine[dark]), float(values[dark:].max() / values[0])


def _valley_over_peak(live: Live) -> float:
    """Return the light midway between two equal points an Airy radius apart along x over that at either of them.

    Brightness adds: 2·I(r/2) / (I(0) + I(r)), 0.735 for a perfect lens (Rayleigh 1879).
    """
    from scipy.interpolate import CubicSpline

    psf = live.psf
    light = CubicSpline(psf.x_um, psf.values[np.abs(psf.y_um).argmin()])
    at_point, midway, at_other = light(live.airy_radius_um * np.array([0.0, 0.5, 1.0]))
    return float(2 * midway / (at_point + at_other))


def _signed_contrast(live: Live) -> float:
    """Return the tangential contrast, below 0 where black and white change places: the sign of Σ light·cos 2πνy."""
    psf = live.psf
    light = psf.values.sum(1, dtype=float)
    away_mm = (psf.y_um - light @ psf.y_um / light.sum()) / UM_PER_MM
    found = mtf_of(measured_parts(measure_request(live)), "", np.array([CONTRAST_PER_MM]))
    return float(np.copysign(found.tangential[0], light @ np.cos(2 * np.pi * CONTRAST_PER_MM * away_mm)))


def _around(live: Live, radii_um: np.ndarray) -> np.ndarray:
    """Return the mean intensity on these circles about the chief ray, by direction over one turn."""
    from scipy.interpolate import RectBivariateSpline

    psf = live.psf
    turn = np.linspace(0, 2 * np.pi, DIRECTIONS, endpoint=False)[:, None]
    spline = RectBivariateSpline(psf.y_um, psf.x_um, psf.values)
    found: np.ndarray = spline.ev(radii_um * np.cos(turn), radii_um * np.sin(turn)).mean(1)
    return found


def _rays_of_star(live: Live) -> np.ndarray:
    return _around(live, live.airy_radius_um * SPIKES)


def _blur(live: Live) -> np.ndarray:
    c = live.setup.coefficients
    return _around(live, 2 * abs(float(c.wd)) * float(c.wavelength_um) / float(c.na) * CORNERS)


def _runs(values: np.ndarray) -> int:
    """Return how many separate directions are brighter than half the brightest."""
    bright = values > values.max() / 2
    return int((bright & ~np.roll(bright, 1)).sum())


def _energy(live: Live) -> Energy:
    return energy_in(measured_parts(measure_request(live)), "")


MEASURES: dict[str, Measure] = {
    "airy_radius_um": of_live(lambda live: live.airy_radius_um),
    "numerical_aperture": of_setup(lambda made: made.coefficients.na),
    "focal_length_mm": of_setup(lambda made: made.focal_length_mm),
    "image_height_mm": of_setup(lambda made: made.coefficients.image_height),
    "stop_surface": of_setup(lambda made: find_stop(made.lens).surface),
    **{f"{term}_waves": coefficient(term) for term in ("w40", "w31", "w22", "w20", "wd", "w11")},
    "rms_waves": of_live(lambda live: live.pupil.rms),
    "left_out_waves": left_out_waves,
    "strehl": of_live(lambda live: np.asarray(live.psf.strehl, float)),
    "centre_over_peak": of_live(lambda live: live.psf.values[tuple(n // 2 for n in live.psf.values.shape)]
                                / live.psf.values.max()),
    "radius_80_um": of_live(lambda live: _energy(live).radius_80_um),
    "dark_ring_um": of_live(lambda live: _beside_centre(live)[0]),
    "ring_over_peak": of_live(lambda live: _beside_centre(live)[1]),
    "valley_over_peak": of_live(_valley_over_peak),
    "spikes": of_live(lambda live: _runs(_rays_of_star(live))),
    "spike_over_gap": of_live(lambda live: _rays_of_star(live).max() / np.median(_rays_of_star(live))),
    "blur_corners": of_live(lambda live: _runs(_blur(live))),
    "centroid_y_um": of_live(lambda live: _energy(live).centroid_um),
    "spread_x_um": _spread("x"),
    "spread_y_um": _spread("y"),
    "contrast_tangential": _contrast("tangential"),
    "contrast_sagittal": _contrast("sagittal"),
    "signed_contrast_tangential": of_live(_signed_contrast),
    **{f"{which}_focus_um": focus_um(which) for which in ASTIGMATISM},
    **{f"real_{which}_focus_um": ray_focus_um(which) for which in ("sagittal", "tangential")},
    "distortion_percent": distortion_percent,
    "axial_colour_um": axial_colour_um,
    "r_squared": r_squared,
    "r_squared_narrow": r_squared_narrow,
    "numbers": of_live(lambda live: live.psf.numbers),
    "rays": of_live(lambda live: live.psf.rays),
    "exact_database_error_waves": database_error("exact"),
    "table1_error_waves": database_error("table1"),
    "linear_error_waves": database_error("linear"),
    "photo_psfs": photo_psfs,
    "sharpening_db": sharpening_db,
}  # fmt: skip
