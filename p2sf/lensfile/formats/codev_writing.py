"""Write a lens as a CODE V .seq file."""

from functools import reduce
from math import exp, inf, isfinite, pi
from typing import NamedTuple

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.errors import GlassError, LensFileError
from p2sf.glass.media import AIR, CatalogueGlass, ConstantIndex, Medium, ModelGlass, TabulatedIndex
from p2sf.lens.anamorphic import Anamorphic
from p2sf.lens.even_terms import power_terms
from p2sf.lens.freeform import Freeform, XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.grating import Grating, Phase
from p2sf.lens.lens import USUAL_AIM, Lens, Surface
from p2sf.lens.placement import Motion, Placement, along_z, placement_of
from p2sf.lens.properties import CODE_V
from p2sf.lens.shapes import Shape
from p2sf.lens.tilts import decentred_surface
from p2sf.lensfile.conjugates import FAR, limiting_rim
from p2sf.lensfile.formats.codev import BORN_WOLF, FREEFORMS, ORDERS, TILT_NAMES
from p2sf.lensfile.glass_lookup import GlassSources, resolve
from p2sf.lensfile.raw import RawGlass
from p2sf.lensfile.source_text import digits
from p2sf.lensfile.surface_endings import check_endings, check_plain, in_own_axes, type_in_file
from p2sf.paraxial.pupils import stop_rim
from p2sf.raytrace.focusing import object_distance

APERTURES = {"entrance_pupil_diameter": "EPD", "f_number": "FNO"}
HIGHEST_ODD = 30
ANY_WAVELENGTH_NM = 50.0, 400.0, 600.0, 1000.0, 50_000.0
LINES_NM = 404.6561, 486.1327, 587.5618, 656.2725, 852.11  # h, F, d, C, s
FEWEST_SAMPLES = 4
FREEFORM_TYPES: dict[type[Shape], str] = {XYPolynomial: "XYP", ZernikeStandardSag: "ZRN", ZernikeFringeSag: "ZFR"}
LETTERS = {power: letter for letter, power in ORDERS.items()}


class CodeVRow(NamedTuple):
    """One surface of the file: what it is and the medium behind it, its number, and how it stands.

    ``number`` is 0 for a plane that only carries a break, and negative where such planes follow with the thickness.
    """

    surface: Surface
    medium: Medium
    number: int
    kind: str
    placement: Placement


def lens_to_seq(lens: Lens) -> str:
    """Return the lens as CODE V commands; LensFileError for what such a file cannot hold.

    Breaks of the coordinates are planes of their own with XDE to CDE, where they are not a surface's own decentre, with
    DAR or BEN behind it. Glasses of no maker known here are private ones, with their indices at the lens's wavelengths.
    Of a zoom it is the present position.
    """
    check_endings(lens, CODE_V)
    if lens.aim != USUAL_AIM:
        raise LensFileError(
            "rays fill the paraxial entrance pupil (aim {aim}), but CODE V aims them at the stop; aim at the stop, or "
            "save as TOML",
            aim=lens.aim,
        )
    stop = lens.stop_surface or limiting_rim(lens, lens.reference_wavelength_um)[0]
    private: dict[Medium, str] = {}
    rows = [row for number in range(1, len(lens.surfaces) + 1) for row in _rows(lens, number)]
    surfaces = [line for row in rows for line in _surface(lens, row, stop, private)]
    image = placement_of(reduce(Motion.then, (placement.motion for placement in lens.sensor_before), along_z(0.0)))
    bent = [f"SI {digits(lens.sensor_radius if lens.sensor_surface.curvature else 0.0)} 0.0"]
    bent += ["ASP", f"K {digits(lens.sensor_conic)}"] * bool(lens.sensor_conic)
    behind = f" {_glass(lens.object_medium, private)}" if lens.object_medium != AIR else ""
    head = [*_head(lens), *_catalogue(lens, private), f"SO 0.0 {digits(min(FAR, object_distance(lens)))}{behind}"]
    return "\n".join([*head, *surfaces, *bent, *_tilts("", image), "GO", ""])


def _head(lens: Lens) -> list[str]:
    lines = dict(zip(lens.wavelengths_nm, lens.wavelength_weights or (1.0,) * len(lens.wavelengths_nm), strict=True))
    waves = sorted(lines)
    title = " ".join(f"{lens.title or lens.name}{f', {lens.positions.words}' if lens.positions else ''}".split())
    keyword = APERTURES.get(lens.aperture.kind)
    return [
        "RDM",
        "LEN",
        f"TITLE '{title.replace(chr(39), chr(8217))}'",
        "DIM M",
        *[f"{keyword} {digits(lens.aperture.value)}"] * bool(keyword),
        f"WL {' '.join(map(digits, waves))}",
        f"REF {waves.index(lens.reference_wavelength_nm) + 1}",
        *[f"PUX {digits(lens.mask.apodisation)}; PUY {digits(lens.mask.apodisation)}; PUI {digits(exp(-2))}"]
        * isfinite(lens.mask.apodisation),
        *[f"WTW {' '.join(digits(lines[wave]) for wave in waves)}"] * bool(lens.wavelength_weights),
        *[f"XAN {' '.join(map(digits, lens.fields_x_deg))}"] * bool(lens.fields_x_deg),
        f"YAN {' '.join(map(digits, lens.fields_deg))}",
    ]


def _rows(lens: Lens, number: int) -> list[CodeVRow]:
    """Return a surface, and the planes that its breaks need before and behind it."""
    surface, here = in_own_axes(lens.surfaces[number - 1]), lens.media[number - 1]
    behind = lens.media[number]
    kind, own = _own_break(surface)
    if kind:
        return [CodeVRow(surface, surface.medium, number, kind, own)]
    *before, last = surface.before or (Placement(),)
    rows = [CodeVRow(Surface(), here, 0, "", placement) for placement in before]
    if not surface.after:
        return [*rows, CodeVRow(surface, surface.medium, number, "", last)]
    gaps = [0.0] * (len(surface.after) - 1) + [surface.thickness]
    planes = [CodeVRow(Surface(thickness=t), behind, 0, "", p) for p, t in zip(surface.after, gaps, strict=True)]
    return [*rows, CodeVRow(surface, surface.medium, -number, "", last), *planes]


def _own_break(surface: Surface) -> tuple[str, Placement]:
    """Return DAR or BEN and a placement where these are what the breaks of a surface mean, else nothing."""
    if len(surface.before) == 1:
        placement = surface.before[0]
        a, b, c = placement.tilt_deg
        for kind in ("DAR", "BEN") if sum(map(bool, (a, b, c))) <= 1 else ("DAR",):
            if decentred_surface(kind, placement.decentre, (-a, -b, c)) == (surface.before, surface.after):
                return kind, placement
    return "", Placement()


def _surface(lens: Lens, row: CodeVRow, stop: int, private: dict[Medium, str]) -> list[str]:
    """Return the commands of a row."""
    surface, number = row.surface, abs(row.number)
    radius = surface.shape.radius_y if isinstance(surface.shape, Anamorphic) else surface.radius
    radius = radius if isfinite(radius) else 0.0
    thickness = surface.thickness if row.number >= 0 else 0.0
    glass = "REFL" if surface.reflects else _glass(row.medium, private)
    lines = [" ".join(f"S {digits(radius)} {digits(thickness)} {glass}".split())]
    lines += ["STO"] * (number == stop)
    lines += [*_shape(surface, number), *_phase(surface.diffraction, lens), *_rim(lens, surface, number == stop)]
    return [*lines, *_tilts(row.kind, row.placement)]


def _tilts(kind: str, placement: Placement) -> list[str]:
    """Return XDE to CDE and DAR or BEN: a break that turns first, or about a pivot, as the same one without that."""
    if placement.tilt_first or any(placement.pivot):
        placement = placement_of(placement.motion)
    a, b, c = placement.tilt_deg
    numbers = zip(TILT_NAMES, (*placement.decentre, -a, -b, c), strict=True)
    return [*(f"{name} {digits(value)}" for name, value in numbers if value), *[kind] * bool(kind)]


def _shape(surface: Surface, number: int) -> list[str]:
    """Return K and A to J, the polynomial SPS ODD or a freeform; LensFileError for what none holds."""
    if isinstance(surface.shape, Freeform):
        return _freeform(surface, surface.shape, number)
    if isinstance(surface.shape, Anamorphic):
        return _anamorphic(surface, surface.shape, number)
    if isinstance(surface.diffraction, Grating):
        check_plain(surface, surface.diffraction.name, number)
    radius, terms = power_terms(surface)
    if radius == 1 and all(power in LETTERS for power in terms):
        conic = [f"K {digits(surface.conic)}"] * bool(surface.conic or terms)
        return [
            *["ASP"] * bool(conic),
            *conic,
            *(f"{LETTERS[power]} {digits(a)}" for power, a in sorted(terms.items())),
        ]
    if max(terms) > HIGHEST_ODD:
        raise LensFileError(
            "surface {surface} has a term in r^{power}, and a CODE V file holds powers up to r^{most}; save as TOML",
            surface=number,
            power=max(terms),
            most=HIGHEST_ODD,
        )
    numbers = [("K", surface.conic), *((f"AR{power}", a) for power, a in sorted(terms.items()))]
    return [f"SPS ODD {digits(radius)}", *(f"SCO {name} {digits(value)}" for name, value in numbers if value)]


def _freeform(surface: Surface, shape: Freeform, number: int) -> list[str]:
    """Return XYP, ZRN or ZFR, with K and coefficients by their places; LensFileError for what these do not hold."""
    kind = type_in_file(FREEFORM_TYPES, shape, number, CODE_V)
    if isinstance(shape, ZernikeStandardSag):
        places = {key: place for place, key in enumerate(BORN_WOLF)}
        numbers = {places.get(key, -1): value for key, value in shape.terms.items() if value}
    else:
        numbers = {place: value for place, value in enumerate(shape.coefficients) if value}
    first, count = FREEFORMS[kind]
    if any(surface.aspheric) or not all(0 <= place < count for place in numbers):
        raise LensFileError(
            "surface {surface} has even terms beside its shape ({kind}), or that of a higher degree than a CODE V file "
            "holds; save as TOML",
            surface=number,
            kind=shape.name,
        )
    named = [("K", surface.conic), *((f"C{first + place}", value) for place, value in sorted(numbers.items()))]
    radius = digits(shape.normalisation_mm)
    lines = [f"SPS {kind} {radius}", f"SCO NRADIUS {radius}"]
    return [*lines, *(f"SCO {name} {digits(value)}" for name, value in named if value)]


def _anamorphic(surface: Surface, shape: Anamorphic, number: int) -> list[str]:
    """Return YTO or AAS and the numbers of a shape with two radii but for that in yz; A, B, … belong to y⁴, y⁶, …."""
    check_plain(surface, shape.name, number)
    kind, names = shape.code_v
    numbers = {command: getattr(shape, name) for command, name in names.items()}
    terms: dict[int, float] = {2 * place: alpha for place, alpha in enumerate(shape.coefficients, 1) if alpha}
    if not terms.keys() <= LETTERS.keys():
        raise LensFileError(
            "surface {surface} has a term in y² or beyond y^{most}, for which a CODE V toroid has no line; save as "
            "TOML",
            surface=number,
            most=max(LETTERS),
        )
    numbers |= {LETTERS[power]: alpha for power, alpha in terms.items()}
    return [kind, *(f"{command} {digits(value)}" for command, value in numbers.items() if value and isfinite(value))]


def _phase(diffraction: Phase | None, lens: Lens) -> list[str]:
    """Return a phase of revolution, A = 2πC/λ₀ at the lens's reference wavelength λ₀, or a grating."""
    if diffraction is None:
        return []
    if isinstance(diffraction, Grating):
        if not diffraction.lines_per_mm:
            return []
        return ["GRT", f"GRO {digits(diffraction.order)}", f"GRS {digits(1 / diffraction.lines_per_mm)}"]
    wave = lens.reference_wavelength_um
    unit = wave / (UM_PER_MM * 2 * pi)
    terms = (a * unit / diffraction.normalisation_mm ** (2 * k) for k, a in enumerate(diffraction.coefficients, 1))
    numbers = [f"HCO C{k} {digits(value)}" for k, value in enumerate(terms, 1) if value]
    return ["DIF DOE", f"HOR {digits(diffraction.order)}", f"HWL {digits(wave * NM_PER_UM)}", "HCT R", *numbers]


def _rim(lens: Lens, surface: Surface, is_stop: bool) -> list[str]:
    rim, shaped = surface.semi_diameter, surface.rim
    if is_stop and lens.aperture.kind == "stop_semi_diameter":
        rim = lens.aperture.value
    hole = "HOL" if is_stop else "OBS"  # an obscuration in the stop is a part of the mask
    lines = [f"CIR {digits(rim)}"] * isfinite(rim)
    lines += [f"CIR {hole} {digits(surface.inner_radius)}"] * bool(surface.inner_radius)
    if is_stop and lens.mask.obscuration:
        return [*lines, *_obscuration(lens, surface)]
    if shaped is None:
        return lines
    numbers = {"ADX": shaped.decentre[0], "ADY": shaped.decentre[1], "ARO": shaped.turn_deg}
    sides = zip(("REX", "REY"), shaped.half_widths or (), strict=False)
    return [
        *lines,
        *(f"{name} {digits(side)}" for name, side in (*sides, *numbers.items()) if side and isfinite(side)),
    ]


def _obscuration(lens: Lens, surface: Surface) -> list[str]:
    """Return the dark disc of the mask, which stands on the stop; LensFileError beside a hole or another rim."""
    mask = lens.mask
    if surface.rim or surface.inner_radius:
        raise LensFileError(
            "surface {surface} is the stop, with an obscuration beside a hole or a rim that is not a circle about the "
            "axis, for which CODE V has no line; save as TOML",
            surface=lens.surfaces.index(surface) + 1,
        )
    sizes = {"CIR OBS": mask.obscuration, "ADX": mask.obscuration_x, "ADY": mask.obscuration_y}
    return [f"{name} {digits(share * stop_rim(lens))}" for name, share in sizes.items() if share]


def _glass(medium: Medium, private: dict[Medium, str]) -> str:
    """Return the word of a medium, nothing for air; one of no maker becomes a private glass."""
    if medium == AIR:
        return ""
    if isinstance(medium, CatalogueGlass) and medium.label.count(" ") == 1 and (word := _makers_name(medium)):
        return word
    if isinstance(medium, ModelGlass):
        return f"{digits(medium.nd)}:{digits(medium.vd)}"
    return f"'{private.setdefault(medium, f'PRIVATE{len(private) + 1}')}'"


def _makers_name(glass: CatalogueGlass) -> str:
    """Return NAME_MAKER, which CODE V writes without hyphens; nothing where that would find no glass or another."""
    maker, name = glass.label.split()
    try:
        same = resolve(RawGlass(name.replace("-", ""), (maker,)), GlassSources()).medium == glass
    except GlassError:
        same = False
    return f"{name.replace('-', '')}_{maker}" if same else ""


def _sampled(lens: Lens, medium: Medium) -> list[float]:
    """Return where the indices of a private glass are stated, nm: at the lens's wavelengths, and at others if few.

    Programs that lay a cubic through them need four.
    """
    if isinstance(medium, ConstantIndex):
        return list(ANY_WAVELENGTH_NM)
    low, high = medium.range_um or (0.0, inf)
    more = [nm for nm in LINES_NM if low <= nm / NM_PER_UM <= high and len(lens.wavelengths_nm) < FEWEST_SAMPLES]
    return sorted({*lens.wavelengths_nm, *more})


def _catalogue(lens: Lens, private: dict[Medium, str]) -> list[str]:
    """Return the private catalogue: every glass with its own wavelengths, nm, and its indices there."""
    lines = []
    for medium, name in private.items():
        if isinstance(medium, TabulatedIndex):
            waves = [wave * NM_PER_UM for wave in medium.wavelengths_um]
        else:
            waves = _sampled(lens, medium)
        numbers = " ".join(digits(medium.index(wave / NM_PER_UM)) for wave in waves)
        lines += [f"PWL {' '.join(map(digits, waves))}", f"'{name}' {numbers}"]
    return ["PRV", *lines, "END"] if lines else []
