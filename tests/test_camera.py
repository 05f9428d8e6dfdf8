"""A camera is declared once: the table of parameters, `Camera`, flags, the window and files know the same numbers."""

import pickle
import re
from dataclasses import fields, is_dataclass, replace
from inspect import signature
from math import inf
from pathlib import Path

import numpy as np
import pytest

import p2sf
import p2sf_explorer
from p2sf.camera import Camera
from p2sf.cli import main
from p2sf.disc.mask import MaskSettings, PupilMask
from p2sf.errors import RequestError
from p2sf.figures.psf_data import Later
from p2sf.lens.lens import with_absorption, with_aim, with_f_number, with_mask
from p2sf.lensfile.library import find_lens
from p2sf.parameters import CAMERA_PARAMETERS, MASK_PARAMETERS, PARAMETERS, SOURCE_PARAMETERS
from p2sf.scene.files import KEYS
from p2sf.scene.scene import Scene
from p2sf.setting import (
    AS_IN_FILE,
    LensSettings,
    PointSource,
    Request,
    Settings,
    explicit_values,
    set_up,
    set_up_source,
)
from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.compute.setup import request_setup, with_lens
from p2sf_explorer.state.limits import RANGES, SLIDERS
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import Optics, State, change, entry, new_state
from p2sf_explorer.state.state_files import state_from_json, state_to_dict, state_to_json
from tests.disc.test_mask_table import SAMPLES as MASKS
from tests.support.lenses.zooms import focusing_zoom

HANDBOOK = Path(p2sf_explorer.__file__).parent / "handbook"
LENS = find_lens("achromat_f6")
SOURCE = p2sf.Source(5000, field_deg=1)
# A value of every number, otherwise than by default.
SAMPLES = {
    "zoom": 42.0,
    "focus_position": 0.25,
    "focus_mm": 3000.0,
    "sensor_shift_um": 20.0,
    "f_number": 8.0,
    "stop": "auto",
    "aim": "paraxial",
    "absorption": True,
    **{each.name: getattr(MASKS[each.name], each.name) for each in MASK_PARAMETERS},
}
WITHOUT_SLIDER = {each.name for each in MASK_PARAMETERS if not each.typed}
NOT_IN_WINDOW = {"absorption", *WITHOUT_SLIDER}  # absorption is a command that edits the lens
PARTS = PointSource, LensSettings, MaskSettings, Settings  # of a request
NOT_IN_MASK = {"zernike_um", "phase_map", "amplitude_map", "turn_deg"}  # of files and Python only
NOT_IN_SCENE = {name for name in SAMPLES if name not in ("zoom", "focus_position", "focus_mm", "f_number", "aim")}
KEYWORDS = {name: SAMPLES[name] for name in ("focus_mm", "sensor_shift_um", "f_number", "stop", "aim")}
CALLS = {
    "render": lambda **camera: p2sf.render(LENS, SOURCE, "traced", pixels=16, pixel_um=2.0, **camera),
    "build_database": lambda **camera: p2sf.build_database(LENS, [2000, inf], [0, 1], [550, 600], **camera).database,
    "tradeoff": lambda **camera: (
        p2sf.tradeoff(LENS, depths_mm=5000, fields_deg=1, wavelengths_nm=550, methods="seidel", pixels=8, **camera)[
            0
        ].errors
    ),
}
pytestmark = pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")  # of small windows


def names(kind) -> list[str]:
    return [field.name for field in fields(kind)]


def same(one, other) -> bool:
    """Return whether two results are the same to the last bit, but for how long they took."""
    if isinstance(one, Later):
        return same(one(), other())
    if is_dataclass(one):
        return all(same(getattr(one, name), getattr(other, name)) for name in names(one) if name != "seconds")
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(np.array_equal(one, other, equal_nan=True)) if isinstance(one, np.ndarray | float) else one == other


def test_the_table_and_the_objects_have_the_same_numbers():
    declared = [each.name for each in (*CAMERA_PARAMETERS, *MASK_PARAMETERS)]
    assert sorted(names(Settings)) == sorted(declared) == sorted(SAMPLES)
    assert names(Camera) == [*names(Settings), "lens", "pixel_um"]
    assert names(PointSource) == [each.name for each in SOURCE_PARAMETERS]
    assert names(Request) == names(PointSource) + names(Settings)
    assert {each.name for each in MASK_PARAMETERS} == set(names(PupilMask)) - NOT_IN_MASK
    described = re.findall(r"^    (\w+)(?: :.*)?$", "\n".join(p.__doc__ for p in PARTS), re.MULTILINE)
    assert set(names(Request)) <= set(described)
    of_mask = re.findall(r"^    (\w+(?:, \w+)*) : .*$", PupilMask.__doc__, re.MULTILINE)
    assert set(", ".join(of_mask).split(", ")) == set(names(PupilMask))


@pytest.mark.parametrize("command", [["psf"], ["database", "build"], ["tradeoff"]])
def test_the_command_line_has_a_flag_for_each_and_says_what_it_is(command, capsys):
    assert main([*command, "--help"]) == 0
    text = capsys.readouterr().out
    for name in names(Settings):
        told = re.search(rf"{PARAMETERS[name].flag}\b[^\w│]([^│]*)│", text)
        assert told and re.search(r"[a-z]{2}", told[1]), name


def test_the_window_has_an_entry_for_each_that_files_and_links_keep():
    held = [name for name in names(Settings) if name not in NOT_IN_WINDOW]
    assert set(held) == set(names(Settings)) & set(names(Optics))
    typed = {name for name in held if PARAMETERS[name].typed}
    assert set(held) - typed == {"stop", "aim"} == {name for name in held if name not in RANGES}
    assert typed == set(names(Settings)) & set(SLIDERS) == set(names(Settings)) & {each.key for each in QUANTITIES}
    default = {name: getattr(AS_IN_FILE, name) for name in held if name != "aim"}
    assert {name: getattr(Optics(), name) for name in default} == default
    state = new_state(**{name: SAMPLES[name] for name in held})
    assert state_of_link(link(state)) == state == state_from_json(state_to_json(state))
    assert set(held) <= set(state_to_dict(state)["optics"])
    left = with_lens(state, "landscape")
    assert all(entry(left, name) == default[name] for name in typed)


@pytest.mark.parametrize("parameter", MASK_PARAMETERS, ids=lambda each: each.name)
def test_the_table_says_how_a_number_of_the_mask_is_shown(parameter):
    """A number that needs no other does something alone; one that does is a row of the window only beside it."""
    alone = PupilMask(**{parameter.name: SAMPLES[parameter.name]})
    assert alone.clear == bool(parameter.needs) and parameter.needs in ("", *names(PupilMask))
    assert parameter.name in HANDBOOK.joinpath("lens_files.md").read_text("utf-8")
    row = f"| {parameter.control} | "
    listed = [line for line in HANDBOOK.joinpath("window.md").read_text("utf-8").splitlines() if line.startswith(row)]
    if parameter.name in WITHOUT_SLIDER:
        assert not listed
        return
    assert parameter.tip and parameter.words
    assert [line.split("|")[3].strip() for line in listed] == [f"`{parameter.name}`"]


def test_a_scene_states_those_that_do_not_change_its_light():
    assert set(names(Settings)) & set(names(Scene)) == set(SAMPLES) - NOT_IN_SCENE == set(names(Settings)) & KEYS[""]
    stated = {name: SAMPLES[name] for name in SAMPLES if name not in NOT_IN_SCENE and name != "focus_position"}
    assert Scene(p2sf.Sensor(2, 3, 5.0), **stated).request == Request(**stated)


@pytest.mark.parametrize("name", SAMPLES)
def test_every_number_means_the_same_everywhere(name):
    lens = focusing_zoom() if name in ("zoom", "focus_position") else LENS
    needed = PARAMETERS[name].needs
    asked = {needed: SAMPLES[needed]} if needed else {}
    camera = Camera(**asked | {name: SAMPLES[name]})
    source = p2sf.Source(5000, field_deg=1, wavelength_nm=1000 * lens.reference_wavelength_um)
    setup = set_up_source(lens, source, camera)
    by_request = set_up(lens, Request(**explicit_values(camera), depth_mm=5000, field_deg=1))
    assert setup == by_request and setup.lens != set_up_source(lens, source, Camera(**asked)).lens
    if name not in NOT_IN_WINDOW and lens is LENS:
        state = change(with_lens(State(), "achromat_f6"), depth_mm=5000.0, field_deg=1.0, **vars_of(camera))
        found = request_setup(change(state, wavelength_nm=source.wavelength_um * 1000))
        assert found.lens == setup.lens and found.stop == setup.stop


def vars_of(camera: Camera) -> dict[str, object]:
    """Return what the window can hold of a camera; its own default of the aim is the stop's."""
    held = {name: getattr(camera, name) for name in names(Settings) if name not in NOT_IN_WINDOW}
    return held | {"aim": camera.aim or LENS.aim}


def test_each_number_does_what_the_lens_does():
    camera = Camera(f_number=9.0, aim="paraxial", absorption=True, obscuration=0.4)
    lens = with_absorption(with_mask(with_aim(with_f_number(LENS, 9.0), "paraxial"), PupilMask(obscuration=0.4)))
    assert set_up_source(LENS, SOURCE, camera).lens == lens


@pytest.mark.parametrize(
    ("call", "name"),
    [(call, name) for call in CALLS for name in KEYWORDS if name in signature(getattr(p2sf, call)).parameters],
)
def test_a_keyword_and_a_camera_give_the_same_bits(call, name):
    one, other = CALLS[call](**{name: SAMPLES[name]}), CALLS[call](camera=Camera(**{name: SAMPLES[name]}))
    assert same(one, other)


@pytest.mark.parametrize("call", CALLS)
def test_a_number_stated_twice_is_one_sentence(call):
    for again in ({"aim": "stop"}, {"aim": "paraxial"}):
        with pytest.raises(p2sf.P2SFError) as raised:
            CALLS[call](camera=Camera(aim="paraxial"), **again)
        assert raised.value.message.values["parameter"] == "aim"
    assert CALLS[call](camera=Camera(aim="paraxial"), aim=None) is not None


def test_keywords_add_to_a_camera():
    both = p2sf.render(LENS, SOURCE, "seidel", pixels=16, f_number=9.0, camera=Camera(focus_mm=4000, blades=5))
    alone = p2sf.render(LENS, SOURCE, "seidel", pixels=16, camera=Camera(f_number=9.0, focus_mm=4000, blades=5))
    assert same(both, alone)


@pytest.mark.parametrize("camera", [None, 5.6, {"f_number": 5.6}, Request(f_number=5.6)])
def test_what_is_no_camera_is_refused(camera):
    with pytest.raises(p2sf.P2SFError) as raised:
        p2sf.render(LENS, SOURCE, camera=camera)
    assert raised.value.message.values["parameter"] == "camera"


@pytest.mark.parametrize("name", SAMPLES)
def test_a_camera_is_written_copied_and_compared(name):
    camera = Camera(**{name: SAMPLES[name]})
    assert repr(camera) == f"Camera({name}={SAMPLES[name]!r})"
    for again in (eval(repr(camera)), pickle.loads(pickle.dumps(camera)), replace(camera)):
        assert again == camera and hash(again) == hash(camera) and again != AS_IN_FILE


def test_a_camera_of_numpy_is_written_in_plain_numbers():
    camera = Camera(f_number=np.float64(5.6), focus_mm=inf, vanes=np.int64(3))
    assert eval(repr(camera)) == camera and "np." not in repr(camera)
    assert repr(AS_IN_FILE) == "Camera()"
    request = Request(field_deg=3.0, zoom="wide")
    assert eval(repr(request)) == request and request != Camera(zoom="wide")


def test_a_camera_with_its_lens_is_that_lens_so_set():
    camera = Camera("achromat_f6", focus_mm=4000, f_number=9.0, pixel_um=3.0)
    assert camera == Camera(LENS, focus_mm=4000, f_number=9.0, pixel_um=3.0) != Camera(focus_mm=4000, f_number=9.0)
    assert eval(repr(camera)) == camera == pickle.loads(pickle.dumps(camera))
    source = camera.source(5000, 1, 550)
    assert source == p2sf.Source(5000, field_deg=1, wavelength_nm=550)
    mine = camera.at(depth_mm=5000, field_deg=1, wavelength_nm=550).psf(pixels=16)
    assert same(mine, p2sf.render(LENS, source, pixels=16, pixel_um=3.0, focus_mm=4000, f_number=9.0))
    assert same(mine, p2sf.render(LENS, source, pixels=16, camera=camera))
    assert camera.at(depth_mm=5000).psf(pixels=16, pixel_um=2.0).pixel_um == 2.0
    assert camera.source().wavelength_um == pytest.approx(LENS.reference_wavelength_um, rel=1e-15)


def test_a_camera_is_no_other_lens_than_the_one_of_the_call():
    for call in (lambda: p2sf.render(find_lens("tessar"), camera=Camera(LENS)), Camera(f_number=8).at):
        with pytest.raises(RequestError):
            call()
    assert same(p2sf.render(lens=find_lens("achromat_f6"), camera=Camera(LENS)), p2sf.render(LENS))


@pytest.mark.parametrize("wrong", [{"lens": 5.6}, {"lens": LENS, "pixel_um": 0.0}, {"lens": "no_such_lens"}])
def test_a_camera_that_cannot_be_is_refused_at_once(wrong):
    with pytest.raises(p2sf.P2SFError):
        Camera(**wrong)
