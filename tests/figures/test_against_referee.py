"""MTF and energy against the referee's dense sums, in some states; all of them are `tests.long.mtf_and_energy`."""

from itertools import product

import pytest

from tests.long.mtf_and_energy import states, truth, verdict
from tests.support.tiers import in_tiers

STATES = (  # slopes of 0.4 to 35 waves per radius, on the axis and beside it, at infinity and near
    "cooke_triplet 20° inf mm full as focused",
    "double_gauss_28 14° inf mm down autofocused",
    "eye_navarro 15° 250 mm full as focused",
    "wide_angle_35 0° inf mm full as focused",
    "telephoto 10° inf mm full autofocused",
    "tessar 20.5° 60 mm full autofocused",
)


@pytest.mark.parametrize(
    ("name", "aim"),
    in_tiers([*product(STATES, ["stop", "paraxial"])], [*product(STATES, ["stop"]), (STATES[0], "paraxial")]),
)
def test_mtf_and_energy_are_the_referees(name, aim):
    state = next(state for state in states(aim, (name.split()[0],)) if state.name == name)
    found = verdict(state, truth(state))
    assert found.good, found
