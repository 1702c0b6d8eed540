"""Names of global modes: by what moves."""

import numpy as np
import pytest

from drake_landing.reduced.checks import reduced_modes
from drake_landing.reduced.make import reduce_structure
from drake_landing.reduced.model import ReducedModel
from drake_landing.reference.d150 import interface_nodes
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.reference_axis import reference_nodes
from drake_landing.reference.global_modes import named_modes, participations, patterns


@pytest.fixture(scope="module")
def model(con) -> ReducedModel:
    return reduce_structure(con.structure, interface_nodes(), "guyan").model


def test_con_has_its_named_modes(model: ReducedModel) -> None:
    found = named_modes(model, reduced_modes(model, 40.0)).set_index("name")
    assert set(found.index) == set(facts("global_modes"))
    assert found["mode"].is_unique, "no mode has two names"
    assert found.loc["wing bending 1", "mode"] == 1
    assert found.loc["wing bending 1", "participation"] > 0.9
    assert found.loc["wing bending 1 antisymmetric", "mode"] == 2
    assert found.loc["engine yaw", "participation"] > 0.8
    assert found.inside[["wing bending 1", "wing torsion", "wing bending 2"]].all()
    assert (found.inside == found.hz.between(found.lowest, found.highest)).all()


def test_a_motion_participates_wholly_in_its_own_name(model: ReducedModel) -> None:
    rigid, mass = model.rigid_body(), model.mass
    for name, (motions, without) in patterns(reference_nodes()).items():
        motion = np.zeros(model.size)
        for row, (grid, component) in enumerate(model.labels):
            if int(grid) in motions[0]:
                motion[row] = motions[0][int(grid)][component - 1]
        if without:
            continue
        motion -= rigid @ np.linalg.solve(
            rigid.T @ mass @ rigid, rigid.T @ mass @ motion
        )
        motion /= np.sqrt(motion @ mass @ motion)
        share = participations(model, motion[:, None])[name][0]
        assert share == pytest.approx(1.0), name


def test_rigid_motions_have_no_name(model: ReducedModel) -> None:
    rigid = model.rigid_body()
    gram = rigid.T @ model.mass @ rigid
    shape = rigid @ np.linalg.inv(np.linalg.cholesky(gram)).T
    for name, share in participations(model, shape).items():
        assert share.max() < 1e-9, name


def test_patterns_are_mirror_images() -> None:
    flip = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    right, left = reference_nodes()["wing_right"], reference_nodes()["wing_left"]
    for name in ("wing bending 1", "wing bending 2", "wing torsion"):
        motion = patterns(reference_nodes())[name][0][0]
        for a, b in zip(right.ids, left.ids):
            np.testing.assert_allclose(motion[a], flip * motion[b], atol=1e-12)
