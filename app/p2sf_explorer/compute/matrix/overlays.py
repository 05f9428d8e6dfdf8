"""Curves laid over each other: contrast of several fields, colours and sensor positions, and curves over the field."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from p2sf.colour.spectrum import spectrum_of
from p2sf.conventions import NM_PER_UM, UM_PER_MM, degrees_from_slope, slope_from_degrees, vergence
from p2sf.errors import P2SFError
from p2sf.figures.perfect import airy_radius_um
from p2sf.lens.lens import Lens, lens_range_um
from p2sf.lens.source import Source
from p2sf.messages import Message, Number
from p2sf.paraxial.pupils import pupils
from p2sf.pixel_kernels.illumination import light_passed, relative_illumination
from p2sf.pixel_kernels.sensor_points import sensor_map
from p2sf.psf.measures import COLOURS, PupilPart, mtf_of
from p2sf.psf.polychromatic import bands_through, chief_shifts_um
from p2sf.raytrace.field_curves import heights
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.matrix.points import spectral_lines, stated_fields, usual_wavelengths
from p2sf_explorer.compute.measured import MeasureRequest, measured_parts
from p2sf_explorer.compute.sampled import optics
from p2sf_explorer.compute.setup import ParaxialSetup, everywhere_by_coefficients, paraxial_setup, prescription
from p2sf_explorer.compute.views.colour import at_wavelength
from p2sf_explorer.compute.views.field import widest_slope
from p2sf_explorer.compute.views.through_focus import shift_range
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.what_if import check_focusable

FREQUENCIES = 257
FIELDS = {"preview": 9, "settled": 25}
SHIFTS = {"preview": 15, "settled": 61}
COLOURS_SHOWN, BANDS = 3, {"preview": 7, "settled": COLOURS}
RAYS = {"preview": 13, "settled": 41}  # chief rays over the field
USUAL_PER_MM = 10.0, 20.0, 40.0  # as makers of photographic lenses publish them
AT_ONCE = ("lateral", "distortion")
TANGENTIAL, SAGITTAL = 2, 1  # widths of lines
PLAIN = 0  # a line that belongs to none of the things compared


@dataclass(frozen=True)
class OverlayRequest:
    """Everything that the curves of ``of`` depend on: the ``state`` they belong to and the values they are drawn for.

    ``fields`` in degrees, ``frequencies`` per mm, ``shifts`` of the sensor in µm, ``wavelengths`` in nm; ``lens`` since
    its file may change. ``count`` of places along the curves.
    """

    of: str
    state: State
    lens: Lens
    count: int
    fields: tuple[float, ...] = ()
    frequencies: tuple[float, ...] = ()
    shifts: tuple[float, ...] = ()
    wavelengths: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class Line:
    """One curve; ``hue`` numbers the thing compared that it belongs to, from 1, 0 none; ``width`` of the line."""

    name: Message
    values: np.ndarray
    hue: int = PLAIN
    width: int = TANGENTIAL


@dataclass(frozen=True, eq=False)
class CurveOverlay:
    """Curves over common places ``x``; ``axes``: English names of both, ``here``: the present place, NaN for none.

    ``names``: of the things compared, in the order of their hues.
    """

    x: np.ndarray
    lines: tuple[Line, ...]
    axes: tuple[str, str]
    names: tuple[Message, ...] = ()
    here: float = np.nan
    missing: Message | None = None


def overlay(live: Live) -> View[CurveOverlay | None]:
    """Return the curves of the present setup, or the request for them where they are too slow for a frame."""
    request = overlay_request(live)
    if request.of in AT_ONCE:
        return View(AT_A_TIME[request.of](request))
    return View(None, request, held=live.quality == "preview")


def overlay_request(live: Live) -> OverlayRequest:
    """Return what is to be drawn, which depends on the present field only where the curves do. Raises P2SFError."""
    view, quality, lens = live.state.curves, live.quality, prescription(live.state)
    state, matrix = optics(live.state), live.state.matrix
    widest = float(degrees_from_slope(widest_slope(live)))
    if view.of == "fields":
        return OverlayRequest("fields", change(state, field_deg=0.0), lens, FREQUENCIES, compared_fields(live.state))
    if view.of == "field":
        fields = tuple(np.linspace(0.0, widest, FIELDS[quality]).tolist())
        found = OverlayRequest("field", change(state, field_deg=0.0), lens, len(fields), fields)
        return replace(found, frequencies=view.frequencies_per_mm or USUAL_PER_MM)
    if view.of == "focus":
        check_focusable(state)
        low, high, _ = shift_range(paraxial_setup(change(state, sensor_shift_um=0.0)))
        shifts = tuple(np.linspace(low, high, SHIFTS[quality]).tolist())
        found = OverlayRequest("focus", change(state, sensor_shift_um=0.0), lens, len(shifts), shifts=shifts)
        return replace(found, frequencies=view.frequencies_per_mm or USUAL_PER_MM)
    waves = matrix.wavelengths_nm or usual_wavelengths(lens, spectral_lines(live.state), COLOURS_SHOWN)
    if view.of == "colours":
        shown = change(state, spectrum=live.state.display.spectrum)
        return OverlayRequest("colours", shown, lens, BANDS[quality], wavelengths=waves)
    if view.of == "transmission_of_colours":
        some = compared_fields(live.state)
        return OverlayRequest(view.of, change(state, field_deg=0.0), lens, RAYS[quality], some, wavelengths=waves)
    of_light = view.of in ("illumination", "transmission")
    fields = tuple(np.linspace(0.0, widest, (FIELDS if of_light else RAYS)[quality]).tolist())
    return OverlayRequest(view.of, change(state, field_deg=0.0), lens, len(fields), fields, wavelengths=waves)


def compared_fields(state: State) -> tuple[float, ...]:
    """Return the fields whose curves and figures are compared, degrees."""
    return state.curves.fields_deg or stated_fields(prescription(state), state.curves.count)


Tell = Callable[[float, object], None]


def answer(request: OverlayRequest, stopped: Callable[[], bool], tell: Tell) -> CurveOverlay:
    """Return the curves of a request, for a worker; ``tell(share, so far)`` is called while they grow."""
    found: CurveOverlay | None = None
    for share, found in GROWING[request.of](request):
        tell(share, found)
        if stopped():
            break
    if found is None:
        raise P2SFError("there is nothing to draw; choose another field or wavelength")
    return found


def measure_of(state: State) -> MeasureRequest:
    """Return what describes the pupil of a state: the six coefficients where they make the picture, else exact rays."""
    setup = paraxial_setup(state)
    by_six = everywhere_by_coefficients(state, setup)
    six = tuple(float(value) for value in vars(setup.coefficients).values()) if by_six else ()
    return MeasureRequest(setup.lens, setup.source, state.optics.clip and not by_six, six)


def contrast_at(state: State, frequency_per_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return tangential and sagittal contrast; NaN where there is no pupil."""
    try:
        found = mtf_of(measured_parts(measure_of(state)), "", frequency_per_mm)
    except P2SFError:
        return (np.full(frequency_per_mm.shape, np.nan),) * 2
    return found.tangential, found.sagittal


def cut_off_per_mm(state: State) -> float:
    """Return the frequency from which on nothing is transferred, cycles per mm. P2SFError where there is no pupil."""
    return UM_PER_MM * max(measured_parts(measure_of(state))[0].pupil.cut_off_per_um)


MTF_AXES = "frequency on the sensor, 1/mm", "contrast"


def of_fields(request: OverlayRequest) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield the contrast of each field over spatial frequency, one field after the other."""
    x = np.linspace(0, cut_off_per_mm(request.state), request.count)
    names = tuple(Message("{angle}°", angle=Number(f"{angle:.4g}")) for angle in request.fields)
    lines: list[Line] = []
    for number, angle in enumerate(request.fields, 1):
        lines += pair(contrast_at(change(request.state, field_deg=angle), x), number, names[number - 1])
        yield number / len(names), CurveOverlay(x, tuple(lines), MTF_AXES, names)


def pair(both: tuple[np.ndarray, np.ndarray], hue: int, name: Message) -> list[Line]:
    """Return the lines of tangential, thick, and sagittal contrast."""
    return [
        Line(Message("{name} tangential", name=name), both[0], hue, TANGENTIAL),
        Line(Message("{name} sagittal", name=name), both[1], hue, SAGITTAL),
    ]


def of_colours(request: OverlayRequest) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield the contrast of single wavelengths, then that of the whole spectrum as the eye weighs it."""
    state, spectrum = request.state, spectrum_of(request.state.display.spectrum)
    shortest = min(request.wavelengths)
    x = np.linspace(0, cut_off_per_mm(at_wavelength(state, shortest)), FREQUENCIES)
    names = (*wave_names(request), Message("spectrum"))
    lines: list[Line] = []
    for number, nm in enumerate(request.wavelengths, 1):
        lines += pair(contrast_at(at_wavelength(state, nm), x), number, names[number - 1])
        yield number / (2 * len(names)), CurveOverlay(x, tuple(lines), MTF_AXES, names)
    setup = paraxial_setup(state)
    waves, xyz = bands_through(setup.lens, setup.source, spectrum, request.count)
    shifts = chief_shifts_um(setup.lens, setup.source, waves)
    shares = xyz[:, 1] / xyz[:, 1].sum()
    parts: list[PupilPart] = []
    for wave, share, shift in zip(waves, shares, shifts, strict=True):
        one = measured_parts(measure_of(at_wavelength(state, NM_PER_UM * float(wave))))[0]
        parts.append(PupilPart(one.pupil, float(share), float(shift)))
        yield 0.5 + 0.5 * len(parts) / (len(waves) + 1), CurveOverlay(x, tuple(lines), MTF_AXES, names)
    whole = mtf_of(parts, "", x)
    lines += pair((whole.tangential, whole.sagittal), PLAIN, names[-1])
    yield 1.0, CurveOverlay(x, tuple(lines), MTF_AXES, names)


def over_field(request: OverlayRequest) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield the contrast at each frequency over the field, from the axis outwards."""
    states = [change(request.state, field_deg=angle) for angle in request.fields]
    yield from over_places(request, states, np.array(request.fields), "field, °")


def through_focus(request: OverlayRequest) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield the contrast at each frequency over the position of the sensor."""
    states = [change(request.state, sensor_shift_um=shift) for shift in request.shifts]
    yield from over_places(request, states, np.array(request.shifts), "sensor shift, µm")


def over_places(
    request: OverlayRequest, states: list[State], x: np.ndarray, bottom: str
) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield the contrast at each frequency over places ``x``, each of which has its state.

    The whole curve comes soon, of every fourth place; straight lines fill it until the others are known.
    """
    frequencies = np.array(request.frequencies)
    names = tuple(Message("{f:g}/mm", f=f) for f in request.frequencies)
    found = np.full((2, len(frequencies), len(x)), np.nan)
    known = np.zeros(len(x), bool)
    for number in coarse_first(len(x)):
        found[:, :, number], known[number] = contrast_at(states[number], frequencies), True
        both = [[np.interp(x, x[known], row[known], np.nan, np.nan) for row in found[:, k]] for k in range(len(names))]
        lines = [line for k, name in enumerate(names) for line in pair((both[k][0], both[k][1]), k + 1, name)]
        yield float(known.mean()), CurveOverlay(x, tuple(lines), (bottom, "contrast"), names)


def coarse_first(count: int) -> list[int]:
    """Return the numbers below ``count``: every fourth and the last, then every second, then all others."""
    return sorted(range(count), key=lambda k: 0 if k % 4 == 0 or k == count - 1 else 1 if k % 2 == 0 else 2)


AIRY = Message("Airy radius")


def lateral_colour(request: OverlayRequest) -> CurveOverlay:
    """Return how much farther out each wavelength's chief ray of one object point lands than the present one's, µm.

    The pupil moves with colour, and with it the slope at which the chief ray of a near point enters.
    """
    setup, slopes = paraxial_setup(request.state), slope_from_degrees(np.array(request.fields))
    here = chief_heights_um(setup, slopes, setup.source.wavelength_um)
    lines = [
        Line(name, chief_heights_um(setup, slopes, nm / NM_PER_UM) - here, number)
        for number, (name, nm) in enumerate(zip(wave_names(request), request.wavelengths, strict=True), 1)
    ]
    radius = float(airy_radius_um(setup.source.wavelength_um, setup.cone.na))
    for sign in (-1, 1):
        lines.append(Line(AIRY, np.full(slopes.shape, sign * radius), PLAIN, SAGITTAL))
    return CurveOverlay(
        np.array(request.fields),
        tuple(lines),
        ("field, °", "lateral colour, µm"),
        (*wave_names(request), Message("Airy radius")),
    )


def chief_heights_um(setup: ParaxialSetup, slopes: np.ndarray, wavelength_um: float) -> np.ndarray:
    """Return how far out the chief rays of one wavelength land from the object points that are seen at these slopes."""
    planes = [
        float(pupils(setup.lens, wave, setup.stop).entrance_from_first)
        for wave in (setup.source.wavelength_um, wavelength_um)
    ]
    near = float(vergence(setup.source.depth_mm))
    ratio = (1 + near * planes[0]) / (1 + near * planes[1])
    source = replace(setup.source, wavelength_um=wavelength_um)
    landed = UM_PER_MM * heights(setup.lens, source, slopes * ratio, setup.stop).real
    inverted = np.nansum(landed) < 0
    return -landed if inverted else landed


def wave_names(request: OverlayRequest) -> tuple[Message, ...]:
    """Return how the wavelengths are written."""
    return tuple(Message("{nm:.1f} nm", nm=nm) for nm in request.wavelengths)


def distortion(request: OverlayRequest) -> CurveOverlay:
    """Return the distortion of each wavelength over the field in per cent: thick by exact rays, fine to third order."""
    setup, slopes = paraxial_setup(request.state), slope_from_degrees(np.array(request.fields))
    names, lines = wave_names(request), []
    for number, (name, nm) in enumerate(zip(names, request.wavelengths, strict=True), 1):
        found = heights(setup.lens, replace(setup.source, wavelength_um=nm / NM_PER_UM), slopes, setup.stop)
        lines.append(Line(name, 100 * found.distortion, number))
        third = Message("{name} third order", name=name)
        lines.append(Line(third, 100 * found.third_order_distortion, number, SAGITTAL))
    return CurveOverlay(np.array(request.fields), tuple(lines), ("field, °", "distortion, %"), names)


RIMS, STOP_ALONE, PINHOLE = Message("rims clip"), Message("the stop alone"), Message("cos⁴ of a pinhole")


def illumination(request: OverlayRequest) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield the irradiance of an even object over that on the axis, with all rims and by the stop alone."""
    setup = paraxial_setup(request.state)
    slopes = slope_from_degrees(np.array(request.fields))
    landed = np.abs(chief_heights_um(setup, slopes, setup.source.wavelength_um)) / UM_PER_MM
    known = np.isfinite(landed)
    found = np.full((2, len(slopes)), np.nan)
    pinhole = np.cos(np.arctan(slopes)) ** 4
    missing: Message | None = None
    for row, clip in enumerate((False, True)):
        try:
            seen = sensor_map(
                setup.lens, setup.source.depth_mm, setup.source.wavelength_um, float(landed[known].max()), clip
            )
            for number in np.flatnonzero(known):
                found[row, number] = float(relative_illumination(seen, 0.0, landed[number]))
                yield (row + (number + 1) / len(slopes)) / 2, light_curves(request, found, pinhole, missing)
        except P2SFError as error:  # a lens without rims, or a corner that no light reaches
            missing = error.message
    yield 1.0, light_curves(request, found, pinhole, missing)


def light_curves(
    request: OverlayRequest, found: np.ndarray, pinhole: np.ndarray, missing: Message | None
) -> CurveOverlay:
    """Return the curves of illumination as far as they are known."""
    lines = (
        Line(STOP_ALONE, 100 * found[0], 1),
        Line(RIMS, 100 * found[1], 2),
        Line(PINHOLE, 100 * pinhole, PLAIN, SAGITTAL),
    )
    axes = "field, °", "relative illumination, %"
    return CurveOverlay(np.array(request.fields), lines, axes, (STOP_ALONE, RIMS, PINHOLE), missing=missing)


TAKES_NOTHING = Message("no surface states a transmission, and the absorption of the glasses is off")
VISIBLE_NM = 380.0, 780.0


def transmission(request: OverlayRequest) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield what surfaces and media pass of the light of each wavelength over the field, from the axis outwards."""
    setup, names = paraxial_setup(request.state), wave_names(request)
    waves = [nm / NM_PER_UM for nm in request.wavelengths]
    slopes = slope_from_degrees(np.array(request.fields)).tolist()
    places = [[replace(setup.source, field_slope=s, wavelength_um=wave) for s in slopes] for wave in waves]
    yield from passed_curves(request, places, (np.array(request.fields), names, "field, °"))


def transmission_of_colours(request: OverlayRequest) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield what surfaces and media pass of the light of each field over the wavelengths that all glasses know."""
    setup = paraxial_setup(request.state)
    names = tuple(Message("{angle}°", angle=Number(f"{angle:.4g}")) for angle in request.fields)
    low, high = lens_range_um(setup.lens) or (0.0, np.inf)
    ends = max(VISIBLE_NM[0], NM_PER_UM * low), min(VISIBLE_NM[1], NM_PER_UM * high)
    waves = np.linspace(*(ends if ends[0] < ends[1] else (NM_PER_UM * low, NM_PER_UM * high)), request.count)
    slopes = slope_from_degrees(np.array(request.fields)).tolist()
    places = [[replace(setup.source, field_slope=s, wavelength_um=nm / NM_PER_UM) for nm in waves] for s in slopes]
    yield from passed_curves(request, places, (waves, names, "wavelength, nm"))


def passed_curves(
    request: OverlayRequest,
    places: list[list[Source]],
    drawn: tuple[np.ndarray, tuple[Message, ...], str],
) -> Iterator[tuple[float, CurveOverlay]]:
    """Yield a curve for each row of sources, in per cent; ``drawn``: places along them, their names, the lower axis."""
    lens, clip, (x, names, bottom) = paraxial_setup(request.state).lens, request.state.optics.clip, drawn
    takes = any(lens.absorbs) or any(surface.transmission for surface in lens.surfaces)
    missing = None if takes else TAKES_NOTHING
    found = np.full((len(places), len(x)), np.nan)
    for number, (row, column) in enumerate(np.ndindex(found.shape), 1):
        try:
            found[row, column] = 100 * light_passed(lens, places[row][column], clip)
        except P2SFError as error:  # a field that no light reaches, or a lens without rims
            missing = error.message
        if number % len(x) == 0:
            lines = tuple(
                Line(name, values, hue) for hue, (name, values) in enumerate(zip(names, found, strict=True), 1)
            )
            yield number / found.size, CurveOverlay(x, lines, (bottom, "transmission, %"), names, missing=missing)


AT_A_TIME: dict[str, Callable[[OverlayRequest], CurveOverlay]] = {"lateral": lateral_colour, "distortion": distortion}
GROWING: dict[str, Callable[[OverlayRequest], Iterator[tuple[float, CurveOverlay]]]] = {
    "fields": of_fields,
    "colours": of_colours,
    "field": over_field,
    "focus": through_focus,
    "illumination": illumination,
    "transmission": transmission,
    "transmission_of_colours": transmission_of_colours,
}
