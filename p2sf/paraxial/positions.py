"""A lens at a position of its zoom and focus rings, and the distance on which it is then focused."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from math import isfinite

from p2sf.arguments import check_arguments
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens, with_sensor
from p2sf.lens.positions import KEPT, PARAMETER, Axis, Kind, Positions, interpolate_lens, position_text
from p2sf.paraxial.first_order import basis_rays

RTOL = 1e-12  # of the travel of a ring


@check_arguments
def lens_at(lens: Lens, zoom: float | str | None = None, focus_position: float | str | None = None) -> Lens:
    """Return a lens with its rings turned.

    Parameters
    ----------
    lens : Lens
        A lens with positions; a focus, an f-number and edits that are not in its columns are lost.
    zoom, focus_position : float or str, optional
        Position of the ring on its own scale, or the name of a column; by default the current one.

    Returns
    -------
    Lens
        At a column exactly the lens stated in the file. Between columns every number that varies is interpolated by
        monotone cubics (Fritsch & Butland 1984), and the sensor of a zoom lens follows its image, as the cams of its
        groups would ensure.

    Raises
    ------
    RequestError
        For a ring that the lens does not have, and for a position outside its scale.

    Examples
    --------
    >>> import p2sf
    >>> wide = p2sf.lens_at(p2sf.load_lens("my_zoom.toml"), zoom="wide")  # doctest: +SKIP
    """
    asked: dict[Kind, float | str | None] = {"zoom": zoom, "focus": focus_position}
    positions = lens.positions
    for kind, value in asked.items():
        if value is not None and (positions is None or positions.axis(kind) is None):
            raise RequestError(
                "{parameter} is {value}, but the lens has no such ring; leave it out",
                parameter=PARAMETER[kind],
                value=position_text(value),
            )
    if positions is None:
        return lens
    place = tuple(
        there if (value := asked[axis.kind]) is None else axis.place(value)
        for axis, there in zip(positions.axes, positions.place, strict=True)
    )
    return lens if place == positions.place else _with_names_of(lens, _lens_at(positions, place))


def _with_names_of(lens: Lens, other: Lens) -> Lens:
    """Return the other lens with the properties of this one that do not depend on the position."""
    return replace(other, **{name: getattr(lens, name) for name in KEPT})


@lru_cache(maxsize=128)
def _lens_at(positions: Positions, place: tuple[float, ...]) -> Lens:
    """Return the lens with its rings at ``place``, one number for each axis, within its scale."""
    lens, axis = interpolate_lens(positions, place), positions.axes[0]
    if axis.kind == "zoom" and place[0] not in axis.at:
        lens = _refocus(lens, axis, place[0], [interpolate_lens(positions, (at, *place[1:])) for at in axis.at])
    return replace(lens, positions=replace(positions, place=place))


def _refocus(lens: Lens, axis: Axis, place: float, columns: Sequence[Lens]) -> Lens:
    """Return the lens between columns, focused on a vergence interpolated between theirs by a monotone cubic.

    Interpolated spaces alone do not keep the image on the sensor as the cams of a zoom do. Without an image the lens is
    returned unchanged.
    """
    from scipy.interpolate import PchipInterpolator

    vergence = float(PchipInterpolator(axis.at, [focused_vergence(column) for column in columns])(place))
    rays = basis_rays(lens, lens.reference_wavelength_um)
    start = vergence * float(rays.object_index)
    height, angle = float(rays.a[-1] + start * rays.b[-1]), float(rays.c[-1] + start * rays.d[-1])
    image = -float(rays.image_index) * height / angle if angle else 0.0
    return with_sensor(lens, image) if isfinite(image) and image * lens.sensor_mm > 0 else lens


@lru_cache(maxsize=128)
def focused_vergence(lens: Lens) -> float:
    """Return the vergence in 1/mm of the object whose paraxial image lies on the sensor; 0 for infinity.

    Solves the height of the axial ray on the sensor, linear in the vergence, for zero; at the reference wavelength.
    """
    rays = basis_rays(lens, lens.reference_wavelength_um)
    reach = lens.sensor_mm / rays.image_index
    parallel, divergent = rays.a[-1] + reach * rays.c[-1], rays.b[-1] + reach * rays.d[-1]
    return -float(parallel / (divergent * rays.object_index)) if divergent else 0.0


@lru_cache(maxsize=64)
def focused_inside(lens: Lens, focus_mm: float) -> Lens:
    """Return the lens with its focus ring set so that the paraxial image of a plane at ``focus_mm`` is on the sensor.

    A lens without such a ring is returned unchanged; beyond an end of its travel the ring is set to that end.
    """
    axis = lens.positions.axis("focus") if lens.positions else None
    if axis is None:
        return lens
    asked = 1 / focus_mm

    def difference(place: float) -> float:
        return focused_vergence(lens_at(lens, focus_position=place)) - asked

    ends = [(place, difference(place)) for place in axis.at]
    for (low, before), (high, after) in pairwise(ends):
        if before * after <= 0:
            from scipy.optimize import brentq

            return lens_at(
                lens, focus_position=float(brentq(difference, low, high, xtol=RTOL * (axis.high - axis.low)))
            )
    return lens_at(lens, focus_position=min(ends, key=lambda end: abs(end[1]))[0])


def matches_columns(lens: Lens) -> bool:
    """Return whether a lens equals the one of its columns at its position: not focused, opened or edited since."""
    return lens.positions is not None and _with_names_of(lens, _lens_at(lens.positions, lens.positions.place)) == lens


def edit_columns(lens: Lens, edit: Callable[[Lens], Lens]) -> Lens:
    """Return the lens with an edit applied to all its columns, at the same position."""
    if lens.positions is None:
        return edit(lens)
    return with_columns(lens, tuple(edit(column) for column in lens.positions.lenses))


def with_columns(lens: Lens, columns: tuple[Lens, ...]) -> Lens:
    """Return a lens with other columns at the same position."""
    if lens.positions is None:
        return lens
    return _with_names_of(lens, _lens_at(replace(lens.positions, lenses=columns), lens.positions.place))
