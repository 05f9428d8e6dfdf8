"""Ray-trace optics for ISETCam (Wandell, Farrell et al.): a .mat file with the fields of ``optics.rayTrace``.

Its conventions, from its own importer and getters: lengths in mm, wavelengths in nm; PSFs (row, column,
field height, wavelength) with the field along +x, columns, and sample N/2 counted from 1 as the origin of
an even N; ``geometry.function`` real and ``fieldHeight`` ideal image heights; ``mag`` negative; ``maxfov``
half the diagonal field. W11 is not in the PSF: the geometry carries the distortion.
"""

import json
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from p2sf.conventions import NM_PER_UM, UM_PER_MM, degrees_from_slope
from p2sf.database.files.provenance import Stored
from p2sf.database.render import Sampling, critical_pixel_um, rendered_light
from p2sf.errors import ExportError
from p2sf.export.psf_cube import check_line
from p2sf.files.writing import write_beside
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import cardinal_points, magnification
from p2sf.paraxial.pupils import f_number, working_f_number
from p2sf.raytrace.pencil import pencil
from p2sf.version import program_version

MOST_PIXELS = 128  # ISETCam's own size
LEAST_HEIGHTS = 9  # its distortion is fitted by a polynomial of degree 8
RIM_RAYS = 64


@dataclass(frozen=True)
class IsetOptions:
    """The one object depth (None: the farthest of the database), and how the PSFs are sampled."""

    depth_mm: float | None = None
    pixels: int = MOST_PIXELS
    pixel_um: float | None = None
    heights: int = 13


DEFAULT = IsetOptions()


def write_iset(stored: Stored, path: str | os.PathLike[str], options: IsetOptions = DEFAULT) -> Path:
    """Write a database as ISETCam ray-trace optics, variable ``optics``; ExportError, DatabaseError, GeometryError."""
    from scipy.io import savemat

    if options.pixels % 2 or not 2 <= options.pixels <= MOST_PIXELS:
        raise ExportError(
            "{pixels} samples a side, but ISETCam takes an even number of samples up to {most}; give 64",
            pixels=options.pixels,
            most=MOST_PIXELS,
        )
    check_line(stored)
    if stored.database.space.field_slopes[0] > 0:
        raise ExportError("ISETCam's field heights start at 0 and this database does not; build it from field 0 on")
    if not stored.database.mask.round:
        raise ExportError(
            "ISETCam turns one PSF for each field height about the axis, and the mask in the stop is not round; write "
            "a stack or .fits, or take vanes, blades and phases away"
        )
    traced = ray_trace(stored, options)
    optics = {"type": "optics", "name": traced["name"], "model": "rayTrace", "rayTrace": traced}
    return write_beside(path, lambda handle: savemat(handle, {"optics": optics}, do_compression=True))


def ray_trace(stored: Stored, options: IsetOptions = DEFAULT) -> dict:
    """Return the fields of ``optics.rayTrace``."""
    database, lens = stored.database, stored.lens
    space = database.space
    depth = float(options.depth_mm or space.depths_mm[-1])
    slopes = np.linspace(0, space.field_slopes[-1], max(LEAST_HEIGHTS, options.heights))
    reference = float(space.wavelengths_um[len(space.wavelengths_um) // 2])
    ideal = np.abs(database.coefficients(depth, slopes, reference).image_height)
    shared = {"fieldHeight": _column(ideal), "wavelength": _column(space.wavelengths_um * NM_PER_UM)}
    real, light = traced_heights(lens, depth, slopes, space.wavelengths_um)
    pitch = options.pixel_um or critical_pixel_um(database)
    return {
        **first_order(lens, depth, reference),
        "name": lens.title or lens.name,
        "program": f"p2sf {program_version()}",
        "lensFile": lens.name,
        "provenance": json.dumps(stored.record),
        "aim": lens.aim,
        "objectDistance": depth,
        "maxfov": float(degrees_from_slope(slopes[-1])),
        "fov": float(degrees_from_slope(slopes[-1])),
        "psf": {
            "function": psf_function(stored, depth, slopes, options.pixels, pitch),
            "sampleSpacing": np.array([[pitch, pitch]]) / UM_PER_MM,
            **shared,
        },
        "geometry": {"function": np.abs(real), **shared},
        "relIllum": {"function": light, **shared},
    }


def first_order(lens: Lens, depth_mm: float, wavelength_um: float) -> dict:
    """Return ISETCam's scalars; its magnification is always negative."""
    return {
        "referenceWavelength": wavelength_um * NM_PER_UM,
        "mag": -abs(float(magnification(lens, depth_mm, wavelength_um))),
        "fNumber": float(f_number(lens, wavelength_um)),
        "effectiveFocalLength": float(cardinal_points(lens, wavelength_um).effective_focal_length),
        "effectiveFNumber": float(working_f_number(lens, depth_mm, wavelength_um)),
    }


def psf_function(stored: Stored, depth_mm: float, slopes: np.ndarray, pixels: int, pixel_um: float) -> np.ndarray:
    """Return unit-sum PSFs (row, column, height, wavelength), field along columns, origin at N/2 counted from 1.

    One sample more is rendered and the first row and column dropped, which moves the origin from N//2 counted
    from 0 without interpolating anything.
    """
    database = stored.database
    points = depth_mm, slopes[:, None], database.space.wavelengths_um
    psfs: np.ndarray = rendered_light(database, points, Sampling(pixels + 1, pixel_um), np.float64)[..., 1:, 1:]
    psfs /= psfs.sum((-2, -1), keepdims=True)
    return psfs.transpose(3, 2, 0, 1)


def traced_heights(
    lens: Lens, depth_mm: float, slopes: np.ndarray, wavelengths_um: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return real image heights (mm) and relative illumination, both (height, wavelength).

    Illumination by a Lambertian scene is ∝ ∫dKx dKy, the area of the pupil's image in direction cosines
    (Welford 1986, §6.5): here of the polygon of rim rays, nothing clipped.
    """
    turn = 2 * np.pi * np.arange(RIM_RAYS) / RIM_RAYS
    rays = [
        [pencil(lens, Source(depth_mm, float(h), float(w)), np.sin(turn), np.cos(turn)) for w in wavelengths_um]
        for h in slopes
    ]
    real = np.array([[r.chief_y.item() for r in row] for row in rays])
    area = np.array([[polygon_area(r.kx, r.ky) for r in row] for row in rays])
    return real, area / area[0]


def polygon_area(x: np.ndarray, y: np.ndarray) -> float:
    """Return the area inside a closed polygon (the shoelace formula)."""
    return abs(float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))) / 2


def _column(values: np.ndarray) -> np.ndarray:
    return np.asarray(values, dtype=float).reshape(-1, 1)
