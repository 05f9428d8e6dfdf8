"""Ask for the name of a file to write."""

import os
import re
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from p2sf_explorer.i18n.tr import tr

ENDING = re.compile(r"\*(\.\w+)")


def ask_path(parent: QWidget, title: str, first: str, kinds: str) -> str:
    """Return the path of the file that a person wants written, "" for none; ``first`` is offered.

    All texts are translated. A name without an ending gets that of the kind that was chosen. Qt asks before it
    replaces the file of the name that was typed, but knows nothing of the ending: for the whole name this asks.
    """
    path, chosen = QFileDialog.getSaveFileName(parent, title, first, kinds)
    ending = ENDING.search(chosen) or ENDING.search(kinds)
    if not path or Path(path).suffix or ending is None:
        return path
    named = path + ending[1]
    return "" if os.path.lexists(named) and not _may_replace(parent, title, named) else named


def _may_replace(parent: QWidget, title: str, path: str) -> bool:
    words = tr("{name} is there already. Replace it?", name=Path(path).name)
    box = QMessageBox(QMessageBox.Icon.Warning, title, words, parent=parent)
    replace = box.addButton(tr("Replace"), QMessageBox.ButtonRole.DestructiveRole)
    box.setDefaultButton(box.addButton(tr("Cancel"), QMessageBox.ButtonRole.RejectRole))
    box.exec()
    return box.clickedButton() is replace
