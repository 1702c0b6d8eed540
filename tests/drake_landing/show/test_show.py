"""Pictures of decks: components by name, faces, modes, a page without network."""

import base64
import json
import re
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

from drake_landing.cli import app, guarded
from drake_landing.reference.d150 import write_model
from drake_landing.show.comments import Names, component_names, read_names
from drake_landing.show.mesh import RIGID, drawn_mesh
from drake_landing.show.modes import shown_modes
from drake_landing.show.viewer import viewer_data
from fem.deck.reader import read_deck
from fem.model.structure import Structure

HEAD = "SOL 103\nCEND\nBEGIN BULK\nMAT1,1,7.+10,,.33,2800.\n"
CUBE = (
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
    "GRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n"
    "GRID,9,,2.,0.,0.\nGRID,10,,2.,1.,0.\nGRID,11,,2.,0.,1.\nGRID,12,,2.,1.,1.\n"
)


def structure_of(folder: Path, text: str) -> Structure:
    path = folder / "model.bdf"
    path.write_text(HEAD + text + "ENDDATA\n")
    return Structure.from_deck(read_deck(path))


@pytest.fixture(scope="module")
def con(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("con") / "con.bdf"
    write_model("con", path)
    return path


def test_two_cubes_show_ten_outer_faces(tmp_path: Path) -> None:
    text = "PSOLID,7,1\nCHEXA,1,7,1,2,3,4,5,6\n,7,8\nCHEXA,2,7,2,9,10,3,6,11\n,12,7\n"
    (component,) = drawn_mesh(structure_of(tmp_path, CUBE + text)).components
    assert len(component.quads) == 10
    assert component.name == "solids"


SHELLS = "CQUAD4,1,7,1,2,3,4\nCQUAD4,2,8,2,9,10,3\n"


@pytest.mark.parametrize(
    "comments",
    [
        "$---------------\n$ left part\n$---------------\nPSHELL,7,1,.01,1\n"
        "CQUAD4,1,7,1,2,3,4\n$ ==========\n$ floor\n$ ==========\n"
        "PSHELL,8,1,.01,1\nCQUAD4,2,8,2,9,10,3\n",
        'PSHELL,7,1,.01,1\nPSHELL,8,1,.01,1\n$HMNAME PROP        7"part" 4\n'
        '$HMNAME PROP        8"floor" 4\n' + SHELLS,
        "$ Femap Property 7 : part\nPSHELL,7,1,.01,1\n$ Femap Property 8 : floor\n"
        "PSHELL,8,1,.01,1\n" + SHELLS,
        "$ Elements and Element Properties for region : part\nPSHELL,7,1,.01,1\n"
        "$ Elements and Element Properties for region : floor\n"
        "PSHELL   8       1       .01     1\n" + SHELLS,
    ],
    ids=["banners", "hypermesh", "femap", "patran"],
)
def test_comments_name_components(tmp_path: Path, comments: str) -> None:
    mesh = drawn_mesh(structure_of(tmp_path, CUBE + comments))
    found = {c.name.replace("left ", "") for c in mesh.components}
    assert found == {"part", "floor"}


def test_hypermesh_moves_and_numbered_names(tmp_path: Path) -> None:
    """Components by element ids; names that only number properties are none."""
    path = tmp_path / "moved.bdf"
    path.write_text(
        '$HMNAME COMP        7"skin" 4\n$HMMOVE        7\n'
        "$       1THRU       3       9\n"
        "$ Femap Property 5 : PSHELL.5\n$ Simcenter Femap Property 6 : spar web\n"
    )
    import pandas as pd

    rows = pd.DataFrame({"id": [1, 2, 3, 4, 9], "card": "CQUAD4", "line": 1})
    rows = rows.assign(pid=[6, 6, 6, 5, 5], file=str(path))
    names = component_names(read_names([str(path)]), rows)
    assert names == ["skin", "skin", "skin", "sheets", "skin"]
    rows.loc[0, "file"] = str(tmp_path / "outer_wing.inc")
    rows.pid = [5, 5, 6, 5, 5]
    names = component_names(Names(properties={6: "spar web"}), rows)
    assert names == ["outer wing", "moved", "spar web", "moved", "moved"]


def test_nameless_properties_are_shown_by_their_kind(tmp_path: Path) -> None:
    path = tmp_path / "nothing.bdf"
    path.write_text("GRID,1\n")
    import pandas as pd

    rows = pd.DataFrame({"card": "CQUAD4", "pid": range(1, 101), "line": 1})
    names = component_names(read_names([str(path)]), rows.assign(file=str(path)))
    assert set(names) == {"sheets"}


def test_modes_say_what_moves(con: Path) -> None:
    structure = Structure.from_deck(read_deck(con))
    mesh = drawn_mesh(structure)
    modes = shown_modes(structure, mesh, 3)
    assert modes.names[0].startswith("symmetric: wing")
    assert modes.names[1].startswith("antisymmetric: wing")
    np.testing.assert_allclose(modes.energy.sum(axis=0), 1.0)
    # Shapes are those of the deck's own freedoms, in basic axes.
    assert modes.shape.shape == (len(mesh.p), 3, 3)
    tips = structure.points.rows([19004, 19005])
    assert modes.shape[tips[0], 2, 0] == pytest.approx(modes.shape[tips[1], 2, 0])
    assert modes.shape[tips[0], 2, 1] == pytest.approx(-modes.shape[tips[1], 2, 1])


def test_page_holds_the_mesh_and_the_shapes(con: Path) -> None:
    structure = Structure.from_deck(read_deck(con))
    mesh = drawn_mesh(structure)
    modes = shown_modes(structure, mesh, 2)
    data = viewer_data("x", mesh, modes)
    p = np.frombuffer(base64.b64decode(data["p"]), "<f4").reshape(-1, 3)
    center = 0.5 * (mesh.p.min(axis=0) + mesh.p.max(axis=0))
    np.testing.assert_allclose(p, mesh.p - center, atol=2e-6)
    shape = np.frombuffer(base64.b64decode(data["modes"][1]["shape"]), "<i2")
    expected = modes.shape[:, :, 1] / np.abs(modes.shape[:, :, 1]).max()
    np.testing.assert_allclose(shape.reshape(-1, 3) / 32767, expected, atol=2e-5)
    hidden = [c["name"] for c in data["components"] if not c["visible"]]
    assert hidden == [RIGID]
    for part in data["components"]:
        index = np.frombuffer(base64.b64decode(part["lines"]), "<u4")
        assert index.max(initial=0) < len(mesh.p)


def test_command_writes_pictures_and_a_page_without_network(
    con: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "pictures"
    assert guarded(app, ["show", str(con), "--out", str(out), "--modes", "2"]) == 0
    assert "2.141 Hz  symmetric: wing" in capsys.readouterr().out
    for name in ("mesh.png", "modes.png"):
        pixels = matplotlib.image.imread(out / name)[..., :3]
        assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 20
    page = (out / "viewer.html").read_text()
    assert not re.search(r"https?:|src\s*=|@import|url\(", page)
    block = re.search(r'<script id="data"[^>]*>(.*?)</script>', page, re.DOTALL)
    assert block is not None
    assert len(json.loads(block[1])["modes"]) == 2


def test_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "points.bdf"
    path.write_text(HEAD + "GRID,1,,0.,0.,0.\nENDDATA\n")
    assert guarded(app, ["show", str(path), "--out", str(tmp_path)]) == 2
    assert "no element to draw" in capsys.readouterr().err
    assert guarded(app, ["show", str(path), "--modes", "-1"]) == 2
    assert "expected 0 or more" in capsys.readouterr().err
