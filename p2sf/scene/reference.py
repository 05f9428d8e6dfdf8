"""The reference kernel of a point anywhere on the sensor: exact rays, a plane wave each, summed without any FFT."""

from dataclasses import replace
from math import ceil

import numpy as np

from p2sf.conventions import UM_PER_MM, centred_axis
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pixel_kernels import SensorMap
from p2sf.psf.plane_waves import counts_for, pupil_amplitude, window_reach_um
from p2sf.pupil.quadrature import gauss_legendre
from p2sf.pupil.transform import sum_plane_waves
from p2sf.raytrace.pencil import pencil, rays_through
from p2sf.raytrace.ray_field import steepness
from p2sf.raytrace.seen_mask import with_slopes
from p2sf.raytrace.vignetting import pupil_nodes
from p2sf.scene.field_points import FieldMap, landing_mm
from p2sf.scene.scene import Channel

PROBE = 12, 36
LEAST_POINTS = 4


def reference_kernel(
    seen: SensorMap | FieldMap, channel: Channel, x_mm: float, y_mm: float, half: int, pixel_um: float
) -> np.ndarray:
    """Return the light per pixel of the point that lands at (x, y) in all its wavelengths, unit sum, row 0 the top."""
    height, angle = float(np.hypot(x_mm, y_mm)), float(np.arctan2(x_mm, y_mm))
    size = 2 * half + 1
    total = np.zeros((size, size))
    for wavelength, share in zip(channel.wavelengths_um, channel.shares, strict=True):
        if isinstance(seen, FieldMap):
            total = total + share * landed_pixels(seen, x_mm, y_mm, float(wavelength), half, pixel_um)
            continue
        source = seen.source(height, float(wavelength))
        shift = seen.shift_mm(height, float(wavelength)) * UM_PER_MM
        total = total + share * exact_pixels(seen.lens, source, angle, half, pixel_um, shift, seen.clip)
    return total


def landed_pixels(
    seen: FieldMap, x_mm: float, y_mm: float, wavelength_um: float, half: int, pixel_um: float
) -> np.ndarray:
    """Return `exact_pixels` of the object point that lands at a place through a misaligned lens."""
    source, aside, shift = landed_point(seen, x_mm, y_mm, wavelength_um)
    return exact_pixels(seen.lens, source, np.deg2rad(source.azimuth_deg), half, pixel_um, shift, seen.clip, aside)


def landed_point(seen: FieldMap, x_mm: float, y_mm: float, wavelength_um: float) -> tuple[Source, float, float]:
    """Return the object point for a wavelength, and how far it lands from the place, µm across and along its field."""
    source = seen.source(x_mm, y_mm, wavelength_um)
    right, up = (UM_PER_MM * (a - b) for a, b in zip(landing_mm(seen.lens, source), (x_mm, y_mm), strict=True))
    sine, cosine = np.sin(np.deg2rad(source.azimuth_deg)), np.cos(np.deg2rad(source.azimuth_deg))
    return source, float(right * cosine - up * sine), float(right * sine + up * cosine)


def exact_pixels(
    lens: Lens,
    source: Source,
    angle: float,
    half: int,
    pixel_um: float,
    shift_um: float,
    clip: bool = False,
    aside_um: float = 0.0,
) -> np.ndarray:
    """Return one wavelength's light per pixel, unit sum, row 0 the top; ``angle`` of the field, radians from +y to +x.

    ``shift_um``, ``aside_um``: where it lands along the field's direction and across.
    """
    # Its mask is turned, which stays in the lens, and so are a lens's tilts and decentres.
    seen = replace(source, azimuth_deg=float(np.rad2deg(angle)))
    probe = pupil_nodes(lens, seen, PROBE, clip)
    steep = steepness(pencil(lens, seen, probe.xi, probe.eta), probe.xi, probe.eta)
    steep = with_slopes(steep, lens.mask, source.wavelength_um)
    size = 2 * half + 1
    place, share = _pixel_points(size, pixel_um, steep.spread)
    counts = counts_for(steep, window_reach_um(size, pixel_um))
    radii, directions = (2 * ceil(0.55 * count) for count in counts)
    nodes = pupil_nodes(lens, seen, (radii, directions), clip).unfolded()
    rays = rays_through(lens, seen, nodes)
    weight, across_f, along_f = rays.share * rays.amplitude, rays.fx, rays.fy
    sine, cosine = np.sin(angle), np.cos(angle)
    fx, fy = across_f * cosine + along_f * sine, along_f * cosine - across_f * sine
    amplitude = pupil_amplitude(weight, rays.phase - along_f * shift_um - across_f * aside_um)
    field = sum_plane_waves(amplitude, fx, fy, place, place, even=False)
    light = (field.real**2 + field.imag**2).reshape(size, len(share), size, len(share))
    pixels = np.einsum("aibj,i,j->ab", light, share, share)
    image: np.ndarray = pixels[::-1] / pixels.sum()
    return image


def _pixel_points(size: int, pixel_um: float, spread: float) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss–Legendre points of every pixel, µm, and their shares, exact for 2·spread cycles per µm."""
    node, weight = gauss_legendre(max(LEAST_POINTS, ceil(np.pi * spread * pixel_um) + 3))
    return (centred_axis(size, pixel_um)[:, None] + node * (pixel_um / 2)).ravel(), weight / 2
