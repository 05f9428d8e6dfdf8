"""What the window computes behind a mask in the stop: the same pupil in picture, density, map, focus and sections."""

from math import inf

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import P2SFError
from p2sf.figures.compare import r_squared
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.geometric import geometric_psf
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.wavefront_map import disc
from p2sf.raytrace.pencil import displayed_opd, pencil, pupil_grid
from p2sf_explorer.compute.autofocus import amount, best_shift_um, open_nodes
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.measured import measure_request
from p2sf_explorer.compute.pupil import pupil_of
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.views.profiles import fine_lines
from p2sf_explorer.compute.views.rays import ray_errors, spots
from p2sf_explorer.state.state import new_state
from p2sf_explorer.state.terms import TERMS
from tests.support.tiers import in_tiers
from tests.support.waves import rms_about_plane

MASKS = (
    {"obscuration": 0.4},
    {"blades": 6},
    {"blades": 5, "roundness": 0.3},
    {"obscuration": 0.3, "vanes": 3, "vane_angle_deg": 10.0},
    {"apodisation": 0.7, "apodisation_power": 4},
    {"cubic_um": 0.5},
)

UNEVEN = ({"blades": 3}, {"blades": 5, "blade_angle_deg": 20.0}, {"obscuration": 0.3, "vanes": 1, "vane_width": 0.2})


def free(waves: dict[str, float], **mask):
    """Return a free pupil with these coefficients."""
    added = tuple(waves.get(term, 0.0) for term in TERMS)
    return new_state(method="seidel", free_pupil=True, added_waves=added, **mask)


def mapped(waves: dict[str, float], **mask):
    """Return the settled map of a free pupil."""
    return pupil_of(paraxial_setup(free(waves, **mask)), False, "settled")


@pytest.mark.parametrize("mask", MASKS, ids=str)
@pytest.mark.parametrize("method", ["seidel", "fitted"])
def test_the_moving_picture_is_the_settled_one_on_fewer_samples(mask, method):
    state = new_state(method=method, f_number=8.0, field_deg=5.0, **mask)
    moving, settled = live(state, "preview").psf, live(state).psf
    assert moving.method == settled.method == method
    step = round(moving.pixel_um / settled.pixel_um)
    assert step * settled.pixel_um == pytest.approx(moving.pixel_um)
    same = settled.values[::step, ::step]
    assert r_squared(moving.values, same / same.sum() * moving.values.sum()) > 0.999


PASSED = [{"obscuration": 0.3}, {"blades": 5, "vanes": 3}, {"apodisation": 0.8}, UNEVEN[1]]


@pytest.mark.parametrize("mask", in_tiers(PASSED, PASSED[1::2]))
@pytest.mark.parametrize("errors", [(), (("decentre_x", 3, 5, 0.3), ("tilt_y", 3, 5, -0.4))], ids=["aligned", "off"])
@pytest.mark.parametrize(("quality", "error"), [("preview", 0.02), ("settled", 0.006)])
def test_behind_rims_and_a_mask_the_map_is_that_of_the_rays_that_pass_both(mask, errors, quality, error):
    """Against rays on a grid of 300², kept where they pass; its all-or-nothing edge is wrong by half a cell."""
    state = new_state(lens="fast_gauss_f14", field_deg=22.0, clip=True, errors=errors, **mask)
    setup = paraxial_setup(state)
    found = pupil_of(setup, True, quality, clip=True)
    xi, eta, inside = pupil_grid(300)
    inside = inside & mask_seen(setup.lens, setup.source).opens(xi, eta)
    xi, eta = xi[inside], eta[inside]
    passed = pencil(setup.lens, setup.source, xi, eta, clip=True).passed
    assert passed.mean() < 0.95, "the rims matter"
    xi, eta = xi[passed], eta[passed]
    waves = displayed_opd(setup.lens, setup.source, xi, eta)
    assert found.clear == pytest.approx(xi.size * 4 / 300**2 / np.pi, abs=0.006)
    assert found.rms == pytest.approx(rms_about_plane(waves, xi, eta), rel=error)
    assert sum(found.parts.values()) + found.rest == pytest.approx(found.rms**2, rel=1e-9)
    assert found.peak_to_valley == pytest.approx(np.ptp(waves), rel=8 * error)
    samples = [((at + 1) * len(found.waves) / 2).astype(int) for at in (eta, xi)]
    assert np.isfinite(found.waves[tuple(samples)]).all()


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.7])
def test_defocus_behind_a_ring_has_the_variance_of_the_ring(ratio):
    """Of Wd·ρ² over ε² < ρ² < 1: Wd²(1 − ε²)²/12 (Mahajan 1991, §5.2); and all of it is defocus."""
    pupil = mapped({"wd": 1.5}, obscuration=ratio)
    assert pupil.rms == pytest.approx(1.5 * (1 - ratio**2) / np.sqrt(12), rel=1e-9)
    assert pupil.clear == pytest.approx(1 - ratio**2, rel=1e-9)
    assert pupil.peak_to_valley == pytest.approx(1.5 * (1 - ratio**2), rel=1e-3)  # at samples and edges
    assert pupil.parts["defocus"] == pytest.approx(pupil.rms**2, rel=1e-9) and pupil.rest < 1e-12


def test_a_cubic_plate_alone_has_the_variance_of_its_path():
    """The mean of (ξ³ + η³)² over the disc is 2·⟨ρ⁶⟩·⟨sin⁶⟩ = 2·(1/4)·(5/16); W falls where the path is longer.

    Of each cube its tilt takes ⟨ξ⁴⟩²/⟨ξ²⟩ = (1/8)²/(1/4).
    """
    pupil = mapped({}, cubic_um=2.0)
    waves = 2.0 / (new_state().optics.wavelength_nm / 1000)
    assert pupil.rms == pytest.approx(waves * np.sqrt(5 / 32 - 2 / 16), rel=1e-9)
    xi, eta, inside = disc(pupil.waves.shape[0])
    np.testing.assert_allclose(pupil.waves[inside], -waves * (xi**3 + eta**3)[inside], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("mask", MASKS[:4], ids=str)
def test_the_map_of_a_lens_is_that_of_its_rays_where_the_mask_is_open(mask):
    """RMS and share against the samples of the whole pupil's map, which stand up to a 200th of a radius off an edge."""
    state = new_state(field_deg=5.0, f_number=5.6)
    whole = pupil_of(paraxial_setup(state), True, "settled")
    masked = pupil_of(paraxial_setup(new_state(field_deg=5.0, f_number=5.6, **mask)), True, "settled")
    xi, eta, inside = disc(whole.waves.shape[0])
    open_ = PupilMask(**mask).opens(xi, eta) & inside
    assert np.isfinite(masked.waves[open_]).all()
    np.testing.assert_allclose(masked.waves[open_], whole.waves[open_], rtol=1e-6, atol=1e-12)
    assert masked.rms == pytest.approx(rms_about_plane(whole.waves[open_], xi[open_], eta[open_]), rel=5e-3)
    assert masked.clear == pytest.approx(open_.sum() / inside.sum(), rel=2e-3)
    assert masked.peak_to_valley == pytest.approx(np.ptp(whole.waves[open_]), rel=2e-2)
    assert sum(masked.parts.values()) + masked.rest == pytest.approx(masked.rms**2, rel=0.02)  # vanes are set aside
    assert 0 < np.isnan(masked.waves).mean() < 1


def test_where_nothing_is_drawn_there_is_nothing_open_and_one_sample_inside_the_edge_is_there():
    masked = mapped({"wd": 1.0}, obscuration=0.5)
    xi, eta, _ = disc(masked.waves.shape[0])
    radius = np.hypot(xi, eta)
    step = 2 / len(radius)
    assert np.isnan(masked.waves[radius < 0.5 - 3 * step]).all()
    assert np.isfinite(masked.waves[(radius > 0.5 - 0.5 * step) & (radius < 1)]).all()


def density(state, window):
    setup = paraxial_setup(state)
    return geometric_psf(setup.lens, setup.source, window, six=setup.coefficients)


def test_the_ray_density_of_a_defocused_ring_is_a_ring():
    """Rays of pure defocus map the pupil on the sensor: no light within ε of the blur, an even one beyond."""
    state = free({"wd": 40.0}, obscuration=0.5)
    setup = paraxial_setup(state)
    reach = 2 * 40.0 * setup.source.wavelength_um / abs(float(setup.coefficients.reduced_slope))
    psf = density(state, (128, 2.2 * reach / 128))
    radius = np.hypot(psf.x_um, psf.x_um[:, None]) / reach
    assert psf.values[radius < 0.45].sum() < 1e-3
    half = np.sqrt((1 + 0.25) / 2)  # which halves the ring's area
    assert psf.values[radius < half].sum() == pytest.approx(0.5, abs=0.02)
    assert psf.energy == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("mask", [*UNEVEN, {"cubic_um": 4.0}], ids=str)
def test_the_ray_density_lies_where_the_waves_lie(mask):
    """Of many waves of defocus and the mask: turned over or mirrored it would not."""
    state = free({"wd": 12.0}, **mask)
    waves = live(state).psf
    assert waves.method == "seidel"
    rays = density(state, (waves.values.shape[0], waves.pixel_um)).values
    right = np.corrcoef(blocks(rays), blocks(waves.values))[0, 1]
    assert right > 0.85  # fringes and caustics are not of rays
    for turned in (rays[::-1], rays[:, ::-1] if "blade_angle_deg" in mask else rays[::-1]):
        assert np.corrcoef(blocks(turned), blocks(waves.values))[0, 1] < right


def blocks(values: np.ndarray) -> np.ndarray:
    """Return means over 32 × 32 blocks, in which the fringes of a blur are lost."""
    side = values.shape[0] // 32
    found: np.ndarray = values.reshape(32, side, 32, side).sum((1, 3)).ravel()
    return found


@pytest.mark.parametrize("ratio", [0.2, 0.6])
def test_the_best_focus_of_a_ring_balances_spherical_aberration(ratio):
    """Wd = −(1 + ε²)·W40 (Mahajan 1991, §5.2), and −W22/2 for astigmatism, whatever the ring."""
    setup = paraxial_setup(free({"w40": 2.0, "w22": 0.6, "wd": 0.25, "w31": 3.0}, obscuration=ratio))
    nodes = open_nodes(setup, False, False)
    waves = np.asarray(wavefront(setup.coefficients, nodes.xi, nodes.eta))
    expected = (1 + ratio**2) * 2.0 + 0.3 + 0.25
    assert amount(nodes, waves, nodes.xi**2 + nodes.eta**2) == pytest.approx(expected, rel=1e-9)


def test_a_path_that_is_a_defocus_is_focused_away():
    """The exact rays of a lens behind a spider: the focus of its rays, to what vanes take from the pupil."""
    clear, spider = (new_state(field_deg=3.0, f_number=5.6, obscuration=0.3, vanes=n, vane_width=0.001) for n in (0, 4))
    first, second = map(best_shift_um, (clear, spider))
    assert first == pytest.approx(second, rel=1e-2) and first != second


@pytest.mark.parametrize("mask", MASKS, ids=str)
@pytest.mark.parametrize("method", ["seidel", "fitted"])
def test_sections_of_the_psf_go_through_its_samples(mask, method):
    answer = live(new_state(method=method, f_number=8.0, field_deg=5.0, **mask))
    psf = answer.psf
    lines = fine_lines(measure_request(answer), psf.x_um[1:])  # as many on either side of the middle
    middle, scale = psf.values.shape[0] // 2, psf.sum_over_peak
    for line, samples in zip(lines, (psf.values[middle, 1:], psf.values[1:, middle]), strict=True):
        assert line == pytest.approx(scale * samples, abs=2e-3 * psf.strehl)


def test_only_rays_through_the_open_part_are_drawn_in_spots_and_fans():
    answer = live(new_state(field_deg=5.0, obscuration=0.5, blades=6))
    landed, fan = spots(answer).found, ray_errors(answer).found
    whole = spots(live(new_state(field_deg=5.0))).found
    assert 0 < np.isfinite(landed.x_um).sum() < np.isfinite(whole.x_um).sum()
    assert landed.rms_um != whole.rms_um
    assert np.array_equal(np.isnan(fan.tangential)[1:-1], np.abs(fan.pupil)[1:-1] < 0.5)  # at ±1 there are corners
    inside = np.abs(fan.pupil) > np.cos(np.pi / 6) + 1e-9  # across, where the blades' edges are
    assert np.array_equal(np.isnan(fan.sagittal), (np.abs(fan.pupil) < 0.5) | inside)


@pytest.mark.parametrize("mask", [{"obscuration": 0.4}, {"cubic_um": 3.0}], ids=str)
def test_the_window_is_wide_enough_for_what_the_mask_spreads(mask):
    assert live(new_state(f_number=8.0, field_deg=5.0, **mask)).psf.energy > 0.9


def test_rims_and_a_mask_leave_less_of_the_pupil_than_either():
    """The mask lets 0.84 through; the rims clip beyond it, so that the parts they take add up."""
    masked, clipped, both = (
        live(new_state(method="traced", field_deg=14.0, **changes)).pupil.clear
        for changes in ({"obscuration": 0.4}, {"clip": True}, {"clip": True, "obscuration": 0.4})
    )
    assert masked == pytest.approx(0.84) and 0.16 < both < clipped < 1
    assert both == pytest.approx(masked + clipped - 1, abs=2e-3)


@pytest.mark.parametrize("method", ["seidel", "fitted", "auto"])
def test_a_filter_that_lets_nothing_through_is_refused_in_a_sentence(method):
    with pytest.raises(P2SFError, match="lets no light through"):
        live(new_state(method=method, obscuration=0.78, apodisation=0.43, apodisation_power=8))


def test_an_apodised_pupil_has_a_shade_and_a_clear_one_none():
    pupil = mapped({}, apodisation=0.5)
    xi, eta, inside = disc(pupil.waves.shape[0])
    np.testing.assert_allclose(pupil.shade[inside], np.exp(-(xi**2 + eta**2) / 0.25)[inside], rtol=1e-3)
    assert mapped({}, apodisation=inf).shade is None
