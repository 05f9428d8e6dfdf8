"""Figures of a camera at object points: plain results of one point, arrays with named axes over several.

Each of several points is what it is alone, bit for bit. They share the lens as it is set, the rays of each point all
its figures, and threads or a cluster the points.
"""

import sys
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial, wraps
from inspect import signature
from typing import TYPE_CHECKING, Any, Concatenate, Generic, Literal, ParamSpec, TypeVar, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from p2sf.api import Method, PupilMethod
from p2sf.arguments import check_arguments, in_own_unit
from p2sf.cluster import checked_client
from p2sf.conventions import centred_axis, write_protect
from p2sf.errors import P2SFWarning, RequestError
from p2sf.lens.source import Source
from p2sf.messages import Alternatives
from p2sf.named_arrays import Dims, NamedArrays, NamedAxes, along
from p2sf.parameters import CAMERA_PARAMETERS, MASK_PARAMETERS, check_finite, check_samples, check_whole
from p2sf.setting import CameraData, Setup, explicit_values, set_up_source
from p2sf.threads import for_each, one_blas_thread, using_threads

if TYPE_CHECKING:
    from p2sf.disc.zernike_terms import ZernikeOrder
    from p2sf.figures.measures import Energy, LineSpread, Mtf
    from p2sf.paraxial.first_order_data import FirstOrder
    from p2sf.paraxial.seidel import Coefficients
    from p2sf.performance import Performance
    from p2sf.psf.choosing import Choice
    from p2sf.psf.measures import PupilPart
    from p2sf.psf.result import Psf
    from p2sf.pupil.zernike_fit import ZernikeFit
    from p2sf.raytrace.pencil import Rays

OF_THE_SOURCE = "depth_mm", "field_x_deg", "field_deg", "wavelength_nm"
AXES = (*(each.name for each in (*CAMERA_PARAMETERS, *MASK_PARAMETERS)), *OF_THE_SOURCE)
"""What may be an axis, in the order of the axes."""
RINGS = 1, 1000  # of rays: three million at most

One = Literal["one"]
Several = Literal["several"]
Count = TypeVar("Count", bound=str)
"""Whether points are `One`, without axes, or `Several`; for type checkers alone."""
P = ParamSpec("P")
R = TypeVar("R")
Arguments = Mapping[str, Any]


class Figure(Generic[P, R]):
    """A method of `ObjectPoints` for type checkers: its own result of one point, `NamedArrays` of several."""

    @overload
    def __get__(self, points: "ObjectPoints[One]", owner: type) -> Callable[P, R]: ...

    @overload
    def __get__(self, points: "ObjectPoints[Several]", owner: type) -> Callable[P, NamedArrays]: ...

    def __get__(self, points: Any, owner: type) -> Any:
        raise NotImplementedError


def figure(
    names: str, axes: Callable[[Arguments], NamedAxes] = lambda given: {}
) -> Callable[[Callable[Concatenate["ObjectPoints[Any]", P], R]], Figure[P, R]]:
    """Decorate the method of one point, so that several answer by arrays of these attributes of its result.

    ``axes``: the coordinates that the arguments of the call give the arrays behind those of the points. An attribute
    that is an array lies along all of them, a number along none.
    """

    def decorate(compute: Callable[Concatenate["ObjectPoints[Any]", P], R]) -> Figure[P, R]:
        of_one = check_arguments(compute)
        parameters = signature(compute)

        @wraps(of_one)
        def call(points: "ObjectPoints[Any]", *args: Any, **kwargs: Any) -> Any:
            if not points.sizes:
                with using_threads(points.threads):
                    found = of_one(points.points[0], *args, **kwargs)
                _warn([_caution(found)])
                return found
            bound = parameters.bind(points, *args, **kwargs)
            bound.apply_defaults()
            given = points.with_one_pitch(dict(list(bound.arguments.items())[1:]))
            behind = axes(given)
            every = points.compute(partial(_figures, name=compute.__name__, given=given, names=names.split()))
            _warn([one.pop(CAUTION) for one in every])
            return points.stack(every, behind)

        return cast("Figure[P, R]", call)

    return decorate


def _asked(name: str) -> Callable[[Arguments], NamedAxes]:
    """Return the axis along a parameter, which several points need, since each has a range of its own."""
    return lambda given: along(name, _axis(name, given[name]))


def _pixels(given: Arguments) -> NamedAxes:
    check_samples(given["pixels"], given["pixel_um"])
    axis = centred_axis(given["pixels"], given["pixel_um"])
    return along("y_um", axis) | along("x_um", axis) | along("pixel_um", np.array(given["pixel_um"]))


def _terms(given: Arguments) -> NamedAxes:
    from p2sf.disc.zernike_terms import zernike_terms

    known = zernike_terms(given["basis"], given["terms"])
    names = {"name": (("term",), np.array([term.name for term in known]))}
    return along("term", np.array([term.number for term in known])) | names


def _rings(given: Arguments) -> NamedAxes:
    from p2sf.raytrace.pencil import hexapolar

    check_whole("rings", given["rings"], *RINGS)
    return along("ray", np.arange(hexapolar(given["rings"])[0].size))


@dataclass(frozen=True)
class Peak:
    """The peak of a PSF: Strehl ratio, place in µm from the chief ray, NaN without a pupil, and the window's light."""

    strehl: float
    peak_x_um: float
    peak_y_um: float
    energy: float


@dataclass(frozen=True, eq=False)
class ObjectPoints(Generic[Count]):
    """Object points before a camera, as `Camera.at` returns them; every figure is computed when it is asked for.

    One point answers by the result itself, such as `p2sf.Psf`. Over arrays of depths, fields, wavelengths or the
    camera's own numbers each array is an axis by its name, in the order depth, field, wavelength behind the camera's
    numbers, and figures are `NamedArrays`: ``found["tangential"]``, ``found.to_xarray()``.

    Parameters
    ----------
    camera : Camera
        With its lens.
    axes : dict
        By name one number or an array (n,): ``depth_mm``, ``field_deg``, ``field_x_deg``, ``wavelength_nm`` (see
        `Camera.source`), or any setting of a camera that it does not state itself, such as ``f_number``.
    given : Source, optional
        The source, instead of those four.
    threads, progress, scheduler
        As for `Camera.at`.

    Raises
    ------
    RequestError
        For a camera without a lens, a name that is no axis, and values that cannot be.

    Examples
    --------
    >>> import p2sf
    >>> camera = p2sf.Camera("double_gauss_28", focus_mm=3000)
    >>> camera.at(depth_mm=3000, field_deg=7, wavelength_nm=550).choose_method().method
    'traced'
    >>> points = camera.at(field_deg=[0, 7], wavelength_nm=[450, 550, 650], f_number=[5.6, 8, 11])
    >>> points
    <ObjectPoints of double_gauss_28: f_number 3 × field_deg 2 × wavelength_nm 3>
    >>> points.strehl()["strehl"].shape
    (3, 2, 3)
    """

    camera: CameraData
    axes: Mapping[str, ArrayLike] = field(default_factory=dict)
    given: Source | None = None
    threads: int | None = None
    progress: Callable[[float], object] | bool = False
    scheduler: Any = None

    def __post_init__(self) -> None:
        own = explicit_values(self.camera.settings)
        for name in self.axes:
            if name not in AXES:
                raise RequestError(
                    '"{name}" is neither of a source nor of a camera; choose {choices}',
                    name=name,
                    choices=Alternatives(AXES),
                )
            other = "source" if self.given is not None and name in OF_THE_SOURCE else f"camera.{name}"
            if name in own or other == "source":
                raise RequestError(
                    "{parameter} and {other} are both given; keep one of them", parameter=name, other=other
                )
        ordered = {name: _axis(name, self.axes[name]) for name in AXES if name in self.axes}
        object.__setattr__(self, "axes", ordered)
        _ = self.camera.its_lens, self.points

    @property
    def shape(self) -> tuple[int, ...]:
        """Return the length of every axis; () of one point."""
        return tuple(self.sizes.values())

    @property
    def sizes(self) -> dict[str, int]:
        """Return the length of every axis by its name."""
        return {name: np.size(values) for name, values in self.axes.items() if np.ndim(values)}

    @cached_property
    def points(self) -> "tuple[ObjectPoints[One], ...]":
        """Return every point by itself, the last axis fastest."""
        names = list(self.sizes)
        fixed = {name: values for name, values in self.axes.items() if name not in names}
        found: list[ObjectPoints[One]] = []
        for place in np.ndindex(self.shape):
            moving = {name: np.asarray(self.axes[name])[k] for name, k in zip(names, place, strict=True)}
            found.append(self._point(fixed | moving) if self.axes or self.given is None else cast("Any", self))
        return tuple(found)

    def _point(self, values: Mapping[str, Any]) -> "ObjectPoints[One]":
        """Return the point at these values; RequestError for values that cannot be."""
        plain = {name: np.asarray(value).item() for name, value in values.items()}
        moved = {name: plain.pop(name) for name in tuple(plain) if name not in OF_THE_SOURCE}
        across, up = plain.pop("field_x_deg", 0.0), plain.pop("field_deg", 0.0)
        camera = replace(self.camera, **moved)
        source = self.given or camera.source(**plain, field_deg=(across, up))
        return ObjectPoints(camera, given=source, threads=self.threads)

    @property
    def source(self) -> Source:
        """Return the source of one point; RequestError of several."""
        if self.sizes:
            raise RequestError("{count} points have as many sources; ask one of them", count=len(self.points))
        return self.given or self.points[0].source

    @cached_property
    def setup(self) -> Setup:
        """Return the lens as it is set, and the source, of one point; RequestError of several."""
        camera = self.points[0].camera
        return set_up_source(camera.its_lens, self.source, camera.settings)

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """Return what all points are of, as `Psf.provenance` has it; what differs lies along the axes."""
        from p2sf.io.record import common, describe

        return common([describe(one.setup) for one in self.points])

    @figure("psf=values energy method predicted_error", _pixels)
    def psf(
        self,
        method: Method = "auto",
        *,
        pixels: int = 64,
        pixel_um: float | None = None,
        quality: Literal["settled", "preview"] = "settled",
        min_r2: float = 0.99,
        clip: bool = False,
        integrated: bool | None = None,
    ) -> "Psf":
        """Return the PSF, of unit sum in its window; parameters and errors are those of `p2sf.render`.

        Of several points: ``psf`` (…, y_um, x_um), with ``energy``, the share of all light in it, ``method`` and its
        ``predicted_error``, 1 − R². All have the pixels of the camera; without, those with which the widest of them is
        shown whole. A ``P2SFWarning`` says where a window holds too little. Peaks, whose search takes half the time of
        a PSF, are those of `strehl`.
        """
        return self._render(method, pixels, pixel_um, integrated, quality=quality, min_r2=min_r2, clip=clip)

    @figure("strehl peak_x_um peak_y_um energy")
    def strehl(
        self,
        method: Method = "auto",
        *,
        pixels: int = 64,
        pixel_um: float | None = None,
        quality: Literal["settled", "preview"] = "settled",
        min_r2: float = 0.99,
        clip: bool = False,
    ) -> Peak:
        """Return ``strehl``, ``peak_x_um`` and ``peak_y_um``, where the peak is, and ``energy`` of the PSF.

        Parameters are those of `psf`. NaN where a method has no pupil.
        """
        psf = self._render(method, pixels, pixel_um, quality=quality, min_r2=min_r2, clip=clip)
        x, y = (np.nan, np.nan) if psf.peak_um is None else psf.peak_um
        return Peak(_or_nan(psf.strehl), float(x), float(y), _or_nan(psf.energy))

    def _render(
        self, method: str, pixels: int, pixel_um: float | None, integrated: bool | None = None, **options: Any
    ) -> "Psf":
        """Return the PSF of one point on the pixels asked for, or else the camera's."""
        from p2sf.psf.methods import PsfOptions
        from p2sf.psf.pixel_integrals import render_setup

        pitch = self.camera.pixel_um if pixel_um is None else pixel_um
        return render_setup(self.setup, method, pixels, pitch, PsfOptions(**options), integrated)

    @figure("tangential sagittal perfect_tangential perfect_sagittal", _asked("frequency_per_mm"))
    def mtf(
        self,
        frequency_per_mm: ArrayLike | None = None,
        method: PupilMethod = "traced",
        *,
        spectrum: str | None = None,
        turn_deg: float = 0.0,
        clip: bool = False,
    ) -> "Mtf":
        """Return the modulation transfer function of the pupil, which includes all light and needs no window.

        Parameters
        ----------
        frequency_per_mm : array_like, optional
            Cycles per mm on the sensor, one or (n,); of one point by default evenly spaced up to the cut-off.
        method : {"traced", "huygens", "fitted", "seidel", "spherical", "auto"}
            What describes the pupil: exact rays ("traced" and "huygens" are the same here), a fit, the six
            coefficients, or what `choose_method` chooses. Exact rays take no longer here than that choice.
        spectrum : str, optional
            A spectrum ("d65", "a", "e", "planck:4300", "lines:486,656"), whose wavelengths are weighted as the eye
            does, with lateral colour. By default only the wavelength of the source.
        turn_deg : float
            Angle of the tangential patterns to the direction of the field, degrees from +y to +x.
        clip : bool
            Stop rays at every clear semi-diameter.

        Returns
        -------
        Mtf
            Tangential and sagittal contrast, and that of the same pupil without aberration, which they never exceed.

        Raises
        ------
        RequestError, GeometryError, GlassError
            As for `p2sf.render`; GeometryError also if rays from different parts of the pupil arrive in the same
            direction.
        SamplingError
            If the blur is too large to be summed.

        Examples
        --------
        >>> import p2sf
        >>> camera = p2sf.Camera("double_gauss_28", f_number=5.6, aim="paraxial")
        >>> camera.at(field_deg=10, wavelength_nm=587.6).mtf([0, 5]).sagittal.round(2)
        array([1.  , 0.86])
        """
        from p2sf.figures.transfer import line_counts
        from p2sf.psf.measures import mtf_of

        check_finite("turn_deg", turn_deg)
        parts, used = self.parts(method, clip, spectrum, turn_deg, check=line_counts)
        return mtf_of(parts, used, frequency_per_mm, turn_deg=turn_deg)

    @figure("fraction radius_50_um radius_80_um rms_um centroid_um", _asked("radius_um"))
    def energy(
        self,
        radius_um: ArrayLike | None = None,
        method: PupilMethod = "traced",
        *,
        spectrum: str | None = None,
        clip: bool = False,
    ) -> "Energy":
        """Return which share of all light lies within a radius of the centroid, from the pupil.

        Parameters and errors are those of `mtf`; ``radius_um``: radii, µm, one or (n,); of one point by default evenly
        spaced from 0 to beyond the blur. The radii of 50 % and 80 % of all light and the RMS distance of the rays, µm,
        stand beside it.

        Examples
        --------
        >>> import p2sf
        >>> round(p2sf.Camera("double_gauss_28", f_number=5.6, aim="paraxial").at().energy().radius_80_um, 1)
        8.7
        """
        from p2sf.psf.measures import energy_in

        return energy_in(*self.parts(method, clip, spectrum), radius_um)

    @figure("line_x line_y edge_x edge_y", _asked("position_um"))
    def line_spread(
        self,
        position_um: ArrayLike | None = None,
        method: PupilMethod = "traced",
        *,
        spectrum: str | None = None,
        clip: bool = False,
    ) -> "LineSpread":
        """Return the line and edge spread functions, the images of a line and of an edge, from the pupil.

        Parameters and errors are those of `mtf`; ``position_um``: distances from the centroid, µm, one or (n,); of one
        point by default evenly spaced over the blur. Light per µm across a line along y and a line along x, and the
        share of light across edges dark below 0.

        Examples
        --------
        >>> import p2sf
        >>> found = p2sf.Camera("double_gauss_28", f_number=5.6, aim="paraxial").at().line_spread([0.0])
        >>> round(float(found.edge_x[0]), 3)
        0.5
        """
        from p2sf.figures.transfer import line_counts
        from p2sf.psf.measures import spread_of

        return spread_of(*self.parts(method, clip, spectrum, check=line_counts), position_um)

    @figure(
        "rms_waves strehl tangential sagittal radius_80_um distortion illumination lateral_colour_um",
        _asked("frequency_per_mm"),
    )
    def performance(self, frequency_per_mm: ArrayLike = (10.0, 30.0), *, clip: bool = False) -> "Performance":
        """Return what an engineer reads first, by exact rays: see `p2sf.performance.Performance`.

        ``rms_waves``, ``strehl``, contrasts ``tangential`` and ``sagittal`` at ``frequency_per_mm``, ``radius_80_um``,
        ``distortion``, ``illumination`` and ``lateral_colour_um``; NaN where there is no such figure.
        """
        from p2sf.performance import performance_of

        traced = partial(self.parts, "traced", clip)
        frequency = _axis("frequency_per_mm", frequency_per_mm)
        return performance_of(self.setup.lens, self.setup.source, frequency, clip, traced)

    @figure("w40 w31 w22 w20 w11 wd na image_distance_mm=image_distance image_height_mm=image_height")
    def coefficients(self) -> "Coefficients":
        """Return the six wavefront coefficients (Pieroni et al. 2015; Welford 1986, ch. 8).

        W40, W31, W22, W20, W11 and Wd in waves, peak values at this field; numerical aperture, image distance and image
        height in mm. W = (optical path of the chief ray − that of the ray)/λ. Those of a lens with tilted or decentred
        parts are of the aligned lens, as a ``P2SFWarning`` says. Raises RequestError, GeometryError and GlassError as
        `p2sf.render` does.

        Examples
        --------
        >>> import p2sf
        >>> round(float(p2sf.Camera("double_gauss_28").at(field_deg=10, wavelength_nm=587.6).coefficients().w40), 2)
        6.45
        """
        from p2sf.paraxial import seidel

        setup = self.setup
        seidel.check_seidel(setup.lens)
        if aligned := seidel.of_aligned_lens(setup.lens):
            warnings.warn(str(aligned), P2SFWarning, stacklevel=4)
        place = setup.source.depth_mm, setup.source.field_slope, setup.source.wavelength_um
        return seidel.coefficients(setup.lens, *place, setup.stop)

    @figure(
        "focal_length_mm back_focal_from_last_mm front_focal_from_first_mm front_principal_from_first_mm "
        "rear_principal_from_last_mm front_nodal_from_first_mm rear_nodal_from_last_mm stop_surface "
        "stop_semi_diameter_mm entrance_pupil_from_first_mm entrance_pupil_diameter_mm exit_pupil_from_last_mm "
        "exit_pupil_diameter_mm numerical_aperture f_number image_from_last_mm magnification"
    )
    def first_order(self) -> "FirstOrder":
        """Return focal length, focal, principal and nodal points, stop, pupils, aperture, image and magnification.

        See `p2sf.paraxial.first_order_data.FirstOrder`, which states signs. Raises RequestError, GeometryError and
        GlassError as `p2sf.render` does.

        Examples
        --------
        >>> import p2sf
        >>> found = p2sf.Camera("double_gauss_28").at(wavelength_nm=550).first_order()
        >>> round(found.focal_length_mm, 2), round(found.entrance_pupil_diameter_mm, 2)
        (99.98, 33.37)
        """
        from p2sf.paraxial.first_order_data import first_order

        setup = self.setup
        return first_order(setup.lens, setup.source.depth_mm, setup.source.wavelength_um, setup.stop)

    @figure("waves rms_waves share rms marechal residual", _terms)
    def zernike(self, basis: "ZernikeOrder" = "noll", terms: int = 37, *, clip: bool = False) -> "ZernikeFit":
        """Return the Zernike terms of the exact wavefront, orthogonal over the open part of the pupil.

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
            For each term its coefficient in waves and its share of the variance without piston and tilt; RMS without
            them, and residual. The wavefront is (optical path of the chief ray − that of the ray)/λ on the sphere about
            the chief ray's sensor point.

        Raises
        ------
        RequestError, GeometryError, GlassError
            As for `p2sf.render`.

        Examples
        --------
        >>> import p2sf
        >>> found = p2sf.Camera("telephoto").at(field_deg=7, wavelength_nm=587.5618).zernike()
        >>> found.terms[6].name, round(float(found.waves[6]), 3), round(found.rms, 3)
        ('coma', -0.057, 0.138)
        """
        from p2sf.pupil.zernike_fit import zernike_fit

        return zernike_fit(self.setup.lens, self.setup.source, basis, terms, clip)

    @figure("method predicted_error numbers")
    def choose_method(self, min_r2: float = 0.99, *, clip: bool = False) -> "Choice":
        """Return the cheapest method whose predicted R² is at least ``min_r2``, without computing the reference.

        That is its name, its predicted 1 − R², how many numbers describe the PSF, and the reason; ``min_r2`` is below
        1, and R² that in a window that shows the whole PSF. Raises RequestError, GeometryError (also if the chief ray
        does not reach the sensor) and GlassError as `p2sf.render` does.
        """
        from p2sf.psf.choosing import choose

        return choose(self.setup.lens, self.setup.source, min_r2, clip)

    @figure("xi eta x_um y_um phase light", _rings)
    def rays(self, rings: int = 12, *, clip: bool = False) -> "Rays":
        """Return exact rays through points of equal area of the pupil, (ray,): its middle, then rings of 6, 12, 18 ….

        ``xi``, ``eta``: pupil coordinates; ``x_um``, ``y_um``: where they meet the sensor, µm from the chief ray, NaN
        of one that does not; ``phase``: waves, as diffraction sums take them; ``light``: relative energy, behind the
        mask in the stop. See `p2sf.raytrace.pencil.Rays`. Raises GeometryError where the chief ray does not arrive,
        RequestError for other numbers of rings than 1 to 1000.
        """
        from p2sf.pupil.landing import mask_of_rays
        from p2sf.raytrace.pencil import hexapolar, pencil

        check_whole("rings", rings, *RINGS)
        lens, source = self.setup.lens, self.setup.source
        xi, eta = hexapolar(rings)
        mask = mask_of_rays(lens, source)
        passed = np.where(mask.opens(xi, eta), mask.amplitude(xi, eta), 0.0)
        return replace(pencil(lens, source, xi, eta, clip), share=1 / xi.size, mask=passed)

    def parts(
        self, method: str, clip: bool = False, spectrum: str | None = None, turn_deg: float = 0.0, **how: Any
    ) -> "tuple[list[PupilPart], str]":
        """Return the pupils that MTF, energy and spreads are of, as `p2sf.psf.measures.parts_of` does, kept."""
        from p2sf.colour.spectrum import spectrum_of
        from p2sf.psf.measures import parts_of

        key = method, clip, spectrum, turn_deg
        if key not in self._parts_by_request:
            wanted = None if spectrum is None else spectrum_of(spectrum)
            setup = self.setup
            self._parts_by_request[key] = parts_of(setup.lens, setup.source, method, clip, wanted, turn_deg, **how)
        return self._parts_by_request[key]

    @cached_property
    def _parts_by_request(self) -> "dict[tuple[Any, ...], tuple[list[PupilPart], str]]":
        return {}

    def __repr__(self) -> str:
        sizes = " × ".join(f"{name} {size}" for name, size in self.sizes.items()) or "one point"
        return f"<ObjectPoints of {self.camera.its_lens.name}: {sizes}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return ObjectPoints, tuple(getattr(self, name) for name in ("camera", "axes", "given", "threads"))

    def with_one_pitch(self, given: dict[str, Any]) -> dict[str, Any]:
        """Return the arguments of a PSF with the pitch of all windows: as asked, the camera's, or the widest needed."""
        from p2sf.psf.methods import whole_pixel_um

        if "pixel_um" not in given:
            return given
        pitch = in_own_unit("pixel_um", self.camera.pixel_um if given["pixel_um"] is None else given["pixel_um"])
        if pitch is None:
            with one_blas_thread:
                windows = (whole_pixel_um(one.setup.lens, one.source, given["pixels"]) for one in self.points)
                pitch = max(windows)
        return given | {"pixel_um": pitch}

    def stack(self, found: "list[Figures]", behind: NamedAxes) -> NamedArrays:
        """Return the figures of all points, with the axes that they have behind those of the points."""
        coords = {k: part for name, values in self.axes.items() for k, part in along(name, np.asarray(values)).items()}
        own = {name: values.size for name, (dims, values) in behind.items() if dims == (name,)}
        arrays: dict[str, tuple[Dims, np.ndarray]] = {}
        for name, first in found[0].items():
            sizes = own if np.ndim(first) else {}
            values = np.array([one[name] for one in found]).reshape(*self.shape, *sizes.values())
            arrays[name] = (*self.sizes, *sizes), values
        return NamedArrays(arrays, coords | behind, self.provenance)

    def compute(self, figures: "Callable[[ObjectPoints[One]], Figures]") -> "list[Figures]":
        """Return figures of every point, by threads or by a scheduler."""
        found: list[Figures] = []
        tell = _show if self.progress is True else self.progress or (lambda _: None)

        def take(one: Figures) -> None:
            found.append(one)
            tell(len(found) / len(self.points))

        if self.scheduler is None:
            for_each(figures, self.points, take, self.threads, ahead=None)
            return found
        with checked_client(self.scheduler, "map") as scheduler:
            answers = scheduler.map(figures, self.points)
            if hasattr(scheduler, "gather"):  # a client of dask, whose answers are futures
                answers = (one.result() for one in answers)
            for one in answers:
                take(one)
        return found


Figures = dict[str, Any]
"""Of one point, by name."""
CAUTION = "caution"
Caution = tuple[float, str] | None
"""The share of all light in a window, and what a warning says of it."""


def _figures(point: ObjectPoints[One], name: str, given: Arguments, names: list[str]) -> Figures:
    """Return attributes of a figure of one point, ``a=b`` the attribute b under the name a, and its caution."""
    found = getattr(ObjectPoints, name).__wrapped__(point, **given)
    pairs = (each.partition("=") for each in names)
    return {own: _or_nan(getattr(found, other or own)) for own, _, other in pairs} | {CAUTION: _caution(found)}


def _caution(found: Any) -> Caution:
    words = getattr(found, "caution", None)
    return None if words is None else (float(_or_nan(found.energy)), str(words))


def _warn(cautions: list[Caution]) -> None:
    """Warn once, of the window that holds least."""
    said = [each for each in cautions if each is not None]
    if said:
        warnings.warn(min(said)[1], P2SFWarning, stacklevel=3)


def _or_nan(value: Any) -> Any:
    return np.nan if value is None else value


def _axis(name: str, values: ArrayLike | None) -> np.ndarray:
    """Return one value or several, () or (n,); RequestError for more axes, for none, and for what is no number."""
    if values is None:
        raise RequestError("{parameter} is None; give one number or a list of them for all points", parameter=name)
    found = np.asarray(in_own_unit(name, values))
    if (
        found.ndim > 1
        or not found.size
        or found.dtype.kind not in "biufU"
        or (found.dtype.kind == "f" and np.isnan(found).any())
    ):
        raise RequestError(
            "{parameter} has the shape {shape} or contains values that are not finite; "
            "give one number or a list of numbers",
            parameter=name,
            shape=str(found.shape),
        )
    return write_protect(found.copy())


def _show(share: float) -> None:
    """Show on the screen how much is done."""
    print(f"\r{share:4.0%}", end="\n" if share == 1 else "", file=sys.stderr, flush=True)
