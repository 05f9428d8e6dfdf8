import numpy as np
import pytest

from p2sf.lens.lens import AIMS, Surface, indices, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.pupils import find_stop
from p2sf.raytrace.pencil import Status, pupil_rays, trace
from p2sf_explorer.compute.glass_outlines import glass_of, profile
from p2sf_explorer.compute.layout import layout
from p2sf_explorer.compute.meridional import aim_ray, path
from p2sf_explorer.compute.setup import default_state, paraxial_setup, prescription
from p2sf_explorer.state.state import change
from tests.support.lenses.mirrors import aplanatic, mangin, telescope, two_mirrors
from tests.support.lenses.shaped_lenses import PARTS, QBFS, UNSEEN_BY_SEIDEL, singlet, two_shaped_mirrors


@pytest.mark.parametrize("name", shipped_lenses())
@pytest.mark.parametrize("part", [0.0, 0.7, 1.3])
@pytest.mark.parametrize("aim", AIMS)
def test_plain_numbers_meet_every_surface_where_the_arrays_do(name, part, aim):
    if aim == "stop":
        part = min(part, 1.0)  # beyond its field no ray of a lens need reach all of the stop
    lens = with_aim(find_lens(name), aim)
    wavelength = lens.reference_wavelength_um
    slope = float(np.tan(np.deg2rad(part * max(map(abs, lens.fields_deg)))))
    eta = np.linspace(-1, 1, 5)
    rays = pupil_rays(lens, Source(2000.0, slope, wavelength), np.zeros(5), eta, stop=find_stop(lens, 2000.0))
    exact = trace(lens, rays.origins, rays.directions, wavelength)
    index = indices(lens, wavelength).tolist()
    origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
    for k in range(5):
        start, direction = (a[k, :0:-1].tolist() for a in (origins, directions))
        z, y, passed = path(lens, index, wavelength, start, direction)
        assert passed == (exact.status[k] == Status.PASSED)
        if passed:
            # Two orders of operations in float64 over some 20 surfaces of 100 mm.
            assert np.allclose(np.stack([z, y]), exact.points[1:, k, :0:-1].T, rtol=0, atol=1e-9)


@pytest.mark.parametrize("lens", [two_mirrors(aplanatic()), mangin(-0.3), telescope()], ids=repr)
def test_plain_numbers_are_reflected_where_the_arrays_are(lens):
    wavelength, eta = lens.reference_wavelength_um, np.linspace(-1, 1, 5)
    rays = pupil_rays(lens, Source(np.inf, 0.005, wavelength), np.zeros(5), eta)
    exact = trace(lens, rays.origins, rays.directions, wavelength)
    index, size = indices(lens, wavelength).tolist(), lens.aperture.value
    origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
    for k in range(5):
        start, direction = (a[k, :0:-1].tolist() for a in (origins, directions))
        z, y, passed = path(lens, index, wavelength, start, direction)
        assert passed and np.allclose(np.stack([z, y]), exact.points[1:, k, :0:-1].T, rtol=0, atol=1e-11 * size)


@pytest.mark.parametrize("make", [singlet, two_shaped_mirrors])
@pytest.mark.parametrize("parts", [*PARTS.values(), *UNSEEN_BY_SEIDEL.values()], ids=[*PARTS, *UNSEEN_BY_SEIDEL])
def test_plain_numbers_meet_shapes_and_are_diffracted_where_the_arrays_are(make, parts):
    lens, eta = make(*parts), np.linspace(-1, 1, 5)
    rays = pupil_rays(lens, Source(np.inf, 0.03, 0.55), np.zeros(5), eta)
    exact = trace(lens, rays.origins, rays.directions, 0.55)
    index = indices(lens, 0.55).tolist()
    origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
    for k in range(5):
        start, direction = (a[k, :0:-1].tolist() for a in (origins, directions))
        z, y, passed = path(lens, index, 0.55, start, direction)
        # Newton's method ends at 1e-12 mm here.
        assert passed and np.allclose(np.stack([z, y]), exact.points[1:, k, :0:-1].T, rtol=0, atol=1e-10)


def test_a_section_is_drawn_with_the_sag_of_its_shape():
    surface = Surface(60.0, shape=QBFS)
    z, y = profile(surface, 5.0, 8.0)
    assert z == pytest.approx(5.0 + surface.sag(0.0, y), abs=1e-14) and len(y) > 2
    assert len(profile(Surface(shape=QBFS), 0.0, 8.0)[1]) > 2, "not a straight line"


def test_mirrors_are_drawn_and_glass_that_light_crosses_twice_is_drawn_once():
    glass = glass_of(two_mirrors(aplanatic()))
    assert not glass.outlines and [mirror.behind for mirror in glass.mirrors] == [1, -1]
    assert glass.left < -308.0 + 1e-9 and glass.right >= 0.0
    glass = glass_of(mangin())
    assert len(glass.outlines) == 1 and len(glass.mirrors) == 1
    assert len(glass_of(telescope()).outlines) == 4 and len(glass_of(telescope()).mirrors) == 3


def test_a_ray_that_misses_ends_before_the_surface_it_misses():
    lens = find_lens("plano_convex")
    z, y, passed = path(lens, indices(lens, 0.55).tolist(), 0.55, (-10.0, 1e4), (1.0, 0.0))
    assert not passed
    assert len(z) == len(y) < len(lens.surfaces)


def test_a_ray_along_the_axis_stays_there():
    lens = find_lens("asphere")
    _, y, passed = path(lens, indices(lens, 0.55).tolist(), 0.55, (-10.0, 0.0), (1.0, 0.0))
    assert passed
    assert not any(y)


@pytest.mark.parametrize("name", shipped_lenses())
def test_drawn_rays_meet_the_stop_where_they_should(name):
    """Marginal and rim rays its rim, the chief ray its centre; a hundred thousandth of the rim is far below a pixel."""
    for field in prescription(default_state(name)).fields_deg:
        setup = paraxial_setup(change(default_state(name), field_deg=field))
        at, rim = int(setup.stop.surface), float(setup.stop.semi_diameter)
        rays = layout(setup).rays
        for ray, goal in zip(rays, (rim, rim, rim, rim, 0.0), strict=True):
            if ray.y.size > at:
                assert abs(ray.y[at]) == pytest.approx(goal, abs=1e-5 * rim)
        assert rays[0].y[-1] == pytest.approx(-rays[1].y[-1], abs=1e-9)


def test_a_height_beyond_a_fold_is_not_taken():
    """Where rays have crossed before the stop, one that lands where it should belongs to another sheet."""
    folded = aim_ray(lambda y: y - y**3, goal=0.2, guess=0.7, gain=1.0, close=1e-9)  # y − y³ falls beyond 0.577
    assert folded is None or 0 < folded < 0.577
    found = aim_ray(lambda y: y - y**3, goal=0.2, guess=0.2, gain=1.0, close=1e-9)
    assert found - found**3 == pytest.approx(0.2, abs=1e-12)
    assert aim_ray(lambda y: None, goal=0.2, guess=0.2, gain=1.0, close=1e-9) is None
