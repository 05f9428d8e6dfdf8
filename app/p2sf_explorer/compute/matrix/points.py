"""Which points the pictures of a matrix show: the fields of its rows, the values of its columns, and their states."""

from dataclasses import dataclass
from functools import lru_cache
from math import inf, isfinite
from typing import Any

import numpy as np

from p2sf.conventions import vergence
from p2sf.lens.lens import Lens
from p2sf.paraxial.balance import depth_of_focus_um
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import coefficients
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.quantities import C_NM, D_NM, F_NM
from p2sf_explorer.compute.ranges import closest_distance, wavelength_range
from p2sf_explorer.compute.sampled import optics
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.compute.views.colour import at_wavelength
from p2sf_explorer.state.scales import nice, told_apart, with_sign
from p2sf_explorer.state.state import State, change

SIDE = "side"
LISTS = {
    "field_deg": "fields_deg",
    "wavelength_nm": "wavelengths_nm",
    "depth_mm": "depths_mm",
    "sensor_shift_um": "shifts_um",
}
FEW = 6  # parts of a field that tenths tell apart
ON_AXIS_DEG = 1.0  # the largest field shown of a lens whose file states none beside the axis
MOST_DEG, FEWEST_UM = 1e-4, 1e-6  # within which a field and a shift are the same
SAME = 1e-6  # of a wavelength or a vergence
Value = float | str


@dataclass(frozen=True)
class MatrixRequest:
    """Everything that the pictures of a matrix depend on: ``what`` they show, and the ``states`` in rows of columns.

    ``rows`` are fields in degrees and ``columns`` values of ``across``, "A" and "B" for the sides of a comparison;
    ``lenses`` are those of the states, since a file may change. ``pixel_um`` is the sensor's, where that counts.
    """

    what: str
    across: str
    rows: tuple[float, ...]
    columns: tuple[Value, ...]
    states: tuple[tuple[State, ...], ...]
    lenses: tuple[Lens, ...]
    shared: bool
    pixel_um: float | None = None


def matrix_request(live: Live) -> MatrixRequest:
    """Return what the matrix of the present setup shows. Raises P2SFError where the lens has no image."""
    view = live.state.matrix
    rows = view.fields_deg or stated_fields(prescription(live.state), view.rows)
    columns = columns_of(live)
    sides = [optics(side) for side in live.sides or (live.state,)]
    base = {"A": sides[0], "B": sides[-1]}
    states = tuple(
        tuple(move_to(base.get(str(column), optics(live.state)), row, view.across, column) for column in columns)
        for row in rows
    )
    lenses = tuple(prescription(side) for side in sides)
    pixel = live.state.display.pixel_um if view.what == "mtf" else None
    return MatrixRequest(view.what, view.across, rows, columns, states, lenses, view.shared, pixel)


def move_to(state: State, field_deg: float, across: str, value: Value) -> State:
    """Return a state at another field, and at a value of ``across``."""
    if across == "wavelength_nm":
        return at_wavelength(state, float(value), field_deg=field_deg)
    return change(state, field_deg=field_deg, **({} if across == SIDE else {across: float(value)}))


def columns_of(live: Live) -> tuple[Value, ...]:
    """Return the values of the columns: those in the state's list, else as many as it asks for around the present."""
    view, lens = live.state.matrix, prescription(live.state)
    if view.across == SIDE:
        return ("A", "B") if live.sides else ("A",)
    listed: tuple[float, ...] = getattr(view, LISTS[view.across])
    if listed:
        return listed
    if view.across == "wavelength_nm":
        return usual_wavelengths(lens, spectral_lines(live.state), view.columns)
    if view.across == "depth_mm":
        return depths_around(live, view.columns)
    return shifts_around(live, view.columns)


def stated_fields(lens: Lens, count: int) -> tuple[float, ...]:
    """Return the fields of the lens's file along y where they are so many, else parts of the widest: 0, 0.7, 1.

    The parts are square roots of even steps, so that the rings between the fields have one area.
    """
    stated = tuple(dict.fromkeys(y for _, y in lens.field_places_deg))
    if len(stated) == count:
        return stated
    widest = max(stated, key=abs) or ON_AXIS_DEG
    places = 1 if count <= FEW else 2
    return tuple(float(round(part, places) * widest) for part in np.sqrt(np.linspace(0, 1, count)))


def spectral_lines(state: State) -> tuple[float, ...]:
    """Return the lines of the state's spectrum, nm; none for a continuous one."""
    kind, _, numbers = state.display.spectrum.partition(":")
    return tuple(map(float, numbers.split(","))) if kind == "lines" else ()


@lru_cache(maxsize=32)
def usual_wavelengths(lens: Lens, lines: tuple[float, ...], count: int) -> tuple[float, ...]:
    """Return the spectrum's ``lines`` or the file's wavelengths where they are so many, else some between F and C, nm.

    Three are F, d and C. All lie where every glass has data.
    """
    low, high = wavelength_range(lens)
    for known in (lines, lens.wavelengths_nm):
        kept = tuple(sorted({nm for nm in known if low <= nm <= high}))
        if len(kept) == count:
            return kept
    if low <= F_NM and C_NM <= high:
        low, high = F_NM, C_NM
    if count == 3 and low < D_NM < high:
        return low, D_NM, high
    return tuple(float(np.round(nm, 1)) for nm in np.linspace(low, high, count))


def depths_around(live: Live, count: int) -> tuple[float, ...]:
    """Return distances around the present one, even in dioptres, one wave of defocus or a little more apart, mm.

    Nothing is closer than the depth slider goes, and nothing beyond infinity.
    """
    here = float(vergence(live.state.optics.depth_mm))
    most = max(here, 1 / closest_distance(prescription(live.state)))
    step = min(1e-3 * nice(1e3 * one_wave(live)), most / count)
    first = here - step * min(round(here / step), (count - 1) // 2)
    first -= step * max(0, np.ceil((first + (count - 1) * step - most) / step - 1e-9))
    places = max(0.0, first) + step * np.arange(count)
    places[np.argmin(np.abs(places - here))] = here
    own = live.state.optics.depth_mm
    return tuple(own if place == here else inf if place <= 0 else _round(1 / float(place)) for place in places)


def _round(distance_mm: float) -> float:
    return float(f"{distance_mm:.6g}")


def one_wave(live: Live) -> float:
    """Return by how much the source's vergence changes for one wave of defocus on the axis, 1/mm."""
    s = live.setup
    here = float(vergence(s.source.depth_mm))
    near = 1e-3 / closest_distance(prescription(live.state))
    depths = np.array([s.source.depth_mm, 1 / (here + near)])
    stop: Stop = s.stop
    waves = coefficients(s.lens, depths, 0.0, s.source.wavelength_um, stop).wd
    slope = abs(float(waves[1] - waves[0])) / near
    return 1 / slope if isfinite(slope) and slope else near


def shifts_around(live: Live, count: int) -> tuple[float, ...]:
    """Return sensor shifts on both sides of the present one, a depth of focus n′λ/NA² or a little more apart, µm."""
    index, na = float(live.setup.own.image_index), live.setup.cone.na
    depth = abs(depth_of_focus_um(index, live.setup.source.wavelength_um, na)) if na else 100.0
    steps = nice(depth) * (np.arange(count) - (count - 1) / 2)
    return tuple(float(live.state.optics.sensor_shift_um + step) for step in steps)


def heading_texts(request: MatrixRequest) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return how rows and columns are written, with their units."""
    rows = tuple(f"{_short(angle)}°" for angle in request.rows)
    if request.across == "depth_mm":
        return rows, tuple(told_apart([float(value) for value in request.columns]))
    if request.across == "wavelength_nm":
        return rows, tuple(f"{float(nm):.1f} nm" for nm in request.columns)
    if request.across == "sensor_shift_um":
        return rows, tuple(f"{_short(float(um), 1)} µm" for um in request.columns)
    return rows, tuple(map(str, request.columns))


def _short(value: float, places: int = 2) -> str:
    text = with_sign(value, places)
    return text.rstrip("0").rstrip(".") if "." in text else text


def nearest(request: MatrixRequest, state: State, side: str = "") -> tuple[int, int, bool]:
    """Return row and column of the picture nearest to a state's point, and whether it is of that very point."""
    here = state.optics
    rows = np.abs(np.array(request.rows) - here.field_deg)
    row = int(rows.argmin())
    exact = bool(rows[row] < MOST_DEG)
    if request.across == SIDE:
        return row, len(request.columns) - 1 if side == "B" else 0, exact
    columns = np.array([float(value) for value in request.columns])
    if request.across == "sensor_shift_um":
        apart, least = np.abs(columns - here.sensor_shift_um), FEWEST_UM
    elif request.across == "depth_mm":
        apart = np.abs(vergence(columns) - vergence(here.depth_mm))
        least = SAME * float(vergence(here.depth_mm)) + 1e-15
    else:
        apart, least = np.abs(columns - here.wavelength_nm), SAME * here.wavelength_nm
    column = int(apart.argmin())
    return row, column, exact and bool(apart[column] <= least)


def point_entries(request: MatrixRequest, row: int, column: int) -> dict[str, Any]:
    """Return the entries of the State that make a picture's point the present one; of a side, only its field."""
    entries: dict[str, Any] = {"field_deg": request.rows[row]}
    if request.across != SIDE:
        entries[request.across] = float(request.columns[column])
    return entries
