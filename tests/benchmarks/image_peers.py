"""A picture through a lens file by another program, at its defaults; `image_simulation` runs it by that one's Python.

``python image_peers.py optiland|deeplens TASK.npz LENS.zmx ANSWER.npz`` reads the picture and its camera and writes the
formed picture and the CPU seconds that it took, without the import. Only numpy and the program are needed.
"""

import sys
from time import process_time

import numpy as np

MARGIN = 64  # pixels that optiland adds on either side, over which its fields are spread too


def optiland(task: dict[str, np.ndarray], lens_file: str) -> tuple[np.ndarray, float]:
    """Return the picture by 5 × 5 PSFs of 128² samples, three of their components; one depth, the distance in focus.

    A sample of its PSF is a pixel of its picture; ``oversample`` brings the picture to that scale. Its fields fill a
    square about the axis, so the picture is put into one.
    """
    from optiland.analysis.image_simulation.engine import ImageSimulationEngine
    from optiland.fileio import load_zemax_file

    values = task["values"]
    rows, columns = values.shape[:2]
    edge = columns - rows
    square = np.pad(values, ((edge // 2, edge - edge // 2), (0, 0), (0, 0)), mode="edge")
    started = process_time()
    lens = load_zemax_file(lens_file)
    lens.set_aperture("EPD", float(task["pupil_mm"]))
    lens.set_thickness(float(task["focus_mm"]), 0)
    half_mm = (columns / 2 + MARGIN) * task["pixel_mm"]
    lens.fields.fields.clear()
    lens.set_field_type("angle")
    for part in (0.0, 1.0):
        lens.add_field(y=part * float(np.rad2deg(np.arctan(half_mm / task["focal_mm"]))))
    engine = ImageSimulationEngine(
        lens, {"wavelengths": task["wavelengths_um"].tolist(), "oversample": int(task["oversample"])}
    )
    found = np.asarray(engine.run(square))[0]
    spent = process_time() - started
    return np.moveaxis(found, 0, -1)[edge // 2 : edge // 2 + rows], spent


def deeplens(task: dict[str, np.ndarray], lens_file: str) -> tuple[np.ndarray, float]:
    """Return the picture by 8 × 8 PSFs of 64² pixels by rays at 16 depths, `GeoLens.render_rgbd` as it is."""
    import torch
    from deeplens.geolens import GeoLens

    torch.set_num_threads(1)
    values = task["values"]
    rows, columns = values.shape[:2]
    started = process_time()
    with open(lens_file, "a", encoding="utf-8") as file:  # the sensor's half diagonal, which its reader requires
        file.write(f"  DIAM {np.hypot(rows, columns) / 2 * task['pixel_mm']}\n")
    lens = GeoLens(lens_file, device=torch.device("cpu"), wvln_rgb=tuple(task["wavelengths_um"].tolist()))
    lens.r_sensor = float(np.hypot(rows, columns) / 2 * task["pixel_mm"])
    lens.set_sensor_res((columns, rows))
    picture = torch.tensor(np.moveaxis(values, -1, 0)[None].copy(), dtype=torch.float32)
    depth = torch.tensor(np.minimum(task["depth_mm"], task["farthest_mm"])[None, None], dtype=torch.float32)
    with torch.no_grad():
        found = lens.render_rgbd(picture, depth, method="psf_map").numpy()[0]
    return np.moveaxis(found, 0, -1), process_time() - started


if __name__ == "__main__":
    program, task_file, lens_path, answer = sys.argv[1:]
    with np.load(task_file) as given:
        formed, seconds = {"optiland": optiland, "deeplens": deeplens}[program](dict(given), lens_path)
    np.savez(answer, picture=formed, seconds=seconds)
