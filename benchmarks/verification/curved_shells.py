"""CQUAD8 and CTRIA6: patches, standard shells, plates from thick to thin."""

from collections.abc import Callable

import numpy as np

from benchmarks.verification.macneal_harder import SOURCE, X, Y, statics
from benchmarks.verification.mesh import Bulk, rectangle, triangles
from benchmarks.verification.patches import PATCH, PATCH_QUADS
from benchmarks.verification.row import Row, convergence, figure, listed
from benchmarks.verification.runner import run

CARDS = {8: "CQUAD8", 6: "CTRIA6"}


def with_mid_sides(points: np.ndarray, conn: np.ndarray) -> tuple[np.ndarray, ...]:
    """(g, k) points with those half-way along all edges, and elements with them."""
    edges = np.stack([conn, np.roll(conn, -1, axis=1)], axis=2)
    pairs = np.sort(edges, axis=2).reshape(-1, 2)
    unique, which = np.unique(pairs, axis=0, return_inverse=True)
    middles = which.reshape(conn.shape) + len(points)
    return np.vstack([points, points[unique].mean(axis=1)]), np.hstack([conn, middles])


def meshes(points: np.ndarray, conn: np.ndarray) -> list[tuple[np.ndarray, ...]]:
    """The same mesh of CQUAD8 and of CTRIA6."""
    return [with_mid_sides(points, own) for own in (conn, triangles(conn))]


def curved_model(
    xyz: np.ndarray,
    conn: np.ndarray,
    material: tuple[float, float, float],
    thickness: float,
) -> Bulk:
    """Shells of one thickness; E, nu, rho."""
    bulk = Bulk()
    bulk.add("MAT1", 1, material[0], "", *material[1:])
    bulk.add("PSHELL", 1, 1, thickness, 1, "", 1)
    bulk.grids(xyz)
    bulk.elements(CARDS[conn.shape[1]], 1, conn)
    return bulk


def patches_with_mid_sides() -> list[Row]:
    """MacNeal and Harder's mesh of distorted elements: uniform states are exact."""
    rows = []
    for points, conn in meshes(PATCH, PATCH_QUADS):
        x, y = points.T
        zero = 0.0 * x
        rim = (x == 0.0) | (y == 0.0) | (x == 0.24) | (y == 0.12)
        membrane = 1e-3 * np.stack([x + y / 2, y + x / 2, *[zero] * 4], 1)
        deflection = (x * x + x * y + y * y) / 2
        slopes = y + x / 2, -(x + y / 2)
        bending = 1e-3 * np.stack([zero, zero, deflection, *slopes, zero], 1)
        for kind, exact, free, stresses in (
            ("membrane", membrane, "3456", (4000 / 3, 4000 / 3, 400.0)),
            ("bending", bending, "126", (2 / 3, 2 / 3, 0.2)),
        ):
            bulk = curved_model(np.c_[points, zero], conn, (1e6, 0.25, 0.0), 1e-3)
            bulk.fix("123456", rim)
            bulk.fix(free, ~rim)
            for grid, component in np.argwhere((exact != 0.0) & rim[:, None]):
                value = float(exact[grid, component])
                bulk.add("SPCD", 7, grid + 1, component + 1, value)
            results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nDISP = ALL\nSTRESS = ALL"))
            case = f"{kind} patch of {CARDS[conn.shape[1]]}"
            error = np.abs(results["static/1/displacement"] - exact)
            xx, yy, xy = stresses
            theirs = np.sqrt(xx * xx - xx * yy + yy * yy + 3.0 * xy * xy)
            table = f"static/1/element_stress/{CARDS[conn.shape[1]]}"
            ours = results.column(table, "c2_von_mises_2") / theirs - 1.0
            for quantity, value in (
                ("inner displacements", error.max() / np.abs(exact).max()),
                ("von Mises stress at a corner", np.abs(ours).max()),
            ):
                rows.append(
                    figure(case, quantity, float(value), 0.0, "exact", target=1e-9)
                )
    return rows


Mesh = tuple[np.ndarray, np.ndarray]


def _converge(
    case: str,
    quantity: str,
    theirs: float,
    source: str,
    sizes: tuple[int, ...],
    solve: Callable[[Mesh], float],
    target: float = 0.01,
) -> list[Row]:
    rows = []
    for k, card in enumerate(CARDS.values()):
        found = []
        for n in sizes:
            points, conn = meshes(*rectangle(n, n))[k]
            found.append((f"{n} x {n}", solve((points, conn))))
        rows += convergence(
            f"{case} of {card}", quantity, found, theirs, source, target=target
        )
    return rows


def curved_roof() -> list[Row]:
    """A quarter of the roof under its weight."""

    def solve(mesh: Mesh) -> float:
        points, conn = mesh
        x, y = points.T
        angle = np.radians(40.0) * y
        xyz = np.c_[25.0 * x, 25.0 * np.sin(angle), 25.0 * np.cos(angle)]
        bulk = curved_model(xyz, conn, (4.32e8, 0.0, 360.0), 0.25)
        bulk.fix("23", x == 0)
        bulk.fix("156", x == 1)
        bulk.fix("246", y == 0)
        bulk.add("GRAV", 7, "", 1.0, 0.0, 0.0, -1.0)
        edge = int(np.flatnonzero((x == 1) & (y == 1))[0])
        return float(-statics(bulk)[edge, 2])

    case = "Scordelis-Lo roof"
    return _converge(
        case, "edge deflection", 0.3024, SOURCE, (1, 2, 4, 8), solve, 0.016
    )


def curved_hemisphere() -> list[Row]:
    """A quarter of the half sphere with an 18 degree hole, radial loads."""

    def solve(mesh: Mesh) -> float:
        points, conn = mesh
        x, y = points.T
        turn, up = 0.5 * np.pi * x, np.radians(72.0) * y
        flat = np.cos(up)
        xyz = 10.0 * np.c_[flat * np.cos(turn), flat * np.sin(turn), np.sin(up)]
        xyz[np.abs(xyz) < 1e-12] = 0.0
        bulk = curved_model(xyz, conn, (6.825e7, 0.3, 0.0), 0.04)
        bulk.fix("246", x == 0)
        bulk.fix("156", x == 1)
        first = int(np.flatnonzero((x == 0) & (y == 0))[0])
        second = int(np.flatnonzero((x == 1) & (y == 0))[0])
        bulk.fix("3", first)
        bulk.forces(7, first, X, 1.0)
        bulk.forces(7, second, -Y, 1.0)
        return float(statics(bulk)[first, 0])

    case, quantity = "hemisphere", "radial displacement"
    return _converge(case, quantity, 0.094, SOURCE, (2, 4, 8, 16, 32), solve, 0.012)


def supported_quarter(mesh: Mesh, thickness: float) -> Bulk:
    """A quarter of a supported square plate 2 x 2 under pressure 1, E 1e7, nu 0.3."""
    points, conn = mesh
    x, y = points.T
    bulk = curved_model(np.c_[points, 0.0 * x], conn, (1e7, 0.3, 0.0), thickness)
    bulk.fix("126", np.full(len(x), True))
    bulk.fix("5", x == 0)
    bulk.fix("4", y == 0)
    bulk.fix("34", x == 1)
    bulk.fix("35", y == 1)
    bulk.add("PLOAD4", 7, 1, 1.0, "", "", "", "THRU", len(conn))
    return bulk


def plates_of_any_thickness() -> list[Row]:
    """A quarter of a supported square plate under pressure, thick to very thin.

    Navier's series of Kirchhoff's plate, and what shear adds to it: under hard support
    of a polygon the moment sum is that of Kirchhoff, so that w = w_K + M / (k G t).
    """
    rows = []
    for thickness in (0.2, 0.02, 2e-3, 2e-4):
        theirs = 1e3 * thickness**3 * mindlin_deflection(thickness)

        def solve(mesh: Mesh, t: float = thickness) -> float:
            return float(1e3 * t**3 * statics(supported_quarter(mesh, t))[0, 2])

        case = f"supported plate, thickness/side {thickness / 2:g},"
        quantity, source = "1e3 t^3 w of the center", "Navier, Mindlin"
        rows += _converge(case, quantity, theirs, source, (2, 4, 8), solve, 0.004)
    return rows


# Shear forces of thin triangles alternate, as MSC Nastran's do.
_SHEAR = {
    **{("CQUAD8", 0.2): 0.02, ("CQUAD8", 2e-4): 0.02},
    **{("CTRIA6", 0.2): 0.02, ("CTRIA6", 2e-4): None},
}


def shear_forces() -> list[Row]:
    """Transverse shear forces of the same plate, against those of the series."""
    rows = []
    for thickness in (0.2, 2e-4):
        case = f"supported plate, thickness/side {thickness / 2:g},"
        quantity, source = "rms error of Q at centers over its peak", "Navier"
        for k, card in enumerate(CARDS.values()):
            for n in (2, 4, 8):
                mesh = meshes(*rectangle(n, n))[k]
                value = shear_error(mesh, thickness)
                target = _SHEAR[card, thickness] if n == 8 else None
                name = f"{case} {card}"
                own = {"mesh": f"{n} x {n}", "target": target}
                rows.append(figure(name, quantity, value, 0.0, source, **own))
    return rows


def shear_error(mesh: Mesh, thickness: float) -> float:
    """Root mean square of the error of Q at the centers over the largest Q there."""
    points, conn = mesh
    bulk = supported_quarter(mesh, thickness)
    results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nFORCE = ALL"))
    table = f"static/1/element_force/{CARDS[conn.shape[1]]}"
    own = np.stack([results.column(table, name) for name in ("tx", "ty")], axis=1)
    corners = points[conn[:, : conn.shape[1] // 2]]
    x = corners[:, 1] - corners[:, 0]
    x /= np.linalg.norm(x, axis=1)[:, None]
    if conn.shape[1] == 8:
        x = np.tile([1.0, 0.0], (len(conn), 1))  # rectangles
    ours = own[:, :1] * x + own[:, 1:] * np.stack([-x[:, 1], x[:, 0]], axis=1)
    theirs = shear_of_series(corners.mean(axis=1))
    worst = np.sqrt(((ours - theirs) ** 2).sum(axis=1).mean())
    return float(worst / np.abs(theirs).max())


def shear_of_series(at: np.ndarray) -> np.ndarray:
    """(n, 2) transverse shear forces at points of the plate, M,x + M,y."""
    m = np.arange(1, 120, 2)
    first, second = (0.5 * np.pi * k for k in np.meshgrid(m, m))
    load = 4.0 / (first * second) * np.sin(first) * np.sin(second)
    size = load / (first**2 + second**2)
    (sx, cx), (sy, cy) = (
        (np.sin(wave * p[:, None, None]), np.cos(wave * p[:, None, None]))
        for wave, p in zip((first, second), at.T)
    )
    forces = -size * first * sx * cy, -size * second * cx * sy
    return np.stack([own.sum(axis=(1, 2)) for own in forces], axis=1)


def mindlin_deflection(t: float) -> float:
    """Center of a supported plate 2 x 2, E 1e7, nu .3, pressure 1, by double series."""
    m = np.arange(1, 200, 2)
    first, second = np.meshgrid(m, m)
    wave = (np.pi / 2.0) ** 2 * (first**2 + second**2)
    load = 16.0 / (np.pi**2 * first * second)
    load *= np.sin(0.5 * np.pi * first) * np.sin(0.5 * np.pi * second)
    bending = 1e7 * t**3 / 12.0 / (1.0 - 0.09)
    shear = 0.833333 * 1e7 / 2.6 * t
    return float(np.sum(load / (bending * wave**2) + load / (shear * wave)))


def pressurised_cylinder() -> list[Row]:
    """An eighth of a long cylinder under inner pressure: membrane stress p R / t."""
    rows = []
    for points, conn in meshes(*rectangle(6, 2)):
        x, y = points.T
        angle = 0.5 * np.pi * x
        xyz = np.c_[np.cos(angle), np.sin(angle), y]
        bulk = curved_model(xyz, conn, (7e10, 0.3, 0.0), 0.01)
        bulk.fix("246", x == 0)
        bulk.fix("156", x == 1)
        bulk.fix("345", y == 0)
        bulk.fix("45", y == 1)
        bulk.add("PLOAD2", 7, 1e6, 1, "THRU", len(conn))
        results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nDISP = ALL\nSTRESS = ALL"))
        card = CARDS[conn.shape[1]]
        u = results["static/1/displacement"]
        radial = np.einsum("gi,gi->g", u[:, :2], xyz[:, :2])
        ours = {
            "radial displacement": (radial.mean(), 1e6 / (7e10 * 0.01)),
            # Strain of the inner fibre: w over its own radius.
            "mean hoop stress of the inner fibre": (
                results.column(f"static/1/element_stress/{card}", "major_1").mean(),
                1e6 / 0.01 / (1.0 - 0.005),
            ),
        }
        for quantity, (value, theirs) in ours.items():
            rows.append(
                figure(
                    f"pressurised cylinder of {card}",
                    quantity,
                    float(abs(value)),
                    theirs,
                    "p R² / (E t), p R / t",
                    target=0.002,
                )
            )
    return rows


def single_elements() -> list[Row]:
    """One element each, clamped along a side, beside Nastran's own."""
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    cases = (
        (square, 1.0, 120.0, (2, 6, 3), {2: 4.28522, 6: 3.572958, 5: 2.13403}, 1e-6),
        (square[[0, 1, 3]], 0.1, 1000.0, (2,), {2: 54.224995, 4: 17.653503}, 1e-6),
    )
    rows = []
    for corners, t, ratio, loaded, theirs, target in cases:
        points, conn = with_mid_sides(corners, np.arange(len(corners))[None])
        # The edges are numbered by their ends; on these shapes as the card wants them.
        order = conn[0]
        x = points[order, 0]
        bulk = Bulk()
        bulk.add("MAT1", 1, 1.0, 0.8, 0.1)
        bulk.add("PSHELL", 1, 1, t, 1, ratio, 1, 1.0)
        bulk.grids(np.c_[points[order], 0.0 * x])
        bulk.elements(CARDS[len(x)], 1, np.arange(len(x))[None])
        bulk.fix("123456", x == 0.0)
        bulk.fix("126", x > 0.0)
        bulk.fix("5" if len(x) == 8 else "4", np.array(loaded[:1] + loaded[2:]) - 1)
        for grid in loaded:
            bulk.forces(7, grid - 1, np.array([0.0, 0.0, 1.0]), 1.0)
        u = statics(bulk)
        for grid, value in theirs.items():
            rows.append(
                figure(
                    f"one {CARDS[len(x)]}, clamped along a side",
                    f"deflection of its grid {grid}",
                    float(u[grid - 1, 2]),
                    value,
                    "OP2 file cqra00366 of Nastran",
                    target=target,
                )
            )
    return rows


# Squares in two elements, clamped along two sides: grids, elements, the grid that is
# loaded, the one whose motion is printed, its T1, T3, R1 and R2.
_PAIRS = {
    "two CQUAD8": (
        [(0.5 * (i % 3), 0.25 * (i // 3)) for i in range(15) if i not in (4, 10)],
        ["CQUAD8,1,1,1,3,8,6,2,5,+", "+,7,4", "CQUAD8,2,1,6,8,13,11,7,10,+", "+,12,9"],
        (13, 13),
        (1.893425178e-5, 5.007095635e-3, 7.153703831e-3, -6.745425519e-3),
    ),
    "two CQUAD8, one mid-side": (
        [(0, 0), (1, 0), (0, 0.5), (0.5, 0.5), (1, 0.5), (0, 1), (1, 1)],
        ["CQUAD8,1,1,1,2,5,3,,,+", "+,4", "CQUAD8,2,1,3,5,7,6,4"],
        (7, 4),
        (1.614769985e-6, 2.921663981e-4, 5.122789880e-4, -7.979067159e-4),
    ),
    "two CTRIA6": (
        [(0.5 * (i % 3), 0.5 * (i // 3)) for i in range(9)],
        ["CTRIA6,1,1,1,3,9,2,6,5", "CTRIA6,2,1,9,7,1,8,4,5"],
        (9, 9),
        (1.427050938e-5, 4.732870031e-3, 5.648746155e-3, -5.648746155e-3),
    ),
    "two CTRIA6, no mid-sides": (
        [(0, 0), (1, 0), (0, 1), (1, 1)],
        ["CTRIA6,1,1,1,2,4", "CTRIA6,2,1,4,3,1"],
        (4, 4),
        (5.454545317e-6, 2.835560590e-3, 3.689931473e-3, -3.689931473e-3),
    ),
}


def pairs_without_shear_flexibility() -> list[Row]:
    """Two elements each with MID3 blank, as MSC has them (undamped: 0 Hz, GE 0.03333).

    None of these results was used to find the elements' formulas, but of the first the
    forces and moments were for the residual flexibility.
    """
    rows = []
    for name, (points, cards, (loaded, printed), theirs) in _PAIRS.items():
        xyz = np.c_[np.array(points, float), np.zeros(len(points))]
        bulk = Bulk()
        bulk.add("MAT1", 1, 1e7, 4e6, 0.25)
        bulk.add("PSHELL", 1, 1, 0.05, 1)
        bulk.grids(xyz)
        bulk.lines += cards
        held = (xyz[:, 0] == 0.0) | (xyz[:, 1] == 0.0)
        bulk.fix("123456", held)
        bulk.fix("6", ~held)
        bulk.forces(7, loaded - 1, np.array([1.0, 0.0, 1.0]), 2.0)
        ours = statics(bulk)[printed - 1, [0, 2, 3, 4]]
        quantity = f"T1, T3, R1, R2 of grid {printed}"
        source = "MSC Nastran, file of pyNastran's deck api3"
        rows.append(listed(name, quantity, ours, theirs, source, target=1e-6))
    return rows
