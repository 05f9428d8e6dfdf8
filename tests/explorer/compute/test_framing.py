"""The circle of the light, against sums of its own, and the frame that follows it."""

import numpy as np
import pytest

from p2sf_explorer.compute.framing import FILLED, KEPT, SHARE, Circle, crop, frame_of, light_circle

COUNT, PITCH = 128, 0.5


def disc(x: float, y: float, radius: float) -> np.ndarray:
    """Return a uniform disc, rows +y, sampled `PITCH` apart about sample N//2."""
    at = PITCH * (np.arange(COUNT) - COUNT // 2)
    return (np.hypot(at - x, (at - y)[:, None]) <= radius).astype(float)


@pytest.mark.parametrize(("x", "y", "radius"), [(0.0, 0.0, 20.0), (6.0, -9.0, 15.0), (-4.5, 2.5, 9.0)])
def test_a_uniform_disc_holds_its_share_within_its_root(x, y, radius):
    circle = light_circle(disc(x, y, radius), PITCH, 0.0)
    assert (circle.x_um, circle.y_um) == pytest.approx((x, y), abs=PITCH / 10)
    assert circle.radius_um == pytest.approx(SHARE**0.5 * radius, abs=PITCH)


def test_the_circle_is_that_of_the_picture_however_finely_it_is_sampled():
    fine = np.kron(disc(3.0, 1.0, 12.0), np.ones((4, 4)))
    coarse, finely = light_circle(disc(3.0, 1.0, 12.0), PITCH, 0.0), light_circle(fine, PITCH / 4, 0.0)
    assert finely.radius_um == pytest.approx(coarse.radius_um, abs=PITCH)


def test_a_point_is_shown_with_its_airy_disc():
    assert light_circle(disc(0.0, 0.0, 0.1), PITCH, 8.0).radius_um == 12.0
    assert light_circle(np.zeros((8, 8)), PITCH, 8.0).radius_um == 12.0


@pytest.mark.parametrize("radius", np.geomspace(0.3, 3000.0, 40))
def test_the_frame_holds_the_circle_and_is_filled_by_it(radius):
    circle = Circle(0.37 * radius, -1.3 * radius, radius)
    frame = frame_of(circle)
    away = np.hypot(circle.x_um - frame.x_um, circle.y_um - frame.y_um)
    assert 0.67 <= radius / frame.half_um <= FILLED + 1e-9 and away + radius <= 0.86 * frame.half_um


def test_a_small_change_seldom_moves_the_frame():
    frames = {frame_of(Circle(0.01 * k, 0.0, 10.0 + 0.02 * k)) for k in range(100)}
    assert len(frames) <= 5


def test_while_a_slider_moves_the_frame_stays_as_long_as_the_circle_is_well_within_it():
    kept, frames = None, []
    for radius in np.geomspace(10.0, 40.0, 200):
        kept = frame_of(Circle(0.0, 0.0, radius), kept)
        frames.append(kept)
        assert KEPT[0] <= radius / kept.half_um <= KEPT[1]
    assert len(set(frames)) <= 1 + np.ceil(np.log(4.0) / np.log(KEPT[1] / FILLED))
    back = frame_of(Circle(0.0, 0.0, 30.0), kept)
    assert back is kept, "and a smaller one is no reason to move it"
    assert frame_of(Circle(kept.half_um, 0.0, 30.0), kept) != kept


def test_pictures_beside_each_other_are_cut_alike_to_the_widest():
    pictures = np.array([disc(0.0, 0.0, 5.0), disc(4.0, 0.0, 10.0), np.full((COUNT, COUNT), np.nan)])
    shown = crop(pictures)
    half = (shown.stop - shown.start) / 2 * PITCH
    assert 0.7 <= (4.0 + SHARE**0.5 * 10.0) / half <= 0.8
    assert (shown.start + shown.stop) / 2 == COUNT // 2
