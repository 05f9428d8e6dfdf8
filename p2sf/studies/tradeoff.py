"""What each method costs in time and in error, measured on this machine: as a table, a plot and JSON."""

import json
import tracemalloc
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from itertools import cycle, product
from math import inf, isinf
from statistics import median
from time import process_time
from typing import BinaryIO

from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, number_list
from p2sf.figures.compare import Errors, compare
from p2sf.html import html_table
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.parameters import check_angle, check_samples
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import NAMES, REFERENCE, PsfOptions, method_of, render
from p2sf.psf.result import Psf
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.raytrace.focusing import object_distance
from p2sf.setting import AS_IN_FILE, AimChoice, CameraData, set_up_source, with_camera
from p2sf.studies.other_sampling import SAMPLED, check_sampling, sampled_psf, sampled_ways
from p2sf.studies.trade_plots import MARKERS
from p2sf.threads import one_blas_thread, using_threads

PIXELS = 64
REPEATS = 9
SLOW_SECONDS = 0.5  # a method this slow is timed once


@dataclass(frozen=True)
class MethodCost:
    """One method at one point: its errors, the numbers and rays it takes, median CPU seconds and peak memory."""

    method: str
    quality: str
    aim: str
    depth_mm: float
    field_deg: float
    wavelength_nm: float
    errors: Errors
    numbers: int
    rays: int
    seconds: float
    bytes: int
    sampling: Message
    error: float | None


class TradeoffTable(list[MethodCost]):
    """Result of `tradeoff`: a list of rows that prints as a table."""

    def __repr__(self) -> str:
        lines = table(self)
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        return "\n".join("  ".join(map(str.ljust, line, widths)).rstrip() for line in lines)

    def _repr_html_(self) -> str:
        head, *rows = table(self)
        return html_table("Each method against the Huygens sum", head, rows)


@one_blas_thread
@check_arguments
@with_camera
def tradeoff(
    lens: Lens,
    *,
    depths_mm: ArrayLike | None = None,
    fields_deg: ArrayLike | None = None,
    wavelengths_nm: ArrayLike | None = None,
    methods: str | Sequence[str] = NAMES,
    pixels: int = PIXELS,
    pixel_um: float | None = None,
    samplings: ArrayLike = (),
    camera: CameraData = AS_IN_FILE,
    aim: AimChoice | None = None,
) -> TradeoffTable:
    """Measure the time of each method and its error against the settled Huygens sum of exact rays.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    depths_mm : array_like, optional
        Object distances from the first vertex, mm; by default that of the lens's object.
    fields_deg, wavelengths_nm : array_like, optional
        Field angles, degrees, and wavelengths, nm; by default the fields and the reference wavelength of the lens.
    methods : str or sequence of str
        One method, or several.
    pixels : int
        Samples along each side of the compared window.
    pixel_um : float, optional
        Distance between samples, µm; by default one that shows the whole PSF.
    samplings : array_like of int, optional
        Points along a side of the pupil's grid for OpticStudio's Huygens sum, a plain FFT of exact rays and the paper's
        FFT, which are measured beside the methods; by default none. The first two fill the paraxial entrance pupil:
        with ``aim="paraxial"`` the reference does so too, and their errors are those of sampling alone.
    camera, aim
        As for `render`; the stop "auto" is that at the first depth.

    Returns
    -------
    TradeoffTable
        A list with one row per point, method and quality: errors, numbers, rays, CPU seconds, peak memory in bytes.

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
        depth, field, wave = place
        source = Source(depth, field_deg=field, wavelength_nm=wave)
        window = pixels, pixel_um or _pitch(lens, source, pixels)
        reference = huygens_psf(lens, source, *window)
        if not rows:
            # Untimed, since a first call loads libraries and tables; the reference has just had its own.
            for way in _ways(set(methods) - {REFERENCE}):
                _point_of_trade(lens, source, window, reference, *way)
        ways = *_ways(methods), *sampled_ways(counts, pixels)
        rows += [_row(lens, source, window, place, reference, *way) for way in ways]
    return rows


def _pitch(lens: Lens, source: Source, pixels: int) -> float:
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return float(suitable_pixel_um(c, pixels))


def _ways(methods: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield (method, quality): every method settled, and as preview too those that have one."""
    for method in methods:
        if method_of(method).previewed:
            yield method, "preview"
        yield method, "settled"


def _row(
    lens: Lens,
    source: Source,
    window: tuple[int, float],
    place: tuple[float, float, float],
    reference: Psf,
    method: str,
    quality: str,
) -> MethodCost:
    @using_threads(1)  # or another thread's block would count as memory too
    def once() -> Psf:
        return _point_of_trade(lens, source, window, reference, method, quality)

    psf, seconds = _time_call(once)
    depth_mm, field_deg, wavelength_nm = place
    return MethodCost(
        method=method,
        quality=quality,
        aim=lens.aim,
        depth_mm=depth_mm,
        field_deg=field_deg,
        wavelength_nm=wavelength_nm,
        errors=compare(psf, reference),
        numbers=psf.numbers,
        rays=psf.rays,
        seconds=seconds,
        bytes=_peak_bytes(once),
        sampling=psf.sampling,
        error=psf.error,
    )


def _point_of_trade(
    lens: Lens, source: Source, window: tuple[int, float], reference: Psf, method: str, quality: str
) -> Psf:
    if method in SAMPLED:
        return sampled_psf(method, int(quality.removesuffix("²")), lens, source, window)
    derived = method_of(method).of_reference
    return derived(reference) if derived else render(lens, source, method, *window, PsfOptions(quality))


def _time_call(once: Callable[[], Psf]) -> tuple[Psf, float]:
    """Return the result and the median CPU seconds of a call; wall-clock times depend on what else the machine does."""
    seconds: list[float] = []
    while True:
        start = process_time()
        psf = once()
        seconds.append(process_time() - start)
        if len(seconds) >= REPEATS or sum(seconds) >= SLOW_SECONDS:
            return psf, median(seconds[1:] or seconds)


def _peak_bytes(once: Callable[[], Psf]) -> int:
    tracing = tracemalloc.is_tracing()
    if not tracing:
        tracemalloc.start()
    tracemalloc.reset_peak()
    before = tracemalloc.get_traced_memory()[0]
    once()
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


def table(rows: list[MethodCost]) -> list[tuple[str, ...]]:
    """Return the rows as text, headings first."""
    head = ("method", "depth mm", "field °", "λ nm", "R²", "rel. L2", "Strehl", "r50 µm", "r80 µm", "shift µm")
    return [(*head, "numbers", "rays", "ms", "kB"), *(_texts(row) for row in rows)]


def _texts(row: MethodCost) -> tuple[str, ...]:
    e = row.errors
    place = "∞" if isinf(row.depth_mm) else f"{row.depth_mm:g}", f"{row.field_deg:g}", f"{row.wavelength_nm:g}"
    r_squared = f"{e.r_squared:.4f}" if e.r_squared < 0.999 else f"1 − {1 - e.r_squared:.0e}"
    radii = f"{e.radius_50_um:+.2g}", f"{e.radius_80_um:+.2g}", f"{e.centroid_um:.2g}"
    strehl = "–" if e.strehl is None else f"{e.strehl:+.1e}"
    cost = str(row.numbers), str(row.rays), f"{1e3 * row.seconds:.3g}", f"{row.bytes / 1e3:.0f}"
    name = row.method if row.quality == "settled" else f"{row.method} ({row.quality})"
    return name, *place, r_squared, f"{e.relative_l2:.1e}", strehl, *radii, *cost


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
    for method, marker in zip(NAMES, cycle(MARKERS), strict=False):
        for quality, filled in (("preview", "none"), ("settled", "full")):
            some = [row for row in rows if (row.method, row.quality) == (method, quality)]
            if some:
                [line] = axes.plot(*_points(some), marker, color=f"C{NAMES.index(method)}", linestyle="none")
                line.set(fillstyle=filled, label=f"{method}, {quality}")
    for number, (method, line_style) in enumerate(zip(SAMPLED, ("-", "--", ":"), strict=True), len(NAMES)):
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
    own = row.error if row.method == REFERENCE and row.error else 0.0
    return max(row.errors.relative_l2, own, 1e-12)
