"""The benchmark of all states measures one by one what it says, on a single state."""

import subprocess
import sys

import pytest

pytest.importorskip("resource")

from tests.benchmarks.states import State, states


def test_the_states_of_a_lens_are_all_and_in_short_form_four():
    names = ["achromat_f6"]
    every, quick = list(states(names)), list(states(names, quick=True))
    assert len(set(every)) == len(every) == 3 * 2 * 9 * 2 and set(quick) < set(every) and len(quick) == 4


def test_a_state_is_computed_in_a_process_of_its_own_within_limits():
    """One that is done, one that is refused, and one that asks for more memory than it may have."""
    state = State("achromat_f6", 5.0, float("inf"), "psf auto", False)
    program = f"""
from dataclasses import replace
from tests.benchmarks import states
state = states.{state!r}
states.WORKS["list"] = lambda *given: bytearray(10**9)
far, list_ = replace(state, work="psf fitted", field_deg=89.0), replace(state, work="list")
for one, most_gb in ((state, 8), (far, 8), (list_, 1)):
    cost = states.cost_of(one, 20, most_gb)
    print(cost.end.split(":")[0], cost.seconds < 20 and 10 < cost.peak_mb < 1000)
""".replace("inf", "float('inf')")
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["done True", "refused True", "out of memory True"]
