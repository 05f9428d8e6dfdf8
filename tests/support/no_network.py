"""A process that the kernel ends when it opens a socket of the internet, and a window in which everything is used."""

import ctypes
import platform
import struct
from pathlib import Path
from time import monotonic, sleep

AF_INET, AF_INET6 = 2, 10
NO_NEW_PRIVILEGES, SECCOMP, FILTER = 38, 22, 2  # of prctl(2)
ALLOW, END = 0x7FFF0000, 0x80000000  # seccomp(2): SECCOMP_RET_ALLOW, SECCOMP_RET_KILL_PROCESS
LOAD, EQUAL, RETURN = 0x20, 0x15, 0x06  # of a classic BPF program, <linux/bpf_common.h>
SOCKET = {"x86_64": 41, "aarch64": 198}[platform.machine()]  # the number of the system call
NUMBER, FIRST_ARGUMENT = 0, 16  # bytes into struct seccomp_data
A_WHILE_S = 0.5  # of background work, which goes on to the window's end


def forbid_network() -> None:
    """Have the kernel end this process, its threads and its children by SIGSYS at socket(AF_INET or AF_INET6, …)."""
    steps = (
        (LOAD, 0, 0, NUMBER),
        (EQUAL, 0, 3, SOCKET),
        (LOAD, 0, 0, FIRST_ARGUMENT),
        (EQUAL, 2, 0, AF_INET),
        (EQUAL, 1, 0, AF_INET6),
        (RETURN, 0, 0, ALLOW),
        (RETURN, 0, 0, END),
    )
    program = b"".join(struct.pack("HBBI", *step) for step in steps)
    kept = ctypes.create_string_buffer(program, len(program))
    header = struct.pack("HxxxxxxP", len(steps), ctypes.addressof(kept))
    libc = ctypes.CDLL(None, use_errno=True)
    for call in ((NO_NEW_PRIVILEGES, 1, 0, 0, 0), (SECCOMP, FILTER, header, 0, 0)):
        if libc.prctl(*call):
            raise OSError(ctypes.get_errno(), "prctl")


def use_everything(folder: str) -> None:
    """Open a window and in it every panel, the handbook, a lesson, the lenses, the palette; save what can be saved."""
    from PySide6.QtWidgets import QApplication

    from p2sf_explorer.files import recent
    from p2sf_explorer.files.session_keeper import RunMark, SessionKeeper
    from p2sf_explorer.state.panels import REGISTRY
    from p2sf_explorer.state.state import new_state
    from p2sf_explorer.window.window import MainWindow

    recent.recent_path = lambda: Path(folder) / "recent.json"
    application = QApplication([])
    mark = RunMark()
    mark.begin()
    window = MainWindow(new_state(method="seidel"), measured=False)
    SessionKeeper(window, window.store, lambda: window.floating.open, {})
    window.show()
    for entry in REGISTRY:
        window.open_panel(entry.key)
        application.processEvents()
    window.teaching.toggle()
    window.commands.theory()
    window.commands.find()
    window.commands.help()
    window.top.lens.open_gallery()
    solid, until = window.panels["solid"], monotonic() + A_WHILE_S
    while solid.busy or (window.is_busy() and monotonic() < until):
        application.processEvents()
        sleep(0.01)
    for name in ("psf.npz", "window.png", "state.json"):
        assert window.commands.save(str(Path(folder) / name))
    window.close()
    mark.end()
