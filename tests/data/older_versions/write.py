"""Write the files of a folder beside this one, by the older version of the program that is on the path.

``git worktree add OLD 5bf45cb2``                                   (0.2.1; 0.3.0 is 5c119c93)
``PYTHONPATH=OLD:OLD/app python tests/data/older_versions/write.py tests/data/older_versions/0.2.1``

A checkout of 0.2.1 takes its version from ``OLD/p2sf/_version.py`` (``__version__ = "0.2.1"``), as a build writes it;
0.3.0 takes it from the installed package. Version 0.1 wrote its folder by an earlier script, with the same contents
and whole pictures.
"""

import json
import sys
from contextlib import redirect_stdout
from dataclasses import replace
from io import StringIO
from pathlib import Path

import numpy as np

from p2sf.cli import main
from p2sf.lens.source import Source
from p2sf.lensfile.library import lenses_folder
from p2sf_explorer.compute.live import live
from p2sf_explorer.files import snapshot
from p2sf_explorer.state.link import link
from p2sf_explorer.state.state import ENTRIES, new_state
from p2sf_explorer.state.state_files import state_to_dict

try:
    from p2sf.database.files.npz import load_database
    from p2sf.database.files.stack import open_stack
except ImportError:  # until 0.2.1
    from p2sf.database_files.npz import load_database
    from p2sf.database_files.stack import open_stack

try:
    from p2sf.database.render import database_psf
except ImportError:
    from p2sf.database.rendering import database_psf

FOLDER = Path(sys.argv[1])
LENS = "achromat_f6"
SPACE = "--depths-mm 1000:4000:2 --fields-deg 0:2:2 --wavelengths-nm 500:600:2".split()
DATABASES = {
    "exact": ("--method", "seidel"),
    "table1": ("--method", "seidel", "--interpolant", "table1"),
    "linear": ("--method", "seidel", "--interpolant", "linear"),
    "fitted": ("--method", "fitted"),
}
PRINTED = ("strehl", "energy", "predicted_error", "pixel_um", "method")
TERMS = ("w40", "w31", "w22", "w20", "w11", "wd")

MOVED = {"depth_mm": 3000.0, "focus_mm": 3000.0, "field_deg": 7.25, "f_number": 5.6, "theme": "dark"}
MASKED = {
    **{"lens": "tessar", "field_deg": 4.0, "method": "fitted", "clip": True, "obscuration": 0.3, "vanes": 3},
    **{"vane_width": 0.04, "vane_angle_deg": 30.0, "blades": 7, "roundness": 0.25, "blade_angle_deg": 12.0},
    **{"apodisation": 0.9, "apodisation_power": 4, "cubic_um": 0.5},
}
BY_HAND = {"added_waves": (0.5, -1.0, 0.0, 0.0, 0.25, 0.0), "muted": ("w22",), "free_pupil": True}
COMPARED = {
    "field_deg": 3.0,
    "pinned": new_state(f_number=8.0, method="seidel"),
    "shown": "b",
    "linked": ("field_deg",),
}
EVERYTHING = {
    **{"lens": "cooke_triplet", "lens_text": (lenses_folder() / "cooke_triplet.toml").read_text(encoding="utf-8")},
    **{"depth_mm": 2500.0, "sensor_shift_um": -12.5, "field_x_deg": 1.5, "wavelength_nm": 546.1, "stop": "auto"},
    **{"aim": "paraxial", "clip": True, "method": "traced", "tolerance": 0.999, "zoom": 1.5, "focus_position": 2.5},
    **{"errors": (("decentre_y", 3, 4, 0.05),), "solo": ("w31",), "psf_scale": "log", "psf_units": "strehl"},
    **{"phase": "contour", "colours": "cividis", "language": "de", "workspace": "compare", "stage": "mtf"},
    **{"rail": ("psf", "spot"), "rail_side": "bottom", "rail_shares": (0.25, 0.75), "stage_share": 0.6},
    **{"show_rail": False, "show_controls": False, "show_pupil_shape": True, "full_bleed": True, "tab": "mtf"},
    **{"windows": ("spot", "psf"), "scale_percent": 125.0, "pixel_um": 3.45, "blur_um": 20.0},
    **{"spectrum": "planck:3200", "rays_coloured": "field", "rays_count": 5, "keep_focus": "rms", "exaggerated": 10},
    **{"show_field_x": True, "caption": ("lens", "strehl"), "playback_slider": "field_deg"},
    **{"playback_range": (0.0, 10.0), "playback_seconds": 7.5, "playback_subject": "psf", "photo_source": "text"},
    **{"photo_pixel_um": None, "photo_show": "axis", "photo_split": 0.25, "photo_full": True, "photo_look": "blink"},
    **{"photo_depths": "slope", "photo_depth_meaning": "near_black", "photo_near_mm": 800.0, "photo_far_mm": 9000.0},
    **{"measured_picture": "points.png", "measured_pixel_um": 5.0, "measured_beside": False},
    **{"measured_encoding": "linear", "lesson_name": "05_coma", "lesson_step": 1, "lesson_told": True},
    **{"camera_turn_deg": -30.0, "camera_tilt_deg": 45.0, "camera_zoom": 2.5, "camera_surface_turn_deg": 60.0},
    **{"camera_surface_tilt_deg": 20.0, "matrix_what": "mtf", "matrix_across": "depth_mm", "matrix_rows": 2},
    **{"matrix_columns": 4, "matrix_fields_deg": (0.0, 7.0), "matrix_wavelengths_nm": (450.0, 650.0)},
    **{"matrix_depths_mm": (1000.0, 3000.0), "matrix_shifts_um": (-50.0, 50.0), "matrix_shared": False},
    **{"curves_of": "colours", "curves_count": 3, "curves_fields_deg": (0.0, 5.0)},
    **{"curves_frequencies_per_mm": (20.0, 40.0), "tolerances_grade": "commercial", "tolerances_criterion": "mtf"},
    **{"tolerances_limit": 0.2, "tolerances_frequency_per_mm": 30.0, "tolerances_own": (("tilt_x", 1, 2, 0.1),)},
    **{"tolerances_compensators": (("thickness", 2, 2),), "tolerances_draw": 3, "tolerances_build": 2},
    **{"seidel_sum": "w31", "zernike_order": "fringe", "database_coefficient": "w40", "database_rule": "linear"},
    **{"accuracy_plot": "time", "exactness_measure": "mtf"},
}
STATES = {"plain": {}, "moved": MOVED, "masked": MASKED, "by_hand": BY_HAND, "compared": COMPARED}
STATES["everything"] = {name: value for name, value in EVERYTHING.items() if name in ENTRIES}


def run(*words: object) -> str:
    """Run a command of the old version, which has to succeed; return what it printed."""
    with redirect_stdout(StringIO()) as printed:
        if main([str(word) for word in words]):
            raise SystemExit(f"p2sf {' '.join(map(str, words))} failed")
    return printed.getvalue()


def write_databases() -> dict:
    """Write a database of every kind and a stack; return what this version looks up in them."""
    found = {}
    for name, kind in DATABASES.items():
        run("database", "build", LENS, "-o", FOLDER / f"{name}.npz", *SPACE, *kind)
    for name in ("exact", "table1", "linear"):
        six = load_database(FOLDER / f"{name}.npz").database.coefficients(2000.0, 0.02, 0.55)
        found[name] = {term: float(getattr(six, term)) for term in TERMS}
    fitted = load_database(FOLDER / "fitted.npz").database
    found["fitted"] = database_psf(fitted, Source(4000.0, 0.02, 0.57), 8, 2.0).values.tolist()
    stack = ("--stack", "--pixels", "8", "--pixel-um", "2")
    run("database", "build", LENS, "-o", FOLDER / "stack.zarr", *SPACE, *DATABASES["exact"], *stack)
    found["stack"] = open_stack(FOLDER / "stack.zarr").psf[1, 1, 0].tolist()
    return found


def write_psfs() -> dict:
    """Write one PSF as a .npz, .csv and .tiff; return its samples, and what the command printed with --json."""
    words = "--field-deg 1 --wavelength-nm 550 --pixels 12 --pixel-um 1.5 --method fitted".split()
    for ending in ("csv", "tiff"):
        run("psf", LENS, *words, "-o", FOLDER / f"psf.{ending}")
    printed = json.loads(run("psf", LENS, *words, "-o", FOLDER / "psf.npz", "--json"))
    with np.load(FOLDER / "psf.npz") as arrays:
        return {"values": arrays["psf"].tolist(), "printed": {name: printed[name] for name in PRINTED}}


def write_states() -> dict:
    """Write states, links and snapshots; return the states as plain values, and the middle of their pictures."""
    found, links, pictures = {}, {}, {}
    for name, changes in STATES.items():
        state = new_state(**changes)
        found[name], links[name] = state_to_dict(state), link(state)
        snapshot.write_state(state, FOLDER / f"{name}.json")
    (FOLDER / "links.json").write_text(json.dumps(links, indent=1))
    for name in ("moved", "masked", "by_hand"):
        answer = live(new_state(**STATES[name]))
        middle = answer.psf.values.shape[0] // 2
        inner = slice(middle - 4, middle + 4)
        values = answer.psf.values[inner, inner]
        pictures[name] = {"pixel_um": answer.psf.pixel_um, "middle": values.astype(float).tolist()}
        if name == "moved":
            small = replace(answer, request=None, psf=replace(answer.psf, values=values))
            for ending in ("npz", "tiff", "fits", "csv"):
                snapshot.write_data(small, FOLDER / f"snapshot_moved.{ending}")
    dot = bytes.fromhex(
        "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c63f8ffff3f0005fe02fea7"
        "9a8ca90000000049454e44ae426082"
    )
    snapshot.write_picture(new_state(**COMPARED), dot, FOLDER / "snapshot_compared.png")
    return {"states": found, "pictures": pictures}


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    told = write_states() | {"looked_up": write_databases(), "psf": write_psfs()}
    (FOLDER / "expected.json").write_text(json.dumps(told, separators=(",", ":"), ensure_ascii=False))
