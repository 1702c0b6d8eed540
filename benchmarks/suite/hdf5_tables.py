"""Result tables of HDF5 files that Nastran writes (MDLPRM,HDF5) under common names."""

from pathlib import Path

import h5py
import numpy as np

from benchmarks.suite.tables import POINTS, Name, Table, listed

_NODAL = {
    "DISPLACEMENT": "displacement",
    "SPC_FORCE": "SPC force",
    "MPC_FORCE": "MPC force",
}
_BUCKLING_ANALYSES = (7, 8)  # before buckling, after
_STATIC, _MODES = 1, 2
assert set(_NODAL.values()) <= set(POINTS.values())


def read_nastran_hdf5(path: Path) -> dict[Name, Table]:
    """Displacements, forces of constraint of statics, frequencies, load factors.

    Points that several superelements have are left out.

    Raises:
        ValueError: no file of Nastran's.
    """
    try:
        with h5py.File(path) as file:
            return _tables(file)
    except (OSError, KeyError) as error:
        raise ValueError(f"{path.name}: {error}") from None


def _tables(file: h5py.File) -> dict[Name, Table]:
    result = file["NASTRAN/RESULT"]
    if not isinstance(result, h5py.Group):
        raise KeyError("NASTRAN/RESULT is no group")
    domains = {row["ID"]: row for row in np.asarray(result["DOMAINS"])}
    found: dict[Name, Table] = {}
    for name, title in _NODAL.items():
        if f"NODAL/{name}" in result:
            found |= _points(np.asarray(result[f"NODAL/{name}"]), domains, title)
    if "SUMMARY/EIGENVALUE" in result:
        rows = np.asarray(result["SUMMARY/EIGENVALUE"])
        found |= _eigenvalues(rows, domains)
    return found


def _points(rows: np.ndarray, domains: dict, title: str) -> dict[Name, Table]:
    if "X" not in (rows.dtype.names or ()):
        return {}  # complex
    kept: dict[int, dict[int, list]] = {}
    for row in rows:
        domain = domains[row["DOMAIN_ID"]]
        if domain["ANALYSIS"] == _STATIC:
            own = kept.setdefault(int(domain["SUBCASE"]), {})
            own.setdefault(int(row["ID"]), []).append(
                [row[c] for c in ("X", "Y", "Z", "RX", "RY", "RZ")]
            )
    columns = ("t1", "t2", "t3", "r1", "r2", "r3")
    found = {}
    for case, values in kept.items():
        single = {point: own[0] for point, own in values.items() if len(own) == 1}
        if single:
            array = np.array([list(single.values())], float)
            found[title, case] = Table([(p, 1) for p in single], array, columns)
    return found


def _eigenvalues(rows: np.ndarray, domains: dict) -> dict[Name, Table]:
    """Of the residual structure, with which superelements are solved."""
    kept: dict[tuple[int, int], list] = {}
    for row in rows:
        domain = domains[row["DOMAIN_ID"]]
        if domain["SE"] == 0:
            key = int(domain["ANALYSIS"]), int(domain["SUBCASE"])
            kept.setdefault(key, []).append(row)
    found, buckling = {}, 0
    for (analysis, case), own in sorted(kept.items()):
        own = sorted(own, key=lambda row: row["MODE"])
        if analysis in _BUCKLING_ANALYSES:
            buckling += 1
            values = np.array([row["EIGEN"] for row in own], float)
            found["load factor", buckling] = listed(values)
        elif analysis == _MODES:
            values = np.array([row["FREQ"] for row in own], float)
            found["frequency", case] = listed(values)
    return found
