"""Which cases are drawn, and what stands in the pictures."""

from types import SimpleNamespace

import numpy as np

from drake_landing.conditions import load_pictures as pictures
from drake_landing.conditions.cases23 import unequal_tires
from drake_landing.conditions.ground import BookCase, load
from drake_landing.conditions.mirror import are_alike, without_mirror_images
from drake_landing.conditions.poses import Posed
from drake_landing.conditions.towing25 import towing
from drake_landing.conditions.turning25 import turning
from tests.drake_landing.conditions.aircraft import commuter, transport


def posed(aircraft) -> SimpleNamespace:
    """What pictures ask of `OnGround`."""
    poses = {
        name: Posed(
            places=dict(places),
            R_AG=np.eye(3),
            whole=SimpleNamespace(center=np.zeros(3)),  # type: ignore[arg-type]
            gears={},
        )
        for name, places in aircraft.poses.items()
    }
    return SimpleNamespace(aircraft=aircraft, poses=poses)


def test_a_turn_to_port_is_the_mirror_image_of_one_to_starboard():
    aircraft = transport()
    starboard, port = turning(aircraft)
    assert are_alike(starboard, port, aircraft.poses, mirrored=True)
    assert not are_alike(starboard, port, aircraft.poses)
    ((title, case),) = without_mirror_images(
        [(7, starboard), (8, port)], aircraft.poses
    )
    assert case is starboard
    assert title == "case 7: turn, load to starboard (mirrored: case 8)"


def test_every_tow_is_drawn_or_named(tmp_path):
    aircraft = transport()
    cases = list(enumerate(towing(aircraft), 1))
    titles = [title for title, _ in without_mirror_images(cases, aircraft.poses)]
    # Of 30 and -30, 45 and -45 degrees one each.
    assert len(titles) == 16
    told = (
        " ".join(titles).replace(",", " ").replace(")", " ").replace(":", " ").split()
    )
    assert {int(word) for word in told if word.isdigit()} >= set(range(1, 25))


def test_pages_hold_all_drawn_cases(tmp_path):
    aircraft = transport()
    balances = [SimpleNamespace(case=case) for case in towing(aircraft)][:12]
    paths = pictures.load_pictures(balances, posed(aircraft), tmp_path)  # type: ignore[arg-type]
    assert [path.name for path in paths] == ["25_509.png", "25_509_2.png"]
    assert all(path.stat().st_size > 10_000 for path in paths)


def shown(case: BookCase, aircraft, view: str) -> list[str]:
    """Texts beside arrows and turns of a view."""
    of = next(v for v in pictures._VIEWS if v.name == view)
    pose = posed(aircraft).poses[case.pose]
    drawn = [*pictures._arrows(case, pose, of, 10.0)]
    drawn += pictures._turns(case, pose, of, 10.0)
    return [one.text for one in drawn]


def test_a_view_numbers_the_components_that_it_shows():
    case = BookCase(
        paragraph="-",
        name="-",
        pose="static",
        loads=(
            load("left", "ground", vertical=182e3, drag=46e3, side=-20e3),
            load("right", "ground", vertical=182e3, drag=46e3, side=30e3),
            load("nose", "axle", drag=-9e3, what="tow"),
        ),
    )
    aircraft = transport()
    assert shown(case, aircraft, "from port") == ["D 2 x 46", "D 9", "V 2 x 182"]
    behind = ["S 20", "S 30", "V 182", "V 182"]
    assert shown(case, aircraft, "from behind") == behind
    assert shown(case, aircraft, "from above") == [
        "D 46",
        "D 46",
        "D 9",
        "S 20",
        "S 30",
    ]


def test_moments_about_the_aft_axis_are_drawn_with_their_sense():
    aircraft = commuter()
    case = next(unequal_tires(aircraft))  # 60 % on the starboard wheels
    view = next(v for v in pictures._VIEWS if v.name == "from behind")
    turns = list(pictures._turns(case, posed(aircraft).poses["largest"], view, 10.0))
    assert len(turns) == 2
    # More load to starboard lifts that side: counter-clockwise from behind.
    assert all(turn.arrow[0] > 0.0 for turn in turns)
    assert turns[0].text == f"M {0.2 * 0.15 * 70e3 / 1e3:.3g}"
