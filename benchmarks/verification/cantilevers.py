"""A cantilever of bars and one of plates, by NASTRAN-95, OpenSees and CalculiX."""

import json
from pathlib import Path

import numpy as np

from benchmarks.verification.mesh import Bulk, rectangle
from benchmarks.verification.plate_theory import ritz_frequencies
from benchmarks.verification.row import (
    SURFACES,
    Row,
    convergence,
    field,
    figure,
    listed,
)
from benchmarks.verification.runner import run


def cantilever_bar(references: Path) -> list[Row]:
    """Ten bars with an offset mass: modes, statics, step response."""
    folder, case = references / "cantilever", "cantilever a (bars)"
    n95 = json.loads((folder / "nastran95_cantilever.json").read_text())["cant_a"]
    ops = json.loads((folder / "opensees_cantilever.json").read_text())
    ops = ops["cant_a_consistent"]
    modes = run(folder / "cant_a_modes.bdf")["modes/frequency_hz"]
    static = run(folder / "cant_a_stat.bdf")["static/1/displacement"]
    ours = run(folder / "cant_a_tran.bdf")
    tip = ours["transient/1/displacement"][:, 10]
    rows = [
        listed(case, "frequencies, Hz", modes, n95["hz"][: len(modes)], "NASTRAN-95"),
        listed(
            case,
            "lowest four, Hz",
            modes[:4],
            ops["hz"][:4],
            "OpenSees (other mass matrix in bending)",
            target=1e-4,
        ),
        field(
            case,
            "statics of all grids",
            static,
            [n95["static"][str(g)] for g in range(1, 12)],
            "NASTRAN-95",
        ),
    ]
    theirs = np.array(n95["transient"]["11"])[:, 1:]
    for number, name in enumerate(("ux", "uy", "uz", "rx", "ry", "rz")):
        if np.abs(theirs[:, number]).max() > 0.0:
            rows.append(
                field(
                    case,
                    f"step response, tip {name}",
                    tip[:, number],
                    theirs[:, number],
                    "NASTRAN-95",
                )
            )
    uz = tip[:, 2]
    rows.append(figure(case, "peak uz", uz.max(), 0.03446439, "NASTRAN-95"))
    force = np.array(n95["cbar101_force"]["rows"])[:, 1:]
    mine = ours["transient/1/element_force/CBAR/value"][:, 0]
    rows.append(field(case, "forces of the first bar", mine, force, "NASTRAN-95"))
    rows.append(
        field(
            case,
            "step response, tip uz",
            uz,
            ops["tip_uz"],
            "OpenSees (average acceleration: differs by the order of the step)",
            target=1e-3,
        )
    )
    return rows


def cantilever_plate(references: Path) -> list[Row]:
    """Ten by four quadrilaterals, between four solvers' elements; refined to theory.

    Quadrilaterals of other kinds differ by 1 % on this mesh: they meet when refined.
    """
    folder, case = references / "cantilever", "cantilever b (10 x 4 plate)"
    modes = run(folder / "cant_b_modes.bdf")["modes/frequency_hz"]
    static = run(folder / "cant_b_stat.bdf").grid("static/1/displacement", 51)[2]
    step = run(folder / "cant_b_tran.bdf").grid("transient/1/displacement", 51)[:, 2]
    rows = []
    for solver, hz, uz, peak in (
        ("NASTRAN-95", [8.3752, 53.1421, 56.4987], 0.001927512, 0.003668651),
        ("OpenSees MITC4", [8.3925, 53.6865, 57.1393], 0.001920661, 0.003660488),
        ("CalculiX S8R", [8.4595, 52.8788, 56.9077], 0.001901791, 0.003613638),
    ):
        target = SURFACES if solver == "NASTRAN-95" else 0.02
        rows.append(
            listed(case, "frequencies, Hz", modes[:3], hz, solver, target=target)
        )
        rows.append(figure(case, "static corner uz", static, uz, solver, target=target))
        rows.append(figure(case, "peak uz", step.max(), peak, solver, target=target))
    young, nu, density, thickness = 7e10, 0.3, 2700.0, 0.01
    rigidity = young * thickness**3 / (12.0 * (1.0 - nu**2))
    exact = ritz_frequencies(
        rigidity, density * thickness, (1.0, 0.3), nu, 3, clamped=True
    )
    found = {n: _refined_plate(n) for n in (1, 2, 4, 8)}
    for mode, theory in enumerate(exact):
        meshes = [(f"{10 * n} x {4 * n}", hz[mode]) for n, hz in found.items()]
        quantity = f"mode {mode + 1}, Hz"
        rows += convergence(case, quantity, meshes, theory, "Kirchhoff, Ritz 14 x 14")
    return rows


def _refined_plate(n: int) -> np.ndarray:
    """Lowest frequencies of the plate with 10 n by 4 n elements."""
    bulk = Bulk("PARAM,COUPMASS,1\nEIGRL,9,,,3\nPARAM,K6ROT,0.")
    bulk.add("MAT1", 1, 7e10, "", 0.3, 2700.0)
    bulk.add("PSHELL", 1, 1, 0.01, 1, "", 1)
    points, quads = rectangle(10 * n, 4 * n)
    bulk.grids(np.c_[points * [1.0, 0.3], np.zeros(len(points))])
    bulk.elements("CQUAD4", 1, quads)
    bulk.fix("126", np.arange(len(points)))
    bulk.fix("345", points[:, 0] == 0)
    return run(bulk.deck(103, "SPC = 1\nMETHOD = 9"))["modes/frequency_hz"]
