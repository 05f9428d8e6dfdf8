"""The light of a field, against rays launched all over a plane before the lens and counted where stop and rims let go.

Those rays know no pupil: a component of the plane whose rays pass is found on a grid, its chords by bisection to the
last digit, and their lengths are added up by a midpoint rule in the angle, which a round outline suits.
"""

import numpy as np
import pytest
from scipy.ndimage import label

from p2sf.lens.lens import Lens, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.pupils import find_stop, pupils
from p2sf.pixel_kernels.illumination import light_collected, relative_illumination
from p2sf.pixel_kernels.sensor_points import chief_heights, sensor_map
from p2sf.raytrace.trace import trace
from tests.long.aiming import symmetric_lens

WAVE = 0.5876
LIGHT = 1e-4  # asked for; what is left is 3e-5, mostly of 200 chords
GRID, CHORDS, BISECTIONS = 161, 200, 40


class Counter:
    """Whether rays through points of the entrance-pupil plane, parallel or from one point, pass stop and rims."""

    def __init__(self, lens: Lens, source: Source, clip: bool):
        stop = find_stop(lens)
        pupil = pupils(lens, source.wavelength_um, stop)
        self.lens, self.source = lens, source
        self.plane, self.radius = float(pupil.entrance_from_first), float(pupil.entrance_diameter) / 2
        number = int(stop.surface)
        rims = [(k, s.semi_diameter) for k, s in enumerate(lens.surfaces, 1) if clip and k != number]
        self.rims = [(number, float(stop.semi_diameter)), *((k, r) for k, r in rims if np.isfinite(r))]

    def slopes(self, x, y):
        if np.isinf(self.source.depth_mm):
            return 0 * x, self.source.field_slope + 0 * y
        away = self.source.depth_mm + self.plane
        return x / away, y / away + self.source.field_slope

    def passes(self, x, y):
        x, y = np.broadcast_arrays(x, y)
        across, along = self.slopes(x, y)
        origins = np.stack([x, y, np.full(x.shape, self.plane)], -1)
        points = trace(self.lens, origins, np.stack([across, along, np.ones(x.shape)], -1), WAVE).points
        with np.errstate(invalid="ignore"):
            return np.logical_and.reduce([np.hypot(*points[k, ..., :2].T).T <= r for k, r in self.rims])

    def edge(self, x, inside, outside):
        for _ in range(BISECTIONS):
            middle = (inside + outside) / 2
            passes = self.passes(x, middle)
            inside, outside = np.where(passes, middle, inside), np.where(passes, outside, middle)
        return inside

    def light(self) -> float:
        """Return ∫cos⁴θ dx dy over the plane, over the paraxial pupil's area: cos θ dΩ = cos⁴θ dx dy/distance²."""
        line = np.linspace(-2.5, 2.5, GRID) * self.radius
        x, y = np.meshgrid(line, line)
        piece = largest(self.passes(x, y))
        step = line[1] - line[0]
        angle = (np.arange(CHORDS) + 0.5) * np.pi / 2 / CHORDS
        reach = np.abs(x[piece]).max() + step
        across, width = reach * np.cos(angle), reach * np.sin(angle) * np.pi / 2 / CHORDS
        heights = np.arange(y[piece].min() - 2 * step, y[piece].max() + 2 * step, step / 2)
        rows = largest(self.passes(across[:, None], heights))
        across, width, rows = (values[rows.any(1)] for values in (across, width, rows))
        low, high = rows.argmax(1), rows.shape[1] - 1 - rows[:, ::-1].argmax(1)
        assert (rows.sum(1) == high - low + 1).all()
        top = self.edge(across, heights[high], heights[high + 1])
        bottom = self.edge(across, heights[low], heights[low - 1])
        node, weight = np.polynomial.legendre.leggauss(12)
        at = (top + bottom) / 2 + (top - bottom) / 2 * node[:, None]
        one, two = self.slopes(across, at)
        mean = weight @ (1 + one**2 + two**2) ** -2.0 / 2
        return float(2 * np.sum(width * (top - bottom) * mean) / (np.pi * self.radius**2))


def largest(passes: np.ndarray) -> np.ndarray:
    """Return the largest piece: rays far outside may stray back through the stop."""
    pieces, _ = label(passes)
    return pieces == np.bincount(pieces.ravel())[1:].argmax() + 1


@pytest.mark.slow
@pytest.mark.parametrize("clip", [False, True])
@pytest.mark.parametrize(
    ("name", "depth"),
    [
        ("wide_angle_35", np.inf),
        ("periskop", 1000.0),
        ("reverse_telephoto", 30.0),
        ("cooke_triplet", np.inf),
        ("eye_navarro", 250.0),
    ],
)
def test_the_light_is_that_of_rays_counted_through_the_stop(name, depth, clip):
    lens = with_aim(find_lens(name), "stop")
    slopes = np.tan(np.deg2rad([0.0, 0.7 * lens.fields_deg[-1], lens.fields_deg[-1]]))
    sources = [Source(depth, float(slope), WAVE) for slope in slopes]
    found = np.array([light_collected(lens, source, clip) for source in sources])
    counted = np.array([Counter(lens, source, clip).light() for source in sources])
    assert np.abs(found / found[0] / (counted / counted[0]) - 1).max() < LIGHT
    assert np.abs(found / counted - 1).max() < LIGHT


def test_the_paraxial_pupil_passes_its_cosines_alone():
    lens, slope = with_aim(find_lens("wide_angle_35"), "paraxial"), 0.6
    assert light_collected(lens, Source(np.inf, slope, WAVE)) == pytest.approx((1 + slope**2) ** -2, rel=1e-12)


@pytest.mark.parametrize(("name", "aim"), [("reverse_telephoto", "stop"), ("wide_angle_35", "paraxial")])
def test_no_light_is_lost_on_the_sensor(name, aim):
    """∫E dA over the sensor's disc is ∫light d²s over the field that lands there, to Simpson's rule on 41 points."""
    from scipy.integrate import simpson

    lens = with_aim(find_lens(name), aim)
    slope = float(np.tan(np.deg2rad(lens.fields_deg[-1])))
    edge = float(chief_heights(lens, Source(np.inf, slope, WAVE)))
    seen = sensor_map(lens, np.inf, WAVE, edge)
    assert abs(edge / float(seen.ideal_mm(0.0, edge)[1]) - 1) > 1e-3
    heights, slopes = np.linspace(0, edge, 41), np.linspace(0, slope, 41)
    light = [light_collected(lens, Source(np.inf, float(s), WAVE)) for s in slopes]
    near_axis = float(seen.fields.thinning(0.0, 0.0))
    sent = simpson(np.array(light) / light[0] * slopes, x=slopes) / near_axis
    assert simpson(relative_illumination(seen, 0.0, heights) * heights, x=heights) == pytest.approx(sent, rel=2e-5)


def test_a_symmetric_lens_at_unit_magnification_maps_without_distortion():
    lens = with_aim(symmetric_lens(), "stop")
    depth = lens.sensor_mm
    seen = sensor_map(lens, depth, WAVE, 12.0)
    heights = np.linspace(0.5, 12.0, 24)
    assert np.abs(seen.ideal_mm(0.0, heights)[1] - heights).max() < 1e-12
    bent = sensor_map(with_aim(lens, "paraxial"), depth, WAVE, 12.0)
    assert np.abs(bent.ideal_mm(0.0, heights)[1] - heights).max() > 1e-5
