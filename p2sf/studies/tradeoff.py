"""What each method costs in time and in error, measured on this machine: as a table, a plot, JSON and CSV."""

import csv
import json
import tracemalloc
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from io import StringIO
from itertools import cycle, product
from math import inf, isinf
from statistics import mean, median
from time import process_time
from typing import BinaryIO

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, number_list
from p2sf.figures.compare import Errors, compare
from p2sf.figures.window import mtf
from p2sf.html import html_table
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.parameters import check_angle, check_samples
from p2sf.psf.methods import AUTO, NAMES, REFERENCE, SPHERICAL, PsfOptions, method_of, whole_pixel_um
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.psf.result import Psf
from p2sf.psf.spherical import worth_spherical
from p2sf.raytrace.focusing import object_distance
from p2sf.setting import AS_IN_FILE, AimChoice, CameraData, set_up_source, with_camera
from p2sf.studies.other_sampling import SAMPLED, check_sampling, sampled_psf, sampled_ways
from p2sf.studies.trade_plots import MARKERS
from p2sf.threads import one_blas_thread, using_threads

PIXELS = 64
REPEATS = 9
SLOW_SECONDS = 0.5  # a method this slow is timed once
EVERY = (AUTO, *NAMES)
STEP = 1e-10  # relative, by which the sources of two readings differ, so that nothing is remembered
LEAST = 0.9, 0.99, 0.999  # R² that `advice` speaks of
MANY = 10_000  # PSFs, of whose time it speaks too


@dataclass(frozen=True)
class MethodCost:
    """One method at one point: its errors, the numbers and rays it takes, median CPU seconds and peak memory.

    ``errors`` and ``mtf_error``, the largest difference of contrast, are against the settled picture by ``reference``.
    ``choice``: the method that "auto" took, else the method itself; ``choosing_seconds``: what it takes longer than
    that method, None unless both were measured. ``error``: the relative L2 error of the sum itself.
    """

    method: str
    quality: str
    choice: str
    reference: str
    aim: str
    depth_mm: float
    field_deg: float
    wavelength_nm: float
    errors: Errors
    mtf_error: float
    numbers: int
    rays: int
    seconds: float
    choosing_seconds: float | None
    bytes: int
    sampling: Message
    error: float | None

    @property
    def name(self) -> str:
        """Return the method, its quality unless settled, and what "auto" took."""
        quality = "" if self.quality == "settled" else f" ({self.quality})"
        return f"{self.method}{quality}" if self.choice == self.method else f"{self.method}{quality}: {self.choice}"


class TradeoffTable(list[MethodCost]):
    """Result of `tradeoff`: a list of rows that prints as a table."""

    def __repr__(self) -> str:
        lines = table(self)
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        return "\n".join("  ".join(map(str.ljust, line, widths)).rstrip() for line in lines)

    def _repr_html_(self) -> str:
        head, *rows = table(self)
        return html_table("Each method against exact rays", head, rows)


@one_blas_thread
@check_arguments
@with_camera
def tradeoff(
    lens: Lens,
    *,
    depths_mm: ArrayLike | None = None,
    fields_deg: ArrayLike | None = None,
    wavelengths_nm: ArrayLike | None = None,
    methods: str | Sequence[str] = EVERY,
    pixels: int = PIXELS,
    pixel_um: float | None = None,
    samplings: ArrayLike = (),
    min_r2: float = 0.99,
    integrated: bool | None = None,
    camera: CameraData = AS_IN_FILE,
    aim: AimChoice | None = None,
) -> TradeoffTable:
    """Measure the time of each method, as `render` takes it, and its error against the settled sum of exact rays.

    Where plane waves are predicted to miss more than 1e-3 of R² that sum is of spherical waves (*spherical*), else of
    plane ones (*huygens*). Every reading is of a source that differs in the tenth digit, as of a first call.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    depths_mm : array_like, optional
        Object distances from the first vertex, mm; by default that of the lens's object.
    fields_deg, wavelengths_nm : array_like, optional
        Field angles, degrees, and wavelengths, nm; by default the fields and the reference wavelength of the lens.
    methods : str or sequence of str
        One method, or several; "auto" is a row of its own, with the method that it takes.
    pixels : int
        Samples along each side of the compared window.
    pixel_um : float, optional
        Distance between samples, µm; by default one that shows the whole PSF.
    samplings : array_like of int, optional
        Points along a side of the pupil's grid for OpticStudio's Huygens sum, a plain FFT of exact rays and the paper's
        FFT, which are measured beside the methods; by default none. The first two fill the paraxial entrance pupil:
        with ``aim="paraxial"`` the reference does so too, and their errors are those of sampling alone. All pictures
        are points then.
    min_r2 : float
        Smallest R² that "auto" accepts.
    integrated : bool, optional
        Whether a sample is the light on the pixel around it; by default as `render` decides for the reference.
    camera, aim
        As for `render`; the stop "auto" is that at the first depth.

    Returns
    -------
    TradeoffTable
        A list with one row per point, method and quality: errors, numbers, rays, CPU seconds, peak memory in bytes;
        `advice` says in words what to take.

    Raises
    ------
    RequestError, GeometryError, GlassError, SamplingError
        As for `render`.

    Examples
    --------
    >>> import p2sf
    >>> rows = p2sf.tradeoff(p2sf.load_lens("landscape"), fields_deg=[0], methods=["seidel"], pixels=16)
    >>> [row.quality for row in rows]
    ['preview', 'settled']
    """
    check_samples(pixels, pixel_um)
    along_y = tuple(dict.fromkeys(y for _, y in lens.field_places_deg))
    fields = number_list("fields_deg", along_y if fields_deg is None else fields_deg).tolist()
    for angle in fields:
        check_angle("fields_deg", angle)
    own = object_distance(lens) if depths_mm is None else depths_mm
    depths = number_list("depths_mm", own, infinite=True).tolist()
    usual = lens.reference_wavelength_nm
    waves = number_list("wavelengths_nm", usual if wavelengths_nm is None else wavelengths_nm).tolist()
    methods = (methods,) if isinstance(methods, str) else methods
    counts = [int(count) for count in number_list("samplings", samplings)]
    for count in counts:
        check_sampling(count)
    first = Source(next(iter(depths), inf), wavelength_um=lens.reference_wavelength_um)
    lens = set_up_source(lens, first, camera).lens
    rows = TradeoffTable()
    for place in product(depths, fields, waves):
        point = _point(lens, place, (pixels, pixel_um), min_r2, False if counts else integrated)
        if not rows:
            # Untimed, since a first call loads libraries and tables; the reference has just had its own.
            for way in _ways(set(methods) - {point.reference}):
                point.picture(*way)
        found = [_row(point, *way) for way in (*_ways(methods), *sampled_ways(counts, pixels))]
        times = {(row.method, row.quality): row.seconds for row in found}
        rows += [_with_choosing(row, times.get((row.choice, row.quality))) for row in found]
    return rows


@dataclass(frozen=True, eq=False)
class Point:
    """A source through a lens, seen in a window (samples a side, µm between them), and its reference picture.

    ``place``: its depth, mm, field, degrees, and wavelength, nm.
    """

    lens: Lens
    place: tuple[float, float, float]
    source: Source
    window: tuple[int, float]
    min_r2: float
    reference: str
    truth: Psf

    def picture(self, method: str, quality: str, number: int = 0) -> Psf:
        """Return the picture by one method, with what the public call reads of it; ``number`` moves the source."""
        factor = 1 + STEP * number
        source = (
            replace(self.source, wavelength_um=self.source.wavelength_um * factor)
            if isinf(self.source.depth_mm)
            else replace(self.source, depth_mm=self.source.depth_mm * factor)
        )
        if method in SAMPLED:
            return sampled_psf(method, int(quality.removesuffix("²")), self.lens, source, self.window)
        options = PsfOptions(quality, self.min_r2)
        psf = render_integrated(self.lens, source, method, *self.window, options, self.truth.integrated)
        _ = psf.caution
        return psf


def _point(
    lens: Lens,
    place: tuple[float, float, float],
    shown: tuple[int, float | None],
    min_r2: float,
    integrated: bool | None,
) -> Point:
    depth, field, wave = place
    source = Source(depth, field_deg=field, wavelength_nm=wave)
    window = shown[0], shown[1] or whole_pixel_um(lens, source, shown[0])
    name = SPHERICAL.name if worth_spherical(lens, source, False) else REFERENCE
    truth = render_integrated(lens, source, name, *window, wanted=integrated)
    return Point(lens, place, source, window, min_r2, name, truth)


def _ways(methods: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield (method, quality): every method settled, and as preview too those that have one."""
    for method in methods:
        if method == AUTO or method_of(method).previewed:
            yield method, "preview"
        yield method, "settled"


def _row(point: Point, method: str, quality: str) -> MethodCost:
    @using_threads(1)  # or another thread's block would count as memory too
    def once(number: int) -> Psf:
        return point.picture(method, quality, number)

    psf, seconds = _time_call(once)
    truth = point.truth
    depth_mm, field_deg, wavelength_nm = point.place
    return MethodCost(
        method=method,
        quality=quality,
        choice=psf.method if method == AUTO else method,
        reference=point.reference,
        aim=point.lens.aim,
        depth_mm=depth_mm,
        field_deg=field_deg,
        wavelength_nm=wavelength_nm,
        errors=compare(psf, truth),
        mtf_error=_mtf_error(psf, truth),
        numbers=psf.numbers,
        rays=psf.rays,
        seconds=seconds,
        choosing_seconds=None,
        bytes=_peak_bytes(once),
        sampling=psf.sampling,
        error=psf.error,
    )


def _with_choosing(row: MethodCost, own: float | None) -> MethodCost:
    """Return the row of "auto" with what choosing adds to the ``own`` seconds of the method that it takes."""
    if row.method != AUTO or own is None:
        return row
    return replace(row, choosing_seconds=max(0.0, row.seconds - own))


def _mtf_error(psf: Psf, truth: Psf) -> float:
    """Return the largest difference of two pictures' contrast up to their Nyquist frequency, tangential or sagittal."""
    found, wanted = mtf(psf), mtf(truth)
    pairs = (found.tangential, wanted.tangential), (found.sagittal, wanted.sagittal)
    return max(float(np.abs(one - other).max()) for one, other in pairs)


def _time_call(once: Callable[[int], Psf]) -> tuple[Psf, float]:
    """Return the result and the median CPU seconds of a call; wall-clock times depend on what else the machine does."""
    seconds: list[float] = []
    while True:
        start = process_time()
        psf = once(1 + len(seconds))
        seconds.append(process_time() - start)
        if len(seconds) >= REPEATS or sum(seconds) >= SLOW_SECONDS:
            return psf, median(seconds[1:] or seconds)


def _peak_bytes(once: Callable[[int], Psf]) -> int:
    tracing = tracemalloc.is_tracing()
    if not tracing:
        tracemalloc.start()
    tracemalloc.reset_peak()
    before = tracemalloc.get_traced_memory()[0]
    once(0)
    peak = tracemalloc.get_traced_memory()[1]
    if not tracing:
        tracemalloc.stop()
    return max(0, peak - before)


def to_json(rows: list[MethodCost]) -> str:
    """Return the rows as a JSON list; an infinite depth is null."""
    return json.dumps([_plain(row) for row in rows], indent=1, allow_nan=False)


def _plain(row: MethodCost) -> dict[str, object]:
    depth = None if isinf(row.depth_mm) else row.depth_mm
    return {**asdict(row), "depth_mm": depth, "sampling": str(row.sampling)}


def to_csv(rows: list[MethodCost]) -> str:
    """Return the rows as numbers under heads with units; an infinite depth is inf, and what is not known is empty."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow((*("method", "quality", "choice", "reference", "aim"), *(head for head, _ in NUMBERS)))
    for row in rows:
        words = row.method, row.quality, row.choice, row.reference, row.aim
        writer.writerow((*words, *(number(row) for _, number in NUMBERS)))
    return text.getvalue()


NUMBERS: tuple[tuple[str, Callable[[MethodCost], float | None]], ...] = (
    ("depth_mm", lambda row: row.depth_mm),
    ("field_deg", lambda row: row.field_deg),
    ("wavelength_nm", lambda row: row.wavelength_nm),
    ("r_squared", lambda row: row.errors.r_squared),
    ("relative_l2", lambda row: row.errors.relative_l2),
    ("mtf_error", lambda row: row.mtf_error),
    ("strehl_error", lambda row: row.errors.strehl),
    ("radius_50_error_um", lambda row: row.errors.radius_50_um),
    ("radius_80_error_um", lambda row: row.errors.radius_80_um),
    ("centroid_error_um", lambda row: row.errors.centroid_um),
    ("numbers", lambda row: row.numbers),
    ("rays", lambda row: row.rays),
    ("cpu_ms", lambda row: 1e3 * row.seconds),
    ("choosing_ms", lambda row: None if row.choosing_seconds is None else 1e3 * row.choosing_seconds),
    ("memory_kb", lambda row: row.bytes / 1e3),
)
"""The numbers of a row, with their units."""


def table(rows: list[MethodCost]) -> list[tuple[str, ...]]:
    """Return the rows as text, headings first."""
    head = ("method", "depth mm", "field °", "λ nm", "R²", "rel. L2", "MTF", "Strehl", "r50 µm", "r80 µm", "shift µm")
    return [(*head, "numbers", "rays", "ms", "choosing", "kB", "against"), *(_texts(row) for row in rows)]


def _texts(row: MethodCost) -> tuple[str, ...]:
    e = row.errors
    place = "∞" if isinf(row.depth_mm) else f"{row.depth_mm:g}", f"{row.field_deg:g}", f"{row.wavelength_nm:g}"
    r_squared = f"{e.r_squared:.4f}" if e.r_squared < 0.999 else f"1 − {1 - e.r_squared:.0e}"
    radii = f"{e.radius_50_um:+.2g}", f"{e.radius_80_um:+.2g}", f"{e.centroid_um:.2g}"
    strehl = "–" if e.strehl is None else f"{e.strehl:+.1e}"
    choosing = "" if row.choosing_seconds is None else f"{1e3 * row.choosing_seconds:.2g}"
    cost = str(row.numbers), str(row.rays), f"{1e3 * row.seconds:.3g}", choosing, f"{row.bytes / 1e3:.0f}"
    return (
        row.name,
        *place,
        r_squared,
        f"{e.relative_l2:.1e}",
        f"{row.mtf_error:.1e}",
        strehl,
        *radii,
        *cost,
        row.reference,
    )


@dataclass(frozen=True)
class Advice:
    """What to take where R² may not fall below ``least`` at any point measured: a method, None where none keeps it.

    ``seconds``: of one PSF, the mean over the points; ``worst``: the least R² of the method.
    """

    least: float
    method: str | None
    quality: str
    seconds: float
    worst: float


def advice(rows: list[MethodCost], least: Sequence[float] = LEAST) -> list[Advice]:
    """Return the fastest method that keeps each R² at all points; "auto" is left out, which takes one of them."""
    ways: dict[tuple[str, str], list[MethodCost]] = {}
    for row in rows:
        if row.method != AUTO and row.method not in SAMPLED:
            ways.setdefault((row.method, row.quality), []).append(row)
    found = []
    for limit in least:
        kept = [
            Advice(limit, method, quality, mean(row.seconds for row in some), worst)
            for (method, quality), some in ways.items()
            if (worst := min(row.errors.r_squared for row in some)) >= limit
        ]
        found.append(min(kept, key=lambda one: one.seconds) if kept else Advice(limit, None, "", inf, -inf))
    return found


def in_words(rows: list[MethodCost]) -> list[str]:
    """Return `advice` in sentences: for each R², of "auto", and for many PSFs."""
    found, places = advice(rows), len({(row.depth_mm, row.field_deg, row.wavelength_nm) for row in rows})
    where = "at this point" if places == 1 else f"at all {places} points"
    parts = []
    for one in found:
        name = f"{one.method} (preview)" if one.quality == "preview" else one.method
        took = f"take {name}, {1e3 * one.seconds:.3g} ms a PSF" if name else "none of these suffices"
        parts.append(f"for R² ≥ {one.least:g} {took}")
    lines = [f"Measured {where}: {'; '.join(parts)}."]
    own = [row for row in rows if row.method == AUTO and row.quality == "settled"]
    if own:
        took = ", ".join(dict.fromkeys(row.choice for row in own))
        worst, time = min(row.errors.r_squared for row in own), mean(row.seconds for row in own)
        lines.append(f"auto took {took}: R² {worst:.4f} or better, {1e3 * time:.3g} ms a PSF.")
    usual = next((one for one in found if one.method and one.least >= 0.99), None)
    if usual:
        lines.append(
            f"{MANY // 1000} 000 PSFs one by one take {usual.seconds * MANY:.3g} s for R² ≥ {usual.least:g}; for so "
            "many of one lens build a database (p2sf database build), which looks them up."
        )
    return lines


def front(rows: list[MethodCost]) -> list[MethodCost]:
    """Return the Pareto front, fastest first: rows that no other beats in both time and error."""
    best = inf
    out: list[MethodCost] = []
    for row in sorted(rows, key=lambda row: (row.seconds, error(row))):
        if error(row) < best:
            best = error(row)
            out.append(row)
    return out


def draw(handle: BinaryIO, rows: list[MethodCost], title: str = "") -> None:
    """Write error against time, log–log with the Pareto front marked, as a PNG into an open binary file."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.4), dpi=150, layout="constrained")
    axes = figure.add_subplot(xscale="log", yscale="log", xlabel="CPU time of one PSF, ms", ylabel="relative L2 error")
    for method, marker in zip(EVERY, cycle(MARKERS), strict=False):
        for quality, filled in (("preview", "none"), ("settled", "full")):
            some = [row for row in rows if (row.method, row.quality) == (method, quality)]
            if some:
                [line] = axes.plot(*_points(some), marker, color=f"C{EVERY.index(method)}", linestyle="none")
                line.set(fillstyle=filled, label=f"{method}, {quality}")
    for number, (method, line_style) in enumerate(zip(SAMPLED, ("-", "--", ":"), strict=True), len(EVERY)):
        some = [row for row in rows if row.method == method]
        if some:
            label = f"{method}, {some[0].quality} to {some[-1].quality}"
            axes.plot(*_points(some), marker=".", linestyle=line_style, color=f"C{number}", label=label)
    axes.plot(*_points(front(rows)), "-", color="0.5", linewidth=1, zorder=0, label="Pareto front")
    axes.set_title(title, loc="left", fontsize=9)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7)
    figure.savefig(handle, format="png")


def _points(rows: list[MethodCost]) -> tuple[list[float], list[float]]:
    return [1e3 * row.seconds for row in rows], [error(row) for row in rows]


def error(row: MethodCost) -> float:
    """Return the relative L2 error; for the reference itself, the agreement that it reached."""
    own = row.error if row.method == row.reference and row.error else 0.0
    return max(row.errors.relative_l2, own, 1e-12)
