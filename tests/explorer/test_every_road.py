"""One point of `tests.long.every_road`: every road says what the referee finds."""

from math import inf

import pytest

from tests.long.every_road import rows, truth, written_rows
from tests.support.lenses.rewritten import WAYS
from tests.support.roads import Point, Window

EVERYWHERE = "1 − R²", "R80", "S1", "T1", "S2", "T2"


@pytest.fixture
def panels(qapp):
    made = Window()
    yield made
    made.close()


def test_every_road_says_what_the_referee_finds(panels):
    at = Point("cooke_triplet", inf, 14.0)
    lines = list(rows(at, *truth(at), panels, methods=("traced",)))
    assert {line.figure for line in lines} >= set(EVERYWHERE)
    assert [str(line) for line in lines if line.figure in EVERYWHERE and line.faults] == []


@pytest.mark.parametrize("name", ["cooke_triplet", pytest.param("cassegrain_f10", marks=pytest.mark.slow)])
def test_the_same_optics_written_in_other_ways_have_the_same_figures(name):
    assert [str(line) for line in written_rows(name, (0.7,), WAYS[1::2]) if line.faults] == []
