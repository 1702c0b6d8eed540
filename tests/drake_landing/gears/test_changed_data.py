"""Gear data with other values are checked like those of a case."""

import pytest
from pydantic import ValidationError

from drake_landing.reference.d150.gears import landing_gears


@pytest.mark.parametrize("paper", [True, False])
def test_changed_data_differ_in_what_was_changed_alone(paper: bool) -> None:
    for gear in landing_gears(paper=paper):
        assert gear.changed() == gear
        other = gear.changed(tyre=gear.tyre.changed(damping=2e3))
        assert other.tyre.damping == 2e3
        assert other.changed(tyre=gear.tyre) == gear


@pytest.mark.parametrize(
    "values", [{"stifness": 1.5e6}, {"radius": -1.0}, {"stiffness": 1.5e6}]
)
def test_what_no_case_may_say_is_refused(values: dict[str, float]) -> None:
    tire = landing_gears()[0].tyre
    assert tire.load_table is not None  # beside which there is no stiffness
    with pytest.raises(ValidationError, match=next(iter(values))):
        tire.changed(**values)
