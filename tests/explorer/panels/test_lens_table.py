"""The lens table under a person's hands: typing, stop, surfaces, undo, files."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QFileDialog, QLineEdit

from p2sf.errors import GeometryError, GlassError
from p2sf.lens.lens import with_sensor
from p2sf.lensfile.library import load_lens
from p2sf.lensfile.toml.lens import write_toml
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import f_number
from p2sf.paraxial.seidel import coefficients
from p2sf_explorer.compute.editing import delete_surface, edited_state, insert_surface, with_stop, with_value
from p2sf_explorer.compute.setup import load, paraxial_setup, prescription
from p2sf_explorer.panels.lens_table.surface_table import KEYS
from p2sf_explorer.state.state import State, new_state
from p2sf_explorer.state.state_files import state_from_json, state_to_json
from tests.explorer.window.test_window import changed, pictures
from tests.support.lenses.shaped_lenses import ODD, PHASE, singlet

LENS = "double_gauss_28"


def speed_of(window) -> float:
    setup = window.live.setup
    return float(f_number(setup.lens, setup.lens.reference_wavelength_um, setup.stop))


def editor_of(table) -> QLineEdit:
    """Return the open editor; earlier ones may still wait for their deletion."""
    return next(editor for editor in table.view.findChildren(QLineEdit) if editor.isVisible())


@pytest.fixture
def table(window):
    window.open_panel("lens")
    return window.panels["lens"]


@pytest.fixture
def typed(table, qtbot):
    """Return a function that double-clicks a cell and types into it."""

    def fill(row: int, key: str, text: str, end=Qt.Key.Key_Return) -> None:
        index = table.model.index(row, KEYS.index(key))
        table.view.scrollTo(index)
        place = table.view.visualRect(index).center()
        for press in (qtbot.mouseClick, qtbot.mouseDClick):
            press(table.view.viewport(), Qt.MouseButton.LeftButton, pos=place)
        editor = editor_of(table)
        editor.selectAll()
        if text.isascii():
            qtbot.keyClicks(editor, text)
        else:  # QTest has no keys for ∞ and −; they arrive as a paste does
            editor.insert(text)
        qtbot.keyClick(editor, end)
        QApplication.processEvents()

    return fill


def test_the_headings_carry_units_and_the_rows_the_prescription(table):
    heads = [table.model.headerData(k, Qt.Orientation.Horizontal) for k in range(table.model.columnCount())]
    assert heads[:6] == [
        "Radius, mm", "Thickness, mm", "Glass or index", "Semi-diameter, mm", "Conic K", "Stop",
    ]  # fmt: skip
    shown = [table.model.data(table.model.index(0, k)) for k in range(6)]
    assert shown == ["56.20238", "8.75", "SCHOTT N-SSK2", "31.104097", "0", "○"]
    assert table.model.data(table.model.index(5, 5)) == "●"


def wait_for_pictures(window, qtbot) -> None:
    """Wait for every picture, the PSF also that for the panel's size, which is asked for a while after a change."""
    qtbot.waitUntil(lambda: not (window.is_busy() or window.panels["psf"]._settled.isActive()))


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("radius", "57,5", 57.5),
        ("thickness", "0.91 cm", pytest.approx(9.1, rel=1e-15)),
        ("semi_diameter", "∞", inf),
        ("conic", "−0.3", -0.3),
        ("aspheric", "1e-6 −2e-9", (1e-6, -2e-9)),
    ],
)
def test_a_typed_value_is_one_undo_and_moves_every_panel(window, typed, qtbot, key, text, value):
    wait_for_pictures(window, qtbot)
    first, before = window.store.state, pictures(window)
    typed(0, key, text)
    assert getattr(prescription(window.store.state).surfaces[0], key) == value
    assert window.top.edited.isVisible()
    if key != "semi_diameter":
        assert {"pupil", "psf", "coefficients"} <= changed(before, pictures(window))
    window.store.undo()
    assert window.store.state == first
    assert not window.top.edited.isVisible()
    wait_for_pictures(window, qtbot)
    assert not changed(before, pictures(window))


@pytest.mark.parametrize("glass", ["SCHOTT N-BK7", "1.6", "nd 1.62 vd 36.4", "N-BK7"])
def test_a_typed_glass_is_live(window, typed, glass):
    before = float(window.live.setup.coefficients.w40)
    typed(0, "medium", glass)
    assert float(window.live.setup.coefficients.w40) != before


@pytest.mark.slow
@pytest.mark.parametrize(
    ("row", "key", "text", "words"),
    [
        (0, "radius", "0", "surface 1: radius 0"),
        (0, "radius", "round", "surface 1"),
        (2, "medium", "SCHOTT N-SK222", "surface 3: glass"),
        (1, "semi_diameter", "-3", "surface 2: semi-diameter"),
        (4, "thickness", "∞", "surface 5"),
    ],
)
def test_a_bad_value_is_a_sentence_and_the_old_one_stays(window, qtbot, table, typed, row, key, text, words):
    qtbot.wait(500)  # the frame of the PSF follows once nothing moves
    state, before = window.store.state, pictures(window)
    old = table.model.data(table.model.index(row, KEYS.index(key)))
    typed(row, key, text)
    assert window.banner.isVisible()
    assert words.lower() in window.banner.text.text().lower()
    assert window.store.state == state
    assert table.model.data(table.model.index(row, KEYS.index(key))) == old
    assert not changed(before, pictures(window))


def test_escape_leaves_the_value(window, typed):
    state = window.store.state
    typed(0, "radius", "99", Qt.Key.Key_Escape)
    assert window.store.state == state


def test_keys_alone_edit_a_cell(window, table, qtbot):
    table.view.setCurrentIndex(table.model.index(0, 0))
    table.view.setFocus()
    qtbot.keyClick(table.view, Qt.Key.Key_Down)
    qtbot.keyClick(table.view, Qt.Key.Key_F2)
    editor = editor_of(table)
    editor.selectAll()
    qtbot.keyClicks(editor, "150")
    qtbot.keyClick(editor, Qt.Key.Key_Return)
    QApplication.processEvents()  # a delegate hands its text over from the event loop
    assert prescription(window.store.state).surfaces[1].radius == 150


def test_clicking_the_stop_column_moves_the_stop_and_keeps_the_f_number(window, table, qtbot):
    index = table.model.index(3, KEYS.index("stop"))
    table.view.scrollTo(index)
    speed = speed_of(window)
    qtbot.mouseClick(table.view.viewport(), Qt.MouseButton.LeftButton, pos=table.view.visualRect(index).center())
    assert int(window.live.setup.stop.surface) == 4
    assert speed_of(window) == pytest.approx(speed, rel=1e-12)  # one division and its inverse


def test_insert_and_delete_from_the_keyboard_give_the_first_lens_back(window, table, qtbot):
    first = window.store.state
    table.view.setCurrentIndex(table.model.index(1, 0))
    table.view.setFocus()
    qtbot.keyClick(table.view, Qt.Key.Key_Insert)
    assert table.model.rowCount() == 12
    assert table.view.currentIndex().row() == 2
    qtbot.keyClick(table.view, Qt.Key.Key_Delete)
    assert window.store.state == first  # an edit taken back by hand leaves no mark


@pytest.mark.parametrize("number", range(1, 12))
def test_an_inserted_plane_changes_no_coefficient(number):
    lens = load(LENS)
    before, after = (coefficients(x, inf, 0.2, 0.5876) for x in (lens, insert_surface(lens, number)))
    for name in ("w40", "w31", "w22", "w20", "w11", "wd"):
        # sums of a hundred waves of either sign, in another order
        assert float(getattr(after, name)) == pytest.approx(float(getattr(before, name)), abs=1e-9)
    assert delete_surface(insert_surface(lens, number), number + 1) == lens


def test_where_a_surface_is_deleted_all_others_stay():
    lens = load(LENS)
    for number in set(range(1, len(lens.surfaces) + 1)) - {lens.stop_surface}:
        left = delete_surface(lens, number)
        stayed = np.delete(np.asarray(lens.vertices), number - 1)
        assert np.diff(left.vertices) == pytest.approx(np.diff(stayed), abs=1e-12)
        assert (
            left.surfaces[left.stop_surface - 1] == lens.surfaces[lens.stop_surface - 1]
            or number == lens.stop_surface + 1
        )


def test_what_cannot_be_deleted_is_a_sentence():
    with pytest.raises(GeometryError, match="surface 6 is the stop"):
        delete_surface(load(LENS), 6)
    with pytest.raises(GeometryError, match="at least one surface"):
        delete_surface(replace(load(LENS), surfaces=load(LENS).surfaces[:1], stop_surface=None), 1)


def test_the_rim_of_the_stop_is_the_aperture():
    lens = with_value(load(LENS), 6, "semi_diameter", "8")
    assert lens.aperture.value == lens.surfaces[5].semi_diameter == 8.0


def test_a_stop_moved_and_back_keeps_its_rim():
    lens = load(LENS)
    assert with_stop(with_stop(lens, 3), 6).aperture.value == pytest.approx(lens.aperture.value, rel=1e-12)


def test_a_glass_without_this_wavelength_is_refused():
    state = new_state(wavelength_nm=2200.0, lens="plano_convex")
    with pytest.raises(GlassError, match="2200 nm"):
        edited_state(state, with_value(load("plano_convex"), 1, "medium", "nd 1.5 vd 60"))


@pytest.mark.slow
def test_100_edits_undone_give_bit_identical_states_and_pictures(window):
    chance, first = np.random.default_rng(1), window.store.state
    visited = [first]
    for radius in chance.uniform(54, 58, 100):
        lens = with_value(prescription(window.store.state), 1, "radius", repr(float(radius)))
        window.store.replace(edited_state(window.store.state, lens))
        visited.append(window.store.state)
    last = window.live.psf.values.copy()
    for state in reversed(visited[:-1]):
        window.store.undo()
        assert window.store.state == state
    assert window.store.state is first
    for _ in range(100):
        window.store.redo()
    assert np.array_equal(window.live.psf.values, last)


def test_the_edited_lens_goes_through_a_state_file():
    state = State()
    made = edited_state(state, with_value(load(LENS), 1, "radius", "57"))
    again = state_from_json(state_to_json(made))
    assert again == made
    assert prescription(again).surfaces[0].radius == 57
    assert paraxial_setup(again).coefficients.w40 == paraxial_setup(made).coefficients.w40


@pytest.mark.parametrize("ending", [".toml", ".zmx", ".json"])
def test_save_as_writes_the_edited_lens(window, table, typed, qtbot, tmp_path, monkeypatch, ending):
    typed(0, "radius", "57")
    path = tmp_path / f"mine{ending}"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), f"(*{ending})"))
    qtbot.mouseClick(table.buttons["_save"], Qt.MouseButton.LeftButton)
    assert load_lens(path).surfaces[0].radius == pytest.approx(57, rel=1e-12)  # .zmx holds the curvature
    assert window.top.edited.isVisible() == (ending != ".toml")
    assert (window.store.state.optics.lens == str(path)) == (ending == ".toml")


def test_back_to_file_drops_the_edits(window, table, typed, qtbot):
    typed(0, "radius", "57")
    qtbot.mouseClick(table.buttons["_revert"], Qt.MouseButton.LeftButton)
    assert window.store.state.optics.lens_text is None
    assert not table.buttons["_revert"].isEnabled()


SHAPED = singlet({"shape": ODD, "aspheric": (1e-7,)}, {"diffraction": PHASE})


def test_shapes_and_diffraction_are_named_and_kept_while_their_terms_are_edited(window, typed, tmp_path):
    """The cell of the terms says what is added to them, its tip with the numbers; typing leaves that alone."""
    window.commands.open_path(str(saved(SHAPED, tmp_path)))
    window.open_panel("lens")
    model = window.panels["lens"].model
    column = KEYS.index("aspheric")
    cells = [model.data(model.index(row, column)) for row in range(3)]
    assert cells == ["", "1e−07  + Odd asphere", "Diffractive"]
    tips = [model.data(model.index(row, column), Qt.ItemDataRole.ToolTipRole) for row in range(3)]
    assert "3e−05" in tips[1] and "order 1" in tips[2] and "−2500" in tips[2] and "phase" not in tips[0]
    assert model.data(model.index(1, column), Qt.ItemDataRole.EditRole) == "1e-07"
    typed(1, "aspheric", "2e-7")
    edited = prescription(window.store.state).surfaces[1]
    assert edited.aspheric == (2e-7,) and edited.shape == ODD
    typed(1, "radius", "45")
    assert prescription(window.store.state).surfaces[1].shape == ODD


def test_a_lens_without_seidel_sums_has_a_picture_and_says_so_beside_its_coefficients(window, tmp_path):
    window.commands.open_path(str(saved(SHAPED, tmp_path)))
    window.store.update(method="seidel")
    assert "Surface 2 has a term in r³" in window.panels["psf"].widget.overlay.text
    window.store.update(method="auto")
    assert window.live.method in ("fitted", "traced") and window.live.psf.values.max() > 0
    window.open_panel("coefficients")
    assert "Surface 2 has a term in r³" in window.panels["coefficients"].widget.overlay.text
    window.store.update(free_pupil=True, added_waves=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert window.live.psf.method == "seidel" and not window.panels["coefficients"].widget.overlay.text


def saved(lens, folder):
    """Return the path of a lens file, its sensor in focus."""
    focused = with_sensor(lens, float(image_distance(lens, inf, lens.reference_wavelength_um)))
    write_toml(focused, folder / "shaped.toml")
    return folder / "shaped.toml"
