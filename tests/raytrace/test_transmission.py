"""Surfaces that take light away: pictures against Hankel integrals of shaded pupils, energies against their sums."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import j0

import p2sf
from p2sf.disc.quadrature import whole_disc
from p2sf.errors import GeometryError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lens.transmission import Transmission
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.illumination import light_collected
from p2sf.raytrace.pencil import pencil

RIM = 5.0
UM = 0.5


def focused(passed: Transmission | None) -> Lens:
    """Return an ellipsoid that focuses an infinitely far point sharply, K = −1/n′², and its stop before it."""
    n = 1.5
    front = Surface(thickness=1.0, transmission=passed)
    bowl = Surface(100.0, 100.0 * n / (n - 1), ConstantIndex(n), conic=-1 / n**2)
    return Lens((front, bowl), Aperture("stop_semi_diameter", RIM), 1, wavelengths_nm=(500.0,))


@pytest.mark.parametrize("passed", [Transmission(0.9, -0.03), Transmission(0.2, 0.03)], ids=["dark rim", "dark middle"])
def test_the_picture_is_the_hankel_integral_of_the_shaded_pupil(passed):
    """∫√(t₀ + t₂h²)·J₀(2π f ρ r)ρ dρ; the pupil of this lens is even to 1e-3, its map straight to that."""
    lens = focused(passed)
    rho, weight = np.polynomial.legendre.leggauss(200)
    rho, weight = (rho + 1) / 2, weight / 2
    root = np.sqrt(passed.vertex + passed.per_mm2 * (RIM * rho) ** 2)
    edge = float(coefficients(lens, np.inf, 0.0, UM).na) / UM
    for method in ("huygens", "traced", "fitted"):
        psf = p2sf.render(lens, Source(wavelength_um=UM), method, pixels=33, pixel_um=0.8)
        assert not psf.integrated
        radius = np.hypot(*np.meshgrid(psf.x_um, psf.y_um))
        field = (weight * root * rho) @ j0(2 * np.pi * edge * np.multiply.outer(rho, radius.ravel()))
        known = np.square(field).reshape(radius.shape)
        apart = psf.values / psf.values.max() - known / known.max()
        assert np.abs(apart).max() < 3e-3, method
        plain = p2sf.render(focused(None), Source(wavelength_um=UM), method, pixels=33, pixel_um=0.8)
        assert np.abs(psf.values / psf.values.max() - plain.values / plain.values.max()).max() > 0.02


def test_the_energy_of_rays_is_the_mean_of_the_transmission():
    """t₀ + t₂R²/2 over an even pupil; two surfaces multiply."""
    passed = Transmission(0.9, -0.02)
    xi, eta, share = whole_disc(12, 24)
    lens = focused(passed)
    dark = replace(lens, surfaces=(lens.surfaces[0], replace(lens.surfaces[1], transmission=Transmission(0.5))))
    clear = pencil(focused(None), Source(wavelength_um=UM), xi, eta)
    for each, factor in ((lens, 1.0), (dark, 0.5)):
        rays = pencil(each, Source(wavelength_um=UM), xi, eta)
        mean = (share * rays.light).sum() / (share * clear.light).sum()
        assert mean == pytest.approx(factor * (0.9 - 0.02 * RIM**2 / 2), rel=1e-6)


def test_a_lens_file_in_inches_passes_the_light_of_the_same_lens_in_millimetres():
    """The transmission at a height in inches is that at 25.4 times as many millimetres, t₂ per square inch."""
    passed = Transmission(0.9, -0.02)
    text = lens_to_toml(focused(passed)).replace('unit = "mm"', 'unit = "in"')
    wide = parse_toml(text, "inches.toml").surfaces[0].transmission
    heights = np.linspace(0, RIM, 5)
    assert wide.at((25.4 * heights) ** 2) == pytest.approx(0.9 - 0.02 * heights**2, rel=1e-12)


def test_the_light_collected_is_that_of_the_rays():
    """That of a shaded lens over that of a clear one; obliquity over the pupil, which rays leave out, is 2e-4 of it."""
    gauss = replace(find_lens("double_gauss_28"), aperture=Aperture("f_number", 4.0))
    front = replace(gauss.surfaces[0], transmission=Transmission(1.0, -0.5 / 14**2))
    shaded, (xi, eta, share) = replace(gauss, surfaces=(front, *gauss.surfaces[1:])), whole_disc(16, 32)
    for field in (0.0, 10.0):
        source = Source(field_deg=field)
        dark, clear = (pencil(lens, source, xi, eta) for lens in (shaded, gauss))
        ratio = light_collected(shaded, source) / light_collected(gauss, source)
        assert ratio == pytest.approx((share * dark.light).sum() / (share * clear.light).sum(), rel=5e-4)
        assert ratio < 0.95


@pytest.mark.parametrize("clip", [False, True], ids=["open", "clipped"])
@pytest.mark.parametrize("change", ["", "tilted", "masked"])
def test_every_road_takes_the_same_light(clip, change):
    """Huygens sums, exact rows and fits, with rims, masks and tilts: the fit to the error of its amplitude."""
    gauss = replace(find_lens("double_gauss_28"), aperture=Aperture("f_number", 4.0))
    front = replace(gauss.surfaces[0], transmission=Transmission(1.0, -0.5 / 14**2))
    lens = replace(gauss, surfaces=(front, *gauss.surfaces[1:]))
    if change == "tilted":
        lens = displaced(lens, 3, 4, Placement(decentre_y=0.05, tilt_x_deg=0.1))
    if change == "masked":
        lens = p2sf.with_mask(lens, p2sf.PupilMask(obscuration=0.3, vanes=3, vane_width=0.03))
    found = {
        method: p2sf.render(lens, Source(field_deg=7.0), method, pixels=48, pixel_um=1.5, clip=clip).values
        for method in ("huygens", "traced", "fitted")
    }
    reference = found["huygens"]
    for method, most in (("traced", 1e-5), ("fitted", 1e-3)):
        assert ((found[method] - reference) ** 2).sum() / ((reference - reference.mean()) ** 2).sum() < most


def test_pupils_that_are_taken_for_even_are_refused():
    lens = replace(focused(Transmission(0.9, -0.02)), aim="paraxial")
    with pytest.raises(GeometryError, match="surface 1 passes a share of light that changes with the height"):
        p2sf.render(lens, Source(wavelength_um=UM), "traced")
    with pytest.raises(
        GeometryError, match="surface 1 passes a share of light that changes with the height, for which"
    ):
        p2sf.render(focused(Transmission(0.9, -0.02)), Source(wavelength_um=UM), "seidel")
    with pytest.raises(GeometryError, match=r"surface 1: transmission 1\.5"):
        focused(Transmission(1.5))


def test_auto_does_not_choose_six_coefficients_that_are_refused():
    """At f/16 six coefficients miss 1e-6 of this lens, so faint is its shade; they are refused all the same."""
    gauss = replace(find_lens("double_gauss_28"), aperture=Aperture("f_number", 16.0))
    front = replace(gauss.surfaces[0], transmission=Transmission(1.0, -1e-5))
    lens = replace(gauss, surfaces=(front, *gauss.surfaces[1:]))
    assert p2sf.Camera(gauss).at(Source()).choose_method(0.9).method == "seidel"
    assert p2sf.render(lens, Source(), min_r2=0.9).method == "traced"
    nodes = {"depths_mm": (1e4, 1e5), "fields_deg": (0.0, 2.0), "wavelengths_nm": (550.0, 560.0)}
    assert p2sf.build_database(lens, method="auto", **nodes).database.method == "fitted"
