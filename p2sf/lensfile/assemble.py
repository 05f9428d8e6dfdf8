"""From what a file states to a Lens: units, glasses, stop, aperture, fields; every error keeps its line."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import zip_longest
from math import hypot, inf, isfinite
from typing import TypeVar

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GeometryError, GlassError
from p2sf.glass.media import AIR, MIRROR, Medium, TabulatedIndex, measured_index
from p2sf.lens.lens import D_NM, Aperture, Lens, Surface, scale_surface, with_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.properties import PROPERTIES, words_of
from p2sf.lens.shapes import RadialPolynomial
from p2sf.lensfile import conjugates
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.glass_lookup import GlassSources, resolve
from p2sf.lensfile.paraxial_solves import with_solves
from p2sf.lensfile.raw import CATALOGUE_AIR, HOLE, RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.stated import compare, in_remarks
from p2sf.messages import Message
from p2sf.paraxial.pupils import stop_rim

Made = TypeVar("Made")
HIGHEST_ORDER = 40
SAME_DEG_C, SAME_ATM = 5.0, 0.05  # which change the index of a glass relative to air by less than 3e-5
MOST_SURFACES = 1000
FAR_PUPILS = 100.0  # of the longest thickness: chief rays over it are parallel to 1 % of their height
MOST_OBSCURED = 0.99  # of the stop's rim
PLACEHOLDER = Aperture("stop_semi_diameter", 1.0)
NO_STOP = Message("no stop named")
RECTANGLE, CIRCLE = Message("a rectangle"), Message("a circle")
HEIGHTS = {
    "object_height": Message("object heights"),
    "image_height": Message("image heights"),
    "real_image_height": Message("image heights"),
}


def assemble(raw: RawLens, sources: GlassSources, notes: Notebook, source: LensText) -> Lens:
    """Return the lens of a file; LensFileError with its line where it is not a lens that P2SF traces."""
    if not raw.surfaces:
        raise source.error("the file contains no lens surface between object and image", len(source.lines))
    if len(raw.surfaces) > MOST_SURFACES:
        where = raw.surfaces[MOST_SURFACES].line or len(source.lines)
        raise source.error(
            "the file holds {count} surfaces; at most {most} are read",
            where,
            count=len(raw.surfaces),
            most=MOST_SURFACES,
        )
    _leave_out_object_plane(raw, notes)
    _check_environment(raw, notes, source)
    media = _media(raw, sources, notes, source)
    lens = _with_line(lambda: _bare_lens(raw, media), raw, source, None)
    lens = _with_line(lambda: _within_data(lens, raw, notes), raw, source, raw.wavelength_line)
    lens = _with_line(lambda: with_solves(lens, raw, notes), raw, source, None)
    lens = _with_line(lambda: _with_aperture(lens, raw, notes), raw, source, raw.aperture_line or raw.wavelength_line)
    lens = _with_line(lambda: _with_obscuration(lens, raw, notes), raw, source, None)
    if not raw.sensor_stated:
        lens = _with_line(lambda: _at_paraxial_focus(lens, raw, notes), raw, source, None)
    lens = _with_line(lambda: _with_curved_sensor(lens, raw, notes), raw, source, raw.image.line if raw.image else None)
    slopes = _with_line(lambda: _field_slopes(lens, raw, notes), raw, source, raw.field_line)
    lens = _with_fields(lens, slopes)
    _read_notes(lens, raw, notes)
    own = {each.kind for each in raw.stated}
    compare([*raw.stated, *(each for each in in_remarks(source) if each.kind not in own)], lens, notes)
    lens = _with_line(lambda: _with_vignetting(lens, raw, slopes, notes), raw, source, None)
    _note_telecentric(lens, raw, notes)
    return _with_line(lambda: _with_object(lens, raw, notes), raw, source, None)


def _with_object(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with the distance of the file's object; one behind the first surface is left out, and noted."""
    distance = raw.object_distance * raw.unit_mm
    if not raw.object_stated:
        return lens
    if distance > 0:
        return replace(lens, object_distance=distance)
    told = "the file's object is at {distance:.6g} mm, not before the first surface, where alone a source can stand"
    notes.add("caution", told, distance=distance)
    return lens


def _with_curved_sensor(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with the radius and the conic constant of the image surface; other terms of it are left out."""
    image = raw.image
    if image is None:
        return lens
    if any(image.aspheric.values()) or image.shape is not None:
        told = (
            "the image surface has more terms than a radius and a conic constant; these two are read, the rest is not"
        )
        notes.add("caution", told, None, image.line)
    if not image.curvature:
        return lens
    return replace(lens, sensor_radius=raw.unit_mm / image.curvature, sensor_conic=image.conic)


def _leave_out_object_plane(raw: RawLens, notes: Notebook) -> None:
    """Put the object where a plane stands that does nothing at no distance before it; some programs begin with one."""
    first = raw.surfaces[0]
    idle = replace(first, number=0, line=None, label="", thickness=0.0, semi_diameter=inf) == RawSurface(0)
    if raw.object_distance == 0 and idle and raw.object_glass is None and raw.stop != 1 and len(raw.surfaces) > 1:
        notes.add("read", "a plane at the object, which does nothing, is left out", first.number, first.line)
        raw.object_distance = first.thickness
        del raw.surfaces[0]
        raw.stop = raw.stop - 1 if raw.stop else None


def _check_environment(raw: RawLens, notes: Notebook, source: LensText) -> None:
    """Raise LensFileError for glasses in other air than that of their catalogues, which their data do not follow."""
    temperature, pressure = raw.environment
    if raw.environment == CATALOGUE_AIR or not any(surface.glass and surface.glass.name for surface in raw.surfaces):
        return
    told = (
        "indices are those at 20 °C and 1 atm, not at {temperature:g} °C and {pressure:g} atm; they differ by some 1e-5"
    )
    notes.add("caution", told, None, raw.environment_line, temperature=temperature, pressure=pressure)
    if abs(temperature - CATALOGUE_AIR[0]) > SAME_DEG_C or abs(pressure - CATALOGUE_AIR[1]) > SAME_ATM:
        raise source.error(
            "the glasses stand at {temperature:g} °C and {pressure:g} atm, but their indices are known at 20 °C in air "
            "of 1 atm only; set these in the program that wrote the file, and save it again",
            raw.environment_line,
            temperature=temperature,
            pressure=pressure,
        )


def private_glass(
    name: str, waves_um: Sequence[float], values: Sequence[float], source: LensText, line: int
) -> TabulatedIndex:
    """Return a glass that a file defines by an index at each of some wavelengths; LensFileError for other lists."""
    pairs = sorted(zip(waves_um, values, strict=False))
    if not pairs or not len(values) == len(waves_um) == len(pairs):
        raise source.error("private glass {name} has not one index per wavelength; complete it", line, name=name)
    try:
        return measured_index([wave for wave, _ in pairs], [value for _, value in pairs])
    except GlassError as failure:
        raise source.error("private glass {name}: {error}", line, name=name, error=failure) from failure


def check_stop(raw: RawLens, source: LensText, line: int | None) -> None:
    """Raise LensFileError where the stop is not on one of the surfaces between object and image."""
    if raw.stop is not None and not 1 <= raw.stop <= len(raw.surfaces):
        raise source.error(
            "the stop is on the object or the image; put it on a surface between", line or len(source.lines)
        )


def _with_line(make: Callable[[], Made], raw: RawLens, source: LensText, line: int | None) -> Made:
    """Call ``make`` and attach a line number to its errors."""
    try:
        return make()
    except (GeometryError, GlassError) as failure:
        number = failure.message.values.get("surface")
        if isinstance(number, int) and 1 <= number <= len(raw.surfaces):
            line = raw.surfaces[number - 1].line
        raise source.error(failure.message, line or len(source.lines)) from failure
    except (OverflowError, ZeroDivisionError) as failure:
        raise source.error(
            "a number is too large or too small for a lens; correct it", line or len(source.lines)
        ) from failure


def _media(raw: RawLens, sources: GlassSources, notes: Notebook, source: LensText) -> list[Medium]:
    """Return the object medium and the medium behind each surface; LensFileError names all glasses not found."""
    media: list[Medium] = []
    unknown: dict[str, tuple[Message, int | None]] = {}
    for surface in (None, *raw.surfaces):
        if surface and surface.keeps_medium:
            media.append(next(medium for medium in reversed(media) if medium != MIRROR))
            continue
        glass, place = (surface.glass, surface.name) if surface else (raw.object_glass, Message("object space"))
        glass = glass or RawGlass(medium=AIR)
        line = glass.line or (surface.line if surface else None)
        try:
            found = resolve(glass, sources)
        except GlassError as failure:
            told = Message("{place}: {error}", place=place, error=failure)
            unknown.setdefault(glass.name or str(told), (told, line))
            media.append(AIR)
            continue
        number = surface.number if surface else None
        if found.substitution:
            notes.add("substituted", found.substitution, number, line)
        if found.choice:
            notes.add("caution", found.choice, number, line)
        media.append(found.medium)
    if unknown:
        (reason, line), *others = unknown.values()
        for other, _ in others:
            reason = Message("{first}; {second}", first=reason, second=other)
        raise source.error(reason, line or len(source.lines))
    return media


def _bare_lens(raw: RawLens, media: list[Medium]) -> Lens:
    surfaces = tuple(
        _surface(s, m, raw.unit_mm, n) for n, (s, m) in enumerate(zip(raw.surfaces, media[1:], strict=True), 1)
    )
    lines: dict[float, float] = {}
    for um, weight in zip_longest(raw.wavelengths_um, raw.weights[: len(raw.wavelengths_um)], fillvalue=1.0):
        lines[_nm(um)] = lines.get(_nm(um), 0.0) + weight
    stated = raw.primary is not None and 0 <= raw.primary < len(raw.wavelengths_um)
    return Lens(
        surfaces,
        PLACEHOLDER,
        raw.stop,
        title=raw.title,
        source=raw.source,
        wavelengths_nm=tuple(lines) or (D_NM,),
        wavelength_weights=_weights(lines.values()),
        reference_nm=_nm(raw.wavelengths_um[raw.primary or 0]) if stated else None,
        object_medium=media[0],
        aim=raw.aim,
        mask=raw.mask,
        sensor_before=_to_mm(raw.sensor_before, raw.unit_mm),
    )


def _nm(wavelength_um: float) -> float:
    return round(wavelength_um * NM_PER_UM, 9)


def _weights(weights: Iterable[float]) -> tuple[float, ...]:
    """Return the weights of wavelengths, none where all are the same or one is no weight."""
    listed = tuple(weights)
    return listed if len(set(listed)) > 1 and min(listed) >= 0 else ()


def _to_mm(placements: tuple[Placement, ...], unit: float) -> tuple[Placement, ...]:
    return tuple(placement.scaled(unit) for placement in placements)


def _within_data(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with the wavelengths at which all its glasses have data; GlassError if the primary has none."""
    kept = []
    for place, wave in enumerate(lens.wavelengths_nm):
        lacking = next((medium for medium in lens.media if _lacks(medium, wave / NM_PER_UM)), None)
        if lacking is None:
            kept.append(place)
        elif wave == lens.reference_wavelength_nm:
            lacking.index(wave / NM_PER_UM)  # raises, with the range of the data
        else:
            notes.add(
                "caution",
                "wavelength {wavelength:g} nm is outside the data of {glass} and left out",
                wavelength=wave,
                glass=lacking.label,
            )
    found = replace(
        lens,
        reference_nm=None,
        wavelengths_nm=tuple(lens.wavelengths_nm[place] for place in kept),
        wavelength_weights=_weights(lens.wavelength_weights[place] for place in kept if lens.wavelength_weights),
    )
    reference = lens.reference_wavelength_nm
    return found if found.reference_wavelength_nm == reference else replace(found, reference_nm=reference)


def _lacks(medium: Medium, wavelength_um: float) -> bool:
    low, high = medium.range_um or (0.0, inf)
    return not low <= wavelength_um <= high


def _surface(raw: RawSurface, medium: Medium, unit: float, number: int) -> Surface:
    """Return one surface in mm; an r² term on a plane makes a paraboloid. GeometryError for powers that cannot be."""
    curvature, conic, terms = raw.curvature, raw.conic, dict(raw.aspheric)
    if terms.get(2) and not curvature:
        curvature, conic = 2 * terms.pop(2), -1.0
    wrong = [power for power, value in terms.items() if value and not 1 <= power <= HIGHEST_ORDER]
    if wrong:
        raise GeometryError(
            "surface {surface}: aspheric term r^{power}; powers from 1 to {most} are read",
            surface=number,
            power=wrong[0],
            most=HIGHEST_ORDER,
        )
    odd = {power: value for power, value in terms.items() if value and (power == 2 or power % 2)}
    if odd and raw.shape:
        raise GeometryError(
            "surface {surface}: a term in r^{power} beside another shape; put all terms into one",
            surface=number,
            power=max(odd),
        )
    stated = {each.name: getattr(raw, each.name) for each in PROPERTIES if hasattr(raw, each.name)}
    stated |= {"radius": 1 / curvature if curvature else inf, "medium": medium, "conic": conic}
    stated |= {"aspheric": _even(terms), "semi_diameter": raw.semi_diameter if raw.semi_diameter > 0 else inf}
    if odd:
        stated["shape"] = RadialPolynomial(tuple(odd.get(power, 0.0) for power in range(1, max(odd) + 1)))
    return scale_surface(Surface(**stated), unit)


def _even(terms: dict[int, float]) -> tuple[float, ...]:
    """Return A4, A6, … up to the last that is not 0."""
    top = max((power for power, value in terms.items() if value and power % 2 == 0), default=2)
    return tuple(terms.get(power, 0.0) for power in range(4, top + 1, 2))


def _with_aperture(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    if raw.aperture is None:
        return _open_to_its_rims(lens, raw, notes)
    stop = raw.stop
    if stop is None:
        stop, _ = conjugates.limiting_rim(lens, lens.reference_wavelength_um)
        notes.add("caution", "no stop is named; the narrowest rim, surface {number}, is the stop", number=stop)
        lens = replace(lens, stop_surface=stop)
    if not raw.aperture[1] > 0:
        raise GeometryError("the aperture is {value:g}; give a positive number", value=raw.aperture[1])
    rays = conjugates.trace(lens, stop, lens.reference_wavelength_um)
    return replace(lens, aperture=conjugates.aperture(raw, raw.aperture, rays))


def _with_obscuration(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with an obscuration of its stop as a part of the mask; note all others, and holes.

    One that is not a whole disc within the rim stays a hole of the surface.
    """
    stop = (lens.stop_surface or 0) - 1
    for place, stated in enumerate(raw.surfaces):
        if not stated.inner_radius:
            continue
        own = lens.surfaces[place]
        rim, (x, y) = (stop_rim(lens) if place == stop else 0.0), own.rim.decentre if own.rim else (0.0, 0.0)
        share = own.inner_radius / rim if rim else inf
        if not (stated.obscured and share + hypot(x, y) / (rim or 1.0) <= MOST_OBSCURED):
            notes.add("caution", HOLE, stated.number, stated.line, radius=stated.inner_radius)
            continue
        told = "the middle of the stop is dark within a radius of {radius:g}, whatever rims do"
        notes.add("read", told, stated.number, stated.line, radius=stated.inner_radius)
        clear = replace(own, inner_radius=0.0, rim=own.rim if own.rim and own.rim.half_widths else None)
        mask = replace(lens.mask, obscuration=share, obscuration_x=x / rim, obscuration_y=y / rim)
        lens = replace(lens, mask=mask, surfaces=(*lens.surfaces[:place], clear, *lens.surfaces[place + 1 :]))
    return lens


def _note_telecentric(lens: Lens, raw: RawLens, notes: Notebook) -> None:
    """Note where a file asks for telecentric object space and the stop does not make it so."""
    stop = lens.stop_surface
    if not raw.telecentric or not stop:
        return
    pupil = conjugates.trace(lens, stop, lens.reference_wavelength_um).entrance_pupil
    if abs(pupil) > FAR_PUPILS * max(abs(surface.thickness) for surface in lens.surfaces):
        return
    told = (
        "the file asks for telecentric object space, but the entrance pupil stands at {pupil:.6g} mm from the first "
        "surface; chief rays pass the centre of the stop instead"
    )
    notes.add("caution", told, None, raw.field_line, pupil=pupil)


def _open_to_its_rims(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens of a file without an aperture, open to the rim of its stop or to its narrowest rim."""
    if raw.stop and isfinite(lens.surfaces[raw.stop - 1].semi_diameter):
        rim = lens.surfaces[raw.stop - 1].semi_diameter
        notes.add(
            "read",
            "the stop, surface {number}, is open to its rim, semi-diameter {rim:g} mm",
            number=raw.stop,
            rim=rim,
        )
    else:
        surface, rim = conjugates.limiting_rim(lens, lens.reference_wavelength_um)
        notes.add(
            "caution", "no aperture is stated; the narrowest rim, surface {number}, limits the light", number=surface
        )
    return replace(lens, aperture=Aperture("stop_semi_diameter", rim))


def _field_slopes(lens: Lens, raw: RawLens, notes: Notebook) -> list[tuple[float, float]]:
    """Return the slopes (x, y) of the chief rays of all fields; none where they have none, which is noted."""
    if not raw.fields:
        return []
    stop = lens.stop_surface or conjugates.limiting_rim(lens, lens.reference_wavelength_um)[0]
    try:
        slopes = conjugates.field_slopes(raw, conjugates.trace(lens, stop, lens.reference_wavelength_um))
    except GeometryError as failure:
        if raw.field_kind == "angle":
            raise
        notes.add("caution", "{error}; the field list holds the axis only", None, raw.field_line, error=failure)
        return []
    if raw.field_kind in HEIGHTS:
        notes.add(
            "read", "fields given as {kind} are kept as angles at the entrance pupil", kind=HEIGHTS[raw.field_kind]
        )
    if raw.field_kind == "real_image_height" and any(map(any, slopes)):
        from p2sf.lensfile.real_heights import real_slopes  # traces rays

        heights = [(x * raw.unit_mm, y * raw.unit_mm) for x, y in raw.fields]
        return real_slopes(lens, heights, slopes, _depth_mm(raw))
    return slopes


def _depth_mm(raw: RawLens) -> float:
    """Return the distance of the object of a file, infinite where it is not in front."""
    distance = raw.object_distance * raw.unit_mm
    return distance if 0 < distance < FAR else inf


def _with_fields(lens: Lens, slopes: list[tuple[float, float]]) -> Lens:
    if not slopes:
        return lens
    across, fields = zip(*conjugates.degrees_of(slopes), strict=True)
    return replace(lens, fields_deg=fields, fields_x_deg=across if any(across) else ())


def _at_paraxial_focus(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with its sensor at the paraxial focus for an object at infinity, for a file without one."""
    focus = conjugates.trace(lens, 1, lens.reference_wavelength_um).focus
    if not isfinite(focus):
        notes.add(
            "caution", "the file does not say where the sensor is, and the lens has no focus; it is at the last vertex"
        )
        return lens
    notes.add("caution", "the file does not say where the sensor is; it is put at the paraxial focus for infinity")
    return with_sensor(lens, focus)


def _read_notes(lens: Lens, raw: RawLens, notes: Notebook) -> None:
    stop = Message("stop on surface {number}", number=lens.stop_surface) if lens.stop_surface else NO_STOP
    notes.add(
        "read",
        "{count} surfaces, {stop}, {aperture}; {wavelengths:g} nm; fields {angles:.4g}°",
        count=len(lens.surfaces),
        stop=stop,
        aperture=_aperture_words(lens.aperture),
        wavelengths=lens.wavelengths_nm,
        angles=lens.fields_deg,
    )
    if lens.fields_x_deg:
        notes.add("read", "fields along x {angles:.4g}°", angles=lens.fields_x_deg)
    if isfinite(raw.mask.apodisation):
        told = "the pupil's amplitude falls to 1/e at {radius:.6g} of its rim's radius"
        notes.add("read", told, radius=raw.mask.apodisation)
    if lens.wavelength_weights:
        notes.add("read", "weights of the wavelengths, as the spectrum {spectrum}", spectrum=lens.spectrum)
    for number, surface in enumerate(lens.surfaces, 1):
        for words in words_of(surface, "aspheric"):
            notes.add("read", "{shape}", number, shape=words)
        if surface.rim:
            kind = RECTANGLE if surface.rim.half_widths else CIRCLE
            notes.add(
                "read",
                "where rims clip, its clear rim is {kind} about ({centre:g}) mm",
                number,
                kind=kind,
                centre=surface.rim.decentre,
            )
    if raw.unit_mm != 1:
        notes.add("read", "lengths converted to mm from units of {unit:g} mm", unit=raw.unit_mm)


def _with_vignetting(lens: Lens, raw: RawLens, slopes: list[tuple[float, float]], notes: Notebook) -> Lens:
    """Return the lens with rims for vignetting factors, where it has none."""
    if raw.vignetting is None:
        return lens
    from p2sf.lensfile.vignetting_rims import with_vignetting  # traces rays

    return with_vignetting(lens, raw.vignetting, slopes, _depth_mm(raw), notes)


def _aperture_words(aperture: Aperture) -> Message:
    """Return the aperture in words."""
    match aperture.kind:
        case "f_number":
            return Message("f number {value:.6g}", value=aperture.value)
        case "entrance_pupil_diameter":
            return Message("entrance pupil diameter {value:.6g} mm", value=aperture.value)
        case "stop_semi_diameter":
            return Message("stop semi diameter {value:.6g} mm", value=aperture.value)
