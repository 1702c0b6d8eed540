"""Each element against MSC and NX: its nodal forces, resultants and stresses.

The OP2 files print displacements, grid point forces by element, forces and stresses.
Our matrices times the printed displacements must give the printed forces. Single
precision limits the agreement: a force is a small difference of large products.
"""

import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.elements.registry import read_elements
from fem.model.points import read_points

SURFACES_AND_SOLIDS = ("CQUAD4", "CTRIA3", "CHEXA", "CPENTA", "CTETRA")


@pytest.fixture(scope="module")
def folder(references):
    return references / "solid_shell_bar"


def read_op2(path):
    from pyNastran.op2.op2 import read_op2 as read

    return read(str(path), build_dataframe=False, debug=None, log=None)


@pytest.fixture(scope="module")
def model(folder):
    deck = read_deck(folder / "static_solid_shell_bar.bdf")
    points = read_points(deck)
    blocks = read_elements(deck, points)
    return points, [b for b in blocks if b.card in SURFACES_AND_SOLIDS]


@pytest.fixture(scope="module")
def static(folder):
    return read_op2(folder / "static_solid_shell_bar.op2")


def states(folder, static):
    """Displacements (g, 6) and {element: {grid: force (6,)}} of five states."""
    found = []
    for op2, kind in (
        (static, "displacements"),
        (read_op2(folder / "static_solid_shell_bar_pload1.op2"), "displacements"),
        (read_op2(folder / "mode_solid_shell_bar.op2"), "eigenvectors"),
    ):
        table, forces = getattr(op2, kind)[1], op2.grid_point_forces[1]
        for k, u in enumerate(table.data):
            pairs = forces.node_element
            pairs = pairs if pairs.ndim == 2 else pairs[k]
            by_element: dict[int, dict[int, np.ndarray]] = {}
            for (grid, element), row in zip(pairs, forces.data[k]):
                by_element.setdefault(int(element), {})[int(grid)] = row.astype(float)
            found.append((u.astype(float), by_element))
    return found


def test_nodal_forces_of_every_element(folder, model, static):
    points, blocks = model
    worst = {}
    for u, printed in states(folder, static):
        for block in blocks:
            stiffness = block.stiffness()
            for i, element in enumerate(block.id):
                ours = stiffness[i] @ u.ravel()[block.dof[i]]
                theirs = np.zeros(points.size)
                for grid, force in printed[int(element)].items():
                    row = 6 * points.rows(grid)
                    theirs[row : row + 6] = -force
                # Rounding of the displacements to 24 bits, times the stiffness.
                noise = np.abs(stiffness[i]) @ np.abs(u.ravel()[block.dof[i]]) * 2**-23
                difference = np.abs(ours - theirs[block.dof[i]])
                ratio = difference / (noise + 2e-6 * np.abs(ours).max())
                worst[block.card] = max(worst.get(block.card, 0.0), ratio.max())
    assert set(worst) == set(SURFACES_AND_SOLIDS)
    assert max(worst.values()) < 1.0, worst


def evaluated(recovery, block, u):
    linear = np.einsum("eij,ej->ei", recovery.matrix, u.ravel()[block.dof])
    return recovery.derive(linear)


def table_of(op2, kind, card):
    return getattr(op2.op2_results, kind).__dict__[f"{card.lower()}_{kind}"][1]


def rows_of(table, element):
    ids = getattr(table, "element_node", None)
    ids = table.element if ids is None else ids[:, 0]
    return table.data[0][ids == element].astype(float)


@pytest.mark.parametrize("kind", ["force", "stress", "strain"])
def test_shell_results_at_center_and_corners(model, static, kind):
    u = static.displacements[1].data[0].astype(float)
    compared = 0
    for block in model[1]:
        if block.card not in ("CQUAD4", "CTRIA3"):
            continue
        if block.property_card == "PCOMP" and kind != "force":
            continue
        method = {"force": "forces", "stress": "stresses", "strain": "strains"}[kind]
        ours = evaluated(getattr(block, method)(corner=True), block, u)
        table = table_of(static, kind, block.card)
        for i, element in enumerate(block.id):
            theirs = rows_of(table, element)
            values = ours[i].reshape(theirs.shape)
            scale = np.abs(theirs).max(axis=0)
            # Columns of one kind share the scale: fx fy fxy, mx my mxy, tx ty.
            scale = np.maximum(scale, 1e-3 * scale.max() if kind != "strain" else 0.0)
            assert (np.abs(values - theirs) <= 1e-4 * scale + 1e-12).all()
            compared += 1
    assert compared == (12 if kind == "force" else 6)


def test_ply_stresses(model, static):
    u = static.displacements[1].data[0].astype(float)
    compared = 0
    for block in model[1]:
        if getattr(block, "property_card", "") != "PCOMP":
            continue
        ours = evaluated(block.stresses(), block, u)
        results = static.op2_results.stress
        table = getattr(results, f"{block.card.lower()}_composite_stress")[1]
        for i, element in enumerate(block.id):
            theirs = table.data[0][table.element_layer[:, 0] == element]
            values = ours[i].reshape(-1, 9)[: len(theirs)]
            np.testing.assert_allclose(values, theirs, rtol=1e-4, atol=2e-3)
            assert np.isnan(ours[i].reshape(-1, 9)[len(theirs) :]).all()
            compared += 1
    assert compared == 6


@pytest.mark.parametrize("kind", ["stress", "strain"])
@pytest.mark.parametrize("card", ["CHEXA", "CPENTA", "CTETRA"])
def test_solid_results_at_center_and_corners(model, static, card, kind):
    u = static.displacements[1].data[0].astype(float)
    (block,) = [b for b in model[1] if b.card == card]
    method = block.stresses if kind == "stress" else block.strains
    ours = evaluated(method(), block, u)
    table = table_of(static, kind, card)
    for i, element in enumerate(block.id):
        theirs = rows_of(table, element)
        values = ours[i].reshape(theirs.shape)
        assert np.abs(values - theirs).max() < 2e-5 * np.abs(theirs).max()
