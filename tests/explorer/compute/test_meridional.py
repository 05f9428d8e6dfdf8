import numpy as np
import pytest

from p2sf.lens.lens import AIMS, indices, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.pupils import find_stop
from p2sf.raytrace.pencil import Status, pupil_rays, trace
from p2sf_explorer.compute.meridional import path


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
        z, y, passed = path(lens, index, start, direction)
        assert passed == (exact.status[k] == Status.PASSED)
        if passed:
            # Two orders of operations in float64 over some 20 surfaces of 100 mm.
            assert np.allclose(np.stack([z, y]), exact.points[1:, k, :0:-1].T, rtol=0, atol=1e-9)


def test_a_ray_that_misses_ends_before_the_surface_it_misses():
    lens = find_lens("plano_convex")
    z, y, passed = path(lens, indices(lens, 0.55).tolist(), (-10.0, 1e4), (1.0, 0.0))
    assert not passed
    assert len(z) == len(y) < len(lens.surfaces)


def test_a_ray_along_the_axis_stays_there():
    lens = find_lens("asphere")
    _, y, passed = path(lens, indices(lens, 0.55).tolist(), (-10.0, 0.0), (1.0, 0.0))
    assert passed
    assert not any(y)
