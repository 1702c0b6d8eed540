"""Templated systems are made quickly and look like what they are."""

import pickle
import pydoc

import pytest
from pydrake.autodiffutils import AutoDiffXd
from pydrake.common import cpp_template

from systems.gear.brake import Brake, Brake_
from systems.tire.tire import Tire, Tire_


@pytest.mark.parametrize(
    ("system", "template"), [(Tire, Tire_), (Brake, Brake_)], ids=["Tire", "Brake"]
)
def test_help_shows_the_plain_name_and_arguments(system, template) -> None:
    name = template.name.removesuffix("_")
    shown = pydoc.render_doc(system, renderer=pydoc.plaintext)
    assert shown.splitlines()[0] == (
        f"Python Library Documentation: class {name} in module {system.__module__}"
    )
    assert f"{name}(parameters: " in shown
    assert "*args" not in shown.split("Method resolution order")[0]


def test_templates_are_those_that_drake_would_make() -> None:
    assert Tire_[float] is Tire
    assert Tire_[AutoDiffXd].__module__ == "systems.tire.tire"
    assert pickle.loads(pickle.dumps(Tire)) is Tire
    # Only while systems are made is Drake's slow look-up replaced.
    assert cpp_template._get_module_from_stack.__module__ == cpp_template.__name__
