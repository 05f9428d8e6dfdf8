"""Points over arrays against the same loop over `render`, in CPU time: ``python -m tests.benchmarks.object_points``.

The least of several rounds counts, and rounds alternate, so that another load on the machine slows both. All numbers
are the same to the last bit.
"""

import warnings
from itertools import product
from time import process_time

import numpy as np

import p2sf

CAMERA = p2sf.Camera("double_gauss_28", focus_mm=3000, f_number=5.6, pixel_um=4)
AXES = {
    "depth_mm": np.linspace(2000, 5000, 5),
    "field_deg": np.linspace(0, 14, 5),
    "wavelength_nm": np.array([450.0, 550.0, 650.0]),
}


def loop(axes: dict[str, np.ndarray]) -> np.ndarray:
    """Return the PSFs of a loop."""
    points = (p2sf.Source(d, field_deg=f, wavelength_nm=w) for d, f, w in product(*axes.values()))
    found = [p2sf.render(CAMERA.its_lens, one, camera=CAMERA).values for one in points]
    return np.array(found).reshape(*map(len, axes.values()), *found[0].shape)


def over_axes(axes: dict[str, np.ndarray]) -> np.ndarray:
    """Return the PSFs of points over the axes."""
    return CAMERA.at(**axes, threads=1).psf()["psf"]


def seconds(work, axes) -> tuple[float, np.ndarray]:
    started = process_time()
    found = work(axes)
    return process_time() - started, found


def main(axes=AXES, rounds: int = 5) -> float:
    """Print and return how many times as long the loop takes; AssertionError where a bit differs."""
    best = [np.inf, np.inf]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for _ in range(rounds):
            (slow, expected), (fast, found) = seconds(loop, axes), seconds(over_axes, axes)
            best = [min(best[0], slow), min(best[1], fast)]
            assert np.array_equal(found, expected)
    print(f"loop {best[0]:.3f} s, points {best[1]:.3f} s of one core: {best[0] / best[1]:.2f} times as fast")
    return best[0] / best[1]


if __name__ == "__main__":
    main()
