"""CPACS files, damaged: a deck that can be read, or a message."""

import random
from pathlib import Path

from benchmarks.fuzz.mutations import mutate_bytes, mutate_values
from benchmarks.fuzz.outcome import Outcome, of_command
from fem.deck.reader import read_deck

_SECTION = """<section uID="s{k}"><elements><element uID="e{k}">
<airfoilUID>a</airfoilUID>
<transformation><scaling><x>{chord}</x><y>1</y><z>{chord}</z></scaling>
</transformation></element></elements></section>"""
_STEP = """<positioning><length>{length}</length><sweepAngle>{sweep}</sweepAngle>
<dihedralAngle>{up}</dihedralAngle>{origin}<toSectionUID>s{k}</toSectionUID>
</positioning>"""
_SPARS = """<componentSegments><componentSegment><structure><spars><sparPositions>
<sparPosition uID="a"><eta>0</eta><xsi>.15</xsi></sparPosition>
<sparPosition uID="b"><eta>1</eta><xsi>.15</xsi></sparPosition>
<sparPosition uID="c"><eta>0</eta><xsi>.6</xsi></sparPosition>
<sparPosition uID="d"><eta>1</eta><xsi>.6</xsi></sparPosition></sparPositions>
<sparSegments><sparSegment uID="front"><sparPositionUIDs><u>a</u><u>b</u>
</sparPositionUIDs></sparSegment><sparSegment uID="rear"><sparPositionUIDs><u>c</u>
<u>d</u></sparPositionUIDs></sparSegment></sparSegments></spars><ribsDefinitions>
<ribsDefinition><ribsPositioning><ribReference>front</ribReference>
<numberOfRibs>30</numberOfRibs><etaStart>.02</etaStart><etaEnd>.98</etaEnd>
<ribRotation><ribRotationReference>globalY</ribRotationReference><z>90</z></ribRotation>
</ribsPositioning></ribsDefinition></ribsDefinitions></structure></componentSegment>
</componentSegments>"""


def _wing(uid: str, place: tuple[float, float, float], steps: str, **more: str) -> str:
    """One lifting surface; chords and positionings as `chord length sweep up` rows."""
    rows = [tuple(map(float, row.split())) for row in steps.split(",")]
    sections = "".join(_SECTION.format(k=k, chord=row[0]) for k, row in enumerate(rows))
    chain = "".join(
        _STEP.format(
            length=length,
            sweep=sweep,
            up=up,
            k=k,
            origin=f"<fromSectionUID>s{k - 1}</fromSectionUID>" if k else "",
        )
        for k, (_, length, sweep, up) in enumerate(rows)
    )
    x, y, z = place
    turn = more.get("turn", "0")
    return (
        f'<wing uID="{uid}"{more.get("symmetry", "")}><transformation><rotation>'
        f"<x>{turn}</x><y>0</y><z>0</z></rotation><translation><x>{x}</x><y>{y}</y><z>{z}</z>"
        f"</translation></transformation><sections>{sections}</sections><positionings>"
        f"{chain}</positionings>{more.get('structure', '')}</wing>"
    )


def _text() -> str:
    both = ' symmetry="x-z-plane"'
    wing = _wing(
        *("wing", (11.6, 0.0, -1.2), "7.1 0 0 0,6.0 2.0 27 5,3.7 5.5 27 5,1.5 10 27 5"),
        symmetry=both,
        structure=_SPARS,
    )
    tail = _wing("tail", (32.0, 0.0, 0.9), "4.0 0 0 0,1.4 7.2 33 6", symmetry=both)
    fin = _wing("fin", (29.5, 0.0, 2.0), "6.0 0 0 0,2.0 7.5 40 0", turn="90")
    return f"""<?xml version="1.0" encoding="utf-8"?>
<cpacs><header><cpacsVersion>3.2</cpacsVersion></header><vehicles><aircraft>
<model uID="m"><name>tried</name><wings>{wing}{tail}{fin}</wings></model></aircraft>
<profiles><wingAirfoils><wingAirfoil uID="a"><pointList>
<z>0;.06;0;-.06;0</z></pointList>
</wingAirfoil></wingAirfoils></profiles><materials><material uID="al2024">
<rho>2780</rho><k11>1.05e11</k11><k12>5.2e10</k12><sig11>4.3e8</sig11>
<tau12>2.8e8</tau12></material></materials></vehicles></cpacs>
"""


def seeds(folder: Path) -> list[Path]:
    """An airliner's wing, tail and material.

    Args:
        folder: for the file.
    """
    path = folder / "aircraft.xml"
    path.write_text(_text().replace("><", ">\n<"), encoding="utf-8")
    return [path]


def damaged(seed: Path, rng: random.Random, place: Path) -> None:
    """Writes a damaged copy of a file: bytes, lines, or absurd numbers.

    Args:
        seed: good file.
        rng: decides what happens to it.
        place: of the copy.
    """
    change = rng.choice([mutate_bytes, mutate_values, mutate_values])
    place.write_bytes(change(seed.read_bytes(), rng))


def outcome(path: Path) -> tuple[Outcome, str]:
    """Of `drake-landing model from-cpacs`; the deck must be one."""
    from drake_landing.cli import app

    out = path.with_name("tried.bdf")
    out.unlink(missing_ok=True)
    words = ("model", "from-cpacs", path, "--level", "con", "--out", out)
    how, why = of_command(app, *words)
    if how is Outcome.right:
        read_deck(out)
    elif out.exists():
        return Outcome.bad, "a message, and a deck"
    return how, why
