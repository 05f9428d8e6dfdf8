"""Tolerances: derivatives against exact rays, laws, builds, compensators and yields."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.disc.quadrature import whole_disc
from p2sf.errors import GeometryError, RequestError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, indices, with_f_number, with_mask, with_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.measures import PupilPart, mtf_of
from p2sf.psf.methods import render
from p2sf.pupil.frequency_pupil import pupil_of_rays
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.trace import trace
from p2sf.tolerance.builds import Builds, evaluate, simulate
from p2sf.tolerance.criteria import harms, share_within
from p2sf.tolerance.differentials import NODES, _rigid, differentials, usual_sources
from p2sf.tolerance.errors_of_build import GRADES, IRREGULAR, Tolerance, build, usual_tolerances
from p2sf.tolerance.single import sensitivities
from p2sf.tolerance.strehl import strehl_ratios
from tests.long.tolerances import agreement, gauss
from tests.support.lenses.simple_lenses import in_the_stop
from tests.support.tiers import in_tiers
from tests.support.tolerances import exact_quality, masked_quality

UM = 0.5875618
FIELDS = Source(), Source(field_deg=7)
FEW = (
    Tolerance("decentre_y", 3, 0.05),
    Tolerance("tilt_x", 3, 0.05),
    Tolerance("tilt_y", 5, 0.05),
    Tolerance("decentre_x", 8, 0.05, 9),
    Tolerance("tilt_x", 8, 0.05, 9),
    Tolerance("decentre_y", 8, 0.05),
    Tolerance("radius", 1, 0.3),
    Tolerance("thickness", 4, 0.1),
    Tolerance("index", 1, 1e-3),
    Tolerance("irregularity", 3, 2.0),
    Tolerance("irregularity_45", 3, 2.0),
    Tolerance("irregularity", 10, 2.0),
)


@pytest.fixture(scope="module")
def lens():
    return gauss(8.0)


@pytest.fixture(scope="module")
def known(lens):
    return differentials(lens, FIELDS, FEW)


def straight(known, waves: np.ndarray) -> np.ndarray:
    """Return waves (fields, rays) without piston and tilt."""
    out = []
    for field, one in enumerate(waves):
        root = np.sqrt(known.weight[field])
        terms = np.stack([np.ones_like(root), known.fx[field], known.fy[field]], 1) * root[:, None]
        out.append(one * root - terms @ np.linalg.lstsq(terms, one * root, rcond=None)[0])
    return np.array(out)


def rms(known, waves: np.ndarray) -> float:
    """Return the RMS in the worst field, without piston and tilt."""
    return float(np.sqrt(np.square(straight(known, waves)).sum(-1)).max())


def phases(lens, tolerances, errors) -> np.ndarray:
    built = build(lens, tolerances, errors)
    return np.array([one.phase for one in (differentials(built, [source], ()) for source in FIELDS)])[:, 0]


LARGE = tuple(replace(tolerance, amount=8 * tolerance.amount) for tolerance in FEW)


@pytest.fixture(scope="module")
def far():
    """Return the differentials of the lens at full aperture, for errors that are felt by pairs."""
    return differentials(gauss(), FIELDS, LARGE)


@pytest.mark.parametrize("pair", [(0, 1), (0, 3), (0, 6), (1, 4), (2, 3), (3, 4), (4, 5), (6, 7), (7, 8)], ids=str)
def test_mixed_derivatives_are_those_of_exact_rays(far, pair):
    """By four lenses with both errors, whose differences leave fourth derivatives: per cent of the largest."""
    one, two = pair
    steps, exact = [0.6 * LARGE[k].amount for k in pair], 0.0
    for a, b in ((1, 1), (-1, -1), (1, -1), (-1, 1)):
        errors = np.zeros(len(LARGE))
        errors[one], errors[two] = a * steps[0], b * steps[1]
        exact = exact + a * b * phases(far.lens, LARGE, errors) / 4
    exact, found = straight(far, exact), straight(far, far.second[one, two] * steps[0] * steps[1])
    assert np.abs(found - exact).max() < 0.03 * np.abs(exact).max() + 2e-5
    assert pair == (4, 5) or np.abs(exact).max() > 1e-3, "a tilt of a piece and a decentre of its plane hardly meet"


def test_a_lens_moved_as_a_whole_has_the_same_waves(lens):
    """Light from infinity does not know where it is."""
    whole = tuple(Tolerance(kind, 1, 0.1, len(lens.surfaces)) for kind in ("decentre_x", "decentre_y"))
    known = differentials(lens, FIELDS, whole)
    assert np.abs([straight(known, one) for one in known.first]).max() < 1e-7
    assert known.chief_um[0] == pytest.approx(np.array([[1000.0, 0.0], [1000.0, 0.0]]), abs=1e-5)


def test_a_shift_of_the_sensor_is_defocus(lens):
    """∂W = n′(K_z − K_z chief)/λ per mm."""
    known = differentials(lens, FIELDS[:1], (Tolerance("thickness", len(lens.surfaces), 0.01),))
    kx, ky = (f[0] * UM for f in (known.fx, known.fy))
    expected = (np.sqrt(1 - kx**2 - ky**2) - 1) * 1000 / UM
    assert known.first[0, 0] == pytest.approx(expected, rel=1e-7)


def test_builds_are_those_of_exact_rays(lens, known):
    errors = np.random.default_rng(2).uniform(-1, 1, (6, len(FEW))) * known.amounts
    found = evaluate(known, errors)
    for number, one in enumerate(errors):
        rms, strehl = exact_quality(build(lens, FEW, one), FIELDS)
        assert found.rms_waves[number] == pytest.approx(rms, rel=5e-3)
        assert found.strehl[number] == pytest.approx(strehl, abs=3e-3)


def rim_of(lens, f_number: float) -> float:
    """Return where the paraxial ray of height f/(2N) meets the stop, surface by surface (Welford 1986, ch. 3)."""
    index, y, nu, heights = indices(lens, lens.reference_wavelength_um), 1.0, 0.0, []
    for number, surface in enumerate(lens.surfaces):
        heights.append(y)
        nu -= y * surface.curvature * (index[number + 1] - index[number])
        y += surface.thickness * nu / index[number + 1]
    return abs(heights[lens.stop_surface - 1] / nu) / (2 * f_number)


def worst_refocused(lens, sources) -> float:
    """Return the RMS of exact rays in the worst field, the sensor where the mean square of all fields is least."""
    shift = 0.0
    for step in (0.05, 0.01, 0.005):
        places = shift + np.array([-step, 0.0, step])
        less, least, more = (
            (exact_quality(with_sensor(lens, lens.sensor_mm + by), sources)[0] ** 2).sum() for by in places
        )
        shift += step * (less - more) / (2 * (less - 2 * least + more))
    return float(exact_quality(with_sensor(lens, lens.sensor_mm + shift), sources)[0].max())


@pytest.mark.parametrize(
    ("name", "f_number", "number"),
    in_tiers(
        [double := ("double_gauss_28", 8.0, 3), wide := ("wide_angle_35", 2.0, 7), ("fast_gauss_f14", 1.4, 3)],
        (double, wide),
    ),
)
def test_a_thickness_that_is_off_does_not_resize_the_iris(name, f_number, number):
    """By exact rays through lenses whose stop keeps the radius that the f-number of the lens as designed means.

    3 %: the third order of an error that adds up to a third of a wave, which a quadratic form leaves out. A resized
    iris would be 33 to 54 % off.
    """
    lens = find_lens(name)
    stopped = replace(lens, aperture=Aperture("stop_semi_diameter", rim_of(lens, f_number)))
    sources = usual_sources(lens, Source())
    thick, focus = Tolerance("thickness", number, 0.05), Tolerance("thickness", len(lens.surfaces), 0.2)
    known = differentials(with_f_number(lens, f_number), sources, (thick, focus))
    surface = lens.surfaces[number - 1]
    worst = []
    for error in (0.05, -0.05, 0.0):
        wrong = replace(surface, thickness=surface.thickness + error)
        surfaces = (*lens.surfaces[: number - 1], wrong, *lens.surfaces[number:])
        worst.append(worst_refocused(replace(stopped, surfaces=surfaces), sources))
    found = harms(sensitivities(known, (1,)), "rms_waves", (1,))[0]
    assert found == pytest.approx(max(worst[:2]) - worst[2], rel=0.03)


def test_an_irregularity_hardly_meets_other_errors(far):
    """What is left out: of ten fringes with 0.1 mm or 0.1°, by four lenses with both, less than 0.002 waves RMS."""
    tolerances = Tolerance("irregularity", 3, 10.0), Tolerance("decentre_y", 3, 0.1), Tolerance("tilt_x", 3, 0.1)
    for place in (1, 2):
        both = 0.0
        for a, b in ((1, 1), (-1, -1), (1, -1), (-1, 1)):
            errors = np.zeros(3)
            errors[0], errors[place] = a * 10.0, b * 0.1
            both = both + a * b * phases(far.lens, tolerances, errors) / 4
        assert 0 < rms(far, both) < 0.002
    alone = phases(far.lens, tolerances, (10.0, 0.0, 0.0)) - phases(far.lens, tolerances, (-10.0, 0.0, 0.0))
    assert rms(far, alone) > 0.3, "twenty fringes that matter"


def test_a_cylinder_in_the_stop_has_the_slope_of_its_law():
    """∂W/∂N = −(n′ − n)·F/2λ·ρ² cos 2θ of the phase, whose sign is the opposite of the displayed wavefront's."""
    lens = in_the_stop(ConstantIndex(1.5), None)
    known = differentials(lens, [Source(wavelength_um=UM)], [Tolerance(kind, 1, 1.0) for kind in IRREGULAR])
    xi, eta, _ = whole_disc(*NODES)
    scale = -0.5 * 0.273035 / 2 / UM
    assert known.first[0, 0] == pytest.approx(scale * (eta**2 - xi**2), abs=1e-4 * abs(scale))
    assert known.first[1, 0] == pytest.approx(scale * 2 * xi * eta, abs=1e-4 * abs(scale))
    assert not known.second.any()


def test_the_direction_of_an_irregularity_may_be_any(known):
    """Of a surface with both, the size is even up to the tolerance and the direction around; of one, its sign only."""
    found = simulate(known, 4000, seed=5).errors
    upright, turned = found[:, 9], found[:, 10]
    size, angle = np.hypot(upright, turned), np.arctan2(turned, upright)
    assert size.max() <= 2.0 and abs(size.mean() - 1.0) < 4 * 2 / np.sqrt(12 * 4000)
    counts = np.histogram(angle, 8, (-np.pi, np.pi))[0]
    assert np.abs(counts - 500).max() < 4 * np.sqrt(500)
    alone = np.abs(found[:, 11])
    assert alone.max() <= 2.0 and abs(alone.mean() - 1.0) < 4 * 2 / np.sqrt(12 * 4000)


def test_an_irregularity_is_over_what_the_field_needs_where_no_clear_radius_is_stated(lens):
    """On the first surface of this lens rays of the widest field land farthest out, but for what is vignetted."""
    open_ = replace(lens, surfaces=tuple(replace(one, semi_diameter=np.inf) for one in lens.surfaces))
    made = build(open_, [Tolerance("irregularity", 1, 1.0)], (1.0,)).surfaces[0].irregularity
    marginal, chief = (trace_heights(open_, field, eta) for field, eta in ((0.0, 1.0), (14.0, 0.0)))
    assert made.normalisation_mm == pytest.approx(abs(marginal) + abs(chief), rel=0.02)  # paraxial ones at 14°
    stated = build(lens, [Tolerance("irregularity", 1, 1.0)], (1.0,)).surfaces[0].irregularity
    assert stated.normalisation_mm == lens.surfaces[0].semi_diameter


def trace_heights(lens, field_deg: float, eta: float) -> float:
    """Return where a ray meets the first surface, mm."""
    rays = pupil_rays(lens, Source(field_deg=field_deg), np.zeros(1), np.array([eta]))
    return float(trace(lens, rays.origins, rays.directions, UM).points[1, 0, 1])


@pytest.mark.slow
def test_most_builds_agree_with_exact_rays_focused_anew():
    """500 builds are tried by ``python -m tests.long.tolerances``."""
    assert agreement(gauss(8.0), "precision", (0.0, 7.0), 6, 200).agree >= 0.95


def test_a_compensator_makes_the_mean_square_least(lens):
    tolerances = (*FEW, Tolerance("thickness", len(lens.surfaces), 0.2))
    known, place = differentials(lens, FIELDS, tolerances), len(FEW)
    found = simulate(known, 20, (place,), seed=3)
    least = (found.rms_waves**2).sum(1)
    for shift in (-0.003, 0.003):
        moved = found.errors.copy()
        moved[:, place] += shift
        assert ((evaluate(known, moved).rms_waves ** 2).sum(1) > least).all()
    assert np.abs(found.errors[:, place]).max() > 0.01


def test_a_tilted_sensor_is_that_of_exact_rays(lens):
    """Behind the last surface the sensor counts as one more; its tilt is defocus that grows with the field."""
    tolerances = (*FEW, *(Tolerance(kind, len(lens.surfaces) + 1, 0.05) for kind in ("tilt_x", "tilt_y")))
    known = differentials(lens, FIELDS, tolerances)
    errors = np.random.default_rng(5).uniform(-1, 1, (4, len(tolerances))) * known.amounts
    errors[:, len(FEW) :] *= 10  # ± 0.5°
    found = evaluate(known, errors)
    for number, one in enumerate(errors):
        built = build(lens, tolerances, one)
        assert built.sensor_before and not lens.sensor_before
        rms, _ = exact_quality(built, FIELDS)
        assert found.rms_waves[number] == pytest.approx(rms, rel=5e-3)
    untilted = evaluate(known, errors * ([1.0] * len(FEW) + [0.0] * 2))
    assert np.abs(untilted.rms_waves - found.rms_waves).max() > 0.02, "the tilt is felt"


def test_a_sensor_tilted_at_assembly_follows_a_tilted_image(lens):
    """The tilt of an element tilts the image: of all sensor tilts, that found leaves the least waves in the fields."""
    count = len(lens.surfaces)
    fields = tuple(Source(field_deg=angle) for angle in (-7.0, 0.0, 7.0))
    tolerances = (
        Tolerance("tilt_x", 7, 0.3, 8),
        Tolerance("thickness", count, 0.2),
        Tolerance("tilt_x", count + 1, 0.05),
    )
    known = differentials(lens, fields, tolerances)
    one = evaluate(known, np.array([[0.3, 0.0, 0.0]]), (1, 2))
    assert abs(one.errors[0, 2]) > 0.01
    least = (exact_quality(build(lens, tolerances, one.errors[0]), fields)[0] ** 2).sum()
    for shift in (-0.05, 0.05):
        moved = build(lens, tolerances, one.errors[0] + [0.0, 0.0, shift])
        assert (exact_quality(moved, fields)[0] ** 2).sum() > least


def test_a_decentre_either_way_is_alike_on_the_axis(known):
    found = sensitivities(known)
    assert found.rms_waves[0, 0] == pytest.approx(found.rms_waves[1, 0], rel=1e-6)
    assert found.rms_waves[-1] == pytest.approx(evaluate(known, np.zeros((1, len(FEW)))).rms_waves[0])


def test_a_yield_has_the_error_of_a_binomial_share():
    strehl = np.r_[np.full(90, 0.9), np.full(10, 0.5)][:, None]
    found = Builds(np.zeros((100, 0)), 1 - strehl, strehl, *np.zeros((2, 100, 1, 2)))
    assert share_within(found, {"strehl": 0.8}) == (0.9, pytest.approx(0.03))
    assert share_within(found, {"rms_waves": 0.2, "strehl": 0.4})[0] == 0.9
    assert share_within(found, {"strehl": 0.1}) == (1.0, pytest.approx(np.sqrt(0.005 * 0.995 / 100)))


def test_two_draws_agree_to_their_statistical_error(known):
    one, two = (simulate(known, 3000, seed=seed) for seed in (1, 2))
    limit = float(np.median(one.rms_waves.max(1)))
    (a, da), (b, db) = (share_within(found, {"rms_waves": limit}) for found in (one, two))
    assert a == pytest.approx(0.5, abs=0.01) and abs(a - b) < 4 * np.hypot(da, db)
    assert (np.abs(one.errors) <= known.amounts).all()


def test_usual_tolerances_are_of_all_that_can_be_off(lens):
    found = usual_tolerances(lens, "high")
    assert {one.kind for one in found} == {
        "decentre_x",
        "decentre_y",
        "tilt_x",
        "tilt_y",
        "radius",
        "thickness",
        "index",
        *IRREGULAR,
    }
    assert not any(one.first == lens.stop_surface and one.kind != "thickness" for one in found), "the stop is bare"
    assert {one.amount for one in found if one.kind == "radius"} == {GRADES["high"]["radius"]}


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda lens: Tolerance("colour", 1, 0.1), 'tolerance "colour" is unknown'),
        (lambda lens: Tolerance("radius", 1, -0.1), "the tolerance of radius at surface 1 is -0.1"),
        (lambda lens: build(lens, [Tolerance("tilt_x", 3, 0.1, 99)], [0.1]), "surfaces 3 to 99 do not exist"),
        (lambda lens: build(lens, [Tolerance("tilt_x", 3, 90.0)], [90.0]), "surface 3: a tilt of 90°"),
        (
            lambda lens: differentials(lens, [Source(), Source(wavelength_nm=500)], FEW),
            "the fields of tolerances have several wavelengths",
        ),
        (lambda lens: differentials(replace(lens), [Source(field_deg=60)], ()), "the chief ray|do not reach"),
    ],
)
def test_what_cannot_be_is_refused(lens, make, said):
    with pytest.raises(GeometryError, match=said):
        make(lens)


def test_a_compensator_that_there_is_not_is_refused(known):
    with pytest.raises(RequestError, match="compensators 99 are not among the 12"):
        simulate(known, 10, (99,))


@pytest.mark.parametrize("frequency", in_tiers([10.0, 40.0], (10.0,)))
def test_contrast_of_builds_is_that_of_their_own_pupils(known, frequency):
    """By the autocorrelation of every build's own pupil; left out is the square of its stretch, some 1 % here."""
    errors = np.random.default_rng(5).uniform(-1, 1, (3, len(known.tolerances))) * known.amounts
    found = evaluate(known, errors, frequency_per_mm=frequency)
    for number, one in enumerate(errors):
        built = build(known.lens, known.tolerances, one)
        for field, source in enumerate(known.sources):
            exact = mtf_of([PupilPart(pupil_of_rays(built, source))], "", [frequency])
            both = [exact.sagittal[0], exact.tangential[0]]
            assert found.mtf[number, field] == pytest.approx(both, abs=3e-4)
    assert np.ptp(found.mtf[:, 0]) > 0.05, "errors that matter"


MASKS = {
    "vanes": PupilMask(obscuration=0.3, vanes=3, vane_width=0.04, vane_angle_deg=20.0),
    "iris": PupilMask(blades=5, blade_angle_deg=10.0),
    "filter": PupilMask(apodisation=0.8, zernike_um=(0.0, 0.0, 0.0, 0.0, 0.05)),
}


@pytest.fixture(scope="module", params=in_tiers(MASKS, ["iris"]))
def behind(request, lens):
    """Return the differentials of the lens with a mask in its stop, by errors that leave it symmetric."""
    few = [one for one in FEW if one.kind in ("radius", "thickness", "index")]
    return differentials(with_mask(lens, MASKS[request.param]), FIELDS, few)


def test_contrast_of_builds_behind_a_mask_is_that_of_their_own_pupils(behind):
    """By the lines of the masked pupil at its own frequencies; 0.001 is what the pairs are settled to."""
    errors = -3.0 * behind.amounts[None]
    found = evaluate(behind, errors, frequency_per_mm=30.0)
    for number, one in enumerate(errors):
        built = build(behind.lens, behind.tolerances, one)
        for field, source in enumerate(FIELDS):
            exact = mtf_of([PupilPart(pupil_of_rays(built, source))], "", [30.0])
            both = [exact.sagittal[0], exact.tangential[0]]
            assert found.mtf[number, field] == pytest.approx(both, abs=1e-3)
    still = evaluate(behind, 0 * errors, frequency_per_mm=30.0)
    assert np.abs(found.mtf - still.mtf).max() > 0.03, "errors that matter"


@pytest.mark.parametrize("name", MASKS)
def test_builds_behind_a_mask_are_those_of_exact_rays(lens, name):
    """By rays on an even grid over what is open, whose edges leave some 0.002 of the light uncertain."""
    masked = with_mask(lens, MASKS[name])
    known, clear = (differentials(one, FIELDS, FEW) for one in (masked, lens))
    errors = np.random.default_rng(2).uniform(-1, 1, (1, len(FEW))) * known.amounts
    found, without = evaluate(known, errors), evaluate(clear, errors)
    for number, one in enumerate(errors):
        rms, strehl = masked_quality(build(masked, FEW, one), FIELDS)
        assert found.rms_waves[number] == pytest.approx(rms, rel=4e-3)
        assert found.strehl[number] == pytest.approx(strehl, abs=3e-3)
    assert np.abs(found.strehl - without.strehl).max() > 0.02, "a mask that matters"


def test_a_phase_in_the_stop_is_in_the_waves():
    """One Zernike term of 0.05 µm RMS over a perfect wavefront, and the Strehl ratio 1 − (2πσ)² + (2πσ)⁴/2 about it."""
    lens = with_mask(in_the_stop(ConstantIndex(1.5), None), PupilMask(zernike_um=(0.0,) * 5 + (0.05,)))
    found = evaluate(differentials(lens, [Source(wavelength_um=1.0)], ()), np.zeros((1, 0)))
    assert found.rms_waves[0, 0] == pytest.approx(0.05, rel=1e-6)
    square = (2 * np.pi * 0.05) ** 2
    assert found.strehl[0, 0] == pytest.approx(1 - square + square**2 / 2, abs=2e-3)


def test_the_strehl_ratio_of_a_build_is_that_of_the_peak_wherever_it_is():
    """Of Zernike's coma on a grid of the test's own: ten times the light at the point of least variance."""
    waves = 0.3
    lens = with_mask(in_the_stop(ConstantIndex(1.5), None), PupilMask(zernike_um=(0.0,) * 6 + (waves,)))
    found = evaluate(differentials(lens, [Source(wavelength_um=1.0)], ()), np.zeros((1, 0))).strehl[0, 0]
    x, y = np.meshgrid(*2 * [np.arange(-399.5, 400) / 400])
    x, y = x[x**2 + y**2 < 1], y[x**2 + y**2 < 1]
    coma = waves * np.sqrt(8) * (3 * (x**2 + y**2) - 2) * y
    along = [abs(np.exp(2j * np.pi * (coma + tilt * y)).mean()) ** 2 for tilt in np.linspace(0, 1.5, 61)]
    assert found == pytest.approx(max(along), abs=2e-3)  # of the quadrature, as in the test above
    assert found > 10 * along[0]
    assert render(lens, Source(wavelength_um=1.0), "traced").strehl == pytest.approx(found, abs=2e-3)


def test_contrast_turns_with_a_decentre(known):
    """On the axis, a decentre along y blurs patterns along y as one along x blurs those along x."""
    lens = known.lens
    both = tuple(Tolerance(kind, 3, 0.4) for kind in ("decentre_x", "decentre_y"))
    found = evaluate(differentials(lens, FIELDS[:1], both), np.diag([0.4, 0.4]), frequency_per_mm=60.0)
    assert found.mtf[0, 0] == pytest.approx(found.mtf[1, 0, ::-1], abs=1e-5)
    assert abs(found.mtf[0, 0, 0] - found.mtf[0, 0, 1]) > 0.01


def test_contrast_beyond_the_cut_off_is_nothing(known):
    assert (evaluate(known, np.zeros((1, len(FEW))), frequency_per_mm=2000.0).mtf == 0).all()


def test_a_pattern_without_a_frequency_is_refused(known):
    with pytest.raises(RequestError, match="frequency_per_mm is 0; give a positive finite number"):
        evaluate(known, np.zeros((1, len(FEW))), frequency_per_mm=0.0)


def test_contrast_that_no_sum_resolves_is_refused():
    wide = differentials(with_sensor(gauss(), gauss().sensor_mm + 8), FIELDS[:1], FEW[:1])
    with pytest.raises(RequestError, match="the contrast at 100 cycles per mm is too small to be summed"):
        evaluate(wide, np.zeros((1, 1)), frequency_per_mm=100.0)


def test_boresight_is_where_the_chief_ray_of_a_build_lands(lens, known):
    """To first order: what is left is of second order in the errors."""
    errors = 0.5 * known.amounts[None]
    landed = [chief_um(build(lens, FEW, one)) for one in (errors[0], 0 * errors[0])]
    assert evaluate(known, errors).boresight_um[0] == pytest.approx(landed[0] - landed[1], rel=5e-3, abs=0.05)


def chief_um(lens) -> np.ndarray:
    """Return where chief rays land on the sensor, (fields, 2) µm."""
    found = [pencil(lens, source, np.zeros(1), np.zeros(1)) for source in FIELDS]
    return 1000 * np.array([[np.ravel(x)[0] for x in (one.chief_x, one.chief_y)] for one in found])


def test_what_an_error_harms_is_by_the_worse_of_its_signs():
    strehl = np.array([0.5, 0.9, 0.7, 0.6, 0.8])[:, None]  # +, − of two errors, and none
    alone = Builds(np.zeros((5, 2)), strehl, strehl, *np.zeros((2, 5, 1, 2)))
    assert harms(alone, "strehl") == pytest.approx([0.3, 0.2]) and harms(alone, "strehl", (0,))[0] == 0
    assert harms(alone, "rms_waves") == pytest.approx([0.1, -0.1])


@pytest.mark.parametrize("away", [(0.02, 0.0), (0.2, -0.15), (-0.1, 0.3)])
def test_a_tilt_moves_the_peak_and_takes_nothing_from_it(away):
    """Periods of the highest frequency, 0.36 of them at most: farther, a search on a grid would start."""
    x, y = np.meshgrid(*2 * [np.linspace(-1, 1, 41)])
    x, y = x[x**2 + y**2 <= 1], y[x**2 + y**2 <= 1]
    tilt, weight = away[0] * x + away[1] * y, np.full(x.size, 1 / x.size)
    for waves in (tilt, tilt + 0.05 * (x**2 + y**2)):
        still = abs((weight * np.exp(2j * np.pi * (waves - tilt))).sum()) ** 2
        assert strehl_ratios(waves[None], weight, np.stack([x, y])) == pytest.approx([still], abs=1e-5)


def test_a_build_without_aberration_divides_by_no_step():
    xi, eta, weight = whole_disc(8, 16)
    with np.errstate(all="raise"):
        assert strehl_ratios(np.zeros((1, xi.size)), weight, np.stack([xi, eta])) == pytest.approx([1.0], abs=1e-6)


@pytest.mark.parametrize("kind", ["tilt_x", "tilt_y"])
def test_a_piece_that_stands_tilted_turns_about_the_axes_of_its_mount(kind):
    """A degree more of one of its angles, by the difference of two placements: what a vertex does, and the rotation."""
    own, step = Placement(tilt_x_deg=30.0), 1e-4
    vertex, still = np.array([1.0, 2.0, 3.0]), own.motion.rotation
    turned = replace(own, **{f"{kind}_deg": getattr(own, f"{kind}_deg") + step}).motion.rotation
    small = (turned @ still.T - np.eye(3)) / step
    found = _rigid(vertex, Tolerance(kind, 1, 1, 1.0), Placement().motion, own)
    assert found[:3] == pytest.approx(small @ vertex, abs=1e-6)
    assert found[3:] == pytest.approx([small[2, 1], small[0, 2], small[1, 0]], abs=1e-6)
