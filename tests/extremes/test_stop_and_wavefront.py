"""The limiting rim and W itself, against the 50-digit witness."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import GlassError
from p2sf.glass.media import catalogue_glass
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.pupils import find_stop
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import wavefront
from tests.extremes import witness
from tests.extremes.regimes import (
    WAVELENGTH,
    Case,
    depth_cases,
    many_surface_cases,
    random_lens,
    scaling_cases,
    system_of,
)

DEPTHS = (1e-3, 1.0, 40.0, 1e3, 1e9, 1e15, np.inf)


@pytest.mark.parametrize("seed", range(12))
def test_the_limiting_rim_is_the_witnesses(seed):
    """Random rims; two that differ by less than 2e-6 would be a tie, which random numbers do not make."""
    rng = np.random.default_rng(seed)
    lens = random_lens(int(rng.integers(1, 30)), seed)
    surfaces = tuple(replace(s, semi_diameter=float(rng.uniform(0.5, 20))) for s in lens.surfaces)
    rim = surfaces[lens.stop_surface - 1].semi_diameter
    lens = replace(lens, surfaces=surfaces, aperture=Aperture("stop_semi_diameter", rim))
    found = find_stop(lens, np.array(DEPTHS), WAVELENGTH, "auto")
    for j, depth in enumerate(DEPTHS):
        system = witness.exact(system_of(Case("", lens, depth)))
        expected = witness.limiting_surface(system, [s.semi_diameter for s in surfaces])
        assert found.limiting_surface[j] == expected
        assert found.semi_diameter[j] == surfaces[expected - 1].semi_diameter


POINTS = ((0.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (0.6, 0.8), (-0.3, 0.1), (1e-9, 1e-9))


@pytest.mark.slow
@pytest.mark.parametrize("regime", [depth_cases, scaling_cases, many_surface_cases])
def test_w_is_as_good_as_its_conditioning(regime, record):
    for case in regime():
        if len(case.lens.surfaces) > 50:
            continue
        system = witness.exact(system_of(case))

        def w(system):
            found = witness.coefficients(system)
            return {point: witness.wave_aberration(found, *point) for point in POINTS}

        values = w(system)
        kappa = witness.conditioning(w, system, values, 20)
        found = coefficients(case.lens, case.depth, case.slope, case.wavelength)
        xi, eta = np.array(POINTS).T
        for value, point in zip(wavefront(found, xi, eta), POINTS, strict=True):
            error = abs(witness.mpf(float(value)) - values[point])
            record("W(ξ, η)", case.regime, float(error / kappa[point]) if kappa[point] else float(value != 0))
            assert error <= 1e-13 * kappa[point]


def test_both_ends_of_a_glass_are_inside_and_the_next_number_is_not():
    glass = catalogue_glass("SCHOTT N-BK7")
    lens = Lens((Surface(50.0, 3.0, glass), Surface(np.inf, 90.0)), Aperture("stop_semi_diameter", 5.0), 1)
    low, high = glass.range_um
    found = coefficients(lens, np.inf, 0.1, np.array([low, high]))
    assert all(np.isfinite(value).all() for value in vars(found).values())
    for outside in (np.nextafter(low, 0), np.nextafter(high, 99)):
        with pytest.raises(GlassError):
            coefficients(lens, np.inf, 0.1, outside)
