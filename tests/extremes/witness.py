"""A witness in 50-digit arithmetic that shares no line with the program.

A system is a plain dict of floats: ``radius`` (inf for a plane), ``thickness`` (the last one leads to the
sensor), ``index`` (one more than there are surfaces), ``conic``, ``a4``, ``stop`` (from 0), ``rim`` (the stop's
semi-diameter), ``depth``, ``slope`` (or mm below the axis, as ``field`` says), ``wavelength_mm``, and ``sensor_radius``
of a curved sensor. Rays carry
(height, slope); the Seidel sums take the classical form with the ratio of the refraction invariants, which is
undefined where the marginal ray meets a surface along its normal: there the ratio is taken at a tiny distance,
which leaves 28 of the 50 digits.
"""

from mpmath import inf, mp, mpf

mp.dps = 50
TINY = mpf(10) ** -22


def exact(system: dict) -> dict:
    """Return the system with every float as the 50-digit number it stands for."""
    return {key: [mpf(x) for x in value] if isinstance(value, list) else value for key, value in system.items()} | {
        key: mpf(system.get(key, inf)) for key in ("rim", "depth", "slope", "wavelength_mm", "sensor_radius")
    }


def bend(system: dict, j: int):
    return 0 if system["radius"][j] in (inf, -inf) else 1 / system["radius"][j]


def march(system: dict, height, slope, start: int = 0):
    """Return (height, slope before, slope behind) at each surface from ``start`` on."""
    rows = []
    for j in range(start, len(system["radius"])):
        n, after = system["index"][j], system["index"][j + 1]
        behind = (n * slope - height * bend(system, j) * (after - n)) / after
        rows.append((height, slope, behind))
        height, slope = height + system["thickness"][j] * behind, behind
    return rows


def march_back(system: dict, slope, stop: int):
    """Return (height, slope) at the first vertex of the ray that leaves the stop's centre backwards."""
    height = mpf(0)
    for j in range(stop - 1, -1, -1):
        n, after = system["index"][j], system["index"][j + 1]
        height -= system["thickness"][j] * slope
        slope = (after * slope + height * bend(system, j) * (after - n)) / n
    return height, slope


def first_order(system: dict) -> dict:
    n, last = system["index"][0], system["index"][-1]
    up, over = march(system, mpf(1), mpf(0))[-1], march(system, mpf(0), 1 / n)[-1]
    a, b, c, d = up[0], over[0], last * up[2], last * over[2]
    return {"A": a, "B": b, "C": c, "D": d} | {
        "effective_focal_length": over_or_infinite(mpf(-1), c),
        "back_focal_distance": over_or_infinite(-last * a, c),
        "front_focal_distance": over_or_infinite(n * d, c),
        "front_principal_from_first": over_or_infinite((d - 1) * n, c),
        "rear_principal_from_last": over_or_infinite((1 - a) * last, c),
        "front_nodal_from_first": over_or_infinite(n * d - last, c),
        "rear_nodal_from_last": over_or_infinite(n - last * a, c),
    }


def over_or_infinite(numerator, denominator):
    return numerator / denominator if denominator else inf


def axial_start(system: dict):
    """Return height and slope at the first vertex of an axial ray of no particular size."""
    depth = system["depth"]
    return (mpf(1), mpf(0)) if depth == inf else (min(depth, mpf(1)), min(depth, mpf(1)) / depth)


def image(system: dict) -> dict:
    height, slope = axial_start(system)
    last = march(system, height, slope)[-1]
    found = {"image_distance": over_or_infinite(-last[0], last[2])}
    if system["depth"] != inf:  # there it is 0, or for an afocal lens the limit
        found["magnification"] = over_or_infinite(system["index"][0] * slope, system["index"][-1] * last[2])
    return found


def limiting_surface(system: dict, rims: list) -> int:
    """Return the surface (from 1) whose rim the axial ray fills most."""
    rows = march(system, *axial_start(system))
    return max(range(len(rows)), key=lambda j: abs(rows[j][0]) / mpf(rims[j])) + 1


def both_rays(system: dict):
    """Return the marginal ray and the chief ray of the field, each as rows of (height, before, behind)."""
    height, slope = march_back(system, mpf(1), system["stop"])
    chief_scale = field_scale(system, height, slope)
    chief = [tuple(chief_scale * x for x in row) for row in march(system, height, slope)]
    y, u = axial_start(system)
    at_stop = march(system, y, u)[system["stop"]][0]
    at_pupil = y - u * height / slope if slope else at_stop  # positive there by convention
    scale = system["rim"] / abs(at_stop) * (1 if at_pupil >= 0 else -1)
    return march(system, scale * y, scale * u), chief


def field_scale(system: dict, height, slope):
    """Return what turns the stop-centred ray that starts as (height, slope) into the field's chief ray."""
    if system["field"] == "slope":
        return system["slope"] / slope
    return -system["slope"] / (height - slope * system["depth"])


def entrance_slope(system: dict) -> dict:
    """Return the slope before the lens of the ray through the stop's centre; 0 in a telecentric object space."""
    return {"entrance slope": march_back(system, mpf(1), system["stop"])[1]}


def pupils(system: dict) -> dict:
    height, slope = march_back(system, mpf(1), system["stop"])
    out = march(system, mpf(0), mpf(1), system["stop"])[-1]
    up = march(system, mpf(1), mpf(0))[system["stop"]][0]
    last = system["index"][-1]
    return {
        "entrance_from_first": over_or_infinite(-height, slope),
        "entrance_diameter": over_or_infinite(2 * system["rim"], abs(up)),
        "exit_from_last": over_or_infinite(-out[0], out[2]),
        "exit_diameter": over_or_infinite(2 * system["rim"] * abs(system["index"][system["stop"]]), abs(last * out[2])),
        "f_number": over_or_infinite(abs(up), 2 * system["rim"] * abs(march(system, mpf(1), mpf(0))[-1][2] * last)),
    }


def seidel(system: dict) -> list:
    """Return the five sums over all surfaces (Welford's signs, the classical division form)."""
    marginal, chief = both_rays(system)
    first = system["index"][0]
    lagrange = first * (chief[0][1] * marginal[0][0] - marginal[0][1] * chief[0][0])
    total = [mpf(0)] * 5
    for j, ((y, u, v), (yc, uc, _)) in enumerate(zip(marginal, chief, strict=True)):
        n, after, c = system["index"][j], system["index"][j + 1], bend(system, j)
        a, ac = n * (u + y * c), n * (uc + yc * c)
        spread = v / after - u / n
        if a == 0:  # the same surface met almost along its normal; the sums are smooth there
            a = TINY * max(abs(y * c), abs(u), TINY)
            u = a / n - y * c
            spread = (n * u - y * c * (after - n)) / after / after - u / n
        ratio = ac / a
        one = -a * a * y * spread
        three = ratio * ratio * one
        four = -lagrange * lagrange * c * (1 / after - 1 / n)
        figure = (system["conic"][j] * c**3 + 8 * system["a4"][j]) * (after - n)
        extra = [figure * y ** (4 - k) * yc**k for k in (0, 1, 2, 3)]
        parts = [one + extra[0], ratio * one + extra[1], three + extra[2], four, ratio * (three + four) + extra[3]]
        total = [s + p for s, p in zip(total, parts, strict=True)]
    return total


def coefficients(system: dict) -> dict:
    """Return the six coefficients in waves, the signed image-space slope n'u' and the paraxial image height."""
    one, two, three, four, five = seidel(system)
    marginal, chief = both_rays(system)
    (y, _, u), last = marginal[-1], system["index"][-1]
    sensor = system["thickness"][-1]
    wavelength = system["wavelength_mm"]
    height, slope = chief[-1][0] + chief[-1][2] * sensor, chief[-1][2]
    behind = height * height / 2 / system["sensor_radius"]  # where the sensor is at the chief ray: defocus, and a shift
    return {
        "w40": one / 8 / wavelength,
        "w31": two / 2 / wavelength,
        "w22": three / 2 / wavelength,
        "w20": (three + four) / 4 / wavelength + last * u * u * behind / 2 / wavelength,
        "w11": five / 2 / wavelength + last * u * slope * behind / wavelength,
        "wd": last * u * (u * sensor + y) / 2 / wavelength,
        "reduced_slope": last * u,
        "image_height": height,
    }


def wave_aberration(coefficients: dict, xi: float, eta: float):
    """Return W in waves at pupil point (ξ, η), without W11, which only moves the image."""
    xi, eta = mpf(xi), mpf(eta)
    square = xi * xi + eta * eta
    c = coefficients
    return c["w40"] * square**2 + c["w31"] * square * eta + c["w22"] * eta**2 + (c["w20"] + c["wd"]) * square


STEP = mpf(10) ** -20


def conditioning(quantity, system: dict, values: dict, most: int = 10**9) -> dict:
    """Return κ = Σ|x·∂q/∂x| + |q| of each value of ``quantity(system)``.

    x runs over radii, thicknesses, indices, conics, A4, depth and field slope; |q| stands for what the result
    owes to its own rounding, to the aperture and to the wavelength. One-sided differences of 1e-20 relative
    leave 25 good digits. With more than ``most`` inputs only every k-th counts, which makes κ smaller and the
    test stricter.
    """
    inputs = [(key, j) for key in ("radius", "thickness", "index", "conic", "a4") for j in range(len(system[key]))]
    inputs = [*inputs[:: 1 + len(inputs) // most], ("depth", None), ("slope", None), ("sensor_radius", None)]
    total = {name: abs(value) for name, value in values.items()}
    for key, j in inputs:
        x = system[key] if j is None else system[key][j]
        if x in (0, inf, -inf):
            continue
        moved = nudged(system, key, j, x)
        for name, value in quantity(moved).items():
            if value != values[name]:
                total[name] += abs(value - values[name]) / STEP
    return total


def nudged(system: dict, key: str, j, x) -> dict:
    if j is None:
        return system | {key: x * (1 + STEP)}
    return system | {key: [*system[key][:j], x * (1 + STEP), *system[key][j + 1 :]]}
