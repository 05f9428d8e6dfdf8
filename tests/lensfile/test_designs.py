"""The lenses that were designed for this program, and Hubble: each shows what its line in the list promises."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.lens.lens import Lens, with_sensor
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import cardinal_points, image_distance, magnification
from p2sf.paraxial.positions import lens_at
from p2sf.paraxial.pupils import f_number, numerical_aperture, pupils
from p2sf.raytrace.trace import trace

D, F, C = 0.5875618, 0.4861327, 0.6562725


def focal_length(lens: Lens, wavelength_um: float = D) -> float:
    return float(cardinal_points(lens, wavelength_um).effective_focal_length)


def axial_wave(lens: Lens, wavelength_um: float, inner: float = 0.0) -> np.ndarray:
    """Return W in waves at radii evenly spread over the area of the annulus, of rays parallel to the axis.

    W follows from where rays meet the sensor, dW = y dM with the direction cosine M, without any optical path.
    """
    radius = float(pupils(lens, wavelength_um).entrance_diameter) / 2
    y = radius * np.sqrt(np.linspace(inner**2, 1.0, 2001))
    zero = np.zeros_like(y)
    rays = trace(lens, np.stack([zero, y, zero], -1), np.array([0.0, 0.0, 1.0]), wavelength_um)
    lands, cosine = rays.points[-1][:, 1], rays.cosines[:, 1]
    return np.append(0.0, np.cumsum((lands[1:] + lands[:-1]) / 2 * np.diff(cosine))) * 1000 / wavelength_um


def rms_spot_um(lens: Lens, slope: float, wavelength_um: float, depth_mm: float = inf) -> float:
    """Return the RMS distance of rays over the paraxial entrance pupil from their centroid, µm."""
    entrance = pupils(lens, wavelength_um)
    z, radius = float(entrance.entrance_from_first), float(entrance.entrance_diameter) / 2
    rho, turn = np.meshgrid(np.sqrt((np.arange(8) + 0.5) / 8), np.arange(16) * np.pi / 8)
    through = np.stack([rho * np.sin(turn), rho * np.cos(turn), 0 * rho], -1).reshape(-1, 3) * radius + [0.0, 0.0, z]
    along = np.array([0.0, slope, 1.0]) if depth_mm == inf else through - [0.0, -slope * (depth_mm + z), -depth_mm]
    lands = trace(lens, through, along, wavelength_um).points[-1][:, :2]
    return 1000 * float(np.sqrt(((lands - lands.mean(0)) ** 2).sum(-1).mean()))


def test_the_cassegrain_has_no_spherical_aberration():
    """Two conics that share a focus, to the digits of its file: 1e-6 mm in radius and spacing."""
    lens = find_lens("cassegrain_f10")
    assert focal_length(lens) == pytest.approx(2000, rel=1e-8) and float(f_number(lens, D)) == pytest.approx(10)
    primary, secondary = lens.surfaces
    assert primary.conic == -1 and secondary.conic == pytest.approx(-((13 / 7) ** 2), abs=1e-8)  # m = 10/3
    assert np.ptp(axial_wave(lens, D)) < 1e-4
    assert rms_spot_um(lens, np.tan(np.deg2rad(0.2)), D) > 5  # coma is left


def test_hubble_is_the_telescope_of_the_failure_report():
    """f/24 with 57.6 m; 2.2 µm too low at the edge, which is 0.41 waves RMS at 632.8 nm over the annulus."""
    lens = find_lens("hubble")
    assert focal_length(lens) == pytest.approx(57_600, rel=1e-5) and float(f_number(lens, D)) == pytest.approx(
        24, rel=1e-4
    )
    assert 1200**4 * (1.0139 - 1.0022985) / (8 * 11_040**3) == pytest.approx(2.2e-3, abs=5e-5)  # mm, of r⁴/8R³·ΔK
    wave = axial_wave(lens, 0.6328, 0.33)
    assert wave.std() == pytest.approx(0.412, abs=0.002)
    # W040 over an annulus with its best defocus: (1 − ε²)²/(6√5) of twice the mirror's error (Mahajan 1981); light
    # meets the rim at 6°, and the design's own conic leaves 0.01 waves.
    error = 2 * 1200**4 * (1.0139 - 1.0022985) / (8 * 11_040**3) * 1000 / 0.6328
    assert wave.std() == pytest.approx(error * (1 - 0.33**2) ** 2 / (6 * np.sqrt(5)), rel=0.03)
    for shift in (-1.0, 1.0):  # mm: the sensor is where the variance is least
        assert axial_wave(with_sensor(lens, lens.sensor_mm + shift), 0.6328, 0.33).std() > wave.std()


def test_hubble_with_the_conic_of_its_design_is_sharp():
    lens = find_lens("hubble")
    right = replace(lens, surfaces=(replace(lens.surfaces[0], conic=-1.0022985), lens.surfaces[1]))
    right = with_sensor(right, float(image_distance(right, inf, 0.6328)))
    assert axial_wave(right, 0.6328, 0.33).std() < 0.02


def test_the_maksutov_has_spheres_only_and_is_diffraction_limited():
    lens = find_lens("maksutov")
    assert not any(s.conic or s.aspheric for s in lens.surfaces)
    assert focal_length(lens) == pytest.approx(2250, rel=1e-4) and float(f_number(lens, D)) == pytest.approx(
        15, rel=1e-4
    )
    for wavelength in (F, D, C):
        assert axial_wave(lens, wavelength, 0.36).std() < 1 / 40


def test_the_schmidt_mirror_has_its_centre_in_the_plate():
    """Without the plate's figure the axis is far worse; at the edge of five degrees rays stay within some microns."""
    lens = find_lens("schmidt_camera")
    plate, figure, mirror = lens.surfaces[:3]
    assert plate.thickness + figure.thickness == pytest.approx(-mirror.radius)
    flat = replace(lens, surfaces=(plate, replace(figure, aspheric=(), radius=inf), *lens.surfaces[2:]))
    assert rms_spot_um(flat, 0.0, 0.546074) > 20 * rms_spot_um(lens, 0.0, 0.546074)
    for angle in lens.fields_deg:
        assert rms_spot_um(lens, np.tan(np.deg2rad(angle)), 0.546074) < 4


def test_the_microscope_objective_magnifies_ten_times_and_is_diffraction_limited():
    lens = find_lens("microscope_10x")
    assert 200 / focal_length(lens) == pytest.approx(10, rel=1e-3)
    assert float(numerical_aperture(lens, inf, D)) == pytest.approx(0.25, rel=1e-3)
    for angle in lens.fields_deg:  # within the Airy radius 0.61 λ/NA
        assert rms_spot_um(lens, np.tan(np.deg2rad(angle)), D) < 0.61 * D / 0.25


def test_the_phone_lens_has_six_aspheres_in_four_millimetres_and_a_half():
    lens = find_lens("phone_f28")
    assert sum(any(s.aspheric) for s in lens.surfaces) == 6
    assert sum(s.thickness for s in lens.surfaces) < 4.4
    assert focal_length(lens) == pytest.approx(3.6, rel=1e-3) and float(f_number(lens, D)) == pytest.approx(2.8)
    for angle in (0, 10, 20, 30):
        assert rms_spot_um(lens, np.tan(np.deg2rad(angle)), D) < 2.5


def test_the_hybrid_achromat_brings_blue_and_red_together():
    lens = find_lens("diffractive_singlet")
    glass = replace(lens, surfaces=(lens.surfaces[0], replace(lens.surfaces[1], diffraction=None)))
    blue, red = (float(image_distance(lens, inf, w)) for w in (F, C))
    assert abs(blue - red) < 1e-3 < 0.5 < focal_length(glass, C) - focal_length(glass, F)
    assert focal_length(lens) == pytest.approx(50, rel=1e-4) and float(f_number(lens, D)) == pytest.approx(5, rel=1e-4)


def test_the_relay_is_telecentric_on_both_sides_and_free_of_distortion():
    lens = find_lens("telecentric_relay")
    depth, ends = 90.9, pupils(lens, D)
    assert float(magnification(lens, depth, D)) == pytest.approx(-1, abs=1e-5)
    assert min(abs(float(ends.entrance_from_first)), abs(float(ends.exit_from_last))) > 10_000
    assert float(numerical_aperture(lens, depth, D)) == pytest.approx(0.05, rel=1e-4)
    slope = np.tan(np.deg2rad(max(lens.fields_deg)))
    origin = np.array([[0.0, -slope * (depth + float(ends.entrance_from_first)), -depth]])
    ray = trace(lens, origin, np.array([0.0, slope, 1.0]), D)
    assert abs(np.rad2deg(ray.cosines[0, 1])) < 0.1
    assert -ray.points[-1][0, 1] / origin[0, 1] == pytest.approx(1, abs=3e-5)


@pytest.mark.parametrize("zoom", [20, 22, 24, 26, 31.5, 35, 46, 55, 60])
def test_the_zoom_keeps_its_focus_and_is_sharp_between_the_columns_too(zoom):
    """Within 0.2 % of the focal length that the ring says, and an RMS spot below the Airy radius of f/4.3."""
    lens = lens_at(find_lens("zoom_3x"), zoom=zoom)
    assert focal_length(lens) == pytest.approx(zoom, rel=2e-3)
    for height in (0.0, 4.2, 6.0):  # mm on the sensor
        assert rms_spot_um(lens, height / zoom, D) < 1.22 * D * 4.3 + 0.5
    assert 6.0 / zoom == pytest.approx(np.tan(np.deg2rad(max(lens.fields_deg))), rel=5e-3)


def test_the_zooms_columns_have_their_focal_lengths():
    lens = find_lens("zoom_3x")
    for column in (20.0, 24.0, 28.0, 35.0, 43.0, 50.0, 60.0):
        assert focal_length(lens_at(lens, zoom=column)) == pytest.approx(column, rel=1e-5)
    assert find_lens("zoom_3x").stop_surface == 7


@pytest.mark.parametrize(("place", "depth"), [(0.0, inf), (0.29, 240.0), (0.628, 125.0)])
def test_floating_focus_keeps_the_macro_sharp(place, depth):
    """Extended as a whole to 1:1.6, with the space of infinity, its spots at the edge are larger by half."""
    lens = lens_at(find_lens("macro_floating"), focus_position=place)
    assert abs(float(magnification(lens, depth, D))) == pytest.approx(place, abs=2e-3)
    slopes = [np.tan(np.deg2rad(angle)) for angle in (0.0, 9.0, 14.0)]
    floating = [rms_spot_um(lens, slope, D, depth) for slope in slopes]
    assert max(floating) < 13
    if place != 0.628:
        return
    stiff = lens_at(find_lens("macro_floating"), focus_position=0.0)
    stiff = with_sensor(stiff, float(image_distance(stiff, depth, D)))
    nearby = [with_sensor(stiff, stiff.sensor_mm + shift) for shift in np.linspace(-0.5, 0.5, 41)]
    assert min(rms_spot_um(lens, slopes[-1], D, depth) for lens in nearby) > 1.5 * floating[-1]
