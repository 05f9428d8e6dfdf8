"""Reads the lens again when its file changes on disk."""

from pathlib import Path

from PySide6.QtCore import QFileSystemWatcher, QObject, QTimer

from p2sf_explorer.files.opening import is_file, stamp

SETTLE_MS = 150  # an editor writes, renames and touches within some milliseconds; one reading is enough


class Watching(QObject):
    """Watches the file of the present lens, and its folder, where an editor renames a new file into its place."""

    def __init__(self, window):
        super().__init__(window)
        self._window = window
        self._path, self._stamp = "", (0, 0)
        self._watcher, self._settle = QFileSystemWatcher(self), QTimer(self, singleShot=True, interval=SETTLE_MS)
        self._watcher.fileChanged.connect(self._settle.start)
        self._watcher.directoryChanged.connect(self._settle.start)
        self._settle.timeout.connect(self._look)
        window.store.changed.connect(self.follow)
        self.follow(window.store.state)

    def follow(self, state) -> None:
        """Watch the file of this state's lens and no other."""
        if state.lens == self._path:
            return
        watched = self._watcher.files() + self._watcher.directories()
        if watched:
            self._watcher.removePaths(watched)
        self._path, self._stamp = state.lens, stamp(state.lens)
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
        store, name = self._window.store, Path(self._path).name
        if store.state.lens_text is not None:
            store.said.emit(f"{name} has changed on disk; your edits are kept, Back to file takes the new one")
            return
        self._window.refresh(store.state)
        if not self._window.banner.isVisible():
            store.said.emit(f"{name} has changed on disk and was read again")
