"""Warnings about pictures: a rim narrower than the stop, a virtual image, a long sum, rays beyond the glass."""

from math import inf

import numpy as np

from p2sf.cli.screen import text, warn
from p2sf.lens.lens import Lens
from p2sf.lensfile.library import find_lens
from p2sf.messages import Message, ParameterName
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.lens_checks import lens_checks, negative_glass
from p2sf.paraxial.seidel import coefficients, of_aligned_lens
from p2sf.setting import Setup

STEEP_WAVES = 500.0, 2000.0  # from about a second on, and where `seidel_psf` refuses the sum
# Measured for 64 × 64 samples: the nodes, and with them the time, grow with the square of the slope.
SECONDS_PER_SQUARE_WAVE = 4e-6

TOO_COARSE = Message(
    "unknown: samples so far apart add up to no share; give a smaller {parameter}",
    parameter=ParameterName("pixel_um"),
)


def open_lens(name: str) -> Lens:
    """Return a lens by its name or path, and print a warning of each glass in it that cannot be made."""
    lens = find_lens(name)
    for message in negative_glass(lens):
        warn(message)
    return lens


def caution(setup: Setup, seidel: bool) -> None:
    """Print warnings about a setup; call before the work, since one of them is how long that will take."""
    own = long_sum(setup) if seidel else crossed_surfaces(setup)
    aligned = of_aligned_lens(setup.lens) if seidel else None
    for message in (setup.stop.warning, virtual_image(setup), own, aligned, *lens_checks(setup.prescription)):
        warn(message)


def crossed_surfaces(setup: Setup) -> Message | None:
    """Return a warning where a ray of the pupil's rim meets two surfaces in the wrong order."""
    from p2sf.raytrace.aiming import pupil_rays
    from p2sf.raytrace.trace import out_of_order, trace

    lens, source = setup.lens, setup.source
    rays = pupil_rays(lens, source, np.array([0.0, 0.0, 1.0]), np.array([1.0, -1.0, 0.0]), setup.stop)
    points = trace(lens, rays.origins, rays.directions, source.wavelength_um).points
    return out_of_order(lens, points[1:-1, ..., 2])


def virtual_image(setup: Setup) -> Message | None:
    """Return a warning where the image of the object is virtual, which the sensor can only show as a wide blur."""
    depth = setup.source.depth_mm
    place = float(image_distance(setup.lens, depth, setup.source.wavelength_um))
    along = setup.lens.directions[-1]
    if setup.lens.tilted or not -inf < along * place < 0 < along * setup.lens.sensor_mm:
        return None
    return Message(
        "the image of an object at {depth} mm is virtual, {distance:.6g} mm before the last vertex, so this is the "
        "blur on the sensor at {sensor:.6g} mm; move the object beyond the front focal point",
        depth=text(depth),
        distance=abs(place),
        sensor=setup.lens.sensor_mm,
    )


def long_sum(setup: Setup) -> Message | None:
    """Return a warning where the six coefficients rise so steeply that summing their pupil takes seconds."""
    from p2sf.paraxial.wavefront import steepest_slope

    source = setup.source
    six = coefficients(setup.lens, source.depth_mm, source.field_slope, source.wavelength_um, setup.stop)
    slope = float(steepest_slope(six))
    if not STEEP_WAVES[0] < slope < STEEP_WAVES[1]:
        return None
    return Message(
        "the six coefficients rise {slope:.0f} waves per pupil radius here, so their sum takes some {seconds:.0f} s "
        "and describes little; choose a smaller field or aperture, or another method",
        slope=slope,
        seconds=SECONDS_PER_SQUARE_WAVE * slope**2,
    )
