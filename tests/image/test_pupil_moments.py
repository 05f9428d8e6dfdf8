"""Moments of kernels over the pupil, by waves, by rays and by paraxial defocus; what silhouettes let through."""

import numpy as np
import pytest

from p2sf.image.preview import preview_plan
from p2sf.image.pupil_moments import MOMENTS, Passing, kernel_moments, powers, pupil_landings, zernike
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

HERE = np.s_[:, :]
GREEN = (Channel("green", (540.0,), (1.0,)),)
GRID = np.mgrid[-1:1:401j, -1:1:401j].reshape(2, -1)
DISC = GRID[:, np.hypot(*GRID) <= 1]  # points of the pupil


def means_of(landing: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the means of a pupil whose rays through DISC land at rows and columns, (2, points), and their reach."""
    reach = float(np.hypot(*landing).max()) + 1
    return zernike(*(2 * DISC))[1:] @ powers(landing / reach).T / DISC.shape[1], reach


def waves(defocus: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Return a kernel, its moments of 2ξ and 2η, and where the rim lands, pixels, of a disc with defocus in waves.

    The mean of p over the light that arrives at a point is Re(E*·E_p)/|E|², where E_p is the field of the pupil times p
    (the local mean of Wigner's distribution, Bastiaans 1979). Pixels are λ/2NA wide.
    """
    count, radius, pixel = 512, 32, 8
    u = np.fft.fftfreq(count) * count / radius
    disc = (u**2 + u[:, None] ** 2 <= 1) * np.exp(2j * np.pi * defocus * (u**2 + u[:, None] ** 2))
    field, down, across = (np.fft.fftshift(np.fft.ifft2(disc * 2 * p)) for p in (0.5, u[:, None], u))
    light = [(field.conj() * each).real for each in (field, down, across)]
    pixels = np.array([np.roll(each, (4, 4), (0, 1)).reshape(64, 8, 64, 8).sum((1, 3))[1:, 1:] for each in light])
    pixels /= pixels[0].sum()
    return pixels[:1], pixels[1:], -2 * defocus * count / radius / pixel  # −∂W/∂f of an amplitude exp(i2πW)


@pytest.mark.parametrize(("defocus", "off"), [(0.25, 0.2), (-1.0, 0.2), (4.0, 0.1)])
def test_moments_are_those_of_the_waves(defocus, off):
    """But for fringes near focus, which rays lack, and for wings, of which the rays' polynomials know nothing."""
    kernel, moments, rim = waves(defocus)
    found = kernel_moments(kernel, *means_of(rim * DISC))
    assert np.abs(found.sum((2, 3))).max() < 1e-6  # of float32: what is even all over has none
    assert np.linalg.norm(found[:2, 0] - moments) < off * np.linalg.norm(moments)


def test_moments_are_the_means_over_the_rays_that_land_at_each_pixel():
    """Rays counted by pixel, astigmatic: rows and columns change places, and each has a scale of its own."""
    landing = np.array([[1.0, 12.0], [-8.0, 2.0]]) @ DISC
    row, column = np.rint(landing).astype(int) + 16
    share = np.ones(DISC.shape[1]) / DISC.shape[1]
    counted = [np.bincount(33 * row + column, share * each, 33**2).reshape(33, 33) for each in zernike(*(2 * DISC))]
    found = kernel_moments(np.array(counted[:1]), *means_of(landing))[:, 0]
    for moment, truth in zip(found, counted[1:], strict=True):
        assert np.linalg.norm(moment - truth) < 0.05 * np.linalg.norm(truth)  # the rim cuts pixels


def test_rays_of_both_sides_of_focus_land_on_opposite_sides_by_twice_the_defocus():
    """On the axis, by half of 2·Wd·λ/NA, the paraxial blur at the rim: half the radius is the standard deviation."""
    scene = Scene(Sensor(41, 41, 20.0), GREEN, 2000.0, 8000.0, focus_mm=3500.0, f_number=8.0)
    planned = preview_plan(scene.camera(find_lens("double_gauss_28")), scene)
    lens, found = planned.lens, []
    for depth in (2000.0, 8000.0):
        means, reach = (each[0, 0] for each in pupil_landings(planned, 1 / depth).at(np.array([20]), np.array([20])))
        covariance = reach * means[1::-1, 1:3]  # of η and ξ with rows and columns
        paraxial = coefficients(lens, depth, 0.0, 0.54)
        blur_um = abs(2 * paraxial.wd * 0.54 / paraxial.reduced_slope)
        assert np.abs(np.diag(covariance)) == pytest.approx(np.full(2, blur_um / 2 / 20), rel=0.05)  # beyond: W40
        found.append(covariance[0, 0])
    assert found[0] * found[1] < 0


def test_coma_points_where_that_of_the_kernel_does():
    """By third moments at a corner, where the field lies along a diagonal: their signs tell up from down."""
    scene, corner = Scene(Sensor(1001, 1001, 6.0), GREEN, f_number=8.0), (np.array([0]), np.array([1000]))
    planned = preview_plan(scene.camera(find_lens("achromat_f6")), scene)
    means, reach = (each[0, 0] for each in pupil_landings(planned, 0.0).at(*corner))
    landing = reach * means[:, 1:3].T @ zernike(*(2 * DISC))[1:]
    kernel = planned.kernels(0, 0.0).at(3.0, 3.0, 20)
    place = np.indices(kernel.shape) - 20
    place = place - np.einsum("ij,aij->a", kernel, place)[:, None, None]
    inside = kernel * (np.hypot(*place) <= reach)  # beyond are the wings of the rim
    thirds = np.einsum("ij,aij->a", inside, place**3)
    assert thirds == pytest.approx((landing**3).mean(1), rel=0.3)  # of what terms of higher degree leave out
    assert thirds[0] > 5 and thirds[1] < -5


def layer(*moments: float) -> list[np.ndarray]:
    """Return what a layer hides of one pixel, the mean and its moments."""
    return [np.full((1, 1, 1), each) for each in (*moments, *[0.0] * (1 + MOMENTS - len(moments)))]


def test_what_passes_an_even_pane_is_the_product_of_its_panes():
    passing = Passing((1, 1, 1))
    for alpha in (0.25, 0.5):
        passing.hide(HERE, layer(alpha))
    assert not passing.cut and passing.values[0, 0, 0, 0] == pytest.approx(0.375)


def test_what_passes_panes_that_change_over_the_pupil_is_the_mean_of_their_product():
    """Two panes linear in the pupil's coordinates, so that the product is of second degree; by sums over the disc."""
    passing, open_parts = Passing((1, 1, 1)), np.ones(DISC.shape[1])
    for moments in ((0.4, 0.1, -0.12), (0.3, 0.11, 0.05)):
        passing.hide(HERE, layer(*moments))
        open_parts = open_parts * (1 - np.array(moments) @ zernike(*(2 * DISC))[:3])
    truth = zernike(*(2 * DISC)) @ open_parts / DISC.shape[1]
    assert passing.values[:, 0, 0, 0] == pytest.approx(truth, abs=2e-3)  # twice NEGLIGIBLE, and the grid
    assert abs(truth[3:]).max() > 0.01
    for steep in (-9.0, 9.0):
        passing.hide(HERE, layer(0.5, steep))
        assert 0 <= passing.values[0, 0, 0, 0] <= 1
