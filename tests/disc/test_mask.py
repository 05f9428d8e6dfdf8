"""The mask in the stop: what cannot be is refused, edges lie where they should, symmetry is told."""

import pickle
from math import inf, pi

import numpy as np
import pytest

from p2sf.disc.mask import PupilMap, PupilMask
from p2sf.errors import RequestError

RING = np.linspace(0, 2 * pi, 721)


@pytest.mark.parametrize(
    "wrong",
    [
        {"obscuration": 1.0},
        {"obscuration": -0.1},
        {"vanes": 13},
        {"vanes": 2.5},
        {"vane_width": 0.6},
        {"vane_angle_deg": inf},
        {"blades": 2},
        {"roundness": 1.1},
        {"apodisation": 0.0},
        {"apodisation_power": 3},
        {"zernike_um": (float("nan"),)},
        {"zernike_um": (0.1, -1e308)},
        {"zernike_um": (0.0,) * 1000},
        {"cubic_um": inf},
        {"cubic_um": 1e308},
    ],
    ids=str,
)
def test_what_cannot_stand_in_a_stop_is_refused_by_name(wrong):
    with pytest.raises(RequestError) as error:
        PupilMask(**wrong)
    assert error.value.message.values["parameter"] == next(iter(wrong))


def test_an_apodisation_too_wide_to_be_seen_is_none():
    """Its radius may be as large as a number can be, whose square is none any more."""
    assert PupilMask(apodisation=1e308).amplitude(np.array([0.0, 0.6]), np.array([0.0, 0.8])).tolist() == [1, 1]


@pytest.mark.parametrize("values", [np.zeros((3, 3)), np.zeros((8, 9)), np.full((8, 8), np.nan)], ids=str)
def test_maps_that_are_no_square_of_numbers_are_refused(values):
    with pytest.raises(RequestError, match="map of the pupil"):
        PupilMap(values)


@pytest.mark.parametrize("blades", [3, 5, 6, 9])
@pytest.mark.parametrize("roundness", [0.0, 1e-9, 0.5, 0.999])
def test_the_edges_of_blades_meet_on_the_rim(blades, roundness):
    mask = PupilMask(blades=blades, roundness=roundness, blade_angle_deg=17)
    angle = np.array(mask.corner_angles)
    nearest = np.min([e.distance(0 * angle, 0 * angle, np.sin(angle), np.cos(angle)) for e in mask.edges], axis=0)
    assert nearest == pytest.approx(1, abs=1e-9)
    # In the middle of a blade the edge lies at the chord's distance and its sagitta.
    middle, half = angle + pi / blades, np.sin(pi / blades)
    sagitta = 0 if roundness == 0 else (1 - np.sqrt(1 - (roundness * half) ** 2)) / roundness
    found = [
        e.distance(np.zeros(1), np.zeros(1), np.sin([a]), np.cos([a]))[0]
        for e, a in zip(mask.edges, middle, strict=True)
    ]
    assert np.array(found) == pytest.approx(np.cos(pi / blades) + sagitta, abs=1e-7)  # the sagitta cancels at 1e-9


def test_blades_of_full_roundness_are_a_circle():
    assert PupilMask(blades=7, roundness=1.0).clear


def test_what_opens_agrees_with_the_distance_to_the_edge():
    mask = PupilMask(blades=5, roundness=0.3, blade_angle_deg=11)
    sine, cosine = np.sin(RING), np.cos(RING)
    edge = np.min([e.distance(0 * RING, 0 * RING, sine, cosine) for e in mask.edges], axis=0)
    assert mask.opens(0.999 * edge * sine, 0.999 * edge * cosine).all()
    assert not mask.opens(1.001 * edge * sine, 1.001 * edge * cosine).any()


def test_vanes_and_obscuration_cover_what_they_say():
    mask = PupilMask(obscuration=0.3, vanes=3, vane_width=0.05, vane_angle_deg=90)
    xi, eta = np.array([0.29, 0.5, 0.5, -0.5, 0.5]), np.array([0.0, 0.0, 0.06, 0.0, 0.049])
    assert mask.opens(xi, eta).tolist() == [False, False, True, True, False]


@pytest.mark.parametrize(
    ("mask", "even"),
    [
        (PupilMask(), True),
        (PupilMask(obscuration=0.4, apodisation=0.7), True),
        (PupilMask(blades=5), True),
        (PupilMask(blades=5, blade_angle_deg=10), False),
        (PupilMask(blades=5, blade_angle_deg=36), True),
        (PupilMask(vanes=3, vane_angle_deg=60), True),
        (PupilMask(vanes=1, vane_angle_deg=90), False),
        (PupilMask(cubic_um=1.0), False),
        (PupilMask(zernike_um=(0, 1.0)), False),  # tilt along ξ
        (PupilMask(zernike_um=(0, 0, 1.0)), True),  # tilt along η
        (PupilMask(zernike_um=(0, 0, 1.0), turn_deg=90), False),
        (PupilMask(zernike_um=(0, 0, 0, 1.0), turn_deg=20), True),  # defocus
        (PupilMask(phase_map=PupilMap.sampled(lambda xi, eta: xi**2 + eta)), True),
        (PupilMask(phase_map=PupilMap.sampled(lambda xi, eta: xi + eta)), False),
    ],
    ids=str,
)
def test_evenness_is_that_of_the_function(mask, even):
    assert mask.even == even
    rng = np.random.default_rng(1)
    xi, eta = rng.uniform(-0.7, 0.7, (2, 4000))
    same = (mask.opens(xi, eta) == mask.opens(-xi, eta)).all() and np.allclose(
        mask.path_um(xi, eta), mask.path_um(-xi, eta), atol=1e-12
    )
    assert same == even


def test_a_turned_mask_is_the_mask_seen_from_another_azimuth():
    mask = PupilMask(
        0.2,
        3,
        0.03,
        5.0,
        6,
        0.2,
        8.0,
        0.9,
        2,
        (0, 0.1, 0, 0, 0.2, 0, 0.3),
        0.4,
        PupilMap.sampled(lambda x, y: x * y**2),
    )
    xi, eta = np.random.default_rng(2).uniform(-0.7, 0.7, (2, 1000))
    turn = 0.3
    back = xi * np.cos(turn) - eta * np.sin(turn), eta * np.cos(turn) + xi * np.sin(turn)
    turned = mask.turned(np.rad2deg(turn))
    assert (turned.opens(xi, eta) == mask.opens(*back)).all()
    assert turned.path_um(xi, eta) == pytest.approx(mask.path_um(*back), abs=1e-14)


def test_a_map_follows_a_smooth_function_and_is_frozen():
    found = PupilMap.sampled(lambda xi, eta: np.cos(3 * xi) * np.sin(2 * eta + 1))
    xi, eta = np.random.default_rng(3).uniform(-0.7, 0.7, (2, 500))
    # A cubic spline errs by 5h⁴/384 of the fourth derivative, 1 + 81, h = 2/129 (de Boor 1978, ch. V).
    assert found.at(xi, eta) == pytest.approx(np.cos(3 * xi) * np.sin(2 * eta + 1), abs=1e-7)
    assert pickle.loads(pickle.dumps(found)) == found and hash(pickle.loads(pickle.dumps(found))) == hash(found)
    with pytest.raises(ValueError, match="read-only"):
        found.values[0, 0] = 1


def test_apodisation_falls_to_1_over_e_at_its_radius():
    for power in (2, 4, 10):
        mask = PupilMask(apodisation=0.6, apodisation_power=power)
        assert mask.amplitude(np.array([0.0, 0.6]), np.zeros(2)) == pytest.approx([1, np.exp(-1)])
