"""A damaged lens file gives a lens or an error with its line; ``python -m tests.long.damaged_files`` tries more."""

import pytest

from tests.long.damaged_files import SAMPLES, attempt


@pytest.mark.slow
@pytest.mark.parametrize("name", SAMPLES)
def test_damage_ends_in_a_lens_or_a_sentence(name):
    results = attempt(name, 200)
    assert set(results) == {"lens", "refused"}  # both happen, or the damage is too mild or too strong to test anything
