"""What a mask in the stop costs beside the clear disc: ``python -m tests.benchmarks.masks [--rounds 15]``.

Lens by lens and method by method, the picture behind each mask and that of the clear disc are made in turns, each time
of a new source, so that nothing but what belongs to mask and window is kept from before. Printed are the median CPU
time of the disc, the median ratio of each mask to it, and how far each picture is from one of many more nodes (relative
L2 in the window): all methods are asked for SETTLED_TOLERANCE, so that costs are compared at equal accuracy.
"""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import count
from statistics import median
from time import thread_time

import numpy as np
from threadpoolctl import threadpool_limits

from p2sf.disc.mask import CLEAR, PupilMap, PupilMask
from p2sf.lens.lens import Lens, with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.fitted import fit, fitted_intensity, fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import whole_pixel_um
from p2sf.psf.seidel import seidel_psf
from p2sf.psf.seidel_stack import as_fit
from p2sf.psf.traced import traced_psf
from p2sf.pupil.plane_waves import counts_for, window_reach_um
from p2sf.pupil.seen_mask import mask_seen
from p2sf.threads import using_threads
from tests.support.waves import relative_l2

PIXELS = 64
APART = 1e-9  # of the field's slope from one source to the next: as many nodes, and nothing kept
CASES = (("double_gauss_28", 10.0), ("cooke_triplet", 14.0), ("cassegrain_f10", 0.2))
MASKS = {
    "ring 0.35": PupilMask(obscuration=0.35),
    "6 blades": PupilMask(blades=6),
    "6 blades, 7°": PupilMask(blades=6, blade_angle_deg=7),
    "5 round blades": PupilMask(blades=5, roundness=0.4, blade_angle_deg=11),
    "4 vanes": PupilMask(obscuration=0.3, vanes=4, vane_width=0.02),
    "Gaussian": PupilMask(apodisation=0.7),
    "phase map": PupilMask(phase_map=PupilMap.sampled(lambda xi, eta: 0.2 * np.sin(3 * xi + 1) * np.cos(2 * eta))),
    "cubic phase": PupilMask(cubic_um=1.0),
}
FINER = 1e-6  # agreement to which the reference of exact rays is driven


@dataclass(frozen=True)
class Case:
    """One lens without and with a mask, a source and the pitch of the window."""

    lens: Lens
    source: Source
    pixel_um: float

    def again(self, step: int) -> "Case":
        """Return the same with a source that differs next to nothing."""
        return replace(self, source=replace(self.source, field_slope=self.source.field_slope + step * APART))


def _seidel(case: Case) -> np.ndarray:
    lens, source = case.lens, case.source
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return seidel_psf(six, PIXELS, case.pixel_um, mask=mask_seen(lens, source)).values


def _method(made: Callable) -> Callable[[Case], np.ndarray]:
    return lambda case: made(case.lens, case.source, PIXELS, case.pixel_um).values


METHODS = {
    "seidel": _seidel,
    "fitted": _method(fitted_psf),
    "traced": _method(traced_psf),
    "huygens": _method(huygens_psf),
}


def finer(method: str, case: Case) -> np.ndarray:
    """Return the picture by many more nodes, and where there is one by the plain sum."""
    lens, source = case.lens, case.source
    if method == "seidel":
        six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
        found = as_fit(six, mask_seen(lens, source))
    if method == "fitted":
        found = fit(lens, source)
    if method in ("seidel", "fitted"):
        radial, angular = counts_for(found.steepness, window_reach_um(2 * PIXELS, case.pixel_um))
        return unit(fitted_intensity(found, (radial, angular), PIXELS, case.pixel_um))
    return huygens_psf(lens, source, PIXELS, case.pixel_um, rtol=FINER).values


def unit(values: np.ndarray) -> np.ndarray:
    """Return values of unit sum."""
    return values / values.sum()


def spent(work: Callable[[Case], np.ndarray], case: Case, steps: Iterator[int]) -> float:
    """Return the CPU time of one picture, s."""
    changed, begun = case.again(next(steps)), thread_time()
    work(changed)
    return thread_time() - begun


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--methods", nargs="*", default=METHODS, choices=METHODS)
    parser.add_argument("--masks", nargs="*", default=MASKS, choices=MASKS)
    parser.add_argument("--lenses", nargs="*", default=[name for name, _ in CASES])
    given, steps = parser.parse_args(), count()
    with threadpool_limits(1), using_threads(1):
        for name, field_deg in (case for case in CASES if case[0] in given.lenses):
            plain, source = with_mask(find_lens(name), CLEAR), Source(field_deg=field_deg)
            pixel_um = whole_pixel_um(plain, source, PIXELS)
            cases = {label: Case(with_mask(plain, MASKS[label]), source, pixel_um) for label in given.masks}
            cases = {"disc": Case(plain, source, pixel_um)} | cases
            for method in given.methods:
                _compare(f"{name} {field_deg:g}°, {method}", method, cases, given.rounds, steps)


def _compare(title: str, method: str, cases: dict[str, Case], rounds: int, steps: Iterator[int]) -> None:
    work = METHODS[method]
    apart = {label: relative_l2(work(case), finer(method, case)) for label, case in cases.items()}
    turns = [{label: spent(work, case, steps) for label, case in cases.items()} for _ in range(rounds)]
    disc = 1e3 * median(turn["disc"] for turn in turns)
    print(f"{title}: the disc takes {disc:.2f} ms, {apart['disc']:.0e} from finer nodes", flush=True)
    for label in list(cases)[1:]:
        ratio = median(turn[label] / turn["disc"] for turn in turns)
        print(f"    {label:16} {ratio:6.2f} × the disc, {apart[label]:.0e}", flush=True)


if __name__ == "__main__":
    main()
