"""Decks of solids, plates, composites, bars and rods against NX and MSC.

Largest displacement, frequencies and the direct transient agree to the precision that
the OP2 files hold; forces and stresses of the transient with them.
"""

import h5py
import numpy as np
import pytest

import fem
from fem.solution import run_deck


@pytest.fixture(scope="module")
def folder(references):
    return references / "solid_shell_bar"


def run(path, out):
    return run_deck(fem.read_deck(path), out)


def read_op2(path):
    from pyNastran.op2.op2 import read_op2 as read

    return read(str(path), build_dataframe=False, debug=None, log=None)


@pytest.mark.parametrize(
    "name",
    [
        "static_solid_shell_bar",
        "static_solid_shell_bar_xyz",
        "static_solid_shell_bar_pload1",
    ],
)
def test_statics(folder, tmp_path, name):
    with h5py.File(run(folder / f"{name}.bdf", tmp_path / "a.h5")) as file:
        ours = file["static/1/displacement"][:]
    theirs = read_op2(folder / f"{name}.op2").displacements[1].data[0]
    assert np.abs(ours - theirs).max() < 2e-6 * np.abs(theirs).max()


def test_modes(folder, tmp_path):
    """MSC 2005: 71.26832, 75.95746, 125.7872 Hz."""
    with h5py.File(run(folder / "mode_solid_shell_bar.bdf", tmp_path / "a.h5")) as file:
        ours, shapes = file["modes/frequency_hz"][:], file["modes/shape"][:]
    np.testing.assert_allclose(ours, [71.26832, 75.95746, 125.7872], rtol=2e-6)
    theirs = read_op2(folder / "mode_solid_shell_bar.op2").eigenvectors[1].data
    for mine, other in zip(shapes, theirs):
        sign = np.sign(np.sum(mine * other))
        assert np.abs(sign * mine - other).max() < 1e-4 * np.abs(other).max()


# The OP2 of the transient has no results of these: it was computed without them.
ADDED_LATER = ("CELAS", "PELAS", "CSHEAR", "PSHEAR", "CDAMP", "CONROD")


@pytest.fixture(scope="module")
def transient(folder, tmp_path_factory):
    work = tmp_path_factory.mktemp("transient")
    text = (folder / "transient_solid_shell_bar.bdf").read_text()
    kept = [x for x in text.splitlines() if not x.startswith(ADDED_LATER)]
    (work / "a.bdf").write_text("\n".join(kept))
    (work / "geom.inc").write_text((folder / "geom.inc").read_text())
    out = run(work / "a.bdf", work / "a.h5")
    # The table comes twice in the file: the first 21 times.
    return out, read_op2(folder / "transient_solid_shell_bar.op2")


def test_transient_displacements(transient):
    out, op2 = transient
    theirs = op2.displacements[1].data[:21]
    with h5py.File(out) as file:
        ours = file["transient/1/displacement"][:]
        np.testing.assert_allclose(file["transient/1/time"][:], np.arange(21) / 100)
    assert ours[1, 12, 1] == pytest.approx(0.005184792, rel=1e-5)
    assert ours[5, 12, 1] == pytest.approx(0.006510834, rel=1e-5)
    assert ours[18, 4, 1] == pytest.approx(0.004796416, rel=1e-5)
    assert np.abs(ours - theirs).max() < 1e-5 * np.abs(theirs).max()


def ids_of(table):
    """Element of each row of an OP2 table."""
    by_node = getattr(table, "element_node", None)
    return table.element if by_node is None else by_node[:, 0]


@pytest.mark.parametrize(
    ("kind", "card", "width"),
    [
        ("force", "CTRIA3", 8),
        ("stress", "CTRIA3", 8),
        ("stress", "CHEXA", 10),
        ("stress", "CPENTA", 10),
        ("stress", "CTETRA", 10),
    ],
)
def test_transient_element_results(transient, kind, card, width):
    out, op2 = transient
    table = getattr(op2.op2_results, kind).__dict__[f"{card.lower()}_{kind}"][1]
    theirs = table.data[:21].astype(float)
    with h5py.File(out) as file:
        group = file[f"transient/1/element_{kind}/{card}"]
        ours = group["value"][:].reshape(21, -1, width)
        # NX prints composites here as if they were one layer; ours are plies.
        theirs = theirs[:, np.isin(ids_of(table), group["id"][:])]
    assert ours.shape == theirs.shape
    # The principal angle jumps where the stress passes through zero.
    columns = [k for k in range(width) if (card, kind, k) != ("CTRIA3", "stress", 4)]
    scale = np.abs(theirs[..., columns]).max()
    assert np.abs((ours - theirs)[..., columns]).max() < 1e-4 * scale


def test_transient_quadrilateral_forces(transient):
    out, op2 = transient
    table = op2.op2_results.force.cquad4_force[1]
    theirs = table.data[:21].astype(float)
    with h5py.File(out) as file:
        # STRESS(BILIN): center and corners.
        ours = file["transient/1/element_force/CQUAD4/value"][:].reshape(theirs.shape)
    for columns in (slice(0, 3), slice(3, 6), slice(6, 8)):
        scale = np.abs(theirs[..., columns]).max()
        assert np.abs((ours - theirs)[..., columns]).max() < 1e-4 * scale
