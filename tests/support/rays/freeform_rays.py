"""A ray tracer in forty digits for surfaces of any shape: Newton's method on x, y and z, with gradients by differences.

It shares nothing with `p2sf` but the numbers of a `Lens`: sags are written out by their definitions, Snell's law and
that of gratings are those of vectors with positive indices, and surfaces stand where `space_rays` puts them.
"""

from math import isqrt

from mpmath import atan2, cos, factorial, hypot, inf, matrix, mp, mpf, pi, sign, sin, sqrt

from p2sf.lens.anamorphic import Biconic, Toroid
from p2sf.lens.freeform import XYPolynomial, ZernikeFringeSag, ZernikeStandardSag
from p2sf.lens.grating import Grating
from p2sf.lens.lens import Lens, Surface
from p2sf.lens.shapes import Diffraction
from tests.support.rays.space_rays import poses

DIGITS = 40
STEP = mpf(10) ** -13  # of central differences, whose error is its square times a third derivative: 1e-26
# (n, m), sin |m|θ where m < 0: Noll 1976, table I, and Wyant & Creath 1992, table III.
NOLL = [(0, 0), (1, 1), (1, -1), (2, 0), (2, -2), (2, 2), (3, -1), (3, 1), (3, -3), (3, 3), (4, 0), (4, 2), (4, -2)]
FRINGE = [(0, 0), (1, 1), (1, -1), (2, 0), (2, 2), (2, -2), (3, 1), (3, -1), (4, 0), (3, 3), (3, -3), (4, 2), (4, -2)]


def zernike(n: int, m: int, rho, theta):
    """Return R(ρ) times cos mθ or sin |m|θ by the sum that defines it, 1 on the edge at most."""
    k, f = abs(m), factorial
    radial = sum(
        (-1) ** s * f(n - s) / (f(s) * f((n + k) // 2 - s) * f((n - k) // 2 - s)) * rho ** (n - 2 * s)
        for s in range((n - k) // 2 + 1)
    )
    return radial * (sin(k * theta) if m < 0 else cos(k * theta))


def monomials(count: int) -> list[tuple[int, int]]:
    """Return the exponents of x and y in the order x, y, x², xy, y², x³, …, by the place of each."""
    found = []
    for place in range(1, count + 1):
        degree = (isqrt(8 * place + 1) - 1) // 2
        b = place - degree * (degree + 1) // 2
        found.append((degree - b, b))
    return found


def bend(radius: float):
    return mpf(0) if abs(radius) == inf else 1 / mpf(radius)


def in_axes_at(angle_deg: float, x, y):
    """Return the coordinates of a place in axes that stand at an angle, from x towards y."""
    angle = mpf(angle_deg) * pi / 180
    return cos(angle) * x + sin(angle) * y, cos(angle) * y - sin(angle) * x


def anamorphic_sag(shape, x, y):
    """Return the sag of a biconic, or that of a toroid, a point of a circle about an axis along y."""
    x, y = in_axes_at(shape.turn_deg, x, y)
    cy, ky = bend(shape.radius_y), mpf(shape.conic_y)
    if isinstance(shape, Biconic):
        cx, kx = bend(shape.radius_x), mpf(shape.conic_x)
        below = 1 + sqrt(1 - (1 + kx) * (cx * x) ** 2 - (1 + ky) * (cy * y) ** 2)
        return (cx * x * x + cy * y * y) / below
    curve = cy * y * y / (1 + sqrt(1 - (1 + ky) * (cy * y) ** 2))
    curve += sum(mpf(alpha) * y ** (2 * k) for k, alpha in enumerate(shape.coefficients, 1))
    if abs(shape.radius_x) == inf:
        return curve
    axis = mpf(shape.radius_x)
    return axis - sign(axis) * sqrt((axis - curve) ** 2 - x * x)


def shape_sag(shape, x, y):
    """Return the sag of a shape that is not of revolution by its definition."""
    if isinstance(shape, Biconic | Toroid):
        return anamorphic_sag(shape, x, y)
    u, v = x / mpf(shape.normalisation_mm), y / mpf(shape.normalisation_mm)
    if isinstance(shape, XYPolynomial):
        pairs = zip(shape.coefficients, monomials(len(shape.coefficients)), strict=True)
        return sum((mpf(c) * u**a * v**b for c, (a, b) in pairs), mpf(0))
    rho, theta = hypot(u, v), atan2(v, u)
    if isinstance(shape, ZernikeStandardSag):
        norms = (sqrt(mpf(n + 1) * (2 if m else 1)) for n, m in NOLL)
        rows = zip(shape.coefficients, NOLL, norms, strict=False)
        return sum((mpf(c) * norm * zernike(n, m, rho, theta) for c, (n, m), norm in rows), mpf(0))
    assert isinstance(shape, ZernikeFringeSag)
    rows = zip(shape.coefficients, FRINGE, strict=False)
    return sum((mpf(c) * zernike(n, m, rho, theta) for c, (n, m) in rows), mpf(0))


def sag(surface: Surface, x, y):
    """Return the sag of a surface: conic, even terms and a freeform shape."""
    square = x * x + y * y
    c = mpf(0) if abs(surface.radius) == inf else 1 / mpf(surface.radius)
    z = c * square / (1 + sqrt(1 - (1 + mpf(surface.conic)) * c * c * square))
    z += sum(mpf(a) * square ** (2 + k) for k, a in enumerate(surface.aspheric))
    return z if surface.shape is None else z + shape_sag(surface.shape, x, y)


def fly(lens: Lens, point, direction, wavelength_um: float):
    """Return where a ray meets every surface and the sensor, from the first vertex, its last direction and its path."""
    with mp.workdps(DIGITS):
        here, way = matrix([mpf(v) for v in point]), matrix([mpf(v) for v in direction])
        way /= sqrt(_dot(way, way))
        path, points = mpf(0), []
        for number, pose in enumerate(poses(lens)):
            surface = lens.surfaces[number] if number < len(lens.surfaces) else Surface()
            index = mpf(float(lens.media[number].index(wavelength_um)))
            turn, origin = matrix(pose.turn.as_matrix().tolist()), matrix(pose.origin.tolist())
            start, along = turn.T * (here - origin), turn.T * way
            step = _step(surface, start, along)
            here, path = here + step * way, path + index * step
            points.append([here[0], here[1], here[2]])
            if number == len(lens.surfaces):
                return points, [way[0], way[1], way[2]], path
            after = mpf(float(lens.media[number + 1].index(wavelength_um)))
            x, y, _ = start + step * along
            normal, phase = _normal(surface, x, y), surface.diffraction
            if phase is None:
                way = turn * _bent(along, normal, index, after, surface.reflects)
                continue
            kick, more = _kick(phase, x, y, mpf(wavelength_um) / 1000)
            path += more
            way = turn * _diffracted(along, normal, index, after, surface.reflects, kick)
    raise AssertionError


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _normal(surface: Surface, x, y):
    across = (sag(surface, x + STEP, y) - sag(surface, x - STEP, y)) / (2 * STEP)
    up = (sag(surface, x, y + STEP) - sag(surface, x, y - STEP)) / (2 * STEP)
    length = sqrt(across**2 + up**2 + 1)
    return matrix([-across / length, -up / length, 1 / length])


def _kick(phase, x, y, wavelength_mm):
    """Return what a grating or a phase adds to the tangential vector n·s, mm⁻¹ times the wavelength, and to the path.

    Of a grating in lines it is mλ/d along the normal of its planes, which are perpendicular to the plane z = 0.
    """
    if isinstance(phase, Grating):
        angle, waves = mpf(phase.turn_deg) * pi / 180, mpf(phase.order) * mpf(phase.lines_per_mm) * wavelength_mm
        return matrix([-waves * sin(angle), waves * cos(angle), 0]), waves * (y * cos(angle) - x * sin(angle))
    assert isinstance(phase, Diffraction)
    unit, radius = mpf(phase.order) * wavelength_mm / (2 * pi), mpf(phase.normalisation_mm)
    square = (x * x + y * y) / radius**2
    slope = sum(2 * k * mpf(a) * square ** (k - 1) for k, a in enumerate(phase.coefficients, 1)) / radius**2
    waves = unit * sum(mpf(a) * square**k for k, a in enumerate(phase.coefficients, 1))
    return matrix([unit * slope * x, unit * slope * y, 0]), waves


def _diffracted(way, normal, before, after, reflects, kick):
    """Return the direction whose tangential part is that before and the kick's (Ludwig 1973, eq. 9): |n's'| = n'."""
    normal = normal if _dot(way, normal) > 0 else -normal
    whole = before * way + kick
    tangential = whole - _dot(whole, normal) * normal
    along = sqrt(after**2 - _dot(tangential, tangential))
    return (tangential + (-along if reflects else along) * normal) / after


def _step(surface: Surface, here, way):
    """Return the length to the surface: from the plane of its vertex, by Newton's method."""
    t = -here[2] / way[2]
    for _ in range(60):
        x, y, z = here + t * way
        miss = z - sag(surface, x, y)
        if abs(miss) < mpf(10) ** -(DIGITS - 8):
            return t
        normal = _normal(surface, x, y)
        t -= miss * normal[2] / _dot(way, normal)
    raise RuntimeError("the ray misses the surface")


def _bent(way, normal, before, after, reflects):
    if reflects:
        return way - 2 * _dot(way, normal) * normal
    normal = normal if _dot(way, normal) > 0 else -normal
    ratio, cosine = before / after, _dot(way, normal)
    return ratio * way + (sqrt(1 - ratio**2 * (1 - cosine**2)) - ratio * cosine) * normal
