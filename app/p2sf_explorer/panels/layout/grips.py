"""What of a lens's drawing a hand can take hold of, and the state when it is at another place. No Qt in here.

Every change is made of the state at the beginning of a drag and of the present place, so that a drag leaves no trace
of its way.
"""

from dataclasses import dataclass, replace
from math import copysign, inf, isfinite

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens, Surface
from p2sf_explorer.compute.editing import edited_state, radius_through, stop_gap, with_stop_shift, with_surface
from p2sf_explorer.compute.glass_outlines import GlassOutline, Section, clear_rims, sag, still, vertices
from p2sf_explorer.compute.layout import Layout, nearly_straight
from p2sf_explorer.compute.setup import ParaxialSetup, prescription, ranges
from p2sf_explorer.state.build_errors import amount_of, with_error
from p2sf_explorer.state.pinning import with_links
from p2sf_explorer.state.state import State, change

Span = tuple[int, int]
"""First and last surface, from 1, of what is selected."""
LEAST_MM = 1e-3  # between the last vertex and the sensor
DECENTRE_DIGITS = 3  # of mm
FLATTEST = 1e-9  # of the height: a smaller sag is a plane


@dataclass(frozen=True)
class Grip:
    """Something to hold, at z and y in mm.

    ``kind``: "sensor", "rim" (of the stop), "stop" (along the axis), "edge" (of a surface, its radius), "vertex" (its
    thickness), "glass" (the bending of an element, or the place of a group), "decentre" (of a piece). ``surfaces`` are
    those it changes. ``drawn``: z and y where it is drawn, if parts that are tilted or decentred take it elsewhere.
    """

    kind: str
    z: float
    y: float
    surfaces: Span = (0, 0)
    drawn: tuple[float, float] | None = None

    @property
    def place(self) -> tuple[float, float]:
        """Return z and y where it is drawn."""
        return self.drawn or (self.z, self.y)


def placed_grips(setup: ParaxialSetup, layout: Layout, selected: Span | None) -> tuple[Grip, ...]:
    """Return the grips of a lens, each where its part is drawn.

    What they move are numbers of the lens set straight. Behind a fold a way along the drawing is none along the axis,
    and there are no grips.
    """
    if not nearly_straight(setup.lens):
        return ()
    lens, drawing = setup.prescription, layout.drawing
    z = vertices(lens)

    def placed(grip: Grip, section: Section, from_z: float) -> Grip:
        at_z, at_y = section.placed(grip.z - from_z, grip.y)
        return replace(grip, drawn=(float(at_z), float(at_y)))

    of_stop = (placed(grip, drawing.stop, drawing.stop_z) for grip in stop_grips(setup, layout))
    of_surfaces = (
        placed(grip, drawing.surfaces[grip.surfaces[0] - 1], z[grip.surfaces[0] - 1])
        for grip in surface_grips(lens, selected)
    )
    return (*of_stop, *of_surfaces, placed(sensor_grip(layout), drawing.sensor, drawing.sensor_z))


def sensor_grip(layout: Layout) -> Grip:
    """Return the grip of the sensor."""
    return Grip("sensor", layout.drawing.sensor_z, 0.0)


def stop_grips(setup: ParaxialSetup, layout: Layout) -> tuple[Grip, ...]:
    """Return the grips of the stop's rim, and of its place where it can move within an air gap."""
    z, rim = layout.drawing.stop_z, layout.drawing.stop_rim
    found = []
    lens = setup.prescription
    if isfinite(ranges(lens).file_f_number):
        found += [Grip("rim", z, side * rim) for side in (1.0, -1.0)]
    if lens.stop_surface == int(setup.stop.surface) and lens.stop_surface > 1 and stop_gap(lens):
        found.append(Grip("stop", z, rim))
    return tuple(found)


def surface_grips(lens: Lens, selected: Span | None) -> tuple[Grip, ...]:
    """Return the grips of the selected surfaces: the two ends of each, and its vertex where something stands before."""
    if not selected or not 1 <= selected[0] <= selected[1] <= len(lens.surfaces):
        return ()
    z, rims, found = vertices(lens), clear_rims(still(lens)), []
    for number in range(selected[0], selected[1] + 1):
        rim, span = rims[number - 1], (number, number)
        edge = z[number - 1] + edge_sag(lens.surfaces[number - 1], rim)
        found += [Grip("edge", edge, side * rim, span) for side in (1.0, -1.0)]
        if number > 1:
            found.append(Grip("vertex", z[number - 1], 0.0, span))
    return tuple(found)


def edge_sag(surface: Surface, rim: float) -> float:
    """Return the sag of a surface at its rim, mm."""
    return float(sag(surface, np.array(rim)))


def glass_runs(outlines: tuple[GlassOutline, ...]) -> tuple[Span, ...]:
    """Return the elements as they are drawn, cemented ones as one."""
    runs: list[Span] = []
    for first, last in (outline.surfaces for outline in outlines):
        if runs and runs[-1][1] == first:
            runs[-1] = runs[-1][0], last
        elif first != last:
            runs.append((first, last))
    return tuple(runs)


def group_of(lens: Lens, runs: tuple[Span, ...], run: Span) -> Span:
    """Return all elements on the same side of the stop as this one, as one group."""
    stop = lens.stop_surface or 0
    same = [other for other in runs if (other[0] > stop) == (run[0] > stop)]
    return same[0][0], same[-1][1]


def drag(grip: Grip, start: State, z: float, y: float) -> State:
    """Return the state when a grip that was taken in the state ``start`` is at z and y, mm; P2SFError where it cannot.

    The grip comes as near to this place as the lens allows.
    """
    drawn_z, drawn_y = grip.place
    return MOVES[grip.kind](grip, start, grip.z + z - drawn_z, grip.y + y - drawn_y)


def _sensor(grip: Grip, start: State, z: float, y: float) -> State:
    """Shift the sensor, which stays behind the last vertex."""
    lens = prescription(start)
    last, along = lens.vertices[-2], lens.directions[-1]
    by = along * max(along * z, along * last + LEAST_MM) - grip.z
    return change(start, sensor_shift_um=start.optics.sensor_shift_um + UM_PER_MM * by)


def _rim(grip: Grip, start: State, z: float, y: float) -> State:
    """Open the stop: its rim is inverse to the f-number."""
    limits = ranges(prescription(start))
    number = start.optics.f_number or limits.file_f_number
    height = max(y * copysign(1.0, grip.y), 1e-9)
    low, high = limits.f_number
    return change(start, f_number=min(max(number * abs(grip.y) / height, low), high))


def _stop(grip: Grip, start: State, z: float, y: float) -> State:
    """Move the stop within its air gap."""
    return edited_state(start, with_stop_shift(prescription(start), z - grip.z))


def _edge(grip: Grip, start: State, z: float, y: float) -> State:
    """Curve the surface so that its edge is at z."""
    lens, number = prescription(start), grip.surfaces[0]
    surface = lens.surfaces[number - 1]
    depth = z - vertices(lens)[number - 1]
    radius = inf if abs(depth) < FLATTEST * abs(grip.y) else radius_through(surface, grip.y, depth)
    return edited_state(start, with_surface(lens, number, radius=radius))


def _vertex(grip: Grip, start: State, z: float, y: float) -> State:
    """Change the space in front of the surface; what follows moves with it."""
    lens, number = prescription(start), grip.surfaces[0]
    before, along = lens.surfaces[number - 2].thickness, lens.directions[number - 1]
    thickness = along * max(0.0, along * (before + z - grip.z))
    return edited_state(start, with_surface(lens, number - 1, thickness=thickness))


def _glass(grip: Grip, start: State, z: float, y: float) -> State:
    """Bend the selected element, its front's edge following the hand; move a group of several along the axis."""
    from p2sf.paraxial.bending import bend, elements

    lens, (first, last) = prescription(start), grip.surfaces
    if (first, last) in elements(lens):
        return edited_state(start, bend(lens, first, last, _curvature_by(lens, first, z - grip.z)))
    return edited_state(start, with_group_shift(lens, first, last, z - grip.z))


def _decentre(grip: Grip, start: State, z: float, y: float) -> State:
    """Move a piece across the axis; where the drawing enlarges decentres, the hand's way is the enlarged one."""
    from p2sf_explorer.state.built import exaggerate

    errors = start.optics.errors
    _, factor = exaggerate(errors, start.display.exaggerated)
    amount = amount_of(errors, "decentre_y", grip.surfaces) + (y - grip.y) / factor
    made = with_error(errors, "decentre_y", grip.surfaces, round(amount, DECENTRE_DIGITS))
    return change(start, **with_links(start, {"errors": made}))


def _curvature_by(lens: Lens, number: int, by_mm: float) -> float:
    """Return the change of a surface's curvature that moves its edge so far along the axis."""
    rim, surface = clear_rims(still(lens))[number - 1], lens.surfaces[number - 1]
    curved = radius_through(surface, rim, edge_sag(surface, rim) + by_mm)
    return 1 / curved - surface.curvature


def with_group_shift(lens: Lens, first: int, last: int, by_mm: float) -> Lens:
    """Return the lens with surfaces ``first`` to ``last`` moved along the axis between their neighbours.

    The first group of a lens has nothing before it; then the rest moves the other way.
    """
    behind = lens.surfaces[last - 1].thickness
    before = lens.surfaces[first - 2].thickness if first > 1 else inf * lens.directions[last]
    by = min(max(by_mm, min(-before, behind)), max(-before, behind))
    moved = with_surface(lens, last, thickness=behind - by)
    return moved if first == 1 else with_surface(moved, first - 1, thickness=before + by)


MOVES = {
    "sensor": _sensor,
    "rim": _rim,
    "stop": _stop,
    "edge": _edge,
    "vertex": _vertex,
    "glass": _glass,
    "decentre": _decentre,
}


def can_bend(lens: Lens, selected: Span) -> bool:
    """Return whether what is selected is one element with air on both sides."""
    from p2sf.paraxial.bending import element_of

    return element_of(lens, selected[0]) == selected


def shape_of(lens: Lens, selected: Span) -> float:
    """Return the shape factor of an element."""
    from p2sf.paraxial.bending import shape_factor

    return shape_factor(lens, *selected)
