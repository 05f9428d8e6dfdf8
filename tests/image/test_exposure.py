"""A sensor counts electrons: their mean, variance and limits, raw numbers, mosaics, filters, and files of them."""

import json

import numpy as np
import pytest
import tifffile

import p2sf
from p2sf.cli import main
from p2sf.cli.scenes import Shown, noise_of
from p2sf.colour.spectrum import relative_power, spectrum_of
from p2sf.errors import RequestError
from p2sf.image.exposure import expose, raw_numbers
from p2sf.image.form import Forming, form_image
from p2sf.image.preview import preview_plan
from p2sf.io.dng import RawLevels, write_dng
from p2sf.lensfile.library import find_lens
from p2sf.scene.files import read_scene
from p2sf.scene.filters import filter_channels
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor

SHAPE = 300, 400, 1
COUNT = 300 * 400
SCENE = """
rtol = 0.4
f_number = 8
[sensor]
rows = 20
columns = 30
pixel_um = 60.0
full_well = 20000
read_noise = 4
bits = 12
black_level = 64
mosaic = "grbg"
fill_factor = 0.8
"""
CURVES = "nm,red,green,blue\n400,0,0,0.2\n460,0,0.1,1\n540,0.1,1,0.1\n610,1,0.2,0\n700,0.1,0,0\n"


def pixels(**how) -> Sensor:
    return Sensor(SHAPE[0], SHAPE[1], 4.0, **how)


def flat(value: float) -> np.ndarray:
    return np.full(SHAPE, value, np.float32)


@pytest.mark.parametrize(("light", "read_noise", "fill"), [(0.0, 5.0, 1.0), (0.02, 3.0, 1.0), (0.5, 8.0, 0.5)])
def test_mean_and_variance_are_those_of_electrons(light, read_noise, fill):
    """Five standard errors of each: √(variance / n), and of a variance of nearly normal numbers √(2 / n)."""
    sensor = pixels(full_well=1000.0, read_noise=read_noise, fill_factor=fill)
    electrons = 1000 * expose(sensor, flat(light), seed=3).astype(float)
    signal = 1000 * light * fill
    variance = signal + read_noise**2
    assert electrons.mean() == pytest.approx(signal, abs=5 * np.sqrt(variance / COUNT))
    assert electrons.var() == pytest.approx(variance, rel=5 * np.sqrt(2.2 / COUNT))
    assert 1000 * sensor.noise(light) == pytest.approx(np.sqrt(variance), rel=1e-12)


def test_sharpening_takes_the_noise_of_the_sensor_and_what_is_added():
    step = 1 / (4095 * np.sqrt(12))
    assert noise_of(pixels(bits=12), flat(0.5), Shown(noise=0.02)) == pytest.approx(np.hypot(0.02, step), rel=1e-6)


def test_light_without_read_noise_comes_in_whole_electrons_and_never_beyond_the_well():
    reading = 200 * expose(pixels(full_well=200.0), flat(1.0)).astype(float)
    assert np.abs(reading - np.rint(reading)).max() < 1e-4  # of float32
    assert reading.max() == 200 and 0.4 < (reading == 200).mean() < 0.6  # half of Poisson's numbers exceed their mean
    assert (expose(pixels(full_well=200.0), flat(50.0)) == 1).all()
    assert (expose(pixels(full_well=200.0), flat(-1.0)) == 0).all()


def test_raw_numbers_have_steps_limits_and_a_black_level():
    ramp = np.linspace(-0.5, 1.5, COUNT).reshape(SHAPE)
    sensor = pixels(bits=5, black_level=4)
    reading = expose(sensor, ramp)
    numbers = raw_numbers(sensor, reading)
    assert numbers.dtype == np.uint16 and np.unique(numbers).tolist() == list(range(32))
    inside = (ramp > -4 / 27) & (ramp < 1)
    assert np.abs(reading - ramp)[inside].max() <= 0.5 / 27 + 1e-6  # half a step
    assert (np.diff(numbers.ravel().astype(int)) >= 0).all()
    # The error of rounding is uniform over a step: a twelfth of its square (Bennett 1948).
    assert np.var((reading - ramp)[inside]) == pytest.approx(1 / (12 * 27**2), rel=0.01)
    assert sensor.noise(0.3) == pytest.approx(np.sqrt(1 / (12 * 27**2)), rel=1e-12)


def test_noise_and_steps_add_as_the_sensor_says():
    """Read noise of some steps, so that what rounding adds is independent of it."""
    sensor = pixels(full_well=4000.0, read_noise=10.0, bits=10, black_level=50)
    reading = expose(sensor, flat(0.3), seed=1)
    assert reading.std(dtype=float) == pytest.approx(float(sensor.noise(0.3)), rel=5 * np.sqrt(0.5 / COUNT))


def test_a_seed_repeats_the_noise_and_another_gives_independent_noise():
    sensor = pixels(full_well=900.0, read_noise=3.0)
    one, again, other = (expose(sensor, flat(0.4), seed) for seed in (7, 7, 8))
    assert (one == again).all()
    assert abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]) < 5 / np.sqrt(COUNT)


@pytest.mark.parametrize(("mosaic", "block"), [("rggb", [[0, 1], [1, 2]]), ("gbrg", [[1, 2], [0, 1]])])
def test_every_pixel_behind_a_mosaic_sees_its_own_colour(mosaic, block):
    light = np.broadcast_to(np.array([0.1, 0.2, 0.3]), (5, 7, 3))
    found = expose(Sensor(5, 7, 4.0, mosaic=mosaic), light)
    assert found.shape == (5, 7, 1)
    wanted = [[0.1 + 0.1 * block[row % 2][column % 2] for column in range(7)] for row in range(5)]
    np.testing.assert_allclose(found[..., 0], wanted, rtol=1e-6)


def test_a_sensor_of_which_nothing_is_stated_reads_the_light_itself():
    light = np.random.default_rng(1).normal(size=(6, 7, 3)).astype(np.float32)
    assert (expose(Sensor(6, 7, 4.0), light) == light).all()


def test_noise_is_applied_at_the_end_of_forming():
    sensor = Sensor(20, 30, 60.0, full_well=5000.0, read_noise=2.0, bits=12, black_level=16)
    scene = Scene(sensor, rtol=0.4, f_number=8)
    planned = preview_plan(scene.camera(find_lens("double_gauss_28")), scene)
    picture = np.random.default_rng(0).random((20, 30, 3))
    found = p2sf.form_image(planned, picture, seed=5)
    assert (found == expose(sensor, form_image(planned, picture, None, Forming()), 5)).all()
    assert (found != p2sf.form_image(planned, picture, seed=6)).any()


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({"full_well": 0.0}, "full_well is 0; give a number from 1"),
        ({"full_well": 10.0, "read_noise": -1.0}, "read_noise is -1"),
        ({"read_noise": 2.0}, "read_noise means nothing without full_well"),
        ({"black_level": 2}, "black_level means nothing without bits"),
        ({"bits": 17}, "bits is 17; give a whole number from 1 to 16"),
        ({"bits": 8, "black_level": 255}, "black_level is 255; give a whole number from 0 to 254"),
        ({"fill_factor": 0.0}, "fill factor is 0"),
        ({"mosaic": "rgbg"}, 'mosaic "rgbg" is unknown; choose rggb, grbg, gbrg or bggr'),
    ],
)
def test_a_pixel_that_cannot_be_is_refused(how, words):
    with pytest.raises(RequestError, match=words):
        pixels(**how)


def test_what_does_not_go_with_a_sensor_is_refused():
    with pytest.raises(RequestError, match="seed is -1; give a whole number"):
        expose(pixels(), flat(0.0), -1)
    with pytest.raises(RequestError, match="needs red, green and blue, but the picture has 1"):
        expose(pixels(mosaic="rggb"), flat(0.0))
    with pytest.raises(RequestError, match="but the scene has 1"):
        Scene(pixels(mosaic="rggb"), (p2sf.Channel("green", (540.0,), (1.0,)),))
    with pytest.raises(RequestError, match="no raw numbers"):
        raw_numbers(pixels(), flat(0.0))
    with pytest.raises(RequestError, match="rows, columns and colours"):
        expose(pixels(), np.zeros((3, 4)))


def test_filters_keep_the_moments_of_their_curves(tmp_path):
    """Sums over tenths of a nanometre, of powers of λ up to the fifteenth, the last that eight wavelengths keep."""
    (tmp_path / "curves.csv").write_text(CURVES)
    channels = filter_channels(tmp_path / "curves.csv", "planck:3200")
    assert [channel.name for channel in channels] == ["red", "green", "blue"]
    table = np.genfromtxt(CURVES.splitlines(), delimiter=",", skip_header=1)
    nm = np.arange(400.05, 700, 0.1)
    for number, channel in enumerate(channels, 1):
        weight = np.interp(nm, table[:, 0], table[:, number]) * relative_power(spectrum_of("planck:3200"), nm / 1000)
        waves, shares = np.array(channel.wavelengths_nm), channel.shares
        assert len(waves) == 8 and waves.min() >= 400 and waves.max() <= 700
        for power in (1, 2, 7, 15):
            wanted = np.average(((nm - 550) / 150) ** power, weights=weight)
            found = shares @ ((waves - 550) / 150) ** power
            assert found == pytest.approx(wanted, abs=2e-5)  # of sums over whole nanometres


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("nm,red\n", "wavelengths that increase"),
        ("nm,red\n500,a\n", "not a table of numbers"),
        ("nm,red\n500,1\n400,1\n", "wavelengths that increase"),
        ("nm,red\n0.5,1\n0.6,1\n", "from 100 to 20000 nm"),
        ("nm,red\n500,0\n600,0\n", "the curve of red has no light"),
        ("nm,red\n500,1\n600,-1\n", "0 or more"),
        ("nm,red\n500,1,2\n600,1\n", "not a table"),
        ("", "not a table"),
    ],
)
def test_curves_that_are_none_are_one_sentence(tmp_path, text, words):
    (tmp_path / "curves.csv").write_text(text)
    with pytest.raises(RequestError, match=words):
        filter_channels(tmp_path / "curves.csv")
    with pytest.raises(RequestError, match="cannot be read"):
        filter_channels(tmp_path / "absent.csv")


def test_a_scene_file_states_sensor_and_filters(tmp_path):
    (tmp_path / "curves.csv").write_text(CURVES)
    path = tmp_path / "scene.toml"
    path.write_text(SCENE + '[filters]\ncurves = "curves.csv"\nlight = "d65"\n')
    scene = read_scene(path)
    how = {"full_well": 20000.0, "read_noise": 4.0, "bits": 12, "black_level": 64, "mosaic": "grbg", "fill_factor": 0.8}
    assert scene.sensor == Sensor(20, 30, 60.0, **how)
    assert scene.channels == filter_channels(tmp_path / "curves.csv", "d65")
    for wrong, words in (
        (SCENE + "[filters]\n", "curves"),
        (SCENE + '[filters]\ncurves = "curves.csv"\n[[channel]]\nwavelengths_nm = [500]\n', "keep one of them"),
        (SCENE.replace("bits = 12", "bits = 1.5"), "bits is 1.5; give a whole number"),
        (SCENE.replace('"grbg"', "3"), "mosaic"),
    ):
        path.write_text(wrong)
        with pytest.raises(RequestError, match=words):
            read_scene(path)


def tag_values(path) -> dict[int, object]:
    with tifffile.TiffFile(path) as file:
        return {tag.code: tag.value for tag in file.pages[0].tags.values()}


def test_a_dng_holds_the_raw_numbers_and_what_they_mean(tmp_path):
    numbers = np.arange(20 * 30, dtype=np.uint16).reshape(20, 30)
    write_dng(tmp_path / "raw.dng", numbers, RawLevels(64, 4095, "grbg", (1e-4, 1e-6)))
    assert (tifffile.imread(tmp_path / "raw.dng") == numbers).all()
    tags = tag_values(tmp_path / "raw.dng")
    assert tags[262] == 32803 and tuple(tags[33422]) == (1, 0, 2, 1) and tuple(tags[33421]) == (2, 2)
    assert (tags[50714], tags[50717]) == (64, 4095) and tags[51041] == pytest.approx((1e-4, 1e-6), rel=1e-12)
    # White of D65 (CIE 15) is the neutral that the file states.
    matrix = np.array(tags[50721], float).reshape(9, 2)
    neutral = (matrix[:, 0] / matrix[:, 1]).reshape(3, 3) @ [0.95047, 1.0, 1.08883]
    assert neutral == pytest.approx([1, 1, 1], abs=2e-4)
    write_dng(tmp_path / "raw.dng", np.zeros((20, 30, 3), np.uint16), RawLevels(0, 255))
    assert tag_values(tmp_path / "raw.dng")[262] == 34892 and tifffile.imread(tmp_path / "raw.dng").shape == (20, 30, 3)


def test_the_command_line_writes_raw_numbers(tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE)
    arguments = ["image", "double_gauss_28", str(scene), "chart:landscape"]
    for name in ("a.npy", "b.npy", "c.dng"):
        seed = ["--seed", "2"] if name == "b.npy" else []
        assert main([*arguments, "-o", str(tmp_path / name), *seed, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["encoding"] == "raw"
    one, other = np.load(tmp_path / "a.npy"), np.load(tmp_path / "b.npy")
    assert one.shape == (20, 30) and one.dtype == np.uint16 and one.max() <= 4095 and (one != other).any()
    assert (tifffile.imread(tmp_path / "c.dng") == one).all()
    for wrong, flags in (("d.npy", ["--preview"]), ("d.png", ["--deblur", "wiener"]), ("d.png", ["--noise", "0.1"])):
        assert main([*arguments, "-o", str(tmp_path / wrong), *flags]) == 2
        assert flags[0] in capsys.readouterr().err
    assert (
        main([*arguments, "-o", str(tmp_path / "d.npy"), "--seed", "-3"]) == 2 and "--seed" in capsys.readouterr().err
    )
    scene.write_text(SCENE.replace("bits = 12", "").replace("black_level = 64", ""))
    assert main([*arguments, "-o", str(tmp_path / "d.dng")]) == 2 and "bits" in capsys.readouterr().err
    scene.write_text(SCENE.replace('mosaic = "grbg"', "") + "[[channel]]\nwavelengths_nm = [540]\n")
    assert main([*arguments, "-o", str(tmp_path / "d.dng")]) == 2 and "1 channels" in capsys.readouterr().err
