"""ParaView files opened by VTK's own reader."""

import h5py
import numpy as np
import pytest

import fem
from fem.files.paraview import largest_von_mises, write_paraview

pv = pytest.importorskip("pyvista")

DECK = """\
SOL {sol}
CEND
SPC = 1
SET 9 = 6, 7
DISP = {disp}
STRESS = ALL
SUBCASE 2
{case}
BEGIN BULK
CORD2C,5,,0.,0.,0.,0.,0.,1.,+
+,1.,0.,0.
MAT1,1,7.+10,,.33,2700.
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.,5
GRID,4,,0.,1.,0.,5
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.,5
GRID,8,,0.,1.,1.,5
PSHELL,1,1,.02,1,,1
PCOMP,3,,,,,,,,+
+,1,.01,0.,YES,1,.01,45.,YES
PSOLID,4,1
PBAR,5,1,1.-3,1.-6,2.-6,5.-7,,,+
+,.1,.1,-.1,.1,-.1,-.1,.1,-.1
CHEXA,101,4,1,2,3,4,5,6,+
+,7,8
CQUAD4,111,1,1,2,6,5
CQUAD4,112,3,3,4,8,7
CTRIA3,113,1,5,6,7
CBAR,121,5,1,7,0.,1.,0.
CELAS2,131,1.+5,7,1,8,1
CONM2,135,7,,50.
SPC1,1,123456,1,2,3,4
FORCE,10,6,,1000.,1.,.5,.2
DAREA,20,6,1,1000.
TLOAD1,30,20,,LOAD,40
TABLED1,40
,0.,0.,.01,1.,1.,1.,ENDT
TSTEP,50,40,.001,5
EIGRL,60,,,3
ENDDATA
"""


@pytest.fixture
def written(tmp_path):
    def go(sol, case, disp="ALL", **options):
        path = tmp_path / "model.bdf"
        path.write_text(DECK.format(sol=sol, case=case, disp=disp))
        deck = fem.read_deck(path)
        out = fem.run_deck(deck, tmp_path / "model.h5", fem.Options(**options))
        structure = fem.Structure.from_deck(deck)
        (file,) = write_paraview(out, structure, tmp_path / "paraview")
        return structure, out, file

    return go


def steps(path):
    """The meshes of all steps, read by VTK."""
    reader = pv.get_reader(str(path)).reader
    reader.UpdateInformation()
    meshes = []
    for k in range(max(reader.GetNumberOfSteps(), 1)):
        reader.SetStep(k)
        reader.Update()
        meshes.append(pv.wrap(reader.GetOutput()).copy())
    return meshes


def test_mesh_and_static_results(written):
    structure, out, path = written(101, "LOAD = 10")
    (mesh,) = steps(path)
    np.testing.assert_allclose(mesh.points, structure.points.xyz)
    ids = mesh.cell_data["element_id"].tolist()
    assert sorted(ids) == [101, 111, 112, 113, 121, 135]
    assert sorted(mesh.cell_data["property_id"].tolist()) == [0, 1, 1, 3, 4, 5]
    solid = mesh.extract_cells(mesh.cell_data["element_id"] == 101)
    assert solid.volume == pytest.approx(1.0)
    flat = mesh.extract_cells(mesh.cell_data["element_id"] == 113)
    assert flat.area == pytest.approx(0.5)
    with h5py.File(out) as file:
        u = file["static/2/displacement"][:]
        table = file["static/2/element_stress/CQUAD4"]
        names = list(table.attrs["columns"])
        both = [names.index(f"von_mises_{k}") for k in (1, 2)]
        mises = table["value"][0, both].max()
    turned = np.einsum("gij,gj->gi", structure.points.rotation, u[:, :3])
    assert not np.allclose(turned, u[:, :3])
    np.testing.assert_allclose(mesh.point_data["displacement"], turned, rtol=1e-6)
    stress = mesh.cell_data["von_mises"]
    assert stress[ids.index(111)] == pytest.approx(mises, rel=1e-6)
    assert [ids[k] for k in np.flatnonzero(np.isnan(stress))] == [135]  # a mass
    assert np.nanmin(stress) > 0


def test_histories_and_envelopes(written):
    structure, out, path = written(109, "DLOAD = 30\nTSTEP = 50", envelope=True)
    meshes = steps(path)
    with h5py.File(out) as file:
        group = file["transient/2"]
        assert len(meshes) == len(group["time"])
        for k, mesh in enumerate(meshes):
            for name in ("displacement", "velocity", "acceleration"):
                own = group[name][k, :, :3]
                turned = np.einsum("gij,gj->gi", structure.points.rotation, own)
                scale = np.abs(group[name][:]).max()
                np.testing.assert_allclose(
                    mesh.point_data[name], turned, atol=1e-6 * scale
                )
    stress = np.array([mesh.cell_data["von_mises"] for mesh in meshes])
    envelope = meshes[0].cell_data["von_mises_envelope"]
    known = np.isfinite(envelope)
    # Every step is in the envelope, every fifth in the file.
    assert known.sum() == 4
    assert (envelope[known] >= stress.max(axis=0)[known] * (1 - 1e-6)).all()


def test_modes_are_steps(written):
    _, out, path = written(103, "METHOD = 60")
    meshes = steps(path)
    with h5py.File(out) as file, h5py.File(path) as other:
        np.testing.assert_allclose(
            other["VTKHDF/Steps/Values"][:], file["modes/frequency_hz"][:]
        )
        assert len(meshes) == 3
        free = [0, 1, 4, 5]  # grids with basic axes
        for mesh, shape in zip(meshes, file["modes/shape"][:]):
            np.testing.assert_allclose(
                mesh.point_data["displacement"][free], shape[free, :3], atol=1e-7
            )


def test_grids_that_were_not_asked_for_have_no_displacement(written):
    _, _, path = written(101, "LOAD = 10", disp="9")
    (mesh,) = steps(path)
    known = np.isfinite(mesh.point_data["displacement"]).all(axis=1)
    assert np.flatnonzero(known).tolist() == [5, 6]


def test_largest_stress_of_each_kind_of_table():
    values = np.array([[3.0, -7.0, 5.0]])
    assert largest_von_mises(("axial", "torsion", "x"), values).tolist() == [3.0]
    assert largest_von_mises(("s1a", "smina", "smaxa"), values).tolist() == [7.0]
    plies = ("o11_p1", "o22_p1", "t12_p1")
    expected = np.sqrt(9 + 21 + 49 + 75)
    assert largest_von_mises(plies, values)[0] == pytest.approx(expected)
    assert largest_von_mises(("max_shear", "avg", "x"), values) is None
