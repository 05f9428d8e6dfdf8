"""Reads the lens again when its file changes on disk."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QFileSystemWatcher, QObject, QTimer

from p2sf.messages import Message
from p2sf_explorer.compute.lens_files import is_file, stamp
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store

SETTLE_MS = 150  # an editor writes, renames and touches within some milliseconds; one reading is enough


class FileWatcher(QObject):
    """Watches the file of the present lens, and its folder, where an editor renames a new file into its place.

    ``read_again()`` shows the changed lens and returns whether it could be read.
    """

    def __init__(self, store: Store, read_again: Callable[[], bool], parent: QObject) -> None:
        super().__init__(parent)
        self._store, self._read_again = store, read_again
        self._path, self._stamp = "", (0, 0)
        self._watcher, self._settle = QFileSystemWatcher(self), QTimer(self, singleShot=True, interval=SETTLE_MS)
        self._watcher.fileChanged.connect(self._settle.start)
        self._watcher.directoryChanged.connect(self._settle.start)
        self._settle.timeout.connect(self._look)
        store.changed.connect(self.follow)
        self.follow(store.state)

    def follow(self, state: State) -> None:
        """Watch the file of this state's lens and no other."""
        if state.optics.lens == self._path:
            return
        watched = self._watcher.files() + self._watcher.directories()
        if watched:
            self._watcher.removePaths(watched)
        self._path, self._stamp = state.optics.lens, stamp(state.optics.lens)
        self._watch()

    def _watch(self) -> None:
        if is_file(self._path) and self._path not in self._watcher.files():
            self._watcher.addPaths([self._path, str(Path(self._path).parent)])

    def _look(self) -> None:
        self._watch()  # a file renamed into place is another file to the system
        found = stamp(self._path)
        if found == self._stamp or not is_file(self._path):
            return
        self._stamp = found
        name = Path(self._path).name
        if self._store.state.optics.lens_text is not None:
            kept = "{name} has changed on disk; your edits are kept, Back to file takes the new one"
            self._store.said.emit(Message(kept, name=name))
        elif self._read_again():
            self._store.said.emit(Message("{name} has changed on disk and was read again", name=name))
