"""Write a lens as TOML that a person would have written: units stated, defaults left out."""

from dataclasses import dataclass
from json import dumps

from p2sf.errors import LensFileError
from p2sf.glass.media import AIR, CatalogueGlass, ConstantIndex, Medium, ModelGlass, TabulatedIndex
from p2sf.lens.lens import Lens, Surface
from p2sf.lensfile.agf import FormulaGlass


@dataclass(frozen=True)
class _Line:
    """One assignment; left out when the value is the default."""

    key: str
    value: str
    default: str = ""

    def __str__(self):
        return "" if self.value == self.default else f"{self.key} = {self.value}\n"


def lens_text(lens: Lens) -> str:
    """Return the lens as TOML; reading it gives an equal lens. LensFileError for a medium no file can hold."""
    stop = "" if lens.stop_surface is None else str(lens.stop_surface)
    head = (
        _Line("title", _text(lens.title), '""'),
        _Line("name", _text(lens.name)),
        _Line("character", _text(lens.character), '""'),
        _Line("source", _text(lens.source), '""'),
        _Line("comment", _text(lens.comment), '""'),
        _Line("unit", '"mm"'),
        _Line("stop_surface", stop),
        _Line("fields_deg", _list(lens.fields_deg)),
        _Line("wavelengths_nm", _list(lens.wavelengths_nm)),
        _Line("object_medium", _medium(lens.object_medium), '"air"'),
    )
    aperture = f"\n[aperture]\n{lens.aperture.kind} = {_number(lens.aperture.value)}\n"
    surfaces = [_surface(surface, number, lens) for number, surface in enumerate(lens.surfaces, 1)]
    return "".join(map(str, head)) + aperture + "".join(surfaces)


def _surface(surface: Surface, number: int, lens: Lens) -> str:
    note = " the stop" if number == lens.stop_surface else " the sensor follows" if number == len(lens.surfaces) else ""
    lines = (
        _Line("radius", _number(surface.radius)),
        _Line("thickness", _number(surface.thickness)),
        _Line("glass", _medium(surface.medium), '"air"'),
        _Line("semi_diameter", _number(surface.semi_diameter), "inf"),
        _Line("conic", _number(surface.conic), "0.0"),
        _Line("aspheric", _list(surface.aspheric), "[]"),
    )
    return f"\n[[surface]]  # {number}{note}\n" + "".join(map(str, lines))


def _number(x) -> str:
    return repr(float(x))


def _list(numbers) -> str:
    return f"[{', '.join(map(_number, numbers))}]"


def _text(text: str) -> str:
    """Return a TOML string; several lines stay several lines."""
    escaped = dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
    if "\n" not in text:
        return escaped
    return '"""\n' + escaped[1:-1].replace("\\n", "\n") + '"""'


def _medium(medium: Medium) -> str:
    if medium == AIR:
        return '"air"'
    if isinstance(medium, ConstantIndex):
        return _number(medium.value)
    if isinstance(medium, CatalogueGlass):
        return _text(medium.label)
    if isinstance(medium, ModelGlass):
        return f"{{ nd = {_number(medium.nd)}, vd = {_number(medium.vd)} }}"
    if isinstance(medium, TabulatedIndex):
        label = "" if medium.label == "table" else f", label = {_text(medium.label)}"
        return f"{{ wavelengths_um = {_list(medium.wavelengths_um)}, n = {_list(medium.values)}{label} }}"
    if isinstance(medium, FormulaGlass):
        numbers = f"coefficients = {_list(medium.coefficients)}, range_um = {_list(medium.range_um)}"
        return f"{{ agf_formula = {medium.formula}, {numbers}, name = {_text(medium.name)} }}"
    raise LensFileError(f"medium {medium.label} cannot be written to a file; give an index, a glass name or nd and vd")
