"""Temperatures: Timoshenko's bimetal."""

import numpy as np

from benchmarks.verification.mesh import Bulk, rectangle
from benchmarks.verification.row import Row, figure
from benchmarks.verification.runner import run

_T1, _T2, _E1, _E2, _A1, _A2 = 0.004, 0.006, 2e11, 7e10, 1.2e-5, 2.4e-5
_NU, _HEAT, _SIDE = 0.3, 100.0, 0.8
_BOOK = "Timoshenko, J. Opt. Soc. Am. 11, 1925, as a plate"


def _bimetal_exact() -> tuple[float, float]:
    """Curvature, and the stress in the middle of the first layer."""
    m, n, h = _T1 / _T2, _E1 / _E2, _T1 + _T2
    square = (1.0 + m) ** 2
    curved = 6.0 * (_A2 - _A1) * _HEAT * square
    curved /= h * (3.0 * square + (1.0 + m * n) * (m**2 + 1.0 / (m * n)))
    stiff = (_E1 * _T1**3 + _E2 * _T2**3) / 12.0
    return curved, 2.0 * stiff * curved / h / _T1 / (1.0 - _NU)


def bimetal_plate() -> list[Row]:
    """A free plate of two layers 100 degrees warmer, of CQUAD4 and CTRIA3."""
    curvature, stress = _bimetal_exact()
    rows = []
    for card in ("CQUAD4", "CTRIA3"):
        xy, conn = rectangle(4, 4)
        if card == "CTRIA3":
            conn = np.concatenate([conn[:, [0, 1, 2]], conn[:, [0, 2, 3]]])
        bulk = Bulk(f"PCOMP,1,,,,,20.\n+,1,{_T1},0.,YES,2,{_T2},0.,YES")
        for mid, e, a in ((1, _E1, _A1), (2, _E2, _A2)):
            bulk.add("MAT1", mid, e, "", _NU, "", a)
        bulk.grids(np.c_[_SIDE * xy, np.zeros(len(xy))])
        bulk.elements(card, 1, conn)
        bulk.fix("123456", [0])
        bulk.add("TEMPD", 4, 20.0 + _HEAT)
        found = run(bulk.deck(101, "SPC = 1\nTEMP(LOAD) = 4\nSTRESS = ALL"))
        corner = found["static/1/displacement"][-1, 2]
        table = f"static/1/element_stress/{card}_COMPOSITE"
        rows += [
            figure(
                f"bimetal plate, {card}",
                "deflection of the far corner",
                float(corner),
                -curvature * _SIDE**2,
                _BOOK,
            ),
            figure(
                f"bimetal plate, {card}",
                "stress in the middle of the lower layer",
                float(found.column(table, "o11_p1").mean()),
                stress,
                _BOOK,
            ),
        ]
    return rows
