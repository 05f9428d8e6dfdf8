"""Is the automatically chosen pupil sampling fine enough? Measured against one four times finer.

``python -m tests.long.settled_sampling [count]`` tries ``count`` (2000) random (lens, point, window) cases and prints
the worst relative L2 errors and where they are.
"""

import sys
from collections import Counter
from math import inf
from time import process_time

import numpy as np

from p2sf.disc.quadrature import chord_rows
from p2sf.lens.lens import with_f_number, with_sensor
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.seidel import Coefficients, coefficients
from p2sf.paraxial.wavefront import steepest_slope
from p2sf.psf.seidel_stack import corner_reach, stack_parts
from p2sf.psf.seidel_sum import intensities, shape_terms, wave_number
from tests.support.reference import LENSES, prescription_lens, reference

PROMISE = 1e-4
STEEPEST = 850.0  # waves per pupil radius: 200 waves of spherical aberration have 800
LARGE = 500  # rows from which "four times finer" means four times as many nodes, below that four times per side


def random_case(seed: int) -> tuple[str, Coefficients, int, float]:
    """Return (what it is, coefficients, pixels, pitch in µm) of a case whose wavefront is within 200 waves."""
    rng = np.random.default_rng([20, seed])
    while True:
        words, found = random_point(rng)
        pixels, pixel_um = random_window(rng, abs(float(wave_number(found))))
        reach = corner_reach(abs(float(wave_number(found))), pixels, pixel_um)
        if float(steepest_slope(found)) + reach < STEEPEST:
            return f"{words}, {pixels} × {pixel_um:.3g} µm", found, pixels, pixel_um


def random_point(rng) -> tuple[str, Coefficients]:
    name = LENSES[rng.integers(len(LENSES))]
    wavelength_nm = float(rng.choice([float(key) for key in reference(name)["indices"]]))
    depth = inf if rng.random() < 0.3 else float(10 ** rng.uniform(1.5, 6))
    number, slope = float(10 ** rng.uniform(0.1, 2)), float(rng.uniform(0, 0.4) * (rng.random() < 0.9))
    lens = with_f_number(prescription_lens(name, wavelength_nm), number)
    image = float(image_distance(lens, depth, wavelength_nm / 1000))
    focused = coefficients(with_sensor(lens, image), depth, slope, wavelength_nm / 1000)
    wanted = float(rng.choice([-1, 1]) * 10 ** rng.uniform(-2, 2.3))
    shift = wanted * 2e-3 * float(focused.wavelength_um * focused.image_index / focused.na**2)
    found = coefficients(with_sensor(lens, image + shift), depth, slope, wavelength_nm / 1000)
    return f"{name} f/{number:.3g} {depth:.3g} mm slope {slope:.3g} {wavelength_nm} nm Wd {wanted:.3g}", found


def random_window(rng, scale: float) -> tuple[int, float]:
    """Return 1 … 64 samples at a pitch from λ/(100 NA) to 10 λ/NA."""
    pixels = int(np.ceil(2 ** rng.uniform(0, 6)))
    return pixels, float(10 ** rng.uniform(-2, 1)) / scale


def error_of(found: Coefficients, pixels: int, pixel_um: float) -> float:
    """Return the relative L2 error in the window of the settled sampling, unit sum as delivered."""
    [(_, rows)] = stack_parts(shape_terms(found)[None], pixels, pixel_um, "settled")
    sides = 2 * len(rows.eta), 2 * rows.weight.shape[1]  # the nodes are a quarter of the disc
    fine = chord_rows(*((2 if side > LARGE else 4) * side for side in sides))
    ours, truth = (intensities(found, pixels, pixel_um, nodes, np.float64) for nodes in (rows, fine))
    chord_rows.cache_clear()
    ours, truth = ours / ours.sum(), truth / truth.sum()
    return float(np.linalg.norm(ours - truth) / np.linalg.norm(truth))


def main(count: int) -> int:
    start, errors = process_time(), []
    for seed in range(count):
        words, *case = random_case(seed)
        errors.append((error_of(*case), words))
        if errors[-1][0] > PROMISE:
            print(f"{errors[-1][0]:.1e} {words}", flush=True)
    worst = sorted(errors, reverse=True)
    decades = Counter(int(np.floor(np.log10(max(error, 1e-17)))) for error, _ in errors)
    print(f"{count} cases, {process_time() - start:.0f} s of CPU; worst {worst[0][0]:.1e}: {worst[0][1]}")
    print("errors per decade:", {f"1e{key}": decades[key] for key in sorted(decades)})
    return int(worst[0][0] > PROMISE)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000))
