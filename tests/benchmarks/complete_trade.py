"""The complete trade: every representation of a lens's PSFs, its error against bytes and against time.

Each lens is taken over its `LensSpace`, in one window of 64² pixels, and judged at points at random that no
representation was made with, against exact rays (`ExactPsfs`); a few of them are summed by Huygens too. What is fixed
for all lenses (rates, bits, rules, cuts) was chosen by trials on `tessar` and `double_gauss_28` at these same points.

``python -m tests.benchmarks.complete_trade FILE [LENS ...] [--quick] [--keep FOLDER]`` writes the trades of lenses, by
default of all shipped ones, which takes 18 minutes of CPU time on one core. ``--keep``: a folder that keeps the result
of each lens, from which a run goes on. `p2sf.studies.complete_trade` reads the file.
"""

import argparse
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import process_time

import numpy as np

from p2sf.conventions import NM_PER_UM, degrees_from_slope
from p2sf.errors import P2SFError
from p2sf.figures.window import radius_of_energy
from p2sf.lens.lens import Lens
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.psf.methods import REFERENCE
from p2sf.psf.result import Psf
from p2sf.studies.complete_trade import LensTrade, Row, SpaceWords, Spread, load_trades, save_trades
from tests.benchmarks.representations.coefficients import coefficient_representations
from tests.benchmarks.representations.fits import fitted_representations
from tests.benchmarks.representations.networks import network_representations
from tests.benchmarks.representations.pictures import grid_representations, pca_representations
from tests.benchmarks.representations.points import point_representations
from tests.benchmarks.representations.rays import ray_representations
from tests.benchmarks.representations.representation import ExactPsfs, Representation, huygens_picture
from tests.benchmarks.representations.shapes import shape_representations
from tests.benchmarks.representations.space import LensSpace, SpacePoints, lens_space
from tests.benchmarks.representations.zernike_grid import zernike_representations

TESTED, TESTED_QUICK, SEED = 40, 12, 2026
PROBED, PROBE_TOLERANCE = 3, 1e-6  # of them, by a Huygens sum that agrees so well with the one before
PARTS = {"median": 0.5, "95 %": 0.95, "worst": 1.0}  # of the points whose error is no larger
MEASURES = ("one_less_r2", "relative_l2", "mtf", "r80")
SINGLE_FIELDS = 0.0, 0.7, 1.0  # of the largest field: the points taken alone, at the far end and the middle wavelength
ENOUGH_SECONDS = 0.02  # of work, for a time
SINGLES = 5  # calls of one point each, at most, for a median
EIGHTY = 0.8
DONE = "done"  # told when a lens is


@dataclass(frozen=True, eq=False)
class Truth:
    """The points a representation is judged at, their unit-sum pictures (n, pixels, pixels) and R80 in pixels, (n,)."""

    points: SpacePoints
    pictures: np.ndarray
    radius: np.ndarray


Progress = Callable[[str], None]


def _silent(words: str) -> None:
    pass


def compare_representations(lens: Lens, quick: bool = False, progress: Progress = _silent) -> LensTrade:
    """Return the complete trade of one lens, on one thread; ``quick``: one setting of each family, fewer points.

    ``progress`` is told what comes next. Raises GeometryError for a lens that has no space to compare in.
    """
    from threadpoolctl import threadpool_limits

    started = process_time()
    with threadpool_limits(1):
        space = lens_space(lens)
        exact = ExactPsfs(space)
        points = space.random(TESTED_QUICK if quick else TESTED, SEED)
        progress("exact PSFs")
        truth = truth_of(points, exact.at(points).astype(float))
        few = points[:PROBED]
        probed = truth_of(few, np.stack([huygens_picture(space, source, PROBE_TOLERANCE) for source in few.sources()]))
        rows, refused = _rows(space, exact, truth, probed, quick, progress)
        progress("single points")
        singles = tuple(_singles(space, exact, quick))
    progress(DONE)
    truth_error = float(_one_less_r2(truth.pictures[:PROBED], probed.pictures).max())
    words = lens.name, lens.title or lens.name, _words(space)
    return LensTrade(*words, truth_error, tuple(rows), singles, tuple(refused), process_time() - started)


def _families(space: LensSpace, exact: ExactPsfs, quick: bool) -> dict[str, Callable[[], Iterator[Representation]]]:
    return {
        "seidel": partial(coefficient_representations, space, quick),
        "fitted": partial(fitted_representations, space, quick),
        "Zernike grid": partial(zernike_representations, space, quick),
        "PSF grid": partial(grid_representations, space, exact, quick),
        "PCA": partial(pca_representations, space, exact, quick),
        "neural": partial(network_representations, space, exact, quick),
        "shapes": partial(shape_representations, space, exact, quick),
    }


def _rows(
    space: LensSpace, exact: ExactPsfs, truth: Truth, probed: Truth, quick: bool, progress: Progress
) -> tuple[list[Row], list[tuple[str, str]]]:
    """Return the rows of all families, and the families that this space refuses."""
    rows: list[Row] = []
    refused: list[tuple[str, str]] = []
    for name, family in _families(space, exact, quick).items():
        progress(name)
        try:
            rows += [measure_representation(made, truth) for made in family()]
        except P2SFError as error:
            refused.append((name, str(error)))
    progress("rays")
    # Rays are the truth of all others; theirs is a Huygens sum of more nodes.
    rows += [measure_representation(made, probed) for made in ray_representations(space)]
    return rows, refused


def _singles(space: LensSpace, exact: ExactPsfs, quick: bool) -> Iterator[tuple[float, tuple[Row, ...]]]:
    """Yield the field, °, and the rows of points taken alone."""
    for part in SINGLE_FIELDS[1:2] if quick else SINGLE_FIELDS:
        place = np.where(space.spread, [1.0, part, 0.5], 0.0)
        point = space.at(place[None])
        truth = truth_of(point, exact.at(point).astype(float))
        made = point_representations(space, exact, point)
        field = float(degrees_from_slope(point.field_slope[0]))
        yield field, tuple(measure_representation(one, truth) for one in made if one.family != REFERENCE)


def truth_of(points: SpacePoints, pictures: np.ndarray) -> Truth:
    """Return what representations are judged by at some points, from unit-sum pictures (n, pixels, pixels)."""
    return Truth(points, pictures, _radius_80(pictures))


def measure_representation(made: Representation, truth: Truth) -> Row:
    """Return what a representation costs, and its errors."""
    points, wanted = truth.points, truth.pictures
    found, batch = _time_call(lambda: made.psf(points))
    singles = [points[k : k + 1] for k in range(min(SINGLES, len(points)))]
    single = float(np.median([_time_call(partial(made.psf, one))[1] for one in singles]))
    l2 = _relative_l2(found, wanted)
    worst = int(l2.argmax())
    place = points.depth_mm[worst], degrees_from_slope(points.field_slope[worst]), points.wavelength_um[worst]
    depth, field, wave = (float(x) for x in place)
    return Row(
        family=made.family,
        settings=made.settings,
        numbers=made.numbers,
        nbytes=made.nbytes,
        build_seconds=made.seconds,
        batch_us=1e6 * batch / len(points),
        single_us=1e6 * single,
        one_less_r2=_spread(_one_less_r2(found, wanted)),
        relative_l2=_spread(l2),
        mtf=_spread(_mtf_error(found, wanted)),
        r80=_spread(np.abs(_radius_80(found) / truth.radius - 1)),
        worst_at=(depth, field, wave * NM_PER_UM),
        points=len(points),
    )


def _time_call(work: Callable[[], np.ndarray]) -> tuple[np.ndarray, float]:
    """Return the result and the mean CPU seconds of a call, of so many that a clock can tell; the first one counts."""
    started, calls = process_time(), 0
    while True:
        found = work()
        calls += 1
        spent = process_time() - started
        if spent >= ENOUGH_SECONDS:
            return found, spent / calls


def _spread(errors: np.ndarray) -> Spread:
    return Spread(*(float(np.quantile(errors, part, method="higher")) for part in PARTS.values()))


def _relative_l2(found: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Return ‖found − truth‖/‖truth‖ of unit-sum pictures, (n,)."""
    error: np.ndarray = np.linalg.norm(found - truth, axis=(1, 2)) / np.linalg.norm(truth, axis=(1, 2))
    return error


def _one_less_r2(found: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Return Σ(found − truth)²/Σ(truth − mean)² of unit-sum pictures, (n,)."""
    about_mean = truth - truth.mean((1, 2), keepdims=True)
    error: np.ndarray = np.square(found - truth).sum((1, 2)) / np.square(about_mean).sum((1, 2))
    return error


def _mtf_error(found: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Return the largest difference of the windows' tangential or sagittal contrast up to the pixels' Nyquist, (n,)."""
    lines = [np.concatenate([x.sum(2), x.sum(1)], axis=1).reshape(len(x), 2, -1) for x in (found, truth)]
    one, other = (np.abs(np.fft.rfft(line, axis=-1)) for line in lines)
    error: np.ndarray = np.abs(one - other).max((1, 2))
    return error


def _radius_80(pictures: np.ndarray) -> np.ndarray:
    """Return the radius that holds 80 % of each window's light about its centroid, pixels, (n,)."""
    return radius_of_energy(Psf(pictures, 1.0, 1.0, ""), EIGHTY)


def _words(space: LensSpace) -> SpaceWords:
    low, high = (float(degrees_from_slope(slope)) for slope in space.slopes)
    blue, red = (wave * NM_PER_UM for wave in space.wavelengths_um)
    window = space.window
    depths = space.f_number, space.near_mm, space.far_mm
    return SpaceWords(*depths, (low, high), (blue, red), window.pixels, window.pixel_um, window.across)


def kept_or_compared(lens: Lens, folder: Path | None, quick: bool = False, progress: Progress = _silent) -> LensTrade:
    """Return the trade of a lens from a folder where an earlier run left it, or compare it and leave it there."""
    if folder is None:
        return compare_representations(lens, quick, progress)
    path = folder / f"{lens.name}.json"
    if path.exists():
        return load_trades(path)[0]
    found = compare_representations(lens, quick, progress)
    save_trades(path, [found])
    return found


def _tell(lens: str, words: str) -> None:
    """Say on a terminal what is compared now, over what was said before."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{lens}: {words}", end="\n" if words == DONE else "", file=sys.stderr, flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("lenses", nargs="*", default=shipped_lenses())
    parser.add_argument("--quick", action="store_true", help="one setting of each representation, at fewer points")
    parser.add_argument("--keep", type=Path, help="a folder that keeps the result of each lens")
    asked = parser.parse_args()
    found = [kept_or_compared(find_lens(name), asked.keep, asked.quick, partial(_tell, name)) for name in asked.lenses]
    save_trades(asked.file, found)


if __name__ == "__main__":
    main()
