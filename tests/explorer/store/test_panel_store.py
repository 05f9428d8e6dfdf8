"""What is on screen is what a panel changes, or nothing is."""

import pytest

from p2sf.errors import GeometryError
from p2sf_explorer.compute.editing import check_surface
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.state.state import new_state


def test_b_on_screen_is_not_edited_and_a_row_too_many_is_a_sentence(window):
    """B has more surfaces than A, and a lens without a picture leaves the table of the last one."""
    window.store.update(lens="double_gauss_28", pinned=new_state(lens="wide_angle_35", theme="light"), shown="b")
    window.open_panel("lens")
    model = window.panels["lens"].model
    last = model.index(model.rowCount() - 1, 1)
    state = window.store.state
    assert model.rowCount() > len(prescription(state).surfaces)
    model.setData(last, "5")
    assert window.store.state == state and "B is on screen" in window.banner.text.text()
    window.store.update(shown="a")
    for number in (0, len(prescription(state).surfaces) + 1):
        with pytest.raises(GeometryError, match=f"there is no surface {number} in a lens of"):
            check_surface(prescription(state), number)
    window.panels["lens"]._on_typed(99, "radius", "5")
    assert "no surface 99" in window.banner.text.text()
