"""A scene states an error that is tolerable, and its plan keeps it at the least cost."""

from dataclasses import replace
from itertools import product
from math import hypot

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError, GlassError, RequestError, SamplingError
from p2sf.image.preview import preview
from p2sf.lens.lens import with_mask
from p2sf.lensfile.library import find_lens
from p2sf.messages import Message
from p2sf.pixel_kernels.pupil_table import chebyshev, lagrange
from p2sf.scene.files import read_scene
from p2sf.scene.planning.bounds import check_blur
from p2sf.scene.planning.cost import Work, predicted_cost
from p2sf.scene.planning.plan import _colour_errors, plan
from p2sf.scene.planning.reference import reference_kernel
from p2sf.scene.planning.sharing import REMAINDER, TARGET_ERROR, fewer_nodes, share_pupils
from p2sf.scene.planning.study import SAMPLING_ERRORS, SAMPLINGS, Place, Study, distance
from p2sf.scene.planning.table import plan_rows
from p2sf.scene.planning.verify import planned_kernel, verify
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from p2sf.scene.spectrum import reduce_spectrum
from tests.long.plans import random_scene

GREEN = (Channel("green", (530.0, 560.0), (1.0, 1.0)),)
SCENE = """
name = "desk"
rtol = 0.1
focus_mm = 20000
f_number = 4
[sensor]
rows = 48
columns = 64
pixel_um = 9.0
[depth]
near_mm = 15000
far_mm = 25000
[[channel]]
name = "green"
wavelengths_nm = [530, 560]
"""


@pytest.fixture(scope="module")
def planned():
    scene = Scene(Sensor(96, 128, 9.0), GREEN, 15000.0, 25000.0, 0.1, focus_mm=20000.0, f_number=4.0)
    return plan(find_lens("double_gauss_28"), scene)


def test_the_plan_keeps_its_tolerance_against_exact_rays(planned):
    verdict = verify(planned, points=2, seed=1)
    assert planned.meets and verdict.kept
    assert verdict.worst > 0  # the two roads share no approximation


@pytest.mark.slow
def test_a_plan_of_clipped_pencils_keeps_its_tolerance():
    """A crop of the Double Gauss's corner, where its rims take 5 % of the pupil and a tenth of L2."""
    lens, single = find_lens("double_gauss_28"), (Channel("green", (550.0,), (1.0,)),)
    scene = Scene(Sensor(40, 40, 8.0, (0.0, 23.5)), single, rtol=0.1, clip=True)
    clipped = plan(lens, scene)
    verdict = verify(clipped, points=1)
    assert clipped.meets and verdict.kept
    x, y, vergence, channel = verdict.places[0]
    kernel = planned_kernel(replace(clipped, scene=replace(scene, clip=False), table=None), x, y, vergence, channel)
    seen = clipped.sensor_map(vergence)
    assert distance(kernel, reference_kernel(seen, single[channel], x, y, kernel.shape[0] // 2, 8.0)) > 0.08


def test_a_plan_without_what_it_decided_would_not(planned):
    """One depth node instead of several: the verdict sees it, so it can fail."""
    assert len(planned.vergences) > 1
    assert not verify(replace(planned, vergences=planned.vergences[:1]), points=1, seed=1).kept


def test_a_decision_is_data_until_it_is_shown(planned):
    depth = next(decision for decision in planned.decisions if decision.kind == "depth")
    assert depth.choice == Message("{count} nodes", count=len(planned.vergences))
    assert plan_rows(planned)[planned.decisions.index(depth)][1] == f"{len(planned.vergences)} nodes"


def test_every_decision_has_a_reason_and_an_error(planned):
    assert {decision.kind for decision in planned.decisions} == {
        "method",
        "sampling",
        "field",
        "depth",
        "colour",
        "pupils",
    }
    assert all(len(str(d.why)) > 20 and 0 <= d.error < 0.1 for d in planned.decisions)
    assert planned.naive.kernel_seconds > planned.cost.kernel_seconds


def test_a_plans_error_is_the_root_of_squares_with_field_and_depth_added(planned):
    largest = {}
    for decision in planned.decisions:
        largest[decision.kind] = max(largest.get(decision.kind, 0.0), decision.error)
    assert largest["pupils"] > 0 and largest["field"] > 0 and largest["depth"] > 0
    defocus = largest.pop("field") + largest.pop("depth")
    assert planned.predicted_error == pytest.approx(hypot(defocus, *largest.values()), rel=1e-12)  # round-off


def test_pupils_between_the_fitted_ones_cost_no_more_than_the_plan_says():
    """Sharp where no depth node is midway: there the kernels of a fit at every depth differ the most."""
    green = Channel("green", (550.0,), (1.0,))
    scene = Scene(Sensor(12, 16, 31.7), (green,), 1095.0, 4094.0, 0.42, f_number=8.0, focus_mm=2007.0)
    shared = plan(find_lens("fast_gauss_f14"), scene)
    shared = replace(shared, recipe=replace(shared.recipe, fineness=3.0, margin=1.0))  # no error of sampling
    each = replace(shared, table=None)
    assert len(shared.table.vergences) < len(shared.vergences)
    worst = 0.0
    for vergence in shared.vergences:
        one, other = (found.kernels(0, vergence) for found in (shared, each))
        for h in shared.table.y_mm:  # in one window, whose width depends on where rays land at a few nodes
            worst = max(worst, distance(*(found.at(0.6 * h, 0.8 * h, 8) for found in (one, other))))
    said = next(decision.error for decision in shared.decisions if decision.kind == "pupils")
    assert 0 < worst <= said <= 0.15 * scene.limit


def test_as_many_heights_are_fitted_as_the_error_between_them_requires(monkeypatch):
    scene = Scene(Sensor(3000, 4000, 4.0), (Channel("green", (550.0,), (1.0,)),), f_number=8.0)
    tables = []
    for target in (1.0, 1e-3):
        study = Study(scene.camera(find_lens("double_gauss_28")), scene)
        study.kept = None
        monkeypatch.setattr("p2sf.scene.planning.sharing.TARGET_ERROR", target)
        share_pupils(study)
        tables.append((study.table, study.table_error))
    (few, error), (more, less) = tables
    assert len(few.y_mm) == 3 < len(more.y_mm)
    assert error > 1e-3 >= less > 0


@pytest.mark.parametrize("part", [1e-3, 0.03, 0.2, 0.5, 0.9, 1.0])
def test_fewer_nodes_on_a_part_of_a_range_leave_no_more_than_all_on_the_range(part):
    """Of smooth curves with a pole beyond the range, as pupils have where rays fail; all nodes leave some 1e-4."""
    nodes = chebyshev(-1.0, 1.0, 9)

    def left(low, high, count):
        some, places = chebyshev(low, high, count), np.linspace(low, high, 200)
        weights = lagrange(some, places)
        return max(np.abs(weights @ curve(some) - curve(places)).max() for curve in (np.exp, lambda x: 1 / (1.8 - x)))

    few = fewer_nodes(nodes.tolist(), 2 * part)
    assert few <= 9 and (few == 9) == (part > 0.15)
    assert left(1 - 2 * part, 1.0, few) <= 2 * max(left(-1.0, 1.0, 9), REMAINDER)


def test_planning_interpolates_pupils_as_well_as_it_says():
    scene = Scene(Sensor(300, 400, 9.0), GREEN, 15000.0, 25000.0, focus_mm=20000.0, f_number=4.0)
    own, shared = (Study(scene.camera(find_lens("double_gauss_28")), scene) for _ in range(2))
    share_pupils(shared)
    assert shared.table and 0 < shared.table_error < 3 * TARGET_ERROR  # field, depth and colour
    places = [Place(0.5, 0.9, float(v), wave) for v in shared.scene.vergences(4) for wave in (0.53, 0.545)]
    found = [distance(one, other) for one, other in zip(*(s.kernels(places) for s in (shared, own)), strict=True)]
    assert 0 < max(found) <= shared.table_error


@pytest.mark.parametrize("lens", ["double_gauss_28", "tessar"])
def test_loosening_never_costs_more(lens):
    scene = Scene(Sensor(60, 80, 4.0), GREEN, f_number=5.6)
    costs = [plan(find_lens(lens), replace(scene, rtol=t)).cost.seconds for t in (0.03, 0.06, 0.12, 0.3)]
    assert costs == sorted(costs, reverse=True)


def test_r2_is_the_square_of_the_relative_error():
    assert Scene(Sensor(8, 8, 5.0), min_r2=0.99).relative_tolerance == pytest.approx(0.1)


def test_a_tolerance_in_decibels_or_of_the_mtf_is_kept_against_exact_rays():
    """Parseval's mean over all frequencies, and the picture of white noise, of one place of a plan asked for in dB."""
    asked = Scene(Sensor(96, 128, 9.0), GREEN, 20000.0, 20000.0, min_psnr_db=36.0, focus_mm=20000.0, f_number=4.0)
    made = plan(find_lens("double_gauss_28"), asked)
    x, y, channel = 0.4, 0.3, 0
    kernel = planned_kernel(made, x, y, made.vergences[0], channel)
    true = reference_kernel(made.sensor_map(made.vergences[0]), GREEN[channel], x, y, kernel.shape[0] // 2, 9.0)
    relative, norm = distance(kernel, true), float(np.linalg.norm(true))
    assert made.meets and relative <= made.allowed_error
    assert 0.2 < norm <= made.norm < 0.9  # the kernel's own size is used, not that of a single pixel
    one, two = (np.abs(np.fft.fft2(k, (64, 64))) for k in (kernel, true))
    of_mtf = replace(asked, min_psnr_db=None, mtf_error=0.02)
    mtf_error = float(np.sqrt(np.mean((one - two) ** 2)))
    assert 0.3 * relative * norm < mtf_error <= of_mtf.measured(relative, norm) * (1 + 1e-9)
    noise = np.random.default_rng(0).integers(0, 2, (512, 512))
    error = np.fft.ifft2(np.fft.fft2(noise) * np.fft.fft2(kernel - true, noise.shape)).real
    decibels = -10 * np.log10(np.mean(error**2))
    assert decibels == pytest.approx(asked.measured(relative, norm), abs=0.2)  # of 512² pixels
    assert decibels >= 36.0


@pytest.mark.parametrize(
    ("name", "limit"), [("rtol", 0.05), ("min_r2", 0.99), ("mtf_error", 0.02), ("min_psnr_db", 40.0)]
)
def test_a_limit_is_the_measure_of_the_error_it_allows(name, limit):
    scene = Scene(Sensor(8, 8, 5.0), **{name: limit})
    assert scene.measured(scene.relative_error(0.4), 0.4) == pytest.approx(limit, rel=1e-12)
    assert scene.relative_tolerance <= scene.relative_error(0.4)


def test_a_scene_is_read_from_toml(tmp_path):
    path = tmp_path / "desk.toml"
    path.write_text(SCENE)
    scene = read_scene(path)
    assert scene.sensor == Sensor(48, 64, 9.0) and scene.channels == (Channel("green", (530.0, 560.0), (1.0, 1.0)),)
    assert (scene.near_mm, scene.far_mm, scene.focus_mm, scene.f_number) == (15000, 25000, 20000, 4)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("rows = 48", "rows = 0", "rows is 0"),
        ("rows = 48", "rows = 'x'", "rows is 'x'; give a number"),
        ("rows = 48", "rows = inf", "rows is inf; give a whole number"),
        ("rtol = 0.1", 'rtol = "a"', "rtol is 'a'; give a number, without quotes"),
        ("far_mm = 25000", "far_mm = [1]", r"far_mm is \[1\]; give a number"),
        ("[530, 560]", "[530, 'b']", "wavelengths_nm is 'b'; give a number"),
        ("[530, 560]", "530", "wavelengths_nm is 530; give numbers in brackets"),
        ("pixel_um = 9.0", "pixel_um = 9.0\ncentre_mm = [1]", "centre_mm has 1 numbers; give two"),
        ("far_mm = 25000", "far_mm = 25000\ngaps_mm = 5", "gaps_mm is 5; give numbers in brackets"),
        ("far_mm = 25000", "far_mm = 25000\ngaps_mm = [[16000, 17000, 18000]]", "gaps_mm is .*; give pairs"),
        ("[depth]\nnear_mm = 15000\nfar_mm = 25000", "[shallow]", 'the scene has "shallow"'),
        ("rows = 48", "rows = 48.5", "rows is 48.5; give a whole number"),
        ("far_mm = 25000", "far_mm = 1e99", r"far_mm is 1e\+99.* beyond 1e\+16 mm .*give inf"),
        ("focus_mm = 20000", "focus_mm = 1e17", r"focus_mm is 1e\+17 mm.* beyond"),
        ("rows = 48\n", "", "lacks rows"),
        ("pixel_um = 9.0", "pixel_um = -1", "positive pitch"),
        ("rtol = 0.1", "rtol = 2", "between 0 and 1"),
        ("rtol = 0.1", "rtol = 1e-5", "tighter"),
        ("near_mm = 15000", "near_mm = 30000", "near one first"),
        ("wavelengths_nm = [530, 560]", "wavelengths_nm = []", "at least one"),
        ('name = "desk"', "nane = 1", "means nothing here"),
        ("[depth]", "[depth", "is not valid TOML"),
    ],
)
def test_a_wrong_scene_is_one_sentence_with_its_file(tmp_path, old, new, words):
    path = tmp_path / "desk.toml"
    path.write_text(SCENE.replace(old, new))
    with pytest.raises(RequestError, match=words) as caught:
        read_scene(path)
    assert "desk.toml" in str(caught.value)


def test_a_scene_says_whether_rims_clip(tmp_path):
    for line, clip in (("clip = true", True), ("clip = false", False), ("", False)):
        (tmp_path / "scene.toml").write_text(f"{line}\n{SCENE}", encoding="utf-8")
        assert read_scene(tmp_path / "scene.toml").clip is clip
    (tmp_path / "scene.toml").write_text(f'clip = "yes"\n{SCENE}', encoding="utf-8")
    with pytest.raises(RequestError, match="clip is 'yes'; write true or false, without quotes"):
        read_scene(tmp_path / "scene.toml")


def test_a_lens_without_rims_is_planned_as_with_rims_beyond_its_beams():
    lens = find_lens("double_gauss_28")
    scene = Scene(Sensor(40, 60, 60.0), GREEN, f_number=5.6)
    bare, wide = (
        replace(lens, surfaces=tuple(replace(surface, semi_diameter=rim) for surface in lens.surfaces))
        for rim in (np.inf, 500.0)
    )
    assert plan(bare, scene).predicted_error == plan(wide, scene).predicted_error


def test_a_colour_that_no_glass_knows_is_named_as_it_was_given():
    """Not the mean of the channel, 2700 nm, which planning asks first; for a coarse picture too."""
    scene = Scene(Sensor(20, 30, 20.0), (Channel("wide", (400.0, 5000.0), (1.0, 1.0)),))
    for make in (plan, lambda lens, asked: preview(lens, asked, np.zeros((20, 30, 1), np.float32))):
        with pytest.raises(GlassError, match="channel wide: wavelength 5000 nm is outside the data of SCHOTT"):
            make(find_lens("double_gauss_28"), scene)


def test_a_sensor_beyond_the_lens_is_one_sentence():
    with pytest.raises(GeometryError, match="sensor's corner"):
        plan(find_lens("double_gauss_28"), Scene(Sensor(1000, 1000, 200.0), GREEN))


def test_a_blur_that_no_transform_holds_is_refused_before_anything_is_measured(monkeypatch):
    """20 µm pixels from 1 m to infinity at f/4: some 9000² samples, which used to be found out after half a minute."""
    measured = []
    monkeypatch.setattr(Study, "rendered", lambda *_: measured.append(1))
    with pytest.raises(SamplingError, match=r"1000 mm away blur over .* mm, which takes \d+² samples of 4096² at most"):
        plan(find_lens("double_gauss_28"), Scene(Sensor(600, 900, 20.0), GREEN, 1000.0, f_number=4.0))
    assert not measured


def test_such_a_blur_of_a_far_end_is_told_with_the_sign_of_infinity(monkeypatch):
    monkeypatch.setattr("p2sf.scene.planning.bounds.transforms", lambda *_: (np.array([249]), np.array([5000])))
    scene = Scene(Sensor(60, 90, 20.0), GREEN)
    with pytest.raises(SamplingError, match=r"^points ∞ away blur over 10 mm"):
        check_blur(Study(scene.camera(find_lens("tessar")), scene))


def test_a_colours_error_is_the_one_that_exact_rays_find_even_on_large_pixels():
    """Samples as coarse as energy allows found a sixth of it here, and a plan missed its tolerance by a tenth."""
    channel = Channel("orange", (571.0, 591.0, 611.0), (0.75, 1.0, 0.62))
    scene = Scene(Sensor(280, 280, 10.3), (channel,), f_number=5.84)
    study = Study(scene.camera(find_lens("wide_angle_35")), scene)
    one = Channel("one", tuple(1000 * w for w in reduce_spectrum(channel, 1).wavelengths_um), (1.0,))
    few, every = (reference_kernel(study.sensor_map(0.0), c, 0.0, 0.0, 6, 10.3) for c in (one, channel))
    exact = distance(few, every)
    assert exact > 0.01
    assert _colour_errors(study, channel, [((0.0, 0.0), 0.0)], [(0, 0)]) == [pytest.approx(exact, rel=0.1)]


def test_corners_are_the_nearest_and_farthest_pixels():
    assert Sensor(3, 4, 1000.0).corners_mm() == (0.0, 2.5)
    near, far = Sensor(2, 2, 1000.0, (4.0, 5.0)).corners_mm()
    assert np.allclose((near, far), (5.0, np.hypot(5, 6)))


def test_no_more_pupils_are_needed_where_a_pixel_is_as_wide_as_an_airy_disc():
    """Chief rays that were joined by straight lines, 0.04 µm off, changed sharp kernels by 1.6 % with any number."""
    scene = Scene(Sensor(400, 600, 50.0), GREEN, 2000.0, 6000.0, f_number=16.0, focus_mm=3000.0)
    study = Study(scene.camera(find_lens("wide_angle_35")), scene)
    share_pupils(study)
    assert study.table and study.table_error < TARGET_ERROR


def test_pupils_interpolated_while_planning_are_tried_where_pixels_show_them():
    """Pixels of 47 µm hide a sharp kernel whole: a table that only sharp depths had tried was wrong by 9 % near by."""
    scene = Scene(Sensor(357, 301, 47.0, (-3.7, -1.9)), GREEN, 18_000.0, np.inf, f_number=10.4)
    alone, study = (Study(scene.camera(find_lens("telephoto")), scene) for _ in range(2))
    share_pupils(study)
    assert study.table
    place = Place(5.0, 6.0, study.ends[-1], study.reference_um)
    # What planning aims at along each axis, and as much again for each since errors along all of them add up.
    assert distance(*study.kernels([place]), *alone.kernels([place])) < 3 * TARGET_ERROR


@pytest.mark.slow
@pytest.mark.parametrize(
    "mask", [PupilMask(), PupilMask(obscuration=0.4, vanes=4), PupilMask(blades=6)], ids=["open", "vanes", "blades"]
)
def test_errors_of_sampling_are_those_stated(mask):
    """Of kernels in random scenes, against 3 samples in λ/2NA and two and a half times the window: 95 of 100."""
    stated, found = dict(zip(SAMPLINGS, SAMPLING_ERRORS, strict=True)), {sampling: [] for sampling in SAMPLINGS}
    for lens, number in product(("double_gauss_28", "achromat_f6", "tessar", "landscape"), range(3)):
        opened, scene = random_scene(with_mask(find_lens(lens), mask), np.random.default_rng([number, 5]))
        study = Study(scene.camera(opened), scene)
        try:
            places = study.places(study.waves_um[0])
        except GeometryError:  # chief rays that do not reach the corner
            continue
        pupils, shifts = study.fitted(study.pupils_at(places))
        good = study.rendered(places, pupils, shifts, (3.0, 1.5), shared=False)
        for sampling in SAMPLINGS:
            made = study.rendered(places, pupils, shifts, sampling, shared=False)
            found[sampling] += map(distance, made, good)
    for sampling, errors in found.items():
        assert np.quantile(errors, 0.95) <= stated[sampling] <= 12 * np.median(errors)


def test_a_picture_on_its_side_costs_the_same():
    work = Work(90, 64.0, 1e-4, 1e-2, 12, rows=600, columns=2000, channels=3, nodes=(2, 5), layers=1)
    aside = replace(work, rows=2000, columns=600, nodes=(5, 2))
    assert predicted_cost(aside).seconds == pytest.approx(predicted_cost(work).seconds, rel=1e-12)
