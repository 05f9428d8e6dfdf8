"""Figures of pupils whose rays arrive in parallel, and of blurs far wider than diffraction."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

import p2sf
from p2sf import Aperture, GeometryError, Lens, Source, Surface
from p2sf.lens.anamorphic import Biconic

PLATE = Lens((Surface(inf, 5.0, 1.5), Surface(inf, 50.0)), Aperture("stop_semi_diameter", 5.0), 1)
CYLINDER = Lens(
    (Surface(inf, 3.0, 1.5, shape=Biconic(radius_x=inf, radius_y=25.0)), Surface(inf, 48.0)),
    Aperture("stop_semi_diameter", 5.0),
    1,
)


@pytest.mark.parametrize("field_deg", [0.0, 10.0])
@pytest.mark.parametrize("figure", ["mtf", "energy", "line_spread"])
@pytest.mark.parametrize("method", ["traced", "fitted", "auto", "huygens"])
def test_a_pupil_without_focus_is_refused_in_words(figure, method, field_deg):
    """A plate bends no parallel light, and its plane waves have no limit; rounding leaves some 1e-16 at 10°."""
    with pytest.raises(GeometryError, match="no focus"):
        getattr(p2sf.Camera(PLATE).at(Source(field_deg=field_deg)), figure)(method=method)


def test_no_method_is_chosen_for_a_pupil_without_focus():
    with pytest.raises(GeometryError, match="no focus"):
        p2sf.Camera(PLATE).at(Source()).choose_method()


@pytest.mark.parametrize("figure", ["mtf", "energy", "line_spread"])
def test_a_cylinder_is_refused_where_it_has_no_power(figure):
    with pytest.raises(GeometryError, match="along one axis"):
        getattr(p2sf.Camera(CYLINDER).at(Source()), figure)()


def test_a_wide_line_spread_is_that_of_its_disc_at_its_own_positions():
    """Through the plate a point at 100 mm lights a disc of radius R: 2√(R² − x²)/(πR²) across, by plane geometry.

    The slopes are 0.02 of 1, so that the disc is even to 0.1 %; ripples of diffraction are averaged out. Beyond
    the disc it leaves some λ/(2π²·NA·x), 1e-4.
    """
    found = p2sf.Camera(replace(PLATE, aperture=Aperture("stop_semi_diameter", 2.0))).at(Source(100.0)).line_spread()
    sine = 2 / np.hypot(2, 100)
    inside = sine / 1.5
    radius = 1000 * (2 + 5 * inside / np.sqrt(1 - inside**2) + 50 * sine / np.sqrt(1 - sine**2))
    middle = np.abs(found.position_um) < 0.5 * radius
    own = 2 * np.sqrt(radius**2 - found.position_um[middle] ** 2) / (np.pi * radius**2)
    assert found.line_x[middle].mean() == pytest.approx(own.mean(), rel=0.01)
    assert found.edge_x[0] == pytest.approx(0, abs=2e-4) and found.edge_x[-1] == pytest.approx(1, abs=2e-4)
