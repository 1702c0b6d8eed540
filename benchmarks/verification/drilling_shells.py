"""CQUADR and CTRIAR: patch tests with rotations, Cook's membrane, a cantilever."""

import numpy as np

from benchmarks.verification.macneal_harder import statics
from benchmarks.verification.mesh import Bulk, edge_shares, rectangle, triangles
from benchmarks.verification.patches import PATCH, PATCH_QUADS
from benchmarks.verification.row import Row, convergence, figure
from benchmarks.verification.runner import run

CARDS = {4: "CQUADR", 3: "CTRIAR"}
Material = tuple[float, float]


def drilling_model(
    xy: np.ndarray, conn: np.ndarray, material: Material, thickness: float
) -> Bulk:
    """A flat sheet in the plane z = 0; E, nu."""
    bulk = Bulk("PARAM,K6ROT,0.\n")
    bulk.add("MAT1", 1, material[0], "", material[1])
    bulk.add("PSHELL", 1, 1, thickness, 1, "", 1)
    bulk.grids(np.c_[xy, np.zeros(len(xy))])
    bulk.elements(CARDS[conn.shape[1]], 1, conn)
    return bulk


def drilling_patches() -> list[Row]:
    """Uniform strains and a rotation on MacNeal and Harder's mesh; the inside free."""
    rows = []
    x, y = PATCH.T
    exact = np.zeros((8, 6))
    exact[:, 0], exact[:, 1] = 1e-3 * (x + 0.8 * y), 1e-3 * (y + 0.2 * x)
    exact[:, 5] = 0.5e-3 * (0.2 - 0.8)
    for conn in (PATCH_QUADS, triangles(PATCH_QUADS)):
        name = CARDS[conn.shape[1]]
        bulk = drilling_model(PATCH, conn, (1e6, 0.25), 1e-3)
        bulk.fix("123456", np.arange(4))
        bulk.fix("345", np.arange(4, 8))
        for grid in range(4):
            for component in np.flatnonzero(exact[grid]):
                value = float(exact[grid, component])
                bulk.add("SPCD", 7, grid + 1, component + 1, value)
        results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nDISP = ALL\nSTRESS = ALL"))
        error = np.abs(results["static/1/displacement"] - exact).max() / 4e-4
        xx, yy, xy = 4000 / 3, 4000 / 3, 400.0
        mises = np.sqrt(xx * xx - xx * yy + yy * yy + 3.0 * xy * xy)
        stress = results.column(f"static/1/element_stress/{name}", "von_mises_1")
        for quantity, value in (
            ("inner displacements and rotations", error),
            ("stresses", np.abs(stress / mises - 1.0).max()),
        ):
            rows.append(
                figure(
                    f"membrane patch of {name}",
                    f"{quantity}: relative error",
                    float(value),
                    0.0,
                    "exact",
                    target=1e-10,
                )
            )
    return rows


def cook_membrane() -> list[Row]:
    """Cook's tapered panel, sheared at its end: the middle of that end."""
    rows = []
    for card in CARDS.values():
        found = []
        for n in (2, 4, 8, 16, 32):
            xy, conn = rectangle(n, n)
            s, t = xy.T
            panel = np.c_[48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)]
            conn = conn if card == "CQUADR" else triangles(conn)
            bulk = drilling_model(panel, conn, (1.0, 1 / 3), 1.0)
            # The root shears: its rotations are not those of a rigid body.
            bulk.fix("12345", s == 0.0)
            bulk.fix("345", s > 0.0)
            tip = np.flatnonzero(s == 1.0)
            bulk.forces(7, tip, np.array([0.0, 1.0, 0.0]), edge_shares(n + 1))
            found.append((f"{n} x {n}", float(statics(bulk)[tip[n // 2], 1])))
        rows += convergence(
            f"Cook's membrane of {card}",
            "deflection",
            found,
            23.96,
            "Cook 1974, refined",
            target=0.01,
        )
    return rows


def sheet_cantilever() -> list[Row]:
    """MacNeal and Harder's straight beam, bent in its plane, from one element deep."""
    rows = []
    for card in CARDS.values():
        found = []
        # The triangle, as Nastran's, bends in its plane on fine meshes only.
        for n in (1, 2, 4) if card == "CQUADR" else (2, 4, 8, 16):
            xy, conn = rectangle(6 * n, n)
            conn = conn if card == "CQUADR" else triangles(conn)
            bulk = drilling_model(xy * [6.0, 0.2], conn, (1e7, 0.3), 0.1)
            root, tip = (np.flatnonzero(xy[:, 0] == end) for end in (0.0, 1.0))
            bulk.fix("12345", root)
            bulk.fix("345", np.flatnonzero(xy[:, 0] > 0.0))
            shares = edge_shares(n + 1)
            bulk.forces(7, tip, np.array([0.0, 1.0, 0.0]), shares)
            deflection = float(shares @ statics(bulk)[tip, 1])
            found.append((f"{6 * n} x {n}", deflection))
        rows += convergence(
            f"straight beam of {card}",
            "in-plane shear",
            found,
            0.1081,
            "MacNeal & Harder 1985",
            target=0.01 if card == "CQUADR" else 0.02,
        )
    return rows
