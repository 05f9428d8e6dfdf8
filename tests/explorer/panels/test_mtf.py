"""The MTF as painted, straight lines between its frequencies, against the transform itself and a closed form."""

import numpy as np
import pytest

from p2sf.metrics.perfect import diffraction_mtf
from p2sf.metrics.window import mtf
from p2sf_explorer.compute.live import live
from p2sf_explorer.results.mtf import contrast
from p2sf_explorer.state.state import changed, new_state

ALONE = new_state(method="seidel", theme="light", free_pupil=True)


def between(frequency_per_mm: np.ndarray) -> np.ndarray:
    """Return frequencies between those that the window tells apart: none of the old, coarse ones."""
    return np.linspace(0, frequency_per_mm[-1], 1601)[1:-1:2]


def test_a_perfect_lens_has_the_closed_form_between_the_samples():
    answer = live(changed(ALONE, added_waves=(1e-9, 0.0, 0.0, 0.0, 0.0, 0.0)))
    found, source = contrast(answer), answer.setup.source
    asked = between(found.frequency_per_mm)
    exact = diffraction_mtf(asked, float(answer.setup.coefficients.na), source.wavelength_um)
    for curve in (found.tangential, found.sagittal):
        painted = np.interp(asked, found.frequency_per_mm, curve)
        assert np.abs(painted - exact).max() < 1.5 * (1 - answer.psf.energy) + 1e-3  # the light outside the window


@pytest.mark.parametrize("waves", [(0.0, 0.0, 0.0, 0.0, 6.0, 0.0), (4.0, 6.0, 3.0, 0.0, 0.0, 0.0)])
def test_what_is_painted_between_the_frequencies_is_the_transform(waves):
    answer = live(changed(ALONE, added_waves=waves))
    found = contrast(answer)
    asked = between(found.frequency_per_mm)
    exact = mtf(answer.psf, asked)
    for name in ("tangential", "sagittal"):
        painted = np.interp(asked, found.frequency_per_mm, getattr(found, name))
        assert np.abs(painted - getattr(exact, name)).max() < 0.01  # an eighth of 1/window: (π/8)²/8·½ at the most
