"""PSFs through the real stop: by every method, by evenly spaced rays of the entrance pupil, and in the limits."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.conventions import UM_PER_MM, centred_axis
from p2sf.disc.quadrature import SETTLED_TOLERANCE, disc_nodes
from p2sf.disc.transform import sum_plane_waves
from p2sf.errors import GeometryError
from p2sf.lens.lens import Aperture, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.choosing import choose
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import PsfOptions, render
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.seidel import suitable_pixel_um
from p2sf.psf.traced import traced_psf
from p2sf.pupil.fit import fit
from p2sf.pupil.plane_waves import pupil_amplitude
from p2sf.pupil.rays import RayPupil
from p2sf.raytrace.aiming import entrance
from p2sf.raytrace.pencil import pencil, pupil_rays, trace
from tests.support.tiers import in_tiers
from tests.support.waves import r_squared

PLACES = [("cooke_triplet", 20), ("double_gauss_28", 14), ("tessar", 20.5), ("reverse_telephoto", 30), ("petzval", 0)]


def place(name, angle, depth=inf):
    """Return a lens aimed at its stop, a source, and a pitch that shows its PSF."""
    lens = with_aim(find_lens(name), "stop")
    source = Source(depth, np.tan(np.deg2rad(angle)), lens.reference_wavelength_um)
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return lens, source, float(suitable_pixel_um(c, 32))


@pytest.mark.parametrize(("name", "angle"), in_tiers(PLACES, PLACES[2:4]))
@pytest.mark.parametrize("depth", [inf, 2000.0])
def test_all_ways_to_sum_the_same_rays_agree(name, angle, depth):
    """As well as they do through the paraxial pupil: the promises of `test_fitted` and `test_traced`."""
    lens, source, pixel = place(name, angle, depth)
    reference = huygens_psf(lens, source, 32, pixel)
    fitted, traced = fitted_psf(lens, source, 32, pixel), traced_psf(lens, source, 32, pixel)
    assert r_squared(fitted.values, reference.values) >= 0.998
    assert r_squared(traced.values, reference.values) >= 0.9999
    assert traced.strehl == pytest.approx(reference.strehl, rel=2e-3)
    if reference.energy is not None:
        assert traced.energy == pytest.approx(reference.energy, rel=5e-3)


def evenly_launched(lens, source, axis, count=700):
    """Return the intensity of rays that fill the plane of the entrance pupil evenly, as far as they pass the stop.

    Nothing is aimed: each ray's place in the stop says how much of its cell lies inside the rim.
    """
    enter, turn = entrance(lens, source), np.linspace(0, 2 * np.pi, 200)
    rim = pupil_rays(lens, source, np.sin(turn), np.cos(turn))
    radius, even = float(enter.radius[0]), with_aim(lens, "paraxial")
    # The grid covers the pupil as far as the rim's rays reach, and two cells more.
    half, middle = 1.01 * np.ptp(rim.y) / 2, (rim.y.max() + rim.y.min()) / 2
    half = max(half, 1.01 * rim.x.max())
    cell = 2 * half / count
    steps = centred_axis(count, cell) + cell / 2
    x, y = (v.ravel() for v in np.meshgrid(steps[steps > 0], steps + middle))
    launched = pupil_rays(even, source, x / radius, y / radius)
    at_stop = trace(lens, launched.origins, launched.directions, source.wavelength_um).points[int(enter.stop.surface)]
    height = np.hypot(at_stop[:, 0], at_stop[:, 1]) / float(enter.stop.semi_diameter)
    grid = height.reshape(count, -1)
    # How far the rim lies from the cell's centre, in cells, by the slope of the height: the share inside it.
    slope = np.hypot(*np.gradient(grid)).ravel()
    inside = np.clip((1 - height) / slope + 0.5, 0, 1)
    some = inside > 0
    data = pencil(even, source, (x / radius)[some], (y / radius)[some])
    centre = UM_PER_MM * float(
        (pencil(lens, source, [0.0], [0.5]).chief_y - pencil(even, source, [0.0], [0.5]).chief_y)[0]
    )
    amplitude = pupil_amplitude(inside[some] / inside.sum(), data.phase)
    field = sum_plane_waves(amplitude, data.fx, data.fy, axis, axis + centre)
    return np.abs(field) ** 2


@pytest.mark.parametrize(("name", "angle"), [("reverse_telephoto", 30), ("tessar", 20.5), ("cooke_triplet", 20)])
def test_weighted_nodes_of_the_stop_are_even_nodes_of_the_entrance_pupil(name, angle):
    lens, source, pixel = place(name, angle)
    psf, plain = huygens_psf(lens, source, 32, pixel), evenly_launched(lens, source, centred_axis(32, pixel))
    # A grid of 700 cells whose edge cells are weighted: (1/350)² of the pupil times the waves along the rim.
    assert 1 - r_squared(psf.values, plain) < 1e-5
    assert psf.over_unaberrated.max() == pytest.approx(plain.max(), rel=3e-3)


def test_without_weights_the_picture_would_be_another():
    """What the check above can tell: the same nodes, each counted alike."""
    lens, source, pixel = place("telephoto", 10)
    nodes, axis = disc_nodes(100, 320), centred_axis(32, pixel)
    data = pencil(lens, source, nodes.xi, nodes.eta)
    even, weighted = (
        np.abs(sum_plane_waves(pupil_amplitude(w, data.phase), data.fx, data.fy, axis, axis)) ** 2
        for w in (nodes.weight, nodes.weight * data.amplitude)
    )
    psf = huygens_psf(lens, source, 32, pixel)
    assert 1 - r_squared(weighted, psf.values) < 1e-7 < 5e-4 < 1 - r_squared(even, psf.values)


def test_in_a_narrow_pencil_near_the_axis_both_fillings_are_one():
    lens = replace(find_lens("cooke_triplet"), aperture=Aperture("f_number", 60.0))
    differences = []
    for slope in (0.08, 0.04, 0.02):
        source = Source(inf, slope, 0.5875618)
        stop, even = (huygens_psf(with_aim(lens, aim), source, 32, 4.0) for aim in ("stop", "paraxial"))
        differences.append(1 - r_squared(stop.values, even.values))
    assert differences[2] < 1e-3
    assert differences[0] > 4 * differences[1] > 16 * differences[2]  # at least of second order in the field


def test_energy_is_that_of_the_weighted_pupil():
    lens, source, _ = place("reverse_telephoto", 30)
    wide = [huygens_psf(lens, source, pixels, 0.7).energy for pixels in (64, 128)]
    # Of a hard-edged aperture some 2/(π²·v) lies outside v: what is missing halves with the window's width.
    assert 0.9 < wide[0] < wide[1] < 1
    assert (1 - wide[0]) / (1 - wide[1]) == pytest.approx(2.0, rel=0.15)


def test_the_radiometric_amplitude_conserves_energy_and_changes_the_picture_little():
    """∫|field|² is then the light sent in, so a window holds the share of light that its rays carry."""
    lens, source, pixel = place("periskop", 30)
    area, light = (
        psf_of_pupil(RayPupil(lens, source, areas=areas), (32, pixel), rtol=SETTLED_TOLERANCE)
        for areas in (None, fit(lens, source))
    )
    assert 1e-3 < 1 - r_squared(light.values, area.values) < 2e-2
    lens, source, _ = place("reverse_telephoto", 30)
    conserved = psf_of_pupil(RayPupil(lens, source, areas=fit(lens, source)), (128, 0.7), rtol=SETTLED_TOLERANCE)
    assert conserved.energy == pytest.approx(huygens_psf(lens, source, 128, 0.7).energy, abs=5e-3)


def test_the_choice_allows_for_an_uneven_pupil():
    """Six coefficients fill the pupil evenly; where the stop's rays do not, the prediction knows."""
    lens, source, pixel = place("reverse_telephoto", 30)
    choice = choose(lens, source, 0.9999)
    made = render(lens, source, "auto", 32, pixel, PsfOptions(min_r2=0.9999))
    assert made.method == choice.method != "seidel"
    assert r_squared(made.values, huygens_psf(lens, source, 32, pixel).values) > 0.9999


def test_a_count_of_numbers_may_leave_out_those_of_the_weight():
    lens, source, _ = place("tessar", 10)
    with pytest.raises(GeometryError, match="no fit has 47 numbers; choose one of 32, 58, 92"):
        fit(lens, source, 47)
    assert fit(lens, source, 46).numbers == fit(lens, source, 58).numbers == 58
    assert fit(with_aim(lens, "paraxial"), source, 46).numbers == 46
