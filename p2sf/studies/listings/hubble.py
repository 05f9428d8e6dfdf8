"""The Hubble telescope of M. Laikin, Lens Design, 4th edition, page 200, with its curved image surface.

Listed from Ansys OpticStudio 2023 R1.02 as constants of a test of optiland (MIT licence); numbers only.
"""

from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.mask import PupilMask
from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Aperture, Lens, Surface, with_mask
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import f_number, find_stop, paraxial_rays, pupils
from p2sf.paraxial.seidel import seidel_sums
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.field_curves import heights, real_foci
from p2sf.raytrace.pencil import displayed_opd, pencil
from p2sf.raytrace.trace import Trace, trace
from p2sf.studies.listings.row import OPTICSTUDIO, ListedNumber, numbers_of
from p2sf.studies.other_sampling import pupil_grid

UM = 0.55
FIELD_DEG = 0.15
LENS = Lens(
    (
        Surface(-11040.02286, -4910.01016, MIRROR, -1.001152),
        Surface(-1349.31166, 6365.20955, MIRROR, -1.483014),
    ),
    Aperture("entrance_pupil_diameter", 2400.0),
    1,
    name="Hubble (Laikin)",
    aim="paraxial",
    wavelengths_nm=(550.0,),
    sensor_radius=-635.38227,
)
SOURCE = f"{OPTICSTUDIO} 2023 R1.02, listed in optiland"
FULL_FIELD = Source(wavelength_um=UM, field_deg=(0.0, FIELD_DEG))
DIGITS = "half a unit of the last printed digit"
RINGS = 6
HOLE = 177.80035 / 1200


def rows() -> Iterator[ListedNumber]:
    """Yield every number of the listings."""
    listed = numbers_of("hubble")
    yield from _first_order(listed["first_order"])
    yield from _seidel(listed["seidel_magnitudes_mm_like_listing"])
    yield from _rays(listed["rays"]["rows"])
    yield from _spots(listed["spot_um"])
    yield from _wavefront(listed)
    yield from _field_curves(listed["field_curvature"])


def _row(
    group: str, quantity: str, listed: float, ours: float, tolerance: float, why: str = DIGITS, **more: Any
) -> ListedNumber:
    return ListedNumber(group, quantity, LENS.name, SOURCE, float(listed), float(ours), tolerance, why, **more)


def _first_order(listed: dict[str, float]) -> Iterator[ListedNumber]:
    pupil = pupils(LENS, UM)
    older = "read from an older file, whose radii have nine digits"
    focal = float(cardinal_points(LENS, UM).effective_focal_length)
    more: dict[str, Any] = {"unit": "mm", "explained": older, "within": 2e-3}
    yield _row("first order", "focal length", listed["focal_length"], focal, 5e-7, **more)
    ours = {
        "entrance_pupil_diameter": (pupil.entrance_diameter, 5e-8),
        "exit_pupil_diameter": (pupil.exit_diameter, 5e-5),
        "exit_pupil_from_image": (pupil.exit_from_last - LENS.sensor_mm, 5e-4),
        "f_number": (abs(f_number(LENS, UM)), 5e-6),
    }
    for name, (value, tolerance) in ours.items():
        yield _row("first order", name.replace("_", " "), listed[name], float(value), tolerance)


def _seidel(listed: list[float]) -> Iterator[ListedNumber]:
    flat = Lens(LENS.surfaces, LENS.aperture, 1, wavelengths_nm=LENS.wavelengths_nm)
    rays = paraxial_rays(flat, np.inf, UM, find_stop(flat))
    sums = seidel_sums(flat, rays, FULL_FIELD.field_slope).total()
    for name, stated, own in zip(("I", "II", "III", "IV", "V"), listed, sums.columns(), strict=True):
        yield _row("Seidel sums", f"|S_{name}|", stated, abs(float(own)), 5e-7, unit="mm")


@lru_cache(maxsize=32)
def _landing(h_x: float, h_y: float, points: tuple[tuple[float, float], ...]) -> Trace:
    """Return rays through points of the pupil to the curved image, in the axes of its vertex."""
    source = Source(wavelength_um=UM, field_deg=(FIELD_DEG * h_x, FIELD_DEG * h_y))
    xi, eta = np.array(points).T
    aimed = pupil_rays(LENS, source, xi, eta)
    return trace(LENS, aimed.origins, aimed.directions, UM)


def _rays(listed: list[list[float]]) -> Iterator[ListedNumber]:
    for h_x, h_y, p_x, p_y, *stated in listed:
        found = _landing(h_x, h_y, ((p_x, p_y),))
        ours = [*found.points[-1, 0, :2].tolist(), *found.cosines[0, :2].tolist()]
        for name, value, own in zip(("x, mm", "y, mm", "L", "M"), stated, ours, strict=True):
            yield _row("rays", f"ray ({h_y:g}; {p_x:g}, {p_y:g}): {name}", value, own, 6e-10)


def _spots(listed: dict[str, dict[str, float]]) -> Iterator[ListedNumber]:
    """Yield spots of rings k/6 with 6k rays, without the ray of the centre, x and y in the axes of the vertex."""
    points = [
        (k / RINGS * np.sin(turn), k / RINGS * np.cos(turn))
        for k in range(1, RINGS + 1)
        for turn in 2 * np.pi * np.arange(6 * k) / (6 * k)
    ]
    for name, field in (("axis", 0.0), ("full_field", 1.0)):
        places = _landing(0.0, field, (*points, (0.0, 0.0))).points[-1, :, :2]
        apart = UM_PER_MM * np.hypot(*(places[:-1] - places[-1]).T)
        why = "a unit of the last printed digit of the rays"
        yield _row(
            "spots", f"RMS, {name}", listed[name]["rms"], float(np.sqrt(np.mean(apart**2))), 5e-7, why, unit="µm"
        )
        yield _row("spots", f"largest, {name}", listed[name]["maximum"], float(apart.max()), 5e-7, why, unit="µm")
    rays = pencil(LENS, FULL_FIELD, *np.array(points).T)
    along = float(np.sqrt(np.mean(rays.x_um**2 + rays.y_um**2)))
    told = "the listing measures along the plane of the vertex, and we along the surface, which is 13.7° steeper there"
    more: dict[str, Any] = {"unit": "µm", "explained": told, "within": 0.03 * listed["full_field"]["rms"]}
    yield _row("spots", "RMS in the plane that touches, full field", listed["full_field"]["rms"], along, 5e-7, **more)


def _wavefront(listed: dict[str, Any]) -> Iterator[ListedNumber]:
    terms = zernike_fit(LENS, FULL_FIELD, "fringe", 16).waves
    for number, stated in listed["fringe_full_field_waves"].items():
        yield _row(
            "Fringe terms",
            f"term {number}, full field",
            stated,
            terms[int(number) - 1],
            1.5e-8,
            "rounding of paths of 16 m, 6e-9 waves, twice",
            unit="waves",
        )
    grid = pupil_grid(64)
    xi, eta = grid.points
    ring = np.hypot(xi, eta) >= HOLE
    waves = displayed_opd(LENS, FULL_FIELD, xi[ring], eta[ring])
    stated = listed["rms_full_field_waves"]["value"]
    yield _row("wavefront", "RMS over its grid of 64²", stated, float(waves.std()), 5e-6, unit="waves")
    converged = zernike_fit(with_mask(LENS, PupilMask(obscuration=HOLE)), FULL_FIELD).rms_with_tilt
    told = "the mean of 64² points, of which some lie on the rim; of all light there is more"
    yield _row("wavefront", "RMS", stated, converged, 5e-6, unit="waves", explained=told, within=3e-3)


def _field_curves(listed: dict[str, float]) -> Iterator[ListedNumber]:
    foci = real_foci(LENS, FULL_FIELD, FULL_FIELD.field_slope)
    distortion = 100 * float(heights(LENS, FULL_FIELD, FULL_FIELD.field_slope).distortion)
    yield _row("field curves", "distortion", listed["distortion_percent"], distortion, 5e-9, unit="%")
    yield _row("field curves", "sagittal focus", listed["sagittal_mm"], float(foci.sagittal), 5e-8, unit="mm")
    axis = float(real_foci(LENS, Source(wavelength_um=UM), 0.0).sagittal)
    yield _row("field curves", "focus on the axis", listed["zero_field_mm"], axis, 5e-8, unit="mm")
    stated = listed["tangential_mm"]
    yield _row("field curves", "tangential focus, its way", stated, _one_sided(), 5e-8, unit="mm")
    told = (
        "the listing divides the difference of two heights on the curved image, whose depths differ, by that of slopes"
    )
    yield _row(
        "field curves",
        "tangential focus",
        stated,
        float(foci.tangential),
        5e-8,
        unit="mm",
        explained=told,
        within=0.011,
    )


def _one_sided() -> float:
    """Return −Δy/Δ(dy/dz) of the chief ray and a ray at a thousandth of the pupil, as they meet the curved image."""
    found = _landing(0.0, 1.0, ((0.0, 0.0), (0.0, 1e-3)))
    y, slope = found.points[-1, :, 1], found.cosines[:, 1] / found.cosines[:, 2]
    return float(-(y[1] - y[0]) / (slope[1] - slope[0]))
