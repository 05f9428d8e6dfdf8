"""Database files come back as they went, and a damaged one is refused in a sentence."""

import io
import json

import numpy as np
import pytest

from p2sf.database.build import INTERPOLANTS, build_database
from p2sf.database.files.npz import load_database, save_database
from p2sf.database.files.packing import MARK
from p2sf.database.files.sealed import DIGITS, read_sealed, write_sealed
from p2sf.database.parts import KINDS
from p2sf.database.space import Space
from p2sf.errors import DatabaseError, ExportError, P2SFError
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.spans import depth_nodes

SPACE = Space(depth_nodes(500), np.tan(np.deg2rad(np.linspace(0, 14, 20))), np.linspace(0.4, 0.7, 31))


@pytest.fixture(scope="module")
def lens():
    return find_lens("double_gauss_28")


@pytest.fixture(scope="module")
def file(lens, tmp_path_factory):
    return save_database(build_database(lens, SPACE), lens, tmp_path_factory.mktemp("db") / "gauss.npz")


@pytest.mark.parametrize("interpolant", INTERPOLANTS)
def test_a_database_comes_back_to_the_last_bit(lens, tmp_path, interpolant):
    database = build_database(lens, SPACE, interpolant)
    stored = load_database(save_database(database, lens, tmp_path / "a.npz"))
    for kind in (*KINDS, "reduced_slope", "image_height"):
        point = (900.0, 0.1, 0.55)
        assert getattr(stored.database.coefficients(*point), kind) == getattr(database.coefficients(*point), kind)
    assert stored.database.errors == database.errors
    assert stored.database.space.shape == (20, 20, 31)


def test_the_file_tells_where_it_comes_from_and_holds_the_lens(lens, file):
    stored = load_database(file)
    meta = stored.meta
    assert {"method", "interpolant", "units", "conventions", "versions", "glasses", "stop", "schema"} <= set(meta)
    assert meta["lens"]["name"] == "double_gauss_28"
    assert any("refractiveindex.info" in glass["data"] for glass in meta["glasses"])
    again = coefficients(stored.lens, np.inf, 0.1, 0.55)
    assert float(again.w40) == pytest.approx(stored.database.coefficients(np.inf, 0.1, 0.55).w40, rel=1e-11)


def test_files_are_as_small_as_promised_and_the_same_every_time(lens, file, tmp_path):
    assert file.stat().st_size <= 20_000
    linear = save_database(build_database(lens, SPACE, "linear"), lens, tmp_path / "linear.npz")
    assert linear.stat().st_size <= 200_000
    again = save_database(build_database(lens, SPACE), lens, tmp_path / "again.npz")
    assert again.read_bytes() == file.read_bytes()


def test_any_npz_reader_opens_it(file):
    with np.load(file) as arrays:
        assert json.loads(str(arrays[MARK]))["lens"]["name"] == "double_gauss_28"


def test_a_thousand_random_corruptions_are_refused_in_one_sentence(file, tmp_path):
    """Bytes changed, cut out, put in, cut off, swapped for noise or zeros: never a traceback, never an answer."""
    whole, rng, broken = file.read_bytes(), np.random.default_rng(4), tmp_path / "broken.npz"
    seen = 0
    while seen < 1000:
        content = damaged(whole, rng)
        if content == whole:
            continue
        broken.write_bytes(content)
        with pytest.raises(P2SFError) as caught:
            load_database(broken)
        assert_one_sentence(str(caught.value), str(broken))
        seen += 1


def damaged(whole: bytes, rng) -> bytes:
    content, place, length = bytearray(whole), int(rng.integers(len(whole))), int(rng.integers(1, 200))
    kind = rng.integers(6)
    if kind == 0:
        content[place] ^= int(rng.integers(1, 256))
    elif kind == 1:
        del content[place : place + length]
    elif kind == 2:
        content[place:place] = rng.bytes(length)
    elif kind == 3:
        del content[place:]
    elif kind == 4:
        content[place : place + length] = rng.bytes(length)
    else:
        content[place : place + length] = bytes(length)
    return bytes(content)


def assert_one_sentence(message: str, path: str):
    assert path in message
    assert "\n" not in message
    assert "; " in message  # what is wrong; what to do


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is not a P2SF database"),
        (b"just text", "is not a P2SF database"),
        (b"PK\x03\x04" + bytes(500), "is not a P2SF database"),
    ],
)
def test_foreign_files_are_called_foreign(tmp_path, content, words):
    path = tmp_path / "foreign.npz"
    path.write_bytes(content)
    with pytest.raises(DatabaseError, match=words):
        load_database(path)


def test_another_programs_npz_is_foreign(tmp_path):
    np.savez(tmp_path / "other.npz", psf=np.ones(3))
    with pytest.raises(DatabaseError, match="is not a P2SF database"):
        load_database(tmp_path / "other.npz")


def test_a_cut_file_is_called_cut_and_a_changed_one_damaged(file, tmp_path):
    path = tmp_path / "a.npz"
    path.write_bytes(file.read_bytes()[:-100])
    with pytest.raises(DatabaseError, match="cut short"):
        load_database(path)
    content = bytearray(file.read_bytes())
    content[1000] ^= 1
    path.write_bytes(content)
    with pytest.raises(DatabaseError, match="contents do not match its seal"):
        load_database(path)


def resealed(file, path, change):
    """Write a file whose contents are changed and whose seal is right, as another program version would."""
    arrays = read_sealed(file, MARK)
    meta = json.loads(str(arrays[MARK]))
    change(meta, arrays)
    arrays[MARK] = np.array(json.dumps(meta))
    return write_sealed(path, arrays)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda meta, arrays: meta.update(schema=7), "has schema 7, newer than 3, the newest this P2SF reads; update"),
        (lambda meta, arrays: meta.update(kind="SplineDatabase"), "lacks what a P2SF database holds"),
        (lambda meta, arrays: meta.pop("schema"), "lacks what a P2SF database holds"),
        (lambda meta, arrays: meta.update(schema="new"), "lacks what a P2SF database holds"),
        (lambda meta, arrays: arrays.pop("series"), "lacks what a P2SF database holds"),
        (lambda meta, arrays: arrays.update(series=arrays["series"][:, :20]), "lacks what a P2SF database holds"),
        (lambda meta, arrays: arrays.update(depths_mm=arrays["depths_mm"][::-1]), "ascending order"),
    ],
)
def test_future_and_incomplete_files_are_refused_by_name(file, tmp_path, change, words):
    with pytest.raises(DatabaseError, match=words):
        load_database(resealed(file, tmp_path / "odd.npz", change))


def test_a_missing_file_and_a_missing_folder_are_sentences(lens, tmp_path):
    with pytest.raises(DatabaseError, match="cannot be read, no such file or directory; check the name"):
        load_database(tmp_path / "none.npz")
    with pytest.raises(ExportError, match="cannot be written"):
        save_database(build_database(lens, SPACE), lens, tmp_path / "none" / "a.npz")


def test_the_seal_covers_every_byte_but_itself(tmp_path):
    path = write_sealed(tmp_path / "a.npz", {"mark": np.arange(3)})
    whole = path.read_bytes()
    for place in range(len(whole)):
        content = bytearray(whole)
        content[place] ^= 0x20 if place >= len(whole) - DIGITS else 0x01
        path.write_bytes(content)
        with pytest.raises(DatabaseError):
            read_sealed(path, "mark")
    assert np.load(io.BytesIO(whole))["mark"].tolist() == [0, 1, 2]
