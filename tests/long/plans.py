"""Plans checked over random scenes of every shipped lens: `python -m tests.long.plans [SCENES] [LENS …]`.

Each scene is planned, checked at random points against exact rays, and its cost is compared with that of the full
grid, which without a plan would have to be computed for the same error: one method everywhere, six coefficients if
they hold in the corner, else the plan's fit, its own rays for every PSF; depth × rows × columns × every wavelength,
everywhere as dense as the worst place needs; every fringe; all phase terms; one window, that of the widest blur; no use
of symmetry (`pricing.naive_work`). Both costs are printed as predicted and as measured (CPU seconds of computing the
kernels, for the full grid from a sample of them; chief rays, which both need alike, are traced before), and beside them
the cost of the reference sum on the same grid.

`python -m tests.long.plans` runs 20 scenes of all lenses, `python -m tests.long.plans 4 tessar relay` four of two, and
`--first 3` begins with the third of each. With `--keep FILE` every scene's figures are appended to a file of JSON
lines; a scene already in it is not tried again, so that a run that was stopped goes on, and the figures at the end are
those of the whole file. Set OMP_NUM_THREADS=1 and OPENBLAS_NUM_THREADS=1, or a second thread counts as CPU time.

`picture_saving` counts whole pictures: both form one by the same code, the full grid with its own kernels.

At the end it prints the sums of every lens and of all, full grid, plan, plan with its planning, and the figures that
matter: seconds of planning, savings with the planning counted in, and a histogram of the errors found, in parts of the
predicted ones.
"""

import argparse
import json
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from math import ceil
from pathlib import Path
from time import process_time

import numpy as np

from p2sf.conventions import depth_of
from p2sf.disc.quadrature import disc_nodes
from p2sf.errors import GeometryError, P2SFError
from p2sf.image.form import form_image, plan_lattice
from p2sf.lens.lens import lens_range_um, with_f_number
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.pupils import f_number, numerical_aperture
from p2sf.paraxial.seidel import coefficients, reason_against_coefficients
from p2sf.pixel_kernels.channel import Colour, Kernels, Recipe
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.pupil.plane_waves import counts_for, window_reach_um
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.ray_field import steepness
from p2sf.scene.planning import lens_pupils
from p2sf.scene.planning.cost import naive_recipe
from p2sf.scene.planning.plan import SHARES, Plan, plan
from p2sf.scene.planning.reference import LEAST_POINTS, PROBE
from p2sf.scene.planning.study import distance
from p2sf.scene.planning.verify import error_at, planned_kernel, verify
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

SCENES, POINTS, SAMPLE = 20, 1, 8
HARDEST, TRIED_DEPTHS = 1, 7
TOLERANCES = 0.2, 0.1, 0.05, 0.03
SIX_SHARE = 0.3  # of the allowed error, which the grid's six coefficients may use up
LARGE = 0.3  # seconds of full grid: a scene that is worth a plan
NO_LOSS = 0.9  # of the full grid's cost per that of a plan with its planning: no worse than without a plan
SLACK = 0, 0.1, 0.25, 0.5, 0.75, 1  # parts of the predicted error between which the found ones are counted
AFFORDABLE = 2e11  # products of a reference sum, some minutes of one core
TABLE, TABLES = lens_pupils._table, []  # makes the pupils that are kept of a lens; CPU seconds of each
SLOWEST_TRIED = 4.0  # f-number: faster lenses are stopped down to it or beyond, as their rims are not clipped here


def random_scene(lens, random) -> tuple:
    """Return a lens stopped down at random and a scene: a crop of its field, a few waves deep, one or two colours."""
    wave = lens.reference_wavelength_um
    fastest = max(float(f_number(lens, wave)), SLOWEST_TRIED)
    lens = with_f_number(lens, fastest * random.uniform(1, 2))
    near, far = _depths(lens, random)
    na = float(numerical_aperture(lens, depth_of(far), wave))
    pixel = random.uniform(1.5, 8) * wave / (2 * na)
    rim = abs(float(coefficients(lens, depth_of(far), np.tan(np.deg2rad(max(lens.fields_deg))), wave).image_height))
    rim = rim or 50 * pixel / 1000
    columns, rows = (int(n) for n in random.integers(48, 400, 2))
    size = float(np.hypot(rows, columns) / 2 * pixel / 1000)
    place, angle = max(0.0, random.uniform(0, 0.75) * rim - size), random.uniform(0, 2 * np.pi)
    centre = (place * np.sin(angle), place * np.cos(angle)) if random.random() < 0.5 else (0.0, 0.0)
    tolerance = float(random.choice(TOLERANCES))
    sensor = Sensor(rows, columns, float(pixel), centre)
    return lens, Scene(sensor, _channels(lens, random), depth_of(near), depth_of(far), tolerance)


def _depths(lens, random) -> tuple[float, float]:
    """Return near and far vergence: from where the lens is focused, up to two waves towards it."""

    def defocus(vergence):
        return np.array(
            [float(coefficients(lens, depth_of(v), 0.0, lens.reference_wavelength_um).wd) for v in vergence]
        )

    tried = np.append(0.0, np.geomspace(1e-6, 0.05, 400))
    found = defocus(tried)
    crossing = np.flatnonzero((found[:-1] < 0) != (found[1:] < 0))
    focus = float(tried[crossing[-1]]) if crossing.size and abs(found[0]) > 2 else 0.0
    step = 1e-7
    slope = abs(float(np.diff(defocus([focus, focus + step]))[0])) / step
    return focus + random.uniform(0, 2) / slope, focus


def _channels(lens, random) -> tuple[Channel, ...]:
    low, high = lens_range_um(lens) or (0.4, 0.7)
    low, high = max(1000 * low, 420) + 20, min(1000 * high, 680) - 20
    middles = random.uniform(low, max(low, high), random.integers(1, 3))
    kinds = (0.0,), (-15.0, 15.0), (-20.0, 0.0, 20.0)
    steps = kinds[int(random.integers(3))]
    return tuple(
        Channel(f"{m:.0f} nm", tuple(float(m + s) for s in steps), tuple(random.uniform(0.5, 1, len(steps)).tolist()))
        for m in middles
    )


def trial(planned: Plan, planning: float, seed: int = 0) -> dict:
    """Return one scene's figures; ``planning``: CPU seconds of planning it."""
    spent, full, formed = plan_seconds(planned), naive_seconds(planned), picture_seconds(planned)
    verdict, scene = verify(planned, POINTS, seed), planned.scene
    worst = max(verdict.worst, *(error_at(planned, *place)[0] for place in hardest(planned)))
    nodes = planned.counts[0] * planned.counts[1] * len(planned.vergences)
    grid = nodes * sum(len(channel.wavelengths_nm) for channel in scene.channels)
    looser = loosened_cost(planned.lens, scene) <= planned.cost.kernel_seconds if seed % 5 == 0 else None
    return {
        "tolerance": scene.limit,
        "predicted": planned.predicted_error,
        "worst": worst,
        "meets": planned.meets,
        "kept": worst <= planned.allowed_error,
        "bounded": worst <= planned.predicted_error,
        "planning_seconds": planning,
        "tables_seconds": sum(TABLES),
        "kernel_seconds": spent,
        "naive_seconds": full,
        "predicted_saving": planned.naive.kernel_seconds / planned.cost.kernel_seconds,
        "measured_saving": full / max(spent, 1e-9),
        "saving_with_planning": full / (spent + planning),
        "picture_saving": (full + max(0.0, formed - spent)) / (formed + planning),
        "reference_saving": grid * verdict.reference_seconds / max(spent, 1e-9),
        "loosening_is_cheaper": looser,
        "errors": {kind: max((d.error for d in planned.decisions if d.kind == kind), default=0.0) for kind in SHARES},
        "what": [f"{d.what}: {d.choice} ({d.error:.2g})" for d in planned.decisions],
    }


def hardest(planned: Plan) -> list[tuple[float, float, float, int]]:
    """Return HARDEST places where the plan's kernels differ most from finer ones: x, y, vergence, channel.

    In the middles of cells, nearest to the axis, farthest from it and between, and at the node farthest out; at depth
    nodes and midway between them. The finer kernels have every wavelength and fringe, at the place itself.
    """
    sensor, scene, found = planned.scene.sensor, planned.scene, []
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), planned.counts, strict=True))
    y, x = sensor.y_mm(_middles(rows, sensor.rows)), sensor.x_mm(_middles(columns, sensor.columns))
    cells = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
    far = max(
        ((sensor.x_mm(b), sensor.y_mm(a)) for a in rows[[0, -1]] for b in columns[[0, -1]]), key=lambda p: np.hypot(*p)
    )
    order = np.argsort(np.hypot(*cells.T), kind="stable")
    points = [*(cells[order[k]] for k in {0, len(order) // 2, len(order) - 1}), far]
    nodes = np.array(planned.vergences if len(planned.vergences) > 1 else scene.vergences(2))
    depths = np.union1d(nodes, (nodes[1:] + nodes[:-1]) / 2)
    every = tuple(Colour(tuple(c.wavelengths_um.tolist()), tuple(c.shares.tolist())) for c in scene.channels)
    finer = replace(planned, colours=every, recipe=replace(planned.recipe, fineness=2.0, margin=0.5))
    for vergence in depths[np.unique(np.linspace(0, len(depths) - 1, TRIED_DEPTHS).astype(int))].tolist():
        for point in points:
            for channel in range(len(every)):
                place = float(point[0]), float(point[1]), vergence, channel
                own = finer.kernels(channel, vergence).at(*place[:2])
                found.append((distance(planned_kernel(planned, *place), own), place))
    return [place for _, place in sorted(found, reverse=True)[:HARDEST]]


def _middles(nodes: np.ndarray, pixels: int) -> np.ndarray:
    """Return the middles between nodes, or both ends beside a single one."""
    return (nodes[1:] + nodes[:-1]) / 2 if len(nodes) > 1 else np.array([0.0, pixels - 1.0])


def timed_plan(lens, scene) -> tuple[Plan, float]:
    """Return a plan whose reference is affordable, and the CPU seconds of planning; P2SFError for another scene."""
    lens_pupils._table = timed_table
    started, tables = process_time(), sum(TABLES)
    planned = plan(lens, scene)
    seconds = process_time() - started - (sum(TABLES) - tables)
    check_affordable(planned)
    return planned, seconds


def timed_table(lens, covered):
    """Return the pupils that are kept of a lens, and note in TABLES the CPU seconds if they had to be made."""
    started, missing = process_time(), TABLE.cache_info().misses
    table = TABLE(lens, covered)
    if TABLE.cache_info().misses > missing:
        TABLES.append(process_time() - started)
    return table


def check_affordable(planned: Plan) -> None:
    """Raise GeometryError for a scene whose reference sum is hours of work, as of a relay far out of focus."""
    sensor, seen = planned.scene.sensor, planned.sensor_map(planned.vergences[0])
    half = rim_half(planned, planned.vergences[0])
    source = seen.source(0.0, sensor.corners_mm()[1], min(planned.colours[0].wavelengths_um))
    probe = disc_nodes(*PROBE)
    steep = steepness(pencil(seen.lens, source, probe.xi, probe.eta), probe.xi, probe.eta)
    size = 2 * half + 1
    points = size * max(LEAST_POINTS, ceil(np.pi * steep.spread * sensor.pixel_um) + 3)
    products = float(np.prod(counts_for(steep, window_reach_um(size, sensor.pixel_um)))) * points**2
    if products > AFFORDABLE:
        raise GeometryError(
            "its reference is a sum of {products:.0e} products; too long to be tried", products=products
        )


def rim_half(planned: Plan, vergence: float) -> int:
    """Return the half width of the kernel at the sensor's farthest corner, pixels."""
    corner = [0.0], [planned.scene.sensor.corners_mm()[1]]
    return int(planned.kernels(0, vergence).points(*corner).half_widths()[0])


def plan_seconds(planned: Plan) -> float:
    """Return the CPU seconds of all kernels of a plan, its pupils included: of one depth times the depths."""
    for vergence in planned.vergences:
        planned.sensor_map(vergence)
    started = process_time()
    for number in range(len(planned.colours)):
        planned.kernels(number, planned.vergences[0])  # makes the pupils that are shared
    shared, started = process_time() - started, process_time()
    plan_lattice(planned, planned.vergences[0])
    return shared + (process_time() - started) * len(planned.vergences)


def picture_seconds(planned: Plan) -> float:
    """Return the CPU seconds of a picture of noise on a slope from far to near, its kernels included."""
    sensor, scene = planned.scene.sensor, planned.scene
    values = np.random.default_rng(0).random((sensor.rows, sensor.columns, len(scene.channels)), np.float32)
    far, near = scene.vergences(2)[[0, -1]].tolist()
    slope = np.linspace(far, near, sensor.columns)
    depth = np.broadcast_to(np.array([depth_of(v) for v in slope]), values.shape[:2])
    for vergence in planned.vergences:
        planned.sensor_map(vergence)
    started = process_time()
    form_image(planned, values, np.clip(depth, scene.near_mm, scene.far_mm))
    return process_time() - started


def naive_seconds(planned: Plan) -> float:
    """Return the CPU seconds of the full grid's kernels: SAMPLE of them made, times how many there are."""
    sensor, recipe = planned.scene.sensor, naive_recipe(cheapest_recipe(planned))
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), planned.counts, strict=True))
    places = [(v, c, a, b) for v in planned.vergences for c in planned.scene.channels for a in rows for b in columns]
    half = max(rim_half(planned, v) for v in (planned.vergences[0], planned.vergences[-1]))
    picked = [places[n] for n in np.linspace(0, len(places) - 1, min(SAMPLE, len(places))).astype(int)]
    views = {v: planned.sensor_map(v) for v, *_ in picked}
    started = process_time()
    for v, channel, row, column in picked:
        colour = Colour(tuple(channel.wavelengths_um.tolist()), tuple(channel.shares.tolist()))
        kernels = Kernels(views[v], colour, sensor.pixel_um, recipe)
        kernels.at(float(sensor.x_mm(column)), float(sensor.y_mm(row)), half)
    return (process_time() - started) * len(places) / len(picked)


def cheapest_recipe(planned: Plan) -> Recipe:
    """Return six coefficients where they keep SIX_SHARE of the tolerance on the axis and in the corner, else a fit."""
    if reason_against_coefficients(planned.lens):
        return planned.recipe
    y = planned.scene.sensor.corners_mm()[1]
    own = replace(planned, table=None)
    six = replace(own, recipe=replace(planned.recipe, method="seidel", numbers=None))
    error = 0.0
    for vergence in planned.vergences[:: max(1, len(planned.vergences) - 1)]:
        for height in (0.0, y):
            one, other = (made.kernels(0, vergence).at(0.6 * height, 0.8 * height) for made in (six, own))
            error = max(error, distance(one, other))
    return six.recipe if error <= SIX_SHARE * planned.allowed_error else planned.recipe


def loosened_cost(lens, scene) -> float:
    """Return the predicted cost at twice the tolerance."""
    return plan(lens, replace(scene, rtol=min(0.9, 2 * scene.limit))).cost.kernel_seconds


def run(name: str, numbers: range, known: set[tuple[str, int]]) -> Iterator[dict]:
    """Yield the figures of these scenes of one lens, counted from 1, but for those known, printing a line each.

    Scenes that no light reaches, or that take too long to check, are redrawn. What comes before the scenes wanted is
    drawn and planned, so that they are the same as in a whole run.
    """
    random, number, refused = np.random.default_rng(sum(map(ord, name))), 1, 0
    while number < numbers.stop and refused < 10 * numbers.stop:
        try:
            planned = timed_plan(*random_scene(find_lens(name), random))
        except P2SFError as error:
            refused += 1
            print(f"  {name}: redrawn, {error}", flush=True)
            continue
        if number in numbers and (name, number) not in known:
            row = {"lens": name, "number": number, **trial(*planned, number - 1)}
            print(sentence(row), flush=True)
            yield row
        number += 1


def sentence(row: dict) -> str:
    """Return the figures of one scene in words, and its decisions if it missed its tolerance."""
    return (
        f"{row['lens']} {row['number']}: tolerance {row['tolerance']:g}, predicted {row['predicted']:.3f}, "
        f"worst {row['worst']:.4f}{'' if row['kept'] else ' MISSED'}{'' if row['meets'] else ' (said so)'}, saving "
        f"{row['predicted_saving']:.1f}× predicted, {row['measured_saving']:.1f}× measured "
        f"({row['naive_seconds']:.3f} s to {row['kernel_seconds']:.3f} s), "
        f"{row['saving_with_planning']:.1f}× with {row['planning_seconds']:.3f} s of planning, "
        f"{row['reference_saving']:.0f}× against the reference, looser is cheaper: {row['loosening_is_cheaper']}"
    ) + ("" if row["kept"] else f"\n    {'; '.join(row['what'])}")


def main() -> None:
    """Run the trial and print its sums."""
    asked = options()
    timed_plan(find_lens("double_gauss_28"), Scene(Sensor(40, 60, 20.0), near_mm=5e4, f_number=8))  # what all share
    kept = asked.keep.read_text().splitlines() if asked.keep and asked.keep.exists() else []
    rows = [json.loads(line) for line in kept]
    known = {(row["lens"], row["number"]) for row in rows}
    for name in asked.lenses or shipped_lenses():
        for row in run(name, range(asked.first, asked.scenes + 1), known):
            rows.append(row)
            if asked.keep:
                with asked.keep.open("a") as file:
                    file.write(json.dumps(row) + "\n")
    if rows:
        print_figures(rows)


def options() -> argparse.Namespace:
    """Return what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m tests.long.plans")
    parser.add_argument("scenes", nargs="?", type=int, default=SCENES, help="number of the last scene of each lens")
    parser.add_argument("lenses", nargs="*", help="shipped lenses; all if none is named")
    parser.add_argument("--first", type=int, default=1, help="number of the first scene of each lens")
    parser.add_argument("--keep", type=Path, help="file of JSON lines to go on with")
    return parser.parse_args()


def print_figures(rows: list[dict]) -> None:
    """Print what the scenes cost and saved together."""
    missed = [row for row in rows if not row["kept"]]
    for key in ("predicted_saving", "measured_saving", "saving_with_planning", "picture_saving", "reference_saving"):
        found = np.array([row[key] for row in rows])
        low, middle = np.percentile(found, [5, 50])
        print(f"{key}: median {middle:.1f}, 5th percentile {low:.1f}, at least 5 in {np.mean(found >= 5):.0%}")
    print("costlier when looser:", sum(row["loosening_is_cheaper"] is False for row in rows))
    for name in dict.fromkeys(row["lens"] for row in rows):
        print(sums(name, [row for row in rows if row["lens"] == name]))
    print(sums("all", rows))
    planning, saving, full, found = (
        np.array(column)
        for column in zip(
            *(
                (r["planning_seconds"], r["saving_with_planning"], r["naive_seconds"], r["worst"] / r["predicted"])
                for r in rows
            ),
            strict=True,
        )
    )
    large = saving[full > LARGE]
    print(f"{len(rows)} scenes, {len(missed)} missed, {sum(row['meets'] for row in missed)} of these unannounced")
    print(f"planning: median {np.median(planning):.3f} s, worst {planning.max():.3f} s")
    print(
        f"saving with the planning counted in: median {np.median(saving):.1f}×, least {saving.min():.2f}×, at least "
        f"{NO_LOSS}× in {np.mean(saving >= NO_LOSS):.1%}, at least 5× in {np.mean(saving >= 5):.1%} of the scenes"
    )
    if len(large):
        print(
            f"in {len(large)} scenes of more than {LARGE:g} s of full grid: median {np.median(large):.1f}×, "
            f"least {large.min():.2f}×, at least 5× in {np.mean(large >= 5):.1%}"
        )
    if (saving < NO_LOSS).any():
        print(f"the dearest full grid of those below {NO_LOSS}×: {full[saving < NO_LOSS].max():.3f} s")
    print(f"the predicted error bounds the found one in {np.mean([row['bounded'] for row in rows]):.1%}")
    for low, high in pairwise((*SLACK, np.inf)):
        print(f"found {low:g} to {high:g} of the predicted error: {np.mean((low < found) & (found <= high)):.1%}")


def sums(name: str, rows: list[dict]) -> str:
    """Return a sentence on what these scenes cost together."""
    full, spent, planning = (
        np.array([row[key] for row in rows]) for key in ("naive_seconds", "kernel_seconds", "planning_seconds")
    )
    saving = np.median([row["measured_saving"] for row in rows])
    return (
        f"{name}: {len(rows)} scenes, full grid {full.sum():.2f} s, plan {spent.sum():.2f} s "
        f"({full.sum() / spent.sum():.1f}× in sum, median {saving:.1f}×), planning {planning.sum():.2f} s more "
        f"(median {np.median(planning):.2f} s, longest {planning.max():.2f} s), "
        f"{full.sum() / (spent + planning).sum():.1f}× with it"
    )


if __name__ == "__main__":
    main()
