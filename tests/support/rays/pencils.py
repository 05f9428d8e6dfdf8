"""One surface, one disc of rays: what the tests of exact rays are made of."""

import numpy as np

from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from tests.support.reference import prescription_lens

GLASS = ConstantIndex(1.5)


def one_surface(conic=0.0, aspheric=(), radius=20.0, medium=GLASS, rim=8.0):
    surface = Surface(radius, 60.0, medium, conic, aspheric)
    return Lens((surface,), Aperture("stop_semi_diameter", rim), 1)


def double_gauss():
    return prescription_lens("double_gauss_28", 656.2725)


def disc(count=200, seed=1):
    rng = np.random.default_rng(seed)
    radius, angle = np.sqrt(rng.random(count)), 2 * np.pi * rng.random(count)
    return radius * np.cos(angle), radius * np.sin(angle)
