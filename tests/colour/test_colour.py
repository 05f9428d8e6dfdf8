"""Spectra, the eye, and the colour PSF, against published figures and what lenses do to colours."""

import json
from dataclasses import replace

import numpy as np
import pytest

from p2sf.cli import main
from p2sf.colour import colorimetry as colour
from p2sf.colour.spectrum import Spectrum, black_body, daylight, spectrum_of
from p2sf.errors import ExportError, RequestError
from p2sf.figures.colour_psf import faint_rgb, screen_rgb
from p2sf.io.colour_files import write_colour_psf
from p2sf.lens.lens import with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import image_distance
from p2sf.psf import polychromatic
from p2sf.raytrace.field_curves import heights

FIT = 2e-3  # how far the fit of Wyman et al. moves a white's x or y; their paper reports errors of this size
F_UM, D_UM, C_UM = 0.4861327, 0.5875618, 0.6562725


@pytest.mark.parametrize(
    ("word", "xy"),
    [
        ("d65", (0.31272, 0.32903)),  # CIE 15:2004, table T.3
        ("equal", (1 / 3, 1 / 3)),
        ("planck:2855.54", (0.44758, 0.40745)),  # illuminant A, CIE 15:2004, table T.3
        ("planck:6500", (0.3135, 0.3237)),  # Wyszecki and Stiles 1982, table 1(3.11)
        ("planck:10000", (0.2807, 0.2884)),
    ],
)
def test_the_colour_of_known_lights(word, xy):
    assert colour.chromaticity(colour.tristimulus(spectrum_of(word))) == pytest.approx(xy, abs=FIT)


def test_d65_is_the_white_of_the_screen():
    assert colour.linear_rgb(colour.tristimulus(Spectrum("d65"))) == pytest.approx((1, 1, 1), abs=0.01)


def test_the_observer_peaks_where_the_eye_does():
    wave = np.arange(0.38, 0.78, 0.001)
    assert wave[colour.matching(wave)[:, 1].argmax()] == pytest.approx(0.555, abs=0.004)
    assert colour.matching(0.555)[1] == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("kelvin", [3000.0, 5772.0, 9000.0])
def test_wiens_law(kelvin):
    wave = np.linspace(0.2, 2.0, 18001)
    assert wave[black_body(wave, kelvin).argmax()] * kelvin == pytest.approx(2897.77, rel=2e-4)  # the grid's step


def test_a_cold_body_and_a_hot_one_do_not_overflow():
    assert np.isfinite(black_body(np.array([0.38, 0.78]), 300.0)).all()
    assert black_body(0.4, 1e6) == pytest.approx((0.56 / 0.4) ** 4, rel=0.02)  # Rayleigh and Jeans: λ⁻⁴


def test_daylight_is_the_table_and_nothing_beyond_it():
    assert daylight(np.array([0.56, 0.44, 0.379, 0.781])) == pytest.approx((1, 1.04865, 0, 0))


@pytest.mark.parametrize("word", ["d65", "planck:2856"])
def test_the_whole_colour_does_not_depend_on_the_number_of_wavelengths(word):
    wholes = [colour.bands(spectrum_of(word), count)[1].sum(0) for count in (1, 7, 40)]
    assert wholes[1:] == [pytest.approx(wholes[0], rel=1e-12)] * 2


def test_colours_a_screen_has_not_are_paled_and_keep_their_luminance():
    rgb = colour.linear_rgb(colour.matching(0.589))
    assert rgb.min() < 0
    shown = colour.displayable(rgb)
    assert shown.min() == pytest.approx(0, abs=1e-12)
    assert shown @ colour.LUMINANCE == pytest.approx(rgb @ colour.LUMINANCE)
    assert shown.argmax() == 0 and shown[1] > shown[2], "sodium light is orange"


@pytest.mark.parametrize(
    "word", ["d66", "planck", "planck:10", "planck:5600,3000", "lines", "lines:5", "equal:3", "lines:a"]
)
def test_a_spectrum_that_cannot_be_is_a_sentence(word):
    with pytest.raises(RequestError, match=r"planck:5600|lines:486"):
        spectrum_of(word)


def test_light_beyond_what_the_eye_sees_has_no_colour():
    with pytest.raises(RequestError, match="lines:1500"):
        colour.bands(spectrum_of("lines:1500"), 3, (1.4, 1.6))


def test_a_colour_psf_of_no_wavelengths_or_ending_is_refused(tmp_path):
    lens, source, white, window = find_lens("tessar"), Source(np.inf, 0.0, 0.55), spectrum_of("d65"), (8, 1.0)
    with pytest.raises(RequestError, match="0 wavelengths for a colour PSF; give a whole number from 1"):
        polychromatic.colour_psf(lens, source, white, window, count=0)
    made = polychromatic.colour_psf(lens, source, white, window, "seidel", 1)
    with pytest.raises(ExportError, match=r'the ending "\.doc" is unknown; choose \.npz'):
        write_colour_psf(made, tmp_path / "a.doc", {})


def test_a_shift_keeps_light_and_sign_and_goes_upwards():
    point = np.zeros((9, 9))
    point[4, 4] = 1
    moved = polychromatic.shifted_up(point, 1.25)
    assert moved[5, 4] == 0.75 and moved[6, 4] == 0.25 and moved.sum() == 1
    assert polychromatic.shifted_up(point, -2.0)[2, 4] == 1
    assert not polychromatic.shifted_up(point, 40.0).any()


def lines(lens, source, *nm, window=(48, 1.0)):
    return polychromatic.colour_psf(lens, source, Spectrum("lines", nm), window, "seidel")


def test_one_line_is_the_plain_psf():
    lens = find_lens("double_gauss_28")
    source = Source(field_slope=0.1)
    plain = polychromatic.by_method("seidel")(lens, source, 48, 1.0)
    found = lines(lens, source, 587.5618)
    assert found.xyz[..., 1] == pytest.approx(plain.energy * plain.values, abs=1e-12)
    assert found.light_in_window == pytest.approx(plain.energy)


@pytest.mark.slow
def test_the_colour_does_not_jump_where_samples_grow_too_far_apart_to_tell_the_light():
    """λ/2NA runs from 1.15 µm for blue to 2.1 µm for red: from pitch to pitch other wavelengths have a known share.

    A step here is 2 %: of a window that catches 2 to 6 % of a smooth blur, the light grows by 4 % of itself.
    """
    source = Source(field_slope=np.tan(np.radians(14.0)), wavelength_um=D_UM)
    pitches = np.geomspace(1.1, 2.3, 38)
    found = [polychromatic.colour_psf(find_lens("double_gauss_28"), source, Spectrum("equal"), (16, p), "seidel", 9)
             for p in pitches]  # fmt: skip
    xy = np.array([colour.chromaticity(one.xyz.sum((0, 1))) for one in found])
    assert np.abs(np.diff(xy, axis=0)).max() < 0.002
    light = [one.xyz[..., 1].sum() for one in found]
    assert np.abs(np.diff(light)).max() < 0.003
    assert [one.light_in_window is None for one in found] == sorted(one.light_in_window is None for one in found)
    assert found[0].light_in_window == pytest.approx(light[0]) and found[-1].light_in_window is None


def test_wide_pixels_hold_the_light_of_the_fine_ones_in_them(capsys):
    """Sixteen pixels, and sixteen times as many over the same width but for a part of one: the blur is 180 µm wide."""
    found = []
    for pixels, pitch in ((16, 2.2), (256, 2.2 / 16)):
        window = f"--pixels {pixels} --pixel-um {pitch}"
        assert (
            main([*f"psf double_gauss_28 --field-deg 14 --spectrum equal --method seidel {window} --json".split()]) == 0
        )
        found.append(json.loads(capsys.readouterr().out)["light_in_window"])
    assert found[0] == pytest.approx(found[1], rel=0.01)


def test_a_simple_lens_focused_for_blue_has_a_blue_core_in_a_red_halo():
    """Longitudinal colour: a positive lens of one glass brings blue to focus first."""
    lens = with_f_number(find_lens("plano_convex"), 20.0)
    blue, red = (float(image_distance(lens, np.inf, wave)) for wave in (F_UM, C_UM))
    lens, blur = with_sensor(lens, blue), 1e3 * (red - blue) / 40  # the red disc's radius, µm
    assert blur > 0
    found = lines(lens, Source(wavelength_um=D_UM), 486.1327, 656.2725, window=(64, 4.0))
    rgb = colour.linear_rgb(found.xyz)
    distance = np.hypot(found.x_um, found.y_um[:, None]) / blur
    far = (distance > 0.4) & (distance < 0.95)
    assert rgb[32, 32, 2] > rgb[32, 32, 0], "the core is blue"
    assert rgb[far][:, 0].sum() > 3 * rgb[far][:, 2].sum(), "the halo is red"


def test_lateral_colour_puts_the_colours_where_their_chief_rays_land():
    lens, source = find_lens("double_gauss_28"), Source(field_slope=0.2, wavelength_um=D_UM)
    lens = with_f_number(lens, 16.0)
    blue, red = (lines(lens, source, nm, window=(96, 0.5)) for nm in (486.1327, 656.2725))
    places = [(f.xyz[..., 1].sum(1) * f.y_um).sum() / f.xyz[..., 1].sum() for f in (blue, red)]
    landed = polychromatic.chief_shifts_um(lens, source, np.array([F_UM, C_UM]))
    own = heights(lens, replace(source, wavelength_um=F_UM), 0.2).real - heights(lens, source, 0.2).real
    assert landed[0] == pytest.approx(1e3 * own, abs=1e-9) and landed[0] - landed[1] > 2
    # Coma moves either centroid alike, to some tenths of a micron between the two colours.
    assert places[0] - places[1] == pytest.approx(landed[0] - landed[1], abs=0.6)


def test_without_a_field_there_is_no_lateral_colour():
    lens = find_lens("double_gauss_28")
    assert not polychromatic.chief_shifts_um(lens, Source(wavelength_um=D_UM), np.array([F_UM, C_UM])).any()


def test_the_command_writes_the_light_and_the_picture(tmp_path, capsys):
    target = tmp_path / "colour.npz"
    command = ["psf", "double_gauss_28", "--method", "seidel", "--pixels", "24", "--spectrum", "lines:486,588,656"]
    assert main([*command, "-o", str(target), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["wavelengths_nm"] == pytest.approx([486, 588, 656])
    with np.load(target) as file:
        assert file["xyz"].shape == (24, 24, 3)
        assert colour.chromaticity(file["xyz"].sum((0, 1))) == pytest.approx(said["chromaticity_xy"])
        assert json.loads(str(file["meta"]))["colour_psf"]["spectrum"] == "lines:486,588,656"
    assert main([*command, "-o", str(tmp_path / "colour.png")]) == 0
    assert (tmp_path / "colour.png").read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("d66",), "choose d65"),
        (("d65", "-o", "a.tiff"), "choose .npz"),
        (("d65", "--sampling", "fft"), "--method"),
        (("d65", "--depth-mm", "29.320641615228546"), "lies at infinity (NA 0)"),
    ],  # the front focal plane of its own colour
)
def test_a_wrong_command_is_a_sentence(words, said, capsys):
    assert main(["psf", "double_gauss_28", "--spectrum", *words]) == 2
    assert said in capsys.readouterr().err


def test_faint_light_is_lifted_and_keeps_its_hue():
    lens = find_lens("double_gauss_28")
    found = lines(lens, replace(Source(), field_slope=0.1), 486.0, 656.0)
    plain, faint = screen_rgb(found), faint_rgb(found)
    assert faint.max() == pytest.approx(1) and (faint >= plain - 1e-12).all()
    some = plain.max(-1) > 1e-3
    ratio = [rgb[some] / rgb[some].max(-1, keepdims=True) for rgb in (plain, faint)]
    assert ratio[0] == pytest.approx(ratio[1])


def test_light_of_a_display_is_that_of_its_standard():
    """IEC 61966-2-1: black, the end of the straight part, 8-bit greys of 1, 5, 21 and 50 % light, and white."""
    values = np.array([0.0, 0.04045, 26 / 255, 63 / 255, 127 / 255, 188 / 255, 1.0])
    light = np.array([0.0, 0.04045 / 12.92, 0.010330, 0.049707, 0.212231, 0.502886, 1.0])
    assert colour.linear_from_srgb(values) == pytest.approx(light, abs=1e-6)
    assert colour.srgb_from_linear(light) == pytest.approx(values, abs=1e-4)
    assert colour.linear_from_srgb(np.array([-0.2])) == pytest.approx([-0.2])
