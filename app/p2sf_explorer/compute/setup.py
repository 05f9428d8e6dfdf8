"""The lens as the state sets it up, its first-order data, and the ranges of the controls. No Qt in here."""

import os
import tomllib
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from math import inf, isfinite
from pathlib import Path

from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import GeometryError, P2SFError
from p2sf.lens.lens import Lens, with_mask
from p2sf.lens.meridians import meridians
from p2sf.lens.positions import Axis, Kind
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import CardinalPoints, cardinal_points
from p2sf.paraxial.positions import lens_at
from p2sf.paraxial.pupils import ParaxialRays, Pupils, Stop, f_number, find_stop, paraxial_rays, pupils
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.psf.methods import by_six
from p2sf.raytrace.field_geometry import Cone, cone
from p2sf.raytrace.focusing import object_distance
from p2sf.setting import AS_IN_FILE, Request, Settings, Setup, mask_of, set_up, with_field
from p2sf.tolerance.errors_of_build import MOVES, source_of_build
from p2sf_explorer.compute.ranges import (
    closest_distance,
    fastest_f_number,
    file_focus,
    middle_distance,
    telling_field,
    wavelength_range,
)
from p2sf_explorer.state.build_errors import BuildErrors
from p2sf_explorer.state.limits import MASK, RINGS, SLIDERS
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import Optics, State, change, new_state
from p2sf_explorer.state.what_if import alter

HERE = {*RINGS, *MASK, "field_deg", "field_x_deg"}
ASKED = {part.name for part in fields(Optics)} & {part.name for part in fields(Request)} - HERE
"""What the library sets up; rings, mask and field are set here, since these make no new lens when they are dragged."""


@dataclass(frozen=True)
class ParaxialSetup:
    """One lens, opened and focused as the state says, and everything paraxial about it at this source.

    ``prescription`` is the lens before it was opened and focused, built as the state has it; ``designed`` is ``lens``
    without the errors of its build, which sources stand before.
    ``coefficients`` make the picture; they are the lens's ``own`` unless ``altered`` by hand.
    ``object_y_mm``: y of the source, None at infinity. ``cardinal`` and ``focal_length_mm``: in yz, which is drawn.
    """

    prescription: Lens
    designed: Lens
    lens: Lens
    source: Source
    stop: Stop
    pupils: Pupils
    cardinal: CardinalPoints
    rays: ParaxialRays
    coefficients: Coefficients
    own: Coefficients
    object_y_mm: float | None
    focal_length_mm: float

    @property
    def cone(self) -> Cone:
        """Return the cone of light about the chief ray; the paraxial one where no such ray reaches the sensor."""
        try:
            return cone(self.lens, self.source)
        except GeometryError:
            return Cone(*[float(self.own.na)] * 3)

    @property
    def altered(self) -> bool:
        """Return whether the coefficients are not the lens's own."""
        return self.coefficients is not self.own


def everywhere_by_coefficients(state: State, setup: ParaxialSetup) -> bool:
    """Return whether the six coefficients make every picture: chosen by name, or altered by hand.

    What ``auto`` chooses holds for the present point only, not for other fields and sensor positions.
    """
    return by_six(state.optics.method) or setup.altered


@dataclass(frozen=True)
class Ranges:
    """Where each slider of this lens begins and ends, and the fields that its file states.

    ``both_sides``: a negative field is not the mirror image of a positive one. ``mask``: what stands in the
    stop as the file has it.
    ``middle_mm``: the distance in the middle of a slider of distance, None where the lens says nothing about it.
    """

    closest_mm: float
    middle_mm: float | None
    field_deg: float
    wavelength_nm: tuple[float, float]
    f_number: tuple[float, float]
    file_f_number: float
    focused_mm: float
    shift_um: float
    stated_deg: tuple[tuple[float, float], ...] = ()
    both_sides: bool = False
    mask: PupilMask = CLEAR
    rings: tuple[Axis, ...] = ()

    def ring(self, kind: Kind) -> Axis | None:
        """Return the ring of a kind, None where the lens has none."""
        return next((axis for axis in self.rings if axis.kind == kind), None)


def load(name: str) -> Lens:
    """Return the lens of a shipped name or a path; read again when the file has changed."""
    try:
        changed = os.stat(name).st_mtime_ns  # four times as fast as Path.stat, and called on every frame
    except (OSError, ValueError):
        changed = 0
    return _load(name, changed)


@lru_cache(maxsize=32)
def _load(name: str, _changed: int) -> Lens:
    from p2sf.lensfile.library import find_lens

    return find_lens(name)


def prescription(state: State) -> Lens:
    """Return the state's lens before it is opened and focused: as edited, else as its file has it, its rings turned.

    It is without the errors of its build, which `built_lens` adds. LensFileError for a file that cannot be read.
    """
    lens = load(state.optics.lens) if state.optics.lens_text is None else _read_edited(state.optics.lens_text)
    return lens if lens.positions is None else with_rings(lens, state)


def built_lens(state: State) -> Lens:
    """Return the state's `prescription` with the errors of its build; P2SFError where these cannot be."""
    from p2sf_explorer.state.built import with_errors

    lens, errors = prescription(state), state.optics.errors
    return with_errors(lens, errors) if errors else lens


def with_rings(lens: Lens, state: State) -> Lens:
    """Return a lens with its rings where the state has them.

    A ring that the lens does not have is passed over, and one is turned to its end at most: a state may be of another
    lens, or of an earlier one in the same file.
    """
    optics, rings = state.optics, lens.positions
    if rings is None:
        return lens
    by_hand = optics.focus_position if optics.focus_mm is None else None
    return _with_rings(lens, _within(rings.axis("zoom"), optics.zoom), _within(rings.axis("focus"), by_hand))


def _within(axis: Axis | None, place: float | None) -> float | None:
    return None if axis is None or place is None else min(max(place, axis.low), axis.high)


@lru_cache(maxsize=64)
def _with_rings(lens: Lens, zoom: float | None, focus_position: float | None) -> Lens:
    return lens_at(lens, zoom, focus_position)


def zoom_place(state: State) -> float | None:
    """Return where the ring of zoom stands; None without one."""
    rings = prescription(state).positions
    return rings.at("zoom") if rings else None


def focus_place(state: State) -> float | None:
    """Return where the ring of focus stands, which a focus distance turns by itself; None without a ring."""
    lens = prescription(state)
    if lens.positions is None or lens.positions.axis("focus") is None:
        return None
    try:
        lens = _axial(lens, _request(state, None), ()).setup.lens
    except P2SFError:  # no picture either: whoever wants it says why
        pass
    return lens.positions.at("focus") if lens.positions else None


@lru_cache(maxsize=128)
def _read_edited(text: str) -> Lens:
    from p2sf.lensfile.toml.lens import parse_toml

    return parse_toml(text, "the edited lens")


def title(name: str) -> str:
    """Return how a chooser names a lens: its file's title, read without looking up its glasses; else its name."""
    return _file_entry(name, "title") or name


def character(name: str) -> str:
    """Return the line of a lens file that says what is peculiar to it; "" where there is none."""
    return _file_entry(name, "character")


def _file_entry(name: str, key: str) -> str:
    from p2sf.lensfile.library import lenses_folder

    path = Path(name) if Path(name).is_file() else lenses_folder() / f"{name}.toml"
    try:
        return str(tomllib.loads(path.read_text(encoding="utf-8")).get(key, ""))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return ""


def shipped_names() -> tuple[str, ...]:
    """Return the names of the lenses that come with the program."""
    from p2sf.lensfile.library import shipped_lenses

    return tuple(shipped_lenses())


def paraxial_setup(state: State) -> ParaxialSetup:
    """Return everything paraxial about the state; P2SFError where there is no answer."""
    axial = _axial(prescription(state), _request(state, None), state.optics.errors)
    setup = _with_fields(axial, state)
    lens, source, stop = with_state_mask(setup.lens, state), setup.source, setup.stop
    own = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um, stop)
    gap = source.depth_mm + float(axial.pupils.entrance_from_first)
    return ParaxialSetup(
        prescription=axial.setup.prescription,
        designed=axial.designed,
        lens=lens,
        source=source,
        stop=stop,
        pupils=axial.pupils,
        cardinal=axial.cardinal,
        rays=axial.rays,
        coefficients=alter(own, state),
        own=own,
        object_y_mm=0.0 - source.field_slope * gap if isfinite(source.depth_mm) else None,
        focal_length_mm=float(axial.cardinal.effective_focal_length),
    )


def request_setup(state: State) -> Setup:
    """Return the state as the library's own setup, which is also what a file says about where it comes from."""
    axial = _axial(prescription(state), _request(state, None), state.optics.errors)
    setup = _with_fields(axial, state)
    return replace(setup, lens=with_state_mask(setup.lens, state))


def _with_fields(axial: "_Axial", state: State) -> Setup:
    """Return a setup with its source at the fields of the state, along y and along x, of the lens as designed."""
    found = with_field(axial.setup, _request(state, state.optics.field_deg))
    source = found.source
    if state.optics.field_x_deg:
        fields = state.optics.field_x_deg, state.optics.field_deg
        source = Source(source.depth_mm, None, source.wavelength_um, field_deg=fields)
    return replace(found, source=source_of_build(axial.designed, found.lens, source))


def with_state_mask(lens: Lens, state: State) -> Lens:
    """Return the lens with the mask in its stop that the state asks for; the lens's own where it asks for none."""
    return _with_mask(lens, tuple(state.optics.mask.items())) if state.optics.mask else lens


@lru_cache(maxsize=16)
def _with_mask(lens: Lens, mask: tuple[tuple[str, float], ...]) -> Lens:
    return with_mask(lens, mask_of(lens, Settings(**dict(mask))))  # type: ignore[arg-type]  # each of its field's own type


@dataclass(frozen=True)
class _Axial:
    """What does not depend on the field, so that dragging the field computes little; ``designed``: without errors."""

    setup: Setup
    designed: Lens
    pupils: Pupils
    cardinal: CardinalPoints
    rays: ParaxialRays


@lru_cache(maxsize=16)
def _axial(prescription: Lens, request: Request, errors: BuildErrors) -> _Axial:
    setup = set_up(prescription, request)
    designed = setup.lens
    if errors:
        setup = _with_errors(setup, errors)
    lens, wavelength, stop = setup.lens, setup.source.wavelength_um, setup.stop
    return _Axial(
        setup=setup,
        designed=designed,
        pupils=pupils(lens, wavelength, stop),
        cardinal=cardinal_points(meridians(lens).y, wavelength),
        rays=paraxial_rays(lens, setup.source.depth_mm, wavelength, stop),
    )


def _with_errors(setup: Setup, errors: BuildErrors) -> Setup:
    """Return a setup with errors in its lens, whose sensor and rings stay where a lens without errors has them."""
    from p2sf_explorer.state.built import with_errors

    lens = with_errors(setup.lens, errors)
    stop = find_stop(lens, setup.source.depth_mm, setup.source.wavelength_um)
    return replace(setup, lens=lens, stop=stop, prescription=with_errors(setup.prescription, errors))


def _request(state: State, field_deg: float | None) -> Request:
    return Request(field_deg=field_deg, **{name: getattr(state.optics, name) for name in ASKED})


@lru_cache(maxsize=32)
def ranges(lens: Lens) -> Ranges:
    """Return the sliders' ranges for a lens as its file has it."""
    wavelength = lens.reference_wavelength_um
    cardinal = cardinal_points(lens, wavelength)
    focal = abs(float(cardinal.effective_focal_length))
    f_stop = float(f_number(lens, wavelength))
    finite = isfinite(f_stop)
    widest = lens.widest_field_deg
    return Ranges(
        closest_mm=closest_distance(lens),
        middle_mm=middle_distance(lens),
        field_deg=_field_end(widest),
        wavelength_nm=wavelength_range(lens),
        f_number=(fastest_f_number(lens), max(32.0, 4 * f_stop) if finite else 32.0),
        file_f_number=f_stop if finite else inf,
        focused_mm=file_focus(lens),
        shift_um=nice(30 * wavelength * (f_stop**2 if finite else 16.0), (1, 2, 3, 5)) if focal else 500.0,
        stated_deg=lens.field_places_deg,
        both_sides=lens.misaligned,
        mask=lens.mask,
        rings=lens.positions.axes if lens.positions else (),
    )


def state_ranges(state: State) -> Ranges:
    """Return the sliders' `ranges` for the lens of a state, whose build may be without symmetry."""
    found = ranges(prescription(state))
    return _with_sides(found, found.both_sides or any(kind in MOVES for kind, *_ in state.optics.errors))


@lru_cache(maxsize=8)
def _with_sides(found: Ranges, both: bool) -> Ranges:
    return replace(found, both_sides=both)


def _field_end(widest: float) -> float:
    """Return where the field's slider ends, degrees: 5° or more, or less where the file states fields of minutes."""
    end = nice(1.25 * widest, (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8)) if widest else 5.0
    return end if end <= 1.0 else min(75.0, max(5.0, end))


def default_state(name: str, lens_text: str | None = None) -> State:
    """Return the state a lens is first shown in: its own object and wavelength, and a field worth showing."""
    return _defaults(new_state(lens=name, lens_text=lens_text), prescription(new_state(lens=name, lens_text=lens_text)))


FIRST_LENS = "cooke_triplet"  # in focus; at 14° astigmatism and coma break a star up into a pattern that has names


def first_state() -> State:
    """Return what the window shows at its first start."""
    return default_state(FIRST_LENS)


@lru_cache(maxsize=32)
def _defaults(state: State, lens: Lens) -> State:
    depth = object_distance(lens)
    x, y = telling_field(lens, depth)
    wavelength = lens.reference_wavelength_nm
    return change(state, depth_mm=depth, field_deg=y, field_x_deg=x, wavelength_nm=wavelength, aim=lens.aim)


def with_lens(state: State, name: str, lens_text: str | None = None) -> State:
    """Return the state moved to another lens: its defaults for the source, the person's choices for the rest."""
    fresh = default_state(name, lens_text)
    return change(
        state,
        lens=name,
        lens_text=lens_text,
        depth_mm=fresh.optics.depth_mm,
        field_deg=fresh.optics.field_deg,
        field_x_deg=fresh.optics.field_x_deg,
        wavelength_nm=fresh.optics.wavelength_nm,
        errors=(),
        **{name: getattr(AS_IN_FILE, name) for name in SLIDERS if hasattr(AS_IN_FILE, name)},
    )
