"""The state: JSON and back, and every bad value one sentence."""

import json
import subprocess
import sys
from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from p2sf.errors import P2SFError
from p2sf.lens.lens import AIMS
from p2sf_explorer.state.link import shorten_state
from p2sf_explorer.state.state import CHOICES, LINKABLE, PanelChoices, State, new_state
from p2sf_explorer.state.state_files import SCHEMA, VERSION, read_state, state_from_json, state_to_dict, state_to_json
from p2sf_explorer.state.terms import TERMS

finite = {"allow_nan": False, "allow_infinity": False}


def some_of(names):
    return st.sets(st.sampled_from(names)).map(lambda found: tuple(name for name in names if name in found))


WAVES = st.floats(-1000, 1000, **finite)
ALONE = dict(
    lens=st.sampled_from(["double_gauss_28", "/some where/lens.toml"]),
    lens_text=st.none() | st.text(max_size=200),
    depth_mm=st.floats(1e-3, 1e12, **finite) | st.just(inf),
    focus_mm=st.none() | st.floats(1e-3, 1e12, **finite) | st.just(inf),
    sensor_shift_um=st.floats(-1e6, 1e6, **finite),
    field_deg=st.floats(-89, 89, **finite),
    wavelength_nm=st.floats(100, 20000, **finite),
    f_number=st.none() | st.floats(0.2, 1000, **finite),
    clip=st.booleans(),
    tolerance=st.floats(0, 1, **finite),
    obscuration=st.none() | st.floats(0, 0.99),
    vanes=st.none() | st.integers(0, 12),
    blades=st.none() | st.just(0) | st.integers(3, 32),
    blade_angle_deg=st.none() | st.floats(-360, 360),
    apodisation=st.none() | st.just(inf) | st.floats(0.1, 10),
    apodisation_power=st.none() | st.integers(1, 10).map(lambda half: 2 * half),
    cubic_um=st.none() | st.floats(-1000, 1000),
    added_waves=st.tuples(*[WAVES] * len(TERMS)),
    muted=some_of(TERMS),
    solo=some_of(TERMS),
    free_pupil=st.booleans(),
    linked=some_of(LINKABLE),
    playback_seconds=st.floats(0.1, 600, **finite),
    measured_picture=st.sampled_from(["", "/some where/points.tif"]),
    measured_pixel_um=st.floats(0.05, 1000, **finite),
    **{name: st.sampled_from(values) for name, values in CHOICES.items() if name != "shown"},
)
PLAYED = st.builds(dict, playback_slider=st.just("depth_mm"), playback_range=st.none() | st.just((500.0, inf)))
PLAYED |= st.builds(dict, playback_slider=st.just("added_w31"), playback_range=st.tuples(WAVES, WAVES))
STATES = st.builds(
    lambda alone, other, played, shown: new_state(**alone, **played, pinned=other, shown=shown if other else "a"),
    st.builds(dict, **ALONE),
    st.none() | st.builds(new_state, **ALONE),
    PLAYED,
    st.sampled_from(CHOICES["shown"]),
)


@given(STATES)
def test_json_and_back_is_identical(state):
    assert state_from_json(state_to_json(state, versions={"p2sf": "x"})) == state


@pytest.mark.parametrize("version", [2, 3])
def test_a_state_without_aim_fills_the_paraxial_pupil_as_before_there_was_one(version):
    groups = {"optics": {"field_deg": 3.0}, "compare": {"pinned": {"what_if": {"free_pupil": True}}}}
    for values in (groups, {}):
        text = json.dumps({"schema": SCHEMA, "version": version, "state": values})
        state = state_from_json(text)
        assert state.optics.aim == "paraxial"
        assert state.compare.pinned is None or state.compare.pinned.optics.aim == "paraxial"


@pytest.mark.parametrize("version", [1, 2, 3, 4])
def test_a_state_from_before_masks_leaves_the_stop_as_the_lens_file_has_it(version):
    values = {"field_deg": 3.0} if version == 1 else {"optics": {"field_deg": 3.0}}
    state = state_from_json(json.dumps({"schema": SCHEMA, "version": version, "state": values}))
    assert state.optics.field_deg == 3.0 and not state.optics.mask


@pytest.mark.parametrize("version", range(1, VERSION + 1))
def test_a_state_that_says_nothing_of_choosers_has_them_as_at_the_first_start(version):
    values = {"field_deg": 3.0} if version == 1 else {"optics": {"field_deg": 3.0}, "playback": {"seconds": 2.0}}
    state = state_from_json(json.dumps({"schema": SCHEMA, "version": version, "state": values}))
    assert state.optics.field_deg == 3.0
    assert (state.choices, state.playback.subject) == (PanelChoices(), "stack")


@pytest.mark.parametrize("aim", AIMS)
def test_every_file_and_link_says_how_rays_fill_the_pupil(aim):
    state = new_state(aim=aim, pinned=new_state(aim=aim))
    written = state_to_dict(state), shorten_state(state)
    for groups in written:
        assert groups["optics"]["aim"] == groups["compare"]["pinned"]["optics"]["aim"] == aim


def test_infinity_is_plain_json():
    text = state_to_json(State())
    assert json.loads(text, parse_constant=pytest.fail)["state"]["optics"]["depth_mm"] == "inf"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"depth_mm": -1.0}, "source depth is -1 mm"),
        ({"depth_mm": 1e99}, "source depth is 1e.99 mm"),
        ({"matrix_depths_mm": (1e3, 1e30)}, "source depth is 1e.30 mm"),
        ({"depth_mm": float("nan")}, "source depth is nan mm"),
        ({"field_deg": 90.0}, "field angle is 90°"),
        ({"field_deg": "wide"}, "field angle is 'wide'"),
        ({"aim": "high"}, 'aim is "high"; choose one of stop, paraxial'),
        ({"aim": None}, 'aim is "None"; choose one of stop, paraxial'),
        ({"method": "magic"}, 'method is "magic"; choose one of auto'),
        ({"lens": ""}, "names no lens"),
        ({"lens_text": 3}, "edited lens is not text"),
        ({"clip": "yes"}, "clip is 'yes'; give true or false"),
        ({"obscuration": 1.0}, "obscuration is 1; give a number from 0 to 0.99"),
        ({"apodisation": float("nan")}, "apodisation is nan"),
        ({"blades": 2}, "a whole number from 3 to 32"),
        ({"blades": 5.5}, "blades is 5.5; give a whole number"),
        ({"vanes": 13}, "number of vanes is 13"),
        ({"apodisation_power": 3}, "give an even number from 2 to 20"),
        ({"blade_angle_deg": "up"}, "blade angle is 'up'"),
        ({"added_waves": (1.0,)}, "give 6 numbers, for w40"),
        ({"added_waves": (float("nan"), 0.0, 0.0, 0.0, 0.0, 0.0)}, "added to w40 is nan λ"),
        ({"muted": ("w31", "w40")}, "each once and in this order"),
        ({"solo": ("piston",)}, "list some of w40"),
        ({"free_pupil": 1}, "free_pupil is 1"),
        ({"pinned": new_state(pinned=State())}, "nothing pinned in it"),
        ({"shown": "b"}, "nothing is pinned as B"),
        ({"linked": ("theme",)}, "linked is"),
        ({"playback_slider": "theme"}, "name a slider"),
        ({"playback_slider": "depth_mm", "playback_range": (-1.0, inf)}, "source depth is -1 mm"),
        ({"playback_seconds": 0.0}, "duration of a sweep is 0 s"),
    ],
)
def test_a_value_that_cannot_be_is_a_sentence(changes, words):
    with pytest.raises(P2SFError, match=words.replace("(", r"\(")):
        new_state(**changes)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "line 1: not JSON"),
        ("[]", "is not a state"),
        ('{"schema": "p2sf-explorer-state", "version": 99, "state": {}}', "version 99"),
        ('{"schema": "p2sf-explorer-state", "version": 1, "state": {"dept_mm": 1}}', 'unknown entry "dept_mm"'),
    ],
)
def test_a_bad_state_file_is_a_sentence(tmp_path, text, words):
    path = tmp_path / "state.json"
    path.write_text(text)
    with pytest.raises(P2SFError, match=words):
        read_state(path)


def nested(value: str, depth: int) -> str:
    """Return a value in so many lists."""
    return "[" * depth + value + "]" * depth


def pinned(depth: int) -> str:
    return '{"pinned": ' * depth + "{}" + "}" * depth


@pytest.mark.parametrize("depth", [*range(750, 1000, 7), 100_000])
@pytest.mark.parametrize("entry", ["windows", "field_deg", "play_range", "lens_text", "muted", "spectrum", "nothing"])
def test_a_state_nested_as_deep_as_python_can_and_deeper_is_a_sentence(entry, depth):
    """Some depths JSON still reads and what follows does not: where that begins depends on who calls."""
    with pytest.raises(P2SFError):
        state_from_json(f'{{"schema": "{SCHEMA}", "version": 1, "state": {{"{entry}": {nested("1", depth)}}}}}')


@pytest.mark.parametrize("depth", [3, 300, 950, 100_000])
def test_only_one_state_is_pinned(depth):
    with pytest.raises(P2SFError, match=r"nothing pinned in it|nested too deep"):
        state_from_json(f'{{"schema": "{SCHEMA}", "version": 1, "state": {pinned(depth)}}}')


@pytest.mark.parametrize("digits", [400, 5000])
def test_a_whole_number_no_float_can_hold_is_a_sentence(digits):
    with pytest.raises(P2SFError, match=r"field angle is 999|too long a number"):
        state_from_json(f'{{"schema": "{SCHEMA}", "version": 1, "state": {{"field_deg": {"9" * digits}}}}}')


def test_a_missing_state_file_is_a_sentence(tmp_path):
    with pytest.raises(P2SFError, match="cannot be read"):
        read_state(tmp_path / "none.json")


def test_state_and_compute_know_no_qt():
    """The layer law: a live answer, side panels included, without Qt or its plots."""
    code = """
import sys
from p2sf_explorer.compute import autofocus, live
from p2sf_explorer.files import snapshot
from p2sf_explorer.state import state
from p2sf_explorer.compute.views import profiles, seidel
live.live(state.State(), views={"p": profiles.profiles, "s": seidel.per_surface})
print([name for name in sys.modules if name.startswith(("PySide6", "pyqtgraph", "pyvista"))])
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
