"""The .roa files of the Python package ray-optics: its model of a lens as JSON.

Every object is ``{"__instance_type__": [module, class], "attributes": {…}}``. Interfaces and gaps alternate, the first
interface is the object and the last the image; profiles stand in a table of their own or in the interface.
"""

import json
from math import atan2, degrees, inf, pi
from typing import Any

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.errors import GeometryError, P2SFError
from p2sf.glass.media import MIRROR
from p2sf.lens.anamorphic import Toroid
from p2sf.lens.grating import Grating, Phase
from p2sf.lens.lens import Lens
from p2sf.lens.shapes import Diffraction
from p2sf.lens.tilts import Breaks, decentred_surface
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawApertureKind, RawFieldKind, RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText

UNITS_MM = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inches": 25.4, "inch": 25.4, "in": 25.4}
APERTURES: dict[tuple[str, str], RawApertureKind] = {
    ("object", "epd"): "entrance_pupil_diameter",
    ("object", "pupil"): "entrance_pupil_diameter",
    ("image", "f/#"): "image_f_number",
    ("object", "NA"): "object_na",
    ("image", "NA"): "image_na",
}
FIELDS: dict[tuple[str, str], RawFieldKind] = {
    ("object", "angle"): "angle",
    ("object", "height"): "object_height",
    ("image", "height"): "image_height",
    ("image", "real height"): "real_image_height",
}
DECENTRES = {"decenter": "", "reverse": "REV", "dec and return": "DAR", "bend": "BEN"}
PROFILES = ("Spherical", "Conic", "EvenPolynomial", "RadialPolynomial")
TOROIDS = {"YToroid": 0.0, "XToroid": 90.0}  # with their turn about the axis, degrees
CURVED = (
    "{surface} is a grating on a curved surface, whose lines are evenly spaced along the surface in ray-optics, and "
    "across the axis here; only plane gratings are read"
)
DAMAGED = (KeyError, TypeError, ValueError, IndexError, AttributeError, RecursionError)


def read_ray_optics(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .roa file; LensFileError for damage, gratings and shapes that are not round.

    A thin lens, there made by a hologram of two points, becomes an ideal lens of its power.
    """
    try:
        model = _inside(json.loads(source.text)["optical_model"])
        raw = _raw_lens(model, source)
    except DAMAGED as failure:
        if isinstance(failure, P2SFError):
            raise
        raise source.error(
            "the file's model is incomplete ({reason}); save it again", 1, reason=repr(failure)
        ) from None
    return assemble(raw, sources, notes, source)


def _inside(value: Any) -> dict[str, Any]:
    """Return the attributes of an object."""
    found: dict[str, Any] = value.get("attributes", value)
    return found


def _kind(value: Any) -> str:
    return str(value["__instance_type__"][1])


def _raw_lens(model: dict[str, Any], source: LensText) -> RawLens:
    sequence, system = _inside(model["seq_model"]), _inside(model["system_spec"])
    unit = str(system.get("_dimensions", system.get("dimensions", "mm"))).lower()
    if unit not in UNITS_MM:
        raise source.error(
            'lens unit "{unit}" is none of {units}; correct it', 1, unit=unit[:20], units=tuple(UNITS_MM)
        )
    raw = RawLens(unit_mm=UNITS_MM[unit], title=" ".join(str(system.get("title", "")).split())[:200])
    interfaces, gaps = sequence["ifcs"], [_inside(gap) for gap in sequence["gaps"]]
    raw.object_distance = float(gaps[0]["thi"])
    if not abs(raw.object_distance) < FAR:
        raw.object_distance = inf
    raw.object_glass = _glass(gaps[0]["medium"])
    for number, (interface, gap) in enumerate(zip(interfaces[1:-1], gaps[1:], strict=True), 1):
        raw.surfaces.append(_surface(number, interface, gap, model, raw.unit_mm, source))
    ends = (RawSurface(place, 1) for place in (0, len(interfaces) - 1))
    moved, (raw.sensor_before, _) = (
        _breaks(end, _inside(interfaces[end.number]).get("decenter"), source) for end in ends
    )
    if profile := _profile(_inside(interfaces[-1]), model):
        raw.image = RawSurface(len(interfaces) - 1, 1)
        _shape(raw.image, profile, source)
    if any(moved):
        raise source.error("the object is tilted or decentred, which is not read; move the lens instead", 1)
    stop = sequence.get("stop_surface")
    raw.stop = int(stop) if stop else None
    _conditions(raw, _inside(model["optical_spec"]))
    return raw


def _surface(
    number: int, interface: Any, gap: dict[str, Any], model: dict[str, Any], unit_mm: float, source: LensText
) -> RawSurface:
    values = _inside(interface)
    surface = RawSurface(number, 1, str(values.get("label", ""))[:60], thickness=float(gap["thi"]))
    surface.before, surface.after = _breaks(surface, values.get("decenter"), source)
    reflects = values.get("interact_mode") == "reflect"
    if _kind(interface) == "ThinLens":
        power = float(values["_power"])
        surface.ideal_focal_length = 1 / power if power else inf
    else:
        if values.get("phase_element"):
            surface.diffraction = _diffraction(surface, values["phase_element"], unit_mm, source, reflects)
        _shape(surface, _profile(values, model), source)
        if isinstance(surface.diffraction, Grating) and surface.curvature:
            raise source.error(CURVED, 1, surface=surface.name)
    surface.glass = RawGlass(medium=MIRROR, line=1) if reflects else _glass(gap["medium"])
    rim = values.get("max_aperture") or inf
    for aperture in values.get("clear_apertures", ()):
        rim = float(_inside(aperture).get("radius", rim))
    surface.semi_diameter = float(rim)
    return surface


def _breaks(surface: RawSurface, decenter: Any, source: LensText) -> Breaks:
    """Return the breaks that a surface's decentre means, whose kinds and signs are those of CODE V."""
    if not decenter:
        return (), ()
    values = _inside(decenter)
    kind = str(values.get("dtype", values.get("_dtype")))
    dec, euler, pivot = (_three(values.get(name)) for name in ("dec", "euler", "rot_pt"))
    if kind not in DECENTRES or any(pivot):
        raise source.error(
            "{surface} is tilted or decentred by {kind} about ({pivot:g}), which is not read; only {known} about the "
            "vertex are",
            1,
            surface=surface.name,
            kind=kind[:20],
            pivot=pivot,
            known=tuple(DECENTRES),
        )
    try:
        return decentred_surface(DECENTRES[kind], dec, euler)
    except GeometryError as failure:
        raise source.error("{surface}: {error}", 1, surface=surface.name, error=failure) from failure


def _three(array: Any) -> tuple[float, float, float]:
    """Return the numbers of an array, zeros where there is none."""
    listed = array.get("__ndarray__", (0, 0, 0)) if isinstance(array, dict) else array or (0, 0, 0)
    x, y, z = map(float, listed)
    return x, y, z


def _diffraction(surface: RawSurface, element: Any, unit_mm: float, source: LensText, reflects: bool) -> Phase:
    """Return the phase 2π/λ·Σ cⱼr²ʲ of an element whose coefficients are a path at its reference wavelength."""
    values = _inside(element)
    if _kind(element) == "DiffractionGrating":
        x, y, z = _three(values.get("grating_normal"))
        if (x or y) and not z:
            lines = float(_stated(values, "grating_lpmm")) * unit_mm
            return grating(lines, float(values.get("order", 1)), (x, y), reflects)
    if _kind(element) != "DiffractiveElement" or values.get("phase_fct_name") != "radial_phase_fct":
        raise source.error(
            "{surface} diffracts ({kind}) and not by a phase in powers of r²; only such phases are read",
            1,
            surface=surface.name,
            kind=_kind(element),
        )
    wavelength = float(values["ref_wl"]) / (NM_PER_UM * UM_PER_MM * unit_mm)
    terms = tuple(2 * pi / wavelength * float(c) for c in values["coefficients"])
    return Diffraction(terms, 1.0, float(values.get("order", 1)))


def grating(lines: float, order: float, normal: tuple[float, float], reflects: bool) -> Grating:
    """Return a grating with lines across its normal.

    A positive order turns rays that pass away from the normal, and rays that it reflects towards it.
    """
    x, y = normal
    return Grating(lines, order * (1 if reflects else -1), degrees(atan2(-x, y)))


def _profile(values: dict[str, Any], model: dict[str, Any]) -> Any:
    """Return the profile of an interface, its own or that which it names."""
    return values.get("profile") or model.get("profile_dict", {}).get(str(values.get("profile_id")))


def _shape(surface: RawSurface, profile: Any, source: LensText) -> None:
    """Give a surface its profile; ``ec`` is 1 + K, ``coefs`` those of r, r², … or of r², r⁴, …."""
    kind, values = _kind(profile), _inside(profile)
    if kind not in (*PROFILES, *TOROIDS):
        raise source.error(
            "{surface} has a shape ({kind}) that is not round or not known; only {known} are read",
            1,
            surface=surface.name,
            kind=kind,
            known=(*PROFILES, *TOROIDS),
        )
    if kind in TOROIDS:
        surface.shape = _toroid(values, TOROIDS[kind])
        return
    surface.curvature = float(values["cv"])
    surface.conic = float(values["ec"]) - 1 if "ec" in values else float(values.get("cc", 0.0))
    step = 2 if kind == "EvenPolynomial" else 1
    terms = enumerate(map(float, values.get("coefs", ())), 1)
    surface.aspheric = {step * place: value for place, value in terms if value}


def _toroid(values: dict[str, Any], turn_deg: float) -> Toroid:
    """Return the toroid of a curve ``cv``, ``cc`` and ``coefs``, of y², y⁴, …, swept with the curvature ``cR``."""
    curve, sweep = float(values["cv"]), float(values.get("cR", 0.0))
    terms = [float(value) for value in values.get("coefs", ())]
    used = max((count for count, term in enumerate(terms, 1) if term), default=0)
    return Toroid(
        radius_x=1 / sweep if sweep else inf,
        radius_y=1 / curve if curve else inf,
        conic_y=float(values["ec"]) - 1 if "ec" in values else float(values.get("cc", 0.0)),
        coefficients=tuple(terms[:used]),
        turn_deg=turn_deg,
    )


def _glass(medium: Any) -> RawGlass | None:
    """Return a medium: air, a constant index, nd and vd, or a maker's glass by the class that holds it."""
    kind, values = _kind(medium), _inside(medium)
    if kind == "Air":
        return None
    if "v" in values and "n" in values:
        return RawGlass(model=(float(values["n"]), float(values["v"])), line=1)
    if "n" in values or "nd" in values:
        return RawGlass(index=float(values["n"] if "n" in values else values["nd"]), line=1)
    return RawGlass(str(values["gname"]), (kind.removesuffix("Glass").upper(),), line=1)


def _stated(values: dict[str, Any], name: str) -> Any:
    """Return an attribute, which some versions of ray-optics write with an underscore; KeyError."""
    return values[name] if name in values else values[f"_{name}"]


def _conditions(raw: RawLens, conditions: dict[str, Any]) -> None:
    """Read aperture, fields and wavelengths; fields may be stated as fractions of the largest."""
    pupil, view, light = (_inside(conditions[name]) for name in ("pupil", "field_of_view", "spectral_region"))
    *_, side, name = _stated(pupil, "key")
    raw.aperture = (APERTURES[side, name], abs(float(_stated(pupil, "value"))))
    *_, side, name = _stated(view, "key")
    raw.field_kind = FIELDS[side, name]
    scale = float(_stated(view, "value")) if view.get("is_relative") else 1.0
    places = (_inside(each) for each in view["fields"])
    raw.fields = [(scale * float(_stated(at, "x")), scale * float(_stated(at, "y"))) for at in places]
    raw.wavelengths_um = [float(nm) / NM_PER_UM for nm in light["wavelengths"]]
    raw.weights = [float(weight) for weight in light.get("spectral_wts", ())]
    raw.primary = int(light["reference_wvl"])
