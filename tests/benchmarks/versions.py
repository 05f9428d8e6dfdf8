"""An earlier checkout beside this one: ``python -m tests.benchmarks.versions OTHER_CHECKOUT [--rounds 15]``.

One process per version stays alive and both take turns, so that a machine whose speed drifts is as fast for one as for
the other; printed are medians of CPU time and the median of the ratios, this version over the other. The jobs: a step
of each slider until all panels are painted, also with a matrix of 3 × 3 PSFs on the stage, 12 400 previews of PSFs, and
``p2sf info`` as a whole process. ``--jobs matrix`` does those jobs alone whose names begin so.
"""

import argparse
import os
import resource
import subprocess
import sys
from pathlib import Path
from statistics import median

HERE = Path(__file__).parents[2]
FRAMES = 20  # of one slider in one turn
WORKER = """
import os, sys
os.environ["QT_QPA_PLATFORM"] = "offscreen"
from itertools import count
from statistics import median
from time import process_time
import numpy as np
from PySide6.QtWidgets import QApplication
from threadpoolctl import threadpool_limits
if sys.argv[1] == "0.1":
    from app.state import State
    from app.theme import configure_plots
    from app.window import Window
    from p2sf.library import find_lens
    from p2sf.psf import seidel_psf
    from p2sf.seidel import coefficients
    fresh = State
else:
    from p2sf.lensfile.library import find_lens
    from p2sf.paraxial.seidel import coefficients
    from p2sf.psf.seidel import seidel_psf
    from p2sf_explorer.charts.theme import configure_plots
    from p2sf_explorer.shell.window import MainWindow as Window
    from p2sf_explorer.state.state import new_state as fresh
lens = find_lens("double_gauss_28")
depths = 1 / np.linspace(1e-6, 1 / 5000, 20)
six = coefficients(lens, depths[:, None, None], np.linspace(0, 0.1, 20)[:, None], np.linspace(0.4, 0.7, 31))
app = QApplication([])
app.setStyle("Fusion")
configure_plots()
steps = count()
with threadpool_limits(1):
    window = Window(fresh(theme="light", method="seidel"), measured=False)
    window.resize(1440, 900)
    window.show()
    app.processEvents()
    print("ready", flush=True)
    for line in sys.stdin:
        job, _, method = line.strip().partition(" ")
        if job == "stack":
            begun = process_time()
            seidel_psf(six, 32, 1.5, "preview")
            print(process_time() - begun, flush=True)
            continue
        state = fresh(theme="light", method=method or "auto")
        if job.startswith("matrix"):
            from p2sf_explorer.state.workspaces import WORKSPACES, with_workspace
            state = with_workspace(state, "inspect", WORKSPACES["inspect"])
            job = job.removeprefix("matrix-")
        window.store.replace(state)
        app.processEvents()
        slider, spent = window.controls.rows[job].slider, []
        window.store.begin()
        for _ in range(FRAMES + 3):
            begun = process_time()
            slider.setValue(650 + (13 * next(steps)) % 350)
            app.processEvents()
            spent.append(process_time() - begun)
        window.store.end()
        print(median(spent[3:]), flush=True)
""".replace("FRAMES", str(FRAMES))
SLIDERS = ("field_deg", "depth_mm", "wavelength_nm", "sensor_shift_um", "f_number")
MATRICES = "matrix-f_number", "matrix-sensor_shift_um"
JOBS = (*(f"{slider} {method}" for slider in SLIDERS for method in ("seidel", "auto")), *MATRICES, "stack", "p2sf info")


class Version:
    """One checkout: a process that stays alive for its window, and its command line."""

    def __init__(self, folder: Path):
        self.layout = "now" if (folder / "app" / "p2sf_explorer").is_dir() else "0.1"
        paths = os.pathsep.join(map(str, (folder, folder / "app")))
        threads = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "P2SF_THREADS": "1"}
        self.environment = os.environ | threads | {"PYTHONPATH": paths, "QT_QPA_PLATFORM": "offscreen"}
        self.process = subprocess.Popen(
            [sys.executable, "-c", WORKER, self.layout],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=self.environment,
            cwd=folder,
        )
        assert self.process.stdout.readline().strip() == "ready"

    def seconds(self, job: str) -> float:
        """Return the CPU time of one turn of a job."""
        if job == "p2sf info":
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            command = [sys.executable, "-m", "p2sf", "info", "double_gauss_28"]
            subprocess.run(command, env=self.environment, stdout=subprocess.DEVNULL, check=True, cwd="/")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.process.stdin.write(f"{job}\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("other", type=Path, help="folder of the earlier checkout")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--jobs", nargs="*", default=[""], help="beginnings of the names of jobs")
    options = parser.parse_args()
    versions = [Version(HERE), Version(options.other.resolve())]
    print(f"{'job':28} {'this ms':>9} {'other ms':>9} {'ratio':>6}")
    known = [job for job in JOBS if "0.1" not in {v.layout for v in versions} or not job.startswith("matrix")]
    for job in (job for job in known if job.startswith(tuple(options.jobs))):
        for version in versions:
            version.seconds(job)  # caches and lazy imports
        turns = [[version.seconds(job) for version in versions] for _ in range(options.rounds)]
        this, other = (median(turn[k] for turn in turns) for k in (0, 1))
        ratio = median(turn[0] / turn[1] for turn in turns)
        print(f"{job:28} {1e3 * this:9.2f} {1e3 * other:9.2f} {ratio:6.3f}", flush=True)


if __name__ == "__main__":
    main()
