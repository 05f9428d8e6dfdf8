"""Holes and shadows: where they end the pupil, against closed forms, sums over a grid, and another program's PSFs."""

from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from p2sf.conventions import centred_axis
from p2sf.disc.domain import WHOLE, ClearNodes
from p2sf.disc.mask import PupilMask
from p2sf.disc.open_part import OpenPart, open_intervals, places_between
from p2sf.disc.transform import sum_plane_waves
from p2sf.errors import GeometryError, LensFileError
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim, with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml, read_toml
from p2sf.psf.choosing import choose
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import PsfOptions, render
from p2sf.psf.traced import traced_psf
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.vignetting import open_part, pupil_nodes
from p2sf.raytrace.pencil import pencil, pupil_grid
from p2sf.studies import validate
from tests.support.masked_sum import masked_sum
from tests.support.tiers import in_tiers
from tests.support.waves import r_squared

LISTED = np.load(Path(__file__).parents[1] / "data" / "telescope_psf.npz")
FIELDS_DEG = ((0.0, 0.0), (0.0, 1.225), (0.0, 1.75), (1.176, 1.176))
RIM, SAMPLED_RIM = 4180.0, 4180.0 * (1 - 1 / 1023)
CEILINGS = (3.31e-6, 1.53e-5, 3.02e-5, 1.99e-5), (2.7e-8, 1.72e-7, 2.98e-7, 3.05e-7)
"""1 − R² that an exact program reaches against the listed PSFs, with the nominal rim and with that of their grid."""


def telescope(rim: float) -> Lens:
    lens = read_toml(Path(validate.__file__).with_name("telescope.toml"))
    return replace(lens, aperture=Aperture("stop_semi_diameter", rim))


@pytest.mark.parametrize(("field", "sampled"), in_tiers([(0, False), (1, True), (2, False), (3, True)], [(0, False)]))
def test_the_telescope_of_another_program(field, sampled):
    """A primary with a hole behind the stop, and rims: OpticStudio's Huygens PSFs, as near as their grid allows."""
    lens, source = telescope(SAMPLED_RIM if sampled else RIM), Source(wavelength_nm=500, field_deg=FIELDS_DEG[field])
    nodes = pupil_nodes(lens, source, (60, 170), clip=True)
    data = pencil(lens, source, nodes.xi, nodes.eta)
    # The listing's grid lies in the sensor's directions: there frequencies are turned, of both halves of the pupil.
    turn, fx, fy = np.deg2rad(source.azimuth_deg), np.append(data.fx, -data.fx), np.append(data.fy, data.fy)
    amplitude, axis = np.tile(nodes.weight * np.exp(2j * np.pi * data.phase), 2), centred_axis(64, 0.289)
    fx, fy = fx * np.cos(turn) + fy * np.sin(turn), fy * np.cos(turn) - fx * np.sin(turn)
    intensity = np.abs(sum_plane_waves(amplitude, fx, fy, axis, axis, even=False)) ** 2
    assert 1 - r_squared(intensity, LISTED[f"psf_{field}"].astype(float)) < 1.02 * CEILINGS[sampled][field]


@pytest.mark.parametrize("field_deg", [0.0, 1.75])
def test_methods_agree_on_the_telescope_behind_a_ring(field_deg):
    lens, source = with_mask(telescope(RIM), PupilMask(obscuration=2558 / RIM)), Source(field_deg=field_deg)
    reference = huygens_psf(lens, source, 64, 0.289)
    assert r_squared(fitted_psf(lens, source, 64, 0.289).values, reference.values) > 0.998
    assert r_squared(traced_psf(lens, source, 64, 0.289).values, reference.values) > 0.9999


def test_a_hole_in_the_stop_is_an_obscuration():
    plain = with_aim(find_lens("double_gauss_28"), "stop")
    stop = plain.stop_surface - 1
    rim = plain.aperture.value
    surfaces = tuple(replace(s, inner_radius=0.4 * rim) if k == stop else s for k, s in enumerate(plain.surfaces))
    holed = replace(plain, surfaces=tuple(replace(s, semi_diameter=1e3) for s in surfaces))
    source = Source(field_deg=10)
    by_rays = huygens_psf(holed, source, 24, 1.8, clip=True)
    by_mask = huygens_psf(with_mask(plain, PupilMask(obscuration=0.4)), source, 24, 1.8)
    assert by_rays.values == pytest.approx(by_mask.values, rel=1e-6, abs=1e-9)
    assert by_rays.strehl == pytest.approx(by_mask.strehl, rel=1e-6)


def two_shadows(field_deg: float) -> tuple[Lens, Source]:
    """Return bare planes with shadows before and behind the stop of a thin lens: they walk apart with the field."""
    rows = (
        Surface(thickness=20.0, inner_radius=4.0),
        Surface(thickness=10.0),
        Surface(thickness=0.0, inner_radius=3.0),
        Surface(radius=100.0, thickness=195.0),
    )
    glass = find_lens("singlet_f6").surfaces[0].medium
    rows = (*rows[:3], replace(rows[3], medium=glass, thickness=5.0), Surface(radius=-100.0, thickness=95.0))
    return Lens(rows, Aperture("stop_semi_diameter", 10.0), 2, aim="paraxial"), Source(field_deg=field_deg)


def circles_apart(one: float, two: float, apart: float) -> float:
    """Return the area that two circles share."""
    if apart <= abs(one - two):
        return pi * min(one, two) ** 2
    if apart >= one + two:
        return 0.0
    first = np.arccos((apart**2 + one**2 - two**2) / (2 * apart * one))
    second = np.arccos((apart**2 + two**2 - one**2) / (2 * apart * two))
    return float(one**2 * (first - np.sin(2 * first) / 2) + two**2 * (second - np.sin(2 * second) / 2))


@pytest.mark.parametrize("field_deg", [0.0, 3.0, 8.0, 11.0])
def test_shadows_that_overlap_count_once(field_deg):
    """In collimated light before the lens shadows are circles that move by distance times slope."""
    lens, source = two_shadows(field_deg)
    slope = np.tan(np.deg2rad(field_deg))
    centres = 20 * slope, -10 * slope  # of the shadows at −20 and +10 mm, in the plane of the stop
    hidden = pi * (4.0**2 + 3.0**2) - circles_apart(4.0, 3.0, 30 * slope)
    assert max(abs(c) + r for c, r in zip(centres, (4, 3), strict=True)) < 10  # wholly inside the pupil
    nodes = pupil_nodes(lens, source, (24, 60), True)
    assert nodes.share == pytest.approx(1 - hidden / (100 * pi), abs=1e-8)


def test_shadows_over_the_rim_count_as_far_as_they_lie_inside():
    lens, source = two_shadows(20.0)  # the first shadow's centre lies 7.3 mm off the axis, so that it crosses the rim
    slope = np.tan(np.deg2rad(20.0))
    hidden = circles_apart(4.0, 10.0, 20 * slope) + circles_apart(3.0, 10.0, 10 * slope)
    nodes = pupil_nodes(lens, source, (24, 60), True)
    assert nodes.share == pytest.approx(1 - hidden / (100 * pi), abs=1e-8)


@pytest.mark.parametrize(
    "mask",
    [
        pytest.param(PupilMask(obscuration=0.3, vanes=4, vane_width=0.03), marks=pytest.mark.slow),
        PupilMask(obscuration=0.2, vanes=3, vane_width=0.03, vane_angle_deg=20, blades=5, roundness=0.6),
    ],
    ids=["even", "uneven"],
)
def test_rims_and_a_mask_together_are_the_sum_over_a_grid(mask):
    """The grid of 8e4 points is good to some 1e-3, by its edges."""
    lens, source = with_aim(find_lens("double_gauss_28"), "paraxial"), Source(field_deg=14)
    found = huygens_psf(with_mask(lens, mask), source, 24, 3.0, clip=True)
    shares = [pupil_nodes(with_mask(lens, mask), source, (20, 60), clip).share for clip in (True, False)]
    assert shares[0] < shares[1] - 0.01
    assert r_squared(masked_sum(lens, source, mask, 24, 3.0, 320, clip=True), found.values) > 0.998


def line_nodes(part: OpenPart, lines: int, samples: int) -> ClearNodes:
    """Return nodes by Gauss–Legendre along lines of the whole disc, between crossings of chords."""
    light, dark = ([np.stack(edge) for edge in some] for some in part.edges())
    turn = np.linspace(0, 2 * pi, 2048, endpoint=False)
    rim = (np.sin(turn), np.cos(turn)) if part.rim is None else part.rim.points(512, WHOLE)
    light = [np.stack(rim), *light]
    places, widths = places_between([*light, *dark], lines)
    node, weight = leggauss(samples)
    found = []
    for low, high in zip(*open_intervals(light, dark, places), strict=True):
        half = (high - low)[:, None] / 2
        eta, area = half * node + (low + high)[:, None] / 2, half * weight * widths[:, None] / pi
        found.append(np.stack([np.broadcast_to(places[:, None], eta.shape), eta, area]).reshape(3, -1))
    xi, eta, area = np.concatenate(found, axis=1)
    return ClearNodes(xi, eta, area / area.sum(), float(area.sum()), domain=WHOLE)


@pytest.mark.parametrize(
    ("mask", "field_deg"),
    [
        (PupilMask(), 14.0),
        (PupilMask(vanes=3, vane_width=0.03, vane_angle_deg=80), 14.0),
        (PupilMask(obscuration=0.3, blades=6, roundness=0.3, blade_angle_deg=10), 14.0),
        (PupilMask(obscuration=0.2, obscuration_x=0.15, vanes=4, blades=5), 11.0),
    ],
    ids=["rims", "vanes", "iris", "all"],
)
@pytest.mark.parametrize("hole", [None, "near", "far"])
def test_pieces_and_lines_are_of_one_open_part(mask, field_deg, hole):
    """Means of plane waves by signed pieces, and by lines between chords: the 1024 of a circle hold 6.3e-6 less.

    The hole far from the stop lies beside its middle, across vanes and a rim.
    """
    lens = with_mask(find_lens("double_gauss_28"), mask)
    if hole:
        at = {"near": lens.stop_surface - 2, "far": 0}[hole]
        rows = list(lens.surfaces)
        rows[at] = replace(rows[at], inner_radius=0.3 * rows[at].semi_diameter)
        lens = replace(lens, surfaces=tuple(rows))
    part = open_part(lens, Source(field_deg=field_deg), True)
    assert bool(part.shadows) == bool(hole)
    fx, fy = np.array([0.3, 2.0, -1.3]), np.array([1.6, -0.4, 0.9])
    found = []
    for nodes in (part.nodes((32, 96)).unfolded(), line_nodes(part, 600, 64)):
        waves = np.exp(2j * pi * (np.outer(fx, nodes.xi) + np.outer(fy, nodes.eta)))
        found.append(np.append(waves @ nodes.weight, 1.0) * nodes.share)
    assert found[0] == pytest.approx(found[1], abs=1.3e-5)  # of two curves
    assert 0.3 < part.nodes((32, 96)).share < 0.96


@pytest.mark.parametrize(
    ("name", "field_deg", "mask", "hole"),
    [
        ("telephoto", 17.305, {"blades": 6, "roundness": 0.3, "blade_angle_deg": 113.747, "obscuration": 0.105}, None),
        ("tessar", 13.589, {"obscuration": 0.219}, (0, 0.0697)),
        ("tessar", 4.454, {"obscuration": 0.287, "obscuration_x": -0.234, "obscuration_y": -0.571}, (2, 0.1347)),
        ("cooke_triplet", 19.359, {"obscuration": 0.405, "blades": 5, "blade_angle_deg": 58.231}, (0, 2.259)),
        ("wide_angle_35", 38.0, {"blades": 3, "blade_angle_deg": 60.0}, None),
    ],
)
def test_overlaps_of_any_size_and_corners_cut_off_count(name, field_deg, mask, hole):
    """A disc beside a blade, a hole beside a disc, by slivers; a corner of the rim that a blade just cuts off.

    Lines between chords find them by crossings alone, and hold as much less as above.
    """
    lens = with_mask(find_lens(name), PupilMask(**mask))
    if hole:
        rows = list(lens.surfaces)
        rows[hole[0]] = replace(rows[hole[0]], inner_radius=hole[1])
        lens = replace(lens, surfaces=tuple(rows))
    part = open_part(lens, Source(field_deg=field_deg), True)
    assert part.nodes((32, 96)).share == pytest.approx(line_nodes(part, 800, 64).share, abs=2e-5)


def test_an_iris_beside_all_that_is_clear_is_refused():
    rows = Surface(thickness=20.0, semi_diameter=5.0), Surface(), Surface(thickness=95.0, ideal_focal_length=100.0)
    lens = Lens(rows, Aperture("stop_semi_diameter", 5.0), 2, aim="paraxial")
    lens = with_mask(lens, PupilMask(blades=3, blade_angle_deg=60))
    with pytest.raises(GeometryError, match="nothing open; leave clip off"):
        pupil_nodes(lens, Source(field_deg=float(np.rad2deg(np.arctan(1.9 * 5 / 20)))), (16, 48), True)


@pytest.mark.parametrize("azimuth_deg", [0.0, 250.0])
def test_rims_of_a_misaligned_lens_are_seen_from_any_azimuth(azimuth_deg):
    """The open share against exact rays of a grid of 1e5 points, good to 1e-3 by its edges."""
    lens = displaced(find_lens("tessar"), 3, 4, Placement(0.03, 0.07, 0.0, 0.5, 0.2))
    first, *others = lens.surfaces
    lens = replace(lens, surfaces=(replace(first, inner_radius=0.3 * first.semi_diameter), *others))
    lens = with_mask(lens, PupilMask(obscuration=0.2, obscuration_x=0.4))
    source = Source(field_deg=15, azimuth_deg=azimuth_deg)
    xi, eta, inside = pupil_grid(360)
    xi, eta = xi[inside], eta[inside]
    passed = pencil(lens, source, xi, eta, True).passed & mask_seen(lens, source).opens(xi, eta)
    assert pupil_nodes(lens, source, (16, 48), True).share == pytest.approx(passed.mean(), abs=1e-3)
    assert np.array_equal(open_part(lens, source, True).opens(xi, eta), passed)


@pytest.mark.slow
def test_the_choice_takes_rays_where_a_hole_clips():
    lens, source = telescope(RIM), Source(wavelength_nm=500, field_deg=1.225)
    assert choose(lens, source, 0.999, clip=True).method == "traced"
    reference = huygens_psf(lens, source, 32, 0.5, clip=True)
    found = render(lens, source, "auto", 32, 0.5, PsfOptions(min_r2=0.999, clip=True))
    assert r_squared(found.values, reference.values) > 0.999


def test_a_hole_as_wide_as_the_surface_is_refused():
    with pytest.raises(GeometryError, match="inner radius"):
        Lens((Surface(50.0, 4.0, semi_diameter=5.0, inner_radius=5.0),), Aperture("f_number", 8))


def test_holes_are_read_and_written():
    lens = telescope(RIM)
    assert parse_toml(lens_to_toml(lens)).surfaces == lens.surfaces
    text = lens_to_toml(lens).replace("inner_radius = 2558.0", "inner_radius = -1")
    with pytest.raises(LensFileError, match="inner_radius is -1"):
        parse_toml(text)
