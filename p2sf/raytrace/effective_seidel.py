"""The exact wavefront in the paper's six words: what W40, W31, W22, W20 and W11 are beside what Seidel says.

The fitted phase w over the pupil is turned to the paper's sign, W = −w, and the shapes ρ⁴, ρ²η, η², ρ², η and 1 are
fitted to it by least squares over the disc. Two definitions make the numbers comparable with Seidel's. W20 is what
remains of the ρ² term after the paraxial Wd. W11 is what moves the image from its paraxial place: the tilt left in
W, plus that of the real chief ray, (y real − y paraxial)·n'u'/λ. What no shape holds is the remainder; it, and the
departure of the pupil map, is why six numbers fail where they do. The phase is one over direction cosines: a
defocus of d waves puts some d·NA²/4 waves of it into W40.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.zernike import basis
from p2sf.raytrace.fit import FittedPencil, Level, fit
from p2sf.raytrace.pencil import pencil


@dataclass(frozen=True)
class EffectiveSeidel:
    """The exact wavefront in the paper's words beside Seidel's, waves at the rim.

    ``fitted`` has w40, w31, w22, w20 and w11 from real rays, everything else as in ``seidel``. ``remainder_waves`` is
    the RMS of W that the six shapes leave; ``squeeze_x`` and ``squeeze_y`` are the real NA over the paraxial one,
    across and along the field, as the mean slope of the pupil map.
    """

    fitted: Coefficients
    seidel: Coefficients
    remainder_waves: float
    squeeze_x: float
    squeeze_y: float


def effective_seidel(lens: Lens, source: Source, numbers: int | None = None) -> EffectiveSeidel:
    """Return the wavefront of one source in the paper's words. Raises as `rayfit.fit` and `seidel.coefficients` do."""
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    found = fit(lens, source, numbers)
    w40, w31, w22, square, tilt, _ = -(_projection(found.level)[0] @ found.phase)
    chief = float(pencil(lens, source, [0.0], [1e-3]).chief_y[0])
    scale = float(six.reduced_slope) / source.wavelength_um
    # A chief ray on the axis does not move; its tilt is rounding.
    w11 = tilt + (chief - float(six.image_height)) * UM_PER_MM * scale if source.field_slope else 0.0
    words = {"w40": w40, "w31": w31, "w22": w22, "w20": square - float(six.wd), "w11": w11}
    fitted = replace(six, **{word: np.asarray(value) for word, value in words.items()})
    slopes = _mean_slopes(found)
    return EffectiveSeidel(fitted, six, _remainder(found), slopes[0] / scale, slopes[1] / scale)


@lru_cache(maxsize=8)
def _projection(level: Level) -> tuple[np.ndarray, np.ndarray]:
    """Return what turns a level's phase coefficients into the six shapes', (6, terms), and into what they leave."""
    nodes = disc_nodes(level.wave_order // 2 + 4, 2 * level.wave_order + 10)
    values = basis(level.wave_order, nodes.xi, nodes.eta)
    square = nodes.xi**2 + nodes.eta**2
    shapes = np.stack([square**2, square * nodes.eta, nodes.eta**2, square, nodes.eta, np.ones_like(square)])
    root = np.sqrt(nodes.weight)
    project = np.linalg.pinv((shapes * root).T) @ (values * root).T
    # Six shapes are combinations of the orthonormal terms: what is left is again one of them.
    return project, np.eye(len(values)) - (values * nodes.weight) @ shapes.T @ project


def _remainder(found: FittedPencil) -> float:
    return float(np.linalg.norm(_projection(found.level)[1] @ found.phase))


def _mean_slopes(found: FittedPencil) -> tuple[float, float]:
    """Return the slopes of fx along ξ and fy along η that fit best over the disc, from the linear terms 2ξ and 2η."""
    return 2 * float(found.fx[0]), 2 * float(found.fy[1])
