"""The MTF as painted, straight lines between its frequencies, against its integral over the pupil and a closed form."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import j0, j1

from p2sf.figures.perfect import diffraction_mtf
from p2sf.psf.measures import mtf_of
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.measured import MeasureRequest, measure_request, measured_parts
from p2sf_explorer.compute.views.mtf import contrast
from p2sf_explorer.state.state import change, new_state
from tests.support.overlap import overlap
from tests.support.windows.windows import settled

ALONE = new_state(method="seidel", theme="light", free_pupil=True)


def between(frequency_per_mm: np.ndarray) -> np.ndarray:
    """Return frequencies between those that the window tells apart: none of the old, coarse ones."""
    return np.linspace(0, frequency_per_mm[-1], 1601)[1:-1:2]


def test_a_perfect_lens_has_the_closed_form_between_the_samples():
    answer = live(change(ALONE, added_waves=(1e-9, 0.0, 0.0, 0.0, 0.0, 0.0)))
    found, source = contrast(answer).found, answer.setup.source
    asked = between(found.frequency_per_mm)
    exact = diffraction_mtf(asked, float(answer.setup.coefficients.na), source.wavelength_um)
    for curve in (found.tangential, found.sagittal):
        painted = np.interp(asked, found.frequency_per_mm, curve)
        assert np.abs(painted - exact).max() < 1e-4  # no light is missing


@pytest.mark.parametrize("waves", [(0.0, 0.0, 0.0, 0.0, 6.0, 0.0), (4.0, 6.0, 3.0, 0.0, 0.0, 0.0)])
def test_what_is_painted_is_the_autocorrelation_of_the_pupil(waves):
    answer = live(change(ALONE, added_waves=waves))
    found = contrast(answer).found
    c = answer.setup.coefficients
    for nu in (0.0131, 0.0517, 0.113, 0.27, 0.61):  # of the cut-off
        asked = nu * 2000 * float(c.na) / float(c.wavelength_um)
        for name, exact in (("tangential", overlap(c, 0.0, nu)), ("sagittal", overlap(c, nu, 0.0))):
            painted = np.interp(asked, found.frequency_per_mm, getattr(found, name))
            assert abs(painted - abs(exact)) < 3e-3  # straight lines between 512 points of six waves of defocus
    assert found.frequency_per_mm[-1] == pytest.approx(2000 * float(c.na) / float(c.wavelength_um), rel=1e-6)


@pytest.mark.slow
def test_a_slow_transfer_function_follows_and_no_wrong_curve_is_shown(window, qtbot):
    """At 1.5 m the Petzval focused at infinity has hundreds of waves: asked of the worker, then painted."""
    window.store.update(lens="petzval", method="traced", field_deg=3.0, depth_mm=700.0, tab="mtf")
    panel = window.panels["mtf"]
    request = window.live.views["mtf"].question
    assert isinstance(request, MeasureRequest) and panel.late.asked == request
    settled(panel, qtbot)
    frequency, contrast = panel.curves["tangential"].data()
    at_20 = mtf_of(measured_parts(request), "", [20.0]).tangential[0]
    assert np.interp(20.0, frequency, contrast) == pytest.approx(at_20, abs=0.02)


def test_beside_a_picture_of_rays_the_contrast_says_that_it_is_of_waves():
    answer = live(new_state(lens="achromat_f6", depth_mm=np.inf, focus_mm=np.inf))
    assert "density" not in str(measure_request(answer).method)
    beside = replace(answer, psf=replace(answer.psf, method="geometric"))
    assert (
        str(measure_request(beside).method)
        == "exact rays, by waves of the pupil; the picture is the density of its rays"
    )


def circles(apart: np.ndarray, one: float, other: float) -> np.ndarray:
    """Return the area that two circles share whose centres lie so far apart: two circular segments."""
    d = np.clip(apart, abs(one - other) + 1e-12, one + other)
    first, second = (
        r * r * np.arccos(np.clip((d * d + r * r - s * s) / (2 * d * r), -1, 1))
        for r, s in ((one, other), (other, one))
    )
    product = (-d + one + other) * (d + one - other) * (d - one + other) * (d + one + other)
    return first + second - np.sqrt(np.maximum(product, 0)) / 2


def test_behind_a_ring_the_perfect_curve_is_that_of_the_same_pupil_and_the_clear_one_stands_beside(window, qtbot):
    """The autocorrelation of an annulus: circles' overlaps, outer less two mixed plus inner (O'Neill 1956)."""
    window.store.replace(change(ALONE, added_waves=(0.0, 0.0, 0.0, 0.0, 0.5, 0.0), obscuration=0.5, tab="mtf"))
    panel = window.panels["mtf"]
    beside = panel.curves["perfect, clear pupil"]
    settled(panel, qtbot)
    frequency, perfect = panel.curves["perfect lens"].data()
    apart = 2 * frequency / frequency[-1]
    ring = circles(apart, 1, 1) - 2 * circles(apart, 1, 0.5) + circles(apart, 0.5, 0.5)
    assert perfect == pytest.approx(ring / (0.75 * np.pi), abs=1e-3)  # the accuracy of contrast behind masks is 3e-4
    _, clear = beside.data()
    assert clear == pytest.approx(circles(apart, 1, 1) / np.pi, abs=1e-3)
    assert "same pupil" in panel.widget.readout.text() and "clear pupil" in panel.widget.readout.text()
    middle, end = (np.abs(apart / 2 - at).argmin() for at in (0.35, 0.8))
    assert perfect[middle] < clear[middle] - 0.1 and perfect[end] > 1.3 * clear[end]


def test_energy_behind_a_ring_is_beside_that_of_the_same_pupil(window, qtbot):
    """That of the annular Airy pattern, 2J₁(v)/v − ε²·2J₁(εv)/(εv) over 1 − ε², summed over rings."""
    window.store.replace(change(ALONE, added_waves=(0.0, 0.0, 0.0, 0.0, 0.5, 0.0), obscuration=0.5, tab="profiles"))
    panel = window.panels["profiles"]
    settled(panel, qtbot)
    (radius, perfect), (_, clear) = panel.perfect.data(), panel.clear.data()
    unit = 2 * np.pi * float(window.live.setup.coefficients.na) / float(window.live.setup.coefficients.wavelength_um)
    v = np.linspace(1e-6, 60 * unit, 40_000)
    amplitude = (2 * j1(v) / v - 0.25 * 2 * j1(v / 2) / (v / 2)) / 0.75
    step = v[1] - v[0]
    within = np.cumsum(amplitude**2 * v * step) * 0.75 / 2  # Parseval: all light is 2/(1 − ε²) in these units
    assert perfect == pytest.approx(np.interp(unit * radius, v, within), abs=5e-3)
    assert clear == pytest.approx(1 - j0(unit * radius) ** 2 - j1(unit * radius) ** 2, abs=1e-3)
