"""An earlier checkout beside this one: ``python -m tests.benchmarks.versions OTHER_CHECKOUT [--rounds 15]``.

One process per version stays alive and both take turns, so that a machine whose speed drifts is as fast for one as for
the other; printed are the least CPU times, since other work only adds to them, and their ratio, this version over the
other. The jobs: previews of a field that moves, by each method and `auto`; 12 400 previews; tolerances; a step of each
slider until all panels are painted, at 1440 × 900, at 3840 × 2160 (*wall*), with a matrix of 3 × 3 PSFs on the stage
(*matrix*) and with 15 of them beside the MTF through focus (*inspect*); and whole processes: ``p2sf info``, ``p2sf psf
-o``, ``import p2sf``, that with its first PSF, and the window until its first picture (``--compiled``: with bytecode
at hand, as installed). ``--jobs matrix`` does those jobs alone whose names begin so.
"""

import argparse
import os
import resource
import subprocess
import sys
from pathlib import Path
from tempfile import gettempdir

HERE = Path(__file__).parents[2]
FRAMES = 20  # of one slider in one turn
MOVES = 60  # fields of one turn
WORKER = """
import os, sys
os.environ["QT_QPA_PLATFORM"] = "offscreen"
from itertools import count
from statistics import median
from time import process_time
import numpy as np
from threadpoolctl import threadpool_limits
if sys.argv[1] == "0.1":
    from p2sf.library import find_lens
    from p2sf.psf import seidel_psf
    from p2sf.seidel import coefficients
else:
    from p2sf.lensfile.library import find_lens
    from p2sf.paraxial.seidel import coefficients
    from p2sf.psf.seidel import seidel_psf

lens = find_lens("double_gauss_28")
steps = count()

def moved(method):
    from p2sf.lens.source import Source
    from p2sf.psf import methods
    preview = methods.PsfOptions("preview") if hasattr(methods, "PsfOptions") else "preview"
    spent = []
    for _ in range(MOVES):
        slope = 0.249328 + 1e-4 * (next(steps) % 997)
        begun = process_time()
        if method == "seidel":
            seidel_psf(coefficients(lens, np.inf, slope, 0.6562725), 64, 0.69125, "preview")
        else:
            source = Source(field_slope=slope, wavelength_um=0.6562725)
            methods.render(lens, source, method, 64, 0.69125, preview)
        spent.append(process_time() - begun)
    return min(spent)

def stack():
    depths = 1 / np.linspace(1e-6, 1 / 5000, 20)
    fields, waves = np.linspace(0, 0.1, 20)[:, None], np.linspace(0.4, 0.7, 31)
    six = coefficients(lens, depths[:, None, None], fields, waves)
    begun = process_time()
    seidel_psf(six, 32, 1.5, "preview")
    return process_time() - begun

def tolerances():
    from p2sf.lens.source import Source
    from p2sf.tolerance.builds import simulate
    from p2sf.tolerance.differentials import differentials
    from p2sf.tolerance.errors_of_build import Tolerance, usual_tolerances
    own = (*usual_tolerances(lens, "commercial"), Tolerance("thickness", len(lens.surfaces), 0.2))
    begun = process_time()
    known = differentials(lens, [Source(field_deg=field) for field in (0.0, 10.0, 14.0)], own)
    simulate(known, 2000, (len(own) - 1,))
    return process_time() - begun

def opened():
    from PySide6.QtWidgets import QApplication
    if sys.argv[1] == "0.1":
        from app.state import State as fresh
        from app import theme
        from app.window import Window
    else:
        from p2sf_explorer.charts import theme
        from p2sf_explorer.state.state import new_state as fresh
        from importlib import import_module
        folder = "shell" if sys.argv[1] == "0.2" else "window"
        Window = import_module(f"p2sf_explorer.{folder}.window").MainWindow
    app = QApplication([])
    app.setStyle("Fusion")
    if hasattr(theme, "configure_plots"):  # of pyqtgraph, until 0.3
        theme.configure_plots()
    window = Window(fresh(theme="light", method="seidel"), measured=False)
    window.resize(1440, 900)
    window.show()
    app.processEvents()
    return app, window, fresh

def dragged(app, window, fresh, job, method):
    what, _, key = job.rpartition("-")
    wide = what == "wall"
    state = fresh(theme="light", method=method or "auto", scale_percent=200.0 if wide else 100.0)
    if what in ("matrix", "inspect"):
        from p2sf_explorer.state.workspaces import WORKSPACES, with_workspace
        state = with_workspace(state, "inspect", WORKSPACES["inspect"])
    window.resize(3840, 2160) if wide else window.resize(1440, 900)
    window.store.replace(state)
    if what == "inspect":
        window.store.update(matrix_rows=5, tab="curves", curves_of="focus")
    app.processEvents()
    slider, spent = window.controls.rows[key].slider, []
    window.store.begin()
    for _ in range(FRAMES + 3):
        begun = process_time()
        slider.setValue(650 + (13 * next(steps)) % 350)
        app.processEvents()
        spent.append(process_time() - begun)
    window.store.end()
    return median(spent[3:])

place = None
with threadpool_limits(1):
    print("ready", flush=True)
    for line in sys.stdin:
        job, _, method = line.strip().partition(" ")
        if job == "moving":
            seconds = moved(method)
        elif job in ("stack", "tolerances"):
            seconds = globals()[job]()
        else:
            place = place or opened()
            seconds = dragged(*place, job, method)
        print(seconds, flush=True)
""".replace("FRAMES", str(FRAMES)).replace("MOVES", str(MOVES))
SLIDERS = ("field_deg", "depth_mm", "wavelength_nm", "sensor_shift_um", "f_number")
MATRICES = "matrix-f_number", "matrix-sensor_shift_um", "inspect-f_number", "inspect-depth_mm"
MOVING = tuple(f"moving {method}" for method in ("seidel", "fitted", "traced", "auto"))
FRAME_JOBS = tuple(
    f"{size}{slider} {method}" for size in ("", "wall-") for slider in SLIDERS for method in ("seidel", "auto")
)
FIRST_RENDER = """
import p2sf
lens = p2sf.load_lens("double_gauss_28")
p2sf.render(lens, p2sf.Source(depth_mm=3000, field_deg=10, wavelength_nm=550), focus_mm=3000)
"""
FIRST_PICTURE = """
import os
from PySide6.QtWidgets import QApplication
application = QApplication([])
from p2sf_explorer.charts import theme
from p2sf_explorer.window.window import MainWindow
if hasattr(theme, "configure_plots"):
    theme.configure_plots()
window = MainWindow()
window.show()
application.processEvents()
window.grab()
os._exit(0)
"""
PROCESSES = {
    "p2sf info": ["-m", "p2sf", "info", "double_gauss_28"],
    "p2sf psf": ["-m", "p2sf", "psf", "double_gauss_28", "-o", str(Path(gettempdir()) / "p2sf_versions.tiff")],
    "import p2sf": ["-c", "import p2sf"],
    "first render": ["-c", FIRST_RENDER],
    "first picture": ["-c", FIRST_PICTURE],
}
JOBS = (*MOVING, "stack", "tolerances", *FRAME_JOBS, *MATRICES, *PROCESSES)
SINCE_0_2 = (*MOVING[1:], "tolerances", *MATRICES)


class Version:
    """One checkout: a process that stays alive for its window, and its command line."""

    def __init__(self, folder: Path, compiled: bool = False):
        explorer = folder / "app" / "p2sf_explorer"
        self.layout = "now" if (explorer / "window").is_dir() else "0.2" if explorer.is_dir() else "0.1"
        paths = os.pathsep.join(map(str, (folder, folder / "app")))
        threads = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "P2SF_THREADS": "1"}
        self.environment = os.environ | threads | {"PYTHONPATH": paths, "QT_QPA_PLATFORM": "offscreen"}
        if compiled:
            self.environment.pop("PYTHONDONTWRITEBYTECODE", None)
            self.environment["PYTHONPYCACHEPREFIX"] = str(Path(gettempdir()) / "p2sf_versions_bytecode")
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
        if job in PROCESSES:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            command = [sys.executable, *PROCESSES[job]]
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
    parser.add_argument("--compiled", action="store_true", help="start processes with bytecode at hand, as installed")
    options = parser.parse_args()
    versions = [Version(folder, options.compiled) for folder in (HERE, options.other.resolve())]
    print(f"{'job':28} {'this ms':>9} {'other ms':>9} {'ratio':>6}")
    known = [job for job in JOBS if "0.1" not in {v.layout for v in versions} or job not in SINCE_0_2]
    for job in (job for job in known if job.startswith(tuple(options.jobs))):
        for version in versions:
            version.seconds(job)  # caches and lazy imports
        turns = [[version.seconds(job) for version in versions] for _ in range(options.rounds)]
        this, other = (min(turn[k] for turn in turns) for k in (0, 1))
        print(f"{job:28} {1e3 * this:9.3f} {1e3 * other:9.3f} {this / other:6.3f}", flush=True)


if __name__ == "__main__":
    main()
