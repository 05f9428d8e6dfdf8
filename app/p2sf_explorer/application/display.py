"""Whether a window can open here: asked first, since Qt would abort. No Qt in here."""

import os
import socket
import sys
from collections.abc import Iterator, Mapping
from ctypes import CDLL

from p2sf.messages import Message

NEEDS_NO_SCREEN = ("offscreen", "minimal", "vnc")
X_PORT = 6000  # display N of a machine answers on port 6000 + N (X Window System Protocol, appendix B)
PATIENCE_S = 2.0
NO_DISPLAY = Message("there is no display to open the window on; start it from a desktop session, or under xvfb-run")
NO_LIBRARY = Message("Qt needs the library libxcb-cursor to open a window on X11; run apt-get install libxcb-cursor0")
Address = str | tuple[str, int]


def display_problem(environment: Mapping[str, str] | None = None, platform: str | None = None) -> Message | None:
    """Return why there is no display to open a window on, None where there is one."""
    environment = os.environ if environment is None else environment
    platform = sys.platform if platform is None else platform
    if not platform.startswith(("linux", "freebsd")):
        return None
    if environment.get("QT_QPA_PLATFORM", "").split(":")[0] in NEEDS_NO_SCREEN or environment.get("WAYLAND_DISPLAY"):
        return None
    if environment.get("DISPLAY"):
        return _x_problem(environment["DISPLAY"])
    return NO_DISPLAY


def _x_problem(display: str) -> Message | None:
    """Return why Qt would abort on this X display: nobody answers there, or the library it loads is missing."""
    if not any(_answers(*place) for place in _sockets(display)):
        no_answer = "no display answers at DISPLAY={display}; start it from a desktop session, or under xvfb-run"
        return Message(no_answer, display=display)
    try:
        CDLL("libxcb-cursor.so.0")
    except OSError:
        return NO_LIBRARY
    return None


def _sockets(display: str) -> Iterator[tuple[socket.AddressFamily, Address]]:
    """Yield (family, address) where an X display such as ``:0``, ``unix:1.0`` or ``host:10`` may listen."""
    host, _, number = display.rpartition(":")
    number = number.split(".")[0]
    if not number.isdigit():
        return
    if host in ("", "unix"):
        name = f"/tmp/.X11-unix/X{number}"  # the same path on every X11 system
        yield socket.AF_UNIX, name
        yield socket.AF_UNIX, f"\0{name}"  # Linux also knows it by name alone, without a file
    else:
        yield socket.AF_INET, (host, X_PORT + int(number))


def _answers(family: socket.AddressFamily, address: Address) -> bool:
    with socket.socket(family) as probe:
        probe.settimeout(PATIENCE_S)
        try:
            probe.connect(address)
        except (OSError, OverflowError):
            return False
    return True
