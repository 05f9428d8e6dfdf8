"""The LSST telescope, version 3.3, g band at 500 nm: rays, wavefronts and PSFs at four fields.

Listed by Ansys OpticStudio in 2019, test data of batoid (BSD 2-Clause licence); numbers only.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from p2sf.lens.lens import Aperture, Lens, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.pupils import pupils
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.rays import RayPupil
from p2sf.raytrace.pencil import displayed_opd, in_azimuth, on_sensor, pencil, rays_through, reaching_by_surfaces
from p2sf.studies.listings.row import FOLDER, OPTICSTUDIO, ListedNumber, arrays_of, numbers_of, r_squared_gap

UM = 0.5
SOURCE = f"{OPTICSTUDIO} of 2019, listed in batoid"
PIXELS, PIXEL_UM = 64, 0.289
SAMPLED_RIM = 4180.0 * (1 - 1 / 1023)  # mm, half a step of the listing's 1024 points inside
HOLES = {2: 900.0, 3: 550.0}  # mm, of mirrors 2 and 3, which block in the wavefront maps only
DIGITS = "half a unit of the last printed digit"


@lru_cache(maxsize=1)
def telescope() -> Lens:
    """Return the telescope, rays filling its paraxial entrance pupil."""
    return with_aim(find_lens(FOLDER.with_name("telescope.toml")), "paraxial")


def rows() -> Iterator[ListedNumber]:
    """Yield every number of the listings."""
    listed, lens = numbers_of("telescope"), telescope()
    pupil = pupils(lens, UM)
    yield _row(
        "first order", "exit pupil, diameter", listed["exit_pupil_diameter_mm"], abs(float(pupil.exit_diameter)), 5e-2
    )
    for case in listed["rays"]:
        yield from _ray(case)
    for case in listed["fields"]:
        yield from _field(case)


def _row(
    group: str, quantity: str, listed: float, ours: float, tolerance: float, why: str = DIGITS, **more: Any
) -> ListedNumber:
    return ListedNumber(group, quantity, "LSST telescope", SOURCE, float(listed), float(ours), tolerance, why, **more)


def _point(case: dict[str, Any]) -> Source:
    return Source(wavelength_um=UM, field_deg=(case["theta_x_deg"], case["theta_y_deg"]))


def _ray(case: dict[str, Any]) -> Iterator[ListedNumber]:
    source, lens = _point(case), telescope()
    turn = np.deg2rad(source.azimuth_deg)
    seen, points = in_azimuth(lens, source.azimuth_deg, np.array([case["Px"]]), np.array([case["Py"]]))
    found = reaching_by_surfaces(seen, source, *points).on_surfaces
    across, up = np.cos(turn), np.sin(turn)
    rotate = np.array([[across, up, 0.0], [-up, across, 0.0], [0.0, 0.0, 1.0]])
    places = (rotate @ found.points)[..., 0]
    places[:, 2] -= lens.surfaces[0].thickness  # the origin is the vertex of the first mirror
    cosines = (rotate @ found.cosines)[..., 0]
    cosines /= np.linalg.norm(cosines, axis=1)[:, None]
    onward = np.concatenate([cosines[1:], cosines[-1:]])
    label = f"ray ({case['theta_x_deg']:g}°, {case['theta_y_deg']:g}°; {case['Px']:g}, {case['Py']:g})"
    for number, stated in enumerate(case["rows"]):
        apart = float(np.abs(places[number] - stated[:3]).max())
        yield _row(
            "rays", f"{label}, surface {number + 1}: position", 0.0, apart, 1e-7, "eleven printed digits", unit="mm"
        )
        # Cosines are listed with the sign of their z, which is always positive.
        signed = onward[number] * np.sign(onward[number][2])
        turned = float(np.abs(signed - stated[3:6]).max())
        yield _row("rays", f"{label}, surface {number + 1}: cosines", 0.0, turned, 6e-11)


def _field(case: dict[str, Any]) -> Iterator[ListedNumber]:
    source, lens, arrays = _point(case), telescope(), arrays_of("telescope")
    label = f"({case['theta_x_deg']:g}°, {case['theta_y_deg']:g}°)"
    chief = on_sensor(lens, [source], np.zeros(1), np.zeros(1))
    for name, stated, own in zip(
        ("x", "y"), case["chief_ray_landing_listed_mm"], (chief.chief_x, chief.chief_y), strict=True
    ):
        yield _row("chief rays", f"{name}, {label}", stated, float(np.ravel(own)[0]), 6e-7, unit="mm")
    yield from _map(case, source, label)
    listed = arrays[f"psf_{case['array']}"]
    rim = replace(lens, aperture=Aperture("stop_semi_diameter", SAMPLED_RIM))
    drawn_in = "its pupil of 1024 points ends half a step inside the rim, as ours here"
    yield _row("Huygens PSFs", f"1 − R², {label}", 0.0, r_squared_gap(_picture(rim, source), listed), 1e-6, drawn_in)


def _map(case: dict[str, Any], source: Source, label: str) -> Iterator[ListedNumber]:
    listed = arrays_of("telescope")[f"opd_{case['array']}"]
    axis = (np.arange(len(listed)) - len(listed) // 2) / (len(listed) // 2 - 1)
    xi, eta = (part.ravel() for part in np.meshgrid(axis, axis))
    seen, turned = in_azimuth(_with_holes(), source.azimuth_deg, xi, eta)
    open_there = (xi**2 + eta**2 <= 1) & pencil(seen, source, *turned, clip=True).passed
    waves = displayed_opd(seen, source, *(part[open_there] for part in turned))
    stated = listed.ravel()
    agree = np.array_equal(np.isfinite(stated), open_there)
    apart = float(np.abs(waves - stated[open_there]).max()) if agree else np.inf
    yield _row("wavefront maps", f"{label}, 32 × 32 points", 0.0, apart, 6e-7, "seven printed digits", unit="waves")
    yield _row(
        "wavefront maps",
        f"peak to valley, {label}",
        case["opd_pv_listed_waves"],
        float(np.ptp(waves)),
        6e-5,
        unit="waves",
    )
    yield _row("wavefront maps", f"RMS, {label}", case["opd_rms_listed_waves"], float(waves.std()), 6e-5, unit="waves")


def _picture(lens: Lens, source: Source) -> np.ndarray:
    """Return the Huygens sum in the axes of the sensor: a picture of a lens of revolution is in those of the field."""
    pupil = RayPupil(lens, source, clip=True)
    nodes = lens.pupil_domain.unfold(pupil.nodes(pupil.counts(window_reach_um(PIXELS, PIXEL_UM))))
    rays = rays_through(lens, source, nodes).arrived.turned(source.azimuth_deg)
    axis = (np.arange(PIXELS) - PIXELS // 2) * PIXEL_UM
    wavelets = rays.share * rays.amplitude * np.exp(2j * np.pi * (rays.phase + np.outer(axis, rays.fy)))
    intensity: np.ndarray = np.abs(wavelets @ np.exp(2j * np.pi * np.outer(rays.fx, axis))) ** 2
    return intensity


@lru_cache(maxsize=1)
def _with_holes() -> Lens:
    lens = telescope()
    surfaces = list(lens.surfaces)
    for number, radius in HOLES.items():
        surfaces[number] = replace(surfaces[number], inner_radius=radius)
    return replace(lens, surfaces=tuple(surfaces))
