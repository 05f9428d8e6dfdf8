"""Faint light of sums against all rays: ``python -m tests.long.faint_tails``.

The Double Gauss, at f/1.4 the fast Gauss, up to f/16, on the axis and at 7°, and an ideal lens; clear, with six blades
and with four vanes. Compared are a fit and exact rays with the sum of rays that has converged to 1e-7, in a window of
200 Airy radii: the largest relative error of the azimuthal mean wherever it is 1e-6 of the peak, that of the light
within, and CPU times. Exit code 1 where exact rays are off by more than a tenth.
"""

import argparse
from time import process_time

from p2sf.disc.mask import PupilMask
from p2sf.errors import P2SFError
from p2sf.figures.tails import tail_error
from p2sf.lens.lens import Aperture, Lens, Surface, with_f_number, with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import render

F_NUMBERS = 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0
MASKS = {"clear": PupilMask(), "six blades": PupilMask(blades=6), "four vanes": PupilMask(vanes=4)}
METHODS = "fitted", "traced"
AIRY_RADII = 142  # of the window on either side: 200 to its corners
PER_AIRY = 2.5  # samples, a little more than the finest fringe needs
CONVERGED = 1e-7  # relative L2 of the reference: tails of 1e-6 of the peak are 1e-3 of that of the whole
MOST = 0.1  # that is allowed of the azimuthal mean
FASTEST = 1.8  # of the Double Gauss, whose rays do not pass beyond


def lenses(f_number: float) -> dict[str, tuple[Lens, float]]:
    """Return lenses with the field angle of the source: aberrated on the axis and off it, and without aberration."""
    perfect = Lens((Surface(thickness=50.0, ideal_focal_length=50.0),), Aperture("f_number", f_number), 1)
    found = {"perfect": (perfect, 0.0)}
    name = "double_gauss_28" if f_number >= FASTEST else "fast_gauss_f14"
    real = with_f_number(find_lens(name), f_number)
    return found | {f"{name} on the axis": (real, 0.0), f"{name} at 7°": (real, 7.0)}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--f-numbers", type=float, nargs="*", default=F_NUMBERS)
    given, worst = parser.parse_args(), dict.fromkeys(METHODS, 0.0)
    for f_number in given.f_numbers:
        radius = 1.22 * 0.5876 * f_number
        size = int(2 * AIRY_RADII * PER_AIRY)
        for kind, (lens, angle) in lenses(f_number).items():
            for what, mask in MASKS.items():
                behind, source = with_mask(lens, mask), Source(field_deg=angle)
                try:
                    begun = process_time()
                    exact = huygens_psf(behind, source, size, radius / PER_AIRY, CONVERGED)
                    took, words = process_time() - begun, []
                    for method in METHODS:
                        begun = process_time()
                        found = render(behind, source, method, size, radius / PER_AIRY)
                        took_it = process_time() - begun
                        off = tail_error(found, exact, radius)
                        worst[method] = max(worst[method], off.mean)
                        words.append(f"{method} {off.mean:.1e} {off.encircled:.1e} in {took_it:.2f} s")
                    reach = f"to {off.radius_um / radius:.0f} Airy radii"
                    print(
                        f"f/{f_number:<4g} {kind:28} {what:11} {reach}: {'; '.join(words)}; all {took:.1f} s",
                        flush=True,
                    )
                except P2SFError as reason:
                    print(f"f/{f_number:<4g} {kind:28} {what:11} {reason}"[:200], flush=True)
    print("largest error of an azimuthal mean: " + ", ".join(f"{method} {off:.1e}" for method, off in worst.items()))
    return int(worst["traced"] > MOST)


if __name__ == "__main__":
    raise SystemExit(main())
