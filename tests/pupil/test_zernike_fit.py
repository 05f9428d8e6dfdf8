"""Zernike terms of exact wavefronts: analytic ones, sums of squares, clipped pupils, and an independent dense grid."""

from math import sqrt

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.disc.zernike_terms import zernike_terms, zernike_values
from p2sf.lens.lens import AIMS, with_aim, with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pupil.vignetting import whole_nodes
from p2sf.pupil.zernike_fit import decompose, pupil_opd, zernike_fit
from p2sf.raytrace.pencil import displayed_opd, hexapolar, opd_map, pencil, pupil_grid
from tests.support.waves import rms_about_plane

WHOLE = whole_nodes((24, 64))


@pytest.mark.parametrize(
    ("shape", "noll"),
    [
        # Born & Wolf 1999, §9.2, and Mahajan 1991, table 2-1: the powers in terms of the orthonormal polynomials.
        (lambda x, y: (x * x + y * y) ** 2, {1: 1 / 3, 4: 1 / (2 * sqrt(3)), 11: 1 / (6 * sqrt(5))}),
        (lambda x, y: (x * x + y * y) * y, {3: 1 / 3, 7: 1 / (3 * sqrt(8))}),
        (lambda x, y: y * y, {1: 1 / 4, 4: 1 / (4 * sqrt(3)), 6: -1 / (2 * sqrt(6))}),
        (lambda x, y: x * x + y * y, {1: 1 / 2, 4: 1 / (2 * sqrt(3))}),
    ],
)
def test_powers_are_split_as_in_the_textbooks(shape, noll):
    found = decompose(WHOLE, shape(WHOLE.xi, WHOLE.eta), "noll", zernike_terms("noll", 37))
    expected = np.zeros(37)
    expected[[number - 1 for number in noll]] = list(noll.values())
    assert np.allclose(found.waves, expected, rtol=0, atol=1e-14)
    assert found.residual < 1e-13


def test_a_fringe_coefficient_is_the_peak_of_its_polynomial():
    waves = 0.7 * (6 * (WHOLE.xi**2 + WHOLE.eta**2) ** 2 - 6 * (WHOLE.xi**2 + WHOLE.eta**2) + 1)
    found = decompose(WHOLE, waves, "fringe", zernike_terms("fringe", 37))
    assert found.waves[8] == pytest.approx(0.7, abs=1e-14)
    assert found.share[8] == pytest.approx(1.0, abs=1e-12) and found.rms == pytest.approx(0.7 / sqrt(5), rel=1e-13)


def test_the_exact_wavefront_of_the_telephoto_has_the_shares_of_a_fit_on_a_dense_grid():
    """Least squares with powers of ξ and η, written out here, on 200² traced rays; ``published`` is paraxial."""
    lens, source = with_aim(find_lens("telephoto"), "paraxial"), Source(field_deg=7)
    xi, eta, inside = pupil_grid(200)
    waves, x, y = opd_map(lens, source, 200)[inside], xi[inside], eta[inside]
    s = x * x + y * y
    families = {
        "defocus": [np.sqrt(3) * (2 * s - 1)],
        "coma": [np.sqrt(8) * (3 * s - 2) * y],
        "trefoil": [np.sqrt(8) * (3 * x * x * y - y**3)],
        "spherical aberration": [np.sqrt(5) * (6 * s * s - 6 * s + 1)],
        "secondary spherical aberration": [np.sqrt(7) * (20 * s**3 - 30 * s * s + 12 * s - 1)],
    }
    others = [x**0, y, x * x - y * y, s * (x * x - y * y), s * s * y, s**4, s * y**3, s * s * y**3, s * s * x * x, s**5]
    table = np.stack([*(column for columns in families.values() for column in columns), *others], axis=1)
    coefficients = np.linalg.lstsq(table, waves, rcond=None)[0][: len(families)]
    # Terms beyond degree 6 among the others overlap those named; the projection of the rest on each is added back.
    rest = waves - table[:, : len(families)] @ coefficients
    coefficients = coefficients + np.array([(rest * column).mean() for column in table.T[: len(families)]])
    plain = waves - waves.mean()
    blur = plain.var() - ((plain * y).mean() ** 2) / (y * y).mean()
    found = zernike_fit(lens, source)
    ours = {name: found.share[[t.name == name for t in found.terms]].sum() for name in families}
    # A grid of squares misses the disc's edge by a share of 1/200 or so, and the rim has the largest waves.
    for (name, share), value in zip(ours.items(), coefficients, strict=True):
        assert share == pytest.approx(value**2 / blur, abs=0.01), name
    published = [0.30, 0.23, 0.14, 0.004, 0.28]
    assert np.allclose(list(ours.values()), published, rtol=0, atol=0.006)


@pytest.mark.parametrize(("name", "field", "clip"), [("telephoto", 7, False), ("double_gauss_28", 14, True)])
@pytest.mark.parametrize("order", ["noll", "fringe"])
@pytest.mark.parametrize("aim", ["paraxial", "stop"])
def test_squares_add_up_to_the_variance(name, field, clip, order, aim):
    lens = with_aim(find_lens(name), aim)
    found = zernike_fit(lens, Source(field_deg=field), order, clip=clip)
    assert (found.clear < 1) == clip
    squares = (found.rms_waves[1:] ** 2).sum() + found.residual**2
    assert squares == pytest.approx(found.rms_with_tilt**2, rel=1e-10)
    assert found.share.sum() + found.residual**2 / found.rms**2 == pytest.approx(1, abs=1e-9)


def test_terms_of_a_clipped_pupil_are_orthogonal_there_and_describe_the_wavefront():
    lens, source = find_lens("double_gauss_28"), Source(field_deg=14)
    nodes, waves = pupil_opd(lens, source, clip=True)
    terms = zernike_terms("noll", 21)
    bare = zernike_values(tuple(t for t in terms if t.even), nodes.xi, nodes.eta)
    assert not np.allclose((bare * nodes.weight) @ bare.T, np.eye(len(bare)), atol=0.01)
    for term, values in zip((t for t in terms if t.even), bare, strict=True):
        one = decompose(nodes, values, "noll", terms)
        assert np.allclose(one.rms_waves[term.number :], 0, atol=1e-10)  # a term is made of itself and those before it
        assert (one.rms_waves**2).sum() == pytest.approx(nodes.weight @ values**2, rel=1e-12)
    assert decompose(nodes, waves, "noll", terms).residual < 0.05  # of 3.6 waves


@pytest.mark.parametrize(("name", "field"), [("double_gauss_28", 14), ("petzval", 7)])
@pytest.mark.parametrize("aim", AIMS)
def test_the_clipped_variance_is_that_of_rays_on_a_dense_grid(name, field, aim):
    lens, source = with_aim(find_lens(name), aim), Source(field_deg=field)
    xi, eta, inside = pupil_grid(300)
    passed = pencil(lens, source, xi[inside], eta[inside], clip=True).passed
    waves = displayed_opd(lens, source, xi[inside][passed], eta[inside][passed])
    found = zernike_fit(lens, source, clip=True)
    # An all-or-nothing edge is wrong by up to half a cell in places: some 1/300 of area and of waves.
    assert found.clear == pytest.approx(passed.mean(), abs=0.002)
    assert found.rms_with_tilt == pytest.approx(waves.std(), rel=0.005)
    if aim == "paraxial":  # of which rims clip more than of the real stop
        whole = zernike_fit(lens, source)
        assert abs(found.rms_with_tilt / whole.rms_with_tilt - 1) > (0.05 if name == "petzval" else 0.002)


def test_the_variance_without_tilt_does_not_depend_on_how_many_terms_are_asked():
    lens, source = with_aim(find_lens("telephoto"), "paraxial"), Source(field_deg=7)
    one, many = zernike_fit(lens, source, count=1), zernike_fit(lens, source, count=66)
    assert one.rms == pytest.approx(many.rms, rel=1e-12) and one.rms_with_tilt == many.rms_with_tilt
    assert many.residual < 1e-4 < one.residual


def test_stop_coordinates_follow_the_lens():
    lens, source = find_lens("telephoto"), Source(field_deg=7)
    paraxial, real = (zernike_fit(with_aim(lens, aim), source) for aim in ("paraxial", "stop"))
    nodes, waves = pupil_opd(with_aim(lens, "stop"), source)
    assert real.rms_with_tilt == pytest.approx(np.sqrt(nodes.weight @ (waves - nodes.weight @ waves) ** 2), rel=1e-12)
    assert abs(real.rms_with_tilt / paraxial.rms_with_tilt - 1) > 0.05


def test_terms_of_a_misaligned_lens_are_those_of_its_mirror_image_and_of_no_misalignment():
    """What is odd in ξ changes sign with the decentre, is proportional to it where small, and 0 without."""
    lens, source = find_lens("double_gauss_28"), Source(field_deg=5)
    still = zernike_fit(lens, source)
    odd = np.array([not term.even for term in still.terms])
    assert not still.waves[odd].any()
    right, left, half = (
        zernike_fit(displaced(lens, 3, 5, Placement(x, 0, 0, 0, x)), source) for x in (0.02, -0.02, 0.01)
    )
    assert right.waves[~odd] == pytest.approx(left.waves[~odd], abs=1e-6)
    assert right.waves[odd] == pytest.approx(-left.waves[odd], abs=1e-6)
    assert right.waves[odd] == pytest.approx(2 * half.waves[odd], abs=1e-3 * np.abs(right.waves[odd]).max())
    assert np.abs(right.waves[odd]).max() > 0.01 and np.abs(right.waves - still.waves)[~odd].max() < 0.01
    assert np.square(right.waves[1:]).sum() + right.residual**2 == pytest.approx(right.rms_with_tilt**2, rel=1e-9)


def test_the_terms_of_a_misaligned_lens_add_up_to_its_wavefront():
    """Rays that the decomposition does not use; by both tilts the variance without tilt is less."""
    source, lens = Source(field_deg=(3, 4)), displaced(find_lens("tessar"), 1, 2, Placement(0.05, -0.1, 0, 0.1, 0.2))
    found, (xi, eta) = zernike_fit(lens, source, count=231), hexapolar(3)
    expected = displayed_opd(lens, source, xi, eta)
    assert found.waves @ zernike_values(found.terms, xi, eta) == pytest.approx(expected, abs=1e-4)
    tilts = np.square(found.waves[1:3])
    assert (tilts > 0).all()
    assert found.rms**2 == pytest.approx(found.rms_with_tilt**2 - tilts.sum(), rel=1e-9)
    assert found.share.sum() == pytest.approx(1.0, abs=1e-6)


def test_rims_end_the_pupil_of_a_misaligned_lens():
    lens = displaced(find_lens("double_gauss_28"), 1, 3, Placement(1.5, 0.5))
    nodes, waves = pupil_opd(lens, Source(field_deg=14), clip=True, counts=(8, 20))
    found = decompose(nodes, waves, "noll", zernike_terms("noll", 37))
    assert 0.2 < found.clear < 0.95 and found.residual < 0.2 * found.rms


def moment(dark: float, power: int) -> float:
    """Return the mean of ρ^(2·power) over a ring."""
    return (1 - dark ** (2 * power + 2)) / ((power + 1) * (1 - dark**2))


def ring(dark: float):
    """Return nodes over a ring, as a lens with an obscuration has them."""
    return pupil_opd(with_mask(find_lens("telephoto"), PupilMask(obscuration=dark)), Source())[0]


@pytest.mark.parametrize("dark", [0.1, 0.36, 0.9])
def test_over_a_ring_terms_are_the_annular_polynomials(dark):
    """ρ⁴ in Legendre polynomials of 2(ρ² − ε²)/(1 − ε²) − 1, as Mahajan 1981 has them; coma by its moments."""
    nodes, gap = ring(dark), 1 - dark**2
    square, terms = nodes.xi**2 + nodes.eta**2, zernike_terms("noll", 37)
    fourth = decompose(nodes, square**2, "noll", terms)
    expected = np.zeros(37)
    expected[[0, 3, 10]] = moment(dark, 2), (1 + dark**2) * gap / (2 * sqrt(3)), gap**2 / (6 * sqrt(5))
    assert np.allclose(fourth.waves, expected, rtol=0, atol=1e-12)
    assert fourth.clear == pytest.approx(gap, rel=1e-12) and fourth.residual < 1e-12
    coma = decompose(nodes, square * nodes.eta, "noll", terms)
    left = sqrt(moment(dark, 3) / 2 - moment(dark, 2) ** 2 / (2 * moment(dark, 1)))
    assert abs(coma.waves[6]) == pytest.approx(left, rel=1e-9)
    assert coma.rms == pytest.approx(left, rel=1e-9)


def test_annular_terms_are_orthonormal_on_a_dense_grid():
    """Each polynomial found from its own nodes, summed over a million cells of a ring; the edge's cells cost 1e-3."""
    dark, terms = 0.4, zernike_terms("noll", 22)
    nodes = ring(dark)
    axis = (2 * np.arange(1000) + 1 - 1000) / 1000
    xi, eta = (v.ravel() for v in np.meshgrid(axis, axis))
    inside = (xi**2 + eta**2 < 1) & (xi**2 + eta**2 > dark**2)
    even = tuple(term for term in terms if term.even)
    plain = zernike_values(even, nodes.xi, nodes.eta)
    found = np.array([decompose(nodes, row, "noll", terms).waves[[t.even for t in terms]] for row in plain])
    annular = np.linalg.solve(found, zernike_values(even, xi[inside], eta[inside]))
    assert np.allclose(annular @ annular.T / inside.sum(), np.eye(len(even)), atol=3e-3)


def test_the_axis_of_a_telescope_has_terms_of_spherical_aberration_only():
    """The Hubble's error over its ring: RMS of a dense grid, all of it in Z11 and beyond, since the sensor is best."""
    lens = find_lens("hubble")
    found = zernike_fit(lens, Source(wavelength_um=0.6328))
    xi, eta, inside = pupil_grid(400)
    kept = inside & (xi**2 + eta**2 > lens.mask.obscuration**2)
    waves = opd_map(lens, Source(wavelength_um=0.6328), 400)[kept]
    assert found.rms_with_tilt == pytest.approx(waves.std(), rel=2e-3)
    names = [found.terms[k].name for k in np.argsort(-found.share)[:2]]
    assert "spherical aberration" in names[0] and found.share[10] > 0.99
    assert found.rms == pytest.approx(sqrt(sum(found.rms_waves[1:] ** 2) + found.residual**2), rel=1e-9)


OFF = Placement(0.02, 0.05, 0.0, 0.05, 0.02)


@pytest.mark.parametrize("clip", [False, True], ids=["whole", "rims"])
@pytest.mark.parametrize("off", [False, True], ids=["aligned", "off"])
@pytest.mark.parametrize(
    "mask",
    [
        PupilMask(blades=5, blade_angle_deg=10, cubic_um=0.2),
        PupilMask(obscuration=0.3, vanes=4, vane_width=0.04),
        PupilMask(obscuration=0.2, obscuration_x=0.3, obscuration_y=0.6, apodisation=0.7),
        PupilMask(obscuration=0.3),
        PupilMask(zernike_um=(0, 0, 0, 0.3)),
    ],
    ids=["blades", "spider", "beside", "ring", "phase"],
)
def test_any_mask_and_rims_leave_the_wavefront_of_a_dense_grid(mask, off, clip):
    """RMS without tilt, open area, and what 37 terms leave by least squares over the grid."""
    lens, source = with_mask(find_lens("cooke_triplet"), mask), Source(field_deg=17)
    lens = displaced(lens, 3, 4, OFF) if off else lens
    found = zernike_fit(lens, source, clip=clip)
    xi, eta, inside = pupil_grid(300)
    inside = inside & mask.opens(xi, eta)
    xi, eta = xi[inside], eta[inside]
    passed = pencil(lens, source, xi, eta, clip).passed
    assert passed.all() != clip
    xi, eta = xi[passed], eta[passed]
    waves = displayed_opd(lens, source, xi, eta) - mask.path_um(xi, eta) / source.wavelength_um
    assert found.clear == pytest.approx(xi.size * 4 / 300**2 / np.pi, abs=2e-3)
    assert found.rms == pytest.approx(rms_about_plane(waves, xi, eta), rel=4e-3)
    table = zernike_values(found.terms, xi, eta).T
    left = waves - table @ np.linalg.lstsq(table, waves)[0]
    assert found.residual == pytest.approx(np.sqrt(np.mean(left**2)), rel=0.03, abs=1e-6)
    assert found.rms_with_tilt**2 == pytest.approx(sum(found.rms_waves[1:] ** 2) + found.residual**2, rel=1e-9)


@pytest.mark.parametrize("blades", [5, 6])
def test_behind_blades_the_mean_of_a_defocus_is_that_of_a_polygon(blades):
    """(2 + cos 2π/n)/6 of a regular polygon within the unit circle, by its second moment."""
    nodes, _ = pupil_opd(with_mask(find_lens("telephoto"), PupilMask(blades=blades)), Source())
    found = decompose(nodes, nodes.xi**2 + nodes.eta**2, "noll", zernike_terms("noll", 37))
    assert found.waves[0] == pytest.approx((2 + np.cos(2 * np.pi / blades)) / 6, rel=1e-12)
    assert np.abs(found.waves[4:]).max() < 1e-9 and found.residual < 1e-7  # roots of sums that are 0 to rounding


@pytest.mark.parametrize("clip", [False, True])
def test_terms_behind_rims_and_a_disc_beside_the_middle_have_converged(clip):
    """Twice as many radii and directions change nothing."""
    mask = PupilMask(obscuration=0.2, obscuration_x=0.3, obscuration_y=0.6)
    lens, source, terms = with_mask(find_lens("cooke_triplet"), mask), Source(field_deg=17), zernike_terms("noll", 66)
    usual, fine = (decompose(*pupil_opd(lens, source, clip, n), "noll", terms) for n in ((24, 64), (48, 128)))
    assert usual.waves == pytest.approx(fine.waves, abs=1e-9)


@pytest.mark.parametrize("dark", [0.7, 0.9])
def test_terms_that_a_thin_ring_cannot_tell_apart_are_none(dark):
    """Squares add up all the same: what they leave is the residual."""
    mask = PupilMask(obscuration=dark, obscuration_x=0.05)
    nodes, waves = pupil_opd(with_mask(find_lens("telephoto"), mask), Source(field_deg=3))
    found = decompose(nodes, waves, "noll", zernike_terms("noll", 231))
    squares = (found.rms_waves[1:] ** 2).sum() + found.residual**2
    assert squares == pytest.approx(found.rms_with_tilt**2, rel=1e-3) and found.residual < 0.1 * found.rms


def test_a_hole_of_a_mirror_has_no_part_in_the_terms():
    """As the disc that it is in the stop, on the axis."""
    lens = find_lens("cassegrain_f10")
    holed = zernike_fit(lens, Source(), clip=True)
    assert holed.clear < 1
    xi, eta, inside = pupil_grid(300)
    xi, eta = xi[inside], eta[inside]
    passed = pencil(lens, Source(), xi, eta, True).passed & lens.mask.opens(xi, eta)
    waves = displayed_opd(lens, Source(), xi[passed], eta[passed])
    assert holed.clear == pytest.approx(passed.sum() * 4 / 300**2 / np.pi, abs=2e-3)
    assert holed.rms == pytest.approx(rms_about_plane(waves, xi[passed], eta[passed]), rel=1e-2)
