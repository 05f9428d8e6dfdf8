"""Ideal lenses: the laws of thin lenses by hand, sharp images of every point, and no aberration of their own."""

from dataclasses import replace
from math import inf, radians, tan

import numpy as np
import pytest

from p2sf.errors import GeometryError, LensFileError
from p2sf.glass.media import MIRROR, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim, with_sensor
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.writing import lens_to_iset, lens_to_zmx
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.lens_checks import lens_checks
from p2sf.paraxial.pupils import paraxial_rays
from p2sf.paraxial.seidel import chromatic_sums, coefficients, seidel_sums
from p2sf.psf.methods import render
from p2sf.raytrace.pencil import displayed_opd, pencil
from p2sf.raytrace.trace import trace
from tests.support.lenses.simple_lenses import FIRST, GAP, SECOND, two_thin_lenses

UM = 0.55
ROUNDING = 1e-13  # some hundred roundings of paths and heights of up to some hundred mm
XI, ETA = np.random.default_rng(3).uniform(-0.7, 0.7, (2, 40))


def through(distance: float, focal_length: float) -> float:
    """Return the distance of the image behind a thin lens, 1/b = 1/f − 1/a."""
    return 1 / (1 / focal_length - (1 / distance if distance else inf))


def test_focal_length_and_back_focus_are_those_of_the_formulas_for_two_thin_lenses():
    points = cardinal_points(two_thin_lenses(), UM)
    together = FIRST * SECOND / (FIRST + SECOND - GAP)
    assert points.effective_focal_length == pytest.approx(together, rel=1e-14)
    assert points.back_focal_distance == pytest.approx(together * (FIRST - GAP) / FIRST, rel=1e-14)


@pytest.mark.parametrize("aim", ["stop", "paraxial"])
@pytest.mark.parametrize("depth", [inf, 300.0, 60.0, 40.0])  # real and virtual images
@pytest.mark.parametrize("field_deg", [0.0, 8.0, -25.0])
def test_every_point_is_imaged_sharply_and_by_equal_paths(depth, field_deg, aim):
    lens = with_sensor(two_thin_lenses(aim=aim), through(GAP - through(depth, FIRST), SECOND))
    rays = pencil(lens, Source(depth, tan(radians(field_deg)), UM), XI, ETA)
    size = abs(lens.sensor_mm) + 100
    assert max(np.abs(rays.dx).max(), np.abs(rays.dy).max(), np.abs(rays.path).max()) < ROUNDING * size


@pytest.mark.parametrize("depth", [300.0, 60.0])
def test_the_image_is_as_large_as_two_thin_lenses_make_it(depth):
    between = through(depth, FIRST)
    behind = through(GAP - between, SECOND)
    by_hand = (between / depth) * (behind / (GAP - between))
    lens = with_sensor(two_thin_lenses(), behind)
    rays = pencil(lens, Source(depth, tan(radians(20.0)), UM), [0.0], [0.0])
    entrance = -through(GAP - 5.0, FIRST)  # of the stop's image by the first lens, seen from the left
    height = -tan(radians(20.0)) * (depth + entrance)
    assert rays.chief_y.item() == pytest.approx(by_hand * height, rel=1e-12)


def test_a_thin_lens_between_media_images_by_the_law_of_a_refracting_surface():
    water, glass, f = 1.33, 1.5, 40.0
    depth = 200.0
    behind = glass / (1 / f - water / depth)
    lens = Lens(
        (Surface(thickness=behind, medium=ConstantIndex(glass), ideal_focal_length=f),),
        Aperture("stop_semi_diameter", 6.0),
        1,
        object_medium=ConstantIndex(water),
    )
    assert image_distance(lens, depth, UM) == pytest.approx(behind, rel=1e-14)
    rays = pencil(lens, Source(depth, 0.2, UM), XI, ETA)
    assert max(np.abs(rays.dx).max(), np.abs(rays.dy).max(), np.abs(rays.path).max()) < ROUNDING * 400


def test_an_ideal_mirror_sends_light_back_to_its_focus():
    lens = Lens((Surface(thickness=-70.0, medium=MIRROR, ideal_focal_length=70.0),), Aperture("f_number", 4.0), 1)
    rays = pencil(lens, Source(field_deg=5.0, wavelength_um=UM), XI, ETA)
    assert max(np.abs(rays.dx).max(), np.abs(rays.dy).max(), np.abs(rays.path).max()) < ROUNDING * 100
    assert rays.chief_y.item() == pytest.approx(70.0 * tan(radians(5.0)), rel=1e-12)


def test_paths_and_places_are_those_of_straight_lines_between_the_points():
    """The path of every ray, added up from its points, differs from a constant by what the rule says the lens adds."""
    depth, f = 90.0, 50.0
    behind = through(depth, f)
    lens = Lens((Surface(thickness=behind, ideal_focal_length=f),), Aperture("stop_semi_diameter", 10.0), 1)
    object_y = -0.3 * depth
    start = np.array([0.0, object_y, -depth])
    met = np.stack([10 * XI, 10 * ETA, 0 * XI], -1)
    found = trace(lens, np.broadcast_to(start, met.shape), met - start, UM)
    image = np.array([0.0, -object_y * behind / depth, behind])
    assert np.abs(found.points[-1] - image).max() < ROUNDING * 100
    assert np.isnan(found.path).all(), "one ray alone does not say which point is imaged"
    assert np.isfinite(found.cosines).all()


def test_nothing_is_added_to_seidel_or_chromatic_sums():
    lens = two_thin_lenses()
    rays = paraxial_rays(lens, 300.0, UM)
    assert not np.concatenate(seidel_sums(lens, rays, 0.3).columns()).any()
    chromatic = chromatic_sums(lens, rays, 0.48, 0.65, 0.3)
    assert not (chromatic.axial.any() or chromatic.lateral.any())
    found = coefficients(lens, 300.0, 0.3, UM)
    assert [found.w40, found.w31, found.w22, found.w20, found.w11] == [0, 0, 0, 0, 0]


def real_lens(behind: float) -> tuple[Surface, ...]:
    glass = ConstantIndex(1.6)
    return Surface(60.0, 3.0, glass), Surface(-90.0, behind)


def relayed(rim: float) -> tuple[Lens, Lens]:
    """Return a singlet with its sensor at the focus of its axis, and the same one with that image relayed 1:1.5."""
    plain = Lens(real_lens(1.0), Aperture("stop_semi_diameter", rim), 1)
    focus = float(image_distance(plain, inf, UM))
    plain = with_sensor(plain, focus)
    away = 50.0  # behind the first image
    further = Surface(thickness=75.0, ideal_focal_length=1 / (1 / away + 1 / 75.0))
    return plain, replace(plain, surfaces=(*real_lens(focus + away), further))


def test_the_aberrations_of_a_real_lens_pass_through_unchanged():
    plain, more = relayed(4.0)
    one, other = (coefficients(lens, inf, 0.05, UM) for lens in (plain, more))
    for term in ("w40", "w31", "w22", "w20", "w11"):
        assert getattr(other, term) == pytest.approx(getattr(one, term), rel=1e-12), term


@pytest.mark.parametrize("slope", [0.0, 0.02])
def test_wavefronts_of_a_real_lens_pass_through_up_to_sixth_order(slope):
    """What an ideal lens changes of an aberrated wavefront falls with the sixth power of aperture and field."""
    changes = []
    for scale in (1.0, 0.5):
        one, other = (
            displayed_opd(with_aim(lens, "paraxial"), Source(inf, scale * slope, UM), XI, ETA)
            for lens in relayed(4.0 * scale)
        )
        changes.append(np.abs(one - other).max() / np.abs(one).max())
    assert changes[0] < 1e-3
    assert changes[1] < 0.3 * changes[0]  # a quarter, over a wavefront that is of fourth order


@pytest.mark.parametrize("field_deg", [0.0, 10.0])
def test_all_methods_paint_the_airy_pattern(field_deg):
    lens = Lens((Surface(thickness=50.0, ideal_focal_length=50.0),), Aperture("f_number", 8.0), 1)
    source = Source(field_deg=field_deg, wavelength_um=UM)
    pictures = {m: render(lens, source, m, pixels=24, pixel_um=0.7) for m in ("huygens", "traced", "fitted", "seidel")}
    best = pictures["huygens"].values
    for method in ("traced", "fitted"):
        left = pictures[method].values - best
        assert 1 - np.square(left).sum() / np.square(best - best.mean()).sum() > 0.9999, method
        assert pictures[method].strehl == pytest.approx(1.0, abs=1e-4)
    if not field_deg:  # off the axis the cone is narrower than the six coefficients have it
        left = pictures["seidel"].values - best
        assert 1 - np.square(left).sum() / np.square(best - best.mean()).sum() > 0.999


def test_a_decentred_ideal_lens_moves_its_image_and_keeps_it_sharp():
    """The image of a thin lens of magnification m moves by (1 − m) times the decentre, and the paths stay equal."""
    depth, f, moved = 100.0, 40.0, (0.7, -1.1)
    behind = through(depth, f)
    lens = Lens(
        (Surface(thickness=0.0), Surface(thickness=behind, ideal_focal_length=f)), Aperture("stop_semi_diameter", 6), 1
    )
    off = displaced(lens, 2, 2, Placement(decentre_x=moved[0], decentre_y=moved[1]))
    source = Source(depth, 0.1, UM)
    before, after = (pencil(each, source, XI, ETA) for each in (lens, off))
    shift = np.array([np.ravel(after.chief_x)[0], (after.chief_y - before.chief_y).item()])
    assert shift == pytest.approx((1 + behind / depth) * np.array(moved), rel=1e-12)
    assert max(np.abs(after.dx).max(), np.abs(after.dy).max(), np.abs(after.path).max()) < ROUNDING * 200


def test_a_tilted_ideal_lens_keeps_every_point_sharp_where_it_images_it():
    """The image of an axial point by a lens tilted by α lies on the axis, as rays through the vertex go straight."""
    depth, f, tilt = 100.0, 40.0, radians(15.0)
    along = 1 / (np.cos(tilt) / f - 1 / depth)  # depth·cos α and along·cos α are the distances from its plane
    lens = Lens((Surface(thickness=along, ideal_focal_length=f),), Aperture("stop_semi_diameter", 6), 1)
    off = displaced(lens, 1, 1, Placement(tilt_x_deg=15.0))
    rays = pencil(off, Source(depth, 0.0, UM), XI, ETA)
    assert max(np.abs(rays.dx).max(), np.abs(rays.dy).max(), np.abs(rays.path).max()) < ROUNDING * 200


def test_files_keep_ideal_lenses():
    lens = two_thin_lenses()
    assert parse_toml(lens_to_toml(lens), "lens.toml").surfaces == lens.surfaces
    read = import_text(LensText("two.zmx", "utf-8", lens_to_zmx(lens)), GlassSources()).lens
    assert [s.ideal_focal_length for s in read.surfaces] == [FIRST, inf, SECOND]
    with pytest.raises(LensFileError, match=r"surface 1: .* cannot express its ideal focal length"):
        lens_to_iset(lens)


@pytest.mark.parametrize(
    "other", [{"radius": 50.0}, {"aspheric": (1e-6,)}, {"ideal_focal_length": 0.0}, {"ideal_focal_length": np.nan}]
)
def test_what_is_no_ideal_lens_is_refused(other):
    with pytest.raises(GeometryError, match="surface 1 is an ideal lens"):
        Lens((Surface(**{"ideal_focal_length": 50.0, **other}),), Aperture("f_number", 8.0), 1)


def test_no_warning_says_that_nothing_bends_light():
    assert not [warning for warning in lens_checks(two_thin_lenses()) if "bends light" in str(warning)]
