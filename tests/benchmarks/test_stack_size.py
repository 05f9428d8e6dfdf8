"""A stack of 13 020 PSFs: how much memory, how long, and what a kill at half leaves (run with --benchmark-only)."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from p2sf.database.files.stack import open_stack

ROOT = Path(__file__).parents[2]
GIB_IN_KIB = 1 << 20
BUILD = """
import resource, sys, time
from p2sf.cli import main
start = time.perf_counter()
grid = ["--depths-mm", "60000:inf:20", "--fields-deg", "0:14:21", "--wavelengths-nm", "420:700:31"]
sampling = ["--stack", "--pixels", "64", "--pixel-um", "1"]
code = main(["database", "build", "double_gauss_28", *grid, *sampling, "-o", sys.argv[1]])
print(code, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.perf_counter() - start)
"""


def build(path) -> subprocess.Popen:
    return subprocess.Popen([sys.executable, "-c", BUILD, str(path)], cwd=ROOT, stdout=subprocess.PIPE, text=True)


def test_a_stack_of_13_020(benchmark, capsys, tmp_path):
    """Within 1 GiB; killed with SIGKILL at half and started again, the same bytes."""

    def whole():
        code, kib, seconds = build(tmp_path / "whole.zarr").communicate()[0].split()[-3:]
        return int(code), int(kib), float(seconds)

    code, kib, seconds = benchmark.pedantic(whole, rounds=1)
    assert code == 0
    assert open_stack(tmp_path / "whole.zarr").psf.shape == (20, 21, 31, 64, 64)
    assert kib <= GIB_IN_KIB
    killed = kill_at_half(tmp_path / "killed.zarr")
    build(tmp_path / "killed.zarr").communicate()
    assert contents(tmp_path / "killed.zarr") == contents(tmp_path / "whole.zarr")
    with capsys.disabled():
        told = f"{kib / 1024:.0f} MiB of memory, {seconds:.1f} s; killed at {killed:.0%}, same bytes"
        print(f"\n13 020 PSFs to Zarr: {told}")


def kill_at_half(path) -> float:
    """Start a build, kill it when half the chunks are there, and return the share that is."""
    process = build(path)
    while process.poll() is None:
        time.sleep(0.05)
        if path.exists() and len(open_stack(path).missing) <= len(open_stack(path).chunks) / 2:
            os.kill(process.pid, signal.SIGKILL)
            break
    process.wait()
    stack = open_stack(path)
    return 1 - len(stack.missing) / len(stack.chunks)


def contents(path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in sorted(path.rglob("*")) if p.is_file()}
