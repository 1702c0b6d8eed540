"""Card tables: defaults, aliases, references, messages; pyNastran as an oracle."""

import logging

import numpy as np
import pytest
from pyNastran.bdf.bdf import BDF

from fem.deck.reader import read_deck
from fem.deck.records import TABLES, table_of
from fem.errors import InputError
from fem.model.points import read_points


def test_every_table_of_the_records_is_there_with_its_columns(read):
    tables = read().cards
    assert set(tables) == set(TABLES)
    for name, record in TABLES.items():
        assert list(tables[name].columns) == ["file", "line", *record.columns], name


def test_grdset_baror_and_property_defaults(read):
    deck = read(
        "GRDSET,,,,,,,345\nGRID,4,,,,,,0\nGRID,5\nBAROR,,1,,,0.,0.,1.\n"
        "CBAR,3,,1,2\nCBAR,4,,2,3,0.,1.,0.\n"
    )
    ps = deck.cards["GRID"].set_index("id")["ps"]
    assert (ps[5], ps[4]) == ("345", "0")
    bars = deck.cards["CBAR"].set_index("eid")
    assert (bars.loc[3, "x3"], bars.loc[4, "x2"], bars.loc[3, "pid"]) == (1.0, 1.0, 1)
    assert read_points(deck).ps[3:].tolist() == [
        [False] * 6,
        [False, False, True, True, True, False],
    ]


def test_orientation_by_grid_or_by_vector(read):
    bars = read("CBAR,3,1,1,2,3\nCBAR,4,1,1,2,1.\n").cards["CBAR"].set_index("eid")
    assert (bars.loc[3, "g0"], bars.loc[4, "g0"]) == (3, 0)
    assert np.isnan(bars.loc[3, "x1"])
    assert bars.loc[4, ["x1", "x2", "x3"]].tolist() == [1.0, 0.0, 0.0]


def test_thru_may_skip_points_but_single_ones_must_exist(read):
    spc = read("SPC1,2,3,1,THRU,50\n".replace("50", "3")).cards["SPC"]
    assert spc[spc["sid"] == 2]["g"].tolist() == [1, 2, 3]
    with pytest.raises(InputError, match="SPC 3: point 77 is not defined"):
        read("SPC1,3,3,77\n")
    deck = read("GRID,9\nSPC1,2,3,1,THRU,9\n")
    assert set(deck.cards["SPC"].query("sid == 2")["g"]) == {1, 2, 3, 9}


def test_scalar_spellings_share_tables(read):
    deck = read(
        "SPOINT,91,THRU,93\nPELAS,1,5.,,,2,6.,.1\nCELAS3,11,1,91,92\n"
        "CELAS1,12,2,1,3\nCELAS4,13,7.,92,93\nCDAMP4,14,.5,91\nCMASS4,15,2.,93\n"
    )
    assert deck.cards["CELAS1"]["c1"].tolist() == [0, 3]
    assert deck.cards["CELAS2"]["k"].tolist() == [7.0]
    assert deck.cards["PELAS"]["ge"].tolist() == [0.0, 0.1]
    assert deck.cards["CDAMP2"][["g1", "g2"]].to_numpy().tolist() == [[91, 0]]
    assert len(deck.cards["CMASS2"]) == 1


def test_pbeaml_blank_dimensions_inherit_and_interpolate(read):
    deck = read("PBEAML,5,1,,BAR\n,.1,.2,3.,YES,.5,,,,\n,NO,1.,.3,,5.\n").cards["PBEAM"]
    row = deck.iloc[0]
    assert row["xxbs"].tolist() == [0.0, 0.5, 1.0]
    assert row["as"] == pytest.approx([0.02, 0.04, 0.06])
    assert row["nsms"] == pytest.approx([3.0, 4.0, 5.0])


def test_uniform_pbeam_has_both_ends(read):
    row = read("PBEAM,5,1,.5,2.,1.,,1.25\n").cards["PBEAM"].iloc[0]
    assert row["xxbs"].tolist() == [0.0, 1.0]
    assert row["js"].tolist() == [1.25, 1.25]


def test_symmetric_dmig_is_completed(read):
    row = read(
        "DMIG,KX,0,6,1\nDMIG,KX,1,1,,1,1,5.,,\n,2,1,-5.,,3,3,1.\n", case="K2GG=KX"
    ).cards["DMIG"]
    values = dict(
        zip(
            zip(row["rowids"][0], row["rowcs"][0], row["colids"][0], row["colcs"][0]),
            row["values"][0],
        )
    )
    assert values[(2, 1, 1, 1)] == values[(1, 1, 2, 1)] == -5.0
    assert len(values) == 5


@pytest.mark.parametrize(
    ("bulk", "messages"),
    [
        ("CBAR,9,8,1,2,0.,1.,0.", ["a.bdf:10: CBAR 9: PBAR 8 is not defined"]),
        ("CBAR,9,1,1,77,0.,1.,0.", ["CBAR 9: grid 77 is not defined"]),
        ("CBAR,9,9,1,2,0.,1.,0.\nPBAR,9,8,1.", ["PBAR 9: MAT1 8 is not defined"]),
        ("GRID,9,4", ["GRID 9: coordinate system 4 is not defined"]),
        ("GRID,1,,5.", ["GRID 1 is defined more than once"]),
        ("CBAR,1,1,1,3,0.,1.,0.", ["CBAR 1 is defined more than once"]),
        ("PBARL,9,1,,BOXX\n,1.", ["found 'BOXX', expected one of ROD"]),
        ("PBARL,9,1,,TUBE\n,1.,2.", ["inner radius 2"]),
        ("PBARL,9,1,,BOX\n,1.,2.,.1", ["field DIM4 is blank"]),
        ("PBEAM,9,1", ["PBEAM", "Area"]),
        ("RBE3,9,,1,123", ["RBE3"]),
        ("GRID,X,,Y", ["field ID: found 'X'", "field X1: found 'Y', expected a real"]),
        ("MPC,1,1,1,0.", ["field A1"]),
        ("TSTEP,1,10,-1.", ["expected positive"]),
        ("FORCE,5,99,,1.,1.", ["FORCE 5: grid 99"]),
        ("PLOAD1,5,77,FX,FR,0.,1.", ["PLOAD1 5: element (CBAR, CBEAM, CBEND) 77"]),
        (
            "CORD2R,1,2,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2R,2,1,0.,0.,0.,0.,0.,1.\n"
            ",1.,0.,0.",
            ["CORD2R 1: refers to coordinate system 2"],
        ),
        ("CORD2R,1,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.", ["three points lie on a line"]),
        ("= = 5", ["cannot be read"]),
    ],
)
def test_faults_say_where_what_and_what_was_expected(read, bulk, messages):
    with pytest.raises(InputError) as caught:
        read(bulk)
    text = "\n".join(caught.value.problems)
    for message in messages:
        assert message in text


def test_sets_that_a_selected_combination_lacks_are_named(read):
    bulk = "LOAD,7,1.,1.,55\nLOAD,8,1.,1.,56\nSPCADD,9,1,57\n"
    with pytest.raises(InputError) as caught:
        read(bulk, case="LOAD = 7\nSPC = 9")
    text = str(caught.value)
    assert "LOAD 7: FORCE set 55 is not defined" in text
    assert "set 56" not in text
    notices = read(bulk, case="SPC = 9").notices
    assert any("SPCADD 9: SPC set 57 is not defined; it" in text for text in notices)


def test_all_unsupported_cards_are_listed_at_once_and_can_be_ignored(read):
    bulk = "CSEAM,5,1,1,2\nCBEAM3,6,3,1,2,3\nCBEAM3,7,3,2,3,1\n"
    bulk += "PBEAM3,3,1\nPLOAD1,4,6,FX,FR"
    with pytest.raises(InputError) as caught:
        read(bulk)
    text = str(caught.value)
    assert "CSEAM (1 card; " in text
    assert "a.bdf:10" in text
    assert "CBEAM3 (2 cards; " in text
    assert "--ignore CBEAM3,CSEAM,PBEAM3" in text
    deck = read(bulk, ignore=("cbeam3", "CSEAM"))
    assert any("CBEAM3 (2 cards" in notice for notice in deck.notices)
    assert any("1 PLOAD1 on ignored elements" in notice for notice in deck.notices)
    assert deck.cards["PLOAD1"].empty


def test_cards_without_effect_only_give_a_notice(read):
    deck = read("PLOTEL,9,1,2\nSET3,5,GRID,1,2\nPARAM,POST,-1\nCBARAO,1,FR,.5")
    assert any("CBARAO (1), SET3 (1)" in notice for notice in deck.notices)


def test_vendor_conm2_with_a_seventh_field_and_absolute_offset(read):
    deck = read("CONM2,9,1,-1,5.,1.,2.,3.\n,1.,0.,2.,0.,0.,3.,7.7\n")
    row = deck.cards["CONM2"].iloc[0]
    assert (row["cid"], row["i33"], row["x3"]) == (-1, 3.0, 3.0)
    assert any("CONM2: fields after" in notice for notice in deck.notices)


def test_alike_repeated_grids_are_accepted(read):
    deck = read("GRID,2,,1.")
    assert len(deck.cards["GRID"]) == 3
    assert any("repeated GRID" in notice for notice in deck.notices)


DECKS = [
    "beams/001_ten_bar_truss/modes.dat",
    "beams/002_svanberg_beam/static.dat",
    "beams/003_svanberg_bar/modes.dat",
    "beams/004_72_bar_truss/static.dat",
    "cantilever/cant_a_tran.bdf",
    "cantilever/cant_b_modes.bdf",
    "solid_shell_bar/static_solid_shell_bar.bdf",
    "solid_shell_bar/static_solid_shell_bar_xyz.bdf",
    "solid_shell_bar/static_solid_shell_bar_pload1.bdf",
    "solid_shell_bar/mode_solid_shell_bar.bdf",
    "solid_shell_bar/transient_solid_shell_bar.bdf",
    "transient_1d/tst1d3.bdf",
    "rbe3/make_gm_nx9_rbe3_1.dat",
    "rbe3/make_gm_nx9_rbe3_um_2.dat",
    "reduction/cantilever_bar/dynamicReduction.dat",
    "truss_frame/full.dat",
    "truss_frame/inboard.dat",
    "truss_frame/outboard.dat",
]
SUPERELEMENTS = ["cbSuper1Mode", "cbSuper3Modes", "guyanSuper", "guyanSuperStatic"]


@pytest.mark.parametrize("name", DECKS)
def test_reference_decks_read_and_are_placed_as_pynastran_places_them(references, name):
    deck = read_deck(references / name, ignore=("CBEND",))
    points = read_points(deck)
    if name.startswith(("truss_frame", "rbe3")):
        return  # their executive control includes files that are not there
    model = BDF(log=logging.getLogger("pynastran"))
    model.read_bdf(references / name, xref=True, validate=False)
    assert points.grid_id.tolist() == sorted(model.nodes)
    theirs = np.array([model.nodes[i].get_position() for i in points.grid_id])
    np.testing.assert_allclose(points.xyz, theirs, atol=1e-12)
    counts = dict.fromkeys(TABLES, 0)
    for card, count in model.card_count.items():
        counts[table_of(card)] = counts.get(table_of(card), 0) + count
    for card in (
        "CBAR",
        "CBEAM",
        "CROD",
        "CQUAD4",
        "CTRIA3",
        "CHEXA",
        "CTETRA",
        "CONM2",
    ):
        assert len(deck.cards[card]) == counts[card], card


@pytest.mark.parametrize("name", SUPERELEMENTS)
def test_superelement_decks_are_one_model(references, name):
    deck = read_deck(references / f"reduction/cantilever_bar/{name}.dat")
    assert len(deck.cards["CBAR"]) == 10
    assert [component.number for component in deck.components] == [1, 2]
