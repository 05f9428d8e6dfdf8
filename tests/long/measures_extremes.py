"""MTF, energy and pictures at the extremes, both ways to fill the pupil: ``python -m tests.long.measures_extremes``.

Every case of the extremes' sweep over aperture, depth and field: measures that keep every law, or a sentence; a picture
without NaN, or a sentence. Prints how many of each there are per regime, and what broke a law.
"""

from collections import Counter

import numpy as np

from p2sf.errors import P2SFError
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.psf.methods import render
from tests.extremes.regimes import Case
from tests.extremes.test_measures_extremes import AIMS, NAMED, SWEPT, outcome_of


def picture(case: Case, aim: str) -> str:
    """Return whether a case has a picture; AssertionError where that has a NaN."""
    source = Source(case.depth, case.slope, case.wavelength)
    try:
        psf = render(with_aim(case.lens, aim), source, method="fitted", pixels=16)
    except P2SFError:
        return NAMED
    assert np.isfinite(psf.values).all()
    return "picture"


def main() -> None:
    """Try every case and print the table."""
    seen: Counter = Counter()
    for case in SWEPT:
        for aim in AIMS:
            for what, trial in (("measures", outcome_of), ("picture", picture)):
                try:
                    found = trial(case, aim)
                except (AssertionError, ValueError, ArithmeticError) as fault:
                    found = "BROKEN"
                    print(f"{case} {aim} {what}: {type(fault).__name__} {fault}"[:300], flush=True)
                seen[case.regime, aim, what, found] += 1
    for key, count in sorted(seen.items()):
        print(*key, count, sep=" | ")
    raise SystemExit(any(found == "BROKEN" for *_, found in seen))


if __name__ == "__main__":
    main()
