"""What rays through the real stop cost over rays through the paraxial pupil: ``python -m tests.benchmarks.aiming``.

Every shipped lens at the fields of its file, far and near. Both fillings take turns in one process, on CPU time, so
that a machine whose speed drifts is as fast for one as for the other; where `traced` has to sum ray by ray through
one of them, both do not do the same, and it is left out. For every call the source's slope changes by a
ten millionth, as a dragged slider changes it; ``known`` are repeated calls with one and the same source.
"""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from math import inf
from statistics import median
from time import process_time

import numpy as np
from threadpoolctl import threadpool_limits

from p2sf.errors import P2SFError
from p2sf.lens.lens import Aim, Lens, with_aim, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import shipped_lenses
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.methods import render
from p2sf.psf.seidel import suitable_pixel_um
from p2sf_explorer.compute.preview import preview, preview_psf, preview_pupil
from p2sf_explorer.compute.setup import default_state, paraxial_setup

PIXELS, TURNS, LONGEST_S = 64, 40, 2.0
AIMS: tuple[Aim, ...] = ("paraxial", "stop")
NEAR_MM = {"relay": 150.0, "reverse_telephoto": 300.0}  # the others 2 m
Work = Callable[[Lens, Source, float], object]


def moving(lens: Lens, source: Source, pixel_um: float) -> object:
    """Return PSF and pupil as the window makes them while a slider moves."""
    traced = preview(replace(paraxial_setup(default_state("singlet_f6")), lens=lens, source=source))
    return traced and (preview_psf(traced, PIXELS, pixel_um), preview_pupil(traced))


def by_method(lens: Lens, source: Source, pixel_um: float, method: str) -> object:
    """Return a settled PSF."""
    return render(lens, source, method, PIXELS, pixel_um)


METHODS: dict[str, Work] = {name: partial(by_method, method=name) for name in ("fitted", "traced", "huygens")}
METHODS = {"moving": moving, **METHODS}


def cases(name: str) -> Iterator[tuple[Lens, Source, float]]:
    """Yield a lens in focus, its sources and the pitch of a window that suits them, in µm."""
    own = paraxial_setup(default_state(name)).lens
    for depth in (inf, NEAR_MM.get(name, 2000.0)):
        lens = with_sensor(own, float(image_distance(own, depth, own.reference_wavelength_um)))
        for field in lens.fields_deg:
            source = Source(depth, field_deg=field, wavelength_nm=1000 * lens.reference_wavelength_um)
            six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
            yield lens, source, float(suitable_pixel_um(six, PIXELS))


def ratio(work: Work, lens: Lens, source: Source, pixel_um: float, known: bool) -> float:
    """Return the least CPU time through the stop over that through the paraxial pupil; other work only adds to it."""
    took: dict[Aim, list[float]] = {aim: [] for aim in AIMS}
    until = process_time() + LONGEST_S
    for turn in range(TURNS + 1):
        if turn > 2 and process_time() > until:
            break
        slope = source.field_slope + (0 if known else 1e-7 * (turn + 1))
        for aim, times in took.items():
            asked = with_aim(lens, aim), Source(source.depth_mm, slope, source.wavelength_um), pixel_um
            begun = process_time()
            work(*asked)
            times.append(process_time() - begun)
    through_stop, paraxial = (min(took[aim][1:]) for aim in reversed(AIMS))
    return through_stop / paraxial


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--methods", nargs="*", default=list(METHODS), choices=METHODS)
    parser.add_argument("--lenses", nargs="*", default=list(shipped_lenses()))
    parser.add_argument("--known", action="store_true", help="the same source in every call")
    asked = parser.parse_args()
    np.ones(1 << 20)  # once a process has freed megabytes it keeps them; before, every array costs page faults
    found: dict[str, list[float]] = {method: [] for method in asked.methods}
    with threadpool_limits(1):
        for name in asked.lenses:
            for lens, source, pixel_um in cases(name):
                line = f"{name:20} {source.field_deg:5.1f}° {source.depth_mm:6g} mm"
                for method in asked.methods:
                    try:
                        times = ratio(METHODS[method], lens, source, pixel_um, asked.known)
                    except P2SFError as error:
                        line += f"  {method} refused ({type(error).__name__})"
                        continue
                    found[method].append(times)
                    line += f"  {method} {times:.2f}"
                print(line, flush=True)
    for method, times in found.items():
        print(f"{method}: median {median(times):.2f}, most {max(times):.2f}, {len(times)} sources")


if __name__ == "__main__":
    main()
