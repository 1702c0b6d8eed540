"""Names that would be code elsewhere stay text in every output of a run."""

import csv
from html.parser import HTMLParser
from pathlib import Path

import h5py
import pytest
import yaml

from drake_landing.case.reading import load_case, parse_case
from drake_landing.csv_tables import write_csv
from drake_landing.process import run as process
from drake_landing.terminal import show
from fem.errors import InputError
from fem.exit_status import exit_status
from fem.files.escaping import attribute, cell, comment, file_name, group_name

HERE = Path(__file__).parent
NAMES = [
    'tip" onload="alert(1)',
    "</text><script>alert(1)</script> $\\frac$ 機",
    "a/../b",
    "..",
    "=1+1 {{ 7 * 7 }}",
]


class Page(HTMLParser):
    """What a browser would run or fetch."""

    def __init__(self) -> None:
        super().__init__()
        self.active: list[str] = []
        self.policy = ""

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        if values.get("http-equiv") == "Content-Security-Policy":
            self.policy = values["content"]
        if tag in ("script", "iframe", "object", "embed", "base", "foreignobject"):
            self.active.append(tag)
        for name, value in attrs:
            outside = name in ("src", "href", "xlink:href") and not (
                value.startswith(("#", "data:image/png;base64,"))
                or (tag == "a" and value in OWN_PAGES)
            )
            if name.startswith("on") or outside:
                self.active.append(f"{tag} {name}={value}")


OWN_PAGES = ("landing.html", "histories.html")  # of the run, beside the report
WRITTEN: list[tuple] = []  # what the run gave to `write_all`


@pytest.fixture(scope="module")
def out(tmp_path_factory) -> Path:
    """A run in which everything that may be named has a hostile name."""
    folder = tmp_path_factory.mktemp("hostile")
    case = yaml.safe_load((HERE / "tiny_case.yaml").read_text())
    case["airframe"]["deck"] = str(HERE / "tiny_aircraft.bdf")
    case["title"] = NAMES[0] + NAMES[1]
    case["airframe"]["monitoring"] = dict(zip(NAMES, [1, 5, 9, 24, 34]))
    case["simulation"] = {"duration": 0.1}
    names = iter(NAMES)
    case["parts"] = {
        "beams": [
            {"name": next(names), "outward": "starboard", "first": 1.0, "last": 4.0}
            | {"count": 2}
            for _ in range(2)
        ],
        "panels": [{"name": name, "grid": 5, "beside": [4, 6]} for name in NAMES[:2]],
        "equipment": dict(zip(NAMES[1:3], [4, 5])),
        "components": {NAMES[2]: {"properties": [1]}},
    }
    path = folder / "case.yaml"
    path.write_text(yaml.safe_dump(case, allow_unicode=True), encoding="utf-8")
    write_all = process.write_all
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            process, "write_all", lambda *a: WRITTEN.append(a) or write_all(*a)
        )
        process.run_case(load_case(path), folder / "out")
    return folder / "out"


def test_nothing_runs_in_the_report(out):
    page = Page()
    page.feed((out / "report.html").read_text(encoding="utf-8"))
    assert page.active == []
    assert page.policy.startswith("default-src 'none'")
    assert "script-src" not in page.policy


def test_no_cell_is_a_formula(out):
    tables = sorted(out.glob("*.csv"))
    assert tables
    for table in tables:
        with table.open(encoding="utf-8", newline="") as file:
            for row in csv.reader(file):
                assert all(text == cell(text) for text in row)


def test_files_stay_in_the_folder(out):
    names = {path.name for path in out.parent.iterdir()}
    assert names == {"case.yaml", "out"}
    assert {p.parent for p in out.rglob("*") if p.is_file()} <= {out, out / "pictures"}


def test_results_hold_every_name(out):
    with h5py.File(out / "results.h5") as file:
        assert set(file["fe/monitoring"]) == set(map(group_name, NAMES))
        assert all("value" in group for group in file["fe/monitoring"].values())


def test_the_deck_is_one_deck(out):
    lines = (out / "landing_sol109.bdf").read_text(encoding="utf-8").splitlines()
    assert sum(line.startswith("TITLE") for line in lines) == 1
    assert lines.count("CEND") == 1


@pytest.mark.parametrize("name", ["a\nb", "", " ", "x" * 81, "\x1b[2J"])
def test_names_that_are_no_line(name):
    case = yaml.safe_load((HERE / "tiny_case.yaml").read_text())
    case["airframe"]["monitoring"] = {name: 5}
    with pytest.raises(InputError, match=r"monitoring") as caught:
        parse_case(yaml.safe_dump(case))
    assert "\x1b" not in str(caught.value)


@pytest.mark.parametrize("text", ["a\nb", "\x1b]0;b\x07", "x" * 1001])
def test_titles_that_are_no_line(text):
    case = yaml.safe_load((HERE / "tiny_case.yaml").read_text())
    case["title"] = text
    case["airframe"]["mass_cases"] = {text: {"remove": [505]}}
    with pytest.raises(InputError) as caught:
        parse_case(yaml.safe_dump(case))
    fields = [problem.split(": ")[1] for problem in caught.value.problems]
    assert fields[0].startswith("airframe.mass_cases")
    assert fields[1] == "title"


def test_a_picture_that_fails_costs_the_picture(tmp_path, monkeypatch, out):
    def fail(*_):
        raise RuntimeError("no browser")

    monkeypatch.setattr("drake_landing.replay.record.write_replay", fail)
    monkeypatch.setattr("drake_landing.parts.gallery.stress_pictures", fail)
    result, _, watch = WRITTEN[-1]
    written = []
    monkeypatch.setattr(
        "drake_landing.report.write_report", lambda _, *about: written.append(about)
    )
    process.write_all(result, tmp_path, watch)
    found, pictures, unable, *_ = written[0]
    assert "landing.html, the replay, could not be made: RuntimeError: no browser" in (
        found.notices
    )
    assert pictures == []
    assert "failed" in unable


def test_file_names():
    assert file_name("right wing") == "right_wing"
    hostile = {file_name(name) for name in [*NAMES, "/", "", "a_b", "y" * 300]}
    assert len(hostile) == len(NAMES) + 4
    assert all(name and len(name) < 100 and "/" not in name for name in hostile)


def test_groups_comments_attributes_cells(tmp_path):
    assert group_name("a/b") == "a%2Fb"
    assert group_name("..") == "%2E%2E"
    assert comment("a\nENDDATA\rb") == "a ENDDATA b"
    assert attribute('"<') == "&quot;&lt;"
    assert [cell(t) for t in ("=1", "-1", "-x", "nose")] == ["'=1", "-1", "'-x", "nose"]


def test_terminals_show_what_would_move_or_color_them(capsys):
    show("a\tb\x1b[2J\r\nc\u202e\x9b \N{NO-BREAK SPACE}機")
    assert capsys.readouterr().out == (
        "a\tb\\x1b[2J\\r\nc\\u202e\\x9b \N{NO-BREAK SPACE}機\n"
    )
    assert exit_status(_refuses, "x", ["\x1b[2J"]) == 2
    assert capsys.readouterr().err == "error: \\x1b[2J: not there\n"


def _refuses(args, **_):
    raise FileNotFoundError(2, "not there", args[0])


def test_written_tables_hold_no_formulas(tmp_path):
    import pandas as pd

    write_csv(tmp_path / "t.csv", pd.DataFrame({"=name": ["=1+1", "ok"], "x": [-1, 2]}))
    assert (tmp_path / "t.csv").read_text() == "'=name,x\n'=1+1,-1\nok,2\n"
