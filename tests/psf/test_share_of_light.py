"""The share of light in a window, and pupils that end where a surface transmits nothing, against radial integrals."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.special import j0

import p2sf
from p2sf import Aperture, GeometryError, Lens, Source, Surface
from p2sf.lens.transmission import Transmission
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.pixel_integrals import light_of_rays
from p2sf.psf.spherical import spherical_pupil
from p2sf.pupil.rays import RayPupil
from p2sf.raytrace.pencil import pencil

BICONVEX = Lens((Surface(60.0, 5.0, 1.6), Surface(-60.0, 48.5)), Aperture("stop_semi_diameter", 5.0), 1)
NODES = 800


def share_in_square(light: Callable[[np.ndarray], np.ndarray], half: float) -> float:
    """Return ∫ of a light of unit integral that depends on the radius alone, over the square |x|, |y| ≤ half."""
    node, weight = leggauss(NODES)
    inner, outer = half * (node + 1) / 2, half * (1 + (np.sqrt(2) - 1) * (node + 1) / 2)
    covered = 2 * np.pi - 8 * np.arccos(half / outer)
    whole = (light(inner) * inner * 2 * np.pi * half / 2) @ weight
    return float(whole + (light(outer) * outer * covered * half * (np.sqrt(2) - 1) / 2) @ weight)


def fresnel(radius_mm: float, focal_mm: float, z_mm: float, wavelength_mm: float) -> Callable[[np.ndarray], np.ndarray]:
    """Return the light behind an ideal lens by Fresnel's integral (Goodman 2005, eq. 4-17), per mm², of unit sum."""
    node, weight = leggauss(NODES)
    square = radius_mm**2 * (node + 1) / 2
    wave = np.exp(1j * np.pi * square / wavelength_mm * (1 / z_mm - 1 / focal_mm)) * weight * radius_mm**2 / 2 * np.pi

    def light(r: np.ndarray) -> np.ndarray:
        field = j0(2 * np.pi / (wavelength_mm * z_mm) * np.outer(r, np.sqrt(square))) @ wave / (wavelength_mm * z_mm)
        return np.abs(field) ** 2 / (np.pi * radius_mm**2)

    return light


@pytest.mark.parametrize("pixel_um", [5.0, 11.0, 16.0])
def test_light_behind_a_small_stop_is_that_of_fresnels_integral(pixel_um):
    """Spherical waves at a Fresnel number of 4.5; the window of 31 samples lies about the chief ray.

    Fresnel's phase is off by π·a⁴/(4λz³) ≈ 2e-3 here, and samples at λ/(4 NA) represent the light of a pixel to 4e-3
    of a share that changes at the edge alone.
    """
    lens = Lens((Surface(ideal_focal_length=50.0, thickness=5.556),), Aperture("stop_semi_diameter", 0.117), 1)
    psf = p2sf.render(lens, Source(wavelength_nm=550), "spherical", pixels=31, pixel_um=pixel_um)
    own = share_in_square(fresnel(0.117, 50.0, 5.556, 0.55e-3), 15.5 * pixel_um / 1000)
    assert psf.energy == pytest.approx(own, abs=2e-3)


@pytest.mark.parametrize(("name", "field_deg"), [("fast_gauss_f14", 4.0), ("wide_angle_35", 20.0), ("phone_f28", 25.0)])
def test_light_of_a_smooth_pupil_is_that_of_differences_between_rays(name, field_deg):
    """Parseval's integral at Gauss–Legendre radii and even directions; differences of rays err by 1e-7 or less."""
    lens, source = p2sf.load_lens(name), Source(5000.0, field_deg=field_deg, wavelength_nm=550)
    node, weight = leggauss(20)
    radius, turn = np.sqrt((1 + node) / 2), (np.arange(48) + 0.5) * (2 * np.pi / 48)
    xi, eta = (np.outer(radius, part(turn)).ravel() for part in (np.sin, np.cos))
    area = np.repeat(weight, turn.size) / (2 * turn.size)
    at, right, left, up, down = (
        pencil(lens, source, xi + x, eta + y) for x, y in ((0, 0), (1e-4, 0), (-1e-4, 0), (0, 1e-4), (0, -1e-4))
    )
    spread = (right.fx - left.fx) * (up.fy - down.fy) - (right.fy - left.fy) * (up.fx - down.fx)
    field = at.amplitude / (area @ at.amplitude)
    own = area @ (field**2 / np.abs(spread / 4e-8)) / np.pi
    assert RayPupil(lens, source).light_um2() == pytest.approx(own, rel=1e-6)


@pytest.mark.parametrize(("method", "error"), [("huygens", 1e-4), ("traced", 1e-4), ("fitted", 8e-3)])
def test_light_of_a_steep_paraboloid_is_a_share_of_that_of_exact_rays(method, error):
    """f/0.5: h = 2f·tan(u/2) and f = sin u/λ; Parseval's integral of all light is one over the radius.

    The error of the fit: its picture has 1 − R² of 7e-4, a hundredth of which may lie in the sum.
    """
    um, pixel = 0.5875618, 0.056
    lens = Lens((Surface(-100.0, -50.0, "mirror", conic=-1.0),), Aperture("f_number", 0.5), 1)
    node, weight = leggauss(NODES)
    rho = (node + 1) / 2
    half_angle = np.arctan(rho / 2)
    frequency = np.sin(2 * half_angle) / um
    slope = np.cos(2 * half_angle) / (1 + rho**2 / 4) / um
    total = float((2 * rho) ** 2 / (2 * np.pi * frequency * slope) @ weight / 2)

    def light(r: np.ndarray) -> np.ndarray:
        field = j0(2 * np.pi * np.outer(r, frequency)) @ (2 * rho * weight / 2)
        return field**2 / total

    psf = p2sf.render(lens, Source(), method, pixels=63, pixel_um=pixel, integrated=False)
    assert psf.energy == pytest.approx(share_in_square(light, 31.5 * pixel), abs=error)


@pytest.mark.parametrize("method", ["huygens", "traced", "fitted"])
def test_no_share_is_above_one_where_the_map_of_directions_folds(method):
    """Just inside the front focus, rays from two zones of the pupil leave in one direction; all light is in view."""
    psf = p2sf.render(BICONVEX, Source(48.37), method)
    assert psf.energy == pytest.approx(1, abs=0.01)


def meridional(height: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return sine of the slope, place on the sensor and path of rays parallel to the axis through BICONVEX."""
    index, (y, sine, path) = 1.0, (height, np.zeros_like(height), np.zeros_like(height))
    x = np.zeros_like(height)
    for radius, after, at in ((60.0, 1.6, 0.0), (-60.0, 1.0, 5.0)):
        centre = at + radius
        cosine = np.sqrt(1 - sine**2)
        along = (centre - x) * cosine - y * sine
        miss = (x - centre) ** 2 + y**2 - radius**2
        step = along - np.sign(radius) * np.sqrt(along**2 - miss)
        x, y, path = x + step * cosine, y + step * sine, path + index * step
        normal = (centre - x) / radius, -y / radius
        incidence = cosine * normal[0] + sine * normal[1]
        bent = np.sqrt(1 - (index / after) ** 2 * (1 - incidence**2))
        sine = index / after * sine + (bent - index / after * incidence) * normal[1]
        index = after
    cosine = np.sqrt(1 - sine**2)
    step = (53.5 - x) / cosine
    return sine, y + step * sine, path + step


def test_a_pupil_ends_where_a_surface_transmits_nothing():
    """T = 1 − r²/10 ends within the stop, and the field Σ√T·exp(2πi·w)·J0 has its nodes up to there alone.

    1 − R² of 1e-6: two sums of the method agree to 1e-3 of the field, or better.
    """
    front = replace(BICONVEX.surfaces[0], transmission=Transmission(1.0, -0.1))
    lens = replace(BICONVEX, surfaces=(front, BICONVEX.surfaces[1]))
    um = 0.5
    psf = p2sf.render(lens, Source(wavelength_um=um), "traced", pixels=33, pixel_um=1.0, integrated=False)
    node, weight = leggauss(400)
    angle = (node + 1) * np.pi / 4
    height = np.sqrt(10) * np.sin(angle)
    sine, place, path = meridional(height)
    chief = meridional(np.zeros(1))[2]
    waves = 1000 * (path - chief - sine * place) / um
    wave = np.sqrt(1 - height**2 / 10) * np.exp(2j * np.pi * waves) * height * np.cos(angle) * weight
    radius = np.hypot(*np.meshgrid(psf.x_um, psf.y_um))
    # The first surface is the stop: a height on it is one of the beam.
    own = np.abs(j0(2 * np.pi / um * np.multiply.outer(radius, sine)) @ wave) ** 2
    own /= own.sum()
    assert ((psf.values - own) ** 2).sum() < 1e-6 * ((own - own.mean()) ** 2).sum()
    assert 0 < psf.energy <= 1


def test_a_surface_that_transmits_nothing_is_refused():
    with pytest.raises(GeometryError, match="surface 2 transmits no light"):
        replace(BICONVEX, surfaces=(BICONVEX.surfaces[0], Surface(-60.0, 48.5, transmission=Transmission(0.0))))


def test_one_pass_of_spherical_waves_states_its_light():
    """By exact rays: of a blur a hundred Airy radii wide, in half of its window, diffraction moves little."""
    lens = p2sf.load_lens("double_gauss_28")
    source = Source(field_deg=19.9)
    once = psf_of_pupil(spherical_pupil(lens, source), (256, 0.9765625))
    assert once.energy == pytest.approx(light_of_rays(lens, source, once, False), abs=0.01)
    assert 0.5 < once.energy < 0.99


def test_no_share_is_told_where_no_ray_arrives_and_samples_are_far_apart():
    """Six coefficients show a picture even there, of 80 times λ/(4 NA) a sample."""
    psf = p2sf.render(p2sf.load_lens("double_gauss_28"), Source(field_deg=40), "seidel", pixels=16)
    assert psf.energy is None and psf.strehl > 0 and psf.predicted_error == np.inf
