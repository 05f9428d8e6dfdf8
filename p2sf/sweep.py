"""Figures of a camera over named axes: every point of a sweep is what one call of the library says of it, bit for bit.

The points share the lens as it is set, the rays of each point all its figures, and threads or a cluster the points.
Peaks, whose search takes half the time of a PSF, are looked for by `Sweep.strehl` only.
"""

import sys
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import in_own_unit
from p2sf.cluster import checked_client
from p2sf.conventions import centred_axis, write_protect
from p2sf.errors import P2SFWarning, RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Alternatives
from p2sf.named_arrays import Dims, NamedArrays, NamedAxes, along
from p2sf.parameters import CAMERA_PARAMETERS, MASK_PARAMETERS
from p2sf.setting import CameraData, Settings, Setup, explicit_values, set_up_source
from p2sf.threads import for_each, one_blas_thread

if TYPE_CHECKING:
    import xarray

    from p2sf.api import Method, PupilMethod
    from p2sf.disc.zernike_terms import ZernikeOrder
    from p2sf.psf.measures import PupilPart
    from p2sf.psf.result import Psf

OF_THE_SOURCE = "depth_mm", "field_x_deg", "field_deg", "wavelength_nm"
SWEPT = (*(each.name for each in (*CAMERA_PARAMETERS, *MASK_PARAMETERS)), *OF_THE_SOURCE)
"""What a sweep may have as an axis, in the order of its axes."""
SIX = "w40", "w31", "w22", "w20", "w11", "wd"

NOTHING: NamedAxes = {}
"""Behind figures that are one number of each point."""
Figures = dict[str, Any]
"""Of one point, by name."""
Axes = Mapping[str, ArrayLike]


@dataclass(frozen=True, eq=False)
class Sweep:
    """A camera over arrays of depths, fields, wavelengths, or of its own numbers, computed when it is asked.

    Every array is an axis by its name, in the order depth, field, wavelength behind the camera's numbers; a single
    number is no axis. Each figure is the same to the last bit as that of a loop over the points.

    Parameters
    ----------
    camera : Camera
        With its lens.
    axes : dict
        By name one number or an array (n,): ``depth_mm``, ``field_deg``, ``field_x_deg``, ``wavelength_nm`` (see
        `Camera.source`), or any setting of a camera that it does not state itself, such as ``f_number``.
    threads : int, optional
        As for `p2sf.render`.
    progress : callable or bool
        Called with the share that is done, 0 to 1; True shows it on the screen.
    scheduler : str or object, optional
        Who computes the points instead of threads: the address of a dask scheduler, its client, or anything with a
        ``map`` like that of `concurrent.futures.Executor`.

    Raises
    ------
    RequestError
        For a camera without a lens, a name that is no axis, and values that cannot be.

    Examples
    --------
    >>> import p2sf
    >>> camera = p2sf.Camera("double_gauss_28", focus_mm=3000)
    >>> sweep = camera.sweep(depth_mm=3000, field_deg=[0, 7], wavelength_nm=[450, 550, 650], f_number=[5.6, 8, 11])
    >>> sweep
    <Sweep of double_gauss_28: f_number 3 × field_deg 2 × wavelength_nm 3>
    >>> sweep.strehl()["strehl"].shape
    (3, 2, 3)
    """

    camera: CameraData
    axes: Axes = field(default_factory=dict)
    threads: int | None = None
    progress: Callable[[float], object] | bool = False
    scheduler: Any = None

    def __post_init__(self) -> None:
        own = explicit_values(self.camera.settings)
        for name in self.axes:
            if name not in SWEPT:
                raise RequestError(
                    '{parameter} is "{value}"; choose {choices}',
                    parameter="axes",
                    value=name,
                    choices=Alternatives(SWEPT),
                )
            if name in own:
                raise RequestError(
                    "{parameter} and {other} are both given; keep one of them", parameter=name, other=f"camera.{name}"
                )
        ordered = {name: _axis(name, self.axes[name]) for name in SWEPT if name in self.axes}
        object.__setattr__(self, "axes", ordered)
        _ = self.camera.its_lens, self.points

    @property
    def shape(self) -> tuple[int, ...]:
        """Return the length of every axis."""
        return tuple(self.sizes.values())

    @property
    def sizes(self) -> dict[str, int]:
        """Return the length of every axis by its name."""
        return {name: np.size(values) for name, values in self.axes.items() if np.ndim(values)}

    @cached_property
    def points(self) -> tuple["SweepPoint", ...]:
        """Return the points, the last axis fastest."""
        names = list(self.sizes)
        fixed = {name: values for name, values in self.axes.items() if name not in names}
        found = []
        for place in np.ndindex(self.shape):
            moving = {name: np.asarray(self.axes[name])[k] for name, k in zip(names, place, strict=True)}
            found.append(_point(self.camera, fixed | moving))
        return tuple(found)

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """Return what all points are of, as `Psf.provenance` has it; what differs lies along the axes."""
        from p2sf.io.record import common, describe

        return common([describe(one.setup) for one in self.points])

    def psfs(
        self,
        method: "Method" = "auto",
        *,
        pixels: int = 64,
        pixel_um: float | None = None,
        integrated: bool | None = None,
        **how: Any,
    ) -> NamedArrays:
        """Return the PSFs, ``psf`` (…, y_um, x_um), each of unit sum, and what each says about itself.

        That is ``energy``, the share of all light in it, and its ``method`` with the ``predicted_error``, 1 − R².

        Parameters are those of `p2sf.render`, ``how`` being ``quality``, ``min_r2`` and ``clip``, whose errors it
        raises. All have the pixels of the camera; without, those with which the widest of them is shown whole. A
        ``P2SFWarning`` says where a window holds too little.
        """
        pitch = self._pixel_um(pixels, pixel_um)
        asked = {"method": method, "pixels": pixels, "pixel_um": pitch, "integrated": integrated, **how}
        found = self._over(partial(_psf_of, **asked))
        _warn(found)
        axis = centred_axis(pixels, pitch)
        behind = {"psf": along("y_um", axis) | along("x_um", axis)}
        made = self._name_axes(found, behind | dict.fromkeys(("energy", "method", "predicted_error"), NOTHING))
        return replace(made, coords=made.coords | along("pixel_um", np.array(pitch)))

    def to_xarray(self, method: "Method" = "auto", **how: Any) -> "xarray.Dataset":
        """Return the PSFs of `psfs`, whose parameters these are, as a dataset of xarray; ExportError without it."""
        return self.psfs(method, **how).to_xarray()

    def strehl(self, method: "Method" = "auto", *, pixels: int = 64, **how: Any) -> NamedArrays:
        """Return ``strehl``, ``peak_x_um`` and ``peak_y_um``, where the peak is, and ``energy`` of the PSFs.

        Parameters are those of `psfs`. NaN where a method has no pupil.
        """
        asked = how | {"method": method, "pixels": pixels, "pixel_um": self._pixel_um(pixels, how.get("pixel_um"))}
        found = self._over(partial(_strehl_of, **asked))
        return self._name_axes(found, dict.fromkeys(("strehl", "peak_x_um", "peak_y_um", "energy"), NOTHING))

    def mtf(
        self, frequency_per_mm: ArrayLike, method: "PupilMethod" = "traced", *, turn_deg: float = 0.0, **how: Any
    ) -> NamedArrays:
        """Return the contrasts of `p2sf.mtf`: ``tangential``, ``sagittal``, and both of the same pupils without phase.

        ``frequency_per_mm``: cycles per mm on the sensor, one or (n,). ``how``: ``clip`` and ``spectrum``.
        """
        frequency = _axis("frequency_per_mm", frequency_per_mm)
        how |= {"frequency_per_mm": frequency, "method": method, "turn_deg": turn_deg}
        names = "tangential", "sagittal", "perfect_tangential", "perfect_sagittal"
        return self._name_axes(
            self._over(partial(_mtf_of, **how)), dict.fromkeys(names, along("frequency_per_mm", frequency))
        )

    def encircled_energy(self, radius_um: ArrayLike, method: "PupilMethod" = "traced", **how: Any) -> NamedArrays:
        """Return what `p2sf.encircled_energy` does: ``fraction`` within radii, µm, and the radii of 50 and 80 %.

        ``radius_um``: one or (n,). ``how``: ``clip`` and ``spectrum``.
        """
        radius = _axis("radius_um", radius_um)
        found = self._over(partial(_energy_of, radius_um=radius, method=method, **how))
        of_all = dict.fromkeys(("radius_50_um", "radius_80_um", "rms_um", "centroid_um"), NOTHING)
        return self._name_axes(found, {"fraction": along("radius_um", radius), **of_all})

    def line_spread(self, position_um: ArrayLike, method: "PupilMethod" = "traced", **how: Any) -> NamedArrays:
        """Return what `p2sf.line_spread` does: images of lines and of edges at distances from the centroid, µm.

        ``position_um``: one or (n,). ``how``: ``clip`` and ``spectrum``.
        """
        position = _axis("position_um", position_um)
        found = self._over(partial(_lines_of, position_um=position, method=method, **how))
        return self._name_axes(
            found, dict.fromkeys(("line_x", "line_y", "edge_x", "edge_y"), along("position_um", position))
        )

    def performance(self, frequency_per_mm: ArrayLike = (10.0, 30.0), *, clip: bool = False) -> NamedArrays:
        """Return what an engineer reads first, by exact rays: see `p2sf.performance.Performance`.

        ``rms_waves``, ``strehl``, contrasts ``tangential`` and ``sagittal`` at ``frequency_per_mm``, ``radius_80_um``,
        ``distortion``, ``illumination`` and ``lateral_colour_um``; NaN where there is no such figure.
        """
        frequency = _axis("frequency_per_mm", frequency_per_mm)
        found = self._over(partial(_performance_of, frequency_per_mm=frequency, clip=clip))
        names = "rms_waves", "strehl", "radius_80_um", "distortion", "illumination", "lateral_colour_um"
        contrasts = dict.fromkeys(("tangential", "sagittal"), along("frequency_per_mm", frequency))
        return self._name_axes(found, dict.fromkeys(names[:2], NOTHING) | contrasts | dict.fromkeys(names[2:], NOTHING))

    def coefficients(self) -> NamedArrays:
        """Return what `p2sf.coefficients` does, ``w40`` … ``wd`` in waves, ``na``, and the image's place, mm."""
        found = self._over(_six_of)
        return self._name_axes(found, dict.fromkeys((*SIX, "na", "image_distance_mm", "image_height_mm"), NOTHING))

    def zernike(self, basis: "ZernikeOrder" = "noll", terms: int = 37, *, clip: bool = False) -> NamedArrays:
        """Return what `p2sf.zernike` does: ``waves`` (…, term), ``rms_waves``, ``share``, ``rms``, ``marechal``."""
        from p2sf.disc.zernike_terms import zernike_terms

        known = zernike_terms(basis, terms)
        found = self._over(partial(_zernike_of, basis=basis, terms=terms, clip=clip))
        behind = along("term", np.array([term.number for term in known]))
        own = dict.fromkeys(("waves", "rms_waves", "share"), behind)
        made = self._name_axes(found, own | dict.fromkeys(("rms", "marechal", "residual"), NOTHING))
        names = {"name": (("term",), np.array([term.name for term in known]))}
        return replace(made, coords=made.coords | names)

    def choose_method(self, min_r2: float = 0.99, *, clip: bool = False) -> NamedArrays:
        """Return what `p2sf.choose_method` does: ``method``, its ``predicted_error`` (1 − R²) and its ``numbers``."""
        found = self._over(partial(_choice_of, min_r2=min_r2, clip=clip))
        return self._name_axes(found, dict.fromkeys(("method", "predicted_error", "numbers"), NOTHING))

    def __repr__(self) -> str:
        sizes = " × ".join(f"{name} {size}" for name, size in self.sizes.items()) or "one point"
        return f"<Sweep of {self.camera.its_lens.name}: {sizes}>"

    def _pixel_um(self, pixels: int, pixel_um: float | None) -> float:
        """Return the pitch of all windows: as asked, the camera's, or the widest that one of them needs."""
        from p2sf.psf.methods import whole_pixel_um

        if pixel_um is not None or self.camera.pixel_um is not None:
            return float(pixel_um or self.camera.pixel_um or 0)
        with one_blas_thread:
            return max(whole_pixel_um(one.setup.lens, one.setup.source, pixels) for one in self.points)

    def _over(self, figure: Callable[["SweepPoint"], Figures]) -> list[Figures]:
        """Return a figure of every point, by threads or by a scheduler."""
        found: list[Figures] = []
        tell = _show if self.progress is True else self.progress or (lambda _: None)

        def take(one: Figures) -> None:
            found.append(one)
            tell(len(found) / len(self.points))

        if self.scheduler is None:
            for_each(figure, self.points, take, self.threads, ahead=None)
            return found
        with checked_client(self.scheduler, "map") as scheduler:
            answers = scheduler.map(figure, self.points)
            if hasattr(scheduler, "gather"):  # a client of dask, whose answers are futures
                answers = (one.result() for one in answers)
            for one in answers:
                take(one)
        return found

    def _name_axes(self, found: list[Figures], own: Mapping[str, NamedAxes]) -> NamedArrays:
        """Return the figures of all points, each with the axes that it has behind those of the sweep."""
        arrays: dict[str, tuple[Dims, np.ndarray]] = {}
        coords = {k: part for name, values in self.axes.items() for k, part in along(name, np.asarray(values)).items()}
        for name, behind in own.items():
            coords |= behind
            dims = (*self.sizes, *(own_name for own_dims, _ in behind.values() for own_name in own_dims))
            shape = self.shape + tuple(n for _, values in behind.values() for n in values.shape)
            arrays[name] = dims, np.array([one[name] for one in found]).reshape(shape)
        return NamedArrays(arrays, coords, self.provenance)


@dataclass(frozen=True, eq=False)
class SweepPoint:
    """One source before a camera that is set, and what its figures share."""

    lens: Lens
    source: Source
    camera: Settings

    @cached_property
    def setup(self) -> Setup:
        """Return the lens as it is set, and the source."""
        return set_up_source(self.lens, self.source, self.camera)

    @cached_property
    def _parts_by_request(self) -> dict[tuple[Any, ...], "tuple[list[PupilPart], str]"]:
        return {}

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

    def __reduce__(self) -> tuple[Any, ...]:
        return SweepPoint, (self.lens, self.source, self.camera)


def _axis(name: str, values: ArrayLike) -> np.ndarray:
    """Return one value or several, () or (n,); RequestError for more axes, for none, and for what is no number."""
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


def _point(camera: CameraData, values: Mapping[str, Any]) -> SweepPoint:
    """Return a point of a sweep; RequestError for values that cannot be."""
    plain = {name: np.asarray(value).item() for name, value in values.items()}
    moved = {name: plain.pop(name) for name in tuple(plain) if name not in OF_THE_SOURCE}
    across, up = plain.pop("field_x_deg", 0.0), plain.pop("field_deg", 0.0)
    own = replace(camera, **moved)
    return SweepPoint(camera.its_lens, own.source(**plain, field_deg=(across, up)), own.settings)


def _psf(
    point: SweepPoint, method: str, pixels: int, pixel_um: float, integrated: bool | None = None, **options: Any
) -> "Psf":
    from p2sf.psf.methods import PsfOptions
    from p2sf.psf.pixel_integrals import render_integrated

    setup = point.setup
    return render_integrated(setup.lens, setup.source, method, pixels, pixel_um, PsfOptions(**options), integrated)


def _psf_of(point: SweepPoint, **how: Any) -> Figures:
    psf = _psf(point, **how)
    about = {"method": psf.method, "predicted_error": _or_nan(psf.predicted_error)}
    return {"psf": psf.values, "energy": _or_nan(psf.energy), **about, "caution": psf.caution}


def _strehl_of(point: SweepPoint, **how: Any) -> Figures:
    psf = _psf(point, **how)
    x, y = (np.nan, np.nan) if psf.peak_um is None else psf.peak_um
    return {"strehl": _or_nan(psf.strehl), "peak_x_um": x, "peak_y_um": y, "energy": _or_nan(psf.energy)}


def _or_nan(value: Any) -> Any:
    return np.nan if value is None else value


def _mtf_of(point: SweepPoint, frequency_per_mm: np.ndarray, turn_deg: float, **how: Any) -> Figures:
    from p2sf.psf.measures import mtf_of

    return vars(mtf_of(*point.parts(turn_deg=turn_deg, **how), frequency_per_mm, turn_deg=turn_deg))


def _energy_of(point: SweepPoint, radius_um: np.ndarray, **how: Any) -> Figures:
    from p2sf.psf.measures import energy_in

    return vars(energy_in(*point.parts(**how), radius_um))


def _performance_of(point: SweepPoint, frequency_per_mm: np.ndarray, clip: bool) -> Figures:
    from p2sf.performance import performance_of

    setup = point.setup
    return vars(performance_of(setup.lens, setup.source, frequency_per_mm, clip, partial(point.parts, "traced", clip)))


def _lines_of(point: SweepPoint, position_um: np.ndarray, **how: Any) -> Figures:
    from p2sf.psf.measures import spread_of

    return vars(spread_of(*point.parts(**how), position_um))


def _six_of(point: SweepPoint) -> Figures:
    from p2sf.paraxial import seidel

    setup, source = point.setup, point.source
    seidel.check_seidel(setup.lens)
    six = seidel.coefficients(setup.lens, source.depth_mm, source.field_slope, source.wavelength_um, setup.stop)
    places = {"image_distance_mm": six.image_distance, "image_height_mm": six.image_height}
    return {name: getattr(six, name) for name in SIX} | places | {"na": six.na}


def _zernike_of(point: SweepPoint, basis: "ZernikeOrder", terms: int, clip: bool) -> Figures:
    from p2sf.pupil.zernike_fit import zernike_fit

    found = zernike_fit(point.setup.lens, point.setup.source, basis, terms, clip)
    return vars(found) | {"marechal": found.marechal}


def _choice_of(point: SweepPoint, min_r2: float, clip: bool) -> Figures:
    from p2sf.psf.choosing import choose

    return vars(choose(point.setup.lens, point.source, min_r2, clip))


def _warn(found: list[Figures]) -> None:
    """Warn once of the window that holds least."""
    cut = [one for one in found if one["caution"]]
    if cut:
        worst = min(cut, key=lambda one: float(one["energy"]))
        warnings.warn(str(worst["caution"]), P2SFWarning, stacklevel=3)


def _show(share: float) -> None:
    """Show on the screen how much is done."""
    print(f"\r{share:4.0%}", end="\n" if share == 1 else "", file=sys.stderr, flush=True)
