"""PSHELL, PCOMP and PCOMPG: sections of shells in material axes, per property.

Blank material ids have Nastran's meaning: no MID1, no membrane stiffness; no MID2, no
bending; no MID3, rigid in transverse shear; no MID4, no membrane-bending coupling.
MID2 = -1 is plane strain. Nastran's M has the opposite sign of this module's
M = int sigma z dz, hence B = -T^2 G4.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.references import table, where
from fem.errors import InputError, Problems
from fem.properties.elasticity import ElasticityTable
from fem.properties.failure import Failure
from fem.properties.laminate import Laminate
from fem.properties.shell_expansion import (
    NO_EXPANSION,
    ShellExpansion,
    of_laminate,
    of_section,
)
from fem.properties.shell_section import (
    ShellSection,
    plate_flexibility,
    turned_flexibility,
    turned_stiffness,
)

if TYPE_CHECKING:
    from fem.deck.deck import Deck

PLATE = ("MAT1", "MAT2", "MAT8")
LAMS = ("", "SYM", "MEM", "BEND", "SMEAR", "SYMEM", "SYBEND", "SYSMEAR")


@dataclass(frozen=True, kw_only=True)
class ShellProperty:
    """One property in material axes; PSHELL per unit of thickness (`nominal` 1).

    Attributes:
        card, pid: identification.
        membrane, coupling, bending: (3, 3) A, B, D at the nominal thickness.
        shear_flexibility: (2, 2) at the nominal thickness.
        nominal: thickness that the matrices belong to.
        thickness: T of the card, NaN where the elements must give it.
        inertia_ratio: 12 I / T^3.
        fibre: (2,) Z1, Z2; NaN: half the thickness below and above.
        density: structural mass per area at the nominal thickness.
        nsm: non-structural mass per area.
        mass_height: height of the structural mass above the reference surface.
        ge: structural damping coefficient.
        laminate: the plies, None for PSHELL.
        ply_id: (p,) numbers of the plies.
        expansion: under temperatures.
        tref: temperature without strain; NaN: blank.
        failure: what FT and SB measure the plies against, None: nothing.
    """

    card: str
    pid: int
    membrane: Float64
    coupling: Float64
    bending: Float64
    shear_flexibility: Float64
    nominal: float
    thickness: float
    inertia_ratio: float
    fibre: Float64
    density: float
    nsm: float
    mass_height: float
    ge: float
    laminate: Laminate | None = None
    ply_id: Int64 | None = None
    failure: Failure | None = None
    expansion: ShellExpansion = NO_EXPANSION
    tref: float = 0.0

    @property
    def isotropic(self) -> bool:
        """Whether the section is the same in all directions of its plane."""
        parts = (self.membrane, self.coupling, self.bending)
        size = max(np.abs(part).max() for part in parts)
        flat = np.diff(np.diag(self.shear_flexibility))[0] == 0.0
        return bool(
            self.laminate is None
            and flat
            and self.shear_flexibility[0, 1] == 0.0
            and all(
                np.abs(part[:2, 2]).max() <= 1e-12 * size
                and abs(part[0, 0] - part[1, 1]) <= 1e-12 * size
                and abs(part[0, 0] - part[0, 1] - 2.0 * part[2, 2]) <= 1e-12 * size
                for part in parts
            )
        )

    def ply_map(self, *, strain: bool = False) -> Float64:
        """(p, 5, 8) ply results of a laminate from resultants, see `Laminate.recovery`.

        Without a laminate an error of the program.
        """
        assert self.laminate is not None
        one = np.s_[None]
        flexible = plate_flexibility(
            self.membrane[one], self.coupling[one], self.bending[one]
        )
        return self.laminate.recovery(flexible[0], strain=strain)


def read_shell_properties(
    deck: "Deck", pids: Iterable[int]
) -> dict[int, ShellProperty]:
    """The properties of these ids, as far as the deck defines them as shells.

    Raises:
        InputError: everything that is wrong with them, materials included.
    """
    wanted = set(pids)
    materials = ElasticityTable(deck)
    properties: dict[int, ShellProperty] = {}
    problems = Problems()
    for card, make in (("PSHELL", _pshell), ("PCOMP", _pcomp)):
        for _, row in table(deck, card).iterrows():
            if int(row["pid"]) not in wanted:
                continue
            with problems.gathered():
                properties[int(row["pid"])] = make(row, materials)
    problems.report()
    return properties


def _check(problems: Iterable[str | None]) -> None:
    found = [p for p in problems if p]
    if found:
        raise InputError(found)


def _pshell(row: pd.Series, materials: ElasticityTable) -> ShellProperty:
    name = where("PSHELL", row)
    mids = {k: int(row[k]) for k in ("mid1", "mid2", "mid3", "mid4")}
    plane_strain = mids["mid2"] == -1
    if plane_strain:
        mids["mid2"] = 0
    _check(materials.problem(m, PLATE, name) for m in mids.values() if m)
    if not mids["mid1"] and not mids["mid2"]:
        raise InputError(f"{name}: MID1 and MID2 are both blank, expected one of them")
    if mids["mid4"] and mids["mid4"] in (mids["mid1"], mids["mid2"]):
        raise InputError(
            f"{name}: MID4 {mids['mid4']} is also MID1 or MID2, expected another"
        )

    def plane(mid: int) -> Float64:
        found = materials[mid].plane if mid else None
        return np.zeros((3, 3)) if found is None else found

    ratio, shear_ratio = float(row["bk"]), float(row["tst"])
    if not (ratio > 0.0 and shear_ratio > 0.0):
        raise InputError(
            f"{name}: 12I/T**3 {ratio:g} and TS/T {shear_ratio:g}, expected positive"
        )
    flexibility = np.zeros((2, 2))
    if mids["mid2"] and mids["mid3"]:
        flexibility = materials[mids["mid3"]].shear_flexibility / shear_ratio
    first = materials[mids["mid1"] or mids["mid2"]]
    membrane = plane(mids["mid1"])
    if plane_strain:
        membrane = _plane_strain(membrane, name)
    matrices = (membrane, -plane(mids["mid4"]), ratio / 12.0 * plane(mids["mid2"]))
    return ShellProperty(
        card="PSHELL",
        pid=int(row["pid"]),
        membrane=matrices[0],
        coupling=matrices[1],
        bending=matrices[2],
        shear_flexibility=flexibility,
        nominal=1.0,
        thickness=float(row["t"]),
        inertia_ratio=ratio,
        fibre=np.array([row["z1"], row["z2"]], float),
        expansion=of_section(
            matrices,
            *(
                materials[mids[k]].plane_alpha if mids[k] else np.zeros(3)
                for k in ("mid1", "mid2")
            ),
        ),
        tref=first.tref,
        density=first.rho,
        nsm=float(np.nan_to_num(float(row["nsm"]))),
        mass_height=0.0,
        ge=first.ge,
    )


def _plane_strain(stress: Float64, name: str) -> Float64:
    """Plane strain from isotropic plane stress stiffness."""
    nu = stress[0, 1] / stress[0, 0]
    if not np.isclose(stress[2, 2], 0.5 * (1.0 - nu) * stress[0, 0]):
        raise InputError(f"{name}: MID2 -1 (plane strain), expected MID1 to be a MAT1")
    return _strain_matrix(stress[0, 0] * (1.0 - nu * nu), nu)


def _strain_matrix(e: float, nu: float) -> Float64:
    factor = e / ((1.0 + nu) * (1.0 - 2.0 * nu))
    return factor * np.array(
        [[1.0 - nu, nu, 0.0], [nu, 1.0 - nu, 0.0], [0.0, 0.0, 0.5 - nu]]
    )


def _pcomp(row: pd.Series, materials: ElasticityTable) -> ShellProperty:
    name = where("PCOMP", row)
    lam = str(row["lam"] or "").upper()
    if lam not in LAMS:
        raise InputError(
            f"{name}: LAM '{lam}' is not supported, expected blank or one of "
            + ", ".join(LAMS[1:])
        )
    mids = np.array(row["mids"], dtype=np.int64)
    _check(materials.problem(int(m), PLATE, name) for m in dict.fromkeys(mids))
    symmetric = lam.startswith("SY")
    order = np.concatenate([mids, mids[::-1]]) if symmetric else mids
    laminate = _stack(row, materials, symmetric=symmetric)
    a, b, d = laminate.stiffness()
    shear = laminate.transverse_flexibility()
    if lam.endswith(("SMEAR", "BEND")):
        # The PSHELL that stands for it has no MID3.
        shear = 0.0 * shear
    if lam.endswith("SMEAR"):
        b, d = 0.0 * b, a * laminate.total**2 / 12.0
    elif lam.endswith("MEM"):
        b, d = 0.0 * b, 0.0 * d
    elif lam.endswith("BEND"):
        a, b = 0.0 * a, 0.0 * b
    plies = np.asarray(row["plies"], dtype=np.int64)
    if len(laminate.thickness) > len(plies):
        plies = np.arange(1, len(laminate.thickness) + 1)
    mean_rho = float(laminate.rho @ laminate.thickness)
    return ShellProperty(
        card="PCOMP",
        pid=int(row["pid"]),
        membrane=a,
        coupling=b,
        bending=d,
        shear_flexibility=shear,
        nominal=laminate.total,
        thickness=laminate.total,
        inertia_ratio=1.0,
        fibre=np.array([laminate.z0, laminate.z0 + laminate.total]),
        density=mean_rho,
        nsm=float(np.nan_to_num(float(row["nsm"]))),
        mass_height=laminate.mass_height(),
        ge=float(np.nan_to_num(float(row["ge"]))),
        laminate=laminate,
        expansion=of_laminate(
            laminate,
            (a, b, d),
            np.stack([materials[int(mid)].plane_alpha for mid in order]),
        ),
        tref=float(row["tref"]),
        ply_id=plies,
        failure=_failure(row, materials, symmetric=symmetric),
    )


def _failure(
    row: pd.Series, materials: ElasticityTable, *, symmetric: bool
) -> Failure | None:
    """What FT and SB ask for; a theory holds where all plies have their strengths."""
    theory, bond = str(row["ft"] or "").upper(), float(np.nan_to_num(row["sb"]))
    if theory and _without_strength(row, materials, theory):
        theory = ""
    if not theory and not bond > 0.0:
        return None
    found = [materials[int(mid)].strength for mid in np.asarray(row["mids"])]
    plies = [strength for strength in found if strength is not None]
    plies = plies + plies[::-1] if symmetric else plies
    return Failure(theory=theory, plies=tuple(plies), bond=bond)


def _without_strength(
    row: pd.Series, materials: ElasticityTable, theory: str
) -> list[int]:
    """Materials of a PCOMP that lack what its failure theory needs."""
    strengths = {int(mid): materials[int(mid)].strength for mid in row["mids"]}
    return [
        mid for mid, s in strengths.items() if s is None or not s.suffices_for(theory)
    ]


def strength_notices(deck: "Deck") -> list[str]:
    """Failure theories of PCOMP without the strengths that they need."""
    notices, materials = [], ElasticityTable(deck)
    for _, row in table(deck, "PCOMP").iterrows():
        theory = str(row["ft"] or "").upper()
        lacking = _without_strength(row, materials, theory) if theory else []
        if lacking:
            notices.append(
                f"{where('PCOMP', row)}: FT {theory}: no failure indices of the plies: "
                f"no strengths for it in material {', '.join(map(str, lacking))}"
            )
    return notices


def _stack(row: pd.Series, materials: ElasticityTable, *, symmetric: bool) -> Laminate:
    order = np.arange(len(row["mids"]))
    if symmetric:
        order = np.concatenate([order, order[::-1]])
    used = [materials[int(m)] for m in np.asarray(row["mids"])[order]]
    return Laminate(
        z0=float(row["z0"]),
        thickness=np.asarray(row["ts"], float)[order],
        angle=np.radians(np.asarray(row["thetas"], float)[order]),
        plane=np.stack([m.plane for m in used]),
        shear_flexibility=np.stack(
            [
                # A MAT2 ply has no transverse shear data: rigid.
                np.zeros((2, 2)) if m.card == "MAT2" else m.shear_flexibility
                for m in used
            ]
        ),
        rho=np.array([m.rho for m in used]),
    )


def sections(
    properties: list[ShellProperty],
    index: Int64,
    angle: Float64,
    corner_thickness: Float64,
) -> ShellSection:
    """Sections of elements in element axes.

    Args:
        properties: properties in use.
        index: (e,) property of each element.
        angle: (e,) rad, from the element x axis to the material x axis.
        corner_thickness: (e, n), no NaN.
    """

    def each(name: str) -> Float64:
        return np.array([getattr(p, name) for p in properties], float)[index]

    mean = corner_thickness.mean(axis=1)
    ratio = mean / each("nominal")
    tapered = np.ptp(corner_thickness, axis=1) > 1e-12 * mean
    half = 0.5 * mean[:, None] * np.array([-1.0, 1.0])
    fibre = each("fibre")
    scale = ratio[:, None, None]
    return ShellSection(
        membrane=scale * turned_stiffness(each("membrane"), angle),
        coupling=scale**2 * turned_stiffness(each("coupling"), angle),
        bending=scale**3 * turned_stiffness(each("bending"), angle),
        shear_flexibility=turned_flexibility(each("shear_flexibility"), angle) / scale,
        thickness=mean,
        taper=corner_thickness / mean[:, None] if tapered.any() else None,
        inertia=each("inertia_ratio") * mean**3 / 12.0,
        fibre=np.where(np.isnan(fibre), half, fibre),
        density=each("density") * ratio,
        nonstructural=each("nsm"),
        mass_height=each("mass_height"),
        ge=each("ge"),
    )
