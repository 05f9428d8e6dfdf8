"""The functions of ``import p2sf``; each imports the modules that it needs when it is first called.

These functions take degrees and nanometres; inside, slopes and micrometres are used (`p2sf.conventions`). An astropy
quantity is converted to the unit that the name of its parameter ends in.
"""

import os
import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import argument, checked, number_list, real_array
from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.errors import ExportError, P2SFWarning
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.notebook import html_table
from p2sf.parameters import check_angle, check_finite
from p2sf.paraxial.seidel import Coefficients
from p2sf.request import AimChoice, Request, StopChoice, aimed, check_aim, set_up, set_up_source
from p2sf.threads import using_threads

if TYPE_CHECKING:
    from p2sf.database_files.provenance import Stored
    from p2sf.metrics.measures import Energy, LineSpread, Mtf, PupilPart
    from p2sf.psf.methods import Choice
    from p2sf.psf.result import Psf
    from p2sf.pupil.zernike_terms import ZernikeOrder
    from p2sf.raytrace.zernike_fit import ZernikeFit
    from p2sf.scene.plan import Plan
    from p2sf.scene.scene import Scene
    from p2sf.studies.tradeoff import MethodCost

Path = str | os.PathLike[str]
Method = Literal["auto", "seidel", "fitted", "traced", "huygens", "gaussian"]
PupilMethod = Literal["auto", "seidel", "fitted", "traced", "huygens"]
ON_AXIS = Source()


@checked
def load_lens(name_or_path: Path) -> Lens:
    """Load a shipped lens or a lens file.

    Parameters
    ----------
    name_or_path : str or path
        The name of a shipped lens, such as "double_gauss_28" (``p2sf lenses`` lists them), or a file of P2SF (TOML),
        Zemax, CODE V, OSLO, ray-optics, ISET or the Optical Bench, or a CSV table; the content decides which.

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


@checked
def render(
    lens: Lens,
    source: Source = ON_AXIS,
    method: Method = "auto",
    *,
    pixels: int = 64,
    pixel_um: float | None = None,
    quality: Literal["settled", "preview"] = "settled",
    tolerance: float = 0.99,
    clip: bool = False,
    integrated: bool | None = None,
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
    source : Source
        The point source; by default at infinity, on the axis.
    method : {"auto", "seidel", "fitted", "traced", "huygens", "gaussian"}
        How the PSF is computed; "auto" takes the cheapest method whose predicted R² is at least ``tolerance``.
    pixels : int
        Samples along each side.
    pixel_um : float, optional
        Distance between samples, µm; by default one that shows the whole PSF.
    quality : {"settled", "preview"}
        Converged (relative L2 error of the sum at most 1e-4), or fast.
    tolerance : float
        Smallest R² against the exact reference that "auto" accepts.
    clip : bool
        Stop rays at every clear semi-diameter, not only at the aperture stop.
    integrated : bool, optional
        Whether a sample is the light on the square pixel around it, or the intensity at its place. By default it is
        the light where pixels are wider than λ/(4 NA), up to which samples hold all of a PSF.
    focus_mm : float, optional
        Focus on the plane this far in front of the first vertex, mm; inf is allowed. By default the sensor stays where
        the lens has it.
    sensor_shift_um : float
        Then move the sensor by this much away from the lens, µm.
    f_number : float, optional
        Focal length over entrance-pupil diameter, in place of the lens's aperture.
    stop : {"file", "auto"}
        The stop that the lens names, or the narrowest rim at this depth.
    aim : {"stop", "paraxial"}, optional
        Whether exact rays fill the real stop or the paraxial entrance pupil; by default as the lens says
        (``Lens.aim``). "real" is the former name of "stop".
    threads : int, optional
        Number of threads for a sum of many rays; the result does not depend on it. By default the environment
        variable P2SF_THREADS, or else the number of cores.

    Returns
    -------
    Psf
        Samples with unit sum, rows towards the field, and how they were computed. ``energy`` is the share of all light
        that falls into the window; below 0.9 a ``P2SFWarning`` says so.

    Raises
    ------
    RequestError
        If a value is invalid.
    GeometryError
        If the lens forms no image of this source.
    GlassError
        If the wavelength is outside the data of a glass.
    SamplingError
        If the grid is too coarse or too large for the PSF.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> p2sf.render(lens, p2sf.Source(field_deg=10), focus_mm=3000, f_number=5.6).method
    'fitted'
    """
    from p2sf.psf.pixel_integrals import render_integrated
    from p2sf.psf.result import warned

    setup = set_up_source(
        lens, source, focus_mm=focus_mm, sensor_shift_um=sensor_shift_um, f_number=f_number, stop=stop, aim=aim
    )
    with using_threads(threads):
        psf = render_integrated(
            setup.lens, setup.source, method, pixels, pixel_um, tolerance, quality, clip, integrated
        )
    return warned(replace(psf, azimuth_deg=source.azimuth_deg) if source.azimuth_deg else psf, 4)


@checked
def coefficients(
    lens: Lens,
    source: Source = ON_AXIS,
    *,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> Coefficients:
    """Compute the six wavefront coefficients of one source (Pieroni et al. 2015; Welford 1986, ch. 8).

    Parameters
    ----------
    lens, source, focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`.

    Returns
    -------
    Coefficients
        W40, W31, W22, W20, W11 and Wd in waves, peak values at this field; numerical aperture, image distance and
        image height in mm. W = (optical path of the chief ray − that of the ray)/λ.

    Raises
    ------
    RequestError, GeometryError, GlassError
        As for `render`.

    Examples
    --------
    >>> import p2sf
    >>> six = p2sf.coefficients(p2sf.load_lens("double_gauss_28"), p2sf.Source(field_deg=10))
    >>> round(float(six.w40), 2)
    6.45
    """
    from p2sf.paraxial import seidel

    setup = set_up_source(
        lens, source, focus_mm=focus_mm, sensor_shift_um=sensor_shift_um, f_number=f_number, stop=stop, aim=aim
    )
    place = source.depth_mm, source.field_slope, source.wavelength_um
    seidel.check_seidel(setup.lens)
    return seidel.coefficients(setup.lens, *place, setup.stop)


@checked
def zernike(
    lens: Lens,
    source: Source = ON_AXIS,
    basis: "ZernikeOrder" = "noll",
    terms: int = 37,
    *,
    clip: bool = False,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "ZernikeFit":
    """Decompose the exact wavefront of one source into Zernike terms, orthogonal over the open part of the pupil.

    Parameters
    ----------
    lens, source, focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`.
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

    Raises
    ------
    RequestError, GeometryError, GlassError
        As for `render`.

    Examples
    --------
    >>> import p2sf
    >>> found = p2sf.zernike(p2sf.load_lens("telephoto"), p2sf.Source(field_deg=7))
    >>> found.terms[6].name, round(float(found.waves[6]), 3), round(found.rms, 3)
    ('coma', -0.057, 0.138)
    """
    from p2sf.raytrace.zernike_fit import zernike_fit

    setup = set_up_source(
        lens, source, focus_mm=focus_mm, sensor_shift_um=sensor_shift_um, f_number=f_number, stop=stop, aim=aim
    )
    return zernike_fit(setup.lens, setup.source, basis, terms, clip)


@checked
def choose_method(
    lens: Lens,
    source: Source = ON_AXIS,
    tolerance: float = 0.99,
    *,
    clip: bool = False,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "Choice":
    """Choose the cheapest method whose predicted R² is at least ``tolerance``, without computing the reference.

    Parameters
    ----------
    lens, source, focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`.
    tolerance : float
        Least R² against the exact reference, below 1, in a window that shows the whole PSF.
    clip : bool
        Stop rays at every clear semi-diameter.

    Returns
    -------
    Choice
        The method, its predicted 1 − R², how many numbers describe the PSF, and the reason.

    Raises
    ------
    RequestError
        If a value is invalid, such as a tolerance that is not below 1.
    GeometryError
        If the lens forms no image of this source, or the chief ray does not reach the sensor.
    GlassError
        If the wavelength is outside the data of a glass.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.choose_method(p2sf.load_lens("double_gauss_28"), p2sf.Source(field_deg=14), tolerance=0.99).method
    'fitted'
    """
    from p2sf.psf.methods import choose

    setup = set_up_source(
        lens, source, focus_mm=focus_mm, sensor_shift_um=sensor_shift_um, f_number=f_number, stop=stop, aim=aim
    )
    return choose(setup.lens, source, tolerance, clip)


@checked
def mtf(
    lens: Lens,
    source: Source = ON_AXIS,
    method: PupilMethod = "traced",
    *,
    frequency_per_mm: ArrayLike | None = None,
    spectrum: str | None = None,
    turn_deg: float = 0.0,
    clip: bool = False,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "Mtf":
    """Compute the modulation transfer function from the pupil, so that it includes all light and needs no window.

    Parameters
    ----------
    lens, source, clip, focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`.
    method : {"traced", "huygens", "fitted", "seidel", "auto"}
        What describes the pupil: exact rays ("traced" and "huygens" are the same here), a fit, the six coefficients,
        or what `choose_method` chooses.
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
    from p2sf.metrics.measures import mtf_of
    from p2sf.metrics.transfer import check_contrast

    camera = {"focus_mm": focus_mm, "sensor_shift_um": sensor_shift_um, "f_number": f_number, "stop": stop, "aim": aim}
    check_finite("turn_deg", turn_deg)
    how = {"method": method, "clip": clip, "turn_deg": turn_deg, "check": check_contrast}
    parts, used = _pupil_parts(lens, source, spectrum, camera, **how)
    return mtf_of(parts, used, frequency_per_mm, turn_deg=turn_deg)


@checked
def encircled_energy(
    lens: Lens,
    source: Source = ON_AXIS,
    method: PupilMethod = "traced",
    *,
    radius_um: ArrayLike | None = None,
    spectrum: str | None = None,
    clip: bool = False,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "Energy":
    """Compute from the pupil which share of all light lies within a radius of the centroid.

    Parameters
    ----------
    lens, source, clip, focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`.
    method : {"traced", "huygens", "fitted", "seidel", "auto"}
        What describes the pupil: exact rays ("traced" and "huygens" are the same here), a fit, the six coefficients,
        or what `choose_method` chooses.
    radius_um : array_like, optional
        Radii, µm, (n,); by default evenly spaced from 0 to beyond the blur.
    spectrum : str, optional
        A spectrum ("d65", "a", "e", "planck:4300", "lines:486,656"), whose wavelengths are weighted as the eye does,
        with lateral colour. By default only the wavelength of the source.

    Returns
    -------
    Energy
        The share within each radius; the radii of 50 % and 80 % of all light and the RMS distance of the rays, µm.

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
    >>> found = p2sf.encircled_energy(lens, f_number=5.6, aim="paraxial")
    >>> round(found.radius_80_um, 1)
    8.7
    """
    from p2sf.metrics.measures import energy_in

    camera = {"focus_mm": focus_mm, "sensor_shift_um": sensor_shift_um, "f_number": f_number, "stop": stop, "aim": aim}
    parts, used = _pupil_parts(lens, source, spectrum, camera, method=method, clip=clip)
    return energy_in(parts, used, radius_um)


@checked
def line_spread(
    lens: Lens,
    source: Source = ON_AXIS,
    method: PupilMethod = "traced",
    *,
    position_um: ArrayLike | None = None,
    spectrum: str | None = None,
    clip: bool = False,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "LineSpread":
    """Compute the line and edge spread functions, the images of a line and of an edge, from the pupil.

    Parameters
    ----------
    lens, source, clip, focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`.
    method : {"traced", "huygens", "fitted", "seidel", "auto"}
        What describes the pupil: exact rays ("traced" and "huygens" are the same here), a fit, the six coefficients,
        or what `choose_method` chooses.
    position_um : array_like, optional
        Distances from the centroid, µm, (n,); by default evenly spaced over the blur.
    spectrum : str, optional
        A spectrum ("d65", "a", "e", "planck:4300", "lines:486,656"), whose wavelengths are weighted as the eye does,
        with lateral colour. By default only the wavelength of the source.

    Returns
    -------
    LineSpread
        Light per µm across a line along y and a line along x, and the share of light across edges dark below 0.

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
    >>> found = p2sf.line_spread(lens, f_number=5.6, position_um=[0.0], aim="paraxial")
    >>> round(float(found.edge_x[0]), 3)
    0.5
    """
    from p2sf.metrics.measures import spread_of
    from p2sf.metrics.transfer import check_contrast

    camera = {"focus_mm": focus_mm, "sensor_shift_um": sensor_shift_um, "f_number": f_number, "stop": stop, "aim": aim}
    parts, used = _pupil_parts(lens, source, spectrum, camera, method=method, clip=clip, check=check_contrast)
    return spread_of(parts, used, position_um)


def _pupil_parts(
    lens: Lens, source: Source, spectrum: str | None, camera: dict[str, Any], **how: Any
) -> "tuple[list[PupilPart], str]":
    """Return the pupils of a source, one per wavelength, and the method that described them, as `parts_of` has both."""
    from p2sf.colour.spectrum import spectrum_of
    from p2sf.metrics.measures import parts_of

    setup = set_up_source(lens, source, **camera)
    wanted = None if spectrum is None else spectrum_of(spectrum)
    return parts_of(setup.lens, setup.source, spectrum=wanted, **how)


class TradeoffTable(list["MethodCost"]):
    """Result of `tradeoff`: a list of rows that prints as a table."""

    def __repr__(self) -> str:
        lines = self._cells()
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        return "\n".join("  ".join(map(str.ljust, line, widths)).rstrip() for line in lines)

    def _repr_html_(self) -> str:
        head, *rows = self._cells()
        return html_table("Each method against the Huygens sum", head, rows)

    def _cells(self) -> list[tuple[str, ...]]:
        from p2sf.studies.tradeoff import table

        return table(self)


@checked
def tradeoff(
    lens: Lens,
    fields_deg: ArrayLike | None = None,
    depths_mm: ArrayLike = (inf,),
    wavelengths_nm: ArrayLike | None = None,
    *,
    methods: str | Sequence[str] = ("gaussian", "seidel", "fitted", "traced", "huygens"),
    pixels: int = 64,
    pixel_um: float | None = None,
    aim: AimChoice | None = None,
) -> TradeoffTable:
    """Measure the time of each method and its error against the settled Huygens sum of exact rays.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    fields_deg, wavelengths_nm : array_like, optional
        Field angles, degrees, and wavelengths, nm; by default the fields and the middle wavelength of the lens.
    depths_mm : array_like
        Object distances from the first vertex, mm.
    methods : str or sequence of str
        One method, or several.
    pixels : int
        Samples along each side of the compared window.
    pixel_um : float, optional
        Distance between samples, µm; by default one that shows the whole PSF.
    aim : {"stop", "paraxial"}, optional
        As for `render`.

    Returns
    -------
    TradeoffTable
        A list with one row per point, method and quality: errors, numbers, rays, CPU seconds, peak memory in bytes.

    Raises
    ------
    RequestError, GeometryError, GlassError, SamplingError
        As for `render`.

    Examples
    --------
    >>> import p2sf
    >>> rows = p2sf.tradeoff(p2sf.load_lens("landscape"), fields_deg=[0], methods=["seidel"], pixels=16)
    >>> [row.quality for row in rows]
    ['preview', 'settled']
    """
    from p2sf.studies import tradeoff as study

    check_aim(aim)
    fields = None if fields_deg is None else tuple(number_list("fields_deg", fields_deg).tolist())
    for angle in fields or ():
        check_angle("fields_deg", angle)
    depths = number_list("depths_mm", depths_mm, infinite=True).tolist()
    waves = None if wavelengths_nm is None else number_list("wavelengths_nm", wavelengths_nm).tolist()
    methods = (methods,) if isinstance(methods, str) else methods
    return TradeoffTable(study.tradeoff(aimed(lens, aim), fields, depths, waves, methods, pixels, pixel_um))


@checked
def build_database(
    lens: Lens,
    depths_mm: ArrayLike,
    fields_deg: ArrayLike,
    wavelengths_nm: ArrayLike,
    *,
    method: Literal["auto", "seidel", "fitted"] = "auto",
    interpolant: Literal["exact", "table1", "linear"] = "exact",
    fields_x_deg: ArrayLike | None = None,
    path: Path | None = None,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> "Stored":
    """Describe all PSFs of a lens within a range of depths, fields and wavelengths by a few numbers.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    depths_mm, fields_deg, wavelengths_nm : array_like
        Nodes along each axis, ascending: object distances from the first vertex, mm, of which the last may be inf;
        field angles, degrees; wavelengths, nm. The database covers everything between the outermost nodes.
    method : {"auto", "seidel", "fitted"}
        The method whose numbers are stored; "auto" takes the six coefficients where they keep R² ≥ 0.99 everywhere, and
        fits to exact rays elsewhere.
    interpolant : {"exact", "table1", "linear"}
        For "seidel", which "auto" then is: polynomials exact to round-off, the rule of Pieroni et al. 2015, table 1, or
        linear interpolation.
    fields_x_deg : array_like, optional
        For "fitted", which "auto" then is: angles along x, degrees, ascending, where ``fields_deg`` are those along y.
        A lens with tilts or decentres needs them, since its PSFs depend on both.
    path : str or path, optional
        A .npz file to which the database is also written.
    focus_mm, sensor_shift_um, f_number, stop, aim
        As for `render`; the stop "auto" is that for an object at infinity.

    Returns
    -------
    Stored
        ``.psf(source)`` and ``.coefficients(source)`` look up a source. ``.accuracy`` is the predicted 1 − R² of its
        PSFs against exact rays, and above 1e-3 a ``P2SFWarning`` says so; ``.meta`` says where the numbers come from,
        and ``.meta["errors_waves"]`` how exactly they are looked up.

    Raises
    ------
    DatabaseError
        If nodes are not ascending, or if the data of a glass cannot be interpolated.
    RequestError, GeometryError, GlassError
        As for `render`.
    ExportError
        If the name does not end in .npz, or if the file cannot be written.

    Examples
    --------
    >>> import p2sf
    >>> lens = p2sf.load_lens("double_gauss_28")
    >>> database = p2sf.build_database(lens, [2000, 5000, float("inf")], [0, 7, 14], [450, 550, 650])
    >>> database.psf(p2sf.Source(3000, field_deg=5, wavelength_nm=500)).method
    'fitted'
    """
    from p2sf.database.accuracy import build_by, check_kind
    from p2sf.database.space import Space
    from p2sf.database_files import Stored, provenance, save_database

    if path is not None:
        _check_database_path(path)
    check_kind(method, interpolant, fields_x_deg is not None)
    fields = _slopes("fields_deg", fields_deg)
    fields_x = None if fields_x_deg is None else _slopes("fields_x_deg", fields_x_deg)
    request = Request(focus_mm=focus_mm, sensor_shift_um=sensor_shift_um, f_number=f_number, stop=stop, aim=aim)
    setup = set_up(lens, request)
    depths, waves = real_array("depths_mm", depths_mm), real_array("wavelengths_nm", wavelengths_nm)
    space = Space(depths, fields, waves / NM_PER_UM, fields_x)
    database = build_by(setup.lens, space, method, interpolant, setup.stop)
    if path is not None:
        save_database(database, setup.lens, path, setup.stop)
    stored = Stored(database, provenance(database, setup.lens, setup.stop))
    if stored.accuracy.caution:
        warnings.warn(str(stored.accuracy.caution), P2SFWarning, stacklevel=3)
    return stored


def _slopes(name: str, angles_deg: ArrayLike) -> np.ndarray:
    """Return the slopes of field angles in degrees; RequestError, naming the parameter, for one that cannot be."""
    angles = real_array(name, angles_deg)
    for angle in angles.ravel().tolist():
        check_angle(name, angle)
    return slope_from_degrees(angles)


def _check_database_path(path: Path) -> None:
    """Raise ExportError for a place that no database can be written to."""
    from p2sf.files.writing import check_place

    if os.path.splitext(path)[1].lower() != ".npz":
        raise ExportError(
            "{parameter} is {path}; {wanted}, choose a name that ends in {ending}",
            parameter="path",
            path=str(path),
            wanted=Message("a database is a .npz file"),
            ending=".npz",
        )
    check_place(path)


@checked
def open_database(path: Path) -> "Stored":
    """Open a PSF database: a .npz file or a stack written by `build_database` or ``p2sf database build``.

    Parameters
    ----------
    path : str or path
        The file, or the folder of a stack (.zarr).

    Returns
    -------
    Stored
        ``.psf(source)`` and ``.coefficients(source)`` look up a source; ``.meta`` says where the numbers come from.

    Raises
    ------
    DatabaseError
        If the file is missing, damaged, cut short, of another kind or of a newer version.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.open_database("dg.npz").psf(p2sf.Source(field_deg=7))  # doctest: +SKIP
    """
    from p2sf.interchange import open_stored

    return open_stored(path)


@checked
def plan(lens: Lens, scene: "Scene | Path", check: Callable[[], None] | None = None) -> "Plan":
    """Find the cheapest model of a lens that stays within the tolerance of a scene.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    scene : Scene or path
        Sensor, depths, colours and tolerance, or a TOML file that states them (``p2sf plan --help``).
    check : callable, optional
        Called repeatedly during the work; an exception that it raises stops the work.

    Returns
    -------
    Plan
        The plan, for `form_image`. ``.decisions`` says what was decided and why, ``.predicted_error`` is the relative
        error, and ``.meets`` says whether it is within the tolerance.

    Raises
    ------
    RequestError
        If the scene is invalid.
    GeometryError, GlassError
        If the lens cannot form the image of the scene.

    Examples
    --------
    >>> import p2sf
    >>> scene = p2sf.Scene(p2sf.Sensor(rows=20, columns=30, pixel_um=60.0), tolerance=0.2, f_number=8)
    >>> p2sf.plan(p2sf.load_lens("double_gauss_28"), scene).meets
    True
    """
    from p2sf.scene import Scene, read_scene
    from p2sf.scene import plan as cheapest_plan

    scene = argument("scene", scene, Scene | Path)
    return cheapest_plan(lens, scene if isinstance(scene, Scene) else read_scene(scene), check)


@checked
def form_image(
    planned: "Plan",
    values: ArrayLike,
    depth_mm: ArrayLike | None = None,
    *,
    method: Literal["patches", "lowrank"] = "patches",
    surround: Literal["edge", "black"] = "edge",
    threads: int | None = None,
) -> np.ndarray:
    """Form the picture that the sensor receives through the lens, with distortion, illumination, blur and pixels.

    Parameters
    ----------
    planned : Plan
        What `plan` found for the lens and the scene.
    values : array_like
        The scene in linear light, shape (rows, columns, channels) as the scene's sensor and colours say: floats, since
        whole numbers are codes of sRGB in most pictures.
    depth_mm : array_like, optional
        Depth of every pixel, mm, shape (rows, columns), between ``near_mm`` and ``far_mm`` of the scene; by default
        its far end.
    method : {"patches", "lowrank"}
        With overlapping patches, or with a few kernels for the whole picture.
    surround : {"edge", "black"}
        What surrounds the picture: its outermost pixels repeated, or darkness.
    threads : int, optional
        As for `render`.

    Returns
    -------
    numpy.ndarray
        The formed picture, linear light, float32, shape (rows, columns, channels).

    Raises
    ------
    RequestError
        If shapes do not fit the scene, values are not finite or whole numbers, or a depth is outside the scene's.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> scene = p2sf.Scene(p2sf.Sensor(rows=20, columns=30, pixel_um=60.0), tolerance=0.2, f_number=8)
    >>> planned = p2sf.plan(p2sf.load_lens("double_gauss_28"), scene)
    >>> p2sf.form_image(planned, np.ones((20, 30, 3))).shape
    (20, 30, 3)
    """
    from p2sf.image import Forming
    from p2sf.image import form_image as form
    from p2sf.scene.plan import Plan

    depths = None if depth_mm is None else real_array("depth_mm", depth_mm)
    planned = argument("planned", planned, Plan)
    with using_threads(threads):
        return form(planned, values, depths, Forming(method, surround))
