"""Every place that knows a mask agrees with `PupilMask.opens`: a new number of the mask fails here until all do."""

from dataclasses import fields

import numpy as np
import pytest

from p2sf.disc.domain import WHOLE
from p2sf.disc.mask import PupilMap, PupilMask
from p2sf.disc.mask_cells import open_share
from p2sf.disc.mask_nodes import mask_nodes, throughput
from p2sf.disc.mask_outline import dark_heights, obstructions, opening
from p2sf.disc.open_part import edges_of
from p2sf.disc.star_curve import StarCurve
from p2sf.lens.lens import with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.parameters import PARAMETERS
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.setting import MASK, Request, mask_of

MAP = PupilMap.sampled(lambda xi, eta: 0.6 + 0.3 * xi * eta + 0.2 * xi, 9)
# A mask for every field, with another value than the default, beside the least that it needs to be seen.
SAMPLES = {
    "obscuration": PupilMask(obscuration=0.35),
    "vanes": PupilMask(vanes=3, vane_width=0.06),
    "vane_width": PupilMask(vanes=4, vane_width=0.11),
    "vane_angle_deg": PupilMask(vanes=3, vane_width=0.06, vane_angle_deg=25.0),
    "blades": PupilMask(blades=5),
    "roundness": PupilMask(blades=6, roundness=0.6),
    "blade_angle_deg": PupilMask(blades=5, blade_angle_deg=13.0),
    "apodisation": PupilMask(apodisation=0.7),
    "apodisation_power": PupilMask(apodisation=0.7, apodisation_power=6),
    "zernike_um": PupilMask(zernike_um=(0.0, 0.1, 0.0, 0.2)),
    "cubic_um": PupilMask(cubic_um=0.4),
    "phase_map": PupilMask(phase_map=MAP),
    "amplitude_map": PupilMask(amplitude_map=MAP),
    "turn_deg": PupilMask(obscuration=0.2, obscuration_y=0.3, vanes=3, vane_width=0.05, blades=5, turn_deg=-35.0),
    "obscuration_x": PupilMask(obscuration=0.3, obscuration_x=-0.4),
    "obscuration_y": PupilMask(obscuration=0.3, obscuration_y=0.45),
}
MIXED = {
    "across vanes": PupilMask(obscuration=0.3, obscuration_x=0.25, obscuration_y=-0.2, vanes=4, vane_width=0.08),
    "at the rim": PupilMask(obscuration=0.4, obscuration_x=0.36, obscuration_y=0.48),
    "behind blades": PupilMask(obscuration=0.4, obscuration_x=0.3, obscuration_y=0.4, blades=5, roundness=0.2),
    "all": PupilMask(
        obscuration=0.35, obscuration_x=0.2, obscuration_y=0.3, vanes=3, vane_width=0.07, blades=6, turn_deg=20.0
    ),
    "even": PupilMask(obscuration=0.3, obscuration_y=-0.5, vanes=3, vane_width=0.05, blades=5),
    "one vane": PupilMask(obscuration=0.2, obscuration_y=0.3, vanes=1, vane_width=0.1),
    "two vanes": PupilMask(obscuration=0.3, obscuration_x=0.5, vanes=2, vane_width=0.1, vane_angle_deg=60.0),
}
EVERY = SAMPLES | MIXED
NOT_ASKED = {"zernike_um", "phase_map", "amplitude_map", "turn_deg"}  # by no request: only files and Python have them
SIDE, LEAN = 1501, 0.4  # a square grid, leant so that no edge runs along it
CENTRE = (2 * np.arange(SIDE) + 1 - SIDE) / SIDE
WITHIN = np.hypot(*np.meshgrid(CENTRE, CENTRE)) < 1
GRID = [x[WITHIN] for x in np.meshgrid(CENTRE, CENTRE)]
XI, ETA = GRID[0] * np.cos(LEAN) + GRID[1] * np.sin(LEAN), GRID[1] * np.cos(LEAN) - GRID[0] * np.sin(LEAN)
MOMENTS = (lambda x, y: 1 + 0 * x, lambda x, y: x, lambda x, y: y, lambda x, y: x * y, lambda x, y: x * x - y * y)


@pytest.fixture(params=EVERY, ids=str, scope="module")
def mask(request) -> PupilMask:
    return EVERY[request.param]


@pytest.fixture(scope="module")
def opened(mask) -> np.ndarray:
    """Return which points of the grid are open."""
    return mask.opens(XI, ETA)


@pytest.fixture(scope="module")
def by_grid(opened) -> np.ndarray:
    """Return moments over the open part, as shares of the disc's area."""
    return np.array([moment(XI[opened], ETA[opened]).sum() for moment in MOMENTS]) / XI.size


def test_every_field_has_a_sample_that_differs():
    plain = PupilMask()
    assert {field.name for field in fields(PupilMask)} == set(SAMPLES)
    for name, mask in SAMPLES.items():
        assert getattr(mask, name) != getattr(plain, name), name


def test_nodes_are_of_the_open_part(mask, opened, by_grid):
    """The grid is yes or no at edges: its error falls as side^−1.5, 1e-4 at most here."""
    nodes = mask_nodes(mask, 24, 48).unfolded()
    found = np.array([nodes.share * nodes.weight @ moment(nodes.xi, nodes.eta) for moment in MOMENTS])
    assert found == pytest.approx(by_grid, abs=2e-4)
    finer = mask_nodes(mask, 48, 96).unfolded()
    again = np.array([finer.share * finer.weight @ moment(finer.xi, finer.eta) for moment in MOMENTS])
    # No edge falls between nodes; the chord of the disc across a vane falls as a root at its ends.
    assert found == pytest.approx(again, abs=2e-6)
    assert nodes.amplitude == pytest.approx(mask.amplitude(nodes.xi, nodes.eta))
    assert nodes.path_um == pytest.approx(mask.path_um(nodes.xi, nodes.eta))
    passed = opened * mask.amplitude(XI, ETA)
    assert throughput(mask).amplitude == pytest.approx(passed.mean(), abs=2e-4)
    assert throughput(mask).light == pytest.approx(np.square(passed).mean(), abs=2e-4)


def test_pieces_between_rims_are_of_the_open_part(mask, by_grid):
    """As exact rays have it, of a lens whose rims are nowhere near."""
    lens = with_mask(find_lens("singlet_f6"), mask)
    nodes = pupil_nodes(lens, Source(), (16, 32), whole=False).unfolded()
    found = np.array([nodes.share * nodes.weight @ moment(nodes.xi, nodes.eta) for moment in MOMENTS])
    assert found == pytest.approx(by_grid, abs=3e-4)


def test_cells_are_open_where_the_mask_is(mask, opened):
    share = open_share(mask, XI, ETA, np.full(XI.shape, 2 / SIDE))
    assert share.mean() == pytest.approx(opened.mean(), abs=3e-4)
    settled = (share == 0) | (share == 1)
    assert np.array_equal(share[settled] > 0.5, opened[settled]) and settled.mean() > 0.97


def inside(curve: np.ndarray, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return which points lie in a closed line, by the parity of crossings to their right."""
    (x, y), (next_x, next_y) = curve, np.roll(curve, -1, axis=1)
    odd = np.zeros(xi.shape, bool)
    for ends in zip(x, y, next_x, next_y, strict=True):
        between = (ends[1] > eta) != (ends[3] > eta)
        with np.errstate(divide="ignore", invalid="ignore"):
            at = ends[0] + (eta - ends[1]) / (ends[3] - ends[1]) * (ends[2] - ends[0])
        odd ^= between & (xi < at)
    return odd


def test_outlines_part_what_is_open_from_what_is_dark(mask):
    """Those of contrast and those of drawings; points closer to an edge than its chords count for neither."""
    rng = np.random.default_rng(1)
    xi, eta = rng.uniform(-0.999, 0.999, (2, 1500))
    some = (np.hypot(xi, eta) < 0.999) & settled_at(mask, xi, eta)
    xi, eta = xi[some], eta[some]
    light, dark = edges_of(mask)
    for openings, covers in ((light, dark), ([opening(mask)], obstructions(mask))):
        open_ = np.ones(xi.shape, bool)
        for curve in openings:
            open_ &= inside(np.stack(curve), xi, eta)
        for curve in covers:
            open_ &= ~inside(np.stack(curve), xi, eta)
        assert np.array_equal(open_, mask.opens(xi, eta))


def settled_at(mask: PupilMask, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    around = [mask.opens(xi + dx, eta + dy) for dx in (-1e-3, 0, 1e-3) for dy in (-1e-3, 0, 1e-3)]
    return np.all(around, axis=0) | ~np.any(around, axis=0)


def test_heights_of_the_drawing_are_those_that_obscuration_and_iris_cover(mask):
    from dataclasses import replace

    mask = replace(mask, vanes=0)
    eta = np.linspace(-0.9995, 0.9995, 1999)
    dark = np.zeros(eta.size, bool)
    for low, high in dark_heights(mask):
        dark |= (eta > low) & (eta < high)
    assert np.array_equal(dark, ~mask.opens(np.zeros_like(eta), eta))


def test_what_there_is_is_told_as_it_is(mask, opened):
    xi, eta = XI[opened], ETA[opened]
    assert mask.edged == (not opened.all())
    assert mask.shaded == bool(np.any(mask.amplitude(xi, eta) != 1))
    assert mask.phased == bool(np.any(mask.path_um(xi, eta) != 0))


def test_symmetries_are_told_as_they_are(mask):
    """A mask that says it is even or round is; one that is says so, for all that a grid can tell."""

    def seen(xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        # Parts that are dark are not compared where the edge itself lies on the grid.
        return np.stack([mask.opens(xi, eta), mask.amplitude(xi, eta), mask.path_um(xi, eta)])

    some = slice(None, None, 97)
    xi, eta = XI[some], ETA[some]
    mirrored = np.mean(np.abs(seen(-xi, eta) - seen(xi, eta)).max(0) > 1e-9) < 1e-3
    assert mirrored == mask.even
    turn = np.hypot(xi, eta)
    same = np.mean(np.abs(seen(turn, 0 * turn) - seen(xi, eta)).max(0) > 1e-9) < 1e-3
    assert same == mask.round
    part = mask.round_part
    assert part.round and not np.any(mask.opens(xi, eta) & ~part.opens(xi, eta))


def test_without_its_phase_a_mask_lets_the_same_light_through(mask):
    xi, eta = XI[::97], ETA[::97]
    plain = mask.without_phase()
    assert not plain.phased and not np.any(plain.path_um(xi, eta))
    assert np.array_equal(plain.opens(xi, eta), mask.opens(xi, eta))
    assert np.array_equal(plain.amplitude(xi, eta), mask.amplitude(xi, eta))


def test_a_turned_mask_is_turned(mask):
    angle = np.deg2rad(40.0)
    xi, eta = XI[::97], ETA[::97]
    back = xi * np.cos(angle) - eta * np.sin(angle), eta * np.cos(angle) + xi * np.sin(angle)
    turned = mask.turned(40.0)
    assert np.mean(turned.opens(xi, eta) != mask.opens(*back)) < 1e-3
    np.testing.assert_allclose(turned.amplitude(xi, eta), mask.amplitude(*back), rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(turned.path_um(xi, eta), mask.path_um(*back), rtol=1e-6, atol=1e-12)


def test_a_lens_file_keeps_it(mask):
    lens = with_mask(find_lens("singlet_f6"), mask)
    assert parse_toml(lens_to_toml(lens), "lens.toml").mask == mask


def test_a_request_states_it():
    names = {field.name for field in fields(PupilMask)}
    assert set(MASK) == names - NOT_ASKED
    for name in MASK:
        sample = SAMPLES[name]
        stated = {other: getattr(sample, other) for other in MASK}
        assert name in PARAMETERS and mask_of(None, Request(**stated)) == sample


def test_a_curve_that_is_held_follows_the_open_part_about_its_middle_in_order():
    """An ellipse twice as wide as a circle and half as high: its ends lie on the circle, and nothing runs back."""
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    circle = StarCurve((0.0, 0.0), (0.0, 2 * np.pi), (np.ones(1),), WHOLE)
    xi, eta = circle.hold(2 * np.sin(turn), 0.5 * np.cos(turn))
    assert (np.diff(np.unwrap(np.arctan2(xi, eta))) >= -1e-12).all() and len(xi) == 64
    assert np.abs(np.hypot(xi, eta)[np.abs(xi) > 0.9] - 1).max() < 0.01
    inside = np.hypot(xi, eta) < 0.99
    assert (xi[inside] / 2) ** 2 + (2 * eta[inside]) ** 2 == pytest.approx(1)
