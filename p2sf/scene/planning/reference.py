"""The reference kernel of a point anywhere on the sensor: exact rays, one plane wave each, summed without an FFT."""

from dataclasses import replace
from math import ceil

import numpy as np

from p2sf.conventions import UM_PER_MM, centred_axis
from p2sf.disc.quadrature import gauss_legendre
from p2sf.disc.transform import sum_plane_waves
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pixel_kernels.sensor_points import SensorMap
from p2sf.pupil.plane_waves import counts_for, pupil_amplitude, window_reach_um
from p2sf.pupil.seen_mask import with_slopes
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.pencil import pencil, rays_through
from p2sf.raytrace.ray_field import steepness
from p2sf.scene.scene import Channel

PROBE = 12, 36
LEAST_POINTS = 4


def reference_kernel(
    seen: SensorMap, channel: Channel, x_mm: float, y_mm: float, half: int, pixel_um: float
) -> np.ndarray:
    """Return the light per pixel of the point that lands at (x, y) in all its wavelengths, unit sum, row 0 the top."""
    total = np.zeros((2 * half + 1, 2 * half + 1))
    for wavelength, share in zip(channel.wavelengths_um.tolist(), channel.shares.tolist(), strict=True):
        source = seen.source(x_mm, y_mm, wavelength)
        across, up = (UM_PER_MM * shift for shift in seen.shift_mm(x_mm, y_mm, wavelength))
        angle = np.deg2rad(source.azimuth_deg)
        along, aside = across * np.sin(angle) + up * np.cos(angle), across * np.cos(angle) - up * np.sin(angle)
        kernel = exact_pixels(seen.lens, source, float(angle), half, pixel_um, (float(along), float(aside)), seen.clip)
        total = total + share * kernel
    return total


def exact_pixels(
    lens: Lens,
    source: Source,
    angle: float,
    half: int,
    pixel_um: float,
    shift_um: tuple[float, float] = (0.0, 0.0),
    clip: bool = False,
) -> np.ndarray:
    """Return one wavelength's light per pixel, unit sum, row 0 the top; ``angle`` of the field, radians from +y to +x.

    ``shift_um``: where it lands along the field's direction and across.
    """
    along_um, aside_um = shift_um
    # The mask, fixed in the lens, is rotated, and so are tilts and decentres of the lens.
    seen = replace(source, azimuth_deg=float(np.rad2deg(angle)))
    probe = pupil_nodes(lens, seen, PROBE, clip)
    steep = steepness(pencil(lens, seen, probe.xi, probe.eta).along_axis(lens), probe.xi, probe.eta)
    steep = with_slopes(steep, lens.mask, source.wavelength_um)
    size = 2 * half + 1
    place, share = _pixel_points(size, pixel_um, steep.spread)
    counts = counts_for(steep, window_reach_um(size, pixel_um))
    radii, directions = (2 * ceil(0.55 * count) for count in counts)
    nodes = pupil_nodes(lens, seen, (radii, directions), clip).unfolded()
    rays = rays_through(lens, seen, nodes).along_axis(lens)
    weight, across_f, along_f = rays.share * rays.amplitude, rays.fx, rays.fy
    sine, cosine = np.sin(angle), np.cos(angle)
    fx, fy = across_f * cosine + along_f * sine, along_f * cosine - across_f * sine
    amplitude = pupil_amplitude(weight, rays.phase - along_f * along_um - across_f * aside_um)
    field = sum_plane_waves(amplitude, fx, fy, place, place, even=False)
    light = (field.real**2 + field.imag**2).reshape(size, len(share), size, len(share))
    pixels = np.einsum("aibj,i,j->ab", light, share, share)
    image: np.ndarray = pixels[::-1] / pixels.sum()
    return image


def _pixel_points(size: int, pixel_um: float, spread: float) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss–Legendre points of every pixel, µm, and their shares, exact for 2·spread cycles per µm."""
    node, weight = gauss_legendre(max(LEAST_POINTS, ceil(np.pi * spread * pixel_um) + 3))
    return (centred_axis(size, pixel_um)[:, None] + node * (pixel_um / 2)).ravel(), weight / 2
