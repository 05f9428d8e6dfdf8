"""The pictures kept beside README and handbook: ``python -m p2sf_explorer.site.handbook_pictures`` makes them anew.

Each carries in its text `SHOWN` a hash of what it shows: of a window its state and the names of the panels and controls
on view, of a plot its command and what that reads. ``--differing`` lists the pictures that no longer show that.
``price_of_a_default.png`` shows other programs too: `tests.benchmarks.image_simulation` draws it.
"""

import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

from PySide6.QtGui import QImage
from PySide6.QtWidgets import QAbstractButton, QAbstractSlider, QApplication, QComboBox, QLabel

from p2sf.cli import main as p2sf
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.writing import lens_to_toml
from p2sf.psf.methods import METHODS
from p2sf.studies.complete_trade import SHIPPED, shipped_trades
from p2sf.studies.trade_plots import draw_trades
from p2sf_explorer.handbook.pages import FOLDER
from p2sf_explorer.site.pictures import FIRST, WINDOW, shown_windows
from p2sf_explorer.state.state import State
from p2sf_explorer.state.state_files import state_to_json
from p2sf_explorer.window.window import MainWindow

PICTURES = FOLDER / "pictures"
SHOWN = "Shown"  # the key of the hash among a PNG's texts
WINDOWS = {"window.png": FIRST, "compare.png": WINDOW["window_compared.png"]}
LENS = "double_gauss_28"
PLOTS = {
    "tradeoff.png": ("tradeoff", LENS),
    "complete_trade.png": ("tradeoff", "--complete"),  # drawn from the figures that are kept, without the command
    "sampling.png": ("tradeoff", "--sampling"),
}


def of_window(window: MainWindow, state: State) -> str:
    """Return the hash of a window: its state, and the titles and the names of the controls on view."""
    kinds = QAbstractButton, QAbstractSlider, QComboBox, QLabel
    seen = {
        widget.accessibleName() or widget.objectName()
        for kind in kinds
        for widget in window.findChildren(kind)
        if widget.isVisible()
    }
    return _hash(state_to_json(state), *sorted(seen))


def of_plot(name: str) -> str:
    """Return the hash of a plot: its command, and what that reads."""
    read = SHIPPED.read_text(encoding="utf-8") if "--complete" in PLOTS[name] else lens_to_toml(find_lens(LENS))
    return _hash(*PLOTS[name], *(method.name for method in METHODS), read)


def _hash(*texts: str) -> str:
    return sha256("\0".join(texts).encode()).hexdigest()


def shown_hashes() -> Iterator[tuple[str, str]]:
    """Yield the name of each picture, and the hash of what it would show now."""
    yield from ((name, of_window(window, WINDOWS[name])) for name, window in shown_windows(WINDOWS))
    yield from ((name, of_plot(name)) for name in PLOTS)


def differing(folder: Path = PICTURES) -> list[str]:
    """Return the names of the pictures that show something else than would be shown now."""
    return [name for name, now in shown_hashes() if QImage(str(folder / name)).text(SHOWN) != now]


def write_all(folder: Path = PICTURES) -> None:
    """Make every picture anew, with the hash of what it shows."""
    for name, window in shown_windows(WINDOWS):
        _save(window.grab().toImage(), of_window(window, WINDOWS[name]), folder / name)
    for name, command in PLOTS.items():
        if "--complete" in command:
            with (folder / name).open("wb") as handle:
                draw_trades(handle, list(shipped_trades().values()))
        else:
            p2sf([*command, "-o", str(folder / name)])
        _save(QImage(str(folder / name)), of_plot(name), folder / name)


def _save(picture: QImage, shown: str, path: Path) -> None:
    picture.setText(SHOWN, shown)
    picture.save(str(path))
    print(path.name)


def main() -> None:
    """Make the pictures, or list those that differ."""
    parser = ArgumentParser(prog="python -m p2sf_explorer.site.handbook_pictures", description=main.__doc__)
    parser.add_argument("--differing", action="store_true", help="make none; list those that show what is no more")
    _application = QApplication.instance() or QApplication(sys.argv[:1])  # kept: without a reference it would end
    if not parser.parse_args().differing:
        return write_all()
    found = differing()
    return print("\n".join(found) or "all show what the window shows now")


if __name__ == "__main__":
    main()
