"""Whether a person has asked the system for less motion. Qt has the setting on no system, up to 6.11."""

import subprocess
import sys

SECONDS = 0.5  # for the answer of a program
ASKED = {
    "darwin": (("defaults", "read", "com.apple.universalaccess", "reduceMotion"), "1"),
    "linux": (("gsettings", "get", "org.gnome.desktop.interface", "enable-animations"), "false"),
}
"""By system, a command that reads the setting, and what it prints where motion is to be reduced."""
GET_CLIENT_AREA_ANIMATION = 0x1042  # of SystemParametersInfoW, winuser.h


def reduced_motion() -> bool:
    """Return whether windows are to move nothing by themselves; False where the system does not say."""
    if sys.platform == "win32":  # written out, so that type checkers look for `windll` nowhere else
        import ctypes

        animated = ctypes.c_int(1)
        ctypes.windll.user32.SystemParametersInfoW(GET_CLIENT_AREA_ANIMATION, 0, ctypes.byref(animated), 0)
        return not animated.value
    if sys.platform not in ASKED:
        return False
    command, reduced = ASKED[sys.platform]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return run.stdout.strip() == reduced
