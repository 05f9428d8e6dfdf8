"""The lens as the state sets it, its first-order facts, and the ranges the controls may run over. No Qt in here."""

import tomllib
from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf, isfinite
from pathlib import Path
from types import MappingProxyType

import numpy as np

from app.scales import nice
from app.state import State
from p2sf.conventions import NM_PER_UM, degrees_from_slope, slope_from_degrees
from p2sf.gaussian import CardinalPoints, basis_rays, cardinal_points
from p2sf.lens import Lens
from p2sf.pupils import ParaxialRays, Pupils, Stop, f_number, paraxial_rays, pupils
from p2sf.request import Request, Setup, set_up
from p2sf.seidel import Coefficients, coefficients
from p2sf.source import Source

VISIBLE_NM = (400.0, 700.0)
AS_GOOD_AS_INFINITE_MM = 1e6  # a file's six digits cannot tell a focus at a kilometre from one at infinity


@dataclass(frozen=True)
class Setting:
    """One lens, opened and focused as the state says, and everything paraxial about it at this source."""

    lens: Lens
    source: Source
    stop: Stop
    pupils: Pupils
    cardinal: CardinalPoints
    rays: ParaxialRays
    coefficients: Coefficients
    object_height_mm: float | None
    focal_length_mm: float


@dataclass(frozen=True)
class Ranges:
    """Where each slider of this lens begins and ends."""

    closest_mm: float
    field_deg: float
    wavelength_nm: tuple[float, float]
    f_number: tuple[float, float]
    file_f_number: float
    focused_mm: float
    shift_um: float


def load(name: str) -> Lens:
    """Return the lens of a shipped name or a path; read again when the file has changed."""
    path = Path(name)
    return _load(name, path.stat().st_mtime_ns if path.is_file() else 0)


@lru_cache(maxsize=32)
def _load(name: str, _changed: int) -> Lens:
    from p2sf.library import find_lens

    return find_lens(name)


def prescription(state: State) -> Lens:
    """Return the state's lens before it is opened and focused: as edited, else as its file has it; LensFileError."""
    return load(state.lens) if state.lens_text is None else _edited(state.lens_text)


@lru_cache(maxsize=128)
def _edited(text: str) -> Lens:
    from p2sf.lensfile.toml import parse_toml

    return parse_toml(text, "the edited lens")


def title(name: str) -> str:
    """Return how a chooser names a lens: its file's title, read without looking up its glasses; else its name."""
    from p2sf.library import lenses_folder

    path = Path(name) if Path(name).is_file() else lenses_folder() / f"{name}.toml"
    try:
        return str(tomllib.loads(path.read_text(encoding="utf-8")).get("title", name))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return name


def shipped() -> tuple[str, ...]:
    """Return the names of the lenses that come with the program."""
    from p2sf.library import shipped_lenses

    return tuple(shipped_lenses())


def setting(state: State) -> Setting:
    """Return everything paraxial about the state; a P2SFError in a sentence where there is no answer."""
    fixed = _fixed(prescription(state), _request(state))
    slope = float(slope_from_degrees(state.field_deg))
    source = replace(fixed["source"], field_slope=slope)
    depth = source.depth_mm
    gap = depth + float(fixed["pupils"].entrance_from_first)
    return Setting(
        **fixed
        | {
            "source": source,
            "coefficients": coefficients(fixed["lens"], depth, slope, source.wavelength_um, fixed["stop"]),
            "object_height_mm": slope * gap if isfinite(depth) else None,
        }
    )


@lru_cache(maxsize=16)
def _fixed(prescription: Lens, request: Request) -> MappingProxyType:
    """Return the entries of a Setting that do not depend on the field, so that dragging the field computes little."""
    made = set_up(prescription, request)
    lens, wavelength, stop = made.lens, made.source.wavelength_um, made.stop
    cardinal = cardinal_points(lens, wavelength)
    return MappingProxyType(
        {
            "lens": lens,
            "source": made.source,
            "stop": stop,
            "pupils": pupils(lens, wavelength, stop),
            "cardinal": cardinal,
            "rays": paraxial_rays(lens, made.source.depth_mm, wavelength, stop),
            "focal_length_mm": float(cardinal.effective_focal_length),
        }
    )


def setup(state: State) -> Setup:
    """Return the state as the library's own setup, field included: what a file says about where it comes from."""
    return set_up(prescription(state), replace(_request(state), field_deg=state.field_deg))


def _request(state: State) -> Request:
    return Request(
        depth_mm=state.depth_mm,
        wavelength_nm=state.wavelength_nm,
        focus_mm=state.focus_mm,
        sensor_shift_um=state.sensor_shift_um,
        f_number=state.f_number,
        stop=state.stop,
    )


@lru_cache(maxsize=32)
def ranges(lens: Lens) -> Ranges:
    """Return the sliders' ranges for a lens as its file has it."""
    wavelength = lens.reference_wavelength_um
    cardinal = cardinal_points(lens, wavelength)
    focal = abs(float(cardinal.effective_focal_length))
    f_stop = float(f_number(lens, wavelength))
    finite = isfinite(f_stop)
    widest = max(abs(angle) for angle in lens.fields_deg)
    return Ranges(
        closest_mm=closest_distance(lens),
        field_deg=min(75.0, max(5.0, nice(1.25 * widest, (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8)) if widest else 5.0)),
        wavelength_nm=wavelength_range(lens),
        f_number=(f_stop / 1.4, max(32.0, 4 * f_stop)) if finite else (1.0, 32.0),
        file_f_number=f_stop if finite else inf,
        focused_mm=focused_distance(lens),
        shift_um=nice(30 * wavelength * (f_stop**2 if finite else 16.0), (1, 2, 3, 5)) if focal else 500.0,
    )


def closest_distance(lens: Lens) -> float:
    """Return the closest sensible source distance in mm: outside the front focus by a fifth of the focal length.

    For a lens that is focused closer than that (a relay), half of the distance it is focused at.
    """
    cardinal = cardinal_points(lens, lens.reference_wavelength_um)
    focal = abs(float(cardinal.effective_focal_length))
    focus = -float(cardinal.front_focal_distance)
    if not isfinite(focal):
        return nice(2 * sum(surface.thickness for surface in lens.surfaces) + 10)
    closest = nice(max(focus + 0.2 * focal, 0.5 * focal), (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8))
    focused = focused_distance(lens)
    if focused > 1.5 * closest:
        return closest
    return 0.5 * (focus + focused) if 0 < focus < focused else 0.5 * focused


def focused_distance(lens: Lens) -> float:
    """Return the object distance in mm whose paraxial image lies on the file's sensor; inf when at or beyond infinity.

    Solves the height of the axial ray on the sensor, linear in the vergence, for zero.
    """
    rays = basis_rays(lens, lens.reference_wavelength_um)
    reach = lens.sensor_mm / rays.image_index
    parallel, divergent = rays.a[-1] + reach * rays.c[-1], rays.b[-1] + reach * rays.d[-1]
    vergence = -float(parallel / (divergent * rays.object_index)) if divergent else 0.0
    return 1 / vergence if vergence > 1 / AS_GOOD_AS_INFINITE_MM else inf


@lru_cache(maxsize=32)
def wavelength_range(lens: Lens) -> tuple[float, float]:
    """Return the visible wavelengths every glass of the lens has data for, nm."""
    low, high = VISIBLE_NM
    for medium in lens.media:
        limits = getattr(medium, "range_um", None) or _table_range(medium)
        if limits:
            low, high = max(low, NM_PER_UM * limits[0]), min(high, NM_PER_UM * limits[1])
    return (low, high) if low < high else VISIBLE_NM


def _table_range(medium) -> tuple[float, float] | None:
    known = getattr(medium, "wavelengths_um", None)
    return (known[0], known[-1]) if known else None


def default_state(name: str, lens_text: str | None = None) -> State:
    """Return the state a lens is first shown in: its own focus, a field with something to say, its middle line."""
    return _defaults(State(lens=name, lens_text=lens_text), prescription(State(lens=name, lens_text=lens_text)))


@lru_cache(maxsize=32)
def _defaults(state: State, lens: Lens) -> State:
    focused = focused_distance(lens)
    focal = abs(float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length))
    depth = inf if focused > 30 * focal or not isfinite(focal) else float(np.round(focused, 3))
    fields = sorted(abs(angle) for angle in lens.fields_deg)
    middle = fields[len(fields) // 2] or fields[-1]
    wavelength = lens.reference_wavelength_um * NM_PER_UM
    return replace(state, depth_mm=depth, field_deg=middle, wavelength_nm=wavelength)


def with_lens(state: State, name: str, lens_text: str | None = None) -> State:
    """Return the state moved to another lens: its defaults for the source, the person's choices for the rest."""
    fresh = default_state(name, lens_text)
    return replace(
        state,
        lens=name,
        lens_text=lens_text,
        depth_mm=fresh.depth_mm,
        field_deg=fresh.field_deg,
        wavelength_nm=fresh.wavelength_nm,
        focus_mm=None,
        sensor_shift_um=0.0,
        f_number=None,
    )


def field_degrees(slope: float) -> float:
    """Return the field angle in degrees of a chief-ray slope."""
    return float(degrees_from_slope(slope))
