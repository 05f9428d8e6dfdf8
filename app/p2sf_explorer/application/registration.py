"""``p2sf-explorer --register``: a menu entry, ``p2sf:`` links and *Open with* for lens files. No Qt in here.

On macOS the bundle's Info.plist says all that. For Linux these are the freedesktop.org files of menu entries, icons and
MIME types, in the person's own folders, so that no administrator is needed and `unregister` undoes it.
"""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from shutil import copyfile, which
from urllib.parse import unquote, urlparse

from p2sf.errors import P2SFError

NAME, SCHEME = "p2sf-explorer", "p2sf"
ICON = Path(__file__).with_name("icon.png")
SIZE = "256x256"
LENS_TYPE = "application/x-p2sf-lens"
TYPES = (
    f"x-scheme-handler/{SCHEME}",
    LENS_TYPE,
    "application/toml",
    "application/json",
    "image/png",
    "image/tiff",
    "image/fits",
    "application/x-npy",
    "application/zip",
)
ENTRY = """[Desktop Entry]
Type=Application
Name=P2SF Explorer
Comment=From a lens prescription to its point spread functions
Comment[de]=Von den Daten eines Objektivs zu seinen Punktbildern
Exec={command} %u
Icon={name}
Terminal=false
Categories=Education;Science;Physics;
MimeType={types};
"""
LENS_MIME = f"""<?xml version="1.0" encoding="UTF-8"?>
<mime-info xmlns="http://www.freedesktop.org/standards/shared-mime-info">
  <mime-type type="{LENS_TYPE}">
    <comment>P2SF lens</comment>
    <comment xml:lang="de">P2SF-Objektiv</comment>
    <sub-class-of type="application/toml"/>
    <magic priority="60"><match type="string" offset="0:4096" value="[[surface]]"/></magic>
    <glob pattern="*.p2sf.toml" weight="60"/>
  </mime-type>
</mime-info>
"""
WINDOWS_ROOTS = rf"Software\Classes\{SCHEME}", rf"Software\Classes\Applications\{NAME}.exe"
BRANCH = r"\shell", r"\open", r"\command"
WINDOWS_VALUES = (
    (WINDOWS_ROOTS[0], "", "URL:P2SF link"),
    (WINDOWS_ROOTS[0], "URL Protocol", ""),
    *((root + "".join(BRANCH), "", "{command}") for root in WINDOWS_ROOTS),
)


def command() -> list[str]:
    """Return what starts the explorer: the bundle's own program, or this Python."""
    return [sys.executable] if getattr(sys, "frozen", False) else [sys.executable, "-m", "p2sf_explorer"]


def as_path(argument: str) -> str:
    """Return the path of a ``file:`` address, as desktops hand over files; anything else as it is."""
    return unquote(urlparse(argument).path) if argument.startswith("file://") else argument


def register() -> str:
    """Write the entries and return in a sentence what was done; P2SFError where they cannot be written."""
    _refuse_macos()
    try:
        if sys.platform == "win32":
            _write_windows()
            return "p2sf: links and Open with start P2SF Explorer now"
        for path, text in _linux_files().items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        _icon_place().parent.mkdir(parents=True, exist_ok=True)
        copyfile(ICON, _icon_place())
    except OSError as error:
        raise _not_written(error) from error
    _refresh()
    return f"P2SF Explorer is in the menu of programs: {next(iter(_linux_files()))}"


def unregister() -> str:
    """Take away what `register` wrote and return that in a sentence; P2SFError where it cannot be taken away."""
    _refuse_macos()
    if sys.platform == "win32":
        _clear_windows()
        return "p2sf: links and Open with no longer start P2SF Explorer"
    try:
        for path in (*_linux_files(), _icon_place()):
            path.unlink(missing_ok=True)
    except OSError as error:
        raise _not_written(error) from error
    _refresh()
    return "P2SF Explorer is no longer in the menu of programs"


def _refuse_macos() -> None:
    if sys.platform == "darwin":
        raise P2SFError("macOS learns what a program opens from its bundle; put P2SF Explorer.app into Applications")


def _not_written(error: OSError) -> P2SFError:
    return P2SFError("{path} cannot be written; choose XDG_DATA_HOME otherwise", path=str(error.filename))


def _data_folder() -> Path:
    return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")


def _icon_place() -> Path:
    return _data_folder() / "icons" / "hicolor" / SIZE / "apps" / f"{NAME}.png"


def _linux_files() -> dict[Path, str]:
    entry = ENTRY.format(command=" ".join(map(_quote, command())), name=NAME, types=";".join(TYPES))
    folder = _data_folder()
    return {
        folder / "applications" / f"{NAME}.desktop": entry,
        folder / "mime" / "packages" / f"{NAME}.xml": LENS_MIME,
    }


def _quote(argument: str) -> str:
    """Return an argument as the freedesktop.org Desktop Entry Specification has it quoted in the key Exec."""
    escaped = re.sub(r'(["`$\\])', r"\\\1", argument)
    return '"' + escaped.replace("\\", "\\\\").replace("%", "%%") + '"'


def _refresh() -> None:
    """Have the desktop read its folders again, where it has the programs for that."""
    for line in _refreshers():
        if which(line[0]):
            subprocess.run(line, check=False, capture_output=True)


def _refreshers() -> Iterator[tuple[str, ...]]:
    folder = _data_folder()
    yield "update-mime-database", str(folder / "mime")
    yield "update-desktop-database", str(folder / "applications")
    yield "xdg-mime", "default", f"{NAME}.desktop", f"x-scheme-handler/{SCHEME}", LENS_TYPE


def _write_windows() -> None:
    import winreg

    line = subprocess.list2cmdline([*command(), "%1"])
    for key, name, value in WINDOWS_VALUES:
        with winreg.CreateKey(winreg.HKEY_CURRENT_USER, key) as opened:  # type: ignore[attr-defined,unused-ignore]
            winreg.SetValueEx(opened, name, 0, winreg.REG_SZ, value.format(command=line))  # type: ignore[attr-defined,unused-ignore]


def _clear_windows() -> None:
    import winreg

    for root in WINDOWS_ROOTS:
        for depth in range(len(BRANCH), -1, -1):  # only a key without others below it can be deleted
            with suppress(FileNotFoundError):
                winreg.DeleteKey(winreg.HKEY_CURRENT_USER, root + "".join(BRANCH[:depth]))  # type: ignore[attr-defined,unused-ignore]
