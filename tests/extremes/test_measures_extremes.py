"""MTF, energy and aiming at the extremes: the closed form where it holds, the laws everywhere else, or a sentence.

Cases whose sums take many seconds are tried by ``python -m tests.long.measures_extremes``, with all the rest.
"""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.conventions import UM_PER_MM
from p2sf.errors import P2SFError
from p2sf.figures.perfect import diffraction_mtf
from p2sf.lens.lens import Aperture, Lens, with_aim, with_sensor
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import numerical_aperture
from p2sf.psf.measures import energy_in, mtf_of, parts_of
from tests.extremes.regimes import BASES, WAVELENGTH, Case, aperture_cases, base, depth_cases, field_cases, scaled
from tests.figures.test_laws import check_laws
from tests.support.airy import circle_energy

AIMS = ("stop", "paraxial")
NAMED = "named error"


def focused(lens: Lens, aim: str, depth: float) -> Lens:
    return with_aim(with_sensor(lens, float(image_distance(lens, depth, WAVELENGTH))), aim)


def outcome(lens: Lens, source: Source) -> str:
    """Return the method that gave measures, which keep every law, or that a sentence says why there are none."""
    try:
        parts, method = parts_of(lens, source)
        mtf, energy = mtf_of(parts, method), energy_in(parts, method)
    except P2SFError as why:
        assert len(str(why)) > 20
        return NAMED
    check_laws(mtf, energy)
    return method


def outcome_of(case: Case, aim: str) -> str:
    return outcome(with_aim(case.lens, aim), Source(case.depth, case.slope, case.wavelength))


def quick(case: Case) -> bool:
    """Return whether a case's sums take well below a second: no slopes of hundreds of waves, no search that fails."""
    return case.lens.aperture.value < 1 or (case.depth >= 1e6 and case.slope < 0.5)


SWEPT = [case for cases in (aperture_cases, depth_cases, field_cases) for case in cases()]


@pytest.mark.parametrize("aim", AIMS)
@pytest.mark.parametrize("case", [case for case in SWEPT if quick(case)], ids=str)
def test_measures_keep_every_law(case, aim):
    assert outcome_of(case, aim) != NAMED


@pytest.mark.parametrize("aim", AIMS)
@pytest.mark.parametrize("name", BASES)
@pytest.mark.parametrize("radius", [1e-6, 1e-3, 1e-2])
def test_small_pupils_are_perfect(name, radius, aim):
    """At f/1000 and beyond nothing is left but diffraction, whose MTF and energy have closed forms."""
    lens = focused(replace(base(name), aperture=Aperture("stop_semi_diameter", radius)), aim, inf)
    parts, method = parts_of(lens, Source(inf, 0.0, WAVELENGTH))
    na = float(numerical_aperture(lens, inf, WAVELENGTH))
    frequency = np.linspace(0, 2 * na / WAVELENGTH * UM_PER_MM, 50)
    found, light = mtf_of(parts, method, frequency), energy_in(parts, method)
    # 1e-4 is the promise of the sums; beside it stands the cone's sine for its tangent, NA²
    for curve in (found.tangential, found.sagittal):
        np.testing.assert_allclose(curve, diffraction_mtf(frequency, na, WAVELENGTH), atol=2e-4)
    assert circle_energy(light.radius_80_um * na / WAVELENGTH) == pytest.approx(0.8, abs=2e-4)


@pytest.mark.parametrize("size", [1e-6, 1e6])
def test_lens_and_wavelength_scaled_together_change_nothing(size):
    """W in waves is the same, so a length of the picture grows as the lens, and contrast is the same at ν/size."""
    results = []
    for k in (1.0, size):
        lens = with_aim(scaled(base("double_gauss_28"), k), "stop")
        parts, method = parts_of(lens, Source(inf, 0.1, WAVELENGTH * k))
        mtf, light = mtf_of(parts, method), energy_in(parts, method)
        results.append((mtf.tangential, mtf.sagittal, np.array([light.radius_50_um, light.radius_80_um]) / k))
    for one, other in zip(*results, strict=True):
        np.testing.assert_allclose(other, one, rtol=2e-5, atol=2e-6)


@pytest.mark.parametrize("waves", [5.0, 50.0])
def test_steep_slopes(waves):
    """Defocus of W waves has a slope of 2W: R80 is √0.8 of the shadow's radius, to the width of its edge, √(λΔz)."""
    lens = replace(base("achromat_f6"), aperture=Aperture("stop_semi_diameter", 0.5))  # f/20: no aberration
    na = float(numerical_aperture(lens, inf, WAVELENGTH))
    shift = 2 * waves * WAVELENGTH / na**2 / UM_PER_MM
    lens = focused(lens, "stop", inf)
    parts, method = parts_of(with_sensor(lens, lens.sensor_mm + shift), Source(inf, 0.0, WAVELENGTH))
    shadow = 2 * waves * WAVELENGTH / na
    light = energy_in(parts, method)
    assert light.radius_80_um == pytest.approx(np.sqrt(0.8) * shadow, rel=0.3 / np.sqrt(waves))
    check_laws(mtf_of(parts, method), light)
