"""Aircraft from CPACS files: their geometry, named defaults, bad files."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.cli import app, guarded
from drake_landing.reference.d150 import build
from drake_landing.reference.d150.cpacs import rib_table, write_cpacs_model
from drake_landing.reference.d150.cpacs_reader import read_cpacs
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import wing
from fem.algebra.modes import normal_modes
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure

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
    assert "wing ribs (30)" in found.taken
    assert "ribs of tailplane and fin" in found.defaults
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
        (
            SMALL.format(
                sections=SECTION.format(k=0, c=5) + SECTION.format(k=1, c=2)
            ).replace("<length>10<", "<length>0<"),
            "has no span along y",
        ),
    ],
)
def test_bad_files(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "bad.xml"
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        read_cpacs(path)


SPARS = """<componentSegments><componentSegment><structure><ribsDefinitions>
<ribsDefinition><ribsPositioning>{ribs}</ribsPositioning></ribsDefinition>
<ribsDefinition><ribsPositioning><ribReference>front</ribReference>
<ribStart>leadingEdge</ribStart><ribEnd>front</ribEnd></ribsPositioning>
</ribsDefinition></ribsDefinitions><spars><sparPositions>
<sparPosition uID="a"><eta>0</eta><xsi>.2</xsi></sparPosition>
<sparPosition uID="b"><eta>1</eta><xsi>.2</xsi></sparPosition>
<sparPosition uID="c"><eta>0</eta><xsi>.6</xsi></sparPosition>
<sparPosition uID="d"><eta>1</eta><xsi>.6</xsi></sparPosition></sparPositions>
<sparSegments><sparSegment uID="rear"><sparPositionUIDs><u>c</u><u>d</u>
</sparPositionUIDs></sparSegment><sparSegment uID="front"><sparPositionUIDs><u>a</u>
<u>b</u></sparPositionUIDs></sparSegment></sparSegments></spars></structure>
</componentSegment></componentSegments></wing>"""
ENDS = "<etaStart>{}</etaStart><etaEnd>{}</etaEnd>"
TURN = "<ribRotation><ribRotationReference>{}</ribRotationReference><z>{}</z>"
TURN += "</ribRotation>"


def ribs_of(folder: Path, ribs: str) -> np.ndarray:
    path = small(folder)
    text = path.read_text().replace("</wing>", SPARS.format(ribs=ribs), 1)
    path.write_text(text)
    found = read_cpacs(path).ribs
    assert found is not None
    return found


@pytest.mark.parametrize("file", ["D150_v201.xml", "CPACS_30_D150.xml"])
def test_ribs_of_the_source_are_the_built_in_ones(d150: Path, file: str) -> None:
    ours = table("wing_ribs")[["eta_front_spar", "angle_deg"]].to_numpy()
    np.testing.assert_allclose(read_cpacs(d150 / file).ribs, ours, atol=1e-5)


def test_a_rib_across_a_spar_is_square_to_it(tmp_path: Path) -> None:
    ribs = "<ribReference>front</ribReference><numberOfRibs>3</numberOfRibs>"
    ribs += ENDS.format(0.2, 0.8) + TURN.format("front", 90)
    found = ribs_of(tmp_path, ribs)
    span = 10 * np.cos(np.deg2rad(30)) * np.cos(np.deg2rad(5))
    slope = (10 * np.sin(np.deg2rad(30)) + 0.2 * (2 - 5)) / span
    np.testing.assert_allclose(found[:, 0], [0.2, 0.5, 0.8])
    np.testing.assert_allclose(found[:, 1], 90 - np.rad2deg(np.arctan(slope)))


def test_a_turned_rib_is_followed_from_the_rear_to_the_front_spar(
    tmp_path: Path,
) -> None:
    ribs = "<ribReference>rear</ribReference><numberOfRibs>1</numberOfRibs>"
    ribs += ENDS.format(0.5, 0.5) + TURN.format("globalX", 160)
    eta, angle = ribs_of(tmp_path, ribs)[0]
    assert angle == pytest.approx(70.0)
    span = 10 * np.cos(np.deg2rad(30)) * np.cos(np.deg2rad(5))
    tip = 10 * np.sin(np.deg2rad(30))
    front, rear = (lambda s: tip * s + 0.2 * (5 - 3 * s)), tip * 0.5 + 0.6 * 3.5
    run, rise = rear - front(eta), (eta - 0.5) * span
    assert rise == pytest.approx(run / np.tan(np.deg2rad(70.0)))


def test_ribs_every_so_many_metres_and_not_in_the_nose(tmp_path: Path) -> None:
    ribs = "<ribReference>leadingEdge</ribReference><spacing>1.5</spacing>"
    found = ribs_of(tmp_path, ribs + ENDS.format(0.1, 1.0) + TURN.format("globalY", 90))
    # Along the leading edge: 10 m over the span, seen from above.
    length = np.hypot(np.sin(np.pi / 6), np.cos(np.pi / 6) * np.cos(np.deg2rad(5)))
    np.testing.assert_allclose(found[:, 0], 0.1 + 0.15 / length * np.arange(6))
    np.testing.assert_allclose(found[:, 1], 90.0)


@pytest.mark.parametrize(
    ("ribs", "words"),
    [
        ("<ribReference>spar</ribReference>" + ENDS.format(0, 1), "'spar', expected"),
        ("<numberOfRibs>0</numberOfRibs>" + ENDS.format(0, 1), "1 or more"),
        ("<spacing>0</spacing>" + ENDS.format(0, 1), "above 0"),
        ("<numberOfRibs>2</numberOfRibs>", "etaStart None"),
        (
            "<numberOfRibs>2</numberOfRibs>"
            + ENDS.format(0, 1)
            + TURN.format("globalY", 5),
            "5.0 degrees",
        ),
    ],
)
def test_bad_ribs(tmp_path: Path, ribs: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        ribs_of(tmp_path, ribs)


def test_another_number_of_ribs_makes_an_aircraft(d150: Path, tmp_path: Path) -> None:
    text = (d150 / "D150_v201.xml").read_text()
    path = tmp_path / "other.xml"
    path.write_text(text.replace("<numberOfRibs>16<", "<numberOfRibs>11<"))
    found = write_cpacs_model(path, "con", tmp_path / "a.bdf")
    assert "wing ribs (25)" in found.taken
    structure = Structure.from_deck(read_deck(tmp_path / "a.bdf"))
    modes = normal_modes(
        structure.stiffness, structure.mass, count=8, rigid_body=structure.rigid_body
    )
    assert modes.rigid == 6
    assert 2.0 < modes.frequency_hz[6] < 3.0


def test_ribs_with_a_role_are_the_nearest_of_the_file() -> None:
    ours = table("wing_ribs")
    theirs = ours[["eta_front_spar", "angle_deg"]].to_numpy() + np.array([5e-3, 0])
    found, text = rib_table(theirs[[*range(12), 15, 20, 25, 29]])
    assert text == " (16)"
    assert found is not None
    roles = found[found.rib.str.startswith("R")].set_index("rib").eta_front_spar
    assert roles.is_monotonic_increasing
    own = ours.set_index("rib").eta_front_spar[roles.index]
    np.testing.assert_allclose(roles, own, atol=0.0051)
    assert rib_table(theirs[:4]) == (None, " (the file has 4, at least 8 are needed)")
    assert rib_table(theirs[::2]) == (None, " (none of the file's is near rib R11)")
    assert rib_table(None) == (None, "")


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line = ["model", "from-cpacs", str(tmp_path / "gone.xml")]
    assert guarded(app, [*line, "--out", str(tmp_path / "a.bdf")]) == 2
    assert "no such file" in capsys.readouterr().err
    assert guarded(app, ["model", "con", "--out", str(tmp_path / "a.bdf")]) == 0
