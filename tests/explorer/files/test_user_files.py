"""Files of a person that lie beside what the window saves stay byte for byte, and what was saved needs none of them."""

import json
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog, QMessageBox

from p2sf.errors import ExportError, LensFileError, P2SFError
from p2sf.image.progress import Progress
from p2sf.io.photo_files import read_photo, write_photo
from p2sf.io.png16 import write_deep
from p2sf.io.png_text import HEADER, with_text
from p2sf_explorer.compute.live import Live
from p2sf_explorer.files.asking import ask_path
from p2sf_explorer.files.embedded_state import KEYWORD, state_inside, text_inside
from p2sf_explorer.files.opening import open_file
from p2sf_explorer.files.snapshot import write_data, write_picture, write_state
from p2sf_explorer.state.state import State, new_state
from p2sf_explorer.state.state_files import state_to_json
from p2sf_explorer.window.commands.set_request import SetTexts, read_request, write_set
from tests.explorer.conftest import FIRST
from tests.support.tiers import in_tiers

ROOT = Path(__file__).parents[3]
SNAPSHOTS = (".npz", ".tiff", ".fits", ".csv", ".png")
PICTURES = (".png", ".tif", ".exr")
SETS = (".npz", ".tif", ".fits")  # those that hold the state
BARE = write_deep(np.ones((8, 8, 3), np.uint16))
SET_TEXTS = SetTexts("2 m", "0", "587.6 nm", "5 µm", "100 %", "11")


@pytest.fixture
def lens(tmp_path) -> Path:
    """Return a lens of the person's own, in the folder that everything is saved to."""
    return Path(shutil.copy(ROOT / "tests" / "data" / "import" / "triplet.json", tmp_path / "mylens.json"))


@pytest.fixture
def make_set():
    def made(state: State, path: Path) -> Path:
        return write_set(read_request(state, SET_TEXTS, str(path)), Progress(lambda _: None, lambda: False))[0]

    return made


@pytest.mark.parametrize("ending", in_tiers(SNAPSHOTS, (".npz", ".png")))
def test_a_snapshot_leaves_the_lens_of_its_name(window, tmp_path, lens, ending):
    before = lens.read_bytes()
    window.commands.open_path(str(lens))
    assert window.commands.save(str(lens.with_suffix(ending)))
    assert lens.read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == {"mylens.json", f"mylens{ending}"}
    state = window.store.state
    window.store.replace(FIRST)
    assert window.commands.open_path(str(lens.with_suffix(ending))) and window.store.state == state


@pytest.mark.parametrize("ending", [*SETS, ".mat", ".csv"])
def test_a_set_leaves_the_lens_of_its_name(tmp_path, lens, make_set, ending):
    before, state = lens.read_bytes(), new_state(f_number=8.0, field_deg=3.0)
    made = make_set(state, lens.with_suffix(ending))
    assert lens.read_bytes() == before
    if ending in SETS:
        assert {path.name for path in tmp_path.iterdir()} == {"mylens.json", made.name}
        assert state_inside(made) == state
    else:
        assert open_file(State(), str(tmp_path / f"{made.name}.state.json")) == state


@pytest.mark.parametrize("ending", in_tiers(PICTURES, (".tif",)))
def test_a_picture_leaves_the_lens_of_its_name(window, image_panel, tmp_path, lens, ending):
    before, path = lens.read_bytes(), lens.with_suffix(ending)
    image_panel.save_as(str(path))
    assert lens.read_bytes() == before
    assert {item.name for item in tmp_path.iterdir()} == {"mylens.json", path.name}
    assert state_inside(path) == window.store.state
    assert read_photo(path).values.shape == image_panel._answer.after.shape


@pytest.mark.parametrize("ending", [".mat", ".csv"])
def test_a_state_beside_a_set_takes_the_place_of_a_state_alone(tmp_path, make_set, ending):
    path, beside = tmp_path / f"set{ending}", tmp_path / f"set{ending}.state.json"
    beside.write_text('{"surfaces": []}')
    with pytest.raises(ExportError, match=r"state\.json is there already"):
        make_set(new_state(), path)
    assert beside.read_text() == '{"surfaces": []}' and not path.exists(), "refused before the work"
    write_state(new_state(f_number=2.8), beside.with_name("old.json")).replace(beside)
    make_set(new_state(f_number=8.0), path)
    assert open_file(State(), str(beside)).optics.f_number == 8.0


def saved(live: Live, path: Path, state: State) -> Path:
    """Save a snapshot of an answer, as the window does, of a state."""
    return write_picture(state, BARE, path) if path.suffix == ".png" else write_data(live, path, state)


def test_two_formats_of_one_name_keep_a_state_each(window, tmp_path):
    states = {ending: new_state(field_deg=float(field)) for field, ending in enumerate(SNAPSHOTS, 1)}
    for ending, state in states.items():
        saved(window.live, tmp_path / f"shot{ending}", state)
    for ending, state in states.items():
        assert open_file(State(), str(tmp_path / f"shot{ending}")) == state


@pytest.mark.parametrize("ending", [".json", ".csv"])
def test_nothing_is_saved_over_the_open_lens(window, tmp_path, ending):
    name = {".json": "triplet.json", ".csv": "singlet.csv"}[ending]
    path = Path(shutil.copy(ROOT / "tests" / "data" / "import" / name, tmp_path))
    (tmp_path / f"link{ending}").symlink_to(path)
    before = path.read_bytes()
    window.commands.open_path(str(path))
    for target in (path, tmp_path / f"link{ending}"):
        assert not window.commands.save(str(target)) and window.banner.isVisible()
        assert path.read_bytes() == before
    window.commands.open_lens("tessar")
    if ending == ".json":
        assert not window.commands.save(str(path)), "a lens that is not open is no state either"
        assert path.read_bytes() == before


def test_no_picture_is_saved_over_its_photo(window, image_panel, qtbot, tmp_path):
    photo = write_photo(tmp_path / "photo.png", np.full((20, 30, 3), 0.5, np.float32))
    before = photo.read_bytes()
    window.store.update(photo_source=str(photo))
    qtbot.waitUntil(lambda: not image_panel._stale())
    image_panel.save_as(str(photo))
    assert photo.read_bytes() == before and window.banner.isVisible()
    window.store.update(photo_source="text")


def test_states_beside_snapshots_of_older_versions_open(tmp_path):
    """Until 0.3 ``shot.json`` lay beside ``shot.png``, as a state file without more."""
    state = new_state(field_deg=4.0, f_number=4.0)
    text = json.loads(state_to_json(state))
    (tmp_path / "shot.json").write_text(json.dumps({**text, "versions": {"p2sf": "0.2.0"}, "exported": "shot.png"}))
    assert open_file(State(), str(tmp_path / "shot.json")) == state


@pytest.mark.slow
def test_every_file_reopens_in_a_process_of_its_own(window, image_panel, make_set, qtbot, tmp_path):
    window.store.update(field_deg=5.0, f_number=5.6)
    qtbot.waitUntil(lambda: not image_panel._stale())
    files = []
    for ending in SNAPSHOTS:
        files.append(tmp_path / f"shot{ending}")
        assert window.commands.save(str(files[-1]))
    files += [make_set(window.store.state, tmp_path / f"set{ending}") for ending in SETS]
    for ending in PICTURES:
        image_panel.save_as(str(tmp_path / f"picture{ending}"))
        files.append(tmp_path / f"picture{ending}")
    code = (
        "import sys; from p2sf_explorer.application.main import starting_state; "
        "from p2sf_explorer.state.state_files import state_to_json; "
        "print(*(state_to_json(starting_state([path])) for path in sys.argv[1:]), sep='', end='')"
    )
    run = subprocess.run([sys.executable, "-c", code, *map(str, files)], capture_output=True, text=True, check=True)
    assert run.stdout == state_to_json(window.store.state) * len(files)


def png_chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def bomb(size: int) -> bytes:
    """Return a text chunk that unpacks to ``size`` bytes."""
    packer = zlib.compressobj(9)
    packed = b"".join(packer.compress(bytes(1 << 20)) for _ in range(size >> 20)) + packer.flush()
    return png_chunk(b"iTXt", KEYWORD.encode() + b"\0\1\0\0\0" + packed)


def test_a_state_that_is_none_is_a_sentence(window, tmp_path, monkeypatch):
    """What another hand put in the place of the state: no JSON, no state, values that none can have."""
    wrong = json.loads(state_to_json(FIRST))
    wrong["state"]["optics"]["f_number"] = "wide open"
    for text in ("", "{", "[" * 100_000, "null", '{"schema": 1}', json.dumps(wrong)):
        monkeypatch.setattr("p2sf_explorer.files.snapshot.state_text", lambda _, text=text: text)
        for ending in SNAPSHOTS:
            with pytest.raises(P2SFError):
                open_file(FIRST, str(saved(window.live, tmp_path / f"shot{ending}", FIRST)))


def test_a_text_that_swells_or_is_torn_is_no_state(tmp_path):
    path = tmp_path / "shot.png"
    whole = with_text(BARE, KEYWORD, state_to_json(FIRST))
    swollen = BARE[:HEADER] + bomb(200 << 20) + BARE[HEADER:]
    for data in (swollen, whole[: HEADER + 300], BARE):
        path.write_bytes(data)
        assert text_inside(path) is None
        with pytest.raises(LensFileError, match="no readable state"):
            open_file(FIRST, str(path))


def clicked(box: QMessageBox, replace: bool) -> None:
    next(button for button in box.buttons() if button.text() == ("Replace" if replace else "Cancel")).click()


def test_a_name_gets_its_ending_and_no_file_is_replaced_unasked(window, tmp_path, monkeypatch):
    (tmp_path / "there.npz").write_text("mine")
    typed, answers = iter(("there", "there", "other", "other.png", "")), iter((False, True, True))
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (f"{tmp_path}/{next(typed)}", "NumPy (*.npz)"))
    monkeypatch.setattr(QMessageBox, "exec", lambda box: clicked(box, next(answers)))
    kinds = "NumPy (*.npz);;PNG (*.png *.tif)"
    found = [ask_path(window, "Save", "first.npz", kinds) for _ in range(4)]
    assert found == ["", str(tmp_path / "there.npz"), str(tmp_path / "other.npz"), str(tmp_path / "other.png")]
