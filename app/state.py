"""Everything the window shows, as one frozen value that goes to JSON and back. No Qt in here."""

import json
from dataclasses import asdict, dataclass, fields, replace
from math import inf, isfinite, isnan
from pathlib import Path

from p2sf.errors import P2SFError

SCHEMA = "p2sf-explorer-state"
VERSION = 1
CHOICES = {
    "stop": ("file", "auto"),
    "method": ("auto", "seidel", "fitted", "traced", "huygens"),
    "psf_scale": ("linear", "sqrt", "log"),
    "psf_units": ("sum", "peak", "strehl"),
    "phase": ("waves", "wrapped"),
    "theme": ("system", "light", "dark"),
}
# Smallest and largest value that can mean something, and how a sentence writes the quantity.
RANGES = {
    "depth_mm": (1e-3, inf, "source depth", "mm"),
    "focus_mm": (1e-3, inf, "focus distance", "mm"),
    "sensor_shift_um": (-1e6, 1e6, "sensor shift", "µm"),
    "field_deg": (-89.0, 89.0, "field angle", "°"),
    "wavelength_nm": (100.0, 20000.0, "wavelength", "nm"),
    "f_number": (0.2, 1000.0, "f-number", ""),
    "tolerance": (0.0, 1.0, "tolerance R²", ""),
}
OPTIONAL = ("focus_mm", "f_number")


@dataclass(frozen=True)
class State:
    """The whole setup; ``focus_mm`` and ``f_number`` None mean: as the lens file has it.

    ``lens_text`` is the TOML text of a lens edited in the window, None while it is as ``lens`` names it.
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


def _check_number(value, name: str, limits: tuple[float, float], words: str, unit: str) -> None:
    if value is None and name in OPTIONAL:
        return
    low, high = limits
    number = isinstance(value, int | float) and not isinstance(value, bool) and not isnan(value)
    if not number or not low <= value <= high:
        shown = f"{value:g}" if number else repr(value)
        raise P2SFError(
            f"{words} is {shown} {unit}".rstrip() + f"; give a number from {low:g} to {high:g} {unit}".rstrip()
        )


def state_to_dict(state: State) -> dict:
    """Return the state as plain JSON values; infinity is written "inf"."""
    return {name: "inf" if value == inf else value for name, value in asdict(state).items()}


def state_from_dict(values: dict) -> State:
    """Return the state of plain JSON values, defaults for what is absent; P2SFError for anything else."""
    known = {field.name for field in fields(State)}
    unknown = sorted(set(values) - known)
    if unknown:
        raise P2SFError(f'the state has an unknown entry "{unknown[0]}"; known are {", ".join(sorted(known))}')
    return replace(State(), **{name: inf if value == "inf" else value for name, value in values.items()})


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
