"""PSF stacks: whole chunks or none, the same bytes whoever renders them, and never a torn one read back."""

import json
import os
import resource
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

from p2sf.conventions import slope_from_degrees
from p2sf.database.build import build_database
from p2sf.database.files.stack import chunk_shape, open_stack, read_psfs
from p2sf.database.files.stack_work import StackProgress, psf_count
from p2sf.database.files.stack_write import write_stack
from p2sf.database.render import Sampling, rendered_light
from p2sf.database.space import Space
from p2sf.errors import DatabaseError
from p2sf.lens.lens import with_aim
from p2sf.lensfile.library import find_lens
from p2sf.spans import depth_nodes

ROOT = Path(__file__).parents[2]
SAMPLING = Sampling(32, 1.0)


def small(fields=5):
    lens = find_lens("double_gauss_28")
    space = Space(
        depth_nodes(20_000, count=6), slope_from_degrees(np.linspace(0, 14, fields)), np.linspace(0.45, 0.65, 4)
    )
    return build_database(lens, space), lens


@pytest.fixture(scope="module")
def stack(tmp_path_factory):
    return write_stack(*small(), tmp_path_factory.mktemp("stack") / "gauss.zarr", SAMPLING)


def contents(path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in sorted(Path(path).rglob("*")) if p.is_file()}


def test_a_stack_holds_the_psfs_of_its_database(stack):
    assert stack.psf.shape == (6, 5, 4, 32, 32)
    assert stack.complete
    space = stack.stored.database.space
    for d, f, w in ((0, 0, 0), (3, 4, 1), (5, 2, 3)):
        point = (space.depths_mm[d], space.field_slopes[f], space.wavelengths_um[w])
        expected = rendered_light(stack.stored.database, point, SAMPLING)
        found = read_psfs(stack, (d, f, w))
        assert np.linalg.norm(found - expected) <= 1e-4 * np.linalg.norm(expected)  # what settled pictures promise
    np.testing.assert_allclose(read_psfs(stack, ...).sum((-2, -1)), 1, atol=1e-5)


def test_xarray_opens_a_stack_with_coordinates_and_units(stack):
    xarray = pytest.importorskip("xarray")
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # of metadata that is looked for in vain
        data = xarray.open_zarr(stack.path)
    space = stack.stored.database.space
    assert data["psf"].dims == ("depth_mm", "field_deg", "wavelength_nm", "y_um", "x_um")
    np.testing.assert_array_equal(data["depth_mm"], space.depths_mm)
    assert [data[name].attrs["units"] for name in data["psf"].dims] == ["mm", "deg", "nm", "um", "um"]
    one = data["psf"].sel(field_deg=14, depth_mm=np.inf).isel(wavelength_nm=1)
    np.testing.assert_array_equal(one, read_psfs(stack, (-1, 4, 1)))


def test_any_zarr_reader_finds_axes_units_and_provenance(stack):
    import zarr

    group = zarr.open_group(stack.path, mode="r")
    assert group["psf"].metadata.zarr_format == 3
    assert group["psf"].metadata.dimension_names == ("depth_mm", "field_deg", "wavelength_nm", "y_um", "x_um")
    assert group["depth_mm"][-1] == np.inf
    assert group["field_deg"][-1] == pytest.approx(14)
    assert group["x_um"][16] == 0
    assert group.attrs["lens"]["name"] == "double_gauss_28"


def test_chunks_are_about_a_mebibyte_along_the_field_first():
    assert chunk_shape((20, 21, 31), 64) == (1, 21, 3)
    assert chunk_shape((20, 21, 31), 512) == (1, 1, 1)
    assert chunk_shape((2, 3, 4), 16) == (1, 3, 4)


def test_progress_and_cancel_between_chunks_and_going_on_gives_the_same_bytes(stack, tmp_path):
    told = []
    database, lens = small()
    watch = StackProgress(told.append, lambda: len(told) >= 1)
    half = write_stack(database, lens, tmp_path / "half.zarr", SAMPLING, watch)
    assert not half.complete
    assert 0 < told[0].done < told[0].total == len(half.chunks)
    assert told[0].seconds_left > 0
    with pytest.raises(DatabaseError, match="is not complete; build it again with the same command, it resumes"):
        read_psfs(half, ...)
    lacking = sum(psf_count(half, chunk) for chunk in half.missing)
    again = write_stack(database, lens, tmp_path / "half.zarr", SAMPLING, StackProgress(told.append))
    assert (told[-1].done, told[-1].total, told[-1].seconds_left) == (len(half.chunks), len(half.chunks), 0)
    assert told[-1].psfs == lacking and told[-1].psfs_per_second > 0
    assert again.complete
    assert contents(again.path) == contents(stack.path)


SLOW_BUILD = """
import sys, time
from p2sf.database.files import stack_work
from p2sf.database.files.stack_write import write_stack
from tests.database.test_stack import SAMPLING, small
plain = stack_work.light_of
def slow(*arguments, **options):
    time.sleep(0.15)
    return plain(*arguments, **options)
stack_work.light_of = slow
write_stack(*small(), sys.argv[1], SAMPLING)
"""


@pytest.mark.slow
def test_kill_9_loses_the_chunk_in_flight_and_no_more(stack, tmp_path):
    path = tmp_path / "killed.zarr"
    process = subprocess.Popen([sys.executable, "-c", SLOW_BUILD, str(path)], cwd=ROOT)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and not (path.exists() and len(open_stack(path).missing) <= 3):
        time.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    killed = open_stack(path)
    kept = {name: content for name, content in contents(path).items() if "/c/" in name and ".partial" not in name}
    assert 0 < len(killed.missing) < len(killed.chunks)
    whole = contents(stack.path)
    assert all(whole[name] == content for name, content in kept.items())
    torn = path / "psf" / "c" / "0" / "0" / "0" / "0" / "0.abc.partial"
    torn.parent.mkdir(parents=True, exist_ok=True)  # whichever chunks were done, this one may be in flight
    torn.write_bytes(b"torn")
    resumed = write_stack(*small(), path, SAMPLING)
    assert resumed.complete
    assert contents(path) == whole


@pytest.mark.parametrize(("limit", "laid"), [(100, False), (20_000, True)])
def test_a_full_disk_is_a_sentence_and_the_next_attempt_goes_on(stack, tmp_path, limit, laid):
    """Files that may not grow stand for the disk: too small for the empty stack, then for its chunks."""
    path = tmp_path / "full.zarr"
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, before[1]))
    try:
        with pytest.raises(DatabaseError, match=r"cannot be written, .*; make room and give the same command again"):
            write_stack(*small(), path, SAMPLING)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert os.listdir(tmp_path) == (["full.zarr"] if laid else [])
    assert write_stack(*small(), path, SAMPLING).complete
    assert contents(path) == contents(stack.path)


def test_another_stack_at_that_place_is_left_alone(stack):
    before = contents(stack.path)
    database, lens = small()
    other_pupil = database, with_aim(lens, "paraxial" if lens.aim == "stop" else "stop")
    for change in (
        (small(fields=4), SAMPLING),
        (other_pupil, SAMPLING),
        (small(), Sampling(16, 1.0)),
        (small(), Sampling(32, 0.9)),
    ):
        with pytest.raises(DatabaseError, match="holds a stack of another lens, aim, nodes or samples"):
            write_stack(*change[0], stack.path, change[1])
    assert contents(stack.path) == before


def copied(stack, path) -> Path:
    for name, content in contents(stack.path).items():
        (path / name).parent.mkdir(parents=True, exist_ok=True)
        (path / name).write_bytes(content)
    return path


def test_a_damaged_chunk_is_noticed_by_its_checksum(stack, tmp_path):
    path = copied(stack, tmp_path / "bad.zarr")
    chunk = path / "psf" / "c" / "2" / "0" / "0" / "0" / "0"
    content = bytearray(chunk.read_bytes())
    content[len(content) // 2] ^= 1
    chunk.write_bytes(content)
    with pytest.raises(DatabaseError, match="has a damaged chunk"):
        read_psfs(open_stack(path), 2)
    chunk.write_bytes(content[: len(content) // 3])
    with pytest.raises(DatabaseError, match="has a damaged chunk"):
        read_psfs(open_stack(path), 2)


def test_damaged_headers_are_sentences(stack, tmp_path):
    """300 random changes of any header file: a sentence, or the very same numbers where nothing read has changed."""
    path, rng = copied(stack, tmp_path / "bad.zarr"), np.random.default_rng(1)
    headers = [p for p in path.rglob("zarr.json") if p.parent.name in ("bad.zarr", "psf", "database")]
    first = read_psfs(stack, (0, 0, 0))
    for _ in range(300):
        header = headers[rng.integers(len(headers))]
        whole = header.read_bytes()
        content = bytearray(whole)
        content[rng.integers(len(content))] = rng.integers(256)
        header.write_bytes(content)
        try:
            np.testing.assert_array_equal(read_psfs(open_stack(path), (0, 0, 0)), first)
        except DatabaseError as error:
            assert str(path) in str(error)
            assert "\n" not in str(error)
        finally:
            header.write_bytes(whole)


@pytest.mark.parametrize(
    ("key", "value", "words"), [("p2sf_stack_schema", 99, "newer than"), ("shape", 7, "do not fit")]
)
def test_a_newer_stack_and_one_of_another_shape_are_told_apart(stack, tmp_path, key, value, words):
    path = copied(stack, tmp_path / "odd.zarr")
    header = path / "zarr.json" if key != "shape" else path / "psf" / "zarr.json"
    content = json.loads(header.read_text())
    if key == "shape":
        content["shape"][0] = value
    else:
        content["attributes"][key] = value
    header.write_text(json.dumps(content))
    with pytest.raises(DatabaseError, match=words):
        open_stack(path)


@pytest.mark.parametrize("kind", ["nothing", "file", "folder"])
def test_foreign_places_are_sentences(tmp_path, kind):
    path = tmp_path / "a.zarr"
    if kind == "file":
        path.write_bytes(b"x")
    if kind == "folder":
        path.mkdir()
    with pytest.raises(DatabaseError, match=r"is not (there|a P2SF stack)"):
        open_stack(path)
    if kind != "nothing":
        with pytest.raises(DatabaseError):
            write_stack(*small(), path, SAMPLING)
