"""One exact ray in the meridional plane, surface by surface in plain numbers. No Qt in here.

The layout draws five rays and more in every frame, and arrays of five cost as much as arrays of five hundred: those of
a Double Gauss take 0.19 ms here and 0.42 by `p2sf.raytrace.trace` (tests/benchmarks/test_rays_speed.py), each time that
they are aimed and traced.
"""

from collections.abc import Callable, Sequence
from math import copysign, hypot, nan, sqrt

from p2sf.lens.lens import Lens, Surface
from p2sf.lens.shapes import WAVES_MM

NEWTON_STEPS = 20
CLOSE_MM = 1e-12
AIM_STEPS = 8

Meeting = tuple[float, float, float]
"""Where a ray meets a surface, local to its vertex: z, y and the slope dz/dy there."""


def path(
    lens: Lens,
    index: Sequence[float],
    wavelength_um: float,
    start: Sequence[float],
    direction: Sequence[float],
    rims: Sequence[float] | None = None,
    last: int | None = None,
) -> tuple[list[float], list[float], bool]:
    """Return z and y of a ray on every surface and on the sensor, and whether it got there.

    With ``last`` it ends on that surface, counted from 1.
    ``index``: per space, at ``wavelength_um``; ``start`` and ``direction`` are (z, y) from the first vertex. A ray that
    misses a surface or is totally reflected ends where it last was; one outside ``rims``, mm per surface, on the
    surface of that rim.
    """
    (z, y), length, vertex = start, hypot(*direction), 0.0
    cz, cy = direction[0] / length, direction[1] / length
    places: tuple[list[float], list[float]] = ([], [])
    for number, surface in enumerate(lens.surfaces):
        met = meet(surface, z - vertex, y, cz, cy)
        if met is None:
            return *places, False
        z, y = met[0] + vertex, met[1]
        places[0].append(z)
        places[1].append(y)
        if rims is not None and abs(y) > rims[number]:
            return *places, False
        if number + 1 == last:
            return *places, True
        turned = _after_surface(surface, met, (cz, cy), index[number : number + 2], wavelength_um)
        if turned is None:
            return *places, False
        cz, cy = turned
        vertex += lens.gaps[number]
    met = meet(lens.sensor_surface, z - vertex, y, cz, cy)
    if met is None:
        return *places, False
    places[0].append(met[0] + vertex)
    places[1].append(met[1])
    return *places, True


def aim_ray(
    landing: Callable[[float], float | None], goal: float, guess: float, gain: float, close: float
) -> float | None:
    """Return the height at which a ray enters so that ``landing`` of it is ``goal``, by the secant method.

    ``gain``: about how far a ray lands from where it did if it enters 1 mm higher; ``close``: the last step, where it
    lands, is at most that long, and what it leaves is far shorter. None where no such ray is found, or
    where rays have crossed before they land.
    """
    y, before, upright = guess, landing(guess), gain > 0
    for _ in range(AIM_STEPS):
        if before is None or not gain or (gain > 0) != upright:
            return None
        step = (goal - before) / gain
        y += step
        if abs(step * gain) <= close:
            return y
        after = landing(y)
        if after is None:
            return None
        gain, before = (after - before) / step, after
    return None


def meet(surface: Surface, z: float, y: float, cz: float, cy: float) -> Meeting | None:
    """Return (z, y, dz/dy) where a ray meets a surface's front sheet, local to its vertex; None where it misses."""
    y -= z * cy / cz
    c, k = surface.curvature, surface.conic
    f, g = c * y * y, cz - c * y * cy  # the conic's quadratic for the step from the vertex plane (Welford 1986, §4.3)
    root = g * g - f * c * (1 + k * cz * cz)
    step = f / (g + copysign(sqrt(root), cz)) if root >= 0 else nan  # nor where the ray has no way to the stop
    on_conic = c * (1 + k) * step * cz < 1
    if len(surface.parts) > 1:
        # A ray may miss the conic under an asphere and meet the asphere; it then starts from the vertex plane.
        return (
            _on_asphere(surface, step * cz, y + step * cy, cz, cy) if on_conic else _on_asphere(surface, 0.0, y, cz, cy)
        )
    if not on_conic:
        return None
    z, y = step * cz, y + step * cy
    return z, y, c * y / (1 - c * (1 + k) * z)


def _on_asphere(surface: Surface, z: float, y: float, cz: float, cy: float) -> Meeting | None:
    """Return where a ray that met the conic meets the asphere, by Newton's method; None where it does not converge."""
    for _ in range(NEWTON_STEPS):
        if not (1 + surface.conic) * (surface.curvature * y) ** 2 < 1:
            return None
        sag, by_square = surface.sag_and_slope(y * y)
        slope, miss = 2 * y * float(by_square), float(sag) - z
        if abs(miss) < CLOSE_MM * (1 + abs(y) + abs(z)):
            return z, y, slope
        step = miss / (cz - slope * cy)
        z, y = z + step * cz, y + step * cy
    return None


def _after_surface(
    surface: Surface, met: Meeting, along: tuple[float, float], index: Sequence[float], wavelength_um: float
) -> tuple[float, float] | None:
    """Return the direction behind a surface of a ray that meets it along (cz, cy); None where totally reflected."""
    if surface.ideal:
        tangent = (index[0] * along[1] / along[0] - met[1] / surface.ideal_focal_length) / index[1]
        cosine = copysign(1 / hypot(1.0, tangent), index[1])
        return cosine, tangent * cosine
    return refract(met[2], *along, index[0], index[1], diffract(surface, met[1], wavelength_um))


def diffract(surface: Surface, y: float, wavelength_um: float) -> float:
    """Return what a diffractive surface adds to the optical cosine along y, (λ/2π)dφ/dy."""
    if surface.diffraction is None:
        return 0.0
    return WAVES_MM * wavelength_um * float(surface.diffraction.phase_and_gradient(0.0, y)[1][1])


def refract(
    slope: float, cz: float, cy: float, before: float, after: float, kick: float = 0.0
) -> tuple[float, float] | None:
    """Return the direction behind a surface of slope dz/dy, Snell's law as a vector; None where totally reflected.

    ``kick`` is added to the optical cosine along y before. As in `p2sf.raytrace.surface` an index is negative where
    light runs to the left.
    """
    length = hypot(1.0, slope)
    nz, ny = 1 / length, -slope / length
    optical_z, optical_y = abs(before) * cz, abs(before) * cy + kick
    incident = optical_z * nz + optical_y * ny
    root = incident**2 + after**2 - (optical_z**2 + optical_y**2 if kick else before**2)
    if not root >= 0:  # nor where the ray is NaN, having no way to its place in the stop
        return None
    push = copysign(sqrt(root), after) - incident
    return (optical_z + push * nz) / abs(after), (optical_y + push * ny) / abs(after)
