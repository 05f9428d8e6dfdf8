"""With clip, what is drawn and counted of exact rays ends at the rims."""

import numpy as np
import pytest

from p2sf.raytrace.pencil import Status, pencil
from p2sf_explorer.compute.layout import layout
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.views.rays import FAN_RAYS, figures, landing_points, path_errors, ray_errors, spots
from p2sf_explorer.scene3d.ray_bundle import ray_bundle
from p2sf_explorer.state.state import change, new_state

CLIPPED = new_state(lens="fast_gauss_f14", field_deg=22.0, clip=True, aim="paraxial", method="seidel")


@pytest.mark.parametrize(("name", "field"), [("fast_gauss_f14", 22.0), ("petzval", 7.0), ("double_gauss_28", 14.0)])
@pytest.mark.parametrize("aim", ["paraxial", "stop"])
def test_a_drawn_ray_ends_where_the_pencil_says_that_a_rim_stops_it(name, field, aim):
    setup = paraxial_setup(new_state(lens=name, field_deg=field, clip=True, aim=aim))
    rims = [ray for ray in layout(setup, clip=True).rays if ray.kind == "rim"]
    exact = pencil(setup.lens, setup.source, [0.0, 0.0], [1.0, -1.0], clip=True)
    for ray, status, surface in zip(rims, exact.status, exact.failed_surface, strict=True):
        assert ray.clipped == (status == Status.CLIPPED) and ray.passed == (status == Status.PASSED)
        if ray.clipped:
            assert ray.z.size == surface + 1  # its start, then every surface up to the one that stops it
            rim = setup.lens.surfaces[surface - 1].semi_diameter
            sag = float(setup.lens.surfaces[surface - 1].sag(0.0, rim))
            vertex = sum(s.thickness for s in setup.lens.surfaces[: surface - 1])
            # In the plane of the rim, widened by a rounding of six digits; the surface itself may be met before it.
            assert ray.z[-1] == pytest.approx(vertex + sag, abs=1e-4) or ray.z[-1] < vertex + sag
            assert abs(ray.y[-1]) > 0.9 * rim
    assert any(ray.clipped for ray in rims)


def test_without_clip_nothing_ends_and_a_stopped_ray_is_not_called_lost():
    assert all(ray.passed for ray in live(change(CLIPPED, clip=False), "preview").layout.rays)
    assert not any("drawn rays do" in message.template for message in live(CLIPPED, "preview").warnings)


@pytest.mark.parametrize("view", [ray_errors, path_errors])
def test_fans_have_gaps_where_rays_are_stopped(view):
    answer = live(CLIPPED, "preview")
    setup, fan = answer.setup, view(answer).found
    line, zero = np.linspace(-1, 1, FAN_RAYS), np.zeros(FAN_RAYS)
    for values, at in ((fan.tangential, (zero, line)), (fan.sagittal, (line, zero))):
        assert np.array_equal(np.isfinite(values), pencil(setup.lens, setup.source, *at, clip=True).passed)
    assert np.isnan(fan.tangential).any()
    assert np.isfinite(view(live(change(CLIPPED, clip=False), "preview")).found.tangential).all()


def test_the_spot_says_that_rims_stop_rays():
    answer = live(CLIPPED, "preview")
    found = spots(answer).found
    rows = {name: (value, why) for name, value, why in figures(found, 1.0, clip=True)}
    value, why = rows["Rays within the rims"]
    assert value.values["count"] == len(landing_points(found)) < value.values["all"] == found.x_um.size
    assert "rim" in why and "Rays within the rims" not in {row[0] for row in figures(found, 1.0)}


def test_rays_in_space_stay_on_the_surface_whose_rim_stops_them():
    answer = live(CLIPPED, "preview")
    free, clipped = (ray_bundle(answer.setup, answer.layout.drawing, clip) for clip in (False, True))
    exact = answer.layout.drawing.sensor_z
    assert np.allclose(free[:, -1, 2], exact) and not np.allclose(clipped[:, -1, 2], exact)
    same = (free == clipped).all(-1)
    assert (np.diff(same.astype(int), axis=1) <= 0).all()  # a ray is the free one up to where it stays


@pytest.mark.parametrize(("aim", "words"), [("paraxial", "entrance pupil"), ("stop", "stop")])
def test_fans_and_spot_name_the_pupil_that_rays_fill(window, aim, words):
    for key in ("spot", "ray_fan", "opd_fan"):
        window.store.update(aim=aim, tab=key)
        panel = window.panels[key]
        assert words in (panel.widget.readout.text() if key == "spot" else panel.chart.labels[0])
        assert "pupil" not in words or "stop" not in panel.chart.labels[0]
