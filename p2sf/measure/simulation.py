"""Frames of points through a lens, with pixels, noise, jitter and a tilted sensor: to try and to teach measuring.

The light on pixels is that of `pixel_kernels`, which samples the pupil over direction cosines: another road than the
sums that a fit uses.
"""

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import RequestError
from p2sf.lens.lens import Lens, with_sensor
from p2sf.measure.frame import Frame, FrameGeometry
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.pixels import PixelWindow, half_width, pixel_kernel, samples_across
from p2sf.pixel_kernels.pupil_stack import FrequencyPupil
from p2sf.pixel_kernels.sensor_points import sensor_map

FINENESS = 2.0  # samples for every fringe


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
    depth_mm: float = inf,
    wavelength_um: float | None = None,
) -> Frame:
    """Return the picture of points whose chief rays land at ``places_mm``, (points, 2), x and y up from the axis.

    Raises RequestError for a place off the sensor, and what the lens raises for its points.
    """
    exposure = exposure or Exposure()
    wave = wavelength_um or lens.reference_wavelength_um
    values = np.zeros((geometry.rows, geometry.columns))
    places = np.asarray(places_mm, float)
    seen = sensor_map(lens, depth_mm, wave, max(float(np.hypot(*places.T).max()), 1e-3) * 1.01)
    for x, y in places.tolist():
        row, column = geometry.pixel_at(x, y)
        if not (0 <= row < geometry.rows and 0 <= column < geometry.columns):
            raise RequestError("a point at ({x:.4g}, {y:.4g}) mm lies off the sensor; take a larger one", x=x, y=y)
        slopes = np.tan(np.deg2rad(exposure.tilt_deg))
        shift_mm = exposure.sensor_shift_um / UM_PER_MM + float(slopes @ (x, y))
        placed = with_sensor(lens, lens.sensor_mm + shift_mm)
        pupil = pupil_map(placed, seen.source(float(np.hypot(x, y)), wave), "fitted", None)
        _add(values, geometry, pupil, (x, y), exposure)
    return Frame(_exposed(values, exposure), geometry)


def _add(
    values: np.ndarray, geometry: FrameGeometry, pupil: FrequencyPupil, place: tuple[float, float], exposure: Exposure
) -> None:
    """Add one point's light to the frame, its peak as asked."""
    from scipy.ndimage import gaussian_filter

    x, y = place
    row, column = geometry.pixel_at(x, y)
    centre_x, centre_y = geometry.place_of(row, column)
    shift = (x - centre_x) * UM_PER_MM, (y - centre_y) * UM_PER_MM
    pitch = geometry.pixel_um
    half = half_width(pupil, pitch, float(np.hypot(*shift)) + 3 * exposure.jitter_um)
    window = PixelWindow(half, pitch, samples_across(pupil, pitch, FINENESS))
    kernel = pixel_kernel(pupil, float(np.arctan2(x, y)), window, shift).astype(float)
    if exposure.jitter_um:
        kernel = gaussian_filter(kernel, exposure.jitter_um / pitch, mode="constant")
    kernel *= exposure.peak / kernel.max()
    top, left = max(row - half, 0), max(column - half, 0)
    part = values[top : row + half + 1, left : column + half + 1]
    begin = top - (row - half), left - (column - half)
    part += kernel[begin[0] : begin[0] + part.shape[0], begin[1] : begin[1] + part.shape[1]]


def _exposed(light: np.ndarray, exposure: Exposure) -> np.ndarray:
    """Return counts of some light: shot noise, background, read noise, saturation."""
    random = np.random.default_rng(exposure.seed)
    counts = light + exposure.background
    if np.isfinite(exposure.gain):
        counts = random.poisson(counts * exposure.gain) / exposure.gain
    counts = counts + random.normal(0, exposure.read_noise, counts.shape)
    clipped: np.ndarray = np.minimum(counts, exposure.full_scale)
    return clipped


def refocused(exposure: Exposure, sensor_shift_um: float) -> Exposure:
    """Return the exposure with the sensor shifted further, and other noise."""
    return replace(exposure, sensor_shift_um=exposure.sensor_shift_um + sensor_shift_um, seed=exposure.seed + 1)
