"""Cuts through bars, sheets, rigid elements: what the cut elements carry, any frame.

The airframe is written for this test: a swept wing box of sheets with an engine on an
RBE3 and a winglet of bars, a tailplane of two bars, all on a fuselage of bars; the wing
hangs on an RBE2.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from drake_landing.parts.branches import beams_of_branches
from drake_landing.parts.cuts import BeamCuts, Cutter
from drake_landing.parts.inventory import inventory
from drake_landing.parts.slices import balanced
from drake_landing.places import Beam
from fem.deck.reader import read_deck
from fem.model.structure import Structure
from fem.recovery.elements import element_tables
from fem.recovery.grid_forces import grid_balance

# Columns: aft, starboard, up in the axes of the deck.
FRAMES = {
    "flies toward -x": np.eye(3),
    "flies toward +x": np.diag([-1.0, -1.0, 1.0]),
    "flies toward +y": np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
}
LOADED = (1, 1021, 2021)  # nose, and a corner of each wing box


class Writer:
    """Grids in aft, starboard, up; cards in the deck's axes."""

    def __init__(self, R_BA: np.ndarray) -> None:
        self.R = R_BA
        self.lines = ["SOL 103", "CEND", "BEGIN BULK", *MATERIALS]
        self.element = 0

    def vector(self, v) -> str:
        return ",".join(f"{c:.9g}" for c in self.R @ np.asarray(v, float) + 0.0)

    def grid(self, grid: int, *p: float) -> int:
        self.lines.append(f"GRID,{grid},,{self.vector(p)}")
        return grid

    def add(self, card: str, pid: int, *grids: int) -> int:
        self.element += 1
        up = f",{self.vector([0.1, 0.2, 1.0])}" if card == "CBAR" else ""
        row = ",".join(map(str, grids))
        self.lines.append(f"{card},{self.element},{pid},{row}{up}")
        return self.element

    def mass(self, grid: int, mass: float) -> None:
        self.element += 1
        i = 0.1 * mass
        self.lines.append(f"CONM2,{self.element},{grid},,{mass}")
        self.lines.append(f",{i},,{i},,,{i}")


MATERIALS = """\
PARAM,GRDPNT,0
MAT1,1,7.+10,,.3,2700.
PBAR,1,1,.02,2.-3,2.-3,2.-3
PBAR,2,1,.01,4.-4,4.-4,6.-4
PSHELL,3,1,.004,1,,1""".splitlines()
BAYS = 8


def airframe(R_BA: np.ndarray) -> str:
    w = Writer(R_BA)
    w.lines += ["$-----------------", "$ fuselage", "$-----------------"]
    stations = [0.0, 3.0, 6.0, 8.0, 9.0, 12.0, 15.0, 18.0]
    nodes = [w.grid(i + 1, x, 0.0, 0.1 * (x > 8.0)) for i, x in enumerate(stations)]
    for a, b in pairwise(nodes):
        w.add("CBAR", 1, a, b)
    for node in nodes:
        w.mass(node, 400.0)
    for side, first in ((1.0, 1000), (-1.0, 2000)):
        name = "starboard" if side > 0 else "port"
        wing(w, side, first, name)
        w.lines += [f"$ {'-' * 20}", f"$ tailplane_{name}", f"$ {'-' * 20}"]
        a = w.grid(first + 400, 18.5, side * 1.3, 0.1)
        b = w.grid(first + 401, 19.0, side * 2.9, 0.1)
        w.add("CBAR", 2, nodes[-1], a)
        w.add("CBAR", 2, a, b)
        w.mass(a, 30.0)
        w.mass(b, 20.0)
    return "\n".join([*w.lines, "ENDDATA", ""])


def wing(w: Writer, side: float, first: int, name: str) -> None:
    """A swept box of four sheets per bay, on an RBE2; engine and winglet."""
    w.lines += [f"$ {'-' * 20}", f"$ wing_{name}", f"$ {'-' * 20}"]
    ring = []
    for k in range(BAYS + 1):
        y, x = 1.0 + k, 7.5 + 0.5 * k
        chord, height = 2.0 - 0.1 * k, 0.3 - 0.02 * k
        corners = ((x, -height), (x + chord, -height), (x + chord, height), (x, height))
        ring.append(
            [
                w.grid(first + 10 * k + i, cx, side * y, cz)
                for i, (cx, cz) in enumerate(corners)
            ]
        )
    for inner, outer in pairwise(ring):
        for i in range(4):
            j = (i + 1) % 4
            w.add("CQUAD4", 3, inner[i], inner[j], outer[j], outer[i])
    for k, corners in enumerate(ring):
        w.add("CQUAD4", 3, *corners)  # a rib, which lies in a plane y
        w.mass(corners[k % 4], 25.0)
    rigid = first + 700
    w.lines.append(f"RBE2,{rigid},4,123456,{','.join(map(str, ring[0]))}")
    w.lines += [f"$ {'-' * 20}", f"$ engine_{name}", f"$ {'-' * 20}"]
    pylon = w.grid(first + 600, 8.2, side * 3.5, -0.5)
    engine = w.grid(first + 601, 6.0, side * 3.5, -0.9)
    a, b, c, d = (*ring[2][:2], *ring[3][:2])
    w.lines.append(f"RBE3,{rigid + 1},,{pylon},123456,1.,123,{a},{b}")
    w.lines.append(f",{c},{d}")
    w.add("CBAR", 2, pylon, engine)
    w.mass(engine, 300.0)
    w.lines += [f"$ {'-' * 20}", f"$ winglet_{name}", f"$ {'-' * 20}"]
    tip = [w.grid(first + 500 + i, 12.5 + 0.3 * i, side * 9.0, 0.7 * i)
           for i in range(4)]  # fmt: skip
    w.lines.append(f"RBE2,{rigid + 2},{tip[0]},123456,{','.join(map(str, ring[-1]))}")
    for a, b in pairwise(tip):
        w.add("CBAR", 2, a, b)
        w.mass(b, 5.0)


@dataclass
class Loaded:
    """An airframe in a frame, under loads that its inertia balances."""

    R_BA: np.ndarray
    structure: Structure

    @cached_property
    def cutter(self) -> Cutter:
        return Cutter(self.structure)

    @cached_property
    def cuts(self) -> dict[str, BeamCuts]:
        found = beams_of_branches(
            self.cutter, self.R_BA.T, LOADED, inventory(self.structure, {})
        )
        return {b.name: self.cutter.cuts(b, LOADED) for b in found}

    @cached_property
    def load(self) -> np.ndarray:
        """(3, 6), B."""
        in_A = np.array(
            [
                [1.0, 2.0, 9.0, 0.0, -5.0, 1.0],
                [6.0, -3.0, 30.0, 1.0, 2.0, 3.0],
                [8.0, 4.0, 20.0, -4.0, 3.0, 7.0],
            ]
        )
        return 1e3 * in_A.reshape(3, 2, 3).dot(self.R_BA.T).reshape(3, 6)

    @cached_property
    def answer(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacements and accelerations of the g-set."""
        pattern = self.structure.operator(LOADED, frame="basic")
        found = balanced(self.structure, pattern.T @ self.load.reshape(-1, 1))
        T = self.structure.elimination.T
        return (T @ found.displacement)[:, 0], (T @ found.motion)[:, 0]

    def section(self, cuts: BeamCuts) -> np.ndarray:
        """(n, 6), B."""
        pattern = self.structure.operator(LOADED, frame="basic")
        found = balanced(self.structure, pattern.T @ self.load.reshape(-1, 1))
        inertia = (cuts.of_acceleration @ found.motion).T
        return cuts.loads(inertia, np.array(LOADED), self.load[None])[0]

    @cached_property
    def carried(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Element ids, grids and forces on these, B; rigid elements have id 0."""
        s, (u, a) = self.structure, self.answer
        none = np.zeros(len(s.points.grid_id), bool)
        table = grid_balance(s.points, s.blocks, loaded=none, spc=none, mpc=none)
        forces = (table.elements @ u).reshape(-1, 6)
        applied = np.zeros(s.points.size)
        for row, load in zip(s.points.rows(LOADED), self.load):
            applied[6 * row : 6 * row + 6] = load
        rest = s.matrices.stiffness @ u + s.matrices.mass @ a - applied
        rigid = s.elimination.mpc_force(rest).reshape(-1, 6)
        return (
            np.concatenate([table.element_id, np.zeros(len(none), np.int64)]),
            np.concatenate([table.at, np.arange(len(none))]),
            np.concatenate([forces, rigid]),
        )


@pytest.fixture(scope="module", params=FRAMES)
def loaded(request, tmp_path_factory) -> Loaded:
    R_BA = FRAMES[request.param]
    path = tmp_path_factory.mktemp("sections") / "airframe.bdf"
    path.write_text(airframe(R_BA))
    return Loaded(R_BA, Structure.from_deck(read_deck(path)))


SIDES = ("wing", "tailplane")
PARTS = {
    *(f"{part}, {side}" for part in SIDES for side in ("starboard", "port")),
    *(f"engine, {side}, fore" for side in ("starboard", "port")),
    *(f"winglet, {side}, up" for side in ("starboard", "port")),
    *("fuselage, fore", "fuselage, aft"),
}


def test_parts_are_named_by_component_and_side(loaded: Loaded) -> None:
    assert set(loaded.cuts) == PARTS


@pytest.mark.parametrize("part", sorted(PARTS))
def test_cut_elements_carry_the_section_load(loaded: Loaded, part: str) -> None:
    """Outer loads less inertia = grid-point forces of what crosses, rigid or not."""
    cuts, s = loaded.cuts[part], loaded.structure
    element, at, force = loaded.carried
    ours = loaded.section(cuts)
    for i, point in enumerate(cuts.point):
        outer = cuts.strip >= i
        inner_of = np.unique(element[~outer[at]])
        crossing = outer[at] & ((element == 0) | np.isin(element, inner_of))
        f = force[crossing]
        arm = s.points.xyz[at[crossing]] - point
        theirs = -np.array(
            [*f[:, :3].sum(0), *(f[:, 3:] + np.cross(arm, f[:, :3])).sum(0)]
        )
        size = np.abs(ours).max()
        assert np.abs(ours[i] - theirs).max() < 1e-6 * size
    assert np.abs(ours).max() > 10.0


BARS = [p for p in sorted(PARTS) if "wing, " not in p]


@pytest.mark.parametrize("part", BARS)
def test_a_section_through_one_bar_is_its_force(loaded: Loaded, part: str) -> None:
    """All six components, about the bar's axis."""
    cuts, s = loaded.cuts[part], loaded.structure
    ours = loaded.section(cuts)
    u, _ = loaded.answer
    (bars,) = [b for b in s.blocks if b.card == "CBAR"]
    table = next(t for t in element_tables(s.points, [bars], "force"))
    forces = table.of(u[:, None])[0]
    checked = 0
    for i, (point, ids) in enumerate(zip(cuts.point, cuts.crossing)):
        link, _, _ = loaded.cutter.links.crossing(cuts.strip >= i)
        if len(set(link.tolist())) > 1:
            continue  # the wing's RBE2, or the engine's RBE3, crosses as well
        checked += 1
        (eid,) = ids
        e = list(bars.id).index(eid)
        of = dict(zip(table.columns, forces[list(table.id).index(eid)]))
        a, b = bars.dof[e, [0, 6]] // 6
        R = bars.geometry.R_BE[e]
        p = s.points.xyz[a]
        # Upon end A; the section load is what the part beyond the cut passes inward.
        force = R @ [-of["axial"], -of["shear1"], -of["shear2"]]
        moment = R @ [-of["torque"], of["bending_moment_a2"], -of["bending_moment_a1"]]
        moment = moment + np.cross(p - point, force)
        sign = -1.0 if cuts.strip[b] >= i else 1.0
        size = np.abs(ours).max()
        np.testing.assert_allclose(ours[i, :3], sign * force, atol=1e-6 * size)
        np.testing.assert_allclose(ours[i, 3:], sign * moment, atol=1e-6 * size)
        axis = np.cross(s.points.xyz[b] - p, point - p)
        assert np.abs(axis).max() < 1e-6  # the point lies on the bar
    assert checked >= 6


def test_the_frame_of_the_deck_does_not_matter(loaded: Loaded, reference) -> None:
    for name, cuts in loaded.cuts.items():
        same = reference.cuts[name]
        R = loaded.R_BA.T
        np.testing.assert_allclose(cuts.point @ R.T, same.point, atol=1e-6)
        ours, theirs = loaded.section(cuts), reference.section(same)
        named = cuts.named(ours[None]), same.named(theirs[None])
        np.testing.assert_allclose(*named, atol=1e-6 * np.abs(theirs).max())


@pytest.fixture(scope="module")
def reference(tmp_path_factory) -> Loaded:
    path = tmp_path_factory.mktemp("reference") / "airframe.bdf"
    path.write_text(airframe(np.eye(3)))
    return Loaded(np.eye(3), Structure.from_deck(read_deck(path)))


def test_a_box_is_cut_at_the_middle_of_its_sheets(reference: Loaded) -> None:
    """Four equal sheets of one thickness: the centroid of the box's outline."""
    cuts = reference.cuts["wing, starboard"]
    for station, point in zip(cuts.beam.stations, cuts.point):
        k = station - 1.0
        assert point[0] == pytest.approx(
            7.5 + 0.5 * k + 0.5 * (2.0 - 0.1 * k), abs=0.02
        )
        assert point[2] == pytest.approx(0.0, abs=1e-9)


def test_cuts_through_rigid_elements_and_planes_of_grids(reference: Loaded) -> None:
    """Planes through the RBE2, at its end, in the plane of a rib and beyond it."""
    beam = Beam(
        name="root",
        outward="starboard",
        stations=np.array([0.5, 1.0, 4.0, 4.0 + 1e-6]),
        tips=(1503,),
    )
    cuts = reference.cutter.cuts(beam, LOADED)
    assert not len(cuts.crossing[0])  # the RBE2 alone
    ring = cuts.strip[reference.structure.points.rows([1030, 1031, 1032, 1033])]
    assert (ring == 2).all()  # what lies in the plane belongs to the outer side
    loads = reference.section(cuts)
    # Nothing but the RBE2 lies between the first two: they differ by their arm.
    arm = cuts.point[0] - cuts.point[1]
    size = np.abs(loads).max()
    np.testing.assert_allclose(loads[1, :3], loads[0, :3], atol=1e-9 * size)
    moved = loads[0, 3:] + np.cross(arm, loads[0, :3])
    np.testing.assert_allclose(loads[1, 3:], moved, atol=1e-9 * size)
    # Beyond the rib the load of the gear and the inertia of the rib are left out.
    assert np.abs(loads[2] - loads[3]).max() > 1e-3 * size


TWO_BARS = """\
CEND
BEGIN BULK
MAT1,1,7.+10,,.3,2700.
MAT1,2,21.+10,,.3,7800.
PBAR,1,1,.03,2.-5,2.-5,2.-5
PBAR,2,2,.01,2.-5,2.-5,2.-5
PSHELL,3,1,.01,1,,1
GRID,1,,0.,0.,0.
GRID,2,,.2,2.,.1
GRID,3,,1.,0.,0.
GRID,4,,1.,2.,0.
GRID,5,,1.6,0.,0.
GRID,6,,1.8,2.,.1
CBAR,1,1,1,2,0.,0.,1.
,,,0.,0.,.5,0.,0.,.5
CBAR,2,2,3,4,0.,0.,1.
CQUAD4,3,3,3,5,6,4,,0.3
ENDDATA
"""


@pytest.mark.parametrize(("outward", "station"), [("starboard", 0.5), ("port", 1.5)])
def test_offsets_and_moduli_weigh(outward: str, station: float, tmp_path: Path) -> None:
    """EA cos³ of two bars, one with offsets, and of a sheet with an offset."""
    path = tmp_path / "bars.bdf"
    path.write_text(TWO_BARS)
    cutter = Cutter(Structure.from_deck(read_deck(path)))
    beam = Beam(name="two", outward=outward, stations=np.array([station]))
    (point,) = cutter.cuts(beam, []).point
    share = station / 2.0
    t = np.array([0.2, 2.0, 0.1]) / np.linalg.norm([0.2, 2.0, 0.1])
    stretch = t[1] ** 2 - 0.3 * (1.0 - t[1] ** 2)
    first = 7e10 * 0.03 * stretch * t[1]
    second = 21e10 * 0.01
    places = np.array([[0.2 * share, station, 0.1 * share + 0.5], [1.0, station, 0.0]])
    model = cutter.elements
    sheet = next(part for part in model if part.sheets)
    weight = sheet.per_length[0, 1]
    right = 1.6 + 0.2 * share
    chord = np.hypot(right - 1.0, 0.1 * share)
    third = weight * chord
    assert weight == pytest.approx(7e10 * 0.01, rel=0.02)
    normal = np.cross([0.8, 2.0, 0.1], [-0.6, 2.0, 0.0])
    place = [0.5 * (1.0 + right), station, 0.05 * share]
    place = place + 0.3 * normal / np.linalg.norm(normal)
    w = np.array([first, second, third])
    middle = w @ np.array([*places, place]) / w.sum()
    np.testing.assert_allclose(point, [middle[0], station, middle[2]], atol=1e-9)
