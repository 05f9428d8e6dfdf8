"""Every figure on every road that shows it, and against the referee: ``python -m tests.long.every_road``.

Every shipped lens × 3 fields × {∞, a near depth with the sensor focused on it}, at the middle wavelength: spot RMS,
Strehl ratio, R80 and the MTF at two frequencies by every method that has them, from the library, from the command line
in this process and as panels of the window print them; for every lens what one error of each kind adds to the RMS of
the worst field. One line for each figure: what the referee finds (`tests.support.rays`), what
the library says, and every road that says anything else in the digits that it shows.

Exact rays, traced and huygens, and what single errors of a lens add, are within 1e-4 of the referee; the PSFs of a fit
and of the six coefficients are within the 1 − R² that they predict. Strehl ratios are those of windows that show all
light. Wave figures are left out where a wavefront is too steep for dense sums, and MTF and R80 where rays from
different parts of the pupil arrive in one direction. Then every lens is written in other ways (travel in breaks, folds,
a tilt of the whole, all but the stop decentred): figures of exact rays and sums of waves agree to 1e-7, R80 as well as
the referee's, and PSFs by a fit and by ``auto`` are within the 1 − R² that they state. ``--quick``: three lenses and
two fields, without tolerances.
``--keep FOLDER`` keeps what the referee finds. Exit code 1 if anything differs.
"""

import argparse
import json
import os
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from itertools import chain, product
from math import inf
from pathlib import Path
from time import process_time

import numpy as np

import p2sf
from p2sf.camera import Camera
from p2sf.errors import P2SFError
from p2sf.figures.spot import spot
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.lensfile.library import shipped_lenses
from p2sf.psf.methods import whole_pixel_um
from p2sf.raytrace.field_geometry import cone
from p2sf.setting import set_up_source
from p2sf.tolerance.criteria import harms
from p2sf.tolerance.differentials import differentials, usual_sources
from p2sf.tolerance.errors_of_build import Tolerance, usual_tolerances
from p2sf.tolerance.files import back_focus, with_compensators
from p2sf.tolerance.single import sensitivities
from tests.support.depths import NEAR_MM, RELAYS_MM, WIDEST_DEG
from tests.support.lenses.rewritten import WAYS, Written
from tests.support.pupil_sums import LostRays
from tests.support.rays.perturbed_rays import harm, worst_rms
from tests.support.rays.ray_figures import RayFigures, ray_figures
from tests.support.roads import (
    EXACT,
    METHODS,
    Point,
    Shown,
    Window,
    command_line_spot,
    each_road,
    harms_in_the_window,
    harms_on_the_command_line,
    library_spot,
    one_computation,
    pitches_um,
)

QUICK = "cooke_triplet", "petzval", "cassegrain_f10"
FIELDS, QUICK_FIELDS = (0.0, 0.7, 1.0), (0.0, 0.7)
FREQUENCIES = 0.04, 0.15  # of the cut-off 2NA/λ
EXACTLY = 1e-4  # of a ratio or of a contrast, and relative of a radius
SAMPLES = 48  # a side, of PSFs that are compared
STEEP = 12.0  # waves per pupil radius: beyond, windows are not made to show all light
ROOM = 4.0  # of λ/NA, around the landing points of a window that shows all light
STEEPEST = 300.0  # beyond, there are no sums of waves
GRIDS_AGREE = 3e-3  # between the referee's two grids, whose extrapolation is some thirty times better
FITTED = 2e-5  # waves, of the referee's pupil
KINDS = "thickness", "radius", "index", "decentre_y", "tilt_x", "irregularity"
WRITTEN_ALIKE = 1e-7  # relative, between the same optics written in two ways
FINEST_UM = 1e-6  # of a spot without aberration, which is rounding of rays
HARM, OF_RMS = 1e-4, 5e-5  # relative, and of the lens's own RMS, of which a harm is a difference


@dataclass
class Truth:
    """What the referee says of a point; NaN where it says nothing. ``slope``: waves per pupil radius."""

    slope: float
    spot_rms_um: float
    rms_waves: float
    strehl: float = np.nan
    radius_80_um: float = np.nan
    sagittal: tuple[float, ...] = ()
    tangential: tuple[float, ...] = ()
    why_not: str = ""

    def of(self, figure: str) -> float:
        """Return a figure by the name that roads give it."""
        if figure[0] in "ST" and figure[1:].isdigit():
            values = {"S": self.sagittal, "T": self.tangential}[figure[0]]
            return values[int(figure[1:]) - 1] if values else np.nan
        return {"spot RMS": self.spot_rms_um, "Strehl": self.strehl, "R80": self.radius_80_um}[figure]


@dataclass(frozen=True)
class Row:
    """One line of the table; ``faults`` says what differs."""

    where: str
    figure: str
    method: str
    referee: float
    library: float
    roads: int
    faults: tuple[str, ...]

    def __str__(self) -> str:
        known = f"{self.referee:13.7g}" if np.isfinite(self.referee) else f"{'–':>13}"
        line = f"{self.where:38} {self.figure:9} {self.method:10} {known} {self.library:13.7g}  {self.roads} roads"
        return "\n      ".join([line, *(f"DIFFERS {fault}" for fault in self.faults)])


def points(names: tuple[str, ...], parts: tuple[float, ...]) -> Iterator[Point]:
    """Yield every point of the lenses named."""
    for name in names:
        widest = WIDEST_DEG.get(name, max(p2sf.load_lens(name).fields_deg))
        for depth in depths(name):
            for part in parts:
                focus = None if depth in (inf, *RELAYS_MM.values()) else depth
                yield Point(name, depth, part * widest, focus)


def depths(name: str) -> tuple[float, ...]:
    """Return the depths of a lens: a relay has one."""
    return (RELAYS_MM[name],) if name in RELAYS_MM else (inf, float(NEAR_MM[name]))


def frequencies(at: Point) -> np.ndarray:
    """Return two frequencies in cycles per mm, of two digits."""
    na = float(p2sf.Camera(at.lens, focus_mm=at.focus_mm).at(at.source).coefficients().na)
    return np.array([float(f"{part * 2000 * na / at.source.wavelength_um:.2g}") for part in FREQUENCIES])


def truth(at: Point, folder: Path | None = None) -> tuple[Truth, RayFigures | None]:
    """Return what the referee finds, and its rays where a PSF can be summed; LostRays where rays are lost."""
    kept = folder / f"{at.label.replace('∞', 'inf')}.json" if folder else None
    setup = set_up_source(at.lens, at.source, Camera(focus_mm=at.focus_mm))
    rays = ray_figures(setup.lens, setup.source)
    if kept and kept.is_file():
        return Truth(**json.loads(kept.read_text())), rays if rays.rays.slope <= STEEPEST else None
    found = Truth(rays.rays.slope, rays.spot_rms_um, rays.rms_waves)
    if found.slope > STEEPEST:
        found.why_not = f"{found.slope:.0f} waves per pupil radius"
        return found, None
    found.strehl = rays.strehl
    if rays.pupil.error > FITTED or rays.folds:
        found.why_not = "rays from different parts of the pupil arrive in one direction, or nearly"
    elif rays.grid_error > GRIDS_AGREE:
        found.why_not = f"the referee's grids differ by {rays.grid_error:.1e}"
    else:
        found.radius_80_um = rays.radius_um(0.8)
        found.sagittal, found.tangential = (tuple(one.tolist()) for one in rays.contrast(frequencies(at)))
    if kept:
        kept.write_text(json.dumps(asdict(found)))
    return found, rays


def rows(
    at: Point, known: Truth, rays: RayFigures | None, window: Window | None, methods: tuple[str, ...] = METHODS
) -> Iterator[Row]:
    """Yield the lines of one point."""
    at = replace(at, steep=known.slope > STEEP)
    shown: list[Shown] = []
    if rays is None:
        shown += (*library_spot(at), *command_line_spot(at))
        methods = ()
    for method in methods:
        shown += each_road(at, method, frequencies(at), window)
        yield psf_row(at, method, rays)
    groups: dict[tuple[str, str], list[Shown]] = {}
    for one in shown:
        if one.figure == "Strehl" and at.steep:
            continue  # the peak may lie outside of a small window
        if one.road == "profiles" and one.figure == "spot RMS" and one.refused and not known.sagittal:
            continue  # which stands in one line with R80, and goes with it
        groups.setdefault((one.figure, one.method), []).append(one)
    for (figure, method), each in groups.items():
        yield row_of(at.label, figure, method, each, known)


def row_of(where: str, figure: str, method: str, each: list[Shown], known: Truth) -> Row:
    """Return the line of one figure by one method: the first road is the library's."""
    answers = [one for one in each if not one.refused]
    faults = []
    if not answers:
        return Row(where, figure, method, np.nan, np.nan, 0, ())
    first = answers[0]
    for one in each:
        if one.refused:
            faults.append(f"{one.road} refuses: {one.refused}")
        elif not one.agrees(first.value):
            digits = "" if one.half_digit == 0 else f" ± {one.half_digit:.1g}"
            faults.append(f"{one.road} {one.value:.7g}{digits}, {first.road} {first.value:.7g}")
    true = known.of(figure) if method in (*EXACT, "exact rays") and figure != "MTF" else np.nan
    if np.isfinite(true):
        scale = true if figure in ("spot RMS", "R80") else 1.0
        away = abs(first.value - true) / scale
        if away > EXACTLY:
            faults.append(f"{first.road} from the referee by {away:.1e}")
    return Row(where, figure, method, true, first.value, len(answers), tuple(faults))


def psf_row(at: Point, method: str, rays: RayFigures) -> Row:
    """Return the line of a PSF: its 1 − R² against the referee's sum and, as the library's word, what it predicts.

    A prediction is for a window that shows all light; where that takes minutes, the core of exact rays is compared.
    """
    if at.steep and method not in EXACT:
        return Row(at.label, "1 − R²", method, np.nan, np.nan, 0, ())
    window = {"integrated": False} | ({"pixel_um": pitches_um(at)[1]} if at.steep else {})
    try:
        psf = p2sf.render(at.lens, at.source, method, pixels=SAMPLES, **window, focus_mm=at.focus_mm)
    except P2SFError as error:
        return Row(at.label, "1 − R²", method, np.nan, np.nan, 0, () if method != "huygens" else (str(error),))
    values = np.abs(rays.field(psf.x_um, psf.y_um)) ** 2
    values /= values.sum()
    missed = float(((psf.values - values) ** 2).sum() / ((values - values.mean()) ** 2).sum())
    allowed = EXACTLY**2 if method == "huygens" else psf.predicted_error
    faults = () if allowed is None or missed <= allowed else (f"1 − R² is {missed:.1e}, predicted {allowed:.1e}",)
    return Row(at.label, "1 − R²", method, missed, np.nan if allowed is None else allowed, 1, faults)


def tolerance_rows(name: str, depth_mm: float, window: Window | None, f_number: float | None = None) -> Iterator[Row]:
    """Yield what the most harmful error of each kind adds to the RMS of the worst field, on every road."""
    focus = None if depth_mm in (inf, *RELAYS_MM.values()) else depth_mm
    at = Point(name, depth_mm, 0.0, focus)
    setup = set_up_source(at.lens, at.source, Camera(focus_mm=focus, f_number=f_number))
    lens, sources = setup.lens, usual_sources(setup.lens, setup.source)
    listed, places = with_compensators(usual_tolerances(lens), (back_focus(lens),))
    where = f"{name} {'∞' if depth_mm == inf else f'{depth_mm:g} mm'}" + (f" f/{f_number:g}" if f_number else "")
    try:
        known = differentials(lens, sources, listed)
    except P2SFError as error:
        yield Row(where, "harm", "", np.nan, np.nan, 0, ())
        print(f"{where}: no tolerances, {error}")
        return
    found = harms(sensitivities(known, places), "rms_waves", places)
    others = {} if f_number else {"p2sf tolerance": harms_on_the_command_line(at)}
    if window and not f_number:
        others["Tolerances"] = harms_in_the_window(at, window)
    for number in most_harmful(listed, found, places):
        one, faults = listed[number], []
        for road, said in others.items():
            if isinstance(said, str):
                faults.append(f"{road} refuses: {said}")
                continue
            told = said[one.kind, one.first]
            value, half = told if isinstance(told, tuple) else (told, 0.0)
            if np.isnan(value) and np.isnan(found[number]):
                continue  # rays are lost, and all roads say so
            if not Shown(road, "harm", "", value, half).agrees(found[number]):
                faults.append(f"{road} {value:.6g} ± {half:.1g}, library {found[number]:.6g}")
        yield harm_row(where, lens, sources, one, float(found[number]), faults, len(others))


def harm_row(
    where: str, lens: Lens, sources: tuple[Source, ...], one: Tolerance, said: float, faults: list[str], others: int
) -> Row:
    """Return the line of one error."""
    try:
        true, own = harm(lens, sources, one), worst_rms(lens, sources, None, 0.0)
    except LostRays:
        true = own = np.nan
    if np.isnan(said) != np.isnan(true):
        faults = [*faults, "rays are lost, or not, unlike those of the referee"]
    if np.isfinite(true) and abs(said - true) > HARM * abs(true) + OF_RMS * own:
        faults = [*faults, f"from the referee by {said / true - 1:+.1e}"]
    return Row(where, one.kind[:9], f"surface {one.first}", true, said, 1 + others, tuple(faults))


def most_harmful(listed: tuple[Tolerance, ...], found: np.ndarray, places: tuple[int, ...]) -> list[int]:
    """Return the place of the most harmful error of each kind, and of the first that loses rays."""
    of_kind = [[k for k, one in enumerate(listed) if one.kind == kind and k not in places] for kind in KINDS]
    lost = [k for numbers in of_kind for k in numbers if np.isnan(found[k])]
    kept = [[k for k in numbers if np.isfinite(found[k])] for numbers in of_kind]
    return [*(max(numbers, key=lambda k: found[k]) for numbers in kept if numbers), *lost[:1]]


def table(
    names: tuple[str, ...], parts: tuple[float, ...], folder: Path | None, window: Window | None
) -> Iterator[Row]:
    """Yield all lines but those of tolerances."""
    for at in points(names, parts):
        begun = process_time()
        try:
            known, rays = truth(at, folder)
        except LostRays as why:
            print(f"{at.label}: not judged, {why}", flush=True)
            continue
        if known.why_not:
            print(f"{at.label}: the referee has no MTF and R80: {known.why_not}", flush=True)
        yield from rows(at, known, rays, window)
        print(f"{at.label}: {known.slope:.1f} waves per radius, {process_time() - begun:.1f} s", flush=True)


def written_rows(name: str, parts: tuple[float, ...], ways: tuple[Written, ...] = WAYS) -> Iterator[Row]:
    """Yield the figures of a lens written in other ways; the referee is the lens as it is, or as the way says."""
    lens = p2sf.load_lens(name)
    widest, um = WIDEST_DEG.get(name, max(lens.fields_deg)), lens.reference_wavelength_um
    if name in RELAYS_MM:
        return  # a tilted object plane is another object
    for way, part in product(ways, parts):
        pair = (way.same(lens), 0.0), (way.write(lens), way.turned_deg)
        places = [(each, Source(field_deg=part * widest + turn, wavelength_um=um)) for each, turn in pair]
        where = f"{name} {part * widest:.4g}° {way.name}"
        try:
            plain = exact_figures(*places[0])
        except P2SFError as error:
            print(f"{where}: not judged, {error}")
            continue
        try:
            other = exact_figures(*places[1])
        except P2SFError as error:
            yield Row(where, "", "", np.nan, np.nan, 0, (str(error),))
            continue
        for (figure, method), due in plain.items():
            found = other[figure, method]
            floor = FINEST_UM / WRITTEN_ALIKE if "RMS" in figure else 0.0
            if figure == "Strehl" and whole_width_um(*places[0]) is None:
                continue  # the peak may lie outside of a small window
            away = abs(found - due) / max(abs(due), floor)
            allowed = EXACTLY if figure == "R80" else WRITTEN_ALIKE  # R80 is settled, on lines that symmetry chooses
            yield Row(where, figure, method, due, found, 1, (f"by {away:.1e}",) if away > allowed else ())
        yield from written_pictures(where, *places)


def exact_figures(lens: Lens, source: Source) -> dict[tuple[str, str], float]:
    """Return figures of exact rays and sums of waves."""
    energy = p2sf.Camera(lens).at(source).energy(method="traced")
    return {
        ("spot RMS", "exact rays"): float(spot(lens, source).rms_um),
        ("OPD RMS", "exact rays"): p2sf.Camera(lens).at(source).zernike().rms,
        ("R80", "traced"): energy.radius_80_um,
        ("Strehl", "huygens"): float(p2sf.render(lens, source, "huygens", **written_window(lens, source)).strehl),
    }


def whole_width_um(lens: Lens, source: Source) -> float | None:
    """Return the width of a window that shows all light; None where that is too wide for sums in seconds."""
    width = whole_pixel_um(lens, source, SAMPLES) * SAMPLES
    return width if width <= 2 * (STEEP + ROOM) * source.wavelength_um / cone(lens, source).na else None


def written_window(lens: Lens, source: Source) -> dict[str, float]:
    """Return a window that is the same however a lens is written: samples at a fifth of λ/NA."""
    return {"pixels": 32, "pixel_um": 0.2 * source.wavelength_um / cone(lens, source).na, "integrated": False}


def written_pictures(where: str, one: tuple[Lens, Source], other: tuple[Lens, Source]) -> Iterator[Row]:
    """Yield the lines of PSFs: by Huygens relative L2, by a fit and ``auto`` what 1 − R² is and what is stated.

    The latter in a window that shows all light, which is what is stated for; none where that is too wide.
    """
    window = written_window(*one)
    reference = p2sf.render(*one, "huygens", **window).values
    found = p2sf.render(*other, "huygens", **window).values
    away = float(np.linalg.norm(found - reference) / np.linalg.norm(reference))
    faults = () if away <= WRITTEN_ALIKE else (f"by {away:.1e}",)
    yield Row(where, "L2", "huygens", away, WRITTEN_ALIKE, 1, faults)
    width = whole_width_um(*one)
    if width is None:
        return
    window = {"pixels": SAMPLES, "pixel_um": width / SAMPLES, "integrated": False}
    for method in ("fitted", "auto"):
        psf = p2sf.render(*other, method, **window)
        truth_by = "spherical" if psf.method == "spherical" else "huygens"
        reference = p2sf.render(*one, truth_by, **window).values
        missed = float(((psf.values - reference) ** 2).sum() / ((reference - reference.mean()) ** 2).sum())
        allowed = psf.predicted_error if psf.predicted_error is not None else EXACTLY**2
        faults = () if missed <= allowed else (f"1 − R² is {missed:.1e}, predicted {allowed:.1e}",)
        yield Row(where, "1 − R²", method, missed, allowed, 1, faults)


def main() -> int:
    """Run from the command line."""
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--quick", action="store_true", help="three lenses, two fields, no tolerances")
    asked.add_argument("--keep", type=Path, help="a folder for what the referee finds")
    asked.add_argument("--no-window", action="store_true", help="library and command line alone")
    asked.add_argument("--tolerances", choices=("no", "only"), help="without tolerances, or nothing else")
    asked.add_argument("lenses", nargs="*", help="names of shipped lenses, all without")
    given = asked.parse_args()
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    names = tuple(given.lenses) or (QUICK if given.quick else shipped_lenses())
    bad = count = 0
    window, parts = None if given.no_window else Window(), QUICK_FIELDS if given.quick else FIELDS
    tables = [] if given.tolerances == "only" else [table(names, parts, given.keep, window)]
    tables += [] if given.tolerances == "only" else [written_rows(name, parts) for name in names]
    tables += [] if given.tolerances == "no" or given.quick else [tolerance_table(names, window)]
    for row in chain.from_iterable(tables):
        print(row, flush=True)
        count, bad = count + 1, bad + bool(row.faults)
    if window:
        window.close()
    print(f"{count} figures, {bad} of them differ; {process_time():.0f} s of CPU time")
    return int(bool(bad))


def tolerance_table(names: tuple[str, ...], window: Window | None) -> Iterator[Row]:
    """Yield the lines of tolerances: every lens for its first depth, and the paper's lens stopped down."""
    with one_computation():
        for name in names:
            yield from tolerance_rows(name, depths(name)[0], window)
        if "double_gauss_28" in names:
            yield from tolerance_rows("double_gauss_28", inf, window, f_number=8.0)


if __name__ == "__main__":
    raise SystemExit(main())
