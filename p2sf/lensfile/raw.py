"""A lens as a file states it, in the file's own units, every item with its line."""

from dataclasses import dataclass, field
from math import inf, nan
from typing import Literal, NamedTuple

import numpy as np

from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import RequestError
from p2sf.glass.media import Medium
from p2sf.lens.grating import Phase
from p2sf.lens.lens import USUAL_AIM, Aim
from p2sf.lens.placement import Placement
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Shape
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.stated import Stated, StatedKind
from p2sf.messages import Message

RawApertureKind = Literal[
    "stop_semi_diameter",
    "entrance_pupil_diameter",
    "f_number",
    "image_f_number",
    "object_na",
    "object_cone_angle",
    "image_na",
]
RawFieldKind = Literal["angle", "object_height", "image_height", "real_image_height"]


@dataclass(frozen=True)
class RawGlass:
    """What a file says about a medium: a name with its makers, an index, or nd and vd.

    ``medium`` is a medium that the file itself defines (a private glass, a table of indices). ``beside``: nd and vd
    that a Zemax file writes beside a name; they may be left over from earlier glasses, and count with the user's
    consent only.
    """

    name: str = ""
    makers: tuple[str, ...] = ()
    index: float | None = None
    model: tuple[float, float] | None = None
    medium: Medium | None = None
    line: int | None = None
    beside: tuple[float, float] | None = None


CATALOGUE_AIR = (20.0, 1.0)  # °C and atmospheres, at which makers state indices relative to air
HOLE = "rays within a radius of {radius:g} are lost, a hole or an obscuration, where rims clip"


EDGE_POINTS = 33  # of half an ellipse


class PupilEnds(NamedTuple):
    """The parts of the pupil's radius that its upper, lower and side ends lose at one field."""

    upper: float = 0.0
    lower: float = 0.0
    side: float = 0.0

    @property
    def middle(self) -> float:
        """Return η of the middle of the ellipse through the ends."""
        return (self.lower - self.upper) / 2

    def edge(self) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η of points of half the ellipse, from its top."""
        angle = np.linspace(0, np.pi, EDGE_POINTS)
        return (1 - self.side) * np.sin(angle), self.middle + (1 - (self.upper + self.lower) / 2) * np.cos(angle)


@dataclass(frozen=True)
class VignettingFactors:
    """The factors of a file, one set per field; ``along_x``: whether some make a pupil that is not even in x."""

    ends: tuple[PupilEnds, ...]
    line: int | None = None
    along_x: bool = False

    @property
    def largest(self) -> float:
        """Return the largest factor."""
        return max((abs(part) for ends in self.ends for part in ends), default=0.0)


@dataclass(frozen=True)
class ParaxialSolve:
    """What the curvature or the thickness of a surface follows from: a marginal or a chief ray.

    ``kind``: its "height" at the next surface, its "angle" behind or its "incidence", "aplanatic" refraction, or, of no
    ray, the "power" of an element; ``value``: that height, slope or power in the file's units; ``beyond``: more
    thickness; ``name``: what the file calls it.
    """

    of: Literal["curvature", "thickness"]
    kind: str
    value: float = 0.0
    ray: Literal["marginal", "chief"] = "marginal"
    beyond: float = 0.0
    name: str = ""


@dataclass
class RawSurface:
    """One surface while it is being read. ``glass`` None is air; ``keeps_medium`` repeats the one before it.

    ``aspheric`` maps a power of r to its coefficient; ``shape`` is added to it. ``solves``: what its curvature and its
    thickness follow from. ``obscured``: whether ``inner_radius`` is an obscuration and no hole, which in the stop is a
    part of the pupil's mask.
    """

    number: int
    line: int | None = None
    label: str = ""
    curvature: float = 0.0
    thickness: float = 0.0
    glass: RawGlass | None = None
    keeps_medium: bool = False
    conic: float = 0.0
    aspheric: dict[int, float] = field(default_factory=dict)
    semi_diameter: float = inf
    inner_radius: float = 0.0
    shape: Shape | None = None
    diffraction: Phase | None = None
    before: tuple[Placement, ...] = ()
    after: tuple[Placement, ...] = ()
    ideal_focal_length: float = inf
    rim: Rim | None = None
    solves: dict[str, ParaxialSolve] = field(default_factory=dict)
    obscured: bool = False

    def solve(self, solve: ParaxialSolve) -> None:
        """Take note of what the curvature or the thickness follows from."""
        self.solves[solve.of] = solve

    @property
    def name(self) -> Message:
        """Return "surface 3" or "surface 3 (FRONT)"."""
        if self.label:
            return Message("surface {surface} ({label})", surface=self.number, label=self.label)
        return Message("surface {surface}", surface=self.number)


@dataclass
class RawLens:
    """A whole file. Lengths in units of ``unit_mm``; wavelengths µm; field pairs (x, y) in the kind's unit.

    ``environment``: temperature, °C, and pressure of the air, atmospheres, that indices of glasses are for.
    ``weights`` are those of the wavelengths, 1 where there are fewer; an object's cone angle is in degrees.

    ``primary`` counts wavelengths from 0. ``image``: the image surface, of which only the shape is
    used; a plane where it is None. ``sensor_before``: how it stands. ``telecentric``: whether the chief rays
    of object space are to be parallel to the axis, wherever the stop stands.
    """

    surfaces: list[RawSurface] = field(default_factory=list)
    unit_mm: float = 1.0
    object_distance: float = inf
    object_glass: RawGlass | None = None
    stop: int | None = None
    aperture: tuple[RawApertureKind, float] | None = None
    aperture_line: int | None = None
    field_kind: RawFieldKind = "angle"
    fields: list[tuple[float, float]] = field(default_factory=list)
    field_line: int | None = None
    wavelengths_um: list[float] = field(default_factory=list)
    weights: list[float] = field(default_factory=list)
    wavelength_line: int | None = None
    primary: int | None = None
    aim: Aim = USUAL_AIM
    telecentric: bool = False
    mask: PupilMask = CLEAR
    environment: tuple[float, float] = CATALOGUE_AIR
    environment_line: int | None = None
    vignetting: VignettingFactors | None = None
    title: str = ""
    source: str = ""
    sensor_stated: bool = True
    object_stated: bool = True
    image: RawSurface | None = None
    sensor_before: tuple[Placement, ...] = ()
    stated: list[Stated] = field(default_factory=list)

    def state(self, kind: StatedKind, value: float, line: int) -> None:
        """Take note of a number that the file states of the whole lens, in mm or degrees."""
        self.stated.append(Stated(kind, value, line))

    def apodise(self, exponent: float, source: LensText, line: int) -> None:
        """Let the amplitude fall as exp(−exponent·ρ²) over the pupil; LensFileError where that is impossible."""
        try:
            self.mask = PupilMask(apodisation=exponent**-0.5 if exponent > 0 else nan)
        except RequestError as failure:
            raise source.error(failure.message, line) from failure
