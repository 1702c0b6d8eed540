"""Files from outside that are none, or are in another encoding."""

import os
from pathlib import Path

import pytest

from fem.errors import InputError
from fem.input_files import input_text


def test_text_with_and_without_a_mark(tmp_path):
    path = tmp_path / "a"
    for mark in (b"", b"\xef\xbb\xbf"):
        path.write_bytes(mark + "é".encode())
        assert input_text(path, "case file") == "é"


@pytest.mark.timeout(10)
@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda path: None, "no such case file"),
        (os.mkdir, "is a folder, expected a case file"),
        (os.mkfifo, "is a device or pipe"),  # nobody writes: reading would not end
        (lambda path: path.write_bytes(b"a" * 101), "expected a case file of at most"),
        (lambda path: path.write_text("a", "utf-16"), "text in UTF-16"),
        (lambda path: path.write_bytes(b"a\xff"), r"not a UTF-8 text file \(byte 1\)"),
        (lambda path: path.symlink_to(path), "symbolic links"),
    ],
)
def test_what_is_no_text_file_is_named(tmp_path, make, words):
    path = tmp_path / "a"
    make(path)
    with pytest.raises(InputError, match=words) as caught:
        input_text(path, "case file", 100)
    assert str(caught.value).startswith(str(path))


def test_names_that_no_file_can_have():
    with pytest.raises(InputError, match="null"):
        input_text(Path("a\0b"), "case file")
