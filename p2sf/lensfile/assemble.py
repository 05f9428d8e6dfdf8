"""From what a file states to a Lens: units, glasses, stop, aperture, fields; every error keeps its line."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf, isfinite

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GeometryError, GlassError
from p2sf.glass.media import AIR, MIRROR, Medium, TabulatedIndex, measured_index
from p2sf.lens.lens import Aperture, Lens, Surface, scale_surface
from p2sf.lens.placement import Placement
from p2sf.lens.properties import PROPERTIES, words_of
from p2sf.lens.shapes import RadialPolynomial
from p2sf.lensfile import conjugates
from p2sf.lensfile.glass_lookup import GlassSources, resolve
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText
from p2sf.messages import Message

HIGHEST_ORDER = 40
MOST_SURFACES = 1000
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
    media = _media(raw, sources, notes, source)
    lens = _with_line(lambda: _bare_lens(raw, media), raw, source, None)
    lens = _with_line(lambda: _within_data(lens, raw, notes), raw, source, raw.wavelength_line)
    lens = _with_line(lambda: _with_aperture(lens, raw, notes), raw, source, raw.aperture_line or raw.wavelength_line)
    lens = _with_line(lambda: _with_fields(lens, raw, notes), raw, source, raw.field_line)
    if not raw.sensor_stated:
        lens = _with_line(lambda: _at_paraxial_focus(lens, raw, notes), raw, source, None)
    _read_notes(lens, raw, notes)
    _note_vignetting(lens, raw, notes)
    return conjugates.with_object_named(lens, raw.object_distance * raw.unit_mm)


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


def _with_line(make: Callable[[], Lens], raw: RawLens, source: LensText, line: int | None) -> Lens:
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
    """Return the object medium and the medium behind each surface."""
    media = [_medium(raw.object_glass, None, sources, notes, source)]
    for surface in raw.surfaces:
        here = next(medium for medium in reversed(media) if medium != MIRROR)
        media.append(here if surface.keeps_medium else _medium(surface.glass, surface, sources, notes, source))
    return media


def _medium(
    glass: RawGlass | None, surface: RawSurface | None, sources: GlassSources, notes: Notebook, source: LensText
) -> Medium:
    if glass is None:
        return AIR
    line = glass.line or (surface.line if surface else None)
    try:
        found = resolve(glass, sources)
    except GlassError as failure:
        where = surface.name if surface else Message("object space")
        raise source.error("{place}: {error}", line or len(source.lines), place=where, error=failure) from failure
    if found.substitution:
        notes.add("substituted", found.substitution, surface.number if surface else None, line)
    return found.medium


def _bare_lens(raw: RawLens, media: list[Medium]) -> Lens:
    surfaces = tuple(
        _surface(s, m, raw.unit_mm, n) for n, (s, m) in enumerate(zip(raw.surfaces, media[1:], strict=True), 1)
    )
    wavelengths = tuple(dict.fromkeys(round(w * NM_PER_UM, 9) for w in raw.wavelengths_um)) or (587.5618,)
    return Lens(
        surfaces,
        PLACEHOLDER,
        raw.stop,
        title=raw.title,
        source=raw.source,
        wavelengths_nm=wavelengths,
        object_medium=media[0],
        sensor_before=_to_mm(raw.sensor_before, raw.unit_mm),
    )


def _to_mm(placements: tuple[Placement, ...], unit: float) -> tuple[Placement, ...]:
    return tuple(placement.scaled(unit) for placement in placements)


def _within_data(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with the wavelengths at which all its glasses have data; GlassError if the primary has none."""
    primary = _primary_um(raw, lens)
    kept = []
    for wave in lens.wavelengths_nm:
        lacking = next((medium for medium in lens.media if _lacks(medium, wave / NM_PER_UM)), None)
        if lacking is None:
            kept.append(wave)
        elif abs(wave / NM_PER_UM - primary) < 1e-9 or len(lens.wavelengths_nm) == 1:
            lacking.index(wave / NM_PER_UM)  # raises, with the range of the data
        else:
            notes.add(
                "caution",
                "wavelength {wavelength:g} nm is outside the data of {glass} and left out",
                wavelength=wave,
                glass=lacking.label,
            )
    return replace(lens, wavelengths_nm=tuple(kept))


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


def _primary_um(raw: RawLens, lens: Lens) -> float:
    if raw.primary is not None and 0 <= raw.primary < len(raw.wavelengths_um):
        return raw.wavelengths_um[raw.primary]
    return lens.reference_wavelength_um


def _with_aperture(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    primary = _primary_um(raw, lens)
    if raw.aperture is None:
        return _open_to_its_rims(lens, raw, primary, notes)
    stop = raw.stop
    if stop is None:
        stop, _ = conjugates.limiting_rim(lens, primary)
        notes.add("caution", "no stop is named; the narrowest rim, surface {number}, is the stop", number=stop)
        lens = replace(lens, stop_surface=stop)
    if not raw.aperture[1] > 0:
        raise GeometryError("the aperture is {value:g}; give a positive number", value=raw.aperture[1])
    rays = conjugates.trace(lens, stop, primary)
    same = abs(primary - lens.reference_wavelength_um) < 1e-9
    return replace(lens, aperture=conjugates.aperture(raw, raw.aperture, rays, same))


def _open_to_its_rims(lens: Lens, raw: RawLens, wavelength_um: float, notes: Notebook) -> Lens:
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
        surface, rim = conjugates.limiting_rim(lens, wavelength_um)
        notes.add(
            "caution", "no aperture is stated; the narrowest rim, surface {number}, limits the light", number=surface
        )
    return replace(lens, aperture=Aperture("stop_semi_diameter", rim))


def _with_fields(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    if not raw.fields:
        return lens
    stop = lens.stop_surface or conjugates.limiting_rim(lens, lens.reference_wavelength_um)[0]
    try:
        slopes = conjugates.field_slopes(raw, conjugates.trace(lens, stop, _primary_um(raw, lens)))
    except GeometryError as failure:
        if raw.field_kind == "angle":
            raise
        notes.add("caution", "{error}; the field list holds the axis only", None, raw.field_line, error=failure)
        return lens
    if any(x for x, _ in raw.fields):
        notes.add("read", "fields beside the y axis are turned onto it, which a round lens does not notice")
    if raw.field_kind in HEIGHTS:
        notes.add(
            "read", "fields given as {kind} are kept as angles at the entrance pupil", kind=HEIGHTS[raw.field_kind]
        )
    if raw.field_kind == "real_image_height" and any(slopes):
        notes.add("caution", "real image heights are taken as paraxial ones; distortion makes the angles differ")
    return replace(lens, fields_deg=conjugates.degrees_of(slopes))


def _at_paraxial_focus(lens: Lens, raw: RawLens, notes: Notebook) -> Lens:
    """Return the lens with its sensor at the paraxial focus for an object at infinity, for a file without one."""
    focus = conjugates.trace(lens, 1, lens.reference_wavelength_um).focus
    if not isfinite(focus):
        notes.add(
            "caution", "the file does not say where the sensor is, and the lens has no focus; it is at the last vertex"
        )
        return lens
    notes.add("caution", "the file does not say where the sensor is; it is put at the paraxial focus for infinity")
    return replace(lens, surfaces=(*lens.surfaces[:-1], replace(lens.surfaces[-1], thickness=focus)))


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
    if isfinite(raw.object_distance):
        notes.add(
            "read",
            "the file's object is at {distance:.6g} mm; ask for this depth to see the file's image",
            distance=raw.object_distance * raw.unit_mm,
        )


def _note_vignetting(lens: Lens, raw: RawLens, notes: Notebook) -> None:
    """Say what became of vignetting factors: rims cut the pencil of every field themselves, without them it is full."""
    if raw.vignetting is None:
        return
    others = (s for number, s in enumerate(lens.surfaces, 1) if number != lens.stop_surface)
    if not raw.vignetting:
        notes.add("ignored", "vignetting factors, all of them 0")
    elif any(isfinite(surface.semi_diameter) for surface in others):
        notes.add(
            "read",
            "vignetting factors (up to {value:g}) are not needed: the rims of the surfaces cut the pencil themselves",
            value=raw.vignetting,
        )
    else:
        notes.add(
            "caution",
            "vignetting factors (up to {value:g}) are not applied, and no surface but the stop states a rim; "
            "the pupil is full at every field",
            value=raw.vignetting,
        )


def _aperture_words(aperture: Aperture) -> Message:
    """Return the aperture in words."""
    match aperture.kind:
        case "f_number":
            return Message("f number {value:.6g}", value=aperture.value)
        case "entrance_pupil_diameter":
            return Message("entrance pupil diameter {value:.6g} mm", value=aperture.value)
        case "stop_semi_diameter":
            return Message("stop semi diameter {value:.6g} mm", value=aperture.value)
