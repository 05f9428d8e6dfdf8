"""Figures of the spot diagram, against dense sums of rays and the areas of known spots."""

from dataclasses import replace
from math import inf, sqrt

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from p2sf.conventions import UM_PER_MM
from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError
from p2sf.figures.spot import spot
from p2sf.lens.lens import with_aim, with_mask, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import image_distance
from p2sf.psf.measures import energy_in, parts_of
from p2sf.pupil.landing import landing
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import pencil
from tests.support.rays.pencils import one_surface


def disc(rings: int, directions: int, inner: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ, η and area shares over a ring of inner radius ``inner``: Gauss–Legendre in ρ², even in θ."""
    node, weight = leggauss(rings)
    square = (1 + inner**2 + (1 - inner**2) * node) / 2
    theta = np.arange(directions) * (2 * np.pi / directions)
    radius, angle = np.meshgrid(np.sqrt(square), theta, indexing="ij")
    share = np.repeat(weight / 2 / directions, directions)
    return (radius * np.sin(angle)).ravel(), (radius * np.cos(angle)).ravel(), share


def dense(lens, source, xi, eta, share, clip=False) -> tuple[float, float, float]:
    """Return RMS radius, centroid y and the farthest ray of a dense sum of rays, by the light of each."""
    rays = pencil(lens, source, xi, eta, clip)
    light = np.where(rays.passed, share * rays.launch, 0.0)
    light /= light.sum()
    x, y = (UM_PER_MM * np.where(rays.passed, place, 0.0) for place in (rays.dx, rays.dy))
    centre_x, centre_y = light @ x, light @ y
    square = (x - centre_x) ** 2 + (y - centre_y) ** 2
    return sqrt(light @ square), float(centre_y), sqrt(square[rays.passed].max())


@pytest.mark.parametrize(
    ("name", "field_deg", "depth_mm"),
    [
        ("petzval", 0, inf),
        ("petzval", 7, inf),
        ("phone_f28", 0, inf),
        ("wide_angle_35", 31, 1000),
        ("maksutov", 0, inf),
    ],
)
@pytest.mark.parametrize("aim", ["stop", "paraxial"])
def test_rms_and_centroid_are_those_of_the_integral(name, field_deg, depth_mm, aim):
    lens = with_aim(find_lens(name), aim)
    source = Source(depth_mm, float(np.tan(np.deg2rad(field_deg))), lens.reference_wavelength_um)
    rms, centroid, _ = dense(lens, source, *disc(40, 96, lens.mask.obscuration))
    found = spot(lens, source)
    assert found.rms_um == pytest.approx(rms, rel=2e-5)  # what the rings leave; weights of aimed rays to 1e-6
    assert found.centroid_y_um == pytest.approx(centroid, rel=2e-5, abs=1e-6 * rms)
    assert found.centroid_x_um == 0


def test_the_farthest_ray_is_one_of_the_rim():
    lens = find_lens("petzval")
    source, turn = Source(inf, 0.1, lens.reference_wavelength_um), np.linspace(0, 2 * np.pi, 721)
    rim = pencil(lens, source, np.sin(turn), np.cos(turn))
    found = spot(lens, source)
    farthest = UM_PER_MM * np.hypot(rim.dx, rim.dy - found.centroid_y_um / UM_PER_MM).max()
    assert found.farthest_um == pytest.approx(farthest, rel=1e-3)  # 96 rays about the rim: (π/96)²


def test_pure_defocus_is_a_uniform_disc():
    lens = one_surface(conic=-((1 / 1.5) ** 2), rim=1.0)
    focus = float(image_distance(lens, inf, 0.55))
    lens, source = with_sensor(lens, focus + 1.0), Source(inf, 0.0, 0.55)
    radius = UM_PER_MM * abs(float(pencil(lens, source, [0.0], [1.0]).dy[0]))
    assert radius == pytest.approx(UM_PER_MM / focus, rel=1e-2)
    found = spot(lens, source)
    # What is left is the bend of the cone, NA²/2 at f/30.
    assert found.rms_um == pytest.approx(radius / sqrt(2), rel=2e-4)
    assert found.rms_x_um == pytest.approx(radius / 2, rel=2e-4)
    assert found.farthest_um == pytest.approx(radius, rel=2e-4)


def test_clipped_rays_end_at_the_rims():
    """Against rays that a rim lets pass or not, so many that the ragged edge is worth some 1e-4."""
    lens = find_lens("double_gauss_28")
    source = Source(inf, float(np.tan(np.deg2rad(14))), lens.reference_wavelength_um)
    rms, centroid, farthest = dense(lens, source, *disc(150, 400), clip=True)
    found = spot(lens, source, clip=True)
    assert found.rms_um == pytest.approx(rms, rel=2e-4)
    assert found.centroid_y_um == pytest.approx(centroid, abs=5e-4 * rms)
    assert found.farthest_um == pytest.approx(farthest, rel=1e-2)
    assert found.rms_um < 0.995 * spot(lens, source).rms_um


def test_behind_an_obscuration_the_ring_alone_counts():
    lens = replace(find_lens("double_gauss_28"), mask=PupilMask(obscuration=0.5))
    source = Source(inf, float(np.tan(np.deg2rad(10))), lens.reference_wavelength_um)
    rms, centroid, _ = dense(lens, source, *disc(40, 96, inner=0.5))
    found = spot(lens, source)
    assert found.rms_um == pytest.approx(rms, rel=2e-5)
    assert found.centroid_y_um == pytest.approx(centroid, rel=2e-5)


@pytest.mark.parametrize(
    "mask",
    [PupilMask(obscuration=0.3), PupilMask(blades=6, vanes=3, vane_width=0.04, vane_angle_deg=20)],
    ids=["ring", "spider"],
)
def test_behind_a_mask_rims_end_the_light_between_rays(mask):
    """Against rays in or out, whose ragged edge is worth some 8e-4, and twice as many radii to 1e-6."""
    lens = with_mask(find_lens("double_gauss_28"), mask)
    source = Source(inf, float(np.tan(np.deg2rad(14))), lens.reference_wavelength_um)
    nodes = np.stack(disc(200, 600))
    rms, centroid, farthest = dense(lens, source, *nodes[:, mask.opens(*nodes[:2])], clip=True)
    found, fine = (landing(lens, source, True, rings=rings) for rings in (16, 32))
    assert np.hypot(*found.rms_um) == pytest.approx(rms, rel=1e-3)
    assert found.centroid_um[1] == pytest.approx(centroid, abs=1e-3 * rms)
    assert found.farthest_um == pytest.approx(farthest, rel=1e-2)
    assert np.hypot(*found.rms_um) == pytest.approx(np.hypot(*fine.rms_um), rel=1e-6)


@pytest.mark.parametrize("field_deg", [0, 10])
def test_one_figure_on_every_road(field_deg):
    """Of one source, of several together, and of the pupil that energy is computed from."""
    lens = find_lens("petzval")
    slope = float(np.tan(np.deg2rad(field_deg / 2)))
    source = Source(inf, slope, lens.reference_wavelength_um)
    alone = spot(lens, source)
    together = spot(lens, Sources(np.array([inf, inf]), np.array([0.0, slope]), np.full(2, source.wavelength_um)))
    assert together.rms_um[1] == pytest.approx(float(alone.rms_um), rel=1e-9)
    for method in ("seidel", "fitted", "traced"):
        assert energy_in(*parts_of(lens, source, method)).rms_um == pytest.approx(float(alone.rms_um), rel=1e-12)


def test_a_phase_in_the_stop_is_refused():
    lens = replace(find_lens("double_gauss_28"), mask=PupilMask(cubic_um=3.0))
    with pytest.raises(GeometryError, match="phase"):
        landing(lens, Source(inf, 0.0, 0.55))
