"""The wiring of a diagram as a small picture: systems and the ports that join them.

Drake's own picture shows every port of every system; this one only what is connected.
"""

import subprocess
from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import Any

from pydrake.systems.framework import Diagram
from pydrake.systems.primitives import Demultiplexer, Multiplexer, VectorLogSink

# Vectors put together and cut, which are but wires here.
_WIRES = (Multiplexer, Demultiplexer)
_HEAD = """digraph wiring {
rankdir=LR; ranksep=0.9; nodesep=0.15;
node [shape=box, style="rounded,filled", fillcolor="#eef3fa", color="#5c6773",
fontname="Helvetica", fontsize=12];
edge [color="#1f5fbf", fontcolor="#5c6773", fontname="Helvetica", fontsize=9];
"""


def wiring_dot(diagram: Diagram, without: Sequence[str] = ("energy_budget",)) -> str:
    """The systems of a diagram and their connections in the dot language.

    Connections between the same two systems are one arrow, labelled with the names of
    the output ports; what only puts vectors together or cuts them is part of the arrow.

    Args:
        diagram: the diagram; loggers are left out.
        without: names of systems to be left out.
    """

    def shown(system: Any) -> bool:
        return (
            not isinstance(system, (VectorLogSink, *_WIRES))
            and system.get_name() not in without
        )

    inputs = defaultdict(list)
    for (target, _), end in diagram.connection_map().items():
        inputs[target.get_name()].append(end)

    def sources(source: Any, port: Any) -> Iterator[tuple[Any, Any]]:
        if not isinstance(source, _WIRES):
            yield source, port
            return
        for before in inputs[source.get_name()]:
            yield from sources(*before)

    systems = [system for system in diagram.GetSystems() if shown(system)]
    rank = {system.get_name(): i for i, system in enumerate(systems)}
    arrows = defaultdict(set)
    for target in systems:
        for end in inputs[target.get_name()]:
            for source, port in sources(*end):
                if shown(source):
                    name = source.get_output_port(port).get_name()
                    place = rank[source.get_name()], rank[target.get_name()]
                    arrows[place].add(name)
    names = list(rank)
    lines = [f'"{name}";' for name in names]
    for (source, target), ports in sorted(arrows.items()):
        label = "\\n".join(sorted(ports))
        lines.append(f'"{names[source]}" -> "{names[target]}" [label="{label}"];')
    return _HEAD + "\n".join(lines) + "\n}\n"


def wiring_svg(diagram: Diagram, without: Sequence[str] = ("energy_budget",)) -> str:
    """The picture as SVG, drawn by the program `dot` of Graphviz.

    Raises:
        FileNotFoundError: `dot` is not installed.
    """
    drawn = subprocess.run(
        ["dot", "-Tsvg"],
        input=wiring_dot(diagram, without),
        capture_output=True,
        text=True,
        check=True,
    )
    return drawn.stdout
