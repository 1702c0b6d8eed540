"""A reference aircraft as it comes out of the generator, and the bench it is built on.

`ModelBuilder` collects grids and cards in named sections and hands out ids; the
builders of the components write to it. `AircraftModel` is the finished product.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from drake_landing.aircraft.deck_writer import DeckText, Section, Value, case_set
from drake_landing.aircraft.facts import facts
from drake_landing.aircraft.geometry import Float64, Int64
from drake_landing.gear import LandingGear

SETS = {1: "monitoring points", 2: "interface nodes", 3: "gear attachment nodes"}


@dataclass(frozen=True, kw_only=True)
class AircraftModel:
    """A reference aircraft.

    Attributes:
        level: con, pre or full.
        topology: how the main gears are attached: 1, 2 or distributed.
        deck: complete Nastran deck (SOL 103), SI units.
        grid_id: (g,) ascending.
        position: (g, 3) of the grids in B, m.
        monitoring: monitoring point -> grid id.
        attachment: gear name -> grid id.
        interface: grid ids that a reduction keeps, ascending.
        parts: part of the deck -> its grid ids.
        masses: component, mass (kg), x, y, z of its centre (m); airframe only.
        gears: the landing gears, bodies of the multibody model, not in the deck.
    """

    level: str
    topology: str
    deck: str = field(repr=False)
    grid_id: Int64 = field(repr=False)
    position: Float64 = field(repr=False)
    monitoring: Mapping[str, int]
    attachment: Mapping[str, int]
    interface: tuple[int, ...] = field(repr=False)
    parts: Mapping[str, tuple[int, ...]] = field(repr=False)
    masses: pd.DataFrame = field(repr=False)
    gears: tuple[LandingGear, ...]

    @property
    def name(self) -> str:
        """E.g. DLR-D150-CON."""
        return f"{facts('overall')['name']}-{self.level.upper()}"


@dataclass
class ModelBuilder:
    """Grids and cards of a model under construction.

    Ids of elements and properties are handed out from the base of the current part:
    part k has elements and properties from k·100000.
    """

    sections: dict[str, Section] = field(default_factory=dict)
    position: dict[int, Float64] = field(default_factory=dict)
    parts: dict[str, list[int]] = field(default_factory=dict)
    elements: int = 0
    _next: dict[str, int] = field(default_factory=dict)

    def section(self, title: str) -> Section:
        """The section of that title, made when first asked for."""
        return self.sections.setdefault(title, Section(title))

    def next_id(self, part: str, kind: str = "element") -> int:
        """A fresh id: of elements (rigid ones, masses) or of properties."""
        key = f"{part}/{kind}"
        if key not in self._next:
            order = sum(1 for k in self._next if k.endswith(kind)) + 1
            self._next[key] = order * 100_000
        self._next[key] += 1
        return self._next[key]

    def grids(self, part: str, ids: Iterable[int], p: Float64) -> None:
        """Writes grids of a part.

        Args:
            part: title of the section.
            ids: n grid ids.
            p: (n, 3) positions in B, m.
        """
        section = self.section(part)
        for i, x in zip(ids, p):
            if i in self.position:
                raise ValueError(f"grid {i} of {part} exists already")
            self.position[i] = x
            self.parts.setdefault(part, []).append(i)
            section.add("GRID", i, None, *map(_grid_value, x), wide=True)

    def element(self, part: str, card: str, *values: Value) -> int:
        """Writes an element; its id is put in front of the values, and returned."""
        eid = self.next_id(part)
        self.section(part).add(card, eid, *values)
        self.elements += 1
        return eid

    def rigid(self, part: str, node: int, components: str, nodes: Sequence[int]) -> int:
        """RBE2: the nodes follow `node` in the components."""
        eid = self.next_id(part)
        self.section(part).add("RBE2", eid, node, components, *nodes)
        return eid

    def average(
        self, part: str, node: int, nodes: Sequence[int], weight: float = 1.0
    ) -> int:
        """RBE3: `node` moves with the weighted mean of the translations of nodes."""
        eid = self.next_id(part)
        self.section(part).add("RBE3", eid, None, node, "123456", weight, "123", *nodes)
        return eid

    def deck(self, title: str, sets: Mapping[int, Sequence[int]], modes: int) -> str:
        """The text of the deck, a normal-modes run of `modes` modes."""
        control = [f"TITLE = {title}", "ECHO = NONE", "METHOD = 1"]
        for sid, ids in sets.items():
            control += [f"$ set {sid}: {SETS[sid]}", case_set(sid, ids)]
        control.append("DISPLACEMENT(PLOT) = 1")
        solution = Section("Solution")
        damping = facts("overall")["damping"]
        solution.add("EIGRL", 1, None, None, modes)
        solution.add("PARAM", "GRDPNT", 0)
        solution.comment("structural damping g, made viscous at w3: B = (g/w3) K")
        solution.add("PARAM", "G", damping["g"])
        solution.add("PARAM", "W3", damping["w3"])
        return DeckText(
            title, ["SOL 103"], control, [solution, *self.sections.values()]
        ).text()


def _grid_value(x: float) -> float:
    """Positions to a micrometre: mirrored grids stay exact mirror images."""
    value = float(np.round(x, 6))
    return value + 0.0  # no minus zero
