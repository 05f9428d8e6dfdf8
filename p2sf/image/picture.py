"""The pictures that a script forms and sharpens: `p2sf.form_image` and `p2sf.sharpen_image`."""

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, real_array
from p2sf.errors import RequestError
from p2sf.image.deblur import PhotoStatistics, photo_statistics, wiener, wiener_by_depth
from p2sf.image.exposure import expose
from p2sf.image.form import Forming, check_picture, plan_lattice, planned_depths
from p2sf.image.form import form_image as form
from p2sf.image.progress import Progress
from p2sf.image.region import Region, check_region, whole
from p2sf.scene.planning.plan import Plan
from p2sf.scene.sensor import Sensor
from p2sf.threads import using_threads


@check_arguments
def form_image(
    planned: Plan,
    values: ArrayLike,
    depth_mm: ArrayLike | None = None,
    *,
    method: Literal["patches", "lowrank"] = "patches",
    surround: Literal["edge", "black"] = "edge",
    seed: int = 0,
    region: tuple[int, int, int, int] | None = None,
    threads: int | None = None,
    scheduler: Any = None,
) -> np.ndarray:
    """Form the picture that the sensor reads through the lens, with distortion, illumination, blur and pixels.

    Parameters
    ----------
    planned : Plan
        The result of `plan` for the lens and the scene.
    values : array_like
        The scene in linear light, shape (rows, columns, channels) of the scene's sensor and colours: floats, since
        integers are sRGB codes in most pictures. Or layers with what is behind each, shape (layers, rows, columns,
        channels + 1): colours that are already multiplied by the alpha after them, the share of light a layer hides.
    depth_mm : array_like, optional
        Depth of every pixel, mm, shape (rows, columns), between ``near_mm`` and ``far_mm`` of the scene; by default
        its far end. Of layers, the depth of each, shape (layers,).
    method : {"patches", "lowrank"}
        With overlapping patches, or with a few kernels for the whole picture.
    surround : {"edge", "black"}
        What surrounds the picture: its outermost pixels repeated, or darkness.
    seed : int, optional
        Of the sensor's noise: the same one gives the same picture.
    region : tuple of int, optional
        The part to form: top, bottom, left, right, counted from 0 and the ends excluded, as in
        ``picture[top:bottom, left:right]``. It takes only the kernels that reach it.
    threads : int, optional
        As for `render`.
    scheduler : str or client, optional
        Of a dask cluster whose workers form the picture instead, a row of tiles of 1024 pixels at a time: its address
        or its client. The picture is the same to the last bit on machines of one kind.

    Returns
    -------
    numpy.ndarray
        The formed picture, linear light, float32, shape (rows, columns, channels); (rows, columns, 1) behind a mosaic.
        With noise, steps and limits of a sensor that states them, whose raw numbers are `p2sf.raw_numbers` of it.

    Raises
    ------
    RequestError
        If shapes do not fit the scene, values are not finite or whole numbers, or a depth is outside the scene's.
    ClusterError
        If the cluster cannot be reached, is lost, or has another version.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> scene = p2sf.Scene(p2sf.Sensor(rows=20, columns=30, pixel_um=60.0), rtol=0.2, f_number=8)
    >>> planned = p2sf.plan(p2sf.load_lens("double_gauss_28"), scene)
    >>> p2sf.form_image(planned, np.ones((20, 30, 3))).shape
    (20, 30, 3)
    """
    depths = None if depth_mm is None else real_array("depth_mm", depth_mm)
    part = None if region is None else region_of_sensor(planned.scene.sensor, region)
    with using_threads(threads):
        light = form(planned, values, depths, Forming(method, surround, scheduler=scheduler), region=part)
        return expose(planned.scene.sensor, light, seed)


def region_of_sensor(sensor: Sensor, region: Sequence[int]) -> Region:
    """Return the region of top, bottom, left and right; RequestError for one that is no part of it."""
    if len(region) != 4 or any(end % 1 for end in region):
        raise RequestError(
            "{parameter} is {given}; give four whole numbers: top, bottom, left, right",
            parameter="region",
            given=str(tuple(region)),
        )
    top, bottom, left, right = map(int, region)
    if sensor.mosaic is not None and (top % 2 or left % 2):
        raise RequestError(
            "{parameter} begins at row {top} and column {left}, amid a block of the mosaic; give even numbers",
            parameter="region",
            top=top,
            left=left,
        )
    return check_region(Region(top, bottom, left, right), whole((sensor.rows, sensor.columns)))


@check_arguments
def sharpen_image(
    planned: Plan,
    photo: ArrayLike,
    depth_mm: ArrayLike | None = None,
    *,
    noise: float | None = None,
    threads: int | None = None,
) -> np.ndarray:
    """Sharpen a photo, by a Wiener filter with the kernel of every place.

    Parameters
    ----------
    planned : Plan
        The result of `plan` for the lens and the scene.
    photo : array_like
        The photo in linear light, floats with white at 1, shape (rows, columns, channels) as for `form_image`.
    depth_mm : array_like, optional
        Depth of every pixel, mm, shape (rows, columns), as for `form_image`; by default the far end of the scene. Each
        depth has its own kernels; beside edges of depth pixels stay as they are.
    noise : float, optional
        Standard deviation of its noise; by default between the limits that the photo tells, see `photo_statistics`.
    threads : int, optional
        As for `render`.

    Returns
    -------
    numpy.ndarray
        The sharpened photo, linear light, float32, shape (rows, columns, channels).

    Raises
    ------
    RequestError
        As `form_image` does, and for a noise that is not positive.
    """
    values = check_picture(planned.scene, photo)
    depths = None if depth_mm is None else real_array("depth_mm", depth_mm)
    with using_threads(threads):
        return sharpen_planned(planned, values, depths, noise)


def sharpen_planned(
    planned: Plan,
    values: np.ndarray,
    depth_mm: np.ndarray | None,
    noise: float | None,
    watch: Progress | None = None,
) -> np.ndarray:
    """Return a photo (rows, columns, channels) sharpened by a plan's kernels, at one depth or at those of a map."""
    if depth_mm is None:
        return sharpen_one_depth(planned, values, noise, watch)[0]
    planned.scene.check_depths(depth_mm)
    depths = planned_depths(planned, depth_mm, values.shape[:2])
    return wiener_by_depth(
        values, depths, lambda number: plan_lattice(planned, planned.vergences[number], watch), noise, watch
    )


def sharpen_one_depth(
    planned: Plan, values: np.ndarray, noise: float | None, watch: Progress | None = None
) -> tuple[np.ndarray, PhotoStatistics]:
    """Return a photo (rows, columns, channels) sharpened by the kernels of a plan's far end, and what that assumes."""
    lattice = plan_lattice(planned, planned.vergences[0], watch)
    about = photo_statistics(values, lattice, noise)
    return wiener(values, lattice, about, watch), about
