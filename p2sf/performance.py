"""What an engineer reads first: sharpness, contrast, distortion, light and colour, by exact rays.

See handbook 6.3.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.messages import PLAIN, Message, Style
from p2sf.pixel_kernels.illumination import relative_illumination
from p2sf.pixel_kernels.sensor_points import landing_mm, sensor_map, slope_ratio
from p2sf.psf.measures import Parts, energy_in, mtf_of, parts_of
from p2sf.psf.methods import PsfOptions, render, whole_pixel_um
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.field_curves import heights
from p2sf.raytrace.pencil import pencil

T = TypeVar("T")
USUAL_PER_MM = 10.0, 30.0
"""The two frequencies at which makers of photographic lenses publish contrast, cycles per mm."""
PIXELS = 64  # of the PSF whose peak is looked for; the peak is that of the continuous picture


@dataclass(frozen=True, eq=False)
class Performance:
    """Figures of one source, NaN where there is none.

    Attributes
    ----------
    frequency_per_mm : numpy.ndarray
        (n,) cycles per mm on the sensor.
    rms_waves : float
        RMS of the wavefront without piston and tilt, as `ObjectPoints.zernike` has it.
    strehl : float
        As `p2sf.render` has it.
    tangential, sagittal : numpy.ndarray
        (n,) contrasts of `ObjectPoints.mtf`.
    radius_80_um : float
        Radius about the centroid that holds 80 % of the light, µm, as `ObjectPoints.energy` has it.
    distortion : float
        Height of the chief ray over its paraxial height, less 1.
    illumination : float
        Irradiance of an even object over that in the middle of the field; NaN for a misaligned lens.
    lateral_colour_um : float
        How much farther from the axis the chief ray of the shortest wavelength of the lens lands than that of the
        longest, from one object point, µm; NaN for a lens of one wavelength.
    reason : Message, optional
        Why the first figure that is NaN has been refused.
    """

    frequency_per_mm: np.ndarray
    rms_waves: float
    strehl: float
    tangential: np.ndarray
    sagittal: np.ndarray
    radius_80_um: float
    distortion: float
    illumination: float
    lateral_colour_um: float
    reason: Message | None = None


def performance_of(
    lens: Lens,
    source: Source,
    frequency_per_mm: ArrayLike = USUAL_PER_MM,
    clip: bool = False,
    parts: Callable[[], tuple[Parts, str]] | None = None,
) -> Performance:
    """Return the figures of a source before a lens as it is set.

    ``parts`` returns its pupil by exact rays, where that may be known already (`p2sf.psf.measures.parts_of`).
    """
    frequency = np.atleast_1d(np.asarray(frequency_per_mm, float))
    collected = _Collected()
    pupil = collected.value(parts or (lambda: parts_of(lens, source, "traced", clip)))
    contrast = collected.value(lambda: mtf_of(*pupil, frequency)) if pupil else None
    nothing = np.full(frequency.shape, nan)
    rms = collected.figure(lambda: zernike_fit(lens, source, clip=clip).rms)
    trusted = collected.figure if isfinite(rms) else _nothing  # without a wavefront no ray can be trusted
    return Performance(
        frequency_per_mm=frequency,
        rms_waves=rms,
        strehl=trusted(lambda: _strehl(lens, source, clip)),
        tangential=contrast.tangential if contrast else nothing,
        sagittal=contrast.sagittal if contrast else nothing,
        radius_80_um=collected.figure(lambda: energy_in(*pupil).radius_80_um) if pupil else nan,
        distortion=trusted(lambda: float(heights(lens, source, source.field_slope).distortion)),
        illumination=trusted(lambda: _illumination(lens, source, clip)),
        lateral_colour_um=trusted(lambda: _lateral_colour_um(lens, source)),
        reason=collected.reason,
    )


def _nothing(figure: Callable[[], float | None]) -> float:
    return nan


@dataclass
class _Collected:
    """Figures that may be refused, each by itself; ``reason``: why the first of them is."""

    reason: Message | None = None

    def value(self, figure: Callable[[], T]) -> T | None:
        """Return a result, None where it is refused."""
        try:
            return figure()
        except P2SFError as error:
            self.reason = self.reason or error.message
            return None

    def figure(self, figure: Callable[[], float | None]) -> float:
        """Return a number, NaN where there is none."""
        found = self.value(figure)
        return nan if found is None else found


def _strehl(lens: Lens, source: Source, clip: bool) -> float | None:
    pixel_um = whole_pixel_um(lens, source, PIXELS)
    found = render(lens, source, "traced", PIXELS, pixel_um, PsfOptions(clip=clip)).strehl
    return None if found is None else float(found)


def _illumination(lens: Lens, source: Source, clip: bool) -> float | None:
    if lens.misaligned:
        return None
    if not source.field_slope:
        return 1.0
    place = landing_mm(lens, source)
    seen = sensor_map(lens, source.depth_mm, source.wavelength_um, float(np.hypot(*place)), clip)
    return float(relative_illumination(seen, *place))


def _lateral_colour_um(lens: Lens, source: Source) -> float | None:
    """Return the lateral colour; the pupil sees the object point at another slope in each wavelength."""
    ends = min(lens.wavelengths_nm) / NM_PER_UM, max(lens.wavelengths_nm) / NM_PER_UM
    if ends[0] == ends[1]:
        return None
    ratios = [slope_ratio(lens, source.depth_mm, source.wavelength_um, wave) for wave in ends]
    every = Sources(source.depth_mm, source.field_slope * np.array(ratios), np.array(ends))
    short, long = pencil(seen_from(lens, source.azimuth_deg), every, np.zeros(1), np.zeros(1)).chief_y[..., 0].tolist()
    return float(UM_PER_MM * (abs(short) - abs(long)))


@dataclass(frozen=True)
class Figure:
    """One column of the table: its heading, its unit, how many decimals are shown, and the figure itself."""

    label: Message
    unit: str
    decimals: int
    value: Callable[[Performance], float]
    signed: bool = False

    def shown(self, found: Performance) -> str:
        """Return the figure as it is shown, a dash where there is none."""
        value = self.value(found)
        if not isfinite(value):
            return "–"
        text = f"{value:{'+z' if self.signed else 'z'}.{self.decimals}f}"
        return text.replace("-", "−")


RMS = Figure(Message("RMS"), "λ", 3, lambda one: one.rms_waves)
STREHL = Figure(Message("Strehl"), "", 3, lambda one: one.strehl)
BEHIND_CONTRAST = (
    Figure(Message("R80"), "µm", 2, lambda one: one.radius_80_um),
    Figure(Message("distortion"), "%", 2, lambda one: 100 * one.distortion, signed=True),
    Figure(Message("illumination"), "%", 1, lambda one: 100 * one.illumination),
    Figure(Message("lateral colour"), "µm", 2, lambda one: one.lateral_colour_um, signed=True),
)


@dataclass(frozen=True, eq=False)
class PerformanceTable:
    """Figures of one lens at several fields, degrees."""

    field_deg: tuple[float, ...]
    frequency_per_mm: tuple[float, ...]
    found: tuple[Performance, ...]

    @property
    def figures(self) -> tuple[Figure, ...]:
        """Return the columns behind that of the field."""
        contrasts = (
            Figure(side, f"{f:g}/mm", 3, _contrast(number, name))
            for number, f in enumerate(self.frequency_per_mm)
            for side, name in ((Message("S"), "sagittal"), (Message("T"), "tangential"))
        )
        return RMS, STREHL, *contrasts, *BEHIND_CONTRAST

    def headings(self, style: Style = PLAIN) -> tuple[tuple[str, str], ...]:
        """Return name and unit of all columns, the field first."""
        named = ((Message("field"), "°"), *((figure.label, figure.unit) for figure in self.figures))
        return tuple((label.text(style), unit) for label, unit in named)

    def rows(self, style: Style = PLAIN) -> tuple[tuple[str, ...], ...]:
        """Return every row as it is shown."""
        return tuple(
            tuple(style.number(text) for text in (f"{angle:.4g}", *(figure.shown(one) for figure in self.figures)))
            for angle, one in zip(self.field_deg, self.found, strict=True)
        )

    def rows_of_data(self) -> list[list[str]]:
        """Return the table with ten digits, units in the headings first, an empty text where there is no figure."""
        rows = [
            [f"{v:.10g}" if isfinite(v) else "" for v in (angle, *(figure.value(one) for figure in self.figures))]
            for angle, one in zip(self.field_deg, self.found, strict=True)
        ]
        return [[", ".join(filter(None, head)) for head in self.headings()], *rows]

    @property
    def reasons(self) -> tuple[Message, ...]:
        """Return why figures are missing, one sentence for each field that lacks some."""
        pairs = zip(self.field_deg, self.found, strict=True)
        return tuple(Message("{field:.4g}°: {why}", field=f, why=one.reason) for f, one in pairs if one.reason)


def _contrast(number: int, name: str) -> Callable[[Performance], float]:
    return lambda one: float(getattr(one, name)[number])


def growing_table(
    lens: Lens, sources: Sequence[Source], frequency_per_mm: Sequence[float] = USUAL_PER_MM, clip: bool = False
) -> Iterator[PerformanceTable]:
    """Yield the table of a lens as it is set while it grows by one row for each source."""
    table = PerformanceTable((), tuple(frequency_per_mm), ())
    for source in sources:
        found = performance_of(lens, source, frequency_per_mm, clip)
        fields = *table.field_deg, source.field_xy_deg[1]
        table = PerformanceTable(fields, table.frequency_per_mm, (*table.found, found))
        yield table
