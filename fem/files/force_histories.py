"""Observers that write forces of constraint and grid point forces of a transient."""

import h5py
import scipy.sparse as sp

from fem.arrays import Float64
from fem.files.hdf5 import PointHistory, PointLayout
from fem.model.structure import Structure
from fem.recovery.constraint_forces import ResidualResponse, mpc_gather, spc_gather
from fem.recovery.grid_forces import GridBalance
from fem.response.observation import Chunk
from fem.response.system import TransientLoad


class LoadHistory:
    """Writes the applied loads at points; see `Observer`.

    Args:
        file, name: where to write.
        layout: at which points.
        load: on the g-set.
        case: load case.
    """

    def __init__(
        self,
        file: h5py.File,
        name: str,
        layout: PointLayout,
        load: TransientLoad,
        case: int,
    ) -> None:
        layout.describe(file, name)
        self._pattern = sp.csr_matrix(load.pattern)[layout.grid_dof]
        self._file, self._name, self._layout = file, name, layout
        self._load, self._case = load, case

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Write all of it: the loads are known before the response."""
        factors = self._load.factors(time)
        case = self._case if len(factors) > 1 else 0
        self._file[self._name] = self._layout.grids((self._pattern @ factors[case]).T)

    def observe(self, chunk: Chunk) -> None:
        """Nothing is left to do."""

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Nothing stays in memory."""
        return 0


def constraint_force_history(
    kind: str,
    file: h5py.File,
    name: str,
    layout: PointLayout,
    model: Structure,
    expand: sp.csr_matrix,
    load: TransientLoad,
    case: int,
) -> PointHistory:
    """Observer of forces of single-point ("spc") or multi-point ("mpc") constraints.

    Args:
        kind: "spc" or "mpc".
        file, name: where to write.
        layout: at which points.
        model: the structure.
        expand: (g, n) g-set from the freedoms of the transient.
        load: on the g-set.
        case: load case.
    """
    gather = (spc_gather if kind == "spc" else mpc_gather)(model.elimination)
    rows = sp.csr_matrix(gather[layout.dof])
    response = ResidualResponse(model, expand, load, case, rows)
    return PointHistory(file, name, layout, response)


class GridForceHistory:
    """Writes the grid point force balance; see `Observer`.

    Args:
        group: of the result file, with the description of the rows.
        balance: the rows.
        model, expand, load, case: as for `constraint_force_history`.
    """

    def __init__(
        self,
        group: h5py.Group,
        balance: GridBalance,
        model: Structure,
        expand: sp.csr_matrix,
        load: TransientLoad,
        case: int,
    ) -> None:
        grids = 6 * len(model.points.grid_id)
        self._group, self._balance = group, balance
        self._elements = sp.csr_matrix(balance.elements @ expand)
        self._pattern = sp.csr_matrix(load.pattern)[:grids]
        self._spc, self._mpc = (
            ResidualResponse(
                model,
                expand,
                load,
                case,
                sp.csr_matrix(gather(model.elimination)[:grids]),
            )
            for gather in (spc_gather, mpc_gather)
        )
        self._load, self._case = load, case
        self._force: h5py.Dataset | None = None

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Make the dataset."""
        shape = (len(time), len(self._balance.at), 6)
        self._force = self._group.create_dataset("force", shape, dtype="f8")

    def observe(self, chunk: Chunk) -> None:
        """Write a chunk."""
        factors = self._load.factors(chunk.time)
        case = self._case if len(factors) > 1 else 0
        force = self._balance.table(
            chunk.get("displacement", self._elements)[:, self._case],
            (self._pattern @ factors[case]).T,
            self._spc.values(chunk),
            self._mpc.values(chunk),
        )
        if self._force is not None:
            self._force[chunk.first : chunk.first + len(chunk.time)] = force

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Nothing stays in memory."""
        return 0
