"""Transfer function and energy of a pupil by a square grid over spatial frequency, whatever ends it.

Exact rays of the whole disc say which point of the stop every cell of the grid belongs to, its phase and its density,
by piecewise cubic interpolation; rays through those points say whether rims let it pass, and the numbers of the mask
whether that does. Padded FFTs do the rest. Nothing of `p2sf` but its rays has a part in it.
"""

import numpy as np
import scipy.fft
from scipy.interpolate import CloughTocher2DInterpolator
from scipy.special import j1

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.pencil import pencil
from tests.support.brute_force import mask_light, mask_opens

KNOWN = 120  # rays across the disc that the others lie between
STEP = 1e-4  # of the radius, for the density


class GridSums:
    """The pupil of a source on ``cells``² frequencies.

    ``frequency``: cycles per µm; ``along_x``, ``along_y``: the modulus of the transfer function there.
    """

    def __init__(self, lens: Lens, source: Source, clip: bool, cells: int = 512):
        axis = np.linspace(-1, 1, KNOWN)
        xi, eta = (v.ravel() for v in np.meshgrid(axis, axis))
        turn = np.linspace(0, 2 * np.pi, 4 * KNOWN, endpoint=False)
        inside = np.hypot(xi, eta) < 0.995
        xi, eta = np.append(xi[inside], np.sin(turn)), np.append(eta[inside], np.cos(turn))
        rays = pencil(lens, source, xi, eta)
        assert rays.passed.all()
        half = max(np.ptp(rays.fx), np.ptp(rays.fy)) / 2 * 1.01
        cell = 2 * half / cells
        place = (np.arange(cells) + 0.5) * cell - half
        centre = (rays.fx.max() + rays.fx.min()) / 2, (rays.fy.max() + rays.fy.min()) / 2
        fx, fy = np.meshgrid(place + centre[0], place + centre[1])
        known = np.stack([xi, eta, rays.phase, rays.amplitude / np.sqrt(_area(lens, source, xi, eta))], axis=1)
        # Of the field per frequency: amplitude·|∂(ξ, η)/∂f|, twice the root.
        known[:, 3] /= np.sqrt(_area(lens, source, xi, eta))
        table = CloughTocher2DInterpolator(np.stack([rays.fx, rays.fy], axis=1), known)(fx, fy)
        lit = np.isfinite(table).all(-1)
        xi, eta, phase, density = table[lit].T
        beyond = np.maximum(np.hypot(xi, eta), 1.0)
        mask = mask_seen(lens, source)
        passed = pencil(lens, source, xi / beyond, eta / beyond, clip).passed & mask_opens(mask, xi, eta)
        field = np.zeros(fx.shape, complex)
        field[lit] = passed * density * np.exp(2j * np.pi * phase) * mask_light(mask, xi, eta, source.wavelength_um)
        self.frequency = np.arange(cells) * cell
        spectrum = np.abs(scipy.fft.fft2(field, (2 * cells, 2 * cells))) ** 2
        self._otf, self._cell = scipy.fft.ifft2(spectrum), cell
        self._otf /= self._otf[0, 0].real
        self.along_x, self.along_y = np.abs(self._otf[0, :cells]), np.abs(self._otf[:cells, 0])

    def energy(self, x_um: float, y_um: float, radius_um: float) -> float:
        """Return the share of all light within a radius of a place, µm from the chief ray: Σ OTF·R·J₁(2πRν)/ν."""
        size = len(self._otf)
        along = scipy.fft.fftfreq(size, 1 / size) * self._cell
        nu = np.hypot(along, along[:, None])
        nu[0, 0] = 1.0
        disc = radius_um * j1(2 * np.pi * radius_um * nu) / nu
        disc[0, 0] = np.pi * radius_um**2
        # The field at x is a sum of exp(+2πif·x), and the transform here is one of exp(−2πif·x).
        wave = np.exp(2j * np.pi * (along * x_um + along[:, None] * y_um))
        return float((self._otf * wave * disc).sum().real * self._cell**2)


def _area(lens: Lens, source: Source, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return |∂(fx, fy)/∂(ξ, η)| by differences of rays a little nearer to the middle."""
    xi, eta = (1 - STEP) * xi, (1 - STEP) * eta
    here, right, up = (pencil(lens, source, xi + a * STEP / 2, eta + b * STEP / 2) for a, b in ((0, 0), (1, 0), (0, 1)))
    area: np.ndarray = (right.fx - here.fx) * (up.fy - here.fy) - (right.fy - here.fy) * (up.fx - here.fx)
    return np.abs(area) / (STEP / 2) ** 2
