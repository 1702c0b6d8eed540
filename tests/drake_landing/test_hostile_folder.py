"""A folder of somebody else's is opened: nothing outside of it and `--out` is touched.

Every file that Python opens is reported by an audit hook, in a process of its own.
"""

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import pytest
from numba.core import config as numba_settings

import systems.tools.compiled  # noqa: F401  that takes no settings
from drake_landing.drawing_style import plain_style
from drake_landing.parts import field_pictures
from fem.errors import InputError
from fem.files.folders import claim

HERE = Path(__file__).parent
AUDIT = """
import json, os, sys

opened = []

def hook(event, arguments):
    if event == "open" and isinstance(arguments[0], (str, bytes)):
        flags = arguments[2] or 0
        writes = bool(flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT))
        opened.append((os.path.abspath(os.fsdecode(arguments[0])), writes))
    elif event in ("os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.symlink"):
        opened.append((os.path.abspath(os.fsdecode(arguments[0])), True))
    elif event == "socket.connect":
        opened.append((f"socket {arguments[1]}", True))

sys.addaudithook(hook)
from fem.exit_status import exit_status
if sys.argv[1] == "fem":
    from fem.cli import app
else:
    from drake_landing.cli import app
status = min(exit_status(app, "x", words) for words in json.loads(sys.argv[2]))
found = list(opened)
print(json.dumps({"status": status, "opened": found}), file=sys.__stdout__)
"""


def audited(
    program: str,
    *words: object,
    cwd: Path,
    then: Sequence[list[str]] = (),
    compiles: bool = True,
) -> tuple[int, list, str]:
    """Least status, (path, whether it was written) of all files, standard error.

    Commands of other words may follow in the same process. What `compiles` does so from
    nothing, which takes long.
    """
    done = subprocess.run(
        [sys.executable, "-c", AUDIT, program, json.dumps([[*map(str, words)], *then])],
        capture_output=True,
        text=True,
        check=False,
        cwd=cwd,
        env={
            **os.environ,
            "PYTHONPATH": str(HERE.parents[1]),
            "DRAKE_LANDING_CACHE": "off",
            "TMPDIR": str(cwd / "scratch"),
            # Machine code and lists of fonts go to folders of the user.
            "NUMBA_CACHE_DIR": str(cwd / "scratch"),
            "MPLCONFIGDIR": str(cwd / "scratch"),
            "NUMBA_DISABLE_JIT": str(int(not compiles)),
        },
    )
    told = json.loads(done.stdout.splitlines()[-1])
    return told["status"], told["opened"], done.stderr


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """`given` is the hostile folder; `outside` holds what it wants."""
    for name in ("given", "outside", "scratch", "outside/kept"):
        (tmp_path / name).mkdir()
    (tmp_path / "outside" / "secret").write_text("GRID,77,,1.,2.,3.\n")
    deck = (HERE / "tiny_aircraft.bdf").read_text()
    given = tmp_path / "given"
    given.joinpath("tiny_aircraft.bdf").write_text(deck)
    given.joinpath("case.yaml").write_text((HERE / "tiny_case.yaml").read_text())
    for name in ("../outside/secret", "a/../../outside/secret", "link"):
        text = deck.replace("ENDDATA", f"INCLUDE '{name}'\nENDDATA")
        text = text if "INCLUDE" in text else f"{text}\nINCLUDE '{name}'\n"
        given.joinpath(f"reads_{Path(name).name}_{len(name)}.bdf").write_text(text)
    (given / "link").symlink_to(tmp_path / "outside" / "secret")
    (given / "a").mkdir()
    return tmp_path


def outside(opened: list, place: Path) -> list:
    return [path for path, _ in opened if path.startswith(str(place / "outside"))]


def written(opened: list, *allowed: Path) -> list:
    """What was written elsewhere."""
    places = (*map(str, allowed), "/dev/")
    return [path for path, writes in opened if writes and not path.startswith(places)]


def state(folder: Path) -> dict:
    return {str(p): p.read_bytes() if p.is_file() else b"" for p in folder.rglob("*")}


def test_no_deck_reads_what_lies_outside(place: Path) -> None:
    decks = sorted((place / "given").glob("reads_*.bdf"))
    assert len(decks) == 3
    several = [[str(deck), "--out", str(place / "out")] for deck in decks]
    status, opened, told = audited("fem", *several[0], cwd=place, then=several[1:])
    assert status == 2, told
    assert told.count("outside the folder of the deck") == 3
    assert "77" not in told
    assert outside(opened, place) == []
    assert written(opened, place / "out", place / "scratch") == []


def test_results_replace_links_and_do_not_follow_them(place: Path) -> None:
    out, secret = place / "out", place / "outside" / "secret"
    out.mkdir()
    for name in ("tiny_aircraft.h5", "tiny_aircraft.op2", ".made-by", ".lock-x"):
        (out / name).symlink_to(secret)
    before = state(place / "outside")
    deck = place / "given" / "tiny_aircraft.bdf"
    status, opened, told = audited("fem", deck, "--op2", "--out", out, cwd=place)
    assert status == 0, told
    assert state(place / "outside") == before
    assert outside(opened, place) == []
    assert written(opened, out, place / "scratch") == []
    assert not (out / "tiny_aircraft.h5").is_symlink()


def test_a_link_in_place_of_a_folder_is_refused(place: Path) -> None:
    out = place / "out"
    out.mkdir()
    (out / "pictures").symlink_to(place / "outside" / "kept")
    with pytest.raises(InputError, match="pictures is a link to"):
        claim(out, "run tiny")


def test_a_check_writes_nothing(place: Path) -> None:
    before = state(place / "given")
    status, opened, told = audited(
        "drake-landing",
        "check",
        place / "given" / "case.yaml",
        cwd=place,
        compiles=False,
    )
    assert status == 0, told
    assert outside(opened, place) == []
    assert written(opened, place / "scratch") == []
    assert state(place / "given") == before


def test_what_lies_in_the_working_directory_is_no_setting(tmp_path, monkeypatch):
    (tmp_path / ".numba_config.yaml").write_text("dump_ir: 1\n")
    monkeypatch.chdir(tmp_path)
    numba_settings.reload_config()
    assert not numba_settings.DUMP_IR
    with mpl.rc_context({"text.usetex": True, "figure.dpi": 9.0}), plain_style():
        assert not mpl.rcParams["text.usetex"]
        assert mpl.rcParams["figure.dpi"] == mpl.rcParamsDefault["figure.dpi"]


WORKER = """
import multiprocessing, time
from fem.exit_status import run_command

def command(**_):
    context = multiprocessing.get_context("spawn")
    worker = context.Process(target=time.sleep, args=(0.0,))
    worker.start()
    worker.join()
    return worker.exitcode

if __name__ == "__main__":
    run_command(lambda: command, "x")
"""


def test_what_lies_in_the_working_directory_is_not_run(tmp_path, monkeypatch):
    for name in ("multiprocessing", "random", "bisect"):
        (tmp_path / f"{name}.py").write_text("open('ran', 'w')")
    program = tmp_path / "elsewhere" / "program.py"
    program.parent.mkdir()
    program.write_text(WORKER)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(field_pictures, "_TRY", "import bisect")
    assert field_pictures._vtk_draws.__wrapped__()
    environment = {**os.environ, "PYTHONPATH": str(HERE.parents[1])}
    done = subprocess.run([sys.executable, program], env=environment, check=False)
    assert done.returncode == 0
    assert not (tmp_path / "ran").exists()


@pytest.mark.slow
def test_a_run_writes_into_its_folder_alone(place: Path) -> None:
    before = state(place / "given")
    out = place / "out"
    status, opened, told = audited(
        "drake-landing", "run", place / "given" / "case.yaml", "--out", out, cwd=place
    )
    assert status == 0, told
    assert outside(opened, place) == []
    assert written(opened, out, place / "scratch") == []
    assert state(place / "given") == before
