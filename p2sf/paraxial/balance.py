"""What of six coefficients blurs: the parts of their variance, and the focus that balances them (handbook 3.4)."""

from typing import overload

from p2sf.conventions import FloatOrArray
from p2sf.paraxial.seidel import Coefficients

ALIKE = 4.0  # of the variance: the focus of third order then is that of the rays up to a factor of two
LEAST_CAUSE = 0.2  # of the focus that a coefficient makes if it is named


def variance_parts(coefficients: Coefficients) -> dict[str, float]:
    """Return how much of the variance of the six coefficients' W (waves²) each of them causes; tilt is left out.

    Spherical beyond its best focus W40²/180, coma beyond its tilt W31²/72, astigmatism about its medial focus W22²/24,
    and all focus together (W40 + W20 + Wd + W22/2)²/12 (Mahajan 1991, table 2-1). Coefficients that push the focus the
    way it is off share that part by their size; those that pull against it have none of it.
    """
    w40, w31, w22, w20, wd = (float(getattr(coefficients, name)) for name in ("w40", "w31", "w22", "w20", "wd"))
    causes = {"w40": w40, "w20": w20 + w22 / 2, "wd": wd}
    focus = _even_focus(coefficients)
    pushes = {name: max(0.0, cause * focus) for name, cause in causes.items()}
    whole = sum(pushes.values()) or 1.0
    shares = {name: focus**2 / 12 * push / whole for name, push in pushes.items()}
    return {"w40": w40**2 / 180 + shares["w40"], "w31": w31**2 / 72, "w22": w22**2 / 24} | {
        name: shares[name] for name in ("w20", "wd")
    }


def strongest(coefficients: Coefficients) -> str:
    """Return which of the six coefficients is to be changed first: the one that causes most of the variance."""
    parts = variance_parts(coefficients)
    return max(parts, key=parts.__getitem__)


@overload
def depth_of_focus_um(image_index: float, wavelength_um: float, na: float) -> float: ...


@overload
def depth_of_focus_um(image_index: FloatOrArray, wavelength_um: FloatOrArray, na: FloatOrArray) -> FloatOrArray: ...


def depth_of_focus_um(image_index: FloatOrArray, wavelength_um: FloatOrArray, na: FloatOrArray) -> FloatOrArray:
    """Return n′λ/NA², µm: so far a shift of the sensor makes half a wave of defocus (Born & Wolf 1999, §8.8.2).

    Its sign is that of the index, which is negative behind an odd number of mirrors.
    """
    return image_index * wavelength_um / na**2


def best_focus_um(c: Coefficients) -> float:
    """Return how far the sensor is from the focus that the six coefficients leave least variance in, µm.

    The parts of W40, W20 + Wd and W22 that are alike over the pupil are (W40 + W20 + Wd + W22/2)ρ² (Welford 1986, §7.7,
    for the depth 2n′λW/NA² of a defocus).
    """
    return abs(2 * float(depth_of_focus_um(c.image_index, c.wavelength_um, c.na)) * _even_focus(c))


def _even_focus(c: Coefficients) -> float:
    """Return the coefficient of ρ² that is alike over the pupil, waves."""
    return float(c.w40 + c.w20 + c.wd + c.w22 / 2)


def focus_causes(coefficients: Coefficients, variance: float) -> tuple[str, ...]:
    """Return the coefficients that make this variance of focus, the largest first; none where they make another."""
    c, focus = coefficients, _even_focus(coefficients)
    if not 1 / ALIKE < focus**2 / 12 / variance < ALIKE:
        return ()
    pulls = {"W40": float(c.w40), "W20": float(c.w20), "Wd": float(c.wd), "W22": float(c.w22 / 2)}
    found = [name for name, pull in pulls.items() if pull / focus > LEAST_CAUSE]
    return tuple(sorted(found, key=lambda name: -pulls[name] / focus))
