"""A result does not depend on what was asked before: the same states on another way, and in a fresh process."""

import subprocess
import sys
from math import inf

import numpy as np

from p2sf.lens.lens import with_aim
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.methods import PsfOptions, render

METHODS, STATES, WINDOW = ("seidel", "fitted", "traced"), 10, (24, 1.4)


def states() -> list[tuple]:
    """Return lenses, sources, methods and qualities of a random walk that comes back to some of its places."""
    rng, gauss = np.random.default_rng(29), find_lens("double_gauss_28")
    lenses = gauss, with_aim(gauss, "paraxial"), displaced(gauss, 3, 5, Placement(0.05, 0.02, 0.0, 0.1))
    found = []
    for number in range(STATES):
        source = Source(rng.choice([inf, 3000.0, rng.uniform(1500, 9000)]), field_deg=rng.uniform(0, 12))
        method = METHODS[number % 3]
        quality = rng.choice(["preview", "settled"])
        found += [(lens, source, method, str(quality)) for lens in lenses]
    return [*found, *found[: STATES // 2]]


def answers(order: np.ndarray) -> np.ndarray:
    """Return samples, Strehl ratio and energy of the states, asked in this order, (states, figures)."""
    asked, found = states(), {}
    for number in order:
        lens, source, method, quality = asked[number]
        psf = render(lens, source, method, *WINDOW, PsfOptions(quality))
        found[int(number)] = [*(psf.values / psf.values.max()).ravel(), psf.strehl, psf.energy]
    return np.array([found[number] for number in range(len(asked))], float)


def test_two_ways_to_a_state_agree_in_one_process_and_in_a_fresh_one(tmp_path):
    forwards = np.arange(len(states()))
    here = answers(np.random.default_rng(1).permutation(forwards))
    path = tmp_path / "fresh.npy"
    code = f"import numpy as np; from {__name__} import answers, states; "
    code += f"np.save({str(path)!r}, answers(np.arange(len(states()))))"
    subprocess.run([sys.executable, "-c", code], check=True)
    for there in (answers(forwards[::-1]), np.load(path)):
        np.testing.assert_allclose(there, here, rtol=0, atol=1e-12)
