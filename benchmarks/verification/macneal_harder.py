"""MacNeal and Harder's standard problems (1985), as generated decks, refined."""

from collections.abc import Callable

import numpy as np

from benchmarks.verification.mesh import (
    Bulk,
    box,
    edge_shares,
    rectangle,
    triangles,
)
from benchmarks.verification.plate_theory import ritz_deflection
from benchmarks.verification.row import SURFACES, Row, convergence, figure
from benchmarks.verification.runner import run

SOURCE = "MacNeal & Harder 1985"
X, Y, Z = np.eye(3)


def shell_model(
    xyz: np.ndarray,
    conn: np.ndarray,
    young: float,
    nu: float,
    thickness: float,
    density: float = 0.0,
) -> Bulk:
    """Shells of one thickness; drilling freedoms without stiffness go to AUTOSPC."""
    bulk = Bulk()
    bulk.add("MAT1", 1, young, "", nu, density)
    bulk.add("PSHELL", 1, 1, thickness, 1, "", 1)
    bulk.grids(xyz)
    bulk.elements("CQUAD4" if conn.shape[1] == 4 else "CTRIA3", 1, conn)
    return bulk


def statics(bulk: Bulk, load: int = 7) -> np.ndarray:
    """(g, 6) displacements under load set 7."""
    return run(bulk.deck(101, f"SPC = 1\nLOAD = {load}\nDISP = ALL"))[
        "static/1/displacement"
    ]


def _tip_means(make: Callable[[], Bulk], tip: np.ndarray, loads: list) -> list[float]:
    """Mean displacements of a loaded edge along unit loads (card, direction, row)."""
    found = []
    for card, direction, component in loads:
        bulk = make()
        bulk.forces(7, tip, direction, edge_shares(len(tip)), card=card)
        found.append(float(edge_shares(len(tip)) @ statics(bulk)[tip, component]))
    return found


# -- beams of shells ------------------------------------------------------------------


def straight_beam() -> list[Row]:
    """6 x 0.2 x 0.1: rectangles, trapezoids, parallelograms; extension to twist.

    Twist: Saint-Venant's .03411 for this section (J = .2287 w t³). The published .03208
    is not what its own formula gives.
    """
    torsion = 0.2287 * 0.2 * 0.1**3
    references = (
        ("extension", ("FORCE", X, 0), 3.0e-5, SOURCE),
        ("in-plane shear", ("FORCE", Y, 1), 0.1081, SOURCE),
        ("out-of-plane shear", ("FORCE", Z, 2), 0.4321, SOURCE),
        ("twist", ("MOMENT", X, 3), 6.0 / (1e7 / 2.6 * torsion), "Saint-Venant"),
    )
    rows = []
    for kind in ("rectangles", "trapezoids", "parallelograms"):
        found: dict[str, list[tuple[str, float]]] = {r[0]: [] for r in references}
        for nx, ny in ((6, 1), (12, 2), (48, 4), (192, 16)):

            def make(nx: int = nx, ny: int = ny, kind: str = kind) -> Bulk:
                return _straight(kind, nx, ny)

            tip = np.arange(nx * (ny + 1), (nx + 1) * (ny + 1))
            values = _tip_means(make, tip, [r[1] for r in references])
            for (name, *_), value in zip(references, values):
                found[name].append((f"{nx} x {ny}", value))
        for name, _, theirs, source in references:
            case = f"straight beam, {kind}"
            rows += convergence(case, name, found[name], theirs, source)
    return rows


def _straight(kind: str, nx: int, ny: int) -> Bulk:
    """The six shapes of the coarse mesh, each cut into smaller ones of its kind."""
    sign = {"rectangles": np.zeros(5), "parallelograms": np.ones(5)}.get(
        kind, (-1.0) ** np.arange(1, 6)
    )
    shift = 0.1 * np.r_[0.0, sign, 0.0]
    cuts = np.linspace(0.0, 6.0, nx + 1)
    lower, upper = (
        np.interp(cuts, np.arange(7), np.arange(7) + k * shift) for k in (-1, 1)
    )
    height = np.linspace(0.0, 1.0, ny + 1)
    x = lower[:, None] * (1.0 - height) + upper[:, None] * height
    y = np.broadcast_to(0.2 * height, x.shape)
    _, conn = rectangle(nx, ny)
    bulk = shell_model(
        np.c_[x.ravel(), y.ravel(), np.zeros(x.size)], conn, 1e7, 0.3, 0.1
    )
    bulk.fix("123456", np.arange(ny + 1))
    return bulk


def curved_beam() -> list[Row]:
    """A quarter of a circle, radius 4.12 to 4.32, thickness 0.1."""
    found: dict[int, list[tuple[str, float]]] = {0: [], 1: []}
    for nx, ny in ((6, 1), (12, 2), (48, 4), (96, 8)):

        def make(nx: int = nx, ny: int = ny) -> Bulk:
            points, conn = rectangle(nx, ny)
            r, angle = 4.12 + 0.2 * points[:, 1], 0.5 * np.pi * (1.0 - points[:, 0])
            xyz = np.c_[r * np.cos(angle), r * np.sin(angle), 0.0 * r]
            bulk = shell_model(xyz, conn, 1e7, 0.25, 0.1)
            bulk.fix("123456", np.arange(ny + 1))
            return bulk

        tip = np.arange(nx * (ny + 1), (nx + 1) * (ny + 1))
        # The tip is at angle 0: x is radial there.
        values = _tip_means(make, tip, [("FORCE", X, 0), ("FORCE", Z, 2)])
        for k, value in enumerate(values):
            found[k].append((f"{nx} x {ny}", value))
    rows = convergence(
        "curved beam", "in-plane shear", found[0], 0.08734, SOURCE, target=0.02
    )
    rows += convergence(
        "curved beam",
        "in-plane shear (accurate)",
        found[0],
        curved_in_plane(),
        "plane elasticity, Airy's function",
    )
    rows += convergence("curved beam", "out-of-plane shear", found[1], 0.5022, SOURCE)
    for k, (name, theirs) in enumerate(
        (("in-plane", 0.952 * 0.08734), ("out-of-plane", 0.955 * 0.5022))
    ):
        rows.append(
            figure(
                "curved beam",
                f"{name}, 6 x 1",
                found[k][0][1],
                theirs,
                "OptiStruct CQUAD4 (OS-V 0710)",
                target=None,
            )
        )
    return rows


def curved_in_plane() -> float:
    """Radial tip deflection of a quarter ring under a unit radial force.

    Timoshenko and Goodier, Theory of Elasticity, bending of a curved bar by a force at
    its end: π (a² + b²) / (E t [(a² - b²) + (a² + b²) ln(b/a)]).
    """
    a2, b2 = 4.12**2, 4.32**2
    shape = (a2 - b2) + (a2 + b2) * np.log(4.32 / 4.12)
    return float(np.pi * (a2 + b2) / (1e7 * 0.1 * shape))


def twisted_beam() -> list[Row]:
    """12 x 1.1 x 0.32, twisted by 90 degrees from end to end."""
    references = (("in-plane shear", Z, 2, 0.005424), ("out-of-plane", Y, 1, 0.001754))
    found: dict[str, list[tuple[str, float]]] = {r[0]: [] for r in references}
    for n in (1, 2, 4):
        nx, ny = 12 * n, 2 * n

        def make(nx: int = nx, ny: int = ny) -> Bulk:
            points, conn = rectangle(nx, ny)
            angle, across = 0.5 * np.pi * points[:, 0], 1.1 * (points[:, 1] - 0.5)
            xyz = np.c_[
                12 * points[:, 0], across * np.cos(angle), across * np.sin(angle)
            ]
            bulk = shell_model(xyz, conn, 29e6, 0.22, 0.32)
            bulk.fix("123456", np.arange(ny + 1))
            return bulk

        tip = np.arange(nx * (ny + 1), (nx + 1) * (ny + 1))
        loads = [("FORCE", direction, k) for _, direction, k, _ in references]
        for (name, *_), value in zip(references, _tip_means(make, tip, loads)):
            found[name].append((f"{nx} x {ny}", value))
    rows = []
    for (name, _, _, theirs), ratio in zip(references, (0.992, 0.988)):
        rows += convergence("twisted beam", name, found[name], theirs, SOURCE)
        rows.append(
            figure(
                "twisted beam",
                f"{name}, 12 x 2",
                found[name][0][1],
                ratio * theirs,
                "OptiStruct CQUAD4 (OS-V 0700)",
                target=SURFACES,
            )
        )
    return rows


# -- shells and plates ----------------------------------------------------------------


def scordelis_lo() -> list[Row]:
    """A quarter of the roof under its weight; and OptiStruct's figures mesh by mesh."""
    ratios = {2: 1.487, 4: 1.082, 6: 1.035, 8: 1.020, 10: 1.013}
    found = []
    for n in (2, 4, 6, 8, 10, 16, 32):
        points, conn = rectangle(n, n)
        angle = np.radians(40.0) * points[:, 1]
        xyz = np.c_[25.0 * points[:, 0], 25.0 * np.sin(angle), 25.0 * np.cos(angle)]
        bulk = shell_model(xyz, conn, 4.32e8, 0.0, 0.25, density=360.0)
        x, y = points.T
        bulk.fix("23", x == 0)
        bulk.fix("156", x == 1)
        bulk.fix("246", y == 0)
        bulk.add("GRAV", 7, "", 1.0, 0.0, 0.0, -1.0)
        edge = int(np.flatnonzero((x == 1) & (y == 1))[0])
        found.append((f"{n} x {n}", -statics(bulk)[edge, 2]))
    case = "Scordelis-Lo roof"
    rows = convergence(case, "edge deflection", found, 0.3024, SOURCE)
    for (mesh, value), (n, ratio) in zip(found, ratios.items()):
        rows.append(
            figure(
                case,
                f"edge deflection, {mesh}",
                value,
                0.3024 * ratio,
                "OptiStruct CQUAD4",
                # On coarse meshes elements differ.
                target=SURFACES if n >= 8 else None,
            )
        )
    return rows


def hemisphere() -> list[Row]:
    """A quarter of the half sphere with an 18 degree hole, radial loads."""
    rows = []
    for card in ("CQUAD4", "CTRIA3"):
        found = []
        for n in (4, 8, 16, 32):
            points, conn = rectangle(n, n)
            conn = conn if card == "CQUAD4" else triangles(conn)
            turn, up = 0.5 * np.pi * points[:, 0], np.radians(72.0) * points[:, 1]
            flat = np.cos(up)
            xyz = 10.0 * np.c_[flat * np.cos(turn), flat * np.sin(turn), np.sin(up)]
            xyz[np.abs(xyz) < 1e-12] = 0.0
            bulk = shell_model(xyz, conn, 6.825e7, 0.3, 0.04)
            x, y = points.T
            bulk.fix("246", x == 0)
            bulk.fix("156", x == 1)
            first = int(np.flatnonzero((x == 0) & (y == 0))[0])
            second = int(np.flatnonzero((x == 1) & (y == 0))[0])
            bulk.fix("3", first)
            bulk.forces(7, first, X, 1.0)
            bulk.forces(7, second, -Y, 1.0)
            found.append((f"{n} x {n}", statics(bulk)[first, 0]))
        rows += convergence(
            f"hemisphere of {card}", "radial displacement", found, 0.094, SOURCE
        )
    return rows


def rectangular_plates() -> list[Row]:
    """A quarter of a plate 2 x 2 and 2 x 10, 1e-4 thick: no locking.

    The published 2.56 of the long clamped plate under pressure contradicts the strip
    (1/384 = 2.604): Ritz with many terms stands beside it.
    """
    cases = {
        (False, False, 2): 4.062, (False, False, 10): 12.97,
        (False, True, 2): 11.60, (False, True, 10): 16.96,
        (True, False, 2): 1.26, (True, False, 10): 2.56,
        (True, True, 2): 5.60, (True, True, 10): 7.23,
    }  # fmt: skip
    rows = []
    for (clamped, point, b), theirs in cases.items():
        found = [
            (f"{n} x {n * k}", _plate_center(n, n * k, b, clamped=clamped, point=point))
            for n, k in ((2, 1), (4, 1), (8, 1), (16, 1), (32, b // 2))
        ]
        case = f"rectangular plate, b/a = {b // 2}"
        quantity = ("clamped" if clamped else "supported") + ", "
        quantity += "force" if point else "pressure"
        exact = 1000.0 * ritz_deflection(2.0, float(b), 0.3)
        coarse = clamped and not point
        target = 0.02 if coarse else SURFACES
        rows += convergence(case, quantity, found, theirs, SOURCE, target=target)
        if coarse:
            source = "Kirchhoff, Ritz with 14 x 14 terms"
            rows += convergence(
                case, f"{quantity} (accurate)", found, exact, source, target=SURFACES
            )
    return rows


def _plate_center(nx: int, ny: int, b: float, *, clamped: bool, point: bool) -> float:
    points, conn = rectangle(nx, ny)
    xyz = np.c_[points * [1.0, 0.5 * b], np.zeros(len(points))]
    bulk = shell_model(xyz, conn, 1.7472e7, 0.3, 1e-4)
    x, y = points.T
    bulk.fix("126", np.arange(len(points)))
    bulk.fix("5", x == 0)
    bulk.fix("4", y == 0)
    if clamped:
        bulk.fix("345", (x == 1) | (y == 1))
    else:
        bulk.fix("34", x == 1)
        bulk.fix("35", y == 1)
    if point:
        bulk.forces(7, 0, Z, 1e-4)
    else:
        bulk.add("PLOAD2", 7, 1e-4, 1, "THRU", nx * ny)
    return float(statics(bulk)[0, 2])


def thick_cylinder() -> list[Row]:
    """Nearly incompressible, inner pressure, plane strain: one row of bricks."""
    rows = []
    for nu, theirs in ((0.49, 5.0399e-3), (0.499, 5.0602e-3), (0.4999, 5.0623e-3)):
        found = []
        for n, radii in (
            (5, [3.0, 3.5, 4.2, 5.2, 6.75, 9.0]),
            (20, np.geomspace(3.0, 9.0, 21)),
        ):
            points, bricks = box(n, 9, 1)
            r = np.asarray(radii)[np.rint(points[:, 0] * n).astype(int)]
            angle = 0.5 * np.pi * points[:, 1]
            xyz = np.c_[r * np.cos(angle), r * np.sin(angle), points[:, 2]]
            xyz[np.abs(xyz) < 1e-12] = 0.0
            bulk = Bulk()
            bulk.add("MAT1", 1, 1000.0, "", nu)
            bulk.add("PSOLID", 1, 1)
            bulk.grids(xyz)
            bulk.elements("CHEXA", 1, bricks)
            every = np.arange(len(xyz))
            bulk.fix("3456", every)
            bulk.fix("2", points[:, 1] == 0)
            bulk.fix("1", points[:, 1] == 1)
            inner = np.flatnonzero(points[:, 0] == 0)
            share = 3.0 * 0.5 * np.pi / 9 * 0.5 * np.ones(len(inner))
            ends = (points[inner, 1] == 0) | (points[inner, 1] == 1)
            share[ends] *= 0.5
            for grid, value in zip(inner, share):
                direction = np.r_[xyz[grid, :2] / 3.0, 0.0]
                bulk.forces(7, grid, direction, value)
            u = statics(bulk)[inner]
            radial = np.einsum("gi,gi->g", u[:, :2], xyz[inner, :2]) / 3.0
            found.append((f"{n} x 9", float(radial.mean())))
        rows += convergence(
            "thick cylinder of bricks", f"radial, nu = {nu}", found, theirs, SOURCE
        )
    return rows
