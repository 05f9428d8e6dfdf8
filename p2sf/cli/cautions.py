"""What `p2sf psf` says beside its figures: a stop that is not one, an image no sensor holds, a sum that takes long."""

from math import inf

from p2sf.cli.screen import text, warn
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import steepest_slope
from p2sf.request import Setup

STEEP_WAVES = 500.0, 2000.0  # from about a second on, and where `psf` refuses the sum
# Measured for 64 × 64 samples: the nodes, and with them the time, grow with the square of the slope.
SECONDS_PER_SQUARE_WAVE = 4e-6

TOO_COARSE = "unknown: samples so far apart add up to no share; give a smaller --pixel-um"


def caution(setup: Setup, seidel: bool) -> None:
    """Print warnings about a setup; call before the work, since one of them is how long that will take."""
    for sentence in (setup.stop.warning, virtual_image(setup), long_sum(setup) if seidel else None):
        warn(sentence)


def virtual_image(setup: Setup) -> str | None:
    """Return a sentence where the image of the object is virtual, which the sensor can only show as a wide blur."""
    depth = setup.source.depth_mm
    place = float(image_distance(setup.lens, depth, setup.source.wavelength_um))
    if not -inf < place < 0 < setup.lens.sensor_mm:
        return None
    return (
        f"the image of an object at {text(depth)} mm is virtual, {-place:.6g} mm before the last vertex, so this is "
        f"the blur on the sensor at {setup.lens.sensor_mm:.6g} mm; move the object beyond the front focal point"
    )


def long_sum(setup: Setup) -> str | None:
    """Return a sentence where the six coefficients rise so steeply that summing their pupil takes seconds."""
    source = setup.source
    six = coefficients(setup.lens, source.depth_mm, source.field_slope, source.wavelength_um, setup.stop)
    slope = float(steepest_slope(six))
    if not STEEP_WAVES[0] < slope < STEEP_WAVES[1]:
        return None
    return (
        f"the six coefficients rise {slope:.0f} waves per pupil radius here, so their sum takes some "
        f"{SECONDS_PER_SQUARE_WAVE * slope**2:.0f} s and describes little; choose a smaller field or "
        "aperture, or another method"
    )
