"""What every method costs in time and in error, measured on this machine: one table, one picture, one JSON."""

import json
import tracemalloc
from dataclasses import asdict, dataclass
from itertools import product
from math import inf, isinf
from statistics import median
from time import process_time

from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.compare import Errors, compare
from p2sf.psf.gaussian_fit import gaussian_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import METHODS, render
from p2sf.psf.result import Psf
from p2sf.psf.seidel import suitable_pixel_um

PIXELS = 64
REPEATS = 9
SLOW_SECONDS = 0.5  # a method this slow is timed once


@dataclass(frozen=True)
class MethodCost:
    """One method at one point: its errors, numbers and rays used, median CPU seconds and peak memory of a call."""

    method: str
    quality: str
    depth_mm: float
    field_deg: float
    wavelength_nm: float
    errors: Errors
    numbers: int
    rays: int
    seconds: float
    bytes: int
    sampling: str
    tolerance: float | None


def tradeoff(
    lens: Lens,
    fields_deg=None,
    depths_mm=(inf,),
    wavelengths_nm=None,
    methods=METHODS,
    pixels: int = PIXELS,
    pixel_um: float | None = None,
) -> list[MethodCost]:
    """Return a row per (depth, field, wavelength) and method, each against the settled Huygens sum at that point.

    Fields and wavelengths default to the lens file's. `fitted` and `traced` have a second row for their preview. The
    window is the one that shows the whole PSF of the six coefficients unless ``pixel_um`` is given.
    """
    fields = lens.fields_deg if fields_deg is None else fields_deg
    waves = (lens.reference_wavelength_um * NM_PER_UM,) if wavelengths_nm is None else wavelengths_nm
    rows = []
    for depth, field, wave in product(depths_mm, fields, waves):
        source = Source(float(depth), float(slope_from_degrees(field)), wave / NM_PER_UM)
        window = pixels, pixel_um or _window(lens, source, pixels)
        reference = huygens_psf(lens, source, *window)
        place = float(depth), float(field), float(wave)
        if not rows:
            for way in _ways(set(methods) - {"huygens"}):  # the reference has just been summed that way
                _made(lens, source, window, reference, *way)  # untimed: the first call loads libraries and tables
        rows += [_row(lens, source, window, place, reference, *way) for way in _ways(methods)]
    return rows


def _window(lens: Lens, source: Source, pixels: int) -> float:
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return float(suitable_pixel_um(c, pixels))


def _ways(methods):
    """Yield (method, quality): every method settled, those with a live form as preview too."""
    for method in methods:
        if method in ("seidel", "fitted", "traced"):
            yield method, "preview"
        yield method, "settled"


def _row(lens, source, window, place, reference: Psf, method: str, quality: str) -> MethodCost:
    def once() -> Psf:
        return _made(lens, source, window, reference, method, quality)

    psf, seconds = _timed(once)
    errors = compare(psf, reference)
    counts = psf.numbers, psf.rays, seconds, _peak_bytes(once)
    return MethodCost(method, quality, *place, errors, *counts, psf.sampling, psf.tolerance)


def _made(lens, source, window, reference: Psf, method: str, quality: str) -> Psf:
    if method == "gaussian":
        return gaussian_psf(reference)
    return render(lens, source, method, *window, quality)


def _timed(once):
    """Return the result and the median CPU seconds of a call; the wall clock of a shared machine says little."""
    psf, seconds = None, []
    while len(seconds) < REPEATS and sum(seconds) < SLOW_SECONDS:
        start = process_time()
        psf = once()
        seconds.append(process_time() - start)
    return psf, median(seconds[1:] or seconds)


def _peak_bytes(once) -> int:
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
    plain = [{**asdict(row), "depth_mm": None if isinf(row.depth_mm) else row.depth_mm} for row in rows]
    return json.dumps(plain, indent=1, allow_nan=False)


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
    """Return the Pareto front, by time: rows that no other beats in both time and error."""
    best, out = inf, []
    for row in sorted(rows, key=lambda row: (row.seconds, error(row))):
        if error(row) < best:
            best = error(row)
            out.append(row)
    return out


def draw(handle, rows: list[MethodCost], title: str = "") -> None:
    """Write time against error, log–log with the Pareto front marked, as a PNG into an open binary file."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.4), dpi=150, layout="constrained")
    axes = figure.add_subplot(xscale="log", yscale="log", xlabel="CPU time of one PSF, ms", ylabel="relative L2 error")
    for method, marker in zip(METHODS, "vosD^", strict=True):
        for quality, filled in (("preview", "none"), ("settled", "full")):
            some = [row for row in rows if (row.method, row.quality) == (method, quality)]
            style = {"fillstyle": filled, "linestyle": "none", "label": f"{method}, {quality}"}
            if some:
                axes.plot(*_points(some), marker, color=f"C{METHODS.index(method)}", **style)
    axes.plot(*_points(front(rows)), "-", color="0.5", linewidth=1, zorder=0, label="Pareto front")
    axes.set_title(title, loc="left", fontsize=9)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7)
    FigureCanvasAgg(figure).print_png(handle)


def _points(rows: list[MethodCost]):
    return [1e3 * row.seconds for row in rows], [error(row) for row in rows]


def error(row: MethodCost) -> float:
    """Return the relative L2 error; of the reference itself, the agreement that it reached."""
    own = row.tolerance if row.method == "huygens" and row.tolerance else 0.0
    return max(row.errors.relative_l2, own, 1e-12)
