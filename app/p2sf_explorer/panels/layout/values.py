"""The value of what a hand moves on the layout, with its unit."""

from math import isfinite

from p2sf.lens.lens import Lens
from p2sf_explorer.compute.quantities import F_NUMBER, FIELD, SHIFT
from p2sf_explorer.compute.setup import prescription, ranges
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.panels.layout.grips import DECENTRE_DIGITS, Grip, can_bend, shape_of
from p2sf_explorer.panels.layout.source_point import DrawnSetup
from p2sf_explorer.state.build_errors import amount_of
from p2sf_explorer.state.scales import significant, with_sign, written_distance

DIGITS = 5


def value_of(grip: Grip, shown: DrawnSetup) -> str:
    """Return what is written beside the hand that moves a grip."""
    return WORDS[grip.kind](grip, shown)


def _source(grip: Grip, shown: DrawnSetup) -> str:
    optics = shown.state.optics
    return local(f"{written_distance(optics.depth_mm)} · {FIELD.write(optics.field_deg)}")


def _sensor(grip: Grip, shown: DrawnSetup) -> str:
    sensor = with_sign(shown.setup.lens.sensor_mm, 3)
    shift = SHIFT.write(shown.state.optics.sensor_shift_um)
    return tr("sensor at {place} mm, shift {shift}", place=sensor, shift=shift)


def _rim(grip: Grip, shown: DrawnSetup) -> str:
    number = F_NUMBER.write(F_NUMBER.shown(shown.state, ranges(prescription(shown.state))))
    return tr("{f_number}, stop ⌀ {diameter} mm", f_number=number, diameter=_mm(2 * shown.layout.drawing.stop_rim))


def _stop(grip: Grip, shown: DrawnSetup) -> str:
    lens = shown.setup.prescription
    number = lens.stop_surface or 0
    behind = lens.surfaces[number - 2].thickness
    return tr("stop {gap} mm behind surface {number}", gap=_mm(behind), number=number - 1)


def _edge(grip: Grip, shown: DrawnSetup) -> str:
    number = grip.surfaces[0]
    return tr("radius {number}: {radius} mm", number=number, radius=_radius(shown.setup.prescription, number))


def _vertex(grip: Grip, shown: DrawnSetup) -> str:
    number = grip.surfaces[0] - 1
    thick = shown.setup.prescription.surfaces[number - 1].thickness
    return tr("thickness {number}: {thickness} mm", number=number, thickness=_mm(thick))


def _glass(grip: Grip, shown: DrawnSetup) -> str:
    lens, (first, last) = shown.setup.prescription, grip.surfaces
    if can_bend(lens, grip.surfaces):
        radii = " / ".join(_radius(lens, number) for number in (first, last))
        return tr("bending X = {shape}, R = {radii} mm", shape=with_sign(shape_of(lens, grip.surfaces), 3), radii=radii)
    behind = _mm(lens.surfaces[last - 1].thickness)
    if first == 1:
        return tr("{behind} mm behind surface {last}", behind=behind, last=last)
    before = _mm(lens.surfaces[first - 2].thickness)
    words = "{before} mm before surface {first}, {behind} mm behind {last}"
    return tr(words, before=before, first=first, behind=behind, last=last)


def _decentre(grip: Grip, shown: DrawnSetup) -> str:
    amount = amount_of(shown.state.optics.errors, "decentre_y", grip.surfaces)
    return tr("decentre y {amount} mm", amount=with_sign(amount, DECENTRE_DIGITS))


def _radius(lens: Lens, number: int) -> str:
    radius = lens.surfaces[number - 1].radius
    return _mm(radius) if isfinite(radius) else "∞"


def _mm(value: float) -> str:
    return significant(value, DIGITS)


WORDS = {
    "source": _source,
    "sensor": _sensor,
    "rim": _rim,
    "stop": _stop,
    "edge": _edge,
    "vertex": _vertex,
    "glass": _glass,
    "decentre": _decentre,
}
