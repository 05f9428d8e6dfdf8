"""What databases, plans and pictures of a misaligned lens cost, beside those of the lens set straight.

python -m tests.benchmarks.misaligned_fields
"""

import sys
import tempfile
from math import inf
from pathlib import Path
from time import process_time

import numpy as np

from p2sf.conventions import slope_from_degrees
from p2sf.database.files.npz import save_database
from p2sf.database.fitted_build import build_fitted
from p2sf.database.render import database_psf
from p2sf.database.space import Space
from p2sf.image.form import form_image
from p2sf.lens.lens import Lens, with_f_number
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.fitted import fitted_psf
from p2sf.scene.planning.plan import Plan, plan
from p2sf.scene.planning.verify import verify
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor
from p2sf.spans import depth_nodes
from tests.support.exact_lattice import exact_lattice

ERROR = Placement(0.15, 0.1, 0.02, 0.2, 0.3)  # of the elements between the third and the fifth surface
SCENES = (
    ("one depth", Scene(Sensor(240, 360, 60.0), rtol=0.05, far_mm=inf)),
    ("15 m to infinity", Scene(Sensor(240, 360, 60.0), rtol=0.1, near_mm=15e3)),
)


def timed(work):
    """Return what ``work`` gives, and its CPU seconds."""
    started = process_time()
    return work(), process_time() - started


def databases(straight: Lens, bad: Lens) -> None:
    """Print what databases of both lenses take, from 3 m to infinity, over the middle 20° and 450 to 650 nm."""
    side = slope_from_degrees(np.linspace(-10, 10, 9))
    depths, waves = depth_nodes(3000.0), np.linspace(0.45, 0.65, 5)
    whole = Space(depths, side, waves, side)
    for name, lens, space in (("straight", straight, whole.line), ("misaligned", bad, whole)):
        found, seconds = timed(lambda lens=lens, space=space: build_fitted(lens, space))
        with tempfile.TemporaryDirectory() as folder:
            size = save_database(found, lens, Path(folder) / "a.npz").stat().st_size
        nodes = " × ".join(map(str, found.series.shape[:-1]))
        source = Source(8000.0, field_deg=5.0, wavelength_um=0.55)
        looked = min(timed(lambda f=found, s=source: database_psf(f, s, 64, 1.0))[1] for _ in range(9))
        traced = min(timed(lambda x=lens, s=source: fitted_psf(x, s, 64, 1.0))[1] for _ in range(9))
        print(f"{name}: {nodes} nodes, {found.level.numbers} numbers, {seconds:.2f} s, {size / 1e3:.0f} kB,", end=" ")
        print(f"a PSF {1e3 * looked:.1f} ms, {1e3 * traced:.1f} ms traced; phase {found.errors['phase']:.1e} waves")


def pictures(straight: Lens, bad: Lens) -> None:
    """Print what plans and pictures of both lenses take, and how far kernels are from exact rays."""
    for name, scene in SCENES:
        values = np.random.default_rng(0).random((scene.sensor.rows, scene.sensor.columns, 3)).astype(np.float32)
        for kind, lens in (("straight", straight), ("misaligned", bad)):
            made, planning = timed(lambda x=lens, s=scene: plan(x, s))
            formed, forming = timed(lambda made=made, v=values: form_image(made, v))
            worst = verify(made, 8).worst
            print(f"{name}, {kind}: plan {planning:.2f} s, picture {forming:.2f} s; predicted", end=" ")
            print(f"{made.predicted_error:.3f} of {made.allowed_error:g}, worst of 8 {worst:.3f}")
        exact, seconds = timed(lambda made=made: exact_lattice(made, 3, widest(made)))
        apart = np.linalg.norm(formed - form_image(made, values, lattice=exact)) / np.linalg.norm(formed)
        print(f"{name}, misaligned: nine places by exact rays {seconds:.1f} s; the pictures differ by {apart:.4f}")


def widest(made: Plan) -> int:
    """Return the half width of the widest kernel at the plan's far end, pixels."""
    corners = np.meshgrid(*made.scene.sensor.ends_mm())
    return max(
        int(made.kernels(k, made.vergences[0]).points(*map(np.ravel, corners)).half_widths().max()) for k in range(3)
    )


def main() -> int:
    straight = with_f_number(find_lens("double_gauss_28"), 5.6)
    bad = displaced(straight, 3, 5, ERROR)
    databases(straight, bad)
    pictures(straight, bad)
    return 0


if __name__ == "__main__":
    sys.exit(main())
