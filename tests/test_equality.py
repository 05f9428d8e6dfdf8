"""Whatever holds arrays can be compared: `==` of two results is True or False, never an error of numpy."""

import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator
from copy import copy
from dataclasses import fields, is_dataclass

import numpy as np
import pytest

import p2sf
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients


def with_arrays() -> Iterator[type]:
    """Yield the frozen dataclasses of the core of which a field is annotated as an array, or may hold some."""
    for found in pkgutil.walk_packages(p2sf.__path__, "p2sf."):
        if found.name.endswith("__main__"):
            continue
        module = importlib.import_module(found.name)
        for _, each in inspect.getmembers(module, inspect.isclass):
            own = each.__module__ == found.name and is_dataclass(each)
            if own and each.__dataclass_params__.frozen and any(map(is_array, fields(each))):
                yield each


def is_array(field) -> bool:
    return "ndarray" in str(field.type)


CLASSES = list(with_arrays())


def filled(kind: type, numbers: np.ndarray) -> object:
    """Return an instance whose arrays are these, made without the checks of its own."""
    made = object.__new__(kind)
    for field in fields(kind):
        value: object = numbers.copy() if is_array(field) else "a"
        if re.search(r"(Mapping|dict)\[", str(field.type)):
            value = {"a": (("x",), value)}  # dims and values, as of `NamedArrays`
        elif "tuple[" in str(field.type):
            value = value, value
        object.__setattr__(made, field.name, value)
    return made


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: f"{kind.__module__}.{kind.__name__}")
def test_two_results_with_arrays_compare_as_true_or_false(kind):
    one, equal, other = filled(kind, np.arange(3.0)), filled(kind, np.arange(3.0)), filled(kind, np.arange(4.0))
    assert (one == one) is True and (one == other) is False and (one == "a") is False
    assert (one == equal) in (True, False) and (one == copy(one)) in (True, False)


def test_most_classes_with_arrays_are_found_by_their_annotations():
    assert len(CLASSES) > 100


def test_first_order_results_of_one_place_compare_by_their_numbers():
    lens = find_lens("cooke_triplet")

    def six(depth_mm):
        return coefficients(lens, depth_mm, 0.1, 0.55)

    both = np.array([1000, np.inf])
    assert six(1000.0) == six(1000.0) != six(np.inf)
    assert six(both) == six(both) and six(both) != six(1000.0) and six(both) != six(both[::-1])
