"""The reference lenses with dispersion added, so that wavelength matters and no glass catalogue is needed."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from p2sf.glass.media import TabulatedIndex
from p2sf.lens.lens import Lens
from tests.support.reference import prescription_lens, reference


@dataclass(frozen=True)
class Sellmeier:
    """One resonance in the ultraviolet, as strong as the index at the sodium line asks."""

    index_d: float
    pole_um2: float = 0.012
    range_um = None

    @property
    def label(self) -> str:
        return f"sellmeier {self.index_d}"

    def index(self, wavelength_um) -> np.ndarray:
        square = np.square(np.asarray(wavelength_um, dtype=float))
        strength = (self.index_d**2 - 1) * (1 - self.pole_um2 / 0.5875618**2)
        return np.sqrt(1 + strength * square / (square - self.pole_um2))


@cache
def dispersive_lens(name: str) -> Lens:
    """Return a reference lens whose glasses disperse, the dense ones more."""
    return _reglazed(name, lambda n: Sellmeier(n, 0.009 + 0.01 * (n - 1.5)))


@cache
def bent_lens(name: str) -> Lens:
    """Return a reference lens whose glasses are straight lines with a corner at 550 nm."""
    return _reglazed(name, lambda n: TabulatedIndex((0.3, 0.55, 0.9), (n + 0.02, n, n - 0.005)))


def _reglazed(name: str, glass) -> Lens:
    lens = prescription_lens(name, next(float(key) for key in reference(name)["indices"]))
    surfaces = tuple(replace(s, medium=glass(s.medium.value)) if s.medium.value > 1.1 else s for s in lens.surfaces)
    return replace(lens, surfaces=surfaces)
