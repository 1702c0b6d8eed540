"""The store finds what it knows, and never trusts what is damaged."""

import itertools
import json
import os
import time
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp

from drake_landing.cache import Arrays, Cache, content_key
from fem.errors import InputError


class Builder:
    def __init__(self) -> None:
        self.calls = 0

    def __call__(self) -> Arrays:
        self.calls += 1
        return {"a": np.arange(6.0).reshape(2, 3), "b": np.array([1, 2])}


def test_second_time_nothing_is_built(tmp_path: Path) -> None:
    build, cache = Builder(), Cache(tmp_path / "new")
    first = cache.arrays("modes", "k1", build)
    again = Cache(tmp_path / "new").arrays("modes", "k1", build)
    assert build.calls == 1
    assert first.keys() == again.keys()
    np.testing.assert_array_equal(first["a"], again["a"])
    cache.arrays("modes", "k2", build)
    assert build.calls == 2


DAMAGE = "flip, cut, no manifest, format, garbage, array struck, list, deep"


@pytest.mark.parametrize("damage", DAMAGE.split(", "))
def test_damaged_entries_are_built_anew(tmp_path: Path, damage: str) -> None:
    build, cache = Builder(), Cache(tmp_path)
    cache.arrays("modes", "k", build)
    place = tmp_path / "modes-k"
    array, manifest = place / "a.npy", place / "entry.json"
    match damage:
        case "flip":
            data = bytearray(array.read_bytes())
            data[-3] ^= 1
            array.write_bytes(data)
        case "cut":
            array.write_bytes(array.read_bytes()[:-8])
        case "no manifest":
            manifest.unlink()
        case "format":
            manifest.write_text(
                manifest.read_text().replace('"format": ', '"format": 9')
            )
        case "garbage":
            manifest.write_text("[1, 2")
        case "array struck":
            text = json.loads(manifest.read_text())
            del text["arrays"]["b"]
            manifest.write_text(json.dumps(text))
        case "list":
            manifest.write_text('{"format": 2, "arrays": [], "checksum": 1}')
        case "deep":
            manifest.write_text("[" * 100_000)
    found = cache.arrays("modes", "k", build)
    assert build.calls == 2
    np.testing.assert_array_equal(found["a"], np.arange(6.0).reshape(2, 3))
    cache.arrays("modes", "k", build)
    assert build.calls == 2


def test_interrupted_builds_leave_nothing(tmp_path: Path) -> None:
    def fails() -> Arrays:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Cache(tmp_path).arrays("modes", "k", fails)
    assert list(tmp_path.iterdir()) == []


def test_longest_unused_entries_go_first(tmp_path: Path) -> None:
    build = Builder()
    cache = Cache(tmp_path, limit_gb=800e-9)
    cache.arrays("x", "old", build)
    os.utime(tmp_path / "x-old", (1.0, 1.0))
    cache.arrays("x", "new", build)
    assert {p.name for p in tmp_path.iterdir()} == {"x-new"}


def test_an_unwritable_place_costs_time_only(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    build = Builder()
    found = Cache(blocked / "below").arrays("x", "k", build)
    assert set(found) == {"a", "b"}
    assert set(Cache(None).arrays("x", "k", build)) == {"a", "b"}


def test_keys_tell_content_apart() -> None:
    matrix = sp.csr_matrix(np.diag([1.0, 2.0]))
    other = sp.csr_matrix(np.diag([1.0, 2.0 + 1e-15]))
    keys = {
        content_key(*parts)
        for parts in (
            (1,),
            (1.0,),
            ("1",),
            (None,),
            ([1, 2], 3),
            ([1], [2, 3]),
            (np.zeros(2),),
            (np.zeros((2, 1)),),
            (np.zeros(2, int),),
            (matrix,),
            (other,),
            ({"a": 1},),
        )
    }
    assert len(keys) == 12
    assert content_key(matrix) == content_key(sp.coo_matrix(matrix))
    with pytest.raises(TypeError, match="object"):
        content_key(object())


def test_environment_names_the_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("DRAKE_LANDING_CACHE", str(tmp_path))
    assert Cache.of_user().folder == tmp_path
    monkeypatch.setenv("DRAKE_LANDING_CACHE", "off")
    assert Cache.of_user().folder is None


@pytest.mark.parametrize("text", ["²", "nan", "-1", "1e999", "8 GB"])
def test_a_size_that_is_none_is_refused(text, monkeypatch) -> None:
    monkeypatch.setenv("DRAKE_LANDING_CACHE_GB", text)
    with pytest.raises(InputError, match="DRAKE_LANDING_CACHE_GB: found"):
        Cache.of_user()


def test_clocks_that_jump_cost_time_alone(tmp_path: Path, monkeypatch) -> None:
    """By years, while entries are written: they are found, or built anew."""
    jumps = itertools.cycle([0.0, 1e10, 3e10, 1.0])
    monkeypatch.setattr(time, "time", lambda: next(jumps))
    first, other = Cache(tmp_path), Cache(tmp_path, limit_gb=1e-9)
    monkeypatch.setattr(np, "save", _meanwhile(np.save, other))
    wanted = Builder()()
    for k in range(8):
        found = first.arrays("modes", f"k{k % 3}", Builder())
        assert all(np.array_equal(found[name], wanted[name]) for name in wanted)
    assert not list(tmp_path.glob(".part-*"))


def _meanwhile(save, other: Cache):
    """Another process makes room, and takes what is being written for left over."""

    def saved(file, values, **options):
        save(file, values, **options)
        other._make_room(keep=other.folder / "none")

    return saved


def test_not_a_number_is_never_kept(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    found = cache.arrays("modes", "k", lambda: {"a": np.array([1.0, np.nan])})
    assert np.isnan(found["a"][1])
    assert cache.find("modes", "k") is None


def test_what_a_killed_process_left_goes_after_a_day(tmp_path: Path) -> None:
    old, new = tmp_path / ".part-old", tmp_path / ".part-new"
    for place in (old, new):
        place.mkdir()
        (place / "a.npy").write_text("half")
    os.utime(old, (1.0, 1.0))
    Cache(tmp_path).arrays("modes", "k", Builder())
    assert new.is_dir()
    assert not old.exists()
