"""Text of decks: fields, continuations, INCLUDE, encodings, sections."""

import pytest

from fem.deck.reader import read_deck
from fem.deck.text.lexer import read_cards
from fem.deck.text.source import Line
from fem.deck.text.values import Malformed, integer, real
from fem.errors import InputError


def cards(text: str) -> list[list[str]]:
    lines = [Line(t.expandtabs(8), "a", k) for k, t in enumerate(text.split("\n"), 1)]
    bulk = read_cards(lines)
    assert not bulk.problems
    return [card.fields for card in bulk.cards]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.5", 1.5),
        ("-.5", -0.5),
        ("2.9+7", 2.9e7),
        ("2.9-7", 2.9e-7),
        ("1.D3", 1e3),
        ("1.E-3", 1e-3),
        ("+1.e+3".upper(), 1e3),
        ("7", 7.0),
    ],
)
def test_real_numbers_as_nastran_writes_them(text, value):
    assert real(text) == value


@pytest.mark.parametrize(
    "text", ["1_0", "NAN", "INF", "1.2.3", "A", "1E999", "٣", "--1"]
)
def test_what_python_takes_for_a_number_is_not_one(text):
    with pytest.raises(Malformed):
        real(text)
    with pytest.raises(Malformed):
        integer(text)


SMALL = """\
PBAR    1       2       3.      4.      5.      6.      7.              +A
+A      8.      9."""
LARGE = """\
PBAR*   1               2               3.              4.              *A
*A      5.              6.              7.
*       8.              9."""
MIXED = """\
PBAR*   1               2               3.              4.              *
*       5.              6.              7.
        8.      9."""
FREE = "PBAR,1,2,3.,4.,5.,6.,7.,,+\n+,8.,9."
TABS = "PBAR\t1\t2\t3.\t4.\t5.\t6.\t7.\n\t8.\t9."
LOWER = "pbar, 1 , 2,3. ,4.,5.,6.,7.   $ comment, with commas\n$ between\n\n,8.,9."


@pytest.mark.parametrize("text", [SMALL, LARGE, MIXED, FREE, TABS, LOWER])
def test_formats_give_the_same_fields(text):
    (fields,) = cards(text)
    expected = ["PBAR", "1", "2", "3.", "4.", "5.", "6.", "7.", "", "8.", "9."]
    assert fields == expected


def test_blank_continuation_row_keeps_its_place():
    (fields,) = cards("PBEAM   1       2\n+\n+       8.")
    assert fields[17] == "8."
    assert not any(fields[9:17])


def test_continuations_find_their_card_by_mnemonic():
    text = (
        f"{'CBAR    1':<72}+A\n{'CBAR    2':<72}+B\n{'+B      22':<72}\n"
        f"{'+A      11':<72}\n"
    )
    first, second = cards(text)
    assert (first[9], second[9]) == ("11", "22")


def test_blanks_separate_free_fields_too():
    (fields,) = cards("PSHEAR, 401     1       1.0     0.5, 1.,30.$ comment")
    assert fields == ["PSHEAR", "401", "1", "1.0", "0.5", "1.", "30."]


def test_a_comma_beyond_the_first_ten_columns_makes_no_free_field():
    (fields,) = cards("DEQATN  5       F(A,B)= -B/A\n        +A,B")
    assert fields[2:] == ["F(A,B)= -B/A", "+A,B"]
    (fields,) = cards("DRESP1  5       LABEL   A,B     C")
    assert fields == ["DRESP1", "5", "LABEL", "A,B", "C"]


def test_replication_copies_and_adds():
    text = "GRID,1,,0.,.5,0.\n=,*2,=,*(1.5),==\n=(2)\nCBAR    1       1       1\n"
    text += "=       *1      =       *(2)"
    made = cards(text)
    assert [fields[1] for fields in made] == ["1", "3", "5", "7", "1", "2"]
    assert [float(fields[3]) for fields in made[:4]] == [0.0, 1.5, 3.0, 4.5]
    assert all(fields[4:] == [".5", "0."] for fields in made[:4])
    assert made[5] == ["CBAR", "2", "1", "3"]


def test_replication_of_what_is_no_number_is_named(read):
    with pytest.raises(InputError, match=r"a.bdf:11: cannot add 1 to 'X'"):
        read("PARAM,X,Y\n=,*1\n")


def test_many_free_fields_go_on_as_continuations(read):
    spc = read("SPC1,9,123,1,1,1,1,1,1,1,1,2\n,3\n").cards["SPC"].query("sid == 9")
    assert set(spc["g"]) == {1, 2, 3}


def test_include_split_relative_quoted_and_by_name(tmp_path, read):
    folder = tmp_path / "sub dir"
    folder.mkdir()
    (folder / "Grids.INC").write_text("GRID,11\nINCLUDE 'more.inc'\n")
    (folder / "more.inc").write_text("grid,12\n")
    (tmp_path / "last.inc").write_text("GRID,13")
    deck = read(
        "INCLUDE 'sub dir/\n  grids.inc'\ninclude \"..\\elsewhere\\last.inc\"\nGRID,14"
    )
    assert deck.cards["GRID"]["id"].tolist() == [1, 2, 3, 11, 12, 13, 14]
    assert any("last.inc" in notice for notice in deck.notices)
    row = deck.cards["GRID"].set_index("id").loc[12]
    assert (row["file"], row["line"]) == (str(folder / "more.inc"), 1)


def test_include_that_is_not_there_or_goes_in_circles(tmp_path, read):
    with pytest.raises(InputError, match=r"a.bdf:10: the file of INCLUDE 'no.inc'"):
        read("INCLUDE 'no.inc'\n")
    (tmp_path / "b.bdf").write_text("GRID,1\nINCLUDE 'b.bdf'\n")
    with pytest.raises(InputError, match="includes itself"):
        read_deck(tmp_path / "b.bdf")


def test_include_of_dmap_in_the_executive_section_is_a_notice(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text("SOL 103\nINCLUDE '/no/such.v9'\nCEND\nBEGIN BULK\nGRID,1\nENDDATA")
    assert any("DMAP" in notice for notice in read_deck(path).notices)


def test_line_ends_byte_order_mark_and_latin_1(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_bytes(b"\xef\xbb\xbf$ h\xc3\xa4\r\nGRID,1\r\nGRID,2\r\n")
    assert len(read_deck(path).cards["GRID"]) == 2
    path.write_bytes(b"$ Tr\xe4ger\nGRID,1\rGRID,2\n")
    assert len(read_deck(path).cards["GRID"]) == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"", "the deck is empty"),
        (b"$ nothing\n\n", "the deck is empty"),
        (b"SOL 103\nCEND\nSPC = 1\n", "ends before BEGIN BULK"),
        (b"PARAM,POST,0\n", "no GRID"),
        (b"GRID\x00\x01", "not a text file"),
        (b"GRID,1\nGRID*   2               \n*\nCBAR,1,1", "CBAR field GA is blank"),
    ],
)
def test_decks_that_hold_nothing_or_are_cut_off(tmp_path, text, message):
    path = tmp_path / "a.bdf"
    path.write_bytes(text)
    with pytest.raises(InputError, match=message):
        read_deck(path)


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_deck(tmp_path / "none.bdf")
    with pytest.raises(InputError):
        read_deck(tmp_path)


def test_missing_enddata_is_a_notice(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text("SOL 103\nCEND\nBEGIN BULK\nGRID,1\n")
    assert any("ENDDATA" in notice for notice in read_deck(path).notices)


def test_superelements_are_joined(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text(
        "SOL 103\nCEND\nBEGIN BULK\nGRID,1\nSEBULK,1,PRIMARY\nSECONCT,1,0\n,1,1\n"
        "BEGIN SUPER=1\nGRID,1\nGRID,2,,1.\nENDDATA\n"
    )
    joined = read_deck(path)
    assert len(joined.cards["GRID"]) == 2
    assert any("one model in statics" in notice for notice in joined.notices)


def test_free_fields_go_on_after_a_comma(read):
    deck = read("SET1,9,1,2,3,4,5,6,7,\n1054,1002,1025,\n1106,5\n")
    (ids,) = deck.cards["SET1"]["ids"]
    assert set(ids) == {1, 2, 3, 4, 5, 6, 7, 1054, 1002, 1025, 1106}


def test_equal_signs_in_a_card_with_its_name_copy_the_card_before(read):
    deck = read("PBAR,7,1,.1,.01,.02,.03\nPBAR,8,1,==\nMAT1,3,1.+7,,.3\nMAT1,4,==\n")
    bars = deck.cards["PBAR"].set_index("pid")
    assert bars.loc[8, "j"] == bars.loc[7, "j"] == 0.03
    assert deck.cards["MAT1"].set_index("mid").loc[4, "e"] == 1e7


def test_system_cells_are_named_but_for_the_one_that_counts(tmp_path):
    path = tmp_path / "cells.bdf"
    path.write_text(
        "NASTRAN BARMASS=1, SYSTEM(319) = 1\nSOL 103\nCEND\nBEGIN BULK\n"
        "GRID,1\nCONM2,1,1,,2.\nENDDATA\n"
    )
    deck = read_deck(path)
    assert deck.number("BARMASS") == 1
    (notice,) = [n for n in deck.notices if "NASTRAN" in n]
    assert "cells.bdf:1: NASTRAN SYSTEM(319)=1: system cells are passed over" in notice


def test_a_system_cell_is_a_number(tmp_path):
    path = tmp_path / "cells.bdf"
    path.write_text("NASTRAN SYSTEM(398)=YES\nSOL 103\nCEND\nBEGIN BULK\nENDDATA\n")
    with pytest.raises(InputError, match="found YES, expected an integer"):
        read_deck(path)
