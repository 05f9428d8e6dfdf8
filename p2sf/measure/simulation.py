"""Frames of points through a lens, with pixels, noise, jitter and a tilted sensor: to try and to teach measuring.

The light on pixels is the sum of a fit to exact rays, with more nodes and points per pixel than a measurement takes.
"""

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens, with_sensor
from p2sf.measure.fitting.frame_terms import chief_rays
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum
from p2sf.measure.fitting.pupil_nodes import counts_for, lens_nodes
from p2sf.measure.frame import Frame, FrameGeometry
from p2sf.pupil.fit import FittedPencil, fit
from p2sf.raytrace.focusing import object_distance

RESIDUAL_WAVES = 2e-4  # of the fit to rays
FINER = 2  # more points across a pixel
AIRY_RADII = 8.0  # of the window about where rays land, in λ/NA


@dataclass(frozen=True)
class Exposure:
    """How points are exposed, in counts: the brightest pixel of each, noise, and what the sensor does.

    ``peak``: of every point; ``background``; ``read_noise``: standard deviation; ``gain``: electrons per count, inf
    for no shot noise; ``full_scale``: counts at which pixels saturate; ``jitter_um``: RMS of a motion in each direction
    during the exposure; ``sensor_shift_um``: away from the lens; ``tilt_deg``: by which the sensor recedes from the
    lens towards +x and towards +y.
    """

    peak: float = 1000.0
    background: float = 50.0
    read_noise: float = 10.0
    gain: float = inf
    full_scale: float = inf
    jitter_um: float = 0.0
    sensor_shift_um: float = 0.0
    tilt_deg: tuple[float, float] = (0.0, 0.0)
    seed: int = 0


def grid_of_points(columns: int, rows: int, width_mm: float, height_mm: float) -> np.ndarray:
    """Return places on the sensor, (rows·columns, 2) mm, evenly over a rectangle of this size about the axis."""
    x, y = np.linspace(-width_mm / 2, width_mm / 2, columns), np.linspace(height_mm / 2, -height_mm / 2, rows)
    return np.stack([axis.ravel() for axis in np.meshgrid(x, y)], axis=1)


def simulated_frame(
    lens: Lens,
    places_mm: np.ndarray,
    geometry: FrameGeometry,
    exposure: Exposure | None = None,
    depth_mm: float | None = None,
    wavelength_um: float | None = None,
) -> Frame:
    """Return the picture of points whose chief rays land at ``places_mm``, (points, 2), x and y up from the axis.

    ``depth_mm``: by default that of the lens's object. Raises RequestError for a place off the sensor, and what the
    lens raises for its points.
    """
    exposure = exposure or Exposure()
    depth_mm = object_distance(lens) if depth_mm is None else depth_mm
    wave = wavelength_um or lens.reference_wavelength_um
    values = np.zeros((geometry.rows, geometry.columns))
    places = np.asarray(places_mm, float)
    seen = chief_rays(lens, depth_mm, wave, max(float(np.hypot(*places.T).max()), 1e-3) * 1.01)
    for x, y in places.tolist():
        row, column = geometry.pixel_at(x, y)
        if not (0 <= row < geometry.rows and 0 <= column < geometry.columns):
            raise RequestError("a point at ({x:.4g}, {y:.4g}) mm lies off the sensor; take a larger one", x=x, y=y)
        slopes = np.tan(np.deg2rad(exposure.tilt_deg))
        shift_mm = exposure.sensor_shift_um / UM_PER_MM + float(slopes @ (x, y))
        placed = with_sensor(lens, lens.sensor_mm + shift_mm)
        found = fit(placed, seen.source(0.0, float(np.hypot(x, y)), wave), residual_waves=RESIDUAL_WAVES)
        _add(values, geometry, found, (x, y), exposure)
    return Frame(_expose(values, exposure), geometry)


def _add(
    values: np.ndarray, geometry: FrameGeometry, found: FittedPencil, place: tuple[float, float], exposure: Exposure
) -> None:
    """Add one point's light to the frame, its peak as asked."""
    from scipy.ndimage import gaussian_filter

    row, column = geometry.pixel_at(*place)
    centre, steep = geometry.place_of(row, column), found.steepness
    pitch = geometry.pixel_um
    reach = (steep.radial + AIRY_RADII) / steep.spread + 4 * exposure.jitter_um
    half = int(np.ceil(reach / pitch))
    kernel = lens_light(found, place, half, pitch, centre)[::-1]
    if exposure.jitter_um:
        kernel = gaussian_filter(kernel, exposure.jitter_um / pitch, mode="constant")
    kernel = kernel * (exposure.peak / kernel.max())
    top, left = max(row - half, 0), max(column - half, 0)
    part = values[top : row + half + 1, left : column + half + 1]
    down, along = top - (row - half), left - (column - half)
    part += kernel[down : down + part.shape[0], along : along + part.shape[1]]


def lens_light(
    found: FittedPencil, place: tuple[float, float], half: int, pixel_um: float, centre: tuple[float, float]
) -> np.ndarray:
    """Return the light of a fit on (2·half + 1)² pixels, rows towards +y, in units that are the same for all windows.

    The chief ray lands at ``place``, and the middle pixel's centre is ``centre``, mm from the axis.
    """
    spread = found.steepness.spread
    optics = PictureOptics(spread, 1.0, pixel_um)
    counts = counts_for(found.steepness.radial, spread, 1.1 * half * pixel_um)
    nodes = lens_nodes(found, float(np.arctan2(*place)), counts)
    waves = found.function.at(nodes.xi, nodes.eta)[0]
    x, y = ((a - b) * UM_PER_MM for a, b in zip(place, centre, strict=True))
    phase = nodes.waves - waves - nodes.fx * x - nodes.fy * y
    return PixelSum(nodes, (2 * half + 1,) * 2, optics, optics.parts + FINER).light(phase)


def _expose(light: np.ndarray, exposure: Exposure) -> np.ndarray:
    """Return counts of some light: shot noise, background, read noise, saturation."""
    random = np.random.default_rng(exposure.seed)
    counts = light + exposure.background
    if np.isfinite(exposure.gain):
        counts = random.poisson(counts * exposure.gain) / exposure.gain
    counts = counts + random.normal(0, exposure.read_noise, counts.shape)
    clipped: np.ndarray = np.minimum(counts, exposure.full_scale)
    return clipped


def refocus(exposure: Exposure, sensor_shift_um: float) -> Exposure:
    """Return the exposure with the sensor shifted further, and other noise."""
    return replace(exposure, sensor_shift_um=exposure.sensor_shift_um + sensor_shift_um, seed=exposure.seed + 1)
