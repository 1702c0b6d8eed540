"""Masses of CBAR and CBEAM against commercial Nastran, frequency by frequency.

A cantilever of 1 m, turned by 30 degrees about its axis, in 30 elements: shear centers
off the grids by WA and WB, the section tapered to half its size, the neutral axis and
non-structural mass off the shear center. BARMASS gives CBAR torsional inertia.
"""

from benchmarks.verification.mesh import Bulk
from benchmarks.verification.row import Row, listed
from benchmarks.verification.runner import run

_SOURCE = (
    "commercial Nastran with BARMASS=1, results of TACS's comparison of beams (branch "
    "NastranCompat)"
)
_ELEMENTS = 30
# Section at the clamped end: area, I1, I2, J.
_A, _I1, _I2, _J = 0.01, 2.0833e-6, 3.3333e-5, 7.0213e-6
# Printed properties have five digits.
_DIGITS = 2e-5

_BARS = [28.805012084, 112.63811615, 178.87927929, 344.79613531, 493.74006230]
_BARS += [623.25106196, 893.06083262, 948.24440298, 1035.3339157, 1506.6921994]
_NEUTRAL = [37.831621366, 99.681357142, 172.24250974, 175.28122697, 245.89240407]
_NEUTRAL += [318.31625232, 391.69536680, 465.19996158, 539.66186196, 613.25567720]
_ALL = [23.068485738, 70.100046046, 87.792734223, 132.32712442, 169.86644058]
_ALL += [197.38342849, 237.80966800, 260.35931867, 313.81588544, 373.75582358]


def _cantilever() -> Bulk:
    bulk = Bulk()
    bulk.add("MAT1", 1, 7.17e10, "", 0.33, 2810.0)
    for i in range(_ELEMENTS + 1):
        bulk.add("GRID", i + 1, "", i / _ELEMENTS, 0.0, 0.0)
    bulk.add("SPC1", 100, 123456, 1)
    return bulk


def _element(bulk: Bulk, card: str, i: int, pid: int) -> None:
    offset = [0.0, 0.1, 0.4]
    bulk.add(card, i, pid, i, i + 1, 0.0, 0.8660254, 0.5, "", "", "", *offset, *offset)


def _bars() -> Bulk:
    bulk = _cantilever()
    bulk.add("PBAR", 1, 1, _A, _I1, _I2, _J, 28.1, *[""] * 9, 5 / 6, 5 / 6)
    for i in range(1, _ELEMENTS + 1):
        _element(bulk, "CBAR", i, 1)
    return bulk


def _beams(*, nsm: bool) -> Bulk:
    bulk = _cantilever()
    off, mass = (0.1, 0.4), 28.1 if nsm else 0.0
    center = (0.05, 0.2) if nsm else (0.0, 0.0)
    for i in range(1, _ELEMENTS + 1):
        ends = []
        for x in ((i - 1) / _ELEMENTS, i / _ELEMENTS):
            s = 1.0 - 0.5 * x
            section = [_A * s**2, _I1 * s**4, _I2 * s**4, 0.0, _J * s**4, mass]
            ends.append(section)
        first, second = ends
        bulk.add(
            *("PBEAM", i, 1, *first, *[""] * 8),
            *("NO", 1.0, *second),  # no stress points at an end without output
            *(5 / 6, 5 / 6, "", "", "", "", "", ""),
            *(*center, *center, *off, *off),
        )
        _element(bulk, "CBEAM", i, i)
    return bulk


def masses_of_beams() -> list[Row]:
    """The ten lowest frequencies of each cantilever."""
    kinds = {
        "CBAR with BARMASS and NSM": (_bars(), _BARS),
        "tapered CBEAM, neutral axis off": (_beams(nsm=False), _NEUTRAL),
        "the same with NSM off": (_beams(nsm=True), _ALL),
    }
    rows = []
    for name, (bulk, theirs) in kinds.items():
        bulk.add("PARAM", "COUPMASS", 1)
        bulk.add("EIGRL", 1, "", "", 10)
        text = "NASTRAN BARMASS=1\n" + bulk.deck(103, "SPC = 100\nMETHOD = 1\n")
        ours = run(text)["modes/frequency_hz"][:10]
        rows.append(
            listed(name, "frequencies, Hz", ours, theirs, _SOURCE, target=_DIGITS)
        )
    return rows
