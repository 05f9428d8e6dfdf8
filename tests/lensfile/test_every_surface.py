"""Random systems of every kind of surface come back from .toml, .zmx and .seq with the same rays.

`tests.long.round_trips` does the same with a hundred systems of each kind, and with the shipped lenses.
"""

import pytest

from p2sf.errors import LensFileError
from tests.long.round_trips import CLOSE_MM, WRITERS, apart_mm, read_again
from tests.support.lenses.every_surface import KINDS, rays, system_of

REFUSED = {("Qbfs", ".seq"), ("ideal lens", ".seq")}  # which CODE V has no line for


@pytest.mark.parametrize("ending", WRITERS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_file_holds_the_same_rays_or_names_the_surface(kind, ending):
    for seed in (0, 1):  # with a mirror and without
        lens = system_of(kind, seed)
        if (kind, ending) in REFUSED:
            with pytest.raises(LensFileError) as refusal:
                read_again(lens, ending)
            assert refusal.value.message.values["surface"] == 2
            continue
        assert apart_mm(lens, read_again(lens, ending), *rays(seed)) < CLOSE_MM
