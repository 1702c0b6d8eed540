"""A deck: card tables, parameters, case control, and what was remarkable."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from fem.arrays import Int64
from fem.deck.control.param_names import CELLS, DEFAULTS, Value
from fem.deck.control.subcase import Subcase
from fem.errors import InputError, nearest


@dataclass(frozen=True, kw_only=True)
class Superelement:
    """One superelement of a model in one piece.

    Attributes:
        number: its id.
        interior: (i,) points that only it has.
        generalised: points, and their components, that stand for its modes.
        count: modes without points of their own (SENQSET).
        kept: points of its interior and components that are kept (ASET).
        methods: EIGRL cards of its own bulk data.
        free: its modes have parts of the boundary free (CSET, SECSET).
    """

    number: int
    interior: Int64
    generalised: tuple[tuple[int, str], ...] = ()
    count: int = 0
    kept: tuple[tuple[int, str], ...] = ()
    methods: pd.DataFrame | None = None
    free: bool = False


@dataclass(frozen=True, kw_only=True)
class Deck:
    """A Nastran deck.

    Attributes:
        path: the main file.
        cards: one table per record of `fem.deck.records.TABLES`, empty ones
            included.
        params: parameters that the deck gives, capitals; see `param` for defaults.
        case_control: subcases in order, the global section applied to each; a deck
            without subcases has one with id 1.
        sol: number of the solution sequence, 0 where the deck does not say.
        executive: executive control statements.
        notices: what was ignored, replaced or understood, for the user to read.
        ignored: names of unsupported cards that the user wanted left out, and that
            the deck has.
        components: superelements that a solution reduces, in their order.
        external: kind and name of the DMIG that are matrices of external superelements.
        increments: elements of BEGIN MASSID=n sections by n, on the points of the deck.
    """

    path: Path
    cards: Mapping[str, pd.DataFrame]
    params: Mapping[str, Value]
    case_control: tuple[Subcase, ...] = ()
    sol: int = 0
    executive: tuple[str, ...] = ()
    notices: tuple[str, ...] = ()
    ignored: tuple[str, ...] = ()
    components: tuple[Superelement, ...] = ()
    external: tuple[tuple[str, str], ...] = ()
    increments: "Mapping[int, Deck]" = field(default_factory=dict)

    def param(self, name: str) -> Value:
        """Value of a parameter or system cell, Nastran's default where none is given.

        Raises:
            KeyError: no parameter of that name is known here (an error in the program).
        """
        return self.params.get(name, {**DEFAULTS, **CELLS}[name])

    def number(self, name: str) -> float:
        """Value of a numeric parameter in units of the deck, see `param`."""
        return float(self.param(name))

    def subcase(self, number: int) -> Subcase:
        """The subcase of that id.

        Raises:
            InputError: there is none.
        """
        for subcase in self.case_control:
            if subcase.id == number:
                return subcase
        ids = [str(subcase.id) for subcase in self.case_control]
        raise InputError(
            f"{self.path}: no subcase {number}; the deck has {', '.join(ids)}"
            f"{nearest(str(number), ids)}"
        )
