"""Conversion and checks of arguments: quantities with a unit, masked arrays, lists for tuples, non-numbers."""

import os
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import lru_cache, wraps
from inspect import Parameter, Signature, signature
from numbers import Real
from types import NoneType, UnionType
from typing import Any, TypeVar, Union, cast, get_args, get_origin

import numpy as np
from numpy.typing import ArrayLike

from p2sf.errors import RequestError
from p2sf.messages import Alternatives

UNITS = (("_per_mm", "1/mm"), ("_mm", "mm"), ("_um", "um"), ("_nm", "nm"), ("_deg", "deg"))
"""Endings of parameters, the longer ones first, and their units as astropy and pint write them."""
LENGTHS = frozenset(
    "radius thickness semi_diameter inner_radius ideal_focal_length decentre_x decentre_y decentre_z pivot".split()
)
"""Lengths of a lens, mm, whose names have no unit; whatever else has none is a plain number."""
NUMBERS = (float, int, Real)  # looking up the first two is ten times as fast
CLASSES = {float: NUMBERS, int: NUMBERS, bool: (bool, np.bool_), None: NoneType}
"""Types accepted for an annotation; whether a count is an integer is checked where it is used."""
PLAIN = frozenset((float, int, bool, str, NoneType))
WANTED = {
    **dict.fromkeys(("float", "int", "Real"), "a number"),
    **dict.fromkeys(("bool", "bool_"), "True or False"),
    "str": "a text",
    "tuple": "a tuple",
    "Aperture": "a p2sf.Aperture or an f-number",
    "CameraData": "a p2sf.Camera",
    "PathLike": "a path",
    "Lens": "what p2sf.load_lens returns",
    "Plan": "what p2sf.plan returns",
    "PsfData": "what p2sf.render returns",
    "Shape": "a shape, such as p2sf.lens.freeform.XYPolynomial",
}

Function = TypeVar("Function", bound=Callable[..., Any])
Kinds = tuple[type, ...]


def check_arguments(function: Function) -> Function:
    """Decorate a function so that `argument` converts and checks its arguments.

    Its signature is shown without types, which the docstring states in words: ``ArrayLike`` alone takes five lines.
    """
    own = signature(function)
    kinds = {name: each.annotation for name, each in own.parameters.items()}

    @wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        given = [argument(name, value, kinds[name]) for name, value in zip(kinds, args, strict=False)]
        named = {name: argument(name, value, kinds.get(name, Any)) for name, value in kwargs.items()}
        return function(*given, *args[len(kinds) :], **named)

    plain = [each.replace(annotation=Parameter.empty) for each in own.parameters.values()]
    call.__signature__ = Signature(plain)  # type: ignore[attr-defined]
    return cast("Function", call)


def check_fields(instance: Any) -> None:
    """Convert the fields of a frozen dataclass by `argument`; raises RequestError as it does."""
    for name, annotation, allowed, parts in _fields(cast("Any", type(instance))):
        value = getattr(instance, name)
        if all(type(part) in parts for part in value) if type(value) is tuple else type(value) in allowed:
            continue
        own = argument(name, value, annotation)
        if own is not value:
            object.__setattr__(instance, name, own)


@lru_cache(maxsize=64)
def _fields(kind: Any) -> tuple[tuple[str, Any, Kinds, Kinds], ...]:
    """Return the fields of a dataclass that can be checked.

    Each has its name and annotation, and the classes of values and of the items of tuples that need no conversion.
    """
    known = ((field.name, field.type, *_kinds(cast("Any", field.type))) for field in fields(kind))
    return tuple(
        (name, annotation, _unconverted(kinds), () if part is None else _unconverted(_kinds(part)[0]))
        for name, annotation, kinds, part in known
        if kinds
    )


def _unconverted(kinds: Kinds) -> Kinds:
    """Return the classes without tuples, whose items are converted one by one."""
    return tuple(set(kinds) - {tuple})


def argument(name: str, value: Any, annotation: Any) -> Any:
    """Return the value of a parameter without its unit, as a tuple if the annotation is one.

    Raises RequestError for a value of a type that the annotation excludes; whatever the annotation allows passes.
    """
    kinds, part = _kinds(annotation)
    if part is not None and not isinstance(value, str) and not (value is None and NoneType in kinds):
        return _tuple_of(name, value, part)
    if isinstance(value, kinds or object) and (type(value) in PLAIN or not _has_unit(value)):
        return value
    value = in_own_unit(name, value)
    if isinstance(value, np.ndarray) and not value.ndim and Real in kinds and np.ndarray not in kinds:
        value = value.item()
    if not isinstance(value, kinds or object):
        raise RequestError(
            "{parameter} is {value}; give {wanted}",
            parameter=name,
            value=f"{value!r:.60}",
            wanted=Alternatives(dict.fromkeys(_kind_words(kind) for kind in kinds if kind is not NoneType)),
        )
    return value


def _kind_words(kind: type) -> str:
    import p2sf

    public = kind.__name__ in p2sf.__all__
    return WANTED.get(kind.__name__, f"a {'p2sf' if public else kind.__module__}.{kind.__name__}")


@lru_cache(maxsize=256)
def _kinds(annotation: Any) -> tuple[Kinds, Any]:
    """Return the classes that an annotation allows, and the annotation of a tuple's items (None for other types).

    No classes if the annotation cannot be expressed by classes, such as arrays or choices.
    """
    origin = get_origin(annotation)
    if origin in (Union, UnionType):
        members = [_kinds(part) for part in get_args(annotation) if part is not NoneType]
        kinds = tuple(kind for each, _ in members for kind in each) + (NoneType,) * (NoneType in get_args(annotation))
        return (kinds, members[0][1] if len(members) == 1 else None) if all(each for each, _ in members) else ((), None)
    kind = CLASSES.get(annotation, annotation if origin is None else origin)
    several = kind if isinstance(kind, tuple) else (kind,)
    usable = all(isinstance(each, type) and not getattr(each, "_is_protocol", False) for each in several)
    usable = usable and annotation not in (Any, Parameter.empty) and origin in (None, tuple, os.PathLike)
    return several if usable else (), get_args(annotation)[0] if origin is tuple else None


def _tuple_of(name: str, value: Any, annotation: Any) -> tuple[Any, ...]:
    """Return a tuple, list, array or other collection as a tuple of items converted by `argument`."""
    value = in_own_unit(name, value)
    try:
        parts = iter(value.tolist() if isinstance(value, np.ndarray) else value)
    except TypeError:
        raise RequestError("{parameter} is {value}; give a tuple", parameter=name, value=f"{value!r:.60}") from None
    return tuple(argument(name, part, annotation) for part in parts)


def in_own_unit(name: str, value: Any) -> Any:
    """Return a quantity of astropy or pint as a number in the unit of the parameter; plain values are unchanged.

    Lists and tuples of quantities are converted item by item; an array of xarray has its unit in an attribute. Raises
    RequestError for a quantity of another dimension, such as a time for a length, and for one that cannot be converted.
    """
    if isinstance(value, list | tuple) and any(_has_unit(part) for part in value):
        return type(value)(in_own_unit(name, part) for part in value)
    if not _has_unit(value):
        return value
    unit = "mm" if name in LENGTHS else next((unit for ending, unit in UNITS if name.endswith(ending)), "")
    try:
        found = _in_unit(value, unit)
    except (AttributeError, TypeError, ValueError):  # from another package, or neither length nor angle
        raise RequestError(
            "{parameter} is {value}; give a number without a unit, in {unit}",
            parameter=name,
            value=f"{value!s:.40}",
            unit=unit or "the unit that the documentation states",
        ) from None
    return found if np.ndim(found) else float(found)


def _in_unit(value: Any, unit: str) -> Any:
    """Return the number of a quantity in a unit; AttributeError, TypeError or ValueError where it has none."""
    if hasattr(value, "to_value"):  # of astropy
        return value.to_value(unit)
    if isinstance(value.units, str):  # an array of xarray
        if value.units != unit:
            raise ValueError(value.units)
        return np.asarray(value)
    return value.to(unit or "dimensionless").magnitude


def _has_unit(value: object) -> bool:
    return hasattr(value, "unit") or hasattr(value, "units")


def real_array(name: str, values: ArrayLike, masked: float = np.nan) -> np.ndarray:
    """Return values as an array of float64, with ``masked`` in place of the masked items of a masked array.

    Raises RequestError for complex numbers and for values that do not form an array of numbers.
    """
    values = in_own_unit(name, values)
    try:
        given = np.ma.asarray(values) if np.ma.isMaskedArray(values) else np.asarray(values)
    except ValueError:  # rows of different lengths
        given = np.asarray(None)
    if given.dtype.kind not in "biuf":
        raise RequestError(
            "{parameter} holds {kind}; give real numbers",
            parameter=name,
            kind="complex numbers" if given.dtype.kind == "c" else "values that are not an array of numbers",
        )
    numbers: np.ndarray = np.ma.filled(given.astype(float), masked)
    return numbers


def first_place(wrong: np.ndarray) -> dict[str, Any]:
    """Return ``row`` and ``column``, from 0, of the first item of (rows, columns, …) that is True, and their ``count``.

    As values of a message, so that nobody has to search a picture for it.
    """
    at = np.unravel_index(int(wrong.argmax()), wrong.shape)
    return {"row": int(at[0]), "column": int(at[1]) if len(at) > 1 else 0, "count": int(np.count_nonzero(wrong))}


def number_list(name: str, values: ArrayLike, infinite: bool = False) -> np.ndarray:
    """Return one or several finite numbers as an array (n,); raises RequestError for anything else."""
    numbers = np.atleast_1d(real_array(name, values))
    possible = ~np.isnan(numbers) if infinite else np.isfinite(numbers)
    if numbers.ndim > 1 or not possible.all():
        raise RequestError(
            "{parameter} has the shape {shape} or contains values that are not finite; "
            "give one number or a list of numbers",
            parameter=name,
            shape=str(numbers.shape),
        )
    return numbers


def same_values(one: object, other: object) -> bool:
    """Return whether two instances of a dataclass have equal fields, arrays where all their numbers are equal.

    The ``__eq__`` of first-order results, which are numbers of one place or arrays over many: the generated one asks
    an array whether it is true. A dataclass that always holds arrays is equal to itself alone (``eq=False``).
    """
    if type(one) is not type(other) or not is_dataclass(one):
        return False
    return all(np.array_equal(getattr(one, each.name), getattr(other, each.name)) for each in fields(one))
