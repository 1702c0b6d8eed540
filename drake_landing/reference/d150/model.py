"""A reference aircraft as it comes out of the generator, and the bench it is built on.

`ModelBuilder` collects grids and cards in named sections and hands out ids; the
builders of the components write to it. `AircraftModel` is the finished product.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from drake_landing.gears.landing_gear import LandingGear
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.geometry import Float64, Int64
from fem.files.deck_writer import DeckText, Section, Value, case_set

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
        masses: component, mass (kg), x, y, z of its center (m); airframe only.
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

    def position_of(self, grid: int) -> Float64:
        """(3,) position of a grid in B, m.

        Raises:
            ValueError: the model has no such grid.
        """
        row = int(np.searchsorted(self.grid_id, grid))
        if row == len(self.grid_id) or self.grid_id[row] != grid:
            raise ValueError(f"{self.name}: no grid {grid}")
        return self.position[row]


@dataclass
class ModelBuilder:
    """Grids and cards of a model under construction.

    Ids of elements and properties are handed out from the base of the current part:
    part k has elements and properties from k·100000. `structure` holds mass (kg) and
    center (m) of every element with mass, by part; `dependent` the freedoms (grid,
    component) that UM of a tie has taken.
    """

    sections: dict[str, Section] = field(default_factory=dict)
    position: dict[int, Float64] = field(default_factory=dict)
    parts: dict[str, list[int]] = field(default_factory=dict)
    elements: int = 0
    structure: dict[str, list[tuple[float, Float64]]] = field(default_factory=dict)
    dependent: set[tuple[int, int]] = field(default_factory=set)
    _next: dict[str, int] = field(default_factory=dict)
    _properties: dict[str, int] = field(default_factory=dict)
    _per_area: dict[int, float] = field(default_factory=dict)
    _per_length: dict[int, float] = field(default_factory=dict)

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
        self,
        part: str,
        node: int,
        grids: Sequence[int],
        dependent: Mapping[int, str] | None = None,
    ) -> int:
        """RBE3: `node` moves with the mean of the translations of the grids.

        Args:
            part: section.
            node: reference grid.
            grids: independent grids.
            dependent: grid -> components that are dependent instead of the node's.
        """
        eid = self.next_id(part)
        values: list[Value] = [eid, None, node, "123456", 1.0, "123", *grids]
        if dependent:
            values += [None] * (-len(values) % 8)
            pairs = list(dependent.items())
            for row in range(0, len(pairs), 3):
                three = [v for pair in pairs[row : row + 3] for v in pair]
                values += ["UM" if row == 0 else None, *three]
                values += [None] * (-len(values) % 8)
        self.section(part).add("RBE3", *values, wide=False)
        return eid

    def shell_property(
        self, name: str, material: int, thickness: float, bending: float = 1.0
    ) -> int:
        """PSHELL of that name, written when first asked for; returns its id.

        Args:
            name: comment, and key.
            material: id.
            thickness: m.
            bending: 12 I/T³, 1 for a plain sheet.
        """
        if name not in self._properties:
            pid = self.next_id("shells", "property")
            section = self.section("Properties of shells")
            section.comment(f"property {pid}: {name}")
            ratio = bending if bending != 1.0 else None
            t = float(f"{thickness:.5g}")
            section.add("PSHELL", pid, material, t, material, ratio, material)
            self._properties[name] = pid
            self._per_area[pid] = density(material) * t
        return self._properties[name]

    def laminate_property(
        self, name: str, bottom: float, plies: Sequence[tuple[int, float, float]]
    ) -> int:
        """PCOMP of that name, written when first asked for; returns its id.

        Args:
            name: comment, and key.
            bottom: height of the lowest ply's bottom above the grids, m.
            plies: material id, thickness (m), mass per area (kg/m²); from the bottom.
        """
        if name not in self._properties:
            pid = self.next_id("shells", "property")
            section = self.section("Properties of shells")
            section.comment(f"property {pid}: {name}")
            values: list[Value] = [pid, float(f"{bottom:.5g}"), *(None,) * 6]
            for material, thickness, _ in plies:
                values += [material, float(f"{thickness:.5g}"), 0.0, "YES"]
            section.add("PCOMP", *values)
            self._properties[name] = pid
            self._per_area[pid] = sum(area for _, _, area in plies)
        return self._properties[name]

    def stiffened_property(
        self,
        name: str,
        material: int,
        thickness: float,
        smeared: float,
        bending: float,
    ) -> int:
        """PSHELL of a skin whose stringers are smeared along the material's 1-axis.

        Args:
            name: comment, and key.
            material: id of the isotropic material of skin and stringers.
            thickness: of the skin, m.
            smeared: stringer area over pitch, m.
            bending: 12 I/T³ of skin with stringers.
        """
        if name not in self._properties:
            m = next(m for m in facts("materials").values() if m["id"] == material)
            plane = m["e"] / (1 - m["nu"] ** 2)
            g11 = plane + m["e"] * smeared / thickness
            g33 = m["e"] / 2 / (1 + m["nu"])
            rho = m["rho"] * (1 + smeared / thickness)
            mid = self.next_id("stiffened skins", "material")
            values = (g11, m["nu"] * plane, 0.0, plane, 0.0, g33, rho)
            self.section("Materials").comment(f"{name}, membrane with stringers")
            self.section("Materials").add(
                "MAT2", mid, *(float(f"{v:.6g}") for v in values)
            )
            pid = self.next_id("shells", "property")
            section = self.section("Properties of shells")
            section.comment(f"property {pid}: {name}")
            t = float(f"{thickness:.5g}")
            section.add("PSHELL", pid, mid, t, material, bending, material)
            self._properties[name] = pid
            self._per_area[pid] = float(f"{rho:.6g}") * t
        return self._properties[name]

    def frame(self, name: str, origin: Float64, axis: Float64, up: Float64) -> int:
        """CORD2R of that name with its x-axis along `axis`; returns its id.

        Args:
            name: comment, and key.
            origin: (3,) m.
            axis: (3,) direction of x.
            up: (3,) direction in the x-z plane.
        """
        if name not in self._properties:
            cid = self.next_id("coordinate systems", "frame")
            section = self.section("Coordinate systems")
            section.comment(f"{name}: x along the stringers")
            x = axis / np.linalg.norm(axis)
            z = up - (up @ x) * x
            points = (origin, origin + z / np.linalg.norm(z), origin + x)
            section.add(
                *("CORD2R", cid, 0),
                *(float(np.round(v, 6)) + 0.0 for p in points for v in p),
                wide=True,
            )
            self._properties[name] = cid
        return self._properties[name]

    def bar_property(
        self,
        name: str,
        material: int,
        area: float,
        i1: float,
        i2: float,
        j: float,
        half: tuple[float, float] | None = None,
    ) -> int:
        """PBAR of that name, written when first asked for; returns its id.

        Args:
            name: comment, and key.
            material: id.
            area: m².
            i1, i2: second moments in planes 1 and 2, m⁴.
            j: torsion constant, m⁴.
            half: half sizes along the orientation vector and across, m, at whose
                corners stresses are recovered.
        """
        if name not in self._properties:
            pid = self.next_id("bars", "property")
            section = self.section("Properties of bars")
            section.comment(f"property {pid}: {name}")
            values = [float(f"{x:.5g}") for x in (area, i1, i2, j)]
            corners: list[Value] = []
            if half:
                c, d = half
                corners = [None, None, c, d, c, -d, -c, d, -c, -d]
            section.add("PBAR", pid, material, *values, *corners)
            self._properties[name] = pid
            self._per_length[pid] = density(material) * values[0]
        return self._properties[name]

    def shell(
        self, part: str, pid: int, nodes: Sequence[int], mcid: int | None = None
    ) -> None:
        """CQUAD4 or CTRIA3, whose mass is counted in the part's structure.

        Args:
            part: section.
            pid: of a shell property.
            nodes: three or four grids.
            mcid: coordinate system whose x-axis is the material's 1-axis.
        """
        card = "CQUAD4" if len(nodes) == 4 else "CTRIA3"
        self.element(part, card, pid, *nodes, mcid)
        p = np.array([self.position[i] for i in nodes])
        area, center = shell_area_center(p)
        self._count(part, self._per_area[pid] * area, center)

    def bar(
        self,
        part: str,
        pid: int,
        a: int,
        b: int,
        orientation: Float64,
        shift: Float64 | None = None,
        pins: int | None = None,
    ) -> None:
        """CBAR, whose mass is counted in the part's structure.

        Args:
            part: section.
            pid: of a `bar_property`.
            a: grid at the start.
            b: grid at the end.
            orientation: (3,) vector of plane 1.
            shift: (3,) offset of both ends from their grids, m.
            pins: freedoms (bar axes) that both ends do not take along.
        """
        vector = [round(float(x), 4) + 0.0 for x in orientation]
        offset: list[float] = []
        if shift is not None and np.any(shift):
            offset = [round(float(x), 5) + 0.0 for x in shift]
        tail = [None, pins, pins, *offset, *offset] if offset or pins else []
        self.element(part, "CBAR", pid, a, b, *vector, *tail)
        pa, pb = self.position[a], self.position[b]
        length = float(np.linalg.norm(pb - pa))
        extra = np.array(offset) if offset else 0.0
        self._count(part, self._per_length[pid] * length, (pa + pb) / 2 + extra)

    def _count(self, part: str, mass: float, center: Float64) -> None:
        if mass:
            self.structure.setdefault(part, []).append((mass, center))

    def deck(self, title: str, sets: Mapping[int, Sequence[int]], modes: int) -> str:
        """The text of the deck, a normal-modes run of `modes` modes."""
        control = [f"TITLE = {title}", "METHOD = 1"]
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


def density(material: int) -> float:
    """Density of a material by id, kg/m³; 0 for the beam models' massless aluminium."""
    densities = {m["id"]: m["rho"] for m in facts("materials").values()}
    return densities.get(material, 0.0)


def shell_area_center(p: Float64) -> tuple[float, Float64]:
    """Area (m²) and middle (3,) of a triangle or quadrilateral (3 or 4, 3)."""
    if len(p) == 3:
        return float(np.linalg.norm(np.cross(p[1] - p[0], p[2] - p[0])) / 2), p.mean(0)
    return float(np.linalg.norm(np.cross(p[2] - p[0], p[3] - p[1])) / 2), p.mean(0)
