"""Everything the window shows, as one frozen value that goes to JSON and back. No Qt in here."""

import json
import os
from dataclasses import dataclass, fields, replace
from math import inf
from pathlib import Path
from typing import Any

from p2sf.colour.spectrum import spectrum_of
from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.state.limits import CHOICES, KINDS, LINKABLE, MOST_WAVES, OPTIONAL, PLAIN, PLAYABLE, RANGES
from p2sf_explorer.state.terms import TERMS

SCHEMA = "p2sf-explorer-state"
THE_STATE = Message("the state")
VERSION = 1
LARGEST_SHOWN = 10**300  # above, a whole number does not fit a float and is quoted as text
MOST_LETTERS = 60  # of a value that is quoted


@dataclass(frozen=True)
class State:
    """The whole setup of the window; ``focus_mm`` and ``f_number`` are None where the lens file's value holds.

    ``lens_text`` is the TOML text of a lens edited in the window, None while the lens is as ``lens`` names it.
    ``windows`` names the panels that stand in windows of their own. ``pixel_um`` is the pixel of a sensor, ``blur_um``
    the diameter of blur that still counts as sharp, ``spectrum`` the light of the colour PSF
    (`p2sf.colour.spectrum`). What-if: ``added_waves`` are added to the lens's own six coefficients (in the order of
    `TERMS`), or stand alone in a ``free_pupil``; ``muted`` terms count as zero, and with any ``solo`` all others do.
    Compare: ``pinned`` is the setup B, ``shown`` the side that is on screen, ``linked`` those that change in both.
    ``play`` is the slider that is swept, over ``play_range`` (None: all of its travel) in ``play_seconds``.
    ``photo`` is the name of a chart or a file; ``photo_pixel_um`` None shows the whole field of the lens. ``lesson`` is
    the one under way, "" for none; ``lesson_told`` says whether the answer of its step is shown. ``language`` is a file
    of ``i18n/languages``, "en", or "system"; ``colours`` are those of the heat maps. ``eye_`` entries place the camera
    of the 3D view, ``relief_`` entries that of the wavefront's surface.
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

    def __post_init__(self) -> None:
        for name, (low, high, words, unit) in RANGES.items():
            _check_number(getattr(self, name), name, (low, high), words, unit)
        for name, allowed in CHOICES.items():
            if getattr(self, name) not in allowed:
                raise P2SFError(
                    '{name} is "{value}"; choose one of {choices}',
                    name=name,
                    value=str(getattr(self, name)),
                    choices=allowed,
                )
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
                raise P2SFError(
                    "{name} is {value}; give {kind}", name=name, value=repr(getattr(self, name)), kind=KINDS[kind]
                )
        object.__setattr__(self, "windows", _names(self.windows))
        spectrum_of(self.spectrum)
        _check_what_if(self)
        _check_pinned(self)
        _check_play(self)


def _check_what_if(state: State) -> None:
    waves = state.added_waves
    if not isinstance(waves, tuple) or len(waves) != len(TERMS):
        raise P2SFError(
            "the added waves are {waves}; give {count} numbers, for {terms}",
            waves=repr(waves),
            count=len(TERMS),
            terms=TERMS,
        )
    for term, value in zip(TERMS, waves, strict=True):
        _check_number(value, term, (-MOST_WAVES, MOST_WAVES), Message("what is added to {term}", term=term), "λ")
    for name in ("muted", "solo"):
        _check_names(getattr(state, name), name, TERMS)
    if not isinstance(state.free_pupil, bool):
        raise P2SFError("free_pupil is {value}; give true or false", value=repr(state.free_pupil))


def _check_names(found: object, name: str, allowed: tuple[str, ...]) -> None:
    if not isinstance(found, tuple) or [item for item in allowed if item in found] != list(found):
        raise P2SFError(
            "{name} is {value}; list some of {allowed}, each once and in this order",
            name=name,
            value=repr(found),
            allowed=allowed,
        )


def _check_pinned(state: State) -> None:
    _check_names(state.linked, "linked", LINKABLE)
    if not isinstance(state.pinned, State | None) or (state.pinned and state.pinned.pinned):
        raise P2SFError("what is pinned as B must be one state with nothing pinned in it; pin it again")
    if state.shown != "a" and not state.pinned:
        raise P2SFError('shown is "{side}" and nothing is pinned as B; pin a state first (Ctrl+B)', side=state.shown)


def _check_play(state: State) -> None:
    if state.play not in PLAYABLE:
        raise P2SFError('play is "{name}"; name a slider: {sliders}', name=str(state.play), sliders=PLAYABLE[1:])
    if state.play_range is None:
        return
    if not isinstance(state.play_range, tuple) or len(state.play_range) != 2:
        raise P2SFError(
            "the range to play is {value}; give where it begins and where it ends", value=repr(state.play_range)
        )
    low, high, words, unit = RANGES.get(state.play, (-MOST_WAVES, MOST_WAVES, Message("an end of the sweep"), "λ"))
    for value in state.play_range:
        _check_number(value, "play_range", (low, high), words, unit)


def _check_number(value: object, name: str, limits: tuple[float, float], words: Message, unit: str) -> None:
    if value is None and name in OPTIONAL:
        return
    low, high = limits
    if isinstance(value, int | float) and not isinstance(value, bool) and low <= value <= high:  # false for NaN
        return
    raise P2SFError(
        "{quantity} is {value}{unit}; give a number from {low:g} to {high:g}{unit}",
        quantity=words,
        value=_quoted(value),
        low=low,
        high=high,
        unit=unit if unit in ("", "°") else f" {unit}",
    )


def _quoted(value: object) -> object:
    """Return a value for a message: a number as one, anything else, or NaN, as a short text."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        if isinstance(value, float) or abs(value) < LARGEST_SHOWN:
            return Message("{value:g}", value=value)
    return repr(value)[:MOST_LETTERS]


def _names(value: object) -> tuple[str, ...]:
    """Return the names of panels as a tuple, which a file's list becomes."""
    if not isinstance(value, list | tuple) or not all(isinstance(name, str) for name in value):
        raise P2SFError("the state's windows must be a list of panels' names; correct it or leave it out")
    return tuple(value)


def state_to_dict(state: State) -> dict[str, object]:
    """Return the state as plain JSON values; infinity is written "inf"."""
    return {field.name: _plain(getattr(state, field.name)) for field in fields(state)}


def _plain(value: object) -> object:
    if isinstance(value, State):
        return state_to_dict(value)
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return "inf" if value == inf else value


def _read(name: str, value: Any) -> Any:
    if isinstance(value, list):
        return tuple(_read("", item) for item in value)
    if name == "pinned" and isinstance(value, dict):
        return state_from_dict(value)
    return inf if value == "inf" else value


def state_from_dict(values: dict[str, Any]) -> State:
    """Return the state of plain JSON values, defaults for what is absent; P2SFError for anything else."""
    pinned = values.get("pinned")
    if isinstance(pinned, dict) and pinned.get("pinned"):
        raise P2SFError("what is pinned as B must be one state with nothing pinned in it; pin it again")
    known = {field.name for field in fields(State)}
    unknown = sorted(set(values) - known)
    if unknown:
        raise P2SFError(
            'the state has an unknown entry "{entry}"; known are {known}', entry=unknown[0], known=tuple(sorted(known))
        )
    try:
        return replace(State(), **{name: _read(name, value) for name, value in values.items()})
    except RecursionError:  # lists in lists, as deep as JSON was read just so
        raise P2SFError("the state's lists are nested too deep; save it again from the explorer") from None


def state_to_json(state: State, **extra: object) -> str:
    """Return the text of a state file; ``extra`` entries, such as versions, are written and not read back."""
    document = {"schema": SCHEMA, "version": VERSION, **extra, "state": state_to_dict(state)}
    return json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def state_from_json(text: str, where: str | Message = THE_STATE) -> State:
    """Return the state of a state file's text; P2SFError says what is wrong and ``where``."""
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise P2SFError(
            "{where}, line {line}: not JSON ({why}); correct it or save it again",
            where=where,
            line=error.lineno,
            why=error.msg,
        ) from None
    except (ValueError, RecursionError):
        raise P2SFError("{where} is nested too deep or holds too long a number; save it again", where=where) from None
    if (
        not isinstance(document, dict)
        or document.get("schema") != SCHEMA
        or not isinstance(document.get("state"), dict)
    ):
        raise P2SFError("{where} is not a state of the explorer; give a .json the explorer has written", where=where)
    if document.get("version") != VERSION:
        raise P2SFError(
            "{where} has version {found}; this program reads version {version}",
            where=where,
            found=str(document.get("version")),
            version=VERSION,
        )
    return state_from_dict(document["state"])


def read_state(path: str | os.PathLike[str]) -> State:
    """Return the state saved at ``path``; P2SFError when it cannot be read."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise P2SFError(
            "{path} cannot be read ({why}); give a state file that exists", path=str(path), why=type(error).__name__
        ) from None
    return state_from_json(text, str(path))
