"""INCLUDE reads below the folder of the deck, and where the user says."""

import os
from pathlib import Path

import pytest

from fem.cli import _status
from fem.deck.reader import read_deck
from fem.deck.text.source import include_reach, read_source
from fem.errors import InputError

SECRET = "root:x:0:0 secret\nuser:y:1:1 secret\n"


@pytest.fixture
def place(tmp_path) -> Path:
    """A deck's folder beside one that is none of its business."""
    (tmp_path / "deck" / "sub").mkdir(parents=True)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "grids.inc").write_text("GRID,1\n")
    (tmp_path / "other" / "secret").write_text(SECRET)
    (tmp_path / "deck" / "sub" / "own.inc").write_text("GRID,2\n")
    return tmp_path


def deck(place: Path, *names: str) -> Path:
    path = place / "deck" / "a.bdf"
    path.write_text("BEGIN BULK\n" + "".join(f"INCLUDE '{n}'\n" for n in names))
    return path


def test_below_the_deck(place):
    texts = [line.text for line in read_source(deck(place, "sub/own.inc")).lines]
    assert "GRID,2" in texts


@pytest.mark.parametrize(
    "way", ["../other/grids.inc", "{place}/other/grids.inc", "link"]
)
def test_outside_is_refused_with_what_would_allow_it(place, way):
    (place / "deck" / "link").symlink_to(place / "other" / "grids.inc")
    path = deck(place, way.format(place=place))
    with pytest.raises(InputError, match=r"a\.bdf:2: INCLUDE of .*--include-path"):
        read_source(path)
    with include_reach([place / "other"]):
        assert any("GRID,1" in line.text for line in read_source(path).lines)
    with include_reach(trust=True):
        assert any("GRID,1" in line.text for line in read_source(path).lines)


def test_folders_that_are_given_are_searched(place):
    with include_reach([place / "other"]):
        texts = [line.text for line in read_source(deck(place, "grids.inc")).lines]
    assert "GRID,1" in texts


def test_lines_of_what_is_no_deck_are_not_shown(place, capsys):
    path = deck(place, "../other/secret")
    assert _status([str(path), "--trust", "--out", str(place / "out")]) == 2
    error = capsys.readouterr().err
    assert "secret: holds no card" in error
    assert "x:0:0" not in error


def test_devices_and_pipes(place):
    os.mkfifo(place / "deck" / "pipe.bdf")
    with pytest.raises(InputError, match="is a device"):
        read_deck(place / "deck" / "pipe.bdf")


def test_depth_is_limited(place):
    folder = place / "deck"
    for k in range(30):
        (folder / f"{k}.inc").write_text(f"INCLUDE '{k + 1}.inc'\n")
    (folder / "30.inc").write_text("GRID,1\n")
    with pytest.raises(InputError, match="INCLUDE more than 20 deep"):
        read_source(deck(place, "0.inc"))


def test_trees_that_double_are_limited(place):
    folder = place / "deck"
    for k in range(12):
        (folder / f"{k}.inc").write_text(f"INCLUDE '{k + 1}.inc'\n" * 2)
    (folder / "12.inc").write_text("GRID,1\n")
    with pytest.raises(InputError, match="more than 2,000 files"):
        read_source(deck(place, "0.inc"))


def test_a_line_without_end(place):
    path = place / "deck" / "long.bdf"
    path.write_text("GRID,1" + "," * 20_000_000)
    with pytest.raises(InputError, match="a line of 20,000,006 characters"):
        read_source(path)
