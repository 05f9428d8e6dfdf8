"""Pictures on a curved sensor: pixels count along its axes, and kernels are foreshortened as its surface is."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.lens.lens import Lens, with_f_number, with_sensor
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.frame import Frame, FrameGeometry
from p2sf.measure.measurement import FrameRequest, measure_frame
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.channel import PointLights, Recipe
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.ray_spread import ray_kernel, ray_spread
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.trace import trace
from p2sf.scene.planning.plan import plan
from p2sf.scene.planning.reference import exact_pixels
from p2sf.scene.planning.verify import verify
from p2sf.scene.scene import Channel, Scene
from p2sf.scene.sensor import Sensor

FIELD = Source(field_deg=20, wavelength_um=0.55)
RADIUS = -28.0  # mm: 40° steep where 20° land
PIXEL_UM, HALF = 12.0, 8


def bent() -> Lens:
    """Return a triplet with a curved sensor out of focus, so that pictures are some ten pixels wide."""
    lens = find_lens("cooke_triplet")
    return replace(with_sensor(lens, lens.sensor_mm + 6.0), sensor_radius=RADIUS)  # where 20° land it is 6.4 mm nearer


def by_landing_points(lens: Lens) -> np.ndarray:
    """Return a kernel of counts: where rays meet the curved sensor itself, x and y of its axes."""
    rng = np.random.default_rng(1)
    rho, theta = np.sqrt(rng.random(200_000)), 2 * np.pi * rng.random(200_000)
    rays = pupil_rays(lens, FIELD, np.append(rho * np.sin(theta), 0.0), np.append(rho * np.cos(theta), 0.0))
    points = 1000 * trace(lens, rays.origins, rays.directions, FIELD.wavelength_um).points[-1, :, :2]
    x, y = (points[:-1] - points[-1]).T
    edges = (np.arange(2 * HALF + 2) - HALF - 0.5) * PIXEL_UM
    count, _, _ = np.histogram2d(y, x, [edges, edges], weights=np.broadcast_to(rays.launch, rho.size + 1)[:-1])
    return count[::-1] / count.sum()


def apart(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.linalg.norm(one - other) / np.linalg.norm(other))


def kernels(lens: Lens, source: Source = FIELD) -> dict[str, np.ndarray]:
    """Return the kernel of every method: counts of rays, a fit and all rays as waves."""
    fitted = PointLights(pupil_map(lens, source, "fitted"), np.zeros(1), np.zeros((1, 2)))
    return {
        "rays": ray_kernel(ray_spread(lens, source), 0.0, HALF, PIXEL_UM),
        "fitted": fitted.kernels(np.array([HALF]), PIXEL_UM, Recipe("fitted", None, 2.0, 0.5))[0],
        "all rays": exact_pixels(lens, source, 0.0, HALF, PIXEL_UM),
    }


def test_every_kernel_is_that_of_rays_on_the_curved_surface_itself():
    """Waves add fringes that pixels average to some hundredths; foreshortening is a quarter of the height here."""
    lens = bent()
    counted = by_landing_points(lens)
    for name, kernel in kernels(lens).items():
        assert apart(kernel, counted) < 0.12, name
    turned = replace(lens, sensor_radius=np.inf)  # the same, seen in the plane across the axis
    assert apart(kernels(turned)["rays"], counted) > 0.25


def test_a_sensor_that_is_hardly_curved_has_the_kernels_of_a_plane_one():
    lens, source = bent(), replace(FIELD, field_slope=0.1)
    flat, hardly = (kernels(replace(lens, sensor_radius=radius), source) for radius in (np.inf, 1e7))
    for name, kernel in flat.items():
        assert apart(hardly[name], kernel) < 1e-4, name


def test_the_pupil_of_six_coefficients_is_wider_along_y_by_the_slope_where_it_lands():
    """Frequencies along y are divided by its cosine, and so is the area over which the light spreads."""
    lens = find_lens("cooke_triplet")
    flat, curved = (pupil_map(replace(lens, sensor_radius=r), FIELD, "seidel") for r in (np.inf, RADIUS))
    height = float(coefficients(lens, np.inf, FIELD.field_slope, 0.55).image_height)
    cosine = np.sqrt(1 - (height / RADIUS) ** 2)
    assert curved.radius / flat.radius == pytest.approx(1 / cosine, rel=1e-12)
    assert curved.energy / flat.energy == pytest.approx(cosine, rel=1e-12)
    # The point ξ = 0.3 of the pupil has the same frequency along x as on a plane: a smaller part of the radius.
    part, none = np.array([0.3]), np.zeros(1)
    assert curved.xi[0] @ curved.basis.fx.values(cosine * part, none) == pytest.approx(part, rel=1e-9)
    assert flat.xi[0] @ flat.basis.fx.values(part, none) == pytest.approx(part, rel=1e-9)


def test_frames_of_points_are_refused_on_a_curved_sensor():
    frame = Frame(np.random.default_rng(2).random((40, 40)), FrameGeometry(40, 40, 4.0))
    with pytest.raises(RequestError, match="curved"):
        measure_frame([frame], PictureOptics(0.1, 0.55, 4.0), FrameRequest(lens=bent()))


@pytest.mark.slow
@pytest.mark.parametrize("moved", [Placement(), Placement(0.1, 0.05, 0.0, 0.2, 0.1)], ids=["aligned", "misaligned"])
def test_a_plan_on_a_curved_sensor_keeps_what_it_promises(moved):
    """Against sums over the rays of each point alone: fits and tables between places are foreshortened alike."""
    lens = with_f_number(find_lens("double_gauss_28"), 5.6)
    lens = displaced(replace(lens, sensor_radius=-80.0), 3, 5, moved)
    planned = plan(
        lens, Scene(Sensor(40, 60, 60.0, (3.0, 6.0)), (Channel("green", (520.0, 560.0), (1.0, 1.0)),), rtol=0.05)
    )
    assert planned.meets and verify(planned, 3).kept
