"""The written SOL 109 deck, read back by another reader."""

from pathlib import Path

import numpy as np
import pytest
from pyNastran.bdf.bdf import BDF

from drake_landing.landing.handover import AttachmentLoads
from drake_landing.transient.deck import (
    model_selections,
    transient_deck,
    write_transient_deck,
)
from fem.deck.control.subcase import Subcase
from fem.errors import InputError

TINY = Path(__file__).parents[1] / "tiny_aircraft.bdf"
# Columns: the axes of CORD2R 10 of the tiny aircraft, z along (1,1,1)/sqrt(3).
R_B10 = np.column_stack(
    [
        np.array([2.0, -1, -1]) / np.sqrt(6),
        np.array([0, 1.0, -1]) / np.sqrt(2),
        np.array([1.0, 1, 1]) / np.sqrt(3),
    ]
)


@pytest.fixture
def loads() -> AttachmentLoads:
    rng = np.random.default_rng(3)
    return AttachmentLoads(
        time=5e-4 * np.arange(401),
        node_id=np.array([51, 52]),
        load=rng.normal(scale=1e5, size=(401, 2, 6)),
    )


def written(tmp_path: Path, source: Path, loads: AttachmentLoads) -> BDF:
    path = tmp_path / "landing.bdf"
    rotation = np.stack([R_B10, np.eye(3)])
    lines = transient_deck(
        source, loads, rotation, output=[1, 24], selections=["SPC = 4"]
    )
    write_transient_deck(path, lines)
    model = BDF(debug=None)
    model.read_bdf(str(path))
    return model


def history(model: BDF, node: int, component: int) -> tuple[np.ndarray, np.ndarray]:
    """Of the load on one freedom, following the cards as a solver does."""
    subcase = model.case_control_deck.subcases[0]
    dload = model.dloads[subcase["DLOAD"][0]][0]
    assert dload.scale == 1.0
    assert set(dload.scale_factors) == {1.0}
    tables = []
    for sid in dload.load_ids:
        sid = getattr(sid, "sid", sid)
        tload = model.dload_entries[sid][0]
        darea = model.dareas[tload.excite_id]
        if (darea.node_ids[0], int(darea.components[0])) == (node, component):
            assert darea.scales[0] == 1.0
            tables.append(model.tables_d[tload.tid])
    assert len(tables) == 1
    return tables[0].x, tables[0].y


def test_every_component_reads_back(tmp_path: Path, loads: AttachmentLoads) -> None:
    model = written(tmp_path, TINY, loads)
    for component in range(6):
        x, y = history(model, 52, component + 1)
        assert x[:-2] == pytest.approx(loads.time, abs=1e-12)
        assert y[:-2] == pytest.approx(loads.load[:, 1, component], rel=1e-9)
        # The integrator looks a step beyond the end.
        assert y[-2:] == pytest.approx(loads.load[-1, 1, component], rel=1e-9)


def test_loads_are_in_the_displacement_frame(
    tmp_path: Path, loads: AttachmentLoads
) -> None:
    model = written(tmp_path, TINY, loads)
    # the frame of the fixture is that of the deck
    assert pytest.approx(R_B10) == model.coords[10].beta().T
    for part in (0, 3):
        found = np.column_stack([history(model, 51, part + c)[1] for c in (1, 2, 3)])
        expected = loads.load[:, 0, part : part + 3] @ R_B10
        assert found[:-2] == pytest.approx(expected, rel=1e-8, abs=1e-3)


def test_control_sections_are_replaced(tmp_path: Path, loads: AttachmentLoads) -> None:
    model = written(tmp_path, TINY, loads)
    subcase = model.case_control_deck.subcases[0]
    assert model.sol == 109
    assert "METHOD" not in subcase
    assert subcase["SPC"][0] == 4
    assert subcase["ACCELERATION"][0] == 1
    tstep = model.tsteps[subcase["TSTEP"][0]]
    assert (tstep.N, tstep.DT, tstep.NO) == ([400], [5e-4], [1])
    assert set(model.nodes) >= {1, 24, 51, 52}
    assert model.params["G"].values == [0.03]


def test_includes_are_copied_and_ids_do_not_collide(
    tmp_path: Path, loads: AttachmentLoads
) -> None:
    (tmp_path / "sub").mkdir()
    bulk = TINY.read_text().split("BEGIN BULK\n")[1].replace("ENDDATA\n", "")
    bulk += "TSTEP,900001,10,.1,1\nFORCE,900004,1,,1.,1.,0.,0.\n"
    (tmp_path / "sub/bulk.inc").write_text(bulk)
    source = tmp_path / "main.bdf"
    control = "SOL 103\nCEND\nPARAM,WTMASS,1.\nMETHOD=1\nBEGIN BULK\n"
    source.write_text(control + "INCLUDE 'sub/bulk.inc'\n")
    model = written(tmp_path, source, loads)
    (tmp_path / "sub/bulk.inc").unlink()  # the deck needs it no more
    assert model.case_control_deck.subcases[0]["TSTEP"][0] > 900004
    assert len(model.nodes) == 23
    text = (tmp_path / "landing.bdf").read_text()
    assert "PARAM,WTMASS,1." in text.split("BEGIN BULK")[0]
    assert not list(tmp_path.glob("*.part"))


def test_selections_of_the_model_are_kept() -> None:
    subcase = Subcase(spc=3, method=1, load=7, b2gg="BMAT", tstep=2)
    assert model_selections(subcase) == ["SPC = 3", "B2GG = BMAT"]


def test_missing_include_and_silent_loads_are_input_errors(
    tmp_path: Path, loads: AttachmentLoads
) -> None:
    source = tmp_path / "main.bdf"
    source.write_text("CEND\nBEGIN BULK\nINCLUDE 'gone.inc'\nENDDATA\n")
    with pytest.raises(InputError, match=r"gone\.inc"):
        written(tmp_path, source, loads)
    silent = AttachmentLoads(
        time=loads.time, node_id=loads.node_id, load=0 * loads.load
    )
    with pytest.raises(InputError, match="do not touch"):
        written(tmp_path, TINY, silent)
