"""The command line: exit states and messages, bad input of every kind."""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from drake_landing.cache import Cache
from drake_landing.cli import app, guarded

HERE = Path(__file__).parent
CASE = HERE.joinpath("tiny_case.yaml").read_text()
DECK = HERE.joinpath("tiny_aircraft.bdf").read_text()
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs a command line: exit status, standard output, standard error."""

    def run(*arguments: str | Path) -> tuple[int, str, str]:
        status = guarded(app, [str(a) for a in arguments])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return run


def written(folder: Path, case: str = CASE, deck: str | None = DECK) -> Path:
    if deck is not None:
        (folder / "tiny_aircraft.bdf").write_text(deck)
    path = folder / "case.yaml"
    path.write_text(case)
    return path


def changed(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new)


BAD_CASES = {
    "unknown key": (
        "sink_rate:",
        "sink_rte:",
        ["sink_rte", "did you mean 'sink_rate'"],
    ),
    "wrong unit": ("sink_rate: 1.2", "sink_rate: 240", ["found 240", "m/s"]),
    "sink rate 0": ("sink_rate: 1.2", "sink_rate: 0", ["found 0", "greater than 0"]),
    "no deck": ("deck: tiny_aircraft.bdf", "deck: gone.bdf", ["gone.bdf", "no such"]),
    "attachment node absent": (
        "attachment_node: 52",
        "attachment_node: 59",
        ["main_right", "grid 59", "52"],
    ),
    "monitoring point absent": ("tail: 9", "tail: 10", ["tail", "grid 10", "9"]),
}


@pytest.mark.parametrize(("old", "new", "words"), BAD_CASES.values(), ids=BAD_CASES)
def test_bad_cases(
    tmp_path: Path, command: Run, old: str, new: str, words: list[str]
) -> None:
    path = written(tmp_path, changed(CASE, old, new))
    status, _, message = command("run", path, "--out", tmp_path / "out")
    assert status == 2
    assert all(word in message for word in words), message
    assert "Traceback" not in message


BAD_DECKS = {
    "unsupported cards": (
        lambda t: changed(t, "ENDDATA", "CBEAM3,1,2,3,4\nCSEAM,5,6,7,8\nENDDATA"),
        ["CBEAM3", "CSEAM"],
    ),
    "empty": (lambda t: "", ["empty"]),
    "comments only": (lambda t: "$ nothing\n", ["empty"]),
    "truncated before the bulk data": (
        lambda t: t[: t.index("BEGIN BULK")],
        ["BEGIN BULK"],
    ),
    "truncated within": (
        lambda t: t[: t.index("GRID,41")],
        ["main_left", "grid 53", "may be cut off"],
    ),
    "not a deck": (lambda t: "\0\1\2", ["not a text file"]),
    "held": (
        lambda t: changed(
            changed(t, "METHOD = 1", "METHOD = 1\nSPC = 1"),
            "ENDDATA",
            "SPC1,1,3,3\nENDDATA",
        ),
        ["rigid-body modes, expected 6", "z"],
    ),
    "monitoring point held": (
        lambda t: changed(t, "GRID,1,,0.0,0.,0.", "GRID,1,,0.0,0.,0.,,3"),
        ["nose", "grid 1 ", "the PS field of GRID holds"],
    ),
    "loose part": (
        lambda t: changed(t, "ENDDATA", LOOSE + "ENDDATA"),
        ["motions without stiffness", "grid 9"],
    ),
    "node on its own": (
        lambda t: changed(t, "RBE2,652,21,123456,52\n", ""),
        ["main_right", "grid 52", "not connected"],
    ),
}
LOOSE = """GRID,91,,5.,0.,3.
GRID,92,,6.,0.,3.
CBAR,991,1,91,92,0.,0.,1.
CONM2,992,91,,5.
,1.,,1.,,,1.
CONM2,993,92,,5.
,1.,,1.,,,1.
"""


@pytest.mark.parametrize(("spoil", "words"), BAD_DECKS.values(), ids=BAD_DECKS)
def test_bad_decks(
    tmp_path: Path, command: Run, spoil: Callable[[str], str], words: list[str]
) -> None:
    path = written(tmp_path, deck=spoil(DECK))
    status, _, message = command("run", path, "--out", tmp_path / "out")
    assert status == 2, message
    assert all(word in message for word in words), message
    assert "Traceback" not in message


def test_deck_and_case_in_each_others_place(tmp_path: Path, command: Run) -> None:
    case = written(tmp_path)
    deck = tmp_path / "tiny_aircraft.bdf"
    assert f"{deck}: is a Nastran deck, expected a case" in command("run", deck)[2]
    assert f"{case}: is a YAML file, expected a Nastran" in command("show", case)[2]


def test_missing_case_file(tmp_path: Path, command: Run) -> None:
    status, _, message = command("run", tmp_path / "none.yaml")
    assert (status, message) == (2, f"error: {tmp_path}/none.yaml: no such case file\n")


@pytest.mark.parametrize(
    "arguments", [["fly"], ["run"], ["run", "a.yaml", "--colour"], ["check"]]
)
def test_wrong_usage(command: Run, arguments: list[str]) -> None:
    status, out, message = command(*arguments)
    assert status == 2
    assert message
    assert out == ""


def test_unwritable_folder(tmp_path: Path, command: Run) -> None:
    path = written(tmp_path)
    (tmp_path / "out").write_text("a file")
    status, _, message = command("run", path, "--out", tmp_path / "out")
    assert status == 2
    assert "out" in message
    assert "Traceback" not in message


def test_an_internal_failure_is_one_line_and_status_1(
    tmp_path: Path, command: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("oops")

    monkeypatch.setattr("drake_landing.case.reading.load_case", broken)
    status, _, message = command("check", tmp_path / "case.yaml")
    assert status == 1
    assert "internal failure: ZeroDivisionError: oops" in message
    assert "Traceback" not in message


def test_check_says_what_matters_first(tmp_path: Path, command: Run) -> None:
    case = written(tmp_path)
    status, out, message = command("check", case)
    assert (status, message) == (0, "")
    lines = out.splitlines()
    assert len(lines) < 24  # a terminal shows it all
    assert lines[0].startswith("tiny: Beam aircraft")
    for words in (
        "23 grids",
        "5,430.0 kg",
        "6 rigid-body motions, no mechanism",
        "main_right  telescopic, 2 wheels, 110.0 kg, stroke 0.25 m, at grid 52",
        "sink energy 4.1 kJ",
        "800 steps of 0.0005 s",
        "out/tiny: report.html",
    ):
        assert words in out
    assert "rebound_damping" not in out
    _, everything, _ = command("check", case, "--all")
    assert everything.startswith(lines[0])
    assert "rebound_damping: 8000.0" in everything
    assert list(tmp_path.glob("out*")) == []


BAD_FOR_CHECK = {
    "hinge": (
        lambda t: changed(t, "CBAR,111,2,22,23,", "CBAR,111,2,22,23,0.,0.,1.,\n,5\n$"),
        ["7 motions without stiffness", "freely moves in 1 way: grid 23", "grid 24"],
    ),
    "no mass": (
        lambda t: changed(t, "BEGIN BULK", "BEGIN BULK\nPARAM,WTMASS,0."),
        ["mass of 0", "CONM2"],
    ),
    **{name: BAD_DECKS[name] for name in ("held", "loose part", "node on its own")},
}


@pytest.mark.parametrize(("spoil", "words"), BAD_FOR_CHECK.values(), ids=BAD_FOR_CHECK)
def test_check_finds_what_run_would(
    tmp_path: Path, command: Run, spoil: Callable[[str], str], words: list[str]
) -> None:
    status, _, message = command("check", written(tmp_path, deck=spoil(DECK)))
    assert status == 2
    assert all(word in message for word in words), message


LATE = {
    "topology": (
        "deck: tiny_aircraft.bdf",
        "model: con\n  topology: 7",
        6,
        "airframe.topology: found '7', expected one of 1, 2",
    ),
    "matrices": (
        "deck: tiny_aircraft.bdf",
        "matrices: {files: [k.op4], grids: g.csv}",
        5,
        "airframe.matrices: ",
    ),
    "deck": ("deck: tiny_aircraft.bdf", "deck: tiny_aircraft.bd", 5, "airframe.deck"),
    "node": (
        "attachment_node: 52",
        "attachment_node: 59",
        27,
        "gears.main_right.attachment_node: found grid 59",
    ),
    "point": ("tail: 9", "tail: 10", 7, "airframe.monitoring.tail: found grid 10"),
    "brakes": ("forward_speed: 40", "forward_speed: 40, braking: 1", 8, "scenario.bra"),
    "lift": ("forward_speed: 40", "forward_speed: 40, lift: {}", 8, "scenario.lift"),
    "units": ("deck:", "units: in-lbf\n  deck:", 5, "airframe.units: found in-lbf"),
}


@pytest.mark.parametrize(("old", "new", "line", "words"), LATE.values(), ids=LATE)
@pytest.mark.parametrize("verb", ["check", "run"])
def test_problems_found_late_say_where(
    tmp_path: Path, command: Run, verb: str, old: str, new: str, line: int, words: str
) -> None:
    path = written(tmp_path, changed(CASE, old, new))
    out = ("--out", tmp_path / "out") if verb == "run" else ()
    status, _, message = command(verb, path, *out)
    assert status == 2
    assert f"{path}:{line}: {words}" in message, message


def test_folders_of_other_results_are_not_overwritten(
    tmp_path: Path, command: Run
) -> None:
    deck = tmp_path / "tiny_aircraft.bdf"
    written(tmp_path)
    arguments = ("show", deck, "--modes", 0, "--out", tmp_path / "out")
    assert command(*arguments)[0] == 0
    assert command(*arguments)[0] == 0  # its own results it may replace
    status, _, message = command("reduce", deck, "--out", tmp_path / "out")
    assert status == 2
    assert "holds the results of 'show tiny_aircraft.bdf'" in message


def test_version(command: Run) -> None:
    status, out, _ = command("--version")
    assert status == 0
    assert out.startswith("drake-landing 0.")


def test_cache_is_shown_and_cleared(
    tmp_path: Path, command: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept, code = tmp_path / "kept", tmp_path / "code"
    monkeypatch.setenv("DRAKE_LANDING_CACHE", str(kept))
    monkeypatch.setenv("DRAKE_LANDING_CACHE_GB", "2")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(code))
    Cache.of_user().keep("modes", "a", {"x": np.zeros(1000)})
    for owner in ("drake-landing", "another"):
        (code / owner).mkdir(parents=True)
    assert "1 entries, 0.0 MB of at most 2 GB" in command("cache")[1]
    assert "deleted 1 entries" in command("cache", "--clear")[1]
    assert list(kept.iterdir()) == []
    assert [path.name for path in code.iterdir()] == ["another"]
    monkeypatch.setenv("DRAKE_LANDING_CACHE", "off")
    assert "nothing is kept" in command("cache")[1]


def test_an_interrupt_is_one_line_and_leaves_nothing_half_written(
    tmp_path: Path,
) -> None:
    """The signal comes while the landing is being simulated."""
    case = written(tmp_path, changed(CASE, "duration: 0.4", "duration: 50"))
    run = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "drake_landing",
            "run",
            case,
            "--out",
            tmp_path / "o",
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # Where the tests run in the background a shell has it ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert run.stderr is not None
    for line in run.stderr:
        if "landing" in line:
            break
    time.sleep(2.0)
    run.send_signal(signal.SIGINT)
    out, message = run.communicate(timeout=60)
    assert run.returncode == 130
    assert out == ""
    *_, kept, last = message.splitlines()
    assert last == "interrupted"
    assert kept.startswith("modes found so far are kept for the next run; again: ")
    assert kept.endswith(f"drake-landing run {case} --out {tmp_path / 'o'}")
    assert "Traceback" not in message
    assert [p.name for p in (tmp_path / "o").rglob("*part*")] == []
    assert not (tmp_path / "o" / "report.html").exists()


def test_schema_is_json(command: Run) -> None:
    status, out, _ = command("check", "--schema")
    assert status == 0
    assert json.loads(out)["title"] == "Case"


def test_reference_aircraft_is_written(tmp_path: Path, command: Run) -> None:
    path = tmp_path / "con.bdf"
    status, out, _ = command("model", "con", "--out", path)
    assert status == 0
    assert "614 grids" in out
    assert path.read_text().count("\nGRID") == 614
    status, _, message = command("model", "cone", "--out", path)
    assert status == 2
    assert "did you mean 'con'" in message


def test_help_needs_no_drake() -> None:
    """Answers that cost no computation come at once."""
    code = (
        "import sys; from drake_landing.cli import app, guarded\n"
        "status = guarded(app, ['--help']) or guarded(app, ['check', '--schema'])\n"
        "heavy = {'pydrake', 'matplotlib', 'scipy'} & set(sys.modules)\n"
        "sys.exit(f'{status} {heavy}' if status or heavy else 0)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "demo" in done.stdout
