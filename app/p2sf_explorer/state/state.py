"""The complete state of the window as one frozen value in groups. Uses no Qt.

Every entry has one name, from slider to lesson: that of its field, with the group as a prefix if the field alone is
ambiguous (`ENTRIES`). `change` and `new_state` take entries by these names; `state_files` reads and writes states.
"""

from dataclasses import dataclass, field, fields, replace
from math import inf
from typing import Any, ClassVar

from p2sf.colour.spectrum import spectrum_of
from p2sf.conventions import FARTHEST_MM
from p2sf.disc.mask import MaskSettings, PupilMask
from p2sf.disc.zernike_terms import ZernikeOrder
from p2sf.errors import P2SFError, RequestError
from p2sf.lens.lens import USUAL_AIM
from p2sf.messages import Alternatives, Message
from p2sf.parameters import FARTHER
from p2sf.psf.methods import AUTO
from p2sf.tolerance.criteria import Criterion
from p2sf.tolerance.errors_of_build import UNITS, Grade
from p2sf_explorer.state.build_errors import BuildErrors, Compensator, check_errors
from p2sf_explorer.state.limits import (
    CHOICES,
    HOLDABLE,
    KINDS,
    LINKABLE,
    LISTED,
    MASK,
    MOST_FIELDS,
    MOST_LISTED,
    MOST_WAVES,
    OPTIONAL,
    PLAIN,
    PLAYABLE,
    RANGES,
)
from p2sf_explorer.state.terms import TERMS

LARGEST_SHOWN = 10**300  # above, a whole number does not fit a float and is quoted as text
MOST_LETTERS = 60  # of a value that is quoted


_NAMES: dict[type, dict[str, str]] = {}


def _entry_names(group: type[Any]) -> dict[str, str]:
    """Return the entries of a group, field → entry; cached, since every frame checks a group."""
    if group not in _NAMES:
        _NAMES[group] = {part.name: getattr(group, "PREFIX", "") + part.name for part in fields(group)}
    return _NAMES[group]


def _check_entries(group: Any) -> None:
    """Raise P2SFError for a value outside its range, choices or kind."""
    for part, name in _entry_names(type(group)).items():
        value = getattr(group, part)
        if name in RANGES:
            low, high, words, unit = RANGES[name]
            _check_number(value, name, (low, high), words, unit)
        elif name in CHOICES and value not in CHOICES[name]:
            raise P2SFError(
                '{name} is "{value}"; choose one of {choices}',
                name=name,
                value=str(value),
                choices=CHOICES[name],
            )
        if name in PLAIN and type(value) is not PLAIN[name] and not (value is None and name in OPTIONAL):
            raise P2SFError(
                "{name} is {value}; give {kind}",
                name=name,
                value=repr(value),
                kind=KINDS[PLAIN[name]],
            )


def _check_names(found: object, name: str, allowed: tuple[str, ...]) -> None:
    if not isinstance(found, tuple) or [item for item in allowed if item in found] != list(found):
        raise P2SFError(
            "{name} is {value}; list some of {allowed}, each once and in this order",
            name=name,
            value=repr(found),
            allowed=allowed,
        )


def _check_number(value: object, name: str, limits: tuple[float, float], words: Message, unit: str) -> None:
    if value is None and name in OPTIONAL:
        return
    low, high = limits
    if isinstance(value, int | float) and not isinstance(value, bool) and low <= value <= high:  # false for NaN
        if unit == "mm" and FARTHEST_MM < value < inf:
            raise P2SFError(Message(FARTHER, parameter=words, value=value, unit=" mm", most=FARTHEST_MM))
        return
    raise P2SFError(
        "{quantity} is {value}{unit}; give a number from {low:g} to {high:g}{unit}",
        quantity=words,
        value=_quote(value),
        low=low,
        high=high,
        unit=unit if unit in ("", "°") else f" {unit}",
    )


def _quote(value: object) -> object:
    """Return a value for a message: a number as one, anything else, or NaN, as a short text."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        if isinstance(value, float) or abs(value) < LARGEST_SHOWN:
            return Message("{value:g}", value=value)
    return repr(value)[:MOST_LETTERS]


@dataclass(frozen=True)
class Optics(MaskSettings):
    """The lens, its settings, the source, and the method; together with `WhatIf` they determine the picture.

    ``lens_text`` is the TOML text of a lens edited in the window, None while the lens is as ``lens`` names it.
    ``focus_mm``, ``f_number`` and the numbers of the mask are None for the value of the lens file. ``aim`` is that of
    `p2sf.lens.lens.Lens`. ``zoom`` and ``focus_position`` are positions on the rings of a lens that has them, None for
    the first column of its file; with ``focus_mm`` the focus ring follows. ``field_deg`` is the field along y and
    ``field_x_deg`` that along x. ``errors`` are manufacturing errors (`p2sf_explorer.state.build_errors`), in addition
    to those of its file or an edit.
    """

    lens: str = "double_gauss_28"
    lens_text: str | None = None
    depth_mm: float = inf
    focus_mm: float | None = None
    sensor_shift_um: float = 0.0
    field_deg: float = 10.0
    field_x_deg: float = 0.0
    wavelength_nm: float = 587.5618
    f_number: float | None = None
    zoom: float | None = None
    focus_position: float | None = None
    stop: str = "file"
    aim: str = USUAL_AIM
    clip: bool = False
    method: str = AUTO
    tolerance: float = 0.99
    errors: BuildErrors = ()

    def __post_init__(self) -> None:
        _check_entries(self)
        check_errors(self.errors)
        if self.mask:
            PupilMask(**self.mask)  # which raises for two blades, and for an odd power
        if not isinstance(self.lens, str) or not self.lens:
            raise P2SFError("the state names no lens; give the name of a shipped lens or a path")
        if not isinstance(self.lens_text, str | None):
            raise P2SFError(
                "the state's edited lens is not text; leave lens_text out to take the lens as its file has it"
            )

    @property
    def automatic(self) -> bool:
        """Return whether the method is left to ``auto``."""
        return self.method == AUTO

    @property
    def mask(self) -> dict[str, Any]:
        """Return the entries of the pupil mask that differ from the lens file, by field of `PupilMask`."""
        return {name: value for name in MASK if (value := getattr(self, name)) is not None}


@dataclass(frozen=True)
class WhatIf:
    """Coefficients altered by hand.

    ``added_waves`` are added to the lens's own six coefficients (in the order of `TERMS`), or stand alone in a
    ``free_pupil``; ``muted`` terms count as zero, and with any ``solo`` all others do.
    """

    added_waves: tuple[float, ...] = (0.0,) * len(TERMS)
    muted: tuple[str, ...] = ()
    solo: tuple[str, ...] = ()
    free_pupil: bool = False

    def __post_init__(self) -> None:
        _check_entries(self)
        waves = self.added_waves
        if not isinstance(waves, tuple) or len(waves) != len(TERMS):
            raise P2SFError(
                "the added waves are {waves}; give {count} numbers, for {terms}",
                waves=repr(waves),
                count=len(TERMS),
                terms=TERMS,
            )
        for term, value in zip(TERMS, waves, strict=True):
            _check_number(
                value,
                term,
                (-MOST_WAVES, MOST_WAVES),
                Message("what is added to {term}", term=term),
                "λ",
            )
        for name in ("muted", "solo"):
            _check_names(getattr(self, name), name, TERMS)


CAPTION = (
    "lens",
    "field",
    "depth",
    "f_number",
    "wavelength",
    "rms",
    "strehl",
)  # possible parts of the line above the stage


def _check_held(scales: object) -> None:
    """Raise P2SFError unless these are pairs of a panel, each once, and the end of its axes (> 0)."""
    pairs = scales if isinstance(scales, tuple) else (scales,)
    if not all(isinstance(pair, tuple) and len(pair) == 2 and pair[0] in HOLDABLE for pair in pairs):
        raise P2SFError(
            "held_scales is {value}; give pairs such as psf 30, of {panels}", value=_quote(scales), panels=(*HOLDABLE,)
        )
    if len({name for name, _ in pairs}) < len(pairs):
        raise P2SFError("held_scales is {value}; name each panel once", value=_quote(scales))
    for name, end in pairs:
        _check_number(end, name, HOLDABLE[name][1], Message("end of the axes"), "")


@dataclass(frozen=True)
class Display:
    """How results are shown.

    The panel ``stage`` is large; those of ``rail`` stand beside it, on ``rail_side``, and after them the tabs, with
    ``tab`` in front. ``stage_share`` is the stage's part of the room, ``rail_shares`` those of the rail's parts, () for
    equal ones. ``workspace`` names the arrangement that these began as (`p2sf_explorer.state.workspaces`). ``windows``
    names the panels that stand in windows of their own. ``scale_percent`` is the size of type and strokes, None for
    that which suits the screen.

    ``pixel_um`` is the pixel of a sensor, ``blur_um`` the diameter of blur that still counts as sharp, ``spectrum`` the
    light of the colour PSF (`p2sf.colour.spectrum`). ``language`` is a file of ``i18n/languages``, "en", or "system";
    ``colours`` are those of the heat maps.
    ``show_more``: whether the controls are unfolded that a first look does not need, ``show_pupil_shape``: those of the
    pupil mask; ``full_bleed``: whether the PSF runs under its own axes, to the edges of its panel.
    ``rays_coloured`` and ``rays_count`` are of the layout (`p2sf_explorer.compute.layout.layout`); ``keep_focus`` says
    what the sensor follows while the lens is edited: "paraxial" or "rms" focus, or "off". ``exaggerated``: the factor
    by which the drawings enlarge the tilts and decentres of ``errors``; ``show_field_x``: the field along x has a
    slider also where the lens is symmetric. ``caption`` names the parts of the line above the stage, of `CAPTION`.
    ``held_scales``: panels of `HOLDABLE` with the end of their axes, which then do not follow the data.
    """

    psf_scale: str = "sqrt"
    psf_units: str = "peak"
    phase: str = "waves"
    theme: str = "system"
    colours: str = "standard"
    language: str = "system"
    workspace: str = "explore"
    stage: str = "psf"
    rail: tuple[str, ...] = ("layout", "coefficients")
    rail_side: str = "right"
    rail_shares: tuple[float, ...] = ()
    stage_share: float = 0.56
    show_rail: bool = True
    show_controls: bool = True
    show_pupil_shape: bool = False
    show_more: bool = False
    full_bleed: bool = False
    tab: str = "profiles"
    windows: tuple[str, ...] = ()
    scale_percent: float | None = None
    pixel_um: float = 4.0
    blur_um: float = 30.0
    spectrum: str = "d65"
    rays_coloured: str = "kind"
    rays_count: int = 3
    keep_focus: str = "paraxial"
    exaggerated: int = 1
    show_field_x: bool = False
    caption: tuple[str, ...] = CAPTION
    held_scales: tuple[tuple[str, float], ...] = ()

    def __post_init__(self) -> None:
        _check_entries(self)
        _check_held(self.held_scales)
        for name in ("windows", "rail", "caption"):
            found = getattr(self, name)
            if not isinstance(found, list | tuple) or not all(isinstance(panel, str) for panel in found):
                raise P2SFError("the state's {name} must be a list of names; correct it or leave it out", name=name)
            object.__setattr__(self, name, tuple(found))  # a file has a list
        if not isinstance(self.rail_shares, tuple):
            raise P2SFError("rail_shares is {value}; give a list of numbers", value=_quote(self.rail_shares))
        for share in self.rail_shares:
            _check_number(share, "rail_shares", (0.0, 1.0), Message("share of a panel beside the stage"), "")
        spectrum_of(self.spectrum)


@dataclass(frozen=True)
class Compare:
    """``pinned`` is the setup B, ``shown`` the side that is on screen, ``linked`` the entries that change in both."""

    pinned: "State | None" = None
    shown: str = "a"
    linked: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        _check_entries(self)
        _check_names(self.linked, "linked", LINKABLE)
        if not isinstance(self.pinned, State | None) or (self.pinned and self.pinned.compare.pinned):
            raise P2SFError("what is pinned as B must be one state with nothing pinned in it; pin it again")
        if self.shown != "a" and not self.pinned:
            raise P2SFError(
                'shown is "{side}" and nothing is pinned as B; pin a state first (Ctrl+B)',
                side=self.shown,
            )


@dataclass(frozen=True)
class Playback:
    """The ``slider`` that is swept, "" for none, over ``range`` (None: all of its travel) in ``seconds``.

    ``subject`` is what a film of the sweep shows.
    """

    PREFIX: ClassVar[str] = "playback_"

    slider: str = ""
    range: tuple[float, float] | None = None
    seconds: float = 4.0
    subject: str = "stack"

    def __post_init__(self) -> None:
        _check_entries(self)
        if self.slider not in PLAYABLE:
            raise P2SFError(
                'play is "{name}"; name a slider: {sliders}',
                name=str(self.slider),
                sliders=PLAYABLE[1:],
            )
        if self.range is None:
            return
        if not isinstance(self.range, tuple) or len(self.range) != 2:
            raise P2SFError(
                "the range to play is {value}; give where it begins and where it ends",
                value=repr(self.range),
            )
        low, high, words, unit = RANGES.get(self.slider, (-MOST_WAVES, MOST_WAVES, Message("an end of the sweep"), "λ"))
        for value in self.range:
            _check_number(value, "playback_range", (low, high), words, unit)


@dataclass(frozen=True)
class PhotoView:
    """The picture before the lens: ``source`` is a chart's name or a file; ``pixel_um`` None shows the whole field.

    ``full`` then takes every pixel of the photo. ``look`` is how before and after are put to the eye. Where ``show`` is
    "taken", the photo was taken through the lens: its own pixels are of ``pixel_um``, and ``full`` takes all of them.
    ``depths``: "" for one distance, "slope", "steps", "photo" for its own, or the path of a map, whose numbers have a
    ``depth_meaning`` between ``near_mm`` and ``far_mm``.
    """

    PREFIX: ClassVar[str] = "photo_"

    source: str = "landscape"
    pixel_um: float | None = 8.0
    show: str = "lens"
    split: float = 0.5
    full: bool = False
    look: str = "split"
    depths: str = ""
    depth_meaning: str = "near_white"
    near_mm: float = 1000.0
    far_mm: float = 10000.0

    def __post_init__(self) -> None:
        _check_entries(self)


@dataclass(frozen=True)
class MeasuredView:
    """The ``picture`` of points that is measured, "" for none, and its pixel.

    ``beside``: departures from the lens on screen are fitted; otherwise the lens gives the scale only. ``encoding``:
    what whole numbers of the picture mean, "srgb" or "linear"; "automatic" takes 8 bits for sRGB.
    """

    PREFIX: ClassVar[str] = "measured_"

    picture: str = ""
    pixel_um: float = 3.45
    beside: bool = True
    encoding: str = "automatic"

    def __post_init__(self) -> None:
        _check_entries(self)


def _check_list(values: object, name: str, least: int, most: int = MOST_LISTED) -> None:
    """Raise P2SFError unless the values are none, or ``least`` to ``most`` numbers that their quantity can be."""
    low, high, words, unit = RANGES[LISTED[name]]
    if not isinstance(values, tuple) or (values and not least <= len(values) <= most):
        raise P2SFError(
            "{name} is {value}; give {least} to {most} numbers, or none for those that the window chooses",
            name=name,
            value=_quote(values),
            least=least,
            most=most,
        )
    for value in values:
        _check_number(value, name, (low, high), words, unit)


@dataclass(frozen=True)
class MatrixView:
    """The matrix of small pictures: ``what`` they show at several fields, and at several values of ``across``.

    ``rows`` and ``columns`` are how many values the window chooses where the list of a quantity is empty. ``shared``:
    all pictures have one scale.
    """

    PREFIX: ClassVar[str] = "matrix_"

    what: str = "psf"
    across: str = "wavelength_nm"
    rows: int = 3
    columns: int = 3
    fields_deg: tuple[float, ...] = ()
    wavelengths_nm: tuple[float, ...] = ()
    depths_mm: tuple[float, ...] = ()
    shifts_um: tuple[float, ...] = ()
    shared: bool = True

    def __post_init__(self) -> None:
        _check_entries(self)
        for part in ("fields_deg", "wavelengths_nm", "depths_mm", "shifts_um"):
            _check_list(getattr(self, part), self.PREFIX + part, 2)


@dataclass(frozen=True)
class CurvesView:
    """Curves laid over each other: ``of`` fields, colours …, at ``frequencies_per_mm`` where one is needed.

    ``count`` is how many fields the window chooses where ``fields_deg`` is empty. The table of figures has the same
    fields and frequencies.
    """

    PREFIX: ClassVar[str] = "curves_"

    of: str = "fields"
    count: int = 5
    fields_deg: tuple[float, ...] = ()
    frequencies_per_mm: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        _check_entries(self)
        _check_list(self.fields_deg, "curves_fields_deg", 1, MOST_FIELDS)
        _check_list(self.frequencies_per_mm, "curves_frequencies_per_mm", 1)


@dataclass(frozen=True)
class ToleranceView:
    """Tolerances of built lenses: those of a ``grade``, and ``own`` ones in their place.

    ``own``: (kind, first, last, amount) as in `p2sf.tolerance.Tolerance`; ``first`` 0 stands for all of a kind.
    ``compensators``: (kind, first, last) of what is set at assembly; ``first`` 0 is the back focus, or of a tilt the
    sensor. ``limit``: what every field of a good lens keeps by the ``criterion``, None for what four lenses of five
    keep. ``draw`` tells one draw of random lenses from another. ``build``: which of them, from 1, was opened as A;
    0 for none.
    """

    PREFIX: ClassVar[str] = "tolerances_"

    grade: Grade = "precision"
    criterion: Criterion = "rms_waves"
    limit: float | None = None
    frequency_per_mm: float = 10.0
    own: BuildErrors = ()
    compensators: tuple[Compensator, ...] = (("thickness", 0, 0),)
    draw: int = 0
    build: int = 0

    def __post_init__(self) -> None:
        _check_entries(self)
        for name, kinds in (("own", (str, int, int, float)), ("compensators", (str, int, int))):
            _check_rows(getattr(self, name), self.PREFIX + name, kinds)


def _check_rows(rows: object, name: str, kinds: tuple[type, ...]) -> None:
    """Raise P2SFError unless the rows name errors of a lens, each with as many numbers as there are kinds."""
    words = "kind, first surface, last surface, amount".split(", ")[: len(kinds)]
    for row in rows if isinstance(rows, tuple) else (rows,):
        if isinstance(row, tuple) and len(row) == len(kinds) and row[0] in UNITS:
            if all(type(x) is kind or (kind is float and type(x) is int) for x, kind in zip(row, kinds, strict=True)):
                if all(0 <= x < inf for x in row[1:]):
                    continue
        raise P2SFError(
            "{name} has {row}; give {words}, of one of {kinds}",
            name=name,
            row=repr(row)[:MOST_LETTERS],
            words=tuple(words),
            kinds=tuple(UNITS),
        )


@dataclass(frozen=True)
class PanelChoices:
    """What panels show where they have a chooser of their own; ``exactness_measure`` is that of the top bar's slider.

    Their values are in `CHOICES`, as those of every chooser.
    """

    seidel_sum: str = "all"
    zernike_order: ZernikeOrder = "noll"
    database_coefficient: str = "w22"
    database_rule: str = "table1"
    accuracy_plot: str = "here"
    exactness_measure: str = "r2"

    def __post_init__(self) -> None:
        _check_entries(self)


@dataclass(frozen=True)
class LessonPlace:
    """The lesson under way by ``name``, "" for none, its ``step``, and whether the step's answer is ``told``."""

    PREFIX: ClassVar[str] = "lesson_"

    name: str = ""
    step: int = 0
    told: bool = False

    def __post_init__(self) -> None:
        _check_entries(self)


@dataclass(frozen=True)
class Cameras:
    """From where the 3D view and the wavefront's surface are seen: turn about the vertical and tilt, and how near."""

    PREFIX: ClassVar[str] = "camera_"

    turn_deg: float = 24.0
    tilt_deg: float = 11.0
    zoom: float = 1.0
    surface_turn_deg: float = -30.0
    surface_tilt_deg: float = 35.0

    def __post_init__(self) -> None:
        _check_entries(self)


@dataclass(frozen=True)
class State:
    """The whole setup of the window."""

    optics: Optics = Optics()
    what_if: WhatIf = WhatIf()
    display: Display = Display()
    compare: Compare = field(default_factory=Compare)  # whose check needs this class
    playback: Playback = Playback()
    photo: PhotoView = PhotoView()
    measured: MeasuredView = MeasuredView()
    lesson: LessonPlace = LessonPlace()
    camera: Cameras = Cameras()
    matrix: MatrixView = MatrixView()
    curves: CurvesView = CurvesView()
    tolerances: ToleranceView = ToleranceView()
    choices: PanelChoices = PanelChoices()


FIRST = State()
ENTRIES = {
    name: (group.name, part)
    for group in fields(State)
    for part, name in _entry_names(type(getattr(FIRST, group.name))).items()
}
"""Where each entry of a State is: name → (group, field)."""


def entry(state: State, name: str) -> Any:
    """Return the entry of a state by its name in `ENTRIES`."""
    group, part = ENTRIES[name]
    return getattr(getattr(state, group), part)


def change(state: State, **entries: Any) -> State:
    """Return a state with some entries changed, by their names in `ENTRIES`; P2SFError for a value that cannot be."""
    groups: dict[str, dict[str, Any]] = {}
    for name, value in entries.items():
        if name not in ENTRIES:
            from difflib import get_close_matches

            close = get_close_matches(name, ENTRIES, 3, 0.5)
            raise RequestError(
                'the state has no entry "{name}"; choose {names}',
                name=name,
                names=Alternatives(close or sorted(ENTRIES)),
            )
        group, part = ENTRIES[name]
        groups.setdefault(group, {})[part] = value
    return replace(
        state,
        **{group: replace(getattr(state, group), **values) for group, values in groups.items()},
    )


def new_state(**entries: Any) -> State:
    """Return the first state with some entries changed, as `change`."""
    return change(FIRST, **entries)
