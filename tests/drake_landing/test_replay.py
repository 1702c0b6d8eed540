"""The replay: what is drawn and how it moves."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.skeleton import Skeleton
from drake_landing.case.reading import load_case
from drake_landing.gears.pictures import rods
from drake_landing.replay.record import deformation_factor


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
    case = load_case(Path(__file__).with_name("tiny_case.yaml"))
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
