"""What a picture with depth costs, and how that grows with pixels, depths and tolerance.

``python -m tests.benchmarks.forming`` plans and forms a landscape in three colours, 2 to 6 m away: a floor on which
three discs stand. Each row runs in a process of its own, so that its peak of memory is its own: CPU seconds of all
threads, which part of them goes into what, and seconds of the wall, which a busy machine lengthens. ``--quick`` has a
sixteenth of the pixels.
"""

import argparse
import json
import resource
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, replace
from functools import wraps
from time import perf_counter, process_time, thread_time
from typing import Any
from unittest import mock

import numpy as np

from p2sf.image import form
from p2sf.image.blur_operator import BlurOperator
from p2sf.image.charts import draw_chart
from p2sf.image.form import form_image
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.channel import Kernels, Points
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor

PARTS = {
    "kernels": ((Kernels, "points"), (Points, "kernels")),
    "convolutions": ((BlurOperator, "_blur_blocks"),),
    "geometry": ((form, "source_places"), (form, "illumination"), (form, "resample")),
}
DISCS = (0.3, 0.3, 0.08, 0.25), (0.65, 0.35, 0.12, 0.7), (0.85, 0.2, 0.05, 0.1)  # x, y, radius, depth from near to far


@dataclass(frozen=True)
class Case:
    """A picture: 3:2, so many million pixels over a width in mm, with depths in mm, through a lens."""

    megapixels: float = 12.0
    rtol: float = 0.02
    near_mm: float = 2000.0
    far_mm: float = 6000.0
    lens: str = "wide_angle_35"
    f_number: float = 16.0
    width_mm: float = 30.0


USUAL = Case()
CASES = (
    *(replace(USUAL, megapixels=each) for each in (0.75, 3.0, 12.0)),
    *(replace(USUAL, far_mm=each) for each in (2000.0, 3000.0, np.inf)),
    *(replace(USUAL, rtol=each) for each in (0.1, 0.05)),
    replace(USUAL, rtol=0.05, f_number=8.0),
    replace(USUAL, rtol=0.05, lens="cooke_triplet", f_number=8.0, width_mm=24.0),
)


def scene_of(case: Case) -> tuple[Scene, np.ndarray]:
    """Return the scene and its depth map, mm."""
    columns = round((1.5e6 * case.megapixels) ** 0.5)
    rows = round(columns / 1.5)
    sensor = Sensor(rows, columns, 1000 * case.width_mm / columns)
    focus = 2 / (1 / case.near_mm + 1 / case.far_mm)
    scene = Scene(
        sensor, near_mm=case.near_mm, far_mm=case.far_mm, rtol=case.rtol, f_number=case.f_number, focus_mm=focus
    )
    y, x = np.mgrid[:rows, :columns] / columns
    part = y / y[-1, 0]  # from far, at the top, to near, in vergence
    for across, down, radius, behind in DISCS:
        part = np.where(np.hypot(x - across, y - down) < radius, 1 - behind, part)
    with np.errstate(divide="ignore"):
        return scene, np.clip(
            1 / (1 / case.far_mm + (1 / case.near_mm - 1 / case.far_mm) * part), case.near_mm, case.far_mm
        )


@contextmanager
def counted_parts() -> Iterator[Counter[str]]:
    """Count the CPU seconds of PARTS of the forming, each of which runs in one thread from call to return."""
    seconds: Counter[str] = Counter()

    def counting(part: str, function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def run(*given: Any, **named: Any) -> Any:
            started = thread_time()
            try:
                return function(*given, **named)
            finally:
                seconds[part] += thread_time() - started

        return run

    with ExitStack() as patches:
        for part, functions in PARTS.items():
            for owner, name in functions:
                patches.enter_context(mock.patch.object(owner, name, counting(part, getattr(owner, name))))
        yield seconds


def measure(case: Case) -> dict:
    """Return what one picture takes, from the lens to the light on the sensor."""
    lens, (scene, depth) = find_lens(case.lens), scene_of(case)
    picture, before = draw_chart("landscape", *depth.shape), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    started = process_time(), perf_counter()
    planned = plan(lens, scene)
    planned_at = process_time()
    with counted_parts() as parts:
        form_image(planned, picture, None if case.near_mm == case.far_mm else depth)
    ended = process_time(), perf_counter()
    return {
        "nodes": f"{planned.counts[0]} × {planned.counts[1]} × {len(planned.vergences)}",
        "error": planned.predicted_error / planned.allowed_error,
        "plan": planned_at - started[0],
        "cpu": ended[0] - started[0],
        "wall": ended[1] - started[1],
        "gib": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20,
        "inputs": before / 2**20,
        **parts,
    }


def main() -> None:
    """Print a table of all cases."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--one", help="a case as JSON, measured in this process")
    asked = parser.parse_args()
    if asked.one:
        print(json.dumps(measure(Case(**json.loads(asked.one)))))
        return
    columns = (
        "lens, megapixels, depths in m, ε, nodes, predicted/allowed, wall s, CPU s, plan, kernels, convolutions, "
        "geometry, rest, peak GiB (inputs)"
    ).split(", ")
    print(f"| {' | '.join(columns)} |\n{'|---' * len(columns)}|", flush=True)
    for case in CASES:
        case = replace(case, megapixels=case.megapixels / 16) if asked.quick else case
        command = [sys.executable, "-m", "tests.benchmarks.forming", "--one", json.dumps(asdict(case))]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        found = json.loads(run.stdout)
        depths = f"{case.near_mm / 1000:g} to {case.far_mm / 1000:g}"
        shares = [found["plan"], *(found[part] for part in PARTS)]
        seconds = " | ".join(
            f"{each:.1f}" for each in (found["wall"], found["cpu"], *shares, found["cpu"] - sum(shares))
        )
        print(
            f"| {case.lens} f/{case.f_number:g} | {case.megapixels:g} | {depths} | {case.rtol:g} | {found['nodes']} "
            f"| {found['error']:.2f} | {seconds} | {found['gib']:.2f} ({found['inputs']:.2f}) |",
            flush=True,
        )


if __name__ == "__main__":
    main()
