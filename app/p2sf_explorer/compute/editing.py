"""A lens edited surface by surface, each edit a new lens. No Qt in here."""

import re
from collections.abc import Callable
from dataclasses import fields, replace
from math import copysign, exp, inf, isclose, isfinite, sqrt
from typing import Any

from p2sf.conventions import UM_PER_MM
from p2sf.errors import GeometryError, P2SFError
from p2sf.glass.media import AIR, Medium, model_glass, parse_medium
from p2sf.lens.lens import Aperture, Lens, Surface, indices, with_f_number, with_sensor
from p2sf.lens.positions import KEPT, Positions
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf.paraxial.positions import edit_columns, with_columns
from p2sf.paraxial.pupils import f_number, find_stop, stop_rim
from p2sf.raytrace.focusing import sensor_in_focus
from p2sf_explorer.compute.setup import load, paraxial_setup, prescription, with_rings
from p2sf_explorer.state.scales import INFINITE, MM_PER_UNIT, read_number
from p2sf_explorer.state.state import State, change

STEEPEST = 0.9  # of a hemisphere's sag
SAME = 1e-12  # of the sensor's distance: less is rounding
MODEL = re.compile(r"nd\s*+=?\s*+([\d.]+)[,\s]++vd\s*+=?\s*+([\d.]+)", re.IGNORECASE)


def edited_state(state: State, lens: Lens) -> State:
    """Return the state with this lens in place of its own, unedited if it is as its file has it.

    The sensor is kept in focus as ``state.display.keep_focus`` says, unless nothing but the sensor has been edited.
    Of a lens with positions, what varies is edited in the present column, and anything else in all of them; in each the
    sensor follows its own paraxial image. Raises P2SFError where the lens has no picture at the state's source, so that
    no state has a bad lens, and for what varies between columns.
    """
    before = prescription(state)
    if before.positions is not None:
        return _with_lens(state, _edited_columns(before, lens, state))
    if state.display.keep_focus == "off" or with_sensor(lens, before.sensor_mm) == before:
        return _with_lens(state, lens)
    followed = with_sensor(lens, followed_sensor(before, lens, state.optics.depth_mm))
    if state.display.keep_focus == "paraxial":
        return _with_lens(state, followed)
    return _with_lens(*best_focused(state, followed))


def _with_lens(state: State, lens: Lens) -> State:
    edited = change(state, lens_text=None if _as_filed(state, lens) else lens_to_toml(lens))
    paraxial_setup(edited)
    return edited


def _edited_columns(before: Lens, lens: Lens, state: State) -> Lens:
    """Return the lens with an edit made in its columns, each in focus as it was."""
    columns = before.positions.lenses if before.positions else ()
    edited = lens if lens.positions is not before.positions else _in_columns(before, lens)
    bare = with_sensor(lens, before.sensor_mm) == before
    if state.display.keep_focus == "off" or bare or edited.positions is None:
        return edited
    depth = state.optics.depth_mm
    followed = (
        with_sensor(after, followed_sensor(column, after, depth))
        for column, after in zip(columns, edited.positions.lenses, strict=True)
    )
    return with_columns(edited, tuple(followed))


def _in_columns(before: Lens, after: Lens) -> Lens:
    """Return the lens with what an edit changed written into its columns: all of them, or the present one.

    GeometryError, naming the surface, for an edit between columns of what is not the same in all of them.
    """
    positions = before.positions
    if positions is None:
        return after
    columns = list(positions.lenses)
    for number, (old, new) in enumerate(zip(before.surfaces, after.surfaces, strict=True)):
        for name in changes(old, new):
            for place in _edited_places(positions, [getattr(c.surfaces[number], name) for c in columns], number + 1):
                columns[place] = with_surface(columns[place], number + 1, **{name: getattr(new, name)})
    for name in set(changes(before, after)) - {"surfaces", *KEPT}:
        for place in _edited_places(positions, [getattr(column, name) for column in columns], None):
            columns[place] = replace(columns[place], **{name: getattr(after, name)})
    same = {name: getattr(after, name) for name in changes(before, after) if name in KEPT}
    return with_columns(replace(before, **same), tuple(columns))


def changes(before: Any, after: Any) -> tuple[str, ...]:
    """Return the fields in which two values of one dataclass differ."""
    return tuple(f.name for f in fields(before) if getattr(before, f.name) != getattr(after, f.name))


def _edited_places(positions: Positions, values: list[Any], surface: int | None) -> range | tuple[int]:
    """Return the columns that an edit of these values is for."""
    if all(value == values[0] for value in values):
        return range(len(values))
    if positions.column is not None:
        return (positions.column,)
    where = Message("surface {surface}", surface=surface) if surface else Message("the lens")
    raise GeometryError(
        "{where}: this is not the same in all columns, and {position} lies between them; "
        "put the ring on a column, marked ▾, to edit it there",
        where=where,
        position=positions.words,
    )


def followed_sensor(before: Lens, after: Lens, depth_mm: float) -> float:
    """Return the sensor's place behind the last vertex, mm, as far from the paraxial image as before an edit.

    Where either lens has no real image of this depth, the sensor stays where the edited lens has it.
    """
    old, new = (sensor_in_focus(lens, depth_mm) for lens in (before, after))
    place, along = before.sensor_mm + new - old, after.directions[-1]
    if not (isfinite(place) and along * new > 0 and along * place > 0) or isclose(place, after.sensor_mm, rel_tol=SAME):
        return after.sensor_mm
    return place


def best_focused(state: State, lens: Lens) -> tuple[State, Lens]:
    """Return state and lens with the sensor, now without shift, where the RMS of the state's wavefront is smallest.

    Where no shift focuses, the lens as it is.
    """
    from p2sf_explorer.compute.autofocus import best_shift_um

    plain = change(state, focus_mm=None, sensor_shift_um=0.0)
    try:
        shift = best_shift_um(_with_lens(plain, lens))
    except GeometryError:  # an image at infinity, or a pupil without a lens
        return state, lens
    return plain, with_sensor(lens, lens.sensor_mm + shift / UM_PER_MM)


def _as_filed(state: State, lens: Lens) -> bool:
    try:
        return with_rings(load(state.optics.lens), state) == lens
    except P2SFError:  # the file is gone or broken; the edited lens stands for itself
        return False


def with_value(lens: Lens, number: int, column: str, text: str) -> Lens:
    """Return the lens with one entry of surface ``number`` (from 1) as a person typed it; P2SFError names the surface.

    ``column`` is a field of `Surface`: radius, thickness, medium, semi_diameter, conic or aspheric.
    """
    before = lens.surfaces[number - 1]
    try:
        after = replace(before, **{column: READERS[column](text)})
    except P2SFError as error:
        raise type(error)("surface {number}: {error}", number=number, error=error) from None
    edited = replace(lens, surfaces=(*lens.surfaces[: number - 1], after, *lens.surfaces[number:]))
    return _opened_to(edited, number, after) if column == "semi_diameter" else edited


def _opened_to(lens: Lens, number: int, surface: Surface) -> Lens:
    """Return the lens whose aperture follows its stop's rim, where the aperture is stated as that rim."""
    if number != lens.stop_surface or lens.aperture.kind != "stop_semi_diameter" or not isfinite(surface.semi_diameter):
        return lens
    return replace(lens, aperture=Aperture("stop_semi_diameter", surface.semi_diameter))


def with_scrubbed(lens: Lens, number: int, column: str, travel: float) -> Lens:
    """Return the lens with one number of surface ``number`` (from 1) moved by a hand; a travel of 1 is a long way.

    A radius moves by its curvature, so that it passes through the plane, and a rim by a factor.
    """
    surface = lens.surfaces[number - 1]
    rims = [s.semi_diameter for s in lens.surfaces if isfinite(s.semi_diameter)]
    height = max(rims, default=10.0)
    if column == "radius":
        curvature = surface.curvature + travel * max(abs(surface.curvature), 0.1 / height)
        return with_surface(lens, number, radius=1 / curvature if curvature else inf)
    if column == "thickness":
        moved = surface.thickness + travel * max(abs(surface.thickness), 0.1 * height)
        return with_surface(lens, number, thickness=max(0.0, moved) if surface.thickness >= 0 else moved)
    if column == "conic":
        return with_surface(lens, number, conic=surface.conic + travel)
    made = replace(surface, semi_diameter=surface.semi_diameter * exp(travel))
    return _opened_to(with_surface(lens, number, semi_diameter=made.semi_diameter), number, made)


def read_length(text: str, words: str) -> float:
    """Return a length in mm as a person typed it, ∞ allowed; P2SFError otherwise."""
    plain = text.strip().lower()
    if plain in (*INFINITE, "plane", ""):
        return inf
    return -inf if plain in ("−∞", "-∞", "-inf") else read_number(text, words, MM_PER_UNIT)


def read_medium(text: str) -> Medium:
    """Return the medium a person typed: a glass, "air", an index, or "nd 1.5168 vd 64.17"; GlassError."""
    numbers = MODEL.fullmatch(text.strip())
    if not numbers:
        return parse_medium(text)
    nd, vd = (read_number(x, "glass's nd or vd") for x in numbers.groups())
    return model_glass(nd, vd)


def read_aspheric(text: str) -> tuple[float, ...]:
    """Return A4, A6, … typed with spaces between them; P2SFError otherwise."""
    return tuple(read_number(word, "aspheric coefficient") for word in text.replace(";", " ").split())


READERS: dict[str, Callable[[str], Any]] = {
    "radius": lambda text: read_length(text, "radius"),
    "thickness": lambda text: read_number(text, "thickness", MM_PER_UNIT),
    "medium": read_medium,
    "semi_diameter": lambda text: read_length(text, "semi-diameter"),
    "conic": lambda text: read_number(text, "conic constant"),
    "aspheric": read_aspheric,
}


def check_surface(lens: Lens, number: int) -> None:
    """Raise GeometryError for a surface that the lens does not have: a table may show an earlier lens."""
    if not 1 <= number <= len(lens.surfaces):
        raise GeometryError(
            "there is no surface {number} in a lens of {count}; choose its row again",
            number=number,
            count=len(lens.surfaces),
        )


def with_stop(lens: Lens, number: int) -> Lens:
    """Return the lens with its stop on surface ``number``, as fast as it was: the f-number stays, the rim follows.

    Where there is no f-number to keep, the new stop is open to its own rim, and GeometryError if it has none.
    """
    if lens.positions is not None:
        return edit_columns(lens, lambda column: with_stop(column, number))
    moved = replace(lens, stop_surface=number)
    if lens.aperture.kind != "stop_semi_diameter" or number == lens.stop_surface:
        return moved
    speed = float(f_number(lens, lens.reference_wavelength_um, find_stop(lens)))
    rim = stop_rim(with_f_number(moved, speed)) if isfinite(speed) else lens.surfaces[number - 1].semi_diameter
    if not isfinite(rim):
        raise GeometryError("surface {number} has no rim to be the stop; give it a semi-diameter first", number=number)
    return replace(moved, aperture=Aperture("stop_semi_diameter", rim))


def stop_gap(lens: Lens) -> tuple[float, float] | None:
    """Return the room before and behind the stop within its air gap, mm; None where the stop is a refracting surface.

    A stop on the first surface has none before it, one on the last surface the space up to the sensor behind it.
    """
    number = lens.stop_surface
    if number is None:
        return None
    stop, index = lens.surfaces[number - 1], indices(lens, lens.reference_wavelength_um)
    if not stop.bare or index[number - 1] != index[number]:
        return None
    return (lens.surfaces[number - 2].thickness if number > 1 else 0.0), stop.thickness


def with_stop_shift(lens: Lens, by_mm: float) -> Lens:
    """Return the lens with its stop moved within its air gap, as fast as before; everything else stays where it is.

    GeometryError for a stop that is a refracting surface, or that has no gap before it.
    """
    gap, number = stop_gap(lens), lens.stop_surface or 0
    if gap is None or number < 2:
        raise GeometryError(
            "the stop is no plane in an air gap, so it cannot be moved alone; insert a plane and put the stop there"
        )
    by = min(max(by_mm, -gap[0]), gap[1])
    moved = with_surface(with_surface(lens, number - 1, thickness=gap[0] + by), number, thickness=gap[1] - by)
    if lens.aperture.kind != "stop_semi_diameter":
        return moved
    speed = float(f_number(lens, lens.reference_wavelength_um, find_stop(lens)))
    rim = stop_rim(with_f_number(moved, speed)) if isfinite(speed) else lens.aperture.value
    return replace(moved, aperture=Aperture("stop_semi_diameter", rim))


def with_surface(lens: Lens, number: int, **values: Any) -> Lens:
    """Return the lens with other values of surface ``number`` (from 1)."""
    made = replace(lens.surfaces[number - 1], **values)
    return replace(lens, surfaces=(*lens.surfaces[: number - 1], made, *lens.surfaces[number:]))


def radius_through(surface: Surface, height_mm: float, sag_mm: float) -> float:
    """Return the radius with which the surface has this sag at this height, mm; its other terms stay.

    From y² = 2Rz − (1 + K)z² of a conic, R = (y² + (1 + K)z²)/2z. A sag beyond that of a hemisphere is held there.
    """
    square = height_mm**2
    _, *others = surface.parts  # a Qbfs follows the radius a little, which a second drag makes up for
    c, k = surface.curvature, surface.conic
    sag = sag_mm - sum(float(part.sag_and_gradient(0.0, height_mm, c, k)[0]) for part in others)
    bulge = 1 + surface.conic
    if bulge > 0:
        steepest = STEEPEST * abs(height_mm) / sqrt(bulge)
        sag = copysign(min(abs(sag), steepest), sag)
    return (square + bulge * sag**2) / (2 * sag) if sag else inf


def insert_surface(lens: Lens, number: int) -> Lens:
    """Return the lens with a plane in the middle of the space after surface ``number``: optically the same lens."""
    if lens.positions is not None:
        return edit_columns(lens, lambda column: insert_surface(column, number))
    before = lens.surfaces[number - 1]
    half = before.thickness / 2
    plane = Surface(thickness=half, medium=before.medium)
    surfaces = (*lens.surfaces[: number - 1], replace(before, thickness=half), plane, *lens.surfaces[number:])
    stop = lens.stop_surface
    return replace(lens, surfaces=surfaces, stop_surface=stop + 1 if stop and stop > number else stop)


def delete_surface(lens: Lens, number: int) -> Lens:
    """Return the lens without surface ``number``; all others stay where they are. GeometryError for stop and last one.

    The medium before the surface reaches on to the next one.
    """
    if lens.positions is not None:
        return edit_columns(lens, lambda column: delete_surface(column, number))
    stop, before = lens.stop_surface, lens.surfaces[: number - 1]
    if len(lens.surfaces) == 1:
        raise GeometryError("a lens needs at least one surface; insert another before deleting this one")
    if stop == number:
        raise GeometryError(
            "surface {number} is the stop; put the stop on another surface before deleting it", number=number
        )
    if before:
        joined = before[-1].thickness + lens.surfaces[number - 1].thickness
        before = (*before[:-1], replace(before[-1], thickness=joined))
    surfaces = (*before, *lens.surfaces[number:])
    return replace(lens, surfaces=surfaces, stop_surface=stop - 1 if stop and stop > number else stop)


def cell_text(surface: Surface, column: str, full: bool = False) -> str:
    """Return one entry as a table shows it, or with every digit for editing."""
    value = getattr(surface, column)
    if column == "medium":
        return "air" if value == AIR else value.label
    numbers = value if column == "aspheric" else (value,)
    return "  ".join(repr(x) if full and isfinite(x) else number_text(x) for x in numbers)


def number_text(value: float) -> str:
    """Return a number as a table shows it: ten digits, a true minus, ∞ for a plane or an unlimited rim."""
    if not isfinite(value):
        return "∞" if value > 0 else "−∞"
    return f"{value:.10g}".replace("-", "−")
