"""The wavefront behind one PSF given as an array, by the fits that photographs of points are measured with."""

from dataclasses import replace
from math import inf
from typing import Literal

from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, real_array
from p2sf.conventions import NM_PER_UM
from p2sf.errors import RequestError
from p2sf.measure.fitting.point_fit import PointFit
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.frame import Frame, FrameGeometry, Noise
from p2sf.measure.measurement import FrameRequest, measure_frame
from p2sf.messages import Message
from p2sf.parameters import check_positive

NOT_FITTED = Message("no point is in this picture; give one whose middle holds its light")


@check_arguments
def fit_psf(
    values: ArrayLike,
    na: float,
    wavelength_nm: float,
    pixel_um: float,
    *,
    model: Literal["seidel", "26", "46"] = "seidel",
    integrated: bool = True,
    noise: float | None = None,
) -> PointFit:
    """Find the wavefront that explains a PSF, measured or computed elsewhere, by least squares.

    Parameters
    ----------
    values : array_like
        Samples of the intensity in any unit, (rows, columns), rows towards the direction of the field, the chief ray at
        sample N//2 of either axis, as `Psf.values` has them; NaN does not count.
    na : float
        Numerical aperture of the image.
    wavelength_nm, pixel_um : float
        Wavelength, nm, and distance between samples, µm.
    model : {"seidel", "26", "46"}
        W40, W31, W22 and W20 + Wd with the paraxial pupil, or that many numbers of a wavefront and of a pupil map.
    integrated : bool
        Whether a sample is the light on a whole pixel, or the intensity at a point.
    noise : float, optional
        Standard deviation of a sample in units of ``values``; estimated from them when not given.

    Returns
    -------
    PointFit
        ``names`` and ``numbers``, in waves; ``errors``, one standard deviation of each; ``r2`` of the picture that they
        make; ``waves(xi, eta)``, the wavefront; ``others``, which explain the picture as well: one picture in focus
        leaves the sign of what is even in the pupil open.

    Raises
    ------
    RequestError
        For values that are no picture of one point, or numbers that cannot be.

    Examples
    --------
    >>> import p2sf
    >>> point = p2sf.Camera("achromat_f6", focus_mm=5000).at(depth_mm=5000, wavelength_nm=550)
    >>> psf = point.psf("seidel")
    >>> found = p2sf.fit_psf(psf.values, float(point.coefficients().na), 550, psf.pixel_um, integrated=False)
    >>> bool(found.r2[0] > 0.9999)
    True
    """
    for name, value in (("na", na), ("wavelength_nm", wavelength_nm), ("pixel_um", pixel_um), ("noise", noise)):
        check_positive(name, value)
    picture = real_array("values", values)
    if picture.ndim != 2 or min(picture.shape) < 2:
        raise RequestError("a frame of shape {shape}; give rows and columns of counts", shape=str(picture.shape))
    rows, columns = picture.shape
    below = (rows - 1) // 2 + 1.0, float(columns // 2)  # the axis: so the field points to +y
    geometry = FrameGeometry(rows, columns, pixel_um, below)
    frame = Frame(picture[::-1], geometry, Noise(inf, noise), psf=True, integrated=integrated)
    optics = PictureOptics(na, wavelength_nm / NM_PER_UM, pixel_um, 1.0 if integrated else 0.0)
    made = measure_frame([frame], optics, FrameRequest(model=model))
    if made.fits[0] is None:
        raise RequestError(made.failures[0] or NOT_FITTED)
    found = made.fits[0]
    return replace(found, warnings=(*found.warnings, frame.clipped)) if frame.clipped else found
