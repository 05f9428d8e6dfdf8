"""Figures that others published, beside this program's own: what `p2sf validate` prints (published.toml has them)."""

import tomllib
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import cache
from math import floor, log10
from pathlib import Path

import numpy as np

from p2sf.conventions import NM_PER_UM, slope_from_degrees
from p2sf.figures.compare import r_squared
from p2sf.glass.catalogue import find_entry
from p2sf.glass.media import CatalogueGlass, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, with_aim, with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import abcd, cardinal_points
from p2sf.paraxial.pupils import find_stop, pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.seidel import seidel_psf
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.raytrace.pencil import displayed_opd, pencil
from p2sf.studies.listings import edges, hubble, singlet, telescope
from p2sf.studies.listings.row import ListedNumber
from p2sf.studies.paper import PIXELS, WINDOW_UM

DATA = Path(__file__).with_name("published.toml")
KINDS = {"program": "another program", "paper": "the paper's authors", "witness": "independent witness"}
LISTED = 32  # points along a side of a listed wavefront
AGREES, EXPLAINED, DIFFERS = "agrees", "explained", "differs, unexplained"
LISTINGS = singlet, hubble, telescope, edges


@dataclass(frozen=True)
class Published:
    """One published figure: what it is, of which lens, who says so, and the largest difference that is agreement.

    ``why`` says where the tolerance comes from. ``measure`` names the function of `MEASURES`; "" with ``waits_for``,
    what this program lacks. The others say what of the shipped lens is replaced: ``glasses`` by label, all ``indices``
    at this wavelength, the ``last_radius``, the ``f_number``, the ``stop_semi_diameter``, mm, and the ``inner_radii``
    by surface. ``file``: the lens's, beside this module, where it is not a shipped one. ``pixels`` and ``pixel_um``:
    the samples among which the highest is looked for. ``group``: of the rows that are told together.
    ``explained``: why the two differ by more than the tolerance, and ``within``: the most that this accounts for.
    """

    quantity: str
    lens: str
    value: float
    unit: str
    tolerance: float
    why: str
    source: str
    kind: str
    measure: str = ""
    waits_for: str = ""
    wavelength_nm: float = 0.0
    field_deg: float = 0.0
    f_number: float | None = None
    last_radius: float | None = None
    azimuth_deg: float = 0.0
    pixels: int = 64
    pixel_um: float = 0.289
    file: str = ""
    stop_semi_diameter: float | None = None
    inner_radii: dict[str, float] | None = None
    glasses: dict[str, str] | None = None
    indices: tuple[float, ...] = ()
    row: int = 0
    column: int = 0
    group: str = ""
    explained: str = ""
    within: float = 0.0

    @property
    def wavelength_um(self) -> float:
        """Return the wavelength, µm."""
        return self.wavelength_nm / NM_PER_UM

    @property
    def point(self) -> Source:
        """Return the point source at infinity that the figure is about."""
        return Source(field_slope=float(slope_from_degrees(self.field_deg)), wavelength_um=self.wavelength_um)


@dataclass(frozen=True)
class Comparison:
    """A published figure beside this program's own; ``ours`` and ``difference`` are None where it cannot compute it."""

    published: Published
    ours: float | None

    @property
    def difference(self) -> float | None:
        """Return ours less theirs."""
        return None if self.ours is None else self.ours - self.published.value

    @property
    def verdict(self) -> str:
        """Return `AGREES`, `DIFFERS`, or what the figure waits for."""
        if self.difference is None:
            return f"waits for {self.published.waits_for}"
        if abs(self.difference) <= self.published.tolerance:
            return AGREES
        known = self.published.explained and abs(self.difference) <= self.published.within
        return EXPLAINED if known else DIFFERS


@cache
def published_figures() -> tuple[Published, ...]:
    """Return the published figures in the order of the file."""
    tables = tomllib.loads(DATA.read_text(encoding="utf-8"))["figure"]
    return tuple(Published(**{**table, "indices": tuple(table.get("indices", ()))}) for table in tables)


def compare(figure: Published) -> Comparison:
    """Return one figure beside this program's own."""
    if figure.waits_for:
        return Comparison(figure, None)
    return Comparison(figure, float(MEASURES[figure.measure](figure, lens_of(figure))))


def validation() -> tuple[Comparison, ...]:
    """Return every published figure, and every number of the listings, beside this program's own."""
    return *map(compare, published_figures()), *listed_figures()


@cache
def listed_figures() -> tuple[Comparison, ...]:
    """Return every number of the listings of other programs beside this program's own."""
    return tuple(comparison_of(row) for listing in LISTINGS for row in listing.rows())


def comparison_of(row: ListedNumber) -> Comparison:
    """Return a listed number beside this program's own."""
    numbers = row.quantity, row.lens, row.listed, row.unit, row.tolerance, row.why, row.source, "program"
    figure = Published(*numbers, group=f"{row.lens}: {row.group}", explained=row.explained, within=row.within)
    return Comparison(figure, row.ours)


@dataclass(frozen=True)
class Group:
    """Rows that are told together: how many there are, agree and are explained, and the largest use of a tolerance.

    ``worst``: the largest difference over its tolerance among those that agree.
    """

    name: str
    source: str
    rows: int
    agree: int
    explained: int
    worst: float

    @property
    def verdict(self) -> str:
        """Return `AGREES`, `EXPLAINED` where some of the rows are, or `DIFFERS`."""
        if self.agree + self.explained < self.rows:
            return DIFFERS
        return EXPLAINED if self.explained else AGREES


def groups(rows: tuple[Comparison, ...]) -> tuple[Group, ...]:
    """Return the groups of the listed rows, in their order."""
    found: dict[str, list[Comparison]] = {}
    for row in rows:
        if row.published.group:
            found.setdefault(row.published.group, []).append(row)
    return tuple(_group(name, some) for name, some in found.items())


def _group(name: str, rows: list[Comparison]) -> Group:
    verdicts = [row.verdict for row in rows]
    shares = [_share(row) for row in rows if row.verdict == AGREES]
    counts = len(rows), verdicts.count(AGREES), verdicts.count(EXPLAINED)
    return Group(name, rows[0].published.source, *counts, max(shares, default=0.0))


def _share(row: Comparison) -> float:
    """Return how much of its tolerance a difference takes."""
    return abs(row.difference or 0.0) / (row.published.tolerance or 1.0)


GROUP_COLUMNS = ("listing", "source", "rows", "agree", "explained", "most of a tolerance", "verdict")


def group_lines(found: tuple[Group, ...]) -> list[tuple[str, ...]]:
    """Return the groups in words, a line each, as `GROUP_COLUMNS` names them."""
    return [
        (one.name, one.source, f"{one.rows}", f"{one.agree}", f"{one.explained}", f"{one.worst:.0%}", one.verdict)
        for one in found
    ]


def explanations(rows: tuple[Comparison, ...]) -> dict[str, int]:
    """Return each explanation of a difference → how many rows it stands for."""
    found: dict[str, int] = {}
    for row in rows:
        if row.verdict == EXPLAINED:
            found[row.published.explained] = found.get(row.published.explained, 0) + 1
    return found


def lens_of(figure: Published) -> Lens:
    """Return the lens a figure is about; rays fill its paraxial entrance pupil, as in the other programs' defaults."""
    lens = with_aim(find_lens(DATA.with_name(figure.file) if figure.file else figure.lens), "paraxial")
    for number, radius in (figure.inner_radii or {}).items():
        holed = list(lens.surfaces)
        holed[int(number) - 1] = replace(holed[int(number) - 1], inner_radius=radius)
        lens = replace(lens, surfaces=tuple(holed))
    if figure.stop_semi_diameter is not None:
        lens = replace(lens, aperture=Aperture("stop_semi_diameter", figure.stop_semi_diameter))
    for label, other in (figure.glasses or {}).items():
        glass = CatalogueGlass(find_entry(other))
        surfaces = (replace(s, medium=glass) if s.medium.label == label else s for s in lens.surfaces)
        lens = replace(lens, surfaces=tuple(surfaces))
    if figure.indices:
        media = map(ConstantIndex, figure.indices[1:])
        surfaces = (replace(s, medium=medium) for s, medium in zip(lens.surfaces, media, strict=True))
        lens = replace(lens, surfaces=tuple(surfaces), object_medium=ConstantIndex(figure.indices[0]))
    if figure.last_radius is not None:
        lens = replace(lens, surfaces=(*lens.surfaces[:-1], replace(lens.surfaces[-1], radius=figure.last_radius)))
    return lens if figure.f_number is None else with_f_number(lens, figure.f_number)


def focal_length(figure: Published, lens: Lens) -> float:
    """Return the effective focal length, mm."""
    return float(cardinal_points(lens, figure.wavelength_um).effective_focal_length)


def front_focal_plane(figure: Published, lens: Lens) -> float:
    """Return where the front focal plane lies, mm to the right of the first vertex."""
    return float(cardinal_points(lens, figure.wavelength_um).front_focal_distance)


def entrance_pupil(figure: Published, lens: Lens) -> float:
    """Return where the entrance pupil lies, mm to the right of the first vertex."""
    stop = find_stop(lens, figure.point.depth_mm, figure.wavelength_um)
    return float(pupils(lens, figure.wavelength_um, stop).entrance_from_first)


def system_matrix(figure: Published, lens: Lens) -> float:
    """Return one element of the matrix of reduced angles, first to last vertex."""
    return float(abcd(lens, figure.wavelength_um)[figure.row, figure.column])


def rms_with_tilt(figure: Published, lens: Lens) -> float:
    """Return the RMS of the wavefront about its mean on the chief ray's sphere, waves; tilt counts, rims do not."""
    return zernike_fit(lens, figure.point).rms_with_tilt


def chief_ray(figure: Published, lens: Lens) -> float:
    """Return the height of the exact chief ray on the sensor, mm."""
    return float(pencil(lens, figure.point, [0.0], [0.5]).chief_y[0])


def r_squared_of_seidel(figure: Published, lens: Lens) -> float:
    """Return R² of the PSF of the six coefficients against the Huygens sum, in the paper's window."""
    window = PIXELS, WINDOW_UM / PIXELS
    source = figure.point
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return r_squared(seidel_psf(six, *window).values, huygens_psf(lens, source, *window).values)


def strehl(figure: Published, lens: Lens) -> float:
    """Return the highest sample of the Huygens sum over the unaberrated peak; rims and holes end the pupil.

    The highest of their samples is what the listings state, not that of the continuous picture.
    """
    samples = huygens_psf(lens, figure.point, figure.pixels, figure.pixel_um, clip=True).over_unaberrated
    return float("nan") if samples is None else float(samples.max())


def rms_with_tilt_of_listed_points(figure: Published, lens: Lens) -> float:
    """Return the RMS of the wavefront about its mean over the 32 × 32 points of a listing, waves; tilt counts.

    Sample (row, column) is the pupil point (column − 16, row − 16)/15; rims and holes block. Where the field lies off
    the plane ξ = 0 the points are seen turned.
    """
    centre = (np.arange(LISTED) - LISTED // 2) / (LISTED // 2 - 1)
    xi, eta = (x.ravel() for x in np.meshgrid(centre, centre))
    inside = xi**2 + eta**2 <= 1
    turn = np.deg2rad(figure.azimuth_deg)
    xi, eta = xi * np.cos(turn) - eta * np.sin(turn), eta * np.cos(turn) + xi * np.sin(turn)
    xi, eta = xi[inside], eta[inside]
    passed = pencil(lens, figure.point, xi, eta, clip=True).passed
    return float(displayed_opd(lens, figure.point, xi[passed], eta[passed]).std())


MEASURES: dict[str, Callable[[Published, Lens], float]] = {
    "focal_length": focal_length,
    "front_focal_plane": front_focal_plane,
    "entrance_pupil": entrance_pupil,
    "abcd": system_matrix,
    "rms_with_tilt": rms_with_tilt,
    "chief_ray": chief_ray,
    "r_squared_of_seidel": r_squared_of_seidel,
    "strehl": strehl,
    "rms_with_tilt_of_listed_points": rms_with_tilt_of_listed_points,
}
COLUMNS = ("quantity", "lens", "theirs", "source", "ours", "difference", "tolerance", "verdict")


def lines(rows: tuple[Comparison, ...]) -> list[tuple[str, ...]]:
    """Return the table in words, a line per figure, as `COLUMNS` names them."""
    return [
        (
            row.published.quantity,
            row.published.lens,
            _format_figure(row.published.value, row.published),
            f"{row.published.source} ({KINDS[row.published.kind]})",
            "–" if row.ours is None else _format_figure(row.ours, row.published),
            "–" if row.difference is None else f"{row.difference:.0e}",
            f"{row.published.tolerance:.0e}",
            row.verdict,
        )
        for row in rows
    ]


def reasons(rows: tuple[Comparison, ...]) -> dict[str, str]:
    """Return each reason for a tolerance → the tolerances it stands for, from the smallest."""
    found: dict[str, set[float]] = {}
    for row in rows:
        found.setdefault(row.published.why, set()).add(row.published.tolerance)
    return {why: ", ".join(f"{size:.0e}" for size in sorted(sizes)) for why, sizes in found.items()}


def _format_figure(value: float, figure: Published) -> str:
    """Return a value to the digit that the tolerance decides, with its unit."""
    return f"{value:.{max(-floor(log10(figure.tolerance)), 0)}f} {figure.unit}".strip()


def markdown(rows: tuple[Comparison, ...]) -> str:
    """Return single figures as the handbook has them: without differences, which round-off changes by the machine."""
    single = tuple(row for row in rows if not row.published.group)
    return _markdown(COLUMNS, lines(single), "difference")


def markdown_of_groups(rows: tuple[Comparison, ...]) -> str:
    """Return the groups as the handbook has them, without what round-off changes from machine to machine."""
    return _markdown(GROUP_COLUMNS, group_lines(groups(rows)), "most of a tolerance")


def _markdown(columns: tuple[str, ...], told: list[tuple[str, ...]], left_out: str) -> str:
    shown = [k for k, name in enumerate(columns) if name != left_out]
    cells = [columns, ("---",) * len(columns), *told]
    return "".join("| " + " | ".join(line[k] for k in shown) + " |\n" for line in cells)


def record(row: Comparison) -> dict:
    """Return one row as JSON carries it."""
    return {**asdict(row.published), "ours": row.ours, "difference": row.difference, "verdict": row.verdict}
