"""The window by real mouse and keys from a fresh profile: ``python -m tests.long.walks FOLDER [--size 1280x800]``.

Under Xvfb, by xdotool: a professor before a lecture, a camera engineer, a student and a designer begin at the start
screen. An action is one combination of keys, one text typed and entered, or one click. Printed are the actions of each
task and the seconds until the screen has stood still; FOLDER gets a picture after every task, to be looked at.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageGrab

HERE = Path(__file__).parents[2]
DISPLAY = ":131"
LOOK_S, STILL, LONGEST_S = 0.25, 4, 60.0  # between looks, equal looks in a row, and for how long at most
DIFFERENT = 40  # pixels that differ, beyond a blinking cursor

Action = tuple[str, str]
"""A kind ("keys", "typed" or "click") and the keys, the text (entered), or the place as parts of width and height."""


@dataclass(frozen=True)
class Walk:
    """The tasks of a person by their names, with what each of them does."""

    who: str
    tasks: tuple[tuple[str, tuple[Action, ...]], ...]


def keys(*names: str) -> tuple[Action, ...]:
    """Return combinations of keys, one action each."""
    return tuple(("keys", name) for name in names)


def found(words: str) -> tuple[Action, ...]:
    """Return a command that is found by its words."""
    return ("keys", "ctrl+k"), ("typed", words)


START = "leave the start screen", keys("Escape")
WALKS = (
    Walk(
        "professor",
        (
            START,
            ("A beside B", keys("ctrl+alt+b")),
            ("B away", keys("ctrl+b")),
            ("present", keys("F5")),
            ("end presenting", keys("F5")),
            ("list of lessons", keys("shift+F3")),
            ("a lesson by its words", (("typed", "coma"),)),
            ("its next step", keys("alt+Right")),
            ("leave it", keys("F3")),
            ("a lesson of the screen", (*found("make a lesson"), ("typed", "My star"))),
        ),
    ),
    Walk(
        "engineer",
        (
            START,
            ("MTF of five fields", found("overlays")),
            ("on the stage", (("keys", "4"),)),
            ("performance", found("performance")),
            ("report", (*keys("ctrl+p"), ("typed", "{folder}/report.pdf"))),
            ("a field out of range", (("click", "0.19 0.178"), ("typed", "95"))),
            ("a lens file", (*keys("ctrl+o"), ("typed", "{lenses}/tessar.toml"))),
        ),
    ),
    Walk(
        "student",
        (
            START,
            ("first lesson", keys("F3")),
            ("its next step", keys("alt+Right")),
            ("its answer", keys("alt+Down")),
            ("leave it", keys("F3")),
            ("mute astigmatism", (("click", "0.963 0.492"),)),
            ("play the field", (("click", "0.1 0.206"), ("keys", "space"))),
            ("pause", keys("ctrl+space")),
        ),
    ),
    Walk(
        "designer",
        (
            START,
            ("dark", found("theme dark")),
            ("light", found("theme light")),
            ("picture to the edges", keys("shift+F10")),
            ("Inspect", keys("ctrl+2")),
            ("Lens", keys("ctrl+3")),
            ("Image", keys("ctrl+4")),
            ("German", found("deutsch")),
        ),
    ),
)


class Screen:
    """A screen without a person, on which one window is open."""

    def __init__(self, size: tuple[int, int], window: str) -> None:
        self.size, self.window = size, window

    def xdotool(self, *arguments: str) -> str:
        """Run xdotool on the screen, and return what it says."""
        run = subprocess.run(["xdotool", *arguments], env=ON_SCREEN, capture_output=True, text=True, check=False)
        return run.stdout.strip()

    def act(self, action: Action) -> None:
        """Do what a hand does."""
        kind, what = action
        if kind == "keys":
            self.xdotool("windowfocus", self.window, "key", what)
        elif kind == "typed":
            time.sleep(0.6)  # a dialog opens, to which no window manager gives the keys
            latest = max(map(int, self.xdotool("search", "--onlyvisible", "--name", ".").split()))
            self.xdotool("windowfocus", str(latest))
            self.xdotool("key", "ctrl+a")
            self.xdotool("type", "--delay", "15", what)
            self.xdotool("key", "Return")
        else:
            x, y = (round(float(part) * side) for part, side in zip(what.split(), self.size, strict=True))
            self.xdotool("mousemove", str(x), str(y), "click", "1")
        time.sleep(LOOK_S)

    def picture(self) -> Image.Image:
        """Return what is on screen."""
        return ImageGrab.grab(xdisplay=DISPLAY)

    def still(self) -> float:
        """Wait until the screen stands still; return the seconds until its last change."""
        begun = changed = time.perf_counter()
        seen, looks = np.asarray(self.picture()), 0
        while looks < STILL and time.perf_counter() < begun + LONGEST_S:
            time.sleep(LOOK_S)
            now = np.asarray(self.picture())
            looks = looks + 1 if np.any(now != seen, axis=-1).sum() <= DIFFERENT else 0
            changed = changed if looks else time.perf_counter()
            seen = now
        return changed - begun


ON_SCREEN = os.environ | {"DISPLAY": DISPLAY}


@contextmanager
def opened(size: tuple[int, int], checkout: Path) -> Iterator[Screen]:
    """Open the explorer of a checkout from a fresh profile on a screen of a size."""
    screen = subprocess.Popen(["Xvfb", DISPLAY, "-screen", "0", f"{size[0]}x{size[1]}x24"], stderr=subprocess.DEVNULL)
    time.sleep(1.5)
    with tempfile.TemporaryDirectory() as home:
        paths = os.pathsep.join(map(str, (checkout, checkout / "app")))
        own = {f"XDG_{name}_HOME": f"{home}/{name}" for name in ("DATA", "CONFIG", "CACHE", "STATE")}
        environment = ON_SCREEN | own | {"HOME": home, "PYTHONPATH": paths, "QT_QPA_PLATFORM": "xcb", "LANG": "C.UTF-8"}
        program = subprocess.Popen([sys.executable, "-m", "p2sf", "explore"], env=environment, cwd=home)
        try:
            seen = Screen(size, "")
            until = time.monotonic() + LONGEST_S
            while not seen.window and time.monotonic() < until:
                time.sleep(LOOK_S)
                seen.window = seen.xdotool("search", "--onlyvisible", "--name", "P2SF Explorer").partition("\n")[0]
            seen.xdotool("windowmove", seen.window, "0", "0", "windowsize", seen.window, *map(str, size))
            seen.xdotool("windowfocus", seen.window)
            seen.still()
            yield seen
        finally:
            program.terminate()
            program.wait()
            screen.terminate()
            screen.wait()


def walk(walk: Walk, size: tuple[int, int], folder: Path, checkout: Path = HERE) -> None:
    """Print the actions and seconds of each task of a walk, and save what is on screen after it."""
    with opened(size, checkout) as screen:
        screen.picture().save(folder / f"{walk.who}_00_first.png")
        for number, (task, actions) in enumerate(walk.tasks, 1):
            for action in actions:
                words = action[1].replace("{folder}", str(folder)).replace("{lenses}", str(checkout / "lenses"))
                screen.act((action[0], words))
            seconds = screen.still()
            screen.picture().save(folder / f"{walk.who}_{number:02}_{task.replace(' ', '_')}.png")
            print(f"{walk.who:10} {task:24} {len(actions)} actions, {seconds:5.1f} s", flush=True)


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the pictures go")
    parser.add_argument("--size", default="1280x800")
    parser.add_argument("--who", nargs="*", default=[walk.who for walk in WALKS])
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    size = tuple(int(side) for side in options.size.split("x"))
    for one in WALKS:
        if one.who in options.who:
            walk(one, (size[0], size[1]), options.folder.resolve())


if __name__ == "__main__":
    main()
