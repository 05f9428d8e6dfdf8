from PySide6.QtGui import QImage

from p2sf_explorer.site.gallery import SIZES, picture, sizes_of, states
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import new_state
from p2sf_explorer.state.workspaces import WORKSPACES


def test_every_panel_and_workspace_is_in_the_gallery_and_every_state_differs():
    shown = states()
    assert {state.display.stage for state in shown.values()} >= {entry.key for entry in REGISTRY}
    taken = {(state.display.workspace, state.display.theme): sizes_of(name) for name, state in reversed(shown.items())}
    for name in WORKSPACES:
        for theme in ("light", "dark"):
            assert taken[name, theme] == tuple(SIZES), name
    assert len(set(shown.values())) == len(shown)
    matrices = [state.matrix for state in shown.values() if state.display.stage == "matrix"]
    assert {view.what for view in matrices} == set(CHOICES["matrix_what"])
    assert {view.across for view in matrices} == set(CHOICES["matrix_across"])


def test_a_picture_has_the_size_asked_for_and_more_than_one_colour(only_window, tmp_path):
    picture(new_state(method="seidel", theme="dark"), (900, 640), tmp_path / "window.png", measured=False)
    image = QImage(str(tmp_path / "window.png"))
    assert image.width() >= 900 and image.height() >= 640  # a layout may insist on more room
    assert len({image.pixel(x, y) for x in range(0, 900, 5) for y in range(100, 640, 5)}) > 100
