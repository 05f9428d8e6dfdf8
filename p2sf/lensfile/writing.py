"""Write a lens as a file: Zemax .zmx, CODE V .seq, ISET .json or this program's .toml, by the ending."""

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf, isfinite
from pathlib import Path
from typing import Any

from p2sf.arguments import check_arguments
from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError, LensFileError
from p2sf.files.writing import check_own
from p2sf.glass.media import AIR, MIRROR, CatalogueGlass, ConstantIndex, Medium, ModelGlass
from p2sf.lens.anamorphic import Anamorphic
from p2sf.lens.even_terms import even_asphere, power_terms
from p2sf.lens.freeform import Freeform, ZernikeSag
from p2sf.lens.grating import Grating
from p2sf.lens.lens import Lens, Surface, message_if_misaligned
from p2sf.lens.properties import ISET, PROPERTIES, ZEMAX
from p2sf.lens.shapes import Qbfs
from p2sf.lens.tilts import break_rows
from p2sf.lensfile.agf import FormulaGlass, nd_and_vd
from p2sf.lensfile.conjugates import FAR, limiting_rim, trace
from p2sf.lensfile.formats.codev_writing import lens_to_seq
from p2sf.lensfile.formats.zemax import FREEFORMS
from p2sf.lensfile.glass_lookup import GlassSources, resolve
from p2sf.lensfile.raw import RawGlass
from p2sf.lensfile.source_text import digits, write_text
from p2sf.lensfile.surface_endings import check_endings, check_plain, in_own_axes, type_in_file
from p2sf.lensfile.toml.columns import columns_of
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf.paraxial.positions import matches_columns
from p2sf.paraxial.pupils import stop_rim
from p2sf.raytrace.focusing import focused_distance, object_distance

OWN_CATALOGUE = "glasses of the lens of this name, written by p2sf"
SILICA_LABEL = "main/SiO2/Malitson"
ZEMAX_APERTURES = {"entrance_pupil_diameter": "ENPD", "f_number": "FNUM"}
UNLIMITED = 1e10  # mm: no rim
HIGHEST_ZEMAX_ORDER = 16
HIGHEST_ZEMAX_ODD = 8
MOST_TOROID = 7  # terms, to y¹⁴
MOST_ISET_TERMS = 20
SPECTRUM_NM = tuple(range(400, 701, 10))


@check_arguments
def write_lens(lens: Lens, path: str | os.PathLike[str]) -> None:
    """Write a lens as a file of P2SF, Zemax, CODE V or ISET.

    Parameters
    ----------
    lens : Lens
        The lens.
    path : str or path
        A name that ends in .toml, .zmx, .seq or .json, which says the format. Glasses from AGF catalogues go into a
        small catalogue of their own beside a .zmx, with the same stem.

    Raises
    ------
    LensFileError
        For another ending, and for what the format cannot hold.
    ExportError
        Where the glass catalogue beside a .zmx would take the place of one that is not of this program.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.write_lens(p2sf.load_lens("tessar"), "tessar.zmx")  # doctest: +SKIP
    """
    ending = Path(path).suffix.lower()
    writers: dict[str, Callable[[Lens], str]] = {
        ".toml": lens_to_toml,
        ".zmx": lambda lens: lens_to_zmx(lens, Path(path).stem),
        ".seq": lens_to_seq,
        ".json": lens_to_iset,
    }
    if ending not in writers:
        raise LensFileError(
            'ending "{ending}" is none of {endings}; choose one', path, ending=ending, endings=tuple(writers)
        )
    known = ending in (".zmx", ".seq") and lens.mask == _obscured_gaussian(lens.mask)
    if ending != ".toml" and not lens.mask.clear and not known:
        raise LensFileError(
            "a mask stands in the stop, which a file that ends in {ending} cannot express; save as TOML",
            path,
            ending=ending,
        )
    text = writers[ending](lens)
    catalogue = lens_to_agf(lens) if ending == ".zmx" else ""
    if catalogue:
        check_own(Path(path).with_suffix(".agf"), OWN_CATALOGUE.encode())
        write_text(f"CC {OWN_CATALOGUE}\n{catalogue}", Path(path).with_suffix(".agf"))
    write_text(text, path)


def _obscured_gaussian(mask: PupilMask) -> PupilMask:
    """Return what files for Zemax and CODE V can express of a mask: a dark disc and a Gaussian."""
    disc = {name: getattr(mask, name) for name in ("obscuration", "obscuration_x", "obscuration_y")}
    return PupilMask(apodisation=mask.apodisation, **disc)


def _check_aligned(lens: Lens, what: Message) -> None:
    """Raise LensFileError for a lens with tilts or decentres, which ``what`` cannot hold."""
    tilted = Message(
        "parts of the lens are tilted or decentred, which {what} cannot express; save as TOML, or for Zemax at one "
        "position",
        what=what,
    )
    if reason := message_if_misaligned(lens, tilted):
        raise LensFileError(reason)


def lens_to_zmx(lens: Lens, stem: str = "lens") -> str:
    """Return the lens as a Zemax prescription; LensFileError for what such a file cannot hold.

    The columns of a zoom are its configurations, the present position the one that its surfaces show if it is a column.
    """
    check_endings(lens, ZEMAX)
    _check_zemax_columns(lens)
    stop = lens.stop_surface or limiting_rim(lens, lens.reference_wavelength_um)[0]
    distance = object_distance(lens)
    far = digits(distance) if isfinite(distance) else "INFINITY"
    lines = [*_zemax_head(lens, _makers(lens, stem)), "SURF 0", "  TYPE STANDARD", "  CURV 0.0", f"  DISZ {far}"]
    if lens.object_medium != AIR:
        lines.append(_zemax_glass(lens.object_medium))
    rows = [row for number in range(1, len(lens.surfaces) + 1) for row in _zemax_rows(lens, number, stop)]
    rows += [_zemax_break(one) for placement in lens.sensor_before for one in break_rows(placement, 0.0)]
    image, conic = lens.sensor_surface, lens.sensor_conic
    rows.append(
        ["  TYPE STANDARD", f"  CURV {digits(image.curvature)}", "  DISZ 0", *[f"  CONI {digits(conic)}"] * bool(conic)]
    )
    lines += [line for number, row in enumerate(rows, 1) for line in (f"SURF {number}", *row)]
    return "\n".join([*lines, *_zemax_configurations(lens, stop), ""])


def _zemax_configurations(lens: Lens, stop: int) -> list[str]:
    """Return the lines of the multi-configuration editor: the titles, and every number that varies."""
    if lens.positions is None or not matches_columns(lens):
        return []
    (axis, *others), columns = lens.positions.axes, columns_of(lens)
    if others:
        raise LensFileError(
            "the lens has a zoom ring and a focus ring, but a Zemax file has one list of configurations; save as TOML"
        )
    lines = [f"MNUM {len(columns)} {(lens.positions.column or 0) + 1}"]
    lines += [f'LTTL 0 {k} "{name}" 0 0 0 1 1 0 0.0 "" 0' for k, name in enumerate(axis.columns, 1)]
    stated = [_zemax_numbers(column, stop) for column in columns]
    for numbers, column in zip(stated, columns, strict=True):
        focused = axis.kind == "focus" and column.object_distance is None  # which distances tell from a zoom
        numbers["THIC", 0] = min(FAR, focused_distance(column) if focused else object_distance(column))
    for key in stated[0]:
        values = [numbers.get(key) for numbers in stated]
        if len(set(values)) > 1:
            lines += [f'{key[0]} {key[1]} {k} {value} 0 0 0 1 1 1 0 0 "" 0' for k, value in enumerate(values, 1)]
    return lines


def _zemax_numbers(lens: Lens, stop: int) -> dict[tuple[str, int], float | str]:
    """Return what an operand can set, by its name and its surface or number."""
    found: dict[tuple[str, int], float | str] = {("APER", 0): lens.aperture.value}
    for number, surface in enumerate(lens.surfaces, 1):
        rim = surface.semi_diameter if isfinite(surface.semi_diameter) else 0.0
        found |= {("CRVT", number): surface.curvature, ("THIC", number): surface.thickness}
        found |= {("CONN", number): surface.conic, ("GLSS", number): _zemax_glass(surface.medium).split()[1]}
        if number != stop or lens.aperture.kind != "stop_semi_diameter":
            found["SDIA", number] = rim
    found |= {("XFIE", k): float(field) for k, field in enumerate(lens.fields_x_deg, 1)}
    found |= {("YFIE", k): float(field) for k, field in enumerate(lens.fields_deg, 1)}
    return found | {("WAVE", k): wave / NM_PER_UM for k, wave in enumerate(lens.wavelengths_nm, 1)}


def _check_zemax_columns(lens: Lens) -> None:
    """Raise LensFileError for what differs between columns and no operand sets, and for breaks beside columns."""
    if lens.positions is None:
        return
    _check_aligned(lens, Message("a Zemax file with configurations"))
    for number, rows in enumerate(zip(*(column.surfaces for column in lens.positions.lenses), strict=True), 1):
        unnamed = [row.medium for row in rows if not isinstance(row.medium, CatalogueGlass | FormulaGlass)]
        different = len({row.medium for row in rows}) > 1
        fixed = {tuple(getattr(row, each.name) for each in PROPERTIES if not each.operand) for row in rows}
        if len(fixed) > 1 or (different and unnamed):
            raise LensFileError(
                "surface {surface} differs between columns in its shape, its rim or a medium without a name, for "
                "which a Zemax file has no line; save as TOML",
                surface=number,
            )
    counts = {(len(column.fields_deg), len(column.wavelengths_nm)) for column in lens.positions.lenses}
    if len(counts) > 1:
        raise LensFileError(
            "the columns have different numbers of fields or wavelengths, but a Zemax file has one; save as TOML"
        )


def _zemax_head(lens: Lens, makers: list[str]) -> list[str]:
    waves, fields = lens.wavelengths_nm, lens.fields_deg
    weights = lens.wavelength_weights or (1.0,) * len(waves)
    keyword = ZEMAX_APERTURES.get(lens.aperture.kind)
    return [
        "VERS 181122 258 36214",
        "MODE SEQ",
        f"NAME {' '.join((lens.title or lens.name).split())}",
        "UNIT MM X W X CM MR CPMM",
        f"{keyword} {digits(lens.aperture.value)} 0" if keyword else "FLOA",
        f"GCAT {' '.join(makers)}",
        f"FTYP 0 0 {len(fields)} {len(waves)} 0 0 0",
        f"XFLN {' '.join(digits(field) for field in lens.fields_x_deg or (0.0,) * len(fields))}",
        f"YFLN {' '.join(digits(field) for field in fields)}",
        *(
            f"WAVM {i} {digits(wave / NM_PER_UM)} {digits(weight)}"
            for i, (wave, weight) in enumerate(zip(waves, weights, strict=True), 1)
        ),
        f"PWAV {waves.index(lens.reference_wavelength_nm) + 1}",
        *[f"GFAC 1 {digits(lens.mask.apodisation**-2)}"] * isfinite(lens.mask.apodisation),
        f"RAIM 0 {0 if lens.aim == 'paraxial' else 2} 1 1 0 0 0 0 0",
    ]


def _zemax_rows(lens: Lens, number: int, stop: int) -> list[list[str]]:
    """Return the lines of a surface, and of the coordinate breaks before and behind it."""
    surface, before = in_own_axes(lens.surfaces[number - 1]), lens.media[number - 1]
    breaks = [row for placement in surface.before for row in break_rows(placement, 0.0)]
    open_wide = not isfinite(surface.semi_diameter) and not surface.inner_radius and not surface.rim
    idle = surface.bare and surface.medium == before and number != stop and open_wide
    if idle and breaks and not surface.after:  # as a coordinate break of a file is read
        return [*map(_zemax_break, breaks[:-1]), _zemax_break(breaks[-1], surface.thickness)]
    behind = [row for placement in surface.after for row in break_rows(placement, 0.0)]
    own = _zemax_surface(lens, replace(surface, thickness=0.0) if behind else surface, number, stop)
    rows = [*map(_zemax_break, breaks), own, *map(_zemax_break, behind[:-1])]
    return [*rows, _zemax_break(behind[-1], surface.thickness)] if behind else rows


def _zemax_break(row: Sequence[float], more: float = 0.0) -> list[str]:
    """Return the lines of a coordinate break of `break_rows`, with ``more`` thickness behind it."""
    *moves, order, behind = row
    numbers = [f"  PARM {place} {digits(value)}" for place, value in enumerate(moves, 1)]
    numbers.append(f"  PARM 6 {int(order)}")
    return ["  TYPE COORDBRK", "  CURV 0.0", *numbers, f"  DISZ {digits(behind + more)}"]


def _zemax_surface(lens: Lens, surface: Surface, number: int, stop: int) -> list[str]:
    kind, numbers = _zemax_shape(surface, number)
    curvature, conic = surface.curvature, surface.conic
    if isinstance(surface.shape, Anamorphic):
        curvature, conic = surface.shape.curvatures[1], surface.shape.conic_y
    rim = surface.semi_diameter
    if number == stop and lens.aperture.kind == "stop_semi_diameter":
        rim = lens.aperture.value
    return [
        *["  STOP"] * (number == stop),
        f"  TYPE {kind}",
        f"  CURV {digits(curvature)}",
        *numbers,
        f"  DISZ {digits(surface.thickness)}",
        *[_zemax_glass(surface.medium)] * (surface.medium != AIR),
        *[f"  CONI {digits(conic)}"] * bool(conic),
        f"  DIAM {digits(rim) if isfinite(rim) else 0} {int(isfinite(rim))} 0 0 1",
        *(_zemax_obscuration(lens, surface, number) if number == stop else []),
        *_zemax_rim(surface, number, number == stop),
    ]


def _zemax_obscuration(lens: Lens, surface: Surface, number: int) -> list[str]:
    """Return the lines of the dark disc of the mask, which stands on the stop; LensFileError beside another rim."""
    mask = lens.mask
    if not mask.obscuration:
        return []
    if surface.rim or surface.inner_radius:
        raise LensFileError(
            "surface {surface} is the stop, with an obscuration beside a hole or a rim that is not a circle about the "
            "axis, for which Zemax has no line; save as TOML",
            surface=number,
        )
    radius, x, y = (
        digits(share * stop_rim(lens)) for share in (mask.obscuration, mask.obscuration_x, mask.obscuration_y)
    )
    return [f"  OBSC 0 {radius}", *[f"  OBDC {x} {y}"] * bool(mask.obscuration_x or mask.obscuration_y)]


def _zemax_rim(surface: Surface, number: int, is_stop: bool) -> list[str]:
    """Return the lines of a hole and of a rim that is decentred or a rectangle, which takes the place of a circle's.

    In the stop a hole is the inner radius of a rim, since an obscuration there is a mask.
    """
    rim, hole = surface.rim, surface.inner_radius
    if rim is None and is_stop and hole:
        return [f"  CLAP {digits(hole)} {digits(min(surface.semi_diameter, UNLIMITED))} 0"]
    if rim is None:
        return [f"  OBSC 0 {digits(hole)}"] * bool(hole)
    if rim.turn_deg or (rim.half_widths and hole):
        raise LensFileError(
            "surface {surface} has a rectangular rim that is turned or has a hole, for which Zemax has no line; "
            "save as TOML",
            surface=number,
        )
    x, y = map(digits, rim.decentre)
    if rim.half_widths:
        across, up = map(digits, rim.half_widths)
        clear = f"  SQAP {across} {up} 0"
    else:
        clear = f"  CLAP {digits(hole)} {digits(min(surface.semi_diameter, UNLIMITED))} 0"
    return [clear, f"  OBDC {x} {y}"]


def _zemax_shape(surface: Surface, number: int) -> tuple[str, list[str]]:
    """Return the type of a surface and the lines of its terms; LensFileError for what Zemax has no line for.

    The first type that holds it is taken: even and odd aspheres in powers of r, extended ones in powers of r over the
    normalisation radius, to which Qcon is converted exactly.
    """
    if isinstance(surface.shape, Anamorphic):
        return _zemax_anamorphic(surface, surface.shape, number)
    if isinstance(surface.diffraction, Grating):
        check_plain(surface, surface.diffraction.name, number)
        lines = surface.diffraction.lines_per_mm / UM_PER_MM
        return "DGRATING", [f"  PARM 1 {digits(lines)}", f"  PARM 2 {digits(surface.diffraction.order)}"]
    radius, terms = power_terms(surface)
    odd, top = any(power % 2 for power in terms), max(terms, default=0)
    step = 1 if odd else 2
    parameters = [f"  PARM {power // step} {digits(value)}" for power, value in sorted(terms.items())]
    if isinstance(surface.shape, Qbfs | Freeform):
        return _own_type(surface, surface.shape, number)
    if surface.ideal:
        return "PARAXIAL", [f"  PARM 1 {digits(surface.ideal_focal_length)}"]
    if surface.diffraction is not None:
        if odd or radius != 1 or top > HIGHEST_ZEMAX_ORDER:
            raise LensFileError(
                "surface {surface} diffracts and has terms other than even ones up to r^16, for which Zemax has no "
                "line; save as TOML",
                surface=number,
            )
        d = surface.diffraction
        return "BINARY_2", [
            f"  PARM 0 {digits(d.order)}",
            *parameters,
            *_extra_data(d.normalisation_mm, d.coefficients),
        ]
    if not terms:
        return "STANDARD", []
    if radius == 1 and top <= (HIGHEST_ZEMAX_ODD if odd else HIGHEST_ZEMAX_ORDER):
        return "ODDASPHE" if odd else "EVENASPH", parameters
    listed = tuple(terms.get(power, 0.0) for power in range(step, top + 1, step))
    return "XOSPHERE" if odd else "XASPHERE", _extra_data(radius, listed)


def _zemax_anamorphic(surface: Surface, shape: Anamorphic, number: int) -> tuple[str, list[str]]:
    """Return the type of a shape with two radii and its parameters; 0 is an infinite radius."""
    check_plain(surface, shape.name, number)
    kind, names = shape.zemax
    numbers = [*(getattr(shape, name) for name in names), *shape.coefficients]
    if len(shape.coefficients) > MOST_TOROID:
        raise LensFileError(
            "surface {surface} has a term in y^{power}, and a Zemax toroid holds powers up to y^{most}; save as TOML",
            surface=number,
            power=2 * len(shape.coefficients),
            most=2 * MOST_TOROID,
        )
    return kind, [f"  PARM {place} {digits(x) if isfinite(x) else 0}" for place, x in enumerate(numbers, 1)]


def _own_type(surface: Surface, shape: Qbfs | Freeform, number: int) -> tuple[str, list[str]]:
    """Return the type of a shape that has one of its own, and its lines: even terms where it takes them, extra data."""
    terms, data = len(surface.aspheric), _extra_data(shape.normalisation_mm, shape.coefficients)
    held = 0 if not isinstance(shape, ZernikeSag) else HIGHEST_ZEMAX_ORDER // 2 - 1
    if (any(surface.aspheric) and terms > held) or surface.diffraction is not None:
        raise LensFileError(
            "surface {surface} has even terms or diffraction beside its shape ({kind}), for which Zemax has no line; "
            "save as TOML",
            surface=number,
            kind=shape.name,
        )
    if isinstance(shape, Qbfs):  # type 0 of Forbes's
        return "QED_TYPE", _extra_lines((0, len(shape.coefficients), shape.normalisation_mm, *shape.coefficients))
    kind = type_in_file({known: kind for kind, known in FREEFORMS.items()}, shape, number, ZEMAX)
    if isinstance(shape, ZernikeSag):  # parameter 0: the terms hold beyond the normalisation radius too
        even = [f"  PARM {place} {digits(value)}" for place, value in enumerate(surface.aspheric, 2) if value]
        return kind, ["  PARM 0 1", *even, *data]
    return kind, data


def _extra_data(radius: float, numbers: tuple[float, ...]) -> list[str]:
    """Return the lines of extra data: how many numbers, the normalisation radius, and the numbers."""
    return _extra_lines((len(numbers), radius, *numbers))


def _extra_lines(values: tuple[float, ...]) -> list[str]:
    return [f"  XDAT {place} {digits(x)} 0 0 1 0 0" for place, x in enumerate(values, 1)]


def _zemax_glass(medium: Medium) -> str:
    if medium == MIRROR:
        return "  GLAS MIRROR 0 0 1.5 40 0 0 0 0 0 0"
    if isinstance(medium, ConstantIndex):
        return f"  GLAS ___BLANK 1 0 {digits(medium.value)} 0 0 0 0 0 0 0"
    if isinstance(medium, ModelGlass):
        return f"  GLAS ___BLANK 1 0 {digits(medium.nd)} {digits(medium.vd)} 0 0 0 0 0 0"
    if isinstance(medium, CatalogueGlass) and medium.label == SILICA_LABEL:
        return "  GLAS SILICA 0 0 1.5 40 0 0 0 0 0 0"
    if isinstance(medium, CatalogueGlass) and " " in medium.label:
        return f"  GLAS {medium.label.split()[1]} 0 0 1.5 40 0 0 0 0 0 0"
    if isinstance(medium, FormulaGlass):
        return f"  GLAS {medium.name} 0 0 1.5 40 0 0 0 0 0 0"
    raise LensFileError("medium {name} has no line in a Zemax file; save as TOML, or give nd and vd", name=medium.label)


def _makers(lens: Lens, stem: str) -> list[str]:
    """Return the catalogues that a .zmx names; LensFileError where a name would find another maker's glass."""
    glasses = [m for m in lens.media if isinstance(m, CatalogueGlass) and " " in m.label]
    makers = list(dict.fromkeys(glass.label.split()[0] for glass in glasses))
    for glass in glasses:
        name = glass.label.split()[1]
        if resolve(RawGlass(name, tuple(makers)), GlassSources()).medium != glass:
            raise LensFileError(
                "{glass} shares its name with another maker's glass of this lens; save as TOML", glass=glass.label
            )
    own = [stem.upper()] * any(isinstance(medium, FormulaGlass) for medium in lens.media)
    return [*own, *makers] or ["SCHOTT"]


def lens_to_agf(lens: Lens) -> str:
    """Return an AGF catalogue of the lens's glasses from such catalogues, empty where it has none."""
    glasses = dict.fromkeys(medium for medium in lens.media if isinstance(medium, FormulaGlass))
    return "".join(map(_agf_entry, glasses))


def _agf_entry(glass: FormulaGlass) -> str:
    nd, vd = nd_and_vd(glass)
    coefficients = " ".join(map(digits, glass.coefficients))
    low, high = glass.range_um
    return (
        f"NM {glass.name} {glass.formula} 0 {nd:.6f} {vd:.4f} 0 0\nCD {coefficients}\nLD {digits(low)} {digits(high)}\n"
    )


def lens_to_iset(lens: Lens, spectral: bool = False) -> str:
    """Return the lens as ISET JSON, its indices at the reference wavelength, or over 400 to 700 nm if ``spectral``.

    Of a zoom it is the present position, which the description names. A stop on a refracting surface becomes a plane
    at its vertex, because ISET marks a stop by its index 0.
    Raises LensFileError where the object is not in air, and for mirrors.
    """
    if lens.object_medium != AIR:
        raise LensFileError("the object stands in a medium, which an ISET file cannot express; save as TOML")
    check_endings(lens, ISET)
    if lens.sensor_before:
        _check_aligned(lens, Message("an ISET file"))
    if any(surface.reflects for surface in lens.surfaces):
        raise LensFileError("the lens has mirrors, which an ISET file cannot express; save as TOML")
    wave = lens.reference_wavelength_um
    stop = lens.stop_surface or limiting_rim(lens, wave)[0]
    rows = []
    for number, surface in enumerate(lens.surfaces, 1):
        row = _iset_row(_iset_surface(surface, number), _iset_index(surface.medium, wave, spectral))
        plain = not surface.bare or surface.medium != lens.media[number - 1]
        if number == stop:
            opening = {"radius": 0, "thickness": 0.0, "ior": 0, "semi_aperture": float(_stop_rim(lens, stop, wave))}
            rows += [opening] if plain else [opening | {"thickness": float(surface.thickness)}]
        if number != stop or plain:
            rows.append(row)
    focal = -1 / trace(lens, 1, wave).last[2] if trace(lens, 1, wave).last[2] else inf
    turned = f", {lens.positions.words}" if lens.positions else ""
    top: dict[str, Any] = {
        "name": lens.name,
        "description": " ".join(f"{lens.title}{turned}".split()),
        "type": "multi element lens",
        "surfaces": rows,
    }
    if isfinite(focal):
        top["metadata"] = {"focalLength": float(focal) / 1000}  # ISET keeps it in metres
    return json.dumps(top, indent=1) + "\n"


def _iset_surface(surface: Surface, number: int) -> Surface:
    """Return a surface as a conic with even terms, exactly; LensFileError where that is impossible."""
    try:
        made = even_asphere(surface)
    except GeometryError:
        made = None
    exact = made is not None and not made.residual_mm and len(made.surface.aspheric) <= MOST_ISET_TERMS
    if made is not None and exact and surface.diffraction is None and not surface.ideal:
        return made.surface
    raise LensFileError(
        "surface {surface} is no conic with even terms from r⁴ on, which a file for {program} cannot express; save "
        "as TOML",
        surface=number,
        program="ISET",
    )


def _iset_row(surface: Surface, ior: float | list[list[float]]) -> dict[str, Any]:
    row: dict[str, Any] = {
        "radius": float(surface.radius) if isfinite(surface.radius) else 0,
        "thickness": float(surface.thickness),
        "ior": ior,
    }
    if isfinite(surface.semi_diameter):
        row["semi_aperture"] = float(surface.semi_diameter)
    if surface.conic:
        row["conic_constant"] = float(surface.conic)
    if surface.aspheric:
        row["aspheric_coefficients"] = [float(a) for a in surface.aspheric]
    return row


def _iset_index(medium: Medium, wavelength_um: float, spectral: bool) -> float | list[list[float]]:
    if not spectral or isinstance(medium, ConstantIndex):
        return float(medium.index(wavelength_um))
    low, high = medium.range_um or (0.0, inf)
    waves: list[float] = [w for w in SPECTRUM_NM if low <= w / NM_PER_UM <= high]
    return [waves, [float(medium.index(w / NM_PER_UM)) for w in waves]]


def _stop_rim(lens: Lens, stop: int, wavelength_um: float) -> float:
    """Return the stop's semi-diameter in mm for any kind of aperture; LensFileError for an afocal f-number."""
    rays = trace(lens, stop, wavelength_um)
    kind, value = lens.aperture.kind, lens.aperture.value
    if kind == "stop_semi_diameter":
        return value
    if kind == "entrance_pupil_diameter":
        return value / 2 * abs(rays.stop[0])
    if not rays.last[2]:
        raise LensFileError("an afocal lens has no f-number; state the stop's semi-diameter")
    return abs(rays.stop[0] / (2 * value * rays.last[2]))
