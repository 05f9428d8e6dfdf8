"""Compare PSFs behind masks with sums over a grid of 10⁷ points: ``python -m tests.long.pupil_masks``.

The grid leaves out the points that the mask covers, so its error falls with its edges alone, as about side^−1.5; what
is printed is an upper bound of the reference's own error.
"""

import argparse
from math import ceil, pi, sqrt
from time import perf_counter

from p2sf.disc.mask import PupilMask
from p2sf.lens.lens import with_aim, with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.traced import traced_psf
from tests.support.masked_sum import masked_sum
from tests.support.waves import r_squared

MASKS = {
    "ring 0.35": PupilMask(obscuration=0.35),
    "ring 0.99": PupilMask(obscuration=0.99),
    "6 blades": PupilMask(blades=6, blade_angle_deg=7),
    "5 round blades": PupilMask(blades=5, roundness=0.4, blade_angle_deg=11),
    "4 vanes": PupilMask(obscuration=0.3, vanes=4, vane_width=0.03, vane_angle_deg=10),
    "Gaussian": PupilMask(apodisation=0.7),
    "super-Gaussian": PupilMask(apodisation=0.8, apodisation_power=12),
    "cubic plate": PupilMask(cubic_um=1.0),
}


def main() -> None:
    """Print 1 − R² of the reference and of `traced` against the grid, and the seconds of each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=float, default=1e7)
    parser.add_argument("--lens", default="double_gauss_28")
    parser.add_argument("--field-deg", type=float, default=10.0)
    parser.add_argument("--only", nargs="*", choices=MASKS)
    given = parser.parse_args()
    side = 2 * ceil(sqrt(given.points * 4 / pi) / 2)
    plain, source = with_aim(find_lens(given.lens), "paraxial"), Source(field_deg=given.field_deg)
    for name in given.only or MASKS:
        mask, begun = MASKS[name], perf_counter()
        dense = masked_sum(plain, source, mask, 32, 1.4, side)
        seconds = perf_counter() - begun
        found = [method(with_mask(plain, mask), source, 32, 1.4) for method in (huygens_psf, traced_psf)]
        errors = " ".join(f"{p.method} {1 - r_squared(p.values, dense):.1e} in {p.seconds:.2f} s;" for p in found)
        print(f"{name:16} 1 − R² {errors} grid {seconds:.0f} s", flush=True)


if __name__ == "__main__":
    main()
