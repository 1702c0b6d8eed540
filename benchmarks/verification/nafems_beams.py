"""NAFEMS beams: FV2, FV4, FV5 (R0015) and 5T (R0016), as generated decks.

CBAR has no rotary inertia of its own (no Nastran has it): where the reference is
Timoshenko's beam with rotary inertia, CONM2 at the grids carry it, as a user would do.
"""

import numpy as np

from benchmarks.verification.mesh import Bulk
from benchmarks.verification.row import Row, convergence
from benchmarks.verification.runner import run

E, NU, RHO = 200e9, 0.3, 8000.0
MODES = "METHOD = 9\nSPC = 1"


def _material(bulk: Bulk) -> None:
    bulk.add("MAT1", 1, E, "", NU, RHO)


def double_cross(per_arm: int) -> str:
    """FV2: eight arms of 5 m, 0.125 m square, pinned ends, motion in their plane."""
    bulk = Bulk("EIGRL,9,,,16\nPARAM,COUPMASS,1")
    _material(bulk)
    a = 0.125
    bulk.add("PBAR", 1, 1, a * a, a**4 / 12, a**4 / 12, 0.141 * a**4)
    angles = np.arange(8) * np.pi / 4
    radii = 5.0 * np.arange(1, per_arm + 1) / per_arm
    spokes = (
        radii[None, :, None] * np.stack([np.cos(angles), np.sin(angles)], 1)[:, None]
    )
    xy = np.vstack([[0.0, 0.0], spokes.reshape(-1, 2)])
    bulk.grids(np.c_[xy, np.zeros(len(xy))])
    for arm in range(8):
        first = 1 + arm * per_arm
        chain = np.r_[0, first : first + per_arm]
        bulk.elements("CBAR", 1, np.c_[chain[:-1], chain[1:]], 0.0, 0.0, 1.0)
    bulk.fix("345", np.arange(len(xy)))
    bulk.fix("12", np.arange(per_arm, len(xy), per_arm))
    return bulk.deck(103, MODES)


def fv2() -> list[Row]:
    """Pin-ended double cross: formulas of bars pinned, and clamped and pinned."""
    c = np.sqrt(E / RHO * 0.125**2 / 12) / (2 * np.pi * 25.0)
    pinned, clamped = c * np.pi**2, c * 3.92660231**2
    hz = {
        f"{n} per arm": run(double_cross(n))["modes/frequency_hz"] for n in (4, 8, 16)
    }
    rows = []
    for name, at, reference in (
        ("mode 1", 0, pinned),
        ("modes 2-8, the last", 7, clamped),
        ("mode 9", 8, 4.0 * pinned),
        ("modes 10-16, the last", 15, c * 7.06858275**2),
    ):
        found = [(mesh, values[at]) for mesh, values in hz.items()]
        rows += convergence(
            "FV2 double cross",
            f"{name}, Hz",
            found,
            reference,
            "closed form",
            target=1e-3,
        )
    return rows


def off_center_masses(count: int) -> str:
    """FV4: cantilever of 10 m, 0.5 m round, 10 t and 1 t two metres off its tip."""
    bulk = Bulk("EIGRL,9,,,6\nPARAM,COUPMASS,1")
    _material(bulk)
    area, inertia = np.pi / 4 * 0.5**2, np.pi / 64 * 0.5**4
    bulk.add("PBAR", 1, 1, area, inertia, inertia, 2 * inertia)
    x = np.linspace(0.0, 10.0, count + 1)
    bulk.grids(np.r_[np.c_[x, 0 * x, 0 * x], [[10.0, 2.0, 0.0], [10.0, -2.0, 0.0]]])
    at = np.arange(count)
    bulk.elements("CBAR", 1, np.c_[at, at + 1], 0.0, 0.0, 1.0)
    bulk.add("RBE2", 900, count + 1, 123456, count + 2, count + 3)
    bulk.add("CONM2", 901, count + 2, "", 10000.0)
    bulk.add("CONM2", 902, count + 3, "", 1000.0)
    bulk.fix("123456", 0)
    return bulk.deck(103, MODES)


def fv4() -> list[Row]:
    """Cantilever with off-center masses."""
    reference = [1.723, 1.727, 7.413, 9.972, 18.155, 26.957]
    hz = {n: run(off_center_masses(n))["modes/frequency_hz"] for n in (5, 10, 20)}
    rows = []
    for mode, theirs in enumerate(reference):
        found = [(f"{n} bars", values[mode]) for n, values in hz.items()]
        rows += convergence(
            "FV4 off-center masses",
            f"mode {mode + 1}, Hz",
            found,
            theirs,
            "NAFEMS R0015",
        )
    return rows


SIDE, LENGTH = 2.0, 10.0
AREA, INERTIA = SIDE**2, SIDE**4 / 12
TORSION = 2.2491  # Saint-Venant: 0.140577 side^4
SHEAR = 5.0 / 6.0


def deep_beam(count: int, *, rotary: bool = True) -> Bulk:
    """FV5 and 5T: 10 m long, 2 m square, pinned; shear factors, rotary inertia."""
    bulk = Bulk("PARAM,COUPMASS,1")
    _material(bulk)
    bulk.add("PBAR", 1, 1, AREA, INERTIA, INERTIA, TORSION)
    # Stresses at the corners; the last line holds the shear factors.
    bulk.lines[-1] += "\n+,1.,1.,1.,-1.,-1.,1.,-1.,-1."
    bulk.lines[-1] += f"\n+,{SHEAR:.10g},{SHEAR:.10g}"
    x = np.linspace(0.0, LENGTH, count + 1)
    bulk.grids(np.c_[x, 0 * x, 0 * x])
    at = np.arange(count)
    bulk.elements("CBAR", 1, np.c_[at, at + 1], 0.0, 1.0, 0.0)
    for grid in range(count + 1):
        share = RHO * INERTIA * LENGTH / count * (0.5 if grid in (0, count) else 1.0)
        bend = share if rotary else 0.0
        bulk.add("CONM2", 900 + grid, grid + 1, "", 0.0, *[""] * 4)
        bulk.lines[-1] += f"\n+,{2 * share:.10g},,{bend:.10g},,,{bend:.10g}"
    bulk.fix("1234", 0)
    bulk.fix("23", count)
    return bulk


def fv5() -> list[Row]:
    """Deep simply supported beam: bending in two planes, torsion, extension."""
    reference = [42.65, 42.65, 71.20, 125.0, 148.15, 148.15, 213.61, 283.47, 283.47]
    hz = {}
    for n in (5, 10, 20, 40):
        bulk = deep_beam(n)
        bulk.add("EIGRL", 9, "", "", 9)
        hz[f"{n} bars"] = run(bulk.deck(103, MODES))["modes/frequency_hz"]
    rows = []
    for mode, theirs in enumerate(reference):
        found = [(mesh, values[mode]) for mesh, values in hz.items()]
        rows += convergence(
            "FV5 deep beam", f"mode {mode + 1}, Hz", found, theirs, "NAFEMS R0015"
        )
    return rows


def deep_beam_step(count: int, sol: int, case: str) -> str:
    """5T: a uniform load of 1 MN/m that begins suddenly; Rayleigh damping."""
    bulk = deep_beam(count)
    bulk.add("PARAM", "ALPHA1", 5.36)
    bulk.add("PARAM", "ALPHA2", 7.46e-5)
    sudden(bulk, 400, 1e-4)
    for element in range(1, count + 1):
        bulk.add("PLOAD1", 20, element, "FY", "FR", 0.0, 1e6, 1.0, 1e6)
    return bulk.deck(sol, case)


STEP = "SPC = 1\nTSTEP = 7\nDLOAD = 5\nLOADSET = 6\nDISP = ALL\nSTRESS = ALL"


def sudden(bulk: Bulk, steps: int, size: float, stride: int = 1) -> None:
    """Static load set 20, constant from t = 0 on."""
    bulk.add("TSTEP", 7, steps, size, stride)
    bulk.add("LSEQ", 6, 21, 20)
    bulk.add("TLOAD1", 5, 21, "", "LOAD", 8)
    bulk.lines.append("TABLED1,8\n+,0.,1.,1000.,1.,ENDT")


def deep_beam_transient() -> list[Row]:
    """NAFEMS 5T: peak displacement, its time, peak stress, static displacement."""
    case, source = "NAFEMS 5T deep beam, step", "NAFEMS R0016"
    found: dict[str, list[tuple[str, float]]] = {
        k: [] for k in ("peak", "time", "stress", "static")
    }
    for n in (10, 20, 40):
        mesh = f"{n} bars"
        ours = run(deep_beam_step(n, 109, STEP))
        y = ours["transient/1/displacement"][:, n // 2, 1]
        time = ours["transient/1/time"]
        found["peak"].append((mesh, 1e3 * y.max()))
        found["time"].append((mesh, time[y.argmax()]))
        stress = ours.column("transient/1/element_stress/CBAR", "smaxb")
        found["stress"].append((mesh, 1e-6 * stress[:, n // 2 - 1].max()))
        rest = run(deep_beam_step(n, 101, "SPC = 1\nLOAD = 20"))
        found["static"].append((mesh, 1e3 * rest["static/1/displacement"][n // 2, 1]))
    return [
        *convergence(case, "peak displacement, mm", found["peak"], 1.043, source),
        *convergence(case, "time of it, s", found["time"], 0.0117, source),
        # Beam theory leaves out the load's own pressure: 3 % was the spread there.
        *convergence(
            case, "peak stress, N/mm²", found["stress"], 18.76, source, target=0.03
        ),
        *convergence(case, "static, mm", found["static"], 0.538, source),
    ]


def euler_cantilever() -> list[Row]:
    """Bending modes of a slender cantilever and of a free beam: formulas."""
    rows = []
    for name, roots, fixed in (
        ("cantilever", [1.8751041, 4.6940911, 7.8547574, 10.9955407, 14.1371684], True),
        ("free beam", [4.7300407, 7.8532046, 10.9956078, 14.1371655], False),
    ):
        found: dict[int, list[tuple[str, float]]] = {k: [] for k in range(len(roots))}
        for n in (8, 16, 32):
            bulk = Bulk("EIGRL,9,,,9\nPARAM,COUPMASS,1")
            _material(bulk)
            bulk.add("PBAR", 1, 1, 1e-4, 1e-9, 1e-9, 2e-9)
            x = np.linspace(0.0, 1.0, n + 1)
            bulk.grids(np.c_[x, 0 * x, 0 * x])
            at = np.arange(n)
            bulk.elements("CBAR", 1, np.c_[at, at + 1], 0.0, 1.0, 0.0)
            bulk.fix("1345", [*at.tolist(), n])
            if fixed:
                bulk.fix("26", 0)
            hz = run(bulk.deck(103, MODES))["modes/frequency_hz"]
            for k in found:
                found[k].append((f"{n} bars", hz[k + (0 if fixed else 2)]))
        unit = np.sqrt(E * 1e-9 / (RHO * 1e-4)) / (2 * np.pi)
        for k, root in enumerate(roots):
            rows += convergence(
                f"slender {name}",
                f"mode {k + 1}, Hz",
                found[k],
                unit * root**2,
                "closed form",
                target=1e-4,
            )
    return rows
