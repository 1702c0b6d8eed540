"""The picture of a diagram's wiring."""

import re
import shutil

import pytest
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import (
    Adder,
    ConstantVectorSource,
    Demultiplexer,
    LogVectorOutput,
    Multiplexer,
)

from drake_landing.landing.wiring import wiring_dot, wiring_svg


def _sum():
    """Two sources into an adder, one of them twice; a logger."""
    builder = DiagramBuilder()
    one = builder.AddNamedSystem("one", ConstantVectorSource([1.0]))
    two = builder.AddNamedSystem("two", ConstantVectorSource([2.0]))
    total = builder.AddNamedSystem("total", Adder(3, 1))
    for i, source in enumerate((one, one, two)):
        builder.Connect(source.get_output_port(), total.get_input_port(i))
    LogVectorOutput(total.get_output_port(), builder)
    return builder.Build()


def _read(text):
    """Names of the boxes; arrows as (from, to), with repetitions."""
    boxes = re.findall(r'^"(\w+)";$', text, re.MULTILINE)
    arrows = re.findall(r'^"(\w+)" -> "(\w+)" ', text, re.MULTILINE)
    return set(boxes), sorted(arrows)


def test_systems_and_joined_connections_without_loggers():
    boxes, arrows = _read(wiring_dot(_sum()))
    assert boxes == {"one", "two", "total"}
    assert arrows == [("one", "total"), ("two", "total")]


def test_named_systems_are_left_out():
    boxes, arrows = _read(wiring_dot(_sum(), without=["two"]))
    assert boxes == {"one", "total"}
    assert arrows == [("one", "total")]


def test_what_puts_vectors_together_and_cuts_them_is_part_of_the_arrow():
    builder = DiagramBuilder()
    sources = [
        builder.AddNamedSystem(name, ConstantVectorSource([1.0])) for name in "ab"
    ]
    both = builder.AddNamedSystem("both", Multiplexer(2))
    cut = builder.AddNamedSystem("cut", Demultiplexer(2, 1))
    total = builder.AddNamedSystem("total", Adder(1, 1))
    for i, source in enumerate(sources):
        builder.Connect(source.get_output_port(), both.get_input_port(i))
    builder.Connect(both.get_output_port(), cut.get_input_port())
    builder.Connect(cut.get_output_port(0), total.get_input_port(0))
    boxes, arrows = _read(wiring_dot(builder.Build()))
    assert boxes == {"a", "b", "total"}
    assert arrows == [("a", "total"), ("b", "total")]


@pytest.mark.skipif(shutil.which("dot") is None, reason="Graphviz is not installed")
def test_dot_draws_every_system():
    svg = wiring_svg(_sum())
    assert all(f">{name}</text>" in svg for name in ("one", "two", "total"))
