"""Shear forces and reactions of supported plates, elements that are not square.

A unit square under unit pressure, supported on all sides (w, the tangential rotation
and, for laminates, the tangential displacement are zero), against Navier's series. The
reactions at the grids are those of the series, weighted with the hat of each grid. The
plates are 1/100 thick: their transverse shear matters by 0.1 % (deflections), but makes
the reactions at such supports unique (w against the moment of the tangential rotation).
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchmarks.verification.mesh import Bulk, rectangle, triangles
from benchmarks.verification.row import SURFACES, Row, convergence
from benchmarks.verification.runner import Results, run

Float64 = npt.NDArray[np.float64]
THICKNESS = 0.01
ODD = np.arange(1.0, 400.0, 2.0)
_CASE = "SPC = 1\nLOAD = 7\nDISP = ALL\nSPCFORCE = ALL\nFORCE = ALL"


@dataclass(frozen=True, kw_only=True)
class Navier:
    """Series of a cross-ply laminate (or an isotropic plate) without transverse shear.

    Displacements U cos sin, V sin cos, W sin sin of the wave numbers (m, n) / pi solve
    the equilibrium of membrane and bending together, N = A e + B k, M = B e + D k with
    the curvatures -w,xx, -w,yy, -2 w,xy.

    Attributes:
        a, b, d: (3, 3) stiffness of the laminate.
    """

    a: Float64
    b: Float64
    d: Float64

    def _amplitudes(self) -> tuple[Float64, ...]:
        """x and y wave numbers (n, n), and Q_x, Q_y, W of each wave."""
        x, y = np.meshgrid(np.pi * ODD, np.pi * ODD, indexing="ij")
        a, b, d = self.a, self.b, self.d
        system = np.zeros((*x.shape, 3, 3))
        system[..., 0, 0] = a[0, 0] * x**2 + a[2, 2] * y**2
        system[..., 1, 1] = a[1, 1] * y**2 + a[2, 2] * x**2
        system[..., 0, 1] = system[..., 1, 0] = (a[0, 1] + a[2, 2]) * x * y
        system[..., 0, 2] = system[..., 2, 0] = -b[0, 0] * x**3
        system[..., 1, 2] = system[..., 2, 1] = -b[1, 1] * y**3
        mixed = d[0, 1] + 2.0 * d[2, 2]
        system[..., 2, 2] = d[0, 0] * x**4 + 2.0 * mixed * (x * y) ** 2 + d[1, 1] * y**4
        load = np.zeros((*x.shape, 3, 1))
        load[..., 2, 0] = 16.0 / (x * y)
        u, v, w = np.moveaxis(np.linalg.solve(system, load)[..., 0], -1, 0)
        along = -b[0, 0] * x**2 * u + (d[0, 0] * x**3 + mixed * x * y**2) * w
        across = -b[1, 1] * y**2 * v + (d[1, 1] * y**3 + mixed * y * x**2) * w
        return x, y, along, across, w

    def center(self) -> float:
        """Deflection of the center."""
        x, y, _, _, w = self._amplitudes()
        return float((w * np.sin(0.5 * x) * np.sin(0.5 * y)).sum())

    def shear(self, at: tuple[float, float]) -> tuple[float, float]:
        """Q_x and Q_y at a point."""
        x, y, along, across, _ = self._amplitudes()
        first = along * np.cos(x * at[0]) * np.sin(y * at[1])
        second = across * np.sin(x * at[0]) * np.cos(y * at[1])
        return float(first.sum()), float(second.sum())

    def reaction(self, axis: int, count: int) -> float:
        """Of the grid amid the edge x = 0 (axis 0) or y = 0, `count` elements long."""
        x, y, along, across, _ = self._amplitudes()
        waves, amplitude = (y, along) if axis == 0 else (x, across)
        hat = (2.0 - 2.0 * np.cos(waves / count)) / waves**2 * count
        return float((amplitude * hat * np.sin(0.5 * waves)).sum())


def _isotropic(bulk: Bulk) -> Navier:
    bulk.add("MAT1", 1, 1e7, "", 0.3)
    bulk.add("PSHELL", 1, 1, THICKNESS, 1, "", 1)
    plane = 1e7 / 0.91 * np.array([[1.0, 0.3, 0.0], [0.3, 1.0, 0.0], [0.0, 0.0, 0.35]])
    return Navier(
        a=plane * THICKNESS, b=np.zeros((3, 3)), d=plane * THICKNESS**3 / 12.0
    )


def _cross_ply(bulk: Bulk) -> Navier:
    """0/90, E1/E2 = 25: membrane and bending are coupled (B11 = -B22)."""
    bulk.add("MAT8", 1, 25e6, 1e6, 0.25, 0.5e6, 0.5e6, 0.5e6)
    half = 0.5 * THICKNESS
    plies = [1, half, 0.0, "NO", 1, half, 90.0, "NO"]
    bulk.add("PCOMP", 1, "", "", "", "", "", "", "", *plies)
    share = 1.0 - 0.25**2 / 25.0
    lower = np.array([[25e6, 0.25e6, 0.0], [0.25e6, 1e6, 0.0], [0.0, 0.0, 0.0]]) / share
    lower[2, 2] = 0.5e6
    upper = lower[[1, 0, 2]][:, [1, 0, 2]]
    return Navier(
        a=(lower + upper) * half,
        b=(upper - lower) * half**2 / 2.0,
        d=(lower + upper) * half**3 / 3.0,
    )


def _plate(nx: int, ny: int, corners: int, sheared: float, section: str) -> tuple:
    """Bulk data of the supported plate under pressure, the series and the points."""
    bulk = Bulk()
    theory = _cross_ply(bulk) if section == "0/90" else _isotropic(bulk)
    points, conn = rectangle(nx, ny)
    x, y = points.T
    # Skewed and tapered inside, straight at the sides.
    bump = sheared * np.sin(np.pi * x) * np.sin(np.pi * y)
    place = np.stack([x + bump * (y - 0.5), y + bump * (x - 0.5)], axis=1)
    bulk.grids(np.c_[place, 0.0 * x])
    conn = conn if corners == 4 else triangles(conn)
    bulk.elements("CQUAD4" if corners == 4 else "CTRIA3", 1, conn, 0)
    bulk.add("PLOAD2", 7, 1.0, 1, "THRU", len(conn))
    ends, sides = (x == 0) | (x == 1), (y == 0) | (y == 1)
    bulk.fix("6", np.arange(len(points)))
    bulk.fix("234", ends)
    bulk.fix("135", sides)
    if section != "0/90":
        bulk.fix("12", np.arange(len(points)))
    return bulk, theory, points


def _figures(nx: int, ny: int, **options: object) -> dict[str, tuple[float, float]]:
    """Ours and theirs by quantity."""
    bulk, theory, points = _plate(nx, ny, **options)  # type: ignore[arg-type]
    ours: Results = run(bulk.deck(101, _CASE))
    w = ours["static/1/displacement"][:, 2]
    reaction = -ours["static/1/spc_force"][:, 2]
    middle = (points == 0.5).all(axis=1)
    found = {"deflection of the center": (float(w[middle][0]), theory.center())}
    for axis, name, count in ((0, "x", ny), (1, "y", nx)):
        at = (points[:, axis] == 0.0) & (points[:, 1 - axis] == 0.5)
        theirs = theory.reaction(axis, count)
        found[f"reaction amid the side {name} = 0"] = float(reaction[at][0]), theirs
    if options["corners"] == 4 and not options["sheared"]:
        # Elements beside the middles of two sides: axes along x and y.
        for column, element, place in (
            ("tx", ny // 2, (0.5 / nx, 0.5 + 0.5 / ny)),
            ("ty", nx // 2 * ny, (0.5 + 0.5 / nx, 0.5 / ny)),
        ):
            force = ours.column("static/1/element_force/CQUAD4", column)
            theirs = abs(theory.shear(place)[0 if column == "tx" else 1])
            name = f"shear force {column} beside the side {column[1]} = 0"
            found[name] = abs(float(np.ravel(force)[element])), theirs
    return found


def _rows(case: str, meshes: tuple[tuple[int, int], ...], **options: object) -> list:
    found = {f"{nx} x {ny}": _figures(nx, ny, **options) for nx, ny in meshes}
    rows: list[Row] = []
    for quantity in next(iter(found.values())):
        # Theirs are others on each mesh (hats, places): ours are scaled to the finest.
        theirs = found[list(found)[-1]][quantity][1]
        scaled = [
            (m, f[quantity][0] / f[quantity][1] * theirs) for m, f in found.items()
        ]
        target = 0.02 if options["sheared"] else SURFACES
        rows += convergence(
            case, quantity, scaled, theirs, "Navier's series", target=target
        )
    return rows


def plate_reactions() -> list[Row]:
    """Elements of aspect 1 to 10, skewed and tapered ones, triangles, a laminate."""
    rows = []
    for aspect in (1, 2, 5, 10):
        counts = (8, 16, 32) if aspect == 1 else (4, 8, 16)
        meshes = tuple((n, n * aspect) for n in counts)
        for section in ("isotropic", "0/90"):
            rows += _rows(
                f"supported plate, {section}, elements {aspect} to 1",
                meshes,
                corners=4,
                sheared=0.0,
                section=section,
            )
    squares = ((8, 8), (16, 16), (32, 32))
    for section in ("isotropic", "0/90"):
        rows += _rows(
            f"supported plate, {section}, skewed and tapered elements",
            squares,
            corners=4,
            sheared=0.4,
            section=section,
        )
    rows += _rows(
        "supported plate, isotropic, triangles",
        squares,
        corners=3,
        sheared=0.0,
        section="isotropic",
    )
    return rows
