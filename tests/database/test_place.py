"""Stacks at URLs: the same files as in a folder, resumed there, and a sentence where nothing can be reached."""

import numpy as np
import pytest
from fsspec.core import url_to_fs

from p2sf.cli import main
from p2sf.database.files.place import is_url, place_of, size_bytes
from p2sf.database.files.stack import open_stack, read_psfs
from p2sf.database.files.stack_work import StackProgress
from p2sf.database.files.stack_write import write_stack
from p2sf.errors import DatabaseError
from p2sf.export.psf_cube import open_cube
from tests.database.test_stack import SAMPLING, contents, small
from tests.support.cluster import running_cluster

MEMORY = "memory://shelf/gauss.zarr"


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    return write_stack(*small(), tmp_path_factory.mktemp("plain") / "gauss.zarr", SAMPLING)


@pytest.fixture
def memory():
    """Return a place in the memory of this process, and clear it."""
    yield MEMORY
    url_to_fs(MEMORY)[0].store.clear()


@pytest.fixture
def bucket(monkeypatch):
    """Return the URL of a bucket in an object store, which a server of this process keeps."""
    pytest.importorskip("s3fs")
    server = pytest.importorskip("moto.server").ThreadedMotoServer("127.0.0.1", 0)
    server.start()
    host, port = server.get_host_and_port()
    settings = {"ENDPOINT_URL": f"http://{host}:{port}", "ACCESS_KEY_ID": "me", "SECRET_ACCESS_KEY": "secret"}
    for name, value in {**settings, "DEFAULT_REGION": "us-east-1"}.items():
        monkeypatch.setenv(f"AWS_{name}", value)
    files = url_to_fs("s3://shelf")[0]
    files.makedirs("shelf", exist_ok=True)
    yield "s3://shelf"
    server.stop()
    type(files).clear_instance_cache()


def stored(url) -> dict[str, bytes]:
    """Return all files below a URL, as `contents` of a folder."""
    files, root = url_to_fs(url)
    files.invalidate_cache()
    return {name.removeprefix(f"{root}/"): files.cat_file(name) for name in files.find(root)}


def test_what_is_a_url():
    assert is_url("s3://a/b.zarr") and is_url(MEMORY)
    assert not is_url("a/b.zarr") and not is_url("file:///a/b.zarr")
    assert place_of("file:///a%20b/c.zarr").as_posix() == "/a b/c.zarr"
    assert place_of("s3://a/b.zarr/") == "s3://a/b.zarr"


def test_a_stack_at_a_url_holds_the_files_of_a_folder(plain, memory):
    told = []
    half = write_stack(*small(), memory, SAMPLING, StackProgress(told.append, lambda: len(told) >= 1), threads=1)
    assert len(half.missing) == len(half.chunks) - 1
    with pytest.raises(DatabaseError, match="is not complete; build it again"):
        read_psfs(half, ...)
    whole = write_stack(*small(), memory, SAMPLING)
    assert whole.complete
    assert stored(memory) == contents(plain.path)
    assert size_bytes(memory) == size_bytes(plain.path) == sum(map(len, contents(plain.path).values()))
    np.testing.assert_array_equal(open_cube(memory).values, read_psfs(plain, ...))


def test_a_stack_without_its_header_is_none(plain, memory):
    """The header is the last file of an empty stack, and a writer that is killed before leaves none."""
    write_stack(*small(), memory, SAMPLING, StackProgress(cancelled=lambda: True))
    files, root = url_to_fs(memory)
    files.rm_file(f"{root}/zarr.json")
    with pytest.raises(DatabaseError, match="is not there; build it"):
        open_stack(memory)
    assert write_stack(*small(), memory, SAMPLING).complete
    assert stored(memory) == contents(plain.path)


def test_the_command_line_takes_urls(memory, capsys):
    nodes = ("--depths-mm", "20000:inf:2", "--fields-deg", "0,7", "--wavelengths-nm", "550")
    sampling = ("--stack", "--pixels", "16", "--pixel-um", "2")
    assert main(["database", "build", "double_gauss_28", *nodes, *sampling, "-o", memory]) == 0
    assert memory in capsys.readouterr().out
    assert main(["database", "info", memory]) == 0
    assert "complete" in capsys.readouterr().out
    assert main(["psf", memory, "--field-deg", "7", "--pixels", "16"]) == 0


@pytest.mark.parametrize("url", ["nothing://a/b.zarr", "nothing://a/b.zarr/"])
def test_a_place_of_no_known_kind_is_a_sentence(url):
    for use in (open_stack, lambda place: write_stack(*small(), place, SAMPLING)):
        with pytest.raises(DatabaseError, match=r"nothing://a/b.zarr needs a library .*, protocol"):
            use(url)


def test_workers_write_to_an_object_store_themselves(plain, bucket, tmp_path):
    url = f"{bucket}/lenses/gauss.zarr"
    with running_cluster(tmp_path) as cluster:
        told = []
        watch = StackProgress(told.append, lambda: len(told) >= 1)
        assert not write_stack(*small(), url, SAMPLING, watch, scheduler=cluster.address).complete
        assert write_stack(*small(), url, SAMPLING, scheduler=cluster.address).complete
    assert stored(url) == contents(plain.path)
    np.testing.assert_array_equal(read_psfs(open_stack(url), ...), read_psfs(plain, ...))


def test_a_store_that_cannot_be_reached_is_a_sentence(bucket, monkeypatch):
    with pytest.raises(DatabaseError, match=r"s3://nobody/a\.zarr is not there"):
        open_stack("s3://nobody/a.zarr")
    with pytest.raises(DatabaseError, match=r"s3://nobody/a\.zarr cannot be reached, .*bucket"):
        write_stack(*small(), "s3://nobody/a.zarr", SAMPLING)
    monkeypatch.setenv("AWS_ENDPOINT_URL", "http://127.0.0.1:1")
    url_to_fs("s3://x")[0].clear_instance_cache()
    with pytest.raises(DatabaseError, match=r"cannot be reached, .*; check the address"):
        open_stack(f"{bucket}/a.zarr")
