"""Nastran decks to `Deck`.

Text is cut into cards here, with file and line, so that messages say where; cards of
irregular shape are given to pyNastran's classes one by one (`pynastran_cards`), so that
one faulty card hides no other. All problems of a deck are reported at once.
"""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.deck.card_tables import make_tables
from fem.deck.checks import STATIC_LOADS, check, check_selected
from fem.deck.cleanup import clean, drop_unused_equations
from fem.deck.control.case_control import CaseControl, read_case_control
from fem.deck.control.executive import read_executive
from fem.deck.control.param_cards import read_parameters
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck, Superelement
from fem.deck.design_variables import set_initial_values
from fem.deck.mass_increments import POINTS, check_combinations, set_aside
from fem.deck.pynastran_cards import rows_from_pynastran
from fem.deck.reversed_solids import turn_solids
from fem.deck.superelements.images import (
    check_images,
    images,
    mirrored,
    primaries_first,
    with_primary,
)
from fem.deck.superelements.main_section import main_superelements
from fem.deck.superelements.matrices import with_matrices
from fem.deck.superelements.subcases import split_subcases, with_chosen_sets
from fem.deck.superelements.whole import check_sections, in_one_piece, with_modal
from fem.deck.text.fields import Fields
from fem.deck.text.lexer import Bulk, RawCard, read_cards
from fem.deck.text.sections import Increment, Sections, split_sections
from fem.deck.text.source import read_source
from fem.deck.text.values import Malformed
from fem.deck.unsupported import take_unsupported
from fem.errors import InputError


def read_deck(path: str | Path, *, ignore: Collection[str] = ()) -> Deck:
    """Read a Nastran deck with its INCLUDE files.

    Args:
        path: the deck; a file of bulk data alone (punch) will do.
        ignore: names of unsupported cards to go on without; recorded in the notices.

    Raises:
        InputError: everything that is wrong with the deck, each with file and line.
    """
    path = Path(path)
    source = read_source(path)
    sections = split_sections(source.lines, str(path))
    executive = read_executive(sections.executive)
    ignore = {name.upper() for name in ignore}
    bulk = read_cards(sections.bulk)
    case = read_case_control(
        sections.case_control,
        refuse="CASE" not in ignore,
        known=lambda: _possible_ids(bulk),
    )
    notices = [*source.notices, *executive.notices, *case.notices]
    problems = [*sections.problems, *executive.problems, *case.problems]
    if executive.sol == 200:
        set_initial_values(bulk.cards, ignore, problems, notices)
    has_parts = bool(sections.superelements)
    deck = _deck(path, bulk, case, ignore, problems, notices, partial=has_parts)
    deck = replace(deck, params={**deck.params, **executive.cells})
    cards = [card for card in bulk.cards if card.name not in ignore]
    problems += _temperature_problems(cards, case.subcases, executive.sol)
    if not problems and any(
        c.initial_temperature and c.temperature for c in case.subcases
    ):
        notices += _own_references(deck)
    if not problems:
        problems += check_images(deck, {*sections.superelements})
    parts = _superelements(path, sections, ignore, problems, deck)
    if not parts and not problems:
        problems += check_sections(deck, parts)
    subcases = list(case.subcases)
    of_parts: Mapping[int, Sequence[Mapping[str, pd.DataFrame]]] = {}
    if parts and not problems:
        for number, part in parts.items():
            cards, subcases = with_chosen_sets(
                part.cards, number, subcases, (*STATIC_LOADS, "LOAD")
            )
            parts[number] = replace(part, cards=cards)
        try:
            deck, parts, said = with_matrices(deck, parts, executive)
            notices += said
        except InputError as error:
            problems += error.problems
        deck, whole = in_one_piece(deck, parts)
        of_parts = whole.increments
        problems += whole.problems
        notices += whole.notices
        if not problems:
            problems += check(deck)
    components = deck.components
    if not components and not problems:
        components = tuple(main_superelements(deck.cards))
        deck = replace(deck, cards=_with_modal_points(deck.cards, components))
    deck = replace(deck, case_control=tuple(subcases))
    increments = _increments(deck, sections, of_parts, ignore, problems, notices)
    if not problems:
        problems += check_combinations(replace(deck, increments=increments))
    if not problems:
        solved, _ = split_subcases(deck.case_control)
        chosen = replace(deck, case_control=tuple(solved))
        found = check_selected(chosen, executive.sol)
        problems += found.problems
        notices += found.notices
    if problems:
        raise InputError(problems)
    deck = _known_reference(deck, notices)
    if sections.has_control and not bulk.has_enddata and not sections.in_parts:
        notices.append(f"{path}: no ENDDATA; the deck may be cut off")
    return Deck(
        path=path,
        cards=deck.cards,
        params=deck.params,
        case_control=deck.case_control,
        sol=executive.sol,
        executive=executive.statements,
        notices=tuple(dict.fromkeys(notices)),
        ignored=deck.ignored,
        components=components,
        external=deck.external,
        increments=increments,
    )


def _own_references(deck: Deck) -> list[str]:
    """Materials whose TREF stands against TEMPERATURE(INITIAL)."""
    return [
        f"warning: {name} {', '.join(map(str, given))}: TREF counts; "
        "TEMPERATURE(INITIAL) is the reference of materials with a blank TREF only"
        for name in ("MAT1", "MAT2", "MAT3", "MAT8", "MAT9", "PCOMP", "PCOMPS")
        if (given := deck.cards[name].dropna(subset="tref").iloc[:, 2].tolist()[:8])
    ]


def _temperature_problems(
    cards: Sequence[RawCard], subcases: Sequence[Subcase], sol: int
) -> list[str]:
    """Cards that temperatures would give a meaning, which nothing here carries out."""
    problems = []
    if any(
        c.initial_temperature or c.material_temperature or c.temperature
        for c in subcases
    ):
        problems += [
            f"{card.place}: {card.name} with TEMPERATURE in the case control: "
            "materials do not depend on temperature here; give the constants that hold"
            for card in cards
            if card.name.startswith("MATT")
        ]
    if sol == 101 and any(c.temperature for c in subcases):
        problems += [
            f"{card.place}: {card.name} with TEMPERATURE(LOAD): temperatures over the "
            "thickness of shells at points are not supported; expected TEMPP1"
            for card in cards
            if card.name == "TEMPP3"
        ]
    return problems


def _known_reference(deck: Deck, notices: list[str]) -> Deck:
    """PARAM GRDPNT that names no grid is the origin, as Nastran takes it."""
    grid = int(deck.number("GRDPNT"))
    if grid <= 0 or (deck.cards["GRID"]["id"] == grid).any():
        return deck
    notices.append(
        f"PARAM GRDPNT {grid}: there is no such grid; the weight table and resultants "
        "are about the origin of the basic frame"
    )
    return replace(deck, params={**deck.params, "GRDPNT": 0})


def _possible_ids(bulk: Bulk) -> Int64:
    """Ids that points and elements of a deck may have, ascending: all first fields."""
    found: set[int] = set()
    for card in bulk.cards:
        written = [text for text in card.fields[1:] if text][:1]
        if card.name == "SPOINT":
            with suppress(Malformed):  # reported where its table is made
                points, between = Fields(card).ids(1, "ID")
                found.update(points, between)
        else:
            found.update(int(text) for text in written if text.isdecimal())
    return np.array(sorted(found), dtype=np.int64)


def _deck(
    path: Path,
    bulk: Bulk,
    case: CaseControl,
    ignore: Collection[str],
    problems: list[str],
    notices: list[str],
    *,
    partial: bool = False,
) -> Deck:
    """Tables and parameters of one bulk data section, of all or `partial`."""
    problems += bulk.problems
    notices += bulk.notices
    groups: dict[str, list[RawCard]] = {}
    for card in bulk.cards:
        groups.setdefault(card.name, []).append(card)
    params = read_parameters(groups.pop("PARAM", []), case.params, problems, notices)
    ignored = take_unsupported(groups, ignore, problems, notices)
    tables = make_tables(groups, rows_from_pynastran, problems, notices)
    deck = Deck(
        path=path,
        cards=tables,
        params=params,
        case_control=case.subcases,
        ignored=tuple(dict.fromkeys(card.name for card in ignored)),
    )
    if not problems:
        clean(tables, ignored, notices)
        turn_solids(tables, notices)
        if case.subcases:
            drop_unused_equations(tables, case.subcases, notices)
        problems += check(deck, partial=partial)
    return deck


def _with_modal_points(
    cards: Mapping[str, pd.DataFrame], components: Sequence[Superelement]
) -> Mapping[str, pd.DataFrame]:
    """Tables whose QSET has the modal coordinates of SEQSET."""
    return {**cards, "QSET": with_modal(cards["QSET"], components)}


def _superelements(
    path: Path,
    sections: Sections,
    ignore: Collection[str],
    problems: list[str],
    main: Deck,
) -> Mapping[int, Deck]:
    """Decks of the BEGIN SUPER=n sections and of images of them."""
    decks, copies = {}, {} if problems else images(main)
    read = {n: read_cards(lines) for n, lines in sections.superelements.items()}
    for number in primaries_first(copies, {*read}):
        bulk, notices = read.get(number), []
        if number in copies:
            bulk = with_primary(bulk, read[copies[number]])
        assert bulk is not None
        deck = _deck(path, bulk, CaseControl(subcases=()), ignore, problems, notices)
        if number in copies and not problems:
            deck = mirrored(main, deck, number, problems)
        own = {
            m: _increment(deck, m, section, ignore, problems, notices)
            for (part, m), section in sections.of_parts.items()
            if part == number
        }
        decks[number] = Deck(
            path=path,
            cards=deck.cards,
            params=deck.params,
            notices=tuple(notices),
            increments=own,
        )
    problems += [
        f"BEGIN SUPER={part} MASSID={m}: BEGIN SUPER={part} is not in the deck"
        for part, m in sections.of_parts
        if part not in decks
    ]
    return decks


def _increments(
    deck: Deck,
    sections: Sections,
    of_parts: Mapping[int, Sequence[Mapping[str, pd.DataFrame]]],
    ignore: Collection[str],
    problems: list[str],
    notices: list[str],
) -> Mapping[int, Deck]:
    """Decks of the BEGIN MASSID=n sections, on the points of the whole deck.

    Those of superelements are among them.
    """
    decks = {
        number: _increment(deck, number, section, ignore, problems, notices)
        for number, section in sections.increments.items()
    }
    for number, tables in of_parts.items():
        before = [decks[number].cards] if number in decks else []
        cards = {
            name: pd.concat([t[name] for t in (*before, *tables)], ignore_index=True)
            for name in tables[0]
            if name not in POINTS
        }
        cards |= {name: deck.cards[name] for name in POINTS}
        decks[number] = Deck(path=deck.path, cards=cards, params=deck.params)
        if not problems:
            problems += check(decks[number], partial=True)
    return decks


def _increment(
    deck: Deck,
    number: int,
    section: Increment,
    ignore: Collection[str],
    problems: list[str],
    notices: list[str],
) -> Deck:
    """The deck of one section of an increment, on the points of another."""
    bulk = read_cards(section.lines)
    problems += bulk.problems
    groups: dict[str, list[RawCard]] = {}
    for card in set_aside(bulk.cards, number, notices):
        groups.setdefault(card.name, []).append(card)
    take_unsupported(groups, {*ignore} & {*groups}, problems, notices)
    tables = make_tables(groups, rows_from_pynastran, problems, notices)
    tables |= {name: deck.cards[name] for name in POINTS}
    part = Deck(path=deck.path, cards=tables, params=deck.params)
    if not problems:
        problems += check(part, partial=True)
    return part
