"""A lens with the errors of its build: laws of what it does to the picture, and sentences where there is none."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import P2SFError
from p2sf.glass.media import ShiftedIndex
from p2sf.lens.misalignment import displaced, straighten
from p2sf.lens.placement import Placement
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import stop_rim
from p2sf.pupil.wavefront_map import disc
from p2sf.raytrace.pencil import displayed_opd, opd_map, pencil, pupil_grid, reaching_by_surfaces
from p2sf.tolerance.errors_of_build import Tolerance
from p2sf.tolerance.nodal import exact_aberrations
from p2sf_explorer.compute.glass_outlines import Section
from p2sf_explorer.compute.layout import layout_of
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.pupil import pupil_of
from p2sf_explorer.compute.setup import built_lens, paraxial_setup, prescription, with_lens
from p2sf_explorer.compute.views.field_map import field_map
from p2sf_explorer.state.build_errors import renumber, with_error, without_piece
from p2sf_explorer.state.built import adjustments, exaggerate, pieces, with_errors
from p2sf_explorer.state.state import change, new_state
from tests.support.depths import RELAYS_MM
from tests.support.rays.perturbed_rays import perturbed
from tests.support.waves import rms_about_plane

START = with_lens(new_state(), "double_gauss_28")
SKEW = (("decentre_x", 3, 5, 0.08), ("tilt_x", 1, 2, 0.1), ("tilt_y", 3, 5, -0.07))


def of(errors, **entries):
    return change(START, errors=errors, **entries)


def chief(state):
    """Return where the chief ray meets the sensor, mm, in the axes of the aligned lens."""
    setup = paraxial_setup(state)
    rays = pencil(setup.lens, setup.source, np.zeros(1), np.zeros(1))
    local = np.array([np.squeeze(rays.chief_x), np.squeeze(rays.chief_y), 0.0])
    rotation, origin = setup.lens.frames[-1]
    return (rotation @ local + origin)[:2]


def test_a_piece_off_twice_is_one_break_of_the_coordinates():
    lens = find_lens("double_gauss_28")
    found = with_errors(lens, (("decentre_y", 3, 5, 0.1), ("tilt_x", 3, 5, 0.2)))
    assert found == displaced(lens, 3, 5, Placement(decentre_y=0.1, tilt_x_deg=0.2))
    assert with_errors(lens, ()) == lens


@pytest.mark.parametrize("by", [0.05, -0.4])
def test_the_whole_lens_moves_the_image_of_infinity_with_it(by):
    """A lens at infinity images directions; moved sideways by d it moves every image by d, and changes no picture."""
    state, moved = of(()), of((("decentre_y", 1, 11, by),))
    assert chief(moved) - chief(state) == pytest.approx([0, by], abs=1e-12)
    a, b = (live(change(each, method="traced"), "settled").psf for each in (state, moved))
    assert a.pixel_um == b.pixel_um
    # The pupil with symmetry and the one without are summed at other nodes, each settled to 1e-3.
    assert np.abs(a.values - b.values).max() < 2e-3 * a.values.max()


def test_a_near_source_is_imaged_with_the_magnification_about_the_moved_axis():
    """First order: a lens moved by d against a point on the axis moves its image by d(1 − m), with the sensor there."""
    near, d = {"depth_mm": 1000.0, "focus_mm": 1000.0, "field_deg": 0.0}, 1e-3
    cardinal = cardinal_points(prescription(START), START.optics.wavelength_nm / 1e3)
    # Newton: m = f/x of a source x before the front focus; for a real image m < 0.
    magnification = -float(cardinal.effective_focal_length) / (1000.0 + float(cardinal.front_focal_distance))
    moved = chief(of((("decentre_x", 1, 11, d),), **near)) - chief(of((), **near))
    assert moved == pytest.approx([d * (1 - magnification), 0.0], abs=1e-4 * d)  # the third order is far smaller


def test_setting_back_gives_the_very_same_picture():
    errors = with_error(with_error((), "decentre_y", (3, 5), 0.1), "tilt_x", (1, 2), 0.3)
    assert with_error(with_error(errors, "decentre_y", (3, 5), 0.0), "tilt_x", (1, 2), 0.0) == ()
    before, after = live(of(()), "settled"), live(change(of(errors), errors=()), "settled")
    assert np.array_equal(before.psf.values, after.psf.values)
    assert np.array_equal(before.pupil.waves, after.pupil.waves, equal_nan=True)


@pytest.mark.parametrize("quality", ["preview", "settled"])
def test_the_pupil_is_that_of_exact_rays_all_over_the_disc(quality):
    """The map of terms against exact rays on a grid, traced one by one."""
    setup = paraxial_setup(of(SKEW, field_deg=7.0))
    shown = pupil_of(setup, True, quality)
    across, up, disc_32 = pupil_grid(32)
    exact = rms_about_plane(opd_map(setup.lens, setup.source, 32)[disc_32], across[disc_32], up[disc_32])
    xi, eta, inside = disc(len(shown.waves))
    some = np.flatnonzero(inside.ravel())[:: inside.sum() // 500]
    waves = displayed_opd(setup.lens, setup.source, xi.ravel()[some], eta.ravel()[some])
    # Order 8 leaves 1e-2 waves of this lens at full aperture, order 18 rounding of the quadrature.
    assert np.abs(shown.waves.ravel()[some] - waves).max() < {"preview": 2e-2, "settled": 1e-4}[quality]
    assert shown.rms == pytest.approx(exact, rel=0.05)
    left, right = shown.waves[:, : len(shown.waves) // 2], shown.waves[:, : -len(shown.waves) // 2 - 1 : -1]
    assert np.nanmax(np.abs(left - right)) > 0.05  # or half of the pupil would have done


def test_the_preview_of_a_misaligned_lens_is_its_settled_picture():
    """`traced` sums exact rays over the whole pupil; the preview is a fit to 64 of them."""
    state = of(SKEW, field_deg=5.0, method="traced", f_number=5.6)
    quick, slow = (live(state, quality).psf for quality in ("preview", "settled"))
    assert quick.pixel_um * len(quick.values) == pytest.approx(slow.pixel_um * len(slow.values))
    block = len(slow.values) // len(quick.values)
    centre = slow.values[::block, ::block] / slow.values.max()  # sample N/2 is the chief ray in both
    off = quick.values / quick.values.sum() - centre / centre.sum()
    spread = (centre - centre.mean()) / centre.sum()
    assert (off**2).sum() < 0.005 * (spread**2).sum()  # R² > 0.995, as good as 46 numbers are


def test_seidel_says_that_it_is_of_the_lens_set_straight():
    straight, skew = (live(of(errors, method="seidel"), "preview") for errors in ((), SKEW))
    assert np.array_equal(straight.psf.values, skew.psf.values)
    assert any("aligned" in str(message) for message in skew.warnings)
    assert not any("aligned" in str(message) for message in straight.warnings)


@pytest.mark.parametrize(
    ("errors", "says"),
    [
        ((("tilt_x", 3, 5, 90.0),), "surface 3: a tilt of 90°"),
        ((("tilt_x", 3, 5, 120.0),), "surface 3: a tilt of 120°"),
        ((("decentre_y", 3, 5, 40.0),), "surface 3 is decentred by (0, 40, 0) mm"),
        ((("tilt_x", 7, 9, 80.0),), "surface 7"),
        ((("thickness", 2, 2, -900.0),), "surface 2: a thickness of 0.5 mm that is off by -900 mm"),
    ],
)
def test_what_cannot_be_built_is_one_sentence_with_surface_and_value(errors, says):
    with pytest.raises(P2SFError) as caught:
        live(of(errors), "preview")
    assert says in str(caught.value)


@pytest.mark.parametrize(
    "bad",
    [
        (("decentre", 1, 2, 0.1),),
        (("decentre_x", 2, 1, 0.1),),
        (("decentre_x", 0, 1, 0.1),),
        (("decentre_x", 1, 2, float("nan")),),
        (("decentre_x", 1, 2, True),),
        (("decentre_x", 1, 2, "0.1"),),
        (("decentre_x", 1.0, 2, 0.1),),
        ("decentre_x", 1, 2, 0.1),
        [("decentre_x", 1, 2, 0.1)],
        None,
    ],
)
def test_a_state_has_no_errors_that_are_none(bad):
    with pytest.raises(P2SFError):
        change(START, errors=bad)


def test_rows_put_in_or_taken_out_keep_errors_at_their_glass():
    errors = (("radius", 3, 3, 0.1), ("decentre_y", 3, 5, 0.1), ("tilt_x", 7, 9, 0.2))
    more = renumber(errors, 4, 1)
    assert more == (("radius", 3, 3, 0.1), ("decentre_y", 3, 6, 0.1), ("tilt_x", 8, 10, 0.2))
    assert renumber(more, 5, -1) == errors
    assert renumber(errors, 3, -1) == (("decentre_y", 3, 4, 0.1), ("tilt_x", 6, 8, 0.2))


def test_a_piece_is_set_right_with_its_radii_and_glasses():
    errors = (("radius", 4, 4, 0.1), ("radius", 7, 7, 0.1), ("decentre_y", 3, 5, 0.1), ("decentre_y", 1, 5, 0.1))
    assert without_piece(errors, (3, 5)) == (("radius", 7, 7, 0.1), ("decentre_y", 1, 5, 0.1))


def test_the_pieces_are_elements_groups_the_lens_and_the_sensor():
    spans = [piece.span for piece in pieces(find_lens("double_gauss_28"))]
    assert spans == [(1, 2), (3, 5), (7, 9), (10, 11), (1, 5), (7, 11), (1, 11), (12, 12)]
    assert [one.kind for one in adjustments(find_lens("double_gauss_28"), (12, 12))] == ["tilt_x", "tilt_y"]
    kinds = [(one.kind, one.span) for one in adjustments(find_lens("double_gauss_28"), (3, 5))]
    assert kinds[:4] == [(kind, (3, 5)) for kind in ("decentre_x", "decentre_y", "tilt_x", "tilt_y")]
    assert ("radius", (4, 4)) not in kinds  # a plane has no radius to be off
    assert ("index", (4, 4)) in kinds and ("index", (5, 5)) not in kinds


def test_an_index_is_off_alike_at_every_wavelength_and_is_kept_by_a_file():
    lens = with_errors(find_lens("double_gauss_28"), (("index", 3, 3, 1e-3),))
    medium = find_lens("double_gauss_28").surfaces[2].medium
    waves = np.array([0.45, 0.55, 0.65])
    assert lens.surfaces[2].medium.index(waves) - medium.index(waves) == pytest.approx(np.full(3, 1e-3), abs=1e-15)
    assert isinstance(lens.surfaces[2].medium, ShiftedIndex)
    assert parse_toml(lens_to_toml(lens)) == lens


def test_a_drawing_exaggerates_places_alone_and_never_too_far():
    errors = (("radius", 3, 3, 0.1), ("decentre_y", 3, 5, 0.1), ("tilt_x", 3, 5, 2.0))
    larger, factor = exaggerate(errors, 100)
    assert factor == 30 and larger == (("radius", 3, 3, 0.1), ("decentre_y", 3, 5, 3.0), ("tilt_x", 3, 5, 60.0))
    shown = live(of((("decentre_y", 3, 5, 0.1),), exaggerated=10), "preview").layout
    assert shown.exaggerated == 10 and shown.note
    first = next(o for o in shown.drawing.glass.outlines if o.surfaces == (3, 4))
    straight = next(o for o in live(of(()), "preview").layout.drawing.glass.outlines if o.surfaces == (3, 4))
    assert first.y - straight.y == pytest.approx(np.ones_like(first.y))


def test_the_drawn_rays_are_those_that_are_traced():
    """Every place of a drawn ray lies on its surface: local z is the sag, in the axes of that surface."""
    state = of(SKEW, field_deg=6.0, field_x_deg=4.0)
    setup, drawn = paraxial_setup(state), live(state, "preview").layout
    rays = pencil(setup.lens, setup.source, np.zeros(3), np.array([-1.0, 0.0, 1.0]))
    turned = np.deg2rad(setup.source.azimuth_deg)
    y = np.sin(turned) * -np.squeeze(rays.chief_x) + np.cos(turned) * np.squeeze(rays.chief_y)
    ray = next(ray for ray in drawn.rays if ray.kind == "chief")
    assert ray.y[-1] == pytest.approx(float(y), abs=2e-3)  # aimed for a drawing
    assert len(ray.z) == len(setup.lens.surfaces) + 2


@pytest.mark.parametrize(
    ("name", "errors", "field"),
    [("double_gauss_28", SKEW, 0.0), ("double_gauss_28", SKEW, 9.0), ("petzval", (("decentre_y", 1, 2, 0.2),), 3.0)],
)
def test_drawn_rays_meet_the_rim_of_the_stop_which_does_not_clip_them(name, errors, field):
    """The stop stands upright behind the pieces that are moved, so that η = ±1 is y = ±rim there."""
    state = change(with_lens(new_state(), name), errors=errors, field_deg=field, f_number=4.0, clip=True)
    stop, rays = paraxial_setup(state).stop, live(state, "preview").layout.rays
    edge = [ray for ray in rays if ray.kind == "rim"]
    assert len(edge) == 2 and not any(ray.clipped for ray in rays)
    heights = sorted(float(ray.y[int(stop.surface)]) for ray in edge)
    rim = float(stop.semi_diameter)
    assert heights == pytest.approx([-rim, rim], abs=1e-3 * rim)  # far less than can be seen


def test_the_drawn_sensor_keeps_its_height_while_a_part_is_moved():
    """It holds the widest field of the aligned lens; its height does not flicker with an error of the build."""
    assert straighten(with_errors(prescription(START), SKEW)) == prescription(START)
    halves = {live(of((("decentre_y", 3, 5, by),)), "preview").layout.sensor_half for by in (0.0, 0.01, 0.3)}
    assert len(halves) == 1


def test_a_section_is_seen_along_x():
    lens = displaced(find_lens("double_gauss_28"), 3, 5, Placement(decentre_x=3.0, tilt_x_deg=10.0))
    place = Section.of(lens.frames[2])
    turn = np.deg2rad(10.0)
    z, y = place.placed(0.0, 1.0)  # a point above the vertex; right-handed about x, y turns towards z
    assert (float(z) - place.z, float(y)) == pytest.approx((np.sin(turn), np.cos(turn)))


def test_a_field_along_x_of_a_round_lens_is_that_field_turned():
    across, up = (
        live(of((), **fields), "settled") for fields in ({"field_deg": 0.0, "field_x_deg": 6.0}, {"field_deg": 6.0})
    )
    assert np.allclose(across.psf.values, up.psf.values, rtol=0, atol=1e-9 * up.psf.values.max())
    assert across.setup.source.azimuth_deg == pytest.approx(90.0)


def test_mirror_images_of_field_and_error_have_mirror_images_of_pictures():
    """A lens decentred to +x seen from +x is one decentred to −x seen from −x, turned by 180°: the same picture."""
    one = live(of((("decentre_x", 3, 5, 0.1),), field_deg=0.0, field_x_deg=5.0), "settled").psf
    two = live(of((("decentre_x", 3, 5, -0.1),), field_deg=0.0, field_x_deg=-5.0), "settled").psf
    other = live(of((("decentre_x", 3, 5, -0.1),), field_deg=0.0, field_x_deg=5.0), "settled").psf
    assert np.allclose(one.values, two.values, rtol=0, atol=1e-6 * one.values.max())
    assert np.abs(one.values - other.values).max() > 0.02 * one.values.max()


def test_errors_beyond_the_lens_are_passed_over_and_those_of_the_sensor_tilt_it():
    lens = find_lens("double_gauss_28")
    assert with_errors(lens, (("decentre_y", 30, 31, 0.1),)) == lens
    tilted = with_errors(lens, (("tilt_x", 12, 12, 2.0),))
    assert tilted.sensor_before == (Placement(tilt_x_deg=2.0),)
    assert replace(tilted, sensor_before=()) == lens


def test_a_built_lens_is_the_prescription_where_nothing_is_off():
    assert built_lens(START) is prescription(START)


def test_nodes_stand_in_the_map_where_their_fields_do():
    """The Zernike coma of exact rays is little at the node of third order, and larger a tenth of the map away."""
    state = of((("decentre_y", 3, 5, 0.05),), f_number=16.0, field_deg=0.0)
    found = field_map(live(state, "settled")).question
    ((name, x, y),) = (node for node in found.nodes if node[0] == "coma")
    assert name == "coma" and x == pytest.approx(0.0, abs=1e-9) and 0.0 < abs(y) < 0.5

    def coma(place):
        field_x, field_y = found.field_of(np.array(place))
        setup = paraxial_setup(change(state, field_deg=field_y, field_x_deg=field_x))
        return abs(exact_aberrations(setup.lens, setup.source)[0])

    # The fifth order moves the exact node by some hundredths of the map; mirrored, it would be far away.
    assert coma((x, y)) < 0.4 * min(coma((x, y - 0.1)), coma((0.1, y)), coma((-0.1, y)))
    assert coma((x, y)) < 0.1 * coma((x, -y))


@pytest.mark.parametrize("stop", ["file", "auto"])
@pytest.mark.parametrize("error", [("thickness", 3, 3, 0.5), ("radius", 5, 5, 2.0), ("index", 4, 4, 0.005)], ids=str)
def test_the_iris_of_a_built_lens_keeps_its_radius(error, stop):
    """At an f-number the stop of the lens with errors is that of the lens without, in every view and in its file."""
    still, off = (change(START, f_number=8.0, stop=stop, errors=errors) for errors in ((), (error,)))
    rim = float(paraxial_setup(still).stop.semi_diameter)
    assert [float(paraxial_setup(off).stop.semi_diameter), layout_of(off, paraxial_setup(off)).drawing.stop_rim] == [
        pytest.approx(rim, rel=1e-15)
    ] * 2
    mean = np.abs(rim_heights(off))
    assert mean == pytest.approx(rim, rel=1e-7), "exact rays of the rim"
    filed = change(with_lens(new_state(), "fast_gauss_f14"), errors=(error,))
    saved = parse_toml(lens_to_toml(built_lens(filed)), "saved")
    assert stop_rim(saved) == pytest.approx(stop_rim(prescription(filed)), rel=1e-15)


def rim_heights(state) -> np.ndarray:
    """Return how high exact rays to the rim of the stop meet its surface, mm."""
    setup = paraxial_setup(state)
    angle = np.linspace(0, 2 * np.pi, 7)
    found = reaching_by_surfaces(setup.lens, setup.source, np.cos(angle), np.sin(angle))
    return np.hypot(*found.on_surfaces.points[int(setup.stop.surface) - 1, :2, :-1])


def test_an_object_at_a_finite_depth_stays_where_it_is():
    """Its image lands where the referee's own rays from that place do: 3.3 mm off where the field's angle was kept."""
    start = with_lens(new_state(), "telecentric_relay")
    field = max(find_lens("telecentric_relay").fields_deg)
    designed, moved = (
        change(start, depth_mm=RELAYS_MM["telecentric_relay"], field_deg=field, errors=errors)
        for errors in ((), (("thickness", 6, 6, 0.2),))
    )
    setup = paraxial_setup(designed)
    assert paraxial_setup(moved).object_y_mm == pytest.approx(setup.object_y_mm, rel=1e-12)
    seen = perturbed(setup.lens, setup.source, Tolerance("thickness", 6, 0.2), 0.2)
    place, *_ = seen.traced(seen.aimed(np.zeros(1), np.zeros(1)))
    assert chief(moved) == pytest.approx(place[:, 0], abs=1e-7)
