"""Laws that MTF and energy keep for any lens: random ones, random states of the shipped ones, and their extremes."""

from math import inf

import numpy as np
import pytest
from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from p2sf.errors import P2SFError
from p2sf.figures.measures import Energy, Mtf
from p2sf.lens.lens import Lens, with_aim, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.first_order import image_distance
from p2sf.psf.measures import energy_in, mtf_of, parts_of
from tests.support.lenses.random_lenses import between, lenses, slopes, wavelengths

# Shrinking a lens would take minutes, and its numbers say nothing that the first failure does not.
some = settings(max_examples=settings.default.max_examples // 5, phases=(Phase.generate,))
few = settings(some, max_examples=5)


def measured(lens: Lens, source: Source) -> tuple[Mtf, Energy]:
    """Return the measures; skips the example where a named error says why there are none."""
    try:
        parts, method = parts_of(lens, source)
        return mtf_of(parts, method), energy_in(parts, method)
    except P2SFError:
        assume(False)


def check_laws(mtf: Mtf, energy: Energy) -> None:
    """Check that contrast begins at 1, ends at 0 and is nowhere above the perfect; that energy rises from 0 to 1."""
    for real, perfect in ((mtf.tangential, mtf.perfect_tangential), (mtf.sagittal, mtf.perfect_sagittal)):
        assert np.isfinite(real).all() and (real >= 0).all()
        assert real[0] == pytest.approx(1, abs=1e-12)
        assert (real <= perfect + 1e-6).all() and (perfect <= 1 + 1e-12).all()
    assert max(mtf.tangential[-1], mtf.sagittal[-1]) < 1e-6  # the last frequency is the larger cut-off
    assert energy.fraction[0] == 0 and np.isfinite(energy.fraction).all()
    assert (np.diff(energy.fraction) >= 0).all() and energy.fraction[-1] <= 1
    if np.isfinite(energy.radius_80_um):
        assert 0 < energy.radius_50_um < energy.radius_80_um


@few
@given(lenses(most=5, air=True), st.one_of(st.just(inf), between(20.0, 500.0)), slopes, wavelengths, st.booleans())
def test_random_lenses(lens, depth, slope, wavelength, stop):
    """Of any shape; brought to a focus, or every example would be blur."""
    try:
        image = float(image_distance(lens, depth, wavelength))
        lens = with_aim(with_sensor(lens, image), "stop" if stop else "paraxial")
    except P2SFError:
        assume(False)
    check_laws(*measured(lens, Source(depth, min(slope, 0.3), wavelength)))


@some
@given(
    st.sampled_from(shipped_lenses()),
    st.floats(0, 1),
    st.floats(2.8, 16),
    st.one_of(st.just(inf), st.floats(10, 1000)),
    st.floats(-0.05, 0.05),
)
def test_random_states_of_shipped_lenses(name, part, f_number, depths, shift):
    lens = with_f_number(find_lens(name), f_number)
    source = Source(depths * abs(lens.sensor_mm), field_deg=part * max(lens.fields_deg))
    check_laws(*measured(with_sensor(lens, lens.sensor_mm * (1 + shift)), source))


@pytest.mark.parametrize("field", [0.0, 5.0])
@pytest.mark.parametrize("radius", [1e2, 1e3, 1e6, 1e12])
def test_energy_far_outside_the_blur_is_all_the_light(field, radius):
    """What is outside falls as 1/R, λ/(π²NA·R) for a perfect lens; the sums are periodic and must not come round."""
    parts, method = parts_of(find_lens("achromat_f6"), Source(field_deg=field))
    outside = 1 - energy_in(parts, method, np.array([radius])).fraction.item()
    assert outside == pytest.approx(0.5875618 / (np.pi**2 * 0.0833 * radius), rel=1.0)
    assert 0 <= outside
