"""Field curves, chromatic shift, y–ȳ, first-order data and depth of field: what is painted against the physics."""

from math import inf

import numpy as np
import pytest
from PySide6.QtCore import Qt

from p2sf.lens.source import Source
from p2sf.lensfile.library import shipped_lenses
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.compute.views.depth_of_field import axial_blur, depth_of_field, highest, real_blur
from p2sf_explorer.compute.views.field import field_curves
from p2sf_explorer.compute.views.first_order import first_order
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.state.scales import told_apart
from p2sf_explorer.state.state import change, new_state

PAINTED = new_state(theme="light", method="seidel")


def opened(window, tab, **changes):
    """Return a panel in front, after the store has taken these changes."""
    window.store.update(tab=tab, **changes)
    return window.panels[tab]


def test_the_focal_surfaces_meet_on_the_axis_and_part_by_the_astigmatism(window):
    panel = opened(window, "field", f_number=8.0)
    sagittal, tangential = (panel.curves[name].data() for name in ("S", "T"))
    assert sagittal[0][0] == pytest.approx(tangential[0][0], abs=1e-6)
    c = window.live.setup.coefficients
    here = np.interp(10.0, sagittal[1], sagittal[0]) - np.interp(10.0, tangential[1], tangential[0])
    third = 2 * float(c.w22) * float(c.wavelength_um) / float(c.na) ** 2 / 1e3
    # T − S = −2n′λW22/NA²: sign and size of the third order, to the fifth's share at 10°.
    assert here == pytest.approx(third, rel=0.3)


def test_focal_surfaces_move_with_the_sensor(window):
    panel = opened(window, "field")
    before = panel.curves["S"].data()[0].copy()
    window.store.update(sensor_shift_um=100.0)
    assert before - panel.curves["S"].data()[0] == pytest.approx(np.full(before.size, 0.1), abs=1e-9)


@pytest.mark.parametrize(("lens", "word"), [("double_gauss_28", "barrel"), ("telephoto", "pincushion")])
def test_distortion_bends_the_grid_the_way_its_sign_says(lens, word):
    view = field_curves(live(change(with_lens(PAINTED, lens), method="seidel"))).found
    corner, own = np.nanmax(np.hypot(*view.bent.T)), np.nanmax(np.hypot(*view.straight.T))
    share = view.heights.distortion[np.isfinite(view.heights.distortion)][-1]
    assert (share < 0) == (word == "barrel")
    assert corner / own - 1 == pytest.approx(view.exaggerated * share, rel=1e-2), "the corner moves by the distortion"


def test_the_grid_and_words_say_barrel(window):
    panel = opened(window, "field")
    assert "barrel −1.0" in panel.grid.notes[0][2], "−1.06 % at 14°"
    assert panel.grid.notes[1][2] == "drawn 5 times"


def test_blue_green_and_red_foci_of_the_double_gauss(window):
    panel = opened(window, "chromatic")
    nm, shift = panel.curves["paraxial"].data()
    place = {line: np.interp(line, nm, shift) for line in (486.1327, 587.5618, 656.2725)}
    assert place[587.5618] == pytest.approx(0, abs=1.0), "focused at d; straight lines between 41 wavelengths"
    assert place[486.1327] < 0 < place[656.2725]
    window.store.update(f_number=11.0)  # where the third order is all there is
    rim = np.interp(587.5618, *panel.curves["rim"].data())
    c = window.live.setup.coefficients
    # Longitudinal spherical of the rim ray is −2·2λW40/NA² to third order.
    assert rim == pytest.approx(-4 * float(c.wavelength_um) * float(c.w40) / float(c.na) ** 2, rel=0.05)


def test_the_present_wavelength_is_marked(window):
    panel = opened(window, "chromatic", wavelength_nm=500.0)
    assert panel.chart.uprights == ((500.0, "muted"),)


def test_the_stop_lies_on_the_axis_of_the_ybar_diagram_and_the_image_on_the_other(window):
    panel = opened(window, "ybar")
    chief, marginal = panel.path.data()
    stop = window.live.views["ybar"].found.stop
    assert chief[stop] == pytest.approx(0, abs=1e-9)
    assert marginal[-1] == pytest.approx(0, abs=2e-3), "the file's sensor is rounded to a µm"
    assert chief[-1] == pytest.approx(float(window.live.setup.coefficients.image_height))
    # Twice the area of the triangle from the origin to two neighbours is the Lagrange invariant over n/t (Delano).
    first = chief[1] * marginal[0] - chief[0] * marginal[1]
    gap = window.live.setup.lens.surfaces[0].thickness / window.live.setup.rays.index[1]
    invariant = float(window.live.setup.rays.invariant) * window.live.setup.source.field_slope
    assert first == pytest.approx(invariant * gap)


def test_a_source_on_the_axis_has_no_diagram_and_says_so(window):
    panel = opened(window, "ybar", field_deg=0.0)
    assert "no chief ray" in panel.widget.readout.text()


def test_the_data_table_knows_the_double_gauss(window):
    opened(window, "first_order", depth_mm=2000.0)
    rows = {name: value.text(WINDOW) for column in first_order(window.live).found for name, value, _ in column}
    assert rows["Focal length f′"] == "100.004 mm"
    assert rows["Lagrange invariant"] == "2.9385 mm"
    assert float(rows["Magnification"].replace("−", "-")) == pytest.approx(-100.004 / (2000 - 29.321), abs=1e-4)
    assert [table._rows for table in window.panels["first_order"].tables] == list(first_order(window.live).found)


@pytest.mark.parametrize(("blur", "number"), [(30.0, 5.6), (10.0, 5.6), (30.0, 16.0)])
def test_the_hyperfocal_distance_is_f_squared_over_n_c(window, blur, number):
    opened(window, "depth_of_field", blur_um=blur, f_number=number)
    view = window.live.views["depth_of_field"].found
    focal = 100.004
    # f²/(Nc) from the front focus; the entrance pupil lies behind the first vertex, the exit pupil's scale adds f.
    assert view.hyperfocal_mm == pytest.approx(focal**2 / (number * blur / 1e3) + 29.3, rel=2e-3)


def test_focused_at_the_hyperfocal_distance_infinity_is_just_sharp_and_half_of_it_too(window):
    opened(window, "depth_of_field", blur_um=30.0, f_number=8.0)
    hyperfocal = window.live.views["depth_of_field"].found.hyperfocal_mm
    window.store.update(focus_mm=hyperfocal)
    near, far = window.live.views["depth_of_field"].found.sharp_mm
    assert far == inf or far > 1e7
    assert near == pytest.approx(hyperfocal / 2, rel=2e-3)


def test_the_curve_of_blur_crosses_the_tolerated_one_where_the_shade_ends(window):
    panel = opened(window, "depth_of_field", focus_mm=2000.0, f_number=5.6, field_deg=0.0)
    near, blur = panel.curves["paraxial, axis"].data()
    assert np.interp(panel.chart.sharp, near, blur) == pytest.approx([30.0, 30.0], rel=0.01)
    assert blur.min() < 3 and 1 / near[blur.argmin()] == pytest.approx(2000, rel=0.02)
    assert "sharp from 1.93" in panel.widget.readout.text()


@pytest.mark.parametrize("changes", [{}, {"focus_mm": inf}, {"sensor_shift_um": -300.0}])
def test_the_plot_shows_what_there_is_of_both_curves(changes):
    """Neither curve leaves the plot at once nor lies flat on its floor, though the sensor is far from any focus."""
    for name in set(shipped_lenses()) - {"telecentric_relay"}:  # which has no image of an object at infinity
        found = live(change(with_lens(PAINTED, name), method="seidel", **changes), "preview")
        view = depth_of_field(found).found
        top = highest(view)
        for blur in (view.paraxial, view.real):
            assert np.isnan(blur).all() or (
                0.2 < np.mean(blur[~np.isnan(blur)] <= top) and np.nanmax(blur) > 0.2 * top
            ), name


def test_ticks_of_depths_that_are_near_one_another_have_the_digits_to_tell_them_apart():
    assert told_apart([inf, 2000.0, 1000.0]) == ["∞", "2 m", "1 m"]
    assert told_apart([150.12, 150.04, 149.9]) == ["150.1 mm", "150 mm", "149.9 mm"]


@pytest.mark.parametrize("lens", ["reverse_telephoto", "double_gauss_28", "plano_convex", "relay", "eye_navarro"])
@pytest.mark.parametrize("blur", [30.0, 500.0, 2000.0, 10000.0])
def test_what_is_called_sharp_is_what_the_blur_at_each_depth_says(lens, blur):
    """Against the blur itself, from next to the lens to 10 km; 2 mm is all depths of the reverse telephoto."""
    state = change(with_lens(PAINTED, lens), method="seidel", blur_um=blur)
    found = live(state, "preview")
    answer, depths = depth_of_field(found).found, np.geomspace(1e-3, 1e7, 400)
    sharp = 2e3 * np.abs(axial_blur(found.setup).heights_mm(depths)) <= blur
    near, far = answer.sharp_mm or (inf, 0.0)
    assert np.array_equal((depths >= near) & (depths <= far), sharp)
    assert np.isfinite(answer.near).all()


def test_where_every_depth_is_sharp_the_panel_says_so(window):
    window.store.update(lens="reverse_telephoto", tab="depth_of_field", blur_um=2000.0)
    panel = window.panels["depth_of_field"]
    assert "sharp from the lens itself to ∞" in panel.widget.readout.text()
    assert panel.chart.sharp == (0.0, window.live.views["depth_of_field"].found.near[-1])


def test_a_typed_blur_widens_what_is_sharp_and_nonsense_is_refused(window, qtbot):
    panel = opened(window, "depth_of_field", focus_mm=2000.0)
    before = window.live.views["depth_of_field"].found.sharp_mm
    panel.blur.edit.setFocus()
    panel.blur.edit.selectAll()
    qtbot.keyClicks(panel.blur.edit, "0.1 mm")
    qtbot.keyClick(panel.blur.edit, Qt.Key.Key_Return)
    assert window.store.state.display.blur_um == 100.0
    after = window.live.views["depth_of_field"].found.sharp_mm
    assert after[0] < before[0] and after[1] > before[1]
    panel.blur.edit.selectAll()
    qtbot.keyClicks(panel.blur.edit, "wide")
    qtbot.keyClick(panel.blur.edit, Qt.Key.Key_Return)
    assert "tolerated blur" in window.banner.text.text() and window.store.state.display.blur_um == 100.0


@pytest.mark.parametrize("lens", ["relay", "eye_navarro", "periskop", "fast_gauss_f14"])
def test_every_kind_of_lens_has_an_answer(lens):
    answer = live(change(with_lens(PAINTED, lens), method="seidel"), "preview")
    assert np.isfinite(field_curves(answer).found.real.sagittal[0])
    found = depth_of_field(answer).found
    assert found.sharp_mm is None or found.sharp_mm[0] < found.sharp_mm[1]


def test_the_petzval_radius_is_what_its_tip_says(window):
    """A thin positive lens in air has −n·f′ (Welford 1986, §8.4), and so a sum of the same sign: c(1/n − 1) < 0."""
    window.store.replace(with_lens(window.store.state, "singlet_f6"))
    rows = {name: (value.text(WINDOW), tip) for column in first_order(window.live).found for name, value, tip in column}
    value, tip = rows["Petzval radius"]
    radius = float(value.split()[0].replace("−", "-"))
    s = window.live.setup
    n = s.rays.index
    total = sum(surface.curvature * (1 / n[k + 1] - 1 / n[k]) for k, surface in enumerate(s.lens.surfaces)) * n[-1]
    sign = -1 if tip.startswith("−") else 1
    assert radius == pytest.approx(sign / float(total), rel=1e-3)
    assert radius == pytest.approx(-float(n[1]) * s.focal_length_mm, rel=0.03), "thick by a few per cent"


def test_a_lens_that_is_put_aside_is_not_drawn(window):
    card = window.panels["layout"].widget
    window.store.update(free_pupil=True)
    assert "set aside" in card.overlay.text
    window.store.update(free_pupil=False)
    assert not card.overlay.text


def test_the_exact_blur_is_the_rms_of_the_light_and_not_of_the_rays():
    """Through the real stop of a wide lens rays stand for unequal light: by as much as the spot's own RMS says."""
    picture = live(new_state(lens="reverse_telephoto", depth_mm=np.inf, focus_mm=np.inf, field_deg=30.0, f_number=4.0))
    setup = picture.setup
    blur = real_blur(picture, np.array([np.inf, 400.0]), 16)
    nodes, share = np.polynomial.legendre.leggauss(12)  # in ρ², with 36 directions: exact to ρ²³
    radius, angle = np.sqrt((nodes + 1) / 2)[:, None], 2 * np.pi * (np.arange(36) + 0.5) / 36
    xi, eta = (radius * np.sin(angle)).ravel(), (radius * np.cos(angle)).ravel()
    area = np.repeat(share, 36)
    for depth, found in zip((np.inf, 400.0), blur, strict=True):
        source = Source(depth, setup.source.field_slope, setup.source.wavelength_um)
        rays = pencil(setup.lens, source, xi, eta)
        assert np.ptp(rays.launch) > 0.05 * rays.launch.mean()
        y = 1000 * np.stack([rays.dx, rays.dy])
        light, even = (weight / weight.sum() for weight in (area * rays.launch, area))
        of_light, of_rays = (2 * np.sqrt(np.cov(y, aweights=w, ddof=0).trace()) for w in (light, even))
        assert found == pytest.approx(of_light, rel=1e-6)  # as the weights, differences
        assert found != pytest.approx(of_rays, rel=1e-4)
