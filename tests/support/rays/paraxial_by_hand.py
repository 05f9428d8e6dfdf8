"""First-order data of plain numbers by Welford's refraction and transfer in 50 digits, apart from the program."""

from typing import NamedTuple

from mpmath import mp, mpf


class FirstOrder(NamedTuple):
    """Focal length −1/C, and the focus behind the last vertex, in the unit of the numbers."""

    focal_length: float
    back_focus: float


def first_order(curvatures, thicknesses, indices, powers=None) -> FirstOrder:
    """Trace the ray of height 1 that arrives parallel to the axis; ``indices`` are signed and one more than surfaces.

    n'u' = nu − y(n' − n)c and y' = y + t'u' (Welford 1986, ch. 3); the last thickness is not used. ``powers``
    are added to those of refraction.
    """
    with mp.workdps(50):
        y, nu = mpf(1), mpf(0)
        pairs = list(zip(map(mpf, indices), map(mpf, indices[1:]), strict=False))
        for number, (c, t, (before, after)) in enumerate(zip(curvatures, thicknesses, pairs, strict=True), 1):
            nu -= y * ((after - before) * mpf(c) + (mpf(powers[number - 1]) if powers else 0))
            if number < len(pairs):
                y += mpf(t) * nu / after
        if not nu:
            return FirstOrder(float("inf"), float("inf"))
        return FirstOrder(float(-1 / nu), float(-y * mpf(indices[-1]) / nu))
