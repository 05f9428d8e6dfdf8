"""The state's setup is the library's own, by one road, and dragging the field makes no new lens."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import P2SFError
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lensfile.library import find_lens, load_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.paraxial.seidel import coefficients
from p2sf.setting import Request, set_up
from p2sf_explorer.compute.editing import best_focused
from p2sf_explorer.compute.layout import layout
from p2sf_explorer.compute.setup import (
    default_state,
    paraxial_setup,
    prescription,
    ranges,
    request_setup,
    with_lens,
    with_state_mask,
)
from p2sf_explorer.state.state import State, change, entry, new_state

STATES = [
    new_state(field_deg=10.0),
    new_state(depth_mm=2000.0, field_deg=-3.0, focus_mm=900.0, sensor_shift_um=12.0, f_number=5.6, wavelength_nm=486.1),
    change(with_lens(State(), "relay"), field_deg=1.5, stop="auto"),
    new_state(aim="stop"),
    new_state(aim="paraxial"),
]


@pytest.mark.parametrize("state", STATES, ids=["as filed", "all of it", "relay", "stop", "paraxial"])
def test_the_setup_is_what_the_library_sets_up_for_the_same_request(state):
    names = ("depth_mm", "field_deg", "wavelength_nm", "focus_mm", "sensor_shift_um", "f_number", "stop", "aim")
    expected = set_up(prescription(state), Request(**{name: entry(state, name) for name in names}))
    found = paraxial_setup(state)
    assert (found.lens, found.source) == (expected.lens, expected.source)
    assert (request_setup(state).lens, request_setup(state).source) == (expected.lens, expected.source)
    assert request_setup(state).field_deg == pytest.approx(state.optics.field_deg)


def test_dragging_the_field_makes_no_new_lens():
    near, far = (paraxial_setup(change(STATES[0], field_deg=field)) for field in (1.0, 2.0))
    assert near.lens is far.lens and near.rays is far.rays and near.source != far.source


def test_a_field_that_cannot_be_is_the_librarys_refusal():
    with pytest.raises(P2SFError, match="90°"):
        paraxial_setup(new_state(field_deg=90.0))


FILED = PupilMask(obscuration=0.3, vanes=4, zernike_um=(0.0, 0.0, 0.0, 0.1))


def with_filed_mask(**entries):
    """Return a state whose lens file has a mask in its stop."""
    lens = with_mask(prescription(State()), FILED)
    return new_state(lens_text=lens_to_toml(lens), **entries)


def test_the_mask_is_the_files_but_for_what_the_state_says_of_it():
    state = with_filed_mask()
    assert prescription(state).mask == FILED == ranges(prescription(state)).mask
    assert with_state_mask(prescription(state), state).mask == FILED
    told = change(state, obscuration=0.5, blades=6)
    assert with_state_mask(prescription(told), told).mask == replace(FILED, obscuration=0.5, blades=6)
    cleared = change(state, obscuration=0.0, vanes=0)
    assert with_state_mask(prescription(cleared), cleared).mask == replace(FILED, obscuration=0.0, vanes=0)


def test_a_mask_moves_with_every_lens_that_the_state_makes_and_leaves_with_the_lens():
    state = new_state(obscuration=0.4, f_number=5.6, focus_mm=900.0)
    assert request_setup(state).lens.mask == PupilMask(obscuration=0.4)
    assert not with_lens(state, "cooke_triplet").optics.mask


def test_dragging_the_field_behind_a_mask_makes_no_new_lens():
    near, far = (request_setup(new_state(blades=6, field_deg=field)) for field in (1.0, 2.0))
    assert near.lens is far.lens


def test_the_layout_draws_what_the_mask_covers_at_the_stop():
    state = new_state(obscuration=0.4)
    shown = layout(paraxial_setup(state)).drawing
    assert shown.dark == ((pytest.approx(-0.4 * shown.stop_rim), pytest.approx(0.4 * shown.stop_rim)),)
    assert not layout(paraxial_setup(new_state())).drawing.dark


def test_the_f_number_slider_ends_where_the_achromats_crown_has_an_edge():
    """By hand: two spheres 0.434 mm apart meet at the height of the beam of f/4.91; f/6 leaves both an edge."""
    low, _ = ranges(find_lens("achromat_f6")).f_number
    height = 20.0037 / (2 * low)
    front, back = (radius - np.sqrt(radius**2 - height**2) for radius in (12.38401, 7.9414))
    assert front + back == pytest.approx(0.434, abs=0.003) and front + back < 0.434
    assert ranges(find_lens("double_gauss_28")).f_number[0] == pytest.approx(3 / 1.4, rel=0.001)


def test_a_lens_that_is_not_symmetric_opens_at_a_field_of_its_file():
    """Its field of −5° is not that of +5°, and one along x is marked there."""
    path = Path(__file__).parents[2] / "data" / "import" / "tilted_fields.zmx"
    state = default_state(str(path))
    assert (state.optics.field_x_deg, state.optics.field_deg) == (0.0, -5.0)
    assert ranges(load_lens(path)).stated_deg == ((3.0, 0.0), (0.0, -5.0), (0.0, 5.0))


@pytest.mark.parametrize(("name", "f_number"), [("landscape", 8.0), ("double_gauss_28", 4.0)])
def test_an_edited_lens_is_refocused_where_defocus_balances_its_spherical_aberration(name, f_number):
    """On the axis the RMS of W40ρ⁴ + Wρ² is least for W = −W40 (Mahajan 1991, §8.3)."""
    state = change(with_lens(new_state(method="seidel"), name), f_number=f_number, field_deg=0.0)
    lens = with_f_number(best_focused(state, prescription(state))[1], f_number)
    c = coefficients(lens, np.inf, 0.0, lens.reference_wavelength_um)
    assert float(c.w20 + c.wd) == pytest.approx(-float(c.w40), rel=1e-4) and abs(float(c.w40)) > 1
