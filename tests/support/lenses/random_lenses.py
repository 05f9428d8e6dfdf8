"""Random lenses and sources for property tests: valid by construction, wild in shape."""

from math import inf

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from p2sf.errors import P2SFError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.pupils import ParaxialRays, paraxial_rays

TINY = 1e-30  # products of smaller numbers underflow, where no law holds to the last bit


def between(low: float, high: float):
    return st.floats(low, high, allow_nan=False).map(lambda value: value if abs(value) > TINY else 0.0)


@st.composite
def radii(draw):
    """Return a plane now and then, else a radius of either sign."""
    size = draw(st.one_of(st.just(inf), between(8.0, 500.0)))
    return size if size == inf or draw(st.booleans()) else -size


@st.composite
def lenses(draw, most: int = 7, spherical: bool = False, air: bool = False) -> Lens:
    """Return a lens of 1 to ``most`` surfaces; ``air`` keeps n = n' = 1, ``spherical`` leaves figures out."""
    count = draw(st.integers(1, most))
    rows = []
    for _ in range(count):
        figure = (0.0, ()) if spherical else (draw(between(-2, 1)), (draw(between(-1e-6, 1e-6)),))
        medium = ConstantIndex(draw(st.one_of(st.just(1.0), between(1.3, 2.0))))
        rows.append(Surface(draw(radii()), draw(between(0.0, 20.0)), medium, *figure))
    if air:
        rows[-1] = Surface(rows[-1].radius, rows[-1].thickness, ConstantIndex(1.0), rows[-1].conic, rows[-1].aspheric)
    before = ConstantIndex(1.0 if air else draw(st.one_of(st.just(1.0), between(1.0, 1.6))))
    rim = Aperture("stop_semi_diameter", draw(between(0.05, 3.0)))
    return Lens(tuple(rows), rim, draw(st.integers(1, count)), object_medium=before)


depths = st.one_of(st.just(inf), between(1e-3, 1e15), between(5.0, 500.0))
# 0, or at least 1e-12: the cube of a slope of 1e-103 is no ordinary number any more
slopes = st.one_of(st.just(0.0), between(1e-12, 0.6), between(-0.6, -1e-12), between(1e-12, 600.0))
wavelengths = between(0.2, 12.0)


def rays_or_skip(lens: Lens, *where) -> ParaxialRays:
    """Return the paraxial rays at (depth, wavelength); skips the example if there are none, or none below a metre."""
    try:
        rays = paraxial_rays(lens, *where)
    except P2SFError:
        assume(False)
    assume(all(np.abs(x).max() < 1e3 for x in (rays.y, rays.chief_y, rays.nu, rays.chief_nu)))
    return rays
