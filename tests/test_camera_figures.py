"""What a camera with its lens answers is what the functions of the library do, asked for the same."""

from math import inf

import numpy as np
import pytest

import p2sf
from p2sf.errors import P2SFError
from p2sf.paraxial.first_order import cardinal_points
from p2sf.tolerance.builds import evaluate
from p2sf.tolerance.criteria import share_within
from p2sf.tolerance.errors_of_build import Tolerance

LENS = p2sf.load_lens("achromat_f6")
CAMERA = p2sf.Camera(LENS, focus_mm=4000, f_number=8, pixel_um=40.0, obscuration=0.2, sensor_shift_um=15)
RNG = np.random.default_rng(5)
pytestmark = pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")


def test_a_database_covers_the_lens_as_it_is_set():
    found = CAMERA.database("seidel")
    np.testing.assert_array_equal(found.depths_mm, [2000, inf])
    assert found.fields_deg[-1] == pytest.approx(LENS.widest_field_deg) and found.fields_deg[0] == 0
    waves = sorted(LENS.wavelengths_nm)
    np.testing.assert_allclose(found.wavelengths_nm[[0, -1]], [waves[0], waves[-1]], rtol=1e-12)
    source = CAMERA.source(3000, 0.5)
    for own, direct in zip(
        vars(found.coefficients(source)).values(),
        vars(CAMERA.at(source).coefficients()).values(),
        strict=True,
    ):
        assert own == pytest.approx(direct, abs=1e-9)
    free = p2sf.Camera(LENS).database("seidel", wavelengths_nm=[550])
    focal = cardinal_points(LENS, LENS.reference_wavelength_um).effective_focal_length
    assert free.depths_mm[0] == pytest.approx(20 * float(focal)) and free.wavelengths_nm.size == 1


@pytest.mark.parametrize("depths", [None, 3000.0, RNG.uniform(3000, 5000, (12, 16))])
def test_a_photograph_is_that_of_a_plan(depths):
    values = RNG.uniform(0, 1, (12, 16, 3))
    found = CAMERA.photograph(values, depths, rtol=0.2)
    seen = depths if depths is not None else 4000.0
    scene = p2sf.Scene(
        p2sf.Sensor(12, 16, 40.0),
        near_mm=float(np.min(seen)),
        far_mm=float(np.max(seen)),
        rtol=0.2,
        focus_mm=4000,
        f_number=8,
    )
    masked = p2sf.with_mask(LENS, p2sf.PupilMask(obscuration=0.2))
    still = p2sf.form_image(p2sf.plan(masked, scene), values, None if np.ndim(seen) == 0 else seen)
    assert found.shape == values.shape and found.dtype == np.float32
    unshifted = p2sf.Camera(LENS, focus_mm=4000, f_number=8, pixel_um=40.0, obscuration=0.2)
    np.testing.assert_allclose(unshifted.photograph(values, depths, rtol=0.2), still, atol=1e-6)


@pytest.mark.parametrize("shape", [(48, 64), (48, 64, 3)], ids=["grey", "colours"])
def test_a_sharpened_photograph_is_nearer_to_the_scene(shape):
    """Bars of 6 pixels, blurred over 4; noise of 0.002 is estimated to 30 % from so few pixels."""
    blurred = p2sf.Camera(LENS, focus_mm=4000, pixel_um=6.0, sensor_shift_um=120)
    scene = np.full(shape, 0.3)
    scene[:, np.arange(64) % 12 < 6] = 0.7
    photo = blurred.photograph(scene, rtol=0.1) + RNG.normal(0, 0.002, shape)
    found, known = blurred.sharpen(photo), blurred.sharpen(photo, noise=0.002)
    inner = np.s_[12:-12, 12:-12]
    before, after = (float(np.sqrt(np.mean((each - scene)[inner] ** 2))) for each in (photo, found))
    assert found.shape == photo.shape and found.dtype == np.float32
    assert after < 0.6 * before
    np.testing.assert_allclose(found[inner], known[inner], atol=0.3 * after)


def test_a_photograph_of_one_colour_keeps_its_shape():
    values = np.zeros((11, 15))
    values[5, 7] = 1.0
    found = CAMERA.photograph(values, rtol=0.2)
    assert found.shape == (11, 15) and np.unravel_index(found.argmax(), found.shape) == (5, 7)


def test_yields_are_the_shares_that_keep_limits():
    limits = {"strehl": 0.7, "mtf20": 0.5, "mtf40": 0.2}
    found = CAMERA.tolerances(limits, builds=400, seed=3)
    assert found.yields.keys() == {*limits, "all"} and found.errors.keys() == found.yields.keys()
    for name, limit in limits.items():
        criterion = "mtf" if name.startswith("mtf") else name
        share, error = share_within(found.builds[name], {criterion: limit})
        assert (found.yields[name], found.errors[name]) == (share, error)
        assert np.mean(found.values[name] >= limit) == share
    assert found.yields["all"] <= min(found.yields[name] for name in limits)
    assert "strehl" in repr(found)


def test_the_most_harmful_tolerance_comes_first_and_leaves_the_smaller_yield():
    """The first and the last of the list alone, at plus and minus its amount: the Strehl ratio tells which is worse."""
    found = CAMERA.tolerances({"strehl": 0.7}, builds=50, seed=3)
    listed = found.harms("strehl")
    assert all(isinstance(tolerance, Tolerance) for tolerance, _ in listed)
    assert (np.diff([harm for _, harm in listed]) <= 0).all() and listed[0][1] > 0
    places = [found.known.tolerances.index(listed[at][0]) for at in (0, -1)]
    alone = np.eye(len(found.known.tolerances))[places] * found.known.amounts
    both = evaluate(found.known, np.concatenate([alone, -alone]), found.compensators).strehl.min(1)
    first, last = both.reshape(2, 2).min(0)
    assert first < last


@pytest.mark.parametrize(
    "limits", [{}, {"mtf": 0.3}, {"mtf0": 0.3}, {"strehl": 1.5}, {"rms_waves": -1.0}, {"speed": 1.0}]
)
def test_limits_that_are_none_are_refused(limits):
    with pytest.raises(P2SFError):
        CAMERA.tolerances(limits)


@pytest.mark.parametrize("image", [np.zeros(5), np.zeros((4, 4, 2)), np.zeros((4, 4), complex)])
def test_what_is_no_picture_is_refused(image):
    with pytest.raises(P2SFError):
        CAMERA.photograph(image)


def test_a_photograph_needs_pixels():
    with pytest.raises(P2SFError):
        p2sf.Camera(LENS).photograph(np.zeros((4, 4, 3)))
