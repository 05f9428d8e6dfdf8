"""Why a method was chosen: from the choice's data, with nothing read back out of a sentence."""

import pytest

from p2sf.psf.methods import choose
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.method import chosen, reason
from p2sf_explorer.compute.setup import paraxial_setup, with_lens
from p2sf_explorer.state.state import State, changed, new_state

SHARP = new_state(method="auto", field_deg=0.0, f_number=16.0)
CORNER = changed(with_lens(State(), "double_gauss_28"), method="auto", field_deg=14.0, f_number=None, clip=True)


@pytest.mark.parametrize(
    ("state", "words"),
    [
        (SHARP, "seidel: six coefficients are enough, predicted R² ≥ "),
        (changed(SHARP, field_deg=10.0, f_number=8.0, tolerance=0.998), "fitted: "),
        (CORNER, "traced: exact rays, predicted R² ≥ "),
    ],
)
def test_the_reason_names_the_method_that_the_library_chose(state, words):
    setup = paraxial_setup(state)
    choice = choose(setup.lens, setup.source, state.optics.tolerance, state.optics.clip)
    assert str(reason(choice, state.optics.tolerance)).startswith(words)
    assert chosen(state, setup) == (choice.method, reason(choice, state.optics.tolerance))


def test_lost_rays_are_counted_in_the_reason():
    setup = paraxial_setup(CORNER)
    choice = choose(setup.lens, setup.source, CORNER.optics.tolerance, clip=True)
    said = reason(choice, CORNER.optics.tolerance)
    assert 0 < said.values["lost"] == choice.lost_rays < said.values["count"] == choice.tried_rays
    assert str(said).endswith(f"{choice.lost_rays} of {choice.tried_rays} rays are lost, and a smooth pupil does not "
                              "describe that")  # fmt: skip


def test_a_person_who_chose_is_given_no_reason():
    assert str(live(changed(SHARP, method="seidel"), "preview").why) == ""
