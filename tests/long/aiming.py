"""Rays that fill the real stop, against rays traced backwards from it: ``python -m tests.long.aiming``.

For five lenses whose pupils are far from their paraxial image, R² of the reference's PSF and the light of the field,
relative to the axis, against the plain sum over rays that the referee traced backwards from a dense square grid in the
stop, each with the area of its cell in the plane of the entrance pupil (near objects: solid angle × distance²). Then
where the program's own rays meet the stop, of its rim, and the distortion of a symmetric 1:1 lens. What this filling
costs beside the paraxial one is measured by ``python -m tests.benchmarks.aiming``.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from math import inf

import numpy as np
from scipy.optimize import brentq

from p2sf.disc.quadrature import disc_nodes
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import field_from_object_height
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.pencil import pencil
from tests.support.pupil_sums import best_shift_mm, ray_sum
from tests.support.rays.skew_rays import forwards, system_of
from tests.support.waves import r_squared

LENSES = ("wide_angle_35", "periskop", "reverse_telephoto", "cooke_triplet", "eye_navarro")
NEAR_MM = {"reverse_telephoto": 30.0, "eye_navarro": 250.0}  # the others 1 m
PIXELS = 48
R2, LIGHT, STOP, DISTORTION_MM = 0.999999, 1e-4, 1e-9, 1e-12


@dataclass(frozen=True)
class Row:
    """One lens and source: 1 − R² of the PSF, the relative error of its light, and the farthest miss of the stop."""

    name: str
    error: float
    light: float
    stop: float

    @property
    def good(self) -> bool:
        return self.error <= 1 - R2 and self.light <= LIGHT and self.stop <= STOP


def cases(lens: Lens) -> Iterator[tuple[Lens, Source]]:
    """Yield the lens in its best focus for its outer fields, at infinity and at its near depth."""
    for depth in (inf, NEAR_MM.get(lens.name, 1000.0)):
        for field in lens.fields_deg[1:]:
            source = Source(depth, field_deg=field, wavelength_nm=1000 * lens.reference_wavelength_um)
            yield with_sensor(lens, lens.sensor_mm + best_shift_mm(lens, source, "stop")), source


def row(lens: Lens, source: Source, cells: int) -> Row:
    """Return how the program's rays compare with the referee's."""
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    shown = huygens_psf(lens, source, PIXELS, float(suitable_pixel_um(c, PIXELS)))
    coarse, truth = (ray_sum(lens, source, "stop", shown.x_um, shown.y_um, n) for n in (cells // 2, cells))
    field = (4 * truth.field / truth.light - coarse.field / coarse.light) / 3  # the grid's error falls as 1/cells²
    axis = Source(source.depth_mm, 0.0, source.wavelength_um)
    expected = truth.light / entering(lens, axis, cells // 2)
    dimmer = light(lens, source) / light(lens, axis) / expected - 1
    name = f"{lens.name} {source.field_deg:.4g}° {source.depth_mm:g} mm"
    error = 1 - r_squared(shown.values, np.abs(field) ** 2)
    return Row(name, error, abs(dimmer), stop_miss(lens, source))


def entering(lens: Lens, source: Source, cells: int) -> float:
    """Return the referee's light of a source: the sum of the areas that its rays enter by, mm²."""
    return ray_sum(lens, source, "stop", np.zeros(1), np.zeros(1), cells).light


def light(lens: Lens, source: Source) -> float:
    """Return the program's light of a source: the pupil's mean of its rays' weights."""
    nodes = disc_nodes(24, 48)
    return float(nodes.weight @ pencil(lens, source, nodes.xi, nodes.eta).light)


def stop_miss(lens: Lens, source: Source) -> float:
    """Return how far from their places the program's rays meet the stop, of its rim, by the referee's tracer."""
    nodes, system = disc_nodes(16, 32), system_of(lens, source.wavelength_um)
    rays = pupil_rays(lens, source, nodes.xi, nodes.eta)
    met = forwards(system, source, rays.origins.T, rays.directions.T)
    return float(np.hypot(met.stop_x - system.rim * nodes.xi, met.stop_y - system.rim * nodes.eta).max() / system.rim)


def symmetric_lens() -> Lens:
    """Return two equal glass shells about a stop, and the sensor at unit magnification."""
    glass, air = ConstantIndex(1.6), ConstantIndex(1.0)
    front = (Surface(40.0, 6.0, glass), Surface(90.0, 15.0, air))
    rear = (Surface(-90.0, 6.0, glass), Surface(-40.0, 1.0, air))
    lens = Lens((*front, Surface(inf, 15.0, air), *rear), Aperture("stop_semi_diameter", 4.0), 3)
    return with_sensor(lens, _equal_distance(lens))


def _equal_distance(lens: Lens) -> float:
    """Return the distance in front of the lens whose image lies as far behind it, mm."""
    return float(brentq(lambda d: float(image_distance(lens, d, lens.reference_wavelength_um)) - d, 60.0, 1000.0))


def distortion_mm(lens: Lens, height: float) -> float:
    """Return by how much the chief ray of an object at this height misses the same height behind the lens, mm."""
    slope = float(field_from_object_height(lens, lens.sensor_mm, lens.reference_wavelength_um, height))
    source = Source(lens.sensor_mm, slope, lens.reference_wavelength_um)
    return float(pencil(lens, source, [0.0], [0.1]).chief_y.item()) - height


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--cells", type=int, default=2000, help="cells of the referee's grid across the stop")
    cells, bad = asked.parse_args().cells, 0
    for lens in (with_aim(find_lens(name), "stop") for name in LENSES):
        for focused, source in cases(lens):
            found = row(focused, source, cells)
            bad += not found.good
            figures = f"1 − R² {found.error:.1e}, light {found.light:.1e}, stop {found.stop:.1e}"
            print(f"{found.name:32} {figures}", flush=True)
    lens = with_aim(symmetric_lens(), "stop")
    for height in (2.0, 10.0, 20.0):
        miss = distortion_mm(lens, height)
        bad += abs(miss) > DISTORTION_MM
        print(f"symmetric 1:1, object at {height:g} mm: distortion {miss:.1e} mm")
    raise SystemExit(f"{bad} outside their limits" if bad else 0)


if __name__ == "__main__":
    main()
