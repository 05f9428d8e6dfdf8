"""The 3D view: rendered pictures against the scene, moving in place, files, and a sentence where OpenGL is missing."""

import json
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt

from p2sf.errors import P2SFError
from p2sf_explorer.charts.theme import LIGHT
from p2sf_explorer.compute.live import live
from p2sf_explorer.panels.solid import SolidPanel
from p2sf_explorer.scene3d.scene import scene
from p2sf_explorer.state.camera import CAMERA, SceneCamera
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.store.store import Store
from tests.long.crash import small_disk

FIRST = new_state(method="seidel", theme="light")
MAPS = "CET-D1A", "inferno"
SIDE = SceneCamera(turn=0.0, tilt=0.0)


def scene_at(**changes):
    return scene(live(change(FIRST, **changes), "preview")).found


@pytest.fixture(scope="module")
def renderer():
    from p2sf_explorer.scene3d.renderer import Renderer

    made = Renderer((320, 240))
    yield made
    made.close()


def shown(renderer, camera=SIDE, **changes) -> np.ndarray:
    renderer.follow(scene_at(**changes), LIGHT, MAPS)
    renderer.look(camera)
    return renderer.picture()[..., :3].astype(int)


def test_from_the_side_light_goes_to_the_right_and_the_sensor_stands_there(renderer):
    picture = shown(renderer)
    dark = (picture.max(axis=2) < 100).sum(axis=0)
    assert 230 < dark.argmax() < 320, "the sensor, seen from its edge, is the tallest dark column at the right"


def test_rays_have_the_colour_of_their_light_and_rise_with_the_field(renderer):
    heights = []
    for field in (4.0, 14.0):
        picture = shown(renderer, field_deg=field, wavelength_nm=530.0)
        green = (picture[..., 1] > picture[..., 0] + 60) & (picture[..., 1] > picture[..., 2] + 60)
        assert green.sum() > 100
        heights.append(np.flatnonzero(green[:, 230:300].any(axis=1)).min())  # the highest green row near the sensor
    assert heights[1] < heights[0] - 10


def test_dragging_moves_what_is_there_and_makes_nothing_anew(renderer):
    shown(renderer)
    before = renderer.built
    for field in (11.0, 12.0, 13.0):
        shown(renderer, field_deg=field, wavelength_nm=500.0 + field, sensor_shift_um=10 * field, f_number=4.0)
    assert renderer.built == before
    shown(renderer, lens="cooke_triplet")
    assert renderer.built > before


def test_the_scene_is_written_and_read_by_others(renderer, tmp_path):
    shown(renderer)
    renderer.save(str(tmp_path / "lens.gltf"))
    renderer.save(str(tmp_path / "lens.obj"))
    document = json.loads((tmp_path / "lens.gltf").read_text())
    assert document["asset"]["version"] == "2.0"
    assert (
        len(document["meshes"]) == 2 * len(scene_at().glass) + 5
    )  # with their edges, and stop, sensor, rays, wavefront, PSF
    corners = [line for line in (tmp_path / "lens.obj").read_text().splitlines() if line.startswith("v ")]
    assert len(corners) > 10_000
    with pytest.raises(P2SFError, match=r"\.stl.*gltf or \.obj"):
        renderer.save(str(tmp_path / "lens.stl"))


@pytest.mark.parametrize("room", [0, 20_000])
@pytest.mark.parametrize("ending", ["gltf", "obj"])
def test_a_scene_on_a_full_disk_is_a_sentence_and_the_old_one_stays(renderer, tmp_path, ending, room):
    shown(renderer)
    old = tmp_path / f"lens.{ending}"
    old.write_bytes(b"old")
    with small_disk(room), pytest.raises(P2SFError, match="cannot be written"):
        renderer.save(str(old))
    assert old.read_bytes() == b"old"
    assert {path.name for path in tmp_path.iterdir()} <= {old.name, "lens.mtl"}  # colours of no shape are no harm


@pytest.fixture
def panel(qtbot):
    made = SolidPanel(Store(FIRST))
    made.restyle(LIGHT)
    qtbot.addWidget(made.widget)
    made.widget.resize(400, 300)
    made.widget.show()
    yield made
    made.stop()


def answer(state=FIRST):
    made = live(state, "preview")
    return replace(made, views={"solid": scene(made)})


def test_where_opengl_is_missing_a_sentence_says_what_to_do(panel, qtbot, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    for name in ("__EGL_VENDOR_LIBRARY_FILENAMES", "LIBGL_DRIVERS_PATH"):
        monkeypatch.setenv(name, "/nowhere")
    panel.show(answer())
    assert panel.busy
    qtbot.waitUntil(lambda: panel.view.message_is_final)
    assert "libgl1-mesa-dri" in panel.view.accessibleDescription()
    assert panel.renderer is None and not panel.busy and not panel.save_button.isEnabled()


def test_the_panel_opens_turns_and_keeps_its_eye_in_the_state(panel, qtbot, tmp_path):
    panel.show(answer())
    qtbot.waitUntil(lambda: panel.renderer is not None)
    assert "W × 200" in panel.factors.text() and "PSF × 50" in panel.factors.text()
    qtbot.waitUntil(lambda: panel.view.image is not None)
    first, store = panel.view.image.copy(), panel.view._store
    panel.view.setFocus()
    qtbot.keyClick(panel.view, Qt.Key.Key_Left)
    assert store.state.camera.turn_deg == CAMERA.turn - 5
    qtbot.mousePress(panel.view, Qt.MouseButton.LeftButton, pos=QPoint(100, 100))
    qtbot.mouseMove(panel.view, QPoint(130, 120))
    qtbot.mouseRelease(panel.view, Qt.MouseButton.LeftButton, pos=QPoint(130, 120))
    assert store.state.camera.tilt_deg == pytest.approx(CAMERA.tilt + 8)
    panel.show(answer(store.state))
    qtbot.waitUntil(lambda: panel.view.image is not None)
    assert panel.view.image != first
    store.undo()
    store.undo()
    assert store.state == FIRST
    assert panel.save(str(tmp_path / "view.png"))
    assert (tmp_path / "view.png").stat().st_size > 5000
    assert not panel.save(str(tmp_path / "no" / "scene.obj"))
    before = (tmp_path / "view.png").read_bytes()
    with small_disk(2000):
        assert not panel.save(str(tmp_path / "view.png"))
    assert (tmp_path / "view.png").read_bytes() == before
