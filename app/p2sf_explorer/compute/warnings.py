"""What a person must know about the picture, in words. No Qt in here."""

from functools import lru_cache
from math import isinf

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.paraxial.lens_checks import lens_checks
from p2sf_explorer.compute.pupil import strongest
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.scales import significant
from p2sf_explorer.state.what_if import NOTE

DEFOCUS_LIMIT = 10.0  # waves; Pieroni et al. 2015 state the method up to |Wd| = 10 λ
GEOMETRIC = "the blur is so large that the picture is ray density, no diffraction; "
TOGETHER = "bring focus and source together to see waves"
NEARER = "stop down or go nearer the axis to see waves"
UNALTERED = "image, database, field curves, chromatic shift, depth of field, rays, spots, fans and sums per surface"
WIDE_DEG, FAST_NA = 25.0, 0.30  # tan and sin differ by 10 % at 25°; an NA of 0.3 is f/1.7


def warnings(setup: ParaxialSetup, exact: bool, lost_rays: int = 0, geometric: bool = False) -> tuple[str, ...]:
    """Return the sentences that hold for this setting, with or without exact rays, most important first.

    ``geometric``: the picture is the density of rays.
    """
    found = [
        _by_hand(setup),
        _image_at_infinity(setup),
        _blurred(setup) if geometric else None,
        _lost(lost_rays),
        None if exact else _defocus(setup),
        None if exact else _paraxial(setup),
        setup.stop.warning,
        *_odd(setup.lens),
    ]
    return tuple(_sentence(text) for text in found if text)


def _sentence(text: str) -> str:
    return text[0].upper() + text[1:] + ("" if text.endswith(".") else ".")


@lru_cache(maxsize=16)
def _odd(lens: Lens) -> tuple[str, ...]:
    """Return what no workshop could make: the first sentence, and how many there are."""
    first, *others = lens_checks(lens) or (None,)
    return (first, f"this lens has {1 + len(others)} such oddities; p2sf info lists them all") if others else (first,)


def _by_hand(setup: ParaxialSetup) -> str | None:
    return f"{NOTE}; {UNALTERED} stay the lens's own" if setup.altered else None


def _image_at_infinity(setup: ParaxialSetup) -> str | None:
    if isinf(float(setup.coefficients.image_distance)):
        return "the object lies in the front focal plane, so its image is at infinity; move the source"
    return None


def _blurred(setup: ParaxialSetup) -> str:
    return GEOMETRIC + remedy(setup)


def remedy(setup: ParaxialSetup) -> str:
    """Return what brings waves back into view, after what blurs most."""
    return TOGETHER if strongest(setup.coefficients) == "wd" else NEARER


def _lost(count: int) -> str | None:
    if not count:
        return None
    rays = "one of the drawn rays" if count == 1 else f"{count} of the drawn rays"
    return f"{rays} cannot pass (surface missed, or total reflection); less light arrives than the picture assumes"


def _defocus(setup: ParaxialSetup) -> str | None:
    wd = float(setup.coefficients.wd)
    if np.isnan(wd) or abs(wd) < DEFOCUS_LIMIT:
        return None
    return f"defocus is {significant(wd, 3)} λ, beyond the method's 10 λ; bring focus or source nearer, or stop down"


def _paraxial(setup: ParaxialSetup) -> str | None:
    angle = abs(float(np.rad2deg(np.arctan(setup.source.field_slope))))
    na = float(setup.coefficients.na)
    if angle <= WIDE_DEG and na <= FAST_NA:
        return None
    what = f"a field of {angle:.0f}°" if angle > WIDE_DEG else f"an aperture of NA {na:.2f}"
    return (
        f"{what} is far outside the paraxial range, where six coefficients only sketch the PSF; choose fitted or traced"
    )
