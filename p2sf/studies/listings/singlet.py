"""The singlet of ZOSPy's reference data: every analysis on the axis, at a skew field and at a finite distance.

Listed by ZOSPy (MREYE-LUMC, MIT licence) from Ansys OpticStudio 25.1.1; numbers only.
"""

from collections.abc import Iterator
from functools import lru_cache
from math import inf, sqrt
from typing import Any

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.domain import WHOLE
from p2sf.disc.zernike_terms import zernike_terms, zernike_values
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import abcd, cardinal_points
from p2sf.paraxial.pupils import f_number, numerical_aperture, paraxial_rays, pupils
from p2sf.psf.measures import mtf_of, parts_of
from p2sf.pupil.zernike_fit import decompose
from p2sf.raytrace.pencil import (
    displayed_opd,
    exit_radius,
    in_azimuth,
    on_sensor,
    opd_on_sphere,
    pencil,
    reaching_by_surfaces,
)
from p2sf.studies.listings.row import OPTICSTUDIO, ListedNumber, arrays_of, numbers_of, r_squared_gap
from p2sf.studies.other_sampling import fft_intensity, huygens_amplitude, pupil_grid

UM = 0.543
LENS = Lens(
    (Surface(), Surface(20.0, 1.0, ConstantIndex(1.5)), Surface(-20.0, 19.792)),
    Aperture("stop_semi_diameter", 1.0),
    1,
    name="ZOSPy singlet",
    aim="paraxial",
    wavelengths_nm=(543.0,),
)
SOURCE = f"{OPTICSTUDIO} 25.1.1, listed by ZOSPy"
POINTS = {
    "axis": Source(wavelength_um=UM),
    "skew": Source(wavelength_um=UM, field_deg=(10.0, 20.0)),
    # The object's point (1, 2) mm lies 10 mm before the entrance pupil, and its image is inverted.
    "finite": Source(
        10.0, wavelength_um=UM, field_deg=(-float(np.rad2deg(np.arctan(0.1))), -float(np.rad2deg(np.arctan(0.2))))
    ),
}
NODES = 24, 64
SPHERE = 2e-8  # of the radius of the reference sphere: by so much less the lists at 10 mm have it smaller
DIGITS = "half a unit of the last printed digit"
FROM_A_SUM = "one unit of the last printed digit"
CURVE = "of a curve that is printed to be drawn"
SAMPLED = "the pupil is a grid of squares: what steps along its rim change falls as one over the points across it"
WINDOWED = "taken from a PSF in a window of √N·λF, which cuts off light; the loss falls as one over that width"


def rows() -> Iterator[ListedNumber]:
    """Yield every number of the listings."""
    cases = numbers_of("singlet")
    yield from _cardinal(cases["cardinal_points"]["values"])
    yield from _system(cases["system_data"]["values"])
    yield from _surface(cases["surface_data"])
    yield from _rays(cases["single_rays"]["rays"])
    yield from _fan(cases["ray_fan"])
    for name, case in cases.items():
        if name.startswith("wavefront_map"):
            yield _wavefront_map(name)
        elif "waves" in case:
            yield from _zernike(case)
        elif name.startswith("huygens_mtf"):
            yield from _contrast(name)
        elif name.startswith("huygens"):
            yield from _huygens(name, case)
        elif name.startswith("fft_mtf"):
            yield from _contrast(name)
        elif name.startswith(("fft_axis", "fft_skew")):
            yield from _fft(name, case)
    yield from _fringe(cases["zernike_fringe_axis_128"]["waves_peak"])
    yield from _through_focus(cases["fft_through_focus_mtf_64"])
    yield _quick_focus(cases["quick_focus"])


def _row(
    group: str, quantity: str, listed: float, ours: float, tolerance: float, why: str = DIGITS, **more: Any
) -> ListedNumber:
    return ListedNumber(group, quantity, LENS.name, SOURCE, float(listed), float(ours), tolerance, why, **more)


def _cardinal(values: dict[str, dict[str, float]]) -> Iterator[ListedNumber]:
    points = cardinal_points(LENS, UM)
    focal = float(points.effective_focal_length)
    front, rear = float(points.front_principal_from_first), float(points.rear_principal_from_last)
    ours = {
        "focal_length": (-focal, focal),
        "focal_planes": (front - focal, rear + focal),
        "principal_planes": (front, rear),
        "anti_principal_planes": (front - 2 * focal, rear + 2 * focal),
        "nodal_planes": (float(points.front_nodal_from_first), float(points.rear_nodal_from_last)),
        "anti_nodal_planes": (front - 2 * focal, rear + 2 * focal),
    }
    for name, pair in ours.items():
        for side, value in zip(("object", "image"), pair, strict=True):
            quantity = f"{name.replace('_', ' ')}, {side}"
            yield _row("cardinal points", quantity, values[name][side], value, 5e-7, unit="mm")


def _system(values: dict[str, float]) -> Iterator[ListedNumber]:
    points, pupil = cardinal_points(LENS, UM), pupils(LENS, UM)
    number, na = float(f_number(LENS, UM)), float(numerical_aperture(LENS, inf, UM))
    sine = float(np.hypot(*_marginal_cosines()))
    ours = {
        "surfaces": (len(LENS.surfaces) + 1, 0.5),
        "stop": (LENS.stop_surface or 0, 0.5),
        "effective_focal_length_air": (points.effective_focal_length, 5e-6),
        "effective_focal_length_image": (points.effective_focal_length, 5e-6),
        "back_focal_length": (points.back_focal_distance, 5e-6),
        "total_track": (sum(surface.thickness for surface in LENS.surfaces), 5e-4),
        "image_space_f_number": (number, 5e-6),
        "paraxial_working_f_number": (1 / (2 * na), 5e-6),
        "working_f_number": (1 / (2 * sine), 5e-6),
        "image_space_na": (np.sin(np.arctan(na)), 5e-8),
        "stop_radius": (LENS.aperture.value, 1e-12),
        "paraxial_image_height": (0.0, 1e-12),
        "paraxial_magnification": (0.0, 1e-12),
        "entrance_pupil_diameter": (pupil.entrance_diameter, 5e-7),
        "entrance_pupil_position": (pupil.entrance_from_first, 5e-7),
        "exit_pupil_diameter": (pupil.exit_diameter, 5e-7),
        "exit_pupil_position": (pupil.exit_from_last - LENS.sensor_mm, 5e-6),
        "maximum_radial_field": (0.0, 1e-12),
        "primary_wavelength": (UM, 1e-12),
        "angular_magnification": (pupil.entrance_diameter / pupil.exit_diameter, 5e-8),
    }
    for name, (value, tolerance) in ours.items():
        yield _row("system data", name.replace("_", " "), values[name], float(value), tolerance)
    least = "the listing never states less than 1e-10"
    yield _row("system data", "object space NA", values["object_space_na"], 0.0, 5e-11, explained=least, within=1e-10)


def _marginal_cosines() -> tuple[float, float]:
    rays = pencil(LENS, POINTS["axis"], [0.0], [1.0])
    return float(rays.kx[0]), float(rays.ky[0])


def _surface(case: dict[str, Any]) -> Iterator[ListedNumber]:
    crossings = reaching_by_surfaces(LENS, POINTS["axis"], [0.0], [1.0]).on_surfaces
    front, rear = LENS.surfaces[1:]
    heights = crossings.points[1:3, 1, 0]
    thickness = front.thickness + float(rear.sag(0.0, heights[1])) - float(front.sag(0.0, heights[0]))
    for side in ("x", "y"):
        yield _row("surface data", f"edge thickness, {side}", case["edge_thickness"][side], thickness, 5e-7, unit="mm")
    power = -float(abcd(LENS, UM)[1, 0])
    for where, stated in case["powers"].items():
        ours = {
            ("surf", "2"): (0.5 * front.curvature, 5e-7),
            ("surf", "3"): (-0.5 * rear.curvature, 5e-7),
            ("power", "2.0,3.0"): (power, 5e-7),
            ("efl", "2.0,3.0"): (1 / power, 5e-4),
            ("f_number", "2.0,3.0"): (float(f_number(LENS, UM)), 5e-4),
        }
        for (name, surfaces), (value, tolerance) in ours.items():
            quantity = f"{name} of {surfaces}, {where.replace('_', ' ')}"
            yield _row("surface data", quantity, stated[name][surfaces], value, tolerance)


def _rays(listed: list[dict[str, Any]]) -> Iterator[ListedNumber]:
    for case in listed:
        label = f"ray ({case['px']:g}, {case['py']:g})"
        real = zip(case["real"], _real_ray(case["px"], case["py"]), strict=True)
        flat = zip(case["paraxial"], _paraxial_ray(case["px"], case["py"]), strict=True)
        for kind, pairs in (("", real), (", paraxial", flat)):
            for (stated, ours), vertex in zip(pairs, (0.0, 0.0, 1.0, 20.792), strict=True):
                if case["local"]:
                    ours[POSITION] = ours[POSITION] - np.array([0.0, 0.0, vertex])
                for name, part, tolerance in COLUMNS[: len(ours)]:
                    apart = float(np.abs(np.subtract(stated[part], ours[name])).max())
                    quantity = f"{label}{kind}, surface {stated[0]}: {name}"
                    yield _row("single rays", quantity, 0.0, apart, tolerance)


POSITION = "position, mm"
COLUMNS = (
    (POSITION, slice(1, 4), 6e-12),
    ("cosines", slice(4, 7), 6e-11),
    ("normal", slice(7, 10), 6e-11),
    ("angle of incidence, °", slice(10, 11), 6e-10),
    ("path, mm", slice(11, 12), 6e-10),
)


def _real_ray(px: float, py: float) -> Iterator[dict[str, np.ndarray]]:
    found = reaching_by_surfaces(LENS, POINTS["axis"], [px], [py]).on_surfaces
    index = np.array([1.0, 1.0, 1.5, 1.0])
    along = found.cosines[..., 0] / index[:, None]
    onward = np.concatenate([along[1:], along[-1:]])
    before = np.concatenate([found.points[:1], found.points[:-1]])[..., 0]
    for place, surface in enumerate((*LENS.surfaces, LENS.sensor_surface)):
        x, y, _ = point = found.points[place, :, 0]
        _, slope = surface.sag_and_slope(x * x + y * y)
        normal = np.array([2 * slope * x, 2 * slope * y, -1.0])
        normal /= np.linalg.norm(normal)
        angle = np.rad2deg(np.arccos(min(1.0, abs(float(normal @ along[place])))))
        lengths = np.array([angle]), np.array([np.linalg.norm(point - before[place])])
        yield dict(zip((name for name, *_ in COLUMNS), (point, onward[place], normal, *lengths), strict=True))


def _paraxial_ray(px: float, py: float) -> Iterator[dict[str, np.ndarray]]:
    rays, z = paraxial_rays(LENS, inf, UM), 0.0
    heights = [*rays.y.tolist(), float(rays.y[-1] + rays.nu[-1] * LENS.sensor_mm)]
    slopes = (rays.nu[1:] / rays.index[1:]).tolist()
    for y, slope, surface in zip(heights, [*slopes, slopes[-1]], (*LENS.surfaces, Surface()), strict=True):
        direction = np.array([slope * px, slope * py, 1.0])
        yield {POSITION: np.array([y * px, y * py, z]), "cosines": direction / np.linalg.norm(direction)}
        z += surface.thickness


def _fan(case: dict[str, list[float]]) -> Iterator[ListedNumber]:
    pupil, zero = np.array(case["pupil"]), np.zeros(len(case["pupil"]))
    tangential, sagittal = pencil(LENS, POINTS["axis"], zero, pupil), pencil(LENS, POINTS["axis"], pupil, zero)
    for name, ours in (("tangential_y_um", tangential.y_um), ("sagittal_x_um", sagittal.x_um)):
        apart = float(np.abs(ours - case[name]).max())
        yield _row("ray fans", name[:-3].replace("_", " ") + ", 81 points", 0.0, apart, 1e-10, FROM_A_SUM, unit="µm")


def opd(source: Source, xi: np.ndarray, eta: np.ndarray, sphere: float = 1.0) -> np.ndarray:
    """Return the displayed OPD at points of the pupil in the axes of the sensor, waves.

    ``sphere``: by how much the radius of the reference sphere is larger than it should be.
    """
    lens, points = in_azimuth(LENS, source.azimuth_deg, xi, eta)
    if sphere == 1:
        return displayed_opd(lens, source, *points)
    rays = pencil(lens, source, *points)
    return opd_on_sphere(rays, exit_radius(lens, source, rays) * sphere)


@lru_cache(maxsize=8)
def _terms(system: str, count: int, sphere: float = 1.0, order: Any = "noll") -> np.ndarray:
    nodes = WHOLE.nodes(NODES)
    waves = opd(POINTS[system], nodes.xi, nodes.eta, sphere)
    return decompose(nodes, waves, order, zernike_terms(order, count)).waves


def _zernike(case: dict[str, Any]) -> Iterator[ListedNumber]:
    system, listed, sampling = case["system"], np.array(case["waves"]), case["settings"]["sampling"]
    ours, group = _terms(system, len(listed)), f"Zernike terms, {system}, {sampling}²"
    # By so much the terms change with the reference sphere.
    drift = np.abs(_terms(system, len(listed), 1 - SPHERE) - ours) if system == "finite" else np.zeros(len(listed))
    smaller = (
        "its reference sphere at 10 mm is smaller by 1e-8 of the radius, in all terms alike; the last digit by one"
    )
    for number, (stated, own) in enumerate(zip(listed, ours, strict=True), 1):
        more = {"explained": smaller, "within": 1.1e-8 + drift[number - 1]} if drift.any() else {}
        yield _row(group, f"term {number}", stated, own, 6e-9, unit="waves", **more)
    yield from _figures(case, ours, float(np.linalg.norm(drift)))


def _figures(case: dict[str, Any], terms: np.ndarray, drift: float) -> Iterator[ListedNumber]:
    """Yield the figures beside a list of terms: over the program's own grid of rays, and of the terms themselves."""
    system, sampling = case["system"], case["settings"]["sampling"]
    group, xi_eta = f"Zernike figures, {system}, {sampling}²", pupil_grid(sampling).points
    waves = opd(POINTS[system], *xi_eta)
    plane = np.stack([np.ones(waves.size), *xi_eta], axis=1)
    level = waves - plane @ np.linalg.lstsq(plane, waves, rcond=None)[0]
    rest = waves - terms @ zernike_values(zernike_terms("noll", len(terms)), *xi_eta)
    spread, flat = sqrt(float(terms[1:] @ terms[1:])), sqrt(float(terms[3:] @ terms[3:]))
    ours = {
        ("peak_to_valley_to_chief",): (np.ptp(waves), 8 * drift),
        ("peak_to_valley_to_centroid",): (np.ptp(level), 8 * drift),
        ("from_rays", "rms_to_chief"): (waves.std(), 2 * drift),
        ("from_rays", "rms_to_centroid"): (level.std(), 2 * drift),
        ("from_rays", "variance"): (level.var(), 4 * level.std() * drift),
        ("from_rays", "strehl_ratio"): (np.exp(-((2 * np.pi * level.std()) ** 2)), 0.0),
        ("from_fit", "rms_to_chief"): (spread, 2 * drift),
        ("from_fit", "rms_to_centroid"): (flat, 2 * drift),
        ("from_fit", "variance"): (flat**2, 4 * flat * drift),
        ("from_fit", "strehl_ratio"): (np.exp(-((2 * np.pi * flat) ** 2)), 0.0),
        ("rms_fit_error",): (sqrt(float(np.mean(rest**2))), 0.0),
        ("maximum_fit_error",): (float(np.abs(rest).max()), 1e-8),
    }
    smaller = "by the reference sphere at 10 mm, as the terms"
    for keys, (value, more) in ours.items():
        stated = case[keys[0]] if len(keys) == 1 else case[keys[0]][keys[1]]
        words = " ".join(keys).replace("_", " ")
        told = {"explained": smaller, "within": 1e-8 + more} if drift else {}
        yield _row(group, words, stated, float(value), 1.1e-8, FROM_A_SUM, unit="", **told)


def _fringe(listed: list[float]) -> Iterator[ListedNumber]:
    ours = _terms("axis", len(listed), 1.0, "fringe")
    for number, (stated, own) in enumerate(zip(listed, ours, strict=True), 1):
        yield _row("Fringe terms, axis", f"term {number}", stated, own, 6e-7, unit="waves")


def _wavefront_map(name: str) -> ListedNumber:
    listed = arrays_of("singlet")[name]
    count = len(listed)
    axis = (np.arange(count) - count // 2) / (count // 2 - 1)
    xi, eta = np.meshgrid(axis, axis)
    inside = xi**2 + eta**2 <= 1
    apart = float(np.abs(opd(POINTS["axis"], xi[inside], eta[inside]) - listed[inside]).max())
    missed = int((np.isfinite(listed) != inside).sum())
    quantity = f"{count} × {count} points"
    return _row("wavefront maps", quantity, 0.0, apart if not missed else inf, 1e-10, FROM_A_SUM, unit="waves")


def _huygens(name: str, case: dict[str, Any]) -> Iterator[ListedNumber]:
    settings, system = case["settings"], case["system"]
    listed, source = arrays_of("singlet")[name], POINTS[system]
    wide = settings["pupil_sampling"], settings["image_sampling"], case["spacing_um"]
    amplitude = huygens_amplitude(LENS, source, *wide)
    label = f"{system}, pupil {wide[0]}², image {wide[1]}²"
    made = "rounding of the listing, made by the recipe of its sampling"
    if settings["type"] == "linear":
        gap = r_squared_gap(np.abs(amplitude) ** 2, listed)
        yield _row("Huygens PSFs", f"1 − R², {label}", 0.0, gap, 1e-16, made)
    else:
        real = (amplitude * chief_carrier(LENS, source, wide[1], wide[2])).real / np.abs(amplitude).max()
        apart = float(np.abs(real - listed).max())
        yield _row("Huygens PSFs", f"real part, {label}", 0.0, apart, 2e-10, made)
    if not settings["image_delta_um"]:
        # The spacing λF_w/√N of the axis, for the skew field too.
        yield _row(
            "Huygens PSFs",
            f"default spacing, {label}",
            wide[2],
            _width_um() / sqrt(wide[0]),
            1e-9,
            FROM_A_SUM,
            unit="µm",
        )
    if "strehl_listed" in case:
        peak = float(np.abs(amplitude).max()) ** 2
        yield _row("Huygens PSFs", f"Strehl ratio, {label}", case["strehl_listed"], peak, 5.1e-4)


def chief_carrier(lens: Lens, source: Source, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the phase factor of the chief ray over the samples: a real part is that of the whole plane waves."""
    rays = on_sensor(lens, [source], np.zeros(1), np.zeros(1))
    axis = (np.arange(pixels) - pixels // 2) * pixel_um / source.wavelength_um
    waves = axis * np.ravel(rays.chief_kx)[0] + (axis * np.ravel(rays.chief_ky)[0])[:, None]
    carrier: np.ndarray = np.exp(2j * np.pi * waves)
    return carrier


def _fft(name: str, case: dict[str, Any]) -> Iterator[ListedNumber]:
    listed, sampling, system = arrays_of("singlet")[name], case["settings"]["sampling"], case["system"]
    linear = 10**listed if name.endswith("log") else listed
    made, pitch = fft_intensity(LENS, POINTS[system], sampling)
    row, column = np.unravel_index(linear.argmax(), linear.shape)
    high, wide = np.unravel_index(made.argmax(), made.shape)
    part = made[high - row : high - row + len(linear), wide - column : wide - column + len(linear)]
    label = f"{system}, {sampling}²"
    if system == "axis":
        yield _row("FFT PSFs", f"spacing, {label}", case["spacing_um"], pitch, 5e-4, unit="µm")
    if system == "skew":
        told = "how the listing lays the pupil of a skew field on its grid is not stated, and not as on the axis"
        gap = r_squared_gap(part, linear)
        yield _row("FFT PSFs", f"1 − R², {label}", 0.0, gap, 1e-9, explained=told, within=10.0)
        return
    apart = float(np.abs(part / part.max() - linear / linear.max()).max())
    told = "the listing normalises otherwise, in the fifth digit"
    yield _row(
        "FFT PSFs",
        f"largest difference over the peak, {label}",
        0.0,
        apart,
        3e-5,
        "of the peak: the listing has no more equal digits",
    )
    yield _row("FFT PSFs", f"peak, {label}", linear.max(), part.max(), 1e-6, explained=told, within=5e-5)


@lru_cache(maxsize=16)
def _converged(frequency: tuple[float, ...], shift_mm: float = 0.0) -> np.ndarray:
    """Return the contrast on the axis at frequencies, per mm, which is the same in all directions."""
    parts, method = parts_of(with_sensor(LENS, LENS.sensor_mm + shift_mm), POINTS["axis"])
    return np.asarray(mtf_of(parts, method, frequency).tangential)


def _contrast(name: str) -> Iterator[ListedNumber]:
    arrays = arrays_of("singlet")
    frequency, listed = arrays[f"{name}_frequency"], arrays[name]
    curves = {"tangential": listed[:, -2], "sagittal": listed[:, -1]}
    ours = dict.fromkeys(curves, _converged(tuple(frequency.tolist())))
    if listed.shape[1] == 4:
        limit = diffraction_limit(frequency, _width_um())
        curves |= {"diffraction limit, tangential": listed[:, 0], "diffraction limit, sagittal": listed[:, 1]}
        ours |= dict.fromkeys(("diffraction limit, tangential", "diffraction limit, sagittal"), limit)
    kind, *sampling = name.replace("_mtf", "").split("_")
    told, within = SAMPLED, CONTRAST / int(sampling[0])
    if name.startswith("huygens_mtf"):
        told, within = WINDOWED, WINDOW * _width_um() / _window_um(*map(int, sampling))
    for words, curve in curves.items():
        apart = float(np.abs(curve - ours[words]).max())
        quantity = f"{kind} {' '.join(sampling)}, {words}, {len(frequency)} frequencies"
        yield _row("contrast", quantity, 0.0, apart, 1e-3, CURVE, explained=told, within=within)


CONTRAST = 0.8  # over the points across a pupil: what steps along its rim change
WINDOW = 0.45  # of λF over the width of a window: the light of Airy's disc beyond it, and what that adds to the rest


def _width_um() -> float:
    """Return λF_w, µm, with the working f-number 1/(2 sin) of the marginal ray."""
    return UM / 2 / float(np.hypot(*_marginal_cosines()))


def _window_um(pupil: int, pixels: int) -> float:
    """Return the width of the PSF from which a contrast was listed: 1 µm a sample for 32 and 64, else λF_w/√N."""
    return pixels * (1.0 if (pupil, pixels) == (32, 64) else _width_um() / sqrt(pupil))


def diffraction_limit(frequency_per_mm: np.ndarray, width_um: float) -> np.ndarray:
    """Return the contrast of a clear disc, (2/π)(arccos s − s√(1 − s²)), s = νλF (Goodman 2005, eq. 6-31)."""
    s = np.clip(frequency_per_mm * width_um / UM_PER_MM, 0.0, 1.0)
    limit: np.ndarray = 2 / np.pi * (np.arccos(s) - s * np.sqrt(1 - s * s))
    return limit


def _through_focus(case: dict[str, Any]) -> Iterator[ListedNumber]:
    arrays = arrays_of("singlet")
    defocus, listed = arrays["fft_through_focus_mtf_64_defocus"], arrays["fft_through_focus_mtf_64"]
    some = slice(None, None, 30)
    frequency = (case["frequency_per_mm"],)
    ours = [float(_converged(frequency, float(shift))[0]) for shift in defocus[some]]
    for column, words in enumerate(("tangential", "sagittal")):
        apart = float(np.abs(listed[some, column] - ours).max())
        quantity = f"fft 64, through focus, {words}, every 30th of 300 places"
        yield _row("contrast", quantity, 0.0, apart, 1e-3, CURVE, explained=SAMPLED, within=CONTRAST / 64)


def _quick_focus(case: dict[str, Any]) -> ListedNumber:
    """Return the row of the focus of least RMS spot: Σ(y + z·slope)² is least at −Σ y·slope/Σ slope²."""
    nodes = WHOLE.nodes(NODES)
    rays = pencil(LENS, POINTS["axis"], nodes.xi, nodes.eta)
    slopes = np.stack([rays.kx / rays.kz, rays.ky / rays.kz])
    places = np.stack([rays.dx, rays.dy])
    best = LENS.sensor_mm - float((nodes.weight * places * slopes).sum() / (nodes.weight * slopes**2).sum())
    return _row("quick focus", "thickness", case["focused_thickness"], best, 5e-7, unit="mm")
