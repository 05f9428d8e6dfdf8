"""The state's setup is the library's own, by one road, and dragging the field makes no new lens."""

import pytest

from p2sf.errors import P2SFError
from p2sf.request import Request, set_up
from p2sf_explorer.compute.setup import paraxial_setup, prescription, request_setup, with_lens
from p2sf_explorer.state.state import State, changed, entry, new_state

STATES = [
    new_state(field_deg=10.0),
    new_state(depth_mm=2000.0, field_deg=-3.0, focus_mm=900.0, sensor_shift_um=12.0, f_number=5.6, wavelength_nm=486.1),
    changed(with_lens(State(), "relay"), field_deg=1.5, stop="auto"),
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
    near, far = (paraxial_setup(changed(STATES[0], field_deg=field)) for field in (1.0, 2.0))
    assert near.lens is far.lens and near.rays is far.rays and near.source != far.source


def test_a_field_that_cannot_be_is_the_librarys_refusal():
    with pytest.raises(P2SFError, match="90°"):
        paraxial_setup(new_state(field_deg=90.0))
