"""A known target: read from a file, and found in a picture however it lies there, with points missing and added."""

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.lens.lens import with_f_number
from p2sf.lensfile.library import find_lens
from p2sf.measure.fitting.frame_terms import FOCUS, lens_optics
from p2sf.measure.frame import Frame, FrameGeometry
from p2sf.measure.measurement import FrameRequest, measure_frame
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.measure.target import Target, expected_places, match_target, read_target

PITCH = 3.45
HEAD = "number, x_mm, y_mm\n"


def grid(without=()):
    """Return 9 × 7 points of 400 × 300 mm, numbered in rows from the top left, without some of them."""
    places = grid_of_points(9, 7, 400.0, 300.0)
    kept = np.setdiff1d(np.arange(63), without)
    return Target(kept + 1, places[kept], "mm", "test.csv")


def seen(places, scale=0.03, turned_deg=0.0, mirrored=False, distortion=0.0, shift=(0.3, -0.2)):
    """Return where the points of a target are seen, by the plain formula."""
    x, y = places.T * [[-1 if mirrored else 1], [1]]
    size = scale * (1 + distortion * (x * x + y * y) / (x * x + y * y).max())
    sine, cosine = np.sin(np.deg2rad(turned_deg)), np.cos(np.deg2rad(turned_deg))
    return np.stack([size * (x * cosine - y * sine), size * (x * sine + y * cosine)], 1) + shift


@pytest.mark.parametrize("seed", range(6))
def test_a_target_is_found_turned_mirrored_and_distorted_with_points_missing_and_added(seed):
    """Places err by 10 µm, a twentieth of what separates one point from the next; three points break the symmetry."""
    rng, target = np.random.default_rng(seed), grid(without=(0, 1, 9))
    turned, mirrored, distortion = rng.uniform(-180, 180), bool(seed % 2), rng.uniform(-0.08, 0.08)
    kept = rng.permutation(60)[:52]
    places = seen(target.places, 0.03, turned, mirrored, distortion)[kept]
    found = np.concatenate([places, rng.uniform(-5, 5, (4, 2))]) + rng.normal(0, 0.01, (56, 2))
    match = match_target(found, target, target.places, known_scale=False)
    assert np.array_equal(match.which[:52], kept) and match.count <= 53 and match.alike == 1
    assert match.mirrored == mirrored and match.numbers[match.which[0]] == target.numbers[kept[0]]
    assert (match.rotation_deg - turned + 180) % 360 - 180 == pytest.approx(0, abs=0.1)
    assert match.scale == pytest.approx(0.03, rel=3e-3) and match.distortion == pytest.approx(distortion, abs=5e-3)
    assert match.axis_mm == pytest.approx((0.3, -0.2), abs=6e-3) and match.rms_mm < 0.02
    undistorted = seen(target.places, 0.03, turned, mirrored, 0.0, (0.0, 0.0))
    assert match.places_mm == pytest.approx(undistorted, abs=0.03)


def test_a_symmetric_target_is_taken_upright_and_said_to_be_symmetric():
    """A full grid is the same turned by 180° and mirrored either way: four ways; its rows differ from its columns."""
    target = grid()
    match = match_target(seen(target.places, turned_deg=2.0), target, target.places, known_scale=False)
    assert match.alike == 4 and "4 ways" in str(match.warnings[0])
    assert not match.mirrored and match.rotation_deg == pytest.approx(2.0) and list(match.which) == list(range(63))


def test_a_part_of_a_target_is_found_by_what_is_missing_in_its_midst():
    target = grid(without=(40, 41, 33))
    found = seen(target.places)
    match = match_target(found[np.abs(found - [0.3, -0.2]).max(1) < 3.1], target, target.places, known_scale=False)
    assert match.alike == 1 and match.axis_mm == pytest.approx((0.3, -0.2), abs=1e-9)


def test_other_points_are_refused():
    rng, target = np.random.default_rng(0), grid()
    with pytest.raises(RequestError, match=r"lie where test\.csv has one"):
        match_target(rng.uniform(-6, 6, (40, 2)), target, target.places, known_scale=False)
    with pytest.raises(RequestError, match="2 points"):
        match_target(np.zeros((2, 2)), target, target.places, known_scale=False)
    twice = seen(target.places, scale=2.0)
    for scale in (1, 1e-3):  # mm in place of metres leave no pair of points whose scale could be right
        with pytest.raises(RequestError, match="its unit"):
            match_target(twice, target, scale * target.places, known_scale=True)


def test_a_target_is_read_and_what_is_wrong_is_said(tmp_path):
    file = tmp_path / "target.csv"
    file.write_text("# of the big screen\nNumber; x_deg; y_deg\n3; -1.5; 2\n\n5\t0 0\n8, 1.5, -2e0\n")
    target = read_target(file)
    assert target.unit == "deg" and list(target.numbers) == [3, 5, 8]
    assert target.places.tolist() == [[-1.5, 2.0], [0.0, 0.0], [1.5, -2.0]]
    for text, words in (
        ("1, 2, 3\n", "line 1: name the columns"),
        (HEAD + "1, 2\n", '2: "1 2" is not a point'),
        (HEAD + "1, 2, x\n", "is not a point"),
        (HEAD + "1, 2, nan\n", "is not a point"),
        (HEAD + "1.5, 2, 3\n", "is not a point"),
        (HEAD.replace("mm", "deg") + "1, 2, 95\n", "is not a point"),
        (HEAD + "1, 2, 3\n1, 4, 5\n", "line 3: 1 4 5 is number 1 once more"),
        (HEAD + "1, 2, 3\n2, 2, 3\n", "line 3: 2 2 3 is number 1 once more"),
        (HEAD + "1, 2, 3\n", "holds 1 points"),
        ("", "holds 0 points"),
    ):
        file.write_text(text)
        with pytest.raises(RequestError, match=r"target\.csv") as caught:
            read_target(file)
        assert words in str(caught.value), text
    file.write_bytes(b"\xff\xfe\x00number")
    with pytest.raises(RequestError, match="cannot be read"):
        read_target(file)


@pytest.fixture(scope="module")
def triplet():
    return with_f_number(find_lens("cooke_triplet"), 4.0)


def test_a_lens_puts_a_target_where_similar_triangles_do(triplet):
    """The sensor is where infinity is sharp: a chief ray of slope s lands at f·s near the axis, f = 50 mm.

    The slope is that at the entrance pupil, some 10 mm behind the first vertex, which is 2 m from the target: 1 %.
    """
    target = Target(np.array([1, 2, 3]), np.array([[0.0, 0.0], [30.0, 0.0], [-18.0, 24.0]]), "mm")
    places = expected_places(target, triplet, 2000.0, 0.5876)
    assert np.hypot(*places.T) == pytest.approx([0.0, 0.75, 0.75], rel=0.015)
    assert places[2] == pytest.approx(places[1, 0] * np.array([-0.6, 0.8]))
    angles = Target(np.array([1, 2]), np.array([[1.0, 0.0], [0.0, -2.0]]), "deg")
    landed = expected_places(angles, triplet, np.inf, 0.5876)
    assert landed == pytest.approx(50 * np.tan(np.deg2rad(angles.places)), rel=0.01, abs=1e-12)
    with pytest.raises(RequestError, match="infinitely far"):
        expected_places(target, triplet, np.inf, 0.5876)


@pytest.mark.slow
def test_a_cropped_picture_of_a_target_has_the_axis_and_the_fields_of_the_target(triplet):
    """The picture's middle is 0.83 mm beside the axis, where a sensor tilted by 0.4° is farther by 5.8 µm.

    Without the target that is told as the shift. Five standard deviations.
    """
    deg = grid_of_points(3, 3, 4.4, 2.2)[:-1]
    target = Target(np.arange(1, 9), deg, "deg")
    places = expected_places(target, triplet, np.inf, triplet.reference_wavelength_um)
    exposure = Exposure(sensor_shift_um=25.0, tilt_deg=(0.4, 0.0))
    whole = simulated_frame(triplet, places, FrameGeometry(680, 2200, PITCH), exposure)
    whole.values[500:505, 1200:1205] += 300.0  # a speck
    frame = Frame(whole.values[:, 480:], FrameGeometry(680, 1720, PITCH))
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    found = measure_frame([frame], optics, FrameRequest(lens=triplet, unknowns=FOCUS, target=target, singly=False))
    assert found.target.count == 8 and found.target.axis_mm[0] == pytest.approx(-240 * PITCH / 1000, abs=3e-3)
    assert np.abs((found.whole.values - [25.0, 0.4, 0.0, 0.0]) / found.whole.errors).max() < 5
    without = measure_frame([frame], optics, FrameRequest(lens=triplet, unknowns=FOCUS, singly=False)).whole
    assert abs(without.values[0] - 25.0) > 5 * without.errors[0]
    numbers = {point.number: point for point in found.points}
    assert (numbers[1].x_mm, numbers[1].y_mm) == pytest.approx(tuple(places[0]), abs=8e-3)
    (speck,) = (point for point in found.points if point.number is None)
    assert [str(flag) for flag in speck.flags] == ["no point of the target"] and round(speck.row) == 502
