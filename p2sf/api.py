"""The functions of ``import p2sf``; each imports the modules that it needs when it is first called.

These functions take degrees and nanometres; inside, slopes and micrometres are used (`p2sf.conventions`). An astropy
quantity is converted to the unit that the name of its parameter ends in.

``camera`` is a `Camera`, and a keyword by the name of one of its numbers, such as ``f_number``, sets that number alone.
"""

import os
import warnings
from typing import TYPE_CHECKING, Any, Literal

from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments
from p2sf.errors import P2SFWarning
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.parameters import check_finite
from p2sf.paraxial.seidel import Coefficients
from p2sf.setting import AS_IN_FILE, AimChoice, CameraData, StopChoice, set_up_source, with_camera
from p2sf.threads import using_threads

if TYPE_CHECKING:
    from p2sf.disc.zernike_terms import ZernikeOrder
    from p2sf.figures.measures import Energy, LineSpread, Mtf
    from p2sf.psf.choosing import Choice
    from p2sf.psf.measures import PupilPart
    from p2sf.psf.result import Psf
    from p2sf.pupil.zernike_fit import ZernikeFit

Path = str | os.PathLike[str]
Method = Literal["auto", "seidel", "fitted", "traced", "huygens", "spherical", "gaussian"]
PupilMethod = Literal["auto", "seidel", "fitted", "traced", "huygens", "spherical"]


@check_arguments
def load_lens(name_or_path: Path) -> Lens:
    """Load a shipped lens or a lens file.

    Parameters
    ----------
    name_or_path : str or path
        The name of a shipped lens, such as "double_gauss_28" (``p2sf lenses`` lists them), or a file of P2SF (TOML),
        Zemax, CODE V, OSLO, ray-optics, ray-optics-web, Optiland, DeepLens, ISET, the Optical Bench or a renderer, a
        patent's prescription or a CSV table; the content decides which.

    Returns
    -------
    Lens
        The prescription, frozen.

    Raises
    ------
    LensFileError
        If the name is neither a shipped lens nor a file, if the file cannot be read, or if no catalogue has one of its
        glasses; the message names the line.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.load_lens("double_gauss_28")
    <Lens double_gauss_28: 11 surfaces, stop_semi_diameter 10.5673, aim stop>
    """
    from p2sf.lensfile.library import find_lens

    return find_lens(name_or_path)


@check_arguments
@with_camera
def render(
    lens: Lens,
    source: Source | None = None,
    method: Method = "auto",
    *,
    pixels: int = 64,
    pixel_um: float | None = None,
    quality: Literal["settled", "preview"] = "settled",
    min_r2: float = 0.99,
    clip: bool = False,
    integrated: bool | None = None,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
    threads: int | None = None,
) -> "Psf":
    """Compute the point spread function of one source.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    source : Source, optional
        The point source; by default on the axis, at the distance of the lens's object, of its reference wavelength.
    method : {"auto", "seidel", "fitted", "traced", "huygens", "spherical", "gaussian"}
        How the PSF is computed; "auto" takes the cheapest method whose predicted R² is at least ``min_r2``.
    pixels : int
        Samples along each side.
    pixel_um : float, optional
        Distance between samples, µm; by default one that shows the whole PSF.
    quality : {"settled", "preview"}
        Converged (relative L2 error of the sum at most 1e-4), or fast.
    min_r2 : float
        Smallest R² against the exact reference that "auto" accepts.
    clip : bool
        Stop rays at every clear semi-diameter, not only at the aperture stop.
    integrated : bool, optional
        Whether a sample is the light on the pixel around it; by default where pixels are wider than λ/(4 NA).
    camera : Camera
        How the camera is set; by default as the lens file has it. The keywords ``focus_mm``, ``sensor_shift_um``,
        ``f_number``, ``stop`` and ``aim`` set one of its numbers each.
    threads : int, optional
        For a sum of many rays; by default P2SF_THREADS or the number of cores. No result depends on it.

    Returns
    -------
    Psf
        Samples with unit sum, rows towards the field. A ``P2SFWarning`` says where the window holds too little light,
        but not of a "preview" whose samples are too far apart to tell.

    Raises
    ------
    RequestError, GeometryError, GlassError, SamplingError
        For an invalid value or one stated twice; a lens that forms no image of this source; a wavelength outside the
        data of a glass; a grid too coarse or too large for the PSF.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> p2sf.render(lens, p2sf.Source(field_deg=10), camera=p2sf.Camera(focus_mm=3000, f_number=5.6)).method
    'spherical'
    """
    from p2sf.psf.methods import PsfOptions
    from p2sf.psf.pixel_integrals import render_setup
    from p2sf.psf.result import warn_of_window

    setup = set_up_source(lens, source, camera)
    with using_threads(threads):
        options = PsfOptions(quality, min_r2, clip)
        psf = render_setup(setup, method, pixels, pixel_um, options, integrated)
    return warn_of_window(psf, 5)


@check_arguments
@with_camera
def coefficients(
    lens: Lens,
    source: Source | None = None,
    *,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> Coefficients:
    """Compute the six wavefront coefficients of one source (Pieroni et al. 2015; Welford 1986, ch. 8).

    Parameters are as for `render`. Raises RequestError, GeometryError and GlassError as it does.

    Returns
    -------
    Coefficients
        W40, W31, W22, W20, W11 and Wd in waves, peak values at this field; numerical aperture, image distance and
        image height in mm. W = (optical path of the chief ray − that of the ray)/λ. Those of a lens with tilted or
        decentred parts are of the aligned lens, as a ``P2SFWarning`` says.

    Examples
    --------
    >>> import p2sf
    >>> six = p2sf.coefficients(p2sf.load_lens("double_gauss_28"), p2sf.Source(field_deg=10))
    >>> round(float(six.w40), 2)
    6.45
    """
    from p2sf.paraxial import seidel

    setup = set_up_source(lens, source, camera)
    place = setup.source.depth_mm, setup.source.field_slope, setup.source.wavelength_um
    seidel.check_seidel(setup.lens)
    if aligned := seidel.of_aligned_lens(setup.lens):
        warnings.warn(str(aligned), P2SFWarning, stacklevel=4)
    return seidel.coefficients(setup.lens, *place, setup.stop)


@check_arguments
@with_camera
def zernike(
    lens: Lens,
    source: Source | None = None,
    basis: "ZernikeOrder" = "noll",
    terms: int = 37,
    *,
    clip: bool = False,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "ZernikeFit":
    """Decompose the exact wavefront of one source into Zernike terms, orthogonal over the open part of the pupil.

    Parameters are as for `render`, and these. Raises RequestError, GeometryError and GlassError as it does.

    Parameters
    ----------
    basis : {"noll", "fringe"}
        Noll's order with waves RMS, or the Fringe order of 37 terms with peak waves.
    terms : int
        Number of terms, from the first.
    clip : bool
        Stop rays at every clear semi-diameter; the terms are then orthogonal over what remains of the pupil.

    Returns
    -------
    ZernikeFit
        For each term its coefficient in waves and its share of the variance without piston and tilt; RMS without them,
        and residual. The wavefront is (optical path of the chief ray − that of the ray)/λ on the sphere about the chief
        ray's sensor point.

    Examples
    --------
    >>> import p2sf
    >>> found = p2sf.zernike(p2sf.load_lens("telephoto"), p2sf.Source(field_deg=7))
    >>> found.terms[6].name, round(float(found.waves[6]), 3), round(found.rms, 3)
    ('coma', -0.057, 0.138)
    """
    from p2sf.pupil.zernike_fit import zernike_fit

    setup = set_up_source(lens, source, camera)
    return zernike_fit(setup.lens, setup.source, basis, terms, clip)


@check_arguments
@with_camera
def choose_method(
    lens: Lens,
    source: Source | None = None,
    min_r2: float = 0.99,
    *,
    clip: bool = False,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "Choice":
    """Choose the cheapest method whose predicted R² is at least ``min_r2``, without computing the reference.

    Parameters are as for `render`; ``min_r2`` is below 1, and R² that in a window that shows the whole PSF. Raises
    RequestError, GeometryError (also if the chief ray does not reach the sensor) and GlassError as it does.

    Returns
    -------
    Choice
        The method, its predicted 1 − R², how many numbers describe the PSF, and the reason.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.choose_method(p2sf.load_lens("double_gauss_28"), p2sf.Source(field_deg=10), min_r2=0.99).method
    'fitted'
    """
    from p2sf.psf.choosing import choose

    setup = set_up_source(lens, source, camera)
    return choose(setup.lens, setup.source, min_r2, clip)


@check_arguments
@with_camera
def mtf(
    lens: Lens,
    source: Source | None = None,
    method: PupilMethod = "traced",
    *,
    frequency_per_mm: ArrayLike | None = None,
    spectrum: str | None = None,
    turn_deg: float = 0.0,
    clip: bool = False,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "Mtf":
    """Compute the modulation transfer function from the pupil, so that it includes all light and needs no window.

    Parameters are as for `render`, and these.

    Parameters
    ----------
    method : {"traced", "huygens", "fitted", "seidel", "spherical", "auto"}
        What describes the pupil: exact rays ("traced" and "huygens" are the same here), a fit, the six coefficients,
        or what `choose_method` chooses. By default exact rays, which take no longer here than that choice.
    frequency_per_mm : array_like, optional
        Cycles per mm on the sensor, one or (n,); by default evenly spaced up to the cut-off.
    spectrum : str, optional
        A spectrum ("d65", "a", "e", "planck:4300", "lines:486,656"), whose wavelengths are weighted as the eye does,
        with lateral colour. By default only the wavelength of the source.
    turn_deg : float
        Angle of the tangential patterns to the direction of the field, degrees from +y to +x.

    Returns
    -------
    Mtf
        Tangential and sagittal contrast, and that of the same pupil without aberration, which they never exceed.

    Raises
    ------
    RequestError, GeometryError, GlassError
        As for `render`; GeometryError also if rays from different parts of the pupil arrive in the same direction.
    SamplingError
        If the blur is too large to be summed.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> found = p2sf.mtf(lens, p2sf.Source(field_deg=10), frequency_per_mm=[0, 5], f_number=5.6, aim="paraxial")
    >>> [round(float(value), 2) for value in found.sagittal]
    [1.0, 0.86]
    """
    from p2sf.figures.transfer import line_counts
    from p2sf.psf.measures import mtf_of

    check_finite("turn_deg", turn_deg)
    how = {"method": method, "clip": clip, "turn_deg": turn_deg, "check": line_counts}
    parts, used = _pupil_parts(lens, source, spectrum, camera, **how)
    return mtf_of(parts, used, frequency_per_mm, turn_deg=turn_deg)


@check_arguments
@with_camera
def encircled_energy(
    lens: Lens,
    source: Source | None = None,
    method: PupilMethod = "traced",
    *,
    radius_um: ArrayLike | None = None,
    spectrum: str | None = None,
    clip: bool = False,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "Energy":
    """Compute from the pupil which share of all light lies within a radius of the centroid.

    Parameters are as for `mtf`; ``radius_um``: radii, µm, (n,); by default evenly spaced from 0 to beyond
    the blur. Raises RequestError, GeometryError, GlassError and SamplingError as it does.

    Returns
    -------
    Energy
        The share within each radius; the radii of 50 % and 80 % of all light and the RMS distance of the rays, µm.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> found = p2sf.encircled_energy(lens, f_number=5.6, aim="paraxial")
    >>> round(found.radius_80_um, 1)
    8.7
    """
    from p2sf.psf.measures import energy_in

    parts, used = _pupil_parts(lens, source, spectrum, camera, method=method, clip=clip)
    return energy_in(parts, used, radius_um)


@check_arguments
@with_camera
def line_spread(
    lens: Lens,
    source: Source | None = None,
    method: PupilMethod = "traced",
    *,
    position_um: ArrayLike | None = None,
    spectrum: str | None = None,
    clip: bool = False,
    camera: CameraData = AS_IN_FILE,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "LineSpread":
    """Compute the line and edge spread functions, the images of a line and of an edge, from the pupil.

    Parameters are as for `mtf`; ``position_um``: distances from the centroid, µm, (n,); by default evenly
    spaced over the blur. Raises RequestError, GeometryError, GlassError and SamplingError as it does.

    Returns
    -------
    LineSpread
        Light per µm across a line along y and a line along x, and the share of light across edges dark below 0.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> found = p2sf.line_spread(lens, f_number=5.6, position_um=[0.0], aim="paraxial")
    >>> round(float(found.edge_x[0]), 3)
    0.5
    """
    from p2sf.figures.transfer import line_counts
    from p2sf.psf.measures import spread_of

    parts, used = _pupil_parts(lens, source, spectrum, camera, method=method, clip=clip, check=line_counts)
    return spread_of(parts, used, position_um)


def _pupil_parts(
    lens: Lens, source: Source | None, spectrum: str | None, camera: CameraData, **how: Any
) -> "tuple[list[PupilPart], str]":
    """Return the pupils of a source, one per wavelength, and the method that described them, as `parts_of` has both."""
    from p2sf.colour.spectrum import spectrum_of
    from p2sf.psf.measures import parts_of

    setup = set_up_source(lens, source, camera)
    wanted = None if spectrum is None else spectrum_of(spectrum)
    return parts_of(setup.lens, setup.source, spectrum=wanted, **how)
