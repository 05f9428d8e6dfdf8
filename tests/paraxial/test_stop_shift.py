"""What moving the stop along a lens changes and what it leaves, Welford 1986, §8.4."""

from dataclasses import replace
from math import inf

import numpy as np
from hypothesis import assume, example, given
from hypothesis import strategies as st

from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.seidel import seidel_sums
from tests.support.lenses.random_lenses import depths, lenses, rays_or_skip, wavelengths


def shifted_stop(lens: Lens, to: int, depth, wavelength) -> Lens:
    """Return the lens with the stop on another surface, its rim set by the old marginal ray."""
    rays = rays_or_skip(lens, depth, wavelength)
    rim = abs(float(rays.y[to - 1]))
    assume(rim > 1e-3)
    return replace(lens, stop_surface=to, aperture=replace(lens.aperture, value=rim))


AIR, GLASS = ConstantIndex(1.0), ConstantIndex(2.0)
# Light of an object 1 mm away is bent by a strong surface and crosses the axis before the last plane, 9 mm behind.
CROSSED = Lens(
    (Surface(inf, 0, GLASS), Surface(-8.0, 9.0, AIR), Surface(inf, 0, AIR)), Aperture("stop_semi_diameter", 1.0), 1
)


@given(lenses(spherical=True), depths, wavelengths, st.integers(0, 399))
@example(CROSSED, 1.0, 1.0, 2)
def test_a_stop_shift_leaves_spherical_aberration_and_petzval_alone(lens, depth, wavelength, to):
    """Welford 1986, §8.4: S_I does not know the stop, nor does S_IV/H²; coma changes by δ·S_I, δ = Δȳ/y.

    A marginal ray of the other sign turns S_II's A and y both, so the sum turns with the invariant alone.
    """
    moved = shifted_stop(lens, 1 + to % len(lens.surfaces), depth, wavelength)
    old, new = rays_or_skip(lens, depth, wavelength), rays_or_skip(moved, depth, wavelength)
    first, second = seidel_sums(lens, old), seidel_sums(moved, new)
    scale = np.abs(first.spherical).sum()
    np.testing.assert_allclose(second.spherical.sum(), first.spherical.sum(), rtol=0, atol=1e-11 * scale)
    for at in range(len(lens.surfaces)):
        np.testing.assert_allclose(
            second.petzval[at] * old.invariant**2, first.petzval[at] * new.invariant**2, rtol=1e-12, atol=1e-300
        )
    k = int(np.argmax(np.abs(old.y)))
    side, ratio = np.sign(new.y[k] * old.y[k]), new.invariant / old.invariant
    shift = (new.chief_y[k] / ratio * side - old.chief_y[k]) / old.y[k]
    expected = first.coma.sum() + shift * first.spherical.sum()
    sizes = np.abs(first.coma).sum() + abs(shift) * scale + np.abs(second.coma / ratio).sum()
    np.testing.assert_allclose(second.coma.sum() / ratio, expected, rtol=0, atol=1e-9 * sizes)
