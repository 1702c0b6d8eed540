"""Results that only transients have, and loads between the ends of bars."""

import h5py
import numpy as np
import pytest

import fem
from fem.solution import run_deck

E, A, I1, I2, L = 7e10, 0.02, 3e-5, 2e-5, 2.0
BAR = f"PBAR,1,1,{A},{I1},{I2},4.-5\nMAT1,1,7.+10,,.3,2700.\n"


@pytest.fixture
def run(tmp_path):
    """Function from case control and bulk data to the datasets of a run."""

    def go(sol, case, bulk, **options):
        path = tmp_path / "model.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}\nBEGIN BULK\n{bulk}\nENDDATA\n")
        out = run_deck(
            fem.read_deck(path), tmp_path / "model.h5", fem.Options(**options)
        )
        found = {}
        with h5py.File(out) as file:
            file.visititems(
                lambda name, item: found.update(
                    {name: item[()]} if isinstance(item, h5py.Dataset) else {}
                )
            )
        return found

    return go


def clamped(element: str) -> str:
    """One element between clamped grids under a uniform load of 1000 along y."""
    prop = BAR
    if element == "CBEAM":
        prop = f"PBEAM,1,1,{A},{I1},{I2},,4.-5\nMAT1,1,7.+10,,.3,2700.\n"
    return (
        f"{prop}GRID,1\nGRID,2,,{L}\n{element},1,1,1,2,0.,1.,0.\n"
        "SPC1,1,123456,1,2\nPLOAD1,1,1,FY,FR,0.,1000.,1.,1000.\n"
        "GRID,3,,0.,1.\nCELAS2,9,1.,3,1\nCMASS2,8,1.,3,1\nSPC1,1,23456,3\n"
    )


@pytest.mark.parametrize("element", ["CBAR", "CBEAM"])
def test_clamped_beam_under_uniform_load(run, element):
    """End moments q L² / 12, shear q L / 2; the load leaves no displacement."""
    found = run(101, "SPC=1\nLOAD=1\nFORCE=ALL\nSTRESS=ALL", clamped(element))
    force = found[f"static/1/element_force/{element}/value"][0]
    moment, shear = 1000.0 * L**2 / 12.0, 1000.0 * L / 2.0
    if element == "CBAR":
        ends = found["static/1/element_force/CBAR_ENDS/value"][0].reshape(2, 6)
        assert force[4] == pytest.approx(ends[0, 2])
    else:
        ends = force.reshape(2, 7)[:, :6]
    np.testing.assert_allclose(np.abs(ends[:, 0]), moment)
    assert ends[0, 0] == pytest.approx(ends[1, 0])
    np.testing.assert_allclose(
        ends[:, 2], np.array([-shear, shear]) * np.sign(ends[1, 2])
    )
    # Equilibrium of the element: the shear falls by the load.
    assert abs(ends[1, 2] - ends[0, 2]) == pytest.approx(1000.0 * L)


@pytest.mark.parametrize("pins", ["", "5", "6"])
def test_one_loaded_bar_gives_the_end_forces_of_twenty(run, pins):
    """A propped, pinned or clamped bar, offset, under a partial load."""
    n = 20
    tail = f",{pins},,,.1,.2,,.1,.2\n" if pins else ",,,,.1,.2,,.1,.2\n"
    one = BAR + f"GRID,1\nGRID,2,,{L}\nCBAR,1,1,1,2,0.,1.,0.\n{tail}"
    one += "SPC1,1,123456,1\nSPC1,1,23,2\nPLOAD1,1,1,FZ,FR,0.2,50.,0.7,90.\n"
    case = "SPC=1\nLOAD=1\nFORCE=ALL\nSTRESS=ALL\nGPFORCE=ALL"
    short = run(101, case, one)["static/1/element_force/CBAR_ENDS/value"][0]
    many = BAR + f"GRID,1\nGRID,{n + 1},,{L}\nSPC1,1,123456,1\nSPC1,1,23,{n + 1}\n"
    for k in range(1, n):
        many += f"GRID,{k + 1},,{k * L / n:.3f},.1,.2\n"
    for k in range(n):
        first = ",,.1,.2" if k == 0 else ",,,"
        last = ",,.1,.2" if k == n - 1 else ""
        many += f"CBAR,{k + 1},1,{k + 1},{k + 2},0.,1.,0.\n"
        many += f",{pins if k == 0 else ''},{first}{last}\n"
        a, b = max(k / n, 0.2), min((k + 1) / n, 0.7)
        if b > a + 1e-9:
            p, q = (50.0 + (x - 0.2) / 0.5 * 40.0 for x in (a, b))
            x, y = a * n - k, b * n - k
            many += f"PLOAD1,1,{k + 1},FZ,FR,{x:.5f},{p:.5f},{y:.5f},{q:.5f}\n"
    found = run(101, case, many)
    bars = found["static/1/element_force/CBAR/value"]
    scale = np.abs(bars).max()
    np.testing.assert_allclose(
        short[:6], bars[0][[0, 1, 4, 5, 6, 7]], atol=2e-6 * scale
    )
    np.testing.assert_allclose(short[[6, 7]], bars[-1][[2, 3]], atol=2e-6 * scale)


STEPS = "TSTEP,1,200,1.-3,10\nTLOAD1,5,1,,,7\nTABLED1,7\n,0.,0.,.1,1.,10.,1.,ENDT\n"


def test_bar_results_under_a_load_that_grows(run):
    """The shear falls along the bar by q L f(t); left out on request."""
    case = "SPC=1\nTSTEP=1\nDLOAD=5\nFORCE=ALL\nSTRESS=ALL"
    found = run(109, case, clamped("CBAR") + STEPS, envelope=True)
    ends = found["transient/1/element_force/CBAR_ENDS/value"][:, 0].reshape(-1, 2, 6)
    factor = np.minimum(found["transient/1/time"] / 0.1, 1.0)
    np.testing.assert_allclose(
        np.abs(ends[:, 1, 2] - ends[:, 0, 2]), 1000.0 * L * factor, atol=1e-9
    )
    moment = found["transient/1/element_force/CBAR/value"][:, 0, 0]
    np.testing.assert_allclose(np.abs(moment), 1000.0 * L**2 / 12 * factor, atol=1e-9)
    group = "transient/1/envelope/force/CBAR"
    extremes = found[f"{group}/min"][0, 0], found[f"{group}/max"][0, 0]
    assert max(map(abs, extremes)) == pytest.approx(1000.0 * L**2 / 12)
    plain = run(109, case, clamped("CBAR") + STEPS, bar_loads=False)
    assert np.all(plain["transient/1/element_force/CBAR/value"] == 0.0)
    assert "transient/1/element_force/CBAR_ENDS/value" not in plain


def test_nx_counts_pload1_at_the_stations_of_cbarao(references, tmp_path):
    """Strains of tst1d3 at both ends of the bar, half a step of NX's P(t) apart."""
    from pyNastran.op2.op2 import read_op2

    folder = references / "transient_1d"
    op2 = read_op2(
        str(folder / "tst1d3.op2"), build_dataframe=False, debug=None, log=None
    )
    table = op2.op2_results.strain.cbar_strain_10nodes[10].data[-1].astype(float)
    deck = fem.read_deck(folder / "tst1d3.bdf", ignore=["CBEND", "PBEND"])
    with h5py.File(run_deck(deck, tmp_path / "a.h5")) as file:
        group = file["transient/10/element_strain"]
        bar = group["CBAR/value"][-1, 0]
        spring = group["CELAS3/value"][-1, 0, 0]
        tube = group["CTUBE/value"][-1, 0, 0]
    np.testing.assert_allclose(bar[:7], table[0, 1:8], rtol=1e-5)
    np.testing.assert_allclose(bar[7:11], table[2, 1:5], rtol=1e-4)
    strain = op2.op2_results.strain
    assert spring == pytest.approx(strain.celas3_strain[10].data[-1, 0, 0], rel=1e-6)
    assert tube == pytest.approx(strain.ctube_strain[10].data[-1, 0, 0], rel=1e-6)


def test_forces_of_dampers_follow_the_velocities(run):
    """CDAMP2, CDAMP4, CVISC and the dashpots of CBUSH, with RCV coefficients."""
    bulk = (
        "GRID,1\nGRID,2,,1.,2.,2.\nSPC1,1,123456,1\nSPC1,1,456,2\nSPOINT,9\n"
        "CDAMP2,1,3.,2,1\nCDAMP4,2,.5,9\nCVISC,3,3,1,2\nPVISC,3,4.,0.\n"
        "CBUSH,4,4,1,2,,,,0\nPBUSH,4,K,50.,60.,70.\n,,B,2.,3.,4.\n,,RCV,2.,3.,5.,7.\n"
        "CMASS2,11,1.,2,1\nCMASS2,12,1.,2,2\nCMASS2,13,1.,2,3\nCMASS4,14,2.,9\n"
        "CELAS4,15,30.,9\nTIC,1,2,1,0.,1.\nTIC,1,2,2,.1,-1.\nTIC,1,9,,.2,0.\n"
        "TSTEP,1,50,.01,5\n"
    )
    case = "SPC=1\nTSTEP=1\nIC=1\nFORCE=ALL\nSTRESS=ALL\nSTRAIN=ALL"
    found = run(109, case, bulk)
    u, v = (found[f"transient/1/{q}"][:, 1, :3] for q in ("displacement", "velocity"))
    scalar = found["transient/1/velocity_scalar_point"][:, 0]
    force = {
        name: found[f"transient/1/element_force/{name}/value"][:, 0]
        for name in ("CDAMP2", "CDAMP4", "CVISC", "CBUSH")
    }
    np.testing.assert_allclose(force["CDAMP2"][:, 0], 3.0 * v[:, 0])
    np.testing.assert_allclose(force["CDAMP4"][:, 0], 0.5 * scalar)
    axis = np.array([1.0, 2.0, 2.0]) / 3.0
    np.testing.assert_allclose(force["CVISC"][:, 0], 4.0 * v @ axis)
    bush = u * [50.0, 60.0, 70.0] + v * [2.0, 3.0, 4.0]
    np.testing.assert_allclose(force["CBUSH"][:, :3], bush)
    stress = found["transient/1/element_stress/CBUSH/value"][:, 0]
    strain = found["transient/1/element_strain/CBUSH/value"][:, 0]
    np.testing.assert_allclose(stress[:, :3], 2.0 * bush)
    np.testing.assert_allclose(strain[:, :3], 5.0 * u)
    assert np.abs(v).max() > 0.1  # it moves


def test_forces_of_rigid_elements_in_a_transient(run):
    """The RBE2 moves an offset mass: its force on it is m a, on the bar the reverse."""
    bulk = (
        BAR + f"GRID,1\nGRID,2,,{L}\nGRID,3,,{L},.5\nCBAR,1,1,1,2,0.,1.,0.\n"
        "SPC1,1,123456,1\nRBE2,5,2,123456,3\nCONM2,6,3,,40.\n"
        "TIC,1,2,2,0.,1.\nTIC,1,2,3,0.,2.\nTSTEP,1,100,2.-4,5\n"
    )
    case = "SPC=1\nTSTEP=1\nIC=1\nMPCFORCES=ALL\nGPFORCE=ALL\nSPCFORCES=ALL"
    found = run(109, case, bulk)
    force = found["transient/1/mpc_force"]
    a = found["transient/1/acceleration"]
    np.testing.assert_allclose(
        force[:, 2, :3], 40.0 * a[:, 2, :3], rtol=1e-9, atol=1e-9
    )
    total = force.sum(axis=1)
    scale = np.abs(force).max()
    np.testing.assert_allclose(total[:, :3], 0.0, atol=1e-9 * scale)
    # About grid 2: the arm of the mass is 0.5 along y.
    about = force[:, 1, 3:] + force[:, 2, 3:]
    about += np.cross([0.0, 0.5, 0.0], force[:, 2, :3])
    np.testing.assert_allclose(about, 0.0, atol=1e-9 * scale)
    source = found["transient/1/grid_point_force/source"].astype(str)
    grid = found["transient/1/grid_point_force/grid_id"]
    rows = found["transient/1/grid_point_force/force"]
    at = np.flatnonzero((source == "F-OF-MPC") & (grid == 3))
    np.testing.assert_allclose(rows[:, at[0]], force[:, 2])
    # What is left over at the grids is inertia.
    rest = rows[:, (source == "*TOTALS*") & (grid == 3)][:, 0, :3]
    np.testing.assert_allclose(rest, 40.0 * a[:, 2, :3], rtol=1e-9, atol=1e-9)
