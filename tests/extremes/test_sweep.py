"""The program in float64 against the 50-digit witness, over the systematic sweep of regimes.

The unit of error is κ = Σ|x·∂q/∂x|: what the result changes by when every input moves by its own rounding.
1e-13 is 450 roundings, the allowance of a lens of 400 surfaces.
"""

from dataclasses import replace
from math import inf, isfinite, isinf

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.paraxial.first_order import abcd, cardinal_points, image_distance, magnification
from p2sf.paraxial.pupils import f_number, pupils
from p2sf.paraxial.seidel import coefficients
from tests.extremes import witness
from tests.extremes.regimes import REGIMES, Case, cases_of, system_of

LIMIT = 1e-13
INPUTS = 20  # of a long lens only so many inputs count into κ, which is the stricter side

GROUPS = {
    "ABCD": ("A", "B", "C", "D"),
    "cardinal points": (
        "effective_focal_length",
        "back_focal_distance",
        "front_focal_distance",
        "front_principal_from_first",
        "rear_principal_from_last",
        "front_nodal_from_first",
        "rear_nodal_from_last",
    ),
    "image": ("image_distance", "magnification"),
    "pupils": ("entrance_from_first", "entrance_diameter", "exit_from_last", "exit_diameter", "f_number"),
    "n'u'": ("reduced_slope",),
    "W40": ("w40",),
    "W31": ("w31",),
    "W22": ("w22",),
    "W20": ("w20",),
    "W11": ("w11",),
    "Wd": ("wd",),
    "image height": ("image_height",),
}
COLUMN = {name: group for group, names in GROUPS.items() for name in names}


def program(case: Case) -> dict:
    """Return every quantity as p2sf finds it; an overflow on the way is a failure."""
    with np.errstate(over="raise"):
        return quantities(case)


def quantities(case: Case) -> dict:
    lens, wavelength = case.lens, case.wavelength
    found = dict(zip("ABCD", abcd(lens, wavelength).ravel(), strict=True))
    found |= vars(cardinal_points(lens, wavelength)) | vars(pupils(lens, wavelength))
    found |= {"image_distance": image_distance(lens, case.depth, wavelength)}
    found |= {"magnification": magnification(lens, case.depth, wavelength)}
    found |= {"f_number": f_number(lens, wavelength)}
    return found | vars(coefficients(lens, case.depth, case.slope, wavelength, field=case.field))


def compare(case: Case, quantity, found: dict):
    """Yield (name, error in κ) of every value of one witness function."""
    system = witness.exact(system_of(case))
    values = quantity(system)
    kappa = witness.conditioning(quantity, system, values, INPUTS)
    for name, value in values.items():
        yield name, error_in_kappa(float(found[name]), value, kappa[name])


def error_in_kappa(result: float, value, kappa) -> float:
    if not isfinite(result) or not isfinite(value):
        return float(not is_noise(value, kappa)) if isinf(result) else inf
    return float(abs(witness.mpf(result) - value) / kappa) if kappa else float(result != 0)


def is_noise(value, kappa) -> bool:
    """Return whether 1/value is nothing but the rounding of the inputs, so that infinity is the right answer."""
    return isinf(value) or kappa > abs(value) * 1e13


def answerable(case: Case) -> Case:
    """Return the case; where a field angle has no meaning (telecentric object space), with an object height."""
    system = witness.exact(system_of(case))
    values = witness.entrance_slope(system)
    kappa = witness.conditioning(witness.entrance_slope, system, values, INPUTS)["entrance slope"]
    value = values["entrance slope"]
    if abs(value) > kappa * 1e-14:
        return case
    with pytest.raises(GeometryError, match="entrance pupil is at infinity"):
        coefficients(case.lens, case.depth, case.slope, case.wavelength)
    return replace(case, field="height", depth=min(case.depth, 1e9), slope=2.0)


@pytest.mark.slow
@pytest.mark.parametrize("regime", REGIMES, ids=lambda r: r.__name__.removesuffix("_cases"))
def test_every_result_is_as_good_as_its_conditioning(regime, record):
    worst = []
    for number, case in enumerate(cases_of(regime)):
        found = program(answerable(case))
        for quantity in (witness.first_order, witness.image, witness.pupils, witness.coefficients):
            for name, error in compare(answerable(case), quantity, found):
                record(COLUMN[name], case.regime, error)
                if not error <= LIMIT:
                    worst.append(f"case {number}, {name}: {error:.1e} κ")
    assert not worst, "\n".join(worst[:40])
