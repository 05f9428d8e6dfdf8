"""Ideal lenses in the window: every panel answers, plain numbers meet the arrays' rays, arrows are painted."""

import numpy as np
import pytest

from p2sf.lens.lens import Lens, indices, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf.paraxial.first_order import image_distance
from p2sf.raytrace.pencil import pupil_rays, trace
from p2sf_explorer.compute.glass_outlines import glass_of, still
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.meridional import path
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.scene3d.meshes import elements
from p2sf_explorer.state.panels import REGISTRY, view_of
from p2sf_explorer.state.state import change
from tests.support.lenses.simple_lenses import two_thin_lenses


@pytest.fixture(scope="module")
def lens() -> Lens:
    made = two_thin_lenses()
    return with_sensor(made, float(image_distance(made, np.inf, made.reference_wavelength_um)))


def test_every_panel_answers(lens):
    state = change(default_state("lens", lens_to_toml(lens)), field_deg=5.0)
    found = live(state, views={entry.key: view_of(entry) for entry in REGISTRY if entry.view})
    assert float(np.asarray(found.psf.strehl)) == pytest.approx(1.0, abs=1e-6)
    assert found.views["lens"].found.beside[0]["aspheric"].short == (Message("ideal lens"),)


def test_plain_numbers_go_where_the_arrays_go(lens):
    wave, eta = lens.reference_wavelength_um, np.linspace(-1, 1, 5)
    rays = pupil_rays(lens, Source(500.0, 0.1, wave), np.zeros(5), eta)
    exact = trace(lens, rays.origins, rays.directions, wave)
    index = indices(lens, wave).tolist()
    origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
    for k in range(5):
        start, direction = (a[k, :0:-1].tolist() for a in (origins, directions))
        z, y, passed = path(lens, index, wave, start, direction)
        assert passed and np.allclose(np.stack([z, y]), exact.points[1:, k, :0:-1].T, rtol=0, atol=1e-11)


def test_they_are_drawn_by_their_sign_and_stand_in_space(lens):
    drawn = glass_of(still(lens)).ideal
    assert [(each.z, each.half, each.gathers) for each in drawn] == [(0.0, 9.0, True), (25.0, 8.0, False)]
    assert len(elements(still(lens))) == 2


def test_the_layout_paints_them(lens, window, qtbot):
    window.store.replace(default_state("lens", lens_to_toml(lens)))
    painted = window.panels["layout"].widget.grab().toImage()
    assert not painted.isNull()
