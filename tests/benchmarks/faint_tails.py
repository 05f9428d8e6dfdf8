"""What a picture of 2048² samples with faint tails costs beside a transform of that size, and how true the tails are.

``python -m tests.benchmarks.faint_tails`` sums the waves of a pupil into 2048² samples λ/4NA apart, with blades and
vanes, in turn with one complex64 FFT: the least CPU time of many rounds of each. Then it compares the light at 20 to
200 Airy radii with a sum of plane waves by exact rays, on the same samples.
"""

from collections.abc import Callable
from dataclasses import replace
from time import process_time

import numpy as np
import scipy.fft

from p2sf.disc.mask import PupilMask
from p2sf.disc.transform import sum_plane_waves
from p2sf.lens.lens import Lens, with_f_number, with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.pixels import PixelWindow, rim_gain, sampled_light
from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.pupil.plane_waves import pupil_amplitude
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.pencil import rays_through
from p2sf.threads import using_threads

SIDE, ROUNDS, AIRY, FARTHEST = 2048, 15, 0.61, 200
MASKS = {
    "clear": PupilMask(),
    "six blades": PupilMask(blades=6),
    "four vanes": PupilMask(vanes=4),
    "both, obscured": PupilMask(blades=6, vanes=4, obscuration=0.3),
}
SOURCE = Source(field_deg=7)
RADII, AZIMUTHS, PATCH = (20, 50, 100, 200), 12, 8  # Airy radii; patches on each ring, and samples along their sides
NODES = 300, 1800  # at 200 Airy radii a wave turns 122 times from the middle to the rim, 1530 about it


def pupil_of(lens: Lens) -> PupilStack:
    """Return the pupil with all that stands in it."""
    return replace(pupil_map(lens, SOURCE, "fitted", None), mask=mask_seen(lens, SOURCE))


def picture(pupil: PupilStack, side: int = SIDE) -> np.ndarray:
    """Return the light at samples λ/4NA apart, row 0 at the bottom, true to FARTHEST Airy radii."""
    radius = pupil.radius.item()
    pitch = 1 / (4 * radius)
    light = sampled_light(pupil, np.zeros(1), PixelWindow((side - 1) // 2, pitch, 1), np.zeros((1, 2)))[0]
    half, middle = min(int(FARTHEST * AIRY / radius / pitch) + 1, (side - 1) // 2), (side - 1) // 2
    near = slice(middle - half, middle + half + 1)
    light[near, near] *= rim_gain(half, pitch, side * pitch, pupil.reach_um.item())
    return light


def exact(lens: Lens) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """Return the function from a grid of points, µm from the chief ray, to their light by a sum over exact rays."""
    rays = rays_through(lens, SOURCE, pupil_nodes(lens, SOURCE, NODES).unfolded())
    amplitude = pupil_amplitude(rays.share * rays.amplitude, rays.phase)

    def light(across: np.ndarray, up: np.ndarray) -> np.ndarray:
        field = sum_plane_waves(amplitude, rays.fx, rays.fy, across, up, even=False)
        return field.real**2 + field.imag**2

    return light


def tails(lens: Lens, radii: tuple[int, ...] = RADII) -> list[float]:
    """Return the light on rings over that of the exact sum, both relative to their peaks."""
    pupil = pupil_of(lens)
    light, cutoff = picture(pupil), pupil.radius.item()
    pitch = 1 / (4 * cutoff)
    middle, found = (SIDE - 1) // 2, []
    patch, summed = np.arange(-PATCH // 2, PATCH // 2 + 1), exact(lens)

    def both(column: int, row: int) -> np.ndarray:
        true = summed((column + patch) * pitch, (row + patch) * pitch)
        own = light[np.ix_(middle + row + patch, middle + column + patch)]
        return np.array([own.sum(), true.sum()])

    core = both(0, 0)
    for radius in radii:
        steps = radius * AIRY / cutoff / pitch
        angles = 2 * np.pi * np.arange(AZIMUTHS) / AZIMUTHS  # along every spike too
        ring = sum(both(round(steps * np.sin(angle)), round(steps * np.cos(angle))) for angle in angles)
        found.append(float(ring[0] / core[0] / (ring[1] / core[1])))
    return found


@using_threads(1)
def ratio(pupil: PupilStack, side: int = SIDE, rounds: int = ROUNDS) -> float:
    """Return the CPU time of a picture over that of one complex64 FFT, the least of rounds in turn."""
    plane, least = np.ones((side, side), np.complex64), [np.inf, np.inf]
    for _ in range(rounds):
        for number, work in enumerate((lambda: picture(pupil, side), lambda: scipy.fft.fft2(plane))):
            started = process_time()
            work()
            least[number] = min(least[number], process_time() - started)
    return least[0] / least[1]


def main() -> None:
    """Print a table."""
    rings = " | ".join(f"{radius} Airy radii" for radius in RADII)
    print(f"light of {SIDE}² samples over the exact sum's\n| pupil | FFTs of its size | {rings} |")
    print("|---|---|---|---|---|---|")
    for f_number in (1.4, 4.0, 16.0):
        for name, mask in MASKS.items():
            lens = with_mask(
                with_f_number(find_lens("double_gauss_28" if f_number > 2 else "fast_gauss_f14"), f_number), mask
            )
            print(f"| f/{f_number:g}, {name} | {ratio(pupil_of(lens)):.2f} | ", end="", flush=True)
            print(" | ".join(f"{value:.3f}" for value in tails(lens)) + " |", flush=True)


if __name__ == "__main__":
    main()
