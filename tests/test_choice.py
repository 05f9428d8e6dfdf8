"""The cheapest that suffices is found, and nothing is worked out that need not be known for it."""

import pytest

from p2sf.choice import first_allowed, first_within


@pytest.mark.parametrize(("allowed", "found"), [(0.5, ("a", 0.5)), (0.3, ("b", 0.2)), (0.1, ("c", 0.15))])
def test_the_first_within_is_taken_or_else_the_last(allowed, found):
    asked = []

    def candidates():
        for name, error in (("a", 0.5), ("b", 0.2), ("c", 0.15)):
            asked.append(name)
            yield name, error

    assert first_within(candidates(), allowed) == found
    assert asked[-1] == found[0]  # what comes after it is not asked for


@pytest.mark.parametrize("start", [0, 2])
def test_the_first_allowed_choice_holds_at_every_place_in_any_order(start):
    """Errors that fall as 1/size, not as its square: the law only guides the search."""
    asked = []
    places = [1.0, 2.0, 8.0, 3.0]

    def measure(tries):
        asked.append(tries)
        return [places[k] / (number + 1) for number, k in tries]

    assert first_allowed(range(1, 6), measure, 4, 2.0, start) == (3, 2.0)
    tried = [pair for tries in asked for pair in tries]
    assert len(set(tried)) == len(tried)  # nothing is measured twice
    assert first_allowed(range(1, 3), measure, 4, 2.0) == (1, 4.0)  # none holds: the last, with its own largest error


def test_by_the_law_of_errors_few_choices_are_tried():
    sizes = range(1, 200)
    for first in range(1, 200, 7):
        asked = []

        def measure(tries, first=first, asked=asked):
            asked.extend(tries)
            return [(first / sizes[number]) ** 2 for number, _ in tries]

        assert first_allowed(sizes, measure, 1, 1.0, 3) == (first - 1, 1.0)
        assert len(asked) <= 3


def test_the_first_of_choices_is_found_whatever_their_errors():
    for first in range(16):

        def measure(tries, first=first):
            return [1.0 if number < first else 0.0 for number, _ in tries]

        assert first_allowed(range(1, 17), measure, 1, 0.5, 3)[0] == first
