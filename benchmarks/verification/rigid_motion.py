"""Rigid-body motion gives no strain energy: each element type, in awkward shapes."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import fem
from benchmarks.verification.row import Row, figure
from fem.model.weight import rigid_modes

DECK = """\
SOL 101
CEND
BEGIN BULK
MAT1,1,7.+10,,.33,2700.
MAT8,8,1.4+11,9.+9,.3,5.+9,5.+9,3.+9,1600.
GRID,1,,0.1,0.2,-.1
GRID,2,,1.3,-.1,0.3
GRID,3,,1.1,1.2,-.2
GRID,4,,-.2,0.9,0.4
GRID,5,,0.2,0.1,1.1
GRID,6,,1.2,0.1,1.3
GRID,7,,1.2,1.1,1.0
GRID,8,,0.0,1.0,1.2
GRID,9,,0.6,0.5,2.3
GRID,11,,0.,0.,5.
GRID,12,,1.2,0.1,5.
GRID,13,,1.3,1.1,5.
GRID,14,,0.1,0.9,5.
GRID,15,,.7,0.,.25
GRID,16,,1.25,.5,.1
GRID,17,,.4,1.15,.2
GRID,18,,-.1,.5,.1
GRID,19,,.6,.5,.1
PSHELL,1,1,.02,1,,1
PSHELL,2,1,.05,1,,1
PCOMP,3,,,,,,,,+
+,8,.001,0.,YES,8,.001,45.,YES,+
+,8,.002,90.,YES
PSOLID,4,1
PBAR,5,1,1.-3,1.-6,2.-6,5.-7
PBEAM,6,1,1.-3,1.-6,2.-6,1.-7,5.-7,,+
+,,,,,,,,,+
+,NO,1.,5.-4,3.-7,6.-7,1.-8,2.-7,,+
+,.8,.8,,,,,,,+
+,,,,,.01,.02,.03,-.01
PROD,7,1,1.-3,1.-7
PTUBE,8,1,.05,.002
PBUSH,9,K,1.+6,2.+6,3.+6,1.+4,2.+4,3.+4
PSHEAR,10,1,.001,,1.,1.
PBEND,11,1,1.-3,1.-6,2.-6,5.-7,1.5
PBUSH1D,12,1.+6
PGAP,13,,,1.+6,,1.+5
PARAM,K6ROT,100.
CQUAD4,101,1,11,12,13,14
CQUAD4,102,1,1,2,3,4
CQUAD4,103,1,1,2,3,4,,.03
CQUAD4,104,2,1,2,3,4,,,+
+,,,.01,.02,.03,.02
CQUAD4,105,3,1,2,3,4,30.,-.02
CTRIA3,111,1,1,2,3
CTRIA3,112,1,1,2,3,,.03
CTRIA3,113,3,1,2,3,15.,.04
CQUADR,106,1,1,2,3,4,,.03
CQUADR,107,3,1,2,3,4,30.,-.02
CTRIAR,108,3,1,2,3,15.,.04
CQUAD8,114,1,1,2,3,4,15,16,+
+,17,18
CQUAD8,115,3,1,2,3,4,15,16,+
+,17,18,,,,,30.,-.02
CTRIA6,116,1,1,2,4,15,9,18,+
+,,.03
CHEXA,121,4,1,2,3,4,5,6,+
+,7,8
CPENTA,122,4,1,2,3,5,6,7
CTETRA,123,4,1,2,3,5
CPYRAM,124,4,5,6,7,8,9
CBAR,131,5,1,7,0.,1.,0.
CBAR,132,5,1,7,0.,1.,0.,,+
+,,,.1,.2,.3,-.1,.2,.1
CBAR,133,5,1,7,0.,1.,0.,,+
+,5,46,.1,.2,.3,-.1,.2,.1
CBEAM,134,6,1,7,0.,1.,0.,,+
+,,,.1,.2,.3,-.1,.2,.1
CBEND,135,11,1,7,0.,1.,0.,3
CBUSH1D,136,12,1,7
CGAP,137,13,1,7,0.,1.,0.
CROD,141,7,1,7
CONROD,142,1,7,1,1.-3,1.-7
CTUBE,143,8,1,7
CBUSH,144,9,1,7,0.,1.,0.
CSHEAR,151,10,1,2,3,4
PFAST,14,.1,,,1.+6,2.+6,3.+6,1.+4,+
+,2.+4,3.+4
PWELD,15,1,.1
CFAST,161,14,ELEM,101,102,,,,+
+,.6,.5,.1
CWELD,162,15,19,ELEMID,,,,,+
+,101,102
CWELD,163,15,,ALIGN,1,7
ENDDATA
"""

_WHAT = {
    101: "flat", 102: "warped", 103: "warped, offset", 104: "warped, tapered thickness",
    105: "warped, composite, offset", 106: "warped, offset",
    107: "warped, composite, offset", 108: "composite, offset",
    114: "curved", 115: "curved, composite, offset",
    116: "curved, offset",
    112: "offset", 113: "composite, offset",
    132: "offset", 133: "offset, pinned", 134: "tapered, offset, shear center offset",
    151: "warped", 161: "ELEM", 162: "ELEMID", 163: "ALIGN",
}  # fmt: skip


def rigid_motions(seed: int = 3) -> list[Row]:
    """Energy of random rigid motions over that of its terms, for each element."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "elements.bdf"
        path.write_text(DECK)
        structure = fem.Structure.from_deck(fem.read_deck(path))
    motions = rigid_modes(structure.points, np.array([0.5, 0.5, 0.5]))
    random = np.random.default_rng(seed).normal(size=(6, 20))
    motions = np.hstack([motions, motions @ random])
    rows = []
    for block in structure.blocks:
        stiffness = block.stiffness()
        if stiffness is None:
            continue
        for i, element in enumerate(block.id):
            u, k = motions[block.dof[i]], stiffness[i]
            energy = np.abs(np.einsum("im,ij,jm->m", u, k, u))
            terms = np.einsum("im,ij,jm->m", np.abs(u), np.abs(k), np.abs(u))
            what = _WHAT.get(int(element), "")
            name = f"{block.card}, {what}" if what else block.card
            rows.append(
                figure(
                    "rigid motion",
                    f"{name}: energy over that of its terms",
                    float((energy / np.maximum(terms, 1e-300)).max()),
                    0.0,
                    "exact",
                    target=1e-10,
                )
            )
    return rows
