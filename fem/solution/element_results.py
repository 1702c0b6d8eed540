"""Results of elements and grid point forces of displacements, as a subcase asks.

Statics, modes and buckling have them in common.
"""

from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.files.hdf5 import ResultFile
from fem.loads.element_loads import ElementLoads
from fem.loads.thermal import FreeMotions
from fem.model.structure import Structure
from fem.recovery.elements import element_tables, loaded_bar_tables, station_tables
from fem.recovery.grid_forces import grid_balance, grids_of
from fem.solution.requests import ELEMENT_RESULTS, detail_of, ids_of, wanted


def write_grid_forces(
    model: Structure,
    subcase: Subcase,
    u_g: Float64,
    forces: tuple[Float64, Float64, Float64],
    results: ResultFile,
    name: str,
) -> None:
    """Grid point force balance of k displacement vectors.

    Args:
        model: the structure.
        subcase: its GPFORCE request.
        u_g: (g, k).
        forces: applied, of SPC and of MPC, each (g, k).
        results, name: where to write; (n, 6) for one vector, (k, n, 6) for several.
    """
    points = model.points
    loaded, spc, mpc = (grids_of(points, vector) for vector in forces)
    balance = grid_balance(
        points,
        model.blocks,
        loaded=loaded,
        spc=spc,
        mpc=mpc,
        wanted=ids_of(wanted(subcase, "GPFORCE")),
    )
    grids = 6 * len(points.grid_id)
    parts = (vector[:grids].T for vector in forces)
    force = balance.table((balance.elements @ u_g).T, *parts)
    group = results.grid_force_group(f"{name}/grid_point_force", balance)
    group["force"] = force[0] if len(force) == 1 else force


def write_element_results(
    model: Structure,
    subcase: Subcase,
    u_g: Float64,
    results: ResultFile,
    name: str,
    loads: ElementLoads | None = None,
    free: FreeMotions | None = None,
) -> None:
    """Forces, stresses and strains that a subcase asks for.

    Args:
        model: the structure.
        subcase: its requests.
        u_g: (g,) displacements, or (g, k) for k sets of results.
        results, name: where to write.
        loads: loads on elements between their grids.
        free: what elements do that nothing hinders (temperatures).
    """
    detail = detail_of(model.deck, subcase)
    for quantity, kind in ELEMENT_RESULTS:
        tables = element_tables(
            model.points,
            model.blocks,
            kind,
            wanted(subcase, quantity),
            detail=detail,
            loads=loads,
            free=free,
        )
        chosen = wanted(subcase, quantity)
        tables += station_tables(model.points, model.blocks, kind, chosen, loads, free)
        if kind == "force":
            tables += loaded_bar_tables(model.points, model.blocks, chosen, loads, free)
        for table in tables:
            results.write_table(f"{name}/element_{kind}", table, table.of(u_g))
