"""Irregular surfaces: rays, the astigmatism that a cylinder makes, and directions."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.disc.quadrature import whole_disc
from p2sf.errors import GeometryError, LensFileError
from p2sf.glass.media import MIRROR, ConstantIndex
from p2sf.lens.freeform import XYPolynomial
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import check_aligned, seen_from
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.writing import write_lens
from p2sf.messages import Message
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.raytrace.pencil import displayed_opd, hexapolar, pencil
from p2sf.raytrace.trace import trace
from tests.support.lenses.simple_lenses import in_the_stop

FRINGE_UM = 0.273035  # half of 546.07 nm
UM = 0.5


@pytest.mark.parametrize(("medium", "step"), [(ConstantIndex(1.5), 0.5), (MIRROR, -2.0)], ids=["glass", "mirror"])
def test_a_cylinder_in_the_stop_is_astigmatism_alone(medium, step):
    """W = (n′ − n)·sag, of N fringes N/2·F·ρ² cos 2θ: up to the square of a fringe's slope."""
    xi, eta, _ = whole_disc(6, 16)
    assert np.abs(displayed_opd(in_the_stop(medium, None), Source(wavelength_um=UM), xi, eta)).max() < 1e-9
    cosine, sine = eta**2 - xi**2, 2 * xi * eta
    for one in (Irregularity(2.0, 0.0, 5.0), Irregularity(0.0, -3.0, 5.0), Irregularity(1.5, 2.0, 10.0)):
        found = displayed_opd(in_the_stop(medium, one), Source(wavelength_um=UM), xi, eta)
        scale = step * FRINGE_UM / 2 / UM * (5.0 / one.normalisation_mm) ** 2
        expected = scale * (one.fringes * cosine + one.fringes_45 * sine)
        assert found == pytest.approx(expected, abs=2e-4 * np.abs(expected).max())
    top, side = displayed_opd(
        in_the_stop(medium, Irregularity(2.0, 0.0, 5.0)), Source(wavelength_um=UM), [0.0, 1.0], [1.0, 0.0]
    )
    assert top - side == pytest.approx(step * 2 * FRINGE_UM / UM, rel=1e-4), "two fringes from peak to valley"


def test_of_zernike_terms_only_the_two_of_astigmatism_appear():
    """Noll's sixth is √6·ρ² cos 2θ with θ from +ξ, his fifth √6·ρ² sin 2θ."""
    fit = zernike_fit(in_the_stop(ConstantIndex(1.5), Irregularity(2.0, 1.0, 5.0)), Source(wavelength_um=UM))
    peak = 0.5 * FRINGE_UM / 2 / UM / np.sqrt(6)
    expected = np.zeros(len(fit.waves))
    expected[5], expected[4] = -2 * peak, 1 * peak
    assert fit.waves == pytest.approx(expected, abs=2e-4 * peak)


def test_a_source_in_another_azimuth_sees_the_cylinder_turned():
    """One along y is, to a source in the azimuth of 45°, one along x = −y, and to one in 90° one along x."""
    one = Irregularity(2.0, 0.5, 8.0)
    for azimuth, seen in ((45.0, (0.5, -2.0)), (90.0, (-2.0, -0.5))):
        turned = one.turned(azimuth)
        assert (turned.fringes, turned.fringes_45) == pytest.approx(seen)
        lens = in_the_stop(ConstantIndex(1.5), one)
        assert seen_from(lens, azimuth).surfaces[0].irregularity == turned
    # What a cylinder along y does to the field (x, y) is what one along x does to the field (y, −x).
    gauss = find_lens("double_gauss_28")
    rings, found = hexapolar(4), []
    for fringes, field in ((30.0, (3.0, 4.0)), (-30.0, (4.0, -3.0))):
        surface = replace(gauss.surfaces[2], irregularity=Irregularity(fringes, 0.0, 20.0))
        bad = replace(gauss, surfaces=(*gauss.surfaces[:2], surface, *gauss.surfaces[3:]))
        found.append(pencil(bad, Source(field_deg=field), *rings))
    assert found[0].dx == pytest.approx(found[1].dx, abs=1e-11)
    assert found[0].chief_x == pytest.approx(found[1].chief_x, abs=1e-11) and abs(found[0].chief_x) > 1e-4


def test_a_cylinder_turned_is_a_surface_turned():
    """By breaks about z before and behind the surface, a road of its own through the tracer."""
    gauss, one, angle = find_lens("double_gauss_28"), Irregularity(40.0, 0.0, 20.0), 30.0
    placed = {"before": (Placement(tilt_z_deg=angle),), "after": (Placement(tilt_z_deg=-angle),)}
    found = []
    for change in ({"irregularity": one.turned(angle)}, {"irregularity": one, **placed}):
        surfaces = list(gauss.surfaces)
        surfaces[2] = replace(surfaces[2], **change)
        found.append(pencil(replace(gauss, surfaces=tuple(surfaces)), Source(field_deg=7), *hexapolar(4)))
    for name in ("dx", "dy", "path"):
        assert getattr(found[0], name) == pytest.approx(getattr(found[1], name), abs=1e-11)


def test_two_irregularities_over_different_radii_add():
    x, y = np.random.default_rng(1).uniform(-5, 5, (2, 20))
    one, other = Irregularity(1.0, -2.0, 4.0), Irregularity(0.7, 3.0, 9.0)
    both = one.added(other.fringes, other.fringes_45, other.normalisation_mm)
    sag = one.sag_and_gradient(x, y)[0] + other.sag_and_gradient(x, y)[0]
    assert both.sag_and_gradient(x, y)[0] == pytest.approx(sag, abs=1e-15)


def test_an_irregular_freeform_refracts_about_the_normal_of_both():
    """Snell's law in vectors; the normal is that of central differences of the whole sag, good to 1e-9."""
    lens = in_the_stop(ConstantIndex(1.5), Irregularity(60.0, -40.0, 5.0))
    surface = replace(lens.surfaces[0], shape=XYPolynomial((0.0, 0.0, 0.02, -0.05, 0.03, 0.01), 5.0))
    lens, way, step = replace(lens, surfaces=(surface, lens.surfaces[1])), np.array([0.0, 0.0, 1.0]), 1e-4
    starts = np.array([[1.0, 2.0, -3.0], [-2.5, 1.5, -3.0], [0.5, -3.0, -3.0]])
    met, behind = trace(lens, starts, np.broadcast_to(way, (3, 3)), UM).points[1:3]
    for (x, y, _), found in zip(met, behind - met, strict=True):
        across = surface.sag(x + step, y) - surface.sag(x - step, y)
        up = surface.sag(x, y + step) - surface.sag(x, y - step)
        normal = np.array([-across, -up, 2 * step]) / np.linalg.norm([across, up, 2 * step])
        bent = (way - (way @ normal) * normal) / 1.5
        bent = bent + np.sqrt(1 - bent @ bent) * normal
        assert found / np.linalg.norm(found) == pytest.approx(bent, abs=1e-8) and np.hypot(across, up) > 1e-3 * step


def test_a_lens_file_keeps_an_irregular_surface_and_other_formats_refuse_it(tmp_path):
    lens = in_the_stop(ConstantIndex(1.5), Irregularity(2.0, 0.25, 8.0))
    text = lens_to_toml(lens)
    assert "irregularity = { fringes = 2.0, fringes_45 = 0.25, normalisation_radius = 8.0 }" in text
    assert parse_toml(text, "lens.toml") == lens
    in_cm = text.replace('unit = "mm"', 'unit = "cm"')
    assert parse_toml(in_cm, "lens.toml").surfaces[0].irregularity == Irregularity(2.0, 0.25, 80.0)
    for ending in (".zmx", ".seq", ".json"):
        with pytest.raises(LensFileError, match=r"surface 1: a file that ends in .* cannot express its irregularity"):
            write_lens(lens, tmp_path / f"lens{ending}")
    with pytest.raises(LensFileError, match="normalisation_radius"):
        parse_toml(text.replace("normalisation_radius = 8.0", "normalisation_radius = -8.0"), "lens.toml")


def test_what_cannot_be_is_refused():
    for fringes, radius, words in ((inf, 5.0, "not finite"), (1.0, 1e-200, "radius 1e-200"), (1.0, 1e200, "radius 1e")):
        with pytest.raises(GeometryError, match=f"surface 1: .*{words}"):
            in_the_stop(ConstantIndex(1.5), Irregularity(fringes, 0.0, radius))
    with pytest.raises(
        GeometryError, match="surface 1 is tilted, decentred or not of revolution, and this supports only rotational"
    ):
        check_aligned(in_the_stop(ConstantIndex(1.5), Irregularity(1.0, 0.0, 5.0)), Message("this"))
