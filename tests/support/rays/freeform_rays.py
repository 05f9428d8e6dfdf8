"""A ray tracer in forty digits for surfaces of any shape: Newton's method on x, y and z, with gradients by differences.

It shares nothing with `p2sf` but the numbers of a `Lens`: sags are written out by their definitions, Snell's law is
that of vectors with positive indices, and the surfaces stand along z.
"""

from math import isqrt

from mpmath import atan2, cos, factorial, hypot, inf, matrix, mp, mpf, sin, sqrt

from p2sf.lens import Lens, Surface, XYPolynomial, ZernikeFringeSag, ZernikeStandardSag

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


def shape_sag(shape, x, y):
    """Return the sag of a freeform shape by its definition."""
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
        vertex, path, points = mpf(0), mpf(0), []
        for number in range(len(lens.surfaces) + 1):
            surface = lens.surfaces[number] if number < len(lens.surfaces) else Surface()
            index = mpf(float(lens.media[number].index(wavelength_um)))
            step = _step(surface, vertex, here, way)
            here, path = here + step * way, path + index * step
            points.append([here[0], here[1], here[2]])
            if number == len(lens.surfaces):
                return points, [way[0], way[1], way[2]], path
            after = mpf(float(lens.media[number + 1].index(wavelength_um)))
            way = _bent(way, _normal(surface, here[0], here[1]), index, after, surface.reflects)
            vertex += mpf(surface.thickness)
    raise AssertionError


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _normal(surface: Surface, x, y):
    across = (sag(surface, x + STEP, y) - sag(surface, x - STEP, y)) / (2 * STEP)
    up = (sag(surface, x, y + STEP) - sag(surface, x, y - STEP)) / (2 * STEP)
    length = sqrt(across**2 + up**2 + 1)
    return matrix([-across / length, -up / length, 1 / length])


def _step(surface: Surface, vertex, here, way):
    """Return the length to the surface: from the plane of its vertex, by Newton's method."""
    t = (vertex - here[2]) / way[2]
    for _ in range(60):
        x, y, z = here + t * way
        miss = z - vertex - sag(surface, x, y)
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
