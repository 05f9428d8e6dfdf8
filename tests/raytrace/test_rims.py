"""Clear rims that are decentred or rectangles: overlaps of circles by the formula, sinc patterns, turned sources."""

from dataclasses import replace
from math import acos, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError, LensFileError
from p2sf.lens.lens import Aperture, Lens, Surface, seen_from
from p2sf.lens.rim import Rim
from p2sf.lens.source import Source
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import import_text
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.lensfile.writing import lens_to_zmx
from p2sf.paraxial.pupils import RIM_TIE
from p2sf.psf.methods import PsfOptions, render
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.surface import Status

STOP, AWAY, FOCAL, UM = 5.0, 20.0, 100.0, 0.55
COUNTS = 24, 64


def lens_with(surface: Surface, stop: float = STOP) -> Lens:
    """Return an ideal lens with its stop ``AWAY`` mm in front, and a rim in the plane of the lens."""
    rows = Surface(thickness=AWAY), replace(surface, thickness=0.0), Surface(thickness=FOCAL, ideal_focal_length=FOCAL)
    return Lens(rows, Aperture("stop_semi_diameter", stop), 1)


def overlap(r: float, s: float, d: float) -> float:
    """Return the area common to two circles whose centres are ``d`` apart (elementary; both segments)."""
    if d >= r + s:
        return 0.0
    if d <= abs(r - s):
        return pi * min(r, s) ** 2
    a, b = (d * d + r * r - s * s) / (2 * d), (d * d + s * s - r * r) / (2 * d)
    parts = r * r * acos(a / r) - a * sqrt(r * r - a * a), s * s * acos(b / s) - b * sqrt(s * s - b * b)
    return sum(parts)


def footprint(field_deg: float, azimuth_deg: float) -> tuple[float, float]:
    """Return where the chief ray, which runs straight on from the stop's centre, meets the plane of the rim."""
    far, turn = AWAY * tan(radians(field_deg)), radians(azimuth_deg)
    return far * sin(turn), far * cos(turn)


@pytest.mark.slow
@pytest.mark.parametrize("azimuth_deg", [0.0, 35.0, 200.0])
@pytest.mark.parametrize("field_deg", [0.0, 6.0])
@pytest.mark.parametrize("decentre", [(0.0, 3.0), (-2.5, 1.5)])
def test_a_decentred_rim_leaves_the_overlap_of_two_circles(decentre, field_deg, azimuth_deg):
    radius = 4.5
    lens = lens_with(Surface(semi_diameter=radius, rim=Rim(decentre)))
    source = Source(field_slope=tan(radians(field_deg)), wavelength_um=UM, azimuth_deg=azimuth_deg)
    x, y = footprint(field_deg, azimuth_deg)
    wider = radius * (1 + RIM_TIE)  # what the program takes stated rims to be, for their rounding
    by_hand = overlap(STOP, wider, hypot(decentre[0] - x, decentre[1] - y)) / (pi * STOP**2)
    # The corners of the outline are known to 1e-10 of the radius, the quadrature between them is to 1e-9.
    assert pupil_nodes(lens, source, COUNTS, clip=True).share == pytest.approx(by_hand, abs=3e-8)


@pytest.mark.parametrize("turn", [0.0, 25.0])
@pytest.mark.parametrize("azimuth_deg", [0.0, 70.0])
def test_a_rectangle_inside_the_beam_leaves_its_own_area(turn, azimuth_deg):
    lens = lens_with(Surface(rim=Rim((0.4, -0.6), (2.5, 1.2), turn)))
    source = Source(field_slope=tan(radians(1.0)), wavelength_um=UM, azimuth_deg=azimuth_deg)
    nodes = pupil_nodes(lens, source, COUNTS, clip=True)
    assert nodes.share == pytest.approx(4 * 2.5 * 1.2 / (pi * STOP**2), rel=1e-7)


@pytest.mark.parametrize("azimuth_deg", [0.0, 120.0])
def test_a_decentred_hole_takes_its_own_area(azimuth_deg):
    lens = lens_with(Surface(semi_diameter=20.0, inner_radius=1.5, rim=Rim((1.2, -1.9))))
    source = Source(field_slope=0.02, wavelength_um=UM, azimuth_deg=azimuth_deg)
    assert pupil_nodes(lens, source, COUNTS, clip=True).share == pytest.approx(1 - (1.5 / STOP) ** 2, rel=1e-7)


def test_rays_are_stopped_where_the_rim_is_not():
    """Ray by ray: those of a source in any azimuth that land outside the rim, and no others."""
    decentre, sides, turn, azimuth = (1.0, 2.0), (3.0, 2.0), 30.0, 50.0
    lens = lens_with(Surface(rim=Rim(decentre, sides, turn)))
    xi, eta = np.random.default_rng(5).uniform(-0.7, 0.7, (2, 400))
    source = Source(field_slope=0.05, wavelength_um=UM, azimuth_deg=azimuth)
    rays = pencil(lens, source, xi, eta, clip=True)
    x, y = STOP * xi, STOP * eta + AWAY * 0.05  # in the source's axes
    c, s = cos(radians(azimuth)), sin(radians(azimuth))
    across, up = c * x + s * y, c * y - s * x  # in those of the lens: the chief ray runs towards azimuth
    a, b = across - decentre[0], up - decentre[1]
    c, s = cos(radians(turn)), sin(radians(turn))
    open_ = (np.abs(c * a + s * b) < sides[0]) & (np.abs(c * b - s * a) < sides[1])
    assert (rays.passed == open_).all() and 0 < open_.sum() < 400
    assert set(rays.status[~open_]) == {Status.CLIPPED, Status.CLIPPED_BESIDE} and set(rays.failed_surface[~open_]) == {
        2
    }
    assert pencil(lens, source, xi, eta).passed.all(), "nothing is clipped unless asked for"


@pytest.mark.parametrize("method", ["huygens", "traced"])
def test_a_rectangular_rim_paints_the_pattern_of_a_rectangle(method):
    sides = 1.6, 0.8
    lens = lens_with(Surface(rim=Rim(half_widths=sides)), 2.0)
    psf = render(lens, Source(wavelength_um=UM), method, 48, 3.0, PsfOptions(clip=True))
    place = (np.arange(48) - 24) * psf.pixel_um
    by_hand = np.outer(*(np.sinc(2 * side / FOCAL * place / UM) ** 2 for side in sides[::-1]))
    by_hand *= psf.values.sum() / by_hand.sum()
    left = np.square(psf.values - by_hand).sum() / np.square(by_hand - by_hand.mean()).sum()
    assert left < 1e-6


def test_files_keep_rims():
    round_ = Surface(semi_diameter=7.0, inner_radius=1.0, rim=Rim((1.5, -2.0)))
    square = Surface(rim=Rim((0.0, np.float64(1.0)), (np.float64(4.0), 3.0)))  # numpy's own repr is no number
    for surface in (round_, square, replace(square, rim=replace(square.rim, turn_deg=20.0))):
        lens = lens_with(surface)
        assert parse_toml(lens_to_toml(lens), "lens.toml").surfaces == lens.surfaces
    for surface in (round_, square):
        read = import_text(LensText("a.zmx", "utf-8", lens_to_zmx(lens_with(surface))), GlassSources()).lens.surfaces[1]
        assert (read.rim, read.inner_radius) == (surface.rim, surface.inner_radius)
    with pytest.raises(LensFileError, match="rectangular rim that is turned"):
        lens_to_zmx(lens_with(Surface(rim=Rim(half_widths=(4.0, 3.0), turn_deg=10.0))))


def test_code_v_states_rims_in_single_commands():
    shaped = "S 50 4 1.5:60\nCIR 6\nADX 1\nADY -2\nS -50 90\nREX 4\nREY 3\nARO 15\n"
    text = f"RDM\nSO 0 1e20\nS 0 20\nSTO\n{shaped}SI 0 0\nEPD 8\n"
    _, second, third = import_text(LensText("a.seq", "utf-8", text), GlassSources()).lens.surfaces
    assert second.rim == Rim((1.0, -2.0)) and second.semi_diameter == 6.0
    assert third.rim == Rim((0.0, 0.0), (4.0, 3.0), 15.0)


def test_a_lens_with_such_a_rim_is_not_symmetric_and_stands_turned_for_a_turned_source():
    lens = lens_with(Surface(semi_diameter=7.0, rim=Rim((2.0, 0.0))))
    assert lens.misaligned
    turned = seen_from(lens, 90.0).surfaces[1].rim
    assert turned.decentre == pytest.approx((0.0, 2.0), abs=1e-15)


def test_rims_that_leave_nothing_open_are_an_error_only_where_they_clip():
    lens = lens_with(Surface(rim=Rim((0.0, 30.0), (3.0, 3.0))))
    assert pupil_nodes(lens, Source(wavelength_um=UM), COUNTS).share == pytest.approx(1.0)
    with pytest.raises(GeometryError, match="the rims clip every ray"):
        pupil_nodes(lens, Source(wavelength_um=UM), COUNTS, clip=True)
    with pytest.raises(GeometryError, match="surface 2: its rim has the centre"):
        lens_with(Surface(rim=Rim((0.0, 0.0), (3.0, -3.0))))


def test_a_mask_and_a_decentred_hole_shade_together():
    lens = lens_with(Surface(semi_diameter=20.0, inner_radius=1.0, rim=Rim((3.0, 0.0))))
    masked = replace(lens, mask=PupilMask(obscuration=0.3))
    share = pupil_nodes(masked, Source(wavelength_um=UM), COUNTS, clip=True).share
    assert share == pytest.approx(1 - 0.3**2 - (1.0 / STOP) ** 2, rel=1e-7)
