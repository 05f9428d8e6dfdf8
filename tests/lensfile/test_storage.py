"""Lens files on disk: missing, broken or huge ones and a full disk are errors, and no partial file is left."""

import os
from dataclasses import replace

import pytest

from p2sf.errors import LensFileError
from p2sf.files.atomic import write_whole
from p2sf.lensfile.source_text import LARGEST_FILE
from p2sf.lensfile.toml.lens import parse_toml, read_toml, write_toml

GOOD = "[aperture]\nf_number = 8\n\n[[surface]]\nradius = 50.0\nthickness = 90.0\nglass = 1.5\n"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "the file is empty; write into it, or name another"),
        (b" \n\t\n", "the file is empty"),
        (b'title = "a"\nsource = "\xff\xfe"\n', "line 2: the file is not UTF-8 text; save it as UTF-8"),
        (b"#" * (LARGEST_FILE + 1), f"larger than {LARGEST_FILE} bytes; this is not a lens file"),
        (bytes(range(256)), "not UTF-8"),
    ],
)
def test_bytes_that_are_no_lens_file(content, said, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_bytes(content)
    with pytest.raises(LensFileError) as caught:
        read_toml(path)
    assert str(path) in str(caught.value) and said in str(caught.value)


def test_missing_files_and_folders(tmp_path):
    with pytest.raises(LensFileError, match=r"gone\.toml: there is no such file; check the path"):
        read_toml(tmp_path / "gone.toml")
    with pytest.raises(LensFileError, match="this is a folder; name a file in it"):
        read_toml(tmp_path)
    with pytest.raises(LensFileError, match=r"cannot be read .*; check its path"):
        read_toml("nul\0byte.toml")


def test_a_byte_order_mark_is_no_mistake(tmp_path):
    (tmp_path / "bom.toml").write_bytes(b"\xef\xbb\xbf" + GOOD.replace("\n", "\r\n").encode())
    assert read_toml(tmp_path / "bom.toml") == replace(parse_toml(GOOD), name="bom")


def test_a_file_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    path = tmp_path / "lens.toml"
    path.write_text("what was here before")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(LensFileError, match=r"cannot be written \(no space left on device\); choose another place"):
        write_toml(parse_toml(GOOD), path)
    assert path.read_text() == "what was here before" and os.listdir(tmp_path) == ["lens.toml"]


def test_without_files_that_have_no_name_a_file_is_still_whole(tmp_path, monkeypatch):
    """Some systems know none; what breaks off then leaves nothing either."""

    def refuse(handle):
        handle.write(b"half")
        raise OSError("none here")

    monkeypatch.setattr("p2sf.files.atomic._nameless_file", lambda folder: None)
    write_whole(tmp_path / "a", lambda handle: handle.write(b"whole"))
    with pytest.raises(OSError, match="none here"):
        write_whole(tmp_path / "a", refuse)
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("a", b"whole")]


def test_writing_into_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(LensFileError, match="cannot be written"):
        write_toml(parse_toml(GOOD), tmp_path / "no" / "lens.toml")
