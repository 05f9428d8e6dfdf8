"""C_I and C_II against the paraxial image of two wavelengths: differences of place and height, traced apart."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.lens.lens import Lens, indices, with_sensor
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import find_stop, paraxial_rays
from p2sf.paraxial.seidel import chromatic_sums

STEP_UM = 1e-4  # to both sides: the sums are of first order, and the central difference errs by its square
SLOPE = 0.1


def depth_of(name: str) -> float:
    return 95.0 if name == "relay" else 1500.0


def on_image(name: str) -> tuple[Lens, float]:
    lens, wavelength = find_lens(name), find_lens(name).reference_wavelength_um
    place = float(image_distance(lens, depth_of(name), wavelength))
    return (with_sensor(lens, place) if place > 0 else lens), place


def traced(lens: Lens, wavelength: float, y: float, u: float) -> tuple[float, float]:
    """Return height and slope behind the last surface, by y–u tracing of one ray from the first vertex."""
    index = indices(lens, wavelength)
    for k, s in enumerate(lens.surfaces):
        u = (index[k] * u - y * s.curvature * (index[k + 1] - index[k])) / index[k + 1]
        y = y + u * s.thickness if k + 1 < len(lens.surfaces) else y
    return y, u


@pytest.mark.parametrize("name", sorted(set(shipped_lenses()) - {"diffractive_singlet"}))  # the rays below refract only
def test_the_sums_are_the_changes_of_image_place_and_height(name):
    """δ(defocus path) = n'u'·δ(height of the axial ray in the image plane)/2, δ(tilt) = n'u'·δ(image height)."""
    lens, place = on_image(name)
    wavelength, depth = lens.reference_wavelength_um, depth_of(name)
    rays = paraxial_rays(lens, depth, wavelength, find_stop(lens, depth))
    sums = chromatic_sums(lens, rays, wavelength - STEP_UM, wavelength + STEP_UM, SLOPE)
    heights = {"axial": (rays.y[0], rays.nu[0]), "chief": (rays.chief_y[0] * SLOPE, rays.chief_nu[0] * SLOPE)}
    change = {}
    for ray, (y, nu) in heights.items():
        ends = []
        for at in (wavelength - STEP_UM, wavelength + STEP_UM):
            end, slope = traced(lens, at, float(y), float(nu) / float(rays.index[0]))
            ends.append(end + slope * place)
        change[ray] = ends[0] - ends[1]
    slope = float(rays.nu[-1])
    # The chief ray here keeps its entrance into the lens, and with it its place in the entrance pupil.
    assert sums.axial.sum() / 2 == pytest.approx(slope * change["axial"] / 2, rel=2e-4, abs=1e-12)
    assert sums.lateral.sum() == pytest.approx(slope * change["chief"], rel=2e-4, abs=1e-12)


def test_a_thin_lens_has_the_axial_sum_of_its_power_and_v_number():
    """A thin lens of power φ and V-number V has C_I = y²φ/V between the wavelengths of V (Welford 1986, §10.3)."""
    thick = find_lens("plano_convex")
    surfaces = tuple(replace(s, thickness=1e-7 if k == 0 else s.thickness) for k, s in enumerate(thick.surfaces))
    lens = replace(thick, surfaces=surfaces)
    rays = paraxial_rays(lens, np.inf, 0.5875618)
    short, mid, long = (float(indices(lens, w)[1]) for w in (0.4861327, 0.5875618, 0.6562725))
    power = (mid - 1) * (surfaces[0].curvature - surfaces[1].curvature)
    total = chromatic_sums(lens, rays, 0.4861327, 0.6562725).axial.sum()
    expected = float(rays.y[0]) ** 2 * power * (short - long) / (mid - 1)
    assert power > 0 > -total and total == pytest.approx(expected, rel=1e-6)


def test_no_dispersion_no_colour():
    lens = find_lens("double_gauss_28")
    rays = paraxial_rays(lens, np.inf, 0.55)
    sums = chromatic_sums(lens, rays, 0.55, 0.55)
    assert not sums.axial.any() and not sums.lateral.any()
