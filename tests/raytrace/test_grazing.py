"""Rays at grazing incidence: through a concentric ball, whose rays are those of the axis seen from another side."""

from math import inf

import numpy as np
import pytest

import p2sf
from p2sf import Aperture, Lens, Source, Surface
from p2sf.raytrace.trace import trace

INDEX, UM, FAR = 1.5, 0.5, 40.0
BALL = Lens(
    (Surface(10.0, 10.0, INDEX), Surface(inf, 10.0, INDEX), Surface(-10.0, 20.0)),
    Aperture("stop_semi_diameter", 1.0),
    2,
    sensor_radius=-30.0,
)
OFFSETS = np.array([[0.0, 0.0], [0.4, 0.0], [0.0, 0.004], [-0.3, -0.002], [0.9, 0.003]])
"""Of rays from the chief ray, mm: within a stop that is seen almost from the side."""


def own_path(offset: float) -> tuple[float, float]:
    """Return path and angle at the centre of a ray through the ball to the sphere of radius 30 mm, at a height.

    By plane trigonometry: deviations at both surfaces and chords, from a plane FAR before the centre.
    """
    outside, inside = np.arcsin(offset / 10), np.arcsin(offset / 10 / INDEX)
    at_sensor = np.arcsin(offset / 30)
    before, within = FAR - 10 * np.cos(outside), 20 * np.cos(inside)
    behind = 30 * np.cos(at_sensor) - 10 * np.cos(outside)
    # Angles at the centre from where the light comes: to the entry, through the ball, and on to the sensor.
    turned = (np.pi - outside) - (np.pi - 2 * inside) - (outside - at_sensor)
    return before + INDEX * within + behind, turned


@pytest.mark.parametrize("field_deg", [0.0, 60.0, 89.0, 89.8, 89.9, 89.95])
def test_rays_through_a_ball_are_the_same_from_every_side(field_deg):
    """Positions and paths to 1e-10 mm: the plane of a vertex is met up to 2e5 mm away, which rounding is a share of."""
    turn = np.deg2rad(field_deg)
    ahead, up, across = np.array([[0, np.sin(turn), np.cos(turn)], [0, np.cos(turn), -np.sin(turn)], [1, 0, 0]])
    centre = np.array([0.0, 0.0, 10.0])
    origins = centre - FAR * ahead + OFFSETS[:, :1] * across + OFFSETS[:, 1:] * up
    found = trace(BALL, origins, np.broadcast_to(ahead, origins.shape), UM)
    height = np.hypot(*OFFSETS.T)
    path, angle = np.array([own_path(h) for h in height]).T
    aside = (OFFSETS[:, :1] * across + OFFSETS[:, 1:] * up) / np.maximum(height, 1e-300)[:, None]
    landing = centre + 30 * (np.cos(angle)[:, None] * ahead + np.sin(angle)[:, None] * aside)
    assert not found.status.any()
    np.testing.assert_allclose(found.points[4], landing, atol=1e-10)
    np.testing.assert_allclose(found.path, path, atol=1e-10)


def test_the_wavefront_at_grazing_fields_tends_to_a_limit():
    """The stop's width is as the cosine of the field: what is left of RMS to its limit falls with the cosine squared.

    The tolerance is that of the rays, 1e-10 mm or 2e-7 waves, of 19 waves.
    """
    cosines = np.cos(np.deg2rad([80.0, 89.8, 89.9]))
    wide, near, nearer = (
        p2sf.Camera(BALL).at(Source(field_slope=np.sqrt(1 / c**2 - 1), wavelength_um=UM)).zernike().rms for c in cosines
    )
    limit = wide + (nearer - wide) * cosines[0] ** 2 / (cosines[0] ** 2 - cosines[2] ** 2)
    assert near == pytest.approx(limit - (limit - wide) * (cosines[1] / cosines[0]) ** 2, abs=1e-5)
