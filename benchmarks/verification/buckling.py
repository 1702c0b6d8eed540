"""Linear buckling: columns, frames, beams sideways, plates, a stiffened panel.

References: S. P. Timoshenko and J. M. Gere, Theory of Elastic Stability, 1961, and
Rayleigh-Ritz solutions of Kirchhoff's plate in polynomials (`plate_theory`), where the
book gives coefficients to two digits only.
"""

import numpy as np

from benchmarks.verification.mesh import Bulk, box, rectangle, triangles, with_mid_sides
from benchmarks.verification.plate_theory import ritz_buckling
from benchmarks.verification.row import LINES, Row, convergence, figure
from benchmarks.verification.runner import run

_YOUNG, _NU = 7e10, 0.3
_SHEAR = _YOUNG / (2.0 * (1.0 + _NU))
_LENGTH, _A, _I1, _I2, _J = 2.0, 4e-3, 5e-7, 8e-7, 3e-7
_CASE = "SPC = 1\nSUBCASE 1\n  LOAD = 7\nSUBCASE 2\n  METHOD = 1\n"
_BOOK = "Timoshenko and Gere"


def factors(bulk: Bulk, *, count: int = 4) -> np.ndarray:
    """Positive load factors of load set 7 under constraint set 1, ascending."""
    bulk.add("EIGRL", 1, 0.0, "", count)
    return run(bulk.deck(105, _CASE))["buckling/2/factor"]


def _line(
    elements: int,
    card: str = "CBAR",
    *,
    k: float = 0.0,
    length: float = _LENGTH,
    depth: float = 1.0,
) -> Bulk:
    """A beam along x with I1 times depth in x-y; shear factor k, 0 for none."""
    bulk = Bulk()
    bulk.add("MAT1", 1, _YOUNG, "", _NU)
    if card == "CBAR":
        bulk.add("PBAR", 1, 1, _A, depth * _I1, _I2, _J)
        bulk.lines += ["+", f"+,{k},{k}"] if k else []
    else:
        bulk.add("PBEAM", 1, 1, _A, depth * _I1, _I2, 0.0, _J)
        bulk.lines += ["+,,,,,,,,", f"+,{k},{k}"]
    x = np.linspace(0.0, length, elements + 1)
    bulk.grids(np.c_[x, np.zeros((elements + 1, 2))])
    ends = np.c_[np.arange(elements), np.arange(1, elements + 1)]
    bulk.elements(card, 1, ends, 0.0, 1.0, 0.0)
    return bulk


def _held(bulk: Bulk, ends: str, last: int) -> None:
    """Ends of a column in x-y: fixed, pinned, free; out of plane nothing moves."""
    bulk.fix("345", np.arange(last + 1))
    left, right = ends.split("-")
    bulk.fix({"fixed": "126", "pinned": "12"}[left], [0])
    free = {"fixed": "26", "pinned": "2", "guided": "6", "free": ""}[right]
    if free:
        bulk.fix(free, [last])


# Ends and effective lengths of columns.
_COLUMNS = {
    "fixed-free": 2.0,
    "pinned-pinned": 1.0,
    "fixed-pinned": 1.0 / 1.43029665,  # tan kl = kl
    "fixed-fixed": 0.5,
    "fixed-guided": 1.0,
}


def euler_columns() -> list[Row]:
    """Columns under all end conditions, ten elements."""
    rows, n = [], 10
    for card in ("CBAR", "CBEAM"):
        for ends, share in _COLUMNS.items():
            bulk = _line(n, card)
            _held(bulk, ends, n)
            bulk.forces(7, [n], (-1.0, 0.0, 0.0), [1.0])
            exact = np.pi**2 * _YOUNG * _I1 / (share * _LENGTH) ** 2
            found = factors(bulk)[0]
            name = f"Euler column {ends}, {card}"
            rows.append(
                figure(name, "load, N", found, exact, _BOOK, target=3e-4, mesh="10")
            )
    for card in ("CBAR", "CBEAM"):
        bulk, k = _line(n, card, k=0.4, length=0.2), 0.4
        _held(bulk, "fixed-free", n)
        bulk.forces(7, [n], (-1.0, 0.0, 0.0), [1.0])
        euler = np.pi**2 * _YOUNG * _I1 / (2.0 * 0.2) ** 2
        exact = euler / (1.0 + euler / (k * _A * _SHEAR))
        rows.append(
            figure(
                f"short column with shear, fixed-free, {card}",
                "load, N",
                factors(bulk)[0],
                exact,
                "Engesser: Timoshenko and Gere 2.17",
                target=3e-4,
                mesh="10",
            )
        )
    return rows


def beams_sideways() -> list[Row]:
    """Torsional and lateral buckling of beams; a portal frame that sways."""
    rows, n = [], 20
    sideways = np.sqrt(_YOUNG * _I2 * _SHEAR * _J)
    # Plane 1 is x-y with I1; made stiff, it bends first and buckles across (I2).
    for name, moment, exact in (
        ("beam under equal end moments, forks", True, np.pi * sideways / _LENGTH),
        ("cantilever under a tip force", False, 4.01260 * sideways / _LENGTH**2),
    ):
        bulk = _line(n, depth=1e4)
        if moment:
            bulk.fix("1234", [0])
            bulk.fix("234", [n])
            bulk.forces(7, [0], (0.0, 0.0, 1.0), [-1.0], card="MOMENT")
            bulk.forces(7, [n], (0.0, 0.0, 1.0), [1.0], card="MOMENT")
        else:
            bulk.fix("123456", [0])
            bulk.forces(7, [n], (0.0, -1.0, 0.0), [1.0])
        rows.append(
            figure(
                name,
                "load",
                factors(bulk)[0],
                exact,
                f"{_BOOK} 6.2, 6.3",
                target=2e-3,
                mesh=str(n),
            )
        )
    bulk = _line(n)
    bulk.fix("1234", [0])
    bulk.fix("234", [n])
    bulk.fix("56", np.arange(n + 1))
    bulk.fix("23", np.arange(n + 1))
    bulk.forces(7, [n], (-1.0, 0.0, 0.0), [1.0])
    exact = _SHEAR * _J * _A / (_I1 + _I2)
    rows.append(
        figure(
            "column that twists (no warping)",
            "load, N",
            factors(bulk)[0],
            exact,
            f"{_BOOK} 5.5",
            target=LINES,
            mesh=str(n),
        )
    )
    rows.append(_portal())
    return rows


def _portal() -> Row:
    """A square frame with hinged feet under forces on its columns: it sways."""
    n, side = 10, 1.0
    bulk = Bulk()
    bulk.add("MAT1", 1, _YOUNG, "", _NU)
    bulk.add("PBAR", 1, 1, 4e2 * _A, _I1, _I2, _J)
    t = np.linspace(0.0, side, n + 1)
    path = np.concatenate(
        [
            np.c_[0.0 * t, t],
            np.c_[t[1:], side + 0.0 * t[1:]],
            np.c_[side + 0.0 * t[1:], side - t[1:]],
        ]
    )
    count = len(path)
    bulk.grids(np.c_[path, np.zeros(count)])
    ends = np.c_[np.arange(count - 1), np.arange(1, count)]
    for a, b in ends:
        dx, dy = np.sign(np.round(path[b] - path[a], 9))  # plane 1 is that of x-y
        bulk.elements("CBAR", 1, np.array([[a, b]]), float(-dy), float(dx), 0.0)
    bulk.fix("345", np.arange(count))
    bulk.fix("12", [0, count - 1])
    bulk.forces(7, [n, 2 * n], (0.0, -1.0, 0.0), [1.0, 1.0])
    # k l tan(k l) = 6 for equal sides and stiffness.
    kl = 1.34955
    exact = kl**2 * _YOUNG * _I1 / side**2
    return figure(
        "square frame with hinged feet, sway",
        "load of a column, N",
        factors(bulk)[0],
        exact,
        f"{_BOOK} 2.9: kl tan kl = 6",
        target=1e-3,
        mesh=str(n),
    )


# -- plates --------------------------------------------------------------------------

_THICKNESS, _WIDTH = 2e-3, 0.4
_RIGIDITY = _YOUNG * _THICKNESS**3 / (12.0 * (1.0 - _NU**2))
_UNIT = np.pi**2 * _RIGIDITY / _WIDTH**2


def plate(card: str, aspect: float, n: int, forces: tuple[float, float, float]) -> Bulk:
    """A simply supported plate under N xx yy xy (compression, shear), N/m.

    Args:
        card: element.
        aspect: length over width.
        n: elements over the width.
        forces: along x and y, shear.
    """
    nx = max(2, round(n * aspect))
    xy, conn = rectangle(nx, n)
    xyz = np.c_[aspect * _WIDTH * xy[:, 0], _WIDTH * xy[:, 1], np.zeros(len(xy))]
    if card in ("CTRIA3", "CTRIAR", "CTRIA6"):
        conn = triangles(conn)
    if card in ("CQUAD8", "CTRIA6"):
        xyz, conn = _mid_sides(xyz, conn)
    bulk = Bulk("PARAM,K6ROT,1.\n")
    bulk.add("MAT1", 1, _YOUNG, "", _NU)
    bulk.add("PSHELL", 1, 1, _THICKNESS, 1, "", 1)
    bulk.grids(xyz)
    bulk.elements(card, 1, conn)
    x, y = xyz[:, 0], xyz[:, 1]
    left, low = np.isclose(x, 0.0), np.isclose(y, 0.0)
    right, top = np.isclose(x, x.max()), np.isclose(y, y.max())
    bulk.fix("3", left | right | low | top)
    bulk.fix("4", left | right)  # hard supports: edges do not twist
    bulk.fix("5", low | top)
    bulk.fix("12", [int(np.flatnonzero(left & low)[0])])
    bulk.fix("2", [int(np.flatnonzero(right & low)[0])])
    quadratic = card in ("CQUAD8", "CTRIA6")
    nxx, nyy, nxy = forces
    for edge, along, push in (
        (right, y, (-nxx, nxy)),
        (left, y, (nxx, -nxy)),
        (top, x, (nxy, -nyy)),
        (low, x, (-nxy, nyy)),
    ):
        grids = np.flatnonzero(edge)
        grids = grids[np.argsort(along[grids])]
        share = _shares(len(grids), quadratic) * (along.max() - along.min())
        for value, direction in zip(push, ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))):
            if value:
                bulk.forces(7, grids, direction, value * share)
    return bulk


def _mid_sides(xyz: np.ndarray, conn: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    pairs = np.sort(np.stack([conn, np.roll(conn, -1, axis=1)], axis=2), axis=2)
    unique, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    nodes = np.vstack([xyz, xyz[unique].mean(axis=1)])
    return nodes, np.c_[conn, len(xyz) + inverse.reshape(len(conn), -1)]


def _shares(count: int, quadratic: bool) -> np.ndarray:
    """(count,) shares of a uniform load on an edge."""
    weight = np.ones(count)
    if quadratic:
        weight[1::2] = 4.0
        weight[2:-1:2] = 2.0
    else:
        weight[[0, -1]] = 0.5
    return weight / weight.sum()


def _coefficient(card: str, aspect: float, n: int, forces) -> float:
    return float(factors(plate(card, aspect, n, forces), count=2)[0] / _UNIT)


def plates_that_buckle() -> list[Row]:
    """Coefficients k of N = k pi^2 D / b^2."""
    rows = []
    for card, meshes in (
        ("CQUAD4", (4, 8, 16)),
        ("CTRIA3", (4, 8)),
        ("CQUADR", (8, 16, 32)),
        ("CTRIAR", (8, 16)),
        ("CQUAD8", (4, 8)),
        ("CTRIA6", (4, 8)),
    ):
        for aspect, forces, name, exact in (
            (1.0, (1.0, 0.0, 0.0), "compression", 4.0),
            (1.0, (0.0, 0.0, 1.0), "shear", ritz_buckling(1.0, (0.0, 0.0, 1.0), _NU)),
        ):
            found = [
                (f"{n}x{n}", _coefficient(card, aspect, n, forces)) for n in meshes
            ]
            rows += convergence(
                f"square plate under {name}, {card}",
                "coefficient k",
                found,
                exact,
                _BOOK if name == "compression" else "Ritz, 12 x 12 polynomials",
                target=0.015,
            )
    for aspect, forces, name in (
        (1.5, (1.0, 0.0, 0.0), "compression"),
        (2.0, (1.0, 0.0, 0.0), "compression"),
        (3.0, (1.0, 0.0, 0.0), "compression"),
        (2.0, (0.0, 0.0, 1.0), "shear"),
        (3.0, (0.0, 0.0, 1.0), "shear"),
        (1.0, (1.0, 1.0, 0.0), "compression from all sides"),
        (1.0, (1.0, 0.0, 1.0), "compression and shear"),
        (2.0, (1.0, -0.5, 0.0), "compression, half as much tension across"),
    ):
        exact = ritz_buckling(aspect, forces, _NU)
        rows.append(
            figure(
                f"plate {aspect:g} long under {name}, CQUAD4",
                "coefficient k",
                _coefficient("CQUAD4", aspect, 16, forces),
                exact,
                "Ritz, 12 x 12 polynomials",
                target=0.015,
                mesh="16 over the width",
            )
        )
    return rows


def stiffened_panel() -> list[Row]:
    """A square plate with a stringer along its middle, that buckles with it."""
    n, gamma, delta = 16, 5.0, 0.1
    inertia = gamma * _RIGIDITY * _WIDTH / _YOUNG
    area = delta * _WIDTH * _THICKNESS
    bulk = plate("CQUAD4", 1.0, n, (1.0, 0.0, 0.0))
    bulk.add("PBAR", 2, 1, area, inertia, inertia, 1e-12)
    middle = np.arange(n + 1) * (n + 1) + n // 2
    bulk.elements("CBAR", 2, np.c_[middle[:-1], middle[1:]], 0.0, 0.0, 1.0)
    # The stringer takes its part of the load where it ends.
    bulk.lines = [line for line in bulk.lines if not line.startswith("FORCE")]
    x = np.flatnonzero(np.arange((n + 1) ** 2) >= n * (n + 1))
    for grids, sign in ((x, -1.0), (np.arange(n + 1), 1.0)):
        shares = _shares(n + 1, False) * _WIDTH
        shares[n // 2] += delta * _WIDTH
        bulk.forces(7, grids, (1.0, 0.0, 0.0), sign * shares)
    found = factors(bulk, count=2)[0] / _UNIT
    # One half wave along and across (m = n = 1); exact to the first term of the series.
    exact = ritz_buckling(1.0, (1.0, 0.0, 0.0), _NU, stringer=(gamma, delta))
    return [
        figure(
            "square panel with a stringer, gamma 5, delta 0.1",
            "coefficient k of the sheet",
            found,
            exact,
            "Ritz with the stringer's bending; Timoshenko and Gere 9.11",
            target=0.01,
            mesh=f"{n}x{n}",
        )
    ]


def solid_column() -> list[Row]:
    """A fixed-free column of bricks."""
    length, side, n = 1.0, 0.05, 20
    rows = []
    for card in ("CHEXA", "CHEXA20"):
        xyz, conn = box(1, 1, n)
        xyz = xyz * [side, 1.2 * side, length]
        if card == "CHEXA20":
            xyz, conn = with_mid_sides("CHEXA", xyz, conn)
        bulk = Bulk()
        bulk.add("MAT1", 1, _YOUNG, "", 0.0)
        bulk.add("PSOLID", 1, 1)
        bulk.grids(xyz)
        bulk.elements("CHEXA", 1, conn)
        z = xyz[:, 2]
        bulk.fix("123", np.isclose(z, 0.0))
        top = np.flatnonzero(np.isclose(z, length))
        corner = top < 4 * (n + 1)
        share = np.full(len(top), 0.25)
        if card == "CHEXA20":  # of a uniform pressure
            share = np.where(corner, -1.0 / 12.0, 1.0 / 3.0)
        bulk.forces(7, top, (0.0, 0.0, -1.0), share)
        inertia = 1.2 * side * side**3 / 12.0
        euler = np.pi**2 * _YOUNG * inertia / (4.0 * length**2)
        shear = 5.0 / 6.0 * 1.2 * side**2 * 0.5 * _YOUNG
        rows.append(
            figure(
                f"fixed-free column of {card}",
                "load, N",
                factors(bulk)[0],
                euler / (1.0 + euler / shear),
                "Euler, with Engesser's shear",
                target=3e-3,
                mesh=f"1x1x{n}",
            )
        )
    return rows
