"""The six wavefront coefficients measured by real rays, to compare with those of Seidel theory.

Seidel theory gives W40, W31, W22, W20 and W11 of a lens to third order. Here ρ⁴, ρ²η, η², ρ², η and a constant are
fitted by least squares over the disc to the exact wavefront W = −w, w the fitted phase: the difference of the two
sets shows, coefficient by coefficient, how far the lens is from third order at a given aperture and field, and the
remainder how much of the wavefront no six coefficients describe. Together with the distortion of the pupil map, the
remainder explains where the Seidel method fails.

Two definitions make the numbers comparable. W20 is what remains of the ρ² term after the paraxial Wd. W11 is what
moves the image from its paraxial position: the tilt in W and the shift of the real chief ray, (y real − y paraxial)·
n'u'/λ. The phase is a function of direction cosines: a defocus of d waves contributes about d·NA²/4 waves to W40.
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
    """The coefficients of the exact wavefront beside those of Seidel theory, waves at the rim.

    ``fitted`` has w40, w31, w22, w20 and w11 from real rays, everything else as in ``seidel``. ``remainder_waves`` is
    the RMS of W that the six shapes leave. ``na_ratio_x`` and ``na_ratio_y`` are the real NA over the paraxial one,
    across and along the field, from the mean slopes of the pupil map.
    """

    fitted: Coefficients
    seidel: Coefficients
    remainder_waves: float
    na_ratio_x: float
    na_ratio_y: float


def effective_seidel(lens: Lens, source: Source, numbers: int | None = None) -> EffectiveSeidel:
    """Return the six coefficients of one source's exact wavefront; ``numbers`` sets the size of the fit, as in `fit`.

    Raises GeometryError and GlassError as `fit` and `coefficients` do.
    """
    seidel = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    found = fit(lens, source, numbers)
    w40, w31, w22, square, tilt, _ = -(_projection(found.level)[0] @ found.phase)
    chief = float(pencil(lens, source, [0.0], [1e-3]).chief_y[0])
    scale = float(seidel.reduced_slope) / source.wavelength_um
    # A chief ray on the axis does not move; its tilt is rounding.
    w11 = tilt + (chief - float(seidel.image_height)) * UM_PER_MM * scale if source.field_slope else 0.0
    by_name = {"w40": w40, "w31": w31, "w22": w22, "w20": square - float(seidel.wd), "w11": w11}
    fitted = replace(seidel, **{name: np.asarray(value) for name, value in by_name.items()})
    slope_x, slope_y = _mean_slopes(found)
    return EffectiveSeidel(fitted, seidel, _remainder(found), slope_x / scale, slope_y / scale)


@lru_cache(maxsize=8)
def _projection(level: Level) -> tuple[np.ndarray, np.ndarray]:
    """Return the matrices from a level's phase coefficients to those of the six shapes, (6, terms), and to the rest."""
    nodes = disc_nodes(level.wave_order // 2 + 4, 2 * level.wave_order + 10)
    values = basis(level.wave_order, nodes.xi, nodes.eta)
    square = nodes.xi**2 + nodes.eta**2
    shapes = np.stack([square**2, square * nodes.eta, nodes.eta**2, square, nodes.eta, np.ones_like(square)])
    root = np.sqrt(nodes.weight)
    project = np.linalg.pinv((shapes * root).T) @ (values * root).T
    # The six shapes are combinations of the orthonormal terms, and so is the rest.
    return project, np.eye(len(values)) - (values * nodes.weight) @ shapes.T @ project


def _remainder(found: FittedPencil) -> float:
    return float(np.linalg.norm(_projection(found.level)[1] @ found.phase))


def _mean_slopes(found: FittedPencil) -> tuple[float, float]:
    """Return the best-fitting slopes over the disc of fx along ξ and fy along η, from the linear terms 2ξ and 2η."""
    return 2 * float(found.fx[0]), 2 * float(found.fy[1])
