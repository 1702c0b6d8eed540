"""CHEXA20, CPENTA15, CPYRAM13, CTETRA10: beams, NAFEMS LE10, figures of MSC and NX."""

import numpy as np

from benchmarks.verification.mesh import Bulk, Float64, Int64, box, with_mid_sides
from benchmarks.verification.row import LINES, SURFACES, Row, convergence, figure
from benchmarks.verification.runner import run
from fem.deck.records.solids import HEXA, PENTA, PYRAMID, TETRA

_FACES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1),
          (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]  # fmt: skip


def _cut(card: str, xyz: Float64, bricks: Int64) -> tuple[Float64, Int64]:
    """Bricks as two prisms, six pyramids or twelve tetrahedra each."""
    if card == "CHEXA":
        return xyz, bricks
    if card == "CPENTA":
        halves = ([0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7])
        return xyz, np.concatenate([bricks[:, h] for h in halves])
    apex = len(xyz) + np.arange(len(bricks))
    nodes = np.vstack([xyz, xyz[bricks].mean(axis=1)])
    pyramids = np.concatenate([np.c_[bricks[:, f], apex] for f in _FACES])
    if card == "CPYRAM":
        return nodes, pyramids
    tetras = []
    for *base, top in pyramids.tolist():
        # Both neighbours of a face cut it along the same diagonal.
        start = base.index(min(base))
        a, b, c, d = base[start:] + base[:start]
        tetras += [[a, b, c, top], [a, c, d, top]]
    return nodes, np.array(tetras)


def quadratic(card: str, n: tuple[int, int, int]) -> tuple[Float64, Int64]:
    """Unit cube in n bricks, cut and with mid-sides: points (g, 3), (e, nodes)."""
    return with_mid_sides(card, *_cut(card, *box(*n)))


CASES = (("CHEXA", 20), ("CPENTA", 15), ("CPYRAM", 13), ("CTETRA", 10))


def chains_of_hexa20() -> list[Row]:
    """A cantilever 8 x 1 x 2 of one row of CHEXA20 under 120 across its end."""
    rows = []
    for count in (1, 4, 16):
        xyz, conn = quadratic("CHEXA", (count, 1, 1))
        xyz = xyz * [8.0, 1.0, 2.0]
        bulk = Bulk("MAT1,1,1.+6,,0.\nPSOLID,1,1")
        bulk.grids(xyz)
        bulk.elements("CHEXA", 1, conn)
        bulk.fix("123", xyz[:, 0] == 0.0)
        bulk.fix("456", np.arange(len(xyz)))
        at_end = xyz[:, 0] == 8.0
        corner = at_end & np.isin(xyz[:, 1], (0.0, 1.0)) & np.isin(xyz[:, 2], (0.0, 2))
        bulk.forces(2, np.flatnonzero(corner), (0, 0, 1), np.full(4, -10.0))
        middle = np.flatnonzero(at_end & ~corner)
        bulk.forces(2, middle, (0, 0, 1), np.full(4, 40.0))
        ours = run(bulk.deck(101, "SPC = 1\nLOAD = 2\nDISP = ALL\nSTRESS = ALL"))
        shear = ours.column("static/1/element_stress/CHEXA", "txz")
        worst = shear[np.argmax(np.abs(shear - 60.0))]
        case = f"cantilever of {count} CHEXA20"
        rows.append(
            figure(case, "shear at all centers, P/A", worst, 60.0, "equilibrium")
        )
        # Plane sections, shear by the whole area: what the shapes can describe.
        tip = 120 * 8**3 / (3 * 1e6 * 8 / 12) + 120 * 8 / (5e5 * 2)
        found = ours["static/1/displacement"][at_end, 2].mean()
        source = "beam theory, shear factor 1 (5/6: 0.03187)"
        rows.append(figure(case, "deflection of the end", found, tip, source))
    return rows


def quadratic_cantilevers() -> list[Row]:
    """A cantilever 6 x 1 x 1 under a parabolic end shear, Timoshenko's field."""
    rows = []
    for card, nodes in CASES:
        found = []
        for count in (3, 6):
            n = (count, 1, 1) if count == 3 else (count, 2, 2)
            found.append((f"{n[0]} x {n[1]} x {n[2]}", _tip(card, n)))
        exact = 6.0**3 / (3 * 1e3 / 12) + 6.0 / (400.0 * 5 / 6)
        rows += convergence(
            f"cantilever of {card}{nodes}",
            "deflection of the end",
            found,
            exact,
            "Timoshenko beam, shear factor 5/6",
        )
    return rows


def _tip(card: str, n: tuple[int, int, int]) -> float:
    xyz, conn = quadratic(card, n)
    xyz = xyz * [6.0, 1.0, 1.0]
    bulk = Bulk("MAT1,1,1000.,400.\nPSOLID,1,1")
    bulk.grids(xyz)
    bulk.elements(card, 1, conn)
    bulk.fix("456", np.arange(len(xyz)))
    root = xyz[:, 0] == 0.0
    bulk.fix("1", root)
    bulk.fix("3", root & (xyz[:, 2] == 0.5))
    bulk.fix("2", root & (xyz[:, 1] == 0.5))
    for eid, face in _end_faces(card, conn, xyz):
        bulk.add("PLOAD4", 2, eid, 1.0, "", "", "", *face, 0, 0.0, 0.0, 1.0)
    ours = run(bulk.deck(101, "SPC = 1\nLOAD = 2\nDISP = ALL"))
    end = (xyz[:, 0] == 6.0) & (xyz[:, 2] == 0.5)
    return float(ours["static/1/displacement"][end, 2].mean())


def _end_faces(
    card: str, conn: Int64, xyz: Float64
) -> list[tuple[int, tuple[int, int]]]:
    """Elements with a face at the largest x, and the two grids that PLOAD4 wants."""
    return _loaded(card, conn, xyz[:, 0] == xyz[:, 0].max())


def _loaded(
    card: str, conn: Int64, on: np.ndarray
) -> list[tuple[int, tuple[int, int]]]:
    """(element id, G1 and G3 or G4) of the faces whose corners are all `on` (g,)."""
    corners = {"CHEXA": 8, "CPENTA": 6, "CPYRAM": 5, "CTETRA": 4}[card]
    faces = {"CHEXA": HEXA, "CPENTA": PENTA, "CPYRAM": PYRAMID, "CTETRA": TETRA}
    found = []
    for e, grids in enumerate(conn):
        for face in faces[card].faces:
            if not on[grids[list(face)]].all():
                continue
            g1 = grids[face[0]] + 1
            if card == "CTETRA":
                (other,) = set(range(corners)) - set(face)
                second = grids[other] + 1
            elif len(face) == 3:
                second = ""
            else:
                second = grids[face[2]] + 1
            found.append((e + 1, (g1, second)))
    return found


def thick_plate() -> list[Row]:
    """NAFEMS LE10: a quarter of an elliptic plate with a hole under pressure."""
    rows = []
    for card, nodes in CASES:
        found = []
        for n in ((4, 3, 2), (8, 6, 2)):
            label = f"{n[0]} x {n[1]} x {n[2]}"
            found.append((label, _le10(card, n)))
        rows += convergence(
            f"LE10 thick plate of {card}{nodes}",
            "oyy at D, MPa",
            found,
            -5.38,
            "NAFEMS R0015, LE10",
            # Printed stresses of tetrahedra are linear: slower at a notch.
            target=0.05 if card == "CTETRA" else 0.03,
        )
    return rows


def _le10(card: str, n: tuple[int, int, int]) -> float:
    place, conn = quadratic(card, n)
    angle = 0.5 * np.pi * place[:, 1]
    inner = np.stack([2.0 * np.cos(angle), np.sin(angle)], axis=1)
    outer = np.stack([3.25 * np.cos(angle), 2.75 * np.sin(angle)], axis=1)
    # Finer towards the hole.
    out = place[:, :1] * (1.0 + place[:, :1]) / 2.0
    xyz = np.c_[inner + out * (outer - inner), 0.6 * place[:, 2]]
    bulk = Bulk("MAT1,1,2.1+11,,.3\nPSOLID,1,1")
    bulk.grids(xyz)
    bulk.elements(card, 1, conn)
    bulk.fix("456", np.arange(len(xyz)))
    bulk.fix("2", place[:, 1] == 0.0)
    bulk.fix("1", place[:, 1] == 1.0)
    rim = place[:, 0] == 1.0
    bulk.fix("12", rim)
    bulk.fix("3", rim & (place[:, 2] == 0.5))
    top = place[:, 2] == 1.0
    for eid, face in _loaded(card, conn, top):
        bulk.add("PLOAD4", 2, eid, 1e6, "", "", "", *face)
    ours = run(bulk.deck(101, "SPC = 1\nLOAD = 2\nSTRESS = ALL"))
    d = int(np.flatnonzero(np.abs(xyz - [2.0, 0.0, 0.6]).max(axis=1) < 1e-9)[0])
    table = f"static/1/element_stress/{card}"
    values = []
    for k in range({"CHEXA": 8, "CPENTA": 6, "CPYRAM": 5, "CTETRA": 4}[card]):
        mine = conn[:, k] == d
        values += ours.column(table, f"c{k + 1}_oyy")[mine].tolist()
    return float(np.mean(values)) * 1e-6


_BOX = [(1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0),
        (1, 0, 1), (1, 1, 1), (0, 1, 1), (0, 0, 1)]  # fmt: skip


def single_hexa20() -> list[Row]:
    """2.5 x 5 x 10 mm, gravity along the shortest edge, held at the upper face."""
    bulk = Bulk("MAT1,1,7.2+10,,.33,2660.\nPSOLID,1,1\nGRAV,1,,9.80665,-1.,0.,0.")
    corners = np.array([[x, y, z] for x, y, z in _BOX]) * [0.0025, 0.005, 0.01]
    pairs = np.array(HEXA.edges)
    bulk.grids(np.vstack([corners, corners[pairs].mean(axis=1)]))
    bulk.elements("CHEXA", 1, np.arange(20)[None])
    held = [4, 5, 6, 7, 16, 17, 18, 19]
    bulk.fix("123456", held)
    bulk.fix("456", np.setdiff1d(np.arange(20), held))
    case = "SPC = 1\nLOAD = 1\nDISP = ALL\nSPCFORCES = ALL\nSTRESS = ALL"
    ours = run(bulk.deck(101, case))
    u, r = ours["static/1/displacement"], ours["static/1/spc_force"]
    stress = ours["static/1/element_stress/CHEXA/value"][0].reshape(9, 10)
    name, source = "one CHEXA20 under gravity", "MSC 2020 (pyNastran models, msc)"
    figures = [
        ("u1 of a free corner, m", u[0, 0], -7.655747147e-10),
        ("u1 of a free mid-side, m", u[8, 0], -7.685651005e-10),
        ("force of constraint, held corner, N", r[4, 0], 0.0044177),
        ("force of constraint, mid-side of 2.5 mm, N", r[19, 0], -0.009169458),
        ("force of constraint, mid-side of 5 mm, N", r[16, 0], 0.001964413),
        ("txz at the center, Pa", stress[0, 5], 130.428),
        ("ozz at a held corner, Pa", stress[5, 2], 2900.46),
        ("txy at a held corner, Pa", stress[5, 3], 250.197),
        ("tyz at a held corner, Pa", stress[5, 4], -156.254),
    ]
    return [figure(name, what, a, b, source) for what, a, b in figures]


_TETRAS = """\
GRID,2154,,-.375018,-.071002,12.025
GRID,2136,,-.344288,.0727013,12.0375
GRID,2487,,-.33584,-.033702,12.0071
GRID,2534,,-.360372,.0720874,11.9835
GRID,2191,,-.296663,.0035972,11.9893
GRID,2161,,-.313558,.216405,12.05
GRID,2503,,-.332027,.214316,11.95
GRID,2486,,-.305111,.110001,12.0196
GRID,2485,,-.314345,.108957,11.9696
GRID,2259,,-.322793,.215361,12.
GRID,2128,,-.229769,.102652,11.95
GRID,2260,,-.220535,.103696,12.
GRID,2488,,-.212087,-.002707,11.9696
GRID,2551,,-.127511,-.009012,11.95
CTETRA,1,1,2154,2161,2191,2503,2136,2486
,2487,2534,2259,2485
CTETRA,2,1,2191,2161,2551,2503,2486,2260
,2488,2485,2259,2128
PSOLID,1,1
MAT1,1,1.705+7,,.31
SPC1,1,123,2128,2260,2488,2551
FORCE,2,2154,,1.,1.,0.,0."""


def distorted_tetra10() -> list[Row]:
    """Two CTETRA10 whose mid-sides lie off the middle, a force at the free corner."""
    ours = run(Bulk(_TETRAS).deck(101, "SPC=1\nLOAD=2\nDISP=ALL\nSTRESS=ALL"))
    u = ours["static/1/displacement"]
    at = {int(g): k for k, g in enumerate(ours["grid_id"])}
    table = "static/1/element_stress/CTETRA"
    figures = [
        ("u1 at the force", u[at[2154], 0], 4.340456e-5),
        ("u2 at the force", u[at[2154], 1], -1.289517e-5),
        ("u3 at the force", u[at[2154], 2], 4.16372e-5),
        ("u3 of a mid-side", u[at[2487], 2], 2.368923e-5),
        ("oxx at the center of 1", ours.column(table, "oxx")[0], -248.031),
        ("oxx at a corner of 1", ours.column(table, "c3_oxx")[0], -2305.923),
        ("txy at a corner of 2", ours.column(table, "c4_txy")[1], 804.0324),
    ]
    source = "MSC (pyNastran models, tet10)"
    return [figure("two CTETRA10", what, a, b, source) for what, a, b in figures]


# Structural damping of the frequency response whose static part is compared.
_GE = 0.03333
_CUBE_MATERIAL = f"MAT1,1,1.+7,4.+6,.25,2.038685,,,{_GE}\nPSOLID,1,1"


def _cube(card: str, nodes: int) -> tuple[Bulk, int]:
    """A cube of one brick or two prisms held at three faces; its free corner.

    With 12 nodes the brick has mid-sides on its edges along x only.
    """
    xyz, conn = quadratic(card, (1, 1, 1))
    if card == "CPENTA":  # the cut runs beside the free corner
        xyz = np.c_[1.0 - xyz[:, 0], xyz[:, 1:]]
        lower, upper = conn[:, [0, 2, 1]], conn[:, [3, 5, 4]]
        sides = conn[:, [8, 7, 6, 9, 11, 10, 14, 13, 12]]
        conn = np.c_[lower, upper, sides]
    bulk = Bulk(_CUBE_MATERIAL)
    bulk.grids(xyz)
    if nodes == 12:
        gone = np.r_[[False] * 8, xyz[conn[0, 8:], 0] != 0.5]
        bulk.add(card, 1, 1, *np.where(gone, "", (conn[0] + 1).astype(str)))
        bulk.fix("123", conn[0, gone])
    else:
        bulk.elements(card, 1, conn)
    bulk.fix("456", np.arange(len(xyz)))
    bulk.fix("123", (xyz == 0.0).any(axis=1))
    return bulk, int(np.flatnonzero((xyz == 1.0).all(axis=1))[0])


def cubes_under_a_corner_force() -> list[Row]:
    """Displacement of the free corner under 2, 0, 2: MSC's response at 0 Hz."""
    rows = []
    for card, nodes, real_part in (
        ("CHEXA", 20, (1.8276668e-6, -1.7765401e-6, 1.8276668e-6)),
        ("CHEXA", 12, (7.8215487e-7, -5.4481217e-7, 1.0460368e-6)),
        ("CPENTA", 15, (1.7340020e-6, -1.5857188e-6, 1.8815221e-6)),
    ):
        bulk, corner = _cube(card, nodes)
        bulk.forces(2, corner, (1, 0, 1), 2.0)
        ours = run(bulk.deck(101, "SPC = 1\nLOAD = 2\nDISP = ALL"))
        for c, theirs in enumerate(real_part):
            rows.append(
                figure(
                    f"cube of {card}{nodes}, corner force",
                    f"u{c + 1} of the corner",
                    ours["static/1/displacement"][corner, c],
                    theirs * (1.0 + _GE**2),
                    "MSC (pyNastran models, api3)",
                )
            )
    return rows


def cubes_in_time() -> list[Row]:
    """The same with a sudden force and lumped mass, three steps."""
    nx = {
        ("CHEXA", 20): [
            (3.5085503e-9, -3.3132419e-9, 3.5085503e-9),
            (7.2803847e-9, -7.0611428e-9, 7.2803847e-9),
            (1.4309546e-8, -1.3729446e-8, 1.4309546e-8),
        ],
        ("CHEXA", 12): [
            (1.5007022e-9, -1.0072124e-9, 2.0243660e-9),
            (3.1159317e-9, -2.1648192e-9, 4.1718566e-9),
            (6.1219967e-9, -4.1933852e-9, 8.2180600e-9),
        ],
        ("CPENTA", 15): [
            (3.39599593e-9, -3.04929215e-9, 3.66368980e-9),
            (6.91861013e-9, -6.32068975e-9, 7.50460671e-9),
            (1.37003004e-8, -1.24224409e-8, 1.48259867e-8),
        ],
    }
    rows = []
    for (card, nodes), steps in nx.items():
        bulk, corner = _cube(card, nodes)
        bulk.lines.append("PARAM,W4,1.\nTSTEP,7,3,1.-4")
        bulk.lines.append("TLOAD2,5,6,,,0.,1.\nDLOAD,4,1.,1.,5")
        bulk.add("DAREA", 6, corner + 1, 1, 2.0)
        bulk.add("DAREA", 6, corner + 1, 3, 2.0)
        ours = run(bulk.deck(109, "SPC = 1\nDLOAD = 4\nTSTEP = 7\nDISP = ALL"))
        u = ours["transient/1/displacement"][:, corner]
        # The shares of the prism's mid-sides are not NX's to the last digits.
        target = LINES if card == "CHEXA" else SURFACES
        rows += [
            figure(
                f"cube of {card}{nodes}, sudden force",
                f"u{c + 1} of the corner, step {k + 1}",
                u[k + 1, c],
                steps[k][c],
                "NX 2019.2 (pyNastran models, tr1091x)",
                target=target,
            )
            for k in range(3)
            for c in range(3)
        ]
    return rows
