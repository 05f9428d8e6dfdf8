"""Plans of misaligned lenses against exact rays of each point, behind masks and rims and at several depths."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.image.form import Forming, form_image
from p2sf.image.preview import preview
from p2sf.lens.freeform import XYPolynomial
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.shapes import RadialPolynomial
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.sensor_points import landing_mm
from p2sf.scene.planning.plan import plan
from p2sf.scene.planning.verify import verify
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor
from tests.support.exact_lattice import exact_lattice

GREEN = (Channel("green", (520.0, 560.0), (1.0, 1.0)),)
SCENE = Scene(Sensor(40, 60, 60.0, (3.0, 6.0)), GREEN, rtol=0.05)


@pytest.fixture(scope="module")
def straight():
    return with_f_number(find_lens("double_gauss_28"), 5.6)


@pytest.fixture(scope="module")
def bad(straight):
    return displaced(straight, 3, 5, Placement(0.15, 0.1, 0.02, 0.2, 0.3))


@pytest.fixture(scope="module")
def planned(bad):
    return plan(bad, SCENE)


@pytest.fixture(scope="module")
def values():
    return np.random.default_rng(0).random((40, 60, 1)).astype(np.float32)


def distance(found, wanted):
    return np.linalg.norm(found - wanted) / np.linalg.norm(wanted)


def test_a_plan_promises_what_exact_rays_find(planned):
    """Against sums over the rays of each point alone, at random places."""
    assert planned.meets
    assert planned.predicted_error <= SCENE.limit
    verdict = verify(planned, 4)
    assert verdict.kept
    assert {str(decision.what) for decision in planned.decisions} >= {"method", "field", "sampling", "depth", "pupils"}


NEAR = 15000.0


@pytest.fixture(scope="module")
def deep(bad):
    return plan(bad, replace(SCENE, near_mm=NEAR, rtol=0.2))


@pytest.mark.slow
def test_depths_have_nodes_between_which_the_promise_holds(deep):
    assert deep.meets
    assert len(deep.vergences) > 2
    assert verify(deep, 3, seed=1).kept


def test_the_picture_is_that_of_exact_kernels(planned, bad, values):
    """What a kernel may be wrong by bounds the picture of white noise; exact ones stand at nine places."""
    half = int(planned.kernels(0, 0.0).points([3.0], [6.0]).half_widths()[0])
    exact = form_image(planned, values, lattice=exact_lattice(planned, 3, half))
    found = form_image(planned, values)
    assert distance(found, exact) <= planned.predicted_error
    straight = form_image(plan(set_straight(bad), SCENE), values)
    assert distance(straight, exact) > 2 * planned.predicted_error


def set_straight(lens):
    return replace(lens, surfaces=tuple(replace(s, before=(), after=()) for s in lens.surfaces))


@pytest.mark.slow
def test_a_lens_turned_about_its_centres_has_the_picture_of_the_straight_one(straight, values):
    """A sphere turned about its own centre is no other lens, but no symmetry is known of it."""
    turned = displaced(straight, 1, 1, Placement(tilt_x_deg=2.0, pivot=(0.0, 0.0, straight.surfaces[0].radius)))
    both = plan(turned, SCENE), plan(straight, SCENE)
    one, other = (form_image(each, values) for each in both)
    assert distance(one, other) <= sum(each.predicted_error for each in both)


@pytest.mark.slow
def test_a_mirrored_lens_forms_the_mirrored_picture(planned, straight, values):
    mirrored = displaced(straight, 3, 5, Placement(-0.15, 0.1, 0.02, 0.2, -0.3))
    scene = replace(SCENE, sensor=replace(SCENE.sensor, centre_mm=(-3.0, 6.0)))
    other = plan(mirrored, scene)
    one, two = form_image(planned, values), form_image(other, np.ascontiguousarray(values[:, ::-1]))
    assert distance(two[:, ::-1], one) <= planned.predicted_error + other.predicted_error
    unlike = form_image(planned, np.ascontiguousarray(values[:, ::-1]))
    assert distance(two, unlike) > 2 * planned.predicted_error


@pytest.mark.parametrize(
    "shape",
    [
        XYPolynomial((0.0, 1e-4, 0.0, 2e-3, 0.0, 1e-3), normalisation_mm=10.0),
        RadialPolynomial((0.0, 0.0, 1e-5)),
    ],
    ids=repr,
)
def test_surfaces_without_six_coefficients_are_planned_by_fits(straight, shape):
    """A freeform, which has no symmetry either, and an odd asphere, which has."""
    odd = replace(straight, surfaces=(replace(straight.surfaces[0], shape=shape), *straight.surfaces[1:]))
    scene = replace(SINGLE, f_number=16.0, rtol=0.1)
    made = plan(odd, scene)
    assert made.meets and made.recipe.method == "fitted"
    assert made.sensor_map(0.0).about_axis == shape.radial
    assert verify(made, 1).kept
    wrong = replace(made, table=plan(straight, scene).table) if shape.radial else None
    assert wrong is None or not verify(wrong, 1).kept


@pytest.mark.slow
def test_layers_of_depth_have_their_own_kernels(deep, values):
    """Two halves at the ends of the depths; away from their seam each is the picture of its depth alone."""
    depth = np.full((40, 60), inf)
    depth[:, :30] = NEAR
    both = form_image(deep, values, depth, Forming(geometry=False))
    for part, mm in ((slice(0, 12), NEAR), (slice(48, 60), inf)):
        alone = form_image(deep, values, np.full((40, 60), mm), Forming(geometry=False))
        assert distance(both[:, part], alone[:, part]) < 1e-3


def test_chief_rays_place_the_picture(planned, bad):
    """In hundredths of a pixel, in the reference wavelength, against a chief ray traced by itself."""
    seen = planned.sensor_map(0.0)
    for place in ((2.0, 5.5), (4.5, 7.0)):
        source = seen.source(*place, planned.reference_um)
        assert landing_mm(bad, source) == pytest.approx(place, abs=0.01 * SCENE.sensor.pixel_mm)


VANE = PupilMask(vanes=1, vane_width=0.3)
SINGLE = replace(SCENE, rtol=0.2, channels=(Channel("green", (540.0,), (1.0,)),))


@pytest.mark.parametrize(
    ("mask", "change"),
    [
        (VANE, {}),
        (CLEAR, {"clip": True}),
        pytest.param(VANE, {"clip": True, "near_mm": NEAR}, marks=pytest.mark.slow),
        pytest.param(VANE, {"clip": True, "sensor": Sensor(40, 60, 30.0, (8.0, 17.0))}, marks=pytest.mark.slow),
    ],
    ids=repr,
)
def test_masks_rims_and_depths_go_together(bad, mask, change):
    made = plan(with_mask(bad, mask), replace(SINGLE, **change))
    assert made.meets
    assert verify(made, 2).kept


def test_the_tilted_sensor_is_planned_by_its_own_sharpest_places(straight):
    """Tilted about x it is sharp along a line: the kernels at top and bottom are told from that between them."""
    tilted = replace(straight, sensor_before=(Placement(tilt_x_deg=4.0),))
    scene = replace(SINGLE, sensor=Sensor(60, 40, 60.0), f_number=4.0)
    made = plan(tilted, scene)
    assert made.meets and made.counts[0] > 2 and not made.mirrored
    assert verify(made, 3).kept


def test_a_preview_is_near_the_picture(bad, planned, values):
    """Its kernels stand at nine places and have one wavelength."""
    found = preview(bad, SCENE, values)
    assert distance(found, form_image(planned, values)) < 0.2
