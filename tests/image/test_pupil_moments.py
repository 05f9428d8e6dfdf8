"""Moments of kernels over the pupil: by waves, by the defocus of six coefficients, and what passes silhouettes."""

import numpy as np
import pytest

from p2sf.image.preview import preview_plan
from p2sf.image.pupil_moments import Passing, kernel_moments, pupil_landings
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.scene import Channel, Scene, Sensor

HERE = np.s_[:, :]
GREEN = (Channel("green", (540.0,), (1.0,)),)


def waves(defocus: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Return a kernel, its moments, (1 and 2, pixels, pixels), and their covariance, pixels, of a disc out of focus.

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
    landing = -2 * defocus * count / radius / pixel  # −∂W/∂f at the rim, of an amplitude exp(i2πW)
    return pixels[:1], pixels[1:], landing / 2


@pytest.mark.parametrize(("defocus", "alike"), [(0.25, 0.95), (-1.0, 0.95), (4.0, 0.99)])
def test_moments_are_those_of_the_waves(defocus, alike):
    """Alike by correlation, and hardly stronger: near focus there are fringes, which rays lack."""
    kernel, moments, covariance = waves(defocus)
    found = kernel_moments(kernel, covariance * np.eye(2))
    assert np.vdot(found, moments) >= alike * np.linalg.norm(found) * np.linalg.norm(moments)
    assert 0.5 < np.abs(found).sum() / np.abs(moments).sum() < 1.05
    assert np.abs(found.sum((1, 2))).max() < 1e-6  # of float32: what is even all over has none


def test_rays_of_both_sides_of_focus_land_on_opposite_sides_by_twice_the_defocus():
    """On the axis, by half of 2·Wd·λ/NA, the paraxial blur at the rim: half the radius is the standard deviation."""
    scene = Scene(Sensor(41, 41, 20.0), GREEN, 2000.0, 8000.0, focus_mm=3500.0, f_number=8.0)
    planned = preview_plan(scene.camera(find_lens("double_gauss_28")), scene)
    lens, found = planned.lens, []
    for depth in (2000.0, 8000.0):
        covariance = pupil_landings(planned, 1 / depth).at(np.array([20]), np.array([20]))[0, 0][::-1]  # of η and rows
        paraxial = coefficients(lens, depth, 0.0, 0.54)
        blur_um = abs(2 * paraxial.wd * 0.54 / paraxial.reduced_slope)
        assert np.abs(np.diag(covariance)) == pytest.approx(np.full(2, blur_um / 2 / 20), rel=0.05)  # beyond: W40
        found.append(covariance[0, 0])
    assert found[0] * found[1] < 0


def test_what_passes_an_even_pane_is_the_product_of_its_panes():
    passing = Passing((3, 4, 1))
    for alpha in (0.25, 0.5):
        passing.hide(HERE, np.full((3, 4, 1), alpha), np.zeros((2, 3, 4, 1)))
    assert not passing.tilted and passing.mean == pytest.approx(np.full((3, 4, 1), 0.375))


def test_light_through_a_cut_pupil_is_the_mean_of_the_product_and_never_beyond_its_bounds():
    """A half disc is open to light that is linear over the pupil: ⟨T·L⟩ in closed form, Parseval's sum of three terms.

    Of the mean 1/2 and of the moment 4/3π·1/2 of p/σ, σ = 1/2, over the open half.
    """
    passing, tilt = Passing((1, 1, 1)), 0.6
    moment = 4 / (3 * np.pi)
    passing.hide(HERE, np.full((1, 1, 1), 0.5), np.array([-moment, 0]).reshape(2, 1, 1, 1))
    light, slope = np.full((1, 1, 1), 1.0), np.array([tilt, 0.3]).reshape(2, 1, 1, 1)
    x, y = np.mgrid[-1:1:801j, -1:1:801j]
    inside, open_half = x**2 + y**2 < 1, x > 0
    truth = ((1 + 2 * tilt * x + 2 * 0.3 * y) * open_half)[inside].mean()
    assert passing.seen(HERE, light, slope) == pytest.approx(truth, rel=3e-3)  # of the grid and of NEGLIGIBLE
    for steep in (-9.0, 9.0):
        assert 0 <= passing.seen(HERE, light, steep * slope) <= 1
