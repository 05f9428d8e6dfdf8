"""The colour PSF of the present point: the request, and the answer in the colours of a screen."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from p2sf.colour.colorimetry import displayable, linear_rgb, matching, srgb_from_linear
from p2sf.colour.spectrum import relative_power, spectrum_of
from p2sf.conventions import NM_PER_UM
from p2sf.figures.colour_psf import ColourPsf, faint_rgb
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.psf.polychromatic import colour_psf, suitable_pitch_um
from p2sf.psf.result import Psf
from p2sf_explorer.compute.brightness import stretch
from p2sf_explorer.compute.finer import smooth
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.method import WINDOWS
from p2sf_explorer.compute.sampled import by_coefficients, in_window, optics
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State, change

COUNT = {"preview": 7, "settled": 15}
FINE_UM = np.arange(0.4, 0.7001, 0.005)
PIXELS = {"preview": 48, "settled": 96}
CHOICES = (
    ("d65", "daylight D65"),
    ("equal", "equal energy"),
    ("planck:2856", "tungsten 2856 K"),
    ("planck:5600", "black body 5600 K"),
    ("lines:486.13,587.56,656.27", "lines F d C"),
    ("lines:435.83,546.07", "mercury g e"),
)


@dataclass(frozen=True)
class ColourQuestion:
    """Everything a colour PSF depends on: setup, spectrum, ``window`` (pixels, µm per pixel), ``count`` of wavelengths.

    ``six``: by the six coefficients, else by exact rays.
    """

    state: State
    spectrum: str
    window: tuple[int, float]
    count: int
    six: bool


@dataclass(frozen=True)
class Colours:
    """The colour PSF, and for its spectrum: wavelengths in nm, relative luminance and sRGB 0 to 1 of each."""

    psf: ColourPsf
    wavelength_nm: np.ndarray
    luminance: np.ndarray
    hues: np.ndarray


def question(live: Live) -> View[None]:
    """Return what to show for the present point. Raises P2SFError for a line outside the glasses' data."""
    s, pixels = live.setup, PIXELS[live.quality]
    spectrum = spectrum_of(live.state.display.spectrum)
    pitch = suitable_pitch_um(s.lens, s.source, spectrum, pixels, s.stop)
    window = pixels, nice(pixels * pitch, WINDOWS) / pixels
    return View(
        None, ColourQuestion(optics(live.state), spectrum.name, window, COUNT[live.quality], by_coefficients(live))
    )


def answer(request: ColourQuestion, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> Colours:
    """Return the colour PSF; P2SFError where a wavelength has no PSF."""
    setup, spectrum = paraxial_setup(request.state), spectrum_of(request.spectrum)

    def one(lens: Lens, source: Source, pixels: int, pixel_um: float) -> Psf:
        return in_window(
            at_wavelength(request.state, NM_PER_UM * source.wavelength_um), (pixels, pixel_um), request.six
        )

    # A free pupil has no glass: the axis of the lens, where no colour lands beside another, stands for it.
    source = replace(setup.source, field_slope=0.0) if request.state.what_if.free_pupil else setup.source
    psf = colour_psf(setup.lens, source, spectrum, request.window, one, request.count)
    waves = np.array(spectrum.numbers) / NM_PER_UM if spectrum.kind == "lines" else FINE_UM
    power = np.ones(waves.size) if spectrum.kind == "lines" else relative_power(spectrum, waves)
    return Colours(psf, NM_PER_UM * waves, power * matching(waves)[:, 1], hues(waves))


def at_wavelength(state: State, wavelength_nm: float, **entries: Any) -> State:
    """Return the setup at another wavelength; a path added by hand is more waves of a shorter wavelength.

    ``entries``: others that are changed with it.
    """
    ratio = state.optics.wavelength_nm / wavelength_nm
    added = tuple(ratio * waves for waves in state.what_if.added_waves)
    return change(state, wavelength_nm=wavelength_nm, added_waves=added, **entries)


def hues(wavelength_um: np.ndarray) -> np.ndarray:
    """Return the screen's colour of each wavelength, sRGB 0 to 1 with its brightest channel 1, (n, 3)."""
    rgb = displayable(linear_rgb(matching(wavelength_um)))
    return srgb_from_linear(rgb / np.maximum(rgb.max(-1, keepdims=True), 1e-12))


def smooth_colours(found: ColourPsf, coarse: bool) -> ColourPsf:
    """Return a picture on finer samples, as it is painted; ``coarse`` as for `p2sf.figures.enlarge.enlarge`."""
    finer = [smooth(found.xyz[..., channel], coarse=coarse) for channel in range(3)]
    return replace(found, xyz=np.stack(finer, axis=-1))


def pixels(found: ColourPsf, scale: str) -> np.ndarray:
    """Return the picture as 0xffRRGGBB, rows +y, brightness stretched on a scale, hue kept."""
    rgb = srgb_from_linear(np.clip(faint_rgb(found, lambda top: stretch(top, scale)), 0.0, 1.0))
    red, green, blue = np.moveaxis(np.rint(255 * rgb).astype(np.uint32), -1, 0)
    return 0xFF000000 | red << 16 | green << 8 | blue
