"""Everything the window shows, as one frozen value that goes to JSON and back. No Qt in here."""

import json
from dataclasses import dataclass, fields, replace
from math import inf, isfinite
from pathlib import Path

from p2sf.colour.spectrum import spectrum_of
from p2sf.errors import P2SFError
from p2sf_explorer.state.limits import CHOICES, KINDS, LINKABLE, MOST_WAVES, OPTIONAL, PLAIN, PLAYABLE, RANGES
from p2sf_explorer.state.terms import TERMS

SCHEMA = "p2sf-explorer-state"
VERSION = 1
TELLABLE, TOLD = 10**300, 60  # a whole number that a float can still hold; letters of what is none


@dataclass(frozen=True)
class State:
    """The whole setup; ``focus_mm`` and ``f_number`` None mean: as the lens file has it.

    ``lens_text`` is the TOML text of a lens edited in the window, None while it is as ``lens`` names it.
    ``windows`` names the panels that stand in windows of their own. ``pixel_um`` is a sensor's pixel, ``blur_um`` the
    blur's diameter still called sharp, ``spectrum`` the colour PSF's light (`p2sf.colour.spectrum`).
    What if: ``added_waves`` on top of the lens's own six coefficients (`TERMS` in order), or alone in a
    ``free_pupil``; ``muted`` terms count as zero, and with any ``solo`` all others do. Compare: ``pinned`` is the
    setup B, ``shown`` which of the two is on screen, ``linked`` what moves both. ``play`` is the slider that is
    swept, over ``play_range`` (None: all of its travel) in ``play_seconds``.
    ``photo`` is a chart's name or a file, ``photo_pixel_um`` None shows the lens's whole field. ``lesson`` is the one
    under way, none for "", and ``lesson_told`` whether its step's answer is shown. ``language`` is a file of
    ``i18n/languages``, "en", or the system's; ``colours`` the heat maps'; ``eye_`` says where the 3D view is seen from,
    ``relief_`` where the wavefront's surface is.
    """

    lens: str = "double_gauss_28"
    lens_text: str | None = None
    depth_mm: float = inf
    focus_mm: float | None = None
    sensor_shift_um: float = 0.0
    field_deg: float = 10.0
    wavelength_nm: float = 587.5618
    f_number: float | None = None
    stop: str = "file"
    clip: bool = False
    method: str = "auto"
    tolerance: float = 0.99
    psf_scale: str = "sqrt"
    psf_units: str = "peak"
    phase: str = "waves"
    theme: str = "system"
    tab: str = "profiles"
    windows: tuple[str, ...] = ()
    pixel_um: float = 4.0
    blur_um: float = 30.0
    spectrum: str = "d65"
    added_waves: tuple[float, ...] = (0.0,) * len(TERMS)
    muted: tuple[str, ...] = ()
    solo: tuple[str, ...] = ()
    free_pupil: bool = False
    pinned: "State | None" = None
    shown: str = "a"
    linked: tuple[str, ...] = ()
    play: str = ""
    play_range: tuple[float, float] | None = None
    play_seconds: float = 4.0
    photo: str = "landscape"
    photo_pixel_um: float | None = 8.0
    photo_show: str = "lens"
    photo_split: float = 0.5
    lesson: str = ""
    lesson_step: int = 0
    lesson_told: bool = False
    language: str = "system"
    colours: str = "standard"
    eye_turn_deg: float = 24.0
    eye_tilt_deg: float = 11.0
    eye_near: float = 1.0
    relief_turn_deg: float = -30.0
    relief_tilt_deg: float = 35.0

    def __post_init__(self):
        for name, (low, high, words, unit) in RANGES.items():
            _check_number(getattr(self, name), name, (low, high), words, unit)
        for name, allowed in CHOICES.items():
            if getattr(self, name) not in allowed:
                raise P2SFError(f'{name} is "{getattr(self, name)}"; choose one of {", ".join(allowed)}')
        if not isinstance(self.lens, str) or not self.lens:
            raise P2SFError("the state names no lens; give the name of a shipped lens or a path")
        if not isinstance(self.lens_text, str | None):
            raise P2SFError(
                "the state's edited lens is not text; leave lens_text out to take the lens as its file has it"
            )
        if not isinstance(self.clip, bool) or not isinstance(self.tab, str):
            raise P2SFError("the state's clip must be true or false, and its tab a panel's name; correct them")
        for name, kind in PLAIN.items():
            if type(getattr(self, name)) is not kind:
                raise P2SFError(f"{name} is {getattr(self, name)!r}; give {KINDS[kind]}")
        object.__setattr__(self, "windows", _names(self.windows))
        spectrum_of(self.spectrum)
        _check_what_if(self)
        _check_pinned(self)
        _check_play(self)


def _check_what_if(state: State) -> None:
    waves = state.added_waves
    if not isinstance(waves, tuple) or len(waves) != len(TERMS):
        raise P2SFError(f"the added waves are {waves!r}; give {len(TERMS)} numbers, for {', '.join(TERMS)}")
    for term, value in zip(TERMS, waves, strict=True):
        _check_number(value, term, (-MOST_WAVES, MOST_WAVES), f"what is added to {term}", "λ")
    for name in ("muted", "solo"):
        _check_names(getattr(state, name), name, TERMS)
    if not isinstance(state.free_pupil, bool):
        raise P2SFError(f"free_pupil is {state.free_pupil!r}; give true or false")


def _check_names(found, name: str, allowed: tuple[str, ...]) -> None:
    if not isinstance(found, tuple) or [item for item in allowed if item in found] != list(found):
        raise P2SFError(f"{name} is {found!r}; list some of {', '.join(allowed)}, each once and in this order")


def _check_pinned(state: State) -> None:
    _check_names(state.linked, "linked", LINKABLE)
    if not isinstance(state.pinned, State | None) or (state.pinned and state.pinned.pinned):
        raise P2SFError("what is pinned as B must be one state with nothing pinned in it; pin it again")
    if state.shown != "a" and not state.pinned:
        raise P2SFError(f'shown is "{state.shown}" and nothing is pinned as B; pin a state first (Ctrl+B)')


def _check_play(state: State) -> None:
    if state.play not in PLAYABLE:
        raise P2SFError(f'play is "{state.play}"; name a slider: {", ".join(PLAYABLE[1:])}')
    if state.play_range is None:
        return
    if not isinstance(state.play_range, tuple) or len(state.play_range) != 2:
        raise P2SFError(f"the range to play is {state.play_range!r}; give where it begins and where it ends")
    low, high, words, unit = RANGES.get(state.play, (-MOST_WAVES, MOST_WAVES, "an end of the sweep", "λ"))
    for value in state.play_range:
        _check_number(value, "play_range", (low, high), words, unit)


def _check_number(value, name: str, limits: tuple[float, float], words: str, unit: str) -> None:
    if value is None and name in OPTIONAL:
        return
    low, high = limits
    number = isinstance(value, int | float) and not isinstance(value, bool) and value == value
    if not number or not low <= value <= high:
        shown = f"{value:g}" if number and (isinstance(value, float) or abs(value) < TELLABLE) else repr(value)[:TOLD]
        gap = "" if unit == "°" else " "
        raise P2SFError(
            f"{words} is {shown}{gap}{unit}".rstrip() + f"; give a number from {low:g} to {high:g}{gap}{unit}".rstrip()
        )


def _names(value) -> tuple[str, ...]:
    """Return the names of panels as a tuple, which a file's list becomes."""
    if not isinstance(value, list | tuple) or not all(isinstance(name, str) for name in value):
        raise P2SFError("the state's windows must be a list of panels' names; correct it or leave it out")
    return tuple(value)


def state_to_dict(state: State) -> dict:
    """Return the state as plain JSON values; infinity is written "inf"."""
    return {field.name: _plain(getattr(state, field.name)) for field in fields(state)}


def _plain(value):
    if isinstance(value, State):
        return state_to_dict(value)
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return "inf" if value == inf else value


def _read(name: str, value):
    if isinstance(value, list):
        return tuple(_read("", item) for item in value)
    if name == "pinned" and isinstance(value, dict):
        return state_from_dict(value)
    return inf if value == "inf" else value


def state_from_dict(values: dict) -> State:
    """Return the state of plain JSON values, defaults for what is absent; P2SFError for anything else."""
    pinned = values.get("pinned")
    if isinstance(pinned, dict) and pinned.get("pinned"):
        raise P2SFError("what is pinned as B must be one state with nothing pinned in it; pin it again")
    known = {field.name for field in fields(State)}
    unknown = sorted(set(values) - known)
    if unknown:
        raise P2SFError(f'the state has an unknown entry "{unknown[0]}"; known are {", ".join(sorted(known))}')
    try:
        return replace(State(), **{name: _read(name, value) for name, value in values.items()})
    except RecursionError:  # lists in lists, as deep as JSON was read just so
        raise P2SFError("the state's lists are nested too deep; save it again from the explorer") from None


def state_to_json(state: State, **extra) -> str:
    """Return a state file's text; ``extra`` (versions, what was exported) is kept beside and not read back."""
    document = {"schema": SCHEMA, "version": VERSION, **extra, "state": state_to_dict(state)}
    return json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def state_from_json(text: str, where: str = "the state") -> State:
    """Return the state of a state file's text; P2SFError says what is wrong and where."""
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise P2SFError(f"{where}, line {error.lineno}: not JSON ({error.msg}); correct it or save it again") from None
    except (ValueError, RecursionError):
        raise P2SFError(f"{where} is nested too deep or holds too long a number; save it again") from None
    if (
        not isinstance(document, dict)
        or document.get("schema") != SCHEMA
        or not isinstance(document.get("state"), dict)
    ):
        raise P2SFError(f"{where} is not a state of the explorer; give a .json the explorer has written")
    if document.get("version") != VERSION:
        raise P2SFError(f"{where} has version {document.get('version')}; this program reads version {VERSION}")
    return state_from_dict(document["state"])


def read_state(path) -> State:
    """Return the state saved at ``path``; P2SFError when it cannot be read."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise P2SFError(f"{path} cannot be read ({type(error).__name__}); give a state file that exists") from None
    return state_from_json(text, str(path))


def is_finite_depth(state: State) -> bool:
    """Return whether the source stands at a finite distance."""
    return isfinite(state.depth_mm)
