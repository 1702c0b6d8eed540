"""Patch tests: uniform strains and curvatures on distorted meshes, exact to round-off.

MacNeal and Harder's meshes of quadrilaterals and bricks, and what is cut from them.
"""

import numpy as np

from benchmarks.verification.macneal_harder import shell_model
from benchmarks.verification.mesh import Bulk, triangles, with_mid_sides
from benchmarks.verification.row import Row, figure
from benchmarks.verification.runner import run

PATCH = np.array(
    [[0.0, 0.0], [0.24, 0.0], [0.24, 0.12], [0.0, 0.12],
     [0.04, 0.02], [0.18, 0.03], [0.16, 0.08], [0.08, 0.08]]
)  # fmt: skip
PATCH_QUADS = np.array(
    [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]]
)


def patches() -> list[Row]:
    """Membrane and bending patches: displacements and stresses, exact to 1e-10."""
    rows = []
    x, y = PATCH.T
    zero = 0.0 * x
    membrane = 1e-3 * np.stack([x + y / 2, y + x / 2, zero, zero, zero, zero], 1)
    bending = 1e-3 * np.stack(
        [zero, zero, (x * x + x * y + y * y) / 2, y + x / 2, -(x + y / 2), zero], 1
    )
    for name, conn in (("CQUAD4", PATCH_QUADS), ("CTRIA3", triangles(PATCH_QUADS))):
        for kind, exact, stresses in (
            ("membrane", membrane, (4000 / 3, 4000 / 3, 400.0)),
            ("bending", bending, (2 / 3, 2 / 3, 0.2)),
        ):
            xyz = np.c_[PATCH, zero]
            bulk = shell_model(xyz, conn, 1e6, 0.25, 1e-3)
            bulk.fix("123456" if kind == "membrane" else "12345", np.arange(4))
            if kind == "membrane":
                bulk.fix("3456", np.arange(4, 8))
            else:
                bulk.fix("126", np.arange(8))
            for grid in range(4):
                for component in np.flatnonzero(exact[grid]):
                    value = float(exact[grid, component])
                    bulk.add("SPCD", 7, grid + 1, component + 1, value)
            results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nDISP = ALL\nSTRESS = ALL"))
            u = results["static/1/displacement"]
            part = slice(0, 2) if kind == "membrane" else slice(2, 5)
            case = f"{kind} patch of {name}"
            error = np.abs(u - exact)[4:, part].max() / np.abs(exact[:, part]).max()
            rows.append(_exact(case, "inner displacements", error))
            table = f"static/1/element_stress/{name}"
            # Invariants: each element prints stresses in its own axes.
            xx, yy, xy = stresses
            mises = np.sqrt(xx * xx - xx * yy + yy * yy + 3.0 * xy * xy)
            for k in (1, 2):
                column = {
                    name: results.column(table, f"{name}_{k}")
                    for name in ("oxx", "oyy", "von_mises")
                }
                total = np.abs(column["oxx"] + column["oyy"]) / (xx + yy) - 1.0
                other = column["von_mises"] / mises - 1.0
                error = np.abs(np.r_[total, other]).max()
                rows.append(_exact(case, f"stresses of fibre {k}", float(error)))
    return rows + solid_patches()


def _exact(case: str, quantity: str, error: float) -> Row:
    return figure(
        case, f"{quantity}: relative error", error, 0.0, "exact", target=1e-10
    )


_INNER = np.array(
    [
        [0.249, 0.342, 0.192], [0.826, 0.288, 0.288], [0.850, 0.649, 0.263],
        [0.273, 0.750, 0.230], [0.320, 0.186, 0.643], [0.677, 0.305, 0.683],
        [0.788, 0.693, 0.644], [0.165, 0.745, 0.702],
    ]
)  # fmt: skip
_OUTER = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
     [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1.0]]
)  # fmt: skip
_BRICKS = np.array(
    [
        [0, 1, 2, 3, 4, 5, 6, 7], [8, 9, 10, 11, 0, 1, 2, 3],
        [4, 5, 6, 7, 12, 13, 14, 15],
        [8, 9, 1, 0, 12, 13, 5, 4], [9, 10, 2, 1, 13, 14, 6, 5],
        [10, 11, 3, 2, 14, 15, 7, 6], [11, 8, 0, 3, 15, 12, 4, 7],
    ]
)  # fmt: skip


def solid_patches() -> list[Row]:
    """Seven distorted bricks, and the same volume in prisms, pyramids, tetrahedra."""
    xyz = np.vstack([_INNER, _OUTER])
    gradient = 1e-3 * (np.eye(3) + 1.0) / 2.0
    rows = []
    for card, nodes, conn in _solid_meshes(xyz):
        bulk = Bulk()
        bulk.add("MAT1", 1, 1e6, "", 0.25)
        bulk.add("PSOLID", 1, 1)
        bulk.grids(nodes)
        bulk.elements(card, 1, conn)
        exact = nodes @ gradient.T
        outside = ((nodes == 0.0) | (nodes == 1.0)).any(axis=1)
        bulk.fix("456", np.arange(len(nodes)))
        bulk.fix("123", outside)
        for grid in np.flatnonzero(outside):
            for component in range(3):
                if exact[grid, component]:
                    value = float(exact[grid, component])
                    bulk.add("SPCD", 7, grid + 1, component + 1, value)
        results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nDISP = ALL\nSTRESS = ALL"))
        u = results["static/1/displacement"][:, :3]
        case = f"solid patch of {card}{conn.shape[1]}"
        error = np.abs(u - exact).max() / np.abs(exact).max()
        rows.append(_exact(case, "inner displacements", float(error)))
        for column, theirs in (("oxx", 2000.0), ("txy", 400.0)):
            values = results.column(f"static/1/element_stress/{card}", column)
            rows.append(_exact(case, column, float(np.abs(values / theirs - 1).max())))
    return rows


def _solid_meshes(xyz: np.ndarray) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Bricks; pyramids about their centers; tetrahedra; prisms; each with mid-sides."""
    faces = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1),
             (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]  # fmt: skip
    apex = len(xyz) + np.arange(len(_BRICKS))
    nodes = np.vstack([xyz, xyz[_BRICKS].mean(axis=1)])
    pyramids = np.concatenate([np.c_[_BRICKS[:, f], apex] for f in faces])
    tetras = []
    for *base, top in pyramids.tolist():
        # Both neighbours of a face cut it along the same diagonal.
        start = base.index(min(base))
        a, b, c, d = base[start:] + base[:start]
        tetras += [[a, b, c, top], [a, c, d, top]]
    small = np.array(tetras)
    flat, prisms = _leaning_prisms()
    quadratic = [
        (card, *with_mid_sides(card, points, conn))
        for card, points, conn in (
            ("CHEXA", xyz, _BRICKS),
            ("CPYRAM", nodes, pyramids),
            ("CTETRA", nodes, small),
            ("CPENTA", flat, prisms),
        )
    ]
    return [
        ("CHEXA", xyz, _BRICKS),
        ("CPYRAM", nodes, pyramids),
        ("CTETRA", nodes, small),
        ("CPENTA", flat, prisms),
        *quadratic,
    ]


def _leaning_prisms() -> tuple[np.ndarray, np.ndarray]:
    """Irregular triangles of the unit square in three layers of unlike height."""
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    inner = np.array([[0.3, 0.2], [0.7, 0.35], [0.65, 0.75], [0.2, 0.6]])
    flat = np.vstack([square, inner])
    tri = triangles(PATCH_QUADS)
    heights = (0.0, 0.2, 0.7, 1.0)
    xyz = np.concatenate([np.c_[flat, np.full(8, h)] for h in heights])
    layers = [np.c_[tri + 8 * k, tri + 8 * k + 8] for k in range(3)]
    return xyz, np.concatenate(layers)
