"""The entry in the menu of programs, and what the program of the bundle takes besides files."""

import configparser
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from xml.etree import ElementTree

import pytest
from PySide6.QtCore import QEvent, QObject, QUrl
from PySide6.QtGui import QFileOpenEvent, QImage

from p2sf import __version__
from p2sf.lensfile.library import lenses_folder
from p2sf_explorer.application.main import run, starting_state
from p2sf_explorer.application.open_events import OpenEvents
from p2sf_explorer.application.registration import ICON, LENS_MIME, as_path, register, unregister
from p2sf_explorer.scene3d import opengl_probe

ON_LINUX = pytest.mark.skipif(sys.platform != "linux", reason="the freedesktop.org files are for Linux")


@ON_LINUX
def test_the_entry_opens_links_and_lens_files_and_goes_again(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    assert str(tmp_path) in register()
    parser = configparser.RawConfigParser()
    parser.optionxform = str
    parser.read(tmp_path / "applications" / "p2sf-explorer.desktop")
    entry = dict(parser["Desktop Entry"])
    assert entry["Exec"].endswith(" %u") and sys.executable in entry["Exec"]
    assert {"x-scheme-handler/p2sf", "application/x-p2sf-lens"} <= set(entry["MimeType"].split(";"))
    assert QImage(str(tmp_path / "icons/hicolor/256x256/apps/p2sf-explorer.png")).width() == 256
    assert (tmp_path / "mime/packages/p2sf-explorer.xml").is_file()
    unregister()
    left = [path for path in tmp_path.rglob("p2sf*") if path.is_file()]
    assert not [path for path in left if path.suffix in (".desktop", ".png") or path.parent.name == "packages"]


@ON_LINUX
def test_a_program_in_a_folder_of_any_name_is_quoted_for_the_menu(tmp_path, monkeypatch):
    """Double quotes, a backslash before what a shell would expand, each written twice in the file, and %% for %."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setattr("p2sf_explorer.application.registration.command", lambda: ["/my 100 % folder/$it", "-m"])
    register()
    text = (tmp_path / "applications" / "p2sf-explorer.desktop").read_text()
    assert 'Exec="/my 100 %% folder/\\\\$it" "-m" %u\n' in text
    unregister()


class Registry:
    """Keys of the Windows registry under one root, as the module winreg offers them."""

    HKEY_CURRENT_USER, REG_SZ = object(), 1

    def __init__(self):
        self.keys = {"Software", "Software\\Classes", "Software\\Classes\\Applications"}

    @contextmanager
    def CreateKey(self, root, path):
        parts = path.split("\\")
        self.keys |= {"\\".join(parts[:k]) for k in range(1, len(parts) + 1)}
        yield path

    def SetValueEx(self, key, name, reserved, kind, value):
        assert key in self.keys

    def DeleteKey(self, root, path):
        if path not in self.keys:
            raise FileNotFoundError(path)
        if any(key.startswith(path + "\\") for key in self.keys):
            raise PermissionError(path)
        self.keys.remove(path)


def test_on_windows_the_keys_go_again_and_may_be_missing(monkeypatch):
    registry = Registry()
    before = set(registry.keys)
    monkeypatch.setitem(sys.modules, "winreg", registry)
    monkeypatch.setattr(sys, "platform", "win32")
    assert "start P2SF Explorer" in register() and len(registry.keys) > len(before) + 4
    for _ in range(2):
        assert "no longer" in unregister() and registry.keys == before


def test_every_shipped_lens_is_known_by_its_content():
    """The magic of the MIME type: a text that stands near the beginning of every lens file."""
    match = next(element for element in ElementTree.fromstring(LENS_MIME).iter() if element.tag.endswith("}match"))
    length = int(match.attrib["offset"].split(":")[1])
    files = list(lenses_folder().glob("*.toml"))
    assert files and all(match.attrib["value"] in path.read_text()[: length + 20] for path in files)


def test_a_file_that_a_desktop_hands_over_as_an_address_opens(tmp_path):
    place = tmp_path / "my lens.toml"
    place.write_text((lenses_folder() / "tessar.toml").read_text())
    assert as_path(place.as_uri()) == str(place)
    assert starting_state([place.as_uri()]).optics.lens == str(place)
    assert as_path("tessar") == "tessar"


def test_files_and_links_that_come_later_open_too(qapp):
    class Target(QObject):
        pass

    opened, target = [], Target()
    OpenEvents(lambda path: opened.append(("file", path)), lambda text: opened.append(("link", text)), target)
    for address in (QUrl.fromLocalFile("/tmp/lens.toml"), QUrl("p2sf:abc")):
        assert qapp.sendEvent(target, QFileOpenEvent(address))
    qapp.sendEvent(target, QEvent(QEvent.Type.User))
    assert opened == [("file", "/tmp/lens.toml"), ("link", "p2sf:abc")]


def test_version_and_the_icon(capsys):
    assert run(["--version"]) == 0
    assert capsys.readouterr().out.startswith(f"p2sf {__version__}\npython ")
    assert ICON.is_file()


def test_a_bundle_asks_itself_for_opengl_and_says_where_3d_is(monkeypatch):
    monkeypatch.setattr(opengl_probe, "FROZEN", True)
    assert opengl_probe.command() == [sys.executable, opengl_probe.OPTION]
    assert opengl_probe.sentence(opengl_probe.NO_LIBRARY) == opengl_probe.NOT_IN_BUNDLE
    code = [sys.executable, "-m", "p2sf_explorer", opengl_probe.OPTION]
    asked = subprocess.run(code, cwd=Path(__file__).parents[3], capture_output=True)
    assert asked.returncode in (opengl_probe.WORKS, opengl_probe.NO_CONTEXT)
