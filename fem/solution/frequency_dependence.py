"""Springs and dampers with tables of frequency: PBUSHT, PELAST, PDAMPT.

In frequency responses a table takes the place of the nominal value of PBUSH, PELAS or
PDAMP at every frequency; where there is none (0), and in all other solutions, modes of
SOL 111 included, the nominal values hold (Autodesk Nastran reference, PBUSHT).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64
from fem.deck.references import table
from fem.elements.block import Detail, ElementBlock, Kind
from fem.elements.registry import readers
from fem.geometry.points import Points
from fem.loads.time_tables import table_function
from fem.model.assembly import Matrices, assemble
from fem.recovery.elements import ElementTable, element_tables

if TYPE_CHECKING:
    from fem.deck.deck import Deck

Complex128 = npt.NDArray[np.complex128]


@dataclass(frozen=True, kw_only=True)
class _Kind:
    """A card of tables.

    Attributes:
        property: the card it belongs to.
        reader: of the elements.
        columns: of the property, of the tables for it, and of the factor for units.
    """

    property: str
    reader: str
    columns: tuple[tuple[str, str, str], ...]


_KINDS = {
    "PBUSHT": _Kind(
        property="PBUSH",
        reader="CBUSH",
        columns=(("ks", "ktables", "ks"), ("bs", "btables", "bs"),
                 ("ges", "getables", "")),
    ),
    "PELAST": _Kind(
        property="PELAS",
        reader="CELAS1",
        columns=(("k", "ktable", "k"), ("ge", "getable", "")),
    ),
    "PDAMPT": _Kind(property="PDAMP", reader="CDAMP1", columns=(("b", "btable", "b"),)),
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class FrequencyDependence:
    """Elements of a deck whose properties depend on frequency.

    Attributes:
        deck, points: the model.
        used: names of the cards of tables that it has.
        nominal: the elements as they are elsewhere.
        cards: their cards.
    """

    deck: "Deck"
    points: Points
    used: tuple[str, ...]
    nominal: tuple[ElementBlock, ...]
    cards: frozenset[str]

    @classmethod
    def from_deck(
        cls, deck: "Deck", points: Points, blocks: Sequence[ElementBlock]
    ) -> "FrequencyDependence | None":
        """The dependence of a model; None where nothing in it depends on frequency."""
        used = [name for name in _KINDS if not table(deck, name).empty]
        named = {_KINDS[name].reader for name in used}
        cards = frozenset(b.card for r in named for b in readers()[r](deck, points))
        if not cards:
            return None
        nominal = tuple(block for block in blocks if block.card in cards)
        return cls(
            deck=deck, points=points, used=tuple(used), nominal=nominal, cards=cards
        )

    def blocks(self, hertz: float) -> list[ElementBlock]:
        """The elements at a frequency.

        Raises:
            InputError: a table that is not there.
        """
        cards = dict(self.deck.cards)
        for name in self.used:
            kind = _KINDS[name]
            cards[kind.property] = self._properties(name, hertz)
        deck = replace(self.deck, cards=cards)
        named = [_KINDS[name].reader for name in self.used]
        return [block for r in named for block in readers()[r](deck, self.points)]

    def at(self, hertz: float) -> Matrices:
        """Matrices of the g-set that a frequency adds; the mass stays."""
        new, old = self._assembled(self.blocks(hertz)), self._assembled(self.nominal)
        return Matrices(
            stiffness=sp.csr_matrix(new.stiffness - old.stiffness),
            mass=sp.csr_matrix(new.mass - old.mass),
            damping=sp.csr_matrix(new.damping - old.damping),
            structural_damping=sp.csr_matrix(
                new.structural_damping - old.structural_damping
            ),
        )

    def linear(
        self,
        chosen: ElementTable,
        kind: Kind,
        detail: Detail,
        frequency_hz: Float64,
        u: Complex128,
    ) -> Complex128:
        """(f, r) linear results of a table's elements, of displacements u (f, g)."""
        ids, rows = frozenset(chosen.id.tolist()), []
        for k, hertz in enumerate(frequency_hz):
            blocks = [b for b in self.blocks(float(hertz)) if b.card == chosen.table]
            (own,) = element_tables(
                self.points, blocks, kind, ids, detail=detail, moving=True
            )
            rate = np.full((1, 1), 2j * np.pi * hertz)
            rows.append(own.harmonic(u[k : k + 1], rate)[0])
        return np.array(rows)

    def _assembled(self, blocks: Sequence[ElementBlock]) -> Matrices:
        k, m, b = (self.deck.number(name) for name in ("CK1", "CM1", "CB1"))
        return assemble(self.points, blocks, factors=(k, m, b))

    def _properties(self, name: str, hertz: float) -> pd.DataFrame:
        kind, at = _KINDS[name], np.array([hertz])
        found = self.deck.cards[kind.property].copy()
        tables = self.deck.cards[name].set_index("pid")
        for column, ids, unit in kind.columns:
            values = []
            for pid, nominal in zip(found["pid"], found[column]):
                value = np.array(nominal, float)
                if pid in tables.index:
                    row = tables.loc[pid]
                    factor = np.broadcast_to(row[unit] if unit else 1.0, value.shape)
                    for place, tid in np.ndenumerate(np.asarray(row[ids])):
                        if tid:
                            function = table_function(self.deck, int(tid))
                            value[place] = factor[place] * function(at)[0]
                values.append(value if value.ndim else float(value))
            found[column] = pd.Series(values, index=found.index)
        return found
