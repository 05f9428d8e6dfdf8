"""What the lessons claim, measured by roads of their own: the referee's rays, plain sums and paraxial rays.

Of the program only the setup is taken, the lens with its sensor and stop and the source, and where a claim is about the
picture on the screen (R²), the picture. Every function takes a `State`.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from math import isinf

import numpy as np
from numpy.polynomial.legendre import leggauss

from p2sf.lens.lens import Lens, with_sensor
from p2sf.lens.source import Source
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.terms import TERMS
from p2sf_explorer.state.what_if import is_altered, is_heard
from tests.support.pupil_sums import (
    Pupil,
    Sums,
    field_at,
    part_inside,
    phase_and_frequency,
    pupil_of,
    pupil_through,
    sums_of,
)
from tests.support.rays import space_pupil
from tests.support.rays.skew_rays import (
    System,
    back_to_sphere,
    entrance_pupil,
    exit_pupil_mm,
    system_of,
    through_paraxial_pupil,
    through_stop,
)
from tests.support.waves import rms_about_plane

AIRY = 0.609835  # first zero of J1 over 2π
SMALL = 0.3  # of pupil and field: where a polynomial of eighth order is exact to 1e-6
CELLS, FEW_CELLS = 512, 256  # across the pupil; the few where the phase is of a wave or two


def lens_and_source(state: State) -> tuple[Lens, Source]:
    made = paraxial_setup(state)
    return made.lens, made.source


# Paraxial rays


def marginal_ray(system: System, source: Source) -> tuple[float, float]:
    """Return height at the last surface and slope behind it of the paraxial ray through the entrance pupil's rim."""
    plane, radius = entrance_pupil(system)
    slope = 0.0 if isinf(source.depth_mm) else radius / (source.depth_mm + plane)
    return paraxial_ray(system, radius - slope * plane, slope)


def paraxial_ray(system: System, y: float, u: float) -> tuple[float, float]:
    """Return height at the last surface and slope behind it of a ray that meets the first surface at y with slope u."""
    for j, shape in enumerate(system.shapes):
        before, after = system.index[j], system.index[j + 1]
        u = (before * u - y * shape.power(before, after)) / after
        if j < len(system.shapes) - 1:
            y += u * system.thickness[j]
    return y, u


def image_mm(lens: Lens, depth_mm: float, wavelength_um: float) -> float:
    """Return the place of the paraxial image behind the last surface, mm."""
    y, u = marginal_ray(system_of(lens, wavelength_um), Source(depth_mm, 0.0, wavelength_um))
    return -y / u


def chief_mm(system: System, slope: float, sensor_mm: float) -> float:
    """Return where the paraxial chief ray meets the sensor, mm."""
    y, u = paraxial_ray(system, -slope * entrance_pupil(system)[0], slope)
    return y + u * sensor_mm


def numerical_aperture(state: State) -> float:
    lens, source = lens_and_source(state)
    system = system_of(lens, source.wavelength_um)
    return abs(system.last * marginal_ray(system, source)[1])


def focal_length(state: State) -> float:
    lens, source = lens_and_source(state)
    return -1 / paraxial_ray(system_of(lens, source.wavelength_um), 1.0, 0.0)[1]


def image_height(state: State) -> float:
    lens, source = lens_and_source(state)
    return chief_mm(system_of(lens, source.wavelength_um), source.field_slope, lens.sensor_mm)


def axial_colour(state: State) -> float:
    lens, source = lens_and_source(state)
    blue, red = (image_mm(lens, source.depth_mm, wavelength) for wavelength in (0.4861327, 0.6562725))
    return 1000 * (red - blue)


# The six coefficients, as the limit of exact rays at small aperture and field


def coefficients(state: State) -> dict[str, float]:
    """Return the coefficients in waves as the state alters them."""
    own = lens_coefficients(*lens_and_source(state))
    added = dict(zip(TERMS, state.what_if.added_waves, strict=True))
    base = 0.0 if state.what_if.free_pupil else 1.0
    return {term: (base * own[term] + added[term]) * is_heard(state, term) for term in TERMS}


@lru_cache(maxsize=64)
def lens_coefficients(lens: Lens, source: Source) -> dict[str, float]:
    """Return W40 … Wd in waves from the phase of exact rays near the axis, as the leading terms of its power series."""
    system, image = system_of(lens, source.wavelength_um), image_mm(lens, source.depth_mm, source.wavelength_um)
    focused = system_of(with_sensor(lens, image), source.wavelength_um)
    leading, chief = _power_series(focused, source)
    na = system.last * marginal_ray(system, source)[1]
    return {
        "w40": leading[2, 0, 0],
        "w31": leading[1, 1, 0],
        "w22": leading[0, 2, 0],
        "w20": leading[1, 0, 1],
        "wd": na**2 * (lens.sensor_mm - image) / (2 * system.last * system.wavelength),
        "w11": na * chief / system.wavelength,
    }


def _power_series(system: System, source: Source) -> tuple[dict, float]:
    """Return the coefficients of (ρ²)^a (ηh)^b (h²)^c in W, and of h³ in the chief ray's height beyond the paraxial."""
    xi, eta = (SMALL * values for values in np.meshgrid(np.linspace(0, 1, 5), np.linspace(-1, 1, 9)))
    rows, waves, heights = [], [], []
    fields = SMALL * np.arange(1, 6) / 5
    terms = [(a, b, n - a - b) for n in range(2, 5) for a in range(n + 1) for b in range(n + 1 - a) if a + b]
    for h in fields:
        at = Source(source.depth_mm, h * source.field_slope, source.wavelength_um)
        rays = through_paraxial_pupil(system, at, xi.ravel(), eta.ravel())
        chief = through_paraxial_pupil(system, at, np.zeros(1), np.zeros(1))
        waves.append(-phase_and_frequency(system, rays, chief)[0])
        square, mixed = (xi**2 + eta**2).ravel(), (eta * h).ravel()
        rows.append(np.stack([square**a * mixed**b * h ** (2 * c) for a, b, c in terms], -1))
        ideal = chief_mm(system, at.field_slope, system.thickness[-1])
        heights.append(float(chief.y.item()) - ideal)
    scale = SMALL ** (2 * np.array(terms).sum(-1))  # the columns are of one size then
    found = np.linalg.lstsq(np.concatenate(rows) / scale, np.concatenate(waves), rcond=None)[0] / scale
    cubic = np.linalg.lstsq(fields[:, None] ** np.array([3, 5, 7]), np.array(heights), rcond=None)[0][0]
    return dict(zip(terms, found.tolist(), strict=True)), float(cubic)


def third_order_focus(times_w22: float) -> Callable[[State], float]:
    """Return the measure of where a fan focuses, µm behind the sensor, from W20, Wd and a multiple of W22."""

    def focus(state: State) -> float:
        w, (lens, source) = coefficients(state), lens_and_source(state)
        index = system_of(lens, source.wavelength_um).last
        waves = w["w20"] + w["wd"] + times_w22 * w["w22"]
        return -2 * index * source.wavelength_um * waves / numerical_aperture(state) ** 2

    return focus


# Exact rays


def fill(lens: Lens):
    assert not lens.misaligned, "these rays know no tilts and decentres"
    return {"stop": through_stop, "paraxial": through_paraxial_pupil}[lens.aim]


def distortion(state: State) -> float:
    lens, source = lens_and_source(state)
    system = system_of(lens, source.wavelength_um)
    real = fill(lens)(system, source, np.zeros(1), np.zeros(1)).y.item()
    return 100 * (real / image_height(state) - 1)


def ray_focus(along: bool) -> Callable[[State], float]:
    """Return the measure of where rays next to the chief ray cross it, µm behind the sensor: ∂y/∂tan or ∂x/∂tan."""

    def focus(state: State) -> float:
        lens, source = lens_and_source(state)
        system, tiny = system_of(lens, source.wavelength_um), np.array([-1e-4, 1e-4])
        rays = fill(lens)(system, source, 0 * tiny if along else tiny, tiny if along else 0 * tiny)
        place, slope = (rays.y, rays.k[1]) if along else (rays.x, rays.k[0])
        return -1000 * float(np.diff(place).item() / np.diff(slope / rays.k[2]).item())

    return focus


# The picture


@lru_cache(maxsize=32)
def pupil(state: State) -> Pupil:
    """Return the pupil that makes the picture: of exact rays, or of the coefficients that were changed by hand."""
    lens, source = lens_and_source(state)
    assert not lens.misaligned, "this sum knows no tilts and decentres"
    if not is_altered(state):
        return pupil_of(lens, source, lens.aim)
    w, scale = coefficients(state), -1000 * numerical_aperture(state) / source.wavelength_um  # a real image: u' < 0
    rho, angle = np.sqrt(np.linspace(0.01, 1, 20))[:, None], np.linspace(0, np.pi, 41)
    xi, eta = (rho * np.sin(angle)).ravel(), (rho * np.cos(angle)).ravel()
    turn = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    rim = scale * np.stack([np.sin(turn), np.cos(turn)])
    spot = 4 * sum(abs(value) for value in w.values()) / abs(scale)
    one = np.ones_like(xi)
    dark = lens.mask.obscuration
    hole = dark * rim if dark else None
    return pupil_through(scale * np.stack([xi, eta]), -shape(w, xi, eta), (xi, eta, one), rim, spot, hole)


def shape(w: dict[str, float], xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return W without its tilt, waves."""
    square = xi**2 + eta**2
    return w["w40"] * square**2 + w["w31"] * square * eta + w["w22"] * eta**2 + (w["w20"] + w["wd"]) * square


@lru_cache(maxsize=32)
def sums(state: State) -> Sums:
    return sums_of(pupil(state), cells=CELLS)


def radius_80(state: State) -> float:
    return sums(state).radius(0.8)


def contrast(direction: str) -> Callable[[State], float]:
    def at_fifty(state: State) -> float:
        found = sums(state)
        return float(np.interp(50.0, found.frequency, np.abs(getattr(found, direction))))

    return at_fifty


def intensity(state: State, x_um: np.ndarray, y_um: np.ndarray, cells: int = CELLS) -> np.ndarray:
    return np.abs(field_at(pupil(state), x_um, y_um, cells)) ** 2


def beside_centre(state: State) -> tuple[float, float]:
    """Return the radius of the first dark ring, µm, and the brightest light beyond it over that in the middle."""
    radius = np.linspace(0, 5, 2001) * airy_radius(state)
    values = intensity(state, np.zeros(1), radius, FEW_CELLS)[:, 0]
    dark = int(np.argmax(np.diff(values) > 0))
    return float(radius[dark]), float(values[dark:].max() / values[0])


def valley_over_peak(state: State) -> float:
    """Return the light midway between two points an Airy radius apart, over that at either: plain sums, added."""
    radius = airy_radius(state)
    places = np.array([-radius / 2, 0.0, radius / 2])  # about the middle, with the points at its ends
    one, other = (intensity(state, places + shift, np.zeros(1), FEW_CELLS)[0] for shift in (radius / 2, -radius / 2))
    both = one + other
    return float(both[1] / both[0])


def signed_contrast(state: State) -> float:
    """Return the real part of the OTF along y about the centroid at 50 cycles per mm."""
    found = sums(state)
    return float(np.interp(50.0, found.frequency, found.y.real))


def around(state: State, radii_um: np.ndarray) -> np.ndarray:
    """Return the mean intensity on circles by direction, 2° apart, of what was put into the pupil by hand.

    |Σ exp(i2π(W + (NA/λ)(ξx + ηy)))|² over a square grid of the iris, every cell by the part of it that is open.
    """
    assert is_altered(state), "the plain sum is of coefficients added by hand"
    lens, source = lens_and_source(state)
    axis = (np.arange(FEW_CELLS) + 0.5) * (2 / FEW_CELLS) - 1
    xi, eta = np.meshgrid(axis, axis)
    field = iris(lens.mask, xi, eta, axis[1] - axis[0]) * np.exp(2j * np.pi * shape(coefficients(state), xi, eta))
    turn = np.deg2rad(np.arange(0, 360, 2))[:, None]
    scale = 2 * np.pi * numerical_aperture(state) / source.wavelength_um
    along, across = (scale * (radii_um * wave(turn)).ravel() for wave in (np.cos, np.sin))
    rows = np.exp(1j * np.outer(across, axis)) @ field.T
    found = np.abs((rows * np.exp(1j * np.outer(along, axis))).sum(1)) ** 2
    return found.reshape(-1, radii_um.size).mean(1)


def iris(mask, xi: np.ndarray, eta: np.ndarray, cell: float) -> np.ndarray:
    """Return the part of every cell that the blades leave open: each is a half plane, or a disc through its corners."""
    inside = part_inside((1 - np.hypot(xi, eta)) / cell, np.arctan2(eta, xi))
    if not mask.blades or mask.roundness == 1:
        return inside
    for k in range(mask.blades):
        angle = np.deg2rad(mask.blade_angle_deg) + np.pi * (2 * k + 1) / mask.blades
        across, along = xi * np.sin(angle) + eta * np.cos(angle), xi * np.cos(angle) - eta * np.sin(angle)
        half, distance = np.sin(np.pi / mask.blades), np.cos(np.pi / mask.blades)
        if mask.roundness == 0:
            depth, normal = distance - across, np.pi / 2 - angle + 0 * across
        else:
            radius = 1 / mask.roundness
            away = across - (distance - np.sqrt(radius**2 - half**2))
            depth = radius - np.hypot(away, along)
            normal = np.pi / 2 - angle + np.arctan2(along, away)
        inside = inside * part_inside(depth / cell, normal)
    return inside


def spikes(state: State) -> np.ndarray:
    return around(state, np.linspace(3, 5, 21) * airy_radius(state))


def blur(state: State) -> np.ndarray:
    """Return the light near the edge of the geometric blur, whose radius is the slope 2·Wd of the wavefront."""
    wd = coefficients(state)["wd"] * lens_and_source(state)[1].wavelength_um / numerical_aperture(state)
    return around(state, np.linspace(0.92, 0.96, 5) * 2 * abs(wd))


def bright_directions(values: np.ndarray) -> int:
    """Return how often the values rise through half the brightest on their way around."""
    bright = values > values.max() / 2
    return sum(b and not a for a, b in zip(np.roll(bright, 1), bright, strict=True))


def strehl(state: State) -> float:
    """Return the highest intensity over that of the same pupil without phase."""
    flat = replace(pupil(state), phase=np.zeros((1, 1)))
    ideal = float(np.abs(field_at(flat, np.zeros(1), np.zeros(1), FEW_CELLS)).item() ** 2)
    return highest(state) / ideal


def highest(state: State) -> float:
    """Return the highest intensity, by a search that narrows around the largest sample."""
    middle, wide, best = np.zeros(2), 10 * airy_radius(state), 0.0
    for _ in range(4):
        axis = np.linspace(-wide, wide, 51)
        seen = intensity(state, middle[0] + axis, middle[1] + axis, FEW_CELLS)
        row, column = np.unravel_index(seen.argmax(), seen.shape)
        middle, wide, best = middle + axis[[column, row]], wide / 10, float(seen.max())
    return best


def centre_over_peak(state: State) -> float:
    return float(intensity(state, np.zeros(1), np.zeros(1), FEW_CELLS).item()) / highest(state)


def airy_radius(state: State) -> float:
    return AIRY * lens_and_source(state)[1].wavelength_um / numerical_aperture(state)


def rms(state: State) -> float:
    """Return the RMS of the wavefront without piston and tilt over the pupil outside its obscuration."""
    lens, source = lens_and_source(state)
    by_coefficients = is_altered(state) or state.optics.method == "seidel"
    if lens.misaligned and not by_coefficients:
        return space_pupil.rms_waves(lens, source)
    node, weight = leggauss(24)
    dark = lens.mask.obscuration**2
    rho, angle = np.sqrt((1 + dark + (1 - dark) * node) / 2)[:, None], 2 * np.pi * (np.arange(48) + 0.5) / 48
    xi, eta = (rho * np.sin(angle)).ravel(), (rho * np.cos(angle)).ravel()
    waves = shape(coefficients(state), xi, eta) if by_coefficients else on_sphere(lens, source, xi, eta)
    share = np.repeat(weight, angle.size) / (2 * angle.size)
    return rms_about_plane(waves, xi, eta, share)


def left_out(state: State) -> float:
    """Return the RMS of what exact rays have beyond the six coefficients, over a uniform grid of the pupil."""
    lens, source = lens_and_source(state)
    node, weight = leggauss(20)
    rho, angle = np.sqrt((1 + node) / 2)[:, None], 2 * np.pi * (np.arange(44) + 0.5) / 44
    xi, eta = (rho * np.sin(angle)).ravel(), (rho * np.cos(angle)).ravel()
    rest = on_sphere(lens, source, xi, eta) + shape(
        coefficients(state), xi, eta
    )  # the paths are longer where W is less
    return rms_about_plane(rest, xi, eta, np.repeat(weight, angle.size))


def on_sphere(lens: Lens, source: Source, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return the paths of rays less the chief ray's, waves, on the reference sphere through the exit pupil."""
    system = system_of(lens, source.wavelength_um)
    rays, chief = (fill(lens)(system, source, *points) for points in ((xi, eta), (np.zeros(1), np.zeros(1))))
    away = np.stack([rays.x - chief.x, rays.y - chief.y])
    radius = (system.thickness[-1] - exit_pupil_mm(system)) / chief.k[2].item()
    back = back_to_sphere((rays.k[:2] * away).sum(0), (away**2).sum(0), radius)
    return (rays.path - chief.path - system.last * back) / system.wavelength


def centroid_y(state: State) -> float:
    """Return the centroid of the light, µm: the mean landing point −∂w/∂f of the pupil's light."""
    lens, source = lens_and_source(state)
    if lens.misaligned:
        return float(space_pupil.centroid_um(lens, source)[1])
    return float(sums(state).centroid_um)


def spread(axis: int) -> Callable[[State], float]:
    """Return the measure of the standard deviation along x (1) or y (0) in the window on the screen, µm."""

    def deviation(state: State) -> float:
        shown = compute.live(state).psf
        values = intensity(state, shown.x_um, shown.y_um).sum(1 - axis)
        place = (shown.y_um, shown.x_um)[axis]
        share = values / values.sum()
        return float(np.sqrt(share @ place**2 - (share @ place) ** 2))

    return deviation


def r_squared(state: State) -> float:
    """Return R² of the state's method against the plain sum, in the window in which the Accuracy panel measures it."""
    from p2sf_explorer.compute.reference import measure

    shown = measure(compute.live(state), False, lambda: False, lambda part: None).picture
    return likeness(shown.values, np.abs(_exact_field(state, shown.x_um, shown.y_um)) ** 2)


def r_squared_narrow(state: State) -> float:
    """Return R² of the six coefficients' picture against the plain sum, both on 32² samples over 22.12 µm."""
    axis = (np.arange(32) - 16) * (22.12 / 32)
    by_hand = change(state, free_pupil=True, added_waves=tuple(coefficients(state)[term] for term in TERMS))
    return likeness(intensity(by_hand, axis, axis), np.abs(_exact_field(state, axis, axis)) ** 2)


def _exact_field(state: State, x_um: np.ndarray, y_um: np.ndarray) -> np.ndarray:
    lens, source = lens_and_source(state)
    return field_at(pupil_of(lens, source, lens.aim), x_um, y_um, 2 * CELLS)


def likeness(shown: np.ndarray, truth: np.ndarray) -> float:
    shown, truth = shown / shown.sum(dtype=float), truth / truth.sum()
    return 1 - float(((shown - truth) ** 2).sum() / ((truth - truth.mean()) ** 2).sum())


# The database


def interpolation_error(rule: str) -> Callable[[State], float]:
    """Return the measure of what a rule loses in W22, waves, at the middle of every gap between the nodes.

    W22 is a parabola in 1/(distance to the entrance pupil) (handbook 7.1). "linear": a straight line over 1/depth
    through the two nodes beside; "table1": a parabola over depth itself through the three nearest nodes.
    """

    def error(state: State) -> float:
        from p2sf_explorer.compute.views.database import nodes, question

        space = nodes(question(compute.live(state)).question)
        depths, blue = space.depths_mm, float(space.wavelengths_um[:2].mean())  # waves are the most in blue
        lens, _ = lens_and_source(state)
        plane = entrance_pupil(system_of(lens, blue))[0]
        tried = [1.5 * depths[0], 3 * depths[0], 9 * depths[0]]
        widest = float(space.field_slopes[-2:].mean())
        waves = [lens_coefficients(lens, Source(d, widest, blue))["w22"] for d in tried]
        exact = np.polynomial.Polynomial.fit([1 / (d + plane) for d in tried], waves, 2)
        found = _straight(depths, plane, exact) if rule == "linear" else _parabolas(depths, plane, exact)
        return float(np.abs(found).max())

    return error


def _straight(depths: np.ndarray, plane: float, exact: Callable) -> np.ndarray:
    near = 1 / depths
    middle = (near[1:] + near[:-1]) / 2
    values = exact(near / (1 + near * plane))
    return (values[1:] + values[:-1]) / 2 - exact(middle / (1 + middle * plane))


def _parabolas(depths: np.ndarray, plane: float, exact: Callable) -> np.ndarray:
    finite = depths[np.isfinite(depths)]
    missed = []
    for low, high in pairwise(1 / finite):
        d = 2 / (low + high)  # in the middle over 1/depth
        some = finite[np.sort(np.argsort(np.abs(finite - d))[:3])]
        weights = [np.prod([(d - b) / (a - b) for b in some if b != a]) for a in some]
        missed.append(weights @ exact(1 / (some + plane)) - exact(1 / (d + plane)))
    return np.array(missed)


def sharpening(state: State) -> float:
    """Return what sharpening gains, dB, from the pictures themselves: 10 log10 of the ratio of mean squares."""
    from p2sf_explorer.compute.views.image import COLUMNS, ROWS, coarse, question
    from p2sf_explorer.compute.views.photos import scene_values

    found = coarse(question(compute.live(change(state, method="seidel"))).question)
    truth = scene_values(state.photo.source, (ROWS, COLUMNS))
    before, after = (float(((picture - truth) ** 2).mean()) for picture in (found.before, found.after))
    return 10 * float(np.log10(before / after))


REFEREE: dict[str, Callable[[State], float]] = {
    "airy_radius_um": airy_radius,
    "numerical_aperture": numerical_aperture,
    "focal_length_mm": focal_length,
    "image_height_mm": image_height,
    **{f"{term}_waves": (lambda state, term=term: coefficients(state)[term]) for term in TERMS},
    "rms_waves": rms,
    "left_out_waves": left_out,
    "strehl": strehl,
    "centre_over_peak": centre_over_peak,
    "radius_80_um": radius_80,
    "dark_ring_um": lambda state: beside_centre(state)[0],
    "ring_over_peak": lambda state: beside_centre(state)[1],
    "valley_over_peak": valley_over_peak,
    "spikes": lambda state: bright_directions(spikes(state)),
    "spike_over_gap": lambda state: float(spikes(state).max() / np.median(spikes(state))),
    "blur_corners": lambda state: bright_directions(blur(state)),
    "centroid_y_um": centroid_y,
    "spread_x_um": spread(1),
    "spread_y_um": spread(0),
    "contrast_tangential": contrast("y"),
    "contrast_sagittal": contrast("x"),
    "signed_contrast_tangential": signed_contrast,
    "petzval_focus_um": third_order_focus(-0.5),
    "sagittal_focus_um": third_order_focus(0.0),
    "tangential_focus_um": third_order_focus(1.0),
    "real_sagittal_focus_um": ray_focus(False),
    "real_tangential_focus_um": ray_focus(True),
    "distortion_percent": distortion,
    "axial_colour_um": axial_colour,
    "r_squared": r_squared,
    "r_squared_narrow": r_squared_narrow,
    "table1_error_waves": interpolation_error("table1"),
    "linear_error_waves": interpolation_error("linear"),
    "sharpening_db": sharpening,
}
# What the program says about itself, or what is exact by definition: there is no other road to it.
OWN_ACCOUNT = ("stop_surface", "numbers", "rays", "photo_psfs", "exact_database_error_waves")
