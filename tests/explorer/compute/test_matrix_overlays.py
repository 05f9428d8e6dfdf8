"""Curves over fields, colours and sensor positions against single pictures, plain formulas and the library."""

from dataclasses import replace

import numpy as np
import pytest

import p2sf
from p2sf.conventions import degrees_from_slope, slope_from_degrees
from p2sf.figures.perfect import circle_contrast
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.lens.transmission import Transmission
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.paraxial.pupils import pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.matrix.overlays import PLAIN, CurveOverlay, answer, overlay, overlay_request
from p2sf_explorer.compute.setup import default_state, load, paraxial_setup
from p2sf_explorer.state.state import change, new_state

TRIPLET = change(default_state("cooke_triplet"), f_number=8.0)
NM = 550.0


def worked(state, **entries) -> CurveOverlay:
    request = overlay_request(live(change(state, **entries), "preview"))
    told = []
    found = answer(request, lambda: False, lambda share, so_far: told.append(share))
    assert told == sorted(told) and told[-1] == 1.0
    return found


def lines(found: CurveOverlay) -> dict[str, np.ndarray]:
    return {str(line.name): line.values for line in found.lines}


def own(angle, nm=NM, frequency_per_mm=None, spectrum=None, **camera):
    point = p2sf.Camera("cooke_triplet", f_number=8.0, **camera).at(p2sf.Source(field_deg=angle, wavelength_nm=nm))
    return point.mtf(frequency_per_mm, spectrum=spectrum)


def test_each_field_has_the_contrast_of_the_library():
    found = worked(TRIPLET, curves_of="fields", curves_count=3)
    assert [str(name) for name in found.names] == ["0°", "14°", "20°"]
    for angle in (0, 14, 20):
        alone = own(angle, frequency_per_mm=found.x)
        assert lines(found)[f"{angle}° tangential"] == pytest.approx(alone.tangential, abs=1e-9)
        assert lines(found)[f"{angle}° sagittal"] == pytest.approx(alone.sagittal, abs=1e-9)


def test_on_the_axis_tangential_and_sagittal_are_one():
    found = lines(worked(TRIPLET, curves_of="fields"))
    assert found["0° tangential"] == pytest.approx(found["0° sagittal"], abs=4.5e-4)  # 2π√2 of the residual


def test_a_perfect_pupil_has_the_contrast_of_a_circle_everywhere():
    """2(arccos s − s√(1 − s²))/π, s over the cut-off 2NA/λ (Goodman 2005, eq. 6-30)."""
    state = new_state(method="seidel", free_pupil=True)
    found = worked(state, curves_of="fields")
    na = float(paraxial_setup(change(state, field_deg=0.0)).coefficients.na)
    s = np.minimum(found.x / (2 * na / (state.optics.wavelength_nm * 1e-6)), 1.0)
    perfect = 2 / np.pi * (np.arccos(s) - s * np.sqrt(1 - s * s))
    assert np.all(circle_contrast(s) == pytest.approx(perfect, abs=1e-12))
    for values in lines(found).values():
        assert values == pytest.approx(perfect, abs=1e-4)


def test_the_spectrum_is_that_of_the_library_and_lies_within_its_lines():
    """The spectrum's curve against the library's own way to it, with lines, whose weights are ȳ alone."""
    state = change(TRIPLET, spectrum="lines:486.13,587.56,656.27", field_deg=14.0, curves_of="colours")
    found = worked(state)
    alone = own(14.0, frequency_per_mm=found.x, spectrum="lines:486.13,587.56,656.27")
    assert lines(found)["spectrum tangential"] == pytest.approx(alone.tangential, abs=1e-9)
    assert [line.hue for line in found.lines][-2:] == [PLAIN, PLAIN]
    single = own(14.0, 587.56, frequency_per_mm=found.x)
    assert lines(found)["587.6 nm sagittal"] == pytest.approx(single.sagittal, abs=1e-9)


def test_one_line_alone_is_its_own_spectrum():
    state = change(TRIPLET, spectrum="lines:550", matrix_wavelengths_nm=(NM, 600.0), curves_of="colours")
    found = lines(worked(state))
    assert found["spectrum tangential"] == pytest.approx(found["550.0 nm tangential"], abs=1e-12)


def test_over_the_field_each_place_is_the_contrast_of_that_field():
    found = worked(TRIPLET, curves_of="field", curves_frequencies_per_mm=(15.0, 60.0))
    assert found.x[0] == 0.0 and found.x[-1] == pytest.approx(20.0)
    for k in (0, 3, len(found.x) - 1):
        alone = own(float(found.x[k]), frequency_per_mm=np.array([15.0, 60.0]))
        assert lines(found)["15/mm tangential"][k] == pytest.approx(alone.tangential[0], abs=1e-9)
        assert lines(found)["60/mm sagittal"][k] == pytest.approx(alone.sagittal[1], abs=1e-9)


def test_through_focus_each_place_is_the_contrast_there_and_does_not_follow_the_sensor():
    state = change(TRIPLET, curves_of="focus", field_deg=14.0, curves_frequencies_per_mm=(30.0,))
    found = worked(state)
    for k in (0, 6, len(found.x) - 1):
        alone = own(14.0, frequency_per_mm=np.array([30.0]), sensor_shift_um=float(found.x[k]))
        assert lines(found)["30/mm tangential"][k] == pytest.approx(alone.tangential[0], abs=1e-9)
    here, there = (overlay_request(live(change(state, sensor_shift_um=s), "preview")) for s in (0.0, 25.0))
    assert here == there


def test_a_pure_defocus_is_even_about_its_focus():
    """Contrast through focus of a lens of little aberration has its maximum at the paraxial image."""
    state = change(default_state("achromat_f6"), f_number=20.0, field_deg=0.0, curves_of="focus")
    found = worked(state, curves_frequencies_per_mm=(20.0,))
    c = paraxial_setup(state).own
    step = found.x[1] - found.x[0]
    focus = -2 * float(c.image_index) * float(c.wavelength_um) * float(c.wd + c.w40) / float(c.na) ** 2
    best = found.x[np.argmax(lines(found)["20/mm tangential"])]
    assert abs(best - focus) <= step


@pytest.mark.parametrize("depth_mm", [np.inf, 600.0])
def test_lateral_colour_is_that_of_one_object_point(depth_mm):
    """One point of the object, whatever the colour: its height is −slope·(distance to that colour's entrance pupil)."""
    state = change(TRIPLET, depth_mm=depth_mm, focus_mm=depth_mm, curves_of="lateral")
    found = overlay(live(state)).found
    setup, blue = paraxial_setup(state), 480.0
    angle = found.x[-1]

    def landed(nm, slope):
        return 1000 * float(pencil(setup.lens, Source(depth_mm, slope, nm / 1000), [0.0], [0.0]).chief_y[0])

    slope = float(slope_from_degrees(angle))
    gaps = [
        float(p2sf.paraxial.pupils.pupils(setup.lens, nm / 1000, setup.stop).entrance_from_first) for nm in (NM, blue)
    ]
    other = slope if np.isinf(depth_mm) else slope * (depth_mm + gaps[0]) / (depth_mm + gaps[1])
    assert lines(found)["480.0 nm"][-1] == pytest.approx(landed(blue, other) - landed(NM, slope), abs=1e-6)
    assert np.all(lines(found)["550.0 nm"] == 0) and lines(found)["480.0 nm"][0] == pytest.approx(0.0, abs=1e-9)


def test_distortion_is_of_the_third_order_near_the_axis():
    """Distortion of W11 grows with the square of the field; what exact rays add to it, with the fourth power."""
    state = change(TRIPLET, focus_mm=np.inf, curves_of="distortion")  # W11 is of the Gaussian image plane
    found = overlay(live(state)).found
    exact, third = lines(found)["550.0 nm"], lines(found)["550.0 nm third order"]
    slopes = np.tan(np.deg2rad(found.x))
    assert third[1:] / slopes[1:] ** 2 == pytest.approx(third[-1] / slopes[-1] ** 2, rel=1e-9)
    higher = np.interp(np.tan(np.deg2rad([2.0, 4.0])), slopes, exact - third)
    assert higher[1] / higher[0] == pytest.approx(16, rel=0.05)  # the sixth power is some per cent at 4°
    setup = paraxial_setup(state)
    c = coefficients(setup.lens, np.inf, slopes[-1], NM / 1000, setup.stop)
    share = float(c.w11 * c.wavelength_um / c.reduced_slope / 1000 / c.image_height)
    assert third[-1] == pytest.approx(100 * share, rel=1e-9)


def test_a_pinhole_darkens_with_the_fourth_power_and_rims_take_more():
    """A lens stopped far down, with little distortion and pupil aberration, keeps near to cos⁴ (Welford 1986, §6.5)."""
    found = worked(change(default_state("double_gauss_28"), f_number=16.0), curves_of="illumination")
    alone, rims = lines(found)["the stop alone"], lines(found)["rims clip"]
    pinhole = 100 * np.cos(np.deg2rad(found.x)) ** 4
    assert lines(found)["cos⁴ of a pinhole"] == pytest.approx(pinhole)
    assert alone[0] == pytest.approx(100) and rims[0] == pytest.approx(100)
    assert alone == pytest.approx(pinhole, abs=5.0)
    assert np.all(rims <= alone + 0.01)


def test_illumination_is_light_through_the_stop_over_the_sensors_area():
    """Two fields by a plain sum: rays through an even grid of the stop, their solid angle, and the image's stretch."""
    state = change(TRIPLET, curves_of="illumination")
    found = worked(state)
    setup = paraxial_setup(state)
    step = 1e-4

    def irradiance(slope):
        rays = pencil(setup.lens, Source(np.inf, slope, NM / 1000), *grid())
        light = float(rays.launch.mean()) * np.cos(np.arctan(slope)) ** 4
        near = (slope - step, slope, slope + step)
        low, middle, high = (chief(setup.lens, s) for s in near)
        radial = (high - low) / (2 * step)
        return light / (radial * (middle / slope))

    slope = float(slope_from_degrees(found.x[4]))
    expected = irradiance(slope) / irradiance(2 * step)
    assert lines(found)["the stop alone"][4] == pytest.approx(100 * expected, rel=2e-3)  # a grid of 60² cells
    assert degrees_from_slope(slope) == pytest.approx(found.x[4])


def chief(lens, slope):
    return float(pencil(lens, Source(np.inf, slope, NM / 1000), [0.0], [0.0]).chief_y[0])


def grid():
    axis = (np.arange(60) + 0.5) / 30 - 1
    xi, eta = np.meshgrid(axis, axis)
    inside = xi**2 + eta**2 <= 1
    return xi[inside], eta[inside]


def test_a_field_that_no_light_reaches_is_a_gap():
    state = change(TRIPLET, curves_fields_deg=(0.0, 70.0), curves_of="fields")
    found = lines(worked(state))
    assert np.isnan(found["70° tangential"]).all() and np.isfinite(found["0° tangential"]).all()


def test_lenses_without_rims_say_so():
    lens = load("achromat_f6")
    found = worked(change(default_state("achromat_f6"), curves_of="illumination"))
    stated = any(np.isfinite(surface.semi_diameter) for surface in lens.surfaces)
    assert np.isfinite(lines(found)["rims clip"]).all() == stated and (found.missing is None) == stated


def coated(vertex: float, per_area: float) -> Lens:
    """Return a triplet whose first surface passes vertex + per_area·h²."""
    lens = p2sf.load_lens("cooke_triplet")
    first = replace(lens.surfaces[0], transmission=Transmission(vertex, per_area))
    return replace(lens, surfaces=(first, *lens.surfaces[1:]))


def test_an_even_coating_passes_the_same_at_every_field_and_colour():
    lens = coated(0.9, 0.0)
    for of in ("transmission", "transmission_of_colours"):
        found = worked(change(default_state("coated", lens_to_toml(lens)), curves_of=of))
        assert found.missing is None
        for values in lines(found).values():
            assert values == pytest.approx(90.0, abs=1e-9)


def test_a_coating_that_fades_outwards_is_the_mean_over_the_beam():
    """On the axis t₀ + t₂·⟨h²⟩, and ⟨h²⟩ = h_rim²/2 of an evenly filled circle, to the curvature of the surface."""
    lens = coated(0.9, -1e-3)
    found = worked(change(default_state("coated", lens_to_toml(lens)), curves_of="transmission"))
    rim = float(pupils(lens, 0.55).entrance_diameter) / 2
    for values in lines(found).values():
        assert values[0] == pytest.approx(100 * (0.9 - 1e-3 * rim**2 / 2), abs=0.05)
        assert values[-1] < values[0]  # a beam off the axis meets the surface farther out


def test_a_lens_that_takes_no_light_says_so():
    found = worked(TRIPLET, curves_of="transmission")
    assert found.missing is not None
    for values in lines(found).values():
        assert values == pytest.approx(100.0, abs=1e-12)
