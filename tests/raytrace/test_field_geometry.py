"""Where the sensor is, where a field's exit pupil is, and the cone of its light: the same however a lens is written."""

from dataclasses import replace
from math import atan, degrees, inf

import numpy as np
import pytest
from scipy.special import j1

import p2sf
from p2sf.errors import GeometryError
from p2sf.figures.perfect import airy_radius_um
from p2sf.glass.media import ConstantIndex
from p2sf.lens.anamorphic import Toroid
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.misalignment import displaced, folding, straighten
from p2sf.lens.placement import Placement
from p2sf.paraxial.pupils import find_stop
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.raytrace.field_geometry import cone, exit_pupil
from p2sf.raytrace.pencil import exit_radius, pencil

UM = 0.55


def along(mm):
    return (Placement(decentre_z=mm),)


def spherical_mirror(in_thickness=-800.0, before_sensor=0.0):
    """Return a mirror of radius −1600 mm that is its own stop, and its sensor 800 mm in front."""
    behind = along(-800.0 - in_thickness - before_sensor)
    mirror = Surface(-1600.0, in_thickness, "mirror", after=behind)
    stop = Aperture("stop_semi_diameter", 150.0)
    return Lens((mirror,), stop, 1, sensor_before=along(before_sensor), wavelengths_nm=(1e3 * UM,))


WRITTEN = {
    "thickness": spherical_mirror(),
    "half in a break": spherical_mirror(-400.0),
    "all in a break": spherical_mirror(0.0),
    "before the sensor": spherical_mirror(0.0, -800.0),
    "both": spherical_mirror(-300.0, -400.0),
}


def mirror_rms(field_deg, radius=-1600.0, sensor=-800.0, rim=150.0):
    """Return the RMS of the path on the sphere about the chief ray's point through the vertex, waves, without tilt.

    Rays of its own: plane wave, reflection at the sphere, straight to that sphere.
    """
    (r, w), turn = np.polynomial.legendre.leggauss(24), 2 * np.pi * np.arange(64) / 64
    rho = np.sqrt((r + 1) / 2)
    x, y = (np.append(0.0, rim * np.outer(rho, part(turn))) for part in (np.sin, np.cos))
    z = (x * x + y * y) / (radius * (1 + np.sqrt(1 - (x * x + y * y) / radius**2)))
    points = np.stack([x, y, z])
    k = np.array([0.0, np.sin(np.deg2rad(field_deg)), np.cos(np.deg2rad(field_deg))])[:, None]
    normal = np.array([[0.0], [0.0], [radius]]) - points
    normal /= np.linalg.norm(normal, axis=0)
    out = k - 2 * (k * normal).sum(0) * normal
    centre = (out * (sensor / out[2]))[:, :1]  # of the chief ray, from the vertex
    far = points - centre
    b, square = (far * out).sum(0), (far * far).sum(0)
    path = (k * points).sum(0) - b - np.sqrt(b * b - square + (centre * centre).sum())
    waves = (path[1:] - path[0]) * 1e3 / UM
    weight = np.repeat(w / 2 / 64, 64)
    terms = np.stack([np.ones_like(waves), x[1:], y[1:]]) * np.sqrt(weight)
    fit = np.linalg.lstsq(terms.T, waves * np.sqrt(weight), rcond=None)[0]
    rest = waves * np.sqrt(weight) - fit @ terms
    return float(np.sqrt((rest * rest).sum()))


@pytest.mark.parametrize("lens", WRITTEN.values(), ids=WRITTEN)
@pytest.mark.parametrize("field_deg", [0.0, 1.0])
def test_the_reference_sphere_is_where_the_sensor_is(lens, field_deg):
    # 64 × 24 nodes integrate a wavefront of this degree exactly; 1e-9 is rounding of paths of 1 m in waves.
    found = zernike_fit(lens, p2sf.Source(field_deg=field_deg, wavelength_um=UM))
    assert found.rms == pytest.approx(mirror_rms(field_deg), rel=1e-8)


@pytest.mark.parametrize("lens", WRITTEN.values(), ids=WRITTEN)
def test_what_breaks_shift_along_the_axis_is_thickness(lens):
    assert not lens.misaligned
    assert lens.sensor_mm == pytest.approx(-800.0, rel=1e-15)
    source = p2sf.Source(wavelength_um=UM)
    plain = float(p2sf.Camera(WRITTEN["thickness"]).at(source).coefficients().w40)
    assert float(p2sf.Camera(lens).at(source).coefficients().w40) == pytest.approx(plain, rel=1e-14)
    assert straighten(lens).surfaces[0].thickness == pytest.approx(-800.0, rel=1e-15)


def test_an_element_moved_along_the_axis_is_two_changed_spaces():
    lens = p2sf.load_lens("cooke_triplet")
    moved = displaced(lens, 3, 4, Placement(decentre_z=0.25))
    spaces = [s.thickness + {2: 0.25, 4: -0.25}.get(k, 0.0) for k, s in enumerate(lens.surfaces, 1)]
    plain = replace(lens, surfaces=tuple(replace(s, thickness=t) for s, t in zip(lens.surfaces, spaces, strict=True)))
    source = p2sf.Source(field_deg=14)
    found, due = (p2sf.Camera(one).at(source).coefficients() for one in (moved, plain))
    for name in ("w40", "w31", "w22", "w20", "w11", "wd"):
        assert getattr(found, name) == pytest.approx(float(getattr(due, name)), rel=1e-12)
    assert zernike_fit(moved, source).rms == pytest.approx(zernike_fit(plain, source).rms, rel=1e-9)


def paraboloid(across_mm, focal=100.0, rim=10.0):
    """Return a beam of radius 10 mm that meets a paraboloid this far from its axis, folded into its focus."""
    turn = degrees(2 * atan(across_mm / (2 * focal)))
    before, after = Placement(decentre_y=-across_mm), Placement(decentre_z=-focal, tilt_x_deg=-turn)
    mirror = Surface(-2 * focal, 0.0, "mirror", conic=-1.0, before=(before,), after=(after,))
    stop = Aperture("stop_semi_diameter", rim)
    return Lens((Surface(inf, 120.0), mirror), stop, 1, wavelengths_nm=(600.0,))


@pytest.mark.parametrize(("across_mm", "airy_um"), [(20.0, 3.70), (60.0, 3.99), (120.3, 4.98)])
def test_the_cone_of_an_off_axis_paraboloid_is_about_its_real_chief_ray(across_mm, airy_um):
    # A point (0, h) of the paraboloid y²= 4f(f − z) is f + h²/4f from the focus, and beams stay round in it.
    lens, source = paraboloid(across_mm), p2sf.Source(wavelength_um=0.6)
    found, due = cone(lens, source), 10.0 / (100.0 + across_mm**2 / 400.0)
    # Differences over 1e-3 of the radius leave its square, times the aperture's.
    assert [found.na_x, found.na_y, found.na] == pytest.approx([due] * 3, rel=1e-7)
    assert float(airy_radius_um(0.6, found.na)) == pytest.approx(airy_um, abs=5e-3)


@pytest.mark.parametrize("across_mm", [20.0, 60.0, 120.3])
def test_the_window_of_an_off_axis_paraboloid_in_focus_is_its_airy_pattern(across_mm):
    lens, source = paraboloid(across_mm), p2sf.Source(wavelength_um=0.6)
    psf = p2sf.render(lens, source, integrated=False)
    assert psf.strehl == pytest.approx(1.0, abs=1e-4)
    airy = float(airy_radius_um(0.6, 10.0 / (100.0 + across_mm**2 / 400.0)))
    assert psf.pixel_um * 64 / 2 == pytest.approx(5 * airy, rel=1e-3)  # five Airy radii and no blur
    x, y = np.meshgrid(psf.x_um, psf.y_um)
    v = 3.8317059702075125 * np.hypot(x, y) / airy
    pattern = np.where(v > 0, 2 * j1(v) / np.where(v > 0, v, 1), 1.0) ** 2
    pattern /= pattern.sum()
    # A collimated beam fills the paraboloid's cone evenly up to NA²: 1 − R² of the Airy pattern is below that squared.
    missed = ((psf.values - pattern) ** 2).sum() / ((pattern - pattern.mean()) ** 2).sum()
    assert missed < 1e-3


def folded(lens, at_mm, tilt_deg=40.0):
    """Return the lens with a plane mirror so far behind its last surface that turns the axis."""
    *front, last = lens.surfaces
    rest = at_mm - last.thickness
    mirror = Surface(inf, rest, "mirror", **folding(Placement(tilt_x_deg=tilt_deg)))
    return replace(lens, surfaces=(*front, replace(last, thickness=at_mm), mirror))


@pytest.mark.parametrize("field_deg", [(0.0, 0.0), (0.0, 14.0), (9.0, -6.0)])
def test_a_fold_changes_neither_wavefront_nor_cone(field_deg):
    lens, source = p2sf.load_lens("cooke_triplet"), p2sf.Source(field_deg=field_deg, wavelength_um=UM)
    bent = folded(lens, 20.0)
    one, other = (zernike_fit(each, source).rms for each in (lens, bent))
    assert other == pytest.approx(one, rel=1e-7)  # the pupil's place is good to 1e-6, and counts to second order
    radii = [float(np.ravel(exit_radius(each, source, pencil(each, source, [0.0], [0.0])))[0]) for each in (lens, bent)]
    assert radii[1] == pytest.approx(-radii[0], rel=1e-6)
    if field_deg == (0.0, 0.0):
        assert cone(bent, source).na == pytest.approx(cone(lens, source).na, rel=1e-6)


def test_the_cone_is_that_of_the_stop_that_is_given():
    lens, source = p2sf.load_lens("cooke_triplet"), p2sf.Source(wavelength_um=UM)
    stop = find_stop(lens)
    half = replace(stop, semi_diameter=stop.semi_diameter / 2)
    moved = displaced(lens, 1, 2, Placement(decentre_y=1e-9))
    for each in (lens, moved):
        assert cone(each, source, half).na == pytest.approx(cone(each, source).na / 2, rel=1e-3)


@pytest.mark.parametrize("turn_deg", [0.0, 30.0])
def test_a_beam_that_is_parallel_in_one_direction_has_no_cone(turn_deg):
    """Behind a cylinder: whatever rounding leaves of the narrow side, it makes no window of metres."""
    front, rear = (Toroid(radius_y=radius, turn_deg=turn_deg) for radius in (50.0, -70.0))
    surfaces = Surface(inf, 3.0, ConstantIndex(1.5), shape=front), Surface(inf, 90.0, shape=rear)
    lens = Lens(surfaces, Aperture("stop_semi_diameter", 4.0), 1)
    found = cone(lens, p2sf.Source(field_deg=3.0, wavelength_um=UM))
    assert found.na == 0 and max(found.na_x, found.na_y) > 0.01


@pytest.mark.parametrize("angles", [(45.0, 45.0), (60.0, 60.0)])
def test_surfaces_at_right_angles_to_the_light_or_beyond_have_no_axis_that_it_takes(angles):
    first, *rest = p2sf.load_lens("singlet_f6").surfaces
    turned = replace(first, before=tuple(Placement(tilt_x_deg=angle) for angle in angles))
    lens = replace(p2sf.load_lens("singlet_f6"), surfaces=(turned, *rest))
    with np.errstate(all="raise"), pytest.raises(GeometryError, match="tilted"):
        exit_pupil(lens, p2sf.Source(wavelength_um=UM))
