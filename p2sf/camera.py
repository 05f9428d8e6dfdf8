"""A camera: a lens on a sensor, how both are set, and the figures, pictures and databases that follow."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import isfinite
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import real_array
from p2sf.conventions import NM_PER_UM
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.parameters import check_depth_map
from p2sf.paraxial.first_order import cardinal_points
from p2sf.raytrace.focusing import focused_distance
from p2sf.setting import CameraData, set_up_source, usual_depths

if TYPE_CHECKING:
    from p2sf.database.files.provenance import Stored
    from p2sf.object_points import ObjectPoints
    from p2sf.scene.planning.plan import Plan
    from p2sf.tolerance.yields import ToleranceStudy


@dataclass(frozen=True, repr=False)
class Camera(CameraData):
    """A lens on a sensor and how both are set: what figures, pictures and databases are asked of.

    Every number that the settings do not state is as the lens file has it. Without a lens it is what ``camera`` of
    `p2sf.render` and its like take.

    Parameters
    ----------
    lens : Lens or str or path, optional
        The lens, or what `p2sf.load_lens` finds it by.
    pixel_um : float, optional
        Distance between the sensor's pixels, µm, and so between the samples of PSFs; a pixel wider than λ/(4 NA)
        holds the light that falls on it.
    zoom, focus_position, focus_mm, sensor_shift_um, f_number, stop, aim, absorption
        How the lens is set, see `p2sf.setting.LensSettings`.
    obscuration, obscuration_x, obscuration_y, vanes, vane_width, vane_angle_deg, blades, roundness, blade_angle_deg
        The mask in its stop, see `p2sf.disc.mask.MaskSettings`, also for ``apodisation``, ``apodisation_power`` and
        ``cubic_um``.

    Raises
    ------
    RequestError
        For a value that no camera can have, and for a focus stated twice.
    LensFileError
        For a lens that is not found.

    Examples
    --------
    >>> import p2sf
    >>> camera = p2sf.Camera("double_gauss_28", focus_mm=3000, f_number=5.6, pixel_um=4)
    >>> camera
    Camera('double_gauss_28', focus_mm=3000, f_number=5.6, pixel_um=4)
    >>> camera.at(depth_mm=3000, field_deg=10, wavelength_nm=550).psf().pixel_um
    4

    A camera without a lens sets any:

    >>> p2sf.render(p2sf.load_lens("tessar"), p2sf.Source(3000), camera=p2sf.Camera(f_number=11)).method
    'seidel'
    """

    def __post_init__(self) -> None:
        if isinstance(self.lens, str | PathLike):
            from p2sf.api import load_lens

            object.__setattr__(self, "lens", load_lens(self.lens))
        super().__post_init__()

    @overload
    def at(  # type: ignore[overload-overlap]  # a number is array_like too, and means one point
        self,
        source: Source | None = None,
        *,
        depth_mm: float | None = None,
        field_deg: float | None = None,
        field_x_deg: float | None = None,
        wavelength_nm: float | None = None,
        threads: int | None = None,
        progress: Callable[[float], object] | bool = False,
        scheduler: Any = None,
        **numbers: float | str,
    ) -> "ObjectPoints[Literal['one']]": ...

    @overload
    def at(
        self,
        source: Source | None = None,
        *,
        depth_mm: ArrayLike | None = None,
        field_deg: ArrayLike | None = None,
        field_x_deg: ArrayLike | None = None,
        wavelength_nm: ArrayLike | None = None,
        threads: int | None = None,
        progress: Callable[[float], object] | bool = False,
        scheduler: Any = None,
        **numbers: ArrayLike,
    ) -> "ObjectPoints[Literal['several']]": ...

    def at(
        self,
        source: Source | None = None,
        *,
        depth_mm: ArrayLike | None = None,
        field_deg: ArrayLike | None = None,
        field_x_deg: ArrayLike | None = None,
        wavelength_nm: ArrayLike | None = None,
        threads: int | None = None,
        progress: Callable[[float], object] | bool = False,
        scheduler: Any = None,
        **numbers: ArrayLike,
    ) -> "ObjectPoints[Any]":
        """Return the object point, or points, of which figures can be asked; nothing is computed before that.

        Parameters
        ----------
        source : Source, optional
            One point as a source, instead of what follows.
        depth_mm, field_deg, field_x_deg, wavelength_nm : float or array_like, optional
            Distance of the object, mm; angle of its chief ray up and across, degrees; wavelength, nm. An array (n,) is
            an axis, a single number none. By default as for `source`.
        threads : int, optional
            As for `p2sf.render`; of several points each computes other points.
        progress : callable or bool
            Called with the share that is done, 0 to 1; True shows it on the screen.
        scheduler : str or object, optional
            Who computes the points instead of threads: the address of a dask scheduler, its client, or anything with a
            ``map`` like that of `concurrent.futures.Executor`.
        numbers
            Any setting of a camera that it does not state itself, one or an array, such as ``f_number=[4, 5.6, 8]``.

        Returns
        -------
        ObjectPoints
            With `psf`, `mtf`, `energy`, `line_spread`, `strehl`, `first_order`, `coefficients`, `zernike`, `rays`,
            `performance` and `choose_method`: plain results of one point, `NamedArrays` over several.

        Raises
        ------
        RequestError
            For a camera without a lens, a name that is no axis, and values that cannot be.

        Examples
        --------
        >>> import p2sf
        >>> camera = p2sf.Camera("double_gauss_28", focus_mm=3000, f_number=5.6)
        >>> camera.at(depth_mm=3000, field_deg=10).psf().method
        'traced'
        >>> camera.at(depth_mm=3000, field_deg=[0, 7, 14]).mtf(20)["tangential"].round(2)
        array([0.79, 0.53, 0.06])
        """
        from p2sf.object_points import ObjectPoints

        if not isinstance(source, Source | None):
            raise RequestError(
                "{parameter} is {value}; give a p2sf.Source, or name what it is, such as depth_mm=3000",
                parameter="source",
                value=f"{source!r:.60}",
            )
        of_source = {"depth_mm": depth_mm, "field_deg": field_deg, "field_x_deg": field_x_deg}
        of_source["wavelength_nm"] = wavelength_nm
        axes = numbers | {name: value for name, value in of_source.items() if value is not None}
        points = ObjectPoints[Any](self, axes, source, threads, progress, scheduler)
        if depth_mm is not None and "focus_mm" not in axes:
            self._check_metres(float(np.max(points.axes["depth_mm"])))
        return points if points.sizes else points.points[0]

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Raise AttributeError, which says of a method of earlier versions what is written instead."""
            if name in ("psf", "sweep"):
                raise AttributeError(
                    f"a camera has no {name} any more; write camera.at(depth_mm=…, field_deg=…), then "
                    "the figure, such as .psf() or .mtf(frequency_per_mm)"
                )
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)

    def database(
        self,
        method: Literal["auto", "seidel", "fitted"] = "auto",
        *,
        depths_mm: ArrayLike | None = None,
        fields_deg: ArrayLike | None = None,
        wavelengths_nm: ArrayLike | None = None,
        **how: Any,
    ) -> "Stored":
        """Return the database of this camera's PSFs, `p2sf.build_database`, whose errors it raises.

        By default from half of the distance in focus, or twenty focal lengths, to infinity, or ten per cent about a
        near object's own distance; from the axis to the lens's widest field, and over its wavelengths. ``how``:
        ``interpolant``, ``fields_x_deg`` and ``path``.
        """
        from p2sf.database.files.building import build_database

        lens = self.its_lens
        if depths_mm is None:
            focal = abs(float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length))
            depths_mm = usual_depths(self.usual_depth_mm, 20 * focal, self.focus_mm is not None)
        if fields_deg is None:
            fields_deg = np.unique([0.0, lens.widest_field_deg])
        if wavelengths_nm is None:
            wavelengths_nm = np.unique([min(lens.wavelengths_nm), max(lens.wavelengths_nm)])
        return build_database(lens, depths_mm, fields_deg, wavelengths_nm, method=method, camera=self, **how)

    def photograph(
        self,
        image: ArrayLike,
        depth_mm: ArrayLike | None = None,
        *,
        rtol: float = 0.05,
        clip: bool = False,
        **how: Any,
    ) -> np.ndarray:
        """Return the picture that the sensor receives of a scene, `p2sf.plan` and `p2sf.form_image` with this camera.

        Parameters
        ----------
        image : array_like
            The scene in linear light, floats, (rows, columns, 3) for red, green and blue, or (rows, columns) for light
            of the lens's middle wavelength; row 0 is the top, and a pixel as wide as the sensor's.
        depth_mm : array_like, optional
            One depth, mm, or that of every pixel, (rows, columns); by default as for `source`.
        rtol : float
            Relative L2 error of a pixel's kernel that is tolerable.
        clip : bool
            Stop rays at every clear semi-diameter.
        how
            ``method``, ``surround``, ``threads`` and ``scheduler`` as `p2sf.form_image` has them.

        Returns
        -------
        numpy.ndarray
            Linear light, float32, of the shape of ``image``.

        Raises
        ------
        RequestError, GeometryError, GlassError
            As for `p2sf.plan` and `p2sf.form_image`, and for a camera without ``pixel_um``.
        """
        from p2sf.image.picture import form_image

        values, depths = real_array("image", image), self._depths(depth_mm)
        planned = self._plan(values, depths, rtol, clip)
        given = None if depths.size == 1 else depths
        formed: np.ndarray = form_image(planned, np.asarray(image).reshape(*values.shape[:2], -1), given, **how)
        return formed.reshape(values.shape)

    def sharpen(
        self,
        photo: ArrayLike,
        depth_mm: ArrayLike | None = None,
        *,
        noise: float | None = None,
        rtol: float = 0.05,
        clip: bool = False,
        threads: int | None = None,
    ) -> np.ndarray:
        """Return a photo that this camera took, sharpened by a Wiener filter with the kernels of every place.

        Parameters
        ----------
        photo : array_like
            Linear light, floats with white at 1, (rows, columns, 3) or (rows, columns), as for `photograph`.
        depth_mm : array_like, optional
            The depth that is made sharp, mm, or that of every pixel, (rows, columns); by default as for `source`.
        noise : float, optional
            Standard deviation of the photo's noise; estimated from the photo by default.
        rtol, clip
            As for `photograph`.
        threads : int, optional
            As for `p2sf.render`.

        Returns
        -------
        numpy.ndarray
            Linear light, float32, of the shape of ``photo``.

        Raises
        ------
        RequestError, GeometryError, GlassError
            As `photograph` does, and for a noise that is not positive.
        """
        from p2sf.image.picture import sharpen_image

        values, depths = real_array("photo", photo), self._depths(depth_mm)
        pixels = np.asarray(photo).reshape(*values.shape[:2], -1)
        planned = self._plan(values, depths, rtol, clip)
        given = None if depths.size == 1 else depths
        sharp: np.ndarray = sharpen_image(planned, pixels, given, noise=noise, threads=threads)
        return sharp.reshape(values.shape)

    def picture_plan(
        self, values: ArrayLike, depth_mm: ArrayLike | None = None, *, rtol: float = 0.05, clip: bool = False
    ) -> "Plan":
        """Return the plan by which `photograph` forms a picture of this shape, and `sharpen` sharpens one.

        ``values``: the picture, (row, column) or (row, column, 3); ``depth_mm``: one distance of the object or that of
        every pixel, by default the one in focus; ``rtol``: relative L2 error that its kernels may have; ``clip``:
        whether clear semi-diameters count. Raises RequestError without ``pixel_um`` and for impossible depths.
        """
        return self._plan(real_array("values", values), self._depths(depth_mm), rtol, clip)

    def _depths(self, depth_mm: ArrayLike | None) -> np.ndarray:
        """Return the depths of a picture, (1,) or of every pixel, by default the distance in focus."""
        depths = np.atleast_1d(real_array("depth_mm", self.usual_depth_mm if depth_mm is None else depth_mm))
        if depths.size > 1:  # of one, the parameter is named
            check_depth_map(depths)
        return depths

    def _check_metres(self, far_mm: float) -> None:
        """Raise RequestError where the farthest of the depths is as near as metres are taken for millimetres."""
        if far_mm <= MOST_METRES:
            middle = Source(far_mm, wavelength_um=self.its_lens.reference_wavelength_um)
            _check_metres(set_up_source(self.its_lens, middle, self.settings).lens, far_mm)

    def _plan(self, values: np.ndarray, depths: np.ndarray, rtol: float, clip: bool) -> "Plan":
        """Return the plan of a picture of these pixels and depths; RequestError without ``pixel_um``."""
        from p2sf.scene.planning.plan import plan
        from p2sf.scene.scene import Channel, Scene
        from p2sf.scene.sensor import Sensor

        if self.pixel_um is None:
            raise RequestError("this camera has no pixels; give {parameter}", parameter="pixel_um")
        if values.ndim not in (2, 3):
            raise RequestError("a picture of shape {shape}; give rows, columns and colours", shape=str(values.shape))
        lens, middle = self.its_lens, self.its_lens.reference_wavelength_um
        near, far = float(depths.min()), float(depths.max())
        seen = set_up_source(lens, Source(far, wavelength_um=middle), self.settings).lens
        self._check_metres(far)
        sensor = Sensor(values.shape[0], values.shape[1], self.pixel_um)
        scene = Scene(sensor, near_mm=near, far_mm=far, rtol=rtol, clip=clip).at_depths(depths)
        if values.ndim == 2 or values.shape[2] == 1:
            scene = replace(scene, channels=(Channel("light", (middle * NM_PER_UM,), (1.0,)),))
        return plan(seen, scene)

    def tolerances(
        self, limits: Mapping[str, float], depth_mm: float | None = None, wavelength_nm: float | None = None, **how: Any
    ) -> "ToleranceStudy":
        """Return what share of built lenses keeps limits, `p2sf.tolerances` of this camera, whose errors it raises.

        The object is by default as for `source`; ``how``: ``grade``, ``builds`` and ``seed``.
        """
        from p2sf.tolerance.yields import tolerances

        source = self.source(depth_mm, 0.0, wavelength_nm)
        return tolerances(set_up_source(self.its_lens, source, self.settings).lens, source, limits, **how)


NEARER = 100.0  # times than what is in focus: metres look a thousand times nearer
MOST_METRES = 1000.0  # to which scenes that are given in metres reach
CLOSE_FOCAL_LENGTHS = 5.0  # beyond them, what is that much nearer than the focus may well be meant to be blurred


def _check_metres(lens: Lens, far_mm: float) -> None:
    """Raise RequestError where all depths are as near as metres are that are taken for millimetres.

    That is within the front focus, where nothing has a real image, or both close and a hundred times nearer than what
    is in focus; and no number that would be kilometres: telescopes have a front focus hundreds of metres away.
    """
    points = cardinal_points(lens, lens.reference_wavelength_um)
    if far_mm > MOST_METRES:
        return
    focus, close = -float(points.front_focal_distance), CLOSE_FOCAL_LENGTHS * abs(float(points.effective_focal_length))
    sharp = focused_distance(lens)
    if (isfinite(focus) and far_mm <= focus) or (isfinite(sharp) and far_mm < min(close, sharp / NEARER)):
        raise RequestError(
            "{parameter} reaches to {far:g} mm, for a lens in focus at {sharp:.4g} mm with its front focus {focus:.4g} "
            "mm before it; give millimetres, 1000 for each metre",
            parameter="depth_mm",
            far=far_mm,
            sharp=sharp,
            focus=focus,
        )
