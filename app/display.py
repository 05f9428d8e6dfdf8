"""Whether a window can open here, asked before Qt would abort. No Qt in here."""

import os
import sys

NEEDS_NO_SCREEN = ("offscreen", "minimal", "vnc")


def display_problem(environment=None, platform: str | None = None) -> str | None:
    """Return a sentence when there is no display to open a window on, else None."""
    environment = os.environ if environment is None else environment
    platform = sys.platform if platform is None else platform
    if not platform.startswith(("linux", "freebsd")):
        return None
    if environment.get("QT_QPA_PLATFORM", "").split(":")[0] in NEEDS_NO_SCREEN:
        return None
    if environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"):
        return None
    return "there is no display to open the window on; start it from a desktop session, or under xvfb-run"
