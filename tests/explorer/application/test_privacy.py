"""The explorer makes no connection to any network: the kernel ends the process that asks for one."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
ON_LINUX = pytest.mark.skipif(sys.platform != "linux", reason="seccomp is Linux's")
USED = "from tests.support.no_network import forbid_network, use_everything; forbid_network(); "


def ended(code: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-c", USED + code], cwd=ROOT, capture_output=True, text=True)


@ON_LINUX
@pytest.mark.parametrize("family", ["AF_INET", "AF_INET6"])
def test_a_socket_of_the_internet_would_end_the_process(family):
    run = ended(f"import socket; socket.socket(socket.{family}); print('open')")
    assert run.returncode == -31 and "open" not in run.stdout, "SIGSYS"


@ON_LINUX
def test_the_whole_window_with_every_panel_knows_no_network(tmp_path):
    """Each panel, the handbook, a lesson, the lenses, snapshots: no socket, and none of Qt's modules for one.

    It takes some seconds since all that has to be opened, in a process that may be ended.
    """
    run = ended(f"use_everything({str(tmp_path)!r}); import sys; print(*sys.modules)")
    assert run.returncode == 0, run.stderr
    loaded = set(run.stdout.split())
    assert {"PySide6.QtWidgets", "pyvista"} <= loaded
    assert not {name for name in loaded if re.match(r"PySide6\.Qt(Network|WebEngine|WebSockets|RemoteObjects)", name)}
    assert not loaded & {"requests", "httpx", "aiohttp", "urllib3"}


def test_nothing_is_sent_and_no_browser_is_opened():
    sources = [path.read_text() for path in (ROOT / "app/p2sf_explorer").rglob("*.py")]
    sending = re.compile(
        r"QDesktopServices|QNetwork|urlopen|http\.client|smtplib|webbrowser|setOpenExternalLinks\(True"
    )
    assert not [found for text in sources if (found := sending.findall(text))]
