"""Pictures a second, and the error, of a picture with depth that follows a drag; a photo seen through three lenses.

``python -m tests.benchmarks.focus_pull`` prints a table; ``--windows`` chooses 1440, 3840 or both, ``--drags`` some of
focus, f-number, zoom and tilt (of the sensor), ``--exact 0`` leaves out the exact pictures, which take most of the
time, and ``--rest`` times those that follow in the window. A picture counts from the setting of the lens to the pixels
that are painted, and no setting comes twice. Times are the median and the worst of eight settings, each the least of
two that differ by a millionth; the machine's load is beside them. The error is RMS, of white, against the picture by a
plan of relative error 0.02, but for a rim of eight pixels.
"""

import argparse
import os
import tempfile
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np

from p2sf.image.charts import draw_chart
from p2sf.image.form import form_image
from p2sf.io.photo_files import write_photo
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.views.depths import depth_map
from p2sf_explorer.compute.views.image import (
    ImageRequest,
    on_stage,
    planned_picture,
    question,
    scene_of,
)
from p2sf_explorer.compute.views.moving_image import Keeper, moving
from p2sf_explorer.state.state import change, new_state

DRAGS = "focus", "f-number", "zoom", "tilt"
ROOMS = {1440: (846, 1420), 3840: (2088, 3800)}  # pixels of the stage when presenting, the line of controls left out
LENSES: dict[str, dict[str, Any]] = {
    "cooke_triplet": {"photo_pixel_um": 8.0, "photo_near_mm": 900.0, "photo_far_mm": 4000.0},
    "double_gauss_28": {"photo_pixel_um": 16.0, "photo_near_mm": 2000.0, "photo_far_mm": 6000.0, "f_number": 8.0},
    "tessar": {"photo_pixel_um": 1.5, "photo_near_mm": 200.0, "photo_far_mm": 2000.0},
}
ZOOM = {"zoom_3x": {"photo_pixel_um": 8.0, "photo_near_mm": 1500.0, "photo_far_mm": 6000.0, "f_number": 8.0}}
SCENES = {
    "print, sloping": {"photo_source": "text", "photo_depths": "slope"},
    "landscape, three depths": {"photo_source": "landscape", "photo_depths": "steps"},
    "star before a landscape": {"photo_source": "star", "photo_depths": "map"},
}
STEPS, EXACT = 8, 0.02  # settings from one end of a drag to the other; relative error of the exact picture
RIM = 8
OTHER = 1 + 1e-6  # times a setting: of no other picture, and for nothing that is kept by its numbers the same


@dataclass(frozen=True)
class Row:
    """A drag of one lens and scene: milliseconds a picture, the stated and the true error, and seconds at rest."""

    drag: str
    lens: str
    scene: str
    shape: tuple[int, int]
    cpu_ms: float
    worst_ms: float
    wall_ms: float
    stated: float
    true: float
    rest_s: float


def settings(drag: str, lens: str) -> list[dict[str, Any]]:
    """Return the entries of a state that a drag goes through, twice, the second time by a millionth otherwise."""
    usual = LENSES.get(lens) or ZOOM[lens]
    near, far = (usual[f"photo_{end}_mm"] for end in ("near", "far"))
    focus = 1 / np.linspace(1 / near, 1 / far, STEPS)
    open_at, behind = usual.get("f_number", 4.0), len(find_lens(lens).surfaces) + 1
    values: dict[str, list[dict[str, Any]]] = {}
    for times in (1.0, OTHER):
        still = {"focus_mm": float(focus[STEPS // 2]) * times}
        values.setdefault("focus", []).extend({"focus_mm": float(d) * times} for d in focus)
        values.setdefault("f-number", []).extend(
            still | {"f_number": float(n)} for n in np.geomspace(open_at, 4 * open_at, STEPS)
        )
        values.setdefault("zoom", []).extend(still | {"zoom": float(z)} for z in np.linspace(24.0, 50.0, STEPS))
        values.setdefault("tilt", []).extend(
            still | {"errors": (("tilt_x", behind, behind, float(t)),)} for t in np.linspace(-2.0, 2.0, STEPS)
        )
    return values[drag]


def star_before_a_landscape(folder: Path, shape: tuple[int, int] = (1040, 1560)) -> dict[str, str]:
    """Write a photo of a star before a landscape and its map of depths; return their paths as entries of a state."""
    row, column = np.mgrid[: shape[0], : shape[1]]
    star = np.hypot(row - shape[0] / 2, column - shape[1] / 2) < 0.3 * shape[0]
    both = np.where(star[..., None], draw_chart("siemens_star", *shape), draw_chart("landscape", *shape))
    write_photo(folder / "star.png", both)
    write_photo(folder / "star_depth.png", star.astype(float), "linear", "16")
    return {"photo_source": str(folder / "star.png"), "photo_depths": str(folder / "star_depth.png")}


def asked_for(lens: str, scene: dict[str, str], room: tuple[int, int], changes: dict[str, Any]) -> ImageRequest:
    """Return the request for a picture on the stage through a lens as it is set."""
    usual = LENSES.get(lens) or ZOOM[lens]
    state = change(new_state(lens=lens, method="seidel", field_deg=0.0), **(usual | scene | changes))
    return on_stage(question(live(state, "preview")).question, room)


def row(
    drag: str, lens: str, scene: tuple[str, dict[str, str]], room: tuple[int, int], exact: float, rest: bool
) -> Row:
    """Return the figures of a drag; with ``exact`` 0 without the true error, and of the rest only with ``rest``."""
    name, entries = scene
    keeper, spent = Keeper(), []
    asked = [asked_for(lens, entries, room, changes) for changes in settings(drag, lens)]
    moving(replace(asked[0], lens=asked[STEPS // 2].lens), keeper=keeper)
    for request in asked:
        begun = process_time(), perf_counter()
        assert moving(request, keeper=keeper).painted.size
        spent.append((1e3 * (process_time() - begun[0]), 1e3 * (perf_counter() - begun[1])))
    middle = asked[STEPS // 2]
    found = moving(middle, keeper=keeper)
    true = seconds = float("nan")
    if rest:
        begun_s = process_time()
        planned_picture(middle)
        seconds = process_time() - begun_s
    if exact:
        whole = replace(scene_of(middle), rtol=exact)
        depths = depth_map(middle.depths, middle.photo, middle.shape)
        best = form_image(plan(middle.lens, whole), found.before, depths)
        true = float(np.sqrt(np.mean(np.square(found.after - best)[RIM:-RIM, RIM:-RIM])))
    cpu, wall = np.min(np.reshape(spent, (2, STEPS, 2)), axis=0).T  # what else runs on the machine only adds
    times = float(np.median(cpu)), float(cpu.max()), float(np.median(wall))
    return Row(drag, lens, name, middle.shape, *times, found.error or 0.0, true, seconds)


def photo_through_three_lenses(folder: Path, room: tuple[int, int]) -> tuple[float, float, int]:
    """Return CPU and clock seconds from a JPEG of 12 megapixels and its map to three pictures, and its megapixels."""
    from PIL import Image

    shape = 3000, 4000
    names = star_before_a_landscape(folder, (750, 1000))
    for path in names.values():
        with Image.open(path) as small:
            small.resize(shape[::-1]).save(Path(path).with_suffix(".png"))
    with Image.open(names["photo_source"]) as large:
        large.save(folder / "star.jpg", quality=92)
    names["photo_source"] = str(folder / "star.jpg")
    asked = [asked_for(lens, names, room, settings("focus", lens)[2]) for lens in LENSES]
    keeper, begun = Keeper(), (process_time(), perf_counter())
    for request in asked:
        assert moving(request, keeper=keeper).painted.size
    return process_time() - begun[0], perf_counter() - begun[1], shape[0] * shape[1] // 10**6


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--windows", type=int, nargs="+", choices=ROOMS, default=list(ROOMS))
    parser.add_argument("--drags", nargs="+", choices=DRAGS, default=DRAGS)
    parser.add_argument("--exact", type=float, default=EXACT)
    parser.add_argument("--rest", action="store_true")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scenes = dict(SCENES) | {"star before a landscape": star_before_a_landscape(folder)}
        print(
            "window  drag      lens             scene                    pixels       CPU ms  worst  clock ms  stated",
            end="",
        )
        print("    true  at rest  load")
        for window, drag in product(given.windows, given.drags):
            for lens, scene in product(ZOOM if drag == "zoom" else LENSES, scenes.items()):
                made = row(drag, lens, scene, ROOMS[window], given.exact, given.rest)
                which = f"{drag:8}  {lens:15}  {made.scene:23}  {made.shape[1]} × {made.shape[0]}"
                print(
                    f"{window:6}  {which:65}  {made.cpu_ms:6.0f} {made.worst_ms:6.0f}"
                    f"  {made.wall_ms:8.0f}  {made.stated:.4f}  {made.true:.4f}  {made.rest_s:5.1f} s"
                    f"  {os.getloadavg()[0]:4.1f}",
                    flush=True,
                )
        cpu, wall, mega = photo_through_three_lenses(folder, ROOMS[given.windows[0]])
        print(f"{mega} megapixels, JPEG and PNG, through three lenses: CPU {cpu:.2f} s, clock {wall:.2f} s")


if __name__ == "__main__":
    main()
