"""Aircraft from CPACS files: their geometry, named defaults, bad files."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.aircraft import build
from drake_landing.aircraft.cpacs import write_cpacs_model
from drake_landing.aircraft.cpacs_reader import read_cpacs
from drake_landing.aircraft.facts import facts, table
from drake_landing.aircraft.geometry import wing
from drake_landing.cli import app, guarded
from fem.deck.reader import read_deck
from fem.errors import InputError

SMALL = """<cpacs><header><cpacsVersion>3.2</cpacsVersion></header><vehicles>
<aircraft><model uID="m"><name>small</name><wings>
<wing uID="w" symmetry="x-z-plane">
<transformation><translation><x>10</x><y>0</y><z>-1</z></translation></transformation>
<sections>{sections}</sections><positionings>
<positioning><length>0</length><sweepAngle>0</sweepAngle>
<dihedralAngle>0</dihedralAngle><toSectionUID>s0</toSectionUID></positioning>
<positioning><length>10</length><sweepAngle>30</sweepAngle>
<dihedralAngle>5</dihedralAngle><fromSectionUID>s0</fromSectionUID>
<toSectionUID>s1</toSectionUID></positioning>
</positionings></wing></wings></model></aircraft><profiles><wingAirfoils>
<wingAirfoil uID="a"><pointList><z>0;.06;0;-.06;0</z></pointList></wingAirfoil>
</wingAirfoils></profiles></vehicles></cpacs>"""
SECTION = """<section uID="s{k}"><elements><element uID="e{k}">
<airfoilUID>a</airfoilUID>
<transformation><scaling><x>{c}</x><y>1</y><z>{c}</z></scaling></transformation>
</element></elements></section>"""


def small(folder: Path, **change: str) -> Path:
    sections = SECTION.format(k=0, c=5) + SECTION.format(k=1, c=change.get("c", 2))
    path = folder / "small.xml"
    path.write_text(SMALL.format(sections=sections))
    return path


@pytest.fixture(scope="session")
def d150() -> Path:
    folder = Path(__file__).resolve().parents[4] / "shared" / "data" / "d150"
    if not folder.is_dir():
        pytest.skip(f"CPACS files are not there: {folder}")
    return folder


def test_positionings_and_scalings(tmp_path: Path) -> None:
    found = read_cpacs(small(tmp_path)).wing
    assert found is not None
    sweep, up = np.deg2rad([30.0, 5.0])
    tip = [np.sin(sweep), np.cos(sweep) * np.cos(up), np.cos(sweep) * np.sin(up)]
    np.testing.assert_allclose(found.leading, [[0, 0, 0], 10 * np.array(tip)])
    np.testing.assert_allclose(found.chord, [5.0, 2.0])
    np.testing.assert_allclose(found.thickness, [0.6, 0.24])
    assert found.spars is None


def test_the_source_gives_the_built_in_wing(d150: Path, tmp_path: Path) -> None:
    found = write_cpacs_model(d150 / "D150_v201.xml", "con", tmp_path / "a.bdf")
    assert {"wing spars", "fuselage frames", "material al2024"} <= set(found.taken)
    own = build("con")
    assert found.model.grid_id.tolist() == own.grid_id.tolist()
    away = np.linalg.norm(found.model.position - own.position, axis=1)
    # The structural axis is the chord line's middle here, the source's own there.
    assert away.max() < 0.2
    assert found.model.masses["mass"].sum() == pytest.approx(own.masses["mass"].sum())


@pytest.mark.parametrize("file", ["D150_v201.xml", "CPACS_30_D150.xml"])
def test_pre_from_a_file_can_be_read(d150: Path, tmp_path: Path, file: str) -> None:
    out = tmp_path / "a.bdf"
    found = write_cpacs_model(d150 / file, "pre", out)
    deck = read_deck(out)
    assert len(deck.cards["GRID"]) == pytest.approx(13790, rel=0.02)
    assert "ribs" in found.defaults
    assert ("fuselage frames" in found.taken) == (file == "D150_v201.xml")
    # The built-in aircraft is itself again.
    assert wing().leading[0, 2] == facts("wing")["planform"][0][2] == -1.2423
    assert len(table("fuselage_frames")) == 86


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<cpacs><vehicles></cpacs>", "no XML"),
        ("<other/>", "expected <cpacs>"),
        ("<cpacs/>", "no vehicles/aircraft/model"),
        (SMALL.format(sections="").replace("<length>10<", "<length>ten<"), "'ten'"),
    ],
)
def test_bad_files(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "bad.xml"
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        read_cpacs(path)


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line = ["model", "from-cpacs", str(tmp_path / "gone.xml")]
    assert guarded(app, [*line, "--out", str(tmp_path / "a.bdf")]) == 2
    assert "no such file" in capsys.readouterr().err
    assert guarded(app, ["model", "con", "--out", str(tmp_path / "a.bdf")]) == 0
