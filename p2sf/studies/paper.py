"""The plots of results of the paper (Pieroni et al. 2015, section 3) on this machine, and a verdict on each claim."""

from collections.abc import Callable
from dataclasses import asdict
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, BinaryIO

from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.figures.compare import r_squared
from p2sf.glass.media import AIR
from p2sf.lens.lens import AIMS, Lens, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.pupils import find_stop, pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.gaussian_fit import gaussian_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.result import Psf
from p2sf.psf.seidel import seidel_psf
from p2sf.psf.traced import traced_psf
from p2sf.studies.paper_claims import (
    STAGES,
    defocus_claim,
    gaussian_claim,
    memory_claim,
    off_axis_claim,
    speed_claim,
    time_claim,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LENS, FIELDS_DEG, WAVELENGTH_NM = "double_gauss_28", (0.0, 10.0, 14.0), 656.3
PIXELS, WINDOW_UM = 32, 22.12
REPEATS = 31
DEPTH_MM = 1e4  # of the timed stages: finite, so that no branch is spared


def paper_figures(progress: Callable[[float], None] = lambda done: None) -> dict:
    """Return the numbers of both figures, ``timing`` per lens, ``accuracy`` per aim and field, and the ``claims``."""
    names = shipped_lenses()
    timing = []
    for number, name in enumerate(names):
        timing.append(stage_times(find_lens(name)))
        progress(0.6 * (number + 1) / len(names))
    accuracy = [fidelity(with_aim(find_lens(LENS), aim), field) for aim in AIMS for field in FIELDS_DEG]
    lens = with_aim(find_lens(LENS), "paraxial")  # the pupil of the paper
    progress(0.8)
    paraxial = [row for row in accuracy if row["aim"] == lens.aim]
    claims = (
        time_claim(timing),
        speed_claim(*(min(row["seconds"][name] for row in accuracy) for name in ("seidel", "huygens"))),
        memory_claim(lens, WAVELENGTH_NM, PIXELS),
        defocus_claim(lens, WAVELENGTH_NM),
        gaussian_claim(paraxial),
        off_axis_claim(paraxial),
    )
    progress(1.0)
    return {
        "lens": LENS,
        "wavelength_nm": WAVELENGTH_NM,
        "pixels": PIXELS,
        "window_um": WINDOW_UM,
        "timing": sorted(timing, key=lambda row: row["elements"]),
        "accuracy": accuracy,
        "claims": [asdict(claim) for claim in claims],
    }


def elements(lens: Lens) -> int:
    """Return how many refracting elements a lens has: stretches of anything but air between two surfaces."""
    return sum(medium != AIR for medium in lens.media[1:-1])


def stage_times(lens: Lens) -> dict:
    """Return the median seconds of the paper's three stages for one source of a lens."""
    wavelength, slope = lens.reference_wavelength_um, slope_from_degrees(lens.widest_field_deg)
    stop = find_stop(lens, DEPTH_MM, wavelength)

    def shift_invariant() -> object:
        return cardinal_points(lens, wavelength), image_distance(lens, DEPTH_MM, wavelength)

    def quasi_invariant() -> object:
        return pupils(lens, wavelength, find_stop(lens, DEPTH_MM, wavelength, "auto"))

    def spatially_variant() -> object:
        return coefficients(lens, DEPTH_MM, slope, wavelength, stop)

    seconds = (_median_seconds(stage) for stage in (shift_invariant, quasi_invariant, spatially_variant))
    return {"lens": lens.name, "elements": elements(lens), **dict(zip(STAGES, seconds, strict=True))}


def _median_seconds(work: Callable[[], object]) -> float:
    def once() -> float:
        started = perf_counter()
        work()
        return perf_counter() - started

    once()
    return median(once() for _ in range(REPEATS))


def fidelity(lens: Lens, field_deg: float) -> dict:
    """Return R² against the settled Huygens sum, for every method at one field of the paper's comparison."""
    reference, made = psfs(lens, field_deg)
    scores = {name: r_squared(psf.values, reference.values) for name, psf in made.items()}
    seconds = {"seidel": made["seidel"].seconds, "huygens": reference.seconds}
    return {
        "aim": lens.aim,
        "field_deg": field_deg,
        "reference_tolerance": reference.error,
        "r_squared": scores,
        "seconds": seconds,
    }


def psfs(lens: Lens, field_deg: float) -> tuple[Psf, dict[str, Psf]]:
    """Return the Huygens reference and the PSF of every method, 32 × 32 samples over 22.12 µm, as the lens is aimed."""
    source = Source(field_slope=float(slope_from_degrees(field_deg)), wavelength_um=WAVELENGTH_NM / NM_PER_UM)
    window = PIXELS, WINDOW_UM / PIXELS
    reference = huygens_psf(lens, source, *window)
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return reference, {
        "gaussian": gaussian_psf(reference),
        "seidel": seidel_psf(six, *window),
        "fitted, 26 numbers": fitted_psf(lens, source, *window, numbers=26),
        "fitted, 46 numbers": fitted_psf(lens, source, *window, numbers=46),
        "traced": traced_psf(lens, source, *window),
    }


def draw_timing(handle: BinaryIO, figures: dict) -> None:
    """Write the stage times as a PNG into an open binary file, against the number of refracting elements."""
    figure, axes = _page("refracting elements", "median time of one source, µs")
    for stage, marker in zip(STAGES, "osD", strict=True):
        found = [(row["elements"], 1e6 * row[stage]) for row in figures["timing"]]
        axes.plot(*zip(*found, strict=True), marker, label=stage, alpha=0.8)
    axes.set_ylim(bottom=0)
    axes.set_title(f"{len(figures['timing'])} shipped lenses, this machine", loc="left", fontsize=9)
    _save(figure, axes, handle)


def draw_accuracy(handle: BinaryIO, figures: dict) -> None:
    """Write R² as a PNG into an open binary file: every method against field, the real stop dashed."""
    figure, axes = _page("field, °", "R² against the Huygens sum")
    for aim, line in (("paraxial", "-"), ("stop", "--")):
        rows = [row for row in figures["accuracy"] if row["aim"] == aim]
        for number, (name, marker) in enumerate(zip(rows[0]["r_squared"], "sovDx", strict=True)):
            points = [row["field_deg"] for row in rows], [row["r_squared"][name] for row in rows]
            axes.plot(*points, marker + line, color=f"C{number}", label=f"{name}, {aim}")
    axes.axhline(0, color="black", linewidth=0.6)
    grid = f"{figures['pixels']} × {figures['pixels']} samples over {figures['window_um']} µm"
    axes.set_title(f"{figures['lens']}, {figures['wavelength_nm']} nm, {grid}", loc="left", fontsize=9)
    _save(figure, axes, handle)


def _page(x: str, y: str) -> "tuple[Figure, Axes]":
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.4), dpi=150, layout="constrained")
    axes = figure.add_subplot(xlabel=x, ylabel=y)
    axes.grid(alpha=0.3)
    return figure, axes


def _save(figure: "Figure", axes: "Axes", handle: BinaryIO) -> None:
    axes.legend(fontsize=8)
    figure.savefig(handle, format="png")
