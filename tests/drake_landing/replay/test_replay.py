"""The replay: what is drawn and how it moves."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from drake_landing.airframe.skeleton import Skeleton
from drake_landing.case.reading import load_case
from drake_landing.gears.bodies import leg_lines
from drake_landing.gears.rods import rods
from drake_landing.replay.record import deformation_factor, enlarged_bending
from tests.drake_landing.landing_gears import changed


@pytest.mark.parametrize(
    ("displacement", "factor"), [(0.0, 1), (1e-9, 50), (0.01, 20), (0.05, 2), (0.3, 1)]
)
def test_deformation_is_enlarged_by_a_round_factor(
    displacement: float, factor: float
) -> None:
    # Ten metres long: two per cent of it are to be seen, or less.
    net = Skeleton(
        p=np.array([[0.0, 0, 0], [10, 0, 0]]),
        shape=np.array([[[0.0], [0], [0]], [[0], [0], [1]]]),
        edges=np.array([[0, 1]]),
    )
    amplitudes = displacement * np.sin(np.linspace(0, np.pi, 41))[:, None]
    assert deformation_factor(net, amplitudes) == factor


def test_rigid_airframe_is_drawn_as_it_is() -> None:
    net = Skeleton(
        p=np.zeros((2, 3)), shape=np.zeros((2, 3, 0)), edges=np.array([[0, 1]])
    )
    assert deformation_factor(net, np.zeros((5, 0))) == 1


def test_rods_of_a_telescopic_gear_lead_from_attachment_to_axle() -> None:
    case = load_case(Path(__file__).parents[1] / "tiny_case.yaml")
    main = case.gears[1]
    attachment = np.array([8.6, 2.0, -0.3])
    origin = {
        "main_right_fitting": attachment,
        "main_right_piston": np.array(main.axles[0]),
    }
    ends = [
        (origin[r.body] + r.start, origin[r.body] + r.end)
        for r in rods(main, attachment)
    ]
    assert ends[0][0] == pytest.approx(attachment)
    assert ends[1][0] == pytest.approx(ends[0][1])
    assert ends[2][0] == pytest.approx(main.axles[0])
    # The piston reaches into the cylinder, and the axle to the wheels.
    assert ends[2][1][2] > ends[1][1][2]
    assert np.ptp([end[1] for end in ends[3]]) == pytest.approx(0.3)


def test_elastic_legs_are_seen_to_bend_about_their_root() -> None:
    case = load_case(Path(__file__).parents[1] / "tiny_case.yaml")
    law = {"frequency": 16.0}
    main = changed(case.gears[1], leg={"fore_aft": law, "lateral": law})
    attachment, time = np.array([8.6, 2.0, -0.3]), np.array([0.0, 0.1, 0.2])
    angles = {"fore_aft": [0.0, 0.01, -0.02], "lateral": [0.0, 0.0, 0.005]}
    table = pd.DataFrame(angles, index=time)
    lines = leg_lines(main, attachment)
    found = enlarged_bending(table, lines, attachment, time, 5.0)
    axle = np.array(main.axles[0]) - attachment
    for i, X in enumerate(found):
        # The picture has the bending once already; four times more are added.
        more = X.multiply(axle) - axle
        aft, starboard = (4 * -axle[2] * angles[kind][i] for kind in angles)
        np.testing.assert_allclose(more[:2], [aft, starboard], rtol=0.05, atol=1e-12)
        np.testing.assert_allclose(X.translation(), 0.0, atol=1e-12)
    plain = enlarged_bending(None, lines, attachment, time, 5.0)
    assert all(X.IsExactlyIdentity() for X in plain)
    names = {rod.body for rod in rods(main, attachment)}
    assert "main_right_below_lateral" in names
