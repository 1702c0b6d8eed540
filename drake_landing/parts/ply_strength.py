"""How far laminates use the strengths of their plies and of their bonding.

Use is the factor by which all stresses of an element fall short of failure, inverted:
0.5 where twice the load would fail. It grows in proportion to the load, also under
Tsai-Wu's and Hoffman's theories with their linear terms (Nastran's strength ratio). The
largest of all plies holds, of

    MAT8 with Xt Xc Yt Yc S     by the theory of PCOMP's FT (`fem.properties.failure`),
                                else the largest stress over its strength
    MAT1 with ST, or any        von Mises, or the largest principal stress of MAT8,
    material with an allowable  over it; an allowable of the case comes before the deck
    of the case
    SB                          interlaminar shear stress over SB

Printed as a stress it is use times the allowable of the first ply that is judged (Xt of
MAT8), so that allowable over stress is what the element has in reserve.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from fem.deck.deck import Deck
from fem.elements.stress_measures import plane_von_mises
from fem.properties.elasticity import Elasticity, ElasticityTable
from fem.properties.failure import Strength, hill, max_strain, tsai_wu_parts

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PlyLimit:
    """What one ply is measured against: strengths, else a single stress.

    Attributes:
        material: id.
        isotropic: MAT1.
        allowed: Pa, NaN: none.
        strength: of MAT8, None: none, or `allowed` comes first.
        compliance: (3, 3) strains from stresses, ply axes.
    """

    material: int
    isotropic: bool
    allowed: float
    strength: Strength | None
    compliance: Float64 = field(repr=False)

    @property
    def reference(self) -> float:
        """Pa, the allowable that stands for the ply; NaN where it has none."""
        return self.strength.xt if self.strength is not None else self.allowed

    def use(self, stress: Float64, theory: str) -> Float64:
        """(...,) of stresses (..., 3) 11 22 12, Pa; 0 where nothing is known."""
        if self.strength is not None:
            return strength_use(stress, self.strength, theory, self.compliance)
        if np.isnan(self.allowed):
            return np.zeros(stress.shape[:-1])
        return _single(stress, self.isotropic) / self.allowed


@dataclass(frozen=True, kw_only=True)
class LaminateLimit:
    """What the plies of one PCOMP are measured against.

    Attributes:
        theory: of FT; "": largest stress.
        bond: SB, Pa; 0: none.
        plies: from the bottom.
    """

    theory: str
    bond: float
    plies: tuple[PlyLimit, ...]

    @property
    def judged(self) -> bool:
        """Whether there is more to it than isotropic plies."""
        orthotropic = [p for p in self.plies if not p.isotropic]
        return self.bond > 0.0 or any(p.reference > 0.0 for p in orthotropic)

    @property
    def reference(self) -> tuple[int, float]:
        """Material and allowable (Pa) that stand for the laminate."""
        for ply in self.plies:
            if ply.reference > 0.0:
                return ply.material, ply.reference
        return self.plies[0].material, self.bond if self.bond > 0.0 else np.nan

    def use(self, stress: Float64) -> Float64:
        """(...,) of ply stresses (..., p, 5) 11 22 12, and 1z 2z at the tops, Pa."""
        found = np.zeros(stress.shape[:-2])
        for k, ply in enumerate(self.plies):
            found = np.maximum(found, ply.use(stress[..., k, :3], self.theory))
        if self.bond > 0.0:
            shear = np.abs(stress[..., : len(self.plies), 3:]).max(axis=(-1, -2))
            found = np.maximum(found, shear / self.bond)
        return found


def laminate_limits(
    deck: Deck, allowables: Mapping[int, float]
) -> dict[int, LaminateLimit]:
    """Limits of all PCOMP of a deck whose plies have more than isotropic allowables.

    Args:
        deck: in SI.
        allowables: material id -> Pa, of the case.
    """
    if "PCOMP" not in deck.cards or deck.cards["PCOMP"].empty:
        return {}
    materials = ElasticityTable(deck)
    found = {}
    for row in deck.cards["PCOMP"].to_dict("records"):
        mids = [int(mid) for mid in row["mids"]]
        theory = str(row["ft"] or "").upper()
        plies = [_ply(materials[mid], allowables, theory) for mid in mids]
        if str(row["lam"] or "").upper().startswith("SY"):
            plies += plies[::-1]
        limit = LaminateLimit(
            theory=theory, bond=float(np.nan_to_num(row["sb"])), plies=tuple(plies)
        )
        if limit.judged:
            found[int(row["pid"])] = limit
    return found


def _ply(
    material: Elasticity, allowables: Mapping[int, float], theory: str
) -> PlyLimit:
    own = allowables.get(material.mid, np.nan)
    isotropic = material.card == "MAT1"
    strength = material.strength
    if isotropic and strength is not None and np.isnan(own) and strength.xt > 0.0:
        own = strength.xt
    whole = strength is not None and strength.suffices_for(
        "" if theory != "STRN" else theory
    )
    taken = strength if whole and not isotropic and np.isnan(own) else None
    plane = np.zeros((3, 3)) if material.plane is None else material.plane
    return PlyLimit(
        material=material.mid,
        isotropic=isotropic,
        allowed=own,
        strength=taken,
        compliance=np.linalg.pinv(plane, hermitian=True),
    )


def strength_use(
    stress: Float64, strength: Strength, theory: str, compliance: Float64
) -> Float64:
    """(...,) use of a MAT8 by stresses (..., 3) 11 22 12, see the head of the module.

    A theory a R² + b R = 1 of stresses times R has the use 1 / R, the larger root of
    u² - b u - a = 0.
    """
    if theory == "STRN":
        return max_strain(stress @ compliance.T, strength.strain)
    xt, xc, yt, yc, s = strength.xt, strength.xc, strength.yt, strength.yc, strength.s
    if theory in ("HOFF", "TSAI"):
        f12 = strength.f12 if theory == "TSAI" else -0.5 / (xt * xc)
        b, a = tsai_wu_parts(stress, xt, xc, yt, yc, s, f12)
        root: Float64 = 0.5 * (b + np.sqrt(np.maximum(b * b + 4.0 * a, 0.0)))
        return np.maximum(root, 0.0)
    if theory == "HILL":
        return np.sqrt(np.maximum(hill(stress, xt, xc, yt, yc, s), 0.0))
    return max_strain(stress, (xt, xc, yt, yc, s))


def _single(stress: Float64, isotropic: bool) -> Float64:
    """Von Mises, or the largest principal stress by magnitude."""
    xx, yy, xy = np.moveaxis(stress, -1, 0)
    if isotropic:
        return plane_von_mises(xx, yy, xy)
    return np.abs(0.5 * (xx + yy)) + np.hypot(0.5 * (xx - yy), xy)
