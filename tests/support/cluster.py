"""A dask.distributed scheduler and workers as processes of their own, which tests may kill, freeze and start again."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
QUIET = {"DASK_DISTRIBUTED__LOGGING__DISTRIBUTED": "error"}


@dataclass
class RunningCluster:
    """The address of a scheduler, and its process."""

    address: str
    scheduler: subprocess.Popen

    def kill_scheduler(self) -> None:
        self.scheduler.kill()
        self.scheduler.wait()

    def worker_pids(self) -> list[int]:
        from distributed import Client

        with Client(self.address, set_as_default=False) as client:
            return list(client.run(os.getpid).values())


@contextmanager
def running_cluster(folder: Path, workers: int = 2) -> Iterator[RunningCluster]:
    """Run a scheduler and so many workers of one thread, each with its nanny, in this process's environment."""
    told = folder / "scheduler.json"
    told.unlink(missing_ok=True)
    code = "from distributed.cli.dask_{} import main; main()"
    here = "--host", "127.0.0.1"
    scheduler = _started(
        [code.format("scheduler"), *here, "--port", "0", "--no-dashboard", "--scheduler-file", str(told)]
    )
    options = [*here, "--nworkers", str(workers), "--nthreads", "1", "--no-dashboard", "--local-directory", str(folder)]
    nannies = _started([code.format("worker"), "--scheduler-file", str(told), *options])
    try:
        yield RunningCluster(_address(told, workers), scheduler)
    finally:
        for process in (nannies, scheduler):
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def _started(arguments: list[str]) -> subprocess.Popen:
    return subprocess.Popen(
        [sys.executable, "-c", *arguments],
        cwd=ROOT,
        env={**os.environ, **QUIET},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def _address(told: Path, workers: int) -> str:
    from distributed import Client

    deadline, address = time.monotonic() + 60, ""
    while not address:
        assert time.monotonic() < deadline, "the scheduler has not started"
        time.sleep(0.05)
        with suppress(OSError, ValueError):  # not there, or half written
            address = json.loads(told.read_text())["address"]
    with Client(address, timeout=60, set_as_default=False) as client:
        client.wait_for_workers(workers, timeout=60)
    return address
