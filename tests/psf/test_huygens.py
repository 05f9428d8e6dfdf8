"""The reference: against the witness's PSFs, against its own definition, and what it reports about itself."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import disc_nodes
from p2sf.errors import Cancelled, GeometryError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.source import Source
from p2sf.psf.huygens import huygens_psf
from p2sf.pupil.clear_curves import clear_curve
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.rays import RayPupil
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.pupil.watch import Watch
from p2sf.raytrace.pencil import pencil
from tests.support.rays.pencils import double_gauss
from tests.support.reference import LENSES, case, huygens_rows, prescription_lens
from tests.support.waves import r_squared, relative_l2


@pytest.mark.parametrize("name", LENSES)
def test_the_reference_equals_the_witness(name):
    for row, stored, _ in huygens_rows(name):
        psf = huygens_psf(*case(name, row), 32, row["pixel_um"])
        assert 1 - r_squared(psf.values, stored) < 1e-9  # the witness converged to 1e-6
        assert psf.error <= 1e-4
        assert psf.over_unaberrated.max() == pytest.approx(stored.max(), rel=1e-6)


def off_axis():
    row, stored, _ = huygens_rows("double_gauss_28")[2]
    return *case("double_gauss_28", row), row["pixel_um"], stored


def plain_sum(data, weight, x_um, y_um):
    """Return the field Σ weight·exp(2πi(w + f·x)) point by point, (y, x), mirror images included: the definition."""
    field = np.empty((len(y_um), len(x_um)), complex)
    for j, y in enumerate(y_um):
        for i, x in enumerate(x_um):
            right = np.exp(2j * np.pi * (data.phase + data.fx * x + data.fy * y))
            left = np.exp(2j * np.pi * (data.phase - data.fx * x + data.fy * y))
            field[j, i] = weight @ (right + left) / 2
    return field


def test_the_matrix_products_equal_the_double_loop():
    lens, source, pixel, _ = off_axis()
    nodes = disc_nodes(20, 40)
    data = pencil(lens, source, nodes.xi, nodes.eta)
    axis = centred_axis(16, pixel)

    field = RayPupil(lens, source).sample((20, 40), 16 * pixel).waves.field(axis, axis)
    assert np.max(np.abs(field - plain_sum(data, nodes.weight, axis, axis))) < 1e-12  # waves of 1e3 in float64


@pytest.mark.parametrize("index", [2, 5])
def test_a_live_picture_promises_nothing_and_takes_more_rays_where_it_needs_them(index):
    row, stored, _ = huygens_rows("double_gauss_28")[index]
    live = huygens_psf(*case("double_gauss_28", row), 32, row["pixel_um"], rtol=None)
    assert live.error is None and (live.rays > 6480) == (index == 5)
    assert 1 - r_squared(live.values, stored) < 1e-6  # float32 phases, one pass


def test_a_sum_that_has_not_converged_says_so(monkeypatch):
    lens, source, pixel, _ = off_axis()
    monkeypatch.setattr(RayPupil, "counts", lambda *a: (8, 16))
    monkeypatch.setattr("p2sf.pupil.watch.MOST_RAYS", 200)
    psf = huygens_psf(lens, source, 32, pixel)
    assert psf.error > 1e-2
    assert "not converged" in str(psf.sampling)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_the_stated_tolerance_is_the_one_that_ends_the_sum(monkeypatch, tolerance):
    """From few rays the agreement passes through every decade, so that a laxer end would show."""
    lens, source, pixel, _ = off_axis()
    monkeypatch.setattr(RayPupil, "counts", lambda *a: (16, 32))
    psf = huygens_psf(lens, source, 16, pixel, rtol=tolerance)
    assert psf.error <= tolerance and "not converged" not in str(psf.sampling)


def test_progress_rises_to_one_and_cancel_stops():
    lens, source, pixel, _ = off_axis()
    seen = []
    huygens_psf(lens, source, 32, pixel, watch=Watch(seen.append))
    assert seen == sorted(seen) and seen[-1] == 1.0
    for tolerance in (1e-4, None):
        with pytest.raises(Cancelled):
            huygens_psf(lens, source, 32, pixel, tolerance, watch=Watch(cancelled=lambda: True))


def test_all_the_light_is_found_in_a_wide_window():
    lens, source = case("cooke_triplet", huygens_rows("cooke_triplet")[0][0])
    psf = huygens_psf(lens, source, 128, 0.6)
    # Of a hard-edged aperture 2/(π²·v) lies outside v: 1 % at 77 µm width and f/5.
    assert psf.energy == pytest.approx(0.99, abs=0.01)


def test_a_pupil_that_no_rim_touches_is_not_clipped():
    lens, source, pixel, _ = off_axis()
    narrow = replace(lens, aperture=Aperture("stop_semi_diameter", 4.0))
    clear = pupil_nodes(narrow, source, (8, 16), clip=True)
    assert clear.share == pytest.approx(1.0, abs=1e-12)
    plain, clipped = (huygens_psf(narrow, source, 32, pixel, clip=c) for c in (False, True))
    assert r_squared(clipped.values, plain.values) > 1 - 1e-8


def test_clear_apertures_end_exactly_at_the_rims():
    lens = double_gauss()
    rims = [12.0 if j == 0 else s.semi_diameter for j, s in enumerate(lens.surfaces)]
    surfaces = tuple(replace(s, semi_diameter=rim) for s, rim in zip(lens.surfaces, rims, strict=True))
    source = Source(inf, 0.0, 0.6562725)
    cut = replace(lens, surfaces=surfaces)
    # On axis the first rim simply stops the pupil down to a circle: 12 mm of 16.7 mm.
    assert clear_curve(cut, source).corners == (0.0, np.pi)
    radius = pupil_nodes(cut, source, (8, 24), clip=True).share ** 0.5
    row = huygens_rows("double_gauss_28")[0][0]
    small = replace(lens, aperture=Aperture("stop_semi_diameter", lens.aperture.value * radius))
    pixel = row["pixel_um"]
    clipped = huygens_psf(cut, source, 32, pixel, clip=True)
    assert r_squared(clipped.values, huygens_psf(small, source, 32, pixel).values) > 1 - 1e-8


def overfilled():
    """Return a lens whose first rim stops an axial beam down to a small circle, and the lens with such a stop."""
    lens = double_gauss()
    cut = replace(lens, surfaces=(replace(lens.surfaces[0], semi_diameter=4.0), *lens.surfaces[1:]))
    radius = pupil_nodes(cut, AXIAL, (8, 24), clip=True).share ** 0.5
    return cut, replace(lens, aperture=Aperture("stop_semi_diameter", lens.aperture.value * radius))


AXIAL = Source(3000.0, 0.0, 0.6562725)  # out of focus, where the outer rays that the rim stops are the steepest


def test_rays_that_rims_stop_ask_for_no_nodes():
    """A rim that leaves a small circle asks for as many nodes as a stop of that size, which passes all its rays."""
    cut, small = overfilled()
    reach = window_reach_um(32, 10.0)
    clipped, stopped = RayPupil(cut, AXIAL, clip=True).counts(reach), RayPupil(small, AXIAL).counts(reach)
    # The outermost node is not on the rim; counts come in steps of 4 and 16.
    assert np.array(clipped) == pytest.approx(np.array(stopped), rel=0.1, abs=16)
    assert np.prod(RayPupil(cut, AXIAL).counts(reach)) > 5 * np.prod(clipped)


def test_the_light_within_a_clipped_window_takes_no_table_of_all_nodes(monkeypatch):
    """Its energy is that of the lens stopped down to the same circle: to 1e-4, since fits are made of either pupil."""
    cut, small = overfilled()
    sizes = []

    def recorded(lens, source, xi, eta):
        sizes.append(np.size(xi))
        return pencil(lens, source, xi, eta)

    monkeypatch.setattr("p2sf.pupil.rays.pencil", recorded)
    clipped, stopped = (huygens_psf(one, AXIAL, 256, 1.0, clip=one is cut) for one in (cut, small))
    assert clipped.energy == pytest.approx(stopped.energy, rel=1e-4) and 0.1 < clipped.energy < 0.999
    assert max(sizes) < clipped.rays  # some hundred nodes with four rays beside each, however many are summed


def test_the_first_counts_carry_the_phase_up_to_the_corners_of_the_window():
    """Coma, whose rays land on one side of the window: the first pass is as good as nine times as many rays."""
    lens, source, pixel, _ = off_axis()
    reach, axis = window_reach_um(32, pixel), centred_axis(32, pixel)
    counts = RayPupil(lens, source).counts(reach)
    first, finer = (RayPupil(lens, source).sample((k * counts[0], k * counts[1]), reach).waves for k in (1, 3))
    assert relative_l2(first.intensity(axis, axis), finer.intensity(axis, axis)) < 1e-6


def test_the_cats_eye_converges_and_loses_light():
    lens, source, pixel, _ = off_axis()
    clipped = huygens_psf(lens, source, 32, pixel, clip=True)
    assert clipped.error <= 1e-4
    share = pupil_nodes(lens, source, (8, 64), clip=True).share
    assert len(clear_curve(lens, source).corners) > 2
    grid = np.linspace(-1, 1, 201)
    xi, eta = (a.ravel() for a in np.meshgrid(grid, grid))
    inside = xi**2 + eta**2 <= 1
    passed = pencil(lens, source, xi[inside], eta[inside], clip=True).passed
    assert share == pytest.approx(passed.mean(), abs=5e-3)  # counting on a 200² grid is good to its edge cells


def test_a_pupil_that_is_clipped_altogether_is_refused():
    lens = double_gauss()
    surfaces = (replace(lens.surfaces[0], semi_diameter=0.1), *lens.surfaces[1:])
    with pytest.raises(GeometryError, match="rims clip every ray"):
        huygens_psf(replace(lens, surfaces=surfaces), Source(inf, 0.3, 0.6562725), 32, 1.0, clip=True)


def test_more_nodes_are_asked_for_a_wider_window_and_a_stronger_blur():
    lens, source, pixel, _ = off_axis()
    near = RayPupil(lens, source).counts(window_reach_um(32, pixel))
    wide = RayPupil(lens, source).counts(window_reach_um(256, pixel))
    assert wide[0] > near[0] and wide[1] > near[1]


def test_a_relay_and_the_eye_have_their_own_index_and_orientation():
    lens = prescription_lens("eye_navarro", 543.0)
    row, stored, _ = huygens_rows("eye_navarro")[1]
    psf = huygens_psf(*case("eye_navarro", row), 32, row["pixel_um"])
    flipped = np.roll(psf.values[::-1], 1, axis=0)
    assert r_squared(psf.values, stored) > 0.999999 > 0.9 > r_squared(flipped, stored)
    assert lens.media[-1].index(0.543) == pytest.approx(1.3377, abs=2e-3)


def test_where_rays_are_lost_the_pupil_ends_there_and_the_sum_still_converges():
    """A bubble of almost no power, overfilled: beyond 5 mm rays miss it, and that edge is found, not sampled."""
    front, back = Surface(5.0, 10.0, ConstantIndex(1 + 1e-6)), Surface(-5.0, 50.0)
    # Rays are aimed at the stop by differences, which end 1e-6 of its radius short of the edge.
    lens = Lens((front, back), Aperture("stop_semi_diameter", 5.5), 1, aim="paraxial")
    source = Source(inf, 0.0, 0.55)
    psf = huygens_psf(lens, source, 32, 20.0, 1e-3)
    assert psf.error <= 1e-3
    share = pupil_nodes(lens, source, (8, 64), whole=False).share
    assert share == pytest.approx((5.0 / 5.5) ** 2, rel=1e-9)
