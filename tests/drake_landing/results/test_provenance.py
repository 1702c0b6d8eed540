"""What a run says of its making survives, and tells files that have changed."""

import shutil
from pathlib import Path

import h5py
import pytest

from drake_landing.case.reading import load_case
from drake_landing.cli import app, guarded
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.report.gear_echo import gear_echo
from drake_landing.results.provenance import Provenance, gears_text, read_provenance
from fem.errors import InputError

HERE = Path(__file__).parents[1]


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """Results of a case whose deck includes a file."""
    text = (HERE / "tiny_aircraft.bdf").read_text()
    bulk = text.index("BEGIN BULK") + len("BEGIN BULK\n")
    (tmp_path / "bulk.inc").write_text(text[bulk:].replace("ENDDATA", "$"))
    (tmp_path / "tiny_aircraft.bdf").write_text(
        text[:bulk] + "INCLUDE 'bulk.inc'\nENDDATA\n"
    )
    shutil.copy(HERE / "tiny_case.yaml", tmp_path / "case.yaml")
    case = load_case(tmp_path / "case.yaml")
    folder = tmp_path / "out"
    folder.mkdir()
    made = Provenance.begin(case, prepare_aircraft(case, folder), folder)
    with h5py.File(folder / "results.h5", "w") as file:
        made.write(file, 12.0)
    return folder


def test_it_reads_back_with_deck_include_and_case(out: Path) -> None:
    made = read_provenance(out)
    assert [(m.role, m.path) for m in made.files] == [
        ("case", "../case.yaml"),
        ("deck", "../tiny_aircraft.bdf"),
        ("include", "../bulk.inc"),
    ]
    assert {"load case", "started", "program", "Drake", "duration"} <= set(made.facts)
    assert made.changes(out) == []
    assert guarded(app, ["show-run", str(out)]) == 0


@pytest.mark.parametrize("name", ["case.yaml", "tiny_aircraft.bdf", "bulk.inc"])
def test_a_file_that_changes_is_named(
    out: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = out.parent / name
    path.write_text(path.read_text() + "\n")
    assert [name in text for text in read_provenance(out).changes(out)] == [True]
    assert guarded(app, ["show-run", str(out)]) == 2
    assert "has changed since the run" in capsys.readouterr().err
    path.unlink()
    assert "is not there" in read_provenance(out).changes(out)[0]


def test_gear_data_that_were_tampered_with_are_told(out: Path) -> None:
    with h5py.File(out / "results.h5", "a") as file:
        text = file["provenance/gears"].asstr()[()]
        del file["provenance/gears"].attrs["sha256"]
        file["provenance/gears"].attrs["sha256"] = "0" * 64
    assert '"stiffness": 250000.0' in text
    assert "gear data" in read_provenance(out).changes(out)[0]


def test_folders_without_results_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"no results\.h5"):
        read_provenance(tmp_path)
    (tmp_path / "results.h5").write_text("text")
    with pytest.raises(InputError, match="no HDF5"):
        read_provenance(tmp_path)


def test_the_echo_has_each_value_with_its_meaning() -> None:
    gears = load_case(HERE / "tiny_case.yaml").gears
    assert not isinstance(gears, str)
    rows = {row[0].text: row for row in gear_echo(gears, "the case").rows}
    stiffness = rows["tyre.stiffness"]
    assert [cell.text for cell in stiffness[2:]] == ["250000", "500000", "500000"]
    assert "N/m" in stiffness[1].text
    assert all(row[1].text for name, row in rows.items() if name != "kind")
    assert '"attachment_node": 51' in gears_text(gears)
