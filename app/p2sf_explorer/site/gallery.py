"""Pictures of the window, to look at after changing a panel: ``python -m p2sf_explorer.site.gallery FOLDER``."""

import sys
from argparse import ArgumentParser
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEventLoop, QSize, QTimer
from PySide6.QtWidgets import QApplication

from p2sf.messages import Message
from p2sf_explorer.charts.theme import screen_scale
from p2sf_explorer.compute.setup import first_state
from p2sf_explorer.i18n.language import ENGLISH, set_language
from p2sf_explorer.lessons.lesson import shipped_lessons
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import State, change, new_state
from p2sf_explorer.state.workspaces import TEACH, WORKSPACES, on_stage, with_workspace
from p2sf_explorer.window.window import MainWindow

SIZES = {"small": (1280, 800), "large": (1920, 1080), "wide": (2560, 1440), "wall": (3840, 2160)}
EVERY_SIZE, ONE_SIZE = "workspace_", "panel_"  # how the names of states begin that are shown in all sizes, or in one
USUAL = "small", "large"
THEMES = "light", "dark"
ACTIONS: dict[str, Callable[[MainWindow], object]] = {
    "stage_start": lambda window: window.show_start(),
    "stage_error": lambda window: window.refuse(Message("field 34° is beyond 14°, the largest; type a smaller one")),
    "stage_presented": lambda window: window.presentation.start(),
}
"""What is done in a window for the pictures of these names, which no state says."""
LONGEST_MS = 20_000  # for the background measurement of one picture
LOOK_MS = 50
IDLE_LOOKS = 8  # in a row: a panel waits a moment after it was resized before it asks for a finer picture


def states() -> dict[str, State]:
    """Return the states to show: every workspace in both themes, what else there is, and every panel on the stage."""
    panels = [entry.key for entry in REGISTRY if entry.key != State().display.stage]
    shown = {f"{EVERY_SIZE}{name}_{theme}": workspace(name, theme) for theme in THEMES for name in WORKSPACES}
    shown["close_up"] = new_state(lens="cooke_triplet", depth_mm=400.0, focus_mm=400.0, field_deg=14.0, theme="light")
    shown["eye"] = new_state(lens="eye_navarro", field_deg=15.0, wavelength_nm=543.0, phase="wrapped", theme="dark")
    shown["surface"] = new_state(phase="surface", theme="dark")
    shown["what_if"] = new_state(theme="light", added_waves=(0.0, 1.5, 0.0, 0.0, -2.0, 0.0), muted=("w22",))
    shown["free_pupil"] = new_state(
        theme="dark", added_waves=(0.0, 3.0, 0.0, 0.0, 0.0, 0.0), free_pupil=True, tab="mtf"
    )
    pair = new_state(theme="light", pinned=new_state(f_number=8.0), linked=("field_deg",), playback_slider="field_deg")
    for side in CHOICES["shown"]:
        shown[f"compare_{side}"] = change(pair, shown=side)
    coma = next(lesson for lesson in shipped_lessons() if lesson.name == "05_coma")
    shown["lesson"] = change(coma.state(1, new_state(theme="light")), lesson_told=True)
    shown["german"] = new_state(theme="light", language="de", tab="first_order")
    first = new_state(theme="light")
    return (
        shown
        | stages()
        | matrices()
        | {f"{ONE_SIZE}{key}": change(first, **on_stage(first.display, key)) for key in panels}
    )


def stages() -> dict[str, State]:
    """Return what stands on the stage and over its edge beside the usual: in a lens that shows coma, dark."""
    first = new_state(lens="cooke_triplet", field_deg=14.0, theme="dark")
    pair = change(first, pinned=change(first, f_number=8.0))
    return {
        "stage_start": first,
        "stage_error": change(first, theme="light"),
        "stage_presented": change(first, field_deg=20.0),
        "stage_full_bleed": change(first, full_bleed=True),
        "stage_both": change(pair, shown="both"),
        "stage_played": change(pair, shown="difference", playback_slider="field_deg"),
        "stage_through_focus": change(first, **on_stage(first.display, "through_focus"), rail_side="right"),
        "stage_field_map": change(first, **on_stage(first.display, "field_map")),
        "stage_performance": change(first, **on_stage(first.display, "performance"), theme="light"),
        "stage_five_fields": change(first, **on_stage(first.display, "curves"), curves_count=5),
    }


def workspace(name: str, theme: str) -> State:
    """Return what the window shows at its first start in a workspace; that of teaching with the first lesson."""
    first = change(first_state(), theme=theme)
    return shipped_lessons()[0].state(0, first) if name == TEACH else with_workspace(first, name, WORKSPACES[name])


def matrices() -> dict[str, State]:
    """Return a matrix of every kind, and one over every quantity."""
    first = with_workspace(new_state(pinned=new_state(f_number=8.0)), "inspect", WORKSPACES["inspect"])
    kinds = {f"matrix_{what}": change(first, matrix_what=what, theme="light") for what in CHOICES["matrix_what"]}
    over = {name: name.partition("_")[0] for name in CHOICES["matrix_across"][1:]}
    return kinds | {
        f"matrix_over_{words}": change(first, matrix_across=name, theme="dark") for name, words in over.items()
    }


def settle(window: MainWindow) -> None:
    """Let the window paint, and its background measurement end."""
    loop, looking, longest = QEventLoop(), QTimer(), QTimer()
    idle = 0

    def look() -> None:
        nonlocal idle
        idle = 0 if window.is_busy() else idle + 1
        if idle == IDLE_LOOKS:
            loop.quit()

    looking.timeout.connect(look)
    longest.setSingleShot(True)
    longest.timeout.connect(loop.quit)
    looking.start(LOOK_MS)
    longest.start(LONGEST_MS)
    loop.exec()


def picture(
    state: State,
    size: tuple[int, int],
    path: Path,
    measured: bool = True,
    act: Callable[[MainWindow], object] | None = None,
) -> None:
    """Save a picture of the window in a state, as on a screen of this size, its accuracy ``measured`` or not.

    ``act`` does something in the window before.
    """
    state = change(state, scale_percent=100 * screen_scale(QSize(*size)))
    set_language(
        ENGLISH if state.display.language == "system" else state.display.language
    )  # the same pictures on every machine
    window = MainWindow(state, measured)
    window.resize(*size)
    window.show()
    if act:
        settle(window)
        act(window)
        window.resize(*size)
    settle(window)
    window.grab().save(str(path))
    window.close()


def sizes_of(name: str) -> tuple[str, ...]:
    """Return the sizes in which a state is shown."""
    return tuple(SIZES) if name.startswith(EVERY_SIZE) else USUAL[:1] if name.startswith(ONE_SIZE) else USUAL


def main() -> None:
    """Write every picture, or those of some names and sizes, into the folder named on the command line."""
    parser = ArgumentParser(prog="python -m p2sf_explorer.site.gallery", description="Take pictures of the window.")
    parser.add_argument("folder", type=Path, help="where the pictures go")
    parser.add_argument("--names", nargs="*", default=[""], help="beginnings of the names of states")
    parser.add_argument("--sizes", nargs="*", choices=tuple(SIZES), default=list(SIZES), help="sizes of the window")
    options = parser.parse_args()
    folder: Path = options.folder
    folder.mkdir(parents=True, exist_ok=True)
    _application = QApplication.instance() or QApplication(sys.argv[:1])  # kept: without a reference it would end
    QApplication.setStyle("Fusion")
    for name, state in states().items():
        for size, pixels in SIZES.items():
            if size in sizes_of(name) and size in options.sizes and name.startswith(tuple(options.names)):
                picture(state, pixels, folder / f"{name}_{size}.png", act=ACTIONS.get(name))
                print(folder / f"{name}_{size}.png")


if __name__ == "__main__":
    main()
