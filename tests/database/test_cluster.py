"""Stacks by the workers of a cluster: the same bytes whatever happens to them, and a sentence where it cannot go on.

`python -m tests.long.cluster` measures what the faults cost, on a stack of 13 020 PSFs.
"""

import json
import os
import signal
import time
from threading import Timer

import pytest

from p2sf import __version__
from p2sf.cli import main
from p2sf.cluster import connect
from p2sf.database.files.stack import open_stack
from p2sf.database.files.stack_cluster import fill_chunks
from p2sf.database.files.stack_work import StackProgress
from p2sf.database.files.stack_write import write_stack
from p2sf.errors import ClusterError, DatabaseError
from tests.database.test_stack import SAMPLING, contents, small
from tests.support.cluster import running_cluster

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """Return the bytes of a stack that local threads have written."""
    return contents(write_stack(*small(), tmp_path_factory.mktemp("plain") / "gauss.zarr", SAMPLING).path)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    with running_cluster(tmp_path_factory.mktemp("cluster")) as cluster:
        yield cluster


def slowed() -> int:
    """Let a worker take a while for each chunk, and return its process id."""
    from p2sf.database.files import stack_work as work

    plain = work.__dict__.setdefault("plain", work.light_of)
    work.light_of = lambda *arguments, **options: (time.sleep(0.2), plain(*arguments, **options))[1]
    return os.getpid()


def filled(cluster, path, progress=lambda now: None):
    return write_stack(*small(), path, SAMPLING, StackProgress(progress), scheduler=cluster.address)


def test_two_processes_of_a_cluster_write_the_same_bytes(plain, cluster, tmp_path):
    told = []
    built = filled(cluster, tmp_path / "two.zarr", told.append)
    assert contents(built.path) == plain
    assert [now.done for now in told] == list(range(1, len(built.chunks) + 1))


def on_the_way(cluster, act):
    """Return a ``progress`` that acts on one of two slowed workers once the first chunk is done, and its id."""
    with connect(cluster.address) as client:
        client.wait_for_workers(2)  # one that was killed before may be on its way back
        victim = min(client.run(slowed).values())
    return (lambda now: act(victim) if now.done == 1 else None), victim


def test_a_worker_that_is_killed_costs_no_chunk(plain, cluster, tmp_path):
    progress, victim = on_the_way(cluster, lambda pid: os.kill(pid, signal.SIGKILL))
    assert contents(filled(cluster, tmp_path / "killed.zarr", progress).path) == plain
    assert victim not in cluster.worker_pids()


def test_a_worker_that_is_frozen_is_not_waited_for(plain, cluster, tmp_path):
    progress, victim = on_the_way(cluster, lambda pid: os.kill(pid, signal.SIGSTOP))
    thaw = Timer(60, os.kill, (victim, signal.SIGCONT))  # so that a failure ends
    thaw.start()
    built = filled(cluster, tmp_path / "frozen.zarr", progress)
    assert thaw.is_alive()
    thaw.cancel()
    os.kill(victim, signal.SIGCONT)
    assert built.complete
    assert victim in cluster.worker_pids()  # which answers once its chunk is written a second time
    assert contents(built.path) == plain


def test_another_version_or_none_is_a_sentence(cluster, tmp_path):
    with connect(cluster.address) as client:
        victim = min(client.nthreads())
        for version, words in (("0.0.9", "has P2SF 0.0.9, and"), (None, "has no P2SF, and")):
            client.run(versioned, version, workers=[victim])
            with pytest.raises(ClusterError, match=f"{words} .* is needed; install p2sf") as refused:
                filled(cluster, tmp_path / "other.zarr")
            assert victim in str(refused.value)
            client.run(versioned, "", workers=[victim])
        late = client.submit(fill_chunks, str(tmp_path), "", "0.0.9", ((0, 0, 0),))  # for a worker that came later
        with pytest.raises(ClusterError, match=r"and 0\.0\.9 is needed"):
            late.result()


def versioned(version: str | None) -> None:
    """Give P2SF another version on a worker, none, or ("") its own again."""
    import sys
    from types import SimpleNamespace

    own = sys.modules.setdefault("p2sf as installed", sys.modules["p2sf"])
    sys.modules["p2sf"] = SimpleNamespace(__version__=version) if version else own if version == "" else None


def test_a_folder_that_workers_do_not_share_is_a_sentence(cluster, tmp_path):
    with connect(cluster.address) as client:
        elsewhere = client.submit(fill_chunks, str(tmp_path / "other.zarr"), "", __version__, ((0, 0, 0),))
        with pytest.raises(DatabaseError, match=r"other.zarr is not there"):
            elsewhere.result()
    with pytest.raises(DatabaseError, match="the memory of one process"):
        filled(cluster, "memory://gauss.zarr")


def test_the_command_line_lists_the_workers(cluster, capsys):
    assert main(["cluster", cluster.address, "--json"]) == 0
    workers = json.loads(capsys.readouterr().out)["workers"]
    assert [(worker["threads"], worker["p2sf"]) for worker in workers] == [(1, __version__)] * 2


def test_nobody_there_is_a_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr("p2sf.cluster.ANSWER_S", 0.2)
    for address in ("tcp://127.0.0.1:1", "nonsense", "nothing://here:1"):
        with pytest.raises(ClusterError, match=r"no scheduler answers at .*; start one with dask scheduler"):
            write_stack(*small(), tmp_path / "a.zarr", SAMPLING, scheduler=address)


def test_a_lost_scheduler_is_a_sentence_and_what_is_done_is_kept(plain, cluster, tmp_path):
    """The last test, as it leaves no cluster."""
    path = tmp_path / "lost.zarr"
    progress, _ = on_the_way(cluster, lambda pid: cluster.kill_scheduler())
    with pytest.raises(DatabaseError, match=r"is lost; start it .* and give the same command again, which keeps"):
        filled(cluster, path, progress)
    assert 0 < len(open_stack(path).missing) < len(open_stack(path).chunks)
    assert contents(write_stack(*small(), path, SAMPLING).path) == plain
