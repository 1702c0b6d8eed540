"""Reference decks with the figures that MSC, NX, NASTRAN-95 and others print."""

import json
import re
from pathlib import Path

import numpy as np
import scipy.io
import scipy.linalg
import scipy.sparse as sp

import fem
from benchmarks.verification.op2_tables import element_rows, first_times, read_op2
from benchmarks.verification.row import (
    SURFACES,
    Row,
    field,
    figure,
    listed,
)
from benchmarks.verification.runner import run
from fem.constraints.rbe3 import read_rbe3
from fem.model.points import read_points
from fem.solution import Options


def expected(references: Path) -> dict:
    """Figures printed by the solvers."""
    return json.loads((references / "expected.json").read_text())


def trusses_and_beams(references: Path) -> list[Row]:
    """Modes of trusses and of beams and bars; their statics by equilibrium."""
    rows = []
    for name, entry in expected(references)["beams"].items():
        hz = entry["modes_hz"]
        ours = run(references / "beams" / name)["modes/frequency_hz"][: len(hz)]
        case = name.split("/")[0]
        rows.append(listed(case, "frequencies, Hz", ours, hz, entry["solver"]))
        rows += _equilibrium(case, references / "beams" / case / "static.dat")
    return rows


def _equilibrium(case: str, path: Path) -> list[Row]:
    """Sums of the forces and moments of constraint against those of the FORCE cards."""
    ours, deck = run(path), fem.read_deck(path)
    xyz, grids = ours["position"], ours["grid_id"]
    rows = []
    for subcase in deck.case_control:
        cards = deck.cards["FORCE"]
        cards = cards[cards["sid"] == subcase.load]
        force = cards[["n1", "n2", "n3"]].to_numpy() * cards[["f"]].to_numpy()
        at = xyz[np.searchsorted(grids, cards["g"].to_numpy())]
        load = np.r_[force.sum(axis=0), np.cross(at, force).sum(axis=0)]
        spc = ours[f"static/{subcase.id}/spc_force"]
        moment = np.cross(xyz, spc[:, :3]).sum(axis=0) + spc[:, 3:].sum(axis=0)
        reaction = -np.r_[spc[:, :3].sum(axis=0), moment]
        for text, part in (("forces", slice(0, 3)), ("moments", slice(3, 6))):
            rows.append(
                field(
                    case,
                    f"statics {subcase.id}: sum of {text} of constraint",
                    reaction[part],
                    load[part],
                    "equilibrium",
                )
            )
    return rows


def solid_shell_bar_statics(references: Path) -> list[Row]:
    """All element types in one small structure: every number of the OP2 files."""
    rows = []
    printed = [0.002632421, 0.0002271015, 0.002766774]
    for suffix in ("", "_xyz", "_pload1"):
        stem = f"static_solid_shell_bar{suffix}"
        folder = references / "solid_shell_bar"
        ours, theirs = run(folder / f"{stem}.bdf"), read_op2(folder / f"{stem}.op2")
        u = ours["static/1/displacement"]
        if not suffix:
            largest = np.abs(u[:, :3]).max(axis=0)
            for name, a, b in zip("xyz", largest, printed):
                rows.append(
                    figure(stem, f"largest u{name}", a, b, "NX 8.5", target=SURFACES)
                )
        table = theirs.displacements[1].data[0]
        for text, part in (
            ("translations", slice(0, 3)),
            ("rotations", slice(3, 6)),
        ):
            rows.append(
                field(
                    stem,
                    f"all {text}",
                    u[:, part],
                    table[:, part],
                    "NX 8.5, OP2",
                    target=SURFACES,
                )
            )
        spc = theirs.spc_forces[1]
        at = np.searchsorted(ours["grid_id"], spc.node_gridtype[:, 0])
        mine = ours["static/1/spc_force"][at]
        rows.append(
            field(
                stem,
                "SPC forces",
                mine[:, :3],
                spc.data[0][:, :3],
                "NX 8.5, OP2",
                target=SURFACES,
            )
        )
        rows += element_rows(stem, ours, "static/1", theirs, 1, "NX 8.5, OP2")
    return rows


def solid_shell_bar_modes(references: Path) -> list[Row]:
    """Frequencies, shapes and element results of the modes."""
    folder, case = references / "solid_shell_bar", "mode_solid_shell_bar"
    ours, theirs = run(folder / f"{case}.bdf"), read_op2(folder / f"{case}.op2")
    hz = expected(references)["solid_shell_bar/mode_solid_shell_bar.bdf"]["modes_hz"]
    rows = [
        listed(
            case,
            "frequencies, Hz",
            ours["modes/frequency_hz"],
            hz,
            "MSC 2005",
            target=SURFACES,
        )
    ]
    shapes = theirs.eigenvectors[1].data
    mine = ours["modes/shape"]
    sign = np.sign(np.einsum("mgc,mgc->m", mine, shapes))
    aligned = sign[:, None, None] * mine
    rows.append(
        field(case, "shapes", aligned, shapes, "MSC 2005, OP2", target=SURFACES)
    )
    return rows + element_rows(
        case, ours, "modes", theirs, 1, "MSC 2005, OP2", sign=sign
    )


def solid_shell_bar_buckling(references: Path) -> list[Row]:
    """Load factors of the same structure under a force at its tip."""
    folder = references / "solid_shell_bar"
    bulk = (folder / "static_solid_shell_bar.bdf").read_text().split("BEGIN BULK")[1]
    bulk = bulk.replace("INCLUDE 'geom.inc'", (folder / "geom.inc").read_text())
    bulk = bulk.replace("AUTOSPC NO", "AUTOSPC YES")
    bulk = re.sub(r"(?m)^(FORCE|SPC1|SPCADD|LOAD) .*\n", "", bulk)
    more = """SPC1,9,123456,18,19,20,21
SPC1,9,456,5,THRU,13
FORCE,9,13,,1.-5,0.,0.,1.
CELAS2,23,10.,21,1,25,1
CELAS2,22,10.,21,1,25,1
CSHEAR,28,9,17,16,20,21
PSHEAR,9,1,.1
CONROD,27,18,22,1,1.,2.
EIGRL,9,,,4
ENDDATA
"""
    case = "SPC = 9\nSUBCASE 1\n LOAD = 9\nSUBCASE 2\n METHOD = 9\nBEGIN BULK\n"
    ours = run(f"SOL 105\nCEND\n{case}{bulk.split('ENDDATA')[0]}{more}")
    return [
        listed(
            "buckling2_solid_shell_bar",
            "load factors",
            ours["buckling/2/factor"],
            [-4.935766e10, -5.800194e10, -3.797507e11, -4.284625e11],
            "MSC Nastran, OP2 of pyNastran's models",
            target=SURFACES,
        )
    ]


def solid_shell_bar_transient(references: Path) -> list[Row]:
    """SOL 109: histories of displacements, constraint forces, element results."""
    folder, case = references / "solid_shell_bar", "transient_solid_shell_bar"
    theirs = read_op2(folder / f"{case}.op2")
    ours = run(_without_late_additions(folder / f"{case}.bdf"))
    u, time = ours["transient/1/displacement"], ours["transient/1/time"]
    rows = []
    for grid, when, uy in (
        (13, 0.01, 0.005184792),
        (13, 0.05, 0.006510834),
        (5, 0.18, 0.004796416),
    ):
        at = int(np.argmin(np.abs(time - when)))
        mine = ours.grid("transient/1/displacement", grid)[at, 1]
        rows.append(
            figure(
                case,
                f"grid {grid} uy at {when} s",
                mine,
                uy,
                "NX 8.5",
                target=SURFACES,
            )
        )
    table = theirs.displacements[1]
    data = table.data[first_times(table)]
    for text, part in (("translations", slice(0, 3)), ("rotations", slice(3, 6))):
        rows.append(
            field(
                case,
                f"histories of all {text}",
                u[..., part],
                data[..., part],
                "NX 8.5, OP2",
                target=SURFACES,
            )
        )
    spc = theirs.spc_forces[1]
    at = np.searchsorted(ours["grid_id"], spc.node_gridtype[:, 0])
    rows.append(
        field(
            case,
            "histories of SPC forces",
            ours["transient/1/spc_force"][:, at, :3],
            spc.data[first_times(spc)][..., :3],
            "NX 8.5, OP2",
            target=SURFACES,
        )
    )
    return rows + element_rows(case, ours, "transient/1", theirs, 1, "NX 8.5, OP2")


def _without_late_additions(path: Path) -> str:
    """The deck without the five elements that its OP2 file does not know.

    The loads in the file add up to 987.0389 = 386.1 times the mass without them, it
    has no results of theirs, and with them no history comes near.
    """
    lines = path.read_text().replace("'geom.inc'", f"'{path.parent / 'geom.inc'}'")
    late = ("CELAS1", "CELAS2", "CSHEAR", "CDAMP2", "CONROD")
    return "\n".join(x for x in lines.splitlines() if not x.startswith(late))


def line_elements_transient(references: Path) -> list[Row]:
    """tst1d3: bars, beams, tubes, springs, an arc with initial velocities."""
    folder, case = references / "transient_1d", "tst1d3"
    # NX leaves the part of PLOAD1 between the ends out of its tables.
    plain = Options(bar_loads=False)
    ours = run(folder / "tst1d3.bdf", options=plain)
    theirs = read_op2(folder / "tst1d3.op2")
    ux = ours.grid("transient/10/displacement", 9)[:, 0]
    rows = [
        figure(case, f"grid 9 ux, output {at}", ux[at], value, "NX")
        for at, value in _appearing(ux, (0.001589753, 0.003581755))
    ]
    table = theirs.displacements[10]
    data = table.data[first_times(table)]
    nodes = table.node_gridtype[:, 0].tolist()
    grids = ours["grid_id"].tolist()
    mine = ours["transient/10/displacement"][:, np.searchsorted(ours["grid_id"], grids)]
    other = data[:, [nodes.index(g) for g in grids]]
    rows.append(field(case, "histories of all grids", mine, other, "NX, OP2"))
    points = ours["scalar_point_id"]
    mine = ours["transient/10/displacement_scalar_point"]
    other = data[:, [nodes.index(p) for p in points], 0]
    rows.append(field(case, "histories of scalar points", mine, other, "NX, OP2"))
    return rows + element_rows(case, ours, "transient/10", theirs, 10, "NX, OP2")


def _appearing(
    history: np.ndarray, values: tuple[float, ...]
) -> list[tuple[int, float]]:
    """Each printed value with the output at which the history comes closest."""
    return [(int(np.argmin(np.abs(history - v))), v) for v in values]


def reductions(references: Path) -> list[Row]:
    """Guyan, dynamic reduction and Craig-Bampton superelements of a cantilever bar."""
    folder = references / "reduction" / "cantilever_bar"
    printed = expected(references)["reduction/cantilever_bar"]
    rows = []
    for name in ("noReduction", "guyanReduction", "dynamicReduction"):
        entry = printed[f"{name}.dat"]
        hz = np.array(entry["modes_hz"][-1])
        ours = run(folder / f"{name}.dat")["modes/frequency_hz"]
        rows.append(
            listed(name, "frequencies, Hz", ours[: len(hz)], hz, entry["solver"])
        )
    for count in (0, 1, 2, 3):
        name = f"cbSuper{count}Mode{'s' if count > 1 else ''}"
        name = name if count else "guyanSuper"
        entry = printed[f"{name}.dat"]
        parts = _parts(folder)
        text = (folder / f"{name}.dat").read_text().replace("\\", "/")
        whole = run(text.replace("'../", f"'{folder}/"))["modes/frequency_hz"]
        for text, ours, theirs in (
            ("modes of part 1, Hz", parts[0], entry["modes_hz"][0]),
            (
                "modes of part 2, Hz",
                parts[1],
                entry["modes_hz"][1 % len(entry["modes_hz"])],
            ),
            ("modes of the whole, Hz", whole, entry["modes_hz"][-1]),
        ):
            if count == 0 and "part" in text:
                continue
            size = min(len(ours), len(theirs))
            rows.append(listed(name, text, ours[:size], theirs[:size], entry["solver"]))
    return rows


def _parts(folder: Path) -> list[np.ndarray]:
    """Fixed-interface modes of both parts.

    The parts meet at grid 6 alone: with it held their interiors are uncoupled.
    """
    structure = fem.Structure.from_deck(fem.read_deck(folder / "guyanReduction.dat"))
    kept = structure.free_rows(structure.analysis_dof, "ASET")
    k, m = structure.stiffness, structure.mass
    grid = structure.points.grid_id[structure.elimination.f // 6]
    interior = np.setdiff1d(np.arange(structure.size), kept)
    frequencies = []
    for part in (grid[interior] > 6, grid[interior] < 6):
        rows = interior[part]
        inner = [sp.csr_matrix(a[rows][:, rows]) for a in (k, m)]
        count = min(3, len(rows))
        frequencies.append(fem.normal_modes(*inner, count=count).frequency_hz)
    return frequencies


def rbe3_matrices(references: Path) -> list[Row]:
    """Constraint matrices of RBE3 elements."""
    rows = []
    for name in ("1", "2", "3", "4", "um_1", "um_2"):
        stem = references / "rbe3" / f"make_gm_nx9_rbe3_{name}"
        matrix = stem.with_suffix(".mat")
        if not matrix.exists():
            continue
        deck = fem.read_deck(stem.with_suffix(".dat"))
        points = read_points(deck)
        (equations,) = read_rbe3(deck, points)
        ours = np.zeros((points.size, points.size))
        at = equations.dependent[equations.row], equations.column
        ours[at] = equations.value
        m = np.sort(equations.dependent)
        n = np.setdiff1d(np.arange(points.size), m)
        gm = scipy.io.loadmat(matrix)["gm"][0, 0]
        theirs = np.asarray(gm[gm.dtype.names[0]] if gm.dtype.names else gm)
        rows.append(field(f"RBE3 {name}", "GM", ours[np.ix_(m, n)], theirs, "NX 9"))
    return rows


def truss_frame(references: Path) -> list[Row]:
    """A free frame of 117 bars with RBE2: elastic modes."""
    entry = expected(references)["truss_frame/full.dat"]
    structure = fem.Structure.from_deck(
        fem.read_deck(references / "truss_frame" / "full.dat")
    )
    hz = np.array(entry["modes_hz"])
    modes = fem.normal_modes(
        structure.stiffness,
        structure.mass,
        count=len(hz),
        rigid_body=structure.rigid_body,
    )
    ours = modes.frequency_hz[6 : len(hz)]
    return [
        listed("truss frame", "elastic modes, Hz", ours, hz[6:], entry["solver"]),
        figure(
            "truss frame",
            "rigid-body modes",
            modes.rigid,
            6,
            "count",
            target=0.0,
        ),
    ]
